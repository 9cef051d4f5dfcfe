// expect: is private within this context|calling a private constructor
#include "lekalo/geom/polygon.hpp"

using lekalo::geom::ConvexPolygon;
using lekalo::geom::Ring;

lekalo::Result<ConvexPolygon> polygon(Ring ring) {
#ifdef LEKALO_WRONG
  return ConvexPolygon(std::move(ring));
#else
  return ConvexPolygon::make(std::move(ring));
#endif
}

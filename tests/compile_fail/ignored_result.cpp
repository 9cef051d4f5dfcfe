// expect: ignoring return value
#include "lekalo/geom/polygon.hpp"

void use(lekalo::geom::Ring ring) {
#ifdef LEKALO_WRONG
  lekalo::geom::ConvexPolygon::make(std::move(ring));
#else
  const auto polygon = lekalo::geom::ConvexPolygon::make(std::move(ring));
  static_cast<void>(polygon);
#endif
}

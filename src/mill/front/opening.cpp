#include "opening.hpp"

#include "lekalo/geom/offset.hpp"

namespace lekalo::mill {

Result<std::vector<geom::Region>> opened_by(const std::vector<geom::Region>& regions, double shrink,
                                            double fillet) {
  LEKALO_TRY(auto least, geom::offset(regions, -(shrink + fillet)));
  LEKALO_TRY(auto opened, geom::offset(least.regions, fillet));
  return std::move(opened.regions);
}

}  // namespace lekalo::mill

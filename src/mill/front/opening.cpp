#include "opening.hpp"

#include "lekalo/geom/offset.hpp"

namespace lekalo::mill {

Result<std::vector<geom::Region>> opened_by(const std::vector<geom::Region>& regions, double shrink,
                                            double fillet) {
  auto least = geom::offset(regions, -(shrink + fillet));
  if (!least) return tl::unexpected(least.error());
  auto opened = geom::offset(least->regions, fillet);
  if (!opened) return tl::unexpected(opened.error());
  return std::move(opened->regions);
}

}  // namespace lekalo::mill

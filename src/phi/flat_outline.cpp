#include "flat_outline.hpp"

namespace lekalo::phi {

FlatOutline flat_outline(const geom::GridRegion& region) {
  const geom::GridBox box = bounds(region);
  FlatOutline flat;
  flat.region = geom::moved(region, -box.low);
  flat.width = box.high.x - box.low.x;
  flat.height = box.high.y - box.low.y;
  const auto& p = flat.region.points;
  flat.box = p.size() == 4;
  for (std::size_t i = 0; i < p.size() && flat.box; ++i)
    flat.box = (p[i].x == 0 || p[i].x == flat.width) && (p[i].y == 0 || p[i].y == flat.height);
  return flat;
}

}  // namespace lekalo::phi

#include "label_place.hpp"

#include <algorithm>
#include <vector>

namespace lekalo::io::detail {

LabelPlace label_place(const geom::GridRegion& outline) {
  const geom::GridBox box = bounds(outline);
  LabelPlace best{geom::mm_from_grid(
                      box.low + geom::GridPoint{(box.high.x - box.low.x) / 2, (box.high.y - box.low.y) / 2}),
                  0, geom::mm_from_grid(box.high.y - box.low.y)};
  double widest = -1;
  for (int row = 1; row <= 7; ++row) {
    const double y =
        static_cast<double>(box.low.y) + static_cast<double>(box.high.y - box.low.y) * row / 8 + 0.5;
    std::vector<double> crossings;
    for (std::size_t l = 0; l < outline.loops(); ++l) {
      const std::uint32_t begin = outline.loop_starts[l], end = outline.loop_starts[l + 1];
      for (std::uint32_t i = begin; i < end; ++i) {
        const geom::GridPoint a = outline.points[i], b = outline.points[i + 1 == end ? begin : i + 1];
        const double ay = static_cast<double>(a.y), by = static_cast<double>(b.y);
        if ((ay > y) == (by > y)) continue;
        crossings.push_back(static_cast<double>(a.x) + (y - ay) / (by - ay) * static_cast<double>(b.x - a.x));
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      if (crossings[i + 1] - crossings[i] > widest) {
        widest = crossings[i + 1] - crossings[i];
        best.at = geom::kGridStep * geom::Point{(crossings[i] + crossings[i + 1]) / 2, y};
        best.width_mm = geom::kGridStep * widest;
      }
  }
  return best;
}

}  // namespace lekalo::io::detail

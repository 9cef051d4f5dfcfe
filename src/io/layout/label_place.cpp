#include "lekalo/io/layout/label_place.hpp"

#include <algorithm>
#include <vector>

#include "lekalo/base/stop.hpp"

namespace lekalo::io {
namespace {

/// x of the outline's crossings with the row, ascending, steps. A row at half a step meets no vertex.
std::vector<double> crossings_at(const geom::GridRegion& outline, double y) {
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
  return crossings;
}

/// The k-th of n rows, steps.
double row_of(const geom::GridBox& box, int k, int n) {
  return static_cast<double>(box.low.y) + static_cast<double>(box.high.y - box.low.y) * k / n + 0.5;
}

/// Says whether an edge comes into the box, mm.
bool crosses_box(const geom::GridRegion& outline, const geom::Box& box) {
  for (std::size_t l = 0; l < outline.loops(); ++l) {
    const std::uint32_t begin = outline.loop_starts[l], end = outline.loop_starts[l + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const geom::Point a = geom::mm_from_grid(outline.points[i]),
                        b = geom::mm_from_grid(outline.points[i + 1 == end ? begin : i + 1]);
      // Cut down to the box side by side; what remains of it lies within.
      double from = 0, to = 1;
      const auto clip = [&](double start, double step, double low, double high) {
        if (step == 0) {
          if (start < low || start > high) to = -1;
          return;
        }
        const double one = (low - start) / step, other = (high - start) / step;
        from = std::max(from, std::min(one, other)), to = std::min(to, std::max(one, other));
      };
      clip(a.x, b.x - a.x, box.low.x, box.high.x);
      clip(a.y, b.y - a.y, box.low.y, box.high.y);
      if (from <= to) return true;
    }
  }
  return false;
}

}  // namespace

LabelPlace label_place(const geom::GridRegion& outline) {
  constexpr int kRows = 8;
  const geom::GridBox box = bounds(outline);
  LabelPlace best{geom::mm_from_grid(
                      box.low + geom::GridPoint{(box.high.x - box.low.x) / 2, (box.high.y - box.low.y) / 2}),
                  0};
  double widest = -1;
  for (int row = 1; row < kRows; ++row) {
    ask(1 + outline.points.size() / 16);
    const double y = row_of(box, row, kRows);
    const std::vector<double> crossings = crossings_at(outline, y);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      if (crossings[i + 1] - crossings[i] > widest) {
        widest = crossings[i + 1] - crossings[i];
        best.at = geom::kGridStep * geom::Point{(crossings[i] + crossings[i + 1]) / 2, y};
        best.width_mm = geom::kGridStep * widest;
      }
  }
  return best;
}

LabelFit fitted_label(const geom::GridRegion& outline, double wide, double least, double most) {
  constexpr int kRows = 12;
  constexpr double kSmaller = 0.8, kRoomBeside = 1.1, kRoomAbove = 1.6;  // some letters reach above and below
  const geom::GridBox box = bounds(outline);
  LabelFit best;
  for (int k = 1; k < kRows; ++k) {
    // The rows are tried from the middle outwards: 6, 5, 7, 4, 8 ...
    const double y = row_of(box, kRows / 2 + (k % 2 == 0 ? -k / 2 : k / 2), kRows);
    const std::vector<double> crossings = crossings_at(outline, y);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const geom::Point middle = geom::kGridStep * geom::Point{(crossings[i] + crossings[i + 1]) / 2, y};
      double height =
          std::min(most, geom::kGridStep * (crossings[i + 1] - crossings[i]) / (wide * kRoomBeside));
      for (; height >= least && height > best.height; height *= kSmaller) {
        const geom::Point half = 0.5 * height * geom::Point{kRoomBeside * wide, kRoomAbove};
        if (crosses_box(outline, {middle - half, middle + half})) continue;
        best = {middle, height};
        break;
      }
    }
  }
  return best;
}

}  // namespace lekalo::io

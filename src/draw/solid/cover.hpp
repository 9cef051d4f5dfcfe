#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "space_view.hpp"

namespace lekalo::draw {

/// Samples of a pixel each way.
inline constexpr int kAcross = 3;

/// Calls visit(column, row, weights) for the samples in a triangle, in rows `from` to before `until` of
/// `columns` samples; the weights of the corners sum to 1. Corners go to a grid of 1/256 sample, and all else
/// is exact: of triangles that share an edge each sample belongs to one, so there are neither gaps nor
/// samples painted twice, and the same picture comes from every compiler.
template <class Visit>
void cover(std::array<ScreenPoint, 3> t, int columns, int from, int until, const Visit& visit) {
  constexpr double kFarthest = 1 << 21;  // samples; beyond it a triangle is bent, but far off the picture
  std::array<std::int64_t, 3> x{}, y{};
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = std::llround(256 * std::clamp(t[k].x, -kFarthest, kFarthest));
    y[k] = std::llround(256 * std::clamp(t[k].y, -kFarthest, kFarthest));
  }
  const std::int64_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0) return;
  const bool turned = area < 0;
  if (turned) std::swap(x[1], x[2]), std::swap(y[1], y[2]);
  const double share = 1 / static_cast<double>(turned ? -area : area);
  const auto [top, bottom] = std::minmax({y[0], y[1], y[2]});
  // The middle of sample k lies at 256 k + 128.
  const int first_row = static_cast<int>(std::max<std::int64_t>(from, (top - 128 + 255) >> 8));
  const int last_row = static_cast<int>(std::min<std::int64_t>(until - 1, (bottom - 128) >> 8));
  for (int row = first_row; row <= last_row; ++row) {
    const std::int64_t middle = 256 * static_cast<std::int64_t>(row) + 128;
    // Edge k lies opposite corner k; at a sample its value is slope * column + start, >= 0 inside.
    std::array<std::int64_t, 3> slope{}, start{};
    std::int64_t first = 0, last = columns - 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t a = (k + 1) % 3, b = (k + 2) % 3;
      const std::int64_t dx = x[b] - x[a], dy = y[b] - y[a];
      slope[k] = -256 * dy;
      start[k] = dx * (middle - y[a]) - dy * (128 - x[a]);
      // A sample on an edge belongs to the side that has the edge running up, or level to the right.
      const std::int64_t inside = start[k] - (dy < 0 || (dy == 0 && dx > 0) ? 0 : 1);
      const auto floor_of = [](std::int64_t n, std::int64_t d) {
        return n >= 0 ? n / d : -((d - 1 - n) / d);
      };
      if (slope[k] > 0) {
        first = std::max(first, -floor_of(inside, slope[k]));
      } else if (slope[k] < 0) {
        last = std::min(last, floor_of(inside, -slope[k]));
      } else if (inside < 0) {
        last = -1;
      }
    }
    for (std::int64_t column = first; column <= last; ++column) {
      std::array<double, 3> weights{};
      for (std::size_t k = 0; k < 3; ++k)
        weights[k] = static_cast<double>(slope[k] * column + start[k]) * share;
      if (turned) std::swap(weights[1], weights[2]);
      visit(static_cast<int>(column), row, weights);
    }
  }
}

}  // namespace lekalo::draw

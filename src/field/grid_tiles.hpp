#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lekalo/base/parallel.hpp"
#include "lekalo/field/grid.hpp"

/// The parts that all fillings of grids by tiles share.
namespace lekalo::field {

inline constexpr std::size_t kTop = 256;  // nodes along a tile

struct Tile {
  std::size_t column, row, columns, rows;
};

/// A disc that holds the nodes of a tile.
struct TileDisc {
  geom::Point middle;
  double radius;
};
inline TileDisc disc_of(const Tile& tile, const GridFrame& frame) {
  const geom::Point low = frame.node(tile.column, tile.row);
  const geom::Point high = frame.node(tile.column + tile.columns - 1, tile.row + tile.rows - 1);
  return {0.5 * (low + high), norm(high - low) / 2};
}

/// Calls act(tile) for those quarters of a tile that have nodes.
template <class Act>
void each_quarter(const Tile& tile, const Act& act) {
  const std::size_t left = (tile.columns + 1) / 2, below = (tile.rows + 1) / 2;
  for (const Tile& part :
       {Tile{tile.column, tile.row, left, below},
        Tile{tile.column + left, tile.row, tile.columns - left, below},
        Tile{tile.column, tile.row + below, left, tile.rows - below},
        Tile{tile.column + left, tile.row + below, tile.columns - left, tile.rows - below}})
    if (part.columns > 0 && part.rows > 0) act(part);
}

inline constexpr float kLeast = std::numeric_limits<float>::min();

/// The parts of FLOZ in single precision, at (x, y) from the segment's middle: f is the line's value, u = f^2
/// / L, and over = sqrt(u^2 + t^2) - t without cancellation, as in floz(). Loops over it become vector
/// instructions.
struct Terms {
  float f, u, over, root;
};
inline Terms terms(float x, float y, float along_x, float along_y, float length, float per_length) {
  const float f = along_x * y - along_y * x;
  const float t = length * 0.25F - (x * x + y * y) * per_length;
  const float u = f * f * per_length;
  const float root = std::sqrt(u * u + t * t) + kLeast;
  const float sum = root + std::abs(t);
  const float small = u * u / sum;
  return {f, u, t > 0 ? small : sum, root};
}

/// The places where the chords cross each row of nodes, ascending: inside is to the right of an odd number.
class Signs {
 public:
  Signs(const ContourModel& model, const GridFrame& frame) : crossings_(frame.rows) {
    const double last = static_cast<double>(frame.rows) - 1;
    for (const ContourModel::Chord& chord : model.chords()) {
      const geom::Point a = chord.a, b = chord.b;
      const double low = std::min(a.y, b.y), high = std::max(a.y, b.y);
      const double begin = std::clamp(std::floor((low - frame.origin.y) / frame.pitch), 0.0, last);
      const double end = std::clamp(std::ceil((high - frame.origin.y) / frame.pitch), 0.0, last);
      for (auto j = static_cast<std::size_t>(begin); j <= static_cast<std::size_t>(end); ++j) {
        const double y = frame.node(0, j).y;
        if ((a.y <= y) != (b.y <= y)) crossings_[j].push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    }
    for (std::vector<double>& row : crossings_) std::sort(row.begin(), row.end());
  }
  /// 1 inside, -1 outside, for nodes of one row.
  void fill(const GridFrame& frame, std::size_t column, std::size_t row, std::size_t n, float* sign) const {
    const std::vector<double>& crossings = crossings_[row];
    const auto passed = [&](std::size_t i) {
      return std::upper_bound(crossings.begin(), crossings.end(), frame.node(column + i, row).x) -
             crossings.begin();
    };
    auto at = passed(0);
    if (const auto end = passed(n - 1); at == end) {
      std::fill(sign, sign + n, at % 2 == 1 ? 1.0F : -1.0F);
      return;
    }
    for (std::size_t i = 0; i < n; ++i) sign[i] = passed(i) % 2 == 1 ? 1.0F : -1.0F;
  }

 private:
  std::vector<std::vector<double>> crossings_;
};

/// Calls act(tile) for the tiles of kTop nodes along a side, each once. Which thread does which changes
/// nothing.
template <class Act>
void each_top_tile(const GridFrame& frame, unsigned threads, const Act& act) {
  const std::size_t across = (frame.columns + kTop - 1) / kTop, up = (frame.rows + kTop - 1) / kTop;
  share_out(across * up, threads, [&](std::size_t n) {
    const std::size_t column = n % across * kTop, row = n / across * kTop;
    act(Tile{column, row, std::min(kTop, frame.columns - column), std::min(kTop, frame.rows - row)});
  });
}

}  // namespace lekalo::field

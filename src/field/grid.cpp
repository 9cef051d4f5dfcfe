#include "lekalo/field/grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "grid_quadratic.hpp"
#include "grid_tiles.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/base/wide.hpp"

namespace lekalo::field {
namespace {

constexpr std::size_t kSmallTile = 8;    // nodes along a tile
constexpr std::size_t kFewSegments = 2;  // segments that need no further division
constexpr std::size_t kBlock = 256;      // nodes looked at together
using Numbers = std::vector<std::uint32_t>;

/// A segment seen from a tile's middle, in single precision.
struct NearSegment {
  float x, y, along_x, along_y, length;
};

/// Some nodes of a tile, the least value at each, and which of the tile's segments has it.
struct Block {
  std::array<float, kBlock> x, y, least;
  std::array<std::uint32_t, kBlock> which;
  std::array<float, kBlock> from_x, from_y, along_x, along_y, length;  ///< node from segment; the segment
  std::array<float, kBlock> value, dx, dy, sign;
};

// The loops below become vector instructions: no branch, no call, no order of sums that matters.

inline void keep_least(Block& block, std::size_t i, float value, std::uint32_t number) {
  const bool less = value < block.least[i];
  block.least[i] = less ? value : block.least[i];
  block.which[i] = less ? number : block.which[i];
}

LEKALO_WIDE void least_normalised(const NearSegment& s, Block& block, std::size_t n, std::uint32_t number) {
  const float per_length = 1 / s.length;
  for (std::size_t i = 0; i < n; ++i) {
    const Terms at = terms(block.x[i] - s.x, block.y[i] - s.y, s.along_x, s.along_y, s.length, per_length);
    keep_least(block, i, at.f * at.f + 0.25F * at.over * at.over, number);  // the square
  }
}

/// Does the same where t < 0: no node lies in the disc that has the segment as diameter.
LEKALO_WIDE void least_normalised_beyond(const NearSegment& s, Block& block, std::size_t n,
                                         std::uint32_t number) {
  const float per_length = 1 / s.length, quarter = 0.25F * s.length;
  for (std::size_t i = 0; i < n; ++i) {
    const float x = block.x[i] - s.x, y = block.y[i] - s.y;
    const float f = s.along_x * y - s.along_y * x, square = f * f;
    const float past = (x * x + y * y) * per_length - quarter, u = square * per_length;
    const float over = past + std::sqrt(u * u + past * past);
    keep_least(block, i, square + 0.25F * over * over, number);
  }
}

LEKALO_WIDE void least_algebraic(const NearSegment& s, Block& block, std::size_t n, std::uint32_t number) {
  const float per_length = 1 / s.length;
  for (std::size_t i = 0; i < n; ++i) {
    const Terms at = terms(block.x[i] - s.x, block.y[i] - s.y, s.along_x, s.along_y, s.length, per_length);
    keep_least(block, i, at.u + at.over, number);
  }
}

LEKALO_WIDE void least_distance(const NearSegment& s, Block& block, std::size_t n, std::uint32_t number) {
  const float half = s.length * 0.5F;
  for (std::size_t i = 0; i < n; ++i) {
    const float x = block.x[i] - s.x, y = block.y[i] - s.y;
    const float f = s.along_x * y - s.along_y * x, along = s.along_x * x + s.along_y * y;
    const float past = std::max(0.0F, std::abs(along) - half);
    keep_least(block, i, f * f + past * past, number);  // the square
  }
}

/// grad over = 2 (over d + u f n) / (L root), because t / root - 1 = -over / root.
LEKALO_WIDE void jets_normalised(Block& block, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float x = block.from_x[i], y = block.from_y[i], ax = block.along_x[i], ay = block.along_y[i];
    const float per_length = 1 / block.length[i];
    const Terms at = terms(x, y, ax, ay, block.length[i], per_length);
    const float g = 0.5F * at.over, value = std::sqrt(at.f * at.f + g * g), by = 1 / (value + kLeast);
    const float scale = g * per_length / at.root, turn = scale * at.u * at.f + at.f;
    block.value[i] = value;
    block.dx[i] = by * (scale * at.over * x - turn * ay);
    block.dy[i] = by * (scale * at.over * y + turn * ax);
  }
}

LEKALO_WIDE void jets_algebraic(Block& block, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float x = block.from_x[i], y = block.from_y[i], ax = block.along_x[i], ay = block.along_y[i];
    const float per_length = 1 / block.length[i];
    const Terms at = terms(x, y, ax, ay, block.length[i], per_length);
    const float scale = 2 * per_length / at.root, turn = scale * at.u * at.f + 2 * at.f * per_length;
    block.value[i] = at.u + at.over;
    block.dx[i] = scale * at.over * x - turn * ay;
    block.dy[i] = scale * at.over * y + turn * ax;
  }
}

LEKALO_WIDE void jets_distance(Block& block, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const float x = block.from_x[i], y = block.from_y[i], ax = block.along_x[i], ay = block.along_y[i];
    const float half = 0.5F * block.length[i];
    const float f = ax * y - ay * x, along = ax * x + ay * y;
    const float past = along - std::min(std::max(along, -half), half);
    const float value = std::sqrt(f * f + past * past), by = 1 / (value + kLeast);
    block.value[i] = value;
    block.dx[i] = by * (past * ax - f * ay), block.dy[i] = by * (past * ay + f * ax);
  }
}

/// A kind of function says these of itself: bounds over a disc, the least value at nodes and jets in single
/// precision, and a jet in double.
struct LinearFloz {
  const ContourModel& model;
  [[nodiscard]] FlozBounds bounds(const FlozSegment& s, geom::Point x, double radius) const {
    return floz_bounds(s, x, radius, model.options().form);
  }
  [[nodiscard]] bool normalised() const { return model.options().form == FlozForm::normalised; }
  void least(const NearSegment& s, Block& block, std::size_t n, std::uint32_t number, float radius) const {
    if (!normalised()) return least_algebraic(s, block, n, number);
    const bool beyond = std::sqrt(s.x * s.x + s.y * s.y) > 1.001F * (radius + 0.5F * s.length);
    (beyond ? least_normalised_beyond : least_normalised)(s, block, n, number);
  }
  void jets(Block& block, std::size_t n) const {
    (normalised() ? jets_normalised : jets_algebraic)(block, n);
  }
  [[nodiscard]] Jet jet(const FlozSegment& s, geom::Point x) const {
    return floz(s, x, model.options().form);
  }
};

struct Distance {
  static FlozBounds bounds(const FlozSegment& s, geom::Point x, double radius) {
    const double d = jet(s, x).value;
    return {std::max(0.0, d - radius), d + radius};
  }
  static void least(const NearSegment& s, Block& block, std::size_t n, std::uint32_t number,
                    float /*radius*/) {
    least_distance(s, block, n, number);
  }
  static void jets(Block& block, std::size_t n) { jets_distance(block, n); }
  static Jet jet(const FlozSegment& s, geom::Point x) {
    const double along = std::clamp(dot(s.along, x - s.middle), -s.length / 2, s.length / 2);
    const geom::Point off = x - (s.middle + along * s.along);
    const double d = norm(off);
    return {d, d > 0 ? (1 / d) * off : geom::Point{}};
  }
};

template <class Kind>
class TileSampler {
 public:
  TileSampler(const Kind& kind, const ContourModel& model, FieldGrid& grid)
      : kind_(kind), model_(model), grid_(grid), signs_(model, grid.frame) {
    all_.resize(model.segments().size());
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i] = static_cast<std::uint32_t>(i);
  }

  void top_tile(const Tile& tile) const {
    Workspace space;
    space.kept.resize(12);
    divide(tile, all_, 0, space);
  }

 private:
  struct Workspace {
    std::vector<Numbers> kept;  ///< one a depth of division
    std::vector<double> lows;
    std::vector<NearSegment> near;
    Block block;
  };

  void divide(const Tile& tile, const Numbers& numbers, std::size_t depth, Workspace& space) const {
    const auto [middle, radius] = disc_of(tile, grid_.frame);
    double least_high = std::numeric_limits<double>::infinity();
    space.lows.clear();
    for (const std::uint32_t number : numbers) {
      const FlozBounds bounds = kind_.bounds(model_.segments()[number], middle, radius);
      space.lows.push_back(bounds.low);
      least_high = std::min(least_high, bounds.high);
    }
    const double limit = least_high * (1 + 4 * kFieldGridError);
    Numbers& kept = space.kept[depth];
    kept.clear();
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (space.lows[i] <= limit) kept.push_back(numbers[i]);
    if (kept.size() <= kFewSegments || (tile.columns <= kSmallTile && tile.rows <= kSmallTile))
      return fill(tile, middle, kept, space);
    each_quarter(tile, [&](const Tile& part) { divide(part, kept, depth + 1, space); });
  }

  void fill(const Tile& tile, geom::Point middle, const Numbers& numbers, Workspace& space) const {
    space.near.clear();
    double longest = 0;
    for (const std::uint32_t i : numbers) {
      const FlozSegment& s = model_.segments()[i];
      const geom::Point at = s.middle - middle;
      space.near.push_back({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(s.along.x),
                            static_cast<float>(s.along.y), static_cast<float>(s.length)});
      longest = std::max(longest, s.length);
    }
    const GridFrame& frame = grid_.frame;
    const double off = norm(frame.node(tile.column, tile.row) - middle);
    // Nearer to a segment than this, single precision would not tell the side.
    const auto close = static_cast<float>(2e-3 * off + 1e-4 * std::min(longest, off));
    Block& block = space.block;
    const std::size_t rows_at_once = std::max<std::size_t>(1, kBlock / tile.columns);
    for (std::size_t j = 0; j < tile.rows; j += rows_at_once) {
      ask(1 + tile.columns);
      const std::size_t rows = std::min(rows_at_once, tile.rows - j), n = rows * tile.columns;
      for (std::size_t r = 0; r < rows; ++r) {
        const geom::Point begin = frame.node(tile.column, tile.row + j + r) - middle;
        for (std::size_t i = 0; i < tile.columns; ++i) {
          block.x[r * tile.columns + i] = static_cast<float>(begin.x + frame.pitch * static_cast<double>(i));
          block.y[r * tile.columns + i] = static_cast<float>(begin.y);
        }
        signs_.fill(frame, tile.column, tile.row + j + r, tile.columns, &block.sign[r * tile.columns]);
      }
      std::fill_n(block.which.begin(), n, 0U);
      if (space.near.size() > 1) {
        std::fill_n(block.least.begin(), n, std::numeric_limits<float>::infinity());
        for (std::size_t k = 0; k < space.near.size(); ++k)
          kind_.least(space.near[k], block, n, static_cast<std::uint32_t>(k), static_cast<float>(off));
      }
      for (std::size_t i = 0; i < n; ++i) {
        const NearSegment& s = space.near[block.which[i]];
        block.from_x[i] = block.x[i] - s.x, block.from_y[i] = block.y[i] - s.y;
        block.along_x[i] = s.along_x, block.along_y[i] = s.along_y, block.length[i] = s.length;
      }
      kind_.jets(block, n);
      for (std::size_t i = 0; i < n; ++i) {
        if (!(block.value[i] < close)) continue;
        const geom::Point node = frame.node(tile.column + i % tile.columns, tile.row + j + i / tile.columns);
        const Jet jet = kind_.jet(model_.segments()[numbers[block.which[i]]], node);
        block.value[i] = static_cast<float>(jet.value);
        block.dx[i] = static_cast<float>(jet.gradient.x), block.dy[i] = static_cast<float>(jet.gradient.y);
      }
      for (std::size_t r = 0; r < rows; ++r) {
        const std::size_t to = (tile.row + j + r) * frame.columns + tile.column, from = r * tile.columns;
        for (std::size_t i = 0; i < tile.columns; ++i) {
          grid_.value[to + i] = block.sign[from + i] * block.value[from + i];
          grid_.dx[to + i] = block.sign[from + i] * block.dx[from + i];
          grid_.dy[to + i] = block.sign[from + i] * block.dy[from + i];
        }
      }
    }
  }

  const Kind& kind_;
  const ContourModel& model_;
  FieldGrid& grid_;
  Signs signs_;
  Numbers all_;
};

template <class Kind>
void sample_tiles(const Kind& kind, const ContourModel& model, FieldGrid& grid, unsigned threads) {
  const TileSampler<Kind> sampler(kind, model, grid);
  each_top_tile(grid.frame, threads, [&](const Tile& tile) { sampler.top_tile(tile); });
}

FieldGrid empty_grid(const GridFrame& frame) {
  return {frame, Samples(frame.size()), Samples(frame.size()), Samples(frame.size())};
}

}  // namespace

FieldGrid sample(const ContourModel& model, const GridFrame& frame, unsigned threads) {
  FieldGrid grid = empty_grid(frame);
  if (model.options().logic == Logic::linear) {
    sample_tiles(LinearFloz{model}, model, grid, threads);
  } else {
    sample_quadratic(model, threads, grid);
  }
  return grid;
}

FieldGrid sample_distance(const ContourModel& model, const GridFrame& frame, unsigned threads) {
  FieldGrid grid = empty_grid(frame);
  sample_tiles(Distance{}, model, grid, threads);
  return grid;
}

std::vector<double> signed_distances(const geom::RegionIndex& regions, const GridFrame& frame) {
  std::vector<double> distance(frame.size());
  std::uint32_t likely = 0;
  for (std::size_t n = 0; n < distance.size(); ++n) {
    const geom::Point p = frame.node(n % frame.columns, n / frame.columns);
    const auto near = regions.nearest(p, likely);
    likely = near.edge;
    // The side changes only where the boundary passes between two nodes.
    const bool same = n % frame.columns != 0 && std::abs(distance[n - 1]) > 1.01 * frame.pitch;
    const bool inside = same ? distance[n - 1] > 0 : regions.contains(p);
    distance[n] = inside ? near.distance : -near.distance;
  }
  return distance;
}

}  // namespace lekalo::field

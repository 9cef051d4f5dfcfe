#include "lekalo/field/grid.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>

namespace lekalo::field {
namespace {

constexpr std::size_t kTop = 256, kSmall = 8;  // nodes along a tile
constexpr std::size_t kFew = 2;                // segments that need no further division
constexpr std::size_t kBlock = 256;            // nodes looked at together
constexpr float kLeast = std::numeric_limits<float>::min();
using Numbers = std::vector<std::uint32_t>;

struct Tile {
  std::size_t column, row, columns, rows;
};

/// A segment seen from a tile's middle, in single precision.
struct NearSegment {
  float x, y, along_x, along_y, length;
};

/// Value and gradient of some nodes of a tile, and which of its segments they belong to.
struct Block {
  std::array<float, kBlock> x, y, value, dx, dy;
  std::array<std::uint32_t, kBlock> which;
};

/// Keeps what is less than what is there. Loops of this kind are made vector instructions by the compiler:
/// no branch, no call, no order of sums that matters.
struct LeastOf {
  Block& block;
  std::uint32_t number;
  void operator()(std::size_t i, float value, float dx, float dy) const {
    const bool less = value < block.value[i];
    block.value[i] = less ? value : block.value[i];
    block.dx[i] = less ? dx : block.dx[i];
    block.dy[i] = less ? dy : block.dy[i];
    block.which[i] = less ? number : block.which[i];
  }
};

/// What a kind of function is: bounds over a disc, jets at nodes in single precision, a jet in double.
struct LinearFloz {
  const ContourModel& model;
  [[nodiscard]] FlozBounds bounds(const FlozSegment& s, geom::Point x, double radius) const {
    return floz_bounds(s, x, radius, model.options().form);
  }
  /// As floz(): f the line's value, u = f^2 / L, over = sqrt(u^2 + t^2) - t without cancellation, and
  /// grad over = 2 (over d + u f n) / (L root), because t / root - 1 = -over / root.
  template <bool kNormalised>
  static void least(const NearSegment& s, Block& block, std::size_t n, std::uint32_t number) {
    const LeastOf least_of{block, number};
    const float per_length = 1 / s.length;
    for (std::size_t i = 0; i < n; ++i) {
      const float x = block.x[i] - s.x, y = block.y[i] - s.y;
      const float f = s.along_x * y - s.along_y * x;
      const float t = s.length * 0.25F - (x * x + y * y) * per_length;
      const float u = f * f * per_length;
      const float root = std::sqrt(u * u + t * t) + kLeast;
      const float sum = root + std::abs(t);
      const float small = u * u / sum;
      const float over = t > 0 ? small : sum;
      const float scale = 2 * per_length / root;
      const float over_x = scale * (over * x - u * f * s.along_y),
                  over_y = scale * (over * y + u * f * s.along_x);
      if constexpr (kNormalised) {
        const float g = 0.5F * over, value = std::sqrt(f * f + g * g), by = 1 / (value + kLeast);
        least_of(i, value, by * (0.5F * g * over_x - f * s.along_y),
                 by * (0.5F * g * over_y + f * s.along_x));
      } else {
        const float du = 2 * f * per_length;
        least_of(i, u + over, over_x - du * s.along_y, over_y + du * s.along_x);
      }
    }
  }
  void least_of(const NearSegment& s, Block& block, std::size_t n, std::uint32_t number) const {
    if (model.options().form == FlozForm::normalised)
      least<true>(s, block, n, number);
    else
      least<false>(s, block, n, number);
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
  static void least_of(const NearSegment& s, Block& block, std::size_t n, std::uint32_t number) {
    const LeastOf least_of{block, number};
    const float half = s.length * 0.5F;
    for (std::size_t i = 0; i < n; ++i) {
      const float x = block.x[i] - s.x, y = block.y[i] - s.y;
      const float f = s.along_x * y - s.along_y * x, along = s.along_x * x + s.along_y * y;
      const float past = along - std::min(std::max(along, -half), half);
      const float value = std::sqrt(f * f + past * past), by = 1 / (value + kLeast);
      least_of(i, value, by * (past * s.along_x - f * s.along_y), by * (past * s.along_y + f * s.along_x));
    }
  }
  static Jet jet(const FlozSegment& s, geom::Point x) {
    const double along = std::clamp(dot(s.along, x - s.middle), -s.length / 2, s.length / 2);
    const geom::Point off = x - (s.middle + along * s.along);
    const double d = norm(off);
    return {d, d > 0 ? (1 / d) * off : geom::Point{}};
  }
};

/// Calls act(number) for 0 .. count - 1, each once, on `threads` threads. Which does which changes nothing.
template <class Act>
void share_out(std::size_t count, unsigned threads, const Act& act) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) act(i);
  };
  std::vector<std::thread> others;
  for (unsigned t = 1; t < threads; ++t) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
}

/// Where the chords cross each row of nodes, ascending: inside is to the right of an odd number.
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

template <class Kind>
class Sampler {
 public:
  Sampler(const Kind& kind, const ContourModel& model, FieldGrid& grid)
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
    std::array<float, kBlock> sign;
  };

  void divide(const Tile& tile, const Numbers& numbers, std::size_t depth, Workspace& space) const {
    const GridFrame& frame = grid_.frame;
    const geom::Point low = frame.node(tile.column, tile.row);
    const geom::Point high = frame.node(tile.column + tile.columns - 1, tile.row + tile.rows - 1);
    const geom::Point middle = 0.5 * (low + high);
    const double radius = norm(high - low) / 2;
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
    if (kept.size() <= kFew || (tile.columns <= kSmall && tile.rows <= kSmall))
      return fill(tile, middle, kept, space);
    const std::size_t left = (tile.columns + 1) / 2, below = (tile.rows + 1) / 2;
    for (const Tile& part :
         {Tile{tile.column, tile.row, left, below},
          Tile{tile.column + left, tile.row, tile.columns - left, below},
          Tile{tile.column, tile.row + below, left, tile.rows - below},
          Tile{tile.column + left, tile.row + below, tile.columns - left, tile.rows - below}})
      if (part.columns > 0 && part.rows > 0) divide(part, kept, depth + 1, space);
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
      const std::size_t rows = std::min(rows_at_once, tile.rows - j), n = rows * tile.columns;
      for (std::size_t r = 0; r < rows; ++r) {
        const geom::Point begin = frame.node(tile.column, tile.row + j + r) - middle;
        for (std::size_t i = 0; i < tile.columns; ++i) {
          block.x[r * tile.columns + i] = static_cast<float>(begin.x + frame.pitch * static_cast<double>(i));
          block.y[r * tile.columns + i] = static_cast<float>(begin.y);
        }
        signs_.fill(frame, tile.column, tile.row + j + r, tile.columns, &space.sign[r * tile.columns]);
      }
      std::fill_n(block.value.begin(), n, std::numeric_limits<float>::infinity());
      for (std::size_t k = 0; k < space.near.size(); ++k)
        kind_.least_of(space.near[k], block, n, static_cast<std::uint32_t>(k));
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
          grid_.value[to + i] = space.sign[from + i] * block.value[from + i];
          grid_.dx[to + i] = space.sign[from + i] * block.dx[from + i];
          grid_.dy[to + i] = space.sign[from + i] * block.dy[from + i];
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
  const Sampler<Kind> sampler(kind, model, grid);
  const GridFrame& frame = grid.frame;
  const std::size_t across = (frame.columns + kTop - 1) / kTop, up = (frame.rows + kTop - 1) / kTop;
  share_out(across * up, threads, [&](std::size_t n) {
    const std::size_t column = n % across * kTop, row = n / across * kTop;
    sampler.top_tile({column, row, std::min(kTop, frame.columns - column), std::min(kTop, frame.rows - row)});
  });
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
    const Signs signs(model, frame);
    share_out(frame.rows, threads, [&](std::size_t j) {
      std::vector<float> sign(frame.columns);
      signs.fill(frame, 0, j, frame.columns, sign.data());
      for (std::size_t i = 0; i < frame.columns; ++i) {
        const Jet jet = model.unsigned_at(frame.node(i, j));
        const std::size_t n = j * frame.columns + i;
        grid.value[n] = sign[i] * static_cast<float>(jet.value);
        grid.dx[n] = sign[i] * static_cast<float>(jet.gradient.x);
        grid.dy[n] = sign[i] * static_cast<float>(jet.gradient.y);
      }
    });
  }
  return grid;
}

FieldGrid sample_distance(const ContourModel& model, const GridFrame& frame, unsigned threads) {
  FieldGrid grid = empty_grid(frame);
  sample_tiles(Distance{}, model, grid, threads);
  return grid;
}

}  // namespace lekalo::field

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
constexpr std::size_t kFew = 3;                // segments that need no further division
using Numbers = std::vector<std::uint32_t>;

struct Tile {
  std::size_t column, row, columns, rows;
};

/// A segment seen from a tile's middle, in single precision.
struct NearSegment {
  float x, y, along_x, along_y, length;
};

/// What a kind of function is: bounds over a disc, the square at a node in single precision, the jet.
struct LinearFloz {
  const ContourModel& model;
  [[nodiscard]] FlozBounds bounds(const FlozSegment& s, geom::Point x, double radius) const {
    return floz_bounds(s, x, radius, model.options().form);
  }
  /// What both forms are made of: the line's value f, f^2 / L, and root - t without cancellation, where root
  /// is that of (f^2 / L)^2 + t^2.
  struct Terms {
    float f, u, root_less_t;
  };
  static Terms terms(const NearSegment& s, float px, float py) {
    const float dx = px - s.x, dy = py - s.y;
    const float f = s.along_x * dy - s.along_y * dx;
    const float t = s.length * 0.25F - (dx * dx + dy * dy) / s.length;
    const float u = f * f / s.length;
    const float root = std::sqrt(u * u + t * t);
    const float sum = root + std::abs(t);
    const float small = u * u / std::max(sum, std::numeric_limits<float>::min());
    return {f, u, t > 0 ? small : sum};
  }
  static float normalised_square(const NearSegment& s, float px, float py) {
    const Terms at = terms(s, px, py);
    const float g = 0.5F * at.root_less_t;
    return at.f * at.f + g * g;
  }
  static float algebraic(const NearSegment& s, float px, float py) {
    const Terms at = terms(s, px, py);
    return at.u + at.root_less_t;
  }
  /// Grows with the value; the value is its square root where rooted().
  [[nodiscard]] bool rooted() const { return model.options().form == FlozForm::normalised; }
  void measure(const NearSegment& s, const float* px, float py, std::size_t n, float* out) const {
    if (rooted())
      for (std::size_t i = 0; i < n; ++i) out[i] = normalised_square(s, px[i], py);
    else
      for (std::size_t i = 0; i < n; ++i) out[i] = algebraic(s, px[i], py);
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
  [[nodiscard]] static bool rooted() { return true; }
  static void measure(const NearSegment& s, const float* px, float py, std::size_t n, float* out) {
    const float half = s.length * 0.5F;
    for (std::size_t i = 0; i < n; ++i) {
      const float dx = px[i] - s.x, dy = py - s.y;
      const float f = s.along_x * dy - s.along_y * dx;
      const float past = std::max(0.0F, std::abs(s.along_x * dx + s.along_y * dy) - half);
      out[i] = f * f + past * past;
    }
  }
  static Jet jet(const FlozSegment& s, geom::Point x) {
    const double along = std::clamp(dot(s.along, x - s.middle), -s.length / 2, s.length / 2);
    const geom::Point off = x - (s.middle + along * s.along);
    const double d = norm(off);
    return {d, d > 0 ? (1 / d) * off : geom::Point{}};
  }
};

template <class Kind>
class Sampler {
 public:
  Sampler(const Kind& kind, const ContourModel& model, FieldGrid& grid)
      : kind_(kind), model_(model), grid_(grid) {
    all_.resize(model.segments().size());
    for (std::size_t i = 0; i < all_.size(); ++i) all_[i] = static_cast<std::uint32_t>(i);
  }

  void top_tile(const Tile& tile) const { divide(tile, all_); }

 private:
  void divide(const Tile& tile, const Numbers& numbers) const {
    const GridFrame& frame = grid_.frame;
    const geom::Point low = frame.node(tile.column, tile.row);
    const geom::Point high = frame.node(tile.column + tile.columns - 1, tile.row + tile.rows - 1);
    const geom::Point middle = 0.5 * (low + high);
    const double radius = norm(high - low) / 2;
    double least_high = std::numeric_limits<double>::infinity();
    std::vector<double> lows(numbers.size());
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const FlozBounds bounds = kind_.bounds(model_.segments()[numbers[i]], middle, radius);
      lows[i] = bounds.low;
      least_high = std::min(least_high, bounds.high);
    }
    const double limit = least_high * (1 + 4 * kFieldGridError);
    Numbers kept;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      if (lows[i] <= limit) kept.push_back(numbers[i]);
    if (kept.size() <= kFew || (tile.columns <= kSmall && tile.rows <= kSmall))
      return fill(tile, middle, kept);
    const std::size_t left = (tile.columns + 1) / 2, below = (tile.rows + 1) / 2;
    for (const Tile& part :
         {Tile{tile.column, tile.row, left, below},
          Tile{tile.column + left, tile.row, tile.columns - left, below},
          Tile{tile.column, tile.row + below, left, tile.rows - below},
          Tile{tile.column + left, tile.row + below, tile.columns - left, tile.rows - below}})
      if (part.columns > 0 && part.rows > 0) divide(part, kept);
  }

  void fill(const Tile& tile, geom::Point middle, const Numbers& numbers) const {
    std::vector<NearSegment> near;
    for (const std::uint32_t i : numbers) {
      const FlozSegment& s = model_.segments()[i];
      const geom::Point at = s.middle - middle;
      near.push_back({static_cast<float>(at.x), static_cast<float>(at.y), static_cast<float>(s.along.x),
                      static_cast<float>(s.along.y), static_cast<float>(s.length)});
    }
    const GridFrame& frame = grid_.frame;
    std::array<float, kTop> px, least, found;
    std::array<std::uint32_t, kTop> which;
    for (std::size_t i = 0; i < tile.columns; ++i)
      px[i] = static_cast<float>(frame.node(tile.column + i, tile.row).x - middle.x);
    for (std::size_t j = 0; j < tile.rows; ++j) {
      const float py = static_cast<float>(frame.node(tile.column, tile.row + j).y - middle.y);
      kind_.measure(near[0], px.data(), py, tile.columns, least.data());
      for (std::size_t i = 0; i < tile.columns; ++i) which[i] = 0;
      for (std::size_t k = 1; k < near.size(); ++k) {
        kind_.measure(near[k], px.data(), py, tile.columns, found.data());
        const auto number = static_cast<std::uint32_t>(k);
        for (std::size_t i = 0; i < tile.columns; ++i) {
          const bool better = found[i] < least[i];
          least[i] = better ? found[i] : least[i];
          which[i] = better ? number : which[i];
        }
      }
      const std::size_t begin = (tile.row + j) * frame.columns + tile.column;
      for (std::size_t i = 0; i < tile.columns; ++i) {
        const Jet jet =
            kind_.jet(model_.segments()[numbers[which[i]]], frame.node(tile.column + i, tile.row + j));
        grid_.value[begin + i] = static_cast<float>(jet.value);
        grid_.dx[begin + i] = static_cast<float>(jet.gradient.x);
        grid_.dy[begin + i] = static_cast<float>(jet.gradient.y);
      }
    }
  }

  const Kind& kind_;
  const ContourModel& model_;
  FieldGrid& grid_;
  Numbers all_;
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

/// Negative outside: along a row the sign changes where it crosses a chord.
void set_signs(const ContourModel& model, FieldGrid& grid, unsigned threads) {
  const GridFrame& frame = grid.frame;
  std::vector<Numbers> rows(frame.rows);
  const auto& chords = model.chords();
  for (std::size_t c = 0; c < chords.size(); ++c) {
    const double low = std::min(chords[c].a.y, chords[c].b.y), high = std::max(chords[c].a.y, chords[c].b.y);
    const double last = static_cast<double>(frame.rows) - 1;
    const double begin = std::clamp(std::floor((low - frame.origin.y) / frame.pitch), 0.0, last);
    const double end = std::clamp(std::ceil((high - frame.origin.y) / frame.pitch), 0.0, last);
    for (auto j = static_cast<std::size_t>(begin); j <= static_cast<std::size_t>(end); ++j)
      rows[j].push_back(static_cast<std::uint32_t>(c));
  }
  share_out(frame.rows, threads, [&](std::size_t j) {
    const double y = frame.node(0, j).y;
    std::vector<double> crossings;
    for (const std::uint32_t c : rows[j]) {
      const geom::Point a = chords[c].a, b = chords[c].b;
      if ((a.y <= y) != (b.y <= y)) crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t passed = 0;
    for (std::size_t i = 0; i < frame.columns; ++i) {
      const double x = frame.node(i, j).x;
      while (passed < crossings.size() && crossings[passed] <= x) ++passed;
      if (passed % 2 == 1) continue;
      const std::size_t n = j * frame.columns + i;
      grid.value[n] = -grid.value[n], grid.dx[n] = -grid.dx[n], grid.dy[n] = -grid.dy[n];
    }
  });
}

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
  return {frame, std::vector<float>(frame.size()), std::vector<float>(frame.size()),
          std::vector<float>(frame.size())};
}

}  // namespace

FieldGrid sample(const ContourModel& model, const GridFrame& frame, unsigned threads) {
  FieldGrid grid = empty_grid(frame);
  if (model.options().logic == Logic::linear) {
    sample_tiles(LinearFloz{model}, model, grid, threads);
  } else {
    share_out(frame.rows, threads, [&](std::size_t j) {
      for (std::size_t i = 0; i < frame.columns; ++i) {
        const Jet jet = model.unsigned_at(frame.node(i, j));
        const std::size_t n = j * frame.columns + i;
        grid.value[n] = static_cast<float>(jet.value);
        grid.dx[n] = static_cast<float>(jet.gradient.x), grid.dy[n] = static_cast<float>(jet.gradient.y);
      }
    });
  }
  set_signs(model, grid, threads);
  return grid;
}

FieldGrid sample_distance(const ContourModel& model, const GridFrame& frame, unsigned threads) {
  FieldGrid grid = empty_grid(frame);
  sample_tiles(Distance{}, model, grid, threads);
  set_signs(model, grid, threads);
  return grid;
}

}  // namespace lekalo::field

#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/grid_region.hpp"

namespace lekalo::cases {

/// Outlines between the points of a small lattice, so that two of them touch, cross in vertices and share
/// edges all the time, and maps of the lattice into the grid that keep all of that.

using LatticeLoops = std::vector<std::vector<geom::GridPoint>>;

/// (x, y) -> (p x - q y, q x + p y) + at: turned and scaled by a whole number where (p, q) is of a
/// Pythagorean triple.
struct LatticeMap {
  std::int64_t p = 64, q = 0;
  geom::GridPoint at;
  std::int64_t scale = 64;  ///< sqrt(p^2 + q^2), exact
  [[nodiscard]] geom::GridPoint operator()(geom::GridPoint v) const {
    return geom::GridPoint{p * v.x - q * v.y, q * v.x + p * v.y} + at;
  }
  [[nodiscard]] geom::GridPoint vector(geom::GridPoint v) const { return (*this)(v)-at; }
};

/// Lattice coordinates up to 8 stay within 2^38 steps; scales from 25 to some 2^34.
inline LatticeMap lattice_map(Random& random) {
  LatticeMap map;
  const std::int64_t most = std::int64_t{1} << (2 + random.below(13));
  const auto m = static_cast<std::int64_t>(2 + random.below(static_cast<std::uint64_t>(most)));
  const auto n =
      random.below(3) == 0 ? 0 : static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(m)));
  map.p = 32 * (m * m - n * n), map.q = 32 * (2 * m * n), map.scale = 32 * (m * m + n * n);
  if (random.below(2) == 0) std::swap(map.p, map.q);
  if (random.below(2) == 0) map.q = -map.q;
  const auto reach = static_cast<std::uint64_t>(std::int64_t{1} << random.below(37));
  map.at = {static_cast<std::int64_t>(random.below(reach)) - static_cast<std::int64_t>(reach / 2),
            static_cast<std::int64_t>(random.below(reach)) - static_cast<std::int64_t>(reach / 2)};
  return map;
}

/// Nothing when the loops are no outline there.
inline std::optional<geom::GridRegion> mapped(const LatticeLoops& loops, const LatticeMap& map) {
  LatticeLoops there = loops;
  for (auto& loop : there)
    for (geom::GridPoint& p : loop) p = map(p);
  auto region = geom::make_grid_region(std::move(there));
  if (!region) return std::nullopt;
  return *std::move(region);
}

/// All loops are an outline as they are, with no point twice.
inline bool is_lattice_outline(const LatticeLoops& loops) {
  std::size_t points = 0;
  for (const auto& loop : loops) points += loop.size();
  const auto region = mapped(loops, {});
  return region && region->points.size() == points;
}

/// 3 to 8 points within [0, side]^2 in random order, sometimes with a hole, as often as it takes to be
/// simple.
inline LatticeLoops lattice_polygon(Random& random, std::uint64_t side = 8) {
  const auto coordinate = [&] { return static_cast<std::int64_t>(random.below(side + 1)); };
  const auto point = [&] {
    const std::int64_t x = coordinate();
    return geom::GridPoint{x, coordinate()};
  };
  for (;;) {
    LatticeLoops loops(1);
    const std::size_t n = 3 + random.below(6);
    for (std::size_t i = 0; i < n; ++i) loops[0].push_back(point());
    if (!is_lattice_outline(loops)) continue;
    for (int tries = 0; tries < 6; ++tries) {
      LatticeLoops with_hole = loops;
      with_hole.push_back({point(), point(), point()});
      if (random.below(2) == 0) with_hole.back().push_back(point());
      if (is_lattice_outline(with_hole)) loops = std::move(with_hole);
    }
    return loops;
  }
}

/// A set of cells of a 6 x 6 board, connected by edges, with its outline: whose disc is where is known.
struct Cells {
  static constexpr int kSide = 6;
  std::array<bool, kSide * kSide> in{};
  LatticeLoops loops;
};

/// The loops around the cells: counter-clockwise outside; nothing where they touch themselves in a point.
inline std::optional<LatticeLoops> loops_around(const Cells& cells) {
  const auto has = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < Cells::kSide && y < Cells::kSide &&
           cells.in[static_cast<std::size_t>(y * Cells::kSide + x)];
  };
  std::map<std::pair<std::int64_t, std::int64_t>, geom::GridPoint> next;
  bool twice = false;
  const auto add = [&](int x, int y, int dx, int dy) {
    twice = !next.emplace(std::pair{x, y}, geom::GridPoint{x + dx, y + dy}).second || twice;
  };
  for (int y = 0; y < Cells::kSide; ++y) {
    for (int x = 0; x < Cells::kSide; ++x) {
      if (!has(x, y)) continue;
      if (!has(x, y - 1)) add(x, y, 1, 0);
      if (!has(x + 1, y)) add(x + 1, y, 0, 1);
      if (!has(x, y + 1)) add(x + 1, y + 1, -1, 0);
      if (!has(x - 1, y)) add(x, y + 1, 0, -1);
    }
  }
  if (twice) return std::nullopt;
  LatticeLoops loops;
  while (!next.empty()) {  // the least point is on the outer loop, which comes first
    auto& loop = loops.emplace_back();
    for (auto at = next.begin(); at != next.end();) {
      loop.push_back({at->first.first, at->first.second});
      const geom::GridPoint to = at->second;
      next.erase(at);
      at = next.find({to.x, to.y});
    }
  }
  return loops;
}

inline Cells random_cells(Random& random) {
  for (;;) {
    Cells cells;
    std::size_t x = random.below(Cells::kSide), y = random.below(Cells::kSide);
    const std::size_t steps = 2 + random.below(60);
    for (std::size_t i = 0; i < steps; ++i) {  // a walk is connected
      cells.in[y * Cells::kSide + x] = true;
      switch (random.below(4)) {
        case 0:
          x = std::min<std::size_t>(x + 1, Cells::kSide - 1);
          break;
        case 1:
          x = x > 0 ? x - 1 : 0;
          break;
        case 2:
          y = std::min<std::size_t>(y + 1, Cells::kSide - 1);
          break;
        default:
          y = y > 0 ? y - 1 : 0;
      }
    }
    if (auto loops = loops_around(cells); loops && is_lattice_outline(*loops)) {
      cells.loops = *std::move(loops);
      return cells;
    }
  }
}

}  // namespace lekalo::cases

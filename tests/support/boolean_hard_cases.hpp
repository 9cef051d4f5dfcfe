#pragma once

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "support/offset_check.hpp"
#include "support/region_cases.hpp"

namespace lekalo::cases {

/// Pairs of operands that Booleans get wrong: edges that nearly coincide, at angles and distances from 1e-3
/// to 1e-14.
enum class HardKind {
  coincident,   ///< a square and the same turned and moved by next to nothing
  same_circle,  ///< a circle and the same a little off
  tangent,      ///< rounded rectangles that share sides and touch in their arcs
  fan,          ///< up to 30 triangles with one corner in common, some at nearly one angle
  slivers,      ///< thin rectangles across each other
  lenses,       ///< of flat arcs over one chord
  shaken,       ///< random operands and the same moved by next to nothing
  placed,       ///< a part in its blank, or a blank on itself
  pies,         ///< pieces of one circle, cut in different places
  blob          ///< a notch of microns on an edge that coincides for a metre
};
inline constexpr std::array kHardKinds{
    HardKind::coincident, HardKind::same_circle, HardKind::tangent, HardKind::fan,  HardKind::slivers,
    HardKind::lenses,     HardKind::shaken,      HardKind::placed,  HardKind::pies, HardKind::blob};

struct HardPair {
  std::vector<geom::Region> a, b;
};

namespace hard_detail {

inline void add(std::vector<geom::Region>& to, geom::Contour contour) {
  if (auto made = geom::make_region(std::move(contour))) to.push_back(std::move(*made));
}
/// As map_regions, without what becomes too thin to be a region.
inline std::vector<geom::Region> moved(const std::vector<geom::Region>& regions,
                                       const geom::BlankFromPart& pose) {
  std::vector<geom::Region> made;
  for (const geom::Region& r : regions) {
    std::vector<geom::Contour> holes;
    for (const geom::Contour& h : r.holes) holes.push_back(map_contour(h, pose));
    if (auto region = geom::make_region(map_contour(r.outer, pose), std::move(holes)))
      made.push_back(std::move(*region));
  }
  return made;
}
/// The arc from one point to another that rises `height` above the chord, on its right.
inline geom::Edge rise(geom::Point from, geom::Point to, double height) {
  const geom::Point middle = 0.5 * (from + to), chord = to - from;
  const double half = 0.5 * norm(chord), r = (half * half + height * height) / (2 * height);
  return {geom::EdgeKind::arc_ccw, from, to, middle + ((r - height) / norm(chord)) * perpendicular(chord)};
}

}  // namespace hard_detail

inline HardPair hard_pair(Random& random, HardKind kind) {
  using namespace hard_detail;
  using geom::BlankFromPart;
  using geom::EdgeKind;
  using geom::Point;
  const auto small = [&] { return std::pow(10.0, -random.uniform(3, 14)); };
  const auto either = [&] { return random.below(2) == 0 ? 1.0 : -1.0; };
  const auto whole = [&](int n) { return static_cast<int>(random.below(static_cast<std::uint64_t>(n))); };
  const auto nudge = [&] {
    return BlankFromPart::from_angle(either() * small(), {either() * small(), either() * small()});
  };
  HardPair pair;
  switch (kind) {
    case HardKind::coincident:
      add(pair.a, boolean_rectangle(0, 0, 10, 10));
      pair.b = map_regions(pair.a, nudge());
      break;
    case HardKind::same_circle:
      add(pair.a, boolean_circle({0, 0}, 5, whole(4)));
      add(pair.b, boolean_circle({either() * small(), either() * small()}, 5 + either() * small(), whole(4)));
      break;
    case HardKind::tangent:
      add(pair.a, boolean_rounded(0, 0, 10, 6, 2));
      add(pair.b, boolean_rounded(either() * small(), 10 * whole(2) + either() * small(), 10, 6,
                                  2 + either() * small() * whole(2)));
      break;
    case HardKind::fan: {
      const Point corner{random.uniform(-1, 1), random.uniform(-1, 1)};
      for (int i = 0, n = 2 + whole(30); i < n; ++i) {
        const double t = whole(4) == 0 ? 0.3 + small() : random.uniform(0, 6.28);
        const double first = random.uniform(1, 9), turn = random.uniform(0.01, 1),
                     second = random.uniform(1, 9);
        add(whole(2) == 0 ? pair.a : pair.b, boolean_polygon({corner, corner + first * direction_of(t),
                                                              corner + second * direction_of(t + turn)}));
      }
      break;
    }
    case HardKind::slivers:
      for (int i = 0, n = 2 * (1 + whole(4)); i < n; ++i) {
        const Point p{random.uniform(-5, 5), random.uniform(-5, 5)},
            d{random.uniform(-9, 9), random.uniform(-9, 9)};
        const Point across = (small() / norm(d)) * perpendicular(d);
        add(i % 2 == 0 ? pair.a : pair.b, boolean_polygon({p, p + d, p + d + across, p + across}));
      }
      break;
    case HardKind::lenses: {
      const Point p{0, 0}, q{10, 0};
      const double height = std::pow(10.0, -random.uniform(2, 6));
      const auto lens = [&](double up, double down) {
        return geom::Contour{rise(p, q, up), rise(q, p, down)};
      };
      add(pair.a, lens(height + random.uniform(0, 1) * whole(2), 0.5 + small()));
      add(pair.b, lens(height + small(), 0.5 + small() * whole(2)));
      break;
    }
    case HardKind::shaken:
      pair.a = boolean_operand(random, BooleanKind::grid);
      pair.b = map_regions(whole(2) == 0 ? pair.a : boolean_operand(random, BooleanKind::grid), nudge());
      break;
    case HardKind::placed: {
      const RegionKind shape = kRegionKinds[random.below(kRegionKinds.size())];
      const RegionCase one = region_case(random.below(1000), random.below(1000), shape, 24);
      pair.a = one.blank;
      pair.b = map_regions(one.part, one.pose());
      if (whole(2) == 0) pair.b = map_regions(pair.a, nudge());
      break;
    }
    case HardKind::pies: {
      const auto at = [](double t) { return 5 * direction_of(t); };
      const auto pie = [&](double from, double to) {
        return geom::Contour{{EdgeKind::arc_ccw, at(from), at(to), {0, 0}},
                             {EdgeKind::line, at(to), at(from), {}}};
      };
      add(pair.a, boolean_circle({0, 0}, 5));
      const double sweep = random.uniform(0, 6.28), start = random.uniform(0, 6.28);
      add(pair.b, pie(start, sweep));
      if (whole(2) == 0) add(pair.b, pie(0, 10 * small()));
      break;
    }
    case HardKind::blob: {
      const double gap = small(), size = small();
      add(pair.a, boolean_rectangle(0, 0, 1000, 10));
      const double tip = whole(2) == 0 ? size : -size;
      add(pair.b, boolean_polygon({{-1, gap},
                                   {400, gap},
                                   {400, tip},
                                   {400 + size, tip},
                                   {400 + size, gap},
                                   {1001, gap},
                                   {1001, 12},
                                   {-1, 12}}));
    }
  }
  if (whole(2) == 0) {
    const auto pose = BlankFromPart::from_angle(random.uniform(0, 6.28), {random.uniform(-20, 20), 3},
                                                random.below(2) == 0);
    pair.a = hard_detail::moved(pair.a, pose), pair.b = hard_detail::moved(pair.b, pose);
  }
  return pair;
}

/// What is wrong with `result`, by membership of points as close to the edges as edge_error lets them be
/// told; empty if nothing is found.
inline std::string boolean_fault(const HardPair& pair, geom::BooleanOperation operation,
                                 const geom::BooleanResult& result, Random& random, int points) {
  using Op = geom::BooleanOperation;
  for (const geom::Region& r : result.regions) {
    const auto again = geom::make_region(r.outer, r.holes);
    if (!again || !(*again == r)) return "a region of the result is not in order";
  }
  const Membership a(pair.a), b(pair.b);
  const geom::RegionIndex got(result.regions);
  std::vector<geom::Edge> drawn = edges_of(pair.a);
  const std::vector<geom::Edge> other = edges_of(pair.b), made = edges_of(result.regions);
  drawn.insert(drawn.end(), other.begin(), other.end());
  if (drawn.empty()) return made.empty() ? "" : "something came of nothing";
  const double error =
      result.edge_error + 4 * geom::kEdgeDistanceError * std::max(extent_of(pair.a), extent_of(pair.b));
  for (int k = 0; k < points; ++k) {
    const bool near_made = !made.empty() && random.below(2) == 0;
    const geom::Edge& e = near_made ? made[random.below(made.size())] : drawn[random.below(drawn.size())];
    const double off = error * std::pow(10.0, random.uniform(0, 1) * random.uniform(0, 1) * 11);
    const geom::Point on = point_on(e, random.below(2) == 0 ? 0.0 : random.uniform(0, 1));
    const geom::Point p = on + off * direction_of(random.uniform(0, 6.283185307179586));
    const double d = std::min(a.distance(p), b.distance(p));
    if (!(d > error)) continue;
    const bool x = a.contains(p), y = b.contains(p);
    const bool wanted = operation == Op::unite       ? x || y
                        : operation == Op::intersect ? x && y
                        : operation == Op::subtract  ? x && !y
                                                     : x != y;
    if (got.contains(p) != wanted)
      return fmt::format("({}, {}), {} from all edges, is {} of the result; error {}", p.x, p.y, d,
                         wanted ? "not" : "wrongly", error);
  }
  return "";
}

}  // namespace lekalo::cases

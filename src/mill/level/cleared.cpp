#include "cleared.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/offset.hpp"

namespace lekalo::mill {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

constexpr double kSameLevel = 1e-6;  // mm of depth
constexpr double kGrain = 1e-6;      // mm: stretches that agree to it are one
constexpr double kClosed = 4e-3;  // mm: holes in what is cut that are narrower than twice this are rounding
constexpr double kLeastDepth = 6e-3;  // mm: a piece that is nowhere thicker is left alone
constexpr std::size_t kTogether = 24;

Result<Region> disc(Point middle, double radius) {
  const Point from = middle + Point{radius, 0};
  return geom::make_region({{EdgeKind::arc_ccw, from, from, middle}});
}

/// The region that a disc sweeps along an edge, without the discs at its ends. \pre an arc of at most half a
/// turn
Result<Region> body(const Edge& edge, double radius) {
  if (edge.kind == EdgeKind::line) {
    const Point way = edge.to - edge.from;
    const Point side = (radius / norm(way)) * perpendicular(way);
    return geom::make_region({{EdgeKind::line, edge.from - side, edge.to - side, {}},
                              {EdgeKind::line, edge.to - side, edge.to + side, {}},
                              {EdgeKind::line, edge.to + side, edge.from + side, {}},
                              {EdgeKind::line, edge.from + side, edge.from - side, {}}});
  }
  const double r = arc_radius(edge);
  const EdgeKind other = edge.kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
  const auto at = [&](Point p, double distance) {
    return edge.centre + (distance / norm(p - edge.centre)) * (p - edge.centre);
  };
  const Point a = at(edge.from, r + radius), b = at(edge.to, r + radius);
  if (!(r - radius > kClosed))
    return geom::make_region({{edge.kind, a, b, edge.centre},
                              {EdgeKind::line, b, edge.centre, {}},
                              {EdgeKind::line, edge.centre, a, {}}});
  const Point c = at(edge.to, r - radius), d = at(edge.from, r - radius);
  return geom::make_region({{edge.kind, a, b, edge.centre},
                            {EdgeKind::line, b, c, {}},
                            {other, c, d, edge.centre},
                            {EdgeKind::line, d, a, {}}});
}

/// Unites a few pieces at a time, so that what lies inside is gone before the next pieces come.
Result<std::vector<Region>> union_of(const std::vector<Region>& pieces) {
  std::vector<std::vector<Region>> groups;
  for (std::size_t i = 0; i < pieces.size(); i += kTogether) {
    const auto first = pieces.begin() + static_cast<std::ptrdiff_t>(i);
    LEKALO_TRY(
        auto group,
        geom::united({first, first + static_cast<std::ptrdiff_t>(std::min(kTogether, pieces.size() - i))}));
    groups.push_back(std::move(group.regions));
  }
  while (groups.size() > 1) {
    std::vector<std::vector<Region>> larger;
    for (std::size_t i = 0; i < groups.size(); i += 2) {
      ask();
      if (i + 1 == groups.size()) {
        larger.push_back(std::move(groups[i]));
        break;
      }
      LEKALO_TRY(auto both, geom::combine(groups[i], groups[i + 1], geom::BooleanOperation::unite));
      larger.push_back(std::move(both.regions));
    }
    groups = std::move(larger);
  }
  return groups.empty() ? std::vector<Region>{} : std::move(groups.front());
}

}  // namespace

Result<std::vector<Region>> cleared_places(const std::vector<EarlierCut>& cuts, double depth,
                                           double tool_radius) {
  // Levels one below the other go the same ways, so that each stretch is taken once.
  using Key = std::array<long long, 8>;
  std::set<Key> seen;
  std::vector<Region> pieces;
  const auto fresh = [&](const Edge& edge, double diameter) {
    const auto grain = [](double v) { return std::llround(v / kGrain); };
    const bool arc = edge.kind != EdgeKind::line;
    return seen
        .insert({static_cast<long long>(edge.kind), grain(edge.from.x), grain(edge.from.y), grain(edge.to.x),
                 grain(edge.to.y), arc ? grain(edge.centre.x) : 0, arc ? grain(edge.centre.y) : 0,
                 grain(diameter)})
        .second;
  };
  const auto add = [&](Result<Region> piece) -> Result<void> {
    LEKALO_CHECK(piece);
    pieces.push_back(*std::move(piece));
    return {};
  };
  for (const EarlierCut& cut : cuts) {
    if (!(cut.depth >= depth - kSameLevel)) continue;
    const double radius = cut.tool_diameter / 2;
    if (norm(cut.edge.to - cut.edge.from) > kGrain && fresh(cut.edge, cut.tool_diameter))
      LEKALO_CHECK(add(body(cut.edge, radius)));
    for (const Point end : {cut.edge.from, cut.edge.to})
      if (fresh({EdgeKind::line, end, end, {}}, cut.tool_diameter)) LEKALO_CHECK(add(disc(end, radius)));
  }
  LEKALO_TRY(auto swept, union_of(pieces));
  LEKALO_TRY(auto closed, geom::offset(swept, kClosed));
  LEKALO_TRY(auto places, geom::offset(closed.regions, -(kClosed + tool_radius - kThin)));
  return std::move(places.regions);
}

Result<Divided> divided(const Region& allowed, const std::vector<Region>& cleared) {
  if (cleared.empty()) return Divided{{}, {allowed}};
  LEKALO_TRY(auto left, geom::combine({allowed}, cleared, geom::BooleanOperation::subtract));
  std::vector<Region> thick;
  for (const Region& piece : left.regions) {
    LEKALO_TRY(const auto inside, geom::offset({piece}, -kLeastDepth / 2));
    if (!inside.regions.empty()) thick.push_back(piece);
  }
  left.regions = std::move(thick);
  if (left.regions.empty()) return Divided{{allowed}, {}};
  LEKALO_TRY(auto rest, geom::combine({allowed}, left.regions, geom::BooleanOperation::subtract));
  return Divided{std::move(rest.regions), std::move(left.regions)};
}

}  // namespace lekalo::mill

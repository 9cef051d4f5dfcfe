#include "corners.hpp"

#include <algorithm>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "lekalo/mill/straight_pass.hpp"
#include "mill/front/load.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill {

using geom::Edge;
using geom::Point;
using geom::Region;

namespace {

// A peel may take this share of the tool's radius: the last, which comes to the corner itself, and others.
constexpr double kSharpPeel = 0.12, kPeel = 0.22;
constexpr double kHotSpacing = 0.02, kHotMoment = 0.04;  // of the tool's radius

bool lies_on(Point p, const Front& zone) {
  return std::any_of(zone.edges.begin(), zone.edges.end(), [&](const Edge& edge) {
    return norm(geom::nearest_on(geom::make_curve(edge), p) - p) < 1e-3;
  });
}

}  // namespace

Corners::Corners(const Piece& piece, const std::vector<Point>& loop_places,
                 const std::vector<Region>& cleared, const PocketOptions& o)
    : piece_(piece),
      thinness_(std::min(1.0, o.step_over / 0.4)),
      held_degrees_(most_held_degrees(o.step_over)),
      either_way_(o.direction == Direction::any),
      peels_(piece.allowed.regions, loop_places, cleared, piece.tool_radius, thinness_) {}

Result<Corners> Corners::find(const Piece& piece, const std::vector<Point>& loop_places,
                              const std::vector<Region>& cleared, const PocketOptions& o) {
  Corners made(piece, loop_places, cleared, o);
  LEKALO_TRY(const auto roundest, made.peels_.first());
  LEKALO_TRY(const auto zones, made.peels_.between(roundest, made.peels_.last()));
  made.roundest_ = roundest;
  LEKALO_TRY(made.walls_, made.peels_.at(roundest));
  made.zones_ = zones;
  return made;
}

Result<void> Corners::cut(std::size_t zone, ToolMotion& tool) {
  bool back = true;
  return cut_beyond(roundest_, zones()[zone], back, tool);
}

/// True when a pass meets too much of the rim for more than a moment.
bool Corners::is_hot(const std::vector<Front>& passes, const geom::RegionIndex& before) const {
  const double radius = piece_.tool_radius;
  return std::any_of(passes.begin(), passes.end(), [&](const Front& pass) {
    return load_of(pass.edges, false, before, radius, held_degrees_, kHotSpacing * radius).beyond >
           kHotMoment * radius;
  });
}

/// Finds the deepest peel that a zone allows: the last round at once, or else by halving between rounds that
/// are allowed and rounds that are not.
Result<Corners::Peel> Corners::deepest_peel(std::size_t outer, const Front& zone) {
  const std::size_t last = peels_.last();
  LEKALO_TRY(const auto round, peels_.at(outer));
  const geom::RegionIndex& before = round->index;
  Peel chosen{outer, {}};
  std::size_t beyond = last + 1;
  for (std::size_t tried = last; chosen.inner + 1 < beyond; tried = (chosen.inner + beyond) / 2) {
    LEKALO_TRY(const auto fronts, peels_.between(outer, tried));
    std::vector<Front> passes;
    double depth = 0;
    for (const Front& front : *fronts) {
      ask();
      if (!lies_on(front.edges.front().from, zone) || !lies_on(front.edges.back().to, zone)) continue;
      passes.push_back(front);
      for (const Point p : places_on(front.edges, 0.1 * piece_.tool_radius))
        depth = std::max(depth, before.nearest(p).distance);
    }
    // The end of a corridor has two corners, which are met at once.
    const double most = thinness_ * (tried == last ? kSharpPeel : kPeel) *
                        (piece_.narrow.index.contains(zone.edges.front().from) ? 0.5 : 1);
    if (tried == outer + 1 || (depth < most * piece_.tool_radius && !is_hot(passes, before)))
      chosen = {tried, std::move(passes)};
    else
      beyond = tried;
  }
  return chosen;
}

/// Cuts what a zone holds beyond a round. \param back  whether the next pass begins at the zone's end
Result<void> Corners::cut_beyond(std::size_t outer, const Front& zone, bool& back, ToolMotion& tool) {
  if (outer == peels_.last()) return {};
  LEKALO_TRY(auto peel, deepest_peel(outer, zone));
  if (peel.passes.empty()) return cut_beyond(peel.inner, zone, back, tool);
  if (back) std::reverse(peel.passes.begin(), peel.passes.end());
  // A way to a pass goes along the outer round, because the corner beyond it still stands.
  LEKALO_TRY(const auto round, peels_.at(outer));
  std::optional<Point> left;  // the outer round, by the pass before
  for (const Front& pass : peel.passes) {
    const std::vector<Edge> edges = back && either_way_ ? geom::reversed(pass.edges) : pass.edges;
    if (left) tool.link(*left);
    tool.link_along(round->index, edges.front().from);
    tool.go(ToolMotion::Kind::cut, edges);
    left = tool.at();
    bool next = !back;
    LEKALO_CHECK(cut_beyond(peel.inner, pass, next, tool));
  }
  back = !back;
  return {};
}

}  // namespace lekalo::mill

#include "level_path.hpp"

#include <algorithm>
#include <limits>

#include "corners.hpp"
#include "entry.hpp"
#include "front_passes.hpp"
#include "lekalo/base/stop.hpp"
#include "mill/front/fields.hpp"
#include "mill/path/edge_path.hpp"
#include "mill/path/mirror.hpp"
#include "tool_motion.hpp"
#include "walls.hpp"

namespace lekalo::mill {
// This file has the order of the steps 1 to 8 of docs/design/pocket.md; each step has a file of its own.
namespace {

using geom::Point;
using geom::Region;
using geom::RegionIndex;

/// Lifts the tool at the end of a level. The path is empty where there was nothing to cut.
PocketPath finished(ToolMotion& tool, const FrontPasses& passes) {
  if (tool.moves().empty()) return {};
  tool.rise();
  return {tool.moves(), passes.count()};
}

/// Clears from the solid: an entry and its fronts, again for what cannot be reached from there, then the
/// walls.
Result<PocketPath> cleared_from_entries(const Piece& piece, const PocketOptions& o,
                                        const AreaListener& listener) {
  ToolMotion tool(piece, o);
  FrontPasses passes(piece, tool, o, listener);
  std::vector<Region> left = piece.fields.regions.empty() ? piece.allowed.regions : piece.fields.regions;
  while (!left.empty()) {
    ask();
    const Entry entry = widest_disc(left, piece.tool_radius);
    LEKALO_TRY(const auto start, start_region(entry, piece));
    LEKALO_CHECK(passes.grow_from(start));
    enter(tool, entry, passes.first_direction(entry.centre, entry.disc), o);
    passes.cut_all();
    const RegionIndex cut(passes.reached());
    const std::size_t before = left.size();
    std::erase_if(left, [&](const Region& place) {
      const Point edge = place.outer.front().from;
      return cut.contains(edge) || cut.nearest(edge).distance < 1e-2 ||
             cut.contains(entry.centre) == RegionIndex({place}).contains(entry.centre);
    });
    if (left.size() == before) break;
  }
  LEKALO_TRY(auto corners, Corners::find(piece, passes.loop_places(), {}, o));
  LEKALO_CHECK(cut_walls(tool, corners, piece, passes.ends()));
  cut_missed_walls(tool, piece, {});
  return finished(tool, passes);
}

/// A place that other tools have left, and the numbers of the fronts, walls and corners that are cut there.
struct LeftPlace {
  RegionIndex index;
  std::vector<std::size_t> fronts, walls, corners;
  [[nodiscard]] bool is_empty() const { return fronts.empty() && walls.empty() && corners.empty(); }
};

/// The place that a front lies in or is nearest to.
LeftPlace& place_of(const Front& front, std::vector<LeftPlace>& places) {
  const Point p = place_at(front.edges[front.edges.size() / 2], 0.5);
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double d = places[i].index.contains(p) ? 0 : places[i].index.nearest(p).distance;
    if (d < least) least = d, best = i;
  }
  return places[best];
}

/// Cuts corners, the nearest first.
Result<void> cut_corners(ToolMotion& tool, Corners& corners, std::vector<std::size_t> which) {
  const auto far = [&](std::size_t i) { return norm(corners.zones()[i].edges.back().to - tool.at()); };
  while (!which.empty()) {
    ask(1 + which.size());
    const auto next = std::min_element(which.begin(), which.end(),
                                       [&](std::size_t a, std::size_t b) { return far(a) < far(b); });
    LEKALO_CHECK(corners.cut(*next, tool));
    which.erase(next);
  }
  return {};
}

/// Clears what other tools have left, place by place: fronts that grow from where they have been, then the
/// walls that those did not come to, then corners.
Result<PocketPath> cleared_after_others(const Piece& piece, const PocketOptions& o,
                                        const std::vector<Region>& cleared, const std::vector<Region>& left,
                                        const AreaListener& listener) {
  ToolMotion tool(piece, o);
  FrontPasses passes(piece, tool, o, listener);
  LEKALO_CHECK(passes.grow_from(cleared));
  LEKALO_TRY(auto corners, Corners::find(piece, passes.loop_places(), cleared, o));
  const std::vector<Front> walls = fresh_stretches(corners.walls().regions, RegionIndex(passes.reached()));
  const std::vector<Front>&fronts = passes.fronts(), &zones = corners.zones();
  std::vector<LeftPlace> places;
  for (const Region& region : left) places.push_back({RegionIndex({region}), {}, {}, {}});
  for (std::size_t i = 0; i < fronts.size(); ++i) place_of(fronts[i], places).fronts.push_back(i);
  for (std::size_t i = 0; i < walls.size(); ++i) place_of(walls[i], places).walls.push_back(i);
  for (std::size_t i = 0; i < zones.size(); ++i) place_of(zones[i], places).corners.push_back(i);
  std::erase_if(places, [](const LeftPlace& place) { return place.is_empty(); });
  const RegionIndex start(cleared);
  while (!places.empty()) {
    ask(1 + places.size());
    auto place = places.begin();
    if (tool.moves().empty()) {
      const Front& first = !place->fronts.empty()  ? fronts[place->fronts.front()]
                           : !place->walls.empty() ? walls[place->walls.front()]
                                                   : zones[place->corners.front()];
      tool.come_down(roomy_place(first.edges.front().from, start, piece.tool_radius));
    } else {
      place = std::min_element(places.begin(), places.end(), [&](const LeftPlace& a, const LeftPlace& b) {
        return a.index.nearest(tool.at()).distance < b.index.nearest(tool.at()).distance;
      });
    }
    passes.cut_all(place->fronts);
    cut_stretches(tool, walls, place->walls, corners.walls().index);
    LEKALO_CHECK(cut_corners(tool, corners, place->corners));
    places.erase(place);
  }
  // Walls that no pass came along are cut last.
  cut_missed_walls(tool, piece, cleared);
  return finished(tool, passes);
}

Result<PocketPath> climb_or_any(const Region& allowed, const PocketOptions& o,
                                const std::vector<Region>& cleared, const std::vector<Region>& left,
                                const AreaListener& listener) {
  LEKALO_TRY(const auto piece, find_fields(allowed, o.tool_diameter / 2, cleared));
  return cleared.empty() ? cleared_from_entries(piece, o, listener)
                         : cleared_after_others(piece, o, cleared, left, listener);
}

}  // namespace

Result<PocketPath> level_path(const Region& allowed, const PocketOptions& options,
                              const std::vector<Region>& cleared, const std::vector<Region>& left,
                              const AreaListener& listener) {
  if (options.direction != Direction::conventional)
    return climb_or_any(allowed, options, cleared, left, listener);
  PocketOptions turned = options;
  turned.direction = Direction::climb;
  const auto other = mirrored({allowed}), start = mirrored(cleared), rest = mirrored(left);
  for (const auto* made : {&other, &start, &rest}) LEKALO_CHECK(*made);
  LEKALO_TRY(auto path, climb_or_any(other->front(), turned, *start, *rest, listener));
  return mirrored(std::move(path));
}

}  // namespace lekalo::mill

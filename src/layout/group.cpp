#include "group.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/assert.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::layout {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Point;

constexpr std::uint32_t kAllLayers = kPartLayer | kBorderLayer | kDefectLayer | kZoneLayer;

std::vector<std::uint64_t> ids_of(const std::vector<Placement>& placements) {
  std::vector<std::uint64_t> ids;
  for (const Placement& placement : placements) ids.push_back(placement.id);
  return ids;
}

GridBox joined(const GridBox& a, const GridBox& b) noexcept {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}

/// Calls visit(from, to) for every edge.
template <class Visit>
void for_each_edge(const GridRegion& region, Visit&& visit) {
  for (std::size_t l = 0; l < region.loops(); ++l) {
    const std::uint32_t begin = region.loop_starts[l], end = region.loop_starts[l + 1];
    for (std::uint32_t i = begin; i < end; ++i)
      visit(region.points[i], region.points[i + 1 == end ? begin : i + 1]);
  }
}

/// Appends the directions of the contacts between points of one outline and edges of another, within `reach`
/// steps.
void append_contacts(const GridRegion& points, GridPoint points_at, const GridRegion& edges,
                     GridPoint edges_at, double reach, std::vector<Point>& directions) {
  const GridBox box = bounds(points);
  const GridPoint to_points = points_at - edges_at;  // in the frame of the edges
  const Point low = in_doubles(box.low + to_points), high = in_doubles(box.high + to_points);
  for_each_edge(edges, [&](GridPoint a, GridPoint b) {
    const Point from = in_doubles(a), to = in_doubles(b), edge = to - from;
    if (std::min(from.x, to.x) - reach > high.x || std::max(from.x, to.x) + reach < low.x ||
        std::min(from.y, to.y) - reach > high.y || std::max(from.y, to.y) + reach < low.y)
      return;
    const double size = norm(edge);
    for (const GridPoint p : points.points) {
      const Point out = in_doubles(p + to_points) - from;
      const double along = dot(out, edge) / size, height = cross(edge, out) / size;
      if (std::abs(height) <= reach && along >= -reach && along <= size + reach)
        directions.push_back((1 / size) * edge);
      // The direction around a corner counts too, because a corner keeps two vertices apart where there is a
      // gap.
      const double distance = norm(out);
      if (distance > 4 && distance <= reach) directions.push_back((1 / distance) * perpendicular(out));
    }
  });
}

}  // namespace

Point in_doubles(GridPoint p) noexcept { return {static_cast<double>(p.x), static_cast<double>(p.y)}; }

GridPoint nearest_step(Point p) noexcept {
  return {static_cast<std::int64_t>(std::nearbyint(p.x)), static_cast<std::int64_t>(std::nearbyint(p.y))};
}

Point unit_vector(GridPoint direction) noexcept {
  const Point d = in_doubles(direction);
  return (1 / norm(d)) * d;
}

Group::Group(const Workspace& workspace, std::vector<Placement> placements)
    : workspace_(workspace),
      placements_(std::move(placements)),
      ids_(ids_of(placements_)),
      lifted_(workspace, ids_),
      allowed_(std::all_of(placements_.begin(), placements_.end(),
                           [&](const Placement& placement) { return workspace.may_be_so(placement); })) {
  LEKALO_ASSERT(!placements_.empty());
}

bool Group::is_clear(GridPoint shift) const {
  return allowed_ && std::all_of(placements_.begin(), placements_.end(), [&](Placement placement) {
           placement.at = placement.at + shift;
           return workspace_.has_room(placement);
         });
}

GridBox Group::box() const {
  const phi::Scene& scene = workspace_.scene(sheet());
  const auto one = [&](const Placement& placement) {
    const GridBox& box = scene.box(workspace_.shape(sheet(), placement));
    return GridBox{box.low + placement.at, box.high + placement.at};
  };
  GridBox all = one(placements_[0]);
  for (const Placement& placement : placements_) all = joined(all, one(placement));
  return all;
}

void Group::jump(GridPoint shift) noexcept {
  for (Placement& placement : placements_) placement.at = placement.at + shift;
}

Group::Way Group::way(Point direction, double length) const {
  Way made{{{}, direction, length}, {}};
  const phi::Scene& scene = workspace_.scene(sheet());
  const GridPoint end = made.path.at(length);
  for (const Placement& placement : placements_) {
    const Part& part = workspace_.document().parts[placement.part];
    const phi::ShapeIndex shape = workspace_.shape(sheet(), placement);
    const GridBox here{scene.box(shape).low + placement.at, scene.box(shape).high + placement.at};
    const GridBox swept = joined(here, {here.low + end, here.high + end});
    const std::int64_t own = part.gap.value_or(workspace_.document().rules.gap);
    const phi::SlidePath path{placement.at, direction, length};
    for (const phi::BodyIndex body :
         workspace_.near(sheet(), swept, std::max(own, scene.widest_gap()) + 4, kAllLayers)) {
      if (!workspace_.concerns(part, sheet(), body)) continue;
      const phi::Body& other = scene.body(body);
      const std::int64_t gap = workspace_.gap_to(part, sheet(), body);
      append_slide_events(scene.outline(shape), path, scene.outline(other.shape), other.at, gap, made.events);
      if ((other.layers & kZoneLayer) == 0) continue;
      for (const PartArea& area : part.areas)
        append_slide_events(geom::turned(area.outline.polygon, placement.rotation, placement.mirrored), path,
                            scene.outline(other.shape), other.at, 0, made.events);
    }
  }
  return made;
}

bool Group::slide(Point direction, double length) {
  // The way is gone in legs, so that a long one does not gather everything that lies beside it.
  const GridBox around = box();
  const double leg = norm(in_doubles(around.high - around.low)) + 1024;
  while (length > 0) {
    ask();
    Way next = way(direction, std::min(leg, length));
    const phi::SlideEnd end =
        phi::slide(next.path, std::move(next.events), [&](GridPoint shift) { return is_clear(shift); });
    jump(end.at);
    if (end.blocked) return true;
    length -= leg;
  }
  return false;
}

std::vector<Point> Group::along_contacts(Point goal) const {
  std::vector<Point> directions;
  const phi::Scene& scene = workspace_.scene(sheet());
  for (const Placement& placement : placements_) {
    const Part& part = workspace_.document().parts[placement.part];
    const phi::ShapeIndex shape = workspace_.shape(sheet(), placement);
    const GridBox here{scene.box(shape).low + placement.at, scene.box(shape).high + placement.at};
    const std::int64_t own = part.gap.value_or(workspace_.document().rules.gap);
    for (const phi::BodyIndex body :
         workspace_.near(sheet(), here, std::max(own, scene.widest_gap()) + 4, kAllLayers)) {
      if (!workspace_.concerns(part, sheet(), body)) continue;
      const phi::Body& other = scene.body(body);
      const double reach = static_cast<double>(workspace_.gap_to(part, sheet(), body)) + 4;
      append_contacts(scene.outline(shape), placement.at, scene.outline(other.shape), other.at, reach,
                      directions);
      append_contacts(scene.outline(other.shape), other.at, scene.outline(shape), placement.at, reach,
                      directions);
    }
  }
  std::vector<std::pair<double, Point>> leading;
  for (Point direction : directions) {
    double towards = dot(direction, goal);
    if (towards < 0) towards = -towards, direction = -direction;
    if (towards > 1e-6) leading.push_back({towards, direction});
  }
  std::stable_sort(leading.begin(), leading.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Point> kept;
  for (const auto& [towards, direction] : leading)
    if (kept.empty() || norm(kept.back() - direction) > 1e-9) kept.push_back(direction);
  return kept;
}

bool Group::follow(Point along, double length, Point goal) {
  // A group that gets on by less than this stands still.
  constexpr double kProgress = 8;  // steps
  const GridBox around = box();
  Way next = way(along, std::min(length, norm(in_doubles(around.high - around.low)) + 1024));
  std::vector<double> events = next.events;
  const auto clear = [&](GridPoint shift) { return is_clear(shift); };
  const phi::SlideEnd end = phi::slide(next.path, std::move(next.events), clear);
  if (end.way < kProgress) return false;
  // The way to the goal may open where a contact ends, and that can only be at one of the events.
  std::sort(events.begin(), events.end());
  const GridPoint onwards = nearest_step(16 * goal);
  double last = 0;
  for (const double event : events) {
    if (event >= end.way) break;
    if (event - last < kProgress) continue;
    last = event;
    const GridPoint at = next.path.at(event + 2);
    if (!is_clear(at) || !is_clear(at + onwards)) continue;
    jump(at);
    return true;
  }
  jump(end.at);
  return true;
}

void Group::slide_along(GridPoint by) {
  constexpr int kMostTurns = 200;
  const GridPoint goal = placements_[0].at + by;
  for (int turn = 0; turn < kMostTurns; ++turn) {
    const Point rest = in_doubles(goal - placements_[0].at);
    const double distance = norm(rest);
    if (distance < 1) return;
    const Point towards = (1 / distance) * rest;
    if (!slide(towards, distance)) return;
    const Point left = in_doubles(goal - placements_[0].at);
    const double left_distance = norm(left);
    if (left_distance < 1) return;
    bool moved = false;
    for (const Point along : along_contacts((1 / left_distance) * left)) {
      moved = follow(along, dot(left, along), (1 / left_distance) * left);
      if (moved) break;
    }
    if (!moved) return;
  }
}

void Group::settle(Point direction) {
  constexpr int kMostTurns = 200;
  const GridBox world = bounds(workspace_.document().stocks[sheet().stock].outline.polygon);
  const double far = norm(in_doubles(world.high - world.low));
  for (int turn = 0; turn < kMostTurns; ++turn) {
    if (!slide(direction, far)) return;
    bool moved = false;
    for (const Point along : along_contacts(direction)) {
      moved = follow(along, far, direction);
      if (moved) break;
    }
    if (!moved) return;
  }
}

std::vector<phi::BodyIndex> Group::blockers(Point direction) const {
  const phi::Scene& scene = workspace_.scene(sheet());
  std::vector<phi::BodyIndex> found;
  for (double reach = 1; reach <= 16 && found.empty(); reach *= 2) {
    const GridPoint ahead = nearest_step(reach * direction);
    for (const Placement& placement : placements_) {
      const Part& part = workspace_.document().parts[placement.part];
      const phi::ShapeIndex shape = workspace_.shape(sheet(), placement);
      const auto ask = [&](std::uint32_t layers, std::int64_t gap, std::int64_t tolerates) {
        const auto some = scene.forbidding({.shape = shape,
                                            .at = placement.at + ahead,
                                            .gap = gap,
                                            .layers = layers,
                                            .tolerates = tolerates});
        found.insert(found.end(), some.begin(), some.end());
      };
      const Rules& rules = workspace_.document().rules;
      ask(kPartLayer, part.gap.value_or(rules.gap), 0);
      ask(kBorderLayer, part.border_gap.value_or(rules.border_gap), 0);
      ask(kDefectLayer, part.defect_gap.value_or(rules.defect_gap), part.tolerated_severity);
      ask(kZoneLayer, 0, -std::int64_t{part.quality});
    }
  }
  workspace_.sort_bodies(sheet(), found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace lekalo::layout

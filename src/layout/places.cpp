#include "places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "group.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/layout/command.hpp"

namespace lekalo::layout {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Point;

/// An edge of the part and one of a neighbour that it could lie against.
struct Facing {
  double distance = 0;  ///< steps
  Point mine_from, mine_to, theirs_from, theirs_to;
  std::int64_t gap = 0;
};

struct Line {
  Point from, to;
};

std::vector<Line> lines_of(const GridRegion& region, GridPoint at) {
  std::vector<Line> lines;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    const std::uint32_t begin = region.loop_starts[l], end = region.loop_starts[l + 1];
    for (std::uint32_t i = begin; i < end; ++i)
      lines.push_back(
          {in_doubles(region.points[i] + at), in_doubles(region.points[i + 1 == end ? begin : i + 1] + at)});
  }
  return lines;
}

double distance(Point p, const Line& line) noexcept {
  const Point edge = line.to - line.from, out = p - line.from;
  const double share = std::clamp(dot(out, edge) / dot(edge, edge), 0.0, 1.0);
  return norm(out - share * edge);
}

double distance(const Line& a, const Line& b) noexcept {
  return std::min({distance(a.from, b), distance(a.to, b), distance(b.from, a), distance(b.to, a)});
}

/// Turns a placement about a point of the sheet so that `from` shows along `to`; both are unit vectors.
Placement turned_about(Placement placement, Point about, Point from, Point to) {
  const double c = dot(from, to), s = cross(from, to);
  const double old_c = static_cast<double>(placement.rotation.c) * 0x1p-52,
               old_s = static_cast<double>(placement.rotation.s) * 0x1p-52;
  const double new_c = c * old_c - s * old_s, new_s = s * old_c + c * old_s,
               size = std::sqrt(new_c * new_c + new_s * new_s);
  placement.rotation = geom::rotation_from_pair(new_c / size, new_s / size);
  const Point out = in_doubles(placement.at) - about;
  placement.at = nearest_step(about + Point{c * out.x - s * out.y, s * out.x + c * out.y});
  return placement;
}

class Snapper {
 public:
  Snapper(const Workspace& workspace, const Placement& placement, std::int64_t reach)
      : workspace_(workspace), placement_(placement), reach_(reach) {}

  std::optional<Placement> run() {
    std::vector<Facing> pairs = facing_edges();
    std::stable_sort(pairs.begin(), pairs.end(),
                     [](const Facing& a, const Facing& b) { return a.distance < b.distance; });
    constexpr std::size_t kMostTried = 12;
    if (pairs.size() > kMostTried) pairs.resize(kMostTried);
    for (const Facing& pair : pairs)
      if (auto placed = against(pair)) return placed;
    return std::nullopt;
  }

 private:
  /// Returns the pairs of edges within reach whose outer sides face each other, up to the angle that the part
  /// may be turned by.
  std::vector<Facing> facing_edges() const {
    std::vector<Facing> pairs;
    const Sheet sheet{placement_.stock, placement_.copy};
    const phi::Scene& scene = workspace_.scene(sheet);
    const Part& part = workspace_.document().parts[placement_.part];
    const phi::ShapeIndex shape = workspace_.shape(sheet, placement_);
    const GridBox box{scene.box(shape).low + placement_.at, scene.box(shape).high + placement_.at};
    const std::vector<Line> mine = lines_of(scene.outline(shape), placement_.at);
    for (const phi::BodyIndex body :
         workspace_.near(sheet, box, reach_ + scene.widest_gap(), kPartLayer | kBorderLayer)) {
      if (workspace_.placement_of(sheet, body) == placement_.id) continue;
      const phi::Body& other = scene.body(body);
      const std::int64_t gap = workspace_.gap_to(part, sheet, body);
      for (Line theirs : lines_of(scene.outline(other.shape), other.at)) {
        // The border's material is inside the border, and what the part must face is its outer side.
        if (other.container) std::swap(theirs.from, theirs.to);
        for (const Line& my : mine) {
          const Point a = my.to - my.from, b = theirs.from - theirs.to;
          constexpr double kMostTurn = 0.27;  // sine, about 16 degrees
          if (!(dot(a, b) > 0) || std::abs(cross(a, b)) > kMostTurn * norm(a) * norm(b)) continue;
          const double apart = distance(my, theirs);
          if (apart <= static_cast<double>(reach_ + gap))
            pairs.push_back({apart, my.from, my.to, theirs.from, theirs.to, gap});
        }
      }
    }
    return pairs;
  }

  std::optional<Placement> against(const Facing& pair) const {
    const Point theirs = pair.theirs_from - pair.theirs_to;
    const Point along = (1 / norm(theirs)) * theirs;
    const Point mine = pair.mine_to - pair.mine_from, mine_along = (1 / norm(mine)) * mine;
    const Point middle = 0.5 * (pair.mine_from + pair.mine_to);
    Placement placed = placement_;
    if (std::abs(cross(mine_along, along)) > 1e-12) {
      placed = turned_about(placement_, middle, mine_along, along);
      if (!rotation_allowed(workspace_.document().parts[placed.part], placed.rotation)) {
        if (std::abs(cross(mine_along, along)) > 1e-3) return std::nullopt;
        // The part stays as parallel as its angles allow.
        placed = placement_;
      }
    }
    // The part's edge runs along `along` with the part's material on its left, and the other edge lies on the
    // other side.
    const Point inwards = perpendicular(along);
    const double height = dot(middle - pair.theirs_from, inwards);
    // The part is put this much further away first, and then slides back.
    constexpr double kReserve = 16;  // steps
    const Point lift = (static_cast<double>(pair.gap) + kReserve - height) * inwards;
    // Places where a corner meets a corner are tried first, the nearest before the others, and then the place
    // without such a shift.
    std::vector<double> shifts;
    const double half = norm(mine) / 2, at = dot(middle, along);
    for (const double my_end : {at - half, at + half})
      for (const Point their_end : {pair.theirs_from, pair.theirs_to})
        if (const double shift = dot(their_end, along) - my_end;
            std::abs(shift) <= static_cast<double>(reach_))
          shifts.push_back(shift);
    std::sort(shifts.begin(), shifts.end(), [](double a, double b) {
      return std::abs(a) < std::abs(b) || (std::abs(a) == std::abs(b) && a < b);
    });
    shifts.push_back(0);
    for (const double shift : shifts) {
      ask();
      Placement lifted = placed;
      lifted.at = lifted.at + nearest_step(lift + shift * along);
      Group group(workspace_, {lifted});
      if (!group.is_clear()) continue;
      group.slide(-inwards, 2 * kReserve);
      return group.placements()[0];
    }
    return std::nullopt;
  }

  const Workspace& workspace_;
  const Placement& placement_;
  std::int64_t reach_;
};

GridPoint direction_of_step(int step, int steps) noexcept {
  const geom::GridRotation r = geom::rotation_from_degrees(360.0 * step / steps);
  return {r.c, r.s};
}

}  // namespace

std::optional<Placement> snapped(const Workspace& workspace, const Placement& placement, std::int64_t reach) {
  return Snapper(workspace, placement, reach).run();
}

std::optional<std::vector<Placement>> nearest_place(const Workspace& workspace,
                                                    const std::vector<Placement>& placements) {
  Group group(workspace, placements);
  if (group.is_clear()) return placements;
  const GridBox box = group.box();
  const GridBox world = bounds(workspace.document().stocks[group.sheet().stock].outline.polygon);
  const double size = norm(in_doubles(box.high - box.low)),
               most = norm(in_doubles(world.high - world.low)) + size;
  const GridPoint dropped = placements[0].at;
  double best = std::numeric_limits<double>::infinity();
  std::vector<Placement> nearest;
  constexpr int kDirections = 24;
  int ring = 0;
  for (double radius = std::max(16.0, size / 64); radius <= most && radius < best; radius *= 1.25, ++ring) {
    for (int step = 0; step < kDirections; ++step) {
      ask();
      // The directions of a ring lie between those of the ring before.
      const GridPoint direction = direction_of_step(2 * step + ring % 2, 2 * kDirections);
      const GridPoint shift = nearest_step(radius * 0x1p-52 * in_doubles(direction));
      group.jump(dropped + shift - group.placements()[0].at);
      if (!group.is_clear()) continue;
      group.slide_along(dropped - group.placements()[0].at);
      const double distance = norm(in_doubles(group.placements()[0].at - dropped));
      if (!(distance < best)) continue;
      best = distance;
      nearest = group.placements();
    }
  }
  if (nearest.empty()) return std::nullopt;
  return nearest;
}

std::vector<Placement> fits_where(const Workspace& workspace, std::uint32_t part_index, Sheet sheet,
                                  std::size_t most, std::optional<bool> only, const RunControl& run) {
  const Document& document = workspace.document();
  const Part& part = document.parts[part_index];
  std::vector<geom::GridRotation> angles;
  constexpr int kAngles = 16;
  const auto add_range = [&](double from, double to) {
    const double span = std::min(to - from, 360.0 * (kAngles - 1) / kAngles);
    const int count = span > 0 ? kAngles : 1;
    for (int i = 0; i < count; ++i)
      angles.push_back(geom::rotation_from_degrees(count == 1 ? from : from + span * i / (count - 1)));
  };
  if (part.rotations.empty()) add_range(0, 360);
  for (const AngleRange& range : part.rotations) add_range(range.from, range.to);

  GridBox world = bounds(document.stocks[sheet.stock].outline.polygon);
  if (document.stocks[sheet.stock].open_length) {
    // Everything is free beyond the last part of a strip, and one place there is enough.
    std::int64_t last = world.low.x;
    for (const Placement& placement : document.placements) {
      if (placement.stock != sheet.stock || placement.copy != sheet.copy) continue;
      last = std::max(last,
                      workspace.scene(sheet).box(workspace.shape(sheet, placement)).high.x + placement.at.x);
    }
    const GridBox own = bounds(part.outline.polygon);
    world.high.x = std::min(world.high.x, last + 2 * (own.high.x - own.low.x + own.high.y - own.low.y));
  }
  std::vector<Placement> places;
  constexpr std::int64_t kStarts = 24;
  const std::size_t forms = angles.size() * (part.may_mirror && !only ? 2 : 1);
  std::size_t form = 0;
  std::uint64_t rows = 0;
  for (int mirrored = 0; mirrored <= (part.may_mirror ? 1 : 0); ++mirrored) {
    if (only && *only != (mirrored != 0)) continue;
    for (const geom::GridRotation angle : angles) {
      const auto begun = static_cast<double>(form++);
      Placement placement;
      placement.part = part_index;
      placement.stock = sheet.stock;
      placement.copy = sheet.copy;
      placement.rotation = angle;
      placement.mirrored = mirrored != 0;
      const GridBox box = bounds(placed_outline(part, placement));
      const GridPoint low = world.low - box.low, room = (world.high - box.high) - low;
      if (room.x < 0 || room.y < 0) continue;
      std::size_t settled = 0;
      for (std::int64_t iy = 0; iy <= kStarts && settled < most; ++iy) {
        if (run.stop_requested()) break;
        if (run.progress)
          run.progress(
              {++rows, (begun + static_cast<double>(iy) / (kStarts + 1)) / static_cast<double>(forms)});
        for (std::int64_t ix = 0; ix <= kStarts && settled < most; ++ix) {
          placement.at = {low.x + room.x / kStarts * ix, low.y + room.y / kStarts * iy};
          if (!workspace.is_clear_of_scene(placement)) continue;
          Group group(workspace, {placement});
          group.settle({0, -1});
          group.slide({-1, 0}, static_cast<double>(room.x) + 1);
          group.slide({0, -1}, static_cast<double>(room.y) + 1);
          places.push_back(group.placements()[0]);
          ++settled;
        }
      }
    }
  }
  const auto key = [&](const Placement& placement) {
    const GridBox& box = workspace.scene(sheet).box(workspace.shape(sheet, placement));
    return std::tuple{placement.at.y + box.low.y, placement.at.x + box.low.x, placement.rotation.c,
                      placement.rotation.s, placement.mirrored};
  };
  std::sort(places.begin(), places.end(),
            [&](const Placement& a, const Placement& b) { return key(a) < key(b); });
  std::vector<Placement> kept;
  for (const Placement& place : places) {
    const bool known = std::any_of(kept.begin(), kept.end(), [&](const Placement& other) {
      const GridPoint apart = other.at - place.at;
      return other.rotation == place.rotation && other.mirrored == place.mirrored &&
             dot(apart, apart) < geom::Int128{geom::kGridPerMm} * geom::kGridPerMm;
    });
    if (!known) kept.push_back(place);
    if (kept.size() == most) break;
  }
  return kept;
}

}  // namespace lekalo::layout

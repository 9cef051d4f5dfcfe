#include "entry.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/trig.hpp"
#include "mill/front/step_law.hpp"

namespace lekalo::mill {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;
using Kind = PathMove::Kind;

namespace {

constexpr double kHelix = 0.8;        // of the tool's radius
constexpr double kLeastHelix = 1e-3;  // mm: below it the tool goes straight down
constexpr double kLeastDisc = 0.01;   // mm

/// Goes a quarter of a turn about the entry, to `out` off its centre.
void quarter(ToolMotion& tool, const Entry& entry, Point out, double z, Kind kind) {
  tool.go(
      {.kind = kind, .to = entry.centre + out, .z = z, .shape = EdgeKind::arc_ccw, .centre = entry.centre});
}

/// Goes once round on the floor. \param out  where the tool is, off the centre
void level_turn(ToolMotion& tool, const Entry& entry, Point out, double depth, Kind kind) {
  for (int q = 0; q < 4; ++q) {
    out = perpendicular(out);
    quarter(tool, entry, out, -depth, kind);
  }
}

/// Goes down from the stock's face, and once round on the floor. \param out  where the tool is, off the
/// centre
void helix(ToolMotion& tool, const Entry& entry, Point out, const PocketOptions& o) {
  const double turns = std::ceil(o.depth / (kTurn * entry.helix * o.ramp_angle));
  for (double i = 1; i <= 4 * turns; ++i) {
    out = perpendicular(out);
    quarter(tool, entry, out, -o.depth * i / (4 * turns), Kind::entry);
  }
  level_turn(tool, entry, out, o.depth, Kind::entry);
}

/// Leads from the helix out to the disc.
void spiral(ToolMotion& tool, const Entry& entry, Point ahead, const PocketOptions& o) {
  const double radius = o.tool_diameter / 2, widest_step = o.step_over * o.tool_diameter;
  const double cosine = geom::sincos(kNext * straight_pass_angle(o.step_over)).cosine;
  std::vector<double> steps;
  double reach = entry.helix;
  while (reach < entry.disc) {
    // A turn meets the step of the one before, so that what it may add depends on where it begins.
    steps.push_back(std::min(widest_step, step_for(reach, radius, cosine)));
    reach += steps.back();
  }
  const double scale = (entry.disc - entry.helix) / (reach - entry.helix);
  double r = entry.helix;
  for (const double step : steps) {
    // Four quarter circles about the corners of a small square are tangent to each other and end on the axis.
    const double more = scale * step / 4;
    Point out = ahead, centre = entry.centre;
    for (int q = 0; q < 4; ++q) {
      centre = centre - more * out;
      r += more;
      out = perpendicular(out);
      tool.go(Kind::cut, Edge{EdgeKind::arc_ccw, tool.at(), centre + r * out, centre});
    }
  }
  level_turn(tool, entry, r * ahead, o.depth, Kind::cut);
}

}  // namespace

Entry widest_disc(const std::vector<Region>& places, double tool_radius) {
  const geom::RegionIndex limit(places);
  const geom::Box box = limit.bounds();
  const auto depth_at = [&](Point p) {
    const double d = limit.nearest(p).distance;
    return limit.contains(p) ? d : -d;
  };
  Point best = limit.curves()[0].edge.from;
  double most = 0;
  constexpr int kPlaces = 64;
  const Point size = box.high - box.low;
  for (int y = 0; y <= kPlaces; ++y)
    for (int x = 0; x <= kPlaces; ++x) {
      ask();
      const Point p = box.low + Point{size.x * x / kPlaces, size.y * y / kPlaces};
      const double depth = depth_at(p);
      if (depth > most) most = depth, best = p;
    }
  for (double step = std::max(size.x, size.y) / kPlaces; step > 1e-7; step /= 2)
    for (const Point d : {Point{step, 0}, Point{-step, 0}, Point{0, step}, Point{0, -step}, Point{step, step},
                          Point{step, -step}, Point{-step, step}, Point{-step, -step}}) {
      const double depth = depth_at(best + d);
      if (depth > most + 1e-9) most = depth, best = best + d;
    }
  const double disc = std::max(0.0, most - 1e-6);
  return {best, disc, std::min(kHelix * tool_radius, disc)};
}

Result<std::vector<Region>> start_region(const Entry& entry, const Piece& piece) {
  const Point edge = entry.centre + Point{std::max(entry.disc, kLeastDisc), 0};
  LEKALO_TRY(const auto disc, geom::make_region({{EdgeKind::arc_ccw, edge, edge, entry.centre}}));
  if (entry.disc >= kLeastDisc) return std::vector<Region>{disc};
  LEKALO_TRY(auto clipped, geom::combine({disc}, piece.allowed.regions, geom::BooleanOperation::intersect));
  return clipped.regions;
}

void enter(ToolMotion& tool, const Entry& entry, Point ahead, const PocketOptions& o) {
  const Point out = entry.helix * ahead;
  if (!tool.moves().empty()) tool.rise();
  tool.come_down(entry.centre + out, 0);
  if (!(entry.helix > kLeastHelix)) return tool.go(Kind::plunge, entry.centre + out);
  helix(tool, entry, out, o);
  if (entry.disc > entry.helix) spiral(tool, entry, ahead, o);
}

Point roomy_place(Point p, const geom::RegionIndex& cleared, double tool_radius) {
  Point best = cleared.nearest(p).point;
  double most = -1;
  for (double reach = 0.5; reach <= 4; reach += 0.5)
    for (int k = 0; k < 16; ++k) {
      const auto [sine, cosine] = geom::sincos(kTurn / 16 * k);
      const Point q = p + (reach * tool_radius) * Point{cosine, sine};
      if (!cleared.contains(q)) continue;
      const double room =
          std::min(0.5 * tool_radius, cleared.nearest(q).distance) - 0.1 * reach * tool_radius;
      if (room > most) most = room, best = q;
    }
  return best;
}

}  // namespace lekalo::mill

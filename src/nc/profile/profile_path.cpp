#include "profile_path.hpp"

#include <fmt/core.h>

#include <cmath>

#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/offset.hpp"

namespace lekalo::nc {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// An arc below this radius, in units of the last decimal, has no centre worth the name once it is rounded.
constexpr double kLeastRadius = 10;

double decimal_power(int decimals) {
  double power = 1;
  for (int k = 0; k < decimals; ++k) power *= 10;
  return power;
}

/// The middle of an arc; across from the start for a full circle.
Point middle_of_arc(const Edge& arc) {
  const double radius = geom::arc_radius(arc);
  const bool full = arc.from == arc.to;
  Point towards = full ? arc.centre - arc.from : geom::perpendicular(arc.to - arc.from);
  // The perpendicular of the chord points to its left: where a clockwise arc bulges.
  if (!full && arc.kind == EdgeKind::arc_ccw) towards = -towards;
  return arc.centre + (radius / geom::norm(towards)) * towards;
}

void append_written(const Edge& edge, const Resolution& resolution, WrittenPoint& at,
                    std::vector<WrittenEdge>& to) {
  if (edge.kind != EdgeKind::line) {
    constexpr double kHalfTurn = 3.1416;
    if (geom::arc_sweep(edge) > kHalfTurn) {
      Edge first = edge, second = edge;
      first.to = second.from = middle_of_arc(edge);
      append_written(first, resolution, at, to);
      append_written(second, resolution, at, to);
      return;
    }
  }
  WrittenEdge written{EdgeKind::line, at, resolution.rounded(edge.to), {}};
  if (written.from == written.to) return;
  if (edge.kind != EdgeKind::line) {
    const double radius = geom::arc_radius(edge), step = resolution.step_mm();
    const double sweep = geom::arc_sweep(edge), half_chord = 0.5 * geom::norm(edge.to - edge.from);
    // tan of a quarter of the sweep, for sweeps up to half a turn, without a library's tangent.
    const double height = std::sqrt(std::max(0.0, radius * radius - half_chord * half_chord));
    const double sagitta = sweep > 0 ? half_chord * half_chord / (radius + height) : 0;
    if (sagitta >= 0.5 * step && radius >= kLeastRadius * step) {
      written.kind = edge.kind;
      written.centre = resolution.rounded(edge.centre);
    }
  }
  to.push_back(written);
  at = written.to;
}

/// Outlines are counter-clockwise and cut clockwise, so that the part is on the right; holes the other way.
std::vector<WrittenEdge> cut_along(const geom::Contour& contour, const Resolution& resolution) {
  return written_edges(geom::reversed(contour), resolution);
}

tl::unexpected<Error> too_narrow(const ProfilePart& part, const std::string& what, double kerf) {
  return failure(ErrorCode::bad_input,
                 fmt::format("placement {}: {} is narrower than the kerf of {:g} mm and cannot be cut; use a "
                             "narrower kerf or leave it out of the drawing",
                             part.id, what, kerf));
}

Result<Cut> hole_cut(const ProfilePart& part, std::size_t index, std::size_t hole,
                     const ProfileOptions& options, const Resolution& resolution) {
  const geom::Region inside{geom::reversed(part.region.holes[hole]), {}};
  LEKALO_TRY(const auto shrunk, geom::offset({inside}, -0.5 * options.kerf_mm));
  const std::string what = fmt::format("hole {}", hole + 1);
  if (shrunk.regions.empty()) return too_narrow(part, what, options.kerf_mm);
  if (shrunk.regions.size() > 1) return too_narrow(part, "a neck of " + what, options.kerf_mm);
  // The outer contour of a region runs counter-clockwise, as the cut of a hole should.
  Cut cut{index, false, hole, written_edges(shrunk.regions.front().outer, resolution)};
  if (cut.path.size() < 2) return too_narrow(part, what, options.kerf_mm);
  return cut;
}

Result<Cut> outline_cut(const ProfilePart& part, std::size_t index, const ProfileOptions& options,
                        const Resolution& resolution) {
  LEKALO_TRY(const auto grown, geom::offset({{part.region.outer, {}}}, 0.5 * options.kerf_mm));
  if (grown.regions.size() != 1 || !grown.regions.front().holes.empty())
    return too_narrow(part, "the mouth of a notch", options.kerf_mm);
  return Cut{index, true, 0, cut_along(grown.regions.front().outer, resolution)};
}

}  // namespace

double Resolution::step_mm() const noexcept { return millimetres_per(unit) / decimal_power(decimals); }

WrittenPoint Resolution::rounded(Point mm) const noexcept {
  const double scale = decimal_power(decimals) / millimetres_per(unit);
  return {std::llround(mm.x * scale), std::llround(mm.y * scale)};
}

Point Resolution::mm(WrittenPoint p) const noexcept {
  const double power = decimal_power(decimals), unit_mm = millimetres_per(unit);
  return {static_cast<double>(p.x) * unit_mm / power, static_cast<double>(p.y) * unit_mm / power};
}

Resolution resolution_of(const ProfileOptions& options) noexcept {
  return {options.post.decimals.of(options.unit), options.unit};
}

Edge edge_mm(const WrittenEdge& edge, const Resolution& resolution) noexcept {
  return {edge.kind, resolution.mm(edge.from), resolution.mm(edge.to),
          edge.kind == EdgeKind::line ? Point{} : resolution.mm(edge.centre)};
}

double length_of(const Edge& edge) noexcept {
  return edge.kind == EdgeKind::line ? geom::norm(edge.to - edge.from)
                                     : geom::arc_radius(edge) * geom::arc_sweep(edge);
}

std::vector<WrittenEdge> written_edges(const std::vector<Edge>& edges, const Resolution& resolution) {
  std::vector<WrittenEdge> written;
  if (edges.empty()) return written;
  WrittenPoint at = resolution.rounded(edges.front().from);
  for (const Edge& edge : edges) append_written(edge, resolution, at, written);
  return written;
}

Result<std::vector<Cut>> compensated_cuts(const std::vector<ProfilePart>& parts,
                                          const ProfileOptions& options) {
  const Resolution resolution = resolution_of(options);
  std::vector<Cut> cuts;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (std::size_t hole = 0; hole < parts[i].region.holes.size(); ++hole) {
      LEKALO_TRY(Cut cut, hole_cut(parts[i], i, hole, options, resolution));
      cuts.push_back(std::move(cut));
    }
    LEKALO_TRY(Cut cut, outline_cut(parts[i], i, options, resolution));
    cuts.push_back(std::move(cut));
  }
  return cuts;
}

}  // namespace lekalo::nc

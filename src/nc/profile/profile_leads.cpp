#include "profile_leads.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/geom/edge_distance.hpp"

namespace lekalo::nc {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// The direction in which an edge leaves its first point.
Point direction_at_start(const Edge& edge) {
  Point way = edge.to - edge.from;
  if (edge.kind != EdgeKind::line) {
    way = geom::perpendicular(edge.from - edge.centre);
    if (edge.kind == EdgeKind::arc_cw) way = -way;
  }
  return (1 / geom::norm(way)) * way;
}

/// A lead that ends at `at`, where the path goes on in `direction`; the waste is on the left.
std::vector<WrittenEdge> lead_to(WrittenPoint at, Point direction, double length, LeadShape shape,
                                 const Resolution& resolution) {
  const Point end = resolution.mm(at), waste = geom::perpendicular(direction);
  Edge lead{EdgeKind::line, end + length * waste, end, {}};
  if (shape == LeadShape::arc) {
    const Point centre = end + length * waste;
    lead = {EdgeKind::arc_ccw, centre - length * direction, end, centre};
  }
  return written_edges({lead}, resolution);
}

/// Splits the longest lines so that a start may lie away from corners.
void split_lines(std::vector<WrittenEdge>& path, const Resolution& resolution, double least_mm) {
  std::vector<WrittenEdge> split;
  for (const WrittenEdge& edge : path) {
    const Point along = resolution.mm(edge.to) - resolution.mm(edge.from);
    if (edge.kind != EdgeKind::line || geom::norm(along) < least_mm) {
      split.push_back(edge);
      continue;
    }
    const WrittenPoint middle = resolution.rounded(resolution.mm(edge.from) + 0.5 * along);
    split.push_back({EdgeKind::line, edge.from, middle, {}});
    split.push_back({EdgeKind::line, middle, edge.to, {}});
  }
  path = std::move(split);
}

}  // namespace

Starts starts_of(std::vector<WrittenEdge>& path, double lead_in_mm, const KerfProof& proof,
                 const ProfileOptions& options) {
  const Resolution resolution = resolution_of(options);
  if (lead_in_mm > 0) split_lines(path, resolution, 4 * options.kerf_mm);
  const std::size_t count = std::min(path.size(), kMostStarts);
  const auto edge_at = [&](std::size_t k) { return k * path.size() / count; };
  for (const double part : {1.0, 0.5, 0.25}) {
    if (!(lead_in_mm > 0)) break;
    Starts found{{}, part * lead_in_mm};
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t edge = edge_at(k);
      const WrittenPoint at = path[edge].from;
      // Both edges at a start go one way, because the path is smooth, in the middle of a stretch and at the
      // end of a corner's arc alike. Corners that point inwards are no exception that matters: the proof
      // decides.
      auto lead = lead_to(at, direction_at_start(edge_mm(path[edge], resolution)), found.lead_mm,
                          options.lead, resolution);
      if (lead.size() != 1 || lead.back().to != at || !proof.stays_out(lead)) continue;
      const WrittenPoint pierce = lead.front().from;
      found.choices.push_back({std::move(lead), edge, pierce, at});
    }
    if (!found.choices.empty()) return found;
  }
  Starts bare;
  for (std::size_t k = 0; k < count; ++k) {
    const WrittenPoint at = path[edge_at(k)].from;
    bare.choices.push_back({{}, edge_at(k), at, at});
  }
  return bare;
}

}  // namespace lekalo::nc

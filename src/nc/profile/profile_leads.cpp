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

/// Says whether two lines that end at one place come to it the same way, as a lead to a corner that points
/// inwards comes along the edge before it.
bool come_one_way(const WrittenEdge& a, const WrittenEdge& b, const Resolution& resolution) {
  if (a.kind != EdgeKind::line || b.kind != EdgeKind::line) return false;
  const Point way_a = resolution.mm(a.to) - resolution.mm(a.from),
              way_b = resolution.mm(b.to) - resolution.mm(b.from);
  return geom::dot(way_a, way_b) > 0.99 * geom::norm(way_a) * geom::norm(way_b);
}

/// A pierce that is nearer to its own contour than this would burn into the part.
bool needs_room(const ProfileOptions& options) {
  return 0.5 * options.pierce_diameter_mm > 0.5 * options.kerf_mm + options.tolerance_mm;
}

class StartFinder {
 public:
  StartFinder(std::vector<WrittenEdge>& path, std::size_t own, const Surroundings& around,
              const ProfileOptions& options)
      : path_(path), own_(own), around_(around), options_(options), resolution_(resolution_of(options)) {}

  /// The starts with leads of the first of these lengths that has one which meets no kerf, or of the first
  /// that has any; none where none has.
  [[nodiscard]] Starts with_leads(const std::vector<double>& lengths, std::size_t most) const {
    Starts first;
    for (const double length : lengths) {
      Starts found = of_length(length, most);
      const bool is_free = std::any_of(found.choices.begin(), found.choices.end(),
                                       [](const Start& start) { return start.met.empty(); });
      if (is_free) return found;
      if (first.choices.empty()) first = std::move(found);
    }
    return first;
  }

  [[nodiscard]] Starts bare() const {
    Starts bare;
    for (std::size_t k = 0; k < count(kMostStarts); ++k) {
      const std::size_t edge = edge_at(k, kMostStarts);
      const WrittenPoint at = path_[edge].from;
      if (options_.pierce_diameter_mm > 0 &&
          !around_.proof.disc_stays_out(at, 0.5 * options_.pierce_diameter_mm))
        continue;
      if (!keeps_off(around_.grounds, {}, at, options_)) continue;
      bare.choices.push_back({{}, edge, at, at, around_.kerfs.met(own_, {}, at)});
    }
    return bare;
  }

 private:
  [[nodiscard]] std::size_t count(std::size_t most) const { return std::min(path_.size(), most); }
  [[nodiscard]] std::size_t edge_at(std::size_t k, std::size_t most) const {
    return k * path_.size() / count(most);
  }

  [[nodiscard]] Starts of_length(double length, std::size_t most) const {
    Starts found;
    for (std::size_t k = 0; k < count(most); ++k) {
      const std::size_t edge = edge_at(k, most);
      const WrittenPoint at = path_[edge].from;
      // Both edges at a start go one way, because the path is smooth, in the middle of a stretch and at the
      // end of a corner's arc alike. At corners that point inwards the proof decides; but a lead along the
      // edge before would cut that edge twice.
      auto lead = lead_to(at, direction_at_start(edge_mm(path_[edge], resolution_)), length, options_.lead,
                          resolution_);
      if (lead.size() != 1 || lead.back().to != at || !around_.proof.stays_out(lead)) continue;
      const WrittenEdge& before = path_[(edge + path_.size() - 1) % path_.size()];
      if (come_one_way(lead.back(), before, resolution_)) continue;
      const WrittenPoint pierce = lead.front().from;
      if (options_.pierce_diameter_mm > 0 &&
          !around_.proof.disc_stays_out(pierce, 0.5 * options_.pierce_diameter_mm))
        continue;
      if (!keeps_off(around_.grounds, lead, pierce, options_)) continue;
      std::vector<std::size_t> met = around_.kerfs.met(own_, lead, pierce);
      found.choices.push_back({std::move(lead), edge, pierce, at, std::move(met), length});
    }
    return found;
  }

  std::vector<WrittenEdge>& path_;
  std::size_t own_;
  const Surroundings& around_;
  const ProfileOptions& options_;
  Resolution resolution_;
};

}  // namespace

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

std::vector<double> lead_lengths(double lead_in_mm, const ProfileOptions& options) {
  std::vector<double> lengths;
  const double least = least_lead_mm(options);
  for (const double part : {1.0, 0.5, 0.25})
    if (lead_in_mm > 0 && part * lead_in_mm >= least) lengths.push_back(part * lead_in_mm);
  if (least > 0 && !lengths.empty() && lengths.back() > least) lengths.push_back(least);
  return lengths;
}

double least_lead_mm(const ProfileOptions& options) noexcept {
  return needs_room(options) ? 0.5 * (options.pierce_diameter_mm - options.kerf_mm) : 0;
}

Starts starts_of(std::vector<WrittenEdge>& path, std::size_t own, double lead_in_mm,
                 const Surroundings& around, const ProfileOptions& options) {
  const Resolution resolution = resolution_of(options);
  if (lead_in_mm > 0) split_lines(path, resolution, 4 * options.kerf_mm);
  const StartFinder finder(path, own, around, options);
  const std::vector<double> lengths = lead_lengths(lead_in_mm, options);
  Starts found = finder.with_leads(lengths, kMostStarts);
  if (!found.choices.empty()) return found;
  if (!needs_room(options)) return finder.bare();
  // Few places have room for a disc in a crowd, so that many are looked at before the cut is refused.
  constexpr std::size_t kManyStarts = 400;
  for (int times = 0; times < 4; ++times) split_lines(path, resolution, 4 * options.kerf_mm);
  return finder.with_leads(lengths, kManyStarts);
}

}  // namespace lekalo::nc

#include "lekalo/geom/region_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/containment.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom {
namespace {

/// Names the place of an edge in words.
class Names {
 public:
  explicit Names(const std::vector<Region>& regions) : several_(regions.size() > 1) {
    for (std::size_t p = 0; p < regions.size(); ++p) {
      contours_.push_back({p, "outer contour"});
      for (std::size_t h = 0; h < regions[p].holes.size(); ++h)
        contours_.push_back({p, fmt::format("hole {}", h)});
    }
  }
  [[nodiscard]] std::string contour(std::size_t c) const {
    return several_ ? fmt::format("{} of piece {}", contours_[c].name, contours_[c].piece)
                    : contours_[c].name;
  }

 private:
  struct NamedContour {
    std::size_t piece;
    std::string name;
  };
  std::vector<NamedContour> contours_;
  bool several_;
};

/// Says whether two neighbours, one of them an arc, cross again away from the end they share. Only crossings
/// deeper than kArcConsistency allows for the ends of arcs count, because the digits of drawings leave such
/// crossings at smooth joints.
bool cross_again(const Curve& a, const Curve& b, Point shared) {
  if (a.edge.kind == EdgeKind::line) return cross_again(b, a, shared);
  const bool line = b.edge.kind == EdgeKind::line;
  // The other crossing is the shared end mirrored in the line of the centres, or in the perpendicular from
  // the centre to the line.
  const Point axis = line ? b.unit : b.edge.centre - a.edge.centre;
  const double squared = dot(axis, axis);
  if (!(squared > 0)) return false;
  const Point out = shared - a.edge.centre, part = (dot(out, axis) / squared) * axis;
  const Point other = line ? shared - 2 * part : shared - 2 * (out - part);
  const Point apart = other - shared;
  if (!(dot(apart, apart) / (8 * a.radius) > kArcConsistency + kArcConsistencyRelative * a.radius))
    return false;
  if (!faces(a, other - a.edge.centre)) return false;
  if (!line) return faces(b, other - b.edge.centre);
  const double along = dot(other - b.edge.from, b.unit);
  return along > 0 && along < b.length;
}

/// The first meeting is looked for among this share of the pairs that may be looked at.
constexpr std::size_t kSoon = 8;

/// Says whether the lines or circles that carry two edges are surely further apart than `limit`. It is much
/// cheaper than the distance of the edges, and settles most pairs whose boxes meet.
bool carriers_apart(const Curve& a, const Curve& b, double limit) {
  const bool line = a.edge.kind == EdgeKind::line, other_line = b.edge.kind == EdgeKind::line;
  if (!line && other_line) return carriers_apart(b, a, limit);
  if (line) {
    const auto beside = [&](const Curve& one, Point p) { return cross(one.unit, p - one.edge.from); };
    if (!other_line) {
      const double off = std::abs(beside(a, b.edge.centre));
      return off - b.radius > limit + 4 * kEdgeDistanceError * (off + b.radius);
    }
    const auto on_one_side = [&](const Curve& one, const Curve& two) {
      const double from = beside(one, two.edge.from), to = beside(one, two.edge.to);
      return std::min(from, to) > 4 * limit || std::max(from, to) < -4 * limit;
    };
    return on_one_side(a, b) || on_one_side(b, a);
  }
  const double apart = norm(b.edge.centre - a.edge.centre), radii = a.radius + b.radius;
  return std::max(apart - radii, std::abs(a.radius - b.radius) - apart) >
         limit + 4 * kEdgeDistanceError * (apart + radii);
}

class Checker {
 public:
  explicit Checker(const std::vector<Region>& regions) : regions_(regions) {
    for (const Region& region : regions) {
      contours_.push_back(&region.outer);
      for (const Contour& hole : region.holes) contours_.push_back(&hole);
    }
    for (const Contour* contour : contours_) {
      for (const Edge& edge : *contour) {
        contour_of_.push_back(static_cast<std::uint32_t>(starts_.size() - 1));
        curves_.push_back(make_curve(edge));
      }
      starts_.push_back(static_cast<std::uint32_t>(curves_.size()));
    }
  }

  struct Meetings {
    std::optional<MeetingEdges> first;
    bool too_many = false;  ///< boxes meet, so that not all could be looked at
  };
  [[nodiscard]] Meetings meetings() const {
    Meetings all;
    const std::size_t most = limits::most_meeting_boxes(curves_.size());
    std::size_t seen = 0;
    visit_pairs([&](std::uint32_t i, std::uint32_t j, double limit) {
      // Once there is one, the search for the first one ends early: a drawing of which everything crosses
      // everything is as wrong by any of its crossings.
      if (++seen > (all.first ? most / kSoon : most)) return all.too_many = !all.first, false;
      if (all.first && std::pair(all.first->a, all.first->b) < std::pair(i, j)) return true;
      if (const auto met = meeting(i, j, limit)) all.first = met;
      return true;
    });
    return all;
  }

  [[nodiscard]] std::optional<std::vector<MeetingEdges>> all_meetings(double apart) const {
    std::vector<MeetingEdges> all;
    const std::size_t most = limits::most_meeting_boxes(curves_.size());
    std::size_t seen = 0;
    visit_pairs(
        [&](std::uint32_t i, std::uint32_t j, double limit) {
          if (++seen > most) return false;
          const auto met = meeting(i, j, follow_each_other(i, j) ? limit : std::max(limit, apart));
          if (met) all.push_back(*met);
          return true;
        },
        apart);
    if (seen > most) return std::nullopt;
    std::sort(all.begin(), all.end(), [](const MeetingEdges& a, const MeetingEdges& b) {
      return std::pair(a.a, a.b) < std::pair(b.a, b.b);
    });
    return all;
  }

  [[nodiscard]] std::optional<std::string> run() const {
    const Meetings all = meetings();
    if (all.too_many)
      return fmt::format(
          "more than {} pairs of its {} edges have boxes that meet, too many to see whether any two cross; "
          "leave out hatching and long slanting slots",
          limits::most_meeting_boxes(curves_.size()), curves_.size());
    if (const auto& meeting = all.first) {
      const Names names(regions_);
      const std::uint32_t c = contour_of_[meeting->a], d = contour_of_[meeting->b];
      return fmt::format("edge {} of the {} meets edge {} of the {} at ({}, {}) mm", meeting->a - starts_[c],
                         names.contour(c), meeting->b - starts_[d], names.contour(d), meeting->at.x,
                         meeting->at.y);
    }
    return misplaced();
  }

 private:
  /// Calls visit(i, j, limit) for the edges whose boxes come within the limit or `apart`, until it returns
  /// false.
  template <class Visit>
  void visit_pairs(Visit&& visit, double apart = 0) const {
    std::vector<Box> boxes;
    boxes.reserve(curves_.size());
    double largest = 0;
    for (const Curve& curve : curves_) {
      const Box box = boxes.emplace_back(curve_box(curve));
      largest = std::max(
          {largest, std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
    }
    const double limit = kEdgeDistanceError * largest;
    const Point margin{std::max(limit, apart), std::max(limit, apart)};
    for (Box& box : boxes) box = {box.low - margin, box.high + margin};
    BoxTree(boxes).visit_pairs_while([&](std::uint32_t i, std::uint32_t j) {
      ask();
      return visit(i, j, limit);
    });
  }
  [[nodiscard]] std::optional<MeetingEdges> meeting(std::uint32_t i, std::uint32_t j, double limit) const {
    if (carriers_apart(curves_[i], curves_[j], limit) || joined_only_at_their_end(i, j, limit))
      return std::nullopt;
    const ClosestPoints close = closest_points(curves_[i], curves_[j]);
    if (close.distance > limit) return std::nullopt;
    return MeetingEdges{i, j, close.a};
  }
  [[nodiscard]] bool follow_each_other(std::uint32_t i, std::uint32_t j) const {
    const std::uint32_t begin = starts_[contour_of_[i]], end = starts_[contour_of_[i] + 1];
    return j < end && (j == i + 1 || (i == begin && j + 1 == end));
  }
  /// Says whether two neighbours along a contour meet only at an end they share, as far as fault_of sees it.
  [[nodiscard]] bool joined_only_at_their_end(std::uint32_t i, std::uint32_t j, double limit) const {
    const std::uint32_t begin = starts_[contour_of_[i]], end = starts_[contour_of_[i] + 1];
    if (!follow_each_other(i, j)) return false;
    const Edge &a = curves_[i].edge, &b = curves_[j].edge;
    // Two edges alone share both ends, and two circles, or a circle and a line, meet nowhere else.
    if (end - begin < 3) return true;
    if (a.kind == EdgeKind::line && b.kind == EdgeKind::line)
      return segment_relation(a.from, a.to, b.from, b.to) != SegmentRelation::overlap;
    // In a contour of three edges the third one joins the other ends of two neighbours. It is a neighbour of
    // both, so no other check asks whether the two meet there.
    const bool in_order = j == i + 1;
    if (end - begin == 3 &&
        (is_near(i, in_order ? b.to : b.from, limit) || is_near(j, in_order ? a.from : a.to, limit)))
      return false;
    return !cross_again(curves_[i], curves_[j], in_order ? a.to : a.from);
  }
  [[nodiscard]] bool is_near(std::uint32_t i, Point p, double limit) const {
    return !(norm(nearest_on(curves_[i], p) - p) > limit);
  }

  [[nodiscard]] std::optional<std::string> misplaced() const {
    // Piece p begins with its outer contour, whose number is outer[p], and its holes follow.
    std::vector<std::size_t> outer, piece_of;
    for (std::size_t p = 0; p < regions_.size(); ++p) {
      outer.push_back(piece_of.size());
      piece_of.insert(piece_of.end(), regions_[p].holes.size() + 1, p);
    }
    const std::vector<Enclosed> enclosed = enclosed_contours(contours_);
    for (std::size_t c = 0; c < contours_.size(); ++c) {
      const std::size_t p = piece_of[c], by = enclosed[c].by;
      const Point at = contours_[c]->front().from;
      const std::string of = regions_.size() > 1 ? fmt::format(" of piece {}", p) : "";
      if (c == outer[p]) {
        const bool in_material = by != kNoContour && by == outer[piece_of[by]];
        if (in_material)
          return fmt::format("piece {} lies in the material of piece {}, at ({}, {}) mm", p, piece_of[by],
                             at.x, at.y);
        continue;
      }
      if (by == outer[p]) continue;
      std::size_t other_hole = kNoContour;
      std::size_t around = by;
      for (; around != kNoContour && around != outer[p]; around = enclosed[around].by)
        if (piece_of[around] == p) other_hole = std::min(other_hole, around);
      if (around == kNoContour)
        return fmt::format("hole {}{} lies outside the outer contour, at ({}, {}) mm", c - outer[p] - 1, of,
                           at.x, at.y);
      if (other_hole != kNoContour)
        return fmt::format("hole {}{} lies inside hole {}, at ({}, {}) mm", c - outer[p] - 1, of,
                           other_hole - outer[p] - 1, at.x, at.y);
    }
    return std::nullopt;
  }

  const std::vector<Region>& regions_;
  std::vector<const Contour*> contours_;
  std::vector<Curve> curves_;
  std::vector<std::uint32_t> starts_{0}, contour_of_;
};

}  // namespace

std::optional<MeetingEdges> first_meeting(const std::vector<Region>& regions) {
  return Checker(regions).meetings().first;
}

std::optional<std::vector<MeetingEdges>> all_meetings(const std::vector<Region>& regions, double apart) {
  return Checker(regions).all_meetings(apart);
}

std::optional<std::string> fault_of(const std::vector<Region>& regions) { return Checker(regions).run(); }

}  // namespace lekalo::geom

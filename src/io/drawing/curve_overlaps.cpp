#include "curve_overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "arc_middle.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/edge_distance.hpp"

namespace lekalo::io {
namespace {

using geom::Box;
using geom::Curve;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

bool is_straight(const Edge& edge) { return edge.kind == EdgeKind::line; }

/// Bound on how far the points of arc b are from arc a, if that is at most `limit`.
std::optional<double> arc_on_arc(const Curve& b, const Curve& a, double limit) {
  if (!(b.radius > 0) || !(a.radius > 0)) return std::nullopt;
  const Point between = b.edge.centre - a.edge.centre;
  // The distance from a's centre is a sinusoid along b: extreme at b's ends and along the line of centres.
  double least = a.radius, most = a.radius;
  const auto include = [&](Point p) {
    const double far = norm(p - a.edge.centre);
    least = std::min(least, far), most = std::max(most, far);
  };
  for (const Point end : {b.first, b.last}) {
    include(b.edge.centre + end);
    include(b.edge.centre + (b.radius / norm(end)) * end);
  }
  if (const double apart = norm(between); apart > 0) {
    for (const Point unit : {(1 / apart) * between, (-1 / apart) * between})
      if (faces(b, unit)) include(b.edge.centre + b.radius * unit);
  }
  const double radial = std::max(most - a.radius, a.radius - least);
  if (!(radial <= limit) || !(radial <= a.radius / 4)) return std::nullopt;
  if (a.full) return radial + 4 * geom::kEdgeDistanceError * (a.radius + b.radius);
  if (b.full) return std::nullopt;
  // b's ends and middle lie on a, and b does not pass through the middle of what a leaves out: then it leaves
  // a nowhere but, at an end, by at most the distance of that end.
  double beyond = 0;
  for (const Point p : {b.edge.from, b.edge.to, middle_of(b)})
    beyond = std::max(beyond, norm(p - nearest_on(a, p)));
  // Between that end and a's own the distance is at most that of b's end, by an arc instead of its chord.
  const double bound = radial + 1.1 * beyond + 4 * geom::kEdgeDistanceError * (a.radius + b.radius);
  if (!(bound <= limit) || faces(b, -towards_middle(a))) return std::nullopt;
  return bound;
}

std::optional<double> line_on_line(const Edge& b, const Curve& a, double limit) {
  const double far = std::max(norm(b.from - nearest_on(a, b.from)), norm(b.to - nearest_on(a, b.to)));
  return far <= limit ? std::optional(far) : std::nullopt;
}

std::optional<double> edge_on_edge(const Edge& b, const Edge& a, double limit) {
  if (is_straight(a) != is_straight(b)) return std::nullopt;
  return is_straight(a) ? line_on_line(b, make_curve(a), limit)
                        : arc_on_arc(make_curve(b), make_curve(a), limit);
}

/// Bound on the distance of two edges that run the same way, both ways round, if it is at most `limit`.
std::optional<double> same_edge(const Edge& a, const Edge& b, double limit) {
  if (a.kind != b.kind || !(norm(a.from - b.from) <= limit) || !(norm(a.to - b.to) <= limit))
    return std::nullopt;
  const auto one = edge_on_edge(a, b, limit), other = edge_on_edge(b, a, limit);
  return one && other ? std::optional(std::max(*one, *other)) : std::nullopt;
}

std::optional<double> same_edges(const std::vector<Edge>& a, const std::vector<Edge>& b, double limit) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const auto far = same_edge(a[i], b[i], limit);
    if (!far) return far;
    largest = std::max(largest, *far);
  }
  return largest;
}

/// Bound on how far b is from a, if it lies on it; but for rounding.
std::optional<double> lies_on(const LaidCurve& b, const LaidCurve& a, double reach) {
  const double limit = std::min(reach, b.size / 16);
  if (a.edges->size() != b.edges->size()) return std::nullopt;
  if (b.edges->size() == 1) return edge_on_edge(b.edges->front(), a.edges->front(), limit);
  if (auto far = same_edges(*b.edges, *a.edges, limit)) return far;
  return same_edges(geom::reversed(*b.edges), *a.edges, limit);
}

/// The rounding of the distances measured here: a few times kEdgeDistanceError, for their sums and products.
double rounding(const Box& box) {
  return 4 * geom::kEdgeDistanceError *
         std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
}

bool are_equal(const std::vector<Edge>& a, const std::vector<Edge>& b) {
  return a == b || geom::reversed(a) == b;
}

}  // namespace

LaidCurve laid_curve(const std::vector<Edge>& edges) {
  LaidCurve made{&edges, curve_box(make_curve(edges.front())), 0, true};
  for (const Edge& edge : edges) made.box = joined(made.box, curve_box(make_curve(edge)));
  made.size = norm(made.box.high - made.box.low);
  return made;
}

namespace {

/// Looks for curves that lie on others, the largest first, because only the smaller one can lie on the other
/// whole.
class Copies {
 public:
  Copies(const std::vector<LaidCurve>& curves, double reach)
      : curves_(curves), reach_(reach), on_(curves.size()) {
    for (std::uint32_t i = 0; i < curves.size(); ++i)
      if (curves[i].used) order_.push_back(i);
    std::sort(order_.begin(), order_.end(),
              [this](std::uint32_t i, std::uint32_t j) { return before(i, j); });
  }

  std::vector<LyingOn> run() {
    set_equal_ones_aside();
    // A line or an arc can lie anywhere on another, and curves of several edges lie edge by edge.
    std::vector<Candidate> candidates;
    for (std::uint32_t p = 0; p < order_.size(); ++p) {
      const LaidCurve& curve = curves_[order_[p]];
      if (curve.edges->size() == 1) {
        candidates.push_back({grown(curve.box, reach_), p});
        continue;
      }
      const Point from = curve.edges->front().from, to = curve.edges->back().to;
      candidates.push_back({grown(Box{from, from}, reach_), p});
      if (!(from == to)) candidates.push_back({grown(Box{to, to}, reach_), p});
    }
    std::vector<Box> boxes;
    for (const Candidate& one : candidates) boxes.push_back(one.box);
    const geom::BoxTree tree(boxes);
    std::size_t left = limits::most_meeting_boxes(order_.size());
    for (std::uint32_t p = 0; p < order_.size(); ++p) {
      const std::uint32_t a = order_[p];
      // A curve that lies on one that lies on another is measured against that one.
      if (on_[a]) continue;
      // A curve whose copy is a little longer still counts as the copy.
      const Box room = grown(curves_[a].box, 2 * reach_);
      const Point from = curves_[a].edges->front().from;
      const Box where = curves_[a].edges->size() == 1 ? grown(curves_[a].box, reach_) : Box{from, from};
      const bool all = tree.visit_meeting_while(where, [&](std::uint32_t k) {
        if (left-- == 0) return false;
        if (candidates[k].place > p) consider(order_[candidates[k].place], a, room);
        return true;
      });
      if (!all) break;
    }
    return result();
  }

 private:
  /// The place of a curve in the order, and where another begins that it may lie on, or lies.
  struct Candidate {
    Box box;
    std::uint32_t place = 0;
  };

  /// The order in which curves are kept: larger ones first, of equal ones the first.
  [[nodiscard]] bool before(std::uint32_t i, std::uint32_t j) const {
    return curves_[i].size != curves_[j].size ? curves_[i].size > curves_[j].size : i < j;
  }

  void consider(std::uint32_t b, std::uint32_t a, const Box& room) {
    // Most pairs are neighbours along an outline: the shorter one's box does not fit in the other's.
    const Box& box = curves_[b].box;
    if (on_[b] || !(box.low.x >= room.low.x && box.low.y >= room.low.y && box.high.x <= room.high.x &&
                    box.high.y <= room.high.y))
      return;
    if (const auto far = lies_on(curves_[b], curves_[a], reach_))
      on_[b] = LyingOn{b, a, are_equal(*curves_[b].edges, *curves_[a].edges) ? 0 : *far + rounding(room)};
  }

  /// Leaves the first of curves with the same numbers in the order. A hundred copies of one curve would be
  /// ten thousand pairs.
  void set_equal_ones_aside() {
    const auto key = [this](std::uint32_t i) {
      const std::vector<Edge>& edges = *curves_[i].edges;
      return std::tie(edges.front().from.x, edges.front().from.y, edges.back().to.x, edges.back().to.y);
    };
    std::vector<std::uint32_t> sorted = order_;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [&](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
    for (std::size_t k = 1; k < sorted.size(); ++k) {
      const std::uint32_t one = sorted[k - 1], next = sorted[k];
      if (*curves_[one].edges != *curves_[next].edges) continue;
      on_[next] = LyingOn{next, on_[one] ? on_[one]->on : one, 0};
      equal_.push_back(next);
    }
    std::erase_if(order_, [this](std::uint32_t i) { return on_[i].has_value(); });
  }

  [[nodiscard]] std::vector<LyingOn> result() {
    // A curve equal to one that lies on another lies on that other as well.
    for (const std::uint32_t i : equal_)
      if (const auto& first = on_[on_[i]->on]) on_[i] = LyingOn{i, first->on, first->distance};
    std::vector<LyingOn> found;
    for (const std::optional<LyingOn>& one : on_)
      if (one) found.push_back(*one);
    return found;
  }

  const std::vector<LaidCurve>& curves_;
  double reach_;
  std::vector<std::uint32_t> order_, equal_;
  std::vector<std::optional<LyingOn>> on_;
};

}  // namespace

std::vector<LyingOn> curves_on_others(const std::vector<LaidCurve>& curves, double reach) {
  return Copies(curves, reach).run();
}

std::vector<Overlap> overlapping_ends(const std::vector<LooseEnd>& ends, double reach) {
  const auto point_of = [](const LooseEnd& end) { return end.at_end ? end.line.to : end.line.from; };
  std::vector<Box> boxes;
  for (const LooseEnd& end : ends) boxes.push_back(grown(curve_box(make_curve(end.line)), reach));
  const geom::BoxTree tree(boxes);
  std::vector<bool> taken(ends.size(), false);
  std::vector<Overlap> found;
  std::size_t left = limits::most_meeting_boxes(ends.size());
  for (std::uint32_t i = 0; i < ends.size() && left > 0; ++i) {
    if (taken[i]) continue;
    const Curve a = make_curve(ends[i].line);
    const Point p = point_of(ends[i]);
    std::optional<std::uint32_t> first;
    double distance = 0;
    tree.visit_meeting_while({p, p}, [&](std::uint32_t j) {
      if (--left == 0) return false;
      if (j <= i || taken[j] || (first && *first < j) || ends[i].curve == ends[j].curve) return true;
      const Curve b = make_curve(ends[j].line);
      const Point q = point_of(ends[j]);
      const double far = std::max(norm(p - nearest_on(b, p)), norm(q - nearest_on(a, q)));
      // Each beyond the other's end by a good deal more than they are apart sidewise.
      if (!(far <= reach) || !(norm(p - q) >= 16 * far)) return true;
      const Point other = ends[j].at_end ? b.edge.from : b.edge.to;
      if (!(other == p)) first = j, distance = far;
      return true;
    });
    if (!first) continue;
    taken[i] = taken[*first] = true;
    found.push_back({ends[i].curve, ends[*first].curve, ends[i].at_end, ends[*first].at_end,
                     distance + rounding(grown(curve_box(a), reach))});
  }
  return found;
}

}  // namespace lekalo::io

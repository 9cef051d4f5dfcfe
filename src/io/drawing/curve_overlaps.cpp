#include "curve_overlaps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "arc_middle.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/edge_distance.hpp"

namespace lekalo::io {
namespace {

using geom::Box;
using geom::Curve;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

bool is_line(const Edge& edge) { return edge.kind == EdgeKind::line; }

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
  if (is_line(a) != is_line(b)) return std::nullopt;
  return is_line(a) ? line_on_line(b, make_curve(a), limit) : arc_on_arc(make_curve(b), make_curve(a), limit);
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

std::vector<LyingOn> curves_on_others(const std::vector<LaidCurve>& curves, double reach) {
  std::vector<std::uint32_t> numbers;
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < curves.size(); ++i) {
    if (!curves[i].used) continue;
    numbers.push_back(i);
    boxes.push_back(grown(curves[i].box, reach));
  }
  // The larger curve is kept, because only the smaller one can lie on the other whole; of equal ones the
  // first.
  const auto before = [&](std::uint32_t i, std::uint32_t j) {
    return curves[i].size != curves[j].size ? curves[i].size > curves[j].size : i < j;
  };
  std::vector<LyingOn> found;
  geom::BoxTree(std::move(boxes)).visit_pairs([&](std::uint32_t p, std::uint32_t q) {
    std::uint32_t a = numbers[p], b = numbers[q];
    // Most pairs are neighbours along an outline: the shorter one's box does not fit in the other's.
    if (!before(a, b)) std::swap(a, b);
    // A curve whose copy is a little longer still counts as the copy.
    const Box room = grown(curves[a].box, 2 * reach);
    const Box& box = curves[b].box;
    if (!(box.low.x >= room.low.x && box.low.y >= room.low.y && box.high.x <= room.high.x &&
          box.high.y <= room.high.y))
      return;
    if (const auto far = lies_on(curves[b], curves[a], reach))
      found.push_back({b, a, are_equal(*curves[b].edges, *curves[a].edges) ? 0 : *far + rounding(room)});
  });
  std::sort(found.begin(), found.end(), [&](const LyingOn& s, const LyingOn& t) {
    return s.curve != t.curve ? before(s.curve, t.curve) : before(s.on, t.on);
  });
  std::vector<bool> dropped(curves.size(), false);
  std::vector<LyingOn> result;
  for (const LyingOn& one : found) {
    if (dropped[one.curve] || dropped[one.on]) continue;
    dropped[one.curve] = true;
    result.push_back(one);
  }
  std::sort(result.begin(), result.end(),
            [](const LyingOn& s, const LyingOn& t) { return s.curve < t.curve; });
  return result;
}

std::vector<Overlap> overlapping_ends(const std::vector<LooseEnd>& ends, double reach) {
  std::vector<Box> boxes;
  for (const LooseEnd& end : ends) boxes.push_back(grown(curve_box(make_curve(end.line)), reach));
  std::vector<std::array<std::uint32_t, 2>> pairs;
  geom::BoxTree(std::move(boxes)).visit_pairs([&](std::uint32_t i, std::uint32_t j) {
    if (ends[i].curve != ends[j].curve) pairs.push_back({i, j});
  });
  std::sort(pairs.begin(), pairs.end());
  std::vector<bool> taken(ends.size(), false);
  std::vector<Overlap> found;
  for (const auto& [i, j] : pairs) {
    if (taken[i] || taken[j]) continue;
    const Curve a = make_curve(ends[i].line), b = make_curve(ends[j].line);
    const Point p = ends[i].at_end ? a.edge.to : a.edge.from, q = ends[j].at_end ? b.edge.to : b.edge.from;
    const double far = std::max(norm(p - nearest_on(b, p)), norm(q - nearest_on(a, q)));
    // Each beyond the other's end by a good deal more than they are apart sidewise.
    if (!(far <= reach) || !(norm(p - q) >= 16 * far)) continue;
    const Point other = ends[j].at_end ? b.edge.from : b.edge.to;
    if (other == p) continue;
    taken[i] = taken[j] = true;
    found.push_back({ends[i].curve, ends[j].curve, ends[i].at_end, ends[j].at_end,
                     far + rounding(grown(curve_box(a), reach))});
  }
  return found;
}

}  // namespace lekalo::io

#include "contour_closing.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "arc_middle.hpp"
#include "lekalo/geom/edge_distance.hpp"

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Distances here are rounded by 3 u at most; this factor pays for it.
constexpr double kUp = 1 + 0x1p-50;
/// Arcs on which a moved end would move other points by more than this times as much are halved first.
constexpr double kMostLever = 2;
/// Arcs whose ends are nearer than this many gaps are left alone.
constexpr double kLeastChordInGaps = 4;

bool is_line(const Edge& edge) { return edge.kind == EdgeKind::line; }

/// Returns the most that any point of an arc moves when one end moves by 1 and the other stays, and a
/// similarity map takes every point along: the distance of the farthest point from the staying end over the
/// chord.
double lever(const Edge& arc) {
  const geom::Curve curve = make_curve(arc);
  return curve.wide ? 2 * curve.radius / norm(arc.to - arc.from) * kUp : 1;
}

/// Returns the arc under the similarity map that takes its ends to `from` and `to`.
Edge pulled(const Edge& arc, Point from, Point to) {
  const Point before = arc.to - arc.from, after = to - from, out = arc.centre - arc.from;
  const double squared = dot(before, before);
  // The centre keeps its place in the chord's frame.
  const double along = dot(out, before) / squared, aside = cross(before, out) / squared;
  return {arc.kind, from, to, from + along * after + aside * perpendicular(after)};
}

/// Says whether an end of the arc may move so far.
bool may_pull(const Edge& arc, double far) { return norm(arc.to - arc.from) >= kLeastChordInGaps * far; }
/// The rounding of the new centre: a few units of its distances, as kEdgeDistanceError.
double rounding_of_pulled(const Edge& arc) {
  return geom::kEdgeDistanceError * (norm(arc.centre) + 2 * geom::arc_radius(arc));
}

class GapCloser {
 public:
  explicit GapCloser(LooseContour& contour) : contour_(contour) {
    moved_.resize(contour.edges.size(), 0);
    halve_wide_arcs();
    line_after_.resize(contour.edges.size(), false);
  }

  Closing run() {
    const std::size_t n = contour_.edges.size();
    for (std::size_t i = 0; i < n; ++i) close(i, after(i));
    for (std::size_t i = 0; i < n; ++i)
      if (moved_[i] > 0) closing_.moved.push_back({contour_.curves[i], moved_[i]});
    rebuild();
    return std::move(closing_);
  }

 private:
  [[nodiscard]] std::size_t after(std::size_t i) const { return i + 1 == contour_.edges.size() ? 0 : i + 1; }

  /// Splits wide arcs where they meet an arc across a gap, so that only the half near it has to move.
  void halve_wide_arcs() {
    const geom::Contour& edges = contour_.edges;
    std::vector<bool> halved(edges.size(), false);
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const std::size_t next = after(i);
      if (edges[i].to == edges[next].from || is_line(edges[i]) || is_line(edges[next])) continue;
      for (const std::size_t k : {i, next})
        if (lever(edges[k]) > kMostLever) halved[k] = true;
    }
    if (std::find(halved.begin(), halved.end(), true) == halved.end()) return;
    LooseContour made;
    moved_.clear();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      // The halves' mean radii lie between those of the ends.
      const Edge& edge = edges[i];
      const double steps =
          halved[i] ? std::abs(norm(edge.from - edge.centre) - norm(edge.to - edge.centre)) : 0;
      moved_.resize(moved_.size() + (halved[i] ? 2 : 1), steps);
      made.edges.push_back(edge);
      made.curves.resize(made.edges.size() + (halved[i] ? 1 : 0), contour_.curves[i]);
      if (!halved[i]) continue;
      Edge second = edges[i];
      made.edges.back().to = second.from = middle_of(make_curve(edges[i]));
      made.edges.push_back(second);
    }
    contour_ = std::move(made);
  }

  void close(std::size_t i, std::size_t next) {
    Edge &a = contour_.edges[i], &b = contour_.edges[next];
    const Point p = a.to, q = b.from;
    if (p == q) return;
    const ClosedGap gap{0.5 * (p + q), norm(q - p) * kUp, contour_.curves[i], contour_.curves[next]};
    const double to_middle = std::max(norm(gap.at - p), norm(gap.at - q)) * kUp;
    // Points of a line move by no more than its ends do, whatever the other end does.
    if (is_line(a) && is_line(b)) {
      a.to = b.from = gap.at;
      moved_[i] = std::max(moved_[i], to_middle);
      moved_[next] = std::max(moved_[next], to_middle);
    } else if (is_line(a)) {
      a.to = q;
      moved_[i] = std::max(moved_[i], gap.size);
    } else if (is_line(b)) {
      b.from = p;
      moved_[next] = std::max(moved_[next], gap.size);
    } else if (i != next && may_pull(a, gap.size) && may_pull(b, gap.size)) {
      moved_[i] += lever(a) * to_middle + rounding_of_pulled(a);
      moved_[next] += lever(b) * to_middle + rounding_of_pulled(b);
      a = pulled(a, a.from, gap.at);
      b = pulled(b, gap.at, b.to);
    } else {
      line_after_[i] = true;
      moved_[i] = std::max(moved_[i], to_middle);
    }
    closing_.gaps.push_back(gap);
  }

  void rebuild() {
    LooseContour made;
    for (std::size_t i = 0; i < contour_.edges.size(); ++i) {
      const Edge& edge = contour_.edges[i];
      if (!is_line(edge) || edge.from != edge.to) {
        made.edges.push_back(edge);
        made.curves.push_back(contour_.curves[i]);
      }
      if (!line_after_[i]) continue;
      const Point next = contour_.edges[after(i)].from;
      made.edges.push_back({EdgeKind::line, edge.to, next, {}});
      made.curves.push_back(contour_.curves[i]);
    }
    contour_ = std::move(made);
  }

  LooseContour& contour_;
  std::vector<double> moved_;  ///< by edge
  std::vector<bool> line_after_;
  Closing closing_;
};

}  // namespace

std::optional<double> move_end(Edge& edge, bool at_end, Point to) {
  const double far = norm(to - (at_end ? edge.to : edge.from)) * kUp;
  if (!is_line(edge)) {
    if (!may_pull(edge, far) || edge.from == edge.to) return std::nullopt;
    const double moved = lever(edge) * far + rounding_of_pulled(edge);
    edge = at_end ? pulled(edge, edge.from, to) : pulled(edge, to, edge.to);
    return moved;
  }
  (at_end ? edge.to : edge.from) = to;
  return far;
}

Closing close_gaps(LooseContour& contour) { return GapCloser(contour).run(); }

}  // namespace lekalo::io

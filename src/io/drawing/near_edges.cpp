#include "near_edges.hpp"

#include <algorithm>

#include "arc_middle.hpp"

namespace lekalo::io {
namespace {

using geom::Box;
using geom::Curve;
using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Parts of an edge are halved until they are this share of the limit long.
constexpr double kFinest = 1.0 / 1024;

std::vector<Box> boxes_of(const std::vector<Curve>& curves) {
  std::vector<Box> boxes;
  for (const Curve& curve : curves) boxes.push_back(curve_box(curve));
  return boxes;
}

std::vector<Curve> curves_of(const std::vector<Edge>& edges) {
  std::vector<Curve> curves;
  for (const Edge& edge : edges) curves.push_back(geom::make_curve(edge));
  return curves;
}

}  // namespace

Bisected bisected(const Edge& edge) {
  Bisected halves{edge, edge, {}, 0};
  if (edge.kind == EdgeKind::line) {
    halves.middle = 0.5 * (edge.from + edge.to);
    halves.half_length = 0.5 * norm(edge.to - edge.from);
  } else {
    const Curve curve = geom::make_curve(edge);
    halves.middle = curve.full ? edge.centre - (edge.from - edge.centre) : middle_of(curve);
    // An arc of up to half a turn is at most pi / 2 times as long as its chord.
    halves.half_length = 1.6 * std::max(norm(halves.middle - edge.from), norm(halves.middle - edge.to));
  }
  halves.first.to = halves.second.from = halves.middle;
  return halves;
}

NearEdges::NearEdges(const std::vector<Edge>& edges) : curves_(curves_of(edges)), tree_(boxes_of(curves_)) {}

std::optional<double> NearEdges::distance(Point p, double limit) const {
  std::optional<double> least;
  tree_.visit_meeting(geom::grown({p, p}, limit), [&](std::uint32_t i) {
    const double far = norm(nearest_on(curves_[i], p) - p);
    if (far <= limit && (!least || far < *least)) least = far;
  });
  return least;
}

std::optional<double> NearEdges::farthest(const Edge& edge, double limit, std::size_t& work) const {
  double largest = 0;
  std::vector<Edge> open{edge};
  while (!open.empty()) {
    if (work == 0) return std::nullopt;
    --work;
    ask();
    const Edge part = open.back();
    open.pop_back();
    const Bisected halves = bisected(part);
    const auto middle = distance(halves.middle, limit);
    if (!middle) return std::nullopt;
    double bound = *middle + halves.half_length;
    if (part.kind == EdgeKind::line) {
      // A line is nowhere farther from another than at its ends.
      tree_.visit_meeting(geom::grown({halves.middle, halves.middle}, limit), [&](std::uint32_t i) {
        if (curves_[i].edge.kind != EdgeKind::line) return;
        bound = std::min(bound, std::max(norm(nearest_on(curves_[i], part.from) - part.from),
                                         norm(nearest_on(curves_[i], part.to) - part.to)));
      });
    }
    if (bound <= largest) continue;
    const bool fine = halves.half_length <= limit * kFinest || !(halves.half_length > 0);
    if (bound <= *middle + limit * kFinest || fine) {
      if (!(bound <= limit)) return std::nullopt;
      largest = std::max(largest, bound);
      continue;
    }
    open.push_back(halves.first);
    open.push_back(halves.second);
  }
  return largest;
}

}  // namespace lekalo::io

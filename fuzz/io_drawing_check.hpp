#pragma once

#include <cmath>

#include "io/drawing/drawn_shapes.hpp"
#include "io_contour_check.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/io/drawing/drawing.hpp"

// What holds of every drawing that a reader gives: every number and index in it is sound.

namespace lekalo::fuzz {
inline bool in_range(geom::Point p) {
  return std::max(std::abs(p.x), std::abs(p.y)) <= io::kLargestMillimetres && geom::is_exact(p);
}

inline void check_edge(const geom::Edge& edge) {
  must(in_range(edge.from) && in_range(edge.to));
  if (edge.kind == geom::EdgeKind::line) {
    must(edge.from != edge.to);
    return;
  }
  must(geom::is_exact(edge.centre) && edge.from != edge.centre && edge.to != edge.centre);
  const double a = geom::norm(edge.from - edge.centre), b = geom::norm(edge.to - edge.centre);
  must(std::abs(a - b) <= geom::kArcConsistency + geom::kArcConsistencyRelative * std::max(a, b));
}

inline void check_ellipse(const io::EllipseArc& arc) {
  must(in_range(arc.from) && in_range(arc.to) && in_range(arc.centre) && in_range(arc.u) && in_range(arc.v));
  must(geom::cross(arc.u, arc.v) != 0);
  must(arc.begin < arc.end && arc.end <= arc.begin + 2 * kPi && std::abs(arc.begin) <= 100);
}

inline void check_spline(const io::Spline& spline) {
  const std::size_t p = spline.degree, n = spline.poles.size();
  must(p >= 1 && p <= io::kHighestDegree && n > p && spline.knots.size() == n + p + 1);
  must(std::is_sorted(spline.knots.begin(), spline.knots.end()) && spline.knots[p] < spline.knots[n]);
  must(std::all_of(spline.poles.begin(), spline.poles.end(), in_range));
  must(std::all_of(spline.knots.begin(), spline.knots.end(), [](double k) { return std::isfinite(k); }));
  must(spline.weights.empty() || spline.weights.size() == n);
  must(std::all_of(spline.weights.begin(), spline.weights.end(), [](double w) { return w > 0 && w <= 1e9; }));
}

inline void check_drawing(const io::Drawing& drawing) {
  must(drawing.curves.size() <= io::kMostCurves && drawing.millimetres_per_unit > 0);
  std::vector<bool> layer_used(drawing.layers.size()), entity_used(drawing.entities.size());
  for (const io::DrawnCurve& curve : drawing.curves) {
    must(curve.layer < layer_used.size() && curve.entity < entity_used.size());
    layer_used[curve.layer] = entity_used[curve.entity] = true;
    must(curve.error >= 0 && std::isfinite(curve.error));
    if (const auto* edge = std::get_if<geom::Edge>(&curve.shape)) check_edge(*edge);
    if (const auto* arc = std::get_if<io::EllipseArc>(&curve.shape)) check_ellipse(*arc);
    if (const auto* spline = std::get_if<io::Spline>(&curve.shape)) check_spline(*spline);
  }
  must(std::all_of(layer_used.begin(), layer_used.end(), [](bool used) { return used; }));
  must(std::all_of(entity_used.begin(), entity_used.end(), [](bool used) { return used; }));
  for (const io::Unread& unread : drawing.unread)
    must(unread.count > 0 && unread.line > 0 && !unread.name.empty());
  must(std::is_sorted(drawing.unread.begin(), drawing.unread.end(),
                      [](const io::Unread& a, const io::Unread& b) { return a.name < b.name; }));
}

}  // namespace lekalo::fuzz

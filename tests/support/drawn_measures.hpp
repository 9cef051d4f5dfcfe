#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "lekalo/geom/region.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::cases {

/// Length of a curve and the area it sweeps as seen from the origin, by quadrature (about 1e-13 relative):
/// none of the library's code for curves.
struct DrawnMeasures {
  double length = 0, area = 0;
};

namespace drawn_detail {

struct PointAndSlope {
  geom::Point at, slope;
};

/// A B-spline of one span (a Bezier curve), by de Casteljau.
inline PointAndSlope bezier_at(const io::Spline& s, double t) {
  std::vector<geom::Point> p = s.poles;
  while (p.size() > 2) {
    for (std::size_t i = 0; i + 1 < p.size(); ++i) p[i] = (1 - t) * p[i] + t * p[i + 1];
    p.pop_back();
  }
  return {(1 - t) * p[0] + t * p[1], static_cast<double>(s.degree) * (p[1] - p[0])};
}

inline PointAndSlope arc_at(const geom::Point centre, const geom::Point u, const geom::Point v, double begin,
                            double sweep, double t) {
  const double a = begin + t * sweep, c = std::cos(a), s = std::sin(a);
  return {centre + (c * u + s * v), sweep * (c * v - s * u)};
}

inline PointAndSlope at(const io::Shape& shape, double t) {
  if (const auto* spline = std::get_if<io::Spline>(&shape)) return bezier_at(*spline, t);
  if (const auto* arc = std::get_if<io::EllipseArc>(&shape))
    return arc_at(arc->centre, arc->u, arc->v, arc->begin, arc->end - arc->begin, t);
  const geom::Edge& e = std::get<geom::Edge>(shape);
  if (e.kind == geom::EdgeKind::line) return {e.from + t * (e.to - e.from), e.to - e.from};
  const geom::Point d = e.from - e.centre, f = e.to - e.centre;
  const double radius = 0.5 * (norm(d) + norm(f)), begin = std::atan2(d.y, d.x);
  const double turn = 2 * 3.14159265358979323846;
  const bool ccw = e.kind == geom::EdgeKind::arc_ccw;
  double sweep = std::atan2(cross(d, f), dot(d, f));
  if (e.from == e.to)
    sweep = ccw ? turn : -turn;
  else if (ccw && sweep < 0)
    sweep += turn;
  else if (!ccw && sweep > 0)
    sweep -= turn;
  return arc_at(e.centre, {radius, 0}, {0, radius}, begin, sweep, t);
}

}  // namespace drawn_detail

namespace drawn_detail {

/// Gauss and Legendre, 8 points, over [low, high].
inline DrawnMeasures gauss(const io::Shape& shape, double low, double high) {
  constexpr std::array<double, 4> kNodes{0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                                         0.9602898564975363};
  constexpr std::array<double, 4> kWeights{0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                                           0.1012285362903763};
  DrawnMeasures sum;
  for (std::size_t i = 0; i < 8; ++i) {
    const double node = (i < 4 ? 1 : -1) * kNodes[i % 4];
    const auto [p, d] = at(shape, 0.5 * (low + high) + 0.5 * (high - low) * node);
    sum.length += kWeights[i % 4] * norm(d) * (high - low) / 2;
    sum.area += kWeights[i % 4] * cross(p, d) * (high - low) / 4;
  }
  return sum;
}

/// Halved until that changes nothing: Bezier curves may have a cusp, or nearly one.
inline DrawnMeasures halved(const io::Shape& shape, double low, double high, int depth) {
  const DrawnMeasures whole = gauss(shape, low, high);
  const double middle = 0.5 * (low + high);
  DrawnMeasures left = gauss(shape, low, middle), right = gauss(shape, middle, high);
  const bool settled = std::abs(left.length + right.length - whole.length) < 1e-13 * (1 + whole.length);
  if (depth < 3 || (!settled && depth < 30)) {
    left = halved(shape, low, middle, depth + 1);
    right = halved(shape, middle, high, depth + 1);
  }
  return {left.length + right.length, left.area + right.area};
}

}  // namespace drawn_detail

inline DrawnMeasures measure(const io::Shape& shape) { return drawn_detail::halved(shape, 0, 1, 0); }

inline geom::Point first_of(const io::Shape& shape) { return drawn_detail::at(shape, 0).at; }
inline geom::Point last_of(const io::Shape& shape) { return drawn_detail::at(shape, 1).at; }

}  // namespace lekalo::cases

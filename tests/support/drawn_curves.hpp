#pragma once

// Points and integrals of the curves of a drawing, in the plainest way; tests compare others' figures with
// them.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::drawn {

/// A value and its derivative.
struct Dual {
  double v = 0, d = 0;
  friend Dual operator+(Dual a, Dual b) { return {a.v + b.v, a.d + b.d}; }
  friend Dual operator-(Dual a, Dual b) { return {a.v - b.v, a.d - b.d}; }
  friend Dual operator*(Dual a, Dual b) { return {a.v * b.v, a.v * b.d + a.d * b.v}; }
  friend Dual operator/(Dual a, Dual b) { return {a.v / b.v, (a.d * b.v - a.v * b.d) / (b.v * b.v)}; }
};
struct DualPoint {
  Dual x, y;
};

/// A smooth piece of a curve: parameters and how finely to integrate.
struct Piece {
  double begin = 0, end = 0;
  int parts = 1;
};

inline DualPoint on_circle(const geom::Edge& arc, double angle) {
  const double r = geom::arc_radius(arc), s = arc.kind == geom::EdgeKind::arc_ccw ? 1 : -1;
  return {{arc.centre.x + r * std::cos(angle), -s * r * std::sin(angle)},
          {arc.centre.y + r * std::sin(angle), s * r * std::cos(angle)}};
}

inline DualPoint on_spline(const io::Spline& spline, double t, std::size_t span) {
  const std::size_t p = spline.degree;
  std::vector<std::array<Dual, 3>> d(p + 1);
  for (std::size_t j = 0; j <= p; ++j) {
    const std::size_t i = span - p + j;
    const double w = spline.weights.empty() ? 1 : spline.weights[i];
    d[j] = {Dual{w * spline.poles[i].x}, Dual{w * spline.poles[i].y}, Dual{w}};
  }
  const Dual u{t, 1};
  for (std::size_t r = 1; r <= p; ++r) {
    for (std::size_t j = p; j >= r; --j) {
      const double low = spline.knots[span - p + j], high = spline.knots[span + 1 + j - r];
      const Dual a = (u - Dual{low}) / Dual{high - low}, b = Dual{1} - a;
      for (std::size_t k = 0; k < 3; ++k) d[j][k] = b * d[j - 1][k] + a * d[j][k];
    }
  }
  return {d[p][0] / d[p][2], d[p][1] / d[p][2]};
}

/// Calls f(point, weight of the parameter) at the nodes of Gauss's rule on every smooth piece of a shape.
template <class F>
void integrate(const io::Shape& shape, F&& f) {
  static constexpr std::pair<double, double> kGauss[] = {{0.1834346424956498, 0.3626837833783620},
                                                         {0.5255324099163290, 0.3137066458778873},
                                                         {0.7966664774136267, 0.2223810344533745},
                                                         {0.9602898564975363, 0.1012285362903763}};
  const auto over = [&](Piece piece, auto&& point) {
    const double step = (piece.end - piece.begin) / piece.parts;
    for (int k = 0; k < piece.parts; ++k) {
      const double middle = piece.begin + (k + 0.5) * step, half = step / 2;
      for (const auto& [node, weight] : kGauss) {
        f(point(middle - node * half), weight * half);
        f(point(middle + node * half), weight * half);
      }
    }
  };
  if (const auto* edge = std::get_if<geom::Edge>(&shape)) {
    if (edge->kind == geom::EdgeKind::line) {
      const geom::Point a = edge->from, step = edge->to - a;
      over({0, 1, 1}, [&](double t) {
        return DualPoint{{a.x + t * step.x, step.x}, {a.y + t * step.y, step.y}};
      });
      return;
    }
    const double s = edge->kind == geom::EdgeKind::arc_ccw ? 1 : -1;
    const geom::Point p = edge->from - edge->centre, q = edge->to - edge->centre;
    const double begin = std::atan2(p.y, p.x);
    double sweep = s * (std::atan2(q.y, q.x) - begin);
    while (sweep <= 0) sweep += 2 * M_PI;
    while (sweep > 2 * M_PI) sweep -= 2 * M_PI;
    if (edge->from == edge->to) sweep = 2 * M_PI;
    over({0, sweep, 12}, [&](double t) { return on_circle(*edge, begin + s * t); });
  } else if (const auto* arc = std::get_if<io::EllipseArc>(&shape)) {
    over({arc->begin, arc->end, 64}, [&](double t) {
      const double c = std::cos(t), s = std::sin(t);
      return DualPoint{{arc->centre.x + c * arc->u.x + s * arc->v.x, c * arc->v.x - s * arc->u.x},
                       {arc->centre.y + c * arc->u.y + s * arc->v.y, c * arc->v.y - s * arc->u.y}};
    });
  } else {
    const auto& spline = std::get<io::Spline>(shape);
    for (std::size_t span = spline.degree; span < spline.poles.size(); ++span) {
      if (!(spline.knots[span] < spline.knots[span + 1])) continue;
      over({spline.knots[span], spline.knots[span + 1], 4},
           [&](double t) { return on_spline(spline, t, span); });
    }
  }
}

/// Length, integrals of x and y along the curve, and of (x dy - y dx) / 2.
struct Integrals {
  double length = 0, x = 0, y = 0, area = 0;
};
inline Integrals integrals(const io::Shape& shape) {
  Integrals total;
  integrate(shape, [&](DualPoint p, double weight) {
    const double speed = std::hypot(p.x.d, p.y.d) * weight;
    total.length += speed;
    total.x += p.x.v * speed;
    total.y += p.y.v * speed;
    total.area += (p.x.v * p.y.d - p.y.v * p.x.d) / 2 * weight;
  });
  return total;
}

/// Corners of the box of the nodes and ends; inside of the exact one.
inline std::array<double, 4> box(const io::Shape& shape) {
  std::array<double, 4> box{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  const auto include = [&](double x, double y) {
    box = {std::min(box[0], x), std::min(box[1], y), std::max(box[2], x), std::max(box[3], y)};
  };
  integrate(shape, [&](DualPoint p, double) { include(p.x.v, p.y.v); });
  if (const auto* edge = std::get_if<geom::Edge>(&shape)) {
    include(edge->from.x, edge->from.y);
    include(edge->to.x, edge->to.y);
  }
  return box;
}

}  // namespace lekalo::drawn

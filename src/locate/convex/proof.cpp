#include "proof.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lekalo::locate {
namespace {

using geom::Point;

struct Line {
  Point from, to;
};

}  // namespace

double proved_bound(const Basis& basis, const Angle& from, const Angle& to, const geom::Ring& part,
                    const geom::Ring& blank, const Uncertainty& uncertainty) {
  std::array<Line, 3> line;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t k = basis.edge[j];
    line[j] = {blank[k], blank[k + 1 == blank.size() ? 0 : k + 1]};
  }

  // With the exact multipliers m_j the bound is sum m_j chi_j for any shift t, chi_j = n_j . (R v_j + t -
  // a_j). We have lambda_j with |m_j - lambda_j| <= eta and sum m_j = 1 = sum lambda_j (to rounding), so for
  // any number c
  //   sum m_j chi_j <= sum lambda_j chi_j + 3 eta max |chi_j - c|,
  // which is taken at the shift where all three are about c. Far from it |chi_j - c| grows by |v_j| per
  // radian. Two edges that are opposite but for rounding leave the third with a multiplier near 0 that may in
  // truth be -eta. Then its distance, at most the size of the blank, weighs that much in the other direction.
  const double half_width = 0.5 * (to.theta - from.theta);
  const Angle middle = Angle::of(from.theta + half_width);
  const double c = middle.direction.cosine, s = middle.direction.sine;
  std::array<Point, 3> normal;
  std::array<double, 3> open{};
  double furthest = 0, lever = 1, shortest = std::numeric_limits<double>::infinity();
  const double reach = uncertainty.scale + norm(basis.shift);
  for (std::size_t j = 0; j < 3; ++j) {
    const Point v = part[basis.vertex[j]];
    const Point edge = line[j].to - line[j].from;
    const double length = norm(edge);
    normal[j] = {-edge.y / length, edge.x / length};
    const Point p = Point{c * v.x - s * v.y, s * v.x + c * v.y} + basis.shift - line[j].from;
    const double sweep = norm(v) * half_width;
    open[j] = dot(normal[j], p);
    furthest = std::max(furthest, sweep);
    shortest = std::min(shortest, length);
    // When the ends of the edge are off by e, its line moves at this point by e (|1 - tau| + |tau|), where
    // tau is the place along the edge.
    const double tau = dot(edge, p) / (length * length), drift = sweep / length;
    lever = std::max(lever, std::abs(1 - tau) + std::abs(tau) + 2 * drift);
  }
  const double spread =
      std::max({open[0], open[1], open[2]}) - std::min({open[0], open[1], open[2]}) + furthest;
  const double sum = cross(normal[1], normal[2]) + cross(normal[2], normal[0]) + cross(normal[0], normal[1]);
  // All three edges are parallel, so they are no basis.
  if (!(sum > 1e-12)) return std::numeric_limits<double>::infinity();
  // Three weights, each within 6 u, are divided by their sum.
  const double eta = 32 * kUnit / sum;
  // The term 32 u reach is for the sinusoid. Its coefficients are sums of three products of numbers up to
  // `reach`, within 12 u of them, and its largest value is within 8 u more. The sinusoid leaves the shift
  // out, because sum m_j n_j = 0; with the lambdas a rest stays.
  const Point rest = basis.lambda[0] * normal[0] + basis.lambda[1] * normal[1] + basis.lambda[2] * normal[2];
  double rounding = 32 * kUnit * reach + std::abs(dot(rest, basis.shift)) + 3 * eta * spread;
  // An edge whose ends are off by e turns by up to 2 sqrt(2) e / length, and so do the weights that it
  // enters.
  const double doubt = eta + 8 * uncertainty.blank / (shortest * sum);
  const double least = std::min({basis.lambda[0], basis.lambda[1], basis.lambda[2]});
  if (least < doubt) rounding += (doubt + std::max(0.0, -least)) * 8 * reach;
  // The diagonal of a unit square, because both coordinates may be off.
  constexpr double kDiagonal = 1.4142135623730952;
  const double shapes = kDiagonal * (uncertainty.part + uncertainty.blank * (lever + 1));
  return max_over(basis.bound, from, to) + rounding + shapes;
}

}  // namespace lekalo::locate

#include "proof.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/geom/predicates.hpp"

namespace lekalo::locate {
namespace {

using geom::Point;

constexpr double kUnit = 0x1p-53;

struct Line {
  Point from, to;
};

/// Whether the normals of three directed lines span the plane positively: no two neighbours turn by more than
/// a half turn, and they do not all lie in one half-plane. Exact for the doubles given.
bool span_positively(const std::array<Line, 3>& line) {
  int positive = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const Line &a = line[j], &b = line[(j + 1) % 3];
    const int sign = geom::turn(a.from, a.to, b.from, b.to);
    if (sign < 0) return false;
    positive += sign;
  }
  return positive >= 2;  // one of the three may be an opposite pair
}

}  // namespace

double proved_bound(const Basis& basis, const Angle& from, const Angle& to, const geom::Ring& part,
                    const geom::Ring& blank, const Uncertainty& uncertainty) {
  std::array<Line, 3> line;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t k = basis.edge[j];
    line[j] = {blank[k], blank[k + 1 == blank.size() ? 0 : k + 1]};
  }
  if (!span_positively(line)) return std::numeric_limits<double>::infinity();

  // With the exact multipliers m_j the bound is sum m_j chi_j for any shift t, chi_j = n_j . (R v_j + t -
  // a_j). We have lambda_j with |m_j - lambda_j| <= eta and sum m_j = 1 = sum lambda_j (to rounding), so for
  // any number c
  //   sum m_j chi_j <= sum lambda_j chi_j + 3 eta max |chi_j - c|,
  // taken at the shift where all three are about c. Far from it |chi_j - c| grows by |v_j| per radian.
  const double half_width = 0.5 * (to.theta - from.theta);
  const Angle middle = Angle::of(from.theta + half_width);
  const double c = middle.direction.cosine, s = middle.direction.sine;
  std::array<Point, 3> normal;
  std::array<double, 3> open{};
  double furthest = 0, lever = 1, reach = uncertainty.scale + norm(basis.shift);
  for (std::size_t j = 0; j < 3; ++j) {
    const Point v = part[basis.vertex[j]];
    const Point edge = line[j].to - line[j].from;
    const double length = norm(edge);
    normal[j] = {-edge.y / length, edge.x / length};
    const Point p = Point{c * v.x - s * v.y, s * v.x + c * v.y} + basis.shift - line[j].from;
    const double sweep = norm(v) * half_width;
    open[j] = dot(normal[j], p);
    furthest = std::max(furthest, sweep);
    // Ends of the edge off by e move its line at this point by e (|1 - tau| + |tau|), tau the place along the
    // edge.
    const double tau = dot(edge, p) / (length * length), drift = sweep / length;
    lever = std::max(lever, std::abs(1 - tau) + std::abs(tau) + 2 * drift);
  }
  const double spread =
      std::max({open[0], open[1], open[2]}) - std::min({open[0], open[1], open[2]}) + furthest;
  const double sum = cross(normal[1], normal[2]) + cross(normal[2], normal[0]) + cross(normal[0], normal[1]);
  const double eta = 32 * kUnit / sum;  // three weights, each within 6 u, and their sum, divided
  // 64 u reach: the sinusoid's coefficients (sums of three products of numbers up to `reach`) and its largest
  // value.
  const double rounding = 64 * kUnit * reach + 3 * eta * spread;
  constexpr double kDiagonal = 1.4142135623730952;  // of a unit square: both coordinates may be off
  const double shapes = kDiagonal * (uncertainty.part + uncertainty.blank * (lever + 1));
  return max_over(basis.bound, from, to) + rounding + shapes;
}

}  // namespace lekalo::locate

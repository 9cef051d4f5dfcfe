#include "cover_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/number/interval.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

double magnitude(Span a) { return absolute(a).high; }

}  // namespace

/// Bounds the weighted sum of the balls' distances over a cell. Let w be the vector between two balls'
/// centres at the cell's middle, u = w / |w|, and p the part's centre counted from the pivot. At a pose that
/// is off the middle by s in q and by phi in theta the vector is w + s + (R(phi) - 1) p, and
///   |w + d| <= u . (w + d) + |d across u|^2 / (2 u . (w + d))        (from sqrt(a^2 + b^2) <= a + b^2 / 2a)
///   (R(phi) - 1) p = phi J p + rest, |rest| <= phi^2 / 2 |p|,
///   u . rest <= phi^2 / 2 max(0, -u . p) + |phi|^3 / 6 |p|.
/// The terms linear in s and phi are summed over the balls before their largest value is taken.
CellBound bound_over(const PoseCell& cell, const std::vector<BallTerm>& terms) {
  std::array<double, 3> middle, half;
  for (std::size_t k = 0; k < 3; ++k) {
    middle[k] = cell.low[k] + 0.5 * (cell.high[k] - cell.low[k]);
    half[k] = step_up(std::max(cell.high[k] - middle[k], middle[k] - cell.low[k]));
  }
  const Turn turn = turn_by(Interval::exactly(middle[0], 80));
  const Span c{turn.cosine.low_double(), turn.cosine.high_double()},
      s{turn.sine.low_double(), turn.sine.high_double()};
  const Span h = just(half[0]);
  Span sum{0, 0}, middle_value{0, 0}, level{0, 0}, gx{0, 0}, gy{0, 0}, gt{0, 0};
  double floor = -kInfinity;
  for (const BallTerm& term : terms) {
    const Span m = term.multiplier;
    sum = sum + m;
    const Vec p{c * term.part.x - s * term.part.y, s * term.part.x + c * term.part.y};
    const Vec w{plus(p.x, middle[1]) - term.blank.x, plus(p.y, middle[2]) - term.blank.y};
    const Span apart = length(w), far = length(p);
    const Span radii = just(term.part_radius) + just(term.blank_radius);
    if (!term.capped) floor = std::max(floor, -term.blank_radius);
    middle_value = middle_value + m * (apart - radii);
    // However the pose moves within the cell, the part's centre moves no further than this.
    const Span slide = length({just(half[1]), just(half[2])});
    const Span anyway = slide + far * h;
    // If the centres may meet, u may be any number, and the curved bound is infinite.
    const Vec u{w.x / apart, w.y / apart};
    const Span lever = cross(p, u), along_p = dot(u, p), rest = just(0.5) * h * h * far;
    const double ux = magnitude(u.x), uy = magnitude(u.y);
    const Span along =
        just(ux) * just(half[1]) + just(uy) * just(half[2]) + just(magnitude(lever)) * h + rest;
    const Span across =
        just(uy) * just(half[1]) + just(ux) * just(half[2]) + just(magnitude(along_p)) * h + rest;
    const Span left = apart - along;
    const double inwards = std::max(0.0, -along_p.low);
    const Span curved =
        across * across / (left + left) + just(0.5) * h * h * just(inwards) + h * h * h * far / just(6);
    if (curved.high < anyway.high) {
      level = level + m * (apart - radii + curved);
      gx = gx + m * u.x, gy = gy + m * u.y, gt = gt + m * lever;
    } else {
      level = level + m * (apart - radii + anyway);
    }
  }
  const Span linear =
      just(magnitude(gx)) * just(half[1]) + just(magnitude(gy)) * just(half[2]) + just(magnitude(gt)) * h;
  return {std::max(((level + linear) / sum).high, floor), std::max((middle_value / sum).low, floor)};
}

}  // namespace lekalo::verify

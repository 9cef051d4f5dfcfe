// The bound of a cell of a certificate for regions against the pairs' values at poses of the cell.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"
#include "verify/locate/cover_bound.hpp"

namespace lekalo::verify::verify_cover_bound_test {
namespace {

struct Pair {
  long double px, py, cx, cy, r, s, m;
};

/// max(sum of multiplier x distance, least of what balls of the blank allow) at a pose.
long double value_at(const std::vector<Pair>& pairs, long double theta, long double x, long double y) {
  long double sum = 0, weight = 0, floor = -1e30L;
  for (const Pair& p : pairs) {
    const long double c = std::cos(theta), s = std::sin(theta);
    sum += p.m * (std::hypot(c * p.px - s * p.py + x - p.cx, s * p.px + c * p.py + y - p.cy) - p.r - p.s);
    weight += p.m;
    floor = std::max(floor, -p.s);
  }
  return std::max(sum / weight, floor);
}

TEST(CoverBound, HoldsEverywhereAndIsOfSecondOrder) {
  const std::size_t count = cases::case_count(3000);
  double loosest = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 70 + i);
    const double size = std::pow(10.0, -random.uniform(0, 4));
    PoseCell cell{};
    for (int k = 0; k < 3; ++k) {
      const double middle = random.uniform(-3, 3), half = size * random.uniform(0, k == 0 ? 0.1 : 1);
      cell.low[k] = middle - half, cell.high[k] = middle + half;
    }
    std::vector<Pair> pairs;
    std::vector<BallTerm> terms;
    const std::size_t n = 1 + random.below(4);
    for (std::size_t k = 0; k < n; ++k) {
      // A part ball about as far from the blank's as levers are long; some on the far side of the pivot.
      Pair p{random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-40, 40),
             random.uniform(-40, 40), random.uniform(0, 5),    random.uniform(0, 5),
             random.uniform(0.01, 1)};
      if (random.below(3) == 0) p.s = p.s + 1000, p.cx = p.cx + 1000;
      pairs.push_back(p);
      BallTerm term;
      const auto exactly = [](long double v) { return just(static_cast<double>(v)); };
      term.part = {exactly(p.px), exactly(p.py)}, term.blank = {exactly(p.cx), exactly(p.cy)};
      term.part_radius = static_cast<double>(p.r), term.blank_radius = static_cast<double>(p.s);
      term.multiplier = exactly(p.m);
      p = {term.part.x.low,  term.part.y.low,   term.blank.x.low,   term.blank.y.low,
           term.part_radius, term.blank_radius, term.multiplier.low};
      pairs.back() = p;
      terms.push_back(term);
    }
    const CellBound bound = bound_over(cell, terms);
    const auto at = [&](int k, double share) { return cell.low[k] + share * (cell.high[k] - cell.low[k]); };
    long double most = -1e30L;
    for (int k = 0; k < 8; ++k)
      most = std::max(most, value_at(pairs, at(0, k & 1), at(1, k >> 1 & 1), at(2, k >> 2)));
    for (int k = 0; k < 60; ++k)
      most = std::max(most, value_at(pairs, at(0, random.uniform(0, 1)), at(1, random.uniform(0, 1)),
                                     at(2, random.uniform(0, 1))));
    bool apart = true;  // what is of second order is divided by the distance
    for (const Pair& p : pairs)
      apart = apart && value_at({p}, at(0, 0.5), at(1, 0.5), at(2, 0.5)) + p.r + p.s > 10;
    SCOPED_TRACE(fmt::format("case {} seed {} size {}", i, cases::seed(), size));
    ASSERT_GE(bound.everywhere, most - 1e-13L);
    ASSERT_NEAR(bound.in_the_middle, static_cast<double>(value_at(pairs, at(0, 0.5), at(1, 0.5), at(2, 0.5))),
                1e-11);
    // No more above than what is of second order in the cell: sizes are up to 1 mm and 0.1 rad at 43 mm.
    if (size < 0.01)
      loosest = std::max(loosest, static_cast<double>(bound.everywhere - most) / (size * size));
  }
  // Across: (1.4 + 4.3)^2 / 20; turning: 0.1^2 43 / 2.
  EXPECT_LT(loosest, 4) << "it is of first order";
}

/// The terms of second order alone: a point at the end of a lever that points at the blank's ball moves away
/// by turning either way; one beside it moves across.
TEST(CoverBound, TermsOfSecondOrderAreNeeded) {
  const auto bound = [](double half_angle, double half_y, double lever, double to) {
    const PoseCell cell{{-half_angle, 0, -half_y}, {half_angle, 0, half_y}};
    BallTerm term;
    term.part = {just(lever), just(0)}, term.blank = {just(to), just(0)}, term.multiplier = just(1);
    return bound_over(cell, {term}).everywhere;
  };
  for (const double h : {0.1, 0.01, 0.001}) {
    // Turning away from a ball beyond the lever's end: 10 -> sqrt(10^2 + 2 20 30 (1 - cos h)).
    const double turned = std::sqrt(100 + 1200 * (1 - std::cos(h)));
    EXPECT_GE(bound(h, 0, 20, 30), turned);
    EXPECT_LT(bound(h, 0, 20, 30), 10 + 1.6 * (turned - 10) + 40 * h * h * h);
    // Moving across.
    EXPECT_GE(bound(0, h, 20, 30), std::hypot(10, h));
    EXPECT_LT(bound(0, h, 20, 30), 10 + 1.2 * h * h / 20);
    // Turning a lever that points away: it comes nearer, all that is left is across.
    EXPECT_GE(bound(h, 0, -20, -10), 10);
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_cover_bound_test

// verify_clearance against brute force: points all along both outlines in long double, the best of them moved
// along their edges until they are best; inside or outside by rays in long double. None of the checker's
// code.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/boolean_cases.hpp"
#include "support/cases.hpp"
#include "support/region_cases.hpp"

namespace lekalo::verify_clearance_test {
namespace {

using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

struct RealPoint {
  Real x = 0, y = 0;
};
RealPoint operator+(RealPoint a, RealPoint b) { return {a.x + b.x, a.y + b.y}; }
RealPoint operator-(RealPoint a, RealPoint b) { return {a.x - b.x, a.y - b.y}; }
RealPoint operator*(Real s, RealPoint a) { return {s * a.x, s * a.y}; }
Real size(RealPoint a) { return std::sqrt(a.x * a.x + a.y * a.y); }

/// A line, or an arc from an angle on through a signed sweep.
struct Curve {
  bool arc = false;
  RealPoint from, to, centre;
  Real radius = 0, first = 0, sweep = 0;

  [[nodiscard]] RealPoint at(Real share) const {
    if (!arc) return from + share * (to - from);
    const Real angle = first + share * sweep;
    return centre + radius * RealPoint{std::cos(angle), std::sin(angle)};
  }
  [[nodiscard]] Real length() const { return arc ? radius * std::abs(sweep) : size(to - from); }
  [[nodiscard]] Real distance(RealPoint p) const {
    Real least = std::min(size(p - from), size(p - to));
    if (!arc) {
      const RealPoint along = to - from;
      const Real share =
          ((p.x - from.x) * along.x + (p.y - from.y) * along.y) / (along.x * along.x + along.y * along.y);
      return share > 0 && share < 1 ? std::min(least, size(p - at(share))) : least;
    }
    const RealPoint out = p - centre;
    Real turn = (std::atan2(out.y, out.x) - first) * (sweep > 0 ? 1 : -1);
    turn -= 2 * kPi * std::floor(turn / (2 * kPi));
    return turn <= std::abs(sweep) ? std::min(least, std::abs(size(out) - radius)) : least;
  }
};

struct Outline {
  std::vector<std::vector<Curve>> contours;
  std::vector<std::size_t> pieces{0};

  [[nodiscard]] Real distance(RealPoint p) const {
    Real least = 1e30L;
    for (const auto& contour : contours)
      for (const Curve& c : contour) least = std::min(least, c.distance(p));
    return least;
  }
  /// Crossings of a ray to the right, by the angles of arcs. Nothing clever about rays through ends: points
  /// are random.
  [[nodiscard]] static bool winds(const std::vector<Curve>& contour, RealPoint p) {
    bool odd = false;
    for (const Curve& c : contour) {
      if (!c.arc) {
        if ((c.from.y > p.y) == (c.to.y > p.y)) continue;
        const Real x = c.from.x + (p.y - c.from.y) * (c.to.x - c.from.x) / (c.to.y - c.from.y);
        if (x > p.x) odd = !odd;
        continue;
      }
      const Real height = p.y - c.centre.y;
      if (std::abs(height) >= c.radius) continue;
      const Real half = std::sqrt(c.radius * c.radius - height * height);
      for (const Real step : {half, -half}) {
        Real turn = (std::atan2(height, step) - c.first) * (c.sweep > 0 ? 1 : -1);
        turn -= 2 * kPi * std::floor(turn / (2 * kPi));
        if (c.centre.x + step > p.x && turn <= std::abs(c.sweep)) odd = !odd;
      }
    }
    return odd;
  }
  [[nodiscard]] bool holds(RealPoint p) const {
    for (std::size_t piece = 0; piece + 1 < pieces.size(); ++piece) {
      bool in = winds(contours[pieces[piece]], p);
      for (std::size_t h = pieces[piece] + 1; h < pieces[piece + 1]; ++h) in = in && !winds(contours[h], p);
      if (in) return true;
    }
    return false;
  }
};

Outline outline_of(const std::vector<geom::Region>& regions, const verify::Placement& at) {
  const Real c = std::cos(Real(at.theta)), s = std::sin(Real(at.theta));
  const auto placed = [&](geom::Point p) -> RealPoint {
    const Real x = at.mirrored ? -Real(p.x) : Real(p.x), y = p.y;
    return {c * x - s * y + at.x, s * x + c * y + at.y};
  };
  Outline outline;
  const auto add = [&](const geom::Contour& contour) {
    std::vector<Curve> curves;
    for (const geom::Edge& e : contour) {
      Curve made{e.kind != geom::EdgeKind::line, placed(e.from), placed(e.to), {}, 0, 0, 0};
      if (made.arc) {
        made.centre = placed(e.centre);
        const RealPoint a = made.from - made.centre, b = made.to - made.centre;
        made.radius = (size(a) + size(b)) / 2;
        made.first = std::atan2(a.y, a.x);
        const bool ccw = (e.kind == geom::EdgeKind::arc_ccw) != at.mirrored;
        Real turn = (std::atan2(b.y, b.x) - made.first) * (ccw ? 1 : -1);
        turn -= 2 * kPi * std::floor(turn / (2 * kPi));
        if (e.from == e.to) turn = 2 * kPi;
        made.sweep = ccw ? turn : -turn;
      }
      curves.push_back(made);
    }
    outline.contours.push_back(std::move(curves));
  };
  for (const geom::Region& r : regions) {
    add(r.outer);
    for (const geom::Contour& h : r.holes) add(h);
    outline.pieces.push_back(outline.contours.size());
  }
  return outline;
}

/// The least value of a function near `share`, by thirds.
template <class Function>
Real refined(Function&& f, Real share, Real step) {
  Real low = std::max<Real>(0, share - step), high = std::min<Real>(1, share + step);
  for (int i = 0; i < 70; ++i) {
    const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
    f(a) < f(b) ? high = b : low = a;
  }
  return std::min(f(low), f(high));
}

/// Least of f(point) over an outline: samples, then the promising ones refined.
template <class Function>
Real least_along(const Outline& outline, Function&& f, Real spacing) {
  struct Sample {
    Real value;
    const Curve* curve;
    Real share, step;
  };
  std::vector<Sample> samples;
  Real least = 1e30L;
  for (const auto& contour : outline.contours)
    for (const Curve& c : contour) {
      const int n = std::max(4, static_cast<int>(c.length() / spacing));
      for (int i = 0; i <= n; ++i) {
        samples.push_back({f(c.at(Real(i) / n)), &c, Real(i) / n, Real(1) / n});
        least = std::min(least, samples.back().value);
      }
    }
  const Real seen = least;
  for (const Sample& s : samples)
    if (s.value <= seen + spacing)
      least = std::min(least, refined([&](Real share) { return f(s.curve->at(share)); }, s.share, s.step));
  return least;
}

struct Truth {
  Real clearance = 0;
  bool crosses = false;
};
/// Inside: the least distance of the outlines. Else the deepest point found that sticks out.
Truth truth_of(const Outline& part, const Outline& blank, Random& random) {
  const Real apart = std::min(least_along(
                                  part, [&](RealPoint p) { return blank.distance(p); }, 0.7L),
                              least_along(
                                  blank, [&](RealPoint p) { return part.distance(p); }, 0.7L));
  const auto depth = [&](RealPoint p) { return blank.holds(p) ? 0 : -blank.distance(p); };
  Real out = least_along(part, depth, 1);
  // Inside the part, where the blank has a hole: the hole's farthest point from its outline.
  Real low_x = 1e30L, high_x = -1e30L, low_y = 1e30L, high_y = -1e30L;
  for (const auto& contour : part.contours)
    for (const Curve& c : contour)
      for (int i = 0; i <= 8; ++i) {
        const RealPoint p = c.at(Real(i) / 8);
        low_x = std::min(low_x, p.x), high_x = std::max(high_x, p.x);
        low_y = std::min(low_y, p.y), high_y = std::max(high_y, p.y);
      }
  // Of many points the deepest, then a random walk downhill.
  const auto in_part = [&](RealPoint p) { return part.holds(p) ? depth(p) : Real(0); };
  std::vector<std::pair<Real, RealPoint>> deepest;
  for (int k = 0; k < 2000; ++k) {
    const RealPoint p{low_x + (high_x - low_x) * Real(random.uniform(0, 1)),
                      low_y + (high_y - low_y) * Real(random.uniform(0, 1))};
    deepest.push_back({in_part(p), p});
  }
  std::sort(deepest.begin(), deepest.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  deepest.resize(24);
  for (auto& [best, p] : deepest) {
    Real step = 1;
    for (int failed = 0; step > 1e-6L && best < 0;) {
      const RealPoint q{p.x + step * Real(random.uniform(-1, 1)), p.y + step * Real(random.uniform(-1, 1))};
      const Real there = in_part(q);
      if (there < best) {
        p = q, best = there, failed = 0;
      } else if (++failed == 24) {
        failed = 0, step /= 2;
      }
    }
    out = std::min(out, best);
  }
  return out < 0 ? Truth{out, true} : Truth{apart, false};
}

void check(const std::vector<geom::Region>& part, const std::vector<geom::Region>& blank,
           const verify::Placement& at, Random& random, int& inside, int& outside) {
  const std::string part_text = io::regions_json(part), blank_text = io::regions_json(blank);
  const auto got = verify::verify_clearance({"part.json", part_text}, {"blank.json", blank_text}, at);
  ASSERT_TRUE(got.has_value()) << got.error().message;
  ASSERT_LE(got->low, got->high);
  const Truth truth = truth_of(outline_of(part, at), outline_of(blank, {}), random);
  if (!truth.crosses) {
    ++inside;
    ASSERT_NEAR(got->low, static_cast<double>(truth.clearance), 1e-9);
    ASSERT_LE(got->high - got->low, 1e-11);
    ASSERT_GE(truth.clearance, Real(got->low) - 1e-12L);
    ASSERT_LE(truth.clearance, Real(got->high) + 1e-9L);
  } else {
    ++outside;
    // A point was found that sticks out so far, hence the clearance is no more; there may be one a little
    // deeper.
    ASSERT_GE(truth.clearance, Real(got->low) - 1e-9L);
    ASSERT_LE(truth.clearance, Real(got->high) + 0.02L);
    ASSERT_LE(got->high - got->low, 1e-6);
  }
}

TEST(VerifyClearance, IsThatOfBruteForceOnRandomParts) {
  // A second each.
  const std::size_t count = std::min<std::size_t>(cases::region_case_count(1), 100);
  int inside = 0, outside = 0;
  for (const cases::RegionKind kind : cases::kRegionKinds)
    for (std::size_t i = 0; i < count; ++i) {
      const cases::RegionCase one = cases::region_case(cases::seed() + 5, i, kind, 16);
      Random random(cases::seed(), 77 * i + static_cast<std::uint64_t>(kind));
      for (int k = 0; k < 3; ++k) {
        SCOPED_TRACE(fmt::format("{} pose {} seed {}", one.name, k, cases::seed()));
        const double wild = k == 0 ? 0 : (k == 1 ? 0.3 : 6);
        verify::Placement at{one.shift.x + random.uniform(-wild, wild),
                             one.shift.y + random.uniform(-wild, wild),
                             one.theta + 0.03 * random.uniform(-wild, wild), false};
        check(one.part, one.blank, at, random, inside, outside);
        if (testing::Test::HasFatalFailure()) return;
        at.mirrored = k == 2;
        if (at.mirrored) check(one.part, one.blank, at, random, inside, outside);
        if (testing::Test::HasFatalFailure()) return;
      }
    }
  EXPECT_GT(inside, static_cast<int>(count));
  EXPECT_GT(outside, static_cast<int>(count));
}

TEST(VerifyClearance, IsThatOfBruteForceOnShapesOfAGrid) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(40), 2000);
  int inside = 0, outside = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 900 + i);
    SCOPED_TRACE(fmt::format("case {} seed {}", i, cases::seed()));
    const auto part = geom::united(cases::boolean_operand(random, cases::BooleanKind::grid)).value().regions;
    auto blank = geom::united(cases::boolean_operand(random, cases::BooleanKind::grid)).value().regions;
    // Sometimes a big one around everything, with a hole.
    if (i % 3 == 0)
      blank = {geom::make_region(cases::boolean_rectangle(-20, -20, 50, 50),
                                 {cases::boolean_circle({16, 16}, 1.5)})
                   .value()};
    if (part.empty() || blank.empty() || geom::fault_of(part) || geom::fault_of(blank)) continue;
    const verify::Placement at{random.uniform(-2, 8), random.uniform(-2, 8), random.uniform(-4, 4),
                               random.below(2) == 0};
    check(part, blank, at, random, inside, outside);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_GT(inside, 0);
  EXPECT_GT(outside, 0);
}

TEST(VerifyClearance, RingsAreKnownExactly) {
  // Radii r1 < r2 in R1 < R2, centres d apart: min(R2 - r2, r1 - R1) - d.
  const auto ring = [](geom::Point c, double inner, double outer) {
    return std::vector<geom::Region>{
        geom::make_region(cases::boolean_circle(c, outer), {cases::boolean_circle(c, inner)}).value()};
  };
  Random random(cases::seed(), 4);
  for (int k = 0; k < 200; ++k) {
    const double d = random.uniform(0, 0.9), turn = random.uniform(0, 6.28);
    const std::string part = io::regions_json(ring({0, 0}, 5, 10)),
                      blank = io::regions_json(ring({30, -7}, 4, 12));
    const auto got = verify::verify_clearance(
        {"p", part}, {"b", blank},
        {30 + d * std::cos(turn), -7 + d * std::sin(turn), random.uniform(-9, 9), k % 2 == 0});
    ASSERT_TRUE(got.has_value()) << got.error().message;
    ASSERT_NEAR(got->low, 1 - d, 1e-12);
    ASSERT_NEAR(got->high, 1 - d, 1e-12);
    // Moved so far that it sticks out: between the hole of the part, over the blank's, and the outside.
    const auto out = verify::verify_clearance({"p", part}, {"b", blank}, {30 + 2.5, -7, 0, false});
    ASSERT_NEAR(out->low, -1.5, 1e-8);
    ASSERT_NEAR(out->high, -1.5, 1e-8);
  }
}

}  // namespace
}  // namespace lekalo::verify_clearance_test

// The linear program of one angle and the search over angles, against enumeration of every triple of edges.

#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/locate/convex.hpp"
#include "locate/convex/contact_program.hpp"
#include "support/cases.hpp"

namespace lekalo::locate::locate_program_test {
namespace {

using geom::Point;

/// Largest clearance at one angle: the least bound over all triples of edges whose normals span the plane.
/// O(n^3).
double best_at_angle(const geom::Ring& part, const geom::Ring& blank, double theta) {
  const double c = std::cos(theta), s = std::sin(theta);
  const std::size_t n = blank.size();
  std::vector<Point> normal(n);
  std::vector<double> open(n, 1e300);
  for (std::size_t k = 0; k < n; ++k) {
    const Point edge = blank[(k + 1) % n] - blank[k];
    normal[k] = {-edge.y / std::hypot(edge.x, edge.y), edge.x / std::hypot(edge.x, edge.y)};
    for (const Point& v : part)
      open[k] = std::min(open[k], dot(normal[k], Point{c * v.x - s * v.y, s * v.x + c * v.y} - blank[k]));
  }
  double best = 1e300;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) {
        const double wi = cross(normal[j], normal[k]), wj = cross(normal[k], normal[i]),
                     wk = cross(normal[i], normal[j]);
        if (wi < 0 || wj < 0 || wk < 0 || !(wi + wj + wk > 0)) continue;
        best = std::min(best, (wi * open[i] + wj * open[j] + wk * open[k]) / (wi + wj + wk));
      }
  return best;
}

TEST(ContactProgram, AgreesWithTheEnumerationOfTriples) {
  const std::size_t count = cases::case_count(300);
  std::size_t compared = 0;
  for (std::size_t i = 0; compared < count; ++i) {
    const auto one = cases::random_case(cases::seed(), i, cases::Kind::plain);
    if (one.blank.size() > 24) continue;
    ++compared;
    geom::Ring part = one.part.vertices(), blank = one.blank.vertices();
    const Point p0 = part[0], b0 = blank[0];
    for (Point& p : part) p = p - p0;
    for (Point& p : blank) p = p - b0;
    ContactProgram program(part, blank);
    Basis warm = program.first_basis();
    for (int step = 0; step < 7; ++step) {
      const Angle angle = Angle::of(-3.0 + step * 1.7 + static_cast<double>(i % 100) * 0.01);
      const auto solution = program.solve(angle, warm, -1e300);
      const double expected = best_at_angle(part, blank, angle.theta);
      EXPECT_NEAR(solution.value, expected, 1e-11 * program.scale()) << one.name;
      EXPECT_NEAR(solution.basis.bound.at(angle), expected, 1e-11 * program.scale()) << one.name;
      warm = solution.basis;
    }
  }
}

TEST(ContactProgram, LargeBlanksGiveTheSameOptimumAsTheirEnumeratedNeighbourhood) {
  // 200 edges: taken in lazily. The optimum of all edges is at most that of any subset and is reached by the
  // shift.
  const auto part = cases::superellipse(150, 49, 29).vertices(),
             blank = cases::superellipse(200, 50, 31).vertices();
  ContactProgram program(part, blank);
  Basis warm = program.first_basis();
  for (int step = 0; step < 40; ++step) {
    const Angle angle = Angle::of(0.157 * step);
    const auto solution = program.solve(angle, warm, -1e300);
    double reached = 1e300;
    for (std::size_t k = 0; k < blank.size(); ++k) {
      const Point edge = blank[(k + 1) % blank.size()] - blank[k];
      for (const Point& v : part) {
        const Point p = Point{std::cos(angle.theta) * v.x - std::sin(angle.theta) * v.y,
                              std::sin(angle.theta) * v.x + std::cos(angle.theta) * v.y} +
                        solution.shift;
        reached = std::min(reached, cross(edge, p - blank[k]) / norm(edge));
      }
    }
    EXPECT_NEAR(reached, solution.value, 1e-11);
    EXPECT_NEAR(solution.basis.bound.at(angle), solution.value, 1e-11);
    warm = solution.basis;
  }
}

TEST(LocateConvex, IsTheBestOfADenseEnumerationOnThePublishedExamples) {
  for (const cases::Example& example : cases::published_examples()) {
    const geom::Ring part = example.part().vertices(), blank = example.blank().vertices();
    const auto result = locate_convex({example.part(), example.blank(), {}, 0, 0}, {});
    ASSERT_TRUE(result.has_value());
    double best = -1e300, at = 0;
    const int steps = static_cast<int>(cases::case_count(360));
    for (int i = 0; i < steps; ++i) {
      const double theta = 6.283185307179586 * i / steps;
      const double value = best_at_angle(part, blank, theta);
      if (value > best) best = value, at = theta;
    }
    EXPECT_LE(best, result->upper_bound) << example.name;
    // Golden section about the optimum that was found, and about the best of the sweep.
    for (const double centre : {at, result->best.theta}) {
      const double ratio = (std::sqrt(5.0) - 1) / 2;
      double lo = centre - 0.02, hi = centre + 0.02;
      for (int i = 0; i < 80; ++i) {
        const double left = hi - ratio * (hi - lo), right = lo + ratio * (hi - lo);
        (best_at_angle(part, blank, left) < best_at_angle(part, blank, right) ? lo : hi) =
            best_at_angle(part, blank, left) < best_at_angle(part, blank, right) ? left : right;
      }
      const double refined = best_at_angle(part, blank, 0.5 * (lo + hi));
      EXPECT_LE(refined, result->upper_bound + 1e-12) << example.name;
      if (centre == result->best.theta) {
        EXPECT_NEAR(refined, result->best.clearance, 1e-11) << example.name;
      }
    }
  }
}

}  // namespace
}  // namespace lekalo::locate::locate_program_test

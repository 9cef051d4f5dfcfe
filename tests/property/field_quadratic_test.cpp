#include "field/grid_quadratic.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

// The quadratic conjunction on a grid, where polynomials stand for far subtrees, against every segment at
// every node; and the bounds it rests on.

namespace lekalo::field::field_quadratic_test {
namespace {

using geom::Point;
constexpr FlozForm kForms[] = {FlozForm::normalised, FlozForm::algebraic};

/// A wavy outline with a round hole, of many short chords.
ContourModel wavy(Random& random, FlozForm form, int points) {
  geom::Contour outer;
  std::vector<Point> ring;
  const double lobes = std::floor(random.uniform(3, 9)), deep = random.uniform(2, 8);
  for (int i = 0; i < points; ++i) {
    const auto turn = geom::sincos(6.283185307179586 * i / points);
    const double r = 24 + deep * geom::sincos(6.283185307179586 * lobes * i / points).cosine;
    ring.push_back({r * turn.cosine, r * turn.sine});
  }
  for (std::size_t i = 0; i < ring.size(); ++i)
    outer.push_back({geom::EdgeKind::line, ring[i], ring[(i + 1) % ring.size()], {}});
  const geom::Contour hole{{geom::EdgeKind::arc_ccw, {6, 1}, {6, 1}, {3, 1}}};
  return ContourModel::make({*geom::make_region(outer, {hole})}, {0.4, Logic::quadratic, form}).value();
}

double distance(const ContourModel& model, Point x) {
  double least = 1e9;
  for (const auto& chord : model.chords()) {
    const Point way = chord.b - chord.a;
    const double t = std::clamp(dot(x - chord.a, way) / dot(way, way), 0.0, 1.0);
    least = std::min(least, norm(x - (chord.a + t * way)));
  }
  return least;
}

TEST(QuadraticGrid, IsTheModelWithinTheStatedErrors) {
  for (std::size_t i = 0; i < cases::case_count(3); ++i) {
    Random random(cases::seed(), i + 1);
    for (const FlozForm form : kForms) {
      const ContourModel model = wavy(random, form, 120 + 150 * static_cast<int>(i));
      // All of it coarsely; then finely in the middle, about the outline, and far outside.
      for (const GridFrame& frame :
           {GridFrame{{-40, -41}, 0.71, 113, 117}, GridFrame{{-9, 2}, 0.02, 200, 150},
            GridFrame{{15, 15}, 0.031, 170, 300}, GridFrame{{-90, 30}, 0.2, 130, 90}}) {
        const FieldGrid grid = sample(model, frame, 2), one = sample(model, frame, 1);
        EXPECT_EQ(grid.value, one.value);
        EXPECT_EQ(grid.dx, one.dx);
        EXPECT_EQ(grid.dy, one.dy);
        for (std::size_t n = 0; n < frame.size(); n += 23) {
          const Point x = frame.node(n % frame.columns, n / frame.columns);
          const Jet jet = model(x);
          const double found = static_cast<double>(grid.value[n]), value = std::abs(jet.value);
          ASSERT_NEAR(found, jet.value, kQuadraticGridError * std::max({value, frame.pitch, 0.4}))
              << x.x << " " << x.y;
          const Point gradient{static_cast<double>(grid.dx[n]), static_cast<double>(grid.dy[n])};
          const double scale = std::max({1.0, norm(jet.gradient), value / distance(model, x)});
          ASSERT_LE(norm(gradient - jet.gradient), kQuadraticGridGradientError / 20 * scale)
              << x.x << " " << x.y;
        }
      }
    }
  }
}

TEST(QuadraticGrid, IsExactOnItsSegmentsAndKeepsTheirSides) {
  const auto region = geom::make_region({{geom::EdgeKind::line, {0, 0}, {8, 0}, {}},
                                         {geom::EdgeKind::line, {8, 0}, {8, 8}, {}},
                                         {geom::EdgeKind::line, {8, 8}, {0, 8}, {}},
                                         {geom::EdgeKind::line, {0, 8}, {0, 0}, {}}});
  const ContourModel model =
      ContourModel::make({*region}, {1, Logic::quadratic, FlozForm::normalised}).value();
  const FieldGrid grid = sample(model, {{-4, -4}, 0.25, 65, 65});
  for (std::size_t n = 0; n < grid.frame.size(); ++n) {
    const Point x = grid.frame.node(n % 65, n / 65);
    const bool on = distance(model, x) == 0;
    EXPECT_EQ(grid.value[n] == 0, on);
    if (!on) {
      EXPECT_EQ(grid.value[n] > 0, model.inside(x));
    }
  }
}

/// Taylor coefficients along a line, up to the fourth.
struct Series {
  std::array<double, 5> c{};
  friend Series operator+(Series a, const Series& b) {
    for (std::size_t i = 0; i < 5; ++i) a.c[i] += b.c[i];
    return a;
  }
  friend Series operator*(const Series& a, const Series& b) {
    Series product;
    for (std::size_t k = 0; k < 5; ++k)
      for (std::size_t i = 0; i <= k; ++i) product.c[k] += a.c[i] * b.c[k - i];
    return product;
  }
};
Series root(const Series& a) {
  Series s;
  s.c[0] = std::sqrt(a.c[0]);
  for (std::size_t k = 1; k < 5; ++k) {
    double rest = a.c[k];
    for (std::size_t i = 1; i < k; ++i) rest -= s.c[i] * s.c[k - i];
    s.c[k] = rest / (2 * s.c[0]);
  }
  return s;
}

TEST(QuadraticGrid, FarDerivativesOfFlozAreBounded) {
  constexpr std::array<double, 5> kFactorial{1, 1, 2, 6, 24};
  constexpr double kDegree = 0.017453292519943295;
  for (const FlozForm form : kForms) {
    std::array<double, 5> most{};
    for (double r = kFarLengths; r < 1e4; r *= 1.03)
      for (int a = 0; a <= 90; ++a)
        for (int b = 0; b < 180; b += 2) {
          const auto at = geom::sincos(a * kDegree), way = geom::sincos(b * kDegree);
          const Series x{{r * at.cosine, way.cosine}}, y{{r * at.sine, way.sine}};
          const Series u = y * y, t = x * x + u + Series{{-0.25}};
          const Series over = root(t * t + u * u) + t, half = Series{{0.5}} * over;
          const Series f = form == FlozForm::algebraic ? u + over : root(u + half * half);
          // The series is FLOZ of the segment of length 1 about the origin.
          if (b == 0) {
            EXPECT_NEAR(f.c[0], floz(floz_segment({-0.5, 0}, {0.5, 0}), {x.c[0], y.c[0]}, form).value,
                        1e-12 * f.c[0]);
          }
          double power = 1;
          for (std::size_t k = 1; k < 5; ++k) {
            power *= r;
            most[k] = std::max(most[k], std::abs(f.c[k]) * kFactorial[k] * power / f.c[0]);
          }
        }
    for (std::size_t k = 1; k < 5; ++k) EXPECT_LE(most[k], kFarDerivatives[k - 1] * 0.99) << k;
  }
}

TEST(QuadraticGrid, TheMixingFactorIsBounded) {
  for (double ratio = 1e-6; ratio < 1e6; ratio *= 1.0003) {
    const double r = std::sqrt(ratio * ratio + 1);
    const double q = conjunction({ratio, {}}, {1, {}}, Logic::quadratic).value;
    const double factor = ratio * ratio / (r * r * r * q);
    EXPECT_LE(factor, kMixing);
    EXPECT_LE(factor, kMixingSlope * std::min(ratio, 1 / ratio));
  }
}

}  // namespace
}  // namespace lekalo::field::field_quadratic_test

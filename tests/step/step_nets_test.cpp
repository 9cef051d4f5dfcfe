#include "nets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "lekalo/base/random.hpp"
#include "support/cases.hpp"

namespace lekalo::step::step_nets_test {
namespace {

double power(double x, std::size_t n) { return n == 0 ? 1 : x * power(x, n - 1); }

double bernstein(std::size_t degree, std::size_t i, double t) {
  double choose = 1;
  for (std::size_t k = 0; k < i; ++k)
    choose = choose * static_cast<double>(degree - k) / static_cast<double>(k + 1);
  return choose * power(t, i) * power(1 - t, degree - i);
}

/// A rational Bezier patch.
struct Patch {
  std::size_t rows = 0, columns = 0;
  std::vector<NetPoint> points;

  explicit Patch(Random& random) : rows(2 + random.below(4)), columns(2 + random.below(4)) {
    const bool is_rational = random.below(2) == 0;
    for (std::size_t k = 0; k < rows * columns; ++k) {
      const double w = is_rational ? random.uniform(0.4, 2.5) : 1;
      const double x = static_cast<double>(k / columns) * 3 + random.uniform(-1, 1),
                   y = static_cast<double>(k % columns) * 3 + random.uniform(-1, 1),
                   z = random.uniform(-2, 2);
      points.push_back({w * x, w * y, w * z, w});
    }
  }

  [[nodiscard]] gp_XYZ at(double u, double v) const {
    NetPoint sum{};
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        for (std::size_t axis = 0; axis < 4; ++axis)
          sum[axis] +=
              bernstein(rows - 1, i, u) * bernstein(columns - 1, j, v) * points[i * columns + j][axis];
    return {sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]};
  }
};

/// Never below what sampling finds, and not much above it.
void expect_near(double bound, double sampled) {
  EXPECT_GE(bound, sampled - 1e-9);
  EXPECT_LE(bound, 1.1 * sampled + 1e-9);
}

constexpr int kSteps = 40;

TEST(Nets, ABoundOverATriangleIsThatOfItsPointsAlone) {
  Random random(cases::seed());
  for (int k = 0; k < 40; ++k) {
    const Patch patch(random);
    std::array<double, 3> u{}, v{};
    std::array<gp_XYZ, 3> flat;
    for (std::size_t c = 0; c < 3; ++c) {
      u[c] = random.uniform(0, 1), v[c] = random.uniform(0, 1);
      flat[c] = patch.at(u[c], v[c]);
    }
    double sampled = 0;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const double a = static_cast<double>(i) / kSteps, b = static_cast<double>(j) / kSteps, c = 1 - a - b;
        const gp_XYZ is = patch.at(a * u[0] + b * u[1] + c * u[2], a * v[0] + b * v[1] + c * v[2]);
        sampled = std::max(sampled, (is - (a * flat[0] + b * flat[1] + c * flat[2])).Modulus());
      }
    const TriangleNet net = net_over(patch.points, patch.columns, u, v, flat);
    expect_near(farthest({net}, 0), sampled);
    // No work is done where it is not asked for, and it is a bound then, too.
    EXPECT_GE(farthest({net}, 1e9), sampled - 1e-9);
  }
}

TEST(Nets, ABoundOverABoxIsThatOfItsPoints) {
  Random random(cases::seed());
  for (int k = 0; k < 40; ++k) {
    const Patch patch(random);
    const std::array<gp_XYZ, 4> flat{patch.at(0, 0), patch.at(0, 1), patch.at(1, 0), patch.at(1, 1)};
    double sampled = 0;
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; j <= kSteps; ++j) {
        const double s = static_cast<double>(i) / kSteps, t = static_cast<double>(j) / kSteps;
        const gp_XYZ bilinear =
            (1 - s) * ((1 - t) * flat[0] + t * flat[1]) + s * ((1 - t) * flat[2] + t * flat[3]);
        sampled = std::max(sampled, (patch.at(s, t) - bilinear).Modulus());
      }
    expect_near(farthest({net_over(patch.points, patch.columns, flat)}, 0), sampled);
  }
}

TEST(Nets, AWeightThatIsNotAboveZeroProvesNothing) {
  const std::vector<NetPoint> patch{{0, 0, 0, 1}, {0, 1, 0, 1}, {1, 0, 0, 0}, {1, 1, 0, 1}};
  EXPECT_FALSE(std::isfinite(farthest({net_over(patch, 2, std::array<gp_XYZ, 4>{})}, 0)));
}

}  // namespace
}  // namespace lekalo::step::step_nets_test

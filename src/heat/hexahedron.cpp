#include "hexahedron.hpp"

#include <cmath>
#include <numbers>

namespace lekalo::heat {
namespace {

constexpr std::size_t kInner = 9;  // three bubbles for each component
using Strain = std::array<double, 6>;

Strain stress_of(const Strain& e, double youngs, double poisson) {
  const double shear = youngs / (2 * (1 + poisson)), even = 2 * shear * poisson / (1 - 2 * poisson);
  const double sum = even * (e[0] + e[1] + e[2]);
  return {sum + 2 * shear * e[0], sum + 2 * shear * e[1], sum + 2 * shear * e[2],
          shear * e[3],           shear * e[4],           shear * e[5]};
}

/// The strain of a displacement along one axis with this gradient.
Strain strain_of(std::size_t axis, const std::array<double, 3>& gradient) {
  Strain e{};
  e[axis] = gradient[axis];
  // Shear a is of the two other axes.
  for (std::size_t a = 0; a < 3; ++a)
    if (a != axis) e[3 + a] = gradient[3 - a - axis];
  return e;
}

std::array<Strain, kUnknowns> strains_at(const std::array<double, 3>& at, const std::array<double, 3>& half) {
  std::array<Strain, kUnknowns> strains{};
  for (std::size_t n = 0; n < kCorners; ++n) {
    std::array<double, 3> gradient{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      gradient[axis] = 1 / (8 * half[axis]);
      for (std::size_t other = 0; other < 3; ++other) {
        const double sign = (n >> other & 1U) != 0 ? 1 : -1;
        gradient[axis] *= other == axis ? sign : 1 + sign * at[other];
      }
    }
    for (std::size_t c = 0; c < 3; ++c) strains[3 * n + c] = strain_of(c, gradient);
  }
  return strains;
}

std::array<Strain, kInner> inner_strains_at(const std::array<double, 3>& at,
                                            const std::array<double, 3>& half) {
  std::array<Strain, kInner> strains{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::array<double, 3> gradient{};
    gradient[axis] = -2 * at[axis] / half[axis];  // of 1 - s^2
    for (std::size_t c = 0; c < 3; ++c) strains[3 * axis + c] = strain_of(c, gradient);
  }
  return strains;
}

double product(const Strain& a, const Strain& b) {
  double sum = 0;
  for (std::size_t i = 0; i < 6; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

double Hexahedron::mises(const std::array<double, 6>& e) const {
  const Strain s = stress_of(e, youngs, poisson);
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return std::sqrt((a * a + b * b + c * c) / 2 + 3 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]));
}

Hexahedron hexahedron_of(const std::array<double, 3>& pitch, double youngs, double poisson) {
  const std::array<double, 3> half{pitch[0] / 2, pitch[1] / 2, pitch[2] / 2};
  Hexahedron h;
  h.youngs = youngs, h.poisson = poisson;
  constexpr std::size_t kRight = kUnknowns + 4;  // columns by which the inner unknowns are given
  std::array<std::array<double, kInner>, kInner> inner{};
  std::array<std::array<double, kRight>, kInner> right{};
  const double weight = half[0] * half[1] * half[2];
  for (std::size_t p = 0; p < kCorners; ++p) {
    std::array<double, 3> at{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      at[axis] = ((p >> axis & 1U) != 0 ? 1 : -1) / std::numbers::sqrt3;
    const auto outer_strains = strains_at(at, half);
    const auto inner_strains = inner_strains_at(at, half);
    const std::array<double, 4> grows{1, at[0], at[1], at[2]};
    const Strain swelling = stress_of({1, 1, 1, 0, 0, 0}, youngs, poisson);
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      const Strain stress = stress_of(outer_strains[i], youngs, poisson);
      for (std::size_t j = 0; j < kUnknowns; ++j)
        h.stiffness[i][j] += weight * product(stress, outer_strains[j]);
      for (std::size_t a = 0; a < kInner; ++a) right[a][i] += weight * product(stress, inner_strains[a]);
      for (std::size_t q = 0; q < 4; ++q)
        h.load[i][q] += weight * grows[q] * product(swelling, outer_strains[i]);
    }
    for (std::size_t a = 0; a < kInner; ++a) {
      const Strain stress = stress_of(inner_strains[a], youngs, poisson);
      for (std::size_t b = 0; b < kInner; ++b) inner[a][b] += weight * product(stress, inner_strains[b]);
      for (std::size_t q = 0; q < 4; ++q)
        right[a][kUnknowns + q] += weight * grows[q] * product(swelling, inner_strains[a]);
    }
  }
  // The inner unknowns follow from the outer ones and the load: inner x = load - coupling u.
  auto solved = right;
  for (std::size_t a = 0; a < kInner; ++a)
    for (std::size_t b = 0; b < kInner; ++b) {
      if (a == b) continue;
      const double factor = inner[b][a] / inner[a][a];
      for (std::size_t c = 0; c < kInner; ++c) inner[b][c] -= factor * inner[a][c];
      for (std::size_t c = 0; c < kRight; ++c) solved[b][c] -= factor * solved[a][c];
    }
  for (std::size_t a = 0; a < kInner; ++a)
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      const double part = right[a][i] / inner[a][a];
      for (std::size_t j = 0; j < kUnknowns; ++j) h.stiffness[i][j] -= part * solved[a][j];
      for (std::size_t q = 0; q < 4; ++q) h.load[i][q] -= part * solved[a][kUnknowns + q];
    }
  const auto middle = strains_at({0, 0, 0}, half);
  for (std::size_t s = 0; s < 6; ++s)
    for (std::size_t i = 0; i < kUnknowns; ++i) h.strain[s][i] = middle[i][s];
  return h;
}

}  // namespace lekalo::heat

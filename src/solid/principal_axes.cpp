#include "lekalo/solid/principal_axes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace lekalo::solid {
namespace {

/// So many turns of each two axes are more than enough in double precision; what lies beside the diagonal is
/// nothing below this part of the whole.
constexpr int kSweeps = 8;
constexpr double kNothing = 0x1p-60;

double along(const Matrix& m, Vector v) {
  const auto row = [&](std::size_t i) { return dot(v, {m[i][0], m[i][1], m[i][2]}); };
  return v.x * row(0) + v.y * row(1) + v.z * row(2);
}

}  // namespace

/// By turns in the planes of two axes (Jacobi's method).
std::array<Vector, 3> eigenvectors(Matrix m) {
  Matrix turns{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  // its rows become the axes
  const double nothing = kNothing * (m[0][0] + m[1][1] + m[2][2]);
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (const auto& [p, q] : {std::pair<std::size_t, std::size_t>(0, 1), {0, 2}, {1, 2}}) {
      if (std::abs(m[p][q]) <= nothing) continue;
      const double half = 0.5 * (m[q][q] - m[p][p]) / m[p][q];
      const double t = (half < 0 ? -1 : 1) / (std::abs(half) + std::sqrt(half * half + 1));
      const double c = 1 / std::sqrt(t * t + 1), s = t * c;
      const auto turn = [&](double& a, double& b) {
        const double before = a;
        a = c * before - s * b;
        b = s * before + c * b;
      };
      for (std::size_t k = 0; k < 3; ++k) turn(m[p][k], m[q][k]);
      for (std::size_t k = 0; k < 3; ++k) turn(m[k][p], m[k][q]);
      for (std::size_t k = 0; k < 3; ++k) turn(turns[p][k], turns[q][k]);
      m[p][q] = m[q][p] = 0;
    }
  }
  // They are across each other but for the rounding of all turns, and are made so once more.
  const auto unit = [](Vector v) { return 1 / norm(v) * v; };
  const Vector x = unit({turns[0][0], turns[0][1], turns[0][2]}),
               z = unit(cross(x, {turns[1][0], turns[1][1], turns[1][2]}));
  return {x, cross(z, x), z};
}

PrincipalAxes principal_axes(const Mesh& mesh) {
  // Everything is counted from the middle of the box, so that a small body far from the origin keeps its
  // digits; a triangle and the middle make a pyramid whose volume has a sign.
  const Box box = box_of(mesh.vertices);
  const Vector middle = 0.5 * (box.low + box.high);
  PrincipalAxes made;
  Matrix spread{};
  const auto add = [&](Vector p, double weight) {
    const std::array<double, 3> v{p.x, p.y, p.z};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) spread[i][j] += weight * v[i] * v[j];
  };
  Vector first;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vector a = mesh.vertices[i] - middle, b = mesh.vertices[j] - middle, c = mesh.vertices[k] - middle;
    const Vector sum = a + b + c;
    const double volume = dot(a, cross(b, c)) / 6;
    made.volume += volume;
    first = first + volume / 4 * sum;
    for (const Vector p : {a, b, c, sum}) add(p, volume / 20);
  }
  if (!(made.volume > 0)) return made;
  const Vector centre = 1 / made.volume * first;
  made.centre = middle + centre;
  add(centre, -made.volume);
  made.axes = eigenvectors(spread);
  std::sort(made.axes.begin(), made.axes.end(),
            [&](Vector a, Vector b) { return along(spread, a) < along(spread, b); });
  made.axes[2] = cross(made.axes[0], made.axes[1]);
  for (std::size_t k = 0; k < 3; ++k) made.spread[k] = along(spread, made.axes[k]);
  return made;
}

}  // namespace lekalo::solid

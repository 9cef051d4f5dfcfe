#pragma once

// The distance of two meshes by its definition: every pair of triangles, feature by feature, in long double.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "lekalo/solid/mesh.hpp"
#include "lekalo/solid/motion.hpp"

namespace lekalo::brute {

using Real = long double;
using Wide = std::array<Real, 3>;
using Corners = std::array<Wide, 3>;

inline Wide wide(solid::Vector p) { return {p.x, p.y, p.z}; }
inline Wide minus(const Wide& a, const Wide& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Real dot(const Wide& a, const Wide& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Wide cross(const Wide& a, const Wide& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline Real length(const Wide& a) { return std::sqrt(dot(a, a)); }

/// A vertex above the inside of a triangle, by its height.
inline void look_at_face(Real& least, const Wide& p, const Corners& t) {
  const Wide n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(cross(minus(t[(k + 1) % 3], t[k]), minus(p, t[k])), n) < 0) return;
  least = std::min(least, std::abs(dot(n, minus(p, t[0]))) / length(n));
}

/// A vertex beside the inside of an edge, and beside its end.
inline void look_at_edge(Real& least, const Wide& p, const Wide& a, const Wide& b) {
  const Wide ab = minus(b, a), ap = minus(p, a);
  least = std::min(least, length(ap));
  if (dot(ab, ap) > 0 && dot(ab, minus(p, b)) < 0)
    least = std::min(least, length(cross(ab, ap)) / length(ab));
}

/// Two edges that pass each other, by their common perpendicular.
inline void look_at_passing(Real& least, const Wide& a, const Wide& b, const Wide& c, const Wide& d) {
  const Wide u = minus(b, a), v = minus(d, c), n = cross(u, v), un = cross(u, n), vn = cross(v, n);
  if (!(length(n) > 0)) return;
  const auto sides = [](Real x, Real y) { return (x > 0) != (y > 0); };
  if (!sides(dot(vn, minus(a, c)), dot(vn, minus(b, c))) ||
      !sides(dot(un, minus(c, a)), dot(un, minus(d, a))))
    return;
  least = std::min(least, std::abs(dot(n, minus(c, a))) / length(n));
}

/// An edge that goes through a triangle.
inline void look_through(Real& least, const Wide& a, const Wide& b, const Corners& t) {
  const Wide n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  const Real from = dot(n, minus(a, t[0])), to = dot(n, minus(b, t[0]));
  if ((from > 0) == (to > 0)) return;
  Wide p;
  for (std::size_t k = 0; k < 3; ++k) p[k] = a[k] + from / (from - to) * (b[k] - a[k]);
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(cross(minus(t[(k + 1) % 3], t[k]), minus(p, t[k])), n) < 0) return;
  least = 0;
}

inline Real distance(const Corners& a, const Corners& b) {
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    look_at_face(least, a[i], b);
    look_at_face(least, b[i], a);
    look_through(least, a[i], a[(i + 1) % 3], b);
    look_through(least, b[i], b[(i + 1) % 3], a);
    for (std::size_t j = 0; j < 3; ++j) {
      look_at_edge(least, a[i], b[j], b[(j + 1) % 3]);
      look_at_edge(least, b[i], a[j], a[(j + 1) % 3]);
      look_at_passing(least, a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]);
    }
  }
  return least;
}

inline Wide moved(const solid::Motion& motion, solid::Vector p) {
  const auto along = [&](solid::Vector row, double shift) {
    return Real(row.x) * p.x + Real(row.y) * p.y + Real(row.z) * p.z + shift;
  };
  return {along(motion.rotation[0], motion.shift.x), along(motion.rotation[1], motion.shift.y),
          along(motion.rotation[2], motion.shift.z)};
}

/// The least of the distances less widths of the blank's triangles.
inline Real clearance(const solid::Mesh& part, const solid::Mesh& blank, const std::vector<double>& widths,
                      const solid::Motion& motion) {
  Real least = std::numeric_limits<Real>::infinity();
  for (const solid::Triangle& p : part.triangles)
    for (std::size_t k = 0; k < blank.triangles.size(); ++k) {
      const solid::Triangle& b = blank.triangles[k];
      const Real apart =
          distance({moved(motion, part.vertices[p[0]]), moved(motion, part.vertices[p[1]]),
                    moved(motion, part.vertices[p[2]])},
                   {wide(blank.vertices[b[0]]), wide(blank.vertices[b[1]]), wide(blank.vertices[b[2]])});
      least = std::min(least, apart - (widths.empty() ? 0 : widths[k]));
    }
  return least;
}

}  // namespace lekalo::brute

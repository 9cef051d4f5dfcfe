#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "lekalo/solid/triangle_tree.hpp"

namespace lekalo::solid {

inline double largest_coordinate(Vector p) { return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}); }

/// The point of a triangle that is nearest to p, in so far as rounding lets it be found: of a thin triangle
/// it may be another point of it. Source: the Voronoi regions of a triangle, Ericson 2005, section 5.1.5; the
/// code is our own.
inline Vector nearest_point(const Corners& t, Vector p) {
  const Vector ab = t[1] - t[0], ac = t[2] - t[0], ap = p - t[0];
  const double ab_ap = dot(ab, ap), ac_ap = dot(ac, ap);
  if (ab_ap <= 0 && ac_ap <= 0) return t[0];
  const Vector bp = p - t[1];
  const double ab_bp = dot(ab, bp), ac_bp = dot(ac, bp);
  if (ab_bp >= 0 && ac_bp <= ab_bp) return t[1];
  const Vector cp = p - t[2];
  const double ab_cp = dot(ab, cp), ac_cp = dot(ac, cp);
  if (ac_cp >= 0 && ab_cp <= ac_cp) return t[2];
  const double beside_ab = ab_ap * ac_bp - ab_bp * ac_ap;
  if (beside_ab <= 0 && ab_ap >= 0 && ab_bp <= 0) return t[0] + ab_ap / (ab_ap - ab_bp) * ab;
  const double beside_ac = ab_cp * ac_ap - ab_ap * ac_cp;
  if (beside_ac <= 0 && ac_ap >= 0 && ac_cp <= 0) return t[0] + ac_ap / (ac_ap - ac_cp) * ac;
  const double beside_bc = ab_bp * ac_cp - ab_cp * ac_bp, towards_c = ac_bp - ab_bp,
               towards_b = ab_cp - ac_cp;
  if (beside_bc <= 0 && towards_c >= 0 && towards_b >= 0)
    return t[1] + towards_c / (towards_c + towards_b) * (t[2] - t[1]);
  const double whole = beside_ab + beside_ac + beside_bc;
  return t[0] + beside_ac / whole * ab + beside_ab / whole * ac;
}

/// The point of its edges that is nearest to p, which no thinness disturbs.
inline Vector nearest_on_edges(const Corners& t, Vector p) {
  Vector nearest = t[0];
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector from = t[k], along = t[(k + 1) % 3] - from;
    const double square = dot(along, along);
    const double share = square > 0 ? std::clamp(dot(along, p - from) / square, 0.0, 1.0) : 0;
    const Vector q = from + share * along;
    if (dot(p - q, p - q) < dot(p - nearest, p - nearest)) nearest = q;
  }
  return nearest;
}

}  // namespace lekalo::solid

#pragma once

#include <cstdint>

#include "lekalo/geom/polygon.hpp"

namespace lekalo::phi {

/// The pair that decides a phi value: a vertex of the part and an edge of the blank. Edge k runs from vertex
/// k to the next.
struct NearestPair {
  std::uint32_t part_vertex = 0, blank_edge = 0;
};

/// A value known to lie in [low, high].
struct Enclosure {
  double low = 0, high = 0;
  NearestPair nearest;
};

/// The normalised phi-function of a convex part D and B* = R^2 \ int B of a convex blank B:
///   Phi = min over edges k of B and vertices i of D of chi_k(R v_i + t),
/// chi_k the signed distance to the line of edge k, positive inwards. Positive: D lies inside B with that
/// minimum allowance; zero: they touch; negative: D crosses the boundary of B.
///
/// It is taken for the rotation by the *exact* angle `theta` (not its rounded sine and cosine) and the given
/// doubles, enclosed by error-bounded double-double arithmetic: high - low is a few units in the last place
/// of the value, plus 1e-30 M, M the largest absolute coordinate of blank, part, x and y. This is what locate
/// reports (low) and what tests compare with the checker. |theta| <= geom::kMaxAngle. Cost: O(n + m). Source:
/// spec of the method of phi-functions, model (5)-(7) of the localisation article.
[[nodiscard]] Enclosure clearance_enclosure(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                                            double x, double y, double theta) noexcept;

}  // namespace lekalo::phi

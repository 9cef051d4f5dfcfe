#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// Booleans of regions of lines and arcs. docs/design/boolean.md says how they work, what the bounds mean and
/// what failed.

enum class BooleanOperation {
  unite,      ///< in a or in b
  intersect,  ///< in both
  subtract,   ///< in a, not in b
  exclude     ///< in one of them alone
};

/// Regions, and how far they may be from the exact ones, millimetres.
///
/// `edge_error`: every point further than this from all edges of the operands is in `regions` exactly when it
/// is in the exact result. Pieces and gaps that no disc of this radius fits into may be missing or filled.
/// `corner_error`: apart from those, every boundary point of either lies within this of the other boundary.
/// It is larger where edges cross at a small angle, because moving both by e moves a corner of opening alpha
/// by e / sin(alpha / 2).
struct BooleanResult {
  std::vector<Region> regions;
  double edge_error = 0;
  double corner_error = 0;
};

/// Points closer than this times the largest coordinate (arcs' whole circles counted) become one: 2.3e-10 mm
/// for 1 m. This is 2^11 rounding errors, so that rounding does not decide, and smaller by 2^20 than a
/// probe's resolution.
inline constexpr double kBooleanSnap = 0x1p-42;
/// edge_error is this times the snapping distance used: two of them for a vertex, four for an arc so short
/// that it became a line, and reserve.
inline constexpr double kEdgeErrorInSnaps = 8;

/// Returns the material of `a` and `b`, combined. Pieces may touch or overlap, and each operand counts as
/// their union.
///
/// Arcs stay arcs about the same centre, and lines stay lines. An edge that survives whole keeps its doubles,
/// so that combine(a, a, unite) gives a again where a's outlines are simple. Contours of the result do not
/// cross and do not visit a point twice; two of them may share points. Pieces come in the order of their
/// first edge in a, then b.
///
/// Fails with ErrorCode::bad_input where the outlines are so tangled that no snapping distance up to 2^21
/// times the usual one gives a drawing without contradictions (none is known).
///
/// Laws (tests/property/geom_boolean_test.cpp), as sets, within the errors: commutative, idempotent, De
/// Morgan, area(a) + area(b) = area(a | b) + area(a & b), (a - b) & b empty, unchanged by turning, mirroring
/// and moving both.
/// Cost: O((n + k) log n), k pairs of edges whose boxes meet.
/// \pre regions made by make_region
/// \param operand_error  how far the operands' edges are off already: counted in both errors
[[nodiscard]] Result<BooleanResult> combine(const std::vector<Region>& a, const std::vector<Region>& b,
                                            BooleanOperation operation, double operand_error = 0);

/// Returns the union of pieces that may overlap, cross themselves or touch: the points around which they wind
/// at least once, counter-clockwise. Errors and failures are those of combine().
[[nodiscard]] Result<BooleanResult> united(const std::vector<Region>& pieces, double operand_error = 0);

/// Makes regions from closed contours in any direction and order, by containment. A contour inside an even
/// number of others is an outline, and one inside an odd number is a hole of the innermost. Edges keep their
/// doubles.
///
/// Fails as make_region does (contours are named "contour 3"), and with the sentence of fault_of
/// (region_check.hpp) where contours meet. Cost: O((n + k) log n), k as above or edges met by a ray from each
/// contour.
[[nodiscard]] Result<std::vector<Region>> nest_contours(std::vector<Contour> contours);

}  // namespace lekalo::geom

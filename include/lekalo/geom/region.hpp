#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/point.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::geom {

/// Regions of lines and arcs; why they are as they are: docs/design/geometry.md.

enum class EdgeKind : std::uint8_t { line, arc_ccw, arc_cw };

/// One edge of a contour. For a line `centre` is not used; make_region sets it to (0, 0).
struct Edge {
  EdgeKind kind = EdgeKind::line;
  Point from, to, centre;
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// How far an arc's two ends may differ in their distance from its centre: kArcConsistency millimetres, plus
/// kArcConsistencyRelative of the larger of the two. Drawing programs write 6 to 16 digits; a larger value
/// would accept arcs whose curve is ambiguous by more than a probe can see, a smaller one refuses real files.
///
/// The curve meant is the circle about `centre` with the mean of the two radii, between the two directions,
/// joined to its ends along them; whoever needs a one-sided bound adds the difference of the radii.
inline constexpr double kArcConsistency = 1e-3;
inline constexpr double kArcConsistencyRelative = 1e-6;

/// A closed contour: each edge begins exactly where the one before it ends (equal doubles). An arc with
/// from == to is a full circle and then the only edge of its contour.
using Contour = std::vector<Edge>;

/// Mean of the distances of an arc's ends from its centre. \pre an arc
[[nodiscard]] double arc_radius(const Edge& arc) noexcept;

/// Angle an arc turns through about its centre in its own direction, in (0, 2 pi], 2 pi for a full circle;
/// within 4e-15 of the exact one. Which side of a half turn it is on is decided exactly.
/// \pre an arc of a region made by make_region
[[nodiscard]] double arc_sweep(const Edge& arc) noexcept;

/// One bounded piece of the plane: outer contour counter-clockwise, holes clockwise, material on the left of
/// every edge. Several pieces are a std::vector<Region>. Wherever their edges have numbers, these run from 0
/// through all pieces and contours, each outer contour before its holes.
struct Region {
  Contour outer;
  std::vector<Contour> holes;
  friend bool operator==(const Region&, const Region&) = default;
};

/// Checks contours and turns each into its normal direction; a contour keeps its first point. Contours may
/// come in either direction ("islands" of a pocket do).
///
/// Fails with ErrorCode::bad_input, naming contour ("outer contour", "hole 0") and edge (0-based, with the
/// numbers): a coordinate that is not is_exact, an edge that does not begin where the one before ends, a line
/// of no length, an arc end at its centre, radii that differ by more than the consistency above, ends in one
/// direction from the centre but not the same point (no telling a full circle from nothing), a full circle
/// with other edges, no edges, or an area that rounding could turn (within signed_area's bound of 0).
/// That contours do not cross themselves or each other, and that holes lie inside, is decided where Booleans
/// are, not here. Cost: O(edges).
[[nodiscard]] Result<Region> make_region(Contour outer, std::vector<Contour> holes = {});

/// Area inside the edges (lines and the arcs' curves), positive when counter-clockwise. Square millimetres.
///
/// \return within 2 u |area| + n 2^-98 c^2 of the exact area, u = 2^-53, n edges, c the largest coordinate;
///         each arc of radius r and sweep phi adds 4e-15 r^2 min(1, phi^2 / 4) and 8 u of the area beside its
///         chord.
/// Laws (tests/property/geom_region_test.cpp): signed_area(reversed(c)) == -signed_area(c), and equal for
/// every first edge, exactly for lines on a grid, within the bound elsewhere. Cost: O(n). Source: shoelace
/// formula in double-double arithmetic, plus r^2 (phi - sin phi) / 2 for each arc.
[[nodiscard]] double signed_area(const Contour& contour) noexcept;

/// How many edges the pieces have, one above the largest number of an edge. O(contours).
[[nodiscard]] std::size_t edges_in(const std::vector<Region>& regions) noexcept;

/// Area of the material: outer less holes.
[[nodiscard]] double area(const Region& region) noexcept;
/// Their sum: pieces lie apart.
[[nodiscard]] double area(const std::vector<Region>& regions) noexcept;

/// Corners of the axis-parallel box of the edges, arcs at their mean radius, within 4 u of the largest
/// coordinate plus radius; both (0, 0) for no edges.
[[nodiscard]] Box bounds(const Contour& contour) noexcept;

/// The same curve in the other direction; of a contour from the same first point. reversed(reversed(c)) == c.
[[nodiscard]] Edge reversed(Edge edge) noexcept;
[[nodiscard]] Contour reversed(const Contour& contour);

}  // namespace lekalo::geom

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/point.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::geom {

/// How far an arc's two ends may differ in their distance from its centre: kArcConsistency millimetres, plus
/// kArcConsistencyRelative of the radius. Drawing programs write 6 to 16 digits; a larger value would accept
/// arcs whose curve is ambiguous by more than a probe can see, a smaller one refuses real files.
/// The curve meant is the circle about `centre` with the mean of the two radii, between the two directions;
/// whoever needs a one-sided bound adds the difference of the radii.
inline constexpr double kArcConsistency = 1e-3;
inline constexpr double kArcConsistencyRelative = 1e-6;

enum class EdgeKind : std::uint8_t { line, arc_ccw, arc_cw };

/// One edge of a contour. For a line `centre` is not used. An arc with from == to is a full circle.
struct Edge {
  EdgeKind kind = EdgeKind::line;
  Point from, to, centre;
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// A closed contour: each edge begins exactly where the one before it ends (equal doubles).
using Contour = std::vector<Edge>;

/// A bounded piece of the plane: outer contour counter-clockwise, holes clockwise, material on the left of
/// every edge. Files may turn contours either way ("islands" of a pocket too); `make_region` normalises.
struct Region {
  Contour outer;
  std::vector<Contour> holes;
};

/// Checks (finite, closed, arcs consistent, no zero-length line, area not zero) and turns contours into the
/// normal direction. Error names contour and edge (0-based). That contours do not cross each other is decided
/// where Booleans are (any-shape locate), not here.
[[nodiscard]] Result<Region> make_region(Contour outer, std::vector<Contour> holes);

/// Exact area between the edges (lines and circular arcs), positive when counter-clockwise. Square mm.
[[nodiscard]] double signed_area(const Contour& contour) noexcept;

[[nodiscard]] Contour reversed(const Contour& contour);

/// The flat form that kernels take, also in a browser: per edge kFlatEdgeStride doubles
/// (from.x, from.y, to.x, to.y, centre.x, centre.y, direction), direction 0 for a line, +1 for a
/// counter-clockwise arc, -1 for a clockwise one; contour c is edges [starts[c], starts[c + 1]), contour 0 the outer.
struct FlatRegion {
  std::vector<double> edges;
  std::vector<std::uint32_t> starts;
};
inline constexpr std::size_t kFlatEdgeStride = 7;

[[nodiscard]] FlatRegion flatten(const Region& region);
/// Inverse of flatten; \pre made by flatten.
[[nodiscard]] Region unflatten(const FlatRegion& flat);

}  // namespace lekalo::geom

#pragma once

#include <optional>

#include "io/text/decimal.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// Shapes from the numbers of a file, and their images under affine maps, each with a bound on what rounding
/// did to it (docs/design/drawing.md, "Errors").

inline constexpr double kUnitRoundoff = 0x1p-53;

/// A shape and how far the exact one may be from it, mm (as DrawnCurve::error).
struct BoundedShape {
  Shape shape;
  double error = 0;
};

/// A point of a file; each coordinate is within `error` of the exact one.
struct BoundedPoint {
  geom::Point at;
  double error = 0;
};

/// Sine and cosine of an angle in degrees; exact for whole quarter turns. |error| of either: kDegreesError.
struct Direction {
  geom::Point unit;
  bool exact = false;
};
inline constexpr double kDegreesError = 0x1p-51;
/// \pre finite
[[nodiscard]] Direction direction_of_degrees(double degrees) noexcept;

/// p -> (xx x + xy y, yx x + yy y) + shift. The exact map's entries are within linear_error, its shift within
/// shift_error in x and in y.
struct Affine {
  double xx = 1, xy = 0, yx = 0, yy = 1;
  geom::Point shift;
  double linear_error = 0, shift_error = 0;

  [[nodiscard]] double determinant() const noexcept { return xx * yy - xy * yx; }
  [[nodiscard]] bool is_identity() const noexcept;
  /// Largest factor by which it stretches the larger of |x| and |y|.
  [[nodiscard]] double size() const noexcept;
};
[[nodiscard]] BoundedPoint image(const Affine& map, const BoundedPoint& p) noexcept;
/// First `inner`, then `outer`.
[[nodiscard]] Affine composed(const Affine& outer, const Affine& inner) noexcept;

/// The image of a shape. Circles stay circles under maps that keep angles (within rounding), and become
/// ellipses under others; nullopt where the map makes the shape flat (determinant 0) and it is not a line or
/// spline, or makes a number too large (kLargestMillimetres).
[[nodiscard]] std::optional<BoundedShape> image(const Affine& map, const BoundedShape& shape);

[[nodiscard]] BoundedShape line_between(const BoundedPoint& from, const BoundedPoint& to) noexcept;

/// The arc from one point to another with this bulge (tangent of a quarter of the sweep, positive
/// counter-clockwise), which is within `bulge_error` of the exact one; an arc flatter than its own rounding,
/// or without a bulge, is the line. Where the ends are the same there is nothing: nullopt. \pre |bulge| <=
/// 1e9
[[nodiscard]] std::optional<BoundedShape> bulge_arc(const BoundedPoint& from, const BoundedPoint& to,
                                                    double bulge, double bulge_error = 0);

/// Counter-clockwise; begins on the right of the centre (at it, where the radius is lost in rounding).
/// \pre radius > 0
[[nodiscard]] BoundedShape circle(const BoundedPoint& centre, const Millimetres& radius) noexcept;

/// An arc of an ellipse, or the arc of a circle where u and v are orthogonal and equal within rounding; the
/// line between its ends where it is too short to be told from a whole turn. `error` as of a BoundedPoint: of
/// centre, u, v together, at every parameter. \pre cross(u, v) != 0, begin < end <= begin + 2 pi, |begin| <=
/// 1e4
[[nodiscard]] BoundedShape conic(const EllipseArc& arc, double error);

/// The arc of a circle between ends and about a centre of which each coordinate is within `error` of the
/// exact one; `sweep` > 0 tells a whole turn from nothing. The line between its ends where that is all that
/// rounding left.
[[nodiscard]] BoundedShape circle_arc(const geom::Edge& arc, double sweep, double error) noexcept;

/// The ellipse's point at a parameter.
[[nodiscard]] geom::Point point_at(const EllipseArc& arc, double t) noexcept;

}  // namespace lekalo::io

#pragma once

#include <optional>

#include "plane.hpp"

namespace lekalo::nc {

/// An arc as a control computes it from its words.
struct Arc {
  Vector start, end, centre;
  double start_radius = 0, end_radius = 0;  ///< mm
  double sweep = 0;                         ///< radians in (0, 2 pi], without whole turns by P
};

/// A smaller sweep, in rad, is refused: LinuxCNC takes ends closer than 1e-6 rad for one point, and such an
/// arc for a full circle.
inline constexpr double kSmallestSweep = 2e-6;

/// \param end_is_start  the end is the same point as the start: a full circle.
[[nodiscard]] Arc arc_by_centre(const Vector& start, const Vector& end, const Vector& centre, bool clockwise,
                                bool end_is_start) noexcept;

/// The arc of radius |radius| from start to end, the shorter way round when radius > 0; a half circle about
/// the middle when the ends are as far apart as the diameter, or further. \pre start != end, radius != 0
[[nodiscard]] Arc arc_by_radius(const Vector& start, const Vector& end, const geom::DoubleDouble& radius,
                                bool clockwise) noexcept;

/// True when the ends are at least the diameter apart, within the 1e-12 that controls grant.
[[nodiscard]] bool spans_diameter(const Vector& start, const Vector& end,
                                  const geom::DoubleDouble& radius) noexcept;

/// True when LinuxCNC's defaults accept the arc: the radii at the ends agree within 0.002 sqrt(2) inch (0.02
/// sqrt(2) mm in G21), or within 0.1 %, and are not zero.
[[nodiscard]] bool radii_agree(const Arc& arc, LengthUnit unit) noexcept;
/// The same for controls other than LinuxCNC, which run a spiral where the radii are a few percent apart: 2 %
/// and 0.5 mm.
[[nodiscard]] bool radii_nearly_agree(const Arc& arc) noexcept;
/// True when LinuxCNC accepts an arc by radius: its ends are no more than the diameter and 0.0001 inch apart.
[[nodiscard]] bool radius_reaches(const Vector& start, const Vector& end,
                                  const geom::DoubleDouble& radius) noexcept;

/// The point of the arc's plane that has these coordinates, on the plane's two axes: x y, z x or y z.
[[nodiscard]] Vector in_plane(const Vector& p, const geom::DoubleDouble& z, int plane) noexcept;

/// True when not even the last digit tells them apart.
[[nodiscard]] bool same_point(const Vector& a, const Vector& b) noexcept;

struct ArcEnds {
  Vector start, end;
};
/// The ends of a motion, in its plane and the program's frame.
[[nodiscard]] ArcEnds arc_ends(const Motion& motion) noexcept;

/// The arc of a motion of kind arc_by_centre or arc_by_radius, in its plane and the program's frame.
[[nodiscard]] Arc motion_arc(const Motion& motion) noexcept;

/// The largest distance in mm between points of the two arcs at equal fractions of their length. `exact` is
/// the image of the program's arc, and `written` is what the control makes of the written words. There is no
/// value when the two do not run the same way round or are too far apart to say. docs/design/nc-rewrite.md,
/// "Bounds", derives it.
[[nodiscard]] std::optional<double> arc_deviation(const Arc& exact, const Arc& written) noexcept;

}  // namespace lekalo::nc

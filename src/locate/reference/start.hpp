#pragma once

#include <array>
#include <optional>

#include "lekalo/base/error.hpp"
#include "lekalo/base/random.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::locate {

/// The outline as a thin shell of even thickness: where it balances and which way it is long.
struct OutlineMoments {
  geom::Point centroid;
  /// The angle of the axis of least inertia, in (-pi/2, pi/2]; 0 where every axis is alike.
  double axis = 0;
};

[[nodiscard]] OutlineMoments outline_moments(const geom::ConvexPolygon& polygon) noexcept;

/// Returns a point that is uniform in the polygon's area.
[[nodiscard]] geom::Point random_point(const geom::ConvexPolygon& polygon, Random& random) noexcept;

/// Fails with usage when the window's ends are not finite, too large for sincos, or the wrong way round.
[[nodiscard]] Result<void> check_window(const AngleWindow& window);

/// Returns the angle, whole turns added, that lies in the window, or nullopt when there is none.
[[nodiscard]] std::optional<double> fold_into(const AngleWindow& window, double angle) noexcept;
/// Returns what fold_into returns or, when there is none, the nearest end of the window (by turning).
[[nodiscard]] double nearest_in(const AngleWindow& window, double angle) noexcept;

/// Returns the translation that brings the part's point `from`, after turning by theta, onto `to`.
[[nodiscard]] geom::Point translation_onto(geom::Point from, geom::Point to, double theta) noexcept;

/// Returns the two angles (half a turn apart) that align the axes of least inertia of the outlines, not
/// folded.
[[nodiscard]] std::array<double, 2> aligned_axes(const OutlineMoments& part,
                                                 const OutlineMoments& blank) noexcept;

/// Returns the placement with its clearance recomputed for these very numbers and rounded down.
[[nodiscard]] Placement measured_placement(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                                           double x, double y, double theta) noexcept;

}  // namespace lekalo::locate

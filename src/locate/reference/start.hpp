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
  double axis = 0;  ///< angle of the axis of least inertia, in (-pi/2, pi/2]; 0 where every axis is alike
};

[[nodiscard]] OutlineMoments outline_moments(const geom::ConvexPolygon& polygon) noexcept;

/// Uniform in the polygon's area.
[[nodiscard]] geom::Point random_point(const geom::ConvexPolygon& polygon, Random& random) noexcept;

/// usage when the window's ends are not finite, too large for sincos, or the wrong way round.
[[nodiscard]] Result<void> check_window(const AngleWindow& window);

/// The angle, whole turns added, that lies in the window; nullopt when there is none.
[[nodiscard]] std::optional<double> fold_into(const AngleWindow& window, double angle) noexcept;
/// The same, or the nearest end of the window (by turning) when there is none.
[[nodiscard]] double nearest_in(const AngleWindow& window, double angle) noexcept;

/// Translation that brings the part's point `from`, after turning by theta, onto `to`.
[[nodiscard]] geom::Point translation_onto(geom::Point from, geom::Point to, double theta) noexcept;

/// The two angles (half a turn apart) that align the axes of least inertia of the outlines, not folded.
[[nodiscard]] std::array<double, 2> aligned_axes(const OutlineMoments& part,
                                                 const OutlineMoments& blank) noexcept;

/// The placement with its clearance recomputed for these very numbers and rounded down.
[[nodiscard]] Placement measured_placement(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                                           double x, double y, double theta) noexcept;

}  // namespace lekalo::locate

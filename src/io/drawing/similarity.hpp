#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io::detail {

/// p -> linear (p - before) + after, the linear part a turn, perhaps mirrored, times `factor`.
struct Similarity {
  double xx = 1, xy = 0, yx = 0, yy = 1;
  geom::Point before, after;
  double factor = 1;
  bool mirrors = false;
  double linear_error = 0;  ///< of each entry
  double shift_error = 0;   ///< how far points are off by those of before and after

  [[nodiscard]] geom::Point operator()(geom::Point p) const noexcept {
    const geom::Point q = p - before;
    return geom::Point{xx * q.x + xy * q.y, yx * q.x + yy * q.y} + after;
  }
};

[[nodiscard]] Similarity move_by(geom::Point shift) noexcept;
[[nodiscard]] Similarity turn_about(geom::Point centre, double degrees) noexcept;
[[nodiscard]] Similarity scale_about(geom::Point centre, double factor) noexcept;
/// Changes the sign of x (or of y).
[[nodiscard]] Similarity flip(bool x) noexcept;
/// \pre a != b
[[nodiscard]] Similarity mirror_in_line(geom::Point a, geom::Point b) noexcept;

/// How far the image of a point may be from the exact one, for points with coordinates up to `largest`.
[[nodiscard]] double rounding_of(const Similarity& map, double largest) noexcept;

[[nodiscard]] geom::Edge image(const Similarity& map, const geom::Edge& edge) noexcept;
/// Edges that rounding leaves no length are left out, arcs hardly longer than rounding become lines: both
/// less than kShortest times the largest coordinate away. Fails as make_region does.
inline constexpr double kShortest = 0x1p-47;
[[nodiscard]] Result<geom::Region> image(const Similarity& map, const geom::Region& region);
/// A box around the image of a box.
[[nodiscard]] geom::Box image(const Similarity& map, const geom::Box& box) noexcept;
/// A box around all points that go into the box.
[[nodiscard]] geom::Box preimage(const Similarity& map, const geom::Box& box) noexcept;

/// Largest magnitude of a coordinate of the box.
[[nodiscard]] double largest_of(const geom::Box& box) noexcept;
/// The largest magnitude of a coordinate of its edges' ends and centres.
[[nodiscard]] double largest_of(const geom::Region& region) noexcept;

}  // namespace lekalo::io::detail

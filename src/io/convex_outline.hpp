#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lekalo/io/contour_file.hpp"

namespace lekalo::io {

/// Decimals on one line come to lie beside it when they are read: each of three points moves by at most
/// sqrt(2) coordinate errors, so the middle one lies within 2 sqrt(2) < 3 of them from the segment of the
/// other two. A smaller value would refuse straight edges; a larger one calls dents straight that are in the
/// file.
inline constexpr double kCollinearErrors = 3;

/// A contour beside its convex hull. `ring` holds the file indices without duplicates, turned to run
/// counter-clockwise; `hull` the positions in `ring` of the hull's strict corners, ascending.
struct Outline {
  const ContourFile* file = nullptr;
  std::vector<std::size_t> ring, duplicates, hull;
  bool reversed = false;

  [[nodiscard]] geom::Point point(std::size_t position) const { return file->points[ring[position]]; }
  [[nodiscard]] std::size_t after(std::size_t position) const {
    return position + 1 == ring.size() ? 0 : position + 1;
  }
  /// "point 7 (line 9: 12.5, 3 mm)".
  [[nodiscard]] std::string name(std::size_t position) const;
};

/// Fails with ErrorCode::bad_input for points without area and for a contour that does not run once around
/// its hull. Cost: O(n log n). \pre file outlives the outline
[[nodiscard]] Result<Outline> make_outline(const ContourFile& file);

/// The hull without corners that the rounding of straight edges made: each left out lies within `tolerance`
/// mm (largest found in `moved`) of the segment between those that stay. Positions in `ring`, ascending;
/// fewer than three when the contour is no wider than the tolerance. Cost: O(corners log^2 n).
[[nodiscard]] std::vector<std::size_t> true_corners(const Outline& outline, double tolerance);

/// Distance from p to the segment ab, never below the exact one, and 0 only where that is 0; relative error
/// 1e-15.
[[nodiscard]] double distance_to_segment_up(geom::Point p, geom::Point a, geom::Point b);
/// The same to the line through a and b, a != b; positive left of it, negative right. Magnitude rounded up.
[[nodiscard]] double depth_left_of_line_up(geom::Point p, geom::Point a, geom::Point b);

}  // namespace lekalo::io

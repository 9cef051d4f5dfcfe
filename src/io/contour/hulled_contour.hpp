#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lekalo/io/contour/contour_file.hpp"

namespace lekalo::io {

/// Decimals on one line come to lie beside it when they are read: each of three points moves by at most
/// sqrt(2) coordinate errors, so the middle one lies within 2 sqrt(2) < 3 of them from the segment of the
/// other two. A smaller value would refuse straight edges; a larger one calls dents straight that are in the
/// file.
inline constexpr double kCollinearErrors = 3;

/// A contour and the corners of its convex hull. `ring` holds the file indices without duplicates, turned to
/// run counter-clockwise; `corners` positions in `ring`, ascending: a strictly convex polygon,
/// counter-clockwise.
struct HulledContour {
  const ContourFile* file = nullptr;
  std::vector<std::size_t> ring, duplicates, corners;
  bool reversed = false;

  [[nodiscard]] geom::Point point(std::size_t position) const { return file->points[ring[position]]; }
  [[nodiscard]] std::size_t after(std::size_t position) const {
    return position + 1 == ring.size() ? 0 : position + 1;
  }
  /// The name of a point in messages: "point 7 (line 9: 12.5, 3 mm)".
  [[nodiscard]] std::string name(std::size_t position) const;
};

/// Corners of the hull that only rounding made are left out: each lies within `tolerance` mm of the segment
/// between those that stay around it. Fails with ErrorCode::bad_input for a contour no wider than the
/// tolerance, and for one that does not run once around the corners. Cost: O(n log n). \pre file outlives the
/// outline
[[nodiscard]] Result<HulledContour> find_hull(const ContourFile& file, double tolerance);

/// The distance from p to the segment ab, never below the exact one, and 0 only where that is 0; relative
/// error 1e-15.
[[nodiscard]] double distance_to_segment_up(geom::Point p, geom::Point a, geom::Point b);
/// The same to the line through a and b, a != b; positive left of it, negative right. Magnitude rounded up.
[[nodiscard]] double depth_left_of_line_up(geom::Point p, geom::Point a, geom::Point b);

}  // namespace lekalo::io

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// What is wrong with regions whose contours are each in order (make_region), if something is: contours that
/// cross or touch themselves or each other, holes that lie outside their outline or in another hole, pieces
/// inside the material of another piece. One sentence that names piece, contour and edge (0-based) and the
/// place in millimetres.
///
/// Outlines that come closer than kEdgeDistanceError times the largest coordinate count as touching. Two
/// neighbouring edges meet at the end they share; that they also cross elsewhere is seen for lines alone.
/// Cost: O((n + k) log n) for n edges and k pairs whose boxes meet.
[[nodiscard]] std::optional<std::string> fault_of(const std::vector<Region>& regions);

}  // namespace lekalo::geom

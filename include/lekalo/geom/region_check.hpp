#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// The first fault of regions whose contours are each in order (make_region), if there is one. Faults are
/// contours that cross or touch themselves or each other, holes that lie outside their outline or in another
/// hole, pieces inside the material of another piece. One sentence that names piece, contour and edge
/// (0-based) and the place in millimetres.
///
/// Outlines that come closer than kEdgeDistanceError times the largest coordinate count as touching. Two
/// neighbouring edges meet at the end they share; that one of two lines runs back along the other is decided
/// exactly, a second crossing where one is an arc counts when it cuts off more than kArcConsistency allows.
/// Cost: O((n + k) log n) for n edges and k pairs whose boxes meet.
[[nodiscard]] std::optional<std::string> fault_of(const std::vector<Region>& regions);

/// The numbers of two edges that cross or touch, a < b.
struct MeetingEdges {
  std::uint32_t a = 0, b = 0;
  Point at;  ///< mm, on a
};

/// The first such pair (smallest a, then b), by the rule and at the cost of fault_of.
[[nodiscard]] std::optional<MeetingEdges> first_meeting(const std::vector<Region>& regions);

/// Returns all of them, in order; nothing where more boxes meet than limits let through. Edges that do not
/// follow each other meet when they come within `apart` mm, too.
[[nodiscard]] std::optional<std::vector<MeetingEdges>> all_meetings(const std::vector<Region>& regions,
                                                                    double apart = 0);

}  // namespace lekalo::geom

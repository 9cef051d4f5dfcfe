#pragma once

#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom {

/// Regions grown by `distance` mm with round corners (all points within it of the material), or shrunk by
/// -distance where it is negative (the points further than that from everything outside). Lines give lines,
/// arcs arcs about the same centre, corners arcs about the corner. Pieces may touch or overlap, and count as
/// their union; what grows together is one piece, what is cut apart is several.
///
/// Every boundary point of the result lies at |distance| from the boundary of the regions, within twice
/// edge_error; pieces and gaps may be missing or filled, and corners are off, as in boolean.hpp. Where
/// regions cross themselves, or shrink and touch or overlap, their union is taken first, and its corner_error
/// is part of edge_error.
///
/// Fails as combine() does, and with ErrorCode::bad_input for a distance that is not is_exact_coordinate
/// (predicates.hpp): NaN, infinite, beyond 1e144. Laws (tests/property/geom_offset_test.cpp): the distance
/// just said; opening (shrink, then grow) lies inside and closing (grow, then shrink) around the regions; a
/// convex region of boundary length L grows by L d + pi d^2; offset(offset(A, r), s) is offset(A, r + s) for
/// r, s >= 0. Cost: O((n + k) log n) as combine(), about five edges for each. \pre regions made by
/// make_region Source: the union of a region with what each edge and corner sweeps; every such set is bounded
/// by lines and arcs, and sides that two of them share cancel.
[[nodiscard]] Result<BooleanResult> offset(const std::vector<Region>& regions, double distance);

/// The same with a distance for each edge, in the order of their numbers: with those above 0 all points
/// within the distance of the edge are added; below 0 all points within it are taken off first (the rim along
/// the edge); 0 leaves the edge alone. Corners between edges get the larger of the two. Errors as offset().
/// \pre edges_in(regions) distances, finite
[[nodiscard]] Result<BooleanResult> offset_edges(const std::vector<Region>& regions,
                                                 const std::vector<double>& distances);

}  // namespace lekalo::geom

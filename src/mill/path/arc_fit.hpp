#pragma once

#include "lekalo/mill/path.hpp"

namespace lekalo::mill {

/// Says the same path in fewer motions: runs of level lines of one kind become lines and arcs, and arcs about
/// one centre become one. Ends of runs stay. Every vertex of the path lies within tolerance / 2 of the result
/// and every point within tolerance, and the other way round. Arcs are at most half a turn of at most 1 m
/// radius; longer radii that were given become lines within the tolerance. \pre tolerance > 0. Cost: O(n log
/// n).
[[nodiscard]] PocketPath fitted(const PocketPath& path, double tolerance);

}  // namespace lekalo::mill

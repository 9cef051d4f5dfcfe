#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include "lekalo/geom/distance.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::cases {

/// From p to the nearest boundary point of the ring, side by side (never negative, inside or out).
inline double distance_to_boundary(geom::Point p, const geom::Ring& ring) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i)
    least = std::min(least, geom::distance_to_segment(p, ring[i == 0 ? ring.size() - 1 : i - 1], ring[i]));
  return least;
}

}  // namespace lekalo::cases

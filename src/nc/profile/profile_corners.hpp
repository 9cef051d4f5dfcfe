#pragma once

#include <vector>

#include "profile_path.hpp"

namespace lekalo::nc {

/// The path with edges of their own, marked as slow, up to options.corners.distance_mm along it before and
/// behind each corner. New ends are rounded, and no edge is cut shorter than ten steps of the last decimal.
/// \param path  one motion after the other; a closed one has a corner where it begins, too
[[nodiscard]] std::vector<WrittenEdge> with_slow_corners(const std::vector<WrittenEdge>& path,
                                                         const ProfileOptions& options);

}  // namespace lekalo::nc

#pragma once

#include <vector>

#include "lekalo/layout/document.hpp"

namespace lekalo::io {

/// Copies of an outline that a drawing has elsewhere differ by no more than this, mm: what decimals of
/// programs lose where they say the same thing at another place.
inline constexpr double kSameOutline = 1e-5;

/// Makes of parts with one outline, moved but not turned, one that is wanted as often; those with marks have
/// the same marks. The first stays. Returns the largest difference among what was taken for one, mm. Cost:
/// O(n log n), and for each part that of comparing it with others of as many points.
[[nodiscard]] double merge_equal(std::vector<layout::Part>& parts);

}  // namespace lekalo::io

#pragma once

#include <cstdint>
#include <string>

namespace lekalo::io::detail {

/// Decimals with the fewest places that a reader of docs/formats.md brings back to the same step.

/// Millimetres of a coordinate or a length in grid steps. \pre |steps| <= 2^41
void append_mm(std::string& text, std::int64_t steps);
/// Appends a gap so that rounding it up to a step, as readers do, gives it back. \pre 0 <= steps <= 2^41
void append_gap(std::string& text, std::int64_t steps);
/// A cosine or sine in steps of 2^-52. \pre |steps| <= 2^53
void append_rotation_step(std::string& text, std::int64_t steps);

}  // namespace lekalo::io::detail

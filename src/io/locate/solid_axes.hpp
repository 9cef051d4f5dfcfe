#pragma once

#include <array>

namespace lekalo::io {

/// The words for the axes of a box of poses in documents, in the order of locate::SolidTree::Axis.
inline constexpr std::array<const char*, 6> kSolidAxes{"x", "y", "z", "turn_x", "turn_y", "turn_z"};

}  // namespace lekalo::io

#pragma once

#include <array>
#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/field/voxel_model.hpp"

namespace lekalo::draw {

/// The four M-images A, B, C, D as grey PNG pictures, y up, with the grid's numbers in their texts: all that
/// is needed to read value and gradient back (how, and with which error: tests/support/voxel_reader.hpp). 16
/// bits where the palette needs them, else 8. ErrorCode::environment when the library fails.
[[nodiscard]] Result<std::array<std::string, 4>> voxel_pngs(const field::VoxelImages& images);

/// The function itself for people: 0 and below black, its largest value white, 8 bits.
[[nodiscard]] Result<std::string> value_png(const field::FieldGrid& grid);

}  // namespace lekalo::draw

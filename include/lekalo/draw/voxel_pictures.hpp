#pragma once

#include <array>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"
#include "lekalo/field/voxel_model.hpp"

namespace lekalo::draw {

/// The four M-images A, B, C, D as grey PNG pictures, y up, with the grid's numbers in their texts: all that
/// is needed to read value and gradient back (field::read_node, its error field::reading_error). 16 bits
/// where the palette needs them, else 8. ErrorCode::environment when the library fails.
[[nodiscard]] Result<std::array<std::string, 4>> voxel_pngs(const field::VoxelImages& images);

/// Law: gives what voxel_pngs was given. bad_input, naming the file, for what is no such picture, and for
/// pictures of different grids.
[[nodiscard]] Result<field::VoxelImages> parse_voxel_pngs(const std::array<std::string_view, 4>& bytes,
                                                          const std::array<std::string, 4>& names);

/// The function itself for people: 0 and below black, its largest value white, 8 bits.
[[nodiscard]] Result<std::string> value_png(const field::FieldGrid& grid);

}  // namespace lekalo::draw

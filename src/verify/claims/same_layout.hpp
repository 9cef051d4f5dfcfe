#pragma once

#include <string>
#include <vector>

#include "verify/layout/layout_document.hpp"

namespace lekalo::verify {

/// The step of the grid on which layouts lie, mm.
inline constexpr double kStep = 0x1p-20;

/// Returns the loops in their order, each from its least point on: a file may begin and turn them otherwise.
[[nodiscard]] std::vector<GridLoop> loops_of(const GridOutline& outline);

/// Says in sentences what a layout has otherwise than the one that it was made from. Placements may be there,
/// gone or moved, but locked ones of `given` are there and where they were. Texts for people are not
/// compared. Cost: O(bytes of both). \param given  may have outlines that are drawn and have no polygon yet
[[nodiscard]] std::vector<std::string> differences(const WrittenLayout& layout, const WrittenLayout& given);

}  // namespace lekalo::verify

#pragma once

#include <cstdint>
#include <vector>

#include "verify/layout/layout_document.hpp"

namespace lekalo::verify {

/// Returns twice the area inside an outline, in square steps; below 2^123.
[[nodiscard]] Wide twice_area(const GridOutline& outline);

/// A sheet in use, and what its figures are to be. Areas are twice those, in square steps.
struct SheetFigures {
  std::size_t stock = 0;
  std::int64_t copy = 0;
  std::vector<GridOutline> parts;
  Wide parts_area = 0, material_area = 0;
  std::int64_t last = 0;  ///< steps
};

/// Returns the sheets in use, by stock and copy.
[[nodiscard]] std::vector<SheetFigures> sheets_of(const WrittenLayout& layout);

/// Says whether a rectangle is free: in the material, and of parts and defects.
[[nodiscard]] bool is_free(const GridBox& box, const SheetFigures& sheet, const WrittenStock& stock);

}  // namespace lekalo::verify

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "drawn_file.hpp"
#include "placed_inside.hpp"
#include "verify/layout/layout_document.hpp"

namespace lekalo::verify {

/// A stock and its copy, from 0.
using SheetOf = std::pair<std::size_t, std::int64_t>;

/// A sheet with what lies on it, in mm, as exports draw it: curves where an outline has them, else the
/// polygon.
struct PlacedSheet {
  SheetOf sheet;
  std::string name;  ///< STOCK, or STOCK#COPY from 1 where there are several
  /// On the layers CUT, SHEET, DEFECT, ZONE and AREA.
  std::vector<DrawnLine> lines;
  struct Part {
    std::uint64_t id;
    /// The outer contour, then the holes.
    std::vector<std::vector<Stroke>> contours;
    /// The direction of the grain on the sheet, of a part that has one.
    std::optional<Place> grain;
    std::vector<PlacedInside> inside{};
  };
  std::vector<Part> parts;
};

/// Returns the sheets in use, in the order of stocks and copies, or the one of this name. bad_input where
/// nothing is placed, usage where no sheet has the name.
[[nodiscard]] Result<std::vector<PlacedSheet>> placed_sheets(const WrittenLayout& layout,
                                                             const std::string& file,
                                                             const std::string& sheet);

/// Moves the second sheet and the following beside those before, by whole tens of millimetres.
void put_side_by_side(std::vector<PlacedSheet>& sheets);

/// Cuts an edge into pieces that all functions of stroke.hpp take.
void add_pieces(const Stroke& edge, double longest, std::vector<Stroke>& pieces);

}  // namespace lekalo::verify

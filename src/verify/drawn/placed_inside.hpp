#pragma once

#include <string>
#include <vector>

#include "drawn_file.hpp"
#include "verify/layout/layout_document.hpp"

namespace lekalo::verify {

/// A line, or a text with its strokes, that lies on a placed part: in mm, in the sheet's frame.
struct PlacedInside {
  bool is_engraved = false;      ///< programs may follow it
  std::vector<DrawnLine> lines;  ///< on the layer and in the colour of exports
  /// One of a text, none of a line.
  std::vector<DrawnLetters> letters;
};

/// Returns what lies on the part of a piece: marks, then texts, whose letters are set in the font of single
/// lines. Cost: O(edges + letters).
[[nodiscard]] std::vector<PlacedInside> placed_inside(const WrittenPart& part, const WrittenPiece& piece);

/// Returns the text with the letters a to z as capitals: layers are told apart without regard to case.
[[nodiscard]] std::string upper_case(std::string text);

/// Moves it along x.
void move_by(double by, PlacedInside& inside);

}  // namespace lekalo::verify

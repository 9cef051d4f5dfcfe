#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "draw/paper/view.hpp"

namespace lekalo::draw {

/// Lengths on a label are mm. Its number stands above its fields, in larger letters.

/// The least side of a module of a QR code: three dots of a printer of 203 dpi.
inline constexpr double kLeastModule = 0.4;
/// The least size of the letters of a label. A line that has to be shortened may have letters of 0.8 of it.
inline constexpr double kLeastLetters = 2, kSmallerLetters = 0.8;
/// The number's letters and the distances of baselines, in multiples of the letters' size.
inline constexpr double kNumberLetters = 1.8, kLabelLine = 1.25;

/// A label that is higher than it is wide has its code below the text, any other beside it.
[[nodiscard]] inline bool is_tall(double width, double height) { return height > width; }

/// The least sides of a label.
struct LeastLabel {
  double width = 0, height = 0;
};
/// Returns the least sides of a tall label, or of another, on which the code can be read and the number and
/// the fields stand below each other. \param modules  of a side of the code, without its light margin
[[nodiscard]] LeastLabel least_label(bool tall, int modules, std::size_t fields);

/// The places of a label.
struct LabelPlan {
  Rect whole, text;
  Rect code;     ///< with its light margin
  Rect picture;  ///< of the outline; its width is 0 where there is no room
};
/// The code stands in the lower right corner, as large as readers want it. The picture takes the larger of
/// the places that the text leaves.
/// \pre the sides are not below least_label
[[nodiscard]] LabelPlan label_plan(const Rect& whole, int modules, std::size_t fields);

/// The fields of a label in lines. The first field is bold.
struct LabelLines {
  struct Line {
    std::string words;
    bool bold = false;
  };
  double letters = kLeastLetters;
  std::vector<Line> lines;
};
/// Letters are as large as the place allows with whole words, a field in as many lines as it needs. Where
/// there is no room even for the least letters, every field has a line, the first ones more of them, and what
/// remains of a field is shortened in its last line, whose words may need smaller letters (kSmallerLetters).
/// \pre no field is empty, and the place holds a line of the least letters for each
[[nodiscard]] LabelLines label_lines(const std::vector<std::string>& fields, const Rect& text);

}  // namespace lekalo::draw

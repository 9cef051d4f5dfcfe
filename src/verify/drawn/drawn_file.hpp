#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/pocket/stroke.hpp"

namespace lekalo::verify {

/// A contour or line of a drawing in mm, y up. Here an arc may have any sweep; a circle begins and ends at
/// one place.
struct DrawnLine {
  std::string layer;
  std::vector<Stroke> edges;
  bool closed = false;
  std::string colour{};  ///< "#0000ff" where the line itself says one
};

/// A text where it stands: letters run from `at` along `right`, which is as long as a capital is high times
/// how many times wider than usual letters are, and up along `up`, which is as long as a capital is high.
struct DrawnLetters {
  std::string layer, colour, text, anchor;
  Place at, right, up;
};

struct DrawnFile {
  std::vector<DrawnLine> lines;
  /// Without labels, which are on the layer LABEL.
  std::vector<DrawnLetters> texts;
};

/// Read an export as lekalo writes it, and nothing else: bad_input, with line or element, for every word that
/// lekalo does not write there. Labels are passed over. Cost: O(bytes).
[[nodiscard]] Result<DrawnFile> read_dxf(const Document& document);
[[nodiscard]] Result<DrawnFile> read_svg(const Document& document);
[[nodiscard]] Result<DrawnFile> read_hpgl(const Document& document);

[[nodiscard]] inline Stroke line_between(Place from, Place to) { return {false, true, from, to, {}, 0}; }
[[nodiscard]] inline Stroke arc_about(Place from, Place to, Place centre, bool ccw) {
  return {true, ccw, from, to, centre, 0.5 * (length(from - centre) + length(to - centre))};
}

}  // namespace lekalo::verify

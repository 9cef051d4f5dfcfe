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
};

/// Read an export as lekalo writes it, and nothing else: bad_input, with line or element, for every word that
/// lekalo does not write there. Labels are passed over. Cost: O(bytes).
[[nodiscard]] Result<std::vector<DrawnLine>> read_dxf(const Document& document);
[[nodiscard]] Result<std::vector<DrawnLine>> read_svg(const Document& document);
[[nodiscard]] Result<std::vector<DrawnLine>> read_hpgl(const Document& document);

[[nodiscard]] inline Stroke line_between(Place from, Place to) { return {false, true, from, to, {}, 0}; }
[[nodiscard]] inline Stroke arc_about(Place from, Place to, Place centre, bool ccw) {
  return {true, ccw, from, to, centre, 0.5 * (length(from - centre) + length(to - centre))};
}

}  // namespace lekalo::verify

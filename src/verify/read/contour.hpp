#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/verify/verify.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// The points of a contour file as they are written: exact decimals, file order, nothing dropped.
struct Contour {
  std::vector<Decimal> x, y;  ///< same size; in the file's unit
  /// The unit, when the file says one.
  std::optional<LengthUnit> unit;

  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// Reads a contour as docs/formats.md says; the ending of the document's name chooses the format.
/// bad_input names the line or the item.
[[nodiscard]] Result<Contour> read_contour(const Document& document);

/// Returns the ending of a file's name from its last dot, in small letters.
[[nodiscard]] std::string ending_of(std::string_view name);

/// Converts inches to millimetres, by 25.4 exactly.
void to_millimetres(Contour& contour, LengthUnit unit);

}  // namespace lekalo::verify

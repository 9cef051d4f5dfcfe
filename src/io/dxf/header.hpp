#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/decimal.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/io/drawing/drawing.hpp"

namespace lekalo::io {

/// The variables of the section HEADER that matter here.
struct DxfHeader {
  std::string_view code_page;  ///< $DWGCODEPAGE
  std::string_view unit;       ///< $INSUNITS, empty where it is absent
  std::size_t unit_line = 0;
  bool english = false;  ///< $MEASUREMENT is 0: line types and hatches in inches
};

/// A unit of length of a drawing.
struct DrawingUnit {
  const char* name = "mm";
  DecimalFactor factor;
  bool said = false;  ///< by the file or the user

  [[nodiscard]] double millimetres() const noexcept;
};

/// Says whether the sizes of a drawing that does not say its unit suggest inches: it reaches less than 120
/// units, and either all ends of lines are on 32nds and some not on halves, or $MEASUREMENT says so.
[[nodiscard]] bool suggests_inches(const std::vector<DrawnCurve>& curves, const DxfHeader& header);

/// The unit that holds when the file says one (or nothing) and the user says one (or nothing). Refused:
/// another one than the user's, one that is not a decimal number of millimetres (US survey feet), one nobody
/// cuts in (light years).
[[nodiscard]] Result<DrawingUnit> drawing_unit(const DxfHeader& header, std::optional<LengthUnit> user_says,
                                               const std::string& name);

}  // namespace lekalo::io

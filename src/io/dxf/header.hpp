#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "io/text/decimal.hpp"
#include "lekalo/base/error.hpp"

namespace lekalo::io {

/// The variables of the section HEADER that matter here.
struct DxfHeader {
  std::string_view code_page;  ///< $DWGCODEPAGE
  std::string_view unit;       ///< $INSUNITS, empty where it is absent
  std::size_t unit_line = 0;
};

/// A unit of length of a drawing.
struct DrawingUnit {
  const char* name = "mm";
  DecimalFactor factor;
  bool said = false;  ///< by the file or the user

  [[nodiscard]] double millimetres() const noexcept;
};

/// The unit that holds when the file says one (or nothing) and the user says one (or nothing). Refused:
/// another one than the user's, one that is not a decimal number of millimetres (US survey feet), one nobody
/// cuts in (light years).
[[nodiscard]] Result<DrawingUnit> drawing_unit(const DxfHeader& header, std::optional<LengthUnit> user_says,
                                               const std::string& name);

}  // namespace lekalo::io

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/verify/verify.hpp"
#include "verify/layout/layout_document.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// The price of one material in a file of rates (docs/formats.md, "Rates").
struct WrittenPrice {
  WrittenMaterial material;
  Fraction price, remnant_percent;
  /// The sides of the sheets, the smaller first, mm; without them the price is that of a square metre.
  std::optional<std::pair<double, double>> sheet;
  std::optional<double> least_remnant;  ///< mm
};

/// The part of such a file by which a quote is rechecked.
struct WrittenRates {
  std::string currency;
  unsigned long decimals = 2;
  Fraction per_hour, setup_per_hour, per_pierce, per_m_cut, margin_percent, tax_percent;
  Fraction setup_once, setup_per_sheet;  ///< s
  std::vector<WrittenPrice> prices;
};

/// Reads a file of rates. bad_input names the field. What the machine can do, and what is printed, is not
/// read. Cost: O(bytes).
[[nodiscard]] Result<WrittenRates> read_written_rates(const Document& document);

}  // namespace lekalo::verify

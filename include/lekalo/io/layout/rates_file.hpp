#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/io/text/length_word.hpp"
#include "lekalo/layout/document.hpp"
#include "lekalo/nc/machine_time.hpp"

namespace lekalo::io {

/// Files of rates, "lekalo-rates/1": how fast a machine is, and what its time, its wear and its material
/// cost. docs/formats.md, "Rates", has the form.

/// A number of such a file, exactly, in millionths: no rate has more than six decimals.
using Millionths = std::int64_t;
inline constexpr Millionths kOneInMillionths = 1'000'000;

/// The price of stock of one material.
struct MaterialRate {
  std::string material;
  std::int64_t thickness = 0;  ///< grid steps
  /// The size of the sheets, smaller side first, mm. With it `price` is that of a sheet, else that of a
  /// square metre.
  std::optional<PlaneSize> sheet;
  Millionths price = 0;
  /// The worth of a remnant, of its share of the sheet's price; 0 to 100.
  Millionths remnant_percent = 0;
  /// A free rectangle is a remnant from this shorter side on; without a value there are none.
  std::optional<double> least_remnant_mm;
};

struct Rates {
  std::string name;                        ///< of the file, for sentences
  std::string currency;                    ///< three capitals, as ISO 4217 has them
  int decimals = 2;                        ///< of its amounts, 0 to 4
  std::vector<std::string> issuer, terms;  ///< lines of the printed quote, above and below the figures
  nc::MachineModel machine;
  std::int64_t setup_once_ms = 0, setup_per_sheet_ms = 0;
  Millionths per_hour = 0, setup_per_hour = 0, per_pierce = 0, per_m_cut = 0;
  Millionths margin_percent = 0, tax_percent = 0;
  std::vector<MaterialRate> materials;
};

/// Fails with ErrorCode::bad_input: bytes that are no JSON, or one sentence that lists everything that is
/// wrong, each with its place. Cost: O(bytes), but for a logarithm.
[[nodiscard]] Result<Rates> read_rates(std::string_view bytes, const std::string& name);

/// Returns the rate for a material, whose name and thickness are compared exactly. Where rates of sheets and
/// of square metres are there, that of the sheet's size is taken.
/// \param size  of the stock's box, mm; nothing for strips, which have no price of a sheet
///
/// Fails with ErrorCode::bad_input and one sentence that names what there is.
[[nodiscard]] Result<const MaterialRate*> find_rate(const Rates& rates, const layout::Material& material,
                                                    const std::optional<PlaneSize>& size);

}  // namespace lekalo::io

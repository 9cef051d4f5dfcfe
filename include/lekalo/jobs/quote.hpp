#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/grid_region.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/rates_file.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/jobs/layout.hpp"

namespace lekalo::jobs {

/// Quotes say what cutting layouts takes and costs. docs/design/quote.md has the rules; every amount is a
/// whole number of the currency's last decimal.

struct QuoteOptions {
  File rates;                     ///< io::read_rates
  std::optional<File> processes;  ///< io::read_processes
  /// The material of stock that does not say its own; with `processes` also which of them to take, else that
  /// of the stock.
  std::string material;
  double thickness_mm = 0;            ///< 0: not said
  std::vector<io::ExportWord> words;  ///< of an export as G-code
  std::string prefix;                 ///< before the names of words in sentences: "--" or ""
  std::string title;                  ///< of the printed quote; empty: the names of the layouts
};

/// The things that are paid for.
enum class QuoteKind : std::uint8_t {
  machine,   ///< seconds of cutting, piercing and travel
  setup,     ///< seconds
  pierces,   ///< their number
  cut,       ///< metres: gas, wear
  material,  ///< square metres, or sheets
};
/// The words for a kind in documents, its unit, the decimals of its quantity, and for how many units a rate
/// is.
struct QuoteUnit {
  const char *name, *unit;
  int decimals;
  std::int64_t per;
};
[[nodiscard]] QuoteUnit unit_of(QuoteKind kind, bool by_sheet) noexcept;

/// One factor of all pieces of a part on a sheet: amount = quantity * rate / per, rounded half up.
struct QuoteLine {
  std::size_t sheet = 0, part = 0;  ///< of Quote::sheets and Quote::parts
  std::int64_t pieces = 0;
  QuoteKind kind{};
  bool by_sheet = false;      ///< material that is paid by the sheet
  std::int64_t quantity = 0;  ///< in units of its last decimal
  io::Millionths rate = 0;
  std::int64_t amount = 0;
};

/// Time of a sheet, or of a part, ms.
struct QuoteTime {
  std::int64_t cut = 0, pierce = 0, travel = 0, setup = 0;
  [[nodiscard]] std::int64_t machine() const noexcept { return cut + pierce + travel; }
  QuoteTime& operator+=(const QuoteTime& other) noexcept {
    cut += other.cut, pierce += other.pierce, travel += other.travel, setup += other.setup;
    return *this;
  }
};

/// A sheet in use, with its program.
struct QuoteSheet {
  std::size_t layout = 0;  ///< of those given
  std::string stock;
  std::int64_t copy = 0;  ///< from 0
  std::string name;       ///< STOCK or STOCK#COPY
  layout::Material material;
  std::int64_t pieces = 0;
  double parts_area_mm2 = 0, material_area_mm2 = 0;
  std::optional<geom::GridBox> remnant;  ///< what is not charged in full
  std::int64_t pierces = 0, cut_um = 0, travel_um = 0;
  QuoteTime time;
  std::int64_t amount = 0;
  std::string program;  ///< the G-code that was timed
};

/// A part of a layout: a line of an order.
struct QuotePart {
  std::size_t layout = 0;
  std::string id, name;
  layout::Purpose purpose;
  std::int64_t pieces = 0, pierces = 0, cut_um = 0;
  QuoteTime time;
  std::int64_t amount = 0;
};

/// All parts of one customer, day and label.
struct QuoteOrder {
  layout::Purpose purpose;
  std::int64_t pieces = 0, amount = 0;
};

struct Quote {
  std::string title;
  io::Rates rates;
  std::vector<QuoteSheet> sheets;  ///< by layout, stock and copy
  std::vector<QuotePart> parts;    ///< those that are placed, by layout, in its order
  std::vector<QuoteOrder> orders;  ///< in the order of their first part
  std::vector<QuoteLine> lines;    ///< by sheet, part and kind; none of nothing
  std::int64_t subtotal = 0, margin = 0, tax = 0, total = 0;
  std::vector<std::string> notes;
};

/// Makes the programs of all sheets in use as an export does, times them, and prices them.
///
/// Fails as export_layout, io::read_rates and io::find_rate do, and with ErrorCode::usage where a material is
/// not known. Cost: that of the programs.
[[nodiscard]] Result<Quote> quote(const std::vector<Layout>& layouts, const QuoteOptions& options);

/// The quote as a spreadsheet reads it (docs/formats.md, "Quotes"): a row for each line with its factors,
/// then the sum, the margin, the tax and the total.
[[nodiscard]] std::string quote_csv(const Quote& quote);

/// The quote to be printed. Fails with ErrorCode::environment where the drawing library does.
[[nodiscard]] Result<std::string> quote_pdf(const Quote& quote);

/// The quote as "lekalo-quote" JSON, ending in a line end.
/// \param programs  the names of the files that hold the programs, one for each sheet; empty: none was
/// written
[[nodiscard]] std::string quote_json(const Quote& quote, const std::vector<Layout>& layouts,
                                     const QuoteOptions& options, const std::vector<std::string>& programs);

}  // namespace lekalo::jobs

#include <string>

#include "lekalo/io/text/csv_cell.hpp"
#include "lekalo/jobs/quote.hpp"
#include "lekalo/layout/material_words.hpp"
#include "money.hpp"

namespace lekalo::jobs {
namespace {

/// Joins cells to a row.
std::string csv_row(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& cell : cells) row += (row.empty() ? "" : ",") + io::csv_cell(cell);
  return row + "\r\n";
}

}  // namespace

std::string quote_csv(const Quote& quote) {
  const int decimals = quote.rates.decimals;
  std::string text =
      csv_row({"row", "layout", "sheet", "part", "name", "material", "pieces", "customer", "due", "label",
               "what", "quantity", "unit", "rate", "per", "amount", "currency"});
  for (const QuoteLine& line : quote.lines) {
    const QuoteSheet& sheet = quote.sheets[line.sheet];
    const QuotePart& part = quote.parts[line.part];
    const QuoteUnit unit = unit_of(line.kind, line.by_sheet);
    text += csv_row({"line", std::to_string(sheet.layout + 1), sheet.name, part.id, part.name,
                     words_of(sheet.material), std::to_string(line.pieces), part.purpose.customer,
                     part.purpose.due, part.purpose.label, unit.name,
                     decimal_of(line.quantity, unit.decimals), unit.unit, decimal_of(line.rate, 6),
                     std::to_string(unit.per), decimal_of(line.amount, decimals), quote.rates.currency});
  }
  const auto sum = [&](const char* row, const char* what, std::int64_t of, io::Millionths percent,
                       std::int64_t amount) {
    const bool is_share = of >= 0;
    text += csv_row({row, "", "", "", "", "", "", "", "", "", what, is_share ? decimal_of(of, decimals) : "",
                     is_share ? quote.rates.currency : "", is_share ? decimal_of(percent, 6) : "",
                     is_share ? "100" : "", decimal_of(amount, decimals), quote.rates.currency});
  };
  sum("sum", "sum of the lines", -1, 0, quote.subtotal);
  sum("margin", "margin on the sum", quote.subtotal, quote.rates.margin_percent, quote.margin);
  sum("tax", "tax on sum and margin", quote.subtotal + quote.margin, quote.rates.tax_percent, quote.tax);
  sum("total", "total", -1, 0, quote.total);
  return text;
}

}  // namespace lekalo::jobs

#include "quote_rates.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "verify/layout/grid_number.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {
namespace {

/// A number that may be missing.
Fraction rate_or(Fields& fields, std::string_view key, const Fraction& otherwise) {
  return fields.get(key).text.empty() ? otherwise : to_fraction(fields.number(key));
}

WrittenPrice price_of(Json item, const std::string& path, std::string& complaint) {
  Fields fields(item, path, complaint);
  WrittenPrice price;
  price.material.name = fields.text("material");
  if (const auto steps = steps_of(approximate(fields.number("thickness_mm")), ToStep::nearest, 1e6))
    price.material.thickness = *steps;
  else
    fields.complain(fmt::format("field {} is above 1e6", fields.name("thickness_mm")));
  const bool by_sheet = !fields.get("per_sheet").text.empty();
  price.price = to_fraction(fields.number(by_sheet ? "per_sheet" : "per_m2"));
  if (by_sheet) {
    std::vector<double> sides;
    fields.each("sheet_mm", [&](Json side, const std::string& where) {
      sides.push_back(approximate(fields.number_of(side, where)));
    });
    if (sides.size() == 2)
      price.sheet = std::minmax(sides[0], sides[1]);
    else
      fields.complain(fmt::format("field {} has not 2 numbers", fields.name("sheet_mm")));
  }
  price.remnant_percent = rate_or(fields, "remnant_percent", 0);
  if (!fields.get("least_remnant_mm").text.empty())
    price.least_remnant = approximate(fields.number("least_remnant_mm"));
  return price;
}

}  // namespace

Result<WrittenRates> read_written_rates(const Document& document) {
  LEKALO_TRY(const Json root, parse_json(document.bytes, document.name));
  std::string complaint;
  Fields fields(root, "", complaint);
  WrittenRates rates;
  rates.currency = fields.text("currency");
  if (!fields.get("decimals").text.empty()) rates.decimals = fields.index("decimals");
  rates.margin_percent = rate_or(fields, "margin_percent", 0);
  rates.tax_percent = rate_or(fields, "tax_percent", 0);
  Fields hourly(fields.get("rates"), "rates", complaint),
      machine(fields.get("machine"), "machine", complaint);
  rates.per_hour = to_fraction(hourly.number("per_hour"));
  rates.setup_per_hour = rate_or(hourly, "setup_per_hour", rates.per_hour);
  rates.per_pierce = rate_or(hourly, "per_pierce", 0);
  rates.per_m_cut = rate_or(hourly, "per_m_cut", 0);
  rates.setup_once = rate_or(machine, "setup_s_once", 0);
  rates.setup_per_sheet = rate_or(machine, "setup_s_per_sheet", 0);
  fields.each("materials", [&](Json item, const std::string& path) {
    rates.prices.push_back(price_of(item, path, complaint));
  });
  if (rates.decimals > 4) fields.complain("field decimals is above 4");
  if (!complaint.empty())
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", document.name, complaint));
  return rates;
}

}  // namespace lekalo::verify

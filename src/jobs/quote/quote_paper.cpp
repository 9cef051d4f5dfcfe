#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "lekalo/base/counted.hpp"
#include "lekalo/draw/quote.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/quote.hpp"
#include "lekalo/layout/material_words.hpp"
#include "money.hpp"

namespace lekalo::jobs {
namespace {

/// Hours, minutes and seconds: "1:02:03", "2:03".
std::string clock_words(std::int64_t ms) {
  const std::int64_t seconds = (ms + 500) / 1000;
  const std::int64_t hours = seconds / 3600, minutes = seconds / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, seconds % 60)
                   : fmt::format("{}:{:02}", minutes, seconds % 60);
}

/// A percentage with as many decimals as it needs.
std::string percent_words(io::Millionths percent) {
  std::string text = decimal_of(percent, 6);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text + " %";
}

/// Puts a quote into the words that are printed.
class QuotePrinter {
 public:
  explicit QuotePrinter(const Quote& quote) : quote_(quote) {}

  draw::QuotePaper print() const {
    draw::QuotePaper paper;
    paper.title = quote_.title;
    for (const std::string& line : quote_.rates.issuer) paper.issuer.push_back(io::as_utf8(line));
    paper.figures = figures();
    paper.tables = {parts(), orders(), sheets(), factors()};
    paper.sums = sums();
    for (const std::string& line : quote_.rates.terms) paper.terms.push_back(io::as_utf8(line));
    paper.terms.emplace_back("Times are those of a model of the machine.");
    return paper;
  }

 private:
  [[nodiscard]] std::string money(std::int64_t amount) const {
    return decimal_of(amount, quote_.rates.decimals);
  }
  [[nodiscard]] std::string priced(std::int64_t amount) const {
    return money(amount) + " " + quote_.rates.currency;
  }

  [[nodiscard]] std::vector<std::pair<std::string, std::string>> figures() const {
    QuoteTime time;
    std::int64_t cut_um = 0, pierces = 0, pieces = 0;
    for (const QuoteSheet& sheet : quote_.sheets) {
      time += sheet.time;
      cut_um += sheet.cut_um, pierces += sheet.pierces, pieces += sheet.pieces;
    }
    return {{"Total", priced(quote_.total)},
            {"Pieces", std::to_string(pieces)},
            {"Sheets", std::to_string(quote_.sheets.size())},
            {"Machine time", clock_words(time.machine())},
            {"Set-up", clock_words(time.setup)},
            {"Length of cuts", fmt::format("{} m", decimal_of((cut_um + 5000) / 10000, 2))},
            {"Pierces", std::to_string(pierces)}};
  }

  /// Money for a piece is rounded for people; nothing is reckoned from it.
  [[nodiscard]] std::string each(const QuotePart& part) const {
    return money((2 * part.amount + part.pieces) / (2 * part.pieces));
  }

  [[nodiscard]] draw::QuoteTable parts() const {
    draw::QuoteTable table{"Parts",
                           {{"part", 62},
                            {"pieces", 16, true},
                            {"pierces", 18, true},
                            {"cut, m", 20, true},
                            {"machine time", 22, true},
                            {"each", 20, true},
                            {fmt::format("amount, {}", quote_.rates.currency), 22, true}},
                           {}};
    for (const QuotePart& part : quote_.parts)
      table.rows.push_back({io::as_utf8(part.name.empty() ? part.id : part.name), std::to_string(part.pieces),
                            std::to_string(part.pierces), decimal_of((part.cut_um + 500) / 1000, 3),
                            clock_words(part.time.machine()), each(part), money(part.amount)});
    return table;
  }

  /// The orders, where the layout says any.
  [[nodiscard]] draw::QuoteTable orders() const {
    draw::QuoteTable table{"Orders, before margin and tax",
                           {{"customer", 62},
                            {"due", 30},
                            {"label", 46},
                            {"pieces", 20, true},
                            {fmt::format("amount, {}", quote_.rates.currency), 22, true}},
                           {}};
    const bool are_said =
        std::any_of(quote_.orders.begin(), quote_.orders.end(),
                    [](const QuoteOrder& order) { return order.purpose != layout::Purpose{}; });
    if (!are_said) return table;
    for (const QuoteOrder& order : quote_.orders)
      table.rows.push_back({io::as_utf8(order.purpose.customer), order.purpose.due,
                            io::as_utf8(order.purpose.label), std::to_string(order.pieces),
                            money(order.amount)});
    return table;
  }

  [[nodiscard]] draw::QuoteTable sheets() const {
    draw::QuoteTable table{"Sheets, before margin and tax",
                           {{"sheet", 40},
                            {"material", 40},
                            {"pieces", 16, true},
                            {"used", 18, true},
                            {"machine time", 22, true},
                            {"set-up", 22, true},
                            {fmt::format("amount, {}", quote_.rates.currency), 22, true}},
                           {}};
    for (const QuoteSheet& sheet : quote_.sheets)
      table.rows.push_back(
          {io::as_utf8(sheet.name), io::as_utf8(words_of(sheet.material)), std::to_string(sheet.pieces),
           fmt::format("{:.1f} %", 100 * sheet.parts_area_mm2 / sheet.material_area_mm2),
           clock_words(sheet.time.machine()), clock_words(sheet.time.setup), money(sheet.amount)});
    return table;
  }

  /// The parts of the sum, by kind and rate. Lines are rounded one by one, so that an amount here may be
  /// other than quantity times rate.
  [[nodiscard]] draw::QuoteTable factors() const {
    draw::QuoteTable table{"What it is made of, before margin and tax",
                           {{"", 62},
                            {"quantity", 48, true},
                            {"rate", 48, true},
                            {fmt::format("amount, {}", quote_.rates.currency), 22, true}},
                           {}};
    struct Sum {
      QuoteLine line;
      std::string words;
    };
    std::vector<Sum> sums;
    for (const QuoteLine& line : quote_.lines) {
      std::string words = unit_of(line.kind, line.by_sheet).name;
      if (line.kind == QuoteKind::material) words += ": " + words_of(quote_.sheets[line.sheet].material);
      const auto same = std::find_if(sums.begin(), sums.end(), [&](const Sum& sum) {
        return sum.words == words && sum.line.rate == line.rate && sum.line.by_sheet == line.by_sheet;
      });
      if (same == sums.end()) {
        sums.push_back({line, words});
      } else {
        same->line.quantity += line.quantity, same->line.amount += line.amount;
      }
    }
    std::stable_sort(sums.begin(), sums.end(),
                     [](const Sum& a, const Sum& b) { return a.line.kind < b.line.kind; });
    for (const Sum& sum : sums) table.rows.push_back(factor(sum.line, sum.words));
    return table;
  }

  [[nodiscard]] std::vector<std::string> factor(const QuoteLine& line, const std::string& words) const {
    const QuoteUnit unit = unit_of(line.kind, line.by_sheet);
    const bool is_time = unit.per > 1;
    std::string quantity = clock_words(line.quantity);
    if (unit.decimals == 0)
      quantity = std::to_string(line.quantity);
    else if (!is_time)
      quantity = shown_quantity(line.quantity, unit.decimals) + " " + shown_unit(unit.unit);
    std::string rate = decimal_of(line.rate, 6);
    // As many decimals as it needs, and no fewer than amounts have.
    const std::size_t point = rate.find('.');
    const std::size_t last =
        std::max(rate.find_last_not_of('0'), point + static_cast<std::size_t>(quote_.rates.decimals));
    rate.erase(last == point ? point : last + 1);
    return {io::as_utf8(words), quantity,
            fmt::format("{} {} / {}", rate, quote_.rates.currency, is_time ? "h" : shown_unit(unit.unit)),
            money(line.amount)};
  }
  /// A quantity with three decimals: the table has them all.
  static std::string shown_quantity(std::int64_t quantity, int decimals) {
    std::int64_t step = 1;
    for (int i = 3; i < decimals; ++i) step *= 10;
    return decimal_of((quantity + step / 2) / step, 3);
  }
  static std::string shown_unit(std::string_view unit) {
    return unit == "m2" ? "m\u00B2" : std::string(unit);
  }

  [[nodiscard]] std::vector<draw::QuoteSum> sums() const {
    std::vector<draw::QuoteSum> sums{{"Sum", priced(quote_.subtotal)}};
    if (quote_.rates.margin_percent > 0)
      sums.push_back({"Margin, " + percent_words(quote_.rates.margin_percent), priced(quote_.margin)});
    if (quote_.rates.tax_percent > 0)
      sums.push_back({"Tax, " + percent_words(quote_.rates.tax_percent), priced(quote_.tax)});
    sums.push_back({"Total", priced(quote_.total)});
    return sums;
  }

  const Quote& quote_;
};

}  // namespace

Result<std::string> quote_pdf(const Quote& quote) { return draw::quote_pdf(QuotePrinter(quote).print()); }

}  // namespace lekalo::jobs

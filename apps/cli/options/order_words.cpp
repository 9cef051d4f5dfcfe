#include "order_words.hpp"

#include "lekalo/base/limits.hpp"
#include "lekalo/io/formats/order_table.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

/// A word and the number behind its last "=", as in "lids/*.svg=2".
struct CountedWord {
  std::string word;
  std::optional<std::int64_t> count;
};

CountedWord counted_word(WordReader& read, const char* option, const std::string& word) {
  const std::size_t equals = word.find_last_of('=');
  const bool digits = equals != std::string::npos && equals + 1 < word.size() &&
                      word.find_first_not_of("0123456789", equals + 1) == std::string::npos;
  if (!digits) return {word, std::nullopt};
  const auto count = io::quantity_of(word.substr(equals + 1));
  read.require(count.has_value(),
               fmt::format("{}: \"{}\" does not end in a number from 1 to 1,000,000,000", option, word));
  return {word.substr(0, equals), count};
}

bool fine_side(double mm) { return limits::kShortestSide <= mm && mm <= limits::kLargestOutline; }

/// "3000x1500", "8ftx4ft", "48x96in"; nothing for names of files.
std::optional<jobs::SheetSize> size_of(const std::string& word) {
  for (std::size_t at = word.find('x'); at != std::string::npos; at = word.find('x', at + 1)) {
    const std::string right = word.substr(at + 1);
    std::string left = word.substr(0, at);
    const auto height = length_of(right);
    if (!height || !length_of(left)) continue;
    // A unit that stands once, at the end, counts for both.
    const bool without_unit = left.find_last_of("0123456789.") == left.find_last_not_of(' ');
    const std::size_t unit = right.find_last_of("0123456789.");
    if (without_unit) left += right.substr(unit + 1);
    return jobs::SheetSize{*length_of(left), *height};
  }
  return std::nullopt;
}

StockWord sheet_of(WordReader& read, const std::string& word) {
  const CountedWord counted = counted_word(read, "--sheet", word);
  StockWord stock{counted.word, size_of(counted.word), counted.count};
  if (stock.size)
    read.require(fine_side(stock.size->width_mm) && fine_side(stock.size->height_mm),
                 fmt::format("--sheet: \"{}\" has a side that is not from {} to {} mm", word,
                             limits::kShortestSide, limits::kLargestOutline));
  return stock;
}

StockWord strip_of(WordReader& read, const std::string& word) {
  StockWord stock{word, jobs::SheetSize{}, std::nullopt};
  read.length("--strip", word, limits::kShortestSide, limits::kLargestOutline,
              "the width of a strip from 0.001 to 262144 mm", stock.size->height_mm);
  return stock;
}

}  // namespace

void add_order(Form& form, OrderWords& w) {
  const OptionAdder add(form, "An order, instead of a layout");
  add("--part", w.parts, "FILE[=N]",
      "A drawing that is wanted N times [1], a folder, a pattern in quotes; again for more")
      .one_word_a_time = true;
  add("--order", w.table, "TABLE",
      "Parts as a table (CSV) with the columns file, quantity, ...; - reads stdin");
  add("--sheet", w.sheets, "WxH[=N]",
      "A sheet of this size, or of a drawing, N of them [as many as needed]; again for more")
      .one_word_a_time = true;
  add("--strip", w.strips, "H", "A strip of this width, as long as needed").one_word_a_time = true;
  add("--gap", w.gap, "LENGTH", "Between finished parts [0]");
  add("--border", w.border, "LENGTH", "Between parts and the border [0]");
  add("--kerf", w.kerf, "LENGTH", "The width of the cut; a smaller gap is raised to it [0]");
  add("--rotations", w.rotations, "DEGREES", "Angles that parts may have, as 0,90, or any [any]");
  add("--grain", w.grain, "x|y|DEGREES", "The grain of the stock; parts are drawn along it");
  add("--mirror", w.mirror, "Parts may be turned over");
}

Result<std::optional<OrderSource>> to_order(const OrderWords& w, const LayoutWords& layout) {
  const bool asked = !(w.parts.empty() && w.sheets.empty() && w.strips.empty() && w.table.empty());
  const bool rules = !(w.gap.empty() && w.border.empty() && w.kerf.empty() && w.rotations.empty() &&
                       w.grain.empty() && !w.mirror);
  WordReader read;
  read.require(
      asked || !rules,
      "--gap, --border, --kerf, --rotations, --grain and --mirror belong to an order, with --part and "
      "--sheet; a layout says its own");
  OrderSource order;
  if (!layout.path.empty()) order.parts.push_back({layout.path, std::nullopt});
  for (const std::string& word : w.parts) {
    CountedWord part = counted_word(read, "--part", word);
    order.parts.push_back({std::move(part.word), part.count});
  }
  order.table = w.table;
  for (const std::string& word : w.sheets) order.stocks.push_back(sheet_of(read, word));
  for (const std::string& word : w.strips) order.stocks.push_back(strip_of(read, word));
  constexpr const char* kLength = "a length from 0 to 262144 mm, as 4, 1/8in or 3 mm";
  read.length("--gap", w.gap, 0, limits::kLargestOutline, kLength, order.gap_mm);
  read.length("--border", w.border, 0, limits::kLargestOutline, kLength, order.border_mm);
  read.length("--kerf", w.kerf, 0, limits::kLargestOutline, kLength, order.kerf_mm);
  if (!w.rotations.empty()) {
    const auto angles = io::rotations_of(w.rotations);
    read.require(angles.has_value(),
                 fmt::format("--rotations: \"{}\" is not \"any\" or degrees, as in 0,90", w.rotations));
    if (angles) order.rotations = *angles;
  }
  if (!w.grain.empty()) {
    order.grain_degrees = io::grain_of(w.grain);
    read.require(order.grain_degrees.has_value(),
                 fmt::format("--grain: \"{}\" is not x, y or a number of degrees", w.grain));
  }
  order.may_mirror = w.mirror;
  const auto source = to_layout_source(layout);
  if (!source) read.require(false, source.error().message);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  if (!asked) return std::nullopt;
  order.reading = source->parts;
  return order;
}

}  // namespace lekalo::cli

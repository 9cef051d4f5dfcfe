#include "order_words.hpp"

#include "option_words.hpp"

namespace lekalo::cli {
void add_order(Form& form, OrderWords& w) {
  const OptionAdder add(form, "An order, instead of a layout");
  add("--part", w.parts, "FILE[=N][@MATERIAL:T]",
      "A drawing that is wanted N times [1], a folder, a pattern in quotes; again for more")
      .one_word_a_time = true;
  add("--order", w.table, "TABLE",
      "Parts as a table (CSV) with the columns file, quantity, ...; - reads stdin");
  add("--build", w.terms.builds, "ASSEMBLY[=N]",
      "Of a table with the column assembly, a bill of materials: build N of it [1]; again for more")
      .one_word_a_time = true;
  add("--sheet", w.terms.sheets, "WxH[=N][@MATERIAL:T]",
      "A sheet of this size, or of a drawing, N of them [as many as needed], T thick; again for more")
      .one_word_a_time = true;
  add("--strip", w.terms.strips, "H[@MATERIAL:T]", "A strip of this width, as long as needed")
      .one_word_a_time = true;
  add("--stock", w.stock, "FILE",
      "Instead of sheets: what is free in a stock file (lekalo stock), remnants first");
  add("--gap", w.terms.gap, "LENGTH", "Between finished parts [0]");
  add("--border", w.terms.border, "LENGTH", "Between parts and the border [0]");
  add("--kerf", w.terms.kerf, "LENGTH", "The width of the cut; a smaller gap is raised to it [0]");
  add("--rotations", w.terms.rotations, "DEGREES", "Angles that parts may have, as 0,90, or any [any]");
  add("--grain", w.terms.grain, "x|y|DEGREES", "The grain of the stock; parts are drawn along it");
  add("--mirror", w.terms.may_mirror, "Parts may be turned over");
}

Result<std::optional<OrderSource>> to_order(const OrderWords& w, const LayoutWords& layout) {
  const bool asked = !(w.parts.empty() && w.terms.sheets.empty() && w.terms.strips.empty() &&
                       w.table.empty() && w.terms.builds.empty() && w.stock.empty());
  const bool rules = !(w.terms.gap.empty() && w.terms.border.empty() && w.terms.kerf.empty() &&
                       w.terms.rotations.empty() && w.terms.grain.empty() && !w.terms.may_mirror);
  WordReader read;
  read.require(
      asked || !rules,
      "--gap, --border, --kerf, --rotations, --grain and --mirror belong to an order, with --part and "
      "--sheet; a layout says its own");
  OrderSource order;
  if (!layout.path.empty()) order.parts.push_back({layout.path, std::nullopt, {}});
  for (const std::string& word : w.parts) {
    auto part = jobs::ordered_word(word);
    if (part)
      order.parts.push_back({std::move(part->word), part->count, std::move(part->material)});
    else
      read.require(false, fmt::format("--part: \"{}\" {}", word, part.error().message));
  }
  read.require(w.terms.builds.empty() || !w.table.empty(),
               "--build says what is built of a bill of materials, which --order TABLE names");
  read.require(
      w.stock.empty() || (w.terms.sheets.empty() && w.terms.strips.empty()),
      "--stock takes its sheets from the file: add others to it with lekalo stock add, and leave --sheet and "
      "--strip out");
  order.table = w.table;
  order.stock = w.stock;
  auto terms = jobs::read_order_words(w.terms, "--");
  if (terms)
    order.terms = *std::move(terms);
  else
    read.require(false, terms.error().message);
  const auto source = to_layout_source(layout);
  if (!source) read.require(false, source.error().message);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  if (!asked) return std::nullopt;
  order.reading = source->parts;
  order.layer_rules = source->layer_rules;
  return order;
}

}  // namespace lekalo::cli

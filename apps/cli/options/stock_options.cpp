#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>

#include "layout_words.hpp"
#include "lekalo/io/formats/order_table.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

constexpr std::array kStockActions{
    Word<StockAction>{"add", StockAction::add},           Word<StockAction>{"list", StockAction::list},
    Word<StockAction>{"take", StockAction::take}, Word<StockAction>{"cut", StockAction::cut},
    Word<StockAction>{"cancel", StockAction::cancel},     Word<StockAction>{"check", StockAction::check}};

/// As typed.
struct StockWords {
  LayoutWords reading;
  std::string action, file, cost, grain, rule;
  std::vector<std::string> of, sheets;
};

bool wants_order(StockAction action) {
  return action == StockAction::take || action == StockAction::cut || action == StockAction::cancel;
}

/// Complains of words and options that the action does not take, and of those that it lacks.
void require_fitting(WordReader& read, const StockWords& w, StockAction action) {
  const bool adds = action == StockAction::add;
  read.require(adds || (w.sheets.empty() && w.cost.empty() && w.grain.empty() && w.rule.empty()),
               fmt::format("--sheet, --cost, --grain and --remnant-min are for lekalo stock add, not for {}",
                           w.action));
  read.require(
      !adds || !w.sheets.empty() || !w.rule.empty(),
      "nothing is added; say --sheet 3000x1500=5@steel:2, --sheet hide.dxf or --remnant-min 300x200");
  read.require((!w.reading.json && w.reading.picture.empty()) || action == StockAction::list,
               fmt::format("--json and --picture are for lekalo stock list, not for {}", w.action));
  read.require(!wants_order(action) || !w.of.empty(),
               fmt::format("the id of the order is missing: lekalo stock {} FILE ORDER", w.action));
  read.require(action != StockAction::take || w.of.size() > 1 || w.of.empty(),
               "the layout is missing: lekalo stock take FILE ORDER LAYOUT");
  const std::size_t most = !wants_order(action) ? 0 : action == StockAction::cancel ? 1 : w.of.size();
  read.require(w.of.size() <= most, fmt::format("lekalo stock {} does not take \"{}\"", w.action,
                                                w.of.empty() ? "" : w.of.back()));
}

Result<Command> to_stock(const StockWords& w) {
  StockOptions o;
  WordReader read;
  read.choice("the action", w.action, kStockActions, o.action);
  if (!read.complaint().empty())
    return failure(ErrorCode::usage, read.complaint() + " (see lekalo stock --help)");
  require_fitting(read, w, o.action);
  o.file = w.file;
  if (!w.of.empty()) o.order = w.of.front(), o.layouts.assign(w.of.begin() + 1, w.of.end());
  jobs::OrderWords sheets;
  sheets.sheets = w.sheets;
  const auto terms = jobs::read_order_words(sheets, "--");
  read.require(terms.has_value(), terms ? "" : terms.error().message);
  if (terms) o.pieces = terms->stocks;
  if (!w.rule.empty()) {
    o.rule = jobs::remnant_rule_of(w.rule);
    read.require(o.rule.has_value(),
                 fmt::format("--remnant-min: \"{}\" is no size, as 300x200, and no area of whole "
                             "square millimetres, as 60000mm2 or 0.06m2",
                             w.rule));
  }
  if (!w.cost.empty())
    read.number("--cost", w.cost, 0.0, limits::kMostMoney, "a cost from 0 to 1,000,000,000,000",
                o.cost.emplace());
  if (!w.grain.empty()) {
    o.grain = io::grain_of(w.grain);
    read.require(o.grain.has_value(),
                 fmt::format("--grain: \"{}\" is not x, y or a number of degrees", w.grain));
  }
  const auto source = to_layout_source(w.reading);
  read.require(source.has_value(), source ? "" : source.error().message);
  const auto picture = fine_picture(w.reading.picture);
  read.require(picture.has_value(), picture ? "" : picture.error().message);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  o.reading = source->parts;
  o.picture = w.reading.picture;
  o.json = w.reading.json;
  return Command(std::move(o));
}

}  // namespace

Typed add_stock_form(Form& form) {
  auto words = std::make_shared<StockWords>();
  StockWords& w = *words;
  const OptionAdder add(form);
  add("action", w.action, list_of(kStockActions, "|"),
      "Add pieces; list them; take what layouts use for an order; say that it was cut, or that it is not "
      "to be; "
      "check all")
      .required = true;
  add("file", w.file, "FILE", "The stock file; lekalo stock add makes it where there is none").required =
      true;
  add("of", w.of, "ORDER [LAYOUT...]",
      "take: the order's id and its layouts; cut: its id, and layouts that were changed since; cancel: "
      "its id");
  const OptionAdder adding(form, "Adding");
  adding(
      "--sheet", w.sheets, "WxH[=N][@MATERIAL:T]",
      "N sheets of this size [1], of the outlines of a drawing, or of the stocks of a layout; again for more")
      .one_word_a_time = true;
  adding("--cost", w.cost, "COST", "What each of them cost [its area in m2]");
  adding("--grain", w.grain, "x|y|DEGREES", "The direction of the grain of these");
  adding("--remnant-min", w.rule, "WxH|AREA",
         "Keep no remnant that holds no such rectangle, or has less area (60000mm2, 0.06m2), from now on "
         "[200x200]");
  add_drawings_reading(form, w.reading);
  add_layout_outputs(form, w.reading);
  form.footer =
      "lekalo nest --stock FILE --allocate ORDER takes from it, remnants first. Any number of programs may "
      "use\n"
      "the file at the same time, and no piece is given to two orders.\n"
      "Exit codes: 0 done; 1 check: something is not true; 2 wrong command line; 3 bad input, as an order "
      "that\n"
      "is not there; 5 the file cannot be written, or is in use for too long.";
  return [words] { return to_stock(*words); };
}

}  // namespace lekalo::cli

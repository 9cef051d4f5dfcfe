#include <memory>

#include "layout_words.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"
#include "order_words.hpp"

namespace lekalo::cli {
namespace {

constexpr std::array kRemnants{Word<nest::Remnant>{"rectangle", nest::Remnant::rectangle},
                               Word<nest::Remnant>{"strip", nest::Remnant::strip},
                               Word<nest::Remnant>{"corner", nest::Remnant::corner}};

/// As typed.
struct NestWords {
  LayoutWords layout;
  OrderWords order;
  std::string output, stream, allocate, time, work, seed, threads, angles, pairs, remnant;
  bool from_scratch = false, common_line = false;
};

Result<Command> to_nest(const NestWords& w) {
  LEKALO_CHECK(fine_picture(w.layout.picture));
  NestOptions o;
  LEKALO_TRY(o.source, to_layout_source(w.layout));
  LEKALO_TRY(o.order, to_order(w.order, w.layout));
  if (!o.order && w.layout.path.empty())
    return failure(
        ErrorCode::usage,
        "nothing says what is to be placed: give the file of a layout, or drawings and sheets, as in "
        "lekalo nest --part side.dxf=4 --sheet 3000x1500 (see lekalo nest --help)");
  o.output = w.output;
  o.stream = w.stream;
  o.allocate = w.allocate;
  o.search.from_given = !w.from_scratch;
  o.picture = w.layout.picture;
  o.json = w.layout.json;
  WordReader read;
  constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
  read.number("--seed", w.seed, std::uint64_t{0}, kLargest, "a whole number from 0 to 2^64 - 1",
              o.search.seed);
  read.number("--work", w.work, std::uint64_t{1}, kLargest, "a whole number from 1 to 2^64 - 1", o.work);
  read.number("--threads", w.threads, 1u, 64u, "a whole number from 1 to 64", o.search.threads);
  read.number("--angles", w.angles, std::size_t{1}, std::size_t{360}, "a whole number from 1 to 360",
              o.search.angles);
  if (!w.pairs.empty())
    read.number("--pairs", w.pairs, 0.001, 1e6, "a distance from 0.001 to 1,000,000 mm",
                o.search.pair_distance);
  read.choice("--remnant", w.remnant, kRemnants, o.search.remnant);
  read.require(w.allocate.empty() || (o.order && !o.order->stock.empty()),
               "--allocate says for which order pieces of a stock file are taken, which --stock FILE names");
  if (w.common_line) {
    read.require(
        o.order.has_value() && o.order->terms.kerf_mm > 0,
        "--common-line belongs to an order, and --kerf MM says how far apart edges are that two parts "
        "have in common");
    if (o.order) {
      // The layout that is written asks for the kerf alone; the search keeps the gap between all other edges.
      jobs::OrderTerms& terms = o.order->terms;
      o.search.common_line_gap_mm = std::max(terms.gap_mm, terms.kerf_mm);
      terms.gap_mm = terms.kerf_mm;
    }
  }
  if (!w.time.empty() || w.work.empty()) {
    double seconds = 60;
    read.number("--time", w.time, 0.01, 1e6, "a number of seconds from 0.01 to 1,000,000", seconds);
    o.seconds = seconds;
  }
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

}  // namespace

Typed add_nest_form(Form& form) {
  auto words = std::make_shared<NestWords>();
  NestWords& w = *words;
  add_layout_source(form, w.layout, false);
  add_order(form, w.order);
  const OptionAdder write(form);
  write("-o,--output", w.output, "FILE", "Write the layout to this file [stdout]");
  write("--stream", w.stream, "FILE", "Replace this file with every better layout as it is found");
  write("--allocate", w.allocate, "ORDER",
        "Of --stock: allocate what the layout uses to the order with this id");
  const OptionAdder add(form, "Search");
  add("--time", w.time, "SECONDS", "Stop after this time; the report's work repeats it [60 without --work]");
  add("--work", w.work, "N", "Stop after about N candidate places: same bytes on every machine");
  add("--threads", w.threads, "N", "Changes the speed, not the result [2]");
  add("--seed", w.seed, "S", "Seed of all random choices [0]");
  add("--angles", w.angles, "N", "Angles to try of parts that may be turned anyhow [24]");
  add("--pairs", w.pairs, "MM", "Left and right pieces of a kit lie so near one another, middle to middle");
  add("--remnant", w.remnant, list_of(kRemnants, "|"),
      "Of the last sheet, keep what one cut frees, what one cut along y frees, or all beyond a corner "
      "[corner]");
  add("--common-line", w.common_line,
      "Rectangles and right triangles in rows, the kerf apart, where that costs little material");
  add("--from-scratch", w.from_scratch, "Drop what lies there and is not locked, instead of improving it");
  form.footer =
      "Locked placements stay. Others are where the search begins, and the result is no worse; what is "
      "wanted\n"
      "and not there is added. Ctrl-C keeps the best so far. What is written passes lekalo check.\n"
      "Exit codes: 0 everything is placed, 1 some pieces are not, 2 wrong command line, 3 a file cannot be\n"
      "read or nested, 4 the layout found did not pass the check (please report), 5 disk or memory.";
  add_layout_outputs(form, w.layout);
  return [words] { return to_nest(*words); };
}

}  // namespace lekalo::cli

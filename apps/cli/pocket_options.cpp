#include <memory>

#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

/// As typed.
struct PocketWords {
  std::string pocket, tool, step_over, stock_to_leave, depth, feed, plunge_feed, link_feed, safe_height,
      output;
};

Result<Command> to_pocket(PocketWords w) {
  WordReader read;
  PocketOptions o{w.pocket, w.output, {}, {}};
  const char* const feed = "a feed above 0, mm/min";
  double percent = 40;
  if (!w.step_over.empty() && w.step_over.back() == '%') w.step_over.pop_back();
  read.number("--stepover", w.step_over, 1.0, 50.0, "a share of the diameter from 1% to 50%", percent);
  o.path.step_over = percent / 100;
  read.number("--tool", w.tool, 0.01, 1e4, "a diameter from 0.01 to 10000 mm", o.path.tool_diameter);
  read.number("--depth", w.depth, 1e-3, 1e4, "a depth from 0.001 to 10000 mm", o.path.depth);
  read.number("--stock-to-leave", w.stock_to_leave, 0.0, 1e4, "a length from 0 to 10000 mm",
              o.path.stock_to_leave);
  read.number("--feed", w.feed, 1e-3, 1e6, feed, o.program.feed_mm_per_min);
  read.number("--plunge-feed", w.plunge_feed, 1e-3, 1e6, feed, o.program.plunge_feed_mm_per_min);
  read.number("--link-feed", w.link_feed, 1e-3, 1e6, feed, o.program.link_feed_mm_per_min);
  read.number("--safe-height", w.safe_height, 1e-3, 1e4, "a height above 0, mm", o.path.safe_height);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

}  // namespace

Typed add_pocket_form(CLI::App& app) {
  auto words = std::make_shared<PocketWords>();
  PocketWords& w = *words;
  app.add_option("pocket", w.pocket, "The pocket's outline, JSON regions with lines, arcs and islands")
      ->required()
      ->type_name("FILE");
  const WordAdder add(app);
  add("--tool", w.tool, "MM", "Diameter of the tool")->required();
  add("--depth", w.depth, "MM", "Below Z 0, cut in one level")->required();
  add("--stepover", w.step_over, "PERCENT", "Of the tool's diameter, from 1% to 50% [40%]");
  add("--stock-to-leave", w.stock_to_leave, "MM", "What stays on every wall [0]");
  add("--feed", w.feed, "MM/MIN", "In the cut [1500]");
  add("--plunge-feed", w.plunge_feed, "MM/MIN", "Straight down [300]");
  add("--link-feed", w.link_feed, "MM/MIN", "At depth through what is cut already [5000]");
  add("--safe-height", w.safe_height, "MM", "Above Z 0 [5]");
  add("-o,--output", w.output, "FILE", "Write the program to this file [stdout]");
  app.footer(
      "Exit codes: 0 done, 2 wrong command line, 3 a file cannot be read or the tool fits nowhere,\n"
      "4 the program found failed its check, 5 disk or memory. lekalo simulate judges any program.");
  return [words] { return to_pocket(*words); };
}

}  // namespace lekalo::cli

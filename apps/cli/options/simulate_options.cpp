#include <memory>

#include "after_words.hpp"
#include "control_word.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"
#include "step_over_word.hpp"

namespace lekalo::cli {
namespace {

/// The words of the command line as they were typed.
struct SimulateWords {
  std::string program, pocket, tool, stock_to_leave, step_over, top, acceleration, rapid, samples, picture,
      animation, control;
  std::vector<std::string> after;
  bool json = false;
};

Result<Command> to_simulate(const SimulateWords& w) {
  WordReader read;
  SimulateOptions o{w.program, w.pocket, {}, {}, w.samples, w.picture, w.animation, w.json};
  read_after(read, w.after, o.after);
  read_control(read, w.control, o.machining.control);
  read.require(w.picture.empty() || w.picture.ends_with(".svg") || w.picture.ends_with(".png"),
               "--picture " + w.picture + ": the name has to end in .svg or .png");
  const char* const above = "a number above 0";
  read.number("--tool", w.tool, 1e-3, 1e4, "a diameter from 0.001 to 10000 mm", o.machining.tool_diameter);
  read.number("--stock-to-leave", w.stock_to_leave, 0.0, 1e4, "a length from 0 to 10000 mm",
              o.machining.stock_to_leave);
  read_step_over(read, w.step_over, 100, o.machining.step_over);
  read.number("--top", w.top, -1e6, 1e6, "a height within 1000 m of 0, in mm", o.machining.top);
  read.number("--acceleration", w.acceleration, 1e-3, 1e9, above, o.machining.acceleration);
  read.number("--rapid", w.rapid, 1e-3, 1e9, above, o.machining.rapid_feed);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

}  // namespace

Typed add_simulate_form(Form& form) {
  auto words = std::make_shared<SimulateWords>();
  SimulateWords& w = *words;
  const OptionAdder add(form);
  add("program", w.program, "FILE", "NC program of X, Y and Z").required = true;
  add("--pocket", w.pocket, "FILE", "The pocket's outline, JSON regions with lines, arcs and islands")
      .required = true;
  add("--tool", w.tool, "MM", "Diameter of the tool").required = true;
  add_after(add, w.after);
  add("--stock-to-leave", w.stock_to_leave, "MM", "What stays on every wall [0]");
  add("--stepover", w.step_over, "PERCENT", "Of the tool's diameter, for the bound on the time [40%]");
  add("--top", w.top, "MM", "Z of the stock's upper face [0]");
  add("--acceleration", w.acceleration, "MM/S2", "Of the machine, for the time [500]");
  add("--rapid", w.rapid, "MM/MIN", "Feed of G0 [5000]");
  add("--control", w.control, control_list(), "Whose words the program has [linuxcnc]");
  add("--samples", w.samples, "FILE", "Write the engagement along the path as CSV");
  add("--picture", w.picture, "FILE", "Draw the path coloured by engagement (.svg or .png)");
  add("--animation", w.animation, "FILE", "Write a page that plays the cut (.html)");
  add("--json", w.json, "Print the report as JSON on stdout");
  form.footer =
      "Exit codes: 0 whatever the figures are, 2 wrong command line, 3 a file cannot be read or judged,\n"
      "5 disk or memory. What the figures mean: docs/design/simulate.md";
  return [words] { return to_simulate(*words); };
}

}  // namespace lekalo::cli

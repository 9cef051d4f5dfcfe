#include <algorithm>
#include <iterator>
#include <memory>
#include <string_view>
#include <utility>

#include "after_words.hpp"
#include "control_word.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

/// The words of the command line as they were typed, where they are to become numbers.
struct VerifyWords {
  VerifyOptions options;
  std::string tool, stock_to_leave, top, kerf, tolerance, pierce_diameter, joint_width, only, control;
  std::string blade_offset, turn_above, knife_tolerance;
  std::vector<std::string> after;
};

/// Layers as export takes them, with commas between.
void read_layers(WordReader& read, const std::string& words, std::vector<std::string>& layers) {
  for (std::size_t begin = 0; !words.empty() && begin <= words.size();) {
    const std::size_t end = std::min(words.find(',', begin), words.size());
    layers.push_back(words.substr(begin, end - begin));
    read.require(std::find(std::begin(io::kExportLayers), std::end(io::kExportLayers), layers.back()) !=
                     std::end(io::kExportLayers),
                 fmt::format("--only: \"{}\" is no layer of an export", layers.back()));
    begin = end + 1;
  }
}

Result<Command> to_verify(const VerifyWords& w) {
  WordReader read;
  VerifyOptions o = w.options;
  read_after(read, w.after, o.after);
  if (!w.tool.empty())
    read.number("--tool", w.tool, 1e-3, 1e4, "a diameter from 0.001 to 10000 mm", o.tool_diameter.emplace());
  read.number("--stock-to-leave", w.stock_to_leave, 0.0, 1e4, "a length from 0 to 10000 mm",
              o.machining.stock_to_leave);
  read.number("--top", w.top, -1e6, 1e6, "a height within 1000 m of 0, in mm", o.machining.top);
  if (!w.kerf.empty())
    read.number("--kerf", w.kerf, 0.01, 100.0, "a width from 0.01 to 100 mm", o.kerf.emplace());
  if (!w.tolerance.empty())
    read.number("--tolerance", w.tolerance, 1e-4, 25.0, "a length from 0.0001 to 25 mm",
                o.tolerance.emplace());
  if (!w.pierce_diameter.empty())
    read.number("--pierce-diameter", w.pierce_diameter, 0.01, 100.0, "a diameter from 0.01 to 100 mm",
                o.pierce_diameter.emplace());
  if (!w.joint_width.empty())
    read.number("--joint-width", w.joint_width, 0.05, 50.0, "a width from 0.05 to 50 mm",
                o.joint_width.emplace());
  for (const auto& [option, given] : {std::pair{"--pierce-diameter", o.pierce_diameter.has_value()},
                                      {"--joint-width", o.joint_width.has_value()},
                                      {"--common-line", o.common_line}})
    read.require(
        !given || o.kerf.has_value(),
        fmt::format("{} is rechecked with --layout FILE and --kerf MM, the width of the cut", option));
  if (!w.blade_offset.empty())
    read.number("--blade-offset", w.blade_offset, 0.05, 10.0, "a length from 0.05 to 10 mm",
                o.blade_offset.emplace());
  if (!w.turn_above.empty())
    read.number("--turn-above", w.turn_above, 1.0, 90.0, "an angle from 1 to 90 degrees",
                o.turn_above.emplace());
  if (!w.knife_tolerance.empty())
    read.number("--knife-tolerance", w.knife_tolerance, 0.02, 10.0, "a length from 0.02 to 10 mm",
                o.knife_tolerance.emplace());
  read.require(!o.common_line || !o.joint_width,
               "--common-line and --joint-width do not go together: leave one out");
  read.require(!o.blade_offset || !o.turn_above,
               "--blade-offset is for a plot of a drag knife, --turn-above for one of a tangential knife: "
               "leave one out");
  read.require(!o.knife_tolerance || o.blade_offset || o.turn_above,
               "--knife-tolerance is rechecked with --blade-offset MM or --turn-above DEG");
  read_control(read, w.control, o.machining.control);
  read_layers(read, w.only, o.export_words.only);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

}  // namespace

Typed add_verify_form(Form& form) {
  auto words = std::make_shared<VerifyWords>();
  VerifyWords& w = *words;
  VerifyOptions& o = w.options;
  const OptionAdder add(form);
  add("result", o.result, "FILE", "What lekalo wrote: a placement, layout, report, program or export")
      .required = true;
  add("--part", o.part, "FILE", "Where the part file is now, when not where the result says");
  add("--blank", o.blank, "FILE", "Where the blank file is now");
  add("--features", o.features, "FILE", "Where the file of features is now");
  add("--nc", o.program, "FILE", "Where the NC program that was moved is now");
  add("--compare", o.earlier, "FILE", "Where the earlier result is now");
  add("--start", o.start, "FILE", "Where the result is now that a solid started from");
  add("--points", o.points, "FILE", "Where the points are now that the blank was meshed from");
  add("--nominal-blank", o.nominal, "FILE", "Where the mesh is now that was moved to touches");
  add("--certificate", o.certificate, "FILE", "Where the certificate file is now");
  add("--layout", o.layout, "FILE", "The layout that a layout, an export or a profile program was made from");
  add("--pocket", o.pocket, "FILE", "The pocket that a program clears, or where that of a report is now");
  add("--program", o.cut_program, "FILE", "Where the program of a report is now");
  add("--tool", w.tool, "MM", "Diameter of the tool of a program");
  add("--stock-to-leave", w.stock_to_leave, "MM", "What a program leaves on every wall [0]");
  add("--top", w.top, "MM", "Z of the stock's upper face, of a program [0]");
  add_after(add, w.after);
  add("--control", w.control, control_list(), "Whose words a program has [linuxcnc]");
  add("--kerf", w.kerf, "MM", "Width of the cut of a profile program");
  add("--tolerance", w.tolerance, "MM",
      "As for export: of chords in a plot [0.02], or how far the kerf may enter a part [0.01]");
  add("--pierce-diameter", w.pierce_diameter, "MM",
      "What a pierce of a profile program burns: rechecked to be clear of parts and of earlier cuts");
  add("--common-line", o.common_line,
      "Of a profile program: edges that parts have in common are cut once, which is rechecked");
  add("--joint-width", w.joint_width, "MM", "The joints of a profile program: rechecked to stay, so wide");
  add("--blade-offset", w.blade_offset, "MM",
      "Of a plot for a drag knife: its tip is followed, so far behind the axis");
  add("--turn-above", w.turn_above, "DEG",
      "Of a plot for a tangential knife: it is lifted at sharper corners, as for export");
  add("--knife-tolerance", w.knife_tolerance, "MM", "Of a plot for a knife, as for export [0.1]");
  add("--sheet", o.export_words.sheet, "SHEET", "The sheet of an export or a profile program, as for export");
  add("--only", w.only, "LAYER,...", "The layers of an export that has not all, as for export");
  add("--json", o.json, "Print the report as JSON on stdout");
  form.footer =
      "Exit codes: 0 confirmed, 1 what was rechecked holds, but there is no proof of the bound or a claim "
      "was\n"
      "not rechecked, 4 refuted, 2 wrong command line or more has to be given, 3 a file cannot be read.";
  return [words] { return to_verify(*words); };
}

}  // namespace lekalo::cli

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "after_words.hpp"
#include "control_word.hpp"
#include "lekalo/heat/material.hpp"
#include "lekalo/heat/stock.hpp"
#include "lekalo/jobs/picture_form.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

using heat::Property;

enum class Hold { free, plate, vice_x, vice_y };
constexpr std::array kHolds{Word<Hold>{"free", Hold::free}, Word<Hold>{"plate", Hold::plate},
                            Word<Hold>{"vice-x", Hold::vice_x}, Word<Hold>{"vice-y", Hold::vice_y}};

struct FigureOption {
  Property property;
  const char* unit;
  const char* help;
};
/// Each is a figure, or two as in 0.05..0.2.
constexpr std::array<FigureOption, heat::kProperties> kFigures{
    {{Property::share, "PART", "Of the cutting power that heats the workpiece, as in 0.05..0.2"},
     {Property::cutting_force, "N/MM2", "k_c1.1: of a chip 1 mm thick and wide"},
     {Property::force_exponent, "NUMBER", "m_c: the force is k_c1.1 h^-m_c, h in mm"},
     {Property::conductivity, "W/(M.K)", "Of heat"},
     {Property::density, "KG/M3", "Of the material"},
     {Property::heat_capacity, "J/(KG.K)", "Of the material"},
     {Property::expansion, "1/K", "Thermal"},
     {Property::youngs, "MPA", "Young's modulus"},
     {Property::poisson, "RATIO", "Poisson's ratio"},
     {Property::yield, "MPA", "Yield stress"},
     {Property::melting, "C", "Where melting begins"},
     {Property::glass, "C", "Glass transition, of plastics"}}};

std::string option_of(const FigureOption& figure) {
  return fmt::format("--{}", heat::words_of(figure.property).option);
}

/// The words of the command line as they were typed.
struct HeatWords {
  std::string program, pocket, stock, height, tool, teeth, spindle, stock_to_leave, top, acceleration, rapid,
      control;
  std::string material, wear, cooling, hold, datum, ambient, voxel;
  std::array<std::string, heat::kProperties> figures;
  std::vector<std::string> after, measured;
  std::string output, picture, maps, report, animation, corrected, finish;
  bool json = false;
};

void read_figures(WordReader& read, const HeatWords& w, HeatOptions& o) {
  for (std::size_t i = 0; i < kFigures.size(); ++i) {
    if (w.figures[i].empty()) continue;
    const auto value = heat::read_interval(w.figures[i]);
    read.require(value.has_value(), fmt::format("{}: \"{}\" is not a number, or two as in 1..2",
                                                option_of(kFigures[i]), w.figures[i]));
    o.material.stated[static_cast<std::size_t>(kFigures[i].property)] = value;
  }
  if (w.wear.empty()) return;
  const auto wear = heat::read_interval(w.wear);
  read.require(wear && wear->least >= 1 && wear->greatest <= 5,
               fmt::format("--wear: \"{}\" is not a number from 1 to 5, or two as in 1..1.5", w.wear));
  o.job.source.cutting.wear = wear.value_or(o.job.source.cutting.wear);
}

std::vector<std::string> between_commas(const std::string& word) {
  std::vector<std::string> parts(1);
  for (const char c : word) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

/// `T,X,Y,Z,SECONDS` or `T,X,Y,Z,SECONDS,UNCERTAINTY`, as often as something was measured.
void read_measured(WordReader& read, const std::vector<std::string>& words, jobs::HeatJob& job) {
  for (const std::string& word : words) {
    const std::vector<std::string> parts = between_commas(word);
    const bool whole = (parts.size() == 5 || parts.size() == 6) &&
                       std::ranges::none_of(parts, [](const std::string& part) { return part.empty(); });
    read.require(
        whole, fmt::format("--measured: \"{}\" is not a temperature, a place and a time with commas between, "
                           "T,X,Y,Z,SECONDS in degrees C, mm and s, maybe with the uncertainty in K behind",
                           word));
    if (!whole) continue;
    jobs::MeasuredTemperature& m = job.measured.emplace_back();
    const auto number = [&](std::size_t i, double low, double high, const char* wanted, double& value) {
      const std::string words_of_it = fmt::format("{} (in \"{}\")", wanted, word);
      read.number("--measured", parts[i], low, high, words_of_it.c_str(), value);
    };
    number(0, -273.15, 5000.0, "a temperature from -273.15 to 5000 degrees C", m.celsius);
    for (const auto& [i, at] : {std::pair{1U, &m.at.x}, {2U, &m.at.y}, {3U, &m.at.z}})
      number(i, -kLargestLength, kLargestLength, "a length in mm", *at);
    number(4, 0.0, 1e9, "a time from 0 s on", m.seconds);
    if (parts.size() == 6) number(5, 1e-3, 1000.0, "an uncertainty from 0.001 to 1000 K", m.uncertainty_k);
  }
}

/// A block by its sides, or the file of an outline with a height.
void read_stock_words(WordReader& read, const HeatWords& w, HeatOptions& o) {
  jobs::StockGiven& stock = o.job.source.stock;
  stock.block = heat::read_stock(w.stock);
  if (stock.block) {
    read.require(w.height.empty(),
                 "--height is that of an outline; the sides of a block have it behind the second x");
    return;
  }
  o.stock = w.stock;
  read.require(
      !w.height.empty(),
      fmt::format("--stock: \"{}\" is not the sides of a block in mm, as in 120x100x20, with its lower left "
                  "corner if the pocket is not in its middle, as in 120x100x20@-10,5; the file of an outline "
                  "needs --height MM",
                  w.stock));
  read.number("--height", w.height, 1e-3, 1e5, "a height from 0.001 to 100000 mm", stock.thickness);
}

void read_datum(WordReader& read, const std::string& word, heat::Holding& holding) {
  if (word.empty()) return;
  std::array<double, 3> at{};
  const std::string wanted = fmt::format("a length in mm (X,Y,Z in \"{}\")", word);
  const std::vector<std::string> parts = between_commas(word);
  read.require(parts.size() == 3,
               fmt::format("--datum: \"{}\" is not three lengths with commas between, X,Y,Z in mm", word));
  for (std::size_t i = 0; i < std::min(parts.size(), at.size()); ++i) {
    read.require(!parts[i].empty(), fmt::format("--datum: \"\" is not {}", wanted));
    read.number("--datum", parts[i], -kLargestLength, kLargestLength, wanted.c_str(), at[i]);
  }
  holding.datum = heat::Place{at[0], at[1], at[2]};
}

void read_holding(WordReader& read, const HeatWords& w, heat::Holding& holding) {
  Hold hold = Hold::free;
  read.choice("--hold", w.hold, kHolds, hold);
  if (hold == Hold::plate) holding.held[of(heat::Side::z_low)] = true;
  if (hold == Hold::vice_x) holding.held[of(heat::Side::x_low)] = holding.held[of(heat::Side::x_high)] = true;
  if (hold == Hold::vice_y) holding.held[of(heat::Side::y_low)] = holding.held[of(heat::Side::y_high)] = true;
  read_datum(read, w.datum, holding);
  read.require(w.datum.empty() || hold == Hold::free,
               "--datum is for --hold free; what is held stays where its sides are held");
}

/// A picture is drawn beside the result, where its name is not said.
std::string picture_beside(const std::string& output) {
  if (output.empty()) return {};
  return (output.ends_with(".json") ? output.substr(0, output.size() - 5) : output) + ".svg";
}

Result<Command> to_heat(const HeatWords& w) {
  WordReader read;
  HeatOptions o;
  o.program = w.program, o.pocket = w.pocket, o.output = w.output, o.json = w.json, o.cooling = w.cooling;
  o.picture = w.picture.empty() ? picture_beside(w.output) : w.picture;
  o.maps = w.maps, o.report = w.report, o.animation = w.animation;
  for (const auto& [option, name] : {std::pair{"--picture ", &w.picture}, {"--maps ", &w.maps}})
    read.require(name->empty() || name->ends_with(".svg") || name->ends_with(".png"),
                 option + *name + ": the name has to end in .svg or .png");
  read.require(w.report.empty() || jobs::picture_form(w.report).has_value(),
               "--report " + w.report + ": the name has to end in .svg, .pdf or .png");
  read.require(w.animation.empty() || w.animation.ends_with(".html"),
               "--animation " + w.animation + ": the name has to end in .html");
  read_stock_words(read, w, o);
  read_measured(read, w.measured, o.job);
  verify::SimulateOptions& machining = o.job.source.machining;
  read.number("--tool", w.tool, 1e-3, 1e4, "a diameter from 0.001 to 10000 mm", machining.tool_diameter);
  read.number("--teeth", w.teeth, 1, 100,
              "a whole number from 1 to 100, without which chips have no thickness",
              o.job.source.cutting.teeth);
  read.number("--spindle", w.spindle, 1.0, 1e6,
              "a speed from 1 to 1,000,000 rev/min, without which chips have no thickness",
              o.job.source.cutting.spindle_rpm);
  read_after(read, w.after, o.after);
  read_control(read, w.control, machining.control);
  read.number("--stock-to-leave", w.stock_to_leave, 0.0, 1e4, "a length from 0 to 10000 mm",
              machining.stock_to_leave);
  read.number("--top", w.top, -1e6, 1e6, "a height within 1000 m of 0, in mm", machining.top);
  read.number("--acceleration", w.acceleration, 1e-3, 1e9, "a number above 0", machining.acceleration);
  read.number("--rapid", w.rapid, 1e-3, 1e9, "a number above 0", machining.rapid_feed);
  read.number("--ambient", w.ambient, -100.0, 1000.0, "a temperature from -100 to 1000 degrees C",
              o.job.ambient_c);
  read.number("--voxel", w.voxel, 0.05, 100.0, "a length from 0.05 to 100 mm", o.job.pitch);
  o.corrected = w.corrected;
  double finish = 0;
  read.number("--finish", w.finish, 1e-3, 1e4, "a length from 0.001 to 10000 mm", finish);
  if (!w.finish.empty()) o.finish = finish;
  read.require(w.finish.empty() || !w.corrected.empty(), "--finish is for --corrected FILE");
  o.material.name = w.material;
  read_figures(read, w, o);
  read_holding(read, w, o.job.holding);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

std::string names_of_materials() {
  std::string names;
  for (const heat::KnownMaterial& m : heat::known_materials())
    names += (names.empty() ? "" : ", ") + std::string(m.name);
  return names;
}

}  // namespace

Typed add_heat_form(Form& form) {
  auto words = std::make_shared<HeatWords>();
  HeatWords& w = *words;
  const OptionAdder add(form);
  add("program", w.program, "FILE", "NC program of X, Y and Z").required = true;
  add("--pocket", w.pocket, "FILE", "The pocket's outline, JSON regions with lines, arcs and islands")
      .required = true;
  add("--stock", w.stock, "WxDxT[@X,Y]|FILE",
      "Sides of the block, and its lower left corner if the pocket is not in its middle; or an outline")
      .required = true;
  add("--height", w.height, "MM", "Of a stock whose outline is a file");
  add("--tool", w.tool, "MM", "Diameter of the tool").required = true;
  add("--teeth", w.teeth, "N", "Of the tool").required = true;
  add("--spindle", w.spindle, "REV/MIN", "Its speed").required = true;
  add("--material", w.material, "NAME", names_of_materials());
  add("--cooling", w.cooling, "WORD", "dry, mql, flood, or a film in W/m2K as in 20..60 [dry]");
  add("--hold", w.hold, "WORD", "free, plate (under it), vice-x or vice-y (jaws) [free]");
  add("--datum", w.datum, "X,Y,Z", "A place that does not move, with --hold free [none]");
  add("--ambient", w.ambient, "C", "Temperature about it, degrees C [20]");
  add("--measured", w.measured, "T,X,Y,Z,S[,K]",
      "It was T degrees C warm there after S seconds, within K [2.5]; again for more")
      .one_word_a_time = true;
  add("--voxel", w.voxel, "MM", "What the block is divided into [2]");
  add_after(add, w.after);
  add("--stock-to-leave", w.stock_to_leave, "MM", "What stays on every wall [0]");
  add("--top", w.top, "MM", "Z of the stock's upper face [0]");
  add("--acceleration", w.acceleration, "MM/S2", "Of the machine, for the time [500]");
  add("--rapid", w.rapid, "MM/MIN", "Feed of G0 [5000]");
  add("--control", w.control, control_list(), "Whose words the program has [linuxcnc]");
  add("--picture", w.picture, "FILE",
      "Draw the errors of the walls (.svg or .png) [beside the result, .svg]");
  add("--maps", w.maps, "FILE", "Draw temperature, stress and displacement (.svg or .png)");
  add("--report", w.report, "FILE", "Write one page to decide by and to file (.svg, .pdf or .png)");
  add("--animation", w.animation, "FILE", "Write a page that plays the temperatures (.html)");
  add("--corrected", w.corrected, "FILE",
      "Write the program with its finishing passes moved, where that is better than a scaling");
  add("--finish", w.finish, "MM", "The most that a finishing pass takes off a wall [half the tool's radius]");
  add("-o,--output", w.output, "FILE", "Write the result as JSON");
  add("--json", w.json, "Print the result as JSON on stdout");
  const OptionAdder figures(form, "Figures of the material: one, or two as in 1..2");
  for (std::size_t i = 0; i < kFigures.size(); ++i)
    figures(option_of(kFigures[i]).c_str(), w.figures[i], kFigures[i].unit, kFigures[i].help);
  figures("--wear", w.wear, "TIMES", "A worn edge needs so many times the force [1]");
  form.footer =
      "Exit codes: 0 a result, 1 a result but no corrected program, 2 wrong command line, 3 a file or a "
      "figure\n"
      "that cannot be judged, 4 the result failed its check, 5 disk or memory. What is modelled:\n"
      "docs/design/heat-walls.md";
  return [words] { return to_heat(*words); };
}

}  // namespace lekalo::cli

#include <algorithm>
#include <cmath>
#include <memory>

#include "after_words.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"
#include "step_over_word.hpp"

namespace lekalo::cli {
namespace {

constexpr std::array kCoolants{Word<mill::Coolant>{"off", mill::Coolant::off},
                               Word<mill::Coolant>{"mist", mill::Coolant::mist},
                               Word<mill::Coolant>{"flood", mill::Coolant::flood}};
constexpr std::array kDirections{Word<mill::Direction>{"any", mill::Direction::any},
                                 Word<mill::Direction>{"climb", mill::Direction::climb},
                                 Word<mill::Direction>{"conventional", mill::Direction::conventional}};
constexpr std::array kPocketMethods{Word<mill::Method>{"fronts", mill::Method::fronts},
                                    Word<mill::Method>{"floz-linear", mill::Method::floz_linear},
                                    Word<mill::Method>{"floz-quadratic", mill::Method::floz_quadratic}};
constexpr std::array kWorkOffsets{Word<int>{"G54", 1}, Word<int>{"G55", 2}, Word<int>{"G56", 3},
                                  Word<int>{"G57", 4}, Word<int>{"G58", 5}, Word<int>{"G59", 6}};

/// The words as they were typed.
struct PocketWords {
  std::string pocket, tool, step_over, stock_to_leave, floor_stock, depth, step_down, rest, direction,
      ramp_angle, safe_height, tolerance;
  std::string feed, feed_per_tooth, teeth, most_feed, plunge_feed, link_feed, spindle;
  std::string post, output_units, work_offset, tool_number, coolant;
  std::string units, join, repair;
  std::string method, sampling, trace_step, images;
  std::vector<std::string> layers, island_layers, open_layers, after, starts;
  std::string output, picture, animation;
  bool json = false, whole = false, strict = false;
};

/// `--feed`, or what feed per tooth, teeth and spindle make.
void read_feed(WordReader& read, const PocketWords& w, mill::ProgramOptions& program) {
  const char* const feed = "a feed above 0, mm/min";
  read.number("--feed", w.feed, 1e-3, 1e6, feed, program.feed_mm_per_min);
  if (w.feed_per_tooth.empty()) {
    read.require(w.teeth.empty(), "--teeth: has no meaning without --feed-per-tooth");
    return;
  }
  double per_tooth = 0;
  unsigned teeth = 0;
  read.number("--feed-per-tooth", w.feed_per_tooth, 1e-6, 100.0, "a feed from 0.000001 to 100 mm", per_tooth);
  read.number("--teeth", w.teeth, 1u, 100u, "a whole number from 1 to 100", teeth);
  read.require(w.feed.empty(), "--feed and --feed-per-tooth say the same thing twice");
  read.require(teeth > 0 && program.spindle > 0,
               "--feed-per-tooth: needs --teeth and --spindle, which make the feed");
  program.feed_mm_per_min = per_tooth * teeth * program.spindle;
  read.require(program.feed_mm_per_min >= 1e-3 && program.feed_mm_per_min <= 1e6,
               "--feed-per-tooth: the feed it makes is not from 0.001 to 1,000,000 mm/min");
}

void read_post(WordReader& read, const std::string& word, nc::Dialect& post) {
  if (word.empty()) return;
  const nc::Dialect* const known = nc::post_named(word);
  read.require(known != nullptr,
               fmt::format("--post: \"{}\" is not one of {}", word, nc::post_names(", ", ", ")));
  if (known != nullptr) post = *known;
}

/// `X,Y`
void read_start(WordReader& read, const std::string& word, std::vector<geom::Point>& starts) {
  const std::size_t comma = std::min(word.find(','), word.size());
  const std::string x = word.substr(0, comma), y = word.substr(std::min(comma + 1, word.size()));
  read.require(!x.empty() && !y.empty(),
               fmt::format("--start: \"{}\" is not two lengths with a comma between, X,Y in mm", word));
  const std::string wanted = fmt::format("a length in mm (X,Y in \"{}\")", word);
  geom::Point p;
  read.number("--start", x, -kLargestLength, kLargestLength, wanted.c_str(), p.x);
  read.number("--start", y, -kLargestLength, kLargestLength, wanted.c_str(), p.y);
  starts.push_back(p);
}

Result<Command> to_pocket(const PocketWords& w) {
  WordReader read;
  PocketOptions o;
  o.pocket = w.pocket, o.output = w.output, o.picture = w.picture, o.animation = w.animation, o.json = w.json;
  read_step_over(read, w.step_over, 50, o.path.step_over);
  read.number("--tool", w.tool, 0.01, 1e4, "a diameter from 0.01 to 10000 mm", o.path.tool_diameter);
  read.number("--depth", w.depth, 1e-3, 1e4, "a depth from 0.001 to 10000 mm", o.path.depth);
  read.number("--stepdown", w.step_down, 1e-3, 1e4, "a depth from 0.001 to 10000 mm", o.path.step_down);
  read.number("--stock-to-leave", w.stock_to_leave, 0.0, 1e4, "a length from 0 to 10000 mm",
              o.path.stock_to_leave);
  read.number("--floor-stock", w.floor_stock, 0.0, 1e4, "a length from 0 to 10000 mm", o.path.floor_stock);
  read.number("--rest", w.rest, 0.01, 1e4, "a diameter from 0.01 to 10000 mm", o.rest_of);
  read_after(read, w.after, o.after);
  read.require(w.rest.empty() || w.after.empty(),
               "--rest supposes a tool before, --after says what it cut; give one of them");
  read.choice("--cut", w.direction, kDirections, o.path.direction);
  double degrees = o.path.ramp_angle / kDegree;
  read.number("--ramp-angle", w.ramp_angle, 0.1, 45.0, "an angle from 0.1 to 45 degrees", degrees);
  if (!w.ramp_angle.empty()) o.path.ramp_angle = degrees * kDegree;
  read.choice("--method", w.method, kPocketMethods, o.path.method);
  read.number("--sampling", w.sampling, 1e-3, 1e4, "a length from 0.001 to 10000 mm", o.path.sampling);
  read.number("--trace-step", w.trace_step, 1e-3, 1e4, "a length from 0.001 to 10000 mm", o.path.trace_step);
  read.require(o.path.method == mill::Method::fronts || (w.rest.empty() && w.after.empty()),
               "--rest and --after have a meaning with --method fronts alone");
  for (const std::string& word : w.starts) read_start(read, word, o.path.starts);
  o.path.whole = w.whole, o.images = w.images;
  read.require(o.path.method != mill::Method::fronts || (w.sampling.empty() && w.trace_step.empty() &&
                                                         w.starts.empty() && w.images.empty() && !w.whole),
               "--sampling, --trace-step, --start, --images and --whole have a meaning with --method "
               "floz-linear and floz-quadratic alone");
  read.number("--safe-height", w.safe_height, 1e-3, 1e4, "a height above 0, mm", o.path.safe_height);
  read.number("--tolerance", w.tolerance, 1e-5, 1.0, "a length from 0.00001 to 1 mm", o.path.fit_tolerance);
  read.number("--spindle", w.spindle, 1.0, 1e6, "a speed from 1 to 1,000,000 rev/min", o.program.spindle);
  read_feed(read, w, o.program);
  const char* const feed = "a feed above 0, mm/min";
  read.number("--plunge-feed", w.plunge_feed, 1e-3, 1e6, feed, o.program.plunge_feed_mm_per_min);
  read.number("--link-feed", w.link_feed, 1e-3, 1e6, feed, o.program.link_feed_mm_per_min);
  if (!w.most_feed.empty()) {
    double most = 0;
    read.number("--feed-max", w.most_feed, 1e-3, 4e6, feed, most);
    read.require(most >= o.program.feed_mm_per_min && most <= 4 * o.program.feed_mm_per_min,
                 fmt::format("--feed-max {}: is to be from the feed, {:g}, to four times it", w.most_feed,
                             o.program.feed_mm_per_min));
    o.most_feed = most;
  }
  read_post(read, w.post, o.program.post);
  read.choice("--output-units", w.output_units, kUnits, o.program.unit);
  read.choice("--work-offset", w.work_offset, kWorkOffsets, o.program.work_offset);
  read.choice("--coolant", w.coolant, kCoolants, o.program.coolant);
  read.number("--tool-number", w.tool_number, 1, 9999, "a whole number from 1 to 9999",
              o.program.tool_number);
  if (!w.units.empty()) {
    LengthUnit unit{};
    read.choice("--units", w.units, kUnits, unit);
    o.outline.units = unit;
  }
  if (!w.join.empty()) {
    double join = 0;
    read.number("--join", w.join, 0.0, kLargestLength, "a length from 0 mm on", join);
    o.outline.join = join;
  }
  if (!w.repair.empty())
    read.number("--repair", w.repair, 0.0, kLargestLength, "a length from 0 mm on",
                o.outline.repair.emplace());
  o.outline.strict = w.strict;
  o.outline.layers = w.layers;
  o.island_layers = w.island_layers, o.open_layers = w.open_layers;
  read.require(w.picture.empty() || w.picture.ends_with(".svg") || w.picture.ends_with(".png"),
               "--picture " + w.picture + ": the name has to end in .svg or .png");
  read.require(!w.json || !w.output.empty(),
               "--json: the report goes to stdout, so the program needs -o FILE");
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

}  // namespace

Typed add_pocket_form(Form& form) {
  auto words = std::make_shared<PocketWords>();
  PocketWords& w = *words;
  const OptionAdder add(form);
  add("pocket", w.pocket, "FILE",
      fmt::format("The pockets' outlines: JSON regions, {}, a tree of primitives, points",
                  io::drawing_names(", ", " or ")))
      .required = true;
  add("--tool", w.tool, "MM", "Diameter of the tool").required = true;
  add("--depth", w.depth, "MM", "Of the pocket, below Z 0").required = true;
  add("--stepdown", w.step_down, "MM", "Depth of one level at most; levels are equally deep [one level]");
  add("--stepover", w.step_over, "PERCENT", "Of the tool's diameter, from 1% to 50% [40%]");
  add("--stock-to-leave", w.stock_to_leave, "MM", "What stays on every wall [0]");
  add("--floor-stock", w.floor_stock, "MM", "What stays on the floor [0]");
  add_after(add, w.after);
  add("--rest", w.rest, "MM", "Instead: suppose a larger tool cut all it can, as lekalo pocket would");
  add("--cut", w.direction, "WORD", "climb, conventional or any [any]");
  add("--ramp-angle", w.ramp_angle, "DEGREES",
      "Of ways down into the material: the helix, and ramps in slots and sharp corners [2.9]");
  add("--safe-height", w.safe_height, "MM", "Above Z 0 [5]");
  add("-o,--output", w.output, "FILE", "Write the program to this file [stdout]");
  add("--picture", w.picture, "FILE", "Draw the path coloured by engagement (.svg or .png)");
  add("--animation", w.animation, "FILE", "Write a page that plays the cut (.html)");
  add("--json", w.json, "Print the report as JSON on stdout");
  const OptionAdder feeds(form, "Feeds");
  feeds("--feed", w.feed, "MM/MIN", "In the cut [1500]");
  feeds("--feed-per-tooth", w.feed_per_tooth, "MM", "Instead of --feed, with --teeth and --spindle");
  feeds("--teeth", w.teeth, "N", "Of the tool");
  feeds("--feed-max", w.most_feed, "MM/MIN", "Up to this where less is cut: feeds follow the engagement");
  feeds("--plunge-feed", w.plunge_feed, "MM/MIN", "Straight down [300]");
  feeds("--link-feed", w.link_feed, "MM/MIN", "At depth through what is cut already [5000]");
  const OptionAdder program(form, "Program");
  program("--post", w.post, "WORD",
          fmt::format("{} [{}]", nc::post_names(", ", " or "), nc::posts().front().name));
  program("--output-units", w.output_units, "WORD", "Of the program: mm or inch [mm]");
  program("--work-offset", w.work_offset, "WORD", "G54 to G59 [G54]");
  program("--tool-number", w.tool_number, "N", "Change to this tool first, with its length");
  program("--spindle", w.spindle, "REV/MIN", "Start the spindle, clockwise [left alone]");
  program("--coolant", w.coolant, "WORD", "off, mist or flood [off]");
  program("--tolerance", w.tolerance, "MM", "Of lines and arcs instead of the path's points [0.002]");
  const OptionAdder reading(form, "Reading");
  reading("--units", w.units, "WORD", "Of a file that does not say: mm or inch [mm]");
  reading("--join", w.join, "MM", "Ends of a drawing's curves this near are joined [0.01]");
  reading("--repair", w.repair, "MM", "Mends of a drawing move no outline further [0.2]");
  reading("--strict", w.strict, "Refuse a drawing of which anything would be mended or set aside");
  reading("--layer", w.layers, "NAME", "Outlines on this layer of a drawing; again for more [all shown]");
  reading("--island-layer", w.island_layers, "NAME", "What this layer encloses stays");
  reading("--open-layer", w.open_layers, "NAME", "Edges on this layer are no walls: beyond is air");
  const OptionAdder source(form, "The source's method, for comparison");
  source("--method", w.method, "WORD", "fronts, floz-linear or floz-quadratic [fronts]");
  source("--sampling", w.sampling, "MM", "Longest segment of its model of the outline [3]");
  source("--trace-step", w.trace_step, "MM",
         "Step of its spiral; a turn ends pi steps farther out [by --stepover]");
  source("--start", w.starts, "X,Y",
         "Begin the spiral of the fragment there at this place; again for others [the peak of each]")
      .one_word_a_time = true;
  source("--images", w.images, "PREFIX", "Write the model as PREFIX-A.png to -D.png and PREFIX-value.png");
  source("--whole", w.whole, "One model and one spiral, not one for each convex fragment");
  form.footer =
      "Where the tool does not fit is said and drawn; the rest is cut.\n"
      "Exit codes: 0 done, 2 wrong command line, 3 a file cannot be read or the tool fits nowhere,\n"
      "4 the program found failed its check, 5 disk or memory. lekalo simulate judges any program.";
  return [words] { return to_pocket(*words); };
}

}  // namespace lekalo::cli

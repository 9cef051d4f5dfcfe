#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

/// The words of the command line as they were typed.
struct FitWords {
  std::string fit, diameter, interference, hub_outer, length, shaft_length, from_end, bore, roughness,
      friction, clearance;
  std::string material, youngs, poisson, yield, hardening, expansion, shaft_material, output, picture,
      cylindrical, table, drawing, program, control, feed, spindle;
  std::vector<std::string> rings;
  bool json = false, radius = false;
};

constexpr const char* kLength = "a length from 0.001 to 10000 mm";

/// "LOW,HIGH": two numbers.
std::optional<std::array<double, 2>> read_pair(WordReader& read, const char* option, const std::string& word,
                                               double most, const char* wanted) {
  if (word.empty()) return {};
  const std::size_t comma = word.find(',');
  std::array<double, 2> pair{-1, -1};
  read.number(option, word.substr(0, comma), 0.0, most, wanted, pair[0]);
  read.number(option, comma == std::string::npos ? "" : word.substr(comma + 1), 0.0, most, wanted, pair[1]);
  read.require(pair[0] >= 0 && pair[1] >= 0, fmt::format("{}: \"{}\" is not {}", option, word, wanted));
  return pair;
}

/// "OUTER,INTERFERENCE": mm.
void read_rings(WordReader& read, const std::vector<std::string>& words,
                std::vector<jobs::OuterRing>& rings) {
  for (const std::string& word : words) {
    const auto pair =
        read_pair(read, "--ring", word, 1e4, "an outer diameter and an interference in mm, like 50,0.04");
    if (pair) rings.push_back({(*pair)[0], (*pair)[1]});
  }
}

void read_optional(WordReader& read, const char* option, const std::string& word, double low, double high,
                   const char* wanted, std::optional<double>& value) {
  if (word.empty()) return;
  double number = 0;
  read.number(option, word, low, high, wanted, number);
  value = number;
}

/// The profile that is turned before pressing, and its files.
void read_turning(WordReader& read, const FitWords& w, jobs::FitJob& job) {
  if (w.cylindrical == "outside") job.cylindrical = fit::Surface::outside;
  if (w.cylindrical == "bore") job.cylindrical = fit::Surface::bore;
  if (w.cylindrical == "seat") job.cylindrical = fit::Surface::seat;
  read.require(w.cylindrical.empty() || job.cylindrical,
               fmt::format("--cylindrical: \"{}\" is not outside, bore or seat", w.cylindrical));
  job.table_as = w.table, job.drawing_as = w.drawing, job.program_as = w.program;
  read.require(job.cylindrical || (w.table + w.drawing + w.program).empty(),
               "--profile, --drawing and --program need --cylindrical outside, bore or seat");
  read.require(!w.program.empty() || (w.control + w.feed + w.spindle).empty(),
               "--control, --feed and --spindle are for --program FILE");
  read.require(!w.radius || !w.program.empty(), "--radius is for --program FILE");
  if (w.control == "fanuc") job.turning.control = fit::Lathe::fanuc;
  read.require(w.control.empty() || w.control == "fanuc" || w.control == "linuxcnc",
               fmt::format("--control: \"{}\" is not linuxcnc or fanuc", w.control));
  job.turning.radius = w.radius;
  read.number("--feed", w.feed, 0.1, 1e5, "a feed from 0.1 to 100000 mm/min", job.turning.feed_mm_per_min);
  unsigned spindle = 0;
  read.number("--spindle", w.spindle, 1U, 100000U, "a whole number from 1 to 100000 1/min", spindle);
  if (spindle > 0) job.turning.spindle_rpm = spindle;
}

Result<Command> to_fit(const FitWords& w) {
  WordReader read;
  FitOptions o;
  o.output = w.output, o.picture = w.picture, o.json = w.json;
  read.require(w.picture.empty() || w.picture.ends_with(".svg") || w.picture.ends_with(".png"),
               "--picture " + w.picture + ": the name has to end in .svg or .png");
  o.job.picture = jobs::picture_form(w.picture);
  o.job.fit = w.fit;
  read.require(w.fit.empty() != w.diameter.empty() && w.diameter.empty() == w.interference.empty(),
               "say what is pressed: --fit 18H8/z8, or --diameter MM and --interference MM");
  read.number("--diameter", w.diameter, 1e-3, 1e4, kLength, o.job.diameter);
  const std::size_t comma = std::min(w.interference.find(','), w.interference.size());
  read.number("--interference", w.interference.substr(0, comma), -1e4, 1e4, "a length in mm",
              o.job.interference);
  if (comma < w.interference.size()) {
    read.number("--interference", w.interference.substr(comma + 1), -1e4, 1e4, "a length in mm",
                o.job.most_interference);
    read.require(o.job.interference < o.job.most_interference,
                 "--interference " + w.interference + ": the least comes first");
  }
  read.number("--hub-outer", w.hub_outer, 1e-3, 1e4, kLength, o.job.hub_outer);
  read.number("--length", w.length, 1e-3, 1e4, kLength, o.job.length);
  read.number("--shaft-length", w.shaft_length, 1e-3, 1e4, kLength, o.job.shaft_length);
  read_optional(read, "--from-end", w.from_end, 0, 1e4, "a length from 0 to 10000 mm", o.job.from_end);
  read.number("--bore", w.bore, 0.0, 1e4, "a length from 0 to 10000 mm", o.job.bore);
  read_rings(read, w.rings, o.job.more);
  o.job.material.name = w.material;
  read_optional(read, "--youngs", w.youngs, 1, 1e7, "a modulus from 1 to 1e7 MPa", o.job.material.youngs_mpa);
  read_optional(read, "--poisson", w.poisson, 0, 0.49, "a ratio from 0 to 0.49", o.job.material.poisson);
  read_optional(read, "--yield", w.yield, 1e-3, 1e6, "a stress from 0.001 to 1e6 MPa",
                o.job.material.yield_mpa);
  read_optional(read, "--hardening", w.hardening, 0, 1e7, "a modulus from 0 to 1e7 MPa",
                o.job.material.hardening_mpa);
  read_optional(read, "--expansion", w.expansion, 1e-9, 1e-3, "a coefficient from 1e-9 to 1e-3 per K",
                o.job.material.expansion_per_k);
  if (!w.shaft_material.empty()) o.job.shaft_material.emplace().name = w.shaft_material;
  o.job.roughness_um =
      read_pair(read, "--roughness", w.roughness, 1e3, "Rz of shaft and hub in um, like 4,6.3");
  o.job.friction =
      read_pair(read, "--friction", w.friction, 2, "the least and the greatest friction, like 0.08,0.12");
  read.require(!o.job.friction || (*o.job.friction)[0] <= (*o.job.friction)[1],
               "--friction " + w.friction + ": the least comes first");
  read_optional(read, "--clearance", w.clearance, 0, 1e4, "a clearance in um", o.job.clearance_um);
  read_turning(read, w, o.job);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

}  // namespace

Typed add_fit_form(Form& form) {
  auto words = std::make_shared<FitWords>();
  FitWords& w = *words;
  const OptionAdder add(form);
  add("--fit", w.fit, "FIT", "Diameter, hole and shaft by ISO 286, like 18H8/z8");
  add("--diameter", w.diameter, "MM", "Of the seat, instead of --fit");
  add("--interference", w.interference, "MM[,MM]",
      "In diameter, with --diameter; or the least and the greatest");
  add("--hub-outer", w.hub_outer, "MM", "Outer diameter of the hub").required = true;
  add("--length", w.length, "MM", "Of the hub").required = true;
  add("--shaft-length", w.shaft_length, "MM", "Of the shaft [three times the hub's]");
  add("--from-end", w.from_end, "MM", "From the shaft's right end to the hub's [the hub in the middle]");
  add("--bore", w.bore, "MM", "Of a hollow shaft [0]");
  add("--ring", w.rings, "OUTER,MM",
      "One more ring on what is there: its outer diameter, and its interference");
  add("--material", w.material, "NAME", "Of all parts: C45 or 6061-T6");
  add("--youngs", w.youngs, "MPA", "Young's modulus, instead of the material's");
  add("--poisson", w.poisson, "RATIO", "Poisson's ratio");
  add("--yield", w.yield, "MPA", "Yield stress");
  add("--hardening", w.hardening, "MPA", "Growth of the yield stress with plastic strain [0]");
  add("--expansion", w.expansion, "1/K", "Thermal expansion, for --clearance");
  add("--shaft-material", w.shaft_material, "NAME", "Of the shaft, where it is another");
  add("--roughness", w.roughness, "SHAFT,HUB", "Rz in um: the interference that is smoothed away");
  add("--friction", w.friction, "LEAST,MOST", "For the force of pressing");
  add("--clearance", w.clearance, "UM", "In diameter, for the temperature of shrinking");
  add("--cylindrical", w.cylindrical, "SURFACE",
      "outside, bore or seat (of the shaft): turn it such that it is a cylinder after pressing");
  add("--profile", w.table, "FILE", "Write what is to be turned as CSV");
  add("--drawing", w.drawing, "FILE", "Write it as DXF");
  add("--program", w.program, "FILE", "Write the finishing cut along it as NC program");
  add("--control", w.control, "NAME", "Whose words it has: linuxcnc or fanuc [linuxcnc]");
  add("--radius", w.radius, "X of the program is a radius, not a diameter");
  add("--feed", w.feed, "MM/MIN", "Of the finishing cut [50]");
  add("--spindle", w.spindle, "1/MIN", "Speed of the spindle [1000]");
  add("--picture", w.picture, "FILE", "Draw the surfaces along the axis (.svg or .png)");
  add("-o,--output", w.output, "FILE", "Write the result as JSON");
  add("--json", w.json, "Print the result as JSON on stdout");
  form.footer =
      "Exit codes: 0 a result, 2 wrong command line, 3 no such fit, or one that the parts do not carry,\n"
      "4 the result failed its check, 5 disk or memory. What is modelled: docs/design/fit.md";
  return [words] { return to_fit(*words); };
}

}  // namespace lekalo::cli

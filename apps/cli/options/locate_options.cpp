#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "control_word.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "option_forms.hpp"
#include "option_words.hpp"

namespace lekalo::cli {
namespace {

using Method = jobs::LocateMethod;

/// A word means one thing where the files are outlines in the plane, and another, or nothing, where they are
/// solids.
template <class Outline, class Solid>
struct Either {
  std::optional<Outline> outline;
  std::optional<Solid> solid;
};
using EitherMethod = Either<Method, jobs::SolidMethod>;
using EitherUnit = Either<LengthUnit, io::SolidUnit>;
constexpr std::array kLocateMethods{
    Word<EitherMethod>{"certified", {Method::certified, jobs::SolidMethod::certified}},
    Word<EitherMethod>{"ipopt", {Method::ipopt, std::nullopt}},
    Word<EitherMethod>{"icp", {Method::icp, jobs::SolidMethod::icp}},
    Word<EitherMethod>{"climb", {std::nullopt, jobs::SolidMethod::climb}},
    Word<EitherMethod>{"axes", {std::nullopt, jobs::SolidMethod::axes}}};
constexpr std::array kLocateUnits{Word<EitherUnit>{"mm", {LengthUnit::millimetre, io::SolidUnit::millimetre}},
                                  Word<EitherUnit>{"inch", {LengthUnit::inch, io::SolidUnit::inch}},
                                  Word<EitherUnit>{"m", {std::nullopt, io::SolidUnit::metre}}};
constexpr std::array kFreedoms{Word<locate::SolidFreedom>{"xyz", locate::SolidFreedom::xyz},
                               Word<locate::SolidFreedom>{"c-xyz", locate::SolidFreedom::c_xyz},
                               Word<locate::SolidFreedom>{"six", locate::SolidFreedom::six}};
constexpr std::array kStartRules{
    Word<locate::StartRule>{"random", locate::StartRule::random},
    Word<locate::StartRule>{"centroids", locate::StartRule::centroids},
    Word<locate::StartRule>{"principal-axes", locate::StartRule::principal_axes}};
constexpr std::array kModes{Word<nc::RewriteMode>{"coordinates", nc::RewriteMode::coordinates},
                            Word<nc::RewriteMode>{"offset", nc::RewriteMode::offset},
                            Word<nc::RewriteMode>{"g68", nc::RewriteMode::g68}};
constexpr std::array kScanFrames{Word<nc::ScanFrame>{"machine", nc::ScanFrame::machine},
                                 Word<nc::ScanFrame>{"wcs", nc::ScanFrame::wcs}};
constexpr std::array kOffsetControls{Word<nc::OffsetControl>{"linuxcnc", nc::OffsetControl::linuxcnc},
                                     Word<nc::OffsetControl>{"fanuc", nc::OffsetControl::fanuc},
                                     Word<nc::OffsetControl>{"siemens", nc::OffsetControl::siemens}};
constexpr std::array kMirrors{Word<locate::Mirror>{"no", locate::Mirror::no},
                              Word<locate::Mirror>{"yes", locate::Mirror::yes},
                              Word<locate::Mirror>{"either", locate::Mirror::either}};

/// As typed.
struct LocateWords {
  std::string part, blank, units, trim, gap, min_allowance, method, starts, start_rule, seed, work, time,
      alternatives, nc, nc_out, nc_mode, nc_angle_decimals, control, allow, chord_tolerance, wcs, scan_frame,
      output, certificate, picture, report, allowances, drawing, deviations, compare, mirror, lock_x, lock_y,
      features, criterion, give_up, trade_off, join, curve, repair, underside, flat, uncertainty, coverage,
      min_radius, max_dip, step, drop_outliers, simplify, slice_height, slice_thickness, freedom, tilt, shift,
      start, mesh, mesh_step, offset, offset_out, axes, nominal, ball, form;
  std::vector<std::string> part_layers, blank_layers;
  std::vector<std::string> window, offset_decimals, nominal_window;
  bool json = false, strict = false, find_start = false;
};

constexpr double kLargestWindowAngle = 720.0;  // degrees: either way of writing a window fits
constexpr double kClosedWindow = 1e-9;         // degrees: a smaller opening is none
constexpr double kAllTurns = 180;              // degrees: a solid turned by up to this is turned anyhow
constexpr double kLongestTime = 1e7;           // seconds

void read_window(const std::vector<std::string>& words, WordReader& read, LocateOptions& o) {
  if (words.size() != 2) return;
  const char* const wanted = "an angle between -720 and 720 degrees";
  read.number("--window", words[0], -kLargestWindowAngle, kLargestWindowAngle, wanted, o.job.window_from_deg);
  read.number("--window", words[1], -kLargestWindowAngle, kLargestWindowAngle, wanted, o.job.window_to_deg);
  read.require(o.job.window_from_deg <= o.job.window_to_deg,
               fmt::format("--window: the first angle, {}, is above the second, {}", words[0], words[1]));
  o.solid.window_from_deg = o.job.window_from_deg, o.solid.window_to_deg = o.job.window_to_deg;
  if (o.job.window_to_deg - o.job.window_from_deg > 360 - kClosedWindow) {
    o.job.window_from_deg = 0;
    o.job.window_to_deg = 360;
  }
}

/// The names of the criteria that go on from the first one, or what they favour, in one text.
std::string later_criteria(std::string_view locate::Criterion::*said, std::string_view last_separator) {
  std::string list;
  const auto later = locate::criteria().subspan(1);
  for (const locate::Criterion& criterion : later) {
    if (!list.empty()) list += &criterion == &later.back() ? last_separator : ", ";
    list += criterion.*said;
  }
  return list;
}

void read_criterion(const std::string& word, WordReader& read, locate::Criterion& criterion) {
  if (word.empty()) return;
  const locate::Criterion* const known = locate::criterion_named(word);
  read.require(known != nullptr,
               fmt::format("--criterion: \"{}\" is not one of {}", word, locate::criterion_names(", ")));
  if (known != nullptr) criterion = *known;
}

void read_search(const LocateWords& words, WordReader& read, LocateOptions& o) {
  read_window(words.window, read, o);
  if (!words.gap.empty()) {
    read.number("--gap", words.gap, kSmallestLength, kLargestLength, "a length in mm above 0",
                o.job.gap.emplace());
    o.solid.gap = *o.job.gap;
  }
  read.choice("--mirror", words.mirror, kMirrors, o.job.mirror);
  for (const auto& [option, word, to] :
       {std::tuple{"--lock-x", &words.lock_x, &o.job.locked.x}, {"--lock-y", &words.lock_y, &o.job.locked.y}})
    if (!word->empty())
      read.number(option, *word, -kLargestLength, kLargestLength, "a coordinate in mm up to 1e9",
                  to->emplace());
  o.features = words.features;
  read_criterion(words.criterion, read, o.job.criterion);
  read.number("--give-up", words.give_up, 0.0, kLargestLength, "a length in mm of 0 or more", o.job.give_up);
  read.require(words.give_up.empty() || o.job.criterion.choose != nullptr,
               fmt::format("--give-up is for --criterion {}: what they may take off the smallest allowance",
                           later_criteria(&locate::Criterion::name, " and ")));
  read.number("--trade-off", words.trade_off, std::size_t{2}, std::size_t{100},
              "a whole number from 2 to 100", o.job.trade_off);
  read.number("--min-allowance", words.min_allowance, 0.0, kLargestLength, "a length in mm of 0 or more",
              o.job.min_allowance);
  o.solid.min_allowance = o.job.min_allowance;
  read.number("--starts", words.starts, 1, 1'000'000, "a whole number from 1 to 1000000", o.job.starts);
  read.choice("--start-rule", words.start_rule, kStartRules, o.job.start_rule);
  constexpr auto kLargest = std::numeric_limits<std::uint64_t>::max();
  read.number("--seed", words.seed, std::uint64_t{0}, kLargest, "a whole number from 0 to 2^64 - 1",
              o.job.seed);
  read.number("--work", words.work, std::uint64_t{1}, kLargest, "a whole number from 1 to 2^64 - 1", o.work);
  if (!words.alternatives.empty()) {
    read.number("--alternatives", words.alternatives, 0.0, kLargestLength, "a length in mm of 0 or more",
                o.job.alternatives.emplace());
  }
  if (!words.time.empty()) {
    read.number("--time", words.time, 1e-6, kLongestTime, "a time in seconds above 0", o.seconds.emplace());
  }
}

void read_solid_search(const LocateWords& words, WordReader& read, LocateOptions& o) {
  read.choice("--freedom", words.freedom, kFreedoms, o.solid.freedom);
  const char* const tilts = "an angle from 0 to 90 degrees, or 180, which is every rotation";
  read.number("--tilt", words.tilt, 0.0, kAllTurns, tilts, o.solid.tilt_deg);
  read.require(o.solid.tilt_deg <= 90 || o.solid.tilt_deg == kAllTurns,
               fmt::format("--tilt: {} is not {}", words.tilt, tilts));
  if (!words.shift.empty())
    read.number("--shift", words.shift, 0.0, kLargestLength, "a length in mm of 0 or more",
                o.solid.shift.emplace());
  o.start = words.start;
  o.solid.find_start = words.find_start;
  read.require(!words.find_start || words.start.empty(),
               "--find-start and --start FILE: the start is either looked for or given");
}

/// The statements about a scanner's mesh, of which those about its points are read already.
void read_solid_scan(const LocateWords& words, const locate::ScanOptions& m, bool given, WordReader& read,
                     LocateOptions& o) {
  const std::string_view level = words.underside;
  read.require(words.underside.empty() == words.flat.empty(), "--underside and --flat need each other");
  read.require(level.empty() || level.starts_with("z="),
               fmt::format("--underside: \"{}\" is no level like z=0", level));
  locate::SolidUnderside side;
  if (level.starts_with("z="))
    read.number("--underside", words.underside.substr(2), -kLargestLength, kLargestLength,
                "z= and a level in mm up to 1e9", side.z);
  read.number("--flat", words.flat, kSmallestLength, kLargestLength, "a length in mm above 0", side.flat);
  o.mesh = words.mesh;
  read.require(o.mesh.empty() || o.mesh.ends_with(".ply"),
               fmt::format("--mesh: the name \"{}\" does not end in .ply", o.mesh));
  read.require(o.mesh.empty() || given,
               "--mesh is for a scan, which --uncertainty MM says that the blank is");
  std::optional<double> step;
  if (!words.mesh_step.empty())
    read.number("--mesh-step", words.mesh_step, kSmallestLength, kLargestLength, "a length in mm above 0",
                step.emplace());
  read.require(!step || !o.mesh.empty(), "--mesh-step needs --mesh FILE.ply, the mesh of the points");
  if (!given) return;
  jobs::SolidScanOptions& scan = o.solid.scan.emplace();
  scan.uncertainty = m.uncertainty, scan.coverage_factor = m.coverage_factor;
  scan.min_radius = m.min_radius, scan.max_dip = m.max_dip;
  if (!level.empty()) scan.underside = side;
  scan.drop_outliers = m.drop_outliers, scan.step = step;
}

/// The statements about a blank that was touched, of which those about its points are read already.
void read_touches(const LocateWords& words, WordReader& read, LocateOptions& o) {
  o.nominal = words.nominal;
  const bool other = !words.ball.empty() || !words.form.empty() || !words.nominal_window.empty();
  read.require(
      !words.nominal.empty() || !other,
      "--form, --ball and --nominal-window need --nominal-blank FILE, the mesh of the touched blank");
  if (words.nominal.empty()) return;
  jobs::SolidTouchOptions& touch = o.solid.touch.emplace();
  read.require(!words.form.empty(),
               "--nominal-blank needs --form MM, how far the blank's surface may be from it");
  read.require(!words.mesh.empty(), "--nominal-blank needs --mesh FILE.ply, the mesh where it was moved to");
  read.require(!words.uncertainty.empty(),
               "--nominal-blank needs --uncertainty MM, the standard uncertainty of one touch");
  for (const auto& [option, word] : {std::pair{"--min-radius", &words.min_radius},
                                     {"--max-dip", &words.max_dip},
                                     {"--underside", &words.underside},
                                     {"--mesh-step", &words.mesh_step}})
    read.require(word->empty(), fmt::format("{} is for a scan, and --nominal-blank for touches", option));
  read.number("--form", words.form, kSmallestLength, kLargestLength, "a length in mm above 0", touch.form);
  read.number("--ball", words.ball, 0.0, kLargestLength, "a diameter in mm of 0 or more", touch.ball);
  if (words.nominal_window.size() != 2) return;
  read.number("--nominal-window", words.nominal_window[0], kSmallestLength, kLargestLength,
              "a length in mm above 0 and an angle", touch.shift);
  read.number("--nominal-window", words.nominal_window[1], 0.0, 45.0,
              "a length in mm and an angle from 0 to 45 degrees", touch.turn_deg);
}

void read_shapes(const LocateWords& words, WordReader& read, LocateOptions& o) {
  const auto length = [&](const char* option, const std::string& word, double least,
                          std::optional<double>& to) {
    if (word.empty()) return;
    read.number(option, word, least, kLargestLength,
                least > 0 ? "a length in mm above 0" : "a length in mm of 0 or more", to.emplace());
  };
  io::OutlineOptions how = o.job.part;
  length("--join", words.join, 0, how.join);
  length("--curve-tolerance", words.curve, kSmallestLength, how.curve);
  length("--repair", words.repair, 0, how.repair);
  how.strict = words.strict;
  o.job.part = o.job.blank = how;
  o.job.part.layers = words.part_layers, o.job.blank.layers = words.blank_layers;

  io::ScanReading scan;
  locate::ScanOptions& m = scan.measurement;
  std::optional<double> uncertainty, simplify, height, thickness;
  length("--uncertainty", words.uncertainty, 0, uncertainty);
  length("--min-radius", words.min_radius, kSmallestLength, m.min_radius);
  length("--max-dip", words.max_dip, 0, m.max_dip);
  length("--step", words.step, kSmallestLength, m.step);
  length("--drop-outliers", words.drop_outliers, kSmallestLength, m.drop_outliers);
  length("--simplify", words.simplify, kSmallestLength, simplify);
  read.number("--coverage", words.coverage, 1e-3, 100.0, "a factor from 0.001 to 100", m.coverage_factor);
  if (!words.slice_height.empty())
    read.number("--slice-height", words.slice_height, -kLargestLength, kLargestLength,
                "a height in mm up to 1e9", height.emplace());
  length("--slice-thickness", words.slice_thickness, kSmallestLength, thickness);
  if (uncertainty) m.uncertainty = *uncertainty;
  if (simplify) m.simplify = *simplify;
  read.require(height.has_value() == thickness.has_value(),
               "--slice-height and --slice-thickness need each other");
  if (height && thickness) scan.slice = io::ScanSlice{*height, *thickness};
  const bool other = m.min_radius || m.max_dip || m.step || m.drop_outliers || simplify || height ||
                     !words.coverage.empty() || !words.underside.empty();
  read.require(uncertainty || !other,
               "a scan needs --uncertainty MM, the standard uncertainty of one measured point");
  if (uncertainty) o.job.blank.scan = scan;
  read_solid_scan(words, m, uncertainty.has_value(), read, o);
  read_touches(words, read, o);
}

void read_program(const LocateWords& words, WordReader& read, LocateOptions& o) {
  o.nc = words.nc;
  o.outputs.program = words.nc_out;
  read.require(o.nc.empty() || !o.outputs.program.empty(),
               "--nc: say with --nc-out FILE where the rewritten program goes");
  read.require(o.outputs.program.empty() || !o.nc.empty(),
               "--nc-out: say with --nc FILE which program to rewrite");
  o.allow = words.allow;
  read.require(!o.nc.empty() || (words.nc_mode.empty() && words.scan_frame.empty()),
               "--nc-mode and --scan-frame need --nc FILE, the program to rewrite");
  read.require(!o.nc.empty() || !words.offset.empty() || words.wcs.empty(),
               "--wcs needs --nc FILE, the program to rewrite, or --offset CONTROL");
  read.require(
      !o.nc.empty() || (words.control.empty() && words.allow.empty() && words.chord_tolerance.empty()),
      "--control, --allow and --chord-tolerance need --nc FILE, the program to rewrite");
  read_control(read, words.control, o.job.rewrite.control);
  read.number("--chord-tolerance", words.chord_tolerance, 1e-5, 1.0, "a length from 0.00001 to 1 mm",
              o.job.rewrite.chord_tolerance);
  read.choice("--nc-mode", words.nc_mode, kModes, o.job.rewrite.mode);
  read.choice("--scan-frame", words.scan_frame, kScanFrames, o.job.rewrite.scan_frame);
  read.number("--nc-angle-decimals", words.nc_angle_decimals, 0, 9, "a whole number from 0 to 9",
              o.job.rewrite.g68_angle_decimals);
  read.require(words.nc_angle_decimals.empty() || o.job.rewrite.mode == nc::RewriteMode::g68,
               "--nc-angle-decimals is for --nc-mode g68 alone");
  if (o.job.part.units) o.job.rewrite.start_unit = *o.job.part.units;
  read.number("--wcs", words.wcs, 1, 9, "a whole number from 1 (G54) to 9 (G59.3)",
              o.job.rewrite.work_offset);
  o.solid.rewrite = o.job.rewrite;
  if (o.solid.units == io::SolidUnit::inch) o.solid.rewrite.start_unit = LengthUnit::inch;
}

void read_offset(const LocateWords& words, WordReader& read, LocateOptions& o) {
  read.require(words.offset.empty() == words.offset_out.empty(),
               "--offset CONTROL and --offset-out FILE need each other");
  read.require(!words.offset.empty() || (words.axes.empty() && words.offset_decimals.empty()),
               "--axes and --offset-decimals need --offset CONTROL");
  o.offset_out = words.offset_out;
  if (words.offset.empty()) return;
  jobs::SolidOffsetOptions& offset = o.solid.offset.emplace();
  nc::OffsetForm& form = offset.form;
  read.choice("--offset", words.offset, kOffsetControls, form.control);
  constexpr std::array kMost{9, 6, 4};
  const int most = kMost[static_cast<std::size_t>(form.control)];
  read.number("--wcs", words.wcs, 1, most, fmt::format("a whole number from 1 (G54) to {}", most).c_str(),
              form.work_offset);
  if (words.offset_decimals.size() == 2)
    for (const auto& [word, to] : {std::pair{&words.offset_decimals[0], &form.angle_decimals},
                                   {&words.offset_decimals[1], &form.length_decimals}})
      read.number("--offset-decimals", *word, 0, 6, "two whole numbers from 0 to 6", *to);
  constexpr std::array kAxes{Word<int>{"3", 3}, Word<int>{"5", 5}};
  read.choice("--axes", words.axes, kAxes, offset.axes);
  const bool linuxcnc = form.control == nc::OffsetControl::linuxcnc;
  if (o.solid.freedom == locate::SolidFreedom::six && (linuxcnc || offset.axes == 3))
    o.not_for_solids +=
        (o.not_for_solids.empty() ? "" : "; ") +
        std::string(linuxcnc
                        ? "--offset linuxcnc, which turns about Z alone, goes with --freedom c-xyz or xyz"
                        : "--offset with --freedom six is for a machine that can tilt: say --axes 5, or "
                          "--freedom c-xyz or xyz");
}

void read_outputs(const LocateWords& words, WordReader& read, LocateOptions& o) {
  o.output = words.output;
  o.outputs.certificate = words.certificate;
  o.picture = words.picture;
  o.report = words.report;
  o.allowances = words.allowances;
  o.drawing = words.drawing;
  o.outputs.deviations = words.deviations;
  o.compare = words.compare;
  o.json = words.json;
  const std::string ending = std::filesystem::path(o.picture).extension().string();
  read.require(
      o.picture.empty() || ending == ".svg" || ending == ".png" || ending == ".html" || ending == ".ply",
      fmt::format("--picture: the name \"{}\" ends in none of .svg, .png, .html and .ply", o.picture));
  o.outputs.picture = jobs::picture_form(o.picture);
  const std::string page = std::filesystem::path(o.report).extension().string();
  read.require(
      o.report.empty() || page == ".svg" || page == ".pdf" || page == ".png",
      fmt::format("--report: the name \"{}\" ends neither in .svg nor in .pdf nor in .png", o.report));
  o.outputs.report = jobs::picture_form(o.report);
  read.require(o.drawing.empty() || o.drawing.ends_with(".dxf") || o.drawing.ends_with(".svg"),
               fmt::format("--drawing: the name \"{}\" ends neither in .dxf nor in .svg", o.drawing));
  if (!o.drawing.empty())
    o.outputs.drawing = o.drawing.ends_with(".svg") ? jobs::DrawingFormat::svg : jobs::DrawingFormat::dxf;
  read.require(o.allowances.empty() || std::filesystem::path(o.allowances).extension() == ".csv",
               fmt::format("--allowances: the name \"{}\" does not end in .csv", o.allowances));
  o.outputs.allowances = !o.allowances.empty();
}

/// A file that a method cannot make is refused; a number that it does not look at is only worth a word.
void check_method(const LocateWords& words, WordReader& read, LocateOptions& o) {
  const std::string method = words.method.empty() ? "certified" : words.method;
  const bool certified = method == "certified";
  read.require(certified || o.outputs.certificate.empty(),
               "--certificate: --method " + method + " proves nothing, only --method certified does");
  read.require(certified || !o.job.alternatives,
               "--alternatives: --method " + method + " finds none, only --method certified does");
  const auto no_effect = [&](bool given, const char* option) {
    if (given) o.warnings.push_back(fmt::format("{} has no effect with --method {}", option, method));
  };
  no_effect(!words.gap.empty() && !certified, "--gap");
  no_effect(!words.starts.empty() && o.job.method != Method::ipopt, "--starts");
  no_effect(!words.start_rule.empty() && o.job.method != Method::ipopt, "--start-rule");
  no_effect(!words.work.empty() && o.job.method == Method::icp, "--work");
}

/// The options that solids have, too, and those that they alone have; all others are for outlines.
constexpr std::array<std::string_view, 33> kOfBoth{
    "--part",        "--blank",           "--units",         "--window",
    "--gap",         "--method",          "--work",          "--time",
    "--json",        "--output",          "--picture",       "--report",
    "--certificate", "--allowances",      "--min-allowance", "--uncertainty",
    "--coverage",    "--min-radius",      "--max-dip",       "--drop-outliers",
    "--nc",          "--nc-out",          "--nc-mode",       "--control",
    "--allow",       "--chord-tolerance", "--wcs",           "--nc-angle-decimals",
    "--scan-frame",  "--features",        "--deviations",    "--criterion",
    "--give-up"};
constexpr std::array<std::string_view, 17> kOfSolids{
    "--freedom",         "--tilt",      "--shift",      "--start",
    "--find-start",      "--underside", "--flat",       "--mesh",
    "--mesh-step",       "--offset",    "--offset-out", "--axes",
    "--offset-decimals", "--ball",      "--form",       "--nominal-blank",
    "--nominal-window"};

bool is_typed(const FormOption& option) {
  if (const auto* const flag = std::get_if<bool*>(&option.to)) return **flag;
  if (const auto* const word = std::get_if<std::string*>(&option.to)) return !(*word)->empty();
  return !std::get<std::vector<std::string>*>(option.to)->empty();
}

/// One sentence about all of them; empty where there are none.
std::string only_for(const std::vector<std::string>& words, const char* what) {
  std::string text;
  for (std::size_t k = 0; k < words.size(); ++k)
    text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
  return text.empty() ? text : text + (words.size() == 1 ? " is for " : " are for ") + what;
}

/// Reads the words that are not for both outlines and solids. Which of them the files are is told when they
/// are read, so a sentence about what cannot be obeyed then is kept until then.
void read_for_either(const LocateWords& words, const std::vector<FormOption>& options, WordReader& read,
                     LocateOptions& o) {
  std::vector<std::string> of_outlines, of_solids;
  for (const FormOption& option : options) {
    const std::string name = option.names.substr(option.names.rfind(',') + 1);
    if (!is_typed(option) || std::count(kOfBoth.begin(), kOfBoth.end(), name) > 0) continue;
    (std::count(kOfSolids.begin(), kOfSolids.end(), name) > 0 ? of_solids : of_outlines).push_back(name);
  }
  EitherMethod method{Method::certified, jobs::SolidMethod::certified};
  read.choice("--method", words.method, kLocateMethods, method);
  if (!method.outline) of_solids.push_back("--method " + words.method);
  if (!method.solid) of_outlines.push_back("--method " + words.method);
  o.job.method = method.outline.value_or(o.job.method);
  o.solid.method = method.solid.value_or(o.solid.method);
  EitherUnit unit{LengthUnit::millimetre, io::SolidUnit::millimetre};
  read.choice("--units", words.units, kLocateUnits, unit);
  if (!unit.outline) of_solids.push_back("--units " + words.units);
  if (words.picture.ends_with(".svg")) of_outlines.push_back("--picture " + words.picture);
  if (words.picture.ends_with(".html") || words.picture.ends_with(".ply"))
    of_solids.push_back("--picture " + words.picture);
  if (!words.units.empty()) o.job.part.units = unit.outline, o.solid.units = unit.solid;
  o.not_for_outlines = only_for(of_solids, "solids, and the files are outlines in the plane");
  o.not_for_solids = only_for(of_outlines, "outlines in the plane, and the files are solids");
}

/// The rotation of solids is looked at in one window, which depends on their freedom.
void check_turns(const LocateWords& words, LocateOptions& o) {
  const double apart = o.solid.window_to_deg - o.solid.window_from_deg;
  const auto complain = [&](bool wrong, const char* sentence) {
    if (wrong) o.not_for_solids += (o.not_for_solids.empty() ? "" : "; ") + std::string(sentence);
  };
  const bool window = !words.window.empty(), about_z = o.solid.freedom == locate::SolidFreedom::c_xyz;
  complain(
      window && !about_z,
      "--window, the turn about z, goes with --freedom c-xyz; --tilt DEG is how far the part may be turned "
      "about any axis");
  complain(window && about_z && apart > kAllTurns && apart < 2 * kAllTurns,
           "--window: the turns of a solid lie at most 180 degrees apart, or 360, which are all of them");
  complain(!words.tilt.empty() && o.solid.freedom != locate::SolidFreedom::six,
           "--tilt goes with --freedom six");
  complain(
      !words.nc.empty() && o.solid.freedom == locate::SolidFreedom::six,
      "--nc, whose program has three axes, goes with --freedom c-xyz or xyz: no such axis follows a tilt");
}

/// A scanner's mesh has its place in space; what is between its points has to be said.
void check_solid_scan(LocateOptions& o) {
  if (o.solid.scan && !o.solid.touch && !o.solid.scan->min_radius && !o.solid.scan->max_dip)
    o.not_for_solids += (o.not_for_solids.empty() ? "" : "; ") +
                        std::string(
                            "--uncertainty for a solid needs --min-radius MM or --max-dip MM, which say "
                            "what the surface does between its points");
}

/// Solids have two criteria after the largest margin.
void check_solid_criterion(const LocateWords& words, LocateOptions& o) {
  if (o.job.criterion.choose == nullptr) return;
  const bool is_even = o.job.criterion.name == "even";
  o.solid.criterion = is_even ? jobs::SolidCriterion::even : jobs::SolidCriterion::largest;
  o.solid.give_up = o.job.give_up;
  const auto complain = [&](bool wrong, const std::string& sentence) {
    if (wrong) o.not_for_solids += (o.not_for_solids.empty() ? "" : "; ") + sentence;
  };
  complain(!is_even && o.job.criterion.name != "largest",
           fmt::format("--criterion {} is for outlines in the plane, and the files are solids",
                       o.job.criterion.name));
  complain(o.solid.method == jobs::SolidMethod::icp || o.solid.method == jobs::SolidMethod::axes,
           fmt::format("--criterion goes on from the largest margin, which --method {} does not look for",
                       words.method));
}

Result<LocateOptions> to_options(const LocateWords& words, const std::vector<FormOption>& options) {
  LocateOptions o;
  WordReader read;
  o.part = words.part;
  o.blank = words.blank;
  read_for_either(words, options, read, o);
  if (!words.trim.empty()) {
    read.number("--trim", words.trim, kSmallestLength, kLargestLength, "a length in mm above 0",
                o.job.trim.emplace());
  }
  read_shapes(words, read, o);
  read_search(words, read, o);
  read_solid_search(words, read, o);
  check_turns(words, o);
  check_solid_criterion(words, o);
  check_solid_scan(o);
  read_program(words, read, o);
  read_offset(words, read, o);
  read_outputs(words, read, o);
  check_method(words, read, o);
  if (!read.complaint().empty()) {
    return failure(ErrorCode::usage, read.complaint() + " (see lekalo locate --help)");
  }
  return o;
}

constexpr const char* kLocateFooter =
    "Examples:\n"
    "  lekalo locate --part part.csv --blank probed.csv --min-allowance 0.3 --picture where.svg\n"
    "  lekalo locate --part part.dxf --blank probed.xyz --trim 0.05 --nc part.ngc --nc-out here.ngc "
    "\\\n"
    "                --nc-mode coordinates --scan-frame wcs -o result.json\n"
    "  lekalo locate --part part.stl --blank casting.stl --tilt 3 -o result.json\n"
    "\n"
    "Exit codes: 0 a placement, 1 there is none with this allowance, 2 wrong command line, 3 bad input "
    "or "
    "NC\n"
    "program refused, 4 the self-check refuted the result, 5 disk or other surroundings. With 2 to 5 "
    "no "
    "file\n"
    "is written; with 1 no NC program is. Angles on the command line are degrees, in JSON radians.";

void add_input_options(Form& form, LocateWords& w) {
  const OptionAdder add(form, "What to place");
  add("--part", w.part, "FILE",
      fmt::format("The part: points (.csv .txt .xyz), drawing ({}), .json: regions, primitives; or a solid "
                  "(.stl .obj .ply)",
                  io::drawing_endings(" ")))
      .required = true;
  add("--blank", w.blank, "FILE",
      "The blank: its outline in the same formats, or a scan (also .ply, see below); or a solid")
      .required = true;
  add("--part-layers", w.part_layers, "NAME", "Layers of the part's drawing [all that are shown]");
  add("--blank-layers", w.blank_layers, "NAME", "Layers of the blank's drawing [all that are shown]");
  add("--join", w.join, "MM", "Loose ends of a drawing this near are joined [0.01]");
  add("--curve-tolerance", w.curve, "MM", "Lines and arcs may be this far from an ellipse or spline [0.001]");
  add("--repair", w.repair, "MM", "Mends of a drawing move no outline further; the rest is set aside [0.2]");
  add("--strict", w.strict, "Refuse a drawing of which anything would be mended or set aside");
  add("--units", w.units, list_of(kLocateUnits, "|"),
      "Unit of contours that do not name theirs, and of solids [mm]");
  add("--trim", w.trim, "MM",
      "Cut dents of the blank up to this deep inwards to a convex contour; the loss is reported");
  add("--compare", w.compare, "FILE", "Result of an earlier probing: report the shift since then");
}

void add_scan_options(Form& form, LocateWords& w) {
  const OptionAdder add(form, "A blank from a scan");
  add("--uncertainty", w.uncertainty, "MM",
      "The blank is a scan, of solids a mesh; standard uncertainty of one point");
  add("--coverage", w.coverage, "K", "The surface lies within K times that of each point [2]");
  add("--min-radius", w.min_radius, "MM", "No dent of the blank is sharper than this radius");
  add("--max-dip", w.max_dip, "MM", "Between neighbouring points the surface dips at most this deep");
  add("--step", w.step, "MM",
      "Neighbours further apart leave the blank unknown between them [3 median spacings]");
  add("--drop-outliers", w.drop_outliers, "MM", "Leave out and list points with no other this near [none]");
  add("--simplify", w.simplify, "MM", "The outline may be drawn this much further in than it must [0.02]");
  add("--mesh", w.mesh, "FILE.ply",
      "Points in space, or a mesh with holes, become this closed mesh, which is then the blank");
  add("--mesh-step", w.mesh_step, "MM",
      "About the length of its edges [as the points allow, 300,000 triangles]");
  add("--underside", w.underside, "z=MM",
      "Solids: the side that no scanner sees lies at this level, is solid and flat to --flat");
  add("--flat", w.flat, "MM", "Each point of the underside lies within this of material");
  add("--nominal-blank", w.nominal, "FILE",
      "Solids: the blank was touched; this mesh is moved to the touches, and written as --mesh");
  add("--form", w.form, "MM", "The blank's surface and that of this mesh are less than this apart");
  add("--ball", w.ball, "MM", "Touches are centres of a ball of this diameter [0: points of the surface]");
  add("--nominal-window", w.nominal_window, "MM DEG",
      "The blank lies this near to where its mesh fits the touches best [5 2]")
      .count = 2;
  add("--slice-height", w.slice_height, "MM", "Take the points of a 3D scan about this height");
  add("--slice-thickness", w.slice_thickness, "MM", "and this far up and down together");
}

void add_search_options(Form& form, LocateWords& w) {
  const OptionAdder add(form, "How to search");
  add("--min-allowance", w.min_allowance, "MM", "Least material demanded between part and blank surface [0]");
  add("--window", w.window, "DEG",
      "Only angles from the first to the second, degrees [0 360; -5 5 for solids]")
      .count = 2;
  add("--gap", w.gap, "MM",
      "Stop when no other placement can be better by more than this [1e-9; 1e-3 where a shape is not "
      "convex; 0.01 for solids]");
  add("--mirror", w.mirror, list_of(kMirrors, "|"), "Whether the part must or may lie mirrored [no]");
  add("--lock-x", w.lock_x, "MM", "x of the placement is given");
  add("--lock-y", w.lock_y, "MM", "y of the placement is given");
  add("--features", w.features, "FILE",
      "Demands by feature: minimum, target, maximum, scale, finished; of solids minimum, target, maximum, "
      "scale, finished, as cast, datums (JSON)");
  add("--criterion", w.criterion, locate::criterion_names("|"),
      fmt::format("After the largest smallest allowance: {} [{}]",
                  later_criteria(&locate::Criterion::favours, ", or "), locate::criteria().front().name)
          .c_str());
  add("--give-up", w.give_up, "MM", "What the second criterion may take off the smallest allowance [0]");
  add("--trade-off", w.trade_off, "N", "Also N points of the curve of smallest against largest allowance");
  add("--alternatives", w.alternatives, "MM", "Also list other placements that lose at most this");
  add("--method", w.method, list_of(kLocateMethods, "|"),
      "certified proves its result; ipopt, icp and axes are there for comparison; climb is a quick placement "
      "of a solid without a bound [certified]");
  add("--starts", w.starts, "N", "Starts of --method ipopt [10]");
  add("--start-rule", w.start_rule, list_of(kStartRules, "|"), "Where --method ipopt starts [random]");
  add("--seed", w.seed, "S", "Seed of all random choices [0]");
  add("--work", w.work, "N",
      "Stop after N units of work (linear programs, starts, boxes) with the best so far");
  add("--time", w.time, "SECONDS", "Stop after this time with the best so far; not reproducible");
}

void add_solid_options(Form& form, LocateWords& w) {
  const OptionAdder add(form, "Solids");
  add("--freedom", w.freedom, list_of(kFreedoms, "|"),
      "The part is shifted; also turned about z by --window; or turned about any axis by --tilt [six]");
  add("--tilt", w.tilt, "DEG",
      "How far the part may be turned from the start, about any axis; 180 is every rotation [5]");
  add("--shift", w.shift, "MM",
      "How far the middle of the part may move from the start, along each axis [5; with all turns to "
      "anywhere in the blank]");
  add("--start", w.start, "FILE",
      "Result of an earlier placement, whose pose is the start [the part where its file has it]");
  add("--find-start", w.find_start,
      "Look for the start: climb from rotations all over and from the axes of inertia");
}

void add_program_options(Form& form, LocateWords& w) {
  const OptionAdder add(form, "NC program");
  add("--nc", w.nc, "FILE", "ISO/RS-274 program written in the part's frame");
  add("--nc-out", w.nc_out, "FILE", "The program for the blank as it lies");
  add("--nc-mode", w.nc_mode, list_of(kModes, "|"),
      "Turn every coordinate, or let the control do it: LinuxCNC G10 L2, Fanuc G68 [coordinates]");
  add("--control", w.control, control_list(), "Whose words the program has [guessed, and told]");
  add("--allow", w.allow, "FILE", "M words that move no axis, one a line, beside those that lekalo knows");
  add("--chord-tolerance", w.chord_tolerance, "MM",
      "Of the chords for arcs of G18 and G19, which do not stay in their plane when turned [0.001]");
  add("--wcs", w.wcs, "N", "Work offset that the program runs in: 1 is G54 .. 9 is G59.3 [1]");
  add("--nc-angle-decimals", w.nc_angle_decimals, "N",
      "Decimals of a degree that the control takes in G68 R [3]");
  add("--scan-frame", w.scan_frame, list_of(kScanFrames, "|"),
      "Coordinates in which the blank was probed [machine]");
}

void add_offset_options(Form& form, LocateWords& w) {
  const OptionAdder add(form, "Work offset of a solid");
  add("--offset", w.offset, list_of(kOffsetControls, "|"),
      "Lines that set work offset and rotation: LinuxCNC G10 L2, Fanuc G68, Siemens TRANS and AROT");
  add("--offset-out", w.offset_out, "FILE", "These lines; the pose of the result is then what they say");
  add("--axes", w.axes, "3|5", "Axes of the machine: five follow a tilt [3]");
  add("--offset-decimals", w.offset_decimals, "N",
      "Decimals of a degree and of a millimetre that the control takes [3 3]")
      .count = 2;
}

void add_output_options(Form& form, LocateWords& w) {
  const OptionAdder add(form, "Output");
  add("-o,--output", w.output, "FILE", "Write the result as JSON to this file");
  add("--picture", w.picture, "FILE",
      "Draw blank, part and allowance: .svg or .png; solids as .png, .html or .ply");
  add("--report", w.report, "FILE",
      "One page with placement, features, histogram, contacts and what is proved: .svg, .pdf or .png");
  add("--drawing", w.drawing, "FILE",
      "The blank and the part as it lies, on layers BLANK and PART: .dxf or .svg");
  add("--allowances", w.allowances, "FILE",
      "CSV: the allowance along the part's outline, or at the corners of a solid");
  add("--certificate", w.certificate, "FILE", "Write the proof to this file instead of into the result");
  add("--deviations", w.deviations, "FILE",
      "Signed distance of every probed point from the placed part: CSV, of a solid's points also .ply");
  add("--json", w.json, "Print the result as JSON on stdout");
}

}  // namespace

Typed add_locate_form(Form& form) {
  auto words = std::make_shared<LocateWords>();
  add_input_options(form, *words);
  add_scan_options(form, *words);
  add_search_options(form, *words);
  add_solid_options(form, *words);
  add_program_options(form, *words);
  add_offset_options(form, *words);
  add_output_options(form, *words);
  form.footer = kLocateFooter;
  return [words, options = form.options] {
    return to_options(*words, options).map([](LocateOptions&& o) { return Command(std::move(o)); });
  };
}

}  // namespace lekalo::cli

#include "options.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "complaint.hpp"
#include "completion.hpp"
#include "lekalo/base/version.hpp"

namespace lekalo::cli {
namespace {

template <class T>
struct Word {
  const char* name;
  T value;
};
constexpr std::array kMethods{Word<Method>{"certified", Method::certified},
                              Word<Method>{"ipopt", Method::ipopt}, Word<Method>{"icp", Method::icp}};
constexpr std::array kUnits{Word<LengthUnit>{"mm", LengthUnit::millimetre},
                            Word<LengthUnit>{"inch", LengthUnit::inch}};
constexpr std::array kStartRules{
    Word<locate::StartRule>{"random", locate::StartRule::random},
    Word<locate::StartRule>{"centroids", locate::StartRule::centroids},
    Word<locate::StartRule>{"principal-axes", locate::StartRule::principal_axes}};
constexpr std::array kModes{Word<nc::RewriteMode>{"coordinates", nc::RewriteMode::coordinates},
                            Word<nc::RewriteMode>{"offset", nc::RewriteMode::offset},
                            Word<nc::RewriteMode>{"g68", nc::RewriteMode::g68}};
constexpr std::array kScanFrames{Word<nc::ScanFrame>{"machine", nc::ScanFrame::machine},
                                 Word<nc::ScanFrame>{"wcs", nc::ScanFrame::wcs}};

constexpr std::array kMirrors{Word<locate::Mirror>{"no", locate::Mirror::no},
                              Word<locate::Mirror>{"yes", locate::Mirror::yes},
                              Word<locate::Mirror>{"either", locate::Mirror::either}};

constexpr std::array kCriteria{Word<locate::Criterion>{"smallest", locate::Criterion::smallest},
                               Word<locate::Criterion>{"largest", locate::Criterion::largest},
                               Word<locate::Criterion>{"even", locate::Criterion::even}};

constexpr std::array kExportFormats{Word<ExportFormat>{"layout", ExportFormat::layout},
                                    Word<ExportFormat>{"placements", ExportFormat::placements},
                                    Word<ExportFormat>{"dxf", ExportFormat::machine},
                                    Word<ExportFormat>{"svg", ExportFormat::machine},
                                    Word<ExportFormat>{"pdf", ExportFormat::pdf},
                                    Word<ExportFormat>{"hpgl", ExportFormat::machine},
                                    Word<ExportFormat>{"gcode", ExportFormat::machine}};

template <class T, std::size_t N>
const char* name_in(const std::array<Word<T>, N>& words, T value) noexcept {
  for (const Word<T>& word : words) {
    if (word.value == value) return word.name;
  }
  return "";
}

template <class T, std::size_t N>
std::string list_of(const std::array<Word<T>, N>& words, const char* separator) {
  std::string list;
  for (const Word<T>& word : words) list += (list.empty() ? "" : separator) + std::string(word.name);
  return list;
}

/// The words as typed. They become numbers here rather than in CLI11, whose messages do not name the range
/// and which takes "nan" and "0x10".
struct LocateWords {
  std::string part, blank, units, trim, gap, min_allowance, method, starts, start_rule, seed, work, time,
      alternatives, nc, nc_out, nc_mode, nc_angle_decimals, wcs, scan_frame, output, certificate, picture,
      report, allowances, drawing, deviations, compare, mirror, lock_x, lock_y, features, criterion, give_up,
      trade_off, join, curve, uncertainty, coverage, min_radius, max_dip, step, drop_outliers, simplify,
      slice_height, slice_thickness;
  std::vector<std::string> part_layers, blank_layers;
  std::vector<std::string> window;
  bool json = false;
};

/// Turns words into values and keeps the first complaint.
class WordReader {
 public:
  /// Leaves `value` alone when the option was not given.
  template <class Number>
  void number(const char* option, const std::string& word, Number low, Number high, const char* wanted,
              Number& value) {
    if (word.empty()) return;
    Number parsed{};
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, parsed);
    if (error == std::errc{} && stop == end && low <= parsed && parsed <= high) {
      value = parsed;
    } else {
      complain(fmt::format("{}: \"{}\" is not {}", option, word, wanted));
    }
  }
  template <class T, std::size_t N>
  void choice(const char* option, const std::string& word, const std::array<Word<T>, N>& words, T& value) {
    if (word.empty()) return;
    for (const Word<T>& candidate : words) {
      if (word == candidate.name) {
        value = candidate.value;
        return;
      }
    }
    complain(fmt::format("{}: \"{}\" is not one of {}", option, word, list_of(words, ", ")));
  }
  void require(bool condition, const std::string& complaint) {
    if (!condition) complain(complaint);
  }
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

 private:
  void complain(const std::string& complaint) {
    if (complaint_.empty()) complaint_ = complaint;
  }
  std::string complaint_;
};

constexpr double kLargestLength = 1e9;         // mm: a thousand kilometres, beyond any machine
constexpr double kSmallestLength = 1e-300;     // stands for "more than 0"
constexpr double kLargestWindowAngle = 720.0;  // degrees: either way of writing a window fits
constexpr double kClosedWindow = 1e-9;         // degrees: a smaller opening is none
constexpr double kLongestTime = 1e7;           // seconds

void read_window(const std::vector<std::string>& words, WordReader& read, LocateOptions& o) {
  if (words.size() != 2) return;
  const char* const wanted = "an angle between -720 and 720 degrees";
  read.number("--window", words[0], -kLargestWindowAngle, kLargestWindowAngle, wanted, o.window_from_deg);
  read.number("--window", words[1], -kLargestWindowAngle, kLargestWindowAngle, wanted, o.window_to_deg);
  read.require(o.window_from_deg <= o.window_to_deg,
               fmt::format("--window: the first angle, {}, is above the second, {}", words[0], words[1]));
  if (o.window_to_deg - o.window_from_deg > 360 - kClosedWindow) {
    o.window_from_deg = 0;
    o.window_to_deg = 360;
  }
}

void read_search(const LocateWords& words, WordReader& read, LocateOptions& o) {
  read_window(words.window, read, o);
  if (!words.gap.empty())
    read.number("--gap", words.gap, kSmallestLength, kLargestLength, "a length in mm above 0",
                o.gap.emplace());
  read.choice("--mirror", words.mirror, kMirrors, o.mirror);
  for (const auto& [option, word, to] :
       {std::tuple{"--lock-x", &words.lock_x, &o.locked.x}, {"--lock-y", &words.lock_y, &o.locked.y}})
    if (!word->empty())
      read.number(option, *word, -kLargestLength, kLargestLength, "a coordinate in mm up to 1e9",
                  to->emplace());
  o.features = words.features;
  read.choice("--criterion", words.criterion, kCriteria, o.criterion);
  read.number("--give-up", words.give_up, 0.0, kLargestLength, "a length in mm of 0 or more", o.give_up);
  read.require(
      words.give_up.empty() || o.criterion != locate::Criterion::smallest,
      "--give-up is for --criterion largest and even: what they may take off the smallest allowance");
  read.number("--trade-off", words.trade_off, std::size_t{2}, std::size_t{100},
              "a whole number from 2 to 100", o.trade_off);
  read.number("--min-allowance", words.min_allowance, 0.0, kLargestLength, "a length in mm of 0 or more",
              o.min_allowance);
  read.choice("--method", words.method, kMethods, o.method);
  read.number("--starts", words.starts, 1, 1'000'000, "a whole number from 1 to 1000000", o.starts);
  read.choice("--start-rule", words.start_rule, kStartRules, o.start_rule);
  constexpr auto kLargest = std::numeric_limits<std::uint64_t>::max();
  read.number("--seed", words.seed, std::uint64_t{0}, kLargest, "a whole number from 0 to 2^64 - 1", o.seed);
  read.number("--work", words.work, std::uint64_t{1}, kLargest, "a whole number from 1 to 2^64 - 1", o.work);
  if (!words.alternatives.empty()) {
    read.number("--alternatives", words.alternatives, 0.0, kLargestLength, "a length in mm of 0 or more",
                o.alternatives.emplace());
  }
  if (!words.time.empty()) {
    read.number("--time", words.time, 1e-6, kLongestTime, "a time in seconds above 0", o.seconds.emplace());
  }
}

void read_shapes(const LocateWords& words, WordReader& read, LocateOptions& o) {
  const auto length = [&](const char* option, const std::string& word, double least,
                          std::optional<double>& to) {
    if (word.empty()) return;
    read.number(option, word, least, kLargestLength,
                least > 0 ? "a length in mm above 0" : "a length in mm of 0 or more", to.emplace());
  };
  length("--join", words.join, 0, o.join);
  length("--curve-tolerance", words.curve, kSmallestLength, o.curve);
  o.part_layers = words.part_layers, o.blank_layers = words.blank_layers;

  ScanWords scan;
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
  const bool other =
      m.min_radius || m.max_dip || m.step || m.drop_outliers || simplify || height || !words.coverage.empty();
  read.require(uncertainty || !other,
               "a scan needs --uncertainty MM, the standard uncertainty of one measured point");
  if (uncertainty) o.scan = scan;
}

void read_program(const LocateWords& words, WordReader& read, LocateOptions& o) {
  o.nc = words.nc;
  o.nc_out = words.nc_out;
  read.require(o.nc.empty() || !o.nc_out.empty(),
               "--nc: say with --nc-out FILE where the rewritten program goes");
  read.require(o.nc_out.empty() || !o.nc.empty(), "--nc-out: say with --nc FILE which program to rewrite");
  read.require(!o.nc.empty() || (words.nc_mode.empty() && words.wcs.empty() && words.scan_frame.empty()),
               "--nc-mode, --wcs and --scan-frame need --nc FILE, the program to rewrite");
  read.choice("--nc-mode", words.nc_mode, kModes, o.rewrite.mode);
  read.choice("--scan-frame", words.scan_frame, kScanFrames, o.rewrite.scan_frame);
  read.number("--nc-angle-decimals", words.nc_angle_decimals, 0, 9, "a whole number from 0 to 9",
              o.rewrite.g68_angle_decimals);
  read.require(words.nc_angle_decimals.empty() || o.rewrite.mode == nc::RewriteMode::g68,
               "--nc-angle-decimals is for --nc-mode g68 alone");
  if (o.units) o.rewrite.start_unit = *o.units;
  read.number("--wcs", words.wcs, 1, 9, "a whole number from 1 (G54) to 9 (G59.3)", o.rewrite.work_offset);
}

void read_outputs(const LocateWords& words, WordReader& read, LocateOptions& o) {
  o.output = words.output;
  o.certificate = words.certificate;
  o.picture = words.picture;
  o.report = words.report;
  o.allowances = words.allowances;
  o.drawing = words.drawing;
  o.deviations = words.deviations;
  o.compare = words.compare;
  o.json = words.json;
  const std::string ending = std::filesystem::path(o.picture).extension().string();
  read.require(o.picture.empty() || ending == ".svg" || ending == ".png",
               fmt::format("--picture: the name \"{}\" ends neither in .svg nor in .png", o.picture));
  const std::string page = std::filesystem::path(o.report).extension().string();
  read.require(
      o.report.empty() || page == ".svg" || page == ".pdf" || page == ".png",
      fmt::format("--report: the name \"{}\" ends neither in .svg nor in .pdf nor in .png", o.report));
  read.require(o.drawing.empty() || o.drawing.ends_with(".dxf") || o.drawing.ends_with(".svg"),
               fmt::format("--drawing: the name \"{}\" ends neither in .dxf nor in .svg", o.drawing));
  read.require(o.allowances.empty() || std::filesystem::path(o.allowances).extension() == ".csv",
               fmt::format("--allowances: the name \"{}\" does not end in .csv", o.allowances));
}

/// A file that a method cannot make is refused; a number that it does not look at is only worth a word.
void check_method(const LocateWords& words, WordReader& read, LocateOptions& o) {
  const bool certified = o.method == Method::certified;
  const std::string method = name_of(o.method);
  read.require(certified || o.certificate.empty(),
               "--certificate: --method " + method + " proves nothing, only --method certified does");
  read.require(certified || !o.alternatives,
               "--alternatives: --method " + method + " finds none, only --method certified does");
  const auto no_effect = [&](bool given, const char* option) {
    if (given) o.warnings.push_back(fmt::format("{} has no effect with --method {}", option, method));
  };
  no_effect(!words.gap.empty() && !certified, "--gap");
  no_effect(!words.starts.empty() && o.method != Method::ipopt, "--starts");
  no_effect(!words.start_rule.empty() && o.method != Method::ipopt, "--start-rule");
  no_effect(!words.work.empty() && o.method == Method::icp, "--work");
}

}  // namespace

bool needs_convex(const LocateOptions& o) {
  return o.method != Method::certified || o.trim || o.alternatives || !o.deviations.empty() ||
         !o.compare.empty();
}

bool has_demands(const LocateOptions& o) {
  return o.locked.x || o.locked.y || !o.features.empty() || o.criterion != locate::Criterion::smallest ||
         o.trade_off > 0;
}

namespace {

Result<LocateOptions> to_options(const LocateWords& words) {
  LocateOptions o;
  WordReader read;
  o.part = words.part;
  o.blank = words.blank;
  if (!words.units.empty()) read.choice("--units", words.units, kUnits, o.units.emplace());
  if (!words.trim.empty()) {
    read.number("--trim", words.trim, kSmallestLength, kLargestLength, "a length in mm above 0",
                o.trim.emplace());
  }
  read_shapes(words, read, o);
  read_search(words, read, o);
  read_program(words, read, o);
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
    "  lekalo locate --part part.dxf --blank probed.xyz --trim 0.05 --nc part.ngc --nc-out here.ngc \\\n"
    "                --nc-mode coordinates --scan-frame wcs -o result.json\n"
    "\n"
    "Exit codes: 0 a placement, 1 there is none with this allowance, 2 wrong command line, 3 bad input or "
    "NC\n"
    "program refused, 4 the self-check refuted the result, 5 disk or other surroundings. With 2 to 5 no "
    "file\n"
    "is written; with 1 no NC program is. Angles on the command line are degrees, in JSON radians.";

void add_input_options(CLI::App& locate, LocateWords& w) {
  const auto add = [&](const char* name, std::string& word, const char* help) {
    return locate.add_option(name, word, help)->group("What to place");
  };
  add("--part", w.part,
      "The part: points (.csv .txt .xyz), drawing (.dxf .svg), or .json: regions, primitives")
      ->required()
      ->type_name("FILE");
  add("--blank", w.blank, "The blank: its outline in the same formats, or a scan (also .ply, see below)")
      ->required()
      ->type_name("FILE");
  locate.add_option("--part-layers", w.part_layers, "Layers of the part's drawing [all that are shown]")
      ->type_name("NAME")
      ->group("What to place");
  locate.add_option("--blank-layers", w.blank_layers, "Layers of the blank's drawing [all that are shown]")
      ->type_name("NAME")
      ->group("What to place");
  add("--join", w.join, "Loose ends of a drawing this near are joined [0.01]")->type_name("MM");
  add("--curve-tolerance", w.curve, "Lines and arcs may be this far from an ellipse or spline [0.001]")
      ->type_name("MM");
  add("--units", w.units, "Unit of contour files that do not name theirs [mm]")
      ->type_name(list_of(kUnits, "|"));
  add("--trim", w.trim,
      "Cut dents of the blank up to this deep inwards to a convex contour; the loss is reported")
      ->type_name("MM");
  add("--compare", w.compare, "Result of an earlier probing: report the shift since then")->type_name("FILE");
}

void add_scan_options(CLI::App& locate, LocateWords& w) {
  const auto add = [&](const char* name, std::string& word, const char* type, const char* help) {
    locate.add_option(name, word, help)->type_name(type)->group("A blank from a scan");
  };
  add("--uncertainty", w.uncertainty, "MM", "The blank is a scan; standard uncertainty of one point");
  add("--coverage", w.coverage, "K", "The surface lies within K times that of each point [2]");
  add("--min-radius", w.min_radius, "MM", "No dent of the blank is sharper than this radius");
  add("--max-dip", w.max_dip, "MM", "Between neighbouring points the surface dips at most this deep");
  add("--step", w.step, "MM",
      "Neighbours further apart leave the blank unknown between them [3 median spacings]");
  add("--drop-outliers", w.drop_outliers, "MM", "Leave out and list points with no other this near [none]");
  add("--simplify", w.simplify, "MM", "The outline may be drawn this much further in than it must [0.02]");
  add("--slice-height", w.slice_height, "MM", "Take the points of a 3D scan about this height");
  add("--slice-thickness", w.slice_thickness, "MM", "and this far up and down together");
}

void add_search_options(CLI::App& locate, LocateWords& w) {
  const auto add = [&](const char* name, std::string& word, const std::string& type, const char* help) {
    locate.add_option(name, word, help)->type_name(type)->group("How to search");
  };
  add("--min-allowance", w.min_allowance, "MM", "Least material demanded between part and blank surface [0]");
  locate.add_option("--window", w.window, "Only angles from the first to the second, degrees [0 360]")
      ->expected(2)
      ->type_name("DEG")
      ->group("How to search");
  add("--gap", w.gap, "MM",
      "Stop when no other placement can be better by more than this [1e-9; 1e-3 where a shape is not "
      "convex]");
  add("--mirror", w.mirror, list_of(kMirrors, "|"), "Whether the part must or may lie mirrored [no]");
  add("--lock-x", w.lock_x, "MM", "x of the placement is given");
  add("--lock-y", w.lock_y, "MM", "y of the placement is given");
  add("--features", w.features, "FILE",
      "Demands by feature: minimum, target, maximum, scale, finished (JSON)");
  add("--criterion", w.criterion, list_of(kCriteria, "|"),
      "After the largest smallest allowance: the smallest largest one, or the most even [smallest]");
  add("--give-up", w.give_up, "MM", "What the second criterion may take off the smallest allowance [0]");
  add("--trade-off", w.trade_off, "N", "Also N points of the curve of smallest against largest allowance");
  add("--alternatives", w.alternatives, "MM", "Also list other placements that lose at most this");
  add("--method", w.method, list_of(kMethods, "|"),
      "certified proves its result; ipopt and icp are there for comparison [certified]");
  add("--starts", w.starts, "N", "Starts of --method ipopt [10]");
  add("--start-rule", w.start_rule, list_of(kStartRules, "|"), "Where --method ipopt starts [random]");
  add("--seed", w.seed, "S", "Seed of all random choices [0]");
  add("--work", w.work, "N", "Stop after N units of work (linear programs, or starts) with the best so far");
  add("--time", w.time, "SECONDS", "Stop after this time with the best so far; not reproducible");
}

void add_program_options(CLI::App& locate, LocateWords& w) {
  const auto add = [&](const char* name, std::string& word, const std::string& type, const char* help) {
    locate.add_option(name, word, help)->type_name(type)->group("NC program");
  };
  add("--nc", w.nc, "FILE", "ISO/RS-274 program written in the part's frame");
  add("--nc-out", w.nc_out, "FILE", "The program for the blank as it lies");
  add("--nc-mode", w.nc_mode, list_of(kModes, "|"),
      "Turn every coordinate, or let the control do it: LinuxCNC G10 L2, Fanuc G68 [coordinates]");
  add("--wcs", w.wcs, "N", "Work offset that the program runs in: 1 is G54 .. 9 is G59.3 [1]");
  add("--nc-angle-decimals", w.nc_angle_decimals, "N",
      "Decimals of a degree that the control takes in G68 R [3]");
  add("--scan-frame", w.scan_frame, list_of(kScanFrames, "|"),
      "Coordinates in which the blank was probed [machine]");
}

void add_output_options(CLI::App& locate, LocateWords& w) {
  const auto add = [&](const char* name, std::string& word, const char* help) {
    locate.add_option(name, word, help)->type_name("FILE")->group("Output");
  };
  add("-o,--output", w.output, "Write the result as JSON to this file");
  add("--picture", w.picture, "Draw blank, part and allowance: .svg or .png");
  add("--report", w.report,
      "One page with placement, features, histogram, contacts and what is proved: .svg, .pdf or .png");
  add("--drawing", w.drawing, "The blank and the part as it lies, on layers BLANK and PART: .dxf or .svg");
  add("--allowances", w.allowances, "CSV: the allowance along the part's outline");
  add("--certificate", w.certificate, "Write the proof to this file instead of into the result");
  add("--deviations", w.deviations, "CSV: signed distance of every probed point from the placed part");
  locate.add_flag("--json", w.json, "Print the result as JSON on stdout")->group("Output");
}

void add_verify_options(CLI::App& verify, VerifyOptions& o) {
  verify.add_option("result", o.result, "Result written by lekalo locate -o")->required()->type_name("FILE");
  const auto add = [&](const char* name, std::string& word, const char* help) {
    verify.add_option(name, word, help)->type_name("FILE");
  };
  add("--part", o.part, "Where the part file is now, when not where the result says");
  add("--blank", o.blank, "Where the blank file is now");
  add("--certificate", o.certificate, "Where the certificate file is now");
  verify.add_flag("--json", o.json, "Print the report as JSON on stdout");
}

/// The words of `pocket`, as typed.
struct PocketWords {
  std::string pocket, tool, step_over, stock_to_leave, depth, feed, plunge_feed, link_feed, safe_height,
      output;
};

void add_pocket_options(CLI::App& pocket, PocketWords& w) {
  pocket.add_option("pocket", w.pocket, "The pocket's outline, JSON regions with lines, arcs and islands")
      ->required()
      ->type_name("FILE");
  const auto add = [&](const char* name, std::string& word, const char* type, const char* help) {
    return pocket.add_option(name, word, help)->type_name(type);
  };
  add("--tool", w.tool, "MM", "Diameter of the tool")->required();
  add("--depth", w.depth, "MM", "Below Z 0, cut in one level")->required();
  add("--stepover", w.step_over, "PERCENT", "Of the tool's diameter, from 1% to 50% [40%]");
  add("--stock-to-leave", w.stock_to_leave, "MM", "What stays on every wall [0]");
  add("--feed", w.feed, "MM/MIN", "In the cut [1500]");
  add("--plunge-feed", w.plunge_feed, "MM/MIN", "Straight down [300]");
  add("--link-feed", w.link_feed, "MM/MIN", "At depth through what is cut already [5000]");
  add("--safe-height", w.safe_height, "MM", "Above Z 0 [5]");
  add("-o,--output", w.output, "FILE", "Write the program to this file [stdout]");
}

/// The words of `simulate`, as typed.
struct SimulateWords {
  std::string program, pocket, tool, stock_to_leave, step_over, top, acceleration, rapid, samples;
  bool json = false;
};

void add_simulate_options(CLI::App& simulate, SimulateWords& w) {
  simulate.add_option("program", w.program, "NC program: G0 to G3, G20/G21, G90/G91")
      ->required()
      ->type_name("FILE");
  const auto add = [&](const char* name, std::string& word, const char* type, const char* help) {
    return simulate.add_option(name, word, help)->type_name(type);
  };
  add("--pocket", w.pocket, "FILE", "The pocket's outline, JSON regions with lines, arcs and islands")
      ->required();
  add("--tool", w.tool, "MM", "Diameter of the tool")->required();
  add("--stock-to-leave", w.stock_to_leave, "MM", "What stays on every wall [0]");
  add("--step-over", w.step_over, "PART", "Of the diameter, for the lower bound of the time [0.4]");
  add("--top", w.top, "MM", "Z of the stock's upper face [0]");
  add("--acceleration", w.acceleration, "MM/S2", "Of the machine, for the time [500]");
  add("--rapid", w.rapid, "MM/MIN", "Feed of G0 [5000]");
  add("--samples", w.samples, "FILE", "Write the engagement along the path as CSV");
  simulate.add_flag("--json", w.json, "Print the report as JSON on stdout");
}

/// The words of the commands on layouts, as typed.
struct LayoutWords {
  std::string path, instance, units, chords, join, picture, format, output, instance_name, commands;
  std::vector<std::string> layers;
  std::vector<io::ExportWord> machine;  ///< of export: words that io::read_export_words understands
  bool json = false;
};

void add_layout_source(CLI::App& command, LayoutWords& w, bool required = true) {
  command
      .add_option("layout", w.path,
                  "A layout, a job or placements of a nesting program, a drawing, regions: told apart by "
                  "content")
      ->required(required)
      ->type_name("FILE");
  const auto add = [&](const char* name, std::string& word, const std::string& type, const char* help) {
    command.add_option(name, word, help)->type_name(type)->group("Reading");
  };
  add("--instance", w.instance, "FILE", "Of placements: the file of the items, when not where they say");
  add("--units", w.units, list_of(kUnits, "|"), "Of files that do not say theirs [mm]");
  add("--chord-tolerance", w.chords, "MM", "How far chords lie from the arcs of drawings [0.01]");
  add("--join", w.join, "MM", "Loose ends of drawings this near to each other are joined [0.01]");
  command.add_option("--layers", w.layers, "Layers of a drawing that hold parts [all that are shown]")
      ->type_name("NAME")
      ->delimiter(',')
      ->group("Reading");
}

void add_layout_outputs(CLI::App& command, LayoutWords& w) {
  command.add_option("--picture", w.picture, "Draw it: .svg, .png or .pdf")
      ->type_name("FILE")
      ->group("Output");
  command.add_flag("--json", w.json, "Print the report as JSON on stdout")->group("Output");
}

Result<LayoutSource> to_layout_source(const LayoutWords& w) {
  LayoutSource source{w.path, w.instance, std::nullopt, std::nullopt, std::nullopt, w.layers};
  WordReader reader;
  if (!w.units.empty()) {
    LengthUnit unit{};
    reader.choice("--units", w.units, kUnits, unit);
    source.units = unit;
  }
  const auto length = [&](const char* option, const std::string& word, double low,
                          std::optional<double>& value) {
    if (word.empty()) return;
    double mm = 0;
    reader.number(option, word, low, 1000.0, "a number of millimetres", mm);
    value = mm;
  };
  length("--chord-tolerance", w.chords, 0x1p-16, source.chord_tolerance);
  length("--join", w.join, 0.0, source.join);
  if (!reader.complaint().empty()) return failure(ErrorCode::usage, reader.complaint());
  return source;
}

Result<void> fine_picture(const std::string& path) {
  if (path.empty() || path.ends_with(".svg") || path.ends_with(".png") || path.ends_with(".pdf")) return {};
  return failure(
      ErrorCode::usage,
      fmt::format("--picture {}: the name has to end in .svg, .png or .pdf, which says what is drawn", path));
}

template <class Options>
Result<Command> to_drawn(const LayoutWords& w) {
  if (Result<void> fine = fine_picture(w.picture); !fine) return tl::unexpected(fine.error());
  return to_layout_source(w).map([&](LayoutSource&& source) {
    return Command(Options{std::move(source), w.picture, w.json});
  });
}

Result<Command> to_export(const LayoutWords& w) {
  ExportFormat format = ExportFormat::layout;
  WordReader reader;
  if (!w.format.empty()) reader.choice("--format", w.format, kExportFormats, format);
  if (!reader.complaint().empty()) return failure(ErrorCode::usage, reader.complaint());
  io::ExportRequest request;
  std::vector<io::ExportWord> given;
  for (const io::ExportWord& word : w.machine)
    if (!word.second.empty()) given.push_back(word);
  if (format == ExportFormat::machine) {
    auto read = io::read_export_words(*io::export_form(w.format), given, "--");
    if (!read) return tl::unexpected(read.error());
    request = *std::move(read);
  } else if (!given.empty()) {
    return failure(ErrorCode::usage, fmt::format("--{} has no meaning for the form {}", given.front().first,
                                                 w.format.empty() ? "layout" : w.format));
  }
  return to_layout_source(w).map([&](LayoutSource&& source) {
    return Command(ExportOptions{std::move(source), format, w.output, w.instance_name, std::move(request)});
  });
}

void add_machine_words(CLI::App& command, LayoutWords& w) {
  for (const io::ExportWordHelp& help : io::export_words()) w.machine.emplace_back(help.name, "");
  for (std::size_t i = 0; i < w.machine.size(); ++i)
    command.add_option("--" + w.machine[i].first, w.machine[i].second, io::export_words()[i].help)
        ->type_name(io::export_words()[i].type)
        ->group("For machines and other programs");
}

/// The words of `nest` alone.
struct NestWords {
  std::string time, work, seed, threads, angles;
};

void add_nest_options(CLI::App& nest, LayoutWords& layout, NestWords& w) {
  nest.add_option("-o,--output", layout.output, "Write the layout to this file [stdout]")->type_name("FILE");
  const auto add = [&](const char* name, std::string& word, const char* type, const char* help) {
    nest.add_option(name, word, help)->type_name(type)->group("Search");
  };
  add("--time", w.time, "SECONDS", "Stop after this time; the report's work repeats it [60 without --work]");
  add("--work", w.work, "N", "Stop after about N candidate places: same bytes on every machine");
  add("--threads", w.threads, "N", "Changes the speed, not the result [2]");
  add("--seed", w.seed, "S", "Seed of all random choices [0]");
  add("--angles", w.angles, "N", "Angles to try of parts that may be turned anyhow [24]");
  nest.footer(
      "Locked placements stay, others are made anew. Ctrl-C keeps the best so far. What is written passes\n"
      "lekalo check.\n"
      "Exit codes: 0 everything is placed, 1 some pieces are not, 2 wrong command line, 3 a file cannot be\n"
      "read or nested, 4 the layout found did not pass the check (please report), 5 disk or memory.");
}

Result<Command> to_nest(const LayoutWords& layout, const NestWords& w) {
  if (Result<void> fine = fine_picture(layout.picture); !fine) return tl::unexpected(fine.error());
  Result<LayoutSource> source = to_layout_source(layout);
  if (!source) return tl::unexpected(source.error());
  NestOptions o;
  o.source = std::move(*source);
  o.output = layout.output;
  o.picture = layout.picture;
  o.json = layout.json;
  WordReader read;
  constexpr std::uint64_t kLargest = std::numeric_limits<std::uint64_t>::max();
  read.number("--seed", w.seed, std::uint64_t{0}, kLargest, "a whole number from 0 to 2^64 - 1", o.seed);
  read.number("--work", w.work, std::uint64_t{1}, kLargest, "a whole number from 1 to 2^64 - 1", o.work);
  read.number("--threads", w.threads, 1u, 64u, "a whole number from 1 to 64", o.threads);
  read.number("--angles", w.angles, std::size_t{1}, std::size_t{360}, "a whole number from 1 to 360",
              o.angles);
  if (!w.time.empty() || w.work.empty()) {
    double seconds = 60;
    read.number("--time", w.time, 0.01, 1e6, "a number of seconds from 0.01 to 1,000,000", seconds);
    o.seconds = seconds;
  }
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

/// The words of `serve` alone.
struct ServeWords {
  std::string store, listen = "127.0.0.1", port = "8080", token;
};

void add_serve_options(CLI::App& serve, ServeWords& w) {
  const auto add = [&](const char* name, std::string& word, const char* type, const char* help) {
    serve.add_option(name, word, help)->type_name(type);
  };
  add("--store", w.store, "FILE",
      "The layouts and all that was done to them [lekalo/layouts.sqlite among the user's data]");
  add("--port", w.port, "N", "0: any that is free [8080]");
  add("--listen", w.listen, "ADDRESS", "Elsewhere than on this machine alone, with a token [127.0.0.1]");
  add("--token", w.token, "TEXT", "What whoever opens the page has to know [made and printed with --listen]");
  serve.footer(
      "The first line on stdout is \"listening URL\"; Ctrl-C stops it.\n"
      "Exit codes: 0 stopped, 2 wrong command line, 3 the file cannot be read, 5 the port or the store\n"
      "cannot be had.");
}

Result<Command> to_pocket(PocketWords w) {
  WordReader read;
  PocketOptions o{w.pocket, w.output, {}};
  const char* const feed = "a feed above 0, mm/min";
  double percent = 40;
  if (!w.step_over.empty() && w.step_over.back() == '%') w.step_over.pop_back();
  read.number("--stepover", w.step_over, 1.0, 50.0, "a share of the diameter from 1% to 50%", percent);
  o.path.step_over = percent / 100;
  read.number("--tool", w.tool, 0.01, 1e4, "a diameter from 0.01 to 10000 mm", o.path.tool_diameter);
  read.number("--depth", w.depth, 1e-3, 1e4, "a depth from 0.001 to 10000 mm", o.path.depth);
  read.number("--stock-to-leave", w.stock_to_leave, 0.0, 1e4, "a length from 0 to 10000 mm",
              o.path.stock_to_leave);
  read.number("--feed", w.feed, 1e-3, 1e6, feed, o.path.feed);
  read.number("--plunge-feed", w.plunge_feed, 1e-3, 1e6, feed, o.path.plunge_feed);
  read.number("--link-feed", w.link_feed, 1e-3, 1e6, feed, o.path.link_feed);
  read.number("--safe-height", w.safe_height, 1e-3, 1e4, "a height above 0, mm", o.path.safe_height);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

Result<Command> to_simulate(const SimulateWords& w) {
  WordReader read;
  SimulateOptions o{w.program, w.pocket, {}, w.samples, w.json};
  const char* const above = "a number above 0";
  read.number("--tool", w.tool, 1e-3, 1e4, "a diameter from 0.001 to 10000 mm", o.machining.tool_diameter);
  read.number("--stock-to-leave", w.stock_to_leave, 0.0, 1e4, "a length from 0 to 10000 mm",
              o.machining.stock_to_leave);
  read.number("--step-over", w.step_over, 1e-3, 1.0, "a part of the diameter from 0.001 to 1",
              o.machining.step_over);
  read.number("--top", w.top, -1e6, 1e6, "a height within 1000 m of 0, in mm", o.machining.top);
  read.number("--acceleration", w.acceleration, 1e-3, 1e9, above, o.machining.acceleration);
  read.number("--rapid", w.rapid, 1e-3, 1e9, above, o.machining.rapid_feed);
  if (!read.complaint().empty()) return failure(ErrorCode::usage, read.complaint());
  return Command(std::move(o));
}

Result<Command> to_serve(const LayoutWords& layout, const ServeWords& w) {
  Result<LayoutSource> source = to_layout_source(layout);
  if (!source) return tl::unexpected(source.error());
  unsigned port = 0;
  const auto [end, error] = std::from_chars(w.port.data(), w.port.data() + w.port.size(), port);
  if (error != std::errc{} || end != w.port.data() + w.port.size() || port > 65535)
    return failure(ErrorCode::usage, fmt::format("--port {}: has to be a number from 0 to 65535", w.port));
  constexpr std::size_t kShortest = 8, kLongest = 200;
  const bool plain = std::all_of(w.token.begin(), w.token.end(), [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  });
  if (!w.token.empty() && (!plain || w.token.size() < kShortest || w.token.size() > kLongest))
    return failure(ErrorCode::usage,
                   fmt::format("--token: has to be {} to {} letters, digits, - or _", kShortest, kLongest));
  return Command(
      ServeOptions{std::move(*source), w.store, w.listen, static_cast<std::uint16_t>(port), w.token});
}

std::string first_empty_option(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_expected_min() == 0) continue;  // flags
    for (const std::string& word : option->results()) {
      if (word.empty()) return option->get_name();
    }
  }
  return {};
}

}  // namespace

const char* name_of(Method method) noexcept { return name_in(kMethods, method); }
const char* name_of(nc::RewriteMode mode) noexcept { return name_in(kModes, mode); }
const char* name_of(nc::ScanFrame frame) noexcept { return name_in(kScanFrames, frame); }

Result<Command> parse_command_line(int argc, char** argv) {
  CLI::App app(
      "lekalo: geometry for cutting shops, with proofs: parts in blanks, layouts on sheets and hides.",
      "lekalo");
  app.set_version_flag("--version", std::string("lekalo ") + kVersion, "Print the version and stop");
  app.footer("lekalo COMMAND --help explains a command.");
  app.require_subcommand(1);

  LocateWords words;
  CLI::App& locate = *app.add_subcommand(
      "locate", "Place a part in a probed blank with the largest possible minimum allowance, and prove it");
  add_input_options(locate, words);
  add_scan_options(locate, words);
  add_search_options(locate, words);
  add_program_options(locate, words);
  add_output_options(locate, words);
  locate.footer(kLocateFooter);

  VerifyOptions verify_options;
  CLI::App& verify = *app.add_subcommand(
      "verify", "Recheck a result against its files with exact arithmetic, independently of the solver");
  add_verify_options(verify, verify_options);
  verify.footer(
      "Exit codes: 0 confirmed, 1 clearance confirmed but there is no proof of the bound, 4 refuted,\n"
      "2 wrong command line, 3 a file cannot be read.");

  PocketWords pocket_words;
  CLI::App& pocket =
      *app.add_subcommand("pocket", "Make the NC program that clears a pocket with bounded engagement");
  add_pocket_options(pocket, pocket_words);
  pocket.footer(
      "Exit codes: 0 done, 2 wrong command line, 3 a file cannot be read or the tool fits nowhere,\n"
      "4 the program found failed its check, 5 disk or memory. lekalo simulate judges any program.");

  SimulateWords simulate_words;
  CLI::App& simulate = *app.add_subcommand(
      "simulate", "Say what an NC program cuts of a pocket: coverage, gouges, engagement, time");
  add_simulate_options(simulate, simulate_words);
  simulate.footer(
      "Exit codes: 0 whatever the figures are, 2 wrong command line, 3 a file cannot be read or judged,\n"
      "5 disk or memory. What the figures mean: docs/design/simulate.md");

  LayoutWords check_words, show_words, export_words, edit_words;
  CLI::App& check =
      *app.add_subcommand("check", "Say which rules a cutting layout breaks, exactly, and where");
  add_layout_source(check, check_words);
  add_layout_outputs(check, check_words);
  check.footer(
      "Exit codes: 0 valid, 1 violations, 2 wrong command line, 3 a file cannot be read,\n"
      "4 the engine and the independent checker do not agree, 5 disk or memory.");
  constexpr const char* kNoVerdict =
      "Exit codes: 0 done, whatever rules are broken, 2 wrong command line, 3 a file cannot be read,\n"
      "5 disk or memory.";
  CLI::App& show = *app.add_subcommand("show", "Show a cutting layout: material used, parts, kits, picture");
  add_layout_source(show, show_words);
  add_layout_outputs(show, show_words);
  show.footer(kNoVerdict);
  CLI::App& exported =
      *app.add_subcommand("export", "Write a layout or a job of another program in another form");
  add_layout_source(exported, export_words);
  exported.add_option("--format", export_words.format, list_of(kExportFormats, "|"))->type_name("FORM");
  exported.add_option("-o,--output", export_words.output, "Write to this file [stdout]")->type_name("FILE");
  exported
      .add_option("--instance-name", export_words.instance_name,
                  "What placements give as the file of their items [as the input says, or itself]")
      ->type_name("NAME");
  add_machine_words(exported, export_words);
  CLI::App& edit =
      *app.add_subcommand("edit", "Carry out a file of commands on a layout: move, slide, settle, ...");
  add_layout_source(edit, edit_words);
  edit.add_option("--commands", edit_words.commands,
                  "The commands, a line each; the first line is lekalo-commands/1")
      ->required()
      ->type_name("FILE");
  edit.add_option("-o,--output", edit_words.output, "Write the layout to this file [stdout]")
      ->type_name("FILE");
  edit.footer(
      "Exit codes: 0 no rule is broken, 1 some are, 2 a command cannot be carried out,\n"
      "3 a file cannot be read, 4 a command would break a rule (mode strict), 5 disk or memory.\n"
      "With 2 to 5 nothing is written. The commands: docs/design/layout-commands.md");

  exported.footer(kNoVerdict);

  LayoutWords nest_layout;
  NestWords nest_words;
  CLI::App& nest = *app.add_subcommand("nest", "Place parts on strips, sheets and hides, densely");
  add_layout_source(nest, nest_layout);
  add_nest_options(nest, nest_layout, nest_words);
  add_layout_outputs(nest, nest_layout);

  LayoutWords serve_layout;
  ServeWords serve_words;
  CLI::App& serve = *app.add_subcommand("serve", "Correct layouts in a browser, with a live exact check");
  add_layout_source(serve, serve_layout, false);
  add_serve_options(serve, serve_words);

  std::string shell;
  CLI::App& completion = *app.add_subcommand("completion", "Print a completion script for a shell");
  completion.add_option("shell", shell, "bash, zsh or fish")->required()->type_name("SHELL");
  completion.footer("For bash: eval \"$(lekalo completion bash)\"");

  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    return PrintText{std::string(version.what()) + "\n"};
  } catch (const CLI::CallForHelp&) {
    return PrintText{app.help()};
  } catch (const CLI::ParseError& error) {
    return failure(ErrorCode::usage, complaint(app, error, argc, argv));
  }
  for (const CLI::App* command : app.get_subcommands()) {
    const std::string empty = first_empty_option(*command);
    if (!empty.empty()) {
      return failure(ErrorCode::usage, empty + ": the value is empty (see lekalo --help)");
    }
  }
  if (locate) return to_options(words).map([](LocateOptions&& o) { return Command(std::move(o)); });
  if (verify) return verify_options;
  if (pocket) return to_pocket(pocket_words);
  if (simulate) return to_simulate(simulate_words);
  if (check) return to_drawn<CheckOptions>(check_words);
  if (show) return to_drawn<ShowOptions>(show_words);
  if (exported) return to_export(export_words);
  if (edit)
    return to_layout_source(edit_words).map([&](LayoutSource&& source) {
      return Command(EditOptions{std::move(source), edit_words.commands, edit_words.output});
    });
  if (nest) return to_nest(nest_layout, nest_words);
  if (serve) return to_serve(serve_layout, serve_words);
  return completion_script(app, shell).map([](std::string&& text) {
    return Command(PrintText{std::move(text)});
  });
}

}  // namespace lekalo::cli

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/lies.hpp"

/// What the checker says of reports about programs, from bytes made by hand.
namespace lekalo::verify::verify_cut_report_test {
namespace {

using cases::Json;
using test::Lie;

/// A rectangle, of which the upper side is given.
std::string pocket_with(const std::string& side, double x = 7.5, double y = 6.5) {
  return fmt::format(R"({{"units": "mm", "outer": [{{"line": {{"from": [0, 0], "to": [{0}, 0]}}}}, )"
                     R"({{"line": {{"from": [{0}, 0], "to": [{0}, {1}]}}}}, {2}, )"
                     R"({{"line": {{"from": [0, {1}], "to": [0, 0]}}}}]}})",
                     x, y, side);
}
const std::string kSide = R"({"line": {"from": [7.5, 6.5], "to": [0, 6.5]})", kOpen = R"(, "open": true})";
/// 7.5 x 6.5, in which a tool of 6 leaves a strip of 0.5 beside one slot. One like it has room for two slots.
const std::string kWalls = pocket_with(kSide + "}"),
                  kRoom = pocket_with(R"({"line": {"from": [24, 16], "to": [0, 16]}})", 24, 16);
/// Everything that a program has to say before it moves.
const std::string kModes = "G21 G90 G17 G54 G40 G49 G94 G91.1 G61\n";
const std::string kProgram = kModes + "G0 X3 Y3 Z5\nG1 Z-1 F300\nG1 X4.5 F1500\nG0 Z5\n";
/// A program before it, which cuts a little of the strip.
const std::string kEarlier = kModes + "G0 X3 Y6.25 Z5\nG1 Z-1 F300\nG1 X4 F1500\nG0 Z5\n";

struct Files {
  std::string program = kProgram, pocket = kWalls, pocket_name = "pocket.json";
  std::vector<std::pair<std::string, double>> earlier = {};  ///< programs, and diameters of their tools
  double tool = 6;
};
/// So small that it is judged in milliseconds: a slot there and back.
const std::string kSmallSide = R"({"line": {"from": [1, 0.5625], "to": [0, 0.5625]})";
const Files kSmall{.program = kModes + "G0 X0.25 Y0.25 Z5\nG1 Z-1 F300\nG1 X0.75 F1500\nX0.25\nG0 Z5\n",
                   .pocket = pocket_with(kSmallSide + "}", 1, 0.5625),
                   .tool = 0.5};

Json spots(const std::vector<UncutSpot>& found) {
  Json list = Json::array();
  for (const auto& spot : found) list.push_back({{"x", spot.x}, {"y", spot.y}, {"width_mm", spot.width_mm}});
  return list;
}
Json spots(const std::vector<UnreachableSpot>& found) {
  Json list = Json::array();
  for (const auto& spot : found)
    list.push_back(
        {{"x", spot.x}, {"y", spot.y}, {"distance_mm", spot.distance_mm}, {"area_mm2", spot.area_mm2}});
  return list;
}

/// A report of simulate with the figures that the simulator finds.
Json simulated(const Files& files) {
  SimulateOptions options;
  options.tool_diameter = files.tool;
  std::vector<EarlierProgram> earlier;
  for (const auto& [program, tool] : files.earlier) earlier.push_back({{"earlier", program}, tool});
  const auto judged = simulate({"p.ngc", files.program}, {files.pocket_name, files.pocket}, options, earlier);
  if (!judged) throw std::runtime_error(judged.error().message);
  const SimulateReport& r = *judged;
  Json report =
      Json::parse(R"({"format": {"name": "lekalo-simulate", "version": 1}, "units": "mm", "version": "0.2",
    "inputs": [{"role": "program", "path": "p.ngc", "sha256": "x"}, {"role": "pocket", "path": "pocket.json", "sha256": "y"}],
    "tool_mm": 6, "stock_to_leave_mm": 0, "step_over": 0.4, "top_mm": 0, "acceleration_mm_per_s2": 500,
    "rapid_mm_per_min": 5000, "control": "linuxcnc"})");
  report["tool_mm"] = files.tool;
  for (const auto& [program, tool] : files.earlier)
    report["inputs"].push_back({{"role", "after"}, {"path", "e.ngc"}, {"sha256", "z"}, {"tool_mm", tool}});
  report["coverage_percent"] = r.coverage_percent, report["coverage_low_percent"] = r.coverage_low_percent;
  report["uncut_width_mm"] = r.uncut_width_mm, report["gouge_mm"] = r.gouge_mm;
  report["engagement_max_deg"] = r.engagement_max_deg, report["engagement_peak_deg"] = r.engagement_peak_deg;
  report["engagement_p95_deg"] = r.engagement_p95_deg, report["air_percent"] = r.air_percent;
  report["entry_mm"] = r.entry_mm, report["entry_layer_mm"] = r.entry_layer_mm;
  report["rapid_cut_mm"] = r.rapid_cut_mm, report["length_mm"] = r.length_mm;
  report["turning_rad"] = r.turning_rad, report["retracts"] = r.retracts, report["seconds"] = r.seconds;
  report["lower_bound_seconds"] = r.lower_bound_seconds, report["reachable_mm2"] = r.reachable_mm2;
  report["uncut_mm2"] = r.uncut_mm2, report["left_before_mm2"] = r.left_before_mm2;
  report["uncut"] = spots(r.uncut), report["unreachable"] = spots(r.unreachable);
  return report;
}

/// A report of pocket about the same, to the depth that the program goes to; its one long cut in full
/// material.
Json pocketed(const Files& files = {}) {
  Json report = simulated(files);
  report.at("/format/name") = "lekalo-pocket";
  report["outputs"] = Json::array({report["inputs"][0]});
  report["inputs"].erase(0);
  report["regions"] = Json::parse(files.pocket);
  report["tolerance_mm"] = 0, report["drawing"] = nullptr, report["scan"] = nullptr;
  report["open_layers"] = Json::array(), report["ramps"] = Json::array();
  report["hot_cuts"] = Json::parse(R"([{"from": [3.05, 3], "to": [4.5, 3], "z": -1, "length_mm": 1.5,
    "engagement_deg": 180}])");
  report["depth_mm"] = 1, report["floor_stock_mm"] = 0;
  return report;
}

/// The findings, and what stayed unchecked, a line each; or the error.
std::string judged(const Json& report, const Files& files = {}, std::vector<std::string>* notes = nullptr) {
  const std::string text_of_report = report.dump();
  const Document document{"r.json", text_of_report};
  const auto names = named_files(document);
  if (!names) return names.error().message;
  std::vector<Document> documents;
  std::size_t earlier = 0;
  for (const NamedFile& file : *names) {
    if (file.role == "program")
      documents.push_back({"p.ngc", files.program});
    else if (file.role == "pocket")
      documents.push_back({files.pocket_name, files.pocket});
    else if (file.role == "after" && earlier < files.earlier.size())
      documents.push_back({"e.ngc", files.earlier[earlier++].first});
    else
      documents.push_back({"o", ""});
  }
  const auto claims = verify_cut_report(document, documents);
  if (!claims) return claims.error().message;
  if (notes != nullptr) *notes = claims->notes;
  std::string text;
  for (const std::string& finding : claims->findings) text += finding + "\n";
  for (const std::string& unchecked : claims->unchecked) text += "unchecked: " + unchecked + "\n";
  return text;
}

std::string changed(Json report, const std::string& path, const Json& value, const Files& files = {}) {
  report.at(path) = value;
  return judged(report, files);
}

/// A report of pocket about the small slot.
Json small_report() {
  Json report = pocketed(kSmall);
  report["hot_cuts"] = Json::parse(R"([{"from": [0.292, 0.25], "to": [0.75, 0.25], "z": -1, "length_mm": 0.5,
    "engagement_deg": 180}])");
  return report;
}

/// Changes of what is information, or so small that the same figures follow.
bool makes_no_difference(const Lie& lie) {
  const auto& path = lie.path;
  const std::string how = lie.how;
  const bool option = path.ends_with("_mm") && path.find('/', 1) == std::string::npos;
  if (how == "deleted") return path == "/regions/units";  // they are mm without it
  return how == "exchanged" || path == "/version" || path.ends_with("/path") || path.ends_with("/sha256") ||
         path == "/tolerance_mm" || path == "/drawing" ||
         (how == "last place" && (option || path == "/step_over" || path == "/acceleration_mm_per_s2" ||
                                  path == "/rapid_mm_per_min"));
}
const std::vector<std::string> kFigures{"coverage_percent", "gouge_mm", "uncut_width_mm", "entry_mm",
                                        "length_mm"};

void expect_every_lie_to_be_seen(const Json& report) {
  ASSERT_EQ(judged(report), "");
  ASSERT_FALSE(report["uncut"].empty());
  ASSERT_EQ(report["unreachable"].size(), 4U);
  for (const Lie& lie : test::lies_of_json(report.dump()))
    if (!makes_no_difference(lie)) {
      EXPECT_NE(judged(Json::parse(lie.bytes())), "") << lie.path << " " << lie.how;
    }
  for (const std::string& figure : kFigures) {
    Json other = report;
    other[figure] = std::nextafter(report[figure].get<double>(), 1e300);
    EXPECT_NE(judged(other).find(figure + " is "), std::string::npos) << figure;
  }
}

TEST(VerifyCutReport, EveryFigureOfAReportOfSimulateIsTheVeryOne) {
  expect_every_lie_to_be_seen(simulated({}));
}
TEST(VerifyCutReport, EveryFigureOfAReportOfPocketIsTheVeryOne) { expect_every_lie_to_be_seen(pocketed()); }

TEST(VerifyCutReport, OneWordThatIsWrongIsNamed) {
  const Json report = small_report();
  ASSERT_EQ(judged(report, kSmall), "");
  const std::string
      deeper = "the program goes down to Z -1, which is not depth_mm less floor_stock_mm below top_mm\n",
      from = "r.json: field hot_cuts[0].from is not a list of two numbers",
      to = "r.json: field hot_cuts[0].to is not a list of two numbers";
  const auto with = [&](const std::string& path, const char* value) {
    return changed(report, path, Json::parse(value), kSmall);
  };
  EXPECT_EQ(with("/depth_mm", "1.0005"), "");
  EXPECT_EQ(with("/depth_mm", "1.00052"), deeper);
  EXPECT_EQ(with("/depth_mm", "0.99948"), deeper);
  EXPECT_EQ(with("/floor_stock_mm", "0.25"), deeper);
  EXPECT_EQ(with("/hot_cuts/0/from", "[0.292, \"0.25\"]"), from);
  EXPECT_EQ(with("/hot_cuts/0/from", "[0.292]"), from);
  EXPECT_EQ(with("/hot_cuts/0/from", "[0.292, 0.25, 1]"), to);
  EXPECT_EQ(with("/hot_cuts/0/to", "[0.75, 0.25, 1]"), to);
  EXPECT_EQ(with("/hot_cuts/0/to", "[0.75, 0.26]"), "hot_cuts[0] is not what the program cuts there\n");
  Json other = report;
  other["depth_mm"] = 0.75, other["floor_stock_mm"] = -0.25;
  EXPECT_EQ(judged(other, kSmall), deeper);
  other = report;
  other["unsaid"] = Json::array();
  EXPECT_EQ(judged(other, kSmall), "r.json: field unsaid is not one of such a report");
  // A straight pass with a step-over of 0.8 meets 126.87 degrees, of which five quarters are less than the
  // 180 of a slot; with 1 it is a slot itself.
  other = report;
  other["step_over"] = 0.8, other["lower_bound_seconds"] = report["lower_bound_seconds"].get<double>() / 2;
  EXPECT_EQ(judged(other, kSmall), "");
  other["step_over"] = 1;
  EXPECT_NE(judged(other, kSmall).find("hot_cuts has 1 items and is to have 0"), std::string::npos);
  other = simulated(kSmall);
  other["rest_of_mm"] = 1, other["supposed_program"] = kSmall.program;
  EXPECT_EQ(judged(other, kSmall), "r.json: field rest_of_mm is not one of such a report");
  Files ramp = kSmall;
  ramp.program = kModes + "G0 X0.25 Y0.25 Z5\nG1 Z0 F300\nG1 X0.75 Z-1 F1500\nX0.25\nG0 Z5\n";
  other = pocketed(ramp);
  other["hot_cuts"] = Json::array();
  EXPECT_EQ(judged(other, ramp), "");
}

TEST(VerifyCutReport, ItemsThatAreMissingOrTooManyAreCounted) {
  const Json report = pocketed();
  for (const char* list : {"uncut", "unreachable", "hot_cuts"}) {
    const std::size_t count = report[list].size();
    Json more = report;
    const Json last = more[list].back();
    more[list].push_back(last);
    EXPECT_EQ(judged(more), fmt::format("{} has {} items and is to have {}\n", list, count + 1, count));
    Json less = report;
    less[list].erase(count - 1);
    EXPECT_EQ(judged(less), fmt::format("{} has {} items and is to have {}\n", list, count - 1, count));
    EXPECT_EQ(changed(report, std::string("/") + list, 5),
              fmt::format("r.json: field {} is not a list", list));
    EXPECT_EQ(changed(report, fmt::format("/{}/0", list), 5),
              fmt::format("r.json: {}[0] is not an object", list));
    Json strange = report;
    strange[list][0]["more"] = 1;
    EXPECT_EQ(judged(strange), fmt::format("r.json: field {}[0].more is not one of such a report", list));
  }
}

TEST(VerifyCutReport, FilesHaveTheirRolesOnce) {
  const Json report = simulated({});
  const std::string wrong =
      "r.json: the files that it names have the role \"{}\" twice, or no such report has it";
  for (const std::size_t k : {0U, 1U}) {
    Json twice = report;
    twice["inputs"].push_back(twice["inputs"][k]);
    const std::string role = k == 0 ? "program" : "pocket";
    EXPECT_EQ(judged(twice), fmt::format(fmt::runtime(wrong), role));
    Json none = report;
    none["inputs"].erase(k);
    EXPECT_EQ(judged(none), fmt::format("r.json: it names no file with the role \"{}\"", role));
  }
  Json other = report;
  other["inputs"].push_back({{"role", "other"}, {"path", "o"}, {"sha256", "x"}});
  EXPECT_EQ(judged(other), fmt::format(fmt::runtime(wrong), "other"));
  // A stock is one of what heats up.
  Json stock = report;
  stock["inputs"].push_back({{"role", "stock"}, {"path", "o"}, {"sha256", "x"}});
  EXPECT_EQ(judged(stock), fmt::format(fmt::runtime(wrong), "stock"));
  Json first = report;
  first["inputs"] = Json::array({other["inputs"].back(), report["inputs"][0], report["inputs"][1]});
  EXPECT_EQ(judged(first), fmt::format(fmt::runtime(wrong), "other"));
}

TEST(VerifyCutReport, EarlierProgramsCutWithTheirTools) {
  const Files after{.earlier = {{kEarlier, 0.25}}};
  const Json report = simulated(after);
  EXPECT_EQ(judged(report, after), "");
  EXPECT_NE(changed(report, "/inputs/2/tool_mm", 0.375, after).find(" and is to be "), std::string::npos);
  EXPECT_NE(judged(report, {.earlier = {{kProgram, 0.25}}}).find(" and is to be "), std::string::npos);
}

TEST(VerifyCutReport, OptionsOutOfTheirRangeAreTheReports) {
  EXPECT_TRUE(changed(simulated({}), "/tool_mm", 0).starts_with("r.json: "))
      << changed(simulated({}), "/tool_mm", 0);
  EXPECT_EQ(changed(simulated({}), "/control", "none"),
            "r.json: field control is none that programs are read for");
  EXPECT_TRUE(judged(simulated({}), {.program = "G41 D1\n"}).starts_with("p.ngc:1: "));
}

// ---- cuts in full material --------------------------------------------------------------------------------

/// The hot cuts that the checker finds, as it says how many there are to be.
std::string hot_cuts_of(const std::string& program, const std::string& said, double step_over = 0.4) {
  const Files files{.program = kModes + program, .pocket = kRoom};
  Json report = pocketed(files);
  report["hot_cuts"] = Json::parse(said), report["step_over"] = step_over;
  std::string found;
  // Of the figures the bound on the time alone uses the step-over.
  report["lower_bound_seconds"] = report["lower_bound_seconds"].get<double>() * 0.4 / step_over;
  const std::string text = judged(report, files);
  for (std::size_t at = 0; (at = text.find("hot_cuts", at)) != std::string::npos; ++at)
    found += text.substr(at, text.find('\n', at) - at);
  return found;
}

std::string cut(double from, double to, double y, double angle, double z = -1) {
  return fmt::format(
      R"({{"from": [{}, {}], "to": [{}, {}], "z": {}, "length_mm": {}, "engagement_deg": {}}})", from, y, to,
      y, z, std::round((to - from + 0.05) * 1000) / 1000, angle);
}

TEST(VerifyCutReport, HotCutsLastTwoTenthsOfAMillimetre) {
  const std::string down = "G0 X6 Y6 Z5\nG1 Z-1 F300\nG1 F1500 ";
  EXPECT_EQ(hot_cuts_of(down + "X6.15\nG0 Z5\n", "[]"), "");
  EXPECT_EQ(hot_cuts_of(
                down + "X6.2\nG0 Z5\n",
                R"([{"from": [6.04, 6], "to": [6.2, 6], "z": -1, "length_mm": 0.2, "engagement_deg": 180}])"),
            "");
  EXPECT_EQ(hot_cuts_of(down + "X6.2\nG0 Z5\n", "[]"), "hot_cuts has 0 items and is to have 1");
}

TEST(VerifyCutReport, HotCutsMeetFiveQuartersOfAStraightPass) {
  // The second slot is 3.6 mm beside the first and meets acos(-0.2) = 101.537 degrees; a straight pass with a
  // step-over of 0.4 meets 78.463 and with 0.43 81.951 degrees, of which five quarters are 98.08 and 102.44.
  const std::string slots =
      "G0 X6 Y4 Z5\nG1 Z-1 F300\nG1 X18 F1500\nX6\nG0 Z5\nG0 X7.5 Y7.6\nG1 Z-1 F300\nG1 X13.5 F1500\nG0 Z5\n";
  const std::string first = cut(6.05, 18, 4, 180), second = cut(7.55, 13.5, 7.6, 101.537);
  EXPECT_EQ(hot_cuts_of(slots, "[" + first + "," + second + "]"), "");
  EXPECT_EQ(hot_cuts_of(slots, "[" + first + "]", 0.43), "");
  EXPECT_EQ(hot_cuts_of(slots, "[" + second + "," + first + "]"),
            "hot_cuts[0] is not what the program cuts therehot_cuts[1] is not what the program cuts there");
}

TEST(VerifyCutReport, RampsAreNoHotCutsAndAStretchEndsWhereTheMaterialDoes) {
  // Down along a ramp and back on its floor, both entries; on from X18 the slot is full again.
  EXPECT_EQ(hot_cuts_of("G0 X6 Y6 Z5\nG1 Z0 F300\nG1 X18 Z-1 F1500\nG1 X6\nG0 Z5\n", "[]"), "");
  // Across a slot: full before it and behind it, and in between none.
  EXPECT_EQ(
      hot_cuts_of("G0 X12 Y4 Z5\nG1 Z-1 F300\nG1 Y12 F1500\nY4\nG0 Z5\nG0 X4 Y8\nG1 Z-1 F300\nG1 X20 F1500\n",
                  "[]"),
      "hot_cuts has 0 items and is to have 3");
}

TEST(VerifyCutReport, APlaceOfAStretchIsTwoNumbers) {
  const std::string from = "r.json: field hot_cuts[0].from is not a list of two numbers";
  for (const char* wrong : {"[]", "[3.05]", "[3.05, \"3\"]"})
    EXPECT_EQ(changed(pocketed(), "/hot_cuts/0/from", Json::parse(wrong)), from) << wrong;
  EXPECT_EQ(changed(pocketed(), "/hot_cuts/0/to", Json::parse("[4.5]")), from);
  const std::string to = "r.json: field hot_cuts[0].to is not a list of two numbers";
  EXPECT_EQ(changed(pocketed(), "/hot_cuts/0/to", Json::parse("[4.5, 3, 1]")), to);
  EXPECT_EQ(changed(pocketed(), "/hot_cuts/0/from", Json::parse("[3.05, 3, 1]")), to);
}

TEST(VerifyCutReport, RampsAreReadAndLeftUnchecked) {
  Json report = pocketed();
  const Json one = report["hot_cuts"][0];
  report["ramps"].push_back(one);
  EXPECT_EQ(
      judged(report),
      "unchecked: ramps: what 1 stretches would have met without a ramp cannot be seen in the program\n");
  EXPECT_EQ(changed(report, "/ramps/0/from", 5), "r.json: field ramps[0].from is not a list");
  EXPECT_EQ(changed(report, "/ramps/0", 5), "r.json: ramps[0] is not an object");
}

// ---- depth, and what is supposed --------------------------------------------------------------------------

TEST(VerifyCutReport, TheProgramGoesDownToTheDepthLessWhatStaysOnTheFloor) {
  const auto with = [](double depth, double stays) {
    Json report = pocketed();
    report["depth_mm"] = depth, report["floor_stock_mm"] = stays;
    return judged(report);
  };
  const std::string no =
      "the program goes down to Z -1, which is not depth_mm less floor_stock_mm below top_mm\n";
  EXPECT_EQ(with(1, 0), "");
  EXPECT_EQ(with(1.25, 0.25), "");
  EXPECT_EQ(with(1.0005, 0), "");
  EXPECT_EQ(with(0.9995, 0), "");
  EXPECT_EQ(with(1.00052, 0), no);
  EXPECT_EQ(with(0.99948, 0), no);
  EXPECT_EQ(with(1, 0.25), no);
  EXPECT_EQ(with(0.75, -0.25), no);
  // From another upper face.
  const Files raised{.program = kModes + "G0 X3 Y3 Z5\nG1 Z1 F300\nG1 X4.5 F1500\nG1 Z0.5\nG1 X3\nG0 Z5\n"};
  Json report = pocketed();
  report["top_mm"] = 2, report["depth_mm"] = 1.5;
  EXPECT_EQ(judged(report, raised).find("below top_mm"), std::string::npos);
  report["depth_mm"] = 1;
  EXPECT_NE(judged(report, raised).find("the program goes down to Z 0.5, "), std::string::npos);
}

/// The kModes without one of them.
std::string without(const std::string& word) {
  std::string modes = kModes;
  modes.erase(modes.find(word + (word == "G61" ? "" : " ")), word.size());
  return modes;
}

/// A control that begins in inches, or goes on as the program before it, makes other motions of it.
TEST(VerifyCutReport, ModesThatTheProgramDoesNotSayAreUnchecked) {
  const std::string moves = "G0 X3 Y3 Z5\nG1 Z-1 F300\nG1 X4.5 F1500\nG0 Z5\n";
  const auto unsaid = [&](const std::string& modes, const std::string& control = "linuxcnc") {
    Json report = pocketed();
    report["control"] = control;
    return judged(report, {.program = modes + moves});
  };
  const auto line = [](int number, const std::string& what, bool of_one = false) {
    return fmt::format(
        "unchecked: program: line {} moves where the program does not say {}; the control decides "
        "it{}\n",
        number, what, of_one ? " (--control says whose words these are, if not LinuxCNC's)" : "");
  };
  const std::string exact = line(2, "that its path is exact (G61)", true);
  EXPECT_EQ(unsaid(kModes), "");
  EXPECT_EQ(unsaid(without("G17")), "") << "lines alone need no plane";
  EXPECT_EQ(unsaid(without("G91.1")), "") << "lines alone have no centre";
  EXPECT_EQ(unsaid(without("G21")), line(2, "its unit (G20 or G21)"));
  EXPECT_EQ(unsaid(without("G90")), line(2, "from where it counts (G90 or G91)"));
  EXPECT_EQ(unsaid(without("G54")), line(2, "its work offset (G54)"));
  EXPECT_EQ(unsaid(without("G94")), line(3, "that F is a speed (G94)")) << "a rapid has no F";
  EXPECT_EQ(unsaid(without("G40")), line(2, "that no radius is taken off (G40)"));
  EXPECT_EQ(unsaid(without("G49")), line(2, "the length of its tool (G43 or G49)"));
  EXPECT_EQ(unsaid(without("G61")), exact);
  EXPECT_EQ(unsaid(kModes + "G64 P0.05\n"), line(3, "that its path is exact (G61)", true)) << "it blends";
  EXPECT_EQ(unsaid(kModes + "G64\nG61.1\n"), "");
  EXPECT_EQ(unsaid("").size(), unsaid(without("G21")).size() + unsaid(without("G90")).size() +
                                   unsaid(without("G54")).size() + unsaid(without("G94")).size() +
                                   unsaid(without("G40")).size() + unsaid(without("G49")).size() +
                                   unsaid(without("G61")).size());
}

/// The stock is as the programs before left it, and a report of simulate tells what they leave to the
/// control.
TEST(VerifyCutReport, ModesOfEarlierProgramsAndOfSimulateAreUncheckedToo) {
  const std::string no_unit =
      "line 2 moves where the program does not say its unit (G20 or G21); the control decides it";
  const Files before{.earlier = {{without("G21") + kEarlier.substr(kModes.size()), 0.25}}};
  EXPECT_EQ(judged(pocketed(before), before), "unchecked: e.ngc: " + no_unit + "\n");
  Json report = simulated(before);
  EXPECT_EQ(judged(report, before), "unchecked: e.ngc: " + no_unit + "\n");
  const Files own{.program = without("G21") + kProgram.substr(kModes.size())};
  report = simulated(own);
  EXPECT_EQ(judged(report, own), "unchecked: program: " + no_unit + "\n");
  report["unsaid"] = Json::array({"program: " + no_unit});
  EXPECT_EQ(judged(report, own), "unchecked: program: " + no_unit + "\n");
  for (const Json& other :
       {Json::array(), Json::array({"program: " + no_unit, "another"}), Json::array({"another"})}) {
    report["unsaid"] = other;
    EXPECT_EQ(judged(report, own),
              "unsaid is not what the programs do not say\nunchecked: program: " + no_unit + "\n");
  }
  report["unsaid"] = 3;
  EXPECT_EQ(judged(report, own), "r.json: field unsaid is not a list");
  report["unsaid"] = Json::array({3});
  EXPECT_EQ(judged(report, own), "r.json: unsaid[0] is not a text");
  report = simulated({});
  report["unsaid"] = Json::array({"program: " + no_unit});
  EXPECT_EQ(judged(report), "unsaid is not what the programs do not say\n");
}

/// Controls that have one value of a mode alone need no word for it.
TEST(VerifyCutReport, WhatAControlCannotDoOtherwiseNeedsNoWord) {
  const std::string moves = "G0 X3. Y3. Z5.\nG1 Z-1. F300.\nG3 X3. Y3. I0.25 J0. F1500.\nG0 Z5.\n";
  const auto unsaid = [&](words::Control control, const std::string& modes) {
    SimulateOptions options;
    options.tool_diameter = 6, options.control = control;
    const std::string program = modes + moves;
    const auto report = verify_pocket_program({"p.ngc", program}, {"pocket.json", kWalls}, options, {});
    EXPECT_TRUE(report) << report.error().message;
    return report ? report->unchecked.size() : 99;
  };
  const std::string common = "G21 G90 G17 G54 G40 G49 G94\n";
  for (const auto control : {words::Control::haas, words::Control::fanuc, words::Control::grbl})
    EXPECT_EQ(unsaid(control, common), 0U) << words::word_of(control);
  EXPECT_EQ(unsaid(words::Control::linuxcnc, common), 2U);
  EXPECT_EQ(unsaid(words::Control::linuxcnc, kModes), 0U);
  EXPECT_EQ(unsaid(words::Control::linuxcnc, without("G17")), 1U);
  EXPECT_EQ(unsaid(words::Control::linuxcnc, without("G91.1")), 1U);
  const std::string no_g40 = "G21 G90 G17 G54 G49 G94\n";
  EXPECT_EQ(unsaid(words::Control::grbl, no_g40), 0U);
  EXPECT_EQ(unsaid(words::Control::haas, no_g40), 1U);
}

TEST(VerifyCutReport, TheProgramOfALargerToolThatIsSupposedIsUnchecked) {
  const Files after{.earlier = {{kEarlier, 0.25}}};
  Json report = pocketed(after);
  report["inputs"].erase(1);
  report["rest_of_mm"] = 0.25, report["supposed_program"] = kEarlier;
  EXPECT_EQ(
      judged(report),
      "unchecked: rest_of_mm: that a tool of 0.25 mm cuts what the supposed program cuts is not rechecked\n");
  EXPECT_NE(changed(report, "/rest_of_mm", 0.375).find(" and is to be "), std::string::npos);
  EXPECT_EQ(changed(report, "/supposed_program", 5), "r.json: field supposed_program is not a text");
  Json simulate = simulated({});
  simulate["rest_of_mm"] = 4, simulate["supposed_program"] = kEarlier;
  EXPECT_EQ(judged(simulate), "r.json: field rest_of_mm is not one of such a report");
}

// ---- regions ----------------------------------------------------------------------------------------------

TEST(VerifyCutReport, RegionsAreThoseOfTheFile) {
  std::string larger = kWalls;
  for (std::size_t at = 0; (at = larger.find("7.5", at)) != std::string::npos;) larger.replace(at, 3, "7.6");
  EXPECT_EQ(judged(pocketed(), {.pocket = larger}),
            "regions are not what pocket.json means: it has other edges\n");
  EXPECT_EQ(changed(pocketed(), "/regions", 5), "r.json: field regions is not an object");
  for (const char* field : {"drawing", "scan"}) {
    Json report = pocketed();
    report.erase(field);
    EXPECT_EQ(judged(report), fmt::format("r.json: field {} is missing", field));
  }
  EXPECT_EQ(changed(pocketed(), "/open_layers", Json::parse("[1]")), "r.json: open_layers[0] is not a text");
}

TEST(VerifyCutReport, AToleranceIsToldAndFrom0On) {
  const auto noted = [](double tolerance) {
    Json report = pocketed();
    report["tolerance_mm"] = tolerance;
    std::vector<std::string> notes;
    EXPECT_EQ(judged(report, {}, &notes), "");
    return notes.back();
  };
  EXPECT_EQ(noted(0), "the figures were made anew from p.ngc");
  EXPECT_EQ(noted(0.01), "regions are within 0.01 mm of what the file means");
  EXPECT_EQ(changed(pocketed(), "/tolerance_mm", -0.01), "r.json: field tolerance_mm is below 0");
  Json old = pocketed();
  for (const char* field : {"tolerance_mm", "drawing", "scan", "open_layers"}) old.erase(field);
  EXPECT_EQ(
      judged(old),
      "unchecked: regions: that they are what pocket.json becomes was not rechecked: the report does not say "
      "how it was read, as those of lekalo 0.1 did not\n");
}

/// The findings about open edges where the report states one region and the file another.
std::string open_edges(const std::string& stated, const std::string& in_file, double tolerance = 0) {
  Files files{.pocket = stated};
  Json report = pocketed(files);
  report["regions"] = Json::parse(stated), report["tolerance_mm"] = tolerance;
  files.pocket = in_file;
  return judged(report, files);
}

TEST(VerifyCutReport, OpenEdgesAreThoseOfTheFile) {
  const std::string open = pocket_with(kSide + kOpen);
  const std::string no = "the open edges are not those of pocket.json\n";
  EXPECT_EQ(open_edges(kWalls, kWalls), "");
  EXPECT_EQ(open_edges(open, open), "");
  EXPECT_EQ(open_edges(open, kWalls).substr(0, no.size()), no);
  EXPECT_EQ(open_edges(kWalls, open).substr(0, no.size()), no);
  // The other long side is open in the file.
  std::string other = kWalls;
  other.replace(other.find("}}"), 2, "}, \"open\": true}");
  EXPECT_EQ(open_edges(open, other), no);
}

TEST(VerifyCutReport, OpenEdgesMayBeginAndRunOtherwise) {
  const std::string open = pocket_with(kSide + kOpen);
  const std::string turned =
      R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [0, 6.5]}}, {"line": {"from": [0, 6.5], "to": [7.5, 6.5]}, "open": true}, )"
      R"({"line": {"from": [7.5, 6.5], "to": [7.5, 0]}}, {"line": {"from": [7.5, 0], "to": [0, 0]}}]})";
  EXPECT_EQ(open_edges(open, turned), "");
  EXPECT_EQ(open_edges(turned, open), "");
  // Ends that are off by the tolerance are the same, in x and in y.
  const auto moved = [](double x, double y) {
    return fmt::format(
        R"({{"units": "mm", "outer": [{{"line": {{"from": [0, 0], "to": [7.5, 0]}}}}, {{"line": {{"from": [7.5, 0], "to": [{0}, {1}]}}}}, )"
        R"({{"line": {{"from": [{0}, {1}], "to": [0, 6.5]}}, "open": true}}, {{"line": {{"from": [0, 6.5], "to": [0, 0]}}}}]}})",
        7.5 + x, 6.5 + y);
  };
  EXPECT_EQ(open_edges(open, moved(0.124, 0), 0.125), "");
  EXPECT_EQ(open_edges(open, moved(0, 0.124), 0.125), "");
  EXPECT_NE(open_edges(open, moved(0.126, 0), 0.125), "");
  EXPECT_NE(open_edges(open, moved(0, 0.126), 0.125), "");
}

// ---- layers -----------------------------------------------------------------------------------------------

/// A drawing of the pocket whose upper side lies on a layer of its own.
std::string drawn(const std::string& layer, const std::string& more = "") {
  return R"(<svg width="7.5mm" height="6.5mm" viewBox="0 0 7.5 6.5"><g id="WALL"><path d="M7.5 0V6.5H0V0"/></g><g id=")" +
         layer + R"("><path d="M0 0H7.5"/></g>)" + more + "</svg>";
}

/// What is said of a drawing whose upper side is said to be open, or not, and these layers to be so.
std::string layers(const std::string& drawing, bool open, const Json& open_layers) {
  Files files{.pocket = pocket_with(kSide + (open ? kOpen : "}"))};
  Json report = pocketed(files);
  report["open_layers"] = open_layers;
  report["drawing"] = Json::parse(R"({"layers": [], "join": 0, "set_aside": []})");
  files.pocket = drawing, files.pocket_name = "d.svg";
  return judged(report, files);
}

TEST(VerifyCutReport, AnEdgeIsOpenWhereItsLayerIs) {
  EXPECT_EQ(layers(drawn("OPEN"), true, {"OPEN"}), "");
  EXPECT_EQ(layers(drawn("OPEN"), false, Json::array()), "");
  EXPECT_EQ(layers(drawn("OPEN"), true, Json::array()),
            "edge 2 of regions is open, but its layer is none of open_layers\n");
  EXPECT_EQ(layers(drawn("OPEN"), false, {"OPEN"}),
            "edge 2 of regions is a wall, but its layer is one of open_layers\n");
  EXPECT_EQ(layers(drawn("OPEN"), true, {"OTHER", "OPEN"}), "");
}

TEST(VerifyCutReport, NamesOfLayersCompareWithoutTheirCaseOfAToZ) {
  EXPECT_EQ(layers(drawn("AbmZ"), true, {"aBMz"}), "");
  const std::string none = "edge 2 of regions is open, but its layer is none of open_layers\n";
  for (const auto& [a, b] :
       {std::pair{"A[", "a{"}, {"A@", "a`"}, {"OPEN", "OPENS"}, {"OPENS", "OPEN"}, {"OPEN", ""}})
    EXPECT_EQ(layers(drawn(a), true, Json::array({b})), none) << a << " " << b;
}

TEST(VerifyCutReport, AnEdgeAlongTwoLayersOfWhichOneIsOpenIsUnchecked) {
  const std::string twice = drawn("OPEN", R"(<g id="MORE"><path d="M0 0H7.5"/></g>)");
  const std::string unchecked =
      "unchecked: regions: which of two layers edge 2 runs along, an open one or not\n";
  EXPECT_EQ(layers(twice, true, {"OPEN"}), unchecked);
  EXPECT_EQ(layers(twice, false, {"OPEN"}), unchecked);
  EXPECT_EQ(layers(twice, true, {"OPEN", "MORE"}), "");
  EXPECT_EQ(layers(twice, false, Json::array()), "");
}

TEST(VerifyCutReport, AScanHasNoLayersThatCouldBeOpen) {
  // Points 0.25 mm outside the pocket, in their order.
  std::string points;
  const auto along = [&](double x, double y, double dx, double dy, int count) {
    for (int k = 0; k < count; ++k) points += fmt::format("{},{}\n", x + dx * k, y + dy * k);
  };
  along(-0.25, -0.25, 0.0625, 0, 24);
  along(1.25, -0.25, 0, 0.0625, 17);
  along(1.25, 0.8125, -0.0625, 0, 24);
  along(-0.25, 0.8125, 0, -0.0625, 17);
  const auto with = [&](const Files& stated) {
    Json report = pocketed(stated);
    report["hot_cuts"] = small_report()["hot_cuts"];
    report["open_layers"] = Json::array({"OPEN"});
    report["scan"] = Json::parse(R"({"units": "mm", "points": 82, "proved": true, "ordered": true,
      "guard": 0.1, "step": 0.1, "loss": 1, "min_radius": null, "max_dip": null, "slice": null,
      "left_out": [], "outlines": null})");
    Files files = stated;
    files.pocket = points, files.pocket_name = "p.csv";
    return judged(report, files);
  };
  EXPECT_EQ(with(kSmall), "");
  Files open = kSmall;
  open.pocket = pocket_with(kSmallSide + kOpen, 1, 0.5625);
  EXPECT_EQ(with(open), "edge 2 of regions is open, but its layer is none of open_layers\n");
}

/// A word that nobody knows may have been meant to say something of the pocket.
TEST(VerifyCutReport, PocketsWithWordsThatNobodyKnowsAreRefused) {
  const std::string tree = R"("units": "mm", "shape": {"rectangle": {"size": [7.5, 6.5], "corner": [0, 0]}})";
  Json report = pocketed();
  report["tolerance_mm"] = 1e-6;
  EXPECT_EQ(judged(report, {.pocket = "{" + tree + R"(, "name": "a", "source": "b"})"}), "");
  const std::string refuted = "regions are not what pocket.json means: field ";
  EXPECT_EQ(judged(report, {.pocket = "{" + tree + R"(, "islands": []})"}),
            refuted + "islands is not one of a tree of primitives\n");
  EXPECT_EQ(judged(report, {.pocket = "{" + tree + R"(, "units": "mm"})"}),
            refuted + "units is given twice\n");
  const auto with = [](const std::string& member) {
    const std::string pocket = kWalls.substr(0, kWalls.size() - 1) + member + "}";
    SimulateOptions options;
    options.tool_diameter = 6;
    const auto alone = verify_pocket_program({"p.ngc", kProgram}, {"pocket.json", pocket}, options, {});
    return alone ? std::string() : alone.error().message;
  };
  EXPECT_EQ(with(R"(, "name": "a", "date": 5)"), "");
  EXPECT_EQ(with(R"(, "hols": [])"), "pocket.json: field hols is not one of a region file");
}

// ---- a program alone --------------------------------------------------------------------------------------

/// The findings about a program by itself.
std::vector<std::string> alone(const std::string& program) {
  SimulateOptions options;
  options.tool_diameter = 6;
  const auto report = verify_pocket_program({"p.ngc", program}, {"pocket.json", kWalls}, options, {});
  return report ? report->findings : std::vector{report.error().message};
}

TEST(VerifyCutReport, AProgramAloneKeepsItsWallsAndClearsItsPocket) {
  const std::string begin = "G21 G90 G17\nG0 X3 Y3 Z5\nG1 Z-1 F300\n", end = "Y3\nG0 Z5\n";
  const auto round = [&](double left) {
    return fmt::format("G0 X{0} Y3 Z5\nG1 Z-1 F300\nG1 X4.5 F1500\nY3.5\nX{0}\n", left) + end;
  };
  EXPECT_EQ(alone(round(3)), std::vector<std::string>());
  EXPECT_EQ(alone(round(2.996)), std::vector<std::string>());
  const auto gouging = alone(round(2.994));
  ASSERT_EQ(gouging.size(), 1U);
  EXPECT_TRUE(gouging[0].starts_with("the tool leaves the pocket by 0.00")) << gouging[0];
  const auto rapid = alone(begin + "G0 X4\n" + round(3));
  ASSERT_EQ(rapid.size(), 1U);
  EXPECT_TRUE(rapid[0].ends_with(" mm of rapid motion meet material")) << rapid[0];
  const auto uncut = alone(kProgram);
  ASSERT_EQ(uncut.size(), 1U);
  EXPECT_NE(uncut[0].find(" places that the tool can reach stay uncut, the widest "), std::string::npos);
}

}  // namespace
}  // namespace lekalo::verify::verify_cut_report_test

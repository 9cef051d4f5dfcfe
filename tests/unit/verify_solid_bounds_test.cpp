// Results and certificates for solids at their very bounds: each case is true by a digit, or not.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "support/solid_results.hpp"
#include "support/verify_solids.hpp"
#include "verify/solid/certificate_tables.hpp"
#include "verify/solid/triangle_distance.hpp"

namespace lekalo::verify::verify_solid_bounds_test {
namespace {

using cases::block;
using cases::cube_in_cube;
using cases::Json;
using cases::one_leaf;
using cases::SolidResultFiles;

const std::string kBad = "bad input: result.json: ";

std::string told(const std::function<void(Json&)>& change) {
  SolidResultFiles files = cube_in_cube();
  change(files.result);
  return files.told();
}
bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// What is told of a result as a text, in which one piece is replaced by numbers that no double is.
std::string told_with(const SolidResultFiles& files, const std::string& from, const std::string& to) {
  std::string text = files.result.dump();
  EXPECT_NE(text.find(from), std::string::npos) << from << " in " << text;
  text.replace(text.find(from), from.size(), to);
  const auto made =
      verify_locate({{"result.json", text}, {"part.stl", files.part}, {"blank.stl", files.blank}, {}});
  if (!made) return "bad input: " + made.error().message;
  std::string all = made->verdict == Verdict::confirmed ? "confirmed" : "not confirmed";
  for (const std::string& finding : made->findings) all += "; " + finding;
  return all;
}

void sticks_out(Json& result) {
  result["inside"] = false, result["status"] = "infeasible";
  result["clearance"] = result["gap"] = result["shortfall"] = nullptr;
  result["contacts"] = Json::array();
}

// ---- fields ----------------------------------------------------------------------------------------------

TEST(SolidFields, NumbersFollowToTheLastDigitTheyAreComputedTo) {
  // 1e-15 of upper_bound and clearance together, here 2.5, is what rounding may have lost.
  SolidResultFiles bounded = cube_in_cube();
  bounded.result["status"] = "stopped", bounded.result["upper_bound"] = 1.5, bounded.result["gap"] = 0.25;
  const auto gap = [&](const std::string& value) {
    return told_with(bounded, R"("gap":0.25)", "\"gap\":" + value);
  };
  EXPECT_EQ(gap("0.5000000000000025"), "not confirmed");
  EXPECT_EQ(gap("0.4999999999999975"), "not confirmed");
  EXPECT_EQ(gap("0.50000000000000250001"), "not confirmed; gap is not upper_bound less clearance");
  // Nothing is missing at all, or it is.
  const auto shortfall = [](double demand, double value) {
    return told([&](Json& r) { r["min_allowance"] = demand, r["shortfall"] = value; });
  };
  EXPECT_EQ(shortfall(1, 0), "unproved");
  EXPECT_EQ(shortfall(1, 1e-16), "refuted; shortfall is not min_allowance less clearance");
  EXPECT_EQ(
      told([](Json& r) { r["clearance"] = -1; }),
      "refuted; clearance -1 is below 0, which no part in its blank has; shortfall is not min_allowance less "
      "clearance");
}

TEST(SolidFields, ListsAndLengthsEndAtTheirLimits) {
  for (const Json& list :
       {Json{1, 0, 0, 0, 0}, Json{1, 0, 0, "0"}, Json{1, 0, 0, 2e12}, Json(1), Json::array()})
    EXPECT_EQ(told([&](Json& r) { r["quaternion"] = list; }),
              kBad + "field quaternion is not a list of 4 numbers within 1e+12");
  EXPECT_EQ(told([](Json& r) { r["quaternion"] = {1e12, 0, 0, 0}; }), "unproved");
  EXPECT_TRUE(says(told([](Json& r) { r["x"] = 1e12; }), "refuted; "));
  EXPECT_EQ(told([](Json& r) { r["x"] = 1.0000001e12; }), kBad + "field x is beyond 1e+12 mm");
  for (const double degrees : {-1.0, 90.5, 179.5, 180.5})
    EXPECT_EQ(told([&](Json& r) { r["window"]["turn_deg"] = degrees; }),
              kBad + "field window.turn_deg is neither from 0 to 90 nor 180");
  EXPECT_EQ(told([](Json& r) { r["freedom"] = "six", r["window"]["turn_deg"] = 180; }), "unproved");
  EXPECT_EQ(told([](Json& r) { r["freedom"] = "six", r["window"]["turn_deg"] = 90; }), "unproved");
  EXPECT_EQ(told([](Json& r) { r["window"]["shift"] = 0; }), "unproved");
  EXPECT_EQ(told([](Json& r) { r["gap"] = 1e13; }), kBad + "a length is beyond all sizes");
}

TEST(SolidFields, OneFileOfEachRoleIsNamed) {
  const auto with = [](const char* role) {
    return told([&](Json& r) { r["inputs"].push_back(r["inputs"][0]), r["inputs"][2]["role"] = role; });
  };
  EXPECT_EQ(with("part"), kBad + "inputs name 2 part and 1 blank, not one each");
  EXPECT_EQ(with("blank"), kBad + "inputs name 1 part and 2 blank, not one each");
}

TEST(SolidFields, WhatIsNotReadOfEitherFileIsIncomplete) {
  for (const bool part : {false, true}) {
    SolidResultFiles files = cube_in_cube();
    (part ? files.part : files.blank) = "ISO-10303-21;";
    EXPECT_EQ(files.told(), "incomplete");
    ASSERT_TRUE(files.report());
    EXPECT_EQ(files.report()->notes.size(), 1U);
    EXPECT_EQ(files.report()->clearance_low, "");
  }
}

TEST(SolidFields, ContactsMayBeOffByAShareOfTheLongestExtentOfTheBlank) {
  const auto with = [](double length, double off) {
    SolidResultFiles files = cube_in_cube();
    files.blank = solid_files::stl_binary(block({-6, -6, -length / 2}, {6, 6, length / 2}));
    files.result["contacts"][0]["part_point"] = {5 + off, 1, -1};
    files.result["contacts"][0]["blank_triangle"] = 11;
    files.result["contacts"][0]["distance"] = 1 - off;
    return files.told();
  };
  EXPECT_EQ(with(2000, 0.0019), "unproved");
  EXPECT_TRUE(says(with(2000, 0.0021), "part_point is not on triangle 10"));
  EXPECT_TRUE(says(with(12, 0.0000125), "part_point is not on triangle 10"));
  // A blank of less than a millimetre is read as if it were one.
  SolidResultFiles small = cube_in_cube();
  small.part = solid_files::stl_binary(block({-0.125, -0.125, -0.125}, {0.125, 0.125, 0.125}));
  small.blank = solid_files::stl_binary(block({-0.25, -0.25, -0.25}, {0.25, 0.25, 0.25}));
  small.result["clearance"] = 0.125;
  Json& contact = small.result["contacts"][0];
  contact["part_point"] = {0.1250009, 0.05, -0.05}, contact["blank_point"] = {0.25, 0.05, -0.05};
  contact["distance"] = 0.125;
  EXPECT_EQ(small.told(), "unproved");
  contact["part_point"][0] = 0.1250011;
  EXPECT_TRUE(says(small.told(), "part_point is not on triangle 10"));
}

TEST(SolidFields, AContactMayBeOffByExactlyTheTolerance) {
  SolidResultFiles files = cube_in_cube();
  files.part = solid_files::stl_binary(block({0, -5, -5}, {10, 5, 5}));
  files.blank = solid_files::stl_binary(block({-1, -6, -6}, {11, 6, 6}));
  files.result["contacts"][0]["part_point"] = {0.123, 1, -1};
  files.result["contacts"][0]["part_triangle"] = 9;
  const double slack = 1e-6 * 12.0;
  const Triangle3 face{
      {{just(0), just(5), just(-5)}, {just(0), just(-5), just(5)}, {just(0), just(5), just(5)}}};
  const auto told_at = [&](double off) {
    return told_with(files, "0.123", fmt::format("{:.99f}", off));  // to the last digit of the double
  };
  const auto is_at_the_bound = [&](double off) {
    const Vec3 p{just(off), just(1), just(-1)};
    return distance({p, p, p}, face).low == slack;
  };
  double off = slack;
  for (int k = 0; k < 100 && !is_at_the_bound(off); ++k) off = step_up(off);
  ASSERT_TRUE(is_at_the_bound(off));
  EXPECT_FALSE(says(told_at(off), "part_point is not on triangle")) << told_at(off);
  for (int k = 0; k < 5; ++k) off = step_up(off);
  EXPECT_TRUE(says(told_at(off), "part_point is not on triangle")) << told_at(off);
}

TEST(SolidFields, AContactIsOnATriangleThatCounts) {
  SolidResultFiles files = cube_in_cube();
  std::string text = solid_files::obj(block({-5, -5, -5}, {5, 5, 5}));
  text.insert(text.find("f "), "f 1 1 2\n");
  files.part = text;
  files.result["inputs"][0]["triangles"] = 13, files.result["contacts"][0]["part_triangle"] = 11;
  EXPECT_EQ(files.told(), "unproved");
  files.result["contacts"][0]["part_triangle"] = 0;
  EXPECT_EQ(files.told(), "refuted; contact 0: part_point is not on triangle 0 of the part");
}

// ---- scans -----------------------------------------------------------------------------------------------

/// Widths of exactly 0.5, so that the best clearance is 0.5.
SolidResultFiles scanned(const Json& certificate = nullptr, double bound = 0.5) {
  SolidResultFiles files = cube_in_cube(certificate, bound, "xyz", 0);
  Json& r = files.result;
  r["scan"] = cases::scan_by_dip(0.25, 0.25, 0.5);
  r["clearance"] = 0.5, r["contacts"][0]["distance"] = 0.5;
  if (!certificate.is_null()) r["gap"] = bound - 0.5;
  return files;
}
std::string scan_told(const std::function<void(Json&)>& change) {
  SolidResultFiles files = scanned();
  change(files.result);
  return files.told();
}

TEST(SolidScan, WhatIsSaidOfItMayBeOffByTheToleranceOfReading) {
  EXPECT_EQ(scanned().told(), "unproved");
  const auto widest = [](double value) { return scan_told([&](Json& r) { r["scan"]["widest"] = value; }); };
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(widest(0.5 + sign * 1e-6), "unproved");
    EXPECT_TRUE(says(widest(0.5 + sign * 1.1e-6), "refuted; scan.widest is"));
  }
  const auto area = [](double value) {
    return scan_told([&](Json& r) {
      r["scan"]["max_dip"] = nullptr, r["scan"]["min_radius"] = 8, r["scan"]["widest"] = 0.25;
      r["scan"]["unknown_triangles"] = 12, r["scan"]["proved"] = false, r["unknown_area_mm2"] = value;
    });
  };
  EXPECT_FALSE(says(area(864.0008), "unknown_area_mm2"));
  EXPECT_TRUE(says(area(864.0009), "unknown_area_mm2 is 864.0009, but 864"));
  EXPECT_TRUE(says(scan_told([](Json& r) { r["contacts"][0]["distance"] = 0.75; }),
                   "mm apart but for the width of the blank's triangle, not 0.75"));
}

TEST(SolidScan, ItsSentencesAreTexts) {
  const auto with = [](Json list) { return scan_told([&](Json& r) { r["scan"]["assumptions"] = list; }); };
  EXPECT_EQ(with(Json::array({1})), kBad + "scan.assumptions is without a sentence");
  EXPECT_EQ(with(Json::array({1, "it is so"})), "unproved");
}

TEST(SolidScan, OneUnknownTriangleLeavesItIncomplete) {
  // The base of a low pyramid has a circle of 10, its sides of 8.7.
  SolidResultFiles files = cube_in_cube();
  const double s = std::sqrt(75.0);
  solid::Mesh low;
  low.vertices = {{10, 0, 0}, {-5, s, 0}, {-5, -s, 0}, {0, 0, 0.5}};
  low.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  files.blank = solid_files::ply<double>(low, solid_files::PlyForm::little);
  Json& r = files.result;
  sticks_out(r);
  r["status"] = "unproved";
  r["inputs"][1]["triangles"] = 4;
  r["scan"] = {{"guard", 0},
               {"min_radius", 9.5},
               {"max_dip", nullptr},
               {"underside", nullptr},
               {"widest", 9.5 - std::sqrt(9.5 * 9.5 - 75)},
               {"unknown_triangles", 1},
               {"proved", false},
               {"left_out", Json::array()},
               {"assumptions", {"it is so"}}};
  r["unknown_area_mm2"] = 7.5 * 2 * s;
  r["unknown_area_mm2"] = 15 * s;
  EXPECT_EQ(files.told(), "incomplete");
}

TEST(SolidScan, ABallMayReachExactlyThroughTheWidth) {
  const auto at = [](double in, double radius) {
    return scanned(one_leaf(Json::array({{"ball", 0, 0, 1}, {"ball", 0, 1, 1}}), Json::array({{0, 0, 0, 5}}),
                            Json::array({{6 - in, 0, 0, radius}, {in - 6, 0, 0, radius}}), Json::array(), 0))
        .told();
  };
  EXPECT_EQ(at(0, 0.5), "confirmed");
  EXPECT_EQ(at(0.25, 0.25), "confirmed");
  EXPECT_EQ(at(-0.5, 1), "confirmed");
  EXPECT_TRUE(says(at(0, 0.5000000000000001), "less its width"));
  EXPECT_TRUE(says(at(0.25, 0.25000000000000006),
                   "blank_balls[0] is not what it has to be: its centre is in the blank"));
  EXPECT_TRUE(says(at(-0.5, 1.0000000000000002), "less its width"));
}

TEST(SolidScan, ABallMayLieInOneOfTwoWidths) {
  // The triangles below are 0.25 wide, those beside them 0.5.
  SolidResultFiles files = scanned(one_leaf(Json::array({{"ball", 0, 0, 1}}), Json::array({{0, 0, 0, 5}}),
                                            Json::array({{6, 0, -6, 0.5}}), Json::array(), 0));
  files.result["scan"]["underside"] = {{"z", -6}, {"flat", 0.25}};
  EXPECT_FALSE(says(files.told(), "blank_balls"));
  files.result["certificate"]["blank_balls"][0][3] = 0.5000000000000001;
  EXPECT_TRUE(says(files.told(), "blank_balls[0] is not what it has to be: triangle"));
}

// ---- certificates ----------------------------------------------------------------------------------------

Json by_planes() {
  return one_leaf(Json::array({{"plane", 0, 0, 1}, {"plane", 1, 1, 1}}),
                  Json::array({{-5, -5, -5, 0}, {5, -5, -5, 0}}), Json::array(),
                  Json::array({{1, 0, 0, -6}, {-1, 0, 0, -6}}));
}

TEST(SolidBounds, ARootThatIsNoFractionIsRoundedToTheSafeSide) {
  // Along (1, 1, 0) the part is the root of 2 from the half-spaces, on both sides.
  const std::string below = "1.414213562373095048801688724209698078569671875376948073176",
                    above = "1.414213562373095048801688724209698078569671875376948073177",
                    well_below = "1.41421356237309504880168872420969807",
                    well_above = "1.41421356237309504880168872420969808";
  const auto along = [](double half, double bound) {
    SolidResultFiles files = cube_in_cube(by_planes(), bound);
    Json& c = files.result["certificate"];
    c["planes"] = Json::array({{1, 1, 0, -12}, {-1, -1, 0, -12}});
    c["part_balls"] = Json::array({{-half, -half, -5, 0}, {half, half, 5, 0}});
    return files;
  };
  SolidResultFiles files = along(5, 0.12345);
  files.result["gap"] = 0.75;
  const std::string bound_text = R"("upper_bound":0.12345)";
  const auto with = [&](const SolidResultFiles& of, const std::string& bound) {
    return told_with(of, bound_text, R"("upper_bound":)" + bound);
  };
  EXPECT_FALSE(says(with(files, well_above), "do not prove"));
  EXPECT_TRUE(says(with(files, below), "do not prove"));
  files = along(7, 0.12345);
  files.part = solid_files::stl_binary(block({-7, -7, -7}, {7, 7, 7}));
  sticks_out(files.result);
  EXPECT_EQ(with(files, "-" + well_below), "confirmed");
  EXPECT_TRUE(says(with(files, "-" + above), "do not prove"));
}

TEST(SolidBounds, ABallInTheMiddleOfAnotherIsBoundedAsFromOneMillimetre) {
  // With the balls on each other at the only pose, |w| <= (|w|^2 + 1) / 2 leaves 0.5 - 0.25 - 1.5 - bound.
  const auto with = [](double bound) {
    SolidResultFiles files =
        cube_in_cube(one_leaf(Json::array({{"ball", 0, 0, 1}}), Json::array({{0, 0, 0, 0.25}}),
                              Json::array({{0, 0, 0, 1.5}}), Json::array(), 0),
                     bound, "xyz", 0);
    solid::Mesh blank = block({-6, -6, -6}, {6, 6, 6});
    cases::append(blank, block({-2, -2, -2}, {2, 2, 2}));
    files.blank = solid_files::stl_binary(blank);
    files.result["inputs"][1]["triangles"] = 24;
    sticks_out(files.result);
    return files.told();
  };
  EXPECT_EQ(with(-1), "confirmed");
  EXPECT_EQ(with(-1.25), "confirmed");
  EXPECT_TRUE(says(with(-1.2500001), "do not prove"));
}

TEST(SolidBounds, OnlyTheFirstLeavesThatFailAreNamed) {
  Json certificate = by_planes();
  Json leaf = certificate["trees"][0]["nodes"][0];
  leaf.erase(std::size_t{1});
  Json nodes = Json::array();
  for (int k = 0; k < 5; ++k) nodes.push_back(Json::array({"x", 0.25})), nodes.push_back(leaf);
  nodes.push_back(leaf);
  for (int k = 0; k < 5; ++k) nodes[static_cast<std::size_t>(2 * k)][1] = -0.4 + 0.1 * k;
  certificate["trees"][0]["nodes"] = nodes;
  // Each leaf has the half-space at x = -6 alone, and 1 + x for what is above it.
  const auto report = cube_in_cube(certificate, 0.1).report();
  ASSERT_TRUE(report);
  std::vector<std::string> named;
  for (const std::string& finding : report->findings)
    if (says(finding, "do not prove")) named.push_back(finding.substr(0, finding.find(':')));
  EXPECT_EQ(named, (std::vector<std::string>{"certificate.trees[0].nodes[1]", "certificate.trees[0].nodes[3]",
                                             "certificate.trees[0].nodes[5]"}));
}

TEST(SolidBounds, ATermWithoutItsBallIsNone) {
  // The first term is of a thing that is not what it has to be, the second one proves the bound alone.
  const auto with = [](Json bad, Json good, double bound, bool twice) {
    Json certificate = by_planes();
    certificate["part_balls"].push_back({100, 0, 0, 1});
    certificate["blank_balls"] = Json::array({{0, 0, 0, 1}, {16, 0, 0, 10}});
    certificate["planes"].push_back({1, 0, 0, 0});
    const Json leaf = Json::array({bad, good});
    certificate["trees"][0]["nodes"] =
        twice ? Json::array({Json::array({"x", 0}), leaf, leaf}) : Json::array({leaf});
    SolidResultFiles files = cube_in_cube(certificate, bound);
    return files.told();
  };
  const Json good{"plane", 1, 1, 1};
  for (const auto& [bad, sentence] :
       {std::pair(Json{"plane", 2, 0, 1},
                  "part_balls[2] is not what it has to be: its centre is not in the part"),
        {Json{"ball", 2, 1, 1}, "part_balls[2] is not what it has to be: its centre is not in the part"},
        {Json{"face", 2, 0, 1}, "part_balls[2] is not what it has to be: its centre is not in the part"},
        {Json{"ball", 0, 0, 1}, "blank_balls[0] is not what it has to be: its centre is in the blank"},
        {Json{"part_face", 0, 0, 1}, "blank_balls[0] is not what it has to be: its centre is in the blank"},
        {Json{"plane", 0, 2, 1},
         "planes[2] is not what it has to be: a corner of the blank's triangle 0 is not in it"}})
    for (const bool twice : {false, true})
      EXPECT_EQ(with(bad, good, 1.5, twice), std::string("refuted; certificate.") + sentence) << bad;
  // What is left may prove nothing, of which the first leaf is silent.
  const Json poor{"plane", 0, 0, 1};
  EXPECT_EQ(with({"plane", 2, 0, 1}, poor, 1.25, false),
            "refuted; certificate.part_balls[2] is not what it has to be: its centre is not in the part");
  EXPECT_TRUE(says(with({"plane", 2, 0, 1}, poor, 1.25, true), "nodes[2]: its terms do not prove"));
}

TEST(SolidBounds, TermsAreReadWhole) {
  const auto with = [](Json term) {
    Json certificate = by_planes();
    certificate["trees"][0]["nodes"][0] = Json::array({std::move(term)});
    return cube_in_cube(certificate, 2).told();
  };
  const std::string none = kBad + "certificate.trees[0].nodes[0] has a term that is none";
  for (const Json& term :
       {Json{"plane", "0", 0, 1}, Json{"plane", 0, nullptr, 1}, Json{"plane", 0, 0, 1.1e12},
        Json{"plane", 0, 0, nullptr}, Json{nullptr, 0, 0, 1}, Json{true, 0, 0, 1}})
    EXPECT_EQ(with(term), none) << term;
  EXPECT_EQ(with({"plane", 0, 0, 1e12}), "confirmed");
  EXPECT_EQ(with({"plane", 1.0, 1e0, 1}), "confirmed");
  Json certificate = by_planes();
  const Json term = certificate["trees"][0]["nodes"][0][0];
  certificate["trees"][0]["nodes"][0] = std::vector<Json>(64, term);
  EXPECT_EQ(cube_in_cube(certificate, 2).told(), "confirmed");
  for (const Json& place : {Json("0"), Json(nullptr), Json(true), Json::array({0})}) {
    certificate["trees"][0]["nodes"][0] = Json::array({"x", place});
    EXPECT_EQ(cube_in_cube(certificate, 2).told(),
              kBad + "certificate.trees[0].nodes[0] is neither a split nor a leaf")
        << place;
  }
}

TEST(SolidBounds, BallsOfNoRadiusArePointsToo) {
  const auto with = [](const char* path, Json ball) {
    Json certificate = one_leaf(Json::array({{"ball", 0, 0, 1}}), Json::array({{0, 0, 0, 0}}),
                                Json::array({{6, 0, 0, 0}}), Json::array());
    certificate.at(path) = std::move(ball);
    return cube_in_cube(certificate, 20).told();
  };
  EXPECT_EQ(with("/part_balls/0", {0, 0, 0, 0}), "confirmed");
  for (const double x : {5.0, -5.0}) {
    EXPECT_EQ(with("/part_balls/0", {x, 1, 2, 0}), "confirmed");
    EXPECT_EQ(with("/blank_balls/0", {x * 1.2, 1, 2, 0}), "confirmed");
  }
  for (const Json& in : {Json{0, 0, 0, 0}, Json{1, 2, 3, 0}, Json{5.999999, 0, 0, 0}})
    EXPECT_EQ(with("/blank_balls/0", in),
              "refuted; certificate.blank_balls[0] is not what it has to be: its centre is in the blank");
  EXPECT_EQ(with("/part_balls/0", {9, 0, 0, 0}),
            "refuted; certificate.part_balls[0] is not what it has to be: its centre is not in the part");
}

/// What is told of half-spaces at the ends of a blank whose extents all differ, so that no axis stands for
/// another.
void expect_half_spaces(const std::array<double, 3>& low, const std::array<double, 3>& high) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const double level = sign > 0 ? low[axis] : -high[axis];
      const auto with = [&](double at) {
        SolidResultFiles files = cube_in_cube(by_planes(), 20);
        files.blank = solid_files::ply<double>(block({low[0], low[1], low[2]}, {high[0], high[1], high[2]}),
                                               solid_files::PlyForm::little);
        files.result["contacts"] = Json::array(), files.result["gap"] = 19;
        Json normal{0, 0, 0, at};
        normal[axis] = sign;
        Json& c = files.result["certificate"];
        c["planes"] = Json::array({normal});
        c["trees"][0]["nodes"][0] = Json::array({{"plane", 0, 0, 1}});
        return files.told();
      };
      EXPECT_FALSE(says(with(level), "planes[0]")) << axis << sign << with(level);
      EXPECT_FALSE(says(with(level - 1), "planes[0]")) << axis << sign;
      EXPECT_TRUE(says(with(std::nextafter(level, 0)), "a corner of the blank's triangle")) << axis << sign;
      EXPECT_TRUE(says(with(level + 1), "a corner of the blank's triangle")) << axis << sign;
      EXPECT_TRUE(says(with(level + 20), "a corner of the blank's triangle")) << axis << sign;
    }
}

TEST(SolidBounds, AHalfSpaceHoldsEachCornerOfTheBlank) {
  expect_half_spaces({-6, -13, -27}, {28, 14, 7});
  expect_half_spaces({-27, -13, -6}, {7, 14, 28});
}

/// A block whose faces are divided into squares of two triangles.
solid::Mesh fine_block(double half, int count) {
  solid::Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-half, half})
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; ++j) {
          const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
          for (const int k : {0, 1, 2, 3}) {
            const double u = half * (2.0 * (i + k % 2) / count - 1),
                         v = half * (2.0 * (j + k / 2) / count - 1);
            mesh.vertices.push_back(axis == 0   ? solid::Vector{side, u, v}
                                    : axis == 1 ? solid::Vector{u, side, v}
                                                : solid::Vector{u, v, side});
          }
          mesh.triangles.push_back({first, first + 1, first + 2});
          mesh.triangles.push_back({first + 1, first + 3, first + 2});
        }
  return mesh;
}

/// What is far from a ball or from a half-space is not looked at one by one.
TEST(SolidBounds, BallsAndHalfSpacesOfAFineBlankTakeLittleWork) {
  Json balls = Json::array(), planes = Json::array();
  for (int k = 0; k < 30; ++k) {
    balls.push_back({16, 0, 0.001 * k, 9.999});
    planes.push_back({1, 0.001 * k, 0.002 * k, -6.5 - 0.1 * k});
  }
  for (int k = 0; k < 30; ++k) balls.push_back({6.5, 0.3, 0.05 * k, 0.4});
  const std::string text =
      Json{{"part_balls", Json::array()}, {"blank_balls", balls}, {"planes", planes}}.dump();
  const SolidMesh part = cases::checked(block({-5, -5, -5}, {5, 5, 5})),
                  blank = cases::checked(fine_block(6, 16));
  std::vector<std::string> findings;
  std::string complaint;
  const std::vector<SolidDatum> datums;
  CertificateTables tables(*parse_json(text, "tables"), part, blank, datums, findings, complaint);
  const auto takes_at_most = [](std::size_t work, const auto& act) {
    RunControl run;
    run.work_limit = work;
    return stoppable(run, [&] { return act(), true; }).has_value();
  };
  EXPECT_TRUE(takes_at_most(300, [&] {
    for (std::size_t k = 0; k < 30; ++k) EXPECT_NE(tables.blank_ball(k), nullptr);
  }));
  EXPECT_TRUE(takes_at_most(250, [&] {
    for (std::size_t k = 30; k < 60; ++k) EXPECT_NE(tables.blank_ball(k), nullptr);
  }));
  EXPECT_TRUE(takes_at_most(250, [&] {
    for (std::size_t k = 0; k < 30; ++k) EXPECT_NE(tables.plane(k), nullptr);
  }));
  EXPECT_EQ(complaint, "");
}

TEST(SolidBounds, ACertificateStandsInOnePlace) {
  // What stands in the result counts, whatever else is given.
  SolidResultFiles files = cube_in_cube(by_planes());
  files.certificate = "none";
  EXPECT_EQ(files.told(), "confirmed");
  EXPECT_TRUE(files.report()->notes.empty());
  const Json certificate = files.result["certificate"];
  files.result["certificate"] = nullptr;
  files.result["certificate_file"] = {{"path", "c.json"}, {"sha256", ""}, {"boxes", 1}};
  const auto named = [&](const char* name, int version) {
    files.certificate =
        Json{{"format", {{"name", name}, {"version", version}}}, {"certificate", certificate}}.dump();
    return files.told();
  };
  EXPECT_EQ(named("lekalo-certificate", 1), "confirmed");
  for (const auto& [name, version] : {std::pair("lekalo-locate", 1), {"lekalo-certificate", 2}, {"", 1}})
    EXPECT_EQ(named(name, version),
              "bad input: certificate.json: field format does not say lekalo-certificate, version 1");
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_bounds_test

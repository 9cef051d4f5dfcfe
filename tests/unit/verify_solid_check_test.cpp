// What the checker says of results for solids without a certificate, field by field.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

#include "support/solid_results.hpp"

namespace lekalo::verify::verify_solid_check_test {
namespace {

using cases::cube_in_cube;
using cases::Json;
using cases::SolidResultFiles;

std::string told(const std::function<void(Json&)>& change) {
  SolidResultFiles files = cube_in_cube();
  change(files.result);
  return files.told();
}
std::string with(const std::string& path, const Json& value) {
  return told([&](Json& r) {
    const std::size_t slash = path.rfind('/');
    if (slash == 0)
      r[path.substr(1)] = value;
    else
      r.at(path) = value;
  });
}

TEST(SolidCheck, AResultWithoutACertificateIsUnproved) {
  EXPECT_EQ(cube_in_cube().told(), "unproved");
  const auto report = cube_in_cube().report();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->bound_high, "");
  EXPECT_LE(std::stod(report->clearance_low), 1);
  EXPECT_GE(std::stod(report->clearance_high), 1);
  EXPECT_GE(std::stod(report->clearance_low), 1 - 1e-12);
}

TEST(SolidCheck, TheClearanceIsHeldAgainstTheMeshes) {
  EXPECT_EQ(told([](Json& r) { r["clearance"] = 0.5; }), "unproved");
  const std::string above = told([](Json& r) { r["clearance"] = 1.0000000000000002; });
  EXPECT_EQ(above.find("refuted; triangle "), 0U) << above;
  EXPECT_NE(above.find("is nearer than the clearance"), std::string::npos) << above;
  EXPECT_EQ(with("/x", 0.25).find("refuted; "), 0U);
  EXPECT_EQ(told([](Json& r) { r["x"] = 0.25, r["clearance"] = 0.75, r["contacts"] = Json::array(); }),
            "unproved");
  EXPECT_EQ(with("/clearance", -1).find("refuted; "), 0U);
}

TEST(SolidCheck, WhatIsNotInsideHasNoClearance) {
  const auto outside = [](Json& r) {
    r["x"] = 3, r["window"]["x"] = 3, r["inside"] = false,
    r["clearance"] = r["gap"] = r["shortfall"] = nullptr;
    r["contacts"] = Json::array();
  };
  EXPECT_EQ(told(outside), "unproved");
  EXPECT_EQ(told([&](Json& r) { outside(r), r["x"] = r["window"]["x"] = 0.25; }),
            "refuted; inside is false, but the part lies in the blank");
  EXPECT_EQ(told([&](Json& r) { outside(r), r["inside"] = true; }).find("refuted; "), 0U);
  EXPECT_EQ(told([&](Json& r) { outside(r), r["clearance"] = 0.5; }),
            "refuted; inside is false, but there is a clearance; shortfall is null");
  EXPECT_EQ(told([&](Json& r) { outside(r), r["shortfall"] = 0; }),
            "refuted; there is a shortfall, but no clearance");
  // A part that touches is not inside.
  EXPECT_EQ(told([&](Json& r) { outside(r), r["x"] = r["window"]["x"] = 1; }), "unproved");
  EXPECT_EQ(told([&](Json& r) {
              outside(r), r["x"] = r["window"]["x"] = 1;
              r["inside"] = true, r["clearance"] = r["shortfall"] = 0;
            }),
            "refuted; inside is true, but the part touches the blank's surface");
}

TEST(SolidCheck, NumbersThatFollowFromOthersAreHeldAgainstThem) {
  const auto bounded = [](Json& r) { r["status"] = "stopped", r["upper_bound"] = 1.5, r["gap"] = 0.5; };
  EXPECT_EQ(told(bounded), "unproved");
  EXPECT_EQ(told([&](Json& r) { bounded(r), r["gap"] = 0.4; }),
            "refuted; gap is not upper_bound less clearance");
  EXPECT_EQ(told([&](Json& r) { bounded(r), r["gap"] = nullptr; }), "refuted; gap is null");
  EXPECT_EQ(told([&](Json& r) { bounded(r), r["upper_bound"] = 0.5, r["gap"] = -0.5; }),
            "refuted; upper_bound 0.5 is below clearance 1");
  EXPECT_EQ(with("/gap", 0.5), "refuted; there is a gap, but not both a clearance and an upper_bound");
  EXPECT_EQ(with("/shortfall", 0.5), "refuted; shortfall is not min_allowance less clearance");
  EXPECT_EQ(with("/min_allowance", 2), "refuted; shortfall is not min_allowance less clearance");
  EXPECT_EQ(told([&](Json& r) { r["min_allowance"] = 2, r["shortfall"] = 1; }), "unproved");
  EXPECT_EQ(with("/shortfall", nullptr), "refuted; shortfall is null");
  EXPECT_EQ(with("/unknown_area_mm2", 0.1),
            "refuted; unknown_area_mm2 is 0.1, but all of a closed mesh is known");
}

TEST(SolidCheck, AStatusFollowsFromTheBound) {
  EXPECT_EQ(with("/status", "optimal"), "refuted; status is optimal, but there is no upper_bound");
  const auto infeasible = [](Json& r) {
    r["status"] = "infeasible", r["upper_bound"] = 1.5, r["gap"] = 0.5, r["min_allowance"] = 2;
    r["shortfall"] = 1;
  };
  EXPECT_EQ(told(infeasible), "unproved");
  EXPECT_EQ(told([&](Json& r) { infeasible(r), r["status"] = "optimal"; }),
            "refuted; status is optimal, but upper_bound 1.5 is below min_allowance 2");
  EXPECT_EQ(told([&](Json& r) { infeasible(r), r["min_allowance"] = 1.5, r["shortfall"] = 0.5; }),
            "refuted; status is infeasible, but upper_bound 1.5 is not below min_allowance 1.5");
  EXPECT_EQ(with("/status", "fine").find("bad input: result.json: field status is \"fine\", not "), 0U);
}

TEST(SolidCheck, ThePoseIsInTheWindow) {
  const auto shifted = [](double by) {
    return [by](Json& r) { r["z"] = by, r["clearance"] = 0.4, r["contacts"] = Json::array(); };
  };
  EXPECT_EQ(told(shifted(0.5)), "unproved");
  EXPECT_EQ(told(shifted(0.5000000000000001)), "unproved");  // a rounding
  EXPECT_EQ(told(shifted(0.500001)),
            "refuted; the placement is not in the window: the pivot's z is 0.500001 mm from its place at the "
            "start, more than 0.5");
  // The pivot is what may move so far: a turn about another place than its own moves it.
  EXPECT_EQ(told([&](Json& r) { shifted(0.5)(r), r["window"]["pivot"][0] = 100; }), "unproved");
  const auto turned = [](const char* freedom, double degrees, Json quaternion) {
    return [=](Json& r) {
      r["freedom"] = freedom, r["window"]["turn_deg"] = degrees, r["quaternion"] = quaternion;
      r["clearance"] = 0.4, r["contacts"] = Json::array();
    };
  };
  const double t = std::tan(3 * std::numbers::pi / 180 / 2);
  EXPECT_EQ(told(turned("c-xyz", 3, {2, 0, 0, 2 * t})), "unproved");
  EXPECT_EQ(told(turned("c-xyz", 3, {-1, 0, 0, t})), "unproved");
  EXPECT_EQ(told(turned("six", 3, {1, t, -t, t})), "unproved");
  for (const auto& change : {turned("c-xyz", 3, {1, 0, 0, 1.000001 * t}), turned("c-xyz", 3, {1, 1e-9, 0, t}),
                             turned("c-xyz", 3, {1, 0, -1e-9, t}), turned("six", 3, {1, 0, -1.000001 * t, 0}),
                             turned("xyz", 3, {1, 0, 0, 1e-15}), turned("c-xyz", 90, {0, 0, 0, 1}),
                             turned("c-xyz", 0, {1, 0, 0, 1e-9})})
    EXPECT_EQ(told(change).find("refuted; the placement is not in the window: its rotation"), 0U)
        << told(change);
  EXPECT_EQ(told(turned("c-xyz", 90, {1, 0, 0, 1})), "unproved");
  // What is a rounding where the start is tilted.
  EXPECT_EQ(told([&](Json& r) { turned("c-xyz", 3, {1, 1e-16, 0, t})(r); }), "unproved");
  // The rotation is counted from the start's.
  EXPECT_EQ(told([&](Json& r) {
              turned("xyz", 0, {5, 0, 0, 5})(r);
              r["window"]["quaternion"] = {1, 0, 0, 1};
            }),
            "unproved");
}

TEST(SolidCheck, ContactsLieOnTheirTriangles) {
  EXPECT_EQ(with("/contacts/0/part_triangle", 0),
            "refuted; contact 0: part_point is not on triangle 0 of the part");
  EXPECT_EQ(with("/contacts/0/blank_triangle", 12),
            "refuted; contact 0: blank_point is not on triangle 12 of the blank");
  EXPECT_EQ(with("/contacts/0/distance", 1.1).find("refuted; contact 0: the points are "), 0U);
  EXPECT_EQ(with("/contacts/0/blank_point/0", 6.5).find("refuted; contact 0: blank_point"), 0U);
  EXPECT_EQ(with("/contacts/0/part_point/0", 5.000001), "unproved");
  EXPECT_EQ(with("/contacts/0/multiplier", "1").find("bad input: "), 0U);
}

TEST(SolidCheck, FilesHaveTheirUnitAndTheirTriangles) {
  EXPECT_EQ(with("/inputs/0/triangles", 11),
            "refuted; the part is said to have 11 triangles, but part.stl has 12");
  EXPECT_EQ(with("/inputs/1/units", "yard"),
            "bad input: result.json: field inputs[1].units is \"yard\", not \"mm\", \"inch\", \"m\", "
            "\"micron\", \"cm\", \"foot\"");
  EXPECT_EQ(told([](Json& r) { r["inputs"][1]["role"] = "part"; }),
            "bad input: result.json: inputs name 2 part and 0 blank, not one each");
  // A text in inches, to the last digit: half edges of 5 in 5.25 inches.
  SolidResultFiles files = cube_in_cube();
  files.part = solid_files::stl_text(cases::block({-5, -5, -5}, {5, 5, 5}));
  files.blank = solid_files::stl_text(cases::block({-5.25, -5.25, -5.25}, {5.25, 5.25, 5.25}));
  files.result["contacts"] = Json::array();
  for (const auto& [unit, clearance] : {std::pair{"inch", 6.35}, {"m", 250.0}, {"mm", 0.25}}) {
    for (const int file : {0, 1}) files.result["inputs"][file]["units"] = unit;
    files.result["clearance"] = clearance;
    EXPECT_EQ(files.told(), "unproved") << unit;
    files.result["clearance"] = std::nextafter(clearance, 1000);
    EXPECT_EQ(files.told().find("refuted; "), 0U) << unit << files.told();
  }
  // Doubles in inches are no doubles in millimetres.
  files.part = solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}));
  files.blank = solid_files::stl_binary(cases::block({-5.25, -5.25, -5.25}, {5.25, 5.25, 5.25}));
  for (const int file : {0, 1}) files.result["inputs"][file]["units"] = "inch";
  files.result["clearance"] = 6.35;
  EXPECT_EQ(files.told(), "unproved");
}

TEST(SolidCheck, AFileHasARoleAndAStartSaysNothingElse) {
  const auto with_input = [](Json input) {
    SolidResultFiles files = cube_in_cube();
    files.result["inputs"].push_back(std::move(input));
    return files.told();
  };
  const Json start({{"role", "start"}, {"path", "s.json"}, {"sha256", ""}});
  EXPECT_EQ(with_input(start), "unproved");
  Json other = start;
  other["role"] = "stop";
  EXPECT_EQ(with_input(other),
            "bad input: result.json: field inputs[2].role is \"stop\", not \"part\", \"blank\", \"start\", "
            "\"points\", \"nominal\", \"features\", \"nc\", \"allow\"");
  for (const char* key : {"units", "triangles", "points"}) {
    other = start;
    other[key] = 12;
    EXPECT_EQ(
        with_input(other),
        fmt::format("bad input: result.json: field inputs[2].{} is said of the file of the role start", key));
  }
}

TEST(SolidCheck, WhatItDoesNotReadIsIncomplete) {
  SolidResultFiles files = cube_in_cube();
  files.blank = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
  EXPECT_EQ(files.told(), "incomplete");
  const auto report = files.report();
  ASSERT_TRUE(report);
  EXPECT_EQ(
      report->notes.front(),
      "what is said of the blank was not rechecked: blank.stl is not read here, because the face on line 5 "
      "has 4 corners, and only triangles are read");
  files.blank = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  EXPECT_EQ(files.told().find("bad input: blank.stl: the surface is open"), 0U) << files.told();
}

TEST(SolidCheck, EveryFieldIsThereOnceAndKnown) {
  const SolidResultFiles files = cube_in_cube();
  for (const std::string& key : files.result.keys()) {
    if (key == "quaternion") continue;  // without it this is no result for solids
    SolidResultFiles less = files;
    less.result.erase(key);
    EXPECT_EQ(less.told().find("bad input: result.json: "), 0U) << key << ": " << less.told();
  }
  for (const char* parent : {"window", "contacts/0", "inputs/0"})
    for (const std::string& key : files.result.at(std::string("/") + parent).keys()) {
      if (key == "path" || key == "sha256") continue;  // who reads the files looks at these
      SolidResultFiles less = files;
      less.result.at(std::string("/") + parent).erase(key);
      EXPECT_EQ(less.told().find("bad input: result.json: "), 0U) << parent << key << ": " << less.told();
    }
  EXPECT_EQ(with("/theta", 1), "bad input: result.json: field theta is not one of a placement of solids");
  EXPECT_EQ(with("/window/free", 1),
            "bad input: result.json: field window.free is not one of a placement of solids");
  EXPECT_EQ(with("/quaternion", {0, 0, 0, 0}),
            "bad input: result.json: field quaternion is 0, which is no rotation");
  EXPECT_EQ(with("/quaternion", {1, 0, 0}),
            "bad input: result.json: field quaternion is not a list of 4 numbers within 1e+12");
  EXPECT_EQ(with("/x", 1e13), "bad input: result.json: field x is beyond 1e+12 mm");
  EXPECT_EQ(with("/window/turn_deg", 91),
            "bad input: result.json: field window.turn_deg is neither from 0 to 90 nor 180");
  EXPECT_EQ(with("/window/shift", -1), "bad input: result.json: field window.shift is below 0");
  EXPECT_EQ(with("/inside", "true"), "bad input: result.json: field inside is neither true nor false");
  for (const char* key : {"certificate", "offset"})
    for (const Json& value : {Json(1), Json("it is so"), Json::array()})
      EXPECT_EQ(with(std::string("/") + key, value),
                std::string("bad input: result.json: field ") + key + " is neither an object nor null");
  const std::string text = files.result.dump();
  const std::string twice = text.substr(0, text.size() - 1) + R"(,"x":0})";
  const auto report = verify_locate(
      {{"result.json", twice}, {"part.stl", files.part}, {"blank.stl", files.blank}, std::nullopt});
  ASSERT_FALSE(report);
  EXPECT_EQ(report.error().message, "result.json: field x is given twice");
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_check_test

// Which triangles a feature has, to the last digit, and what each of several demands of a solid says.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/solid_results.hpp"
#include "verify/solid/solid_features.hpp"

namespace lekalo::verify::verify_solid_faces_test {
namespace {

using cases::demand_of_result;
using cases::Json;
using cases::one_leaf;
using cases::SolidResultFiles;
using cases::with_demands;
using Numbers = std::vector<std::uint32_t>;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// The triangles of one feature.
Numbers found(const std::string& part, const char* way, Json value) {
  const auto reading = read_solid({"part", part});
  EXPECT_TRUE(reading);
  const std::string text =
      Json{{"features", Json::array({Json{{"name", "a"}, {way, std::move(value)}}})}}.dump();
  const auto made = read_solid_features({"features.json", text}, *reading, SolidUnit::millimetre);
  EXPECT_TRUE(made) << made.error().message;
  Numbers numbers;
  for (std::uint32_t t = 0; made && t < made->feature_of.size(); ++t)
    if (made->feature_of[t] == 1) numbers.push_back(t);
  return numbers;
}
Numbers patch(const std::string& part, Json place) { return found(part, "patch", std::move(place)); }

TEST(SolidFaces, ABoxHasALowCornerToo) {
  const std::string cube = solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}));
  EXPECT_EQ(found(cube, "box", {{-5, -5, 5}, {5, 5, 5}}), (Numbers{2, 3}));
  EXPECT_EQ(found(cube, "box", {{-9, -9, 4.9999}, {9, 9, 9}}), (Numbers{2, 3}));
  EXPECT_EQ(found(cube, "box", {{-5, -5, -5}, {-5, 5, 5}}), (Numbers{8, 9}));
}

TEST(SolidFaces, APlaneLiesAcrossEachAxis) {
  const std::string cube = solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}));
  const auto plane = [&](Json normal) {
    return found(cube, "plane", {{"normal", std::move(normal)}, {"at", 5}, {"within", 0}});
  };
  EXPECT_EQ(plane({1, 0, 0}), found(cube, "box", {{5, -5, -5}, {5, 5, 5}}));
  EXPECT_EQ(plane({0, 1, 0}), found(cube, "box", {{-5, 5, -5}, {5, 5, 5}}));
  EXPECT_EQ(plane({0, 0, 1}), found(cube, "box", {{-5, -5, 5}, {5, 5, 5}}));
}

TEST(SolidFaces, DemandsAreWithinTheirBounds) {
  const auto reading = read_solid({"part", solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}))});
  const auto told = [&](const std::string& word, const std::string& number) {
    const std::string text =
        R"({"features": [{"name": "a", "triangles": [1], ")" + word + "\": " + number + "}]}";
    const auto made = read_solid_features({"features.json", text}, *reading, SolidUnit::millimetre);
    return made ? "" : made.error().message;
  };
  EXPECT_EQ(told("minimum", "0"), "");
  EXPECT_EQ(told("minimum", "1e9"), "");
  EXPECT_TRUE(says(told("minimum", "1.001e9"), "features[0].minimum is no length from 0 to 1e+09 mm"))
      << told("minimum", "1.001e9");
  EXPECT_EQ(told("scale", "1e300"), "");
  EXPECT_TRUE(says(told("scale", "1e399"), "features[0].scale is not above 0")) << told("scale", "1e399");
}

TEST(SolidFaces, WithoutAScaleItIsOne) {
  SolidResultFiles files =
      with_demands({{"minimum", 0},
                    {"features", Json::array({Json{{"name", "low"}, {"triangles", {0}}, {"minimum", 0.5}}})}},
                   Json::array({demand_of_result("low", 1, 0.5, 1)}), nullptr, 0.5, 1);
  EXPECT_EQ(files.told(), "unproved");
}

TEST(SolidFaces, ALabelStandsBehindItsWord) {
  const std::string part = "v 0 0 0\nv 1 0 0\nv 0 1 0\n  g one two \nf 1 2 3\n\to\tthree\nf 1 2 3\n";
  EXPECT_EQ(found(part, "label", "one two"), (Numbers{0}));
  EXPECT_EQ(found(part, "label", "three"), (Numbers{1}));
}

TEST(SolidFaces, OfTrianglesAsNearTheFirstCounts) {
  const std::string two = "v 1 0 0\nv 2 0 0\nv 1 0 1\nv -1 0 0\nv -2 0 0\nv -1 0 1\nf 1 2 3\nf 4 5 6\n";
  EXPECT_EQ(patch(two, {0, 0, 0}), (Numbers{0}));
  EXPECT_EQ(patch(two, {-0.001, 0, 0}), (Numbers{1}));
  // Nearer by less than doubles tell.
  const auto above = [](const char* first, const char* second) {
    std::string made;
    for (const std::string z : {first, second})
      made += "v -9 -9 " + z + "\nv 9 -9 " + z + "\nv 0 " + (made.empty() ? "9 " : "8 ") + z + "\n";
    return made + "f 1 2 3\nf 5 4 6\n";
  };
  EXPECT_EQ(patch(above("1.00000000000000000001", "1"), {0, 0, 0}), (Numbers{1}));
  EXPECT_EQ(patch(above("1", "1.00000000000000000001"), {0, 0, 0}), (Numbers{0}));
}

TEST(SolidFaces, APatchGoesOnThroughEdgesAlone) {
  // One corner in common, which is the first of the file or the last, and two triangles apart.
  EXPECT_EQ(patch("v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nf 1 2 3\nf 1 4 5\n", {1, 0, 0}),
            (Numbers{0}));
  EXPECT_EQ(patch("v 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nv 0 0 0\nf 5 1 2\nf 5 3 4\n", {1, 0, 0}),
            (Numbers{0}));
  EXPECT_EQ(patch("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 1 2 3\nf 4 5 6\n", {0, 0, 0}),
            (Numbers{0}));
  // The only common edge is the first one of all.
  EXPECT_EQ(patch("v 0 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nf 1 2 3\nf 2 1 4\n", {0, 0, 0}), (Numbers{0, 1}));
  // Corners at one place are one, and three triangles may meet at an edge.
  EXPECT_EQ(patch("v 0 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\nf 4 5 6\n", {0, 0, 0}),
            (Numbers{0, 1}));
  EXPECT_EQ(patch("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 1 2 3\nf 1 2 4\nf 2 1 5\n", {0, 1, 0}),
            (Numbers{0, 2}));
}

/// Two triangles at the edge from (0, 0, 0) to `along`, the other corners of which are given.
std::string bent(const std::string& along, const std::string& one, const std::string& other) {
  return "v 0 0 0\nv " + along + "\nv " + one + "\nv " + other + "\nf 1 2 3\nf 2 1 4\n";
}

TEST(SolidFaces, APatchGoesOnBelowThirtyDegrees) {
  // The normals are (1, 1, 0) and (2, 1, 1), which are at 30 degrees exactly: 4 times 3^2 is 3 times 2
  // times 6. Along (1, -1, -1), corners at (0, 0, -1) and (1, -2, 0) and beside them.
  const auto joined = [](const std::string& part) { return patch(part, {0, 0, 0}).size() == 2; };
  EXPECT_FALSE(joined(bent("1 -1 -1", "0 0 -1", "1 -2 0")));
  EXPECT_TRUE(joined(bent("1 -1 -1", "0 0 -1", "1 -1.999999999999999999 0")));
  EXPECT_FALSE(joined(bent("1 -1 -1", "0 0 -1", "1 -2.000000000000000001 0")));
  // Folded back the surface does not go on, and beyond 150 degrees neither.
  EXPECT_FALSE(joined(bent("1 0 0", "0 0 1", "0 0.1 1")));
  EXPECT_FALSE(joined(bent("1 0 0", "0 0 1", "0 1 0")));
  EXPECT_TRUE(joined(bent("1 0 0", "0 0 1", "0 0.1 -1")));
}

// ---- what results say of several demands
// --------------------------------------------------------------------

Json feature(const char* name, Json triangles, double minimum, double scale = 1) {
  return {{"name", name}, {"triangles", std::move(triangles)}, {"minimum", minimum}, {"scale", scale}};
}

/// The cube of half edges 5 in that of 6, of which the first triangle of the bottom alone needs 0.75.
SolidResultFiles low(double margin) {
  return with_demands({{"minimum", 0}, {"features", Json::array({feature("low", {0}, 0.75)})}},
                      Json::array({demand_of_result("low", 1, 0.75, 1)}), nullptr, margin, 1);
}

TEST(SolidFaces, TheFirstTriangleCounts) {
  EXPECT_EQ(low(0.25).told(), "unproved");
  EXPECT_TRUE(says(low(0.26).told(), "refuted; feature \"low\": the clearance 1.01 mm is above 1"))
      << low(0.26).told();
}

TEST(SolidFaces, TheLeastOfAllDistancesIsTold) {
  SolidResultFiles files = low(0);
  files.result["z"] = 0.25, files.result["clearance"] = 0.75;
  files.result["contacts"] = Json::array();
  const auto report = files.report();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->findings.size(), 0U);
  EXPECT_NEAR(std::stod(report->clearance_low), 0.75, 1e-12);
  EXPECT_NEAR(std::stod(report->clearance_high), 0.75, 1e-12);
}

TEST(SolidFaces, WhatNoTriangleDemandsIsNotAskedFor) {
  Json all = Json::array();
  for (int t = 0; t < 12; ++t) all.push_back(t);
  SolidResultFiles files =
      with_demands({{"minimum", 5}, {"features", Json::array({feature("all", all, 0.5)})}},
                   Json::array({demand_of_result("all", 12, 0.5, 1)}), nullptr, 0.5, 1);
  EXPECT_EQ(files.told(), "unproved");
  files = with_demands(
      {{"minimum", 0},
       {"features", Json::array({Json{{"name", "all"}, {"triangles", all}, {"as_cast", true}}})}},
      Json::array({demand_of_result("all", 12, nullptr, nullptr)}), nullptr, 0.5, 1);
  EXPECT_TRUE(says(files.told(), "all of the part is as cast or finished, so that there is no margin"))
      << files.told();
}

/// Two balls of the part between half-spaces 2 farther apart than they are.
SolidResultFiles by_balls(const Json& features, const Json& of_result, double bound) {
  return with_demands(features, of_result,
                      one_leaf(Json::array({{"plane", 0, 0, 1}, {"plane", 1, 1, 1}}),
                               Json::array({{0, 0, 5, 0}, {0, 0, -5, 0}}), Json::array(),
                               Json::array({{0, 0, -1, -6}, {0, 0, 1, -6}})),
                      0, bound);
}

TEST(SolidFaces, ABallCountsWithTheLeastDemandOfAll) {
  const Json features{{"minimum", 0.5}, {"features", Json::array({feature("low", {0, 1}, 1)})}},
      of_result = Json::array({demand_of_result("low", 2, 1, 1)});
  EXPECT_EQ(by_balls(features, of_result, 0.5).told(), "confirmed");
  EXPECT_TRUE(says(by_balls(features, of_result, 0.4999).told(), "do not prove"));
  // Whatever is as cast, the first triangle or the last.
  for (const int t : {0, 11})
    EXPECT_TRUE(says(
        by_balls(
            {{"minimum", 0.5},
             {"features", Json::array({Json{{"name", "rough"}, {"triangles", {t}}, {"as_cast", true}}})}},
            Json::array({demand_of_result("rough", 1, nullptr, nullptr)}), 0.5)
            .told(),
        "has a part ball, but something of the part is as cast"))
        << t;
}

/// The low face along an axis lies 0.5 within the blank's, on a datum or 0.25 off it.
std::string on_datum(std::size_t axis, double level, double off) {
  Json normal = {0, 0, 0}, through = {0, 0, 0}, high = {5, 5, 5};
  normal[axis] = 1, through[axis] = level, high[axis] = -5;
  const Json low{{"name", "low"}, {"box", Json::array({Json{-5, -5, -5}, high})}},
      datum{{"name", "seat"},
            {"feature", "low"},
            {"plane", {{"normal", normal}, {"through", through}}},
            {"within", 0.375}};
  SolidResultFiles files =
      with_demands({{"minimum", 0}, {"features", Json::array({low})}, {"datums", Json::array({datum})}},
                   Json::array({demand_of_result("low", 2, 0, 1)}), nullptr, 0.5, 1);
  files.result[std::string(1, "xyz"[axis])] = -0.5, files.result["clearance"] = 0.5;
  files.result["contacts"] = Json::array();
  files.result["demands"]["datums"] = Json::array({Json{{"name", "seat"}, {"within", 0.375}, {"off", off}}});
  return files.told();
}

TEST(SolidFaces, APartMayLieExactlyOnItsDatum) {
  for (const std::size_t axis : {0U, 1U, 2U}) {
    EXPECT_EQ(on_datum(axis, -5.5, 0), "unproved");
    EXPECT_TRUE(says(on_datum(axis, -5.5, -1e-9), "the part is said to be off it by up to -1e-09 mm"));
  }
  // More may be said by a share of the blank's size.
  EXPECT_EQ(on_datum(2, -5.25, 0.250005), "unproved");
  EXPECT_TRUE(says(on_datum(2, -5.25, 0.250015), "said to be off it"));
}

TEST(SolidFaces, NumbersBesideDemandsAreThoseOfTheMargin) {
  const auto with = [](const char* path, Json value) {
    SolidResultFiles files = low(0.25);
    files.result.at(path) = std::move(value);
    return files.told();
  };
  EXPECT_TRUE(says(with("/gap", 0.5), "there is an upper_bound or a gap, but demands have a margin_bound"));
  EXPECT_TRUE(says(with("/demands/margin_bound", nullptr), "there is a margin_gap, but not both"));
  EXPECT_TRUE(says(with("/shortfall", nullptr), "shortfall is null"));
  EXPECT_TRUE(says(with("/inside", false), "inside is false, but there is a margin"));
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_faces_test

// Demands by face: which triangles of a solid's file a feature has, and what is refused.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "lekalo/io/locate/solid_feature_file.hpp"
#include "support/solid_cases.hpp"
#include "support/solid_files.hpp"

namespace lekalo::io::io_solid_features_test {
namespace {

using Numbers = std::vector<std::uint32_t>;

SolidFile file_of(const solid::Mesh& mesh) {
  return parse_solid(solid_files::stl_text(mesh), "part.stl").value();
}

/// A block; triangles 0 and 1 look down, 2 and 3 up, 4 and 5 to low y, 8 and 9 to low x.
SolidFile block() { return file_of(cases::block({0, 0, 0}, {30, 20, 10})); }

Result<std::vector<SolidFeature>> found(const std::string& features, const SolidFile& part,
                                        std::optional<SolidUnit> unit = {}) {
  auto file = parse_solid_features(features, "f.json", unit);
  if (!file) return tl::unexpected(file.error());
  return find_solid_features(*file, part);
}

/// The triangles of the only feature.
Numbers triangles(const std::string& which, const SolidFile& part) {
  const auto all = found(R"({"features": [{"name": "a", )" + which + "}]}", part);
  EXPECT_TRUE(all) << all.error().message;
  return all ? all->front().triangles : Numbers{};
}

std::string refusal(const std::string& features, const SolidFile& part = block()) {
  const auto all = found(features, part);
  return all ? "found" : all.error().message;
}
std::string refusal_of(const std::string& feature, const SolidFile& part = block()) {
  return refusal(R"({"features": [{"name": "a", )" + feature + "}]}", part);
}

TEST(SolidFeatures, TrianglesAreNamedInFiveWays) {
  EXPECT_EQ(triangles(R"("triangles": [5, 2, 5])", block()), (Numbers{2, 5}));
  EXPECT_EQ(triangles(R"("patch": [14, 9, 12])", block()), (Numbers{2, 3}));
  EXPECT_EQ(triangles(R"("box": [[0, 0, 0], [0, 20, 10]])", block()), (Numbers{8, 9}));
  EXPECT_EQ(triangles(R"("plane": {"normal": [0, 0, 1], "at": 0, "within": 0})", block()), (Numbers{0, 1}));
  EXPECT_EQ(triangles(R"("plane": {"normal": [0, 0, -2], "at": -10, "within": 0.25})", block()),
            (Numbers{2, 3}));
  SolidFile named = block();
  named.groups = {"", "top"};
  named.group_of_triangle = {0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(triangles(R"("label": "top")", named), (Numbers{2, 3}));
}

TEST(SolidFeatures, APatchEndsWhereTheSurfaceBends) {
  // The sides of a prism of 24 bend by 15 degrees, those of one of 10 by 36.
  const auto prism = [](std::uint32_t sides) {
    return file_of(cases::turned({{0, 0}, {10, 0}, {10, 30}, {0, 30}}, sides, 0.1));
  };
  EXPECT_EQ(triangles(R"("patch": [11, 0.5, 14])", prism(24)).size(), 48u);
  EXPECT_EQ(triangles(R"("patch": [11, 0.5, 14])", prism(10)).size(), 2u);
  EXPECT_EQ(triangles(R"("patch": [1, 0.5, 31])", prism(24)).size(), 24u);
}

TEST(SolidFeatures, DemandsAndUnits) {
  const auto all = found(
      R"({"units": "inch", "minimum": 0.1, "features": [
        {"name": "a", "triangles": [0], "minimum": 2, "target": 2.5, "maximum": 3, "scale": 0.5},
        {"name": "b", "box": [[-1, -1, 0.39370], [2, 1, 0.39371]]},
        {"name": "c", "triangles": [4], "as_cast": true},
        {"name": "d", "triangles": [5], "finished": 0.1, "rim": 1}]})",
      block());
  ASSERT_TRUE(all) << all.error().message;
  ASSERT_EQ(all->size(), 4u);
  EXPECT_DOUBLE_EQ((*all)[0].demand->minimum, 50.8);
  EXPECT_EQ((*all)[0].demand->scale, 0.5);
  EXPECT_NEAR((*all)[0].maximum.value_or(0), 76.2, 1e-12);
  EXPECT_NEAR((*all)[0].target.value_or(0), 63.5, 1e-12);
  EXPECT_FALSE((*all)[1].maximum || (*all)[1].target);
  EXPECT_EQ((*all)[1].triangles, (Numbers{2, 3}));
  EXPECT_EQ((*all)[1].demand, locate::SolidDemand{});
  EXPECT_FALSE((*all)[2].demand || (*all)[2].within());
  EXPECT_FALSE((*all)[3].demand);
  EXPECT_NEAR((*all)[3].within().value_or(0), 2.54, 1e-12);
  EXPECT_DOUBLE_EQ((*all)[3].rim, 25.4);
  const auto file = parse_solid_features(R"({"minimum": 0.1})", "f.json", SolidUnit::metre);
  EXPECT_DOUBLE_EQ(file->minimum.value(), 100);
}

TEST(SolidFeatures, WhatCannotBeUnderstoodIsRefused) {
  EXPECT_EQ(refusal(R"({"ignore": []})"),
            R"(f.json: unknown word "ignore"; known here: units, minimum, as_cast, features, datums)");
  EXPECT_EQ(refusal(R"({"as_cast": 1})"), R"(f.json: "as_cast" must be true or false)");
  EXPECT_EQ(refusal(R"({"as_cast": true, "minimum": 1})"), R"(f.json: what is as cast has no "minimum")");
  EXPECT_EQ(refusal(R"({"units": "ft"})"), R"(f.json: "units" must be "mm", "inch" or "m")");
  EXPECT_EQ(refusal(R"({"features": [{"triangles": [0]}]})"), R"(f.json, feature 0: "name" must be a text)");
  EXPECT_EQ(
      refusal_of(R"("minimum": 1)"),
      R"(f.json, feature "a": one of "triangles", "label", "faces", "colour", "patch", "box" and "plane" must )"
      "say which triangles it has");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "label": "x")"), refusal_of(R"("minimum": 1)"));
  EXPECT_EQ(refusal_of(R"("triangles": [12])"),
            R"(f.json, feature "a": triangle 12 is not one of the part's 12)");
  for (const char* colour : {"red", "#ff800", "#ff80001", "#ff80g0", ""})
    EXPECT_EQ(
        refusal_of(std::string(R"("colour": ")") + colour + '"'),
        R"(f.json, feature "a": "colour" must be a text like "#ff8000": red, green and blue, two digits each)");
  EXPECT_EQ(refusal_of(R"("label": "top")"),
            R"(f.json, feature "a": no triangle of the part has the label "top"; there is: part)");
  EXPECT_EQ(refusal_of(R"("box": [[0, 0, 1], [1, 1, 0]])"),
            R"(f.json, feature "a": "box" has a low corner above its high one)");
  EXPECT_EQ(refusal_of(R"("box": [[1, 1, 1], [2, 2, 2]])"),
            R"(f.json, feature "a": no triangle of the part is of it)");
  EXPECT_EQ(refusal_of(R"("plane": {"normal": [0, 0, 0], "at": 0, "within": 1})"),
            R"(f.json, feature "a", plane: "normal" must be a direction [x, y, z])");
  EXPECT_EQ(
      refusal_of(R"("triangles": [0], "rim": 1)"),
      R"(f.json, feature "a": "rim" is of a feature that is finished: what is nearer to it demands nothing)");
  EXPECT_EQ(
      refusal_of(R"("triangles": [0], "finished": 0)"),
      R"(f.json, feature "a": "finished" is how far its points may lie from the blank's surface, above 0)");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "finished": 1, "scale": 2)"),
            R"(f.json, feature "a": a feature that is finished has no "scale")");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "finished": 1, "target": 2)"),
            R"(f.json, feature "a": a feature that is finished has no "target")");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "as_cast": true, "target": 2)"),
            R"(f.json, feature "a": a feature that is as cast has no "target")");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "target": "much")"),
            R"(f.json, feature "a": "target" must be a length that is not negative)");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "target": 2e9)"),
            R"(f.json, feature "a": "target" is 2000000000 mm; demands go up to 1e+09 mm)");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "finished": 1, "as_cast": true)"),
            R"(f.json, feature "a": a feature is not both as cast and finished)");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "minimum": -1)"),
            R"(f.json, feature "a": "minimum" must be a length that is not negative)");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "scale": 0)"),
            R"(f.json, feature "a": "scale" must be a number from 1e-06 to 1e+06)");
  EXPECT_EQ(refusal_of(R"("triangles": [0], "scale": 2, "as_cast": true)"),
            R"(f.json, feature "a": a feature that is as cast has no "scale")");
  EXPECT_EQ(refusal(R"({"features": [{"name": "a", "triangles": [0, 1]}, {"name": "b", "triangles": [1]}]})"),
            R"(f.json, feature "b": triangle 1 is also of the feature "a"; it can be of one)");
}

Result<std::vector<locate::SolidDatum>> datums(const std::string& datum, const char* unit = "mm") {
  const SolidFile part = block();
  const std::string text =
      std::string(R"({"units": ")") + unit +
      R"(", "features": [{"name": "low", "triangles": [1, 0]}, {"name": "twice", "triangles": [2]},
                              {"name": "twice", "triangles": [3]}], "datums": [{"name": "d", )" +
      datum + "}]}";
  auto file = parse_solid_features(text, "f.json", {});
  if (!file) return tl::unexpected(file.error());
  auto features = find_solid_features(*file, part);
  if (!features) return tl::unexpected(features.error());
  return find_solid_datums(*file, *features, part);
}

TEST(SolidFeatures, DatumsHaveTheCornersOfAFeatureOrPoints) {
  const auto face =
      datums(R"("feature": "low", "plane": {"normal": [0, 0, -4], "through": [1, 2, 3]}, "within": 0.5)");
  ASSERT_TRUE(face) << face.error().message;
  const locate::SolidDatum& low = face->front();
  EXPECT_EQ(low.on, locate::SolidDatum::On::plane);
  EXPECT_EQ(low.direction, (solid::Vector{0, 0, -1}));
  EXPECT_EQ(low.at, (solid::Vector{1, 2, 3}));
  EXPECT_EQ(low.within, 0.5);
  ASSERT_FALSE(low.points.empty());
  for (const auto& point : low.points) {
    EXPECT_EQ(point.place, block().mesh.vertices[block().mesh.triangles[point.number / 3][point.number % 3]]);
    EXPECT_EQ(point.place.z, 0);
  }
  const auto hole = datums(
      R"("points": [[0, 0, 1], [0, 2, 0]], "axis": {"along": [0, 3, 0], "through": [0, 0, 1]}, "within": 1)",
      "inch");
  ASSERT_TRUE(hole) << hole.error().message;
  EXPECT_EQ(hole->front().on, locate::SolidDatum::On::axis);
  EXPECT_EQ(hole->front().points[1].place, (solid::Vector{0, 50.8, 0}));
  EXPECT_EQ(hole->front().points[1].number, 1u);
  EXPECT_EQ(hole->front().at, (solid::Vector{0, 0, 25.4}));
  EXPECT_EQ(hole->front().within, 25.4);
}

TEST(SolidFeatures, DatumsThatCannotBeUnderstoodAreRefused) {
  const auto refused = [](const std::string& datum) {
    const auto found = datums(datum);
    return found ? "found" : found.error().message;
  };
  const std::string there = R"("point": [0, 0, 0], "within": 1)";
  EXPECT_EQ(refused(R"("feature": "top", )" + there),
            R"(f.json, datum "d": there is no feature named "top")");
  EXPECT_EQ(refused(R"("feature": "twice", )" + there),
            R"(f.json, datum "d": there are several features named "twice")");
  EXPECT_EQ(refused(there),
            R"(f.json, datum "d": one of "feature" and "points" must say what of the part it holds)");
  EXPECT_EQ(refused(R"("points": [], )" + there),
            R"(f.json, datum "d": "points" must be a list of 1 to 1000 points [x, y, z])");
  EXPECT_EQ(refused(R"("points": [[0, 0, 2e9]], )" + there),
            R"(f.json, datum "d": "points" must be a point [x, y, z] within 1e+09 mm)");
  EXPECT_EQ(
      refused(R"("feature": "low", "within": 1)"),
      R"(f.json, datum "d": one of "plane", "axis" and "point" must say where in the blank's frame it is)");
  EXPECT_EQ(refused(R"("feature": "low", "point": [0, 0, 0])"),
            R"(f.json, datum "d": "within" must be a length above 0)");
  EXPECT_EQ(refused(R"("feature": "low", "axis": {"along": [0, 0, 0], "through": [0, 0, 0]}, "within": 1)"),
            R"(f.json, datum "d", axis: "along" must be a direction [x, y, z])");
  EXPECT_EQ(refused(R"("feature": "low", "plane": {"normal": [0, 0, 1]}, "within": 1)"),
            R"(f.json, datum "d", plane: "through" must be a point [x, y, z] within 1e+09 mm)");
}

TEST(SolidFeatures, WhatRoundingLeavesOpenIsRefused) {
  EXPECT_EQ(
      refusal_of(R"("patch": [30, 20, 5])"),
      R"(f.json, feature "a": (30, 20, 5) is as near to one patch as to another; give a point beside the )"
      "middle of one");
  EXPECT_EQ(
      refusal_of(R"("plane": {"normal": [0, 0, 1], "at": 9.75, "within": 0.25})"),
      R"(f.json, feature "a": the corner (0, 20, 10) is as far off the plane as "within" allows, as far as )"
      "rounding lets that be told; say a little more or less");
  // Twelve sides bend by 30 degrees.
  EXPECT_NE(refusal_of(R"("patch": [9.9, 0, 14])", file_of(cases::turned({{0, 0}, {10, 0}, {10, 30}, {0, 30}},
                                                                         12, std::numbers::pi / 12)))
                .find("meet at 30 degrees, as far as rounding lets that be told"),
            std::string::npos);
}

}  // namespace
}  // namespace lekalo::io::io_solid_features_test

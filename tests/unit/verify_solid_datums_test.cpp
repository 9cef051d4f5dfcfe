// Datums of a solid: the checker measures how far the part is off them, and counts no pose that does not keep
// them.

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "support/solid_results.hpp"
#include "verify/solid/solid_features.hpp"

namespace lekalo::verify::verify_solid_datums_test {
namespace {

using cases::demand_of_result;
using cases::Json;
using cases::one_leaf;
using cases::SolidResultFiles;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

Json seat(double z = -5.5, double within = 0.25) {
  return {{"name", "seat"},
          {"feature", "bottom"},
          {"plane", {{"normal", {0, 0, 2}}, {"through", {1, 2, z}}}},
          {"within", within}};
}

/// The cube of half edges 5 in that of 6, with its bottom (triangles 0 and 1) within 0.25 of z = -5.5: so it
/// lies 0.25 lower, and 0.75 are left. The certificate has the bottom's point 0 over the half-space z >= -6
/// and a term of a datum.
struct Held {
  Json datum = seat(), of_result = {{"name", "seat"}, {"within", 0.25}, {"off", 0.25}};
  /// Row of datum_points, direction and multiplier, beside the same of the half-space.
  Json point = {0, 4}, direction = {0, 0, 1};
  double multiplier = 1, bound = 0.75, margin = 0.75;
  std::array<double, 3> at{0, 0, -0.25};
  Json low = {0, 0, 1, -6};
  Json bottom = {0, 1};  // the triangles of the feature
  Json on_part = {0, 0.25, 0.5};

  [[nodiscard]] SolidResultFiles files() const {
    const Json features{{"minimum", 0},
                        {"features", Json::array({Json{{"name", "bottom"}, {"triangles", bottom}}})},
                        {"datums", Json::array({datum})}};
    Json certificate = one_leaf(Json::array({{"point_plane", 0, 0, 1}, {"datum", 0, 0, multiplier}}),
                                Json::array(), Json::array(), Json::array({low}));
    certificate["part_points"] = Json::array({on_part});
    certificate["datum_points"] = Json::array({point});
    certificate["directions"] = Json::array({direction});
    SolidResultFiles made = cases::with_demands(
        features, Json::array({demand_of_result("bottom", bottom.size(), 0, 1)}), certificate, margin, bound);
    made.result["clearance"] = margin;
    made.result["contacts"] = Json::array();
    made.result["x"] = at[0], made.result["y"] = at[1], made.result["z"] = at[2];
    made.result["demands"]["datums"] = Json::array({of_result});
    return made;
  }
  [[nodiscard]] std::string told() const { return files().told(); }
};

TEST(SolidDatums, AFaceOnAPlaneBoundsTheMarginToTheLastDigit) {
  EXPECT_EQ(Held{}.told(), "confirmed");
  Held less;
  less.bound = 0.75 - 1e-12, less.margin = 0.7;
  EXPECT_TRUE(says(less.told(), "do not prove"));
  // Of any direction the part along the normal counts.
  Held askew;
  askew.direction = {3, -1, 4}, askew.multiplier = 0.25;
  EXPECT_EQ(askew.told(), "confirmed");
  askew.multiplier = 0.2499;
  EXPECT_TRUE(says(askew.told(), "do not prove"));
  // From the other side it says nothing of this.
  Held below;
  below.direction = {0, 0, -1};
  EXPECT_TRUE(says(below.told(), "do not prove"));
}

TEST(SolidDatums, PointsOnAnAxisAndOnAPointDoTheSame) {
  Held axis;
  axis.datum = {{"name", "hole"},
                {"points", Json::array({{0, -5, 1}, {0, 5, 1}})},
                {"axis", {{"along", {0, -3, 0}}, {"through", {0, 7, 0.5}}}},
                {"within", 0.25}};
  axis.of_result["name"] = "hole", axis.point = {0, 1}, axis.direction = {0, 9, 1};
  EXPECT_EQ(axis.told(), "confirmed");
  axis.bound = 0.75 - 1e-12, axis.margin = 0.7;
  EXPECT_TRUE(says(axis.told(), "do not prove"));
  Held point;
  point.datum = {
      {"name", "pin"}, {"points", Json::array({{1, 2, 3}})}, {"point", {1, 2, 2.5}}, {"within", 0.25}};
  point.of_result["name"] = "pin", point.point = {0, 0};
  EXPECT_EQ(point.told(), "confirmed");
  // All of the direction counts: 0.25 of 5 and 0.5 of 3.
  point.multiplier = 1.0 / 3;
  for (const Json& direction : {Json{0, 4, 3}, Json{4, 0, 3}}) {
    point.direction = direction;
    EXPECT_TRUE(says(point.told(), "do not prove"));
  }
}

TEST(SolidDatums, HowFarThePartIsOffIsMeasured) {
  const auto with = [](double off) {
    Held held;
    held.of_result["off"] = off;
    return held.told();
  };
  EXPECT_TRUE(says(with(0.2499999),
                   "datum \"seat\": the part is said to be off it by up to 0.2499999 mm, but it is "
                   "by 0.25"));
  EXPECT_TRUE(says(with(-0.25), "said to be off"));
  EXPECT_TRUE(says(with(0.2501), "said to be off"));
  EXPECT_TRUE(says(with(0.250001), "inside is true, but a datum is not kept"));
  EXPECT_FALSE(says(with(0.250001), "said to be off"));
  Held lower;
  lower.at[2] = -0.2, lower.margin = 0.7;
  EXPECT_TRUE(says(lower.told(), "but it is by 0.3"));
}

/// The same where the datum is not kept at the pose.
SolidResultFiles not_inside(const Held& held) {
  SolidResultFiles files = held.files();
  files.result["inside"] = false, files.result["status"] = "stopped";
  for (const char* one : {"clearance", "shortfall"}) files.result[one] = nullptr;
  files.result["demands"]["margin"] = files.result["demands"]["margin_gap"] = nullptr;
  return files;
}

TEST(SolidDatums, APoseThatDoesNotKeepThemIsNotInside) {
  Held off;
  off.at[2] = 0, off.of_result["off"] = 0.5;
  EXPECT_TRUE(says(not_inside(off).told(),
                   "datum \"seat\": it is off by 0.5 mm of 0.25, so that missed has to be there"));
  off.of_result["missed"] = 0.25 + 1e-12;
  EXPECT_TRUE(says(not_inside(off).told(), "datum \"seat\": missed is not off less within"));
  off.of_result["missed"] = 0.25;
  EXPECT_EQ(not_inside(off).told(), "confirmed");
  Held kept;
  kept.of_result["missed"] = 0;
  EXPECT_TRUE(says(kept.told(), "so that missed has to be left out"));
  EXPECT_TRUE(says(off.told(), "inside is true, but a datum is not kept"));
  EXPECT_TRUE(
      says(not_inside(Held{}).told(), "inside is false, but all of the part that demands something lies in"));
}

TEST(SolidDatums, WhatTheResultSaysOfThemIsHeldAgainstTheFile) {
  const auto with = [](const char* path, Json value) {
    SolidResultFiles files = Held{}.files();
    files.result.at(path) = std::move(value);
    return files.told();
  };
  EXPECT_TRUE(says(with("/demands/datums/0/name", "foot"),
                   "demands.datums[0] is not what features.json says: \"seat\" within 0.25 mm"));
  EXPECT_TRUE(
      says(with("/demands/datums/0/within", 0.26), "demands.datums[0] is not what features.json says"));
  EXPECT_TRUE(
      says(with("/demands/datums", Json::array()), "demands.datums has 0 datums, but features.json has 1"));
  EXPECT_TRUE(says(with("/demands/datums/0/off", "far"), "bad input"));
  EXPECT_TRUE(says(with("/demands/datums/0", Json{{"name", "seat"}, {"within", 0.25}}), "bad input"));
}

TEST(SolidDatums, RowsOfTheirTablesAreRead) {
  const auto point = [](Json row) {
    Held held;
    held.point = std::move(row);
    return held.told();
  };
  // Corner k of triangle f is point 3 f + k.
  for (const int corner : {0, 1, 2, 3, 4, 5}) EXPECT_EQ(point({0, corner}), "confirmed");
  EXPECT_TRUE(says(point({1, 0}), "certificate.datum_points[0] is not what it has to be: its datum is none"));
  EXPECT_TRUE(says(point({-1, 0}), "its datum is none"));
  EXPECT_TRUE(says(point({0.5, 0}), "its datum is none"));
  EXPECT_TRUE(says(point({0, 6}), "its point is none of the datum"));
  EXPECT_TRUE(says(point({0, -1}), "its point is none of the datum"));
  Held half;
  half.bottom = {1}, half.point = {0, 0};
  EXPECT_TRUE(says(half.told(), "its point is none of the datum"));
  EXPECT_TRUE(says(point({0}), "bad input"));
  EXPECT_TRUE(says(point({0, 1e11}), "its point is none of the datum"));
  Held short_of_one;
  short_of_one.direction = {0, 1};
  EXPECT_TRUE(says(short_of_one.told(), "bad input"));
  Held flat;
  flat.direction = {1, -5, 0};
  EXPECT_TRUE(says(flat.told(), "nodes[0] has a direction that does not lead off the datum \"seat\""));
  Held pin;
  pin.datum = {
      {"name", "pin"}, {"points", Json::array({{1, 2, 3}})}, {"point", {1, 2, 2.5}}, {"within", 0.25}};
  pin.of_result["name"] = "pin", pin.point = {0, 1};
  EXPECT_TRUE(says(pin.told(), "its point is none of the datum"));
  // Terms that name no row.
  for (const Json& term : {Json{"datum", 1, 0, 1}, Json{"datum", 0, 1, 1}}) {
    SolidResultFiles files = Held{}.files();
    files.result["certificate"]["trees"][0]["nodes"][0][1] = term;
    EXPECT_TRUE(says(files.told(), "has a term that is none"));
  }
}

/// The bottom's corners of x = 5 leave 0.25 along x, and those of x = -5 10 mm more.
TEST(SolidDatums, PointsOfAFaceAreTheCornersOfTheFile) {
  const solid::Mesh part = cases::block({-5, -5, -5}, {5, 5, 5});
  for (std::size_t corner = 0; corner < 6; ++corner) {
    Held held;
    held.datum = {{"name", "seat"},
                  {"feature", "bottom"},
                  {"plane", {{"normal", {3, 0, 0}}, {"through", {0, 7, 7}}}},
                  {"within", 5.25}};
    held.of_result = {{"name", "seat"}, {"within", 5.25}, {"off", 5}};
    held.at[2] = 0, held.margin = 1, held.bound = 1.25;
    held.point = {0, corner}, held.direction = {1, 0, 0}, held.low = {1, 0, 0, -6};
    // A corner of the bottom at x = -5, over the half-space x >= -6.
    const auto at = [&](std::size_t t, std::size_t k) { return part.vertices[part.triangles[t][k]]; };
    for (std::size_t k = 0; k < 3; ++k)
      if (at(0, k).x < 0) held.on_part = Json{0, k == 1 ? 1 : 0, k == 2 ? 1 : 0};
    if (at(corner / 3, corner % 3).x > 0)
      EXPECT_EQ(held.told(), "confirmed") << corner;
    else
      EXPECT_TRUE(says(held.told(), "do not prove")) << corner;
  }
}

TEST(SolidDatums, APartMayLieExactlyOnThem) {
  Held on;
  on.datum = seat(-5.25), on.of_result["off"] = 0, on.bound = 1;
  EXPECT_EQ(on.told(), "confirmed");
  on.of_result["off"] = -0.0625;
  EXPECT_TRUE(says(on.told(), "said to be off"));
}

TEST(SolidDatums, TermsOfThemAloneProveThatNoPoseKeepsThem) {
  // Shifts of up to 0.5 leave the bottom above -5.5.
  const auto with = [](double z, double within) {
    Held held;
    held.datum = seat(z, within), held.of_result["within"] = within;
    held.at[2] = 0, held.of_result["off"] = -5 - z, held.bound = -0.01;
    held.of_result["missed"] = -5 - z - within;
    SolidResultFiles files = not_inside(held);
    files.result["status"] = "infeasible";
    files.result["certificate"]["trees"][0]["nodes"][0] = Json::array({{"datum", 0, 0, 1}});
    return files.told();
  };
  EXPECT_EQ(with(-6, 0.25), "confirmed");
  EXPECT_EQ(with(-5.75 - 1e-12, 0.25), "confirmed");
  // Below 0 all over: here it is 0 at the lowest shift.
  EXPECT_TRUE(says(with(-5.75, 0.25), "do not prove"));
  EXPECT_TRUE(says(with(-5.7, 0.25), "do not prove"));
}

std::string refused(const Json& datum) {
  const std::string part = solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}));
  const auto reading = read_solid({"part", part});
  const std::string text = Json{
      {"features", Json::array({Json{{"name", "bottom"}, {"triangles", {0, 1}}},
                                Json{{"name", "twice"}, {"triangles", {2}}},
                                Json{{"name", "twice"}, {"triangles", {3}}}})},
      {"datums",
       Json::array({datum})}}.dump();
  const auto made = read_solid_features({"features.json", text}, *reading, SolidUnit::inch);
  return made ? "" : made.error().message;
}

TEST(SolidDatums, RefusalsNameTheField) {
  EXPECT_EQ(refused(seat()), "");
  const auto with = [](const char* key, Json value) {
    Json datum = seat();
    if (value.is_null())
      datum.erase(key);
    else
      datum[key] = std::move(value);
    return refused(datum);
  };
  EXPECT_TRUE(says(with("within", 0), "field datums[0].within is not above 0"));
  EXPECT_TRUE(says(with("within", nullptr), "field datums[0].within is not above 0"));
  EXPECT_TRUE(
      says(with("feature", "top"), "field datums[0].feature is the name of no feature, or of several"));
  EXPECT_TRUE(
      says(with("feature", "twice"), "field datums[0].feature is the name of no feature, or of several"));
  EXPECT_TRUE(says(with("feature", nullptr), "has not one of a feature and points"));
  EXPECT_TRUE(says(with("points", Json::array({{0, 0, 0}})), "has not one of a feature and points"));
  EXPECT_TRUE(says(with("plane", nullptr), "is not on one of a plane, an axis and a point"));
  EXPECT_TRUE(says(with("point", {0, 0, 0}), "is not on one of a plane, an axis and a point"));
  EXPECT_TRUE(says(with("side", 1), "field datums[0].side is no word"));
  EXPECT_TRUE(
      says(with("plane", {{"normal", {0, 0, 0}}, {"through", {0, 0, 0}}}), "is 0, which is no direction"));
  EXPECT_TRUE(says(with("plane", {{"normal", {0, 0, 1}}, {"at", 5}}), "field datums[0].plane.at is no word"));
  EXPECT_TRUE(says(with("plane", {{"normal", {0, 0, 1}}}), "field datums[0].plane.through"));
  Json none = seat();
  none.erase("feature"), none["points"] = Json::array();
  EXPECT_TRUE(says(refused(none), "datums[0] has no point of the part"));
}

TEST(SolidDatums, LengthsAreInTheUnitOfTheFile) {
  const std::string part = solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}));
  const auto reading = read_solid({"part", part}, SolidUnit::inch);
  const auto found = [&](const char* unit) {
    Json datum = seat(-2, 0.5);
    datum.erase("feature"), datum["points"] = Json::array({{0, 0, 1}});
    const std::string text = Json{{"units", unit}, {"datums", Json::array({datum})}}.dump();
    return read_solid_features({"features.json", text}, *reading, SolidUnit::millimetre)->datums[0];
  };
  const SolidDatum inches = found("inch"), millimetres = found("mm");
  EXPECT_EQ(inches.within, 12.7);
  EXPECT_TRUE(inches.points[0][2].exact == Fraction(127, 5));
  EXPECT_TRUE(inches.through[2].exact == Fraction(-254, 5));
  EXPECT_TRUE(inches.direction[2].exact == 2);
  EXPECT_EQ(millimetres.within, 0.5);
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_datums_test

// How a placement of solids was chosen of those with nearly the largest margin: what the checker holds of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "support/solid_results.hpp"

namespace lekalo::verify::verify_solid_choice_test {
namespace {

using cases::Json;
using cases::SolidResultFiles;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// The cube of half edges 5 in that of 6, a quarter of a millimetre above the middle: 0.75 are left, and the
/// underside lies 1.25 deep.
struct Chosen {
  Json criterion = "largest", give_up = 0.25, margin_found = 1, largest = 1.2525;
  double clearance = 0.75;
  bool inside = true;
  Json bound = 1;

  [[nodiscard]] SolidResultFiles files() const {
    SolidResultFiles made = cases::cube_in_cube();
    made.result["z"] = 0.25, made.result["clearance"] = clearance, made.result["upper_bound"] = bound;
    if (!bound.is_null()) made.result["gap"] = bound.get<double>() - clearance;
    made.result["contacts"] = Json::array();
    made.result["choice"] = {
        {"criterion", criterion}, {"give_up", give_up}, {"margin_found", margin_found}, {"largest", largest}};
    if (!inside) {
      made.result["status"] = "unproved", made.result["inside"] = false, made.result["z"] = 2;
      made.result["window"]["shift"] = 3;
      for (const char* field : {"clearance", "gap", "shortfall"}) made.result[field] = nullptr;
    }
    return made;
  }
  [[nodiscard]] std::string told() const { return files().told(); }
};

TEST(SolidChoice, WhatIsTrueIsTaken) {
  EXPECT_EQ(Chosen{}.told(), "unproved");
  Chosen none;
  none.inside = false, none.margin_found = none.largest = nullptr;
  EXPECT_EQ(none.told(), "unproved");
  none.criterion = "even";
  SolidResultFiles even = none.files();
  even.result["choice"]["largest_found"] = even.result["choice"]["deviation"] = nullptr;
  EXPECT_EQ(even.told(), "unproved");
  Chosen unbounded;
  unbounded.bound = nullptr;
  EXPECT_EQ(unbounded.told(), "unproved");
}

TEST(SolidChoice, WithoutAClearanceNothingIsHeldAgainstIt) {
  SolidResultFiles lost = Chosen{}.files();
  for (const char* field : {"clearance", "gap", "shortfall"}) lost.result[field] = nullptr;
  EXPECT_TRUE(says(lost.told(), "inside is true, but there is no clearance")) << lost.told();
  Chosen none;
  none.inside = false, none.margin_found = none.largest = nullptr;
  SolidResultFiles more = none.files();
  more.result["clearance"] = 0.5;
  EXPECT_TRUE(says(more.told(), "inside is false, but there is a clearance")) << more.told();
}

TEST(SolidChoice, NoMoreIsGivenUpThanIsSaid) {
  Chosen less;
  less.give_up = 0.249;
  EXPECT_TRUE(says(less.told(), "the margin 0.75 is below choice.margin_found 1 less choice.give_up 0.249"))
      << less.told();
  Chosen more;
  more.give_up = 0.3;
  EXPECT_EQ(more.told(), "unproved");
  more.give_up = -0.1;
  EXPECT_TRUE(says(more.told(), "bad input")) << more.told();
  Chosen nothing;
  nothing.give_up = 0, nothing.margin_found = 0.75;
  EXPECT_EQ(nothing.told(), "unproved");
}

TEST(SolidChoice, TheMarginThatWasFoundLiesBetweenThatOfThePoseAndTheBound) {
  Chosen low;
  low.margin_found = 0.7499;
  EXPECT_TRUE(says(low.told(), "choice.margin_found 0.7499 is below the margin 0.75")) << low.told();
  low.margin_found = 0.75;
  EXPECT_EQ(low.told(), "unproved");
  Chosen high;
  high.margin_found = 1.0001, high.give_up = 0.5;
  EXPECT_TRUE(says(high.told(), "choice.margin_found 1.0001 is above the bound 1")) << high.told();
}

TEST(SolidChoice, TheLargestAllowanceIsThatOfAllOfThePart) {
  Chosen small;
  small.largest = 1.2499;
  EXPECT_TRUE(says(small.told(), "choice.largest is said to be 1.2")) << small.told();
  small.largest = 1.26;
  EXPECT_EQ(small.told(), "unproved");
  // To the last digit it is not told, and much more is none any more.
  small.largest = 1.25;
  EXPECT_EQ(small.told(), "incomplete");
  small.largest = 1.33;
  EXPECT_TRUE(says(small.told(), "choice.largest is said to be 1.3")) << small.told();
}

TEST(SolidChoice, FacesThatAreAsCastMayLieDeeper) {
  // The underside is triangles 0 and 1, and all others lie no deeper than 1.
  const auto files = [](double largest) {
    Chosen as_cast;
    as_cast.largest = largest;
    SolidResultFiles made = as_cast.files();
    const Json features{
        {"minimum", 0},
        {"features", Json::array({Json{{"name", "under"}, {"triangles", {0, 1}}, {"as_cast", true}}})}};
    SolidResultFiles demands = cases::with_demands(
        features, Json::array({cases::demand_of_result("under", 2, nullptr, nullptr)}), nullptr, 0.75, 1);
    demands.result["choice"] = made.result["choice"], demands.result["z"] = 0.25;
    demands.result["clearance"] = 0.75, demands.result["contacts"] = Json::array();
    demands.result["status"] = "unproved";
    return demands;
  };
  EXPECT_EQ(files(1.01).told(), "unproved") << files(1.01).told();
  EXPECT_TRUE(says(files(1.25).told(), "choice.largest is said to be 1.2")) << files(1.25).told();
  SolidResultFiles more = files(1.01);
  more.result["choice"]["margin_found"] = 1.1, more.result["choice"]["give_up"] = 0.5;
  EXPECT_TRUE(says(more.told(), "choice.margin_found 1.1 is above the bound 1")) << more.told();
}

/// The top of that cube alone demands something: 0.75 over it are left everywhere, and half a millimetre
/// should be.
SolidResultFiles evened(Json deviation = 0.25, Json largest_found = 0.7525, Json target = 0.5) {
  const Json top{{"name", "top"}, {"plane", {{"normal", {0, 0, 1}}, {"at", 5}, {"within", 0}}}};
  Json features{{"minimum", 0}, {"features", Json::array({top})}};
  Json told = cases::demand_of_result("top", 2, 0, 1);
  for (Json* one : {&features["features"][0], &told})
    if (!target.is_null()) (*one)["target"] = target;
  const Json rest{{"name", "rest"}, {"triangles", Json::array()}, {"as_cast", true}};
  features["features"].push_back(rest);
  // All but the triangles of the top, whichever these are.
  const solid::Mesh cube = cases::block({-5, -5, -5}, {5, 5, 5});
  for (std::uint32_t t = 0; t < cube.triangles.size(); ++t) {
    double height = 0;
    for (const std::uint32_t v : cube.triangles[t]) height += cube.vertices[v].z;
    if (height < 14) features["features"][1]["triangles"].push_back(t);
  }
  SolidResultFiles made = cases::with_demands(
      features, Json::array({told, cases::demand_of_result("rest", 10, nullptr, nullptr)}), nullptr, 0.75, 1);
  made.result["choice"] = {{"criterion", "even"}, {"give_up", 0.25},        {"margin_found", 1},
                           {"largest", 0.7525},   {"deviation", deviation}, {"largest_found", largest_found}};
  made.result["z"] = 0.25, made.result["clearance"] = 0.75, made.result["contacts"] = Json::array();
  made.result["status"] = "unproved";
  return made;
}

TEST(SolidChoice, HowEvenAllowancesAreIsMeasured) {
  EXPECT_EQ(evened().told(), "unproved");
  for (const double wrong : {0.2499, 0.2501, 0.0})
    EXPECT_TRUE(says(evened(wrong).told(), "choice.deviation is said to be")) << evened(wrong).told();
  // It is told to 2^-20 of the largest allowance.
  EXPECT_EQ(evened(0.25 + 0.5 * 0x1p-20).told(), "unproved");
  EXPECT_TRUE(says(evened(0.25 + 0x1p-20).told(), "choice.deviation is said to be"));
  // Without a target the mean is aimed at, and all of the top has that.
  EXPECT_EQ(evened(0, 0.7525, nullptr).told(), "unproved");
  EXPECT_TRUE(says(evened(0.25, 0.7525, nullptr).told(), "choice.deviation is said to be 0.25, but it is"))
      << evened(0.25, 0.7525, nullptr).told();
  SolidResultFiles other = evened();
  other.result["demands"]["features"][0]["target"] = 0.6;
  EXPECT_TRUE(says(other.told(), "demands.features[0] has the target 0.6, but features.json says 0.5"))
      << other.told();
  other.result["demands"]["features"][0].erase("target");
  EXPECT_TRUE(says(other.told(), "demands.features[0] has the target nothing")) << other.told();
}

TEST(SolidChoice, PointsByAreaTellHowEvenTheCubeLies) {
  // Of the faces the top has 0.75, the underside up to 1.25, and all others 1 but near the top. In between is
  // what a much finer sum over them says.
  Chosen whole;
  whole.criterion = "even";
  SolidResultFiles files = whole.files();
  double squares = 0, sum = 0;
  constexpr int kSteps = 400;
  std::vector<double> all;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double u = 10 * (i + 0.5) / kSteps - 5, v = 10 * (j + 0.5) / kSteps - 5;
      const double beside = 6 - std::max(std::abs(u), std::abs(v)), up = 5.75 - v;
      all.push_back(std::min(0.75, beside));
      all.push_back(std::min(1.25, beside));
      for (int side = 0; side < 4; ++side) all.push_back(std::min({1.0, 6 - std::abs(u), up, 6.25 + v}));
    }
  for (const double one : all) sum += one;
  for (const double one : all) squares += std::pow(one - sum / static_cast<double>(all.size()), 2);
  const double there = std::sqrt(squares / static_cast<double>(all.size()));
  files.result["choice"]["largest_found"] = 1.2525;
  files.result["choice"]["deviation"] = 0;
  const std::string told = files.told();
  const std::string words = "choice.deviation is said to be 0, but it is ";
  ASSERT_TRUE(says(told, words)) << told;
  const double measured = std::stod(told.substr(told.find(words) + words.size()));
  EXPECT_NEAR(measured, there, 0.03 * there);
  files.result["choice"]["deviation"] = measured;
  EXPECT_EQ(files.told(), "unproved");
}

TEST(SolidChoice, NoMoreOfTheLargestAllowanceIsGivenUpThanIsSaid) {
  EXPECT_EQ(evened(0.25, 0.5025).told(), "unproved");
  EXPECT_TRUE(says(evened(0.25, 0.5).told(),
                   "choice.largest 0.7525 is above choice.largest_found 0.5 and choice.give_up 0.25"))
      << evened(0.25, 0.5).told();
}

TEST(SolidChoice, OnlyWhatIsEvenHasADeviation) {
  for (const char* field : {"deviation", "largest_found"}) {
    SolidResultFiles without = evened();
    without.result["choice"].erase(field);
    EXPECT_TRUE(says(without.told(), "is missing of a placement by the criterion even")) << without.told();
    SolidResultFiles nothing = evened();
    nothing.result["choice"][field] = nullptr;
    EXPECT_TRUE(says(nothing.told(), "choice needs largest_found and deviation")) << nothing.told();
    SolidResultFiles more = Chosen{}.files();
    more.result["choice"][field] = 1;
    EXPECT_TRUE(says(more.told(), "is of a placement by the criterion even")) << more.told();
  }
}

TEST(SolidChoice, OthersAreRefused) {
  Chosen other;
  other.criterion = "smallest";
  EXPECT_TRUE(says(other.told(), "field choice.criterion is \"smallest\", not \"largest\", \"even\""))
      << other.told();
  Chosen half;
  half.largest = nullptr;
  EXPECT_TRUE(says(half.told(), "choice needs margin_found and largest")) << half.told();
  half.largest = 1.2525, half.margin_found = nullptr;
  EXPECT_TRUE(says(half.told(), "choice needs margin_found and largest")) << half.told();
  Chosen none;
  none.inside = false;
  EXPECT_TRUE(says(none.told(), "choice has margin_found and largest")) << none.told();
  Chosen huge;
  huge.largest = 1e300;
  EXPECT_TRUE(says(huge.told(), "beyond all sizes")) << huge.told();
  SolidResultFiles empty = Chosen{}.files();
  for (const Json& value : {Json(), Json(5), Json("largest"), Json::array()}) {
    empty.result["choice"] = value;
    EXPECT_TRUE(says(empty.told(), "bad input")) << value << empty.told();
  }
  for (const char* field : {"criterion", "give_up", "margin_found", "largest"}) {
    SolidResultFiles without = Chosen{}.files();
    without.result["choice"].erase(field);
    EXPECT_TRUE(says(without.told(), "bad input")) << field << without.told();
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_choice_test

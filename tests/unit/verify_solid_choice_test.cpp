// How a placement of solids was chosen of those with nearly the largest margin: what the checker holds of it.

#include <gtest/gtest.h>

#include <string>

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
  Chosen unbounded;
  unbounded.bound = nullptr;
  EXPECT_EQ(unbounded.told(), "unproved");
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

TEST(SolidChoice, OthersAreRefused) {
  Chosen other;
  other.criterion = "even";
  EXPECT_TRUE(says(other.told(), "field choice.criterion is \"even\", not \"largest\"")) << other.told();
  Chosen half;
  half.largest = nullptr;
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

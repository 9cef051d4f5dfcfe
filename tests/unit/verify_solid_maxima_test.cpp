// Maxima of faces: what the checker recomputes at a pose, and the bodies of certificates.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <tuple>

#include "support/solid_results.hpp"

namespace lekalo::verify::verify_solid_maxima_test {
namespace {

using cases::demand_of_result;
using cases::Json;
using cases::one_leaf;
using cases::SolidResultFiles;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// The cube of half edges 5 in that of 6, whose top (triangles 2 and 3) may not lie deeper than 0.75: so it
/// lies 0.25 higher, and has no more. The certificate has a point of the top below the half-space z <= 6, and
/// not in a body that reaches up to z = 5.25.
struct Deep {
  double maximum = 0.75, largest = 0.75, bound = 0.75, margin = 0.7499, multiplier = 1;
  bool inside = true;
  /// The top may stick out by 0.75, too. What holds the part is the edge of the face x = 5 below it.
  bool finished = false;
  std::array<double, 3> at{0, 0, 0.25 + 0x1p-20};
  Json body = {-5, -5, 0, 10, 0, 0, 0, 10, 0, 0, 0, 5.25, 0.75};
  Json on_part = {2, 0.25, 0.5};
  int side = 5, bounded = 0;

  [[nodiscard]] SolidResultFiles files() const {
    const Json features{
        {"minimum", 0},
        {"features", Json::array({Json{{"name", "top"}, {"triangles", {2, 3}}, {word(), maximum}}})}};
    Json certificate = one_leaf(Json::array({{"point_plane", bounded, 0, 1}, {"near", 0, side, multiplier}}),
                                Json::array(), Json::array(), Json::array({{0, 0, -1, -6}}));
    certificate["part_points"] = Json::array({on_part, Json{10, 0, 1}});
    certificate["bodies"] = Json::array({body});
    Json of_result = demand_of_result("top", 2, finished ? Json() : Json(0), finished ? Json() : Json(1));
    of_result["as_cast"] = false;
    of_result[word()] = maximum, of_result["largest"] = largest;
    SolidResultFiles made =
        cases::with_demands(features, Json::array({of_result}), certificate, margin, bound);
    made.result["clearance"] = margin;
    made.result["contacts"] = Json::array();
    made.result["x"] = at[0], made.result["y"] = at[1], made.result["z"] = at[2];
    if (!inside) {
      made.result["status"] = "stopped", made.result["inside"] = false;
      for (const char* field : {"clearance", "shortfall"}) made.result[field] = nullptr;
      for (const char* field : {"margin", "margin_gap"}) made.result["demands"][field] = nullptr;
    }
    return made;
  }
  [[nodiscard]] const char* word() const { return finished ? "finished" : "maximum"; }
  [[nodiscard]] std::string told() const { return files().told(); }
};

TEST(SolidMaxima, ABodyBoundsTheMarginToTheLastDigit) {
  EXPECT_EQ(Deep{}.told(), "confirmed");
  Deep less;
  less.bound = 0.75 - 1e-12, less.margin = 0.7;
  EXPECT_TRUE(says(less.told(), "do not prove"));
  Deep weaker;
  weaker.multiplier = 0.9999;
  EXPECT_TRUE(says(weaker.told(), "do not prove"));
}

TEST(SolidMaxima, ABodyHasToStayAwayFromTheBlank) {
  Deep near;
  near.body[11] = std::nextafter(5.25, 6);
  EXPECT_TRUE(says(near.told(), "certificate.bodies[0] is not what it has to be: triangle")) << near.told();
  // The side walls count as well.
  Deep wide;
  wide.body[0] = -5.25 - 1e-9;
  EXPECT_TRUE(says(wide.told(), "comes nearer to it")) << wide.told();
  wide.body[0] = -5.25;
  EXPECT_EQ(wide.told(), "confirmed");
  Deep flat;
  flat.body[3] = 0;
  EXPECT_TRUE(says(flat.told(), "it is flat")) << flat.told();
  // All of the blank lies in one that is large enough.
  Deep around;
  around.body = {-50, -50, -50, 100, 0, 0, 0, 100, 0, 0, 0, 100, 0.75};
  EXPECT_TRUE(says(around.told(), "a surface of the blank lies in it")) << around.told();
  // Less than the maximum is not enough.
  Deep close;
  close.body[12] = 0.7499;
  EXPECT_TRUE(says(close.told(), "and the part's triangle 2 may be 0.75 mm from it")) << close.told();
}

// A point that only touches its body may lie there: terms of the place alone have to be below 0.
TEST(SolidMaxima, APointThatTouchesItsBodyIsNotShutOut) {
  Deep touching;  // raised by half a millimetre, the most there is
  touching.maximum = touching.largest = 0.5, touching.at[2] = 0.5, touching.margin = 0.5;
  touching.body[11] = 5.5, touching.body[12] = 0.5;
  SolidResultFiles files = touching.files();
  files.result["certificate"]["trees"][0]["nodes"][0] = Json::array({Json::array({"near", 0, 5, 1})});
  EXPECT_TRUE(says(files.told(), "do not prove")) << files.told();
}

TEST(SolidMaxima, ThePointHasToStayInsideOnTheOtherSides) {
  // Moved by up to 0.5 it leaves a body that ends at x = -2.9, or that begins at x = -2.
  for (const double from : {-5.0, -2.0}) {
    Deep narrow;
    narrow.body[0] = from, narrow.body[3] = from < -2 ? 2.1 : 5;
    EXPECT_TRUE(says(narrow.told(), "do not prove")) << from;
  }
  // Another side says nothing here, and there is no seventh.
  Deep other;
  other.side = 4;
  EXPECT_TRUE(says(other.told(), "do not prove"));
  other.side = 6;
  EXPECT_TRUE(says(other.told(), "has a term that is none"));
}

TEST(SolidMaxima, APointOfAnotherTriangleMayBeAnywhere) {
  Deep bottom;
  bottom.on_part = {0, 0.25, 0.5};
  EXPECT_TRUE(says(bottom.told(), "the part's triangle 0 may be anyhow far from it")) << bottom.told();
}

TEST(SolidMaxima, TheLargestAllowanceIsThatOfAllPoints) {
  Deep small;
  small.largest = 0.75 - 0x1p-20 - 1e-9;
  EXPECT_TRUE(says(small.told(), "feature \"top\": its largest allowance is said to be")) << small.told();
  // To the last digit it is not told.
  small.largest = 0.75 - 0x1p-20;
  EXPECT_EQ(small.told(), "incomplete");
  // A little more is said as a rule, but more than the maximum is not inside.
  Deep large;
  large.maximum = 0.765625, large.largest = 0.7501, large.body[12] = 0.765625, large.body[11] = 5.234375;
  large.bound = 0.77;
  EXPECT_EQ(large.told(), "confirmed");
  large.largest = 0.9;
  EXPECT_TRUE(says(large.told(), "its largest allowance is said to be 0.")) << large.told();
  EXPECT_TRUE(says(large.told(), "inside is true, but a maximum is not kept"));
}

// The first triangle of the part counts as the others do: the bottom is 1.25 deep here.
TEST(SolidMaxima, TheFirstTriangleCounts) {
  SolidResultFiles files = Deep{}.files();
  const auto of = [&](double largest) {
    files.features =
        Json{{"minimum", 0},
             {"features", Json::array({Json{{"name", "top"}, {"triangles", {0}}, {"maximum", 2}}})}}
            .dump();
    Json& feature = files.result["demands"]["features"][0];
    feature = demand_of_result("top", 1, 0, 1);
    feature["maximum"] = 2, feature["largest"] = largest;
    return files.told();
  };
  EXPECT_TRUE(says(of(1.2), "its largest allowance is said to be 1.2, but it is 1.25")) << of(1.2);
  EXPECT_FALSE(says(of(1.2500019), "its largest")) << of(1.2500019);
  EXPECT_TRUE(says(of(1.9), "its largest allowance is said to be 1.9, but it is 1.25")) << of(1.9);
}

TEST(SolidMaxima, TermsNeedAPointABodyAndAMaximum) {
  for (const auto& [part, body] : {std::pair{9, 5}, {0, 6}, {7, 5}, {0, 600}}) {
    SolidResultFiles files = Deep{}.files();
    files.result["certificate"]["trees"][0]["nodes"][0][1] = Json::array({"near", part, body, 1});
    EXPECT_TRUE(says(files.told(), "has a term that is none")) << part << " " << body << files.told();
  }
  Deep off_its_triangle;
  off_its_triangle.on_part = {2, 0.75, 0.5};
  EXPECT_NE(off_its_triangle.told(), "confirmed");
  // A result without demands has no maximum that a body could stand for, nor has one without maxima.
  SolidResultFiles without = Deep{}.files();
  without.result["demands"] = nullptr, without.features.reset();
  without.result["inputs"].erase(2);
  without.result["upper_bound"] = 1, without.result["gap"] = 0.5;
  EXPECT_TRUE(says(without.told(), "may be anyhow far from it")) << without.told();
  SolidResultFiles none = Deep{}.files();
  none.features =
      Json{{"minimum", 0}, {"features", Json::array({Json{{"name", "top"}, {"triangles", {2, 3}}}})}}.dump();
  none.result["demands"]["features"][0] = demand_of_result("top", 2, 0, 1);
  EXPECT_TRUE(says(none.told(), "may be anyhow far from it")) << none.told();
  // A maximum of null is none.
  none.features =
      Json{{"minimum", 0},
           {"features", Json::array({Json{{"name", "top"}, {"triangles", {2, 3}}, {"maximum", nullptr}}})}}
          .dump();
  EXPECT_TRUE(says(none.told(), "may be anyhow far from it")) << none.told();
}

TEST(SolidMaxima, APoseThatBreaksOneIsNotInside) {
  Deep broken;
  broken.at[2] = 0, broken.largest = 1.0001, broken.inside = false;
  EXPECT_EQ(broken.told(), "confirmed");
  broken.inside = true;
  EXPECT_TRUE(says(broken.told(), "inside is true, but a maximum is not kept")) << broken.told();
  // One that keeps them all is.
  Deep kept;
  kept.inside = false;
  EXPECT_TRUE(
      says(kept.told(), "inside is false, but all of the part that demands something lies in the blank"));
}

TEST(SolidMaxima, AFinishedFaceIsHeldAndDemandsNothing) {
  Deep deep;
  deep.finished = true, deep.bounded = 1;
  EXPECT_EQ(deep.told(), "confirmed");
  Deep less = deep;
  less.bound = 0.75 - 1e-12, less.margin = 0.7;
  EXPECT_TRUE(says(less.told(), "do not prove"));
  // Nothing is demanded of its points.
  Deep of_top = deep;
  of_top.bounded = 0;
  EXPECT_TRUE(says(of_top.told(), "has a term of the part's triangle 2, which is as cast or finished"));
  Deep far = deep;
  far.at[2] = 0.2, far.largest = 0.75;
  EXPECT_TRUE(says(far.told(), "feature \"top\": its distance from the blank's surface is said to be 0.75"))
      << far.told();
  far.largest = 0.8001;
  EXPECT_TRUE(says(far.told(), "inside is true, but a finished face is too far from the blank's surface"))
      << far.told();
  SolidResultFiles files = deep.files();
  Json& feature = files.result["demands"]["features"][0];
  feature["as_cast"] = true;
  EXPECT_TRUE(says(files.told(), "\"top\" has 2 triangles that are finished")) << files.told();
  feature["as_cast"] = false, feature["finished"] = 0.8;
  EXPECT_TRUE(says(files.told(), "demands.features[0] is finished to 0.8, but features.json says 0.75"));
  feature["maximum"] = 0.75;
  EXPECT_TRUE(says(files.told(), "has a maximum and is finished"));
}

/// The cube whose top is finished, 0.75 below the blank's. Its sides have 1 below a rim of half a millimetre;
/// the certificate has a point of two of them, and the half-spaces in front.
struct Rimmed {
  double rim = 0.5, of_result = 0.5, margin = 0.9999, at = 0.95;
  Json on_part = {10, 0, at};

  [[nodiscard]] std::string told() const {
    Json top{{"name", "top"}, {"triangles", {2, 3}}, {"finished", 0.75}};
    if (rim != 0) top["rim"] = rim;
    Json certificate = one_leaf(Json::array({{"point_plane", 0, 0, 1}, {"point_plane", 1, 1, 1}}),
                                Json::array(), Json::array(), Json::array({{-1, 0, 0, -6}, {1, 0, 0, -6}}));
    certificate["part_points"] = Json::array({on_part, Json{8, 0.5, 0}});
    Json said{{"name", "top"},    {"triangles", 2},   {"minimum", nullptr}, {"scale", nullptr},
              {"as_cast", false}, {"finished", 0.75}, {"largest", 0.75}};
    if (of_result != 0) said["rim"] = of_result;
    SolidResultFiles made = cases::with_demands({{"minimum", 0}, {"features", Json::array({top})}},
                                                Json::array({said}), certificate, margin, 1);
    made.result["clearance"] = margin;
    made.result["contacts"] = Json::array();
    made.result["z"] = 0.25 + 0x1p-20;
    return made.told();
  }
};

TEST(SolidMaxima, ARimDemandsNothing) {
  EXPECT_EQ(Rimmed{}.told(), "confirmed");
  // Right below it there is 1.25, so that more than the sides have may be asked for there, and not above.
  Rimmed narrow;
  narrow.rim = narrow.of_result = 0.25 + 0x1p-8;
  EXPECT_EQ(narrow.told(), "confirmed");
  narrow.rim = narrow.of_result = 0.2499;
  EXPECT_TRUE(says(narrow.told(), "mm is above 0.99989904")) << narrow.told();
  Rimmed none;
  none.rim = none.of_result = 0;
  EXPECT_TRUE(says(none.told(), "the clearance 0.9999 mm is above 0.7")) << none.told();
  none.of_result = 0.5;
  EXPECT_TRUE(says(none.told(), "demands.features[0] has the rim 0.5, but features.json says 0"));
}

TEST(SolidMaxima, ATermOfARimProvesNothing) {
  // The point is half a millimetre from the top, to the last digit.
  Rimmed nearer;
  nearer.on_part = {10, 0, 0.9500000001};
  EXPECT_TRUE(says(nearer.told(), "has a term of the part's triangle 10 in the rim of a finished face"))
      << nearer.told();
  Rimmed of_top;
  of_top.on_part = {2, 0.25, 0.5};
  EXPECT_TRUE(says(of_top.told(), "has a term of the part's triangle 2, which is as cast or finished"))
      << of_top.told();
}

TEST(SolidMaxima, TheFileOfFeaturesSaysOneThing) {
  for (const auto& [key, value, words] :
       {std::tuple<const char*, Json, const char*>{"minimum", 1, "minimum is a demand on what is finished"},
        {"as_cast", true, "finished is a demand on what is as cast"},
        {"finished", 0, "finished is not above 0"}}) {
    Deep deep;
    deep.finished = true;
    SolidResultFiles files = deep.files();
    Json features = Json::parse(*files.features);
    features["features"][0][key] = value;
    files.features = features.dump();
    EXPECT_TRUE(says(files.told(), words)) << files.told();
  }
}

TEST(SolidMaxima, TheResultSaysWhatTheFileSays) {
  SolidResultFiles files = Deep{}.files();
  Json& feature = files.result["demands"]["features"][0];
  feature["maximum"] = 0.8;
  EXPECT_TRUE(says(files.told(), "demands.features[0] has the maximum 0.8, but features.json says 0.75"));
  feature.erase("maximum");
  EXPECT_TRUE(says(files.told(), "has one of a maximum and a largest allowance"));
  feature.erase("largest");
  EXPECT_TRUE(says(files.told(), "demands.features[0] has the maximum nothing, but features.json says 0.75"));
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_maxima_test

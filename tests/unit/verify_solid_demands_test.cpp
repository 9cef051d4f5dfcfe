// Demands by face of a solid: the checker finds the triangles of a file of features itself, and holds margin
// and certificate against what they demand.

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/solid_results.hpp"
#include "verify/solid/solid_features.hpp"

namespace lekalo::verify::verify_solid_demands_test {
namespace {

using cases::demand_of_result;
using cases::Json;
using cases::one_leaf;
using cases::SolidResultFiles;
using cases::with_demands;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// The cube of half edges 5 in that of 6: 0.5 is left for all but the top, which needs 0.25 and counts half.
/// Triangles 2 and 3 are the top, 0 and 1 the bottom, 10 and 11 the side of x = 5.
Json top_features() {
  return {{"minimum", 0.5},
          {"features", Json::array({Json{{"name", "top"},
                                         {"plane", {{"normal", {0, 0, 2}}, {"at", 5}, {"within", 0}}},
                                         {"minimum", 0.25},
                                         {"scale", 2}}})}};
}
/// A point of the top and one of the bottom below half-spaces: with shifts by z they have 0.75 - z and 0.5 +
/// z left, so that the best margin is 1.25 / 3, at z = -1 / 12.
Json by_points() {
  Json made = one_leaf(Json::array({{"point_plane", 0, 0, 1}, {"point_plane", 1, 1, 1}}), Json::array(),
                       Json::array(), Json::array({{0, 0, -1, -6}, {0, 0, 2, -12}}));
  made["part_points"] = Json::array({{2, 0.25, 0.5}, {0, 0.5, 0.125}});
  return made;
}

SolidResultFiles top(double bound = 0.4166666666666667, double margin = 0.375) {
  return with_demands(top_features(), Json::array({demand_of_result("top", 2, 0.25, 2)}), by_points(), margin,
                      bound);
}

TEST(SolidDemands, PointsProveTheBestMarginToTheLastDigits) {
  EXPECT_EQ(top().told(), "confirmed");
  EXPECT_TRUE(says(top(0.4166666666666666).told(),
                   "refuted; certificate.trees[0].nodes[0]: its terms do not prove that no placement with"));
  EXPECT_TRUE(says(top(0.4166666666666666).told(), "has more margin than 0.416666666666666"));
  EXPECT_TRUE(
      says(top(0.42, std::nextafter(0.375, 1)).told(), "refuted; feature \"top\": triangle 3 of the part"));
}

/// The top has 0.375 left, as each kind of term says, wherever it is shifted by 0.1 along x and y.
TEST(SolidDemands, EachTermCountsWithTheDemandOfItsTriangle) {
  const double exact = (1 - 0.25) / 2;
  // A ball of radius 1000 above the blank; a triangle of its top, and the part's over a ball.
  const Json balls = Json::array({{-2, -2, 1006, 1000}}), none = Json::array();
  for (const auto& [term, spare] : {std::pair{Json{"point", 0, 0, 1}, 1e-5},
                                    {Json{"point_face", 0, 2, 1}, 0.0},
                                    {Json{"point_plane", 0, 0, 1}, 0.0},
                                    {Json{"part_face", 2, 0, 1}, 0.0}}) {
    Json certificate = one_leaf(Json::array({term}), none, balls, Json::array({{0, 0, -1, -6}}), 0.5);
    certificate["part_points"] = Json::array({{2, 0.3, 0.3}});
    const auto with = [&](double bound) {
      SolidResultFiles files = with_demands(
          top_features(), Json::array({demand_of_result("top", 2, 0.25, 2)}), certificate, exact, bound);
      // One pose is looked at, and shifts along x and y.
      files.result["window"]["shift"] = 0;
      Json& tree = files.result["certificate"]["trees"][0];
      tree["z"] = {0, 0}, tree["x"] = {-0.1, 0.1}, tree["y"] = {-0.1, 0.1};
      return files.told();
    };
    EXPECT_EQ(with(exact + spare), "confirmed") << term;
    EXPECT_TRUE(says(with(exact - 1e-9), "do not prove")) << term;
  }
}

/// Edges of the bottom's first triangle and of the top pass cores 2 below and above them.
TEST(SolidDemands, AnEdgeCountsWithTheTriangleThatItIsNamedBy) {
  const Json features{
      {"minimum", 0.125},
      {"features", Json::array({Json{{"name", "half"}, {"triangles", {0}}, {"minimum", 0.5}, {"scale", 2}},
                                Json{{"name", "rough"}, {"triangles", {4}}, {"as_cast", true}}})}};
  const auto with = [&](int edge, double bound) {
    SolidResultFiles files = with_demands(
        features,
        Json::array({demand_of_result("half", 1, 0.5, 2), demand_of_result("rough", 1, nullptr, nullptr)}),
        one_leaf(Json::array({{"edges", edge, 45, 1}, {"edges", 6, 77, 1}}), Json::array(), Json::array(),
                 Json::array()),
        0.75, bound);
    solid::Mesh blank = cases::block({-20, -20, -20}, {20, 20, 20});
    cases::append(blank, cases::block({-9, -8, -8}, {3, 8, -7}));
    cases::append(blank, cases::block({-9, -8, 7}, {3, 8, 8}));
    files.blank = solid_files::stl_binary(blank);
    files.result["inputs"][1]["triangles"] = 36, files.result["contacts"] = Json::array();
    return files.told();
  };
  // Half of 1.5 is left below and 1.875 above: with shifts by z the sum of both is 3.375 / 3 for each.
  EXPECT_EQ(with(2, 1.125 + 1e-12), "confirmed");
  EXPECT_TRUE(says(with(2, 1.125 - 1e-12), "do not prove"));
  // The same edge by its other triangle, which is as cast.
  EXPECT_TRUE(
      says(with(12, 1.125 + 1e-12), "nodes[0] has a term of the part's triangle 4, which is as cast"));
  // The diagonal by the bottom's other triangle, which demands as the top does.
  EXPECT_EQ(with(3, 1.875 + 1e-12), "confirmed");
  EXPECT_TRUE(says(with(3, 1.875 - 1e-12), "do not prove"));
}

TEST(SolidDemands, BallsOfThePartNeedThatNothingIsAsCast) {
  Json balls = one_leaf(Json::array({{"plane", 0, 0, 1}, {"plane", 1, 1, 1}}),
                        Json::array({{0, 0, 5, 0}, {0, 0, -5, 0}}), Json::array(),
                        Json::array({{0, 0, -1, -6}, {0, 0, 1, -6}}));
  const auto with = [&](double bound) {
    SolidResultFiles files = top(bound);
    files.result["certificate"] = balls;
    return files;
  };
  // The least that any triangle demands counts: 0.5 and the margin.
  EXPECT_EQ(with(0.5).told(), "confirmed");
  EXPECT_TRUE(says(with(0.4999).told(), "do not prove"));
  SolidResultFiles files = with(0.5);
  Json features = top_features();
  features["features"].push_back(Json{{"name", "rough"}, {"triangles", {10, 11}}, {"as_cast", true}});
  files.features = features.dump();
  files.result["demands"]["features"].push_back(demand_of_result("rough", 2, nullptr, nullptr));
  EXPECT_TRUE(says(files.told(), "nodes[0] has a part ball, but something of the part is as cast"));
  files.result["certificate"] = by_points();
  files.result["demands"]["margin_bound"] = 0.4166666666666667;
  files.result["demands"]["margin_gap"] = 0.4166666666666667 - 0.375;
  EXPECT_EQ(files.told(), "confirmed");
  files.result["certificate"]["part_points"][1] = {10, 0, 0};
  EXPECT_TRUE(says(files.told(), "nodes[0] has a term of the part's triangle 10, which is as cast"));
}

TEST(SolidDemands, PointsAreInTheirTriangles) {
  for (const auto& [row, words] :
       {std::pair{Json{2, -0.001, 0.5}, "part_points[0] is not what it has to be: it is not in its triangle"},
        {Json{2, 0.5, -0.1}, "is not in its triangle"},
        {Json{2, 0.75, 0.5}, "is not in its triangle"},
        {Json{12, 0, 0}, "its triangle is none of the part"},
        {Json{2.5, 0, 0}, "its triangle is none of the part"},
        {Json{-1, 0, 0}, "its triangle is none of the part"},
        {Json{2, 0}, "bad input: result.json: certificate.part_points[0] is not a list of 3 numbers"}}) {
    SolidResultFiles files = top(0.6);
    files.result["demands"]["margin_gap"] = 0.6 - 0.375;
    files.result["certificate"]["part_points"][0] = row;
    EXPECT_TRUE(says(files.told(), words)) << files.told();
  }
  // Corners and sides are of it.
  for (const Json& row : {Json{2, 0, 0}, Json{2, 1, 0}, Json{2, 0.5, 0.5}}) {
    SolidResultFiles files = top();
    files.result["certificate"]["part_points"][0] = row;
    EXPECT_EQ(files.told(), "confirmed");
  }
}

TEST(SolidDemands, WhatTheResultSaysOfThemIsHeldAgainstTheFile) {
  const auto with = [](const char* path, Json value) {
    SolidResultFiles files = top();
    files.result.at(path) = std::move(value);
    return files.told();
  };
  EXPECT_TRUE(says(with("/demands/minimum", 0.25),
                   "refuted; demands.minimum is 0.25, but features.json demands 0.5"));
  for (const auto& [path, value] : {std::pair{"/demands/features/0/name", Json("bottom")},
                                    {"/demands/features/0/triangles", Json(3)},
                                    {"/demands/features/0/minimum", Json(0.2)},
                                    {"/demands/features/0/scale", Json(2.5)},
                                    {"/demands/features/0/scale", Json()},
                                    {"/demands/features/0/as_cast", Json(true)}})
    EXPECT_TRUE(
        says(with(path, value),
             "demands.features[0] is not what features.json says: \"top\" has 2 triangles, minimum 0.25 and "
             "scale 2"))
        << path;
  EXPECT_TRUE(says(with("/demands/features", Json::array()),
                   "demands.features has 0 features, but features.json has 1"));
  EXPECT_TRUE(says(with("/demands/margin", nullptr), "inside is true, but there is no margin"));
  EXPECT_TRUE(says(with("/demands/margin_gap", nullptr), "margin_gap is null"));
  EXPECT_TRUE(says(with("/demands/margin_gap", 0.1), "margin_gap is not margin_bound less margin"));
  EXPECT_TRUE(says(with("/shortfall", 0.1), "shortfall is not what is missing of a margin of 0"));
  EXPECT_TRUE(
      says(with("/upper_bound", 1), "there is an upper_bound or a gap, but demands have a margin_bound"));
  EXPECT_TRUE(says(with("/clearance", 1.0001), "is above"));
  EXPECT_TRUE(says(with("/status", "infeasible"), "status is infeasible, but margin_bound 0.41666"));
  EXPECT_TRUE(says(with("/demands", nullptr), "inputs name 1 files of features, and there are no demands"));
  EXPECT_TRUE(
      says(with("/inputs/2/role", "start"), "inputs name 0 files of features, and there are demands"));
  EXPECT_TRUE(says(with("/min_allowance", 0.75), "demands.minimum is 0.5, but features.json demands 0.75"));
  SolidResultFiles gone = top();
  gone.features.reset();
  EXPECT_TRUE(says(gone.told(), "incomplete"));
}

/// The side of x = -5 alone has a demand. The blank ends at x = 4.
TEST(SolidDemands, WhatIsAsCastMayStickOut) {
  Json features{
      {"minimum", 0.5},
      {"features",
       Json::array(
           {Json{{"name", "rough"}, {"triangles", {0, 1, 2, 3, 4, 5, 6, 7, 10, 11}}, {"as_cast", true}}})}};
  Json certificate = one_leaf(Json::array({{"point_plane", 0, 0, 1}}), Json::array(), Json::array(),
                              Json::array({{1, 0, 0, -6}}));
  certificate["part_points"] = Json::array({{8, 0.25, 0.5}});
  SolidResultFiles files = with_demands(
      features, Json::array({demand_of_result("rough", 10, nullptr, nullptr)}), certificate, 0.5, 1);
  files.result["contacts"] = Json::array();
  const auto in = [&](const solid::Mesh& blank) {
    files.blank = solid_files::stl_binary(blank);
    files.result["inputs"][1]["triangles"] = blank.triangles.size();
    return files.told();
  };
  const solid::Mesh shorter = cases::block({-6, -6, -6}, {4, 6, 6});
  EXPECT_EQ(in(shorter), "confirmed");
  EXPECT_TRUE(says(in(cases::block({-5, -6, -6}, {4, 6, 6})), "refuted"));
  EXPECT_TRUE(says(in(cases::block({-4, -6, -6}, {4, 6, 6})), "refuted"));
  // A core that the part swallows, and one that sticks out of it.
  solid::Mesh cored = shorter;
  cases::append(cored, cases::block({-1, -1, -1}, {1, 1, 1}));
  EXPECT_TRUE(
      says(in(cored), "all of the blank's surface that hangs together at (-1, -1, -1) lies within the part"));
  // Corners on the part's surface do not stick out of it.
  cored = shorter;
  cases::append(cored, cases::block({-1, -1, -1}, {1, 1, 5}));
  EXPECT_TRUE(says(in(cored), "hangs together at (-1, -1, -1) lies within the part"));
  cored = shorter;
  cases::append(cored, cases::block({-1, -1, -1}, {1, 1, 5.5}));
  EXPECT_EQ(in(cored), "confirmed");
  // That it is not inside has to be so, too.
  files.result["inside"] = false;
  for (const char* one : {"clearance", "shortfall"}) files.result[one] = nullptr;
  files.result["demands"]["margin"] = files.result["demands"]["margin_gap"] = nullptr;
  files.result["status"] = "stopped";
  EXPECT_TRUE(
      says(in(shorter), "inside is false, but all of the part that demands something lies in the blank"));
  EXPECT_EQ(in(cases::block({-4, -6, -6}, {4, 6, 6})), "confirmed");
}

// ---- which triangles a feature has ------------------------------------------------------------------------

/// The triangles of the features in a part, or the refusal.
std::vector<std::vector<std::uint32_t>> found(const Json& features, const std::string& part,
                                              SolidUnit unit = SolidUnit::millimetre) {
  const auto reading = read_solid({"part", part}, unit);
  EXPECT_TRUE(reading);
  const std::string text = Json{{"features", features}}.dump();
  const auto made = read_solid_features({"features.json", text}, *reading, unit);
  EXPECT_TRUE(made) << made.error().message;
  std::vector<std::vector<std::uint32_t>> all(features.size());
  if (!made) return all;
  for (std::uint32_t t = 0; t < made->feature_of.size(); ++t)
    if (made->feature_of[t] > 0) all[made->feature_of[t] - 1].push_back(t);
  return all;
}
std::string refused(const std::string& text, const std::string& part) {
  const auto reading = read_solid({"part", part});
  const auto made = read_solid_features({"features.json", text}, *reading, SolidUnit::millimetre);
  return made ? "" : made.error().message;
}
using Numbers = std::vector<std::uint32_t>;

TEST(SolidFeatures, AreFoundExactly) {
  const std::string part = solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}));
  const auto one = [&](const char* way, Json value, SolidUnit unit = SolidUnit::millimetre) {
    return found(Json::array({Json{{"name", "a"}, {way, std::move(value)}}}), part, unit)[0];
  };
  EXPECT_EQ(one("triangles", {7, 3, 3}), (Numbers{3, 7}));
  EXPECT_EQ(one("patch", {0, 0, 40}), (Numbers{2, 3}));
  EXPECT_EQ(one("patch", {-6, 1, 0}), (Numbers{8, 9}));
  EXPECT_EQ(one("box", {{-5, -5, -5}, {5, 5, -5}}), (Numbers{0, 1}));
  EXPECT_EQ(one("box", {{-9, -9, -9}, {9, 9, -4.9999}}), (Numbers{0, 1}));
  const auto plane = [&](Json n, double at, double within) {
    return one("plane", {{"normal", std::move(n)}, {"at", at}, {"within", within}});
  };
  EXPECT_EQ(plane({0, 0, 3}, 5, 0), (Numbers{2, 3}));
  EXPECT_EQ(plane({0, 0, -0.1}, -5, 0), (Numbers{2, 3}));
  EXPECT_EQ(plane({0, 0, 1}, 4.5, 0.5), (Numbers{2, 3}));
  EXPECT_EQ(plane({0, 0, 1}, 0, 5).size(), 12U);
  // Along (1, 1, 0) the corners are at 0 and at the root of 50 on either side.
  EXPECT_EQ(plane({1, 1, 0}, 0, std::sqrt(50.0) + 1e-14).size(), 12U);
  EXPECT_TRUE(says(
      refused(
          Json{{"features",
                Json::array({Json{
                    {"name", "a"},
                    {"plane", {{"normal", {1, 1, 0}}, {"at", 0}, {"within", std::sqrt(50.0) - 1e-14}}}}})}}
              .dump(),
          part),
      "has no triangle of the part"));
  // In inches of a part in inches.
  EXPECT_EQ(one("box", {{-5, -5, -5}, {5, 5, -5}}, SolidUnit::inch), (Numbers{0, 1}));
  EXPECT_EQ(one("patch", {0, 0, 40}, SolidUnit::metre), (Numbers{2, 3}));
}

TEST(SolidFeatures, APatchEndsWhereTheSurfaceBends) {
  // Strips along y, each of two triangles, that turn by 0, 29, 29 and 31 degrees.
  std::string obj;
  double x = 0, z = 0, angle = 0;
  const double turns[]{0, 29, 29, 31};
  for (const double turn : {0.0, 0.0, 29.0, 29.0, 31.0}) {
    obj += fmt::format("v {} 0 {}\nv {} 1 {}\n", x, z, x, z);
    angle += turn * 3.14159265358979 / 180;
    x += std::cos(angle), z += std::sin(angle);
  }
  obj += fmt::format("v {} 0 {}\nv {} 1 {}\n", x, z, x, z);
  for (int k = 0; k < 5; ++k)
    obj += fmt::format("f {} {} {}\nf {} {} {}\n", 2 * k + 1, 2 * k + 3, 2 * k + 2, 2 * k + 3, 2 * k + 4,
                       2 * k + 2);
  EXPECT_EQ(std::size(turns), 4U);
  const auto patch = [&](double at) {
    return found(Json::array({Json{{"name", "a"}, {"patch", {at, 0.25, 3}}}}), obj)[0];
  };
  EXPECT_EQ(patch(0.1), (Numbers{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(SolidFeatures, LabelsAreThoseOfTheFile) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const std::string stl = "solid  top face \n" + facet + "endsolid\nsolid\n" + facet +
                          "endsolid x\nsolid top face\n" + facet + "endsolid\n";
  const auto label = [&](const char* name, const std::string& part) {
    return found(Json::array({Json{{"name", "a"}, {"label", name}}}), part)[0];
  };
  EXPECT_EQ(label("top face", stl), (Numbers{0, 2}));
  const std::string obj =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng one\nf 1 2 3\no two parts\nf 1 2 3\nf 3 2 1\ng one\nf 1 2 3\n";
  EXPECT_EQ(label("one", obj), (Numbers{1, 4}));
  EXPECT_EQ(label("two parts", obj), (Numbers{2, 3}));
}

/// The top alone has a demand, and has 1 - 0.25 of half a margin each.
TEST(SolidDemands, WhatIsOfNoFeatureMayBeAsCast) {
  Json features = top_features();
  features.erase("minimum");
  features["as_cast"] = true;
  Json certificate = one_leaf(Json::array({{"point_plane", 0, 0, 1}}), Json::array(), Json::array(),
                              Json::array({{0, 0, -1, -6}}), 0);
  certificate["part_points"] = Json::array({{2, 0.25, 0.5}});
  SolidResultFiles files = with_demands(top_features(), Json::array({demand_of_result("top", 2, 0.25, 2)}),
                                        certificate, 0.375, 0.375);
  files.features = features.dump();
  files.result["window"]["shift"] = 0;
  EXPECT_TRUE(says(files.told(), "demands.minimum is 0.5, but features.json demands nothing"));
  files.result["demands"]["minimum"] = nullptr;
  EXPECT_EQ(files.told(), "confirmed");
  // What is as cast has no term.
  files.result["certificate"]["part_points"][0] = {0, 0, 0};
  EXPECT_TRUE(says(files.told(), "has a term of the part's triangle 0, which is as cast"));
  files.features = top_features().dump();
  EXPECT_TRUE(says(files.told(), "demands.minimum is nothing, but features.json demands 0.5"));
}

TEST(SolidFeatures, FacesAreThoseOfAStepFile) {
  const std::vector<std::uint32_t> face_of{0, 0, 1, 1, 2, 2, 3, 3, 1, 1, 5, 5};
  const std::string part = solid_files::step_mesh(cases::block({-5, -5, -5}, {5, 5, 5}), "0.5", face_of,
                                                  {"", "roof", "roof", "", "", "c"});
  const auto one = [&](const char* way, Json value) {
    return found(Json::array({Json{{"name", "a"}, {way, std::move(value)}}}), part)[0];
  };
  EXPECT_EQ(one("faces", {1}), (Numbers{2, 3, 8, 9}));
  EXPECT_EQ(one("faces", {5, 0}), (Numbers{0, 1, 10, 11}));
  EXPECT_EQ(one("label", "roof"), (Numbers{2, 3, 4, 5, 8, 9}));
  EXPECT_EQ(one("label", "c"), (Numbers{10, 11}));
  // A face without a name, behind the last of them, has none.
  EXPECT_EQ(found(Json::array({Json{{"name", "a"}, {"label", "c"}}}),
                  solid_files::step_mesh(cases::block({-5, -5, -5}, {5, 5, 5}), "0.5",
                                         {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 6, 5}, {"", "", "", "", "", "c"}))[0],
            (Numbers{11}));
  const std::string coloured =
      solid_files::step_mesh(cases::block({-5, -5, -5}, {5, 5, 5}), "0.5", face_of,
                             {"", "roof", "roof", "", "", "c"}, {255, 0xff8000, 0x1000000, 255, 7, 0xff8000});
  const auto by_colour = [&](const char* colour) {
    return found(Json::array({Json{{"name", "a"}, {"colour", colour}}}), coloured)[0];
  };
  EXPECT_EQ(by_colour("#0000ff"), (Numbers{0, 1, 6, 7}));
  EXPECT_EQ(by_colour("#FF8000"), (Numbers{2, 3, 8, 9, 10, 11}));
  // Every digit of a colour counts, in capitals or not.
  const std::vector<std::uint32_t> colours{0x0099ff, 0x9900aa, 0xaaff99, 0x00aaf0, 0xf99a0f, 0};
  const auto of_colours = [&](const char* colour) {
    return found(Json::array({Json{{"name", "a"}, {"colour", colour}}}),
                 solid_files::step_mesh(cases::block({-5, -5, -5}, {5, 5, 5}), "0.5",
                                        {0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5}, std::vector<std::string>(6),
                                        colours))[0];
  };
  EXPECT_EQ(of_colours("#0099ff"), (Numbers{0, 1}));
  EXPECT_EQ(of_colours("#9900Aa"), (Numbers{2, 3}));
  EXPECT_EQ(of_colours("#AaFf99"), (Numbers{4, 5}));
  EXPECT_EQ(of_colours("#000000"), (Numbers{10, 11}));
  const auto in_colour = [](const char* colour) {
    return std::string(R"({"features": [{"name": "a", "colour": ")") + colour + "\"}]}";
  };
  EXPECT_TRUE(says(refused(in_colour("#000007"), coloured), "features[0] has no triangle of the part"));
  EXPECT_TRUE(says(refused(in_colour("#0000ff"), part), "features[0] has no triangle of the part"));
  EXPECT_TRUE(says(refused(in_colour("#0000ff"), solid_files::stl_binary(cases::block({0, 0, 0}, {1, 1, 1}))),
                   "features[0] has no triangle of the part"));
  for (const char* wrong : {"#ff80", "#ff80000", "0ff8000", "#ff800g", "#-f8000", ""})
    EXPECT_TRUE(
        says(refused(in_colour(wrong), coloured), "field features[0].colour is no colour like #ff8000"))
        << wrong;
  std::string beyond = coloured;
  beyond.replace(beyond.find("16777216"), 8, "16777217");
  EXPECT_TRUE(says(read_solid({"part", beyond}).error().message, "its colour is not one"));
  std::string wrong = part;
  wrong.replace(wrong.rfind(" 5\n"), 3, " x\n");
  const auto reading = read_solid({"part", wrong});
  ASSERT_FALSE(reading);
  EXPECT_TRUE(says(reading.error().message, "its face is not a number from 0")) << reading.error().message;
  const auto of = [](const char* face) {
    return std::string(R"({"features": [{"name": "a", "faces": [)") + face + "]}]}";
  };
  EXPECT_TRUE(
      says(refused(of("4"), part), "field features[0].faces[0] is the number of no face of the part"));
  EXPECT_TRUE(says(refused(of("0"), solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}))),
                   "is the number of no face of the part"));
}

/// What faces demand is demanded of the body that the triangles stand for.
TEST(SolidDemands, WhatAMeshDeviatesIsTakenOffMarginsAndAddedToBounds) {
  const std::vector<std::uint32_t> face_of{0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5};
  const std::vector<std::string> names(6);
  const auto with = [&](double margin, double bound) {
    SolidResultFiles files = top(bound, margin);
    files.part = solid_files::step_mesh(cases::block({-5, -5, -5}, {5, 5, 5}), "0.125", face_of, names);
    files.result["inputs"][0]["deviation"] = 0.125;
    files.result["clearance"] = 0.875;
    return files.told();
  };
  // The top has (1 - 0.25 - 0.125) / 2, all else 0.375.
  EXPECT_EQ(with(0.3125, 0.5), "confirmed");
  EXPECT_TRUE(says(with(std::nextafter(0.3125, 1), 0.5), "refuted; feature \"top\""));
  // The sum of both terms has 1.25 and twice 0.125 for three shares.
  EXPECT_TRUE(says(with(0.3125, 0.4999), "do not prove"));
}

TEST(SolidFeatures, RefusalsNameTheField) {
  const std::string part = solid_files::stl_binary(cases::block({-5, -5, -5}, {5, 5, 5}));
  for (const auto& [text, words] : {
           std::pair{R"({"criterion": "even"})",
                     "features.json: field criterion is no word of a file of features"},
           {R"({"units": "cm"})", "field units is none of"},
           {R"({"minimum": -1})", "field minimum is no length"},
           {R"({"as_cast": 1})", "field as_cast is neither true nor false"},
           {R"({"as_cast": true, "minimum": 1})", "field minimum is a demand on what is as cast"},
           {R"({"features": [{"name": "a"}]})", "features[0].name is of a feature that says of no triangle"},
           {R"({"features": [{"name": "a", "label": "b", "patch": [0, 0, 0]}]})", "is a second way to say"},
           {R"({"features": [{"name": "a", "label": "b"}]})", "features[0] has no triangle of the part"},
           {R"({"features": [{"name": "a", "triangles": [12]}]})", "is 12, but the part has 12 triangles"},
           {R"({"features": [{"name": "a", "triangles": [1]}, {"name": "b", "triangles": [1]}]})",
            "triangle 1 is of two features, features[1] and features[0]"},
           {R"({"features": [{"name": "a", "triangles": [1], "scale": 0}]})",
            "field features[0].scale is not above 0"},
           {R"({"features": [{"name": "a", "triangles": [1], "as_cast": true, "minimum": 1}]})",
            "field features[0].minimum is a demand on what is as cast"},
           {R"({"features": [{"name": "a", "triangles": [1], "minimum": 1, "maximum": 1}]})",
            "field features[0].maximum is not above the minimum"},
           {R"({"features": [{"name": "a", "triangles": [1], "as_cast": true, "maximum": 1}]})",
            "field features[0].maximum is a demand on what is as cast"},
           {R"({"features": [{"name": "a", "triangles": [1], "as_cast": 1}]})", "is neither true nor false"},
           {R"({"features": [{"name": "a", "edges": [1]}]})", "field features[0].edges is no word"},
           {R"({"features": [{"name": "a", "box": [[1, 0, 0], [0, 0, 0]]}]})",
            "has a low corner above its high one"},
           {R"({"features": [{"name": "a", "box": [[1, 0, 0]]}]})", "is not a low and a high corner"},
           {R"({"features": [{"name": "a", "patch": [1, 0]}]})",
            "field features[0].patch is not a list of 3 numbers"},
           {R"({"features": [{"name": "a", "plane": {"normal": [0, 0, 0], "at": 0, "within": 0}}]})",
            "is 0, which is no direction"},
           {R"({"features": [{"name": "a", "plane": {"normal": [0, 0, 1], "at": 0, "within": -1}}]})",
            "is below 0"},
           {R"({"features": [{"name": "a", "plane": {"normal": [0, 0, 1], "at": 0}}]})", "within is missing"},
           {R"({"minimum": 1, "minimum": 2})", "field minimum is given twice"},
       })
    EXPECT_TRUE(says(refused(text, part), words)) << text << "\n" << refused(text, part);
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_demands_test

// Certificates for solids written by hand, whose truth is known by argument.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/base/stop.hpp"
#include "support/solid_results.hpp"

namespace lekalo::verify::verify_solid_certificate_test {
namespace {

using cases::changed;
using cases::cube_in_cube;
using cases::Json;
using cases::one_leaf;
using cases::SolidResultFiles;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// The two half-spaces along x that hold the blank, and two corners of the part opposite to each other along
/// x: their distances from the two sum to 2, however the part is shifted.
Json by_planes() {
  return one_leaf(Json::array({{"plane", 0, 0, 1}, {"plane", 1, 1, 1}}),
                  Json::array({{-5, -5, -5, 0}, {5, -5, -5, 0}}), Json::array(),
                  Json::array({{1, 0, 0, -6}, {-1, 0, 0, -6}}));
}
/// The ball within the part, however it is turned.
Json by_middle(const std::array<double, 3>& turn, double shift = 0.5) {
  return one_leaf(Json::array({{"plane", 0, 0, 0.25}, {"plane", 0, 1, 0.25}}), Json::array({{0, 0, 0, 5}}),
                  Json::array(), Json::array({{3, 0, 0, -18}, {-1, 0, 0, -6}}), shift, turn);
}
/// Two balls beside the blank.
Json by_balls(double far, double shift, const std::array<double, 3>& turn = {0, 0, 0}) {
  return one_leaf(Json::array({{"ball", 0, 0, 1}, {"ball", 0, 1, 1}}), Json::array({{0, 0, 0, 5}}),
                  Json::array({{6 + far, 0, 0, far}, {-6 - far, 0, 0, far}}), Json::array(), shift, turn);
}
/// Two corners of the part over triangles of the blank: those of x = -6 and x = 6 whose right angle is at y =
/// z = -6.
Json by_faces(double shift) {
  return one_leaf(Json::array({{"face", 0, 8, 2}, {"face", 1, 10, 2}}),
                  Json::array({{-5, -5, -5, 0}, {5, -5, -5, 0}}), Json::array(), Json::array(), shift);
}
/// Balls beside the blank over triangles of the part.
Json by_part_faces(double shift) {
  return one_leaf(Json::array({{"part_face", 8, 0, 1}, {"part_face", 10, 1, 1}}), Json::array(),
                  Json::array({{-7, -1, -1, 1}, {7, -1, -1, 1}}), Json::array(), shift);
}

/// Two edges of the part that pass edges of two cores 2 above and below it. \returns the files, for shifts by
/// `shift`
SolidResultFiles by_edges(double bound, double shift = 0.5) {
  SolidResultFiles files =
      cube_in_cube(one_leaf(Json::array({{"edges", 2, 3 * 15, 1}, {"edges", 6, 3 * 25 + 2, 1}}),
                            Json::array(), Json::array(), Json::array(), shift),
                   bound, "xyz", shift);
  solid::Mesh blank = cases::block({-20, -20, -20}, {20, 20, 20});
  cases::append(blank, cases::block({-9, -8, -8}, {3, 8, -7}));
  cases::append(blank, cases::block({-9, -8, 7}, {3, 8, 8}));
  files.blank = solid_files::stl_binary(blank);
  files.result["inputs"][1]["triangles"] = 36, files.result["contacts"] = Json::array();
  return files;
}

TEST(SolidCertificate, HalfSpacesProveACubeInACubeToTheLastDigit) {
  EXPECT_EQ(cube_in_cube(by_planes()).told(), "confirmed");
  const auto report = cube_in_cube(by_planes()).report();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->intervals, 1U);
  EXPECT_GE(std::stod(report->bound_high), 1);
  SolidResultFiles lower = cube_in_cube(by_planes(), std::nextafter(1, 0));
  lower.result["clearance"] = 0.5, lower.result["gap"] = std::nextafter(1, 0) - 0.5;
  EXPECT_TRUE(says(lower.told(),
                   "refuted; certificate.trees[0].nodes[0]: its terms do not prove that no "
                   "placement with x -0.5 to 0.5, y -0.5 to 0.5, z -0.5 to 0.5, turn_x 0 to 0, "
                   "turn_y 0 to 0, turn_z 0 to 0 has more clearance than"))
      << lower.told();
}

TEST(SolidCertificate, ABallInTheMiddleProvesItForAllTurns) {
  const double t = std::tan(std::numbers::pi / 4 / 2) * (1 + 1e-15);
  EXPECT_EQ(cube_in_cube(by_middle({0, 0, t}), 1, "c-xyz", 0.5, 45).told(), "confirmed");
  EXPECT_EQ(cube_in_cube(by_middle({t, t, t}), 1, "six", 0.5, 45).told(), "confirmed");
  EXPECT_EQ(cube_in_cube(by_middle({1, 1, 1}), 1, "six", 0.5, 90).told(), "confirmed");
  EXPECT_EQ(cube_in_cube(by_middle({1, 1, 1}, 100), 1, "six", 100, 90).told(), "confirmed");
  EXPECT_TRUE(
      says(cube_in_cube(by_middle({0, 0, t}), 1, "six", 0.5, 45).told(),
           "refuted; certificate.trees[0]: turn_x from 0 to 0 does not cover the window, from -0.41"));
}

TEST(SolidCertificate, BallsProveWhatTheirCurvesLeave) {
  // Balls of radius f beside the blank: in shifts by h, |T a - c| is less than 11 + f + h^2 / f.
  EXPECT_EQ(cube_in_cube(by_balls(10, 0.1), 1.002, "xyz", 0.1).told(), "confirmed");
  EXPECT_EQ(cube_in_cube(by_balls(1000, 0.1), 1.00002, "xyz", 0.1).told(), "confirmed");
  EXPECT_TRUE(says(cube_in_cube(by_balls(10, 0.1), 1.0005, "xyz", 0.1).told(), "do not prove"));
  EXPECT_EQ(cube_in_cube(by_balls(1000, 0.1, {0.5, 0.5, 0.5}), 1.00002, "six", 0.1, 50).told(), "confirmed");
  // At one pose they prove it to the last digit.
  EXPECT_EQ(cube_in_cube(by_balls(10, 0), 1, "xyz", 0).told(), "confirmed");
}

TEST(SolidCertificate, CornersOverFacesProveItWhereTheirFeetStay) {
  EXPECT_EQ(cube_in_cube(by_faces(0.5)).told(), "confirmed");
  EXPECT_EQ(cube_in_cube(by_faces(1), 1, "xyz", 1).told(), "confirmed");
  EXPECT_TRUE(says(cube_in_cube(by_faces(1.01), 1, "xyz", 1.01).told(), "do not prove"));
  EXPECT_EQ(cube_in_cube(by_part_faces(0.5)).told(), "confirmed");
  EXPECT_EQ(cube_in_cube(by_part_faces(1), 1, "xyz", 1).told(), "confirmed");
  EXPECT_TRUE(says(cube_in_cube(by_part_faces(1.01), 1, "xyz", 1.01).told(), "do not prove"));
  // The other triangles of these faces: the feet are beside them.
  for (const auto& [first, second] : {std::pair{9, 10}, {8, 11}, {8, 8}, {0, 10}}) {
    Json faces = by_faces(0.5), part_faces = by_part_faces(0.5);
    faces.at("/trees/0/nodes/0/0/2") = first, faces.at("/trees/0/nodes/0/1/2") = second;
    part_faces.at("/trees/0/nodes/0/0/1") = first, part_faces.at("/trees/0/nodes/0/1/1") = second;
    EXPECT_TRUE(says(cube_in_cube(faces).told(), "do not prove")) << first << " " << second;
    EXPECT_TRUE(says(cube_in_cube(part_faces).told(), "do not prove")) << first << " " << second;
  }
}

TEST(SolidCertificate, EdgesProveItWhereTheyPassEachOther) {
  constexpr double kSpare = 1e-14;  // the direction is a little shorter than 1
  EXPECT_EQ(by_edges(2 + kSpare).told(), "confirmed");
  EXPECT_TRUE(says(by_edges(std::nextafter(2, 0)).told(), "do not prove"));
  // The part's edge is at y = -5 from x = -5 to 5, those of the cores at x = 3 from y = -8 to 8, 2 off.
  const auto between = [](const char* axis, double low, double high) {
    SolidResultFiles files = by_edges(2 + kSpare);
    files.result["certificate"]["trees"][0][axis] = {low, high};
    return files.told();
  };
  for (const auto& [axis, low, high] : {std::tuple{"x", -2.0, 8.0}, {"y", -3.0, 13.0}, {"z", -2.0, 2.0}}) {
    EXPECT_EQ(between(axis, low + 0.001, high - 0.001), "confirmed") << axis;
    EXPECT_TRUE(says(between(axis, low, high - 0.001), "do not prove")) << axis;
    EXPECT_TRUE(says(between(axis, low + 0.001, high), "do not prove")) << axis;
  }
  // One of them, and the top of the blank: each end of each edge counts.
  const auto alone = [&](const char* axis, double low, double high) {
    SolidResultFiles files = by_edges(8.5 + kSpare);
    Json& certificate = files.result["certificate"];
    certificate["part_balls"] = Json::array({{0, 0, 5, 0}});
    certificate["planes"] = Json::array({{0, 0, -1, -20}});
    certificate["trees"][0]["nodes"][0][1] = {"plane", 0, 0, 1};
    certificate["trees"][0][axis] = {low, high};
    return files.told();
  };
  for (const auto& [axis, low, high] : {std::tuple{"x", -2.0, 8.0}, {"y", -3.0, 13.0}, {"z", -2.0, 50.0}}) {
    EXPECT_EQ(alone(axis, low + 0.001, high - 0.001), "confirmed") << axis;
    EXPECT_TRUE(says(alone(axis, low, high - 0.001), "do not prove")) << axis;
    EXPECT_EQ(says(alone(axis, low + 0.001, high), "do not prove"), high < 50) << axis;
  }
  // The others are parallel, do not cross, or are not there.
  for (int edge = 0; edge < 36; ++edge) {
    SolidResultFiles files = by_edges(2 + kSpare);
    files.result["certificate"]["trees"][0]["nodes"][0][0][1] = edge;
    // Those of the lower face that cross x = 3, each in two triangles.
    const bool passes = std::ranges::count(std::array{1, 2, 3, 4, 12, 20}, edge) == 1;
    EXPECT_EQ(files.told() == "confirmed", passes) << edge << files.told();
  }
  for (const Json& none : {Json{"edges", 36, 45, 1}, Json{"edges", 2, 108, 1}, Json{"edges", -1, 45, 1},
                           Json{"edges", 2, 0.5, 1}}) {
    SolidResultFiles files = by_edges(2 + kSpare);
    files.result["certificate"]["trees"][0]["nodes"][0][0] = none;
    EXPECT_TRUE(says(files.told(), "has a term that is none")) << none;
  }
}

TEST(SolidCertificate, EdgesTurn) {
  // Turned by a about z, edges pass 2 from each other, at an angle whose sine is the cosine of a.
  const auto turned = [](double bound) {
    SolidResultFiles files = by_edges(bound, 0.1);
    files.result["freedom"] = "c-xyz", files.result["window"]["turn_deg"] = 2;
    const double t = std::tan(2 * std::numbers::pi / 180 / 2) * (1 + 1e-15);
    files.result["certificate"]["trees"][0]["turn_z"] = {-t, t};
    return files.told();
  };
  EXPECT_EQ(turned(2.0001), "confirmed");
  EXPECT_TRUE(says(turned(1.9999), "do not prove"));
}

TEST(SolidCertificate, ABallMayGoThroughAFaceUpToItsRadius) {
  const auto through = [](Json certificate, double x) {
    certificate["trees"][0]["x"] = {-x, x};
    return cube_in_cube(certificate).told();
  };
  // Corners are 1 over their faces, the balls of radius 1 are 2 over them.
  Json balls = by_faces(0.5);
  balls["part_balls"] = Json::array({{-4, -4, -4, 1}, {4, -4, -4, 1}});
  for (const auto& [certificate, most] :
       {std::pair{by_faces(0.5), 1.0}, {balls, 3.0}, {by_part_faces(0.5), 3.0}}) {
    EXPECT_EQ(through(certificate, most), "confirmed") << most;
    EXPECT_TRUE(says(through(certificate, most + 0.001), "do not prove")) << most;
  }
}

/// A ball that goes through the wall of a narrow core sticks out of the material by half the core's width.
TEST(SolidCertificate, AFaceBoundsNothingBelowZero) {
  solid::Mesh blank = cases::block({-6, -6, -6}, {6, 6, 6});
  cases::append(blank, cases::block({-2, -2, -0.0625}, {2, 2, 0.0625}));
  for (const auto& [bound, told] : {std::pair{0.0, "confirmed"}, {-0.5, "do not prove"}}) {
    SolidResultFiles files =
        cube_in_cube(one_leaf(Json::array({{"face", 0, 14, 1}}), Json::array({{-0.25, -0.25, 1, 4}}),
                              Json::array(), Json::array(), 0.1),
                     bound, "xyz", 0.1);
    files.blank = solid_files::stl_binary(blank);
    files.result["inputs"][1]["triangles"] = 24, files.result["inside"] = false;
    files.result["clearance"] = files.result["gap"] = files.result["shortfall"] = nullptr;
    files.result["contacts"] = Json::array();
    files.result["status"] = "infeasible", files.result["min_allowance"] = 1;
    EXPECT_TRUE(says(files.told(), told)) << files.told();
  }
}

TEST(SolidCertificate, TurnsMoveWhatIsNotAtThePivot) {
  // The corners (-5, -5) and (5, -5) are 10 cos apart along x.
  const double t = std::tan(2 * std::numbers::pi / 180 / 2) * (1 + 1e-15);
  for (const Json& flat : {by_planes(), by_faces(0.5)}) {
    Json turned = flat;
    turned["trees"][0]["turn_z"] = {-t, t};
    EXPECT_TRUE(says(cube_in_cube(turned, 1.003, "c-xyz", 0.5, 2).told(), "do not prove"));
    EXPECT_EQ(cube_in_cube(turned, 1.0031, "c-xyz", 0.5, 2).told(), "confirmed");
  }
  Json turned = by_part_faces(0.5);
  turned["trees"][0]["turn_z"] = {-t, t};
  EXPECT_TRUE(says(cube_in_cube(turned, 1, "c-xyz", 0.5, 2).told(), "do not prove"));
  EXPECT_EQ(cube_in_cube(turned, 1.02, "c-xyz", 0.5, 2).told(), "confirmed");
}

TEST(SolidCertificate, ABallThatMayMeetThePartNeedsTheBoundAboveItsDepth) {
  // The middle of a core in the blank may come to lie in the part: the clearance is then at most -2.
  const auto cored = [](double bound) {
    SolidResultFiles files =
        cube_in_cube(one_leaf(Json::array({{"ball", 0, 0, 1}}), Json::array({{0, 0, 0, 5}}),
                              Json::array({{0, 0, 0, 2}}), Json::array(), 0.1),
                     bound, "xyz", 0.1);
    solid::Mesh blank = cases::block({-6, -6, -6}, {6, 6, 6});
    cases::append(blank, cases::block({-2.5, -2.5, -2.5}, {2.5, 2.5, 2.5}));
    files.blank = solid_files::stl_binary(blank);
    files.result["inputs"][1]["triangles"] = 24;
    files.result["inside"] = false;
    files.result["clearance"] = files.result["gap"] = files.result["shortfall"] = nullptr;
    files.result["contacts"] = Json::array();
    files.result["status"] = "infeasible";
    return files.told();
  };
  EXPECT_EQ(cored(-1), "confirmed");
  EXPECT_EQ(cored(-2), "confirmed");
  EXPECT_TRUE(says(cored(-2.0001), "do not prove"));
}

TEST(SolidCertificate, BoundsBelowZeroAreProvedByHalfSpaces) {
  // A part of half edges 7 in the blank of 6 sticks out by 1 at least.
  const auto too_large = [](double bound, const Json& certificate) {
    SolidResultFiles files = cube_in_cube(certificate, bound);
    files.part = solid_files::stl_binary(cases::block({-7, -7, -7}, {7, 7, 7}));
    files.result["inside"] = false;
    files.result["clearance"] = files.result["gap"] = files.result["shortfall"] = nullptr;
    files.result["contacts"] = Json::array();
    files.result["status"] = "infeasible";
    return files.told();
  };
  Json planes = by_planes();
  planes["part_balls"] = Json::array({{-7, -7, -7, 0}, {7, -7, -7, 0}});
  EXPECT_EQ(too_large(-1, planes), "confirmed");
  EXPECT_TRUE(says(too_large(-1.0000000000000002, planes), "do not prove"));
  // A normal of another length, whose root is no fraction.
  planes["planes"] = Json::array({{1, 1, 0, -12}, {-1, -1, 0, -12}});
  planes["part_balls"] = Json::array({{-7, -7, -7, 0}, {7, 7, 7, 0}});
  EXPECT_EQ(too_large(-std::sqrt(2) + 1e-15, planes), "confirmed");
  EXPECT_TRUE(says(too_large(-std::sqrt(2) - 1e-15, planes), "do not prove"));
  // Faces bound nothing below 0.
  Json faces = by_faces(0.5);
  faces["part_balls"] = Json::array({{-7, -5, -5, 0}, {7, -5, -5, 0}});
  EXPECT_TRUE(says(too_large(-0.5, faces), "do not prove"));
}

TEST(SolidCertificate, BallsAndHalfSpacesAreHeldAgainstTheMeshes) {
  const auto with = [](Json certificate, const char* path, double value) {
    certificate.at(path) = value;
    return cube_in_cube(certificate, 1.5).told();
  };
  EXPECT_TRUE(
      says(with(by_planes(), "/part_balls/0/3", 1e-300),
           "refuted; certificate.part_balls[0] is not what it has to be: triangle 0 comes nearer to its "
           "centre than its radius"));
  EXPECT_EQ(with(by_planes(), "/part_balls/0/0", -5.000000000000001),
            "refuted; certificate.part_balls[0] is not what it has to be: its centre is not in the part");
  EXPECT_EQ(with(by_planes(), "/part_balls/0/0", -4.9), "confirmed");
  EXPECT_EQ(
      with(by_planes(), "/planes/0/3", -5.999999999999999),
      "refuted; certificate.planes[0] is not what it has to be: a corner of the blank's triangle 0 is not "
      "in it");
  EXPECT_EQ(with(by_planes(), "/planes/0/3", -6.1), "confirmed");
  EXPECT_TRUE(says(with(by_planes(), "/planes/0/0", 0), "is not what it has to be: its normal is 0"));
  EXPECT_TRUE(says(with(by_balls(10, 0.5), "/blank_balls/0/3", 10.000000000000002),
                   "certificate.blank_balls[0] is not what it has to be: triangle 10 comes nearer"));
  EXPECT_TRUE(says(with(by_balls(10, 0.5), "/part_balls/0/3", 5.000000000000001),
                   "certificate.part_balls[0] is not what it has to be: triangle"));
  Json inside = by_balls(10, 0.5);
  inside["blank_balls"][0] = {0, 0, 0, 6};
  EXPECT_TRUE(says(cube_in_cube(inside, 1.5).told(),
                   "certificate.blank_balls[0] is not what it has to be: its centre is in the blank"));
  // Points of the surface: in a corner, on an edge and in a face.
  for (const Json& point : {Json{6, 6, 6, 0}, Json{6, 6, 1, 0}, Json{6, 0.1, 0.7, 0}}) {
    Json points = by_balls(10, 0.5);
    points["blank_balls"][0] = point;
    points["trees"][0]["nodes"][0][0][3] = 0;
    EXPECT_FALSE(says(cube_in_cube(points, 20).told(), "blank_balls"));
    points["trees"][0]["nodes"][0][0][3] = 1;
    EXPECT_FALSE(says(cube_in_cube(points, 20).told(), "blank_balls")) << point;
  }
  // What no leaf uses may be anything.
  Json unused = by_planes();
  unused["part_balls"].push_back({100, 0, 0, 50});
  EXPECT_EQ(cube_in_cube(unused).told(), "confirmed");
}

/// A tree of two splits over the window of by_planes().
Json divided() {
  Json made = by_planes();
  const Json leaf = made["trees"][0]["nodes"][0];
  made["trees"][0]["nodes"] =
      Json::array({Json::array({"x", 0.25}), Json::array({"turn_z", 0}), leaf, leaf, leaf});
  return made;
}

TEST(SolidCertificate, TheTreeDividesItsBox) {
  EXPECT_EQ(cube_in_cube(divided()).told(), "confirmed");
  EXPECT_EQ(cube_in_cube(divided()).report()->intervals, 3U);
  Json less = divided(), more = divided(), outside = divided();
  less["trees"][0]["nodes"].erase(std::size_t{4});
  EXPECT_EQ(cube_in_cube(less).told(),
            "refuted; certificate.trees[0]: the subdivision ends early, 1 boxes are missing");
  more["trees"][0]["nodes"].push_back(more["trees"][0]["nodes"][4]);
  EXPECT_EQ(cube_in_cube(more).told(),
            "bad input: result.json: certificate.trees[0].nodes[5] is one more than the subdivision needs");
  for (const double at : {-0.6, 0.5000001}) {
    outside["trees"][0]["nodes"][0][1] = at;
    EXPECT_EQ(cube_in_cube(outside).told(),
              "bad input: result.json: certificate.trees[0].nodes[0] splits x outside of its box");
  }
  const auto node = [](Json value) {
    Json made = by_planes();
    made["trees"][0]["nodes"][0] = std::move(value);
    return cube_in_cube(made).told();
  };
  const std::string at = "bad input: result.json: certificate.trees[0].nodes[0]";
  for (const Json& none : {Json::array({"w", 0}), Json::array({"x"}), Json::array({"x", 0, 1}), Json(5),
                           Json("x"), Json::array({"x", "0"}), Json::object()})
    EXPECT_EQ(node(none), at + " is neither a split nor a leaf") << none;
  EXPECT_EQ(node(Json::array()), at + " has no multiplier above 0");
  EXPECT_EQ(node(Json::array({{"plane", 0, 0, 0}})), at + " has no multiplier above 0");
  for (const Json& none :
       {Json{"plane", 0, 0, -1}, Json{"plane", 2, 0, 1}, Json{"plane", 0, 2, 1}, Json{"plane", 0.5, 0, 1},
        Json{"plane", -1, 0, 1}, Json{"plane", 0, 0}, Json{"plane", 0, 0, 1, 1}, Json{"disc", 0, 0, 1},
        Json{"ball", 0, 0, 1}, Json{"face", 0, 12, 1}, Json{"part_face", 12, 0, 1},
        Json{"part_face", 0, 0, 1}, Json{"plane", 0, 0, "1"}, Json{0, 0, 0, 1}, Json(5)})
    EXPECT_EQ(node(Json::array({none})), at + " has a term that is none") << none;
  const Json term{"plane", 0, 0, 1};
  EXPECT_EQ(node(std::vector<Json>(65, term)), at + " has more than 64 terms");
}

TEST(SolidCertificate, TheRootCoversTheWindow) {
  const auto with = [](const char* path, Json value) {
    Json made = by_planes();
    made.at(path) = std::move(value);
    return cube_in_cube(made).told();
  };
  for (const char* axis : {"x", "y", "z"})
    for (const Json& range : {Json{-0.5, 0.4999999999999999}, Json{-0.4999999999999999, 0.5}})
      EXPECT_TRUE(says(with((std::string("/trees/0/") + axis).c_str(), range),
                       std::string("refuted; certificate.trees[0]: ") + axis + " from "))
          << axis;
  EXPECT_EQ(with("/trees/0/x", {-0.6, 0.7}), "confirmed");
  EXPECT_TRUE(says(with("/trees/0/turn_x", {0.1, 0.2}), "turn_x from 0.1 to 0.2 does not cover the window"));
  EXPECT_EQ(with("/trees/0/quaternion", {-7, 0, 0, 0}), "confirmed");
  EXPECT_TRUE(says(with("/trees/0/quaternion", {1, 0, 0, 1e-17}),
                   "its rotations are counted from another one than the window's"));
  EXPECT_TRUE(says(with("/trees/0/quaternion", {0, 0, 0, 0}), "quaternion is 0, which is no rotation"));
  EXPECT_TRUE(says(with("/pivot/1", 1e-300), "the pivot of the certificate is not that of the window"));
  EXPECT_EQ(with("/trees", Json::array()), "refuted; certificate.trees has 0 trees, and the window takes 1");
  EXPECT_TRUE(says(with("/trees/0/x", {1, -1}), "trees[0].x is not in ascending order"));
  Json two = by_planes();
  two["trees"].push_back(two["trees"][0]);
  EXPECT_EQ(cube_in_cube(two).told(), "refuted; certificate.trees has 2 trees, and the window takes 1");
}

/// The ball within the part in a tree for each of these rotations.
Json by_charts(const std::vector<std::array<double, 4>>& quaternions, const std::array<double, 3>& turn) {
  Json made = by_middle(turn);
  const Json tree = made["trees"][0];
  made["trees"] = Json::array();
  for (const auto& q : quaternions) {
    made["trees"].push_back(tree);
    made["trees"][made["trees"].size() - 1]["quaternion"] = {q[0], q[1], q[2], q[3]};
  }
  return made;
}

TEST(SolidCertificate, AllRotationsTakeFourTreesAndTurnsAboutZTwo) {
  using Quaternions = std::vector<std::array<double, 4>>;
  const auto six = [](const Quaternions& q, const std::array<double, 3>& turn = {1, 1, 1}) {
    return cube_in_cube(by_charts(q, turn), 1, "six", 0.5, 180).told();
  };
  const auto about_z = [](const Quaternions& q, const std::array<double, 3>& turn = {0, 0, 1}) {
    return cube_in_cube(by_charts(q, turn), 1, "c-xyz", 0.5, 180).told();
  };
  const std::array<double, 4> one{1, 0, 0, 0}, i{0, 1, 0, 0}, j{0, 0, 1, 0}, k{0, 0, 0, 1};
  EXPECT_EQ(six({one, i, j, k}), "confirmed");
  EXPECT_EQ(six({one, {0, -3, 0, 0}, j, k}), "confirmed");
  EXPECT_EQ(about_z({one, k}), "confirmed");
  const std::string other = ": its rotations are counted from another one than the window's";
  EXPECT_EQ(six({one, i, k, j}), "refuted; certificate.trees[2]" + other + "; certificate.trees[3]" + other);
  EXPECT_EQ(six({i, i, j, k}), "refuted; certificate.trees[0]" + other);
  EXPECT_EQ(six({one, i, j, {1e-17, 0, 0, 1}}), "refuted; certificate.trees[3]" + other);
  EXPECT_EQ(six({one, i, j}), "refuted; certificate.trees has 3 trees, and the window takes 4");
  EXPECT_EQ(six({one, i, j, k, one}), "refuted; certificate.trees has 5 trees, and the window takes 4");
  EXPECT_EQ(about_z({one}), "refuted; certificate.trees has 1 trees, and the window takes 2");
  EXPECT_EQ(about_z({one, i}), "refuted; certificate.trees[1]" + other);
  EXPECT_EQ(cube_in_cube(by_charts({one}, {0, 0, 0}), 1, "xyz", 0.5, 180).told(), "confirmed");
  // Each side of each tree counts.
  for (const char* axis : {"turn_x", "turn_y", "turn_z"})
    for (const Json& range : {Json{-0.9999999999999999, 1}, Json{-1, 0.9999999999999999}})
      for (std::size_t tree = 0; tree < 4; ++tree) {
        Json made = by_charts({one, i, j, k}, {1, 1, 1});
        made["trees"][tree][axis] = range;
        EXPECT_TRUE(says(cube_in_cube(made, 1, "six", 0.5, 180).told(),
                         "refuted; certificate.trees[" + std::to_string(tree) + "]: " + axis + " from "));
      }
}

TEST(SolidCertificate, TheChartsAreCountedFromTheStart) {
  SolidResultFiles files =
      cube_in_cube(by_charts({{1, 2, 3, 4}, {-2, 1, -4, 3}, {-3, 4, 1, -2}, {-4, -3, 2, 1}}, {1, 1, 1}), 1,
                   "six", 0.5, 180);
  files.result["window"]["quaternion"] = {1, 2, 3, 4};
  EXPECT_EQ(files.told(), "confirmed");
  const Json right = files.result["certificate"]["trees"];
  for (std::size_t tree = 0; tree < 4; ++tree)
    for (std::size_t part = 0; part < 4; ++part) {
      Json& trees = files.result["certificate"]["trees"];
      trees = right;
      trees[tree]["quaternion"][part] = -right[tree]["quaternion"][part].get<double>();
      EXPECT_TRUE(says(files.told(), "counted from another one")) << tree << part;
    }
}

TEST(SolidCertificate, OfAllTurnsThePoseMayHaveAnyThatIsFree) {
  const auto with = [](const char* freedom, const std::array<double, 4>& q) {
    SolidResultFiles files = cube_in_cube(nullptr, 1, freedom, 0.5, 180);
    files.result["quaternion"] = {q[0], q[1], q[2], q[3]};
    files.result["contacts"] = Json::array(), files.result["clearance"] = 0.5;
    return files.told();
  };
  EXPECT_EQ(with("six", {0, 1, 0, 0}), "unproved");
  EXPECT_EQ(with("six", {1, 1, 1, 1}), "unproved");
  EXPECT_EQ(with("c-xyz", {0, 0, 0, 1}), "unproved");
  EXPECT_EQ(with("c-xyz", {1, 0, 0, -1}), "unproved");
  EXPECT_EQ(with("c-xyz", {1e-15, 0, 3e-15, 1}), "unproved");
  EXPECT_TRUE(
      says(with("c-xyz", {0, 0, 5e-15, 1}), "rotation from the start's has the turn_y 5e-15, beyond 0"));
  EXPECT_TRUE(says(with("c-xyz", {1, 0.5, 0, -1}), "rotation from the start's has the turn_x 0.5, beyond 0"));
  EXPECT_TRUE(says(with("c-xyz", {0, 1, 0, 0}), "rotation from the start's has the turn_x inf, beyond 0"));
  EXPECT_TRUE(says(with("xyz", {0, 0, 0, 1}), "rotation from the start's has the turn_z inf, beyond 0"));
}

TEST(SolidCertificate, AWindowWithAStartMovesTheRoot) {
  // The part turned by a quarter about z, and somewhere else: (x, y, z) goes to (20 - y, x - 3, z).
  SolidResultFiles files = cube_in_cube(by_middle({0, 0, 0.1}), 1, "c-xyz", 0.5, 10);
  files.part = solid_files::stl_binary(cases::block({-2, 15, -5}, {8, 25, 5}));
  Json& result = files.result;
  result["quaternion"] = result["window"]["quaternion"] = result["certificate"]["trees"][0]["quaternion"] =
      Json{1, 0, 0, 1};
  for (Json* at : {&result, &result["window"]}) (*at)["x"] = 20, (*at)["y"] = -3;
  result["window"]["pivot"] = result["certificate"]["pivot"] = Json{3, 20, 0};
  result["certificate"]["part_balls"] = Json::array({{3, 20, 0, 5}});
  result["contacts"] = Json::array();
  EXPECT_EQ(files.told(), "confirmed");
  // Corners in place of the middle: each in its own place after the turn.
  result["freedom"] = "xyz";
  result["certificate"]["part_balls"] = Json::array({{-2, 25, -5, 0}, {-2, 15, -5, 0}});
  result["certificate"]["trees"][0]["turn_z"] = Json{0, 0};
  result["certificate"]["trees"][0]["nodes"][0] = Json::array({{"plane", 0, 0, 1}, {"plane", 1, 1, 1}});
  EXPECT_EQ(files.told(), "confirmed");
  result["certificate"]["part_balls"] = Json::array({{-2, 15, -5, 0}, {-2, 25, -5, 0}});
  EXPECT_TRUE(says(files.told(), "do not prove"));
}

TEST(SolidCertificate, ItMayStandInAFileOfItsOwn) {
  SolidResultFiles files = cube_in_cube(by_planes());
  const Json certificate = files.result["certificate"];
  files.result["certificate"] = nullptr;
  files.result["certificate_file"] = {{"path", "c.json"}, {"sha256", ""}, {"boxes", 1}};
  EXPECT_EQ(files.told(), "unproved");
  Json file{{"format", {{"name", "lekalo-certificate"}, {"version", 1}}}, {"certificate", certificate}};
  files.certificate = file.dump();
  EXPECT_EQ(files.told(), "confirmed");
  files.result["certificate_file"]["boxes"] = 2;
  EXPECT_EQ(files.told(), "refuted; certificate_file.boxes is 2, but the certificate has 1 leaves");
  files.result["certificate_file"]["boxes"] = 1;
  file["format"]["version"] = 2;
  files.certificate = file.dump();
  EXPECT_EQ(files.told(),
            "bad input: certificate.json: field format does not say lekalo-certificate, version 1");
  file["format"]["version"] = 1, file["certificate"] = nullptr;
  files.certificate = file.dump();
  EXPECT_EQ(files.told(), "bad input: certificate.json: field certificate is not an object");
  files.result["certificate"] = certificate;
  EXPECT_EQ(files.told(), "bad input: result.json: the certificate is given both here and in a file");
}

TEST(SolidCertificate, EveryFieldIsThereOnceAndKnown) {
  const Json certificate = by_planes();
  for (const std::string& key : certificate.keys()) {
    Json less = certificate;
    less.erase(key);
    EXPECT_EQ(cube_in_cube(less).told().find("bad input: result.json: "), 0U) << key;
  }
  for (const std::string& key : certificate["trees"][0].keys()) {
    Json less = certificate;
    less["trees"][0].erase(key);
    EXPECT_EQ(cube_in_cube(less).told().find("bad input: result.json: "), 0U) << key;
  }
  Json more = certificate;
  more["note"] = 1;
  EXPECT_TRUE(says(cube_in_cube(more).told(), "field certificate.note is not one of"));
  more = certificate, more["trees"][0]["theta"] = 1;
  EXPECT_TRUE(says(cube_in_cube(more).told(), "field certificate.trees[0].theta is not one of"));
  for (const Json& row :
       {Json{1, 2, 3}, Json{1, 2, 3, -1}, Json{1, 2, 3, "4"}, Json{1e13, 2, 3, 1}, Json(1)}) {
    Json bad = certificate;
    bad["blank_balls"].push_back(row);
    EXPECT_TRUE(says(cube_in_cube(bad).told(), "bad input: result.json: certificate.blank_balls")) << row;
  }
  SolidResultFiles unbound = cube_in_cube(certificate);
  unbound.result["upper_bound"] = unbound.result["gap"] = nullptr;
  EXPECT_TRUE(says(unbound.told(), "there is a certificate, but no upper_bound that it is to prove"));
  unbound = cube_in_cube(certificate);
  unbound.result["status"] = "unproved";
  EXPECT_TRUE(says(unbound.told(), "status is unproved, but there is a certificate"));
}

TEST(SolidCertificate, ItsWorkIsBounded) {
  Json certificate = by_planes();
  Json nodes = Json::array();
  for (int k = 0; k < 2000; ++k) {
    nodes.push_back(Json::array({"x", 0}));
    nodes.push_back(certificate["trees"][0]["nodes"][0]);
  }
  nodes.push_back(certificate["trees"][0]["nodes"][0]);
  certificate["trees"][0]["nodes"] = nodes;
  const SolidResultFiles files = cube_in_cube(certificate);
  RunControl run;
  run.work_limit = 50'000;
  const auto said = stoppable(run, [&] { return files.told(); });
  ASSERT_FALSE(said);
  EXPECT_TRUE(said.error().out_of_work());
  EXPECT_EQ(files.told(), "confirmed");
}

/// No certificate whatever proves less than the clearance that a pose has.
TEST(SolidCertificate, NoChangeProvesABoundThatIsNotTrue) {
  Random random(1);
  const Json kinds[]{by_planes(),   by_middle({0, 0, 0}), by_balls(1000, 0.5),
                     by_faces(0.5), by_part_faces(0.5),   divided()};
  for (int k = 0; k < 3000; ++k) {
    Json certificate = kinds[random.below(std::size(kinds))];
    for (std::size_t times = 1 + random.below(4); times > 0; --times)
      certificate = changed(std::move(certificate), random);
    SolidResultFiles files = cube_in_cube(std::move(certificate), 1 - 1e-9);
    files.result["clearance"] = 0.5, files.result["gap"] = 0.5 - 1e-9;
    files.result["contacts"] = Json::array();
    const std::string told = files.told();
    EXPECT_TRUE(told.find("refuted") == 0 || told.find("bad input") == 0) << told;
  }
}

/// Of other meshes a certificate proves the bound only where it is true: that of blocks within each other is
/// the least distance of their faces.
TEST(SolidCertificate, OtherMeshesAreRefusedUnlessTheBoundIsTrueOfThem) {
  Random random(2);
  const Json kinds[]{by_planes(), by_middle({0, 0, 0}), by_balls(1000, 0.5), by_faces(0.5),
                     by_part_faces(0.5)};
  std::size_t confirmed = 0;
  for (int k = 0; k < 1000; ++k) {
    SolidResultFiles files = cube_in_cube(kinds[random.below(std::size(kinds))], 1.001);
    files.result["clearance"] = 0.25, files.result["gap"] = 1.001 - 0.25;
    files.result["contacts"] = Json::array();
    const auto half = [&](double least) { return least + 0.25 * static_cast<double>(random.below(3)); };
    const solid::Vector part{half(4.75), half(4.75), half(4.75)}, blank{half(5.75), half(5.75), half(5.75)};
    files.part = solid_files::stl_binary(cases::block(-part, part));
    files.blank = solid_files::stl_binary(cases::block(-blank, blank));
    const double optimum = std::min({blank.x - part.x, blank.y - part.y, blank.z - part.z});
    if (files.told() != "confirmed") continue;
    ++confirmed;
    EXPECT_LE(optimum, 1.001);
  }
  EXPECT_GT(confirmed, 50U);
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_certificate_test

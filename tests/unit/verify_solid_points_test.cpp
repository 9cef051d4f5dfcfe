// What the checker says of a blank that was made from points: they are its corners, and none of them lies in
// what counts as material.

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "support/solid_results.hpp"
#include "support/solids.hpp"
#include "support/three_mf_files.hpp"

namespace lekalo::verify::verify_solid_points_test {
namespace {

using cases::cube_in_cube;
using cases::Json;
using cases::SolidResultFiles;

constexpr const char* kCorners = "-6 -6 -6\n6 -6 -6\n6 6 -6\n-6 6 -6\n-6 -6 6\n6 -6 6\n6 6 6\n-6 6 6\n";

/// The material begins 0.3 within the triangles: the points are off by up to 0.1, and a ball of 180.2 sinks
/// by 0.2 more, 180.1 less the root of 180.1^2 - 72.
SolidResultFiles measured() {
  SolidResultFiles files = cube_in_cube();
  Json& r = files.result;
  r["scan"] = cases::scan_by_dip(0.1, 0, 0.3);
  r["scan"]["max_dip"] = nullptr, r["scan"]["min_radius"] = 180.2;
  r["clearance"] = 0.699999, r["contacts"][0]["distance"] = 0.7;
  r["inputs"].push_back({{"role", "points"}, {"path", "p"}, {"sha256", ""}, {"units", "mm"}, {"points", 8}});
  files.points = kCorners;
  return files;
}
std::string told(const std::function<void(SolidResultFiles&)>& change) {
  SolidResultFiles files = measured();
  change(files);
  return files.told();
}
/// The same with so many points more.
std::string with(const std::string& lines, int more, const Json& left_out = Json::array()) {
  return told([&](SolidResultFiles& files) {
    *files.points += lines;
    files.result["inputs"][2]["points"] = 8 + more;
    files.result["scan"]["left_out"] = left_out;
  });
}
bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(SolidPoints, TheCornersOfTheMeshAreMeasured) {
  EXPECT_EQ(measured().told(), "unproved");
  const std::string missing = told([](SolidResultFiles& files) {
    files.points = "-6 -6 -6\n6 -6 -6\n6 6 -6\n-6 6 -6\n-6 -6 6\n6 -6 6\n6 6 6\n-6 6 6.0000001\n";
  });
  EXPECT_TRUE(says(missing, "refuted; the corner (-6, 6, 6) of the blank's mesh is none of the points"))
      << missing;
}

TEST(SolidPoints, TheUnitOfA3mfIsTheOneThatItSays) {
  const auto with_unit = [](const char* said) {
    return told([&](SolidResultFiles& files) {
      files.points = three_mf_files::archive(cases::block({-6, -6, -6}, {6, 6, 6}));
      files.result["inputs"][2]["units"] = said;
    });
  };
  EXPECT_EQ(with_unit("mm"), "unproved");
  EXPECT_TRUE(
      says(with_unit("inch"), "refuted; the points are said to be in another unit than points.xyz says"))
      << with_unit("inch");
}

TEST(SolidPoints, ACornerMayBeOffByAShareOfTheLargestCoordinate) {
  const auto off_by = [](const char* z) {
    return told([&](SolidResultFiles& files) { files.points->replace(files.points->rfind("6\n"), 1, z); });
  };
  EXPECT_EQ(off_by("6.00000000000005"), "unproved");
  EXPECT_TRUE(says(off_by("6.000000000001"), "is none of the points"));
}

TEST(SolidPoints, CornersOfTheUndersideAreStated) {
  const auto with_underside = [](double flat) {
    return told([&](SolidResultFiles& files) {
      files.points = "-6 -6 6\n6 -6 6\n6 6 6\n-6 6 6\n";
      files.result["inputs"][2]["points"] = 4;
      files.result["scan"]["underside"] = {{"z", -6.25}, {"flat", flat}};
    });
  };
  EXPECT_FALSE(says(with_underside(0.25), "none of the points"));
  EXPECT_TRUE(
      says(with_underside(0.24), "the corner (-6, -6, -6) of the blank's mesh is none of the points"));
}

TEST(SolidPoints, NoneLiesInTheMaterial) {
  // Air within 0.3 of a triangle, and a point that is off by 0.1, are nothing new.
  EXPECT_EQ(with("0 0 5.61\n", 1), "unproved");
  EXPECT_EQ(with("0 0 7\n", 1), "unproved");
  EXPECT_EQ(with("5.61 0 0\n0 5.61 0\n", 2), "unproved");
  const std::string inside = with("0 0 5.59\n", 1);
  EXPECT_TRUE(says(inside, "refuted; point (0, 0, 5.59) lies deeper in what counts as material")) << inside;
}

TEST(SolidPoints, ThoseLeftOutDoNotCount) {
  EXPECT_EQ(with("0 0 1\n0 0 7\n", 2, {8}), "unproved");
  EXPECT_TRUE(says(with("0 0 7\n0 0 1\n", 2, {8}), "refuted; point (0, 0, 1)"));
  EXPECT_TRUE(says(with("", 0, {7}), "refuted; the corner (-6, 6, 6)"));
  EXPECT_TRUE(says(with("", 0, {8}), "refuted; scan.left_out names point 8 of 8"));
  EXPECT_TRUE(says(with("", 0, {-1}), "bad input"));
  const std::string alone = told([](SolidResultFiles& files) {
    files.points.reset(), files.result["inputs"].erase(2), files.result["scan"]["left_out"] = {3};
  });
  EXPECT_TRUE(says(alone, "scan.left_out names points, but there is no file of points")) << alone;
}

TEST(SolidPoints, ADipIsSaidOfTrianglesThatWereMeasured) {
  const std::string dip = told([](SolidResultFiles& files) { files.result["scan"]["max_dip"] = 0.2; });
  EXPECT_TRUE(
      says(dip, "refuted; the blank was made from points, but scan.max_dip is said of measured triangles"))
      << dip;
}

TEST(SolidPoints, TheFileHasToBeThereAndToBeRead) {
  EXPECT_TRUE(
      says(told([](SolidResultFiles& f) { f.points.reset(); }), "refuted; the result was checked without"));
  EXPECT_TRUE(
      says(told([](SolidResultFiles& f) { f.result["inputs"].erase(2); }), "refuted; the result names no"));
  EXPECT_TRUE(
      says(told([](SolidResultFiles& f) { f.result["inputs"][2]["points"] = 9; }), "9 points are said"));
  EXPECT_TRUE(
      says(told([](SolidResultFiles& f) { f.result["inputs"][2]["units"] = "inch"; }), "none of the points"));
  EXPECT_TRUE(says(told([](SolidResultFiles& f) { f.points = "1 2\n"; }), "bad input: points.xyz:1: no z"));
  EXPECT_TRUE(says(told([](SolidResultFiles& f) { f.points = "1 2 3e99\n"; }), "bad input: points.xyz:1: "));
  EXPECT_TRUE(says(told([](SolidResultFiles& f) { f.result["scan"] = nullptr; }),
                   "made from points, but scan is null"));
  EXPECT_TRUE(says(told([](SolidResultFiles& f) { f.result["inputs"][2]["triangles"] = 1; }), "bad input"));
  EXPECT_TRUE(says(told([](SolidResultFiles& f) { f.result["inputs"][1]["points"] = 1; }), "bad input"));
  EXPECT_TRUE(says(told([](SolidResultFiles& f) { f.result["inputs"].push_back(f.result["inputs"][2]); }),
                   "two files of points"));
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_points_test

// What the checker says of results for a blank from a scanner: its triangles have widths.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "support/solid_results.hpp"

namespace lekalo::verify::verify_solid_scan_test {
namespace {

using cases::cube_in_cube;
using cases::Json;
using cases::one_leaf;
using cases::SolidResultFiles;

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// The blank's material begins 0.3 within its triangles, so that the best clearance is 0.7.
constexpr double kLeft = 0.699999, kBound = 0.700001;

Json planes(double level) {
  return one_leaf(Json::array({{"plane", 0, 0, 1}, {"plane", 1, 1, 1}}),
                  Json::array({{-5, -5, -5, 0}, {5, -5, -5, 0}}), Json::array(),
                  Json::array({{1, 0, 0, level}, {-2, 0, 0, 2 * level}}));
}
Json balls(double radius, double out) {
  return one_leaf(Json::array({{"ball", 0, 0, 1}, {"ball", 0, 1, 1}}), Json::array({{0, 0, 0, 5}}),
                  Json::array({{6 + out, 0, 0, radius}, {-6 - out, 0, 0, radius}}), Json::array(), 0);
}
Json faces() {
  return one_leaf(Json::array({{"face", 0, 8, 2}, {"face", 1, 10, 2}}),
                  Json::array({{-5, -5, -5, 0}, {5, -5, -5, 0}}), Json::array(), Json::array(), 0.5);
}

SolidResultFiles scanned(const Json& certificate = nullptr, double bound = kBound, double shift = 0.5) {
  SolidResultFiles files = cube_in_cube(certificate, bound, "xyz", shift);
  Json& r = files.result;
  r["scan"] = cases::scan_by_dip(0.1, 0.2, 0.3);
  r["clearance"] = kLeft, r["contacts"][0]["distance"] = 0.7;
  if (!certificate.is_null()) r["gap"] = bound - kLeft;
  return files;
}
std::string told(const std::function<void(Json&)>& change) {
  SolidResultFiles files = scanned();
  change(files.result);
  return files.told();
}

TEST(SolidScan, TheWidthsAreTakenOffTheClearance) {
  EXPECT_EQ(scanned().told(), "unproved");
  EXPECT_TRUE(
      says(told([](Json& r) { r["clearance"] = 0.7001; }), "refuted; the clearance 0.7001 mm is above"));
  EXPECT_TRUE(
      says(told([](Json& r) { r["contacts"][0]["distance"] = 1; }), "refuted; contact 0: the points"));
  EXPECT_TRUE(says(told([](Json& r) { r["scan"] = nullptr; }), "refuted; contact 0"));
}

TEST(SolidScan, CertificatesCountTheWidths) {
  EXPECT_EQ(scanned(planes(-5.7000001)).told(), "confirmed");
  EXPECT_TRUE(says(scanned(planes(-5.69)).told(), "a corner of the blank's triangle"));
  EXPECT_TRUE(says(scanned(planes(-5.7000001), 0.69).told(), "refuted; "));
  // Beside the blank the width adds to the distance.
  EXPECT_EQ(scanned(balls(10.2999999, 10), kBound, 0).told(), "confirmed");
  EXPECT_TRUE(says(scanned(balls(10.31, 10), kBound, 0).told(), "less its width"));
  EXPECT_EQ(scanned(faces()).told(), "confirmed");
  SolidResultFiles as_drawn = cube_in_cube(faces(), kBound);
  as_drawn.result["clearance"] = kLeft, as_drawn.result["gap"] = kBound - kLeft;
  EXPECT_TRUE(says(as_drawn.told(), "do not prove"));
}

TEST(SolidScan, ABallWithinAWidthHasNoMaterial) {
  const auto at = [](double in, double radius) {
    return scanned(one_leaf(Json::array({{"ball", 0, 0, 1}, {"ball", 0, 1, 1}}), Json::array({{0, 0, 0, 5}}),
                            Json::array({{6 - in, 0, 0, radius}, {in - 6, 0, 0, radius}}), Json::array(), 0),
                   kBound, 0)
        .told();
  };
  EXPECT_EQ(at(0, 0.2999999), "confirmed");
  EXPECT_EQ(at(0.1, 0.1999999), "confirmed");
  EXPECT_TRUE(says(at(0, 0.31), "less its width"));
  EXPECT_TRUE(says(at(0.1, 0.21), "its centre is in the blank")) << at(0.1, 0.21);
}

TEST(SolidScan, FieldsOfTheScanAreHeldAgainstTheMesh) {
  EXPECT_TRUE(says(told([](Json& r) { r["scan"]["guard"] = 0.05; }), "scan.widest is 0.3, but"));
  EXPECT_TRUE(says(told([](Json& r) { r["scan"]["widest"] = 0.2; }), "scan.widest is 0.2, but"));
  EXPECT_TRUE(says(told([](Json& r) { r["scan"]["unknown_triangles"] = 1; }), "unknown_triangles is 1"));
  EXPECT_TRUE(says(told([](Json& r) { r["scan"]["proved"] = false; }), "scan.proved is false"));
  EXPECT_TRUE(says(told([](Json& r) { r["unknown_area_mm2"] = 1; }), "unknown_area_mm2 is 1"));
  for (const char* field : {"guard", "min_radius", "max_dip", "underside", "widest", "assumptions"})
    EXPECT_TRUE(says(told([&](Json& r) { r["scan"].erase(field); }), "bad input")) << field;
  EXPECT_TRUE(says(told([](Json& r) { r["scan"]["max_dip"] = nullptr; }), "neither a min_radius nor"));
  EXPECT_TRUE(says(told([](Json& r) { r["scan"]["min_radius"] = 0.1; }), "min_radius is not above"));
  EXPECT_TRUE(says(told([](Json& r) { r["scan"]["assumptions"] = Json::array(); }), "without a sentence"));
  EXPECT_TRUE(says(told([](Json& r) { r["scan"]["more"] = 1; }), "bad input"));
}

/// The cube's triangles have circles of 6 sqrt(2), so that a reach of 9 covers them and one of 8 does not.
TEST(SolidScan, ARadiusCoversTrianglesThatAreSmallEnough) {
  const auto by_radius = [](double radius) {
    SolidResultFiles files = scanned();
    Json& r = files.result;
    r["scan"]["max_dip"] = nullptr, r["scan"]["min_radius"] = radius, r["scan"]["guard"] = 0;
    const double left = radius * radius - 72, width = left > 0 ? radius - std::sqrt(left) : 0;
    r["scan"]["widest"] = width;
    r["clearance"] = 1 - width - 1e-6, r["contacts"][0]["distance"] = 1 - width;
    return files;
  };
  EXPECT_EQ(by_radius(40).told(), "unproved");  // 0.91
  SolidResultFiles unknown = by_radius(8);
  EXPECT_TRUE(says(unknown.told(), "scan.unknown_triangles is 0, but there are 12"));
  unknown.result["scan"]["unknown_triangles"] = 12, unknown.result["scan"]["proved"] = false;
  unknown.result["unknown_area_mm2"] = 864;
  EXPECT_EQ(unknown.told(), "incomplete");
  ASSERT_TRUE(unknown.report());
  EXPECT_TRUE(says(unknown.report()->notes.front(), "12 triangles of the scan are unknown, 864 mm2"));
}

TEST(SolidScan, AStatementClosesTheUnderside) {
  SolidResultFiles files = scanned();
  Json& r = files.result;
  r["scan"]["max_dip"] = nullptr, r["scan"]["min_radius"] = 100, r["scan"]["guard"] = 0;
  r["scan"]["underside"] = {{"z", -6.1}, {"flat", 0.2}};
  // Those beside it count with 0.2, those above with nothing.
  const double beside = 100 - std::sqrt(99.8 * 99.8 - 72);
  r["scan"]["widest"] = beside;
  r["clearance"] = 1 - beside - 1e-6, r["contacts"][0]["distance"] = 1 - beside;
  EXPECT_EQ(files.told(), "unproved");
  r["scan"]["underside"]["flat"] = 0.05;
  EXPECT_TRUE(says(files.told(), "scan.widest is")) << "nothing is of the underside";
}

}  // namespace
}  // namespace lekalo::verify::verify_solid_scan_test

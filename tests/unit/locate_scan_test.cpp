#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "lekalo/geom/region_index.hpp"
#include "lekalo/locate/guaranteed_blank.hpp"
#include "lekalo/locate/region.hpp"
#include "support/cases.hpp"
#include "support/scan_files.hpp"

namespace lekalo::locate_scan_test {
namespace {

using locate::PointOrder;
using locate::ScanOptions;
using locate::ScanPoints;
using scan_files::rectangle;

ScanPoints contours(const std::vector<geom::Ring>& rings) {
  ScanPoints scan;
  scan.contour_starts.clear();
  for (const geom::Ring& ring : rings) {
    scan.contour_starts.push_back(static_cast<std::uint32_t>(scan.points.size()));
    scan.points.insert(scan.points.end(), ring.begin(), ring.end());
  }
  return scan;
}

locate::GuaranteedBlank made(const ScanPoints& scan, const ScanOptions& options) {
  auto blank = locate::guaranteed_blank(scan, options);
  EXPECT_TRUE(blank) << blank.error().message;
  return blank ? *std::move(blank) : locate::GuaranteedBlank{};
}

std::string refusal(const ScanPoints& scan, const ScanOptions& options,
                    ErrorCode code = ErrorCode::bad_input) {
  const auto blank = locate::guaranteed_blank(scan, options);
  EXPECT_FALSE(blank);
  if (blank) return {};
  EXPECT_EQ(blank.error().code, code);
  return blank.error().message;
}

TEST(GuaranteedBlank, ASquareLosesItsGuardAndLittleMore) {
  ScanOptions options;
  options.uncertainty = 0.05;
  options.coverage_factor = 3;
  options.simplify = 0.001;
  const auto blank = made(contours({rectangle(0, 0, 10, 10, 1)}), options);
  EXPECT_DOUBLE_EQ(blank.guard, 0.15);
  ASSERT_EQ(blank.regions.size(), 1U);
  EXPECT_EQ(blank.regions[0].outer.size(), 4U);
  EXPECT_NEAR(geom::area(blank.regions[0]), 9.7 * 9.7, 0.03);
  EXPECT_NEAR(blank.loss, 0.15 * std::sqrt(2.0), 1e-3);
}

TEST(GuaranteedBlank, TheDirectionOfContoursDoesNotMatterAndNestingTellsHoles) {
  geom::Ring outer = rectangle(0, 0, 40, 40, 1), hole = rectangle(10, 10, 20, 20, 1),
             core = rectangle(15, 15, 10, 10, 1);
  const auto blank = made(contours({outer, hole, core}), {});
  ASSERT_EQ(blank.regions.size(), 2U);
  EXPECT_EQ(blank.regions[0].holes.size() + blank.regions[1].holes.size(), 1U);
  std::reverse(outer.begin(), outer.end());
  std::reverse(core.begin(), core.end());
  const auto turned = made(contours({core, outer, hole}), {});
  double area = 0, turned_area = 0;
  for (const auto& r : blank.regions) area += geom::area(r);
  for (const auto& r : turned.regions) turned_area += geom::area(r);
  EXPECT_NEAR(area, 1600 - 400 + 100, 1);
  EXPECT_NEAR(area, turned_area, 0.1);
}

TEST(GuaranteedBlank, APointInsideIsADentAndNotNoise) {
  geom::Ring ring = rectangle(0, 0, 20, 20, 1);
  ring[10] = {10, 3};
  ScanOptions options;
  options.step = 4;
  const auto blank = made(contours({ring}), options);
  EXPECT_TRUE(blank.dropped.empty());
  const geom::RegionIndex index(blank.regions);
  EXPECT_FALSE(index.contains({10, 2.9}));
  EXPECT_TRUE(index.contains({10, 3.1}));
  // Without order such a point makes the contour ambiguous, and a step that does not reach it leaves it
  // alone.
  options.order = PointOrder::none;
  EXPECT_NE(refusal(contours({ring}), options).find("cannot be told"), std::string::npos);
  ring.push_back({10, 10});
  options.step = 1.5;
  EXPECT_NE(refusal(contours({ring}), options).find("--drop-outliers"), std::string::npos);
}

TEST(GuaranteedBlank, OutliersAreLeftOutOnRequestAndListed) {
  geom::Ring ring = rectangle(0, 0, 20, 20, 1);
  ring.push_back({10, 10});
  ring.push_back({300, 10});
  ScanOptions options;
  options.order = PointOrder::none;
  options.drop_outliers = 2;
  const auto blank = made(contours({ring}), options);
  EXPECT_EQ(blank.dropped, (std::vector<std::uint32_t>{80, 81}));
  EXPECT_TRUE(blank.proved());
}

TEST(GuaranteedBlank, WidthsJustBelowAndAboveWhatARadiusBridges) {
  // A gap of 10 mm: a disc of radius 5 (less the guard) falls in, one of 5.1 does not.
  geom::Ring ring = rectangle(0, 0, 40, 40, 1);
  ring.erase(ring.begin() + 11, ring.begin() + 20);
  ScanOptions options;
  options.uncertainty = 0.01;
  options.min_radius = 5.019;
  EXPECT_FALSE(made(contours({ring}), options).proved());
  options.min_radius = 5.1;
  const auto blank = made(contours({ring}), options);
  EXPECT_TRUE(blank.proved());
  EXPECT_NEAR(blank.deepest + blank.guard, 5.1 - std::sqrt(5.08 * 5.08 - 25), 1e-9);
  // The depth stated takes over where the radius says nothing.
  options.min_radius = 1;
  EXPECT_FALSE(made(contours({ring}), options).proved());
  options.max_dip = 0.5;
  EXPECT_TRUE(made(contours({ring}), options).proved());
}

TEST(GuaranteedBlank, ACrossedOrderIsRefusedOrGivenUp) {
  geom::Ring ring = rectangle(0, 0, 20, 20, 1);
  std::swap(ring[5], ring[30]);
  ScanOptions options;
  options.order = PointOrder::given;
  EXPECT_NE(refusal(contours({ring}), options).find("meets itself"), std::string::npos);
  options.order = PointOrder::automatic;
  const auto blank = made(contours({ring}), options);
  EXPECT_FALSE(blank.ordered);
  ASSERT_EQ(blank.notices.size(), 1U);
  EXPECT_NE(blank.notices[0].find("no order"), std::string::npos);
}

TEST(GuaranteedBlank, WallsThinnerThanTheSpacingAreRefusedNotGuessed) {
  ScanOptions options;
  options.order = PointOrder::none;
  const auto outer = rectangle(0, 0, 30, 30, 1);
  EXPECT_NE(refusal(contours({outer, rectangle(1.2, 5, 20, 20, 1)}), options).find("cannot be told"),
            std::string::npos);
  EXPECT_EQ(made(contours({outer, rectangle(5, 5, 20, 20, 1)}), options).outlines.size(), 2U);
}

TEST(GuaranteedBlank, NothingIsLeftOfABlankThinnerThanItsGuards) {
  ScanOptions options;
  options.uncertainty = 1;
  EXPECT_NE(refusal(contours({rectangle(0, 0, 30, 3.9, 1)}), options).find("nothing of the blank is proved"),
            std::string::npos);
}

TEST(GuaranteedBlank, OptionsOutOfRangeAreUsageErrors) {
  const ScanPoints scan = contours({rectangle(0, 0, 10, 10, 1)});
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {-1.0, nan, infinity}) {
    ScanOptions o;
    o.uncertainty = bad;
    refusal(scan, o, ErrorCode::usage);
    o = {};
    o.coverage_factor = bad;
    refusal(scan, o, ErrorCode::usage);
    o = {};
    o.min_radius = bad;
    refusal(scan, o, ErrorCode::usage);
    o = {};
    o.max_dip = bad;
    refusal(scan, o, ErrorCode::usage);
    o = {};
    o.step = bad;
    refusal(scan, o, ErrorCode::usage);
    o = {};
    o.drop_outliers = bad;
    refusal(scan, o, ErrorCode::usage);
    o = {};
    o.simplify = bad;
    refusal(scan, o, ErrorCode::usage);
  }
  ScanOptions o;
  o.uncertainty = 1;
  o.min_radius = 2;
  EXPECT_NE(refusal(scan, o, ErrorCode::usage).find("not above the guard of 2 mm"), std::string::npos);
}

TEST(GuaranteedBlank, StrangePointsAreRefused) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  refusal(contours({{{0, 0}, {1, 0}, {nan, 1}}}), {});
  refusal(contours({{{0, 0}, {1, 0}, {1e10, 1}}}), {});
  refusal(contours({{}}), {});
  refusal(contours({{{0, 0}, {0, 0}, {0, 0}, {1, 1}}}), {});
  for (const PointOrder order : {PointOrder::automatic, PointOrder::given, PointOrder::none}) {
    ScanOptions options;
    options.order = order;
    refusal(contours({{{0, 0}, {1, 1}, {2, 2}, {3, 3}}}), options);
    refusal(contours({{{0, 0}, {0, 0}, {0, 0}, {0, 0}}}), options);
  }
}

TEST(GuaranteedBlank, HugeAndTinyAndLonelyPointsDoNotStopIt) {
  // One point a thousand kilometres away, and all of a cloud in one place.
  geom::Ring ring = rectangle(0, 0, 20, 20, 0.05);
  ring.push_back({1e9, 1e9});
  ScanOptions options;
  options.order = PointOrder::none;
  refusal(contours({ring}), options);
  options.drop_outliers = 1;
  EXPECT_TRUE(made(contours({ring}), options).proved());
  geom::Ring cloud;
  Random random(1);
  for (int i = 0; i < 20000; ++i) cloud.push_back({random.uniform(0, 1), random.uniform(0, 1)});
  refusal(contours({cloud}), options);
}

TEST(GuaranteedBlank, FarFromTheOriginItIsTheSameButForDigits) {
  for (const double far : {1e5, 1e8}) {
    geom::Ring outer = rectangle(0, 0, 40, 40, 1), hole = rectangle(10, 10, 20, 20, 1);
    for (geom::Ring* ring : {&outer, &hole})
      for (geom::Point& p : *ring) p = p + geom::Point{far, -far};
    for (const PointOrder order : {PointOrder::given, PointOrder::none}) {
      ScanOptions options;
      options.uncertainty = 0.01;
      options.order = order;
      const auto blank = made(contours({outer, hole}), options);
      EXPECT_TRUE(blank.proved());
      ASSERT_EQ(blank.regions.size(), 1U);
      EXPECT_NEAR(geom::area(blank.regions[0]), 1600 - 400 - 0.02 * 240, 0.5);
    }
  }
}

TEST(GuaranteedBlank, TheAssumptionsSayWhatWasAssumed) {
  ScanOptions options;
  options.uncertainty = 0.02;
  options.min_radius = 3;
  const auto blank = made(contours({rectangle(0, 0, 20, 20, 1)}), options);
  std::string all;
  for (const std::string& sentence : blank.assumptions) all += sentence + "\n";
  for (const char* part : {"within 0.04 mm", "2 times", "95.45 % for each point by itself",
                           "1 closed contour", "disc of radius 3 mm rolls", "no dent"})
    EXPECT_NE(all.find(part), std::string::npos) << part << " in\n" << all;
}

TEST(GuaranteedBlank, GoesIntoTheCertifiedSearch) {
  ScanOptions options;
  options.uncertainty = 0.01;
  options.min_radius = 4;
  const auto blank = made(contours({rectangle(0, 0, 62, 42, 1), rectangle(20, 12, 18, 18, 1)}), options);
  const auto part = [](geom::Ring outer, geom::Ring hole) {
    const auto contour = [](const geom::Ring& ring) {
      geom::Contour c;
      for (std::size_t i = 0; i < ring.size(); ++i)
        c.push_back({geom::EdgeKind::line, ring[i], ring[(i + 1) % ring.size()], {}});
      return c;
    };
    return std::vector<geom::Region>{geom::make_region(contour(outer), {contour(hole)}).value()};
  };
  locate::RegionProblem problem;
  problem.part = part({{0, 0}, {60, 0}, {60, 40}, {0, 40}}, {{18, 10}, {38, 10}, {38, 30}, {18, 30}});
  problem.blank = blank.regions;
  const auto result = locate::locate_regions(problem, {});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->status, locate::Status::optimal);
  // One millimetre all round in truth, less guard, dip and simplification.
  EXPECT_LE(result->best.clearance, 1 - blank.guard - blank.deepest + 1e-9);
  EXPECT_GE(result->best.clearance, 1 - blank.guard - blank.deepest - options.simplify - 1e-3);
}

}  // namespace
}  // namespace lekalo::locate_scan_test

// Booleans of operands whose edges nearly coincide, against membership in the operands by rays.

#include <gtest/gtest.h>

#include "support/boolean_hard_cases.hpp"
#include "support/cases.hpp"

namespace lekalo::geom::geom_boolean_test {
namespace {

using cases::HardKind;
using Op = BooleanOperation;

constexpr Op kAll[] = {Op::unite, Op::intersect, Op::subtract, Op::exclude};

enum class Snapping { usual, any };

/// Whether all were snapped once, or twice eight times as far where that contradicted itself.
bool check(const cases::HardPair& pair, Random& random, int points, Snapping snapping = Snapping::usual) {
  bool usually = true;
  for (const Op op : kAll) {
    const auto result = combine(pair.a, pair.b, op);
    if (!result) {
      ADD_FAILURE() << result.error().message;
      return false;
    }
    EXPECT_EQ(cases::boolean_fault(pair, op, *result, random, points), "") << static_cast<int>(op);
    const double usual =
        kEdgeErrorInSnaps * kBooleanSnap * std::max(cases::extent_of(pair.a), cases::extent_of(pair.b));
    usually = usually && result->edge_error <= 64.001 * usual;
  }
  EXPECT_TRUE(usually || snapping == Snapping::any);
  return usually;
}

TEST(BooleanAgainstRays, OperandsThatNearlyCoincide) {
  const std::size_t count = cases::case_count(60);
  for (const HardKind kind : cases::kHardKinds)
    for (std::size_t i = 0; i < count; ++i) {
      Random random(cases::seed(), 11 * i + static_cast<std::uint64_t>(kind));
      SCOPED_TRACE(fmt::format("kind {} index {} seed {}", static_cast<int>(kind), i, cases::seed()));
      check(cases::hard_pair(random, kind), random, 40);
      if (testing::Test::HasFailure()) return;
    }
}

std::vector<Region> scaled(const std::vector<Region>& regions, double by, Point shift) {
  const auto map = [&](const Contour& contour) {
    Contour out = contour;
    for (Edge& e : out)
      e.from = by * e.from + shift, e.to = by * e.to + shift, e.centre = by * e.centre + shift;
    for (Edge& e : out)
      if (e.kind == EdgeKind::line) e.centre = {};
    return out;
  };
  std::vector<Region> made;
  for (const Region& r : regions) {
    std::vector<Contour> holes;
    for (const Contour& h : r.holes) holes.push_back(map(h));
    if (auto region = make_region(map(r.outer), std::move(holes))) made.push_back(std::move(*region));
  }
  return made;
}

TEST(BooleanAgainstRays, TinyAndHugeCoordinates) {
  const std::size_t count = cases::case_count(30);
  std::size_t further = 0;
  for (const auto& [by, shift] : {std::pair{1e-6, Point{}},
                                  {1e8, Point{}},
                                  {1e-6, Point{1e-5, -3e-6}},
                                  {1.0, Point{1e8, -1e7}},
                                  {1e-3, Point{1e4, 1e4}},
                                  {1e-100, Point{}}})
    for (std::size_t i = 0; i < count; ++i) {
      Random random(cases::seed(), 500 + i);
      SCOPED_TRACE(fmt::format("by {} index {} seed {}", by, i, cases::seed()));
      cases::HardPair pair = cases::hard_pair(random, HardKind::shaken);
      pair.a = scaled(pair.a, by, shift), pair.b = scaled(pair.b, by, shift);
      further += check(pair, random, 30, Snapping::any) ? 0 : 1;
      if (testing::Test::HasFailure()) return;
    }
  // Shapes of microns ten metres from the origin: nearly tangent edges may take more, and the error says so.
  EXPECT_LE(further, 1 + count / 1000);
}

TEST(BooleanAgainstRays, ThousandsOfEdges) {
  Random random(cases::seed(), 3);
  Ring wheel, other;
  constexpr std::size_t kEdges = 3000;
  for (std::size_t i = 0; i < kEdges; ++i) {
    const double t = 6.283185307179586 * static_cast<double>(i) / kEdges;
    wheel.push_back((50 + random.uniform(0, 1)) * cases::direction_of(t));
    other.push_back((50 + random.uniform(0, 1)) * cases::direction_of(t + 1e-4));
  }
  const cases::HardPair pair{{make_region(cases::boolean_polygon(wheel)).value()},
                             {make_region(cases::boolean_polygon(other)).value()}};
  check(pair, random, 2000);
  // All through one point.
  cases::HardPair fan;
  for (std::size_t i = 0; i < 400; ++i) {
    const double t = 6.283185307179586 * static_cast<double>(i) / 400;
    (i % 2 == 0 ? fan.a : fan.b)
        .push_back(make_region(cases::boolean_polygon(
                                   {{0, 0}, 9 * cases::direction_of(t), 9 * cases::direction_of(t + 0.7)}))
                       .value());
  }
  check(fan, random, 300);
}

// ---- what was wrong once ----------------------------------------------------------------------------------

TEST(BooleanAgainstRays, ANotchOfMicronsOnATailOfAMetreIsKept) {
  // Thin by area over length (the tail is 1e-9 mm wide), a thousand errors wide where the notch is.
  const cases::HardPair pair{{make_region(cases::boolean_rectangle(0, 0, 1000, 10)).value()},
                             {make_region(cases::boolean_polygon({{-1, 3e-9},
                                                                  {400, 3e-9},
                                                                  {400, 1e-6},
                                                                  {400 + 1e-6, 1e-6},
                                                                  {400 + 1e-6, 3e-9},
                                                                  {1001, 3e-9},
                                                                  {1001, 12},
                                                                  {-1, 12}}))
                                  .value()}};
  const auto result = combine(pair.a, pair.b, Op::subtract);
  ASSERT_TRUE(result.has_value());
  EXPECT_TRUE(RegionIndex(result->regions).contains({400 + 5e-7, 5e-7}));
  Random random(cases::seed(), 1);
  check(pair, random, 400);
}

TEST(BooleanAgainstRays, ACuspWhoseArcMissesItsTipIsNoFalseAlarm) {
  // A slot with waisted ends meets a circular hole at the tip of a cusp; the rays counted the circle beyond
  // it.
  Random random(1, 500 + 1851);
  cases::HardPair pair = cases::hard_pair(random, HardKind::shaken);
  pair.a = scaled(pair.a, 1e-6, {}), pair.b = scaled(pair.b, 1e-6, {});
  const auto result = combine(pair.a, pair.b, Op::exclude);
  ASSERT_TRUE(result.has_value());
  EXPECT_FALSE(RegionIndex(result->regions).contains({5.000000000016619e-06, 1.9999999999987577e-06}));
  check(pair, random, 2000);
}

TEST(BooleanAgainstRays, ATriangleTwoErrorsThickIsKept) {
  const cases::HardPair pair{
      {make_region(cases::boolean_rectangle(0, 0, 10, 10)).value()},
      {make_region(cases::boolean_polygon({{0, 7e-11}, {10, 0}, {11, 0}, {11, 11}, {0, 11}})).value()}};
  const auto result = combine(pair.a, pair.b, Op::subtract);
  ASSERT_TRUE(result.has_value());
  EXPECT_LT(result->edge_error, 2.1e-11);
  EXPECT_TRUE(RegionIndex(result->regions).contains({0.02, 3.5e-11}));
}

}  // namespace
}  // namespace lekalo::geom::geom_boolean_test

// The predicates against GMP rationals, on points chosen to be hard; which arithmetic tier answered, and that
// each tier agrees with the next; the error bound of the filter.

#include "lekalo/geom/predicates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geom/turn_tiers.hpp"
#include "support/cases.hpp"
#include "support/exact_geometry.hpp"
#include "support/near_degenerate.hpp"

namespace lekalo::geom_predicates_test {
namespace {

using cases::PointKind;
using geom::Point;

std::size_t count() { return std::max<std::size_t>(20000, cases::case_count(20000)); }

struct TierCounts {
  std::size_t filter = 0, exact_differences = 0, expansion = 0, zero = 0;
};

/// Checks all tiers of one turn against the rational sign and against each other, and counts who answered.
void check_turn(Point a, Point b, Point c, Point d, TierCounts& counts) {
  const int exact = sgn(exact::turn(a, b, c, d));
  ASSERT_EQ(geom::turn(a, b, c, d), exact);
  ASSERT_EQ(geom::detail::turn_exact(a, b, c, d), exact);
  const geom::detail::TurnDifferences differences(a, b, c, d);
  ASSERT_EQ(geom::detail::turn_by_expansion(differences), exact);
  const int filtered = geom::detail::turn_filter(a, b, c, d);
  const int by_differences = geom::detail::turn_of_exact_differences(differences);
  if (by_differences != geom::detail::kUndecided) {
    ASSERT_EQ(by_differences, exact);
  }
  counts.zero += exact == 0;
  if (filtered != geom::detail::kUndecided) {
    ASSERT_EQ(filtered, exact);
    ++counts.filter;
  } else if (by_differences != geom::detail::kUndecided) {
    ++counts.exact_differences;
  } else {
    ++counts.expansion;
  }
}

TierCounts check_kind(PointKind kind, bool three_points) {
  TierCounts counts;
  Random random(cases::seed(), 100 + static_cast<std::uint64_t>(kind));
  for (std::size_t i = 0; i < count() && !testing::Test::HasFatalFailure(); ++i) {
    const auto p = cases::hard_points(random, kind);
    if (three_points) {
      check_turn(p[0], p[1], p[0], p[2], counts);
    } else {
      check_turn(p[0], p[1], p[2], p[3], counts);
    }
  }
  return counts;
}

TEST(PredicatesAgainstRationals, RandomPointsAreAnsweredByTheFilter) {
  for (const bool three : {true, false}) {
    const TierCounts counts = check_kind(PointKind::uniform, three);
    EXPECT_EQ(counts.filter, count());
  }
}

TEST(PredicatesAgainstRationals, OnAGridTheExactDifferencesAnswerWhatTheFilterLeaves) {
  const TierCounts counts = check_kind(PointKind::grid, true);
  EXPECT_GT(counts.zero, count() / 8);
  EXPECT_GT(counts.exact_differences, count() / 40);
  EXPECT_EQ(counts.expansion, 0u);
}

TEST(PredicatesAgainstRationals, UlpsAboutALineNeedExpansions) {
  for (const bool three : {true, false}) {
    const TierCounts counts = check_kind(PointKind::ulps_about_a_line, three);
    EXPECT_GT(counts.expansion, count() / 20);
  }
}

TEST(PredicatesAgainstRationals, KettnersCorner) {
  const TierCounts counts = check_kind(PointKind::kettner, true);
  EXPECT_GT(counts.expansion, count() / 20);
  EXPECT_GT(counts.zero, count() / 200);
}

TEST(PredicatesAgainstRationals, FarFromTheOrigin) {
  // Differences of neighbours do not round here, however large the coordinates.
  const TierCounts counts = check_kind(PointKind::far_from_origin, true);
  EXPECT_GT(counts.zero, count() / 200);
  EXPECT_EQ(counts.expansion, 0u);
}

TEST(PredicatesAgainstRationals, EverySizeTheHeaderPromises) {
  for (const bool three : {true, false}) {
    const TierCounts counts = check_kind(PointKind::any_size, three);
    EXPECT_GT(counts.expansion + counts.exact_differences, count() / 100);
    check_kind(PointKind::sparse, three);
  }
}

TEST(PredicatesAgainstRationals, AtBothEndsOfTheRangeTheLastBitsCount) {
  // Neighbours of the smallest coordinates differ by 2^-532: their products are the smallest that occur.
  for (const double scale : {geom::kSmallestExactCoordinate, geom::kLargestExactCoordinate / 4}) {
    Random random(cases::seed(), 200);
    TierCounts counts;
    for (std::size_t i = 0; i < count(); ++i) {
      const auto near_one = [&] { return scale * cases::few_ulps_off(random, 1.5 + random.uniform()); };
      const Point a{near_one(), near_one()};
      const auto near_a = [&] {
        return Point{a.x + scale * static_cast<double>(random.below(9)) * 0x1p-51,
                     a.y + scale * static_cast<double>(random.below(9)) * 0x1p-51};
      };
      check_turn(a, near_a(), a, near_a(), counts);
      check_turn(a, {near_one(), near_one()}, near_a(), {near_one(), near_one()}, counts);
      if (HasFatalFailure()) return;
    }
    EXPECT_GT(counts.zero, count() / 50);
  }
}

TEST(PredicatesAgainstRationals, TheFilterBoundHoldsAndIsNotIdle) {
  static_assert(geom::kOrientationFilter == (3 + 16 * 0x1p-53) * 0x1p-53, "(3 + 16 u) u, without rounding");
  double worst = 0;
  for (const PointKind kind : cases::kPointKinds) {
    Random random(cases::seed(), 300 + static_cast<std::uint64_t>(kind));
    for (std::size_t i = 0; i < count(); ++i) {
      const auto [a, b, c, d] = cases::hard_points(random, kind);
      const double left = (b.x - a.x) * (d.y - c.y), right = (b.y - a.y) * (d.x - c.x);
      const mpq_class size = abs(mpq_class(left)) + abs(mpq_class(right));
      if (size == 0) continue;
      const mpq_class error = abs(mpq_class(left) - mpq_class(right) - exact::turn(a, b, c, d));
      const mpq_class used = error / size / mpq_class(geom::kOrientationFilter);
      worst = std::max(worst, used.get_d());
    }
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_GT(worst, 0.5) << "a bound this wide sends needless work to the slow tiers";
}

TEST(PredicatesAgainstRationals, SegmentRelation) {
  std::size_t seen[4] = {};
  for (const PointKind kind : cases::kPointKinds) {
    Random random(cases::seed(), 400 + static_cast<std::uint64_t>(kind));
    for (std::size_t i = 0; i < count() / 2; ++i) {
      auto [a, b, c, d] = cases::hard_points(random, kind);
      if (random.below(2) == 0) std::swap(b, c);  // pairs that cross as well as pairs that run side by side
      const geom::SegmentRelation relation = geom::segment_relation(a, b, c, d);
      ASSERT_EQ(relation, exact::segment_relation(a, b, c, d))
          << "kind " << static_cast<int>(kind) << " case " << i;
      ++seen[static_cast<int>(relation)];
    }
  }
  for (const std::size_t times : seen) EXPECT_GT(times, count() / 100);
}

/// Rings of few distinct coordinates: collinear runs, repeated points, crossings, horizontal edges.
geom::Ring awkward_ring(Random& random) {
  geom::Ring ring(random.below(12));
  const bool on_grid = random.below(2) == 0;
  for (Point& p : ring) {
    p = {static_cast<double>(random.below(6)), static_cast<double>(random.below(6))};
    if (!on_grid) p = {cases::few_ulps_off(random, p.x / 10), cases::few_ulps_off(random, p.y / 10)};
  }
  return ring;
}

TEST(PredicatesAgainstRationals, LocatePoint) {
  std::size_t seen[3] = {};
  Random random(cases::seed(), 500);
  for (std::size_t i = 0; i < count(); ++i) {
    const geom::Ring ring = awkward_ring(random);
    Point p{static_cast<double>(random.below(12)) / 2, static_cast<double>(random.below(12)) / 2};
    if (!ring.empty() && random.below(2) == 0) {
      const Point a = ring[random.below(ring.size())], b = ring[random.below(ring.size())];
      p = a + random.uniform() * (b - a);
    }
    const geom::PointLocation location = geom::locate_point(ring, p);
    ASSERT_EQ(location, exact::locate_point(ring, p)) << "case " << i;
    ++seen[static_cast<int>(location)];
  }
  for (const std::size_t times : seen) EXPECT_GT(times, count() / 50);
}

}  // namespace
}  // namespace lekalo::geom_predicates_test

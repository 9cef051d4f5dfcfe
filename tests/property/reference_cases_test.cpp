// The random cases keep what they promise, and the reference methods never report more clearance than there
// is.

#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/locate/reference.hpp"
#include "lekalo/phi/convex.hpp"
#include "support/cases.hpp"

namespace lekalo::reference_cases_test {
namespace {

TEST(Cases, TheKnownPoseHasThePromisedAllowance) {
  const std::size_t count = cases::case_count(400);
  for (std::size_t index = 0; index < count; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    ASSERT_GT(c.allowance, 0) << c.name;
    const auto clearance = phi::clearance_enclosure(c.part, c.blank, c.x, c.y, c.theta);
    // Rounding of the blank's corners, which neighbouring edges of nearly one direction magnify.
    ASSERT_GE(clearance.low, c.allowance - 0x1p-42 * c.largest_coordinate) << c.name;
    const double unit = c.kind == cases::Kind::tiny ? 1e-7 : c.kind == cases::Kind::huge ? 1e6 : 1;
    ASSERT_GE(c.allowance, 0.0999 * unit) << c.name;
    ASSERT_LE(c.allowance, 5 * unit) << c.name;
  }
}

TEST(Cases, AreTheSameForTheSameSeedAndIndex) {
  for (std::size_t index = 0; index < 2 * cases::kKinds.size(); ++index) {
    const auto a = cases::random_case(5, index), b = cases::random_case(5, index),
               c = cases::random_case(6, index);
    EXPECT_EQ(a.part.vertices(), b.part.vertices());
    EXPECT_EQ(a.blank.vertices(), b.blank.vertices());
    EXPECT_EQ(a.theta, b.theta);
    EXPECT_NE(a.blank.vertices(), c.blank.vertices());
  }
}

TEST(Cases, CoverWhatTheirKindsSay) {
  std::size_t most = 0, least = 1000;
  double longest = 0;
  for (std::size_t index = 0; index < 1000; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    most = std::max({most, c.part.size(), c.blank.size()});
    least = std::min({least, c.part.size(), c.blank.size()});
    if (c.kind == cases::Kind::far) {
      EXPECT_GE(c.largest_coordinate, 1e4) << c.name;
      EXPECT_LE(c.largest_coordinate, 5e7) << c.name;
    }
    if (c.kind == cases::Kind::tiny) {
      EXPECT_LE(c.largest_coordinate, 1e-4) << c.name;
    }
    if (c.kind == cases::Kind::huge) {
      EXPECT_GE(c.largest_coordinate, 1e7) << c.name;
    }
    if (c.kind == cases::Kind::sliver) {
      double width = 1e300, length = 0;
      for (std::size_t i = 0; i < c.part.size(); ++i) {
        const geom::Point edge = c.part[c.part.next(i)] - c.part[i];
        double depth = 0;
        for (const geom::Point p : c.part.vertices()) {
          depth = std::max(depth, dot(perpendicular(edge), p - c.part[i]) / norm(edge));
          length = std::max(length, norm(p - c.part[i]));
        }
        width = std::min(width, depth);
      }
      longest = std::max(longest, length / width);
    }
  }
  EXPECT_EQ(least, 3u);
  EXPECT_GE(most, 60u);
  EXPECT_GE(longest, 1e4);
}

TEST(Cases, NearParallelEdgesAreThere) {
  double smallest = 1;
  for (std::size_t index = 0; index < 100; ++index) {
    const auto c = cases::random_case(cases::seed(), index, cases::Kind::near_parallel);
    for (std::size_t i = 0; i < c.part.size(); ++i) {
      const std::size_t j = c.part.next(i);
      const geom::Point a = c.part[j] - c.part[i], b = c.part[c.part.next(j)] - c.part[j];
      smallest = std::min(smallest, std::abs(cross(a, b)) / (norm(a) * norm(b)));
    }
  }
  EXPECT_LT(smallest, 1e-10);
}

TEST(ReferenceMethods, IcpNeverReportsMoreThanTheExactClearance) {
  const std::size_t count = cases::case_count(120);
  for (std::size_t index = 0; index < count; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    const auto best = locate::locate_icp(c.part, c.blank, {}).value().best;
    const auto exact = phi::clearance_enclosure(c.part, c.blank, best.x, best.y, best.theta);
    ASSERT_LE(best.clearance, exact.low) << c.name;
  }
}

#ifdef LEKALO_WITH_IPOPT
TEST(ReferenceMethods, IpoptNeverReportsMoreThanTheExactClearance) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(16), 400);  // 20 ms a start
  for (std::size_t index = 0; index < count; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    locate::IpoptOptions options;
    options.starts = 1;
    options.seed = index;
    const auto result = locate::locate_ipopt(c.part, c.blank, options).value();
    const auto exact =
        phi::clearance_enclosure(c.part, c.blank, result.best.x, result.best.y, result.best.theta);
    ASSERT_LE(result.best.clearance, exact.low) << c.name;
    ASSERT_TRUE(std::isfinite(result.best.clearance)) << c.name;
    if (result.found) {
      // A feasible start is only given up when IPOPT loses it; the tolerance is that of its constraints.
      ASSERT_GE(result.best.clearance, -1e-5 * (1 + c.largest_coordinate)) << c.name;
    }
  }
}
#endif

}  // namespace
}  // namespace lekalo::reference_cases_test

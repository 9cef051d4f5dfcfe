// The laws of geom/boolean.hpp.

#include "lekalo/geom/boolean.hpp"

#include <gtest/gtest.h>

#include <string>

#include "support/boolean_cases.hpp"
#include "support/cases.hpp"

namespace lekalo::geom::geom_boolean_test {
namespace {

using cases::BooleanKind;
using cases::Membership;
using Op = BooleanOperation;
using Regions = std::vector<Region>;

constexpr BooleanKind kKinds[] = {BooleanKind::grid, BooleanKind::turned, BooleanKind::shaken};

struct Pair {
  Regions a, b;
  std::string name;
};
Pair random_pair(std::size_t index) {
  Random random(cases::seed(), 7000 + index);
  const BooleanKind kind = kKinds[index % 3];
  Pair pair;
  pair.a = cases::boolean_operand(random, BooleanKind::grid);
  pair.b = cases::boolean_operand(random, kind);
  if (kind == BooleanKind::turned) {  // both turned alike, so that coincidences stay, up to rounding
    const auto pose = BlankFromPart::from_angle(random.uniform(0, 6.28), {random.uniform(-5, 5), 3});
    pair.a = cases::map_regions(pair.a, pose);
    pair.b = cases::map_regions(cases::boolean_operand(random, BooleanKind::grid), pose);
  }
  pair.name = "pair " + std::to_string(index) + " seed " + std::to_string(cases::seed());
  return pair;
}

bool in_order(const Regions& regions) {
  for (const Region& r : regions) {
    const auto again = make_region(r.outer, r.holes);
    if (!again || !(*again == r)) return false;
  }
  return true;
}

class BooleanLaws : public testing::Test {
 protected:
  static BooleanResult run(const Regions& a, const Regions& b, Op op) {
    auto result = combine(a, b, op);
    EXPECT_TRUE(result.has_value()) << result.error().message;
    if (!result) return {};
    EXPECT_TRUE(in_order(result->regions));
    EXPECT_LE(result->edge_error, 1e-9);
    return *result;
  }
};

TEST_F(BooleanLaws, MembershipIsThatOfTheOperands) {
  const std::size_t count = cases::case_count(3000);
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = random_pair(i);
    SCOPED_TRACE(pair.name);
    const BooleanResult both = run(pair.a, pair.b, Op::intersect), any = run(pair.a, pair.b, Op::unite),
                        rest = run(pair.a, pair.b, Op::subtract), one = run(pair.a, pair.b, Op::exclude);
    const Membership a(pair.a), b(pair.b), in_both(both.regions), in_any(any.regions), in_rest(rest.regions),
        in_one(one.regions);
    Random random(cases::seed(), 90000 + i);
    for (int k = 0; k < 60; ++k) {
      const Point p{random.uniform(-9, 13), random.uniform(-9, 13)};
      if (a.distance(p) < 1e-9 || b.distance(p) < 1e-9) continue;
      const bool x = a.contains(p), y = b.contains(p);
      ASSERT_EQ(in_both.contains(p), x && y) << p.x << " " << p.y;
      ASSERT_EQ(in_any.contains(p), x || y) << p.x << " " << p.y;
      ASSERT_EQ(in_rest.contains(p), x && !y) << p.x << " " << p.y;
      ASSERT_EQ(in_one.contains(p), x != y) << p.x << " " << p.y;
    }
    ASSERT_FALSE(HasFailure());
  }
}

TEST_F(BooleanLaws, AreasAddUp) {
  const std::size_t count = cases::case_count(3000);
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = random_pair(i);
    SCOPED_TRACE(pair.name);
    const Regions a = run(pair.a, {}, Op::unite).regions, b = run(pair.b, {}, Op::unite).regions;
    const BooleanResult result = run(a, b, Op::unite);
    const Regions& any = result.regions;
    const auto both = run(a, b, Op::intersect).regions, rest = run(a, b, Op::subtract).regions,
               other = run(b, a, Op::subtract).regions, one = run(a, b, Op::exclude).regions;
    const double bound = 1e-10 * (1 + cases::length_of(a) + cases::length_of(b));
    const double total = cases::area_of(any), common = cases::area_of(both);
    ASSERT_NEAR(cases::area_of(a) + cases::area_of(b), total + common, bound);
    ASSERT_NEAR(cases::area_of(rest) + common, cases::area_of(a), bound);
    ASSERT_NEAR(cases::area_of(one), total - common, bound);
    ASSERT_NEAR(cases::area_of(rest) + cases::area_of(other), cases::area_of(one), bound);
    // Both orders.
    ASSERT_NEAR(cases::area_of(run(b, a, Op::unite).regions), total, bound);
    ASSERT_NEAR(cases::area_of(run(b, a, Op::intersect).regions), common, bound);
    // What was taken off does not meet the tool, nor what is left.
    ASSERT_TRUE(run(rest, b, Op::intersect).regions.empty());
    ASSERT_TRUE(run(rest, both, Op::intersect).regions.empty());
    ASSERT_TRUE(run(any, a, Op::subtract).regions.size() <= b.size() + 20);
    ASSERT_NEAR(cases::area_of(run(rest, both, Op::unite).regions), cases::area_of(a), bound);
    // Neither does anything twice change anything.
    ASSERT_TRUE(run(any, any, Op::subtract).regions.empty());
    ASSERT_TRUE(run(any, any, Op::exclude).regions.empty());
    const BooleanResult again = run(any, any, Op::unite);
    ASSERT_LT(again.corner_error, 1e-4);
    // The corners of edges that touch move along them.
    if (i % 3 != 0 || result.corner_error > 1e-9 || again.corner_error > 1e-9) continue;
    ASSERT_EQ(again.regions, any);
    ASSERT_EQ(run(any, any, Op::intersect).regions, any);
    ASSERT_EQ(run(any, {}, Op::unite).regions, any);
    ASSERT_FALSE(HasFailure());
  }
}

TEST_F(BooleanLaws, DoNotDependOnThePlace) {
  const std::size_t count = cases::case_count(1000);
  for (std::size_t i = 0; i < count; ++i) {
    const Pair pair = random_pair(i);
    SCOPED_TRACE(pair.name);
    Random random(cases::seed(), 5000 + i);
    const auto pose = BlankFromPart::from_angle(random.uniform(0, 6.28), {random.uniform(-20, 20), 7},
                                                random.below(2) == 0);
    for (const Op op : {Op::unite, Op::intersect, Op::subtract, Op::exclude}) {
      const auto here = run(pair.a, pair.b, op).regions;
      const auto there = run(cases::map_regions(pair.a, pose), cases::map_regions(pair.b, pose), op).regions;
      const double bound = 2e-10 * (1 + cases::length_of(pair.a) + cases::length_of(pair.b));
      ASSERT_NEAR(cases::area_of(here), cases::area_of(there), bound);
    }
    ASSERT_FALSE(HasFailure());
  }
}

}  // namespace
}  // namespace lekalo::geom::geom_boolean_test

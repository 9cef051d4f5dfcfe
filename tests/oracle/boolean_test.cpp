// Booleans against CGAL's exact ones, on shapes whose arcs are exact on a grid, coincidences and all.

#include <gtest/gtest.h>

#include "cgal_regions.hpp"
#include "support/boolean_cases.hpp"
#include "support/cases.hpp"

namespace lekalo::geom {
namespace {

TEST(BooleanAgainstCgal, AreasOfAllOperations) {
  const std::size_t count = cases::case_count(60);
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 300 + i);
    SCOPED_TRACE(i);
    const auto a = cases::boolean_operand(random, cases::BooleanKind::grid),
               b = cases::boolean_operand(random, cases::BooleanKind::grid);
    if (a.empty() || b.empty()) continue;
    const oracle::PolygonSet exact_a = oracle::exact_set(a), exact_b = oracle::exact_set(b);
    using Op = BooleanOperation;
    for (const Op op : {Op::unite, Op::intersect, Op::subtract, Op::exclude}) {
      oracle::PolygonSet exact = exact_a;
      if (op == Op::unite) exact.join(exact_b);
      if (op == Op::intersect) exact.intersection(exact_b);
      if (op == Op::subtract) exact.difference(exact_b);
      if (op == Op::exclude) exact.symmetric_difference(exact_b);
      const auto ours = combine(a, b, op);
      ASSERT_TRUE(ours.has_value());
      ASSERT_NEAR(cases::area_of(ours->regions), oracle::area_of(exact), 1e-9) << static_cast<int>(op);
    }
  }
}

}  // namespace
}  // namespace lekalo::geom

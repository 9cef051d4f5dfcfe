// How two contours lie to each other is told in few steps, however long their arcs are.

#include <gtest/gtest.h>

#include <cmath>

#include "io/drawing/contour_relation.hpp"

namespace lekalo::io::io_contour_relation_test {
namespace {

using geom::Contour;
using geom::EdgeKind;
using geom::Point;

/// A lens of a line of this length and an arc over it.
Contour lens(double length, double height, double aside = 0) {
  const double r = (0.25 * length * length + height * height) / (2 * height);
  const Point from{0, aside}, to{length, aside};
  return {{EdgeKind::line, from, to, {}}, {EdgeKind::arc_ccw, to, from, {0.5 * length, aside + height - r}}};
}

struct Told {
  Relation relation;
  std::size_t steps;
};
Told told(const Contour& a, const Contour& b) {
  constexpr std::size_t kWork = 100'000;
  std::size_t work = kWork;
  const Relation relation = relation_of(PlacedContour(a), PlacedContour(b), 0.2, work);
  return {relation, kWork - work};
}

TEST(IoContourRelation, LongArcsBesideEachOtherTakeFewSteps) {
  // The two arcs differ by less than the repair, but their centres by far more.
  const Told same = told(lens(1e6, 1000), lens(1e6, 1000.1));
  EXPECT_EQ(same.relation, Relation::same);
  EXPECT_LT(same.steps, 200u);
  // An arc and the tangents at its ends, which leave it slowly.
  const Told flat = told(lens(1e6, 1000), {{EdgeKind::line, {0, 0}, {1e6, 0}, {}},
                                           {EdgeKind::line, {1e6, 0}, {5e5, 2000}, {}},
                                           {EdgeKind::line, {5e5, 2000}, {0, 0}, {}}});
  EXPECT_EQ(flat.relation, Relation::first_in);
  EXPECT_LT(flat.steps, 2000u);
}

TEST(IoContourRelation, ALineWithinReachOfAnArcAtItsEndsOnlyDoesNotRunAlongIt) {
  EXPECT_EQ(told(lens(1e4, 500), lens(1e4, 1)).relation, Relation::second_in);
  EXPECT_EQ(told(lens(1e4, 1), lens(1e4, 500)).relation, Relation::first_in);
  EXPECT_EQ(told(lens(1e4, 500), lens(1e4, 500, -10)).relation, Relation::crossing);
  EXPECT_EQ(told(lens(1e4, 500), lens(1e4, 500, -600)).relation, Relation::beside);
}

}  // namespace
}  // namespace lekalo::io::io_contour_relation_test

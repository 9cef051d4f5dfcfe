// Localisation with caps and locked shifts: reached, not beaten, and what is locked stays.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lekalo/locate/region.hpp"
#include "lekalo/phi/region.hpp"
#include "support/region_cases.hpp"

namespace lekalo::locate::locate_caps_test {
namespace {

using geom::BlankFromPart;
using geom::Point;

std::vector<geom::Edge> all_edges(const phi::RegionClearance& clearance) {
  std::vector<geom::Edge> edges;
  for (const geom::Curve& curve : clearance.part().curves()) edges.push_back(curve.edge);
  return edges;
}

/// Depth of the deepest of many points of an edge.
double sampled_depth(const phi::RegionClearance& clearance, const BlankFromPart& pose, std::uint32_t edge,
                     int count) {
  const geom::Edge& e = clearance.part().curves()[edge].edge;
  double deepest = 0;
  for (int i = 0; i <= count; ++i) {
    const double t = static_cast<double>(i) / count;
    Point p = (1 - t) * e.from + t * e.to;
    if (e.kind != geom::EdgeKind::line) {
      const double angle = (e.kind == geom::EdgeKind::arc_ccw ? t : -t) * geom::arc_sweep(e);
      p = e.centre + BlankFromPart::from_angle(angle, {}).rotate(e.from - e.centre);
    }
    const Point q = pose(p);
    if (clearance.blank().contains(q)) deepest = std::max(deepest, clearance.blank().nearest(q).distance);
  }
  return deepest;
}

double objective(const phi::RegionClearance& clearance, const std::vector<Cap>& caps,
                 const BlankFromPart& pose) {
  const auto value = clearance.at(pose);
  double least = value.inside ? value.distance : -1;
  std::vector<phi::RegionContact> places;
  for (const Cap& cap : caps) {
    std::vector<geom::Curve> curves;
    for (const geom::Edge& edge : cap.edges) curves.push_back(geom::make_curve(edge));
    least = std::min(least, cap.most - clearance.deepest(pose, curves, 1e-5, 0, places));
  }
  return least;
}

TEST(LocateCaps, TheDeepestPlaceIsWhereDenseSamplesSay) {
  const std::size_t count = std::min<std::size_t>(cases::region_case_count(3), 50);
  for (const cases::RegionKind kind : cases::kRegionKinds) {
    for (std::size_t i = 0; i < count; ++i) {
      const cases::RegionCase one = cases::region_case(cases::seed(), i, kind);
      SCOPED_TRACE(one.name);
      const phi::RegionClearance clearance(one.part, one.blank);
      Random random(cases::seed(), 300 + i);
      for (const double off : {0.0, 0.3, 20.0}) {
        const BlankFromPart pose = BlankFromPart::from_angle(
            one.theta + off * random.uniform(-0.01, 0.01),
            one.shift + Point{off * random.uniform(-1, 1), off * random.uniform(-1, 1)});
        for (std::uint32_t edge = 0; edge < clearance.part().curves().size(); edge += 3) {
          std::vector<phi::RegionContact> places;
          const double depth = clearance.deepest(pose, {clearance.part().curves()[edge]}, 1e-4, 1e-3, places);
          const double sampled = sampled_depth(clearance, pose, edge, 400);
          const geom::Curve& curve = clearance.part().curves()[edge];
          const double step =
              (curve.edge.kind == geom::EdgeKind::line ? curve.length
                                                       : curve.radius * geom::arc_sweep(curve.edge)) /
              400;
          ASSERT_GE(depth, sampled - 1e-9) << "edge " << edge;
          ASSERT_LE(depth, sampled + step + 1e-4) << "edge " << edge;
          for (const phi::RegionContact& place : places) {
            ASSERT_NEAR(norm(pose(place.part) - place.blank), place.distance, 1e-9);
            ASSERT_LE(place.distance, depth + 1e-9);
          }
        }
      }
    }
  }
}

TEST(LocateCaps, TheBalanceIsReachedAndNotBeaten) {
  const std::size_t count = std::min<std::size_t>(cases::region_case_count(2), 50);
  std::size_t closed = 0, open = 0;
  for (const cases::RegionKind kind : {cases::RegionKind::near_net, cases::RegionKind::rounded}) {
    for (std::size_t i = 0; i < count; ++i) {
      const cases::RegionCase one = cases::region_case(cases::seed(), i, kind);
      SCOPED_TRACE(one.name);
      const phi::RegionClearance clearance(one.part, one.blank);
      RegionProblem problem{one.part, one.blank, {one.theta - 0.1, one.theta + 0.1}};
      const double largest = -objective(clearance, {{all_edges(clearance), 0}}, one.pose());
      problem.caps = {{all_edges(clearance), 0.98 * largest}};
      RegionOptions options;
      options.gap = 5e-3;
      options.run.work_limit = 300'000;
      const RegionResult result = locate_regions(problem, options).value();
      // All that is said holds in every case; that it closes within the work limit does in nearly every one.
      ++(result.status == Status::optimal ? closed : open);
      EXPECT_NE(result.status, Status::infeasible);
      if (result.status == Status::optimal) {
        EXPECT_LE(result.upper_bound - result.best.clearance, 1.01 * options.gap);
      }
      const auto pose = [&](double theta, Point shift) { return BlankFromPart::from_angle(theta, shift); };
      const Point shift{result.best.x, result.best.y};
      EXPECT_LE(result.best.clearance,
                objective(clearance, problem.caps, pose(result.best.theta, shift)) + 1e-3);
      Random random(cases::seed(), 900 + i);
      double step = 0.3, best = -1, theta = result.best.theta;
      Point at = shift;
      for (int k = 0; k < 1500; ++k) {
        const double t = theta + random.uniform(-step, step) / 50;
        const Point s = at + Point{random.uniform(-step, step), random.uniform(-step, step)};
        const double value = objective(clearance, problem.caps, pose(t, s));
        EXPECT_LE(value, result.upper_bound);
        if (value > best) best = value, theta = t, at = s;
        step = std::max(1e-4, step * 0.995);
      }
      // What is known to be reachable decides in the other direction.
      options.enough = result.best.clearance - 0.01;
      const RegionResult some = locate_regions(problem, options).value();
      EXPECT_GE(some.best.clearance, options.enough);
      EXPECT_LE(some.work, result.work);
      options.enough = std::numeric_limits<double>::infinity();
      options.not_above = result.upper_bound + 0.01;
      const RegionResult none = locate_regions(problem, options).value();
      EXPECT_LE(none.upper_bound, options.not_above + 1e-9);
      EXPECT_LE(none.work, result.work);
    }
  }
  EXPECT_LE(open, 1 + closed * 3 / 100) << closed << " closed";
}

TEST(LocateCaps, WhatIsLockedStays) {
  const std::size_t count = std::min<std::size_t>(cases::region_case_count(2), 50);
  for (std::size_t i = 0; i < count; ++i) {
    const cases::RegionCase one = cases::region_case(cases::seed(), i, cases::RegionKind::near_net);
    SCOPED_TRACE(one.name);
    const phi::RegionClearance clearance(one.part, one.blank);
    const double known = clearance.at(one.pose()).distance;
    const RegionProblem free{one.part, one.blank, {}};
    const double best = locate_regions(free, {}).value().best.clearance;
    for (const bool both : {false, true}) {
      RegionProblem problem = free;
      problem.locked.x = one.shift.x;
      if (both) problem.locked.y = one.shift.y, problem.window = {one.theta, one.theta};
      const RegionResult result = locate_regions(problem, {}).value();
      EXPECT_EQ(result.status, Status::optimal);
      EXPECT_EQ(result.best.x, one.shift.x);
      if (both) {
        EXPECT_EQ(result.best.y, one.shift.y);
      }
      EXPECT_GE(result.best.clearance, known - 1e-3);
      EXPECT_LE(result.best.clearance, best + 1e-3);
      EXPECT_GE(result.upper_bound, known);
    }
  }
  RegionProblem wrong;
  const cases::RegionCase one = cases::region_case(1, 0, cases::RegionKind::near_net);
  wrong.part = one.part, wrong.blank = one.blank, wrong.locked.x = std::nan("");
  EXPECT_FALSE(locate_regions(wrong, {}).has_value());
}

}  // namespace
}  // namespace lekalo::locate::locate_caps_test

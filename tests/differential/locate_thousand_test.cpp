// Generated cases whose parts are known to fit: every result against the independent checker on the true
// shapes, the known pose, dense search and, where shapes are tiny, brute force over all poses.
// LEKALO_CASES=1000 is the long run: 400 offset shapes, 300 Boolean trees, 300 scans.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/locate/guaranteed_blank.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/phi/region.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/grown_cases.hpp"
#include "support/scan_cases.hpp"

namespace lekalo::locate_thousand_test {
namespace {

using geom::BlankFromPart;
using geom::Point;

std::size_t count_of(std::size_t quick, std::size_t share_of_ten) {
  return std::min(cases::case_count(quick), 100 * share_of_ten);
}

/// What the checker, which shares no code with the solver, makes of a pose.
verify::Enclosure checked(const std::vector<geom::Region>& part, const std::vector<geom::Region>& blank,
                          double theta, Point shift) {
  const std::string part_text = io::regions_json(part), blank_text = io::regions_json(blank);
  const auto found = verify::verify_clearance({"part.json", part_text}, {"blank.json", blank_text},
                                              {shift.x, shift.y, theta, false});
  EXPECT_TRUE(found.has_value()) << (found ? "" : found.error().message);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return found.value_or(verify::Enclosure{nan, nan});
}

double clearance_at(const phi::RegionClearance& clearance, double theta, Point shift) {
  const auto value = clearance.at(BlankFromPart::from_angle(theta, shift));
  return value.inside ? value.distance : -1;
}

/// The best of `steps` random poses about a pose, closer and closer to the best so far.
double searched(const phi::RegionClearance& clearance, double theta, Point shift, Random& random, int steps) {
  double best = clearance_at(clearance, theta, shift), step = 1;
  for (int i = 0; i < steps; ++i) {
    const double t = theta + random.uniform(-step, step) / 50;
    const Point s = shift + Point{random.uniform(-step, step), random.uniform(-step, step)};
    const double value = clearance_at(clearance, t, s);
    if (value > best) {
      best = value, theta = t, shift = s;
    } else {
      step = std::max(1e-5, step * 0.97);
    }
  }
  return best;
}

struct Tally {
  std::size_t cases = 0, closed = 0;
  double least_gain = std::numeric_limits<double>::infinity();  ///< over the known pose's clearance, mm
  double sum_gain = 0;
  void print(const char* what) const {
    std::printf(
        "%s: %zu cases, %zu closed their gap; clearance less that of the known pose: least %.4f, "
        "mean %.4f mm\n",
        what, cases, closed, least_gain, sum_gain / static_cast<double>(cases));
  }
};

/// Places the part in `given`, which lies in `truth` and may have lost up to `loss` of its boundary.
void place_and_check(const cases::RegionCase& one, const std::vector<geom::Region>& given,
                     const std::vector<geom::Region>& truth, double loss, Random& random, Tally& tally) {
  locate::RegionOptions options;
  options.run.work_limit = 300'000;
  const auto result = locate::locate_regions({one.part, given, {}, locate::Mirror::no, 0, 0}, options);
  ASSERT_TRUE(result.has_value()) << result.error().message;
  const Point shift{result->best.x, result->best.y};
  const double theta = result->best.theta, reported = result->best.clearance;
  ++tally.cases;
  if (result->status == locate::Status::optimal) {
    ++tally.closed;
    EXPECT_LE(result->upper_bound - reported, options.gap);
  }
  EXPECT_LE(reported, result->upper_bound);

  EXPECT_GE(checked(one.part, truth, theta, shift).low, reported);
  const double known = checked(one.part, truth, one.theta, one.shift).low;
  ASSERT_GT(known, 0);
  EXPECT_GE(reported, known - options.gap - loss);
  tally.least_gain = std::min(tally.least_gain, reported - known);
  tally.sum_gain += reported - known;

  const phi::RegionClearance clearance(one.part, given);
  EXPECT_GE(reported, clearance_at(clearance, one.theta, one.shift) - options.gap);
  EXPECT_LE(searched(clearance, one.theta, one.shift, random, 3000), result->upper_bound);
  EXPECT_LE(searched(clearance, theta, shift, random, 3000), result->upper_bound);
}

TEST(LocateThousand, OffsetShapes) {
  const std::size_t count = count_of(7, 4);
  Tally tally;
  for (std::size_t i = 0; i < count; ++i) {
    const auto kind = cases::kRegionKinds[i % cases::kRegionKinds.size()];
    const cases::RegionCase one = cases::region_case(cases::seed() + 2, i, kind);
    SCOPED_TRACE(one.name);
    Random random(cases::seed(), 10'000 + i);
    place_and_check(one, one.blank, one.blank, 0, random, tally);
    if (HasFatalFailure()) return;
  }
  tally.print("offset shapes");
}

TEST(LocateThousand, BooleanTrees) {
  const std::size_t count = count_of(6, 3);
  Tally tally;
  for (std::size_t i = 0; i < count; ++i) {
    const cases::GrownCase grown = cases::grown_case(cases::seed(), i, cases::kStockClasses[i % 3]);
    const cases::RegionCase& one = grown.shapes;
    SCOPED_TRACE(one.name);
    // The case is what it says: the known pose has the least allowance the blank was grown by, or more where
    // the neighbours' growth covers that edge.
    EXPECT_GE(checked(one.part, one.blank, one.theta, one.shift).low, grown.allowance - 1e-8);
    Random random(cases::seed(), 20'000 + i);
    place_and_check(one, one.blank, one.blank, 0, random, tally);
    if (HasFatalFailure()) return;
  }
  tally.print("Boolean trees");
}

TEST(LocateThousand, Scans) {
  constexpr double kNoise = 0.02, kRadius = 2;
  const std::size_t count = count_of(3, 3);
  Tally tally;
  double loss_sum = 0, loss_most = 0;
  for (std::size_t i = 0; i < count; ++i) {
    cases::RegionCase one = cases::grown_case(cases::seed() + 1, i, cases::kStockClasses[i % 3]).shapes;
    SCOPED_TRACE(one.name);
    Random random(cases::seed(), 30'000 + i);
    const std::vector<geom::Region> truth = cases::without_sharp_dents(one.blank, kRadius);
    cases::Sampling how;
    how.spacing = random.uniform(0.2, 0.5);
    how.noise = kNoise;
    locate::ScanOptions options;
    options.uncertainty = 0.01;
    options.min_radius = kRadius * (1 - 1e-6);  // closing by Booleans leaves dents sharper by rounding
    const auto given = locate::guaranteed_blank(cases::scan_of(cases::sample(truth, how, random)), options);
    ASSERT_TRUE(given.has_value()) << given.error().message;
    ASSERT_TRUE(given->proved());
    ASSERT_EQ(given->guard, kNoise);
    // A boundary point of the result lies within guard + deepest + simplify of an outline's edge, that
    // point within half the edge of a measured one, and this within the guard of the truth's boundary.
    const double loss = 2 * given->guard + given->deepest + options.simplify + given->widest / 2;
    place_and_check(one, given->regions, truth, loss, random, tally);
    if (HasFatalFailure()) return;
    const double left = checked(one.part, truth, one.theta, one.shift).low -
                        clearance_at({one.part, given->regions}, one.theta, one.shift);
    loss_sum += left, loss_most = std::max(loss_most, left);
  }
  tally.print("scans");
  std::printf("scans: the known pose loses %.4f mm of clearance on average, %.4f at most\n",
              loss_sum / static_cast<double>(count), loss_most);
}

// ------------------------------------------------------------------------------------------------------
// Tiny shapes: brute force over all poses, with a clearance of its own (vertices against sides).

struct Polygons {
  std::vector<geom::Ring> rings;
  [[nodiscard]] bool holds(Point p) const {
    bool inside = false;
    for (const geom::Ring& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Point a = ring[i], b = ring[(i + 1) % ring.size()];
        if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x))
          inside = !inside;
      }
    return inside;
  }
  [[nodiscard]] std::vector<geom::Region> regions() const {
    geom::Contour outer = cases::boolean_polygon(rings[0]);
    std::vector<geom::Contour> holes;
    for (std::size_t i = 1; i < rings.size(); ++i) holes.push_back(cases::boolean_polygon(rings[i]));
    return {geom::make_region(outer, holes).value()};
  }
};

double to_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double share = std::clamp(dot(p - a, along) / dot(along, along), 0.0, 1.0);
  return norm(p - a - share * along);
}

/// Least distance of the boundaries; 0 where the part is not inside.
double naive_clearance(const Polygons& part, const Polygons& blank) {
  double least = std::numeric_limits<double>::infinity();
  for (const geom::Ring& r : part.rings)
    for (std::size_t i = 0; i < r.size(); ++i) {
      if (!blank.holds(r[i])) return 0;
      const Point a = r[i], b = r[(i + 1) % r.size()];
      for (const geom::Ring& s : blank.rings)
        for (std::size_t j = 0; j < s.size(); ++j) {
          const Point c = s[j], d = s[(j + 1) % s.size()];
          const bool crossed = (cross(b - a, c - a) > 0) != (cross(b - a, d - a) > 0) &&
                               (cross(d - c, a - c) > 0) != (cross(d - c, b - c) > 0);
          if (crossed) return 0;
          least = std::min({least, to_segment(a, c, d), to_segment(c, a, b)});
        }
    }
  // No boundary is crossed: the blank's holes lie in the part's holes unless their corners lie in the part.
  for (std::size_t k = 1; k < blank.rings.size(); ++k)
    if (part.holds(blank.rings[k][0])) return 0;
  return least;
}

struct Bounded {
  double reached = 0, bound = 0;
};

/// Halves boxes of poses whose best could be above what is reached: a clearance changes by no more than the
/// part's points move. Nothing else is used, so it takes a million poses where locate_regions takes a
/// hundred.
Bounded brute_force(const Polygons& part, const Polygons& blank, double tolerance) {
  double radius = 0, reach = 0;
  for (const Point p : part.rings[0]) radius = std::max(radius, norm(p));
  for (const Point p : blank.rings[0]) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  struct Cell {
    double theta, half_theta;
    Point shift;
    double half;
    double bound;
  };
  std::vector<Cell> cells{
      {3.141592653589793, 3.1415926535898, {0, 0}, reach, std::numeric_limits<double>::infinity()}};
  Bounded found;
  for (;;) {
    std::vector<Cell> next;
    for (const Cell& cell : cells) {
      if (cell.bound <= found.reached + tolerance) continue;
      const bool turn = cell.half_theta * radius > cell.half;
      for (int k = 0; k < (turn ? 2 : 4); ++k) {
        Cell c = cell;
        if (turn) {
          c.half_theta /= 2, c.theta += (k == 0 ? -1 : 1) * c.half_theta;
        } else {
          c.half /= 2;
          c.shift = c.shift + c.half * Point{k % 2 == 0 ? -1.0 : 1.0, k < 2 ? -1.0 : 1.0};
        }
        const auto pose = BlankFromPart::from_angle(c.theta, c.shift);
        Polygons placed = part;
        for (geom::Ring& ring : placed.rings)
          for (Point& p : ring) p = pose(p);
        const double value = naive_clearance(placed, blank);
        found.reached = std::max(found.reached, value);
        c.bound = value + 1.4142135623731 * c.half + radius * c.half_theta;
        next.push_back(c);
      }
    }
    if (next.empty()) break;
    cells = std::move(next);
  }
  found.bound = found.reached + tolerance;
  return found;
}

TEST(LocateThousand, TinyCasesAgreeWithBruteForce) {
  constexpr double kTolerance = 0.002;
  const geom::Ring square{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
  const struct {
    const char* name;
    Polygons part, blank;
  } tiny[] = {
      {"square in a notched square",
       {{square}},
       {{{{-7, -6}, {6, -6}, {6, 7}, {1, 7}, {0, 5.6}, {-1, 7}, {-7, 7}}}}},
      {"angle in an angle",
       {{{{-5, -5}, {5, -5}, {5, 0}, {0, 0}, {0, 5}, {-5, 5}}}},
       {{{{-6, -6.5}, {6.5, -6.5}, {6.2, 0.8}, {1.1, 1}, {0.9, 6}, {-6, 6.4}}}}},
      {"frame about a peg",
       {{{{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}, {{-2, -2}, {-2, 3}, {2, 3}, {2, -2}}}},
       {{{{-6, -6}, {6.5, -6}, {6.5, 6}, {-6, 6.3}}, {{-1, -1}, {-1, 1.5}, {1, 2}, {1, -1}}}}},
      {"triangle in a bent blank",
       {{{{-4, -3}, {4, -3}, {0, 5}}}},
       {{{{-6, -4}, {0, -3.6}, {6, -4.5}, {1.2, 6.5}, {-1, 6.2}}}}},
  };
  Random random(cases::seed(), 40'000);
  for (std::size_t k = 0; k < 4 * std::size(tiny); ++k) {
    auto one = tiny[k % std::size(tiny)];
    SCOPED_TRACE(one.name);
    if (k >= std::size(tiny))  // no two alike
      for (Point& p : one.blank.rings[0]) p = p + Point{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3)};
    const Bounded brute = brute_force(one.part, one.blank, kTolerance);
    ASSERT_GT(brute.reached, 0);
    const auto result =
        locate::locate_regions({one.part.regions(), one.blank.regions(), {}, locate::Mirror::no, 0, 0}, {});
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->status, locate::Status::optimal);
    EXPECT_LE(result->best.clearance, brute.bound);
    EXPECT_GE(result->upper_bound, brute.reached);
  }
}

}  // namespace
}  // namespace lekalo::locate_thousand_test

#include "lekalo/field/arrival.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "lekalo/base/random.hpp"
#include "lekalo/field/level_lines.hpp"
#include "support/cases.hpp"

namespace lekalo::field::field_arrival_test {
namespace {

using geom::Point;
using Place = std::function<double(Point)>;

constexpr double kNever = std::numeric_limits<double>::infinity();

geom::RegionIndex disc(Point centre, double r) {
  const Point end = centre + Point{r, 0};
  return geom::RegionIndex({*geom::make_region({{geom::EdgeKind::arc_ccw, end, end, centre}})});
}

/// A square of side 2 * half about the origin, its nodes off the axes.
GridFrame frame_of(double half, double pitch) {
  const auto count = static_cast<std::size_t>(std::ceil(2 * half / pitch)) + 1;
  return {{-half - 0.31 * pitch, -half - 0.17 * pitch}, pitch, count, count};
}

std::vector<double> at_nodes(const GridFrame& frame, const Place& f) {
  std::vector<double> values;
  for (std::size_t j = 0; j < frame.rows; ++j)
    for (std::size_t i = 0; i < frame.columns; ++i) values.push_back(f(frame.node(i, j)));
  return values;
}

/// The largest difference of times from what they are to be, at nodes where `counts`.
double worst(const ArrivalTimes& arrival, const Place& exact, const std::function<bool(Point)>& counts) {
  double off = 0;
  for (std::size_t n = 0; n < arrival.time.size(); ++n) {
    const Point p = arrival.frame.node(n % arrival.frame.columns, n / arrival.frame.columns);
    if (counts(p)) off = std::max(off, std::abs(arrival.time[n] - exact(p)));
  }
  return off;
}

bool everywhere(Point) { return true; }

TEST(ArrivalTimes, OneSpeedFromADiscIsTheDistanceToSecondOrder) {
  constexpr double kSpeed = 2.5;
  double before = 0;
  for (const double pitch : {0.5, 0.25, 0.125}) {
    const GridFrame frame = frame_of(20, pitch);
    const std::vector<double> speed(frame.size(), kSpeed);
    for (const double r : {1.0, 4.0}) {
      const ArrivalTimes arrival = arrival_times(frame, speed, disc({1, 2}, r));
      EXPECT_TRUE(arrival.reaches_all);
      const double off = worst(
          arrival,
          [&](Point p) {
            return (norm(p - Point{1, 2}) - r) / kSpeed;
          },
          everywhere);
      EXPECT_LE(off * kSpeed, 0.5 * pitch * pitch / r);
      if (r == 4 && before > 0) {
        EXPECT_LT(off, before / 3.2);
      }  // 4 at second order
      if (r == 4) before = off;
    }
  }
}

/// Fermat: the fastest way from (0, -depth) in the slow or fast half below y = 0 to p above.
double refracted(double depth, Point p, double below, double above) {
  const auto time = [&](double x) {
    return std::sqrt(x * x + depth * depth) / below + norm(p - Point{x, 0}) / above;
  };
  double low = std::min(0.0, p.x), high = std::max(0.0, p.x);
  for (int i = 0; i < 50; ++i) {
    const double a = low + (high - low) / 3, b = high - (high - low) / 3;
    (time(a) < time(b) ? high : low) = time(a) < time(b) ? b : a;
  }
  return time(0.5 * (low + high));
}

TEST(ArrivalTimes, TwoSpeedsRefractByTheLawOfSnell) {
  constexpr double kDepth = 6, kRadius = 2;
  const Point source{0, -kDepth};
  for (const auto& [below, above] : {std::pair{1.0, 2.0}, std::pair{2.0, 1.0}}) {
    // At a way whose directions hold sin / speed equal the way found by Fermat takes as long.
    const double sine = 0.4, up = sine * above / below;
    const Point there{kDepth * sine / std::sqrt(1 - sine * sine) + 5 * up / std::sqrt(1 - up * up), 5};
    EXPECT_NEAR(refracted(kDepth, there, below, above),
                kDepth / std::sqrt(1 - sine * sine) / below + 5 / std::sqrt(1 - up * up) / above, 1e-9);
    const auto exact = [&, below = below, above = above](Point p) {
      if (p.y >= 0) return refracted(kDepth, p, below, above) - kRadius / below;
      double time = norm(p - source) / below;
      // The wave that runs ahead along the border in the fast half: its way comes back at the critical angle.
      const double critical = below / above;
      if (critical < 1 && std::abs(p.x) * std::sqrt(1 - critical * critical) >= (kDepth - p.y) * critical)
        time = std::min(time,
                        std::abs(p.x) / above + (kDepth - p.y) * std::sqrt(1 - critical * critical) / below);
      return time - kRadius / below;
    };
    double before = 0;
    for (const double pitch : {0.4, 0.2, 0.1}) {
      const GridFrame frame = frame_of(16, pitch);
      const std::vector<double> speed =
          at_nodes(frame, [&, below = below, above = above](Point p) { return p.y < 0 ? below : above; });
      const double off = worst(arrival_times(frame, speed, disc(source, kRadius)), exact, everywhere);
      EXPECT_LE(off, pitch / std::min(below, above));
      if (before > 0) {
        EXPECT_LT(off, before / 1.6);
      }
      before = off;
    }
  }
}

/// The times from a disc about a wall against the length of the shortest way, at falling pitches: off by at
/// most `pitches` of them, and of first order.
void expect_first_order(const std::function<bool(Point)>& free, Point source, const Place& way,
                        double pitches) {
  constexpr double kRadius = 1.5;
  double first = 0;
  for (const double pitch : {0.4, 0.2, 0.1, 0.05}) {
    const GridFrame frame = frame_of(14, pitch);
    const std::vector<double> speed = at_nodes(frame, [&](Point p) { return free(p) ? 1.0 : 0.0; });
    const ArrivalTimes arrival = arrival_times(frame, speed, disc(source, kRadius));
    EXPECT_TRUE(arrival.reaches_all);
    const double off = worst(
        arrival, [&](Point p) { return way(p) - kRadius; }, free);
    EXPECT_LE(off, pitches * pitch);
    if (first > 0) {
      EXPECT_LT(off, first * pitch / 0.4 * 1.8);
    }
    if (first == 0) first = off;
    for (std::size_t n = 0; n < speed.size(); ++n) EXPECT_EQ(arrival.time[n] == kNever, !(speed[n] > 0));
  }
}

TEST(ArrivalTimes, GoAroundARoundObstacleByTheShortestWay) {
  constexpr double kObstacle = 5;
  const Point source{-9, 1};
  expect_first_order([](Point p) { return norm(p) > kObstacle; }, source,
                     [&](Point p) {
                       const double a = norm(source), b = norm(p);
                       const double turn = std::acos(std::clamp(dot(source, p) / (a * b), -1.0, 1.0));
                       const double around =
                           turn - std::acos(kObstacle / a) - std::acos(std::min(1.0, kObstacle / b));
                       if (around <= 0) return norm(p - source);
                       return std::sqrt(a * a - kObstacle * kObstacle) +
                              std::sqrt(b * b - kObstacle * kObstacle) + kObstacle * around;
                     },
                     5.5);
}

TEST(ArrivalTimes, GoAroundACornerByTheShortestWay) {
  const Point source{-7, 5};
  expect_first_order([](Point p) { return p.x > 0 || p.y > 0; }, source,
                     [&](Point p) {
                       // The corner is left of the way to where it cannot be seen from.
                       const bool hidden = p.x > 0 && cross(-1.0 * source, p - source) < 0;
                       return hidden ? norm(source) + norm(p) : norm(p - source);
                     },
                     1.5);
}

/// Speeds without any order, and walls of single nodes.
std::vector<double> rough_speeds(Random& random, const GridFrame& frame) {
  std::vector<double> speed;
  for (std::size_t n = 0; n < frame.size(); ++n)
    speed.push_back(random.uniform() < 0.2 ? 0 : std::exp(random.uniform(-2, 2)));
  return speed;
}

TEST(ArrivalTimes, EachComesFromAnEarlierNeighbour) {
  for (std::size_t k = 0; k < cases::case_count(20); ++k) {
    Random random(cases::seed(), k + 1);
    const GridFrame frame = frame_of(5, 0.2);
    const std::vector<double> speed = rough_speeds(random, frame);
    const Point centre{random.uniform(-5, 5), random.uniform(-5, 5)};  // at the grid's rim too
    const ArrivalTimes arrival = arrival_times(frame, speed, disc(centre, 0.7));
    double last = 0;
    bool all = true;
    for (std::size_t j = 0; j < frame.rows; ++j)
      for (std::size_t i = 0; i < frame.columns; ++i) {
        const std::size_t n = j * frame.columns + i;
        const double time = arrival.time[n];
        if (!(speed[n] > 0)) {
          EXPECT_EQ(time, kNever);
        }
        if (time == kNever) {
          all = all && !(speed[n] > 0);
          continue;
        }
        last = std::max(last, time);
        if (norm(frame.node(i, j) - centre) <= 0.7 + 2.2 * frame.pitch) continue;  // of the start
        double least = kNever;
        if (i > 0) least = std::min(least, arrival.time[n - 1]);
        if (i + 1 < frame.columns) least = std::min(least, arrival.time[n + 1]);
        if (j > 0) least = std::min(least, arrival.time[n - frame.columns]);
        if (j + 1 < frame.rows) least = std::min(least, arrival.time[n + frame.columns]);
        EXPECT_LT(least, time);
      }
    EXPECT_EQ(arrival.reaches_all, all);
    EXPECT_EQ(arrival.last, last);
    EXPECT_EQ(arrival_times(frame, speed, disc(centre, 0.7)).time, arrival.time);
  }
}

TEST(ArrivalTimes, MirroredInputGivesMirroredBytes) {
  for (std::size_t k = 0; k < cases::case_count(10); ++k) {
    Random random(cases::seed(), 1000 + k);
    const GridFrame frame{{-4, -4}, 0.25, 33, 33};
    const std::vector<double> speed = rough_speeds(random, frame);
    std::vector<double> mirrored = speed;
    for (std::size_t j = 0; j < frame.rows; ++j)
      std::reverse(mirrored.begin() + static_cast<std::ptrdiff_t>(j * frame.columns),
                   mirrored.begin() + static_cast<std::ptrdiff_t>((j + 1) * frame.columns));
    const ArrivalTimes a = arrival_times(frame, speed, disc({1, 0.5}, 0.7)),
                       b = arrival_times(frame, mirrored, disc({-1, 0.5}, 0.7));
    for (std::size_t n = 0; n < speed.size(); ++n) {
      const std::size_t m = n / frame.columns * frame.columns + frame.columns - 1 - n % frame.columns;
      EXPECT_EQ(a.time[n] == kNever, b.time[m] == kNever);
      if (a.time[n] != kNever) {
        EXPECT_NEAR(a.time[n], b.time[m], 1e-12);
      }
    }
  }
}

TEST(ArrivalTimes, NothingArrivesBehindAWall) {
  const GridFrame frame{{0, 0}, 0.5, 41, 21};
  const std::vector<double> speed =
      at_nodes(frame, [](Point p) { return std::abs(p.x - 10) < 0.6 ? 0.0 : 3.0; });
  const ArrivalTimes arrival = arrival_times(frame, speed, disc({4, 5}, 2));
  EXPECT_FALSE(arrival.reaches_all);
  for (std::size_t n = 0; n < speed.size(); ++n)
    EXPECT_EQ(arrival.time[n] < kNever, frame.node(n % 41, 0).x < 9.4) << n;
}

TEST(ArrivalTimes, AreCarriedOnStraightBeyondWallsButNotToWhereTheyDoNotCome) {
  const GridFrame frame{{0, 0}, 1, 12, 9};
  const auto free = [](Point p) { return p.x >= 2 && p.x <= 6; };
  ArrivalTimes arrival{frame,
                       at_nodes(frame, [&](Point p) { return free(p) ? 3 * p.x + 0.5 * p.y : kNever; })};
  // The last column has a speed, but nothing came there.
  const std::vector<double> speed =
      at_nodes(frame, [&](Point p) { return free(p) || p.x == 11 ? 1.0 : 0.0; });
  extend_beyond_walls(arrival, speed, 4);
  for (std::size_t n = 0; n < speed.size(); ++n) {
    const Point p = frame.node(n % 12, n / 12);
    if (p.x > 10 || (!free(p) && (p.y < 2 || p.y > 6)))
      EXPECT_EQ(arrival.time[n], kNever);
    else
      EXPECT_NEAR(arrival.time[n], 3 * p.x + 0.5 * p.y, 1e-12);
  }
}

double twice_area(const std::vector<LevelLines::Place>& line) {
  double sum = 0;
  for (std::size_t i = 0; i < line.size(); ++i) sum += cross(line[i].at, line[(i + 1) % line.size()].at);
  return sum;
}

TEST(LevelLines, FollowACircleWithWhatIsBelowOnTheirLeft) {
  constexpr double kPitch = 0.25;
  const GridFrame frame = frame_of(10, kPitch);
  for (const double sign : {1.0, -1.0}) {
    const std::vector<double> values = at_nodes(frame, [&](Point p) {
      return sign * norm(p - Point{1, 0.5});
    });
    const LevelLines lines(frame, values);
    for (const double r : {2.0, 4.7, 7.3}) {
      const auto found = lines.at(sign * r);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_NEAR(twice_area(found[0]), sign * 2 * 3.141592653589793 * r * r, 0.2 * r);
      for (const LevelLines::Place& place : found[0]) {
        EXPECT_TRUE(place.known);
        EXPECT_NEAR(norm(place.at - Point{1, 0.5}), r, kPitch * kPitch / (8 * (r - kPitch)));
      }
    }
    EXPECT_TRUE(lines.at(sign * 40).empty());
  }
}

TEST(LevelLines, EndHalfwayToWhereNothingIsKnownAndLeaveOutWhatLeavesTheGrid) {
  const GridFrame frame{{0, 0}, 1, 20, 20};
  const auto inside = [](Point p) { return p.x > 4.5 && p.x < 14.5 && p.y > 4.5 && p.y < 14.5; };
  const std::vector<double> square = at_nodes(frame, [&](Point p) { return inside(p) ? p.x : kNever; });
  const auto lines = LevelLines(frame, square).at(9.25);
  ASSERT_EQ(lines.size(), 1U);
  for (const LevelLines::Place& place : lines[0])
    EXPECT_TRUE(place.known ? place.at.x == 9.25
                            : place.at.x == 4.5 || place.at.y == 4.5 || place.at.y == 14.5);
  const std::vector<double> slope = at_nodes(frame, [](Point p) { return p.x; });
  EXPECT_TRUE(LevelLines(frame, slope).at(9.25).empty());
}

TEST(LevelLines, TheMeanTellsWhichCornersOfACellAreJoined) {
  const GridFrame frame{{0, 0}, 1, 4, 4};
  // Two low corners crosswise in the middle cell.
  for (const double high : {1.5, 4.0}) {
    std::vector<double> values(16, 9.0);
    values[5] = values[10] = 0;
    values[6] = values[9] = high;
    EXPECT_EQ(LevelLines(frame, values).at(1).size(), high < 2 ? 1U : 2U);
  }
}

TEST(SignedDistances, AreThoseOfLinesAndArcsThemselves) {
  const GridFrame frame = frame_of(6, 0.3);
  const std::vector<double> distance = signed_distances(disc({0.5, -1}, 3), frame);
  for (std::size_t n = 0; n < distance.size(); ++n)
    EXPECT_NEAR(distance[n], 3 - norm(frame.node(n % frame.columns, n / frame.columns) - Point{0.5, -1}),
                1e-9);
}

}  // namespace
}  // namespace lekalo::field::field_arrival_test

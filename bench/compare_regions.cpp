// Regions of any shape: the certified method beside ICP, how many hard cases close within a time, and time
// against edges, window and gap; all as markdown, CPU time of one thread.
//
//   bench_compare_regions [cases of each stock class, 300] [hard cases of each kind, 40]

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/phi/region.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/grown_cases.hpp"

namespace {

using namespace lekalo;
using geom::BlankFromPart;
using geom::Point;

constexpr double kDegree = 0.017453292519943295;

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double percent(std::size_t some, std::size_t all) {
  return 100.0 * static_cast<double>(some) / static_cast<double>(all);
}

// ------------------------------------------------------------------------------------------------------
// ICP: points along the part's outline against the nearest edge of the blank's, point-to-line least squares

std::vector<Point> outline_points(const std::vector<geom::Region>& regions) {
  constexpr double kSpacing = 0.25;  // mm
  std::vector<Point> points;
  const geom::RegionIndex index(regions);
  for (const geom::Curve& curve : index.curves()) {
    const geom::Edge& e = curve.edge;
    const bool line = e.kind == geom::EdgeKind::line;
    const double sweep = line ? 0 : geom::arc_sweep(e) * (e.kind == geom::EdgeKind::arc_ccw ? 1 : -1);
    const double length = line ? curve.length : curve.radius * std::abs(sweep);
    const double pieces = std::max(1.0, std::ceil(length / kSpacing));
    for (double j = 0; j < pieces; ++j) {
      if (line) {
        points.push_back(e.from + (j / pieces) * (e.to - e.from));
      } else {
        const auto turn = BlankFromPart::from_angle(j / pieces * sweep, e.centre);
        points.push_back(turn(e.from - e.centre));
      }
    }
  }
  return points;
}

struct Pose {
  double theta = 0;
  Point shift;
};

/// Solves the 3 x 3 normal equations (positive semidefinite); a motion that the points do not see stays zero.
std::array<double, 3> solved(std::array<std::array<double, 3>, 3> a, std::array<double, 3> b) {
  std::array<bool, 3> done{};
  const double largest = std::max({a[0][0], a[1][1], a[2][2]});
  for (int step = 0; step < 3; ++step) {
    std::size_t pivot = 3;
    for (std::size_t i = 0; i < 3; ++i)
      if (!done[i] && (pivot == 3 || a[i][i] > a[pivot][pivot])) pivot = i;
    if (!(a[pivot][pivot] > 1e-12 * largest)) break;
    done[pivot] = true;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == pivot) continue;
      const double factor = a[i][pivot] / a[pivot][pivot];
      for (std::size_t j = 0; j < 3; ++j) a[i][j] -= factor * a[pivot][j];
      b[i] -= factor * b[pivot];
    }
  }
  std::array<double, 3> motion{};
  for (std::size_t i = 0; i < 3; ++i) motion[i] = done[i] ? b[i] / a[i][i] : 0;
  return motion;
}

Pose registered(const std::vector<Point>& part, Point centre, const geom::RegionIndex& blank, Pose at) {
  constexpr int kMostIterations = 300;
  constexpr double kSize = 50;  // mm: a turn counts as what it moves at this distance
  Point middle = BlankFromPart::from_angle(at.theta, at.shift)(centre);
  std::vector<std::uint32_t> likely(part.size(), 0);
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const auto turn = BlankFromPart::from_angle(at.theta, {});
    std::array<std::array<double, 3>, 3> matrix{};
    std::array<double, 3> right{};
    for (std::size_t k = 0; k < part.size(); ++k) {
      const Point arm = turn(part[k] - centre), p = middle + arm;
      const auto nearest = blank.nearest(p, likely[k]);
      likely[k] = nearest.edge;
      const geom::Curve& curve = blank.curves()[nearest.edge];
      Point normal;
      if (curve.edge.kind == geom::EdgeKind::line) {
        normal = perpendicular(curve.unit);
      } else {
        const Point out = nearest.point - curve.edge.centre;
        normal = (1 / norm(out)) * out;
      }
      const std::array<double, 3> row{normal.x, normal.y, dot(normal, perpendicular(arm)) / kSize};
      const double residual = dot(normal, nearest.point - p);
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) matrix[i][j] += row[i] * row[j];
        right[i] += row[i] * residual;
      }
    }
    const auto motion = solved(matrix, right);
    middle = middle + Point{motion[0], motion[1]};
    at.theta += motion[2] / kSize;
    if (std::abs(motion[0]) + std::abs(motion[1]) + std::abs(motion[2]) < 1e-7) break;
  }
  at.shift = middle - BlankFromPart::from_angle(at.theta, {})(centre);
  return at;
}

struct Score {
  std::size_t cut = 0;
  double share = 0;
  void add(double clearance, double reachable) {
    cut += clearance < 0;
    share += std::max(0.0, clearance) / reachable;
  }
};

void against_icp(std::size_t count) {
  std::printf(
      "| stock | cases | ICP from 5 deg, 10 mm off: cuts in | share of the reachable | ICP from the known "
      "pose: "
      "cuts in | share | certified: cuts in | share | closed |\n|---|---|---|---|---|---|---|---|---|\n");
  for (const cases::StockClass& stock : cases::kStockClasses) {
    Score off, known, ours;
    std::size_t closed = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const cases::RegionCase one = cases::grown_case(cases::seed(), i, stock).shapes;
      locate::RegionOptions options;
      options.run.work_limit = 60'000;
      const auto best =
          locate::locate_regions({one.part, one.blank, {}, locate::Mirror::no, 0, 0}, options).value();
      closed += best.status == locate::Status::optimal;
      const double reachable = best.best.clearance;
      const std::string part = io::regions_json(one.part), blank = io::regions_json(one.blank);
      const auto checked = verify::verify_clearance({"part.json", part}, {"blank.json", blank},
                                                    {best.best.x, best.best.y, best.best.theta, false});
      ours.add(std::min(checked.value().low, reachable), reachable);

      const phi::RegionClearance clearance(one.part, one.blank);
      const auto points = outline_points(one.part);
      Point centre{};
      for (const Point p : points) centre = centre + (1.0 / static_cast<double>(points.size())) * p;
      const auto run = [&](Pose start, Score& score) {
        const Pose end = registered(points, centre, clearance.blank(), start);
        const auto value = clearance.at(BlankFromPart::from_angle(end.theta, end.shift));
        score.add(value.inside ? value.distance : -1, reachable);
      };
      run({one.theta, one.shift}, known);
      // Off by exactly 5 degrees either way, about the part's middle, and by exactly 10 mm any way.
      Random random(cases::seed(), 900'000 + i);
      const double theta = one.theta + (random.below(2) == 0 ? 5 : -5) * kDegree;
      const auto way = geom::sincos(random.uniform(0, 6.283185307179586));
      const Point at = one.pose()(centre) + 10.0 * Point{way.cosine, way.sine};
      run({theta, at - BlankFromPart::from_angle(theta, {})(centre)}, off);
    }
    const double n = static_cast<double>(count);
    std::printf("| %s | %zu | %.1f %% | %.2f | %.1f %% | %.2f | %.1f %% | %.2f | %.1f %% |\n", stock.name,
                count, percent(off.cut, count), off.share / n, percent(known.cut, count), known.share / n,
                percent(ours.cut, count), ours.share / n, percent(closed, count));
    std::fflush(stdout);
  }
}

// ------------------------------------------------------------------------------------------------------
// Hard cases

/// A tree in a rectangular plate 1.2 to 2 times its box: free play along the longer side.
cases::RegionCase in_a_plate(std::uint64_t index) {
  Random random(cases::seed(), 700'000 + index);
  cases::RegionCase one;
  one.part = cases::grown_detail::tree(random);
  const geom::Box box = geom::bounds(one.part[0].outer);
  const double wide = random.uniform(1.2, 2) * (box.high.x - box.low.x),
               high = random.uniform(1.2, 2) * (box.high.y - box.low.y);
  one.blank = {cases::region_detail::region(cases::boolean_rectangle(-wide / 2, -high / 2, wide, high))};
  return one;
}

/// A regular polygon of 3 to 12 sides with a round hole in a larger one with a smaller hole.
cases::RegionCase regular(std::uint64_t index) {
  Random random(cases::seed(), 800'000 + index);
  cases::RegionCase one;
  const std::size_t sides = 3 + index % 10;
  const auto ring = [&](double radius) {
    geom::Ring points;
    for (std::size_t i = 0; i < sides; ++i) {
      const auto at = geom::sincos(6.283185307179586 * static_cast<double>(i) / static_cast<double>(sides));
      points.push_back(radius * Point{at.cosine, at.sine});
    }
    return cases::region_detail::polygon(points);
  };
  using cases::region_detail::circle;
  const auto pose = BlankFromPart::from_angle(random.uniform(0, 6.28), {5, -3});
  const auto moved = [&](const geom::Contour& c) { return cases::region_detail::moved(c, pose); };
  one.part = {cases::region_detail::region(ring(40), {circle({0, 0}, 10)})};
  one.blank = {cases::region_detail::region(moved(ring(40 + random.uniform(3, 8))),
                                            {moved(circle({0, 0}, 10 - random.uniform(1, 4)))})};
  return one;
}

struct Timed {
  double seconds = 0;
  bool closed = false;
};

/// Stopped when `limit` seconds of this thread's time are over.
Timed timed(const cases::RegionCase& one, locate::AngleWindow window, double gap, double limit) {
  const double begin = cpu_seconds();
  std::atomic<bool> stop{false};
  locate::RegionOptions options;
  options.gap = gap;
  options.run.stop = &stop;
  options.run.progress = [&](const Progress&) {
    if (cpu_seconds() - begin > limit) stop = true;
  };
  const auto result =
      locate::locate_regions({one.part, one.blank, window, locate::Mirror::no, 0, 0}, options).value();
  return {cpu_seconds() - begin, result.status == locate::Status::optimal};
}

void hard_cases(std::size_t count) {
  using cases::RegionKind;
  const auto of_kind = [](RegionKind kind) {
    return [kind](std::uint64_t i) { return cases::region_case(cases::seed(), i, kind, 98); };
  };
  const struct {
    const char* name;
    std::function<cases::RegionCase(std::uint64_t)> make;
  } kinds[] = {{"near net, cored, 100 edges", of_kind(RegionKind::near_net)},
               {"roomy: 40 mm of stock all round, cored, 100 edges", of_kind(RegionKind::roomy)},
               {"roomy: Boolean tree in a plate 1.2 to 2 times its box", in_a_plate},
               {"toothed wheel, 3 to 6 teeth", of_kind(RegionKind::toothed)},
               {"regular polygon, 3 to 12 sides, round hole", regular},
               {"ring in a ring", of_kind(RegionKind::turning)}};
  std::printf(
      "| %zu cases each, gap 1e-3 mm, full circle | 0.05 s | 0.5 s | 5 s | median |\n|---|---|---|---|---|\n",
      count);
  for (const auto& kind : kinds) {
    std::array<std::size_t, 3> closed{};
    std::vector<double> seconds;
    for (std::size_t i = 0; i < count; ++i) {
      const Timed t = timed(kind.make(i), {}, 1e-3, 5);
      seconds.push_back(t.seconds);
      for (std::size_t k = 0; k < 3; ++k) closed[k] += t.closed && t.seconds <= std::array{0.05, 0.5, 5.0}[k];
    }
    std::sort(seconds.begin(), seconds.end());
    std::printf("| %s | %.0f %% | %.0f %% | %.0f %% | %.0f ms |\n", kind.name, percent(closed[0], count),
                percent(closed[1], count), percent(closed[2], count), 1e3 * seconds[seconds.size() / 2]);
    std::fflush(stdout);
  }
}

// ------------------------------------------------------------------------------------------------------

void growth() {
  constexpr std::size_t kCases = 21;
  std::printf("| near net, edges | window | 1e-2 mm | 1e-3 mm | 1e-4 mm |\n|---|---|---|---|---|\n");
  for (const std::size_t edges : {32, 100, 300, 1000}) {
    for (const double window : {20.0, 360.0}) {
      std::printf("| %zu | %.0f deg |", edges, window);
      for (const double gap : {1e-2, 1e-3, 1e-4}) {
        std::vector<double> seconds;
        std::size_t closed = 0;
        for (std::size_t i = 0; i < kCases; ++i) {
          const auto one = cases::region_case(cases::seed() + 6, i, cases::RegionKind::near_net, edges - 2);
          const double half = 0.5 * window * kDegree;
          const Timed t = timed(
              one,
              window < 360 ? locate::AngleWindow{one.theta - half, one.theta + half} : locate::AngleWindow{},
              gap, 60);
          seconds.push_back(t.seconds);
          closed += t.closed;
        }
        std::sort(seconds.begin(), seconds.end());
        std::printf(" %.1f, at most %.1f ms%s |", 1e3 * seconds[kCases / 2], 1e3 * seconds.back(),
                    closed == kCases ? "" : " (not all closed)");
      }
      std::printf("\n");
      std::fflush(stdout);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  growth();
  std::printf("\n");
  hard_cases(argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 40);
  std::printf("\n");
  against_icp(argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 300);
}

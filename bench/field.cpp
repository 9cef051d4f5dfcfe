// 1,000 segments on a grid: the linear and the quadratic conjunction of FLOZ and the exact distance, value
// and gradient, by tiles and by brute force over all segments, in one run, in CPU seconds of all threads.
//
//   bench_field [NODES]      nodes along a side of the whole grid [4096]; brute force takes a 16th of them

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <limits>

#include "lekalo/field/grid.hpp"
#include "lekalo/geom/trig.hpp"

namespace {

using namespace lekalo;
using namespace lekalo::field;

struct Seconds {
  double cpu = std::numeric_limits<double>::infinity();
  double wall = std::numeric_limits<double>::infinity();
};

Seconds seconds(const std::function<void()>& act) {
  const std::clock_t cpu = std::clock();
  const auto wall = std::chrono::steady_clock::now();
  act();
  return {static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC,
          std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count()};
}

geom::Region star(int segments) {
  std::vector<geom::Point> points;
  for (int i = 0; i < segments; ++i) {
    const double angle = 6.283185307179586 * i / segments;
    const double r = 50 + 20 * geom::sincos(7 * angle).cosine + 4 * geom::sincos(31 * angle).cosine;
    points.push_back({r * geom::sincos(angle).cosine, r * geom::sincos(angle).sine});
  }
  geom::Contour contour;
  for (std::size_t i = 0; i < points.size(); ++i)
    contour.push_back({geom::EdgeKind::line, points[i], points[(i + 1) % points.size()], {}});
  return geom::make_region(std::move(contour)).value();
}

/// All segments at every node, the least value and its gradient, in double precision.
double brute(const ContourModel& model, const GridFrame& frame) {
  double sum = 0;
  for (std::size_t j = 0; j < frame.rows; ++j)
    for (std::size_t i = 0; i < frame.columns; ++i) sum += model.unsigned_at(frame.node(i, j)).value;
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t nodes = argc > 1 ? static_cast<std::size_t>(std::atol(argv[1])) : 4096;
  const auto model_of = [](Logic logic) {
    return ContourModel::make({star(1000)}, {100, logic, FlozForm::normalised}).value();
  };
  const ContourModel model = model_of(Logic::linear), quadratic = model_of(Logic::quadratic);
  const auto frame_of = [](std::size_t n) {
    return GridFrame{{-80, -80}, 160.0 / static_cast<double>(n - 1), n, n};
  };
  const GridFrame frame = frame_of(nodes), small = frame_of(std::max<std::size_t>(2, nodes / 16));
  fmt::print("{} segments, {} x {} nodes, value and gradient\n", model.segments().size(), nodes, nodes);
  double sum = 0;
  const auto brute_seconds = [&](const ContourModel& m) {
    return seconds([&] { sum += brute(m, small); }).cpu * static_cast<double>(frame.size()) /
           static_cast<double>(small.size());
  };
  const double slow = brute_seconds(model), slow_quadratic = brute_seconds(quadratic);
  fmt::print("brute force, FLOZ, double: linear {:.0f} s, quadratic {:.0f} s\n", slow, slow_quadratic);
  for (const unsigned threads : {1U, 2U}) {
    const auto show = [&](const char* what, int runs, double brute_cpu, const auto& act) {
      Seconds least;
      for (int run = 0; run < runs; ++run) {
        const Seconds took = seconds([&] { sum += static_cast<double>(act().value[0]); });
        least = {std::min(least.cpu, took.cpu), std::min(least.wall, took.wall)};
      }
      fmt::print("{} threads, {}: {:.3f} s, CPU {:.3f} s, {:.0f} times brute force\n", threads, what,
                 least.wall, least.cpu, brute_cpu / least.cpu);
    };
    show("linear conjunction", 5, slow, [&] { return sample(model, frame, threads); });
    show("exact distance", 5, slow, [&] { return sample_distance(model, frame, threads); });
    show("quadratic conjunction", 1, slow_quadratic, [&] { return sample(quadratic, frame, threads); });
  }
  return std::isfinite(sum) ? 0 : 1;
}

// 1,000 segments on a grid: the linear conjunction of FLOZ and the exact distance, value and gradient, by
// tiles and by brute force over all segments, in one run.
//
//   bench_field [NODES]      nodes along a side of the whole grid [4096]; brute force takes a 16th of them

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "lekalo/field/grid.hpp"
#include "lekalo/geom/trig.hpp"

namespace {

using namespace lekalo;
using namespace lekalo::field;

double seconds(const std::function<void()>& act) {
  const auto begin = std::chrono::steady_clock::now();
  act();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
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
  const ContourModel model =
      ContourModel::make({star(1000)}, {100, Logic::linear, FlozForm::normalised}).value();
  const auto frame_of = [](std::size_t n) {
    return GridFrame{{-80, -80}, 160.0 / static_cast<double>(n - 1), n, n};
  };
  const GridFrame frame = frame_of(nodes), small = frame_of(std::max<std::size_t>(2, nodes / 16));
  const double million = static_cast<double>(frame.size()) / 1e6;
  fmt::print("{} segments, {} x {} nodes, value and gradient\n", model.segments().size(), nodes, nodes);
  double sum = 0;
  const double slow = seconds([&] { sum = brute(model, small); }) / (static_cast<double>(small.size()) / 1e6);
  fmt::print("brute force, FLOZ, double: {:.2f} s a million nodes\n", slow);
  for (const unsigned threads : {1U, 2U}) {
    double best_floz = std::numeric_limits<double>::infinity(), best_distance = best_floz;
    for (int run = 0; run < 3; ++run) {
      best_floz = std::min(
          best_floz, seconds([&] { sum += static_cast<double>(sample(model, frame, threads).value[0]); }));
      best_distance = std::min(best_distance, seconds([&] {
                                 sum += static_cast<double>(sample_distance(model, frame, threads).value[0]);
                               }));
    }
    fmt::print(
        "{} threads: linear conjunction {:.3f} s ({:.0f} times brute force), exact distance {:.3f} s\n",
        threads, best_floz, slow * million / best_floz, best_distance);
  }
  return std::isfinite(sum) ? 0 : 1;
}

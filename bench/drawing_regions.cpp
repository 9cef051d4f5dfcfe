// Loose, shuffled lines and arcs to regions: rounded rectangles in rows, one entity an edge.
//
//   bench_drawing_regions
#include <benchmark/benchmark.h>

#include "lekalo/io/drawing/drawing_regions.hpp"
#include "support/boolean_cases.hpp"
#include "support/drawn.hpp"

namespace {

using namespace lekalo;

cases::Sketch loose_parts(std::int64_t side, double gap) {
  Random random(1);
  std::vector<geom::Edge> edges;
  for (std::int64_t i = 0; i < side; ++i) {
    for (std::int64_t j = 0; j < side; ++j) {
      const double x = 12.3 * static_cast<double>(i) + random.uniform(), y = 12.7 * static_cast<double>(j);
      for (geom::Edge edge : cases::boolean_rounded(x, y, 9, 8, 1.5)) {
        const geom::Point by{random.uniform(-gap, gap), random.uniform(-gap, gap)};
        edge.from = edge.from + by;
        edge.to = edge.to + by;
        edge.centre = edge.centre + by;
        edges.push_back(random.below(2) == 0 ? geom::reversed(edge) : edge);
      }
    }
  }
  cases::shuffle(edges, random);
  cases::Sketch sketch;
  sketch.edges(edges);
  return sketch;
}

void regions_of_loose_curves(benchmark::State& state, double gap) {
  const cases::Sketch sketch = loose_parts(state.range(0), gap);
  std::size_t regions = 0;
  for (auto _ : state) {
    const auto found = io::make_regions(sketch.drawing());
    if (!found) return state.SkipWithError(found.error().message.c_str());
    regions = found->regions.size();
  }
  state.counters["curves"] = static_cast<double>(sketch.drawing().curves.size());
  state.counters["regions"] = static_cast<double>(regions);
}
BENCHMARK_CAPTURE(regions_of_loose_curves, exact, 0.0)->Arg(35)->Arg(112)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(regions_of_loose_curves, with_gaps, 0.002)->Arg(112)->Unit(benchmark::kMillisecond);

void ellipse_to_arcs(benchmark::State& state) {
  cases::Sketch sketch;
  sketch.add(io::EllipseArc{{50, 0}, {50, 0}, {0, 0}, {50, 0}, {0, 25}, 0, 6.283185307179586}, "ELLIPSE");
  for (auto _ : state) {
    const auto found = io::make_regions(sketch.drawing());
    if (!found) return state.SkipWithError(found.error().message.c_str());
    state.counters["arcs"] = static_cast<double>(found->regions[0].outer.size());
    state.counters["proven_mm"] = found->curve_tolerance;
  }
}
BENCHMARK(ellipse_to_arcs)->Unit(benchmark::kMicrosecond);

}  // namespace

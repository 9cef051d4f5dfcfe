// Times of the certified localisation and its parts. `bench/run.sh` runs it beside the comparison with the
// rivals.

#include <benchmark/benchmark.h>

#include <string>

#include "lekalo/io/contour/contour_file.hpp"
#include "lekalo/locate/convex.hpp"
#include "lekalo/phi/convex.hpp"
#include "support/cases.hpp"

namespace {

using namespace lekalo;

void locate(benchmark::State& state, const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
            double gap) {
  const locate::ConvexProblem problem{part, blank, {}, 0, 0};
  locate::ConvexOptions options;
  options.gap = gap;
  options.keep_certificate = gap < 1e-7 && part.size() < 900;
  locate::ConvexResult result;
  for (auto _ : state) {
    result = locate::locate_convex(problem, options).value();
    benchmark::DoNotOptimize(result);
  }
  state.counters["programs"] = static_cast<double>(result.work);
  state.counters["intervals"] = static_cast<double>(result.certificate_size);
  state.counters["gap_mm"] = result.upper_bound - result.best.clearance;
}

void Example(benchmark::State& state) {
  const auto example = cases::published_examples()[static_cast<std::size_t>(state.range(0)) - 1];
  locate(state, example.part(), example.blank(), 1e-9);
}
BENCHMARK(Example)->DenseRange(1, 6)->Unit(benchmark::kMicrosecond);

/// n true edges, n vertices: smooth outlines.
void Smooth(benchmark::State& state) {
  const auto n = static_cast<std::size_t>(state.range(0));
  locate(state, cases::superellipse(n, 49, 29), cases::superellipse(n, 50, 31), 1e-9);
}
BENCHMARK(Smooth)->Arg(60)->Arg(1000)->Arg(5000)->Unit(benchmark::kMicrosecond);

/// 5,000 probed points on the 17 sides of a blank: what the reader does, then what the solver does.
io::ContourFile probed_blank() {
  io::ContourFile file;
  file.name = "probed.csv";
  file.points = cases::with_points_on_edges(cases::published_examples()[2].blank(), 5000);
  for (std::size_t i = 0; i < file.points.size(); ++i) file.places.push_back(i + 1);
  file.coordinate_error = 0x1p-45;
  return file;
}
void ProbedReduction(benchmark::State& state) {
  const io::ContourFile file = probed_blank();
  for (auto _ : state) benchmark::DoNotOptimize(io::make_convex(file).value());
  state.counters["points"] = static_cast<double>(file.points.size());
}
BENCHMARK(ProbedReduction)->Unit(benchmark::kMicrosecond);
void ProbedSolution(benchmark::State& state) {
  const auto blank = io::make_convex(probed_blank()).value();
  state.counters["edges"] = static_cast<double>(blank.polygon.size());
  locate(state, cases::published_examples()[2].part(), blank.polygon, 1e-9);
}
BENCHMARK(ProbedSolution)->Unit(benchmark::kMicrosecond);

/// The flat optimum: a regular 997-gon in a regular 1000-gon, gap 10^-range.
void NearRound(benchmark::State& state) {
  locate(state, cases::regular_ngon(997, 49), cases::regular_ngon(1000, 50),
         state.range(0) == 6 ? 1e-6 : 1e-9);
}
BENCHMARK(NearRound)->Arg(6)->Arg(9)->Unit(benchmark::kMillisecond)->Iterations(1);

void ClearanceEnclosure(benchmark::State& state) {
  const auto example = cases::published_examples()[0];
  const auto part = example.part(), blank = example.blank();
  for (auto _ : state) benchmark::DoNotOptimize(phi::clearance_enclosure(part, blank, 3.6458, 15.3929, 1e-3));
}
BENCHMARK(ClearanceEnclosure)->Unit(benchmark::kMicrosecond);

}  // namespace

// Times of the localisation of regions: growth with edges, window and gap.

#include <benchmark/benchmark.h>

#include "lekalo/locate/region.hpp"
#include "support/region_cases.hpp"

namespace {

using namespace lekalo;

/// Case `index` of a kind; window in degrees about the known angle, 360 for the full circle; gap 10^-digits
/// mm.
void locate(benchmark::State& state, cases::RegionKind kind, std::size_t edges, double window_deg,
            int digits) {
  std::uint64_t index = 0, work = 0, closed = 0;
  double gap = 1;
  for (int k = 0; k < digits; ++k) gap /= 10;
  locate::RegionOptions options;
  options.gap = gap;
  options.keep_certificate = true;
  for (auto _ : state) {
    state.PauseTiming();
    const cases::RegionCase one = cases::region_case(7, index++, kind, edges);
    locate::RegionProblem problem{one.part, one.blank, {}, locate::Mirror::no, 0, 0};
    const double half = 0.5 * window_deg * 0.017453292519943295;
    if (window_deg < 360) problem.window = {one.theta - half, one.theta + half};
    state.ResumeTiming();
    const locate::RegionResult result = locate::locate_regions(problem, options).value();
    work += result.work;
    closed += result.status == locate::Status::optimal ? 1 : 0;
  }
  state.counters["work"] = benchmark::Counter(static_cast<double>(work), benchmark::Counter::kAvgIterations);
  state.counters["closed"] =
      benchmark::Counter(static_cast<double>(closed), benchmark::Counter::kAvgIterations);
}

void NearNet(benchmark::State& state) {
  locate(state, cases::RegionKind::near_net, static_cast<std::size_t>(state.range(0)),
         static_cast<double>(state.range(1)), static_cast<int>(state.range(2)));
}
BENCHMARK(NearNet)
    ->ArgNames({"edges", "window", "digits"})
    ->ArgsProduct({{30, 98, 300}, {20, 360}, {2, 3, 4}})
    ->Args({998, 20, 3})
    ->Args({998, 360, 3})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(12);

void OtherShapes(benchmark::State& state) {
  locate(state, static_cast<cases::RegionKind>(state.range(0)), 98, 360, 3);
}
BENCHMARK(OtherShapes)->DenseRange(1, 6)->Unit(benchmark::kMillisecond)->Iterations(12);

}  // namespace

// From the bytes of a scan to a certified pose: times of each step, in one run.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>
#include <string>
#include <utility>

#include "lekalo/io/scan/scan_file.hpp"
#include "lekalo/locate/region.hpp"
#include "support/scan_cases.hpp"

namespace {

using namespace lekalo;

constexpr double kSigma = 0.02;

struct Scanned {
  cases::RegionCase shapes;
  std::string bytes;
};

/// A cored casting of about 380 mm of contour, `count` points with normal errors of 0.02 mm, four decimals;
/// in order or shuffled.
const Scanned& scanned(std::size_t count, bool shuffle) {
  static std::map<std::pair<std::size_t, bool>, Scanned> made;
  Scanned& one = made[{count, shuffle}];
  if (!one.bytes.empty()) return one;
  one.shapes = cases::region_case(7, 3, cases::RegionKind::rounded, 60);
  one.shapes.blank = cases::without_sharp_dents(one.shapes.blank, 3);
  double length = 0;
  Random random(5);
  for (const auto& list : cases::sample(one.shapes.blank, {0.01}, random))
    length += 0.01 * static_cast<double>(list.size());
  cases::Sampling how{length / static_cast<double>(count), 0.5, 0, kSigma};
  const auto lists = cases::sample(one.shapes.blank, how, random);
  locate::ScanPoints scan = cases::scan_of(lists);
  const auto starts = scan.contour_starts;
  if (shuffle) scan = cases::shuffled(std::move(scan), random);
  for (std::size_t i = 0, c = 1; i < scan.points.size(); ++i) {
    if (!shuffle && c < starts.size() && i == starts[c]) one.bytes += "\n", ++c;
    one.bytes += fmt::format("{:.4f} {:.4f}\n", scan.points[i].x, scan.points[i].y);
  }
  return one;
}

void chain(benchmark::State& state, bool shuffle) {
  const Scanned& one = scanned(static_cast<std::size_t>(state.range(0)), shuffle);
  io::ScanBlankOptions options;
  options.scan.uncertainty = kSigma;
  options.scan.min_radius = 3;
  double clearance = 0, edges = 0, loss = 0, ordered = 0, optimal = 0;
  for (auto _ : state) {
    auto made = io::read_scan_blank(one.bytes, "scan.xyz", options);
    if (!made) return state.SkipWithError(made.error().message.c_str());
    if (state.range(1) == 0) continue;
    const locate::RegionProblem problem{one.shapes.part, made->blank.regions, {}, locate::Mirror::no, 0, 0};
    const locate::RegionResult result = locate::locate_regions(problem, {}).value();
    clearance = result.best.clearance;
    optimal = result.status == locate::Status::optimal ? 1 : 0;
    edges = static_cast<double>(geom::edges_in(made->blank.regions));
    loss = made->blank.loss;
    ordered = made->blank.ordered ? 1 : 0;
  }
  if (state.range(1) == 0) return;
  state.counters["edges"] = edges;
  state.counters["loss"] = loss;
  state.counters["clearance"] = clearance;
  state.counters["ordered"] = ordered;
  state.counters["optimal"] = optimal;
}

void Parse(benchmark::State& state) {
  const Scanned& one = scanned(static_cast<std::size_t>(state.range(0)), true);
  for (auto _ : state)
    benchmark::DoNotOptimize(io::parse_scan(one.bytes, "scan.xyz", std::nullopt, std::nullopt));
}
void Shuffled(benchmark::State& state) { chain(state, true); }
void InOrder(benchmark::State& state) { chain(state, false); }

BENCHMARK(Parse)->RangeMultiplier(10)->Range(1000, 1'000'000)->Unit(benchmark::kMillisecond);
BENCHMARK(Shuffled)
    ->ArgNames({"points", "pose"})
    ->ArgsProduct({{1000, 10'000, 100'000, 1'000'000}, {0, 1}})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(InOrder)
    ->ArgNames({"points", "pose"})
    ->ArgsProduct({{1000, 10'000, 100'000, 1'000'000}, {0, 1}})
    ->Unit(benchmark::kMillisecond);

}  // namespace

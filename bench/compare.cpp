// The certified method beside the source's (IPOPT from random feasible starts) and the trade's (ICP), in one
// run.
//
//   bench_compare [random cases]

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "lekalo/locate/convex.hpp"
#include "lekalo/locate/reference.hpp"
#include "support/cases.hpp"

namespace {

using namespace lekalo;
using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

template <class Work>
double seconds_of(Work work, int repetitions) {
  std::vector<double> seconds;
  for (int i = 0; i < repetitions; ++i) {
    const auto begin = Clock::now();
    work();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return median(seconds);
}

locate::IpoptOptions starts(int count, std::uint64_t seed) {
  locate::IpoptOptions options;
  options.starts = count;
  options.seed = seed;
  return options;
}

void published() {
  std::printf(
      "| example | certified, us | 10 IPOPT starts, ms | ratio | IPOPT short of the optimum, mm "
      "|\n|---|---|---|---|---|\n");
  std::vector<double> ratios;
  for (const auto& example : cases::published_examples()) {
    const auto part = example.part(), blank = example.blank();
    const locate::ConvexProblem problem{part, blank, {}, 0, 0};
    locate::ConvexResult ours;
    const double certified = seconds_of([&] { ours = locate::locate_convex(problem, {}).value(); }, 301);
    locate::ReferenceResult theirs;
    const double ipopt =
        seconds_of([&] { theirs = locate::locate_ipopt(part, blank, starts(10, cases::seed())).value(); }, 3);
    ratios.push_back(ipopt / certified);
    std::printf("| %s | %.1f | %.0f | %.0f | %.6f |\n", example.name.c_str(), certified * 1e6, ipopt * 1e3,
                ratios.back(), std::max(0.0, ours.best.clearance - theirs.best.clearance));
  }
  std::printf("\nmedian ratio: %.0f\n\n", median(ratios));
}

void random_cases(std::size_t count) {
  constexpr int kStarts[] = {1, 3, 10};
  std::size_t missed[3] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const auto one = cases::random_case(cases::seed(), i, cases::Kind::plain);
    const auto ours = locate::locate_convex({one.part, one.blank, {}, 0, 0}, {}).value();
    for (std::size_t j = 0; j < 3; ++j) {
      const auto theirs = locate::locate_ipopt(one.part, one.blank, starts(kStarts[j], cases::seed() + i));
      missed[j] += !theirs || theirs->best.clearance < ours.best.clearance - 1e-6;
    }
  }
  std::printf(
      "IPOPT misses the optimum by more than 1e-6 mm, of %zu random cases: 1 start %zu, 3 starts %zu, 10 "
      "starts %zu\n",
      count, missed[0], missed[1], missed[2]);
}

void gouges(std::size_t count) {
  std::printf("\n| stock | cases | ICP cuts into the part | certified |\n|---|---|---|---|\n");
  for (const auto kind : {cases::Kind::uniform_stock, cases::Kind::moderate_stock, cases::Kind::thin_stock}) {
    std::size_t icp = 0, ours = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const auto one = cases::random_case(cases::seed(), i, kind);
      icp += locate::locate_icp(one.part, one.blank, {}).value().best.clearance < 0;
      ours += locate::locate_convex({one.part, one.blank, {}, 0, 0}, {}).value().best.clearance < 0;
    }
    std::printf("| %s | %zu | %.1f %% | %zu |\n", cases::name(kind), count,
                100.0 * static_cast<double>(icp) / static_cast<double>(count), ours);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 200;
  published();
  random_cases(count);
  gouges(std::max<std::size_t>(1000, count));
}

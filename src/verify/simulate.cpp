#include "lekalo/verify/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cut_path.hpp"

namespace lekalo::verify {
namespace {

Result<void> check(const SimulateOptions& o) {
  const auto outside = [](double value, double low, double high) { return !(value >= low && value <= high); };
  const auto wrong = [](const char* what, double value, const char* wanted) {
    return failure(ErrorCode::usage, fmt::format("{} of {:g}: it is to be {}", what, value, wanted));
  };
  if (outside(o.tool_diameter, 1e-3, 1e4))
    return wrong("a tool diameter", o.tool_diameter, "0.001 to 10000 mm");
  if (outside(o.stock_to_leave, 0, 1e4)) return wrong("a stock to leave", o.stock_to_leave, "0 to 10000 mm");
  if (outside(o.step_over, 1e-3, 1)) return wrong("a step-over", o.step_over, "0.001 to 1 of the diameter");
  if (outside(o.top, -1e6, 1e6)) return wrong("a top", o.top, "within 1e6 mm of 0");
  if (outside(o.acceleration, 1e-3, 1e9)) return wrong("an acceleration", o.acceleration, "above 0, mm/s2");
  if (outside(o.rapid_feed, 1e-3, 1e9)) return wrong("a rapid feed", o.rapid_feed, "above 0, mm/min");
  if (outside(o.spacing, 1e-4, 10)) return wrong("a spacing", o.spacing, "0.0001 to 10 mm");
  return {};
}

double turning_of(const CutPath& path) {
  double sum = 0;
  const Stroke* before = nullptr;
  for (const Stroke& s : path.strokes) {
    if (!(length(s.to - s.from) > 0)) continue;
    if (before != nullptr) sum += std::abs(angle_between(heading(*before, before->to), heading(s, s.from)));
    if (s.arc) sum += std::abs(angle_between(s.from - s.centre, s.to - s.centre));
    before = &s;
  }
  return sum;
}

/// The fastest feed, but for a twentieth of what cuts: a link that grazes a wall does not make the bound.
double cutting_feed(const std::vector<Move>& moves, const std::vector<EngagementSample>& samples) {
  std::vector<std::pair<double, double>> feeds;  // with the length cut at each
  double whole = 0;
  std::size_t next = 0;
  for (const EngagementSample& sample : samples) {
    while (next < moves.size() && moves[next].line < sample.line) ++next;
    if (sample.engagement < 3 || next == moves.size()) continue;
    feeds.emplace_back(moves[next].feed, sample.length);
    whole += sample.length;
  }
  std::sort(feeds.rbegin(), feeds.rend());
  double faster = 0;
  for (const auto& [feed, mm] : feeds) {
    faster += mm;
    if (faster > 0.05 * whole) return feed;
  }
  return 0;
}

}  // namespace

Result<SimulateReport> simulate(const Document& program, const Document& pocket, const SimulateOptions& o) {
  if (const Result<void> good = check(o); !good) return tl::unexpected(good.error());
  const Result<std::vector<Move>> moves = read_moves(program);
  if (!moves) return tl::unexpected(moves.error());
  const double radius = o.tool_diameter / 2;
  const Result<PocketReach> reach = PocketReach::make(pocket, radius + o.stock_to_leave);
  if (!reach) return tl::unexpected(reach.error());
  const Result<CutPath> path = cut_path(*moves, o.top, radius / 2, program.name);
  if (!path) return tl::unexpected(path.error());
  if (path->cuts.empty())
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: the tool never goes below Z {:g}, the top of the stock; give --top if it is "
                    "elsewhere",
                    program.name, o.top));
  SimulateReport report;
  report.retracts = path->retracts;
  report.turning_rad = turning_of(*path);
  measure_engagement(*path, radius, o.spacing, report);
  measure_coverage(*path, *reach, radius, report);
  measure_gouge(*path, *reach, report);
  find_unreachable(*reach, radius, report);
  report.seconds = machine_seconds(*moves, o);
  const double feed = cutting_feed(*moves, report.samples);
  if (feed > 0)
    report.lower_bound_seconds = std::max(0.0, report.reachable_mm2 - kPi * radius * radius) /
                                 (o.step_over * o.tool_diameter * feed / 60);
  return report;
}

}  // namespace lekalo::verify

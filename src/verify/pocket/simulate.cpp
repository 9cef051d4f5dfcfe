#include "lekalo/verify/simulate.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "cut_path.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/base/parallel.hpp"
#include "simulate_job.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

/// Nothing stands out of open edges for this many radii of the tool (with the stock to leave), so that a tool
/// can stand there and come in.
constexpr double kAirWidth = 4;

Result<void> check(const SimulateOptions& o, const std::vector<EarlierProgram>& earlier) {
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
  for (const EarlierProgram& other : earlier)
    if (outside(other.tool_diameter, 1e-3, 1e4))
      return wrong("an earlier tool's diameter", other.tool_diameter, "0.001 to 10000 mm");
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

/// Step 1 of docs/design/simulate.md: returns the path of a program that goes below the top, or an error that
/// says that it never does.
Result<CutPath> cuts_of(const Document& program, const std::vector<Move>& moves, double diameter,
                        double top) {
  LEKALO_TRY(CutPath path, cut_path(moves, top, diameter / 2, diameter / 4, program.name));
  if (path.cuts.empty())
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: the tool never goes below Z {:g}, the top of the stock; give --top if it is "
                    "elsewhere",
                    program.name, top));
  return path;
}

/// Returns the area that can be reached and that earlier programs have not cut as deep as this program goes.
double left_before(CutPath path, const PocketReach& reach, double radius) {
  path.cuts.clear();
  SimulateReport report;
  measure_coverage(path, reach, radius, report);
  return report.uncut_mm2;
}

/// Returns the fastest feed that cuts. The fastest twentieth of what cuts is left out, so that a link that
/// grazes a wall does not set the bound.
double cutting_feed(const std::vector<EngagementSample>& samples) {
  // Each feed stands with the length cut at it.
  std::vector<std::pair<double, double>> feeds;
  double whole = 0;
  for (const EngagementSample& sample : samples) {
    if (sample.engagement < kAirDegrees) continue;
    feeds.emplace_back(sample.feed, sample.length);
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

Result<SimulateJob> read_simulate_job(const Document& program, const Document& pocket,
                                      const SimulateOptions& o, const std::vector<EarlierProgram>& earlier) {
  LEKALO_CHECK(check(o, earlier));
  LEKALO_TRY(std::vector<Move> moves, read_moves(program, o.top, o.control));
  const double radius = o.tool_diameter / 2;
  LEKALO_TRY(PocketReach reach,
             PocketReach::make(pocket, radius + o.stock_to_leave, kAirWidth * (radius + o.stock_to_leave)));
  LEKALO_TRY(CutPath path, cuts_of(program, moves, o.tool_diameter, o.top));
  for (const EarlierProgram& other : earlier) {
    LEKALO_TRY(const std::vector<Move> its_moves, read_moves(other.program, o.top, o.control));
    LEKALO_TRY(CutPath its_path, cuts_of(other.program, its_moves, other.tool_diameter, o.top));
    for (Cut& cut : its_path.cuts) {
      cut.entry = 0;
      path.before.push_back(cut);
    }
  }
  return SimulateJob{std::move(moves), std::move(reach), std::move(path)};
}

Result<SimulateReport> simulate(const Document& program, const Document& pocket, const SimulateOptions& o,
                                const std::vector<EarlierProgram>& earlier,
                                const ProgressListener& progress) {
  LEKALO_TRY(const SimulateJob job, read_simulate_job(program, pocket, o, earlier));
  const std::vector<Move>& moves = job.moves;
  const PocketReach& reach = job.reach;
  const CutPath& path = job.path;
  const double radius = o.tool_diameter / 2;
  SimulateReport report;
  report.retracts = path.retracts;
  report.turning_rad = turning_of(path);
  // Two measurements run side by side, so each fills other members of the report: engagement (steps 2, 3, 5
  // and 7), and what is left.
  const auto measure_what_is_left = [&] {
    // Step 8.
    measure_coverage(path, reach, radius, report);
    report.left_before_mm2 = report.reachable_mm2;
    if (!path.before.empty()) report.left_before_mm2 = left_before(path, reach, radius);
    measure_gouge(path, reach, report);
    // Step 10.
    find_unreachable(reach, radius, report);
  };
  std::vector<Removed> removed;
  const auto measure_what_is_cut = [&] {
    removed = measure_engagement(path, reach.air(), radius, o.spacing, report, progress);
  };
  share_out(2, o.threads, [&](std::size_t k) { k == 0 ? measure_what_is_cut() : measure_what_is_left(); });
  report.seconds = machine_seconds(moves, o);
  const double feed = cutting_feed(report.samples);
  if (feed > 0) {
    // No depth can take off more than what can be reached, though measured sums may exceed it by their
    // rounding.
    double mm2 = 0;
    for (const Removed& level : removed)
      mm2 += std::min(level.mm2, std::max(0.0, report.reachable_mm2 - kPi * radius * radius));
    report.lower_bound_seconds = mm2 / (o.step_over * o.tool_diameter * feed / 60);
  }
  return report;
}

Result<std::vector<EngagementSample>> engagement_on(const Document& program, const Document& pocket,
                                                    const SimulateOptions& o,
                                                    const std::vector<EarlierProgram>& earlier,
                                                    const std::vector<LineRange>& lines) {
  LEKALO_TRY(const SimulateJob job, read_simulate_job(program, pocket, o, earlier));
  SimulateReport report;
  measure_engagement_on(job.path, job.reach.air(), o, lines, report);
  return std::move(report.samples);
}

Result<std::vector<CutStretch>> cut_stretches(const Document& program, double top, words::Control control) {
  LEKALO_TRY(const std::vector<Move> moves, read_moves(program, top, control));
  LEKALO_TRY(const CutPath path, cut_path(moves, top, 0, kInfinity, program.name));
  std::vector<CutStretch> stretches;
  for (const Cut& cut : path.cuts) {
    const Stroke& s = cut.stroke;
    stretches.push_back({s.arc, s.ccw, s.from.x, s.from.y, s.to.x, s.to.y, s.centre.x, s.centre.y,
                         std::max(cut.from_z, cut.to_z)});
  }
  return stretches;
}

}  // namespace lekalo::verify

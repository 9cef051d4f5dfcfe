#include "judged_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "interrupt.hpp"
#include "lekalo/mill/feeds.hpp"
#include "lekalo/mill/program.hpp"
#include "lekalo/mill/relief.hpp"

namespace lekalo::cli {
namespace {

/// What a machine's axes and a few decimals may take of a wall, mm.
constexpr double kMostGouge = 0.005;
constexpr int kMostRampings = 3;

using Loads = std::vector<std::vector<mill::MoveLoad>>;

/// A path and the program that says it.
struct Written {
  mill::PocketPath path;
  std::string text;
  std::vector<std::size_t> move_of_line;
};

class Judge {
 public:
  Judge(const PocketInput& input, const CutBefore& before, const PocketOptions& options)
      : input_(input), before_(before), o_(options) {
    machining_.tool_diameter = o_.path.tool_diameter;
    machining_.stock_to_leave = o_.path.stock_to_leave;
    machining_.step_over = o_.path.step_over;
  }

  Result<JudgedProgram> run(mill::PocketPath given) {
    auto slowed = with_slow_links(std::move(given));
    if (!slowed) return tl::unexpected(slowed.error());
    Written best = written(std::move(*slowed));
    Result<verify::SimulateReport> report = judgement_of(best.text);
    if (!report) return tl::unexpected(report.error());
    std::vector<mill::Ramp> ramps;
    if (o_.path.method == mill::Method::fronts) {
      auto relieved = with_relief(best, *report);
      if (!relieved) return tl::unexpected(relieved.error());
      if (relieved->text != best.text)
        // One that is worse for the walls is not worth it.
        if (auto judged = judgement_of(relieved->text)) {
          best = std::move(*relieved);
          report = std::move(judged);
        }
      // A ramp takes off what was to be met later elsewhere: seldom more than once.
      for (int round = 0; round < kMostRampings; ++round) {
        mill::RampedPath ramped = mill::with_ramps(best.path, loads_to_ramp(report->samples, best), o_.path);
        if (ramped.ramps.empty()) break;
        best = written(std::move(ramped.path));
        ramps.insert(ramps.end(), ramped.ramps.begin(), ramped.ramps.end());
        report = judgement_of(best.text);
        if (!report) return tl::unexpected(report.error());
      }
    }
    if (o_.most_feed) {
      best = written(mill::with_feeds(best.path, loads_of(report->samples, best), feeds(*o_.most_feed)));
      report = judgement_of(best.text);
      if (!report) return tl::unexpected(report.error());
    }
    return JudgedProgram{std::move(best.text), std::move(*report), std::move(ramps)};
  }

 private:
  [[nodiscard]] mill::FeedOptions feeds(double most) const {
    return {o_.program.feed_mm_per_min, most, o_.path.step_over};
  }

  [[nodiscard]] Written written(mill::PocketPath path) const {
    Written made{std::move(path), {}, {}};
    made.text = mill::program_of(made.path, o_.program, &made.move_of_line);
    return made;
  }

  /// As who does not know how the program was made finds it.
  [[nodiscard]] Result<verify::SimulateReport> judgement_of(const std::string& program) const {
    Result<verify::SimulateReport> report = [&] {
      ProgressLine line("checking the program", kOnCtrlC);
      return verify::simulate({kProgram, program}, {kPocket, input_.document}, machining_,
                              before_.programs.programs(), [&](const Progress& p) { line.show(p); });
    }();
    if (!report)
      return failure(ErrorCode::refuted,
                     "the independent checker cannot read this program; please report the pocket: " +
                         report.error().message);
    if (report->gouge_mm > kMostGouge || report->rapid_cut_mm > 0)
      return failure(
          ErrorCode::refuted,
          fmt::format("{}: the program found would cut {:.4f} mm into what stays, or {:.3f} mm in rapid "
                      "motion; nothing is written, please report the pocket",
                      o_.pocket, report->gouge_mm, report->rapid_cut_mm));
    return report;
  }

  /// What the checker found along each move.
  static Loads loads_of(const std::vector<verify::EngagementSample>& samples, const Written& of) {
    Loads loads(of.path.moves.size());
    for (const verify::EngagementSample& sample : samples)
      if (const std::size_t move = of.move_of_line[sample.line - 1]; move != mill::kNoMove)
        loads[move].push_back({sample.length, sample.engagement, sample.left});
    return loads;
  }

  /// The same but for what is an entry already.
  static Loads loads_to_ramp(std::vector<verify::EngagementSample> samples, const Written& of) {
    for (verify::EngagementSample& sample : samples)
      if (sample.entry) sample.engagement = 0;
    return loads_of(samples, of);
  }

  /// The same of some moves alone.
  [[nodiscard]] Result<Loads> loads_on(const std::function<bool(std::size_t)>& is_wanted,
                                       const Written& of) const {
    std::vector<verify::LineRange> lines;
    for (std::size_t line = 1; line <= of.move_of_line.size(); ++line) {
      const std::size_t move = of.move_of_line[line - 1];
      if (move == mill::kNoMove || !is_wanted(move)) continue;
      if (!lines.empty() && lines.back().last + 1 == line)
        lines.back().last = line;
      else
        lines.push_back({line, line});
    }
    const auto samples = verify::engagement_on({kProgram, of.text}, {kPocket, input_.document}, machining_,
                                               before_.programs.programs(), lines);
    if (!samples) return tl::unexpected(samples.error());
    return loads_of(*samples, of);
  }

  [[nodiscard]] Result<mill::PocketPath> with_slow_links(mill::PocketPath path) const {
    const Written of = written(std::move(path));
    const auto loads = loads_on(
        [&](std::size_t move) { return of.path.moves[move].kind == mill::PathMove::Kind::link; }, of);
    if (!loads) return tl::unexpected(loads.error());
    return mill::with_cutting_links_slow(of.path, *loads, feeds(o_.program.feed_mm_per_min),
                                         o_.program.link_feed_mm_per_min);
  }

  [[nodiscard]] Result<Written> with_relief(const Written& of, const verify::SimulateReport& report) const {
    Result<mill::Relief> relief = mill::Relief::make(of.path, input_.extended, o_.path);
    if (!relief) return tl::unexpected(relief.error());
    Loads loads = loads_of(report.samples, of);
    while (relief->improve(loads)) {
      const std::vector<mill::Relief::Moves> wanted = relief->wanted();
      auto on = loads_on(
          [&](std::size_t move) {
            const auto after = std::upper_bound(wanted.begin(), wanted.end(), move,
                                                [](std::size_t m, const auto& w) { return m < w.first; });
            return after != wanted.begin() && move <= std::prev(after)->last;
          },
          written(relief->path()));
      if (!on) return tl::unexpected(on.error());
      loads = std::move(*on);
    }
    return written(relief->path());
  }

  static constexpr const char *kProgram = "the program", *kPocket = "pocket.json";
  const PocketInput& input_;
  const CutBefore& before_;
  const PocketOptions& o_;
  verify::SimulateOptions machining_;
};

}  // namespace

Result<JudgedProgram> judged_program(mill::PocketPath path, const PocketInput& input, const CutBefore& before,
                                     const PocketOptions& options) {
  return Judge(input, before, options).run(std::move(path));
}

}  // namespace lekalo::cli

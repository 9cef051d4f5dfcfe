#include "pocket_judge.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

#include "lekalo/mill/feeds.hpp"
#include "lekalo/mill/program.hpp"
#include "lekalo/mill/relief.hpp"

namespace lekalo::jobs {
namespace {

/// mm that a program may take of a wall: the axes of a machine and a few decimals take as much.
constexpr double kMostGouge = 0.005;
/// A ramp takes off material that was to be met later elsewhere, so that another stretch can become too hot;
/// a second round is seldom needed.
constexpr int kMostRampings = 3;

using Loads = std::vector<std::vector<mill::MoveLoad>>;

/// A path and the program that says it.
struct Written {
  mill::PocketPath path;
  std::string text;
  std::vector<std::size_t> move_of_line;
};

/// The load of each move, from what the checker found along the lines of the program.
Loads loads_of(const std::vector<verify::EngagementSample>& samples, const Written& of) {
  Loads loads(of.path.moves.size());
  for (const verify::EngagementSample& sample : samples)
    if (const std::size_t move = of.move_of_line[sample.line - 1]; move != mill::kNoMove)
      loads[move].push_back({sample.length, sample.engagement, sample.left});
  return loads;
}

/// The same loads, but none on what is an entry already: it needs no ramp.
Loads loads_outside_entries(std::vector<verify::EngagementSample> samples, const Written& of) {
  for (verify::EngagementSample& sample : samples)
    if (sample.entry) sample.engagement = 0;
  return loads_of(samples, of);
}

class PocketJudge {
 public:
  PocketJudge(const PocketJob& job, const PocketGround& ground,
              const std::vector<verify::EarlierProgram>& before, const PhaseListener& phases)
      : job_(job),
        o_(job.options),
        ground_(ground),
        before_(before),
        phases_(phases),
        machining_(machining_of(job.options)) {}

  /// Steps 9 and 10 of docs/design/pocket.md; only the product's own paths get shallower passes and ramps.
  Result<JudgedProgram> run(mill::PocketPath given) {
    LEKALO_TRY(mill::PocketPath slowed, with_slow_links(std::move(given)));
    LEKALO_CHECK(take(written(std::move(slowed))));
    if (o_.path.method == mill::Method::fronts) {
      LEKALO_CHECK(relieve());
      LEKALO_CHECK(ramp());
    }
    if (o_.most_feed)
      LEKALO_CHECK(take(
          written(mill::with_feeds(best_.path, loads_of(report_.samples, best_), feeds(*o_.most_feed)))));
    return JudgedProgram{std::move(best_.text), std::move(report_), std::move(ramps_)};
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

  /// The checker's judgement of a program as it is written. It knows the bytes alone, not how they were made.
  [[nodiscard]] Result<verify::SimulateReport> judgement_of(const std::string& program) const {
    Result<verify::SimulateReport> report =
        verify::simulate({kProgram, program}, {kPocket, ground_.document}, machining_, before_,
                         begin_phase(phases_, "checking the program"));
    if (!report)
      return failure(ErrorCode::refuted,
                     "the independent checker cannot read this program; please report the pocket: " +
                         report.error().message);
    if (report->gouge_mm > kMostGouge || report->rapid_cut_mm > 0)
      return failure(
          ErrorCode::refuted,
          fmt::format("{}: the program found would cut {:.4f} mm into what stays, or {:.3f} mm in rapid "
                      "motion; nothing is written, please report the pocket",
                      job_.pocket.name, report->gouge_mm, report->rapid_cut_mm));
    return report;
  }

  /// Judges a program and makes it the best so far.
  Result<void> take(Written made) {
    LEKALO_TRY(report_, judgement_of(made.text));
    best_ = std::move(made);
    return {};
  }

  Result<void> relieve() {
    LEKALO_TRY(Written relieved, with_relief());
    if (relieved.text == best_.text) return {};
    // A program that the checker refuses only because of shallower passes is not worth them.
    if (auto report = judgement_of(relieved.text)) {
      best_ = std::move(relieved);
      report_ = std::move(*report);
    }
    return {};
  }

  Result<void> ramp() {
    for (int round = 0; round < kMostRampings; ++round) {
      mill::RampedPath ramped =
          mill::with_ramps(best_.path, loads_outside_entries(report_.samples, best_), o_.path);
      if (ramped.ramps.empty()) break;
      ramps_.insert(ramps_.end(), ramped.ramps.begin(), ramped.ramps.end());
      LEKALO_CHECK(take(written(std::move(ramped.path))));
    }
    return {};
  }

  /// The loads of some moves alone, at their share of the cost of a judgement.
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
    LEKALO_TRY(const auto samples, verify::engagement_on({kProgram, of.text}, {kPocket, ground_.document},
                                                         machining_, before_, lines));
    return loads_of(samples, of);
  }

  [[nodiscard]] Result<mill::PocketPath> with_slow_links(mill::PocketPath path) const {
    const Written of = written(std::move(path));
    LEKALO_TRY(
        const Loads loads,
        loads_on([&](std::size_t move) { return of.path.moves[move].kind == mill::PathMove::Kind::link; },
                 of));
    return mill::with_cutting_links_slow(of.path, loads, feeds(o_.program.feed_mm_per_min),
                                         o_.program.link_feed_mm_per_min);
  }

  /// The best program with the shallower passes that help; the checker measures each where it was tried.
  [[nodiscard]] Result<Written> with_relief() const {
    LEKALO_TRY(mill::Relief relief, mill::Relief::make(best_.path, ground_.extended, o_.path));
    Loads loads = loads_of(report_.samples, best_);
    while (relief.improve(loads)) {
      const std::vector<mill::Relief::Moves> wanted = relief.wanted();
      const auto is_wanted = [&](std::size_t move) {
        const auto after = std::upper_bound(wanted.begin(), wanted.end(), move,
                                            [](std::size_t m, const auto& w) { return m < w.first; });
        return after != wanted.begin() && move <= std::prev(after)->last;
      };
      LEKALO_TRY(loads, loads_on(is_wanted, written(relief.path())));
    }
    return written(relief.path());
  }

  static constexpr const char *kProgram = "the program", *kPocket = "pocket.json";
  const PocketJob& job_;
  const PocketOptions& o_;
  const PocketGround& ground_;
  const std::vector<verify::EarlierProgram>& before_;
  const PhaseListener& phases_;
  verify::SimulateOptions machining_;
  Written best_;
  verify::SimulateReport report_;  ///< of best_
  std::vector<mill::Ramp> ramps_;
};

}  // namespace

verify::SimulateOptions machining_of(const PocketOptions& options) {
  verify::SimulateOptions machining;
  machining.tool_diameter = options.path.tool_diameter;
  machining.stock_to_leave = options.path.stock_to_leave;
  machining.step_over = options.path.step_over;
  machining.control = options.program.post.language;
  return machining;
}

Result<JudgedProgram> judged_program(mill::PocketPath path, const PocketJob& job, const PocketGround& ground,
                                     const std::vector<verify::EarlierProgram>& before,
                                     const PhaseListener& phases) {
  return PocketJudge(job, ground, before, phases).run(std::move(path));
}

}  // namespace lekalo::jobs

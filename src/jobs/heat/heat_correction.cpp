#include "lekalo/jobs/heat_correction.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "heat_beside.hpp"
#include "heat_moves.hpp"
#include "heat_passes.hpp"
#include "heat_walls.hpp"
#include "lekalo/nc/moved_path.hpp"

namespace lekalo::jobs {
namespace {

/// Passes that are nearer than this to where they ought to be, or than rounding, are left, um.
constexpr double kSettled = 0.15;
constexpr int kMostRounds = 3;
/// Passes keep this off the cold part, um, because the way between places of walls may miss some.
constexpr double kKeptOff = 0.1;
/// A pass takes something where it takes more than this, mm.
constexpr double kTakes = 1e-3;

/// The walls that a program leaves, by the places to which the one before it came.
class WallsAfter {
 public:
  WallsAfter(const HeatFound& first, const HeatFound& now) : now_(now) {
    const SamePlaces places(first.walls);
    for (std::size_t i = 0; i < now.walls.size(); ++i) {
      const WallPoint& wall = now.walls[i];
      const std::size_t same = places.find(wall);
      double nearest = std::numeric_limits<double>::infinity();
      if (same == first.walls.size()) {
        nearest = nearest_of_all(first.source, wall);
      } else {
        for (const WallVisit& visit : first.visits[same])
          nearest = std::min(nearest, beside(first.source, first.walls[same], visit).distance);
      }
      std::vector<Reached> reached;
      for (const WallVisit& visit : now.visits[i]) {
        const BesideWall at = beside(now.source, wall, visit);
        reached.push_back({1000 * (nearest - at.distance), at.towards});
      }
      reached_.push_back(std::move(reached));
    }
  }

  /// The errors of all places in a case, um. The visit counts that goes deepest into the cold workpiece.
  [[nodiscard]] std::vector<double> errors(const HeatCase& one, double part) const {
    std::vector<double> errors;
    for (std::size_t i = 0; i < reached_.size(); ++i) {
      double most = -std::numeric_limits<double>::infinity();
      for (std::size_t v = 0; v < reached_[i].size(); ++v) {
        const auto& [um, towards] = reached_[i][v];
        const auto& moved = one.moved_um[i][v];
        most = std::max(most, um - part * (moved[0] * towards[0] + moved[1] * towards[1]));
      }
      errors.push_back(most);
    }
    return errors;
  }

  void summarise(HeatCorrection& made) const {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    made.errors_um = errors(now_.middle(), 1);
    made.after = summary_of(made.errors_um);
    heat::Interval* const over[] = {&made.after_over.least, &made.after_over.most, &made.after_over.mean,
                                    &made.after_over.largest};
    for (heat::Interval* interval : over) *interval = {kFar, -kFar};
    for (const HeatCase& one : now_.cases)
      for (const double part : {now_.heat_parts.least, 1.0, now_.heat_parts.greatest}) {
        const WallErrors here = summary_of(errors(one, part));
        const double values[] = {here.least, here.most, here.mean, here.largest()};
        for (std::size_t k = 0; k < 4; ++k)
          *over[k] = {std::min(over[k]->least, values[k]), std::max(over[k]->greatest, values[k])};
      }
  }

 private:
  struct Reached {
    double um = 0;  ///< beyond the place to which the first program comes
    std::array<double, 2> towards{};
  };
  const HeatFound& now_;
  std::vector<std::vector<Reached>> reached_;
};

/// Half of the places decide, since a pass takes less where it begins, ends or turns than on its way.
Result<void> check_finishing(const HeatJob& job, const std::vector<WallPasses>& stations, double finish) {
  std::vector<double> stocks;
  for (const WallPasses& passes : stations)
    for (const WallPass& pass : passes)
      if (pass.on_wall && pass.across && pass.stock > kTakes) stocks.push_back(pass.stock);
  std::string taken = "none of its passes along the walls takes anything";
  if (!stocks.empty()) {
    std::ranges::sort(stocks);
    const double usual = stocks[stocks.size() / 2];
    if (usual <= finish) return {};
    taken = fmt::format("its passes along the walls take {:.3g} mm", usual);
  }
  return failure(ErrorCode::bad_input,
                 fmt::format("{}: no finishing pass to move: {}, and a finishing pass takes {:g} mm at most "
                             "(--finish); cut the walls in a pass of their own",
                             job.source.program.name, taken, finish));
}

/// Returns what finishing passes take of a height within a tool's diameter of a station, mm. Where a pass
/// begins and ends it takes less than on the way, or nothing.
double stock_about(const HeatFound& found, const std::vector<WallPasses>& stations, std::size_t station,
                   double z, double diameter) {
  const auto place_of = [&](std::size_t s) -> const WallPoint& {
    return found.walls[stations[s].front().heights.back().place];
  };
  const WallPoint& here = place_of(station);
  double stock = 0;
  const auto look = [&](std::size_t s) {
    if (stations[s].empty()) return true;
    if (std::hypot(place_of(s).x - here.x, place_of(s).y - here.y) > diameter) return false;
    for (const WallPass& pass : stations[s])
      if (pass.finishing && std::ranges::any_of(pass.heights, [&](const WallPass::Height& height) {
            return found.walls[height.place].z == z;
          }))
        stock = std::max(stock, pass.stock);
    return true;
  };
  for (std::size_t s = station + 1; s-- > 0;)
    if (!look(s)) break;
  for (std::size_t s = station + 1; s < stations.size(); ++s)
    if (!look(s)) break;
  return stock;
}

/// No pass goes further than what stands there for the passes of its height to take.
Result<void> check_stock(const HeatJob& job, const HeatFound& found,
                         const std::vector<WallPasses>& stations) {
  for (std::size_t s = 0; s < stations.size(); ++s)
    for (const WallPass& pass : stations[s]) {
      if (!pass.across || !pass.finishing || std::abs(pass.moved) <= 1000 * pass.stock) continue;
      const WallPoint& wall = found.walls[pass.heights.back().place];
      const double stock = stock_about(found, stations, s, wall.z, job.source.machining.tool_diameter);
      if (std::abs(pass.moved) <= 1000 * stock) continue;
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}:{}: the finishing pass takes {:.4f} mm about X {:.3f} Y {:.3f}, and would be moved "
                      "by {:.4f} mm; leave more stock for it",
                      job.source.program.name, found.source.pieces[pass.at.piece].line, stock, wall.x, wall.y,
                      std::abs(pass.moved) / 1000));
    }
  return {};
}

/// Moves passes on to where they ought to be by what a run says; returns by how much at most, um.
double move_on(std::vector<WallPasses>& stations, const PassView& view, const HeatFound& now,
               double overcut) {
  double most = 0;
  for (WallPasses& passes : stations) {
    const std::vector<double> wanted = wanted_moves(passes, view, now, overcut);
    for (std::size_t k = 0; k < passes.size(); ++k) {
      WallPass& pass = passes[k];
      if (!pass.finishing) continue;
      const double more = wanted[k] - view.reached(pass);
      pass.moved += more;
      if (pass.across) most = std::max(most, std::abs(more));
    }
  }
  return most;
}

/// Measurements say how much heat there is, of the program as it is. The corrected one has the same part.
void take_measured(const HeatJob& job, const HeatFound& found, HeatFound& now) {
  const double stated = job.material[heat::Property::share].middle() * found.source.work.work_j.middle();
  now.heat_parts = found.heat_parts;
  for (HeatCase& one : now.cases)
    for (auto& visits : one.moved_um)
      for (auto& moved : visits)
        for (double& along : moved) along *= found.heat_j.middle() / stated;
}

bool is_better(const HeatCorrection& a, const HeatCorrection& b) {
  const bool a_holds = a.after_over.most.greatest <= kMostOvercut,
             b_holds = b.after_over.most.greatest <= kMostOvercut;
  if (a_holds != b_holds) return a_holds;
  return a.after.largest() < b.after.largest();
}

/// Rounding that a reason names, um.
constexpr double kCoarse = 0.3;

/// Why a corrected program is not worth writing; empty where it is.
/// \param rounding  to the decimals of the program, um
std::string reason_against(const HeatFound& found, const HeatCorrection& made, double rounding) {
  const double before = found.errors.largest(), after = made.after.largest(),
               scaled = found.scaling.left.largest();
  const char* const kNone = "no corrected program is written";
  const std::string decimals =
      rounding > kCoarse ? fmt::format(", of which {:.2f} um may be the decimals of the program", rounding)
                         : "";
  if (scaled <= after && made.after_over.most.greatest <= kMostOvercut)
    return fmt::format(
        "scaling the program does as well: it leaves {:.2f} um of {:.2f} um at the middles, and moved "
        "finishing passes {:.2f} um{}; {}",
        scaled, before, after, decimals, kNone);
  if (made.after_over.most.greatest > kMostOvercut)
    return fmt::format(
        "moved finishing passes may cut {:.2f} um into the cold workpiece somewhere in the intervals{}, and "
        "{:g} um are allowed; {}; state the share, the force or the cooling more closely",
        made.after_over.most.greatest, decimals, kMostOvercut, kNone);
  if (after > kMostLeft * before)
    return fmt::format(
        "finishing passes that are moved as far as all of the intervals allow leave {:.2f} um of {:.2f} um "
        "at the middles{}, more than a fifth; {}; state the share, the force or the cooling more closely, or "
        "take less depth at a time",
        after, before, decimals, kNone);
  if (made.after_over.largest.greatest > found.largest_um.greatest)
    return fmt::format(
        "moved finishing passes may leave {:.2f} um somewhere in the intervals, and the program as it is "
        "{:.2f} um; {}",
        made.after_over.largest.greatest, found.largest_um.greatest, kNone);
  return {};
}

}  // namespace

Result<HeatCorrection> heat_correction(const HeatJob& job, const HeatFound& found, const CorrectionWish& wish,
                                       const PhaseListener& phases) {
  const double radius = job.source.machining.tool_diameter / 2, finish = wish.finish.value_or(radius / 2);
  HeatCorrection best;
  best.finish = finish;
  if (!(found.largest_um.greatest > 0)) {
    best.program = job.source.program.bytes, best.found = found;
    return best;
  }
  std::vector<WallPasses> stations = wall_passes(found, radius, finish);
  LEKALO_CHECK(check_finishing(job, stations, finish));
  const words::Control control = job.source.machining.control;
  const std::string &bytes = job.source.program.bytes, &name = job.source.program.name;
  LEKALO_TRY(const nc::MovedRounding decimals, nc::moved_path_rounding(bytes, name, control));
  const double rounding = 1000 * decimals.most;
  best.dropped_um = 1000 * decimals.dropped;
  HeatCorrection latest = best;
  const auto move_passes = [&](const HeatFound& now) {
    return move_on(stations, PassView(found, now), now, kMostOvercut - kKeptOff - rounding);
  };
  double still = move_passes(found);
  for (int round = 1; round <= kMostRounds && (round == 1 || still > std::max(kSettled, rounding)); ++round) {
    LEKALO_CHECK(check_stock(job, found, stations));
    HeatJob again = job;
    again.measured.clear();
    LEKALO_TRY(again.source.program.bytes,
               nc::move_path(bytes, name, control, moved_motions(found, stations, radius, job.pitch)));
    LEKALO_TRY(latest.found, heat(again, phases));
    if (!job.measured.empty()) take_measured(job, found, latest.found);
    latest.program = std::move(again.source.program.bytes), latest.rounds = round;
    WallsAfter(found, latest.found).summarise(latest);
    if (best.rounds == 0 || is_better(latest, best)) best = latest;
    best.rounds = round;
    still = move_passes(latest.found);
  }
  best.still_um = still;
  best.why_not = reason_against(found, best, rounding);
  if (!best.why_not.empty()) best.program.clear();
  return best;
}

}  // namespace lekalo::jobs

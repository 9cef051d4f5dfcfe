// The tables of placements of solids: those that can be had against the true blank, beside least squares, and
// those that cannot be had, with their proofs.

#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/units.hpp"
#include "lekalo/locate/guaranteed_solid.hpp"
#include "lekalo/locate/solid.hpp"
#include "lekalo/locate/solid_reference.hpp"
#include "lekalo/locate/touched_solid.hpp"
#include "lekalo/solid/mesh_clearance.hpp"
#include "support/castings.hpp"
#include "support/touched_castings.hpp"

namespace {

using namespace lekalo;
using locate::SolidPlacement;
using solid::Vector;

constexpr double kGap = 0.02, kNoise = 0.02;

double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// The numbers of one kind of blank.
struct Tally {
  std::uint64_t cases = 0, placed = 0, cut_in = 0, told_more = 0, below = 0;
  std::uint64_t icp_cut_in = 0, icp_inside = 0;
  double worst = std::numeric_limits<double>::infinity();  ///< of what is had, less what has to be
};

void print(const char* kind, const Tally& t) {
  const auto share = [&](std::uint64_t n) {
    return t.cases == 0 ? 0.0 : 100.0 * static_cast<double>(n) / static_cast<double>(t.cases);
  };
  fmt::print("| {} | {} | {} | {} | {} | {} | {} ({:.0f} %) |\n", kind, t.cases, t.placed, t.cut_in,
             t.told_more, t.below, t.icp_cut_in, share(t.icp_cut_in));
}

/// The time limit of a search, in processor time.
class Limit {
 public:
  explicit Limit(double most) : most_(most), start_(seconds()) {}
  void set(locate::SolidOptions& how) {
    how.run.stop = &stop_;
    how.run.progress = [this](const Progress&) { stop_ = seconds() - start_ > most_; };
  }

 private:
  double most_, start_;
  std::atomic<bool> stop_{false};
};

/// The best that a climb and a search of some seconds find.
std::vector<SolidPlacement> placed(const locate::SolidProblem& problem) {
  constexpr double kSeconds = 2;
  locate::SolidOptions how;
  how.gap = kGap, how.threads = 1;
  std::vector<SolidPlacement> made{place_solid(problem, how).value()};
  Limit limit(kSeconds);
  limit.set(how);
  made.push_back(locate_solid(problem, how).value().best);
  return made;
}

/// A blank as drawn, or its scan: nobody who places knows the true one.
void place_in_casting(std::uint64_t number, std::uint64_t seed, bool scanned, Tally& tally) {
  const cases::SolidCase drawn = cases::casting(number, seed);
  const solid::MeshClearance truth(drawn.part, drawn.blank);
  locate::SolidProblem problem{drawn.part, drawn.blank, {}};
  double losses = kGap;
  if (scanned) {
    Random random(seed, 10'000 + number);
    cases::CastingScan scan = cases::scan_of(drawn.blank, 20'000, kNoise, random);
    locate::SolidScan said;
    said.guard = scan.guard, said.max_dip = 0;
    locate::GuaranteedSolid made = guaranteed_solid(scan.mesh, said).value();
    problem.blank = std::move(scan.mesh), problem.blank_widths = std::move(made.widths);
    problem.blank_width_error = made.width_error;
    losses += scan.loss + scan.guard;
  }
  const auto is_held = [&](const SolidPlacement& at) { return truth.inside(motion_of(at.pose)); };
  const double there = truth.nearest(drawn.there)->low;
  ++tally.cases;
  bool any = false, less = true;
  for (const SolidPlacement& one : placed(problem)) {
    if (!one.inside) continue;
    any = true;
    if (!is_held(one))
      ++tally.cut_in;
    else if (!(truth.nearest(motion_of(one.pose))->high >= one.clearance))
      ++tally.told_more;
    less = less && one.clearance < there - losses;
    tally.worst = std::min(tally.worst, one.clearance - (there - losses));
  }
  tally.placed += any;
  tally.below += less;
  tally.icp_cut_in += !is_held(place_solid_icp(problem, {kGap, 0, 1, {}}).value());
}

/// A casting of a metre, touched at 200 places, half of the time with directions. ICP has the mesh as it fits
/// the touches.
void place_in_touched(std::uint64_t number, std::uint64_t seed, Tally& tally) {
  Random random(seed, 20'000 + number);
  cases::SolidCase solids = cases::large_cored_block(random);
  locate::TouchStatement stated;
  stated.form = random.uniform(0.1, 0.4), stated.guard = random.uniform(0.005, 0.03);
  stated.ball = random.uniform(2, 8);
  const cases::TouchedCasting casting(solids.blank, cases::small_motion(random, 0.01, 3),
                                      random.uniform(0.5, 0.99) * stated.form, random);
  const auto touches = touches_of(casting, 200, 0.5 * stated.ball, stated.guard, random,
                                  number % 2 == 0 ? nullptr : &stated.directions);
  locate::TouchedSolid found = touched_solid(casting.nominal(), touches, stated).value();
  locate::SolidProblem problem{solids.part, std::move(found.mesh), {}};
  problem.blank_widths = std::move(found.widths), problem.blank_width_error = found.width_error;
  problem.shift = 25, problem.turn = 0.087;
  const double losses = kGap + 2 * found.widest + stated.form;
  const auto is_held = [&](const SolidPlacement& at) {
    const solid::Motion motion = motion_of(at.pose);
    for (std::size_t t = 0; t < problem.part.triangles.size(); ++t)
      for (int i = 0; i < 20; ++i)
        if (!casting.is_material(motion(cases::of_triangle(problem.part, t, random)))) return false;
    return true;
  };
  const solid::MeshClearance nominal(solids.part, solids.blank);
  const double there = nominal.nearest(solids.there)->low;
  ++tally.cases;
  bool any = false, less = true;
  for (const SolidPlacement& one : placed(problem)) {
    if (!one.inside) {
      less = less && there - losses > 0;
      continue;
    }
    any = true;
    if (!is_held(one)) ++tally.cut_in;
    less = less && one.clearance < there - losses;
    tally.worst = std::min(tally.worst, one.clearance - (there - losses));
  }
  tally.placed += any;
  tally.below += less;
  tally.icp_cut_in += !is_held(place_solid_icp(problem, {kGap, 0, 1, {}}).value());
}

int feasible(std::uint64_t count, std::uint64_t seed) {
  fmt::print(
      "| blanks | cases | placed | cut in | told more than the true blank has | less than the generator's "
      "pose "
      "has, less the losses | ICP cuts in |\n|---|---|---|---|---|---|---|\n");
  const char* const kinds[]{"as drawn", "scanned", "touched at 200 places"};
  std::uint64_t wrong = 0;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    Tally tally;
    for (std::uint64_t k = 0; k < count; ++k) {
      if (kind < 2)
        place_in_casting(k % cases::kCastings, seed + k / cases::kCastings, kind == 1, tally);
      else
        place_in_touched(k, seed, tally);
    }
    print(kinds[kind], tally);
    std::fflush(stdout);
    wrong += tally.cut_in + tally.told_more + tally.below;
  }
  return wrong == 0 ? 0 : 1;
}

/// Plates between two tips that leave too little by 0.05 mm, in the window of 5 mm and 5 degrees.
int infeasible(std::uint64_t count, std::uint64_t seed, double most, double shift, double degrees) {
  constexpr double kTooMuch = 0.05, kNear = 2;
  std::uint64_t proved = 0, placed_there = 0, wrong = 0;
  std::vector<double> times;
  for (std::uint64_t k = 0; k < count; ++k) {
    Random random(seed, 20'000 + k);
    const cases::PinchedPlate drawn = cases::pinched_plate(random, 30);
    locate::SolidProblem problem{drawn.part, drawn.blank, {}};
    problem.shift = shift, problem.turn = degrees * kDegree;
    locate::SolidOptions how;
    how.min_allowance = drawn.optimum + kTooMuch, how.gap = kGap, how.threads = 1;
    Limit limit(most);
    limit.set(how);
    const double start = seconds();
    const locate::SolidResult found = locate_solid(problem, how).value();
    times.push_back(seconds() - start);
    double farthest = 0;
    for (const Vector tip : {drawn.above, drawn.below}) {
      double nearest = std::numeric_limits<double>::infinity();
      for (const locate::SolidTouch& touch : found.best.contacts)
        if (touch.multiplier > 0.1) nearest = std::min(nearest, norm(touch.blank - tip));
      farthest = std::max(farthest, nearest);
    }
    const bool is_proved = found.status == locate::Status::infeasible;
    proved += is_proved, placed_there += farthest < kNear;
    wrong += found.upper_bound < drawn.optimum;
    if (!is_proved || !(farthest < kNear))
      fmt::print(
          "plate {}: bound {:.4f}, optimum {:.4f}, best {:.4f}, {} boxes, {:.1f} s, tips within {:.2f} mm\n",
          k, found.upper_bound, drawn.optimum, found.best.clearance, found.boxes, times.back(), farthest);
    std::fflush(stdout);
  }
  std::sort(times.begin(), times.end());
  fmt::print(
      "{} plates, seed {}, {} mm and {} degrees: {} proved to have no place for {} mm more, {} with both "
      "tips "
      "within {} mm; {:.2f} s in the median, {:.2f} s at most; bounds below the optimum: {}\n",
      count, seed, shift, degrees, proved, kTooMuch, placed_there, kNear, times[times.size() / 2],
      times.back(), wrong);
  return wrong == 0 && proved == count && placed_there == count ? 0 : 1;
}

}  // namespace

/// bench_solid_tables feasible [COUNT OF EACH KIND] [SEED]
/// bench_solid_tables infeasible [COUNT] [SEED] [SECONDS] [SHIFT] [DEGREES]
int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  const std::uint64_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 100;
  const auto number = [&](int k, double otherwise) {
    return argc > k ? std::strtod(argv[k], nullptr) : otherwise;
  };
  const auto seed = static_cast<std::uint64_t>(number(3, what == "feasible" ? cases::kCastingSeed : 1));
  if (what == "feasible" && count > 0) return feasible(count, seed);
  if (what == "infeasible" && count > 0)
    return infeasible(count, seed, number(4, 60), number(5, 5), number(6, 5));
  fmt::print(stderr, "bench_solid_tables feasible|infeasible [COUNT] [SEED]\n");
  return 2;
}

#include "strip_move.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::nest {
namespace {

/// Lets items lie up to this length of the strip, mm. What lies beyond is pushed back.
void limit(Search& search, double length) {
  const Bin& strip = search.problem.bins()[kStrip];
  search.separator.set_limits(kStrip, strip.box.x0 + length, strip.box.y1);
}

/// Makes a strip shorter. What lies beyond a share of its length moves along.
void squeeze(Search& search, double length, double shorter, double share) {
  const double split = search.problem.bins()[kStrip].box.x0 + share * length;
  for (std::size_t i = 0; i < search.items.movable(); ++i) {
    Spot spot = search.separator.state().spots[i];
    if (spot.bin == kNowhere || middle_of(search.problem, spot).x <= split) continue;
    spot.x -= length - shorter;
    search.separator.set_spot(i, spot);
  }
  limit(search, shorter);
}

double best_length(const Search& search) {
  return strip_length(search.problem, search.items, search.best.state);
}

}  // namespace

void StripMove::begin_separation(Search& search) {
  if (search.is_on_lattice()) search.separator.to_lattice();
  search.begin_separation();
  passes_ = relax_after_ = 0;
}

/// nest.md, steps 2 and 4.
Outcome StripMove::step(Search& search) {
  Separator& separator = search.separator;
  if (passes_++ == 0 && !search.is_on_lattice() && separator.relax(2 * tuning::kRelaxRounds))
    return Outcome::valid;
  const double overlap = separator.pass();
  const double least = search.attempt.least_overlap();
  if (overlap > 0 &&
      (overlap < least || (passes_ >= relax_after_ && overlap < tuning::kRelaxBelow * least))) {
    relax_after_ = passes_ + tuning::kRelaxEvery;
    if (fits_wider(search)) return Outcome::valid;
  }
  const Outcome outcome = search.after_pass(overlap, patience(search));
  if (outcome != Outcome::failed) return outcome;
  separator.load(search.attempt.least());
  return fits_wider(search) ? Outcome::valid : Outcome::failed;
}

bool StripMove::fits_wider(Search& search) {
  if (search.is_on_lattice()) return false;
  Separator& separator = search.separator;
  const double end = separator.state().ends[kStrip];
  limit(search, best_length(search) * (1 - tuning::kGain));
  if (separator.relax(tuning::kRelaxRounds)) return true;
  limit(search, end - search.problem.bins()[kStrip].box.x0);
  separator.overlap();
  return false;
}

Outcome StripMove::shorten(Search& search, double share, bool at_random) {
  const Bin& strip = search.problem.bins()[kStrip];
  Separator& separator = search.separator;
  separator.load(search.best.state);
  // The strip cannot be shorter than its widest item, its locked parts or the area of everything.
  const double area = used_area(search.problem, search.items, search.best.state, kStrip);
  const double least = std::max({separator.least_side(kStrip, 0), strip.locked_reach - strip.box.x0,
                                 area / (strip.box.y1 - strip.box.y0)});
  const double length = best_length(search);
  if (length <= least * (1 + 1e-12)) return Outcome::finished;
  double shorter = std::max(length * (1 - share), least);
  if (const double unit = separator.lattice(); unit > 0) {
    const double whole = std::ceil(length / unit - 1e-6) - std::max(1.0, std::round(share * length / unit));
    shorter = std::max(whole, std::ceil(least / unit - 1e-6)) * unit;
    if (shorter >= length * (1 - 1e-12)) return Outcome::over;
  }
  squeeze(search, length, shorter, at_random ? search.random().uniform() : 0.5);
  begin_separation(search);
  return Outcome::under_way;
}

bool StripMove::take(Search& search) {
  const State& state = search.separator.state();
  // A valid state may be no better: items for which the limits leave no room were left beyond them.
  const Merit merit = search.merit_of(state);
  if (!(merit < search.best.merit)) return false;
  search.best = {state, merit};
  if (!search.is_on_lattice()) compact(search);
  return true;
}

/// nest.md, step 4.
void StripMove::compact(Search& search) {
  Separator& separator = search.separator;
  for (double share = tuning::kCompactFrom; share > tuning::kCompactTo;) {
    const double length = best_length(search);
    separator.load(search.best.state);
    squeeze(search, length, length * (1 - share), search.random().uniform());
    const bool fits = separator.relax(tuning::kRelaxRounds);
    const Merit merit = fits ? search.merit_of(separator.state()) : Merit{};
    if (fits && merit < search.best.merit)
      search.best = {separator.state(), merit};
    else
      share *= 0.5;
  }
}

}  // namespace lekalo::nest

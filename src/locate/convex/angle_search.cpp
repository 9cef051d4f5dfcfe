#include "angle_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/assert.hpp"

namespace lekalo::locate {
namespace {

/// The first intervals are at most this wide, because bounds are compared on intervals shorter than pi.
constexpr double kFirstWidth = 1.0471975511965979;  // a sixth of a turn, rounded up
/// The progress listener is called after this many programs.
constexpr std::uint64_t kReportEvery = 4096;
/// In a flat optimum a better placement is looked for only where the clearance can rise by more than this
/// part of the gap. Elsewhere a bound that says so is enough, which saves most of the pivots.
constexpr double kNotWorth = 0.25;

/// Says whether an interval still has an angle inside that doubles can tell from its ends. Below 2^-56 a turn
/// moves nothing by more than rounding does.
bool divisible(double lo, double hi) { return hi - lo > std::max(0x1p-51 * std::abs(hi), 0x1p-56); }

/// Returns where to solve next: at the split, or in the middle where rounding has put the split on an end.
double inside(double split, double lo, double hi) {
  return split > lo && split < hi ? split : lo + 0.5 * (hi - lo);
}

bool lower_priority(const AngleInterval& a, const AngleInterval& b) {
  return a.upper != b.upper ? a.upper < b.upper : a.lo.theta > b.lo.theta;
}

}  // namespace

void for_pieces(const AngleInterval& interval, const std::function<void(const CoverPiece&)>& emit) {
  const auto better = [&](const Angle& from, const Angle& to) -> const Basis& {
    return max_over(interval.left.bound, from, to) <= max_over(interval.right.bound, from, to)
               ? interval.left
               : interval.right;
  };
  CrossingAngles at =
      crossings(interval.left.bound, interval.right.bound, interval.lo.theta, interval.hi.theta);
  if (at.count == 2 && at.theta[0] > at.theta[1]) std::swap(at.theta[0], at.theta[1]);
  const Basis& whole = better(interval.lo, interval.hi);
  if (at.count == 0 || max_over(whole.bound, interval.lo, interval.hi) <= interval.upper) {
    emit({interval.lo, interval.hi, whole});
    return;
  }
  Angle from = interval.lo;
  for (int i = 0; i <= at.count; ++i) {
    const Angle to = i == at.count ? interval.hi : Angle::of(at.theta[static_cast<std::size_t>(i)]);
    emit({from, to, better(from, to)});
    from = to;
  }
}

AngleSearch::AngleSearch(ContactProgram& program, AngleWindow window, double gap, const RunControl& run)
    : program_(program), window_(window), gap_(gap), run_(run) {
  best_.value = -std::numeric_limits<double>::infinity();
}

AngleSearch::Probe AngleSearch::probe(double theta, const Basis& warm, double of_interest,
                                      ContactProgram::Effort effort) {
  ++work_;
  const Angle angle = Angle::of(theta);
  const ContactProgram::Solution solution = program_.solve(angle, warm, of_interest, effort);
  return {angle, solution.basis, solution.shift, solution.value};
}

void AngleSearch::offer(const Probe& probe, const Basis& left, const Basis& right) {
  if (probe.value > best_.value) best_ = {probe.angle, probe.shift, probe.value, {probe.basis, left, right}};
}

void AngleSearch::bound(AngleInterval& interval) {
  const Sinusoid &f = interval.left.bound, &g = interval.right.bound;
  interval.upper = -std::numeric_limits<double>::infinity();
  const auto consider = [&](const Angle& angle) {
    const double value = std::min(f.at(angle), g.at(angle));
    if (value > interval.upper) interval.upper = value, interval.split = angle.theta;
  };
  consider(interval.lo);
  consider(interval.hi);
  // Step 2 of docs/design/locate-convex.md: the smaller of two sinusoids is largest at an end, at a crest of
  // one of them or where they cross.
  for (const Sinusoid* h : {&f, &g}) {
    if (!h->may_crest_within(interval.lo, interval.hi)) continue;
    double crest = h->crest_angle();
    while (crest < interval.lo.theta) crest += kTurn;
    while (crest > interval.hi.theta) crest -= kTurn;
    if (crest > interval.lo.theta && crest < interval.hi.theta) consider(Angle::of(crest));
  }
  const CrossingAngles at = crossings(f, g, interval.lo.theta, interval.hi.theta);
  for (int i = 0; i < at.count; ++i) consider(Angle::of(at.theta[static_cast<std::size_t>(i)]));
}

AngleInterval AngleSearch::join(const Probe& lo, const Probe& hi) {
  AngleInterval interval{lo.angle, hi.angle, lo.basis, hi.basis, 0, 0};
  bound(interval);
  return interval;
}

std::pair<AngleInterval, AngleInterval> AngleSearch::split(const AngleInterval& interval,
                                                           ContactProgram::Effort effort) {
  const double lo = interval.lo.theta, hi = interval.hi.theta;
  const double theta = inside(interval.split, lo, hi);
  const double of_interest =
      effort == ContactProgram::Effort::bound ? best_.value + kNotWorth * gap_ : best_.value;
  const Probe middle =
      probe(theta, theta - lo < hi - theta ? interval.left : interval.right, of_interest, effort);
  offer(middle, interval.left, interval.right);
  AngleInterval first{interval.lo, middle.angle, interval.left, middle.basis, 0, 0};
  AngleInterval second{middle.angle, interval.hi, middle.basis, interval.right, 0, 0};
  bound(first);
  bound(second);
  // A bound of the whole is a bound of both halves, and rounding must not make theirs worse.
  first.upper = std::min(first.upper, interval.upper);
  second.upper = std::min(second.upper, interval.upper);
  return {first, second};
}

std::vector<double> AngleSearch::first_angles() const {
  const double width = window_.to - window_.from;
  const auto pieces = static_cast<int>(std::ceil(width / kFirstWidth));
  std::vector<double> angles{window_.from};
  for (int i = 1; i < pieces; ++i) angles.push_back(window_.from + width * i / pieces);
  angles.push_back(window_.to);
  return angles;
}

/// Step 1 of docs/design/locate-convex.md.
std::vector<AngleInterval> AngleSearch::first_intervals() {
  std::vector<AngleInterval> open;
  std::optional<Probe> lo;
  for (const double theta : first_angles()) {
    const Probe hi = probe(theta, lo ? lo->basis : program_.first_basis(), best_.value);
    offer(hi, lo ? lo->basis : hi.basis, hi.basis);
    if (lo) open.push_back(join(*lo, hi));
    lo = hi;
  }
  return open;
}

bool AngleSearch::out_of_budget() const { return work_ >= run_.work_limit || run_.stop_requested(); }

void AngleSearch::report_progress(double newly_closed_width) {
  closed_width_ += newly_closed_width;
  if (!run_.progress || work_ < next_report_) return;
  next_report_ = work_ + kReportEvery;
  const double width = window_.to - window_.from;
  reported_ = std::max(reported_, width > 0 ? std::min(1.0, closed_width_ / width) : 0.0);
  run_.progress({work_, reported_});
}

/// Step 3: the interval with the largest bound is split first.
void AngleSearch::best_first(std::vector<AngleInterval>& open, std::vector<AngleInterval>& done) {
  std::make_heap(open.begin(), open.end(), lower_priority);
  while (!open.empty() && open.size() < kMostOpen && !closed(open.front()) && !out_of_budget()) {
    std::pop_heap(open.begin(), open.end(), lower_priority);
    const AngleInterval interval = open.back();
    open.pop_back();
    if (!divisible(interval.lo.theta, interval.hi.theta)) {
      // The interval cannot be divided, and upper() will say what it leaves open.
      done.push_back(interval);
      continue;
    }
    const auto [first, second] = split(interval, ContactProgram::Effort::optimum);
    for (const AngleInterval& half : {first, second}) {
      if (closed(half)) {
        done.push_back(half);
        report_progress(half.hi.theta - half.lo.theta);
      } else {
        open.push_back(half);
        std::push_heap(open.begin(), open.end(), lower_priority);
      }
    }
  }
}

/// Step 4: what is left of a flat optimum is walked in order of angle, depth first.
void AngleSearch::in_order(AngleInterval interval, const std::function<void(const AngleInterval&)>& emit) {
  std::vector<AngleInterval> stack{interval};
  while (!stack.empty()) {
    const AngleInterval top = stack.back();
    stack.pop_back();
    if (closed(top) || out_of_budget() || !divisible(top.lo.theta, top.hi.theta)) {
      report_progress(top.hi.theta - top.lo.theta);
      emit(top);
      continue;
    }
    auto [first, second] = split(top, ContactProgram::Effort::bound);
    stack.push_back(second);
    stack.push_back(first);
  }
}

void AngleSearch::run(const std::function<void(const CoverPiece&)>& cover) {
  std::vector<AngleInterval> open = first_intervals();
  std::vector<AngleInterval> done;
  best_first(open, done);
  open.insert(open.end(), done.begin(), done.end());
  std::sort(open.begin(), open.end(),
            [](const AngleInterval& a, const AngleInterval& b) { return a.lo.theta < b.lo.theta; });
  upper_ = best_.value;
  finished_ = true;
  for (const AngleInterval& interval : open) {
    in_order(interval, [&](const AngleInterval& last) {
      upper_ = std::max(upper_, last.upper);
      finished_ = finished_ && closed(last);
      for_pieces(last, cover);
    });
  }
}

void AngleSearch::probe_between(const Probe& from, const Probe& to, double threshold, std::uint64_t last_work,
                                std::vector<Probe>& probes, bool& complete) {
  const AngleInterval interval = join(from, to);
  const double lo = from.angle.theta, hi = to.angle.theta;
  if (interval.upper <= std::max({threshold, from.value, to.value}) + gap_ || !divisible(lo, hi)) return;
  if (work_ >= last_work || run_.stop_requested()) {
    complete = false;
    return;
  }
  const Probe middle = probe(inside(interval.split, lo, hi), from.basis, threshold);
  probe_between(from, middle, threshold, last_work, probes, complete);
  probes.push_back(middle);
  probe_between(middle, to, threshold, last_work, probes, complete);
}

AngleSearch::Peaks AngleSearch::peaks(double threshold, std::uint64_t limit) {
  // The list has every angle at which a program was solved, ascending. Between two neighbours nothing is
  // higher than the higher of the two (or than the threshold) by more than the gap.
  std::vector<Probe> probes;
  Peaks result;
  const std::uint64_t last_work = work_ + limit;
  for (const double theta : first_angles()) {
    const Probe next = probe(theta, probes.empty() ? program_.first_basis() : probes.back().basis, threshold);
    if (!probes.empty()) {
      const Probe last = probes.back();
      probe_between(last, next, threshold, last_work, probes, result.complete);
    }
    probes.push_back(next);
  }
  const bool cyclic = window_.full_circle();
  // The last angle is the first one again.
  if (cyclic) probes.pop_back();

  // A peak counts when, on both sides, the clearance falls below it by more than the gap before it rises
  // above it. Among equal peaks the first one counts.
  const std::size_t count = probes.size();
  const auto falls_before_rising = [&](std::size_t i, bool forwards) {
    const double height = probes[i].value;
    for (std::size_t step = 1; step < count; ++step) {
      // The window ends here.
      if (!cyclic && (forwards ? i + step >= count : step > i)) return true;
      const std::size_t j = forwards ? (i + step) % count : (i + count - step) % count;
      if (probes[j].value < height - gap_) return true;
      if (probes[j].value > height || (probes[j].value == height && j < i)) return false;
    }
    return true;
  };
  for (std::size_t i = 0; i < count; ++i) {
    if (probes[i].value >= threshold && falls_before_rising(i, true) && falls_before_rising(i, false))
      result.found.push_back({probes[i].angle, probes[i].shift, probes[i].value, {probes[i].basis}});
  }
  return result;
}

}  // namespace lekalo::locate

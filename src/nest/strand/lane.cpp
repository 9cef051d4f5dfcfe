#include "lane.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "nest/separator/lattice_unit.hpp"

namespace lekalo::nest {
namespace {

constexpr std::uint32_t kStrip = 0;  ///< the only bin there is
constexpr double kExploreShrink = 0.001, kFirstShrink = 0.02;
constexpr double kCompressFrom = 0.0005, kCompressTo = 0.00001, kCompressDecay = 0.7;
constexpr Patience kExplore = {200, 3}, kCompress = {100, 3}, kHasty = {50, 1}, kInsert = {100, 2};
constexpr int kFailuresToCompress = 6;
/// Relaxing: rounds; tried at a new least overlap, and up to so many times that after so many passes.
constexpr int kRelaxRounds = 100, kRelaxEvery = 10;
constexpr double kRelaxBelow = 1.5;
/// Of a valid state pushed together: the first share of the length, halved where it fails down to the last.
constexpr double kCompactFrom = 0.004, kCompactTo = 1e-5;
/// Shorter than the best, as a share: what counts as that.
constexpr double kGain = 1e-6;
constexpr int kLatticeUnits = 3;                   ///< whole, half, quarter: one after the other
constexpr std::uint64_t kLatticeWork = 1'500'000;  ///< without a gain, until it is left

double about_normal(Random& random) {
  double sum = 0;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum - 6;
}

}  // namespace

Lane::Lane(const Problem& problem, const Items& items, std::uint64_t seed, std::uint64_t stream)
    : problem_(problem),
      items_(items),
      strip_(problem.bins()[kStrip]),
      separator_(problem, items, Random(seed, stream + 1)) {
  by_size_.resize(items.movable());
  std::iota(by_size_.begin(), by_size_.end(), 0u);
  const auto& parts = problem.document().parts;
  std::stable_sort(by_size_.begin(), by_size_.end(), [&](std::uint32_t a, std::uint32_t b) {
    const std::uint32_t p = items_.parts[a], q = items_.parts[b];
    if (parts[p].priority != parts[q].priority) return parts[p].priority > parts[q].priority;
    return problem.hull_area_of(p) > problem.hull_area_of(q);
  });
  if (stream == 1) lattice_unit_ = lattice_unit(problem, items);
  // Those that make up three quarters of all hulls.
  std::vector<std::uint32_t> order = by_size_;
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return problem.hull_area_of(items_.parts[a]) > problem.hull_area_of(items_.parts[b]);
  });
  double all = 0, sum = 0;
  for (const std::uint32_t i : order) all += problem_.hull_area_of(items_.parts[i]);
  for (const std::uint32_t i : order) {
    if (sum > 0.75 * all && large_.size() >= 2) break;
    sum += problem_.hull_area_of(items_.parts[i]);
    large_.push_back(i);
  }
}

double Lane::reach_of(const State& state) const {
  double reach = std::max(0.0, strip_.locked_reach - strip_.box.x0);
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    const Spot& spot = state.spots[i];
    if (spot.bin == kNowhere) continue;
    reach = std::max(reach, problem_.border_gap_of(items_.parts[i]) + spot.x +
                                problem_.forms()[spot.form].box.x1 - strip_.box.x0);
  }
  return reach;
}

double Lane::used_area(const State& state) const {
  double area = 0;
  for (std::size_t i = 0; i < items_.movable(); ++i)
    if (state.spots[i].bin != kNowhere) area += problem_.area_of(items_.parts[i]);
  return area;
}

Merit Lane::merit_of(const State& state) const {
  Merit merit;
  for (std::size_t i = 0; i < items_.movable(); ++i)
    if (state.spots[i].bin == kNowhere) {
      const int priority = problem_.document().parts[items_.parts[i]].priority;
      merit.unplaced += problem_.area_of(items_.parts[i]) * (1 + std::max(0, priority));
    }
  for (const std::uint32_t bin : state.open_bins)
    merit.cost += problem_.document().stocks[problem_.bins()[bin].stock].cost;
  merit.reach = reach_of(state);
  return merit;
}

void Lane::start(const State& state) {
  if (best_.spots.empty()) enter_lattice();
  if (best_.spots.empty() || done_)
    go_on_from(state);
  else
    offered_ = state;
}

void Lane::go_on_from(const State& state) {
  best_ = state;
  failures_ = 0;
  pool_.clear();
  done_ = false;
  offered_.reset();
  choose_goal_again();
  merit_ = merit_of(best_);
  if (!done_) next_attempt();
}

bool Lane::take_offered() {
  if (!offered_) return false;
  const State state = std::move(*offered_);
  offered_.reset();
  if (!(merit_of(state) < merit_)) return false;
  go_on_from(state);
  return true;
}

void Lane::choose_goal() {
  phase_ = Phase::explore;
  for (std::size_t i = 0; i < items_.movable(); ++i)
    if (best_.spots[i].bin == kNowhere) phase_ = Phase::insert;
  done_ = best_.open_bins.empty() || (phase_ == Phase::explore && used_area(best_) == 0);
  ratio_ = kFirstShrink;
}

/// What was too much to ask for before is so now.
void Lane::choose_goal_again() {
  const double ratio = ratio_;
  choose_goal();
  if (phase_ == Phase::explore && ratio > 0) ratio_ = std::min(ratio_, std::max(ratio, kExploreShrink));
}

void Lane::begin_separation() {
  if (on_lattice_) separator_.to_lattice();
  separator_.forget_weights();
  const double overlap = separator_.overlap();
  attempt_.begin(overlap, separator_.state());
  passes_ = relax_after_ = 0;
}

void Lane::next_attempt() {
  if (phase_ == Phase::insert) return attempt_insert();
  attempt_shrink(phase_ == Phase::compress);
}

void Lane::attempt_insert() {
  separator_.load(best_);
  std::vector<std::uint32_t> nowhere;
  for (const std::uint32_t i : by_size_)
    if (best_.spots[i].bin == kNowhere) nowhere.push_back(i);
  Random& random = separator_.random();
  // Mostly the first, which is the largest or the most wanted.
  const std::size_t pick = random.below(2) == 0 ? 0 : random.below(nowhere.size());
  separator_.put_anywhere(nowhere[pick]);
  begin_separation();
}

void Lane::attempt_shrink(bool random_split) {
  separator_.load(best_);
  // No shorter than what lies on it can be.
  const double least = std::max({separator_.least_side(kStrip, 0), strip_.locked_reach - strip_.box.x0,
                                 used_area(best_) / (strip_.box.y1 - strip_.box.y0)});
  const double length = reach_of(best_);
  if (length <= least * (1 + 1e-12)) {
    done_ = true;
    return;
  }
  double shorter = std::max(length * (1 - ratio_), least);
  if (on_lattice_) {
    const double unit = lattice_;
    const double whole = std::ceil(length / unit - 1e-6) - std::max(1.0, std::round(ratio_ * length / unit));
    shorter = std::max(whole, std::ceil(least / unit - 1e-6)) * unit;
    if (shorter >= length * (1 - 1e-12)) {
      leave_lattice();
      return attempt_shrink(random_split);
    }
  }
  squeeze(length, shorter, random_split ? separator_.random().uniform() : 0.5);
  begin_separation();
}

/// Makes the strip shorter; what lies beyond a share of its length moves along.
void Lane::squeeze(double length, double shorter, double share) {
  const double split = strip_.box.x0 + share * length;
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    Spot spot = separator_.state().spots[i];
    if (spot.bin == kNowhere) continue;
    const Box& b = problem_.forms()[spot.form].box;
    if (spot.x + 0.5 * (b.x0 + b.x1) <= split) continue;
    spot.x -= length - shorter;
    separator_.set_spot(i, spot);
  }
  limit(shorter);
}

/// The length up to which there may be something.
void Lane::limit(double length) { separator_.set_limits(kStrip, strip_.box.x0 + length, strip_.box.y1); }

/// Pushes the best together as far as that goes without another arrangement.
void Lane::compact() {
  for (double ratio = kCompactFrom; ratio > kCompactTo && !separator_.is_stopped();) {
    const double length = reach_of(best_);
    separator_.load(best_);
    squeeze(length, length * (1 - ratio), separator_.random().uniform());
    if (separator_.relax(kRelaxRounds) && merit_of(separator_.state()) < merit_) {
      best_ = separator_.state();
      merit_ = merit_of(best_);
    } else {
      ratio *= 0.5;
    }
  }
}

void Lane::attempt_disrupted() {
  Random& random = separator_.random();
  std::stable_sort(pool_.begin(), pool_.end(),
                   [](const Failed& a, const Failed& b) { return a.overlap < b.overlap; });
  const auto pick = static_cast<std::size_t>(std::min(0.999, std::abs(0.25 * about_normal(random))) *
                                             static_cast<double>(pool_.size()));
  separator_.load(pool_[pick].state);
  if (large_.size() < 2) return begin_separation();
  const State& state = separator_.state();
  const std::uint32_t a = large_[random.below(large_.size())];
  std::uint32_t b = a;
  for (int tries = 0; tries < 50 && items_.parts[b] == items_.parts[a]; ++tries)
    b = large_[random.below(large_.size())];
  if (items_.parts[a] == items_.parts[b] || state.spots[a].bin == kNowhere || state.spots[b].bin == kNowhere)
    return begin_separation();
  const auto middle = [&](std::uint32_t i) {
    const Spot& s = state.spots[i];
    const Box& box = problem_.forms()[s.form].box;
    return geom::Point{s.x + 0.5 * (box.x0 + box.x1), s.y + 0.5 * (box.y0 + box.y1)};
  };
  const geom::Point way = middle(b) - middle(a);
  const auto lies_in = [&](std::uint32_t i, std::uint32_t of) {
    const Spot& s = state.spots[of];
    const Box& box = problem_.forms()[s.form].box;
    const geom::Point m = middle(i);
    return state.spots[i].bin == s.bin && m.x > s.x + box.x0 && m.x < s.x + box.x1 && m.y > s.y + box.y0 &&
           m.y < s.y + box.y1 &&
           problem_.hull_area_of(items_.parts[i]) < 0.5 * problem_.hull_area_of(items_.parts[of]);
  };
  std::vector<std::pair<std::uint32_t, Spot>> moves;
  const auto shift = [&](std::uint32_t i, geom::Point by) {
    Spot s = state.spots[i];
    s.x += by.x;
    s.y += by.y;
    moves.emplace_back(i, s);
  };
  shift(a, way);
  shift(b, -way);
  for (std::uint32_t i = 0; i < items_.movable(); ++i) {
    if (i == a || i == b) continue;
    if (lies_in(i, a))
      shift(i, way);
    else if (lies_in(i, b))
      shift(i, -way);
  }
  for (const auto& [item, spot] : moves) separator_.set_spot(item, spot);
  separator_.set_limits(kStrip, state.ends[kStrip], state.tops[kStrip]);
  begin_separation();
}

void Lane::on_valid() {
  if (problem_.unit() > 0) separator_.snap(problem_.unit());
  // What does not fit between the limits at all was left beyond them.
  if (phase_ != Phase::insert && !(merit_of(separator_.state()) < merit_)) return on_failure();
  const Phase before = phase_;
  const double ratio = ratio_;
  best_ = separator_.state();
  failures_ = 0;
  pool_.clear();
  choose_goal();
  if (!done_ && before != Phase::insert) {
    phase_ = before;
    ratio_ = ratio;
  }
  if (before == Phase::insert && phase_ != Phase::insert) pool_.clear();
  merit_ = merit_of(best_);
  if (on_lattice_)
    lattice_until_ = separator_.work() + kLatticeWork;
  else if (!done_ && phase_ != Phase::insert)
    compact();
  if (!done_) next_attempt();
}

void Lane::on_stuck() {
  separator_.load(attempt_.least());
  if (fits_wider()) return on_valid();
  on_failure();
}

void Lane::on_failure() {
  if (take_offered()) return;
  ++failures_;
  if (phase_ == Phase::insert) {
    // Not the goal any more after many tries: then the least material for what is there.
    if (failures_ % 2 == 0 || attempt_.least_overlap() <= 0) return attempt_insert();
    pool_.push_back({attempt_.least(), attempt_.least_overlap()});
    if (pool_.size() > 8) pool_.erase(pool_.begin());
    return attempt_disrupted();
  }
  if (phase_ == Phase::compress) {
    ratio_ *= kCompressDecay;
    if (ratio_ < kCompressTo) {
      phase_ = Phase::explore;
      ratio_ = kExploreShrink;
      if (!on_lattice_) enter_lattice();
      pool_.clear();
      failures_ = 0;
    }
    return next_attempt();
  }
  if (ratio_ > kExploreShrink) {
    ratio_ = std::max(kExploreShrink, 0.5 * ratio_);
    failures_ = 0;
    return next_attempt();
  }
  pool_.push_back({attempt_.least(), attempt_.least_overlap()});
  if (on_lattice_) {  // left by its own clock
    if (pool_.size() > std::size_t{kFailuresToCompress}) pool_.erase(pool_.begin());
  } else if (failures_ >= kFailuresToCompress) {
    phase_ = Phase::compress;
    ratio_ = kCompressFrom;
    failures_ = 0;
    pool_.clear();
    return next_attempt();
  }
  attempt_disrupted();
}

/// What all but fits, and may fit in a little more length that is still a gain.
bool Lane::fits_wider() {
  if (on_lattice_) return false;
  if (phase_ == Phase::insert) return separator_.relax(kRelaxRounds);
  const double end = separator_.state().ends[kStrip];
  limit(reach_of(best_) * (1 - kGain));
  if (separator_.relax(kRelaxRounds)) return true;
  limit(end - strip_.box.x0);
  separator_.overlap();
  return false;
}

void Lane::enter_lattice() {
  if (lattice_unit_ <= 0) return;
  lattice_ = lattice_unit_ / (1 << lattice_halvings_);
  lattice_halvings_ = (lattice_halvings_ + 1) % kLatticeUnits;
  if (!separator_.use_lattice(lattice_)) return;
  on_lattice_ = true;
  lattice_until_ = separator_.work() + kLatticeWork;
}

void Lane::leave_lattice() {
  on_lattice_ = false;
  separator_.use_lattice(0);
  failures_ = 0;
  pool_.clear();
  choose_goal_again();
}

void Lane::step() {
  if (on_lattice_ && separator_.work() > lattice_until_) {
    leave_lattice();
    return next_attempt();
  }
  if (passes_++ == 0 && !on_lattice_ && separator_.relax(2 * kRelaxRounds)) return on_valid();
  const double overlap = separator_.pass();
  if (overlap > 0 && (overlap < attempt_.least_overlap() ||
                      (passes_ >= relax_after_ && overlap < kRelaxBelow * attempt_.least_overlap()))) {
    relax_after_ = passes_ + kRelaxEvery;
    if (fits_wider()) return on_valid();
  }
  if (overlap <= 0 || (separator_.deepest() < problem_.unit() && separator_.snap(problem_.unit())))
    return on_valid();
  const Patience patience = phase_ == Phase::insert     ? kInsert
                            : phase_ == Phase::compress ? kCompress
                            : ratio_ > kExploreShrink   ? kHasty
                                                        : kExplore;
  switch (attempt_.after_pass(overlap, separator_.state(), patience)) {
    case Attempt::Next::on:
      return;
    case Attempt::Next::stuck:
      return on_stuck();
    case Attempt::Next::from_least:
      separator_.load(attempt_.least());
      separator_.overlap();
  }
}

void Lane::run(std::uint64_t work) {
  const std::uint64_t until = separator_.work() + work;
  while (!done_ && separator_.work() < until && !separator_.is_stopped()) step();
}

}  // namespace lekalo::nest

#include "strip_lane.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace lekalo::nest {
namespace {

constexpr double kExploreShrink = 0.001, kFirstShrink = 0.02;
constexpr double kCompressFrom = 0.0005, kCompressTo = 0.00001;
constexpr int kExplorePatience = 200, kExploreStrikes = 3;
constexpr int kCompressPatience = 100, kCompressStrikes = 5;
constexpr int kFailuresToCompress = 12;

double about_normal(Random& random) {
  double sum = 0;
  for (int k = 0; k < 12; ++k) sum += random.uniform();
  return sum - 6;
}

}  // namespace

StripLane::StripLane(const Problem& problem, const Items& items, std::uint64_t seed, std::uint64_t stream)
    : problem_(problem), items_(items), separator_(problem, items, Random(seed, stream + 1)) {
  std::vector<std::uint32_t> order(items.movable);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return problem_.hull_area_of(items_.parts[a]) > problem_.hull_area_of(items_.parts[b]);
  });
  // Those that make up three quarters of all hulls.
  double all = 0, sum = 0;
  for (const std::uint32_t i : order) all += problem_.hull_area_of(items_.parts[i]);
  for (const std::uint32_t i : order) {
    if (sum > 0.75 * all && large_.size() >= 2) break;
    sum += problem_.hull_area_of(items_.parts[i]);
    large_.push_back(i);
  }
}

double StripLane::reach_of(const State& state) const {
  double reach = 0;
  for (std::size_t i = 0; i < state.spots.size(); ++i)
    reach = std::max(reach, state.spots[i].x + problem_.forms()[state.spots[i].form].box.x1 +
                                problem_.border_gap_of(items_.parts[i]));
  return reach;
}

void StripLane::build() {
  State state;
  double area = 0, widest = 0;
  for (std::size_t i = 0; i < items_.movable; ++i) {
    const Forms& forms = problem_.forms_of(items_.parts[i]);
    state.spots.push_back({0, 0, forms.first, ~0u});
    area += problem_.area_of(items_.parts[i]);
    for (std::uint32_t f = forms.first; f < forms.last; ++f)
      widest = std::max(widest, problem_.forms()[f].box.x1 - problem_.forms()[f].box.x0);
  }
  const Box& box = problem_.bins()[0].box;
  double end = widest + 0.5 * area / (box.y1 - box.y0);
  state.ends = {end};
  separator_.load(state);
  std::vector<std::uint32_t> order(items_.movable);
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return problem_.hull_area_of(items_.parts[a]) > problem_.hull_area_of(items_.parts[b]);
  });
  for (const std::uint32_t i : order) {
    Spot spot = separator_.state().spots[i];
    while (true) {
      spot.bin = 0;
      separator_.set_spot(i, spot);
      if (separator_.place_low(i, 200)) break;
      end += widest;
      separator_.set_end(0, end);
    }
  }
  best_ = separator_.state();
  length_ = reach_of(best_);
  best_.ends = {length_};
  start_shrunk(ratio_, false);
}

void StripLane::adopt(const State& best, double length) {
  best_ = best;
  length_ = length;
  pool_.clear();
  failures_ = 0;
  start_shrunk(ratio_, compressing_);
}

void StripLane::begin_separation() {
  separator_.forget_weights();
  least_overlap_ = strike_overlap_ = separator_.overlap();
  least_ = separator_.state();
  without_gain_ = strikes_ = 0;
}

void StripLane::start_shrunk(double ratio, bool random_split) {
  separator_.load(best_);
  const double end = length_ * (1 - ratio);
  const double split = random_split ? separator_.random().uniform(0, length_) : 0.5 * length_;
  for (std::size_t i = 0; i < items_.movable; ++i) {
    Spot spot = separator_.state().spots[i];
    const Box& b = problem_.forms()[spot.form].box;
    if (spot.x + 0.5 * (b.x0 + b.x1) > split) {
      spot.x -= length_ - end;
      separator_.set_spot(i, spot);
    }
  }
  separator_.set_end(0, end);
  begin_separation();
}

void StripLane::start_disrupted() {
  Random& random = separator_.random();
  std::stable_sort(pool_.begin(), pool_.end(),
                   [](const Failed& a, const Failed& b) { return a.overlap < b.overlap; });
  const auto pick = static_cast<std::size_t>(
      std::min(0.999, std::abs(0.25 * about_normal(random))) * static_cast<double>(pool_.size()));
  const double end = separator_.state().ends[0];
  separator_.load(pool_[pick].state);
  separator_.set_end(0, end);
  if (large_.size() < 2) return begin_separation();
  const std::uint32_t a = large_[random.below(large_.size())];
  std::uint32_t b = a;
  for (int tries = 0; tries < 50 && items_.parts[b] == items_.parts[a]; ++tries)
    b = large_[random.below(large_.size())];
  if (items_.parts[a] == items_.parts[b]) return begin_separation();
  const State& state = separator_.state();
  const auto middle = [&](std::uint32_t i) {
    const Spot& s = state.spots[i];
    const Box& box = problem_.forms()[s.form].box;
    return geom::Point{s.x + 0.5 * (box.x0 + box.x1), s.y + 0.5 * (box.y0 + box.y1)};
  };
  const geom::Point at_a = middle(a), at_b = middle(b), way = at_b - at_a;
  const auto inside = [&](std::uint32_t i, std::uint32_t of) {
    const Spot& s = state.spots[of];
    const Box& box = problem_.forms()[s.form].box;
    const geom::Point m = middle(i);
    return m.x > s.x + box.x0 && m.x < s.x + box.x1 && m.y > s.y + box.y0 && m.y < s.y + box.y1 &&
           problem_.hull_area_of(items_.parts[i]) < 0.5 * problem_.hull_area_of(items_.parts[of]);
  };
  std::vector<std::pair<std::uint32_t, geom::Point>> moves = {{a, way}, {b, -way}};
  for (std::uint32_t i = 0; i < items_.movable; ++i) {
    if (i == a || i == b) continue;
    if (inside(i, a))
      moves.emplace_back(i, way);
    else if (inside(i, b))
      moves.emplace_back(i, -way);
  }
  for (const auto& [i, by] : moves) {
    Spot s = state.spots[i];
    s.x += by.x;
    s.y += by.y;
    separator_.set_spot(i, s);
  }
  separator_.set_end(0, end);
  begin_separation();
}

void StripLane::on_valid() {
  best_ = separator_.state();
  length_ = reach_of(best_);
  best_.ends = {length_};
  pool_.clear();
  failures_ = 0;
  start_shrunk(ratio_, compressing_);
}

void StripLane::on_stuck() {
  ++failures_;
  if (compressing_) {
    ratio_ *= 0.85;
    if (ratio_ < kCompressTo) {
      compressing_ = false;
      ratio_ = kExploreShrink;
      pool_.clear();
      failures_ = 0;
    }
    return start_shrunk(ratio_, compressing_);
  }
  if (ratio_ > kExploreShrink) {  // too much at once
    ratio_ = std::max(kExploreShrink, 0.5 * ratio_);
    failures_ = 0;
    return start_shrunk(ratio_, false);
  }
  pool_.push_back({least_, least_overlap_});
  if (failures_ >= kFailuresToCompress) {
    compressing_ = true;
    ratio_ = kCompressFrom;
    failures_ = 0;
    pool_.clear();
    return start_shrunk(ratio_, true);
  }
  start_disrupted();
}

void StripLane::step() {
  ++passes_;
  const double overlap = separator_.pass();
  if (overlap <= 0) return on_valid();
  const int patience = compressing_ ? kCompressPatience : ratio_ > kExploreShrink ? 50 : kExplorePatience;
  const int most_strikes = compressing_ ? kCompressStrikes : ratio_ > kExploreShrink ? 1 : kExploreStrikes;
  if (overlap < 0.98 * strike_overlap_) {
    strike_overlap_ = overlap;
    without_gain_ = 0;
  } else {
    ++without_gain_;
  }
  if (overlap < least_overlap_) {
    least_overlap_ = overlap;
    least_ = separator_.state();
  }
  if (without_gain_ < patience) return;
  without_gain_ = 0;
  strike_overlap_ = least_overlap_;
  if (++strikes_ >= most_strikes) return on_stuck();
  const double end = separator_.state().ends[0];
  separator_.load(least_);
  separator_.set_end(0, end);
  separator_.overlap();
}

void StripLane::run(std::uint64_t work) {
  const std::uint64_t until = separator_.work() + work;
  while (separator_.work() < until) step();
}

}  // namespace lekalo::nest

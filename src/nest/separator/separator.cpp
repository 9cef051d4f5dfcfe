#include "separator.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/stop.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {

namespace {
constexpr double kFar = std::numeric_limits<double>::infinity();
}  // namespace

Separator::Separator(const Problem& problem, const Items& items, Random random)
    : problem_(problem), items_(items), random_(random), total_(items.total()), list_(items.total()) {
  weights_.assign(items_.movable() * total_, 1);
  in_conflict_.assign(total_, 0);
  boxes_.resize(total_);
  for (const std::uint32_t part : items_.parts) unit_ += std::sqrt(problem_.hull_area_of(part));
  unit_ /= static_cast<double>(items_.movable());
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    const Box& b = problem_.forms()[items_.forms[i].first].box;
    size_.push_back(std::sqrt(problem_.hull_area_of(items_.parts[i])) / unit_);
    min_dim_.push_back(std::min(b.x1 - b.x0, b.y1 - b.y0));
  }
  size_.resize(total_, 1);
  for (const double size : size_) root_.push_back(std::sqrt(size));
  if (total_ > tuning::kManyItems) {
    std::vector<Box> bins;
    for (const Bin& bin : problem_.bins()) bins.push_back(bin.box);
    cells_.emplace(total_, std::move(bins), unit_);
  }
  use_lattice(0);
}

void Separator::load(const State& state) {
  state_ = state;
  for (std::size_t i = 0; i < total_; ++i) set_spot(i, state_.spots[i]);
}

void Separator::set_spot(std::size_t i, const Spot& spot) {
  state_.spots[i] = spot;
  boxes_[i] = problem_.forms()[spot.form].box.at(spot.x, spot.y);
  const auto item = static_cast<std::uint32_t>(i);
  if (cells_)
    cells_->set(item, spot.bin, boxes_[i]);
  else
    list_.set(item, spot.bin, boxes_[i]);
}

void Separator::set_limits(std::uint32_t bin, double x1, double y1) {
  state_.ends[bin] = x1;
  state_.tops[bin] = y1;
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    Spot spot = state_.spots[i];
    if (spot.bin != bin) continue;
    Range r = range_of(spot.form, bin, items_.parts[i]);
    if (r.is_empty()) {  // the item may be narrower at another angle
      const Forms& forms = items_.forms[i];
      for (std::uint32_t f = forms.first; f < forms.last; ++f) {
        const Range other = range_of(f, bin, items_.parts[i]);
        if (other.is_empty()) continue;
        spot.form = f;
        r = other;
        break;
      }
    }
    set_spot(i, r.clamped(spot, spot.x, spot.y));
  }
}

double Separator::value_of(std::size_t i, std::size_t j, double depth, double area) const noexcept {
  return cost_of(depth, area) * root_[i] * root_[j];
}

double Separator::cost_of(double depth, double area) const noexcept {
  return (depth + tuning::kAreaShare * std::sqrt(area)) / unit_ + tuning::kLeastValue;
}

double Separator::area_of(const Spot& a, const Spot& b) const {
  return problem_.common_area(problem_.forms()[a.form], problem_.forms()[b.form], b.x - a.x, b.y - a.y);
}

double too_far_from_partner(const Problem& problem, const Items& items, const State& state, std::size_t i,
                            const Spot& spot) {
  if (items.partners.empty() || items.partners[i] == kNowhere) return 0;
  const Spot& other = state.spots[items.partners[i]];
  if (other.bin == kNowhere) return 0;
  const Box &a = problem.forms()[spot.form].box, &b = problem.forms()[other.form].box;
  const double dx = spot.x - other.x + 0.5 * (a.x0 + a.x1 - b.x0 - b.x1),
               dy = spot.y - other.y + 0.5 * (a.y0 + a.y1 - b.y0 - b.y1);
  // A piece on another sheet counts as further away than anywhere on the partner's.
  const Box& sheet = problem.bins()[other.bin].box;
  if (spot.bin != other.bin) return std::hypot(sheet.x1 - sheet.x0, sheet.y1 - sheet.y0);
  return std::max(0.0, std::hypot(dx, dy) - items.pair_reach);
}

double Separator::distance_too_far(std::size_t i, const Spot& spot) const {
  return too_far_from_partner(problem_, items_, state_, i, spot);
}

void Separator::forget_weights() {
  for (const std::size_t k : raised_) weights_[k] = 1.0f;
  raised_.clear();
}

Separator::Range Separator::range_of(std::uint32_t form, std::uint32_t bin, std::uint32_t part) const {
  if (!problem_.follows_grain(form, bin)) return {1, 0, 1, 0};
  const Box& b = problem_.forms()[form].box;
  const Box& in = problem_.bins()[bin].box;
  const double gap = problem_.border_gap_of(part);
  Range r = {in.x0 + gap - b.x0, state_.ends[bin] - gap - b.x1, in.y0 + gap - b.y0,
             state_.tops[bin] - gap - b.y1};
  // An item that fits exactly fits, and rounding must not decide otherwise.
  if (r.x1 < r.x0 && r.x0 - r.x1 < 1e-6) r.x0 = r.x1 = 0.5 * (r.x0 + r.x1);
  if (r.y1 < r.y0 && r.y0 - r.y1 < 1e-6) r.y0 = r.y1 = 0.5 * (r.y0 + r.y1);
  return r;
}

void Separator::gather(const Box& box, std::uint32_t bin, std::size_t but) {
  const double gap = problem_.widest_gap();
  const double x0 = box.x0 - gap, x1 = box.x1 + gap, y0 = box.y0 - gap, y1 = box.y1 + gap;
  if (cells_)
    cells_->find(bin, {x0, y0, x1, y1}, near_);
  else
    list_.find(bin, {x0, y0, x1, y1}, near_);
  std::size_t count = 0;
  for (const std::uint32_t j : near_) {
    near_[count] = j;
    const Box& b = boxes_[j];
    count += static_cast<std::size_t>((b.x0 < x1) & (b.x1 > x0) & (b.y0 < y1) & (b.y1 > y0) & (j != but));
  }
  near_.resize(count);
}

/// The weighted cost of item i there, with the items gathered around; it ends early above the limit.
double Separator::evaluate(std::size_t i, const Spot& spot, double limit) {
  ++work_;
  ask();
  const Form& form = problem_.forms()[spot.form];
  const Box around = form.box.at(spot.x, spot.y, problem_.widest_gap());
  double sum = 0;
  const float* weights = &weights_[i * total_];
  if (const double far = distance_too_far(i, spot); far > 0) {
    const std::uint32_t partner = items_.partners[i];
    sum = static_cast<double>(weights[partner]) * value_of(i, partner, far, 0);
    if (sum >= limit) return sum;
  }
  for (const std::uint32_t j : near_) {
    if (!boxes_[j].meets(around)) continue;
    const Spot& other = state_.spots[j];
    const double depth =
        problem_.depth(form, problem_.forms()[other.form], other.x - spot.x, other.y - spot.y);
    if (depth > 0) {
      sum += static_cast<double>(weights[j]) * value_of(i, j, depth, area_of(spot, other));
      if (sum >= limit) return sum;
    }
  }
  return sum;
}

double Separator::evaluate_all(std::size_t i, const Spot& spot, double limit) {
  gather(problem_.forms()[spot.form].box.at(spot.x, spot.y), spot.bin, i);
  return evaluate(i, spot, limit);
}

void Separator::descend(std::size_t i, Candidate& best, double step, double until) {
  const Range r = range_of(best.spot.form, best.spot.bin, items_.parts[i]);
  const Box& b = problem_.forms()[best.spot.form].box;
  double reach = 3 * step;
  double ax = best.spot.x, ay = best.spot.y;
  const auto gather_here = [&] {
    ax = best.spot.x;
    ay = best.spot.y;
    gather(b.at(ax, ay, reach), best.spot.bin, i);
  };
  gather_here();
  double sx = step, sy = step;
  while (best.loss > 0 && (sx > until || sy > until)) {
    const std::uint64_t axis = random_.below(4);
    const double dx = axis == 1 ? 0 : axis == 0 ? sx : 0.7071 * sx;
    const double dy = axis == 0 ? 0 : axis == 1 ? sy : axis == 2 ? 0.7071 * sy : -0.7071 * sy;
    bool better = false;
    for (const double sign : {1.0, -1.0}) {
      const Spot spot = r.clamped(best.spot, best.spot.x + sign * dx, best.spot.y + sign * dy);
      const double loss = evaluate(i, spot, best.loss);
      if (loss < best.loss) {
        best.loss = loss;
        best.spot = spot;
        better = true;
        break;
      }
    }
    const double factor = better ? tuning::kStepGrowth : tuning::kStepShrink;
    if (axis == 0) {
      sx *= factor;
    } else if (axis == 1) {
      sy *= factor;
    } else {
      const double half = better ? 1.05 : 0.7071;
      sx *= half;
      sy *= half;
    }
    if (std::abs(best.spot.x - ax) + sx > reach || std::abs(best.spot.y - ay) + sy > reach) {
      reach = std::max(reach, 2 * std::max(sx, sy));
      gather_here();
    }
  }
}

/// Pushes item i out along the depths that are left, one after the other. That ends exactly in the corner
/// between two neighbours, which a descent by steps never reaches.
void Separator::push_out(std::size_t i, Candidate& best) {
  const Range r = range_of(best.spot.form, best.spot.bin, items_.parts[i]);
  Spot spot = best.spot;
  const Form& form = problem_.forms()[spot.form];
  for (int round = 0; round < tuning::kPushRounds && best.loss > 0; ++round) {
    for (const std::uint32_t j : near_) {
      if (!boxes_[j].meets(form.box.at(spot.x, spot.y, problem_.widest_gap()))) continue;
      const Spot& other = state_.spots[j];
      const NoFit::Way way =
          problem_.way_out(problem_.forms()[other.form], form, spot.x - other.x, spot.y - other.y);
      if (way.depth <= 0) continue;
      const double by = way.depth + 0.25 * kTolerance;
      spot = r.clamped(spot, spot.x + by * way.direction.x, spot.y + by * way.direction.y);
    }
    const double loss = evaluate(i, spot, best.loss);
    if (loss < best.loss) {
      best.loss = loss;
      best.spot = spot;
    } else if (round >= tuning::kLeastPushRounds) {
      break;
    }
  }
}

void Separator::Choice::offer(const Candidate& candidate) {
  if (candidate.loss >= worst()) return;
  std::size_t at = count < kMost ? count++ : kMost - 1;
  for (; at > 0 && candidate.loss < places[at - 1].loss; --at) places[at] = places[at - 1];
  places[at] = candidate;
}

std::uint32_t Separator::any_form(std::size_t i) {
  const Forms& forms = items_.forms[i];
  return forms.first + static_cast<std::uint32_t>(random_.below(forms.last - forms.first));
}

std::uint32_t Separator::any_bin() {
  return state_.open_bins.size() == 1 ? state_.open_bins[0]
                                      : state_.open_bins[random_.below(state_.open_bins.size())];
}

/// Moves one item to a cheaper place (nest.md, step 2).
void Separator::move(std::size_t i) {
  if (lattice_ > 0) return move_on_lattice(i);
  const std::uint32_t part = items_.parts[i];
  const Spot now = state_.spots[i];
  const Candidate current{now, evaluate_all(i, now, kFar)};
  if (current.loss <= 0) return;
  Candidate best = current;
  const auto offer = [&](const Candidate& c) {
    if (c.loss < best.loss) best = c;
  };
  const Box& size = problem_.forms()[now.form].box;
  const double w = size.x1 - size.x0, h = size.y1 - size.y0;
  gather({now.x + size.x0 - w, now.y + size.y0 - h, now.x + size.x1 + w, now.y + size.y1 + h}, now.bin, i);
  for (int k = 0; k < tuning::kFocused; ++k) {
    Spot spot = now;
    spot.form = any_form(i);
    const Range r = range_of(spot.form, spot.bin, part);
    if (r.is_empty()) continue;
    const Box& b = problem_.forms()[spot.form].box;
    // In another form the middle of the box stays where it was, or near it.
    const double cx = now.x + 0.5 * (size.x0 + size.x1), cy = now.y + 0.5 * (size.y0 + size.y1);
    spot.x = cx - 0.5 * (b.x0 + b.x1) + random_.uniform(-0.5, 0.5) * w;
    spot.y = cy - 0.5 * (b.y0 + b.y1) + random_.uniform(-0.5, 0.5) * h;
    spot = r.clamped(spot, spot.x, spot.y);
    offer({spot, evaluate_all(i, spot, best.loss)});
  }
  const double scale = min_dim_[i];
  // The places of step 3, or random ones where there is no grid; then down to the nearest hollow, and out.
  if (grid_) {
    Choice choice;
    choose_on_grid(i, any_bin(), choice);
    choice.offer(best);
    for (std::size_t k = 0; k < choice.count; ++k) {
      descend(i, choice.places[k], tuning::kFirstStep * scale, tuning::kCoarseStep * scale);
      offer(choice.places[k]);
    }
  } else {
    for (int k = 0; k < tuning::kAnywhere; ++k) {
      Spot spot;
      spot.form = any_form(i);
      spot.bin = any_bin();
      const Range r = range_of(spot.form, spot.bin, part);
      if (r.is_empty()) continue;
      spot.x = random_.uniform(r.x0, r.x1);
      spot.y = random_.uniform(r.y0, r.y1);
      offer({spot, evaluate_all(i, spot, best.loss)});
    }
    descend(i, best, tuning::kFirstStep * scale, tuning::kCoarseStep * scale);
  }
  descend(i, best, 0.5 * tuning::kCoarseStep * scale, tuning::kFineStep * scale);
  push_out(i, best);
  if (best.loss < current.loss) set_spot(i, best.spot);
}

double Separator::overlap() {
  conflicts_.clear();
  deepest_ = 0;
  std::fill(in_conflict_.begin(), in_conflict_.end(), 0);
  double sum = 0;
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    ask();
    if (state_.spots[i].bin == kNowhere) continue;
    gather(boxes_[i], state_.spots[i].bin, i);
    const Spot& spot = state_.spots[i];
    if (const double far = distance_too_far(i, spot); far > kTolerance && items_.partners[i] > i) {
      conflicts_.push_back({static_cast<std::uint32_t>(i), items_.partners[i], far});
      in_conflict_[i] = in_conflict_[items_.partners[i]] = 1;
      sum += far;
      deepest_ = std::max(deepest_, far);
    }
    for (const std::uint32_t j : near_) {
      if (j < i) continue;
      const Spot& other = state_.spots[j];
      const double depth = problem_.depth(problem_.forms()[spot.form], problem_.forms()[other.form],
                                          other.x - spot.x, other.y - spot.y);
      if (depth <= kTolerance) continue;
      conflicts_.push_back({static_cast<std::uint32_t>(i), j, depth});
      in_conflict_[i] = in_conflict_[j] = 1;
      sum += depth;
      deepest_ = std::max(deepest_, depth);
    }
  }
  return sum;
}

bool Separator::is_in_conflict(std::size_t i) { return in_conflict_[i] != 0; }

bool Separator::snap(double unit) {
  const std::vector<Spot> before = state_.spots;
  bool fits = true;
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    Spot spot = before[i];
    if (spot.bin == kNowhere) continue;
    spot.x = std::round(spot.x / unit) * unit;
    spot.y = std::round(spot.y / unit) * unit;
    const Range r = range_of(spot.form, spot.bin, items_.parts[i]);
    fits = fits && spot.x >= r.x0 - kTolerance && spot.x <= r.x1 + kTolerance &&
           spot.y >= r.y0 - kTolerance && spot.y <= r.y1 + kTolerance;
    set_spot(i, spot);
  }
  if (fits && overlap() <= 0) return true;
  for (std::size_t i = 0; i < items_.movable(); ++i) set_spot(i, before[i]);
  overlap();
  return false;
}

/// nest.md, step 2.
double Separator::pass() {
  ++work_;
  if (conflicts_.empty() && overlap() <= 0) return 0;
  order_.clear();
  for (std::uint32_t i = 0; i < items_.movable(); ++i)
    if (in_conflict_[i]) order_.push_back(i);
  for (std::size_t k = order_.size(); k > 1; --k) std::swap(order_[k - 1], order_[random_.below(k)]);
  for (const std::uint32_t i : order_) move(i);
  const double sum = overlap();
  double most = 0;
  for (Conflict& c : conflicts_) {
    c.depth = value_of(c.a, c.b, c.depth, area_of(state_.spots[c.a], state_.spots[c.b]));
    most = std::max(most, c.depth);
  }
  std::erase_if(raised_, [&](std::size_t k) {
    weights_[k] = std::max(1.0f, static_cast<float>(tuning::kDecay) * weights_[k]);
    return weights_[k] == 1.0f;
  });
  for (const Conflict& c : conflicts_) {
    const float factor = static_cast<float>(
        (tuning::kLeastGrowth + (tuning::kMostGrowth - tuning::kLeastGrowth) * c.depth / most) /
        tuning::kDecay);
    const auto raise = [&](std::size_t i, std::size_t j) {
      float& w = weight(i, j);
      if (w == 1.0f) raised_.push_back(i * total_ + j);
      w = std::min(1e12f, w * factor);
    };
    raise(c.a, c.b);
    if (c.b < items_.movable()) raise(c.b, c.a);
  }
  return sum;
}

double Separator::least_side(std::uint32_t bin, int axis) const {
  const Box& in = problem_.bins()[bin].box;
  double least = 0;
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    if (state_.spots[i].bin != bin) continue;
    const std::uint32_t part = items_.parts[i];
    const double gap = 2 * problem_.border_gap_of(part);
    double narrowest = kFar;
    const Forms& forms = items_.forms[i];
    for (std::uint32_t f = forms.first; f < forms.last; ++f) {
      const Box& b = problem_.forms()[f].box;
      const double w = b.x1 - b.x0 + gap, h = b.y1 - b.y0 + gap;
      if (w <= in.x1 - in.x0 + 1e-6 && h <= in.y1 - in.y0 + 1e-6)
        narrowest = std::min(narrowest, axis == 0 ? w : h);
    }
    least = std::max(least, narrowest);
  }
  return least;
}

void Separator::put_anywhere(std::size_t i) {
  const std::uint32_t part = items_.parts[i];
  for (int tries = 0; tries < tuning::kPlaceTries; ++tries) {
    Spot spot;
    spot.form = any_form(i);
    spot.bin = state_.open_bins[random_.below(state_.open_bins.size())];
    const Range r = range_of(spot.form, spot.bin, part);
    if (r.is_empty()) continue;
    spot.x = random_.uniform(r.x0, r.x1);
    spot.y = random_.uniform(r.y0, r.y1);
    return set_spot(i, spot);
  }
}

void Separator::put_near(std::size_t i, std::uint32_t bin, geom::Point at) {
  Choice choice;
  for (int k = 0; k < tuning::kNear; ++k) {
    Spot spot;
    spot.form = any_form(i);
    spot.bin = bin;
    const Range r = range_of(spot.form, spot.bin, items_.parts[i]);
    if (r.is_empty()) continue;
    const Box& b = problem_.forms()[spot.form].box;
    const double far = size_[i] * unit_;
    spot.x = std::clamp(at.x - 0.5 * (b.x0 + b.x1) + random_.uniform(-far, far), r.x0, r.x1);
    spot.y = std::clamp(at.y - 0.5 * (b.y0 + b.y1) + random_.uniform(-far, far), r.y0, r.y1);
    choice.offer({spot, evaluate_all(i, spot, choice.worst())});
  }
  if (choice.count == 0) return put_anywhere(i);
  for (std::size_t k = 0; k < choice.count; ++k)
    descend(i, choice.places[k], tuning::kFirstStep * min_dim_[i], tuning::kCoarseStep * min_dim_[i]);
  const auto cheaper = [](const Candidate& a, const Candidate& b) { return a.loss < b.loss; };
  set_spot(i, std::min_element(choice.places.begin(),
                               choice.places.begin() + static_cast<std::ptrdiff_t>(choice.count), cheaper)
                  ->spot);
}

}  // namespace lekalo::nest

#include "box.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::nest {

bool SmallerBox::is_across(const Search& search) const {
  return search.problem.remnant() != Remnant::corner && !search.problem.bins()[bin_].open;
}

BoxSize SmallerBox::size_of(const Search& search, const State& state) const {
  if (is_across(search)) return box_in_use(search.problem, search.items, state, bin_);
  return {reach_of(search.problem, search.items, state, bin_, 0),
          reach_of(search.problem, search.items, state, bin_, 1)};
}

bool SmallerBox::begin(Search& search) {
  const State& best = search.best.state;
  bin_ = emptiest(search.problem, search.items, best);
  smaller_ = tuning::kFirstSmaller;
  failures_ = 0;
  // The first turn goes on from what there is, later ones with other proportions.
  is_kick_ = search.turns > 1 && !search.problem.bins()[bin_].open;
  const bool can_be_smaller = size_of(search, best).area() * (1 - tuning::kLastSmaller) >
                              used_area(search.problem, search.items, best, bin_) / tuning::kFullest;
  // Pieces that are missing and sheets that may be saved need these turns too: others come only after them.
  return can_be_smaller || best.open_bins.size() > 1 || !search.nowhere(best).empty();
}

/// nest-sheets.md, step 6.
BoxSize SmallerBox::wanted(Search& search, BoxSize now) const {
  Random& random = search.random();
  const Bin& bin = search.problem.bins()[bin_];
  const double used = used_area(search.problem, search.items, search.current.state, bin_);
  const BoxSize most = {bin.box.x1 - bin.box.x0, bin.box.y1 - bin.box.y0};
  BoxSize least = {std::max(search.separator.least_side(bin_, 0), bin.locked_reach - bin.box.x0),
                   std::max(search.separator.least_side(bin_, 1), bin.locked_top - bin.box.y0)};
  if (bin.open) {
    least.w = std::max(least.w, used / most.h);
    return {std::max(least.w, now.w * (1 - smaller_)), most.h};
  }
  if (is_across(search)) return wanted_across(search, now, least, most);
  double area = std::max(now.area() * (1 - smaller_), used / tuning::kFullest);
  BoxSize size;
  if (is_kick_) {
    area = now.area() * (1 + tuning::kKickRoom);
    const double low = std::log(std::max(least.w, area / most.h)),
                 high = std::log(std::min(most.w, area / least.h));
    size.w = low < high ? std::exp(random.uniform(low, high)) : now.w;
  } else {
    // Along one side, along the other, or both with another proportion.
    const double log_ratio = std::log(area / now.area());
    const std::uint64_t way = random.below(4);
    const double share = way == 0 ? 1 : way == 1 ? 0 : random.uniform(-1, 2);
    size.w = now.w * std::exp(share * log_ratio);
  }
  size.h = area / size.w;
  // The other side has to do what one cannot.
  if (size.w < least.w || size.w > most.w) {
    size.w = std::clamp(size.w, std::min(least.w, most.w), most.w);
    size.h = area / size.w;
  }
  if (size.h < least.h || size.h > most.h) {
    size.h = std::clamp(size.h, std::min(least.h, most.h), most.h);
    size.w = std::clamp(area / size.h, std::min(least.w, most.w), most.w);
  }
  return size;
}

BoxSize SmallerBox::wanted_across(Search& search, BoxSize now, BoxSize least, BoxSize most) const {
  const double used = used_area(search.problem, search.items, search.current.state, bin_);
  const double area = is_kick_ ? now.area() * (1 + tuning::kKickRoom)
                               : std::max(now.area() * (1 - smaller_), used / tuning::kFullest);
  bool along_x = now.h == most.h;
  // A kick may turn the cut, where either side will do.
  if (is_kick_ && search.problem.remnant() == Remnant::rectangle) along_x = search.random().below(2) == 0;
  return along_x ? BoxSize{std::clamp(area / most.h, std::min(least.w, most.w), most.w), most.h}
                 : BoxSize{most.w, std::clamp(area / most.w, std::min(least.h, most.h), most.h)};
}

Outcome SmallerBox::attempt(Search& search) {
  Separator& separator = search.separator;
  separator.load(search.current.state);
  const BoxSize now = size_of(search, search.current.state), size = wanted(search, now);
  if (!is_kick_ && size.area() >= now.area() * (1 - 1e-12)) return Outcome::failed;
  const Box& stock = search.problem.bins()[bin_].box;
  for (std::size_t i = 0; i < search.items.movable(); ++i) {
    Spot spot = separator.state().spots[i];
    if (spot.bin != bin_) continue;
    // Middles of the items keep their share of the way.
    const Box& b = search.problem.forms()[spot.form].box;
    const double mx = 0.5 * (b.x0 + b.x1), my = 0.5 * (b.y0 + b.y1);
    spot.x = stock.x0 + (spot.x + mx - stock.x0) * size.w / now.w - mx;
    spot.y = stock.y0 + (spot.y + my - stock.y0) * size.h / now.h - my;
    separator.set_spot(i, spot);
  }
  separator.set_limits(bin_, stock.x0 + size.w, stock.y0 + size.h);
  search.other_work += search.items.movable();  // an attempt looks at every item
  search.begin_separation();
  return Outcome::under_way;
}

Outcome SmallerBox::step(Search& search) {
  return search.after_pass(search.separator.pass(),
                           smaller_ > tuning::kFineBox ? tuning::kBoxPatience : tuning::kFineBoxPatience);
}

Outcome SmallerBox::on_valid(Search& search) {
  State state = search.separator.state();
  search.tidy(state);
  const Merit merit = search.merit_of(state);
  if (!is_kick_ && !(merit < search.current.merit)) return Outcome::failed;
  search.current = {std::move(state), merit};
  search.keep_if_best();
  failures_ = 0;
  is_kick_ = false;
  smaller_ = std::min(tuning::kMostSmaller, tuning::kSmallerGrowth * smaller_);
  // Another sheet may be the one used least now.
  bin_ = emptiest(search.problem, search.items, search.current.state);
  return Outcome::under_way;
}

Outcome SmallerBox::on_failure(Search& search) {
  ++failures_;
  if (is_kick_) return Outcome::over;
  const Box& stock = search.problem.bins()[bin_].box;
  const double behind = search.current.merit.reach - search.best.merit.reach;
  const double best_box = (stock.x1 - stock.x0) * (stock.y1 - stock.y0) + search.best.merit.reach;
  if (failures_ >= tuning::kFailuresToBox) {
    smaller_ *= 0.5;
    failures_ = 0;
  }
  // A kick that is far behind is not worth the last per mille.
  const bool is_hopeless = smaller_ < tuning::kKickPatience && behind > tuning::kKickEnd * best_box;
  return smaller_ < tuning::kLastSmaller || is_hopeless ? Outcome::over : Outcome::under_way;
}

}  // namespace lekalo::nest

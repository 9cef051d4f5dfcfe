#include "fill.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "kits.hpp"
#include "nest/exact/placer.hpp"

namespace lekalo::nest {
namespace {

/// True if no open bin has as much area left as the smallest piece that lies nowhere.
bool is_full(const Search& search) {
  constexpr double kRounding = 1e-12;  // areas that fill a bin add up to it in any order
  const Problem& problem = search.problem;
  const Items& items = search.items;
  const State& state = search.current.state;
  std::vector<double> left;
  for (const Bin& bin : problem.bins()) left.push_back(bin.area * (1 + kRounding));
  for (const Spot& spot : items.fixed)
    if (const Form& form = problem.forms()[spot.form]; problem.kind_of(form) == SearchShape::Kind::part)
      left[spot.bin] -= problem.area_of(problem.part_of(form));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < items.movable(); ++i) {
    const double area = problem.area_of(items.parts[i]);
    if (state.spots[i].bin == kNowhere)
      least = std::min(least, area);
    else
      left[state.spots[i].bin] -= area;
  }
  return std::none_of(state.open_bins.begin(), state.open_bins.end(),
                      [&](std::uint32_t bin) { return left[bin] >= least; });
}

/// Lets two items change places, so that the next attempt is another one.
void exchange(Search& search) {
  const Problem& problem = search.problem;
  Separator& separator = search.separator;
  const std::size_t n = search.items.movable();
  const auto a = static_cast<std::size_t>(search.random().below(n)),
             b = static_cast<std::size_t>(search.random().below(n));
  const Spot s = separator.state().spots[a], t = separator.state().spots[b];
  if (s.bin == kNowhere || t.bin == kNowhere || search.items.parts[a] == search.items.parts[b]) return;
  if (!problem.follows_grain(s.form, t.bin) || !problem.follows_grain(t.form, s.bin)) return;
  const geom::Point way = middle_of(problem, t) - middle_of(problem, s);
  separator.set_spot(a, {s.x + way.x, s.y + way.y, s.form, t.bin});
  separator.set_spot(b, {t.x - way.x, t.y - way.y, t.form, s.bin});
  for (const std::uint32_t bin : {s.bin, t.bin})
    separator.set_limits(bin, separator.state().ends[bin], separator.state().tops[bin]);
}

/// The state without items that overlap others, as few and as small as it goes.
State without_conflicts(Search& search, State state) {
  Separator& separator = search.separator;
  separator.load(state);
  while (separator.overlap() > 0) {
    std::size_t least = search.items.movable();
    double lowest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < search.items.movable(); ++i) {
      const double area = search.problem.area_of(search.items.parts[i]);
      if (!separator.is_in_conflict(i) || !(area < lowest)) continue;
      lowest = area;
      least = i;
    }
    if (least == search.items.movable()) break;
    state.spots[least].bin = kNowhere;
    separator.set_spot(least, state.spots[least]);
  }
  return state;
}

/// The state with missing pieces put where there is room as it is: even a rearrangement in vain may have
/// made some.
State refilled(Search& search, const State& state) {
  const Items& items = search.items;
  Placer placer(search.problem, items, Random(search.random().bits()));
  placer.load(state);
  // Pieces with partners are not alike: each has to lie near its own.
  const bool alike = items.partners.empty();
  std::set<std::pair<std::uint32_t, std::uint32_t>> full;  // bin, first form
  for (const std::uint32_t i : search.nowhere(state)) {
    for (const std::uint32_t bin : state.open_bins) {
      const std::pair key(bin, items.forms[i].first);
      if (full.contains(key)) continue;
      if (placer.place_low(i, bin, tuning::kRefillTries)) break;
      if (alike) full.insert(key);
    }
  }
  search.other_work += placer.work();
  return placer.state();
}

/// Goes on from a valid state that is no worse: as many pieces that lie otherwise make the next attempt
/// another one. True if it is better.
bool take(Search& search, State state) {
  constexpr double kRounding = 1e-12;  // areas are added up in another order
  search.tidy(state);
  const Merit merit = search.merit_of(state), &now = search.current.merit;
  const bool better = merit < now;
  if (!better && !(merit.missing <= now.missing && merit.unplaced <= now.unplaced * (1 + kRounding)))
    return false;
  // The stock that is being filled stays open.
  std::vector<std::uint32_t> open = std::move(search.current.state.open_bins);
  search.current = {std::move(state), merit};
  search.keep_if_best();
  search.current.state.open_bins = std::move(open);
  return better;
}

}  // namespace

bool Fill::begin(Search& search) {
  if (fuller_ != search.fuller) vain_turns_ = 0;
  fuller_ = search.fuller;
  const std::size_t missing = search.nowhere(search.best.state).size();
  // Pieces that find no place again and again do not keep the rest from getting better.
  if (missing == 0 || (vain_turns_ >= tuning::kVainFills && search.turns % tuning::kVainFills != 0 &&
                       !search.best.state.open_bins.empty()))
    return false;
  ++vain_turns_;
  auto& open = search.current.state.open_bins;
  for (std::uint32_t b = 0; b < search.problem.bins().size(); ++b)
    if (std::find(open.begin(), open.end(), b) == open.end()) open.push_back(b);
  begin_with(missing);
  return true;
}

void Fill::begin_with(std::size_t missing) {
  batch_ = 1 + missing / tuning::kFirstBatch;
  failures_ = 0;
}

Outcome Fill::attempt(Search& search) {
  rooms_.end();
  if (tries_rooms(search))
    rooms_.begin(search);
  else
    throw_in(search);
  return Outcome::under_way;
}

/// nest-sheets.md, step 3 while rooms are left, then step 4.
Outcome Fill::step(Search& search) {
  if (!rooms_.are_left()) return search.after_pass(search.separator.pass(), tuning::kFillPatience);
  if (rooms_.try_one(search)) {
    search.attempt.begin(0, search.separator.state());
    return Outcome::valid;
  }
  if (!rooms_.are_left()) throw_in(search);
  return Outcome::under_way;
}

/// nest-sheets.md, step 4.
void Fill::throw_in(Search& search) {
  search.separator.load(search.current.state);
  std::vector<std::uint32_t> missing = search.nowhere(search.current.state);
  if (failures_ > tuning::kFailuresToExchange && failures_ % 2 == 0) exchange(search);
  if (!throw_in_kits(search, missing)) {
    batch_ = std::clamp<std::size_t>(batch_, 1, missing.size());
    for (std::size_t k = 0; k < batch_; ++k) {
      const std::size_t pick = search.pick(missing.size());
      search.separator.put_anywhere(missing[pick]);
      missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(pick));
    }
  }
  search.other_work += search.items.movable();  // an attempt looks at every item
  search.begin_separation();
}

bool Fill::throw_in_kits(Search& search, const std::vector<std::uint32_t>& missing) {
  Random& random = search.random();
  if (search.problem.document().kits.empty()) return false;
  // A full sheet gains by other kits alone; every second attempt still exchanges pieces as usual.
  const bool needs_plan = failures_ % 2 == 0 && is_full(search);
  if (!needs_plan && random.below(4) == 0) return false;
  if (needs_plan || (failures_ > 0 && random.below(2) == 0)) {
    const std::vector<std::int64_t> kits = planned_kits(search);
    if (!kits.empty()) {
      replace_by(search, kits);
      return true;
    }
  }
  const std::vector<std::uint32_t> pieces = pieces_for_a_kit(search, missing);
  for (const std::uint32_t i : pieces) search.separator.put_anywhere(i);
  return !pieces.empty();
}

Outcome Fill::on_valid(Search& search) {
  if (!take(search, refilled(search, search.separator.state()))) return Outcome::failed;
  failures_ = 0;
  const std::size_t missing = search.nowhere(search.current.state).size();
  if (missing == 0) return Outcome::over;
  batch_ = std::min(2 * batch_, missing);
  return Outcome::under_way;
}

Outcome Fill::on_failure(Search& search) {
  ++failures_;
  if (take(search, refilled(search, without_conflicts(search, search.attempt.least())))) failures_ = 0;
  if (search.nowhere(search.current.state).empty()) return Outcome::over;
  batch_ = std::max<std::size_t>(1, batch_ / 2);
  return failures_ >= most_failures() ? Outcome::over : Outcome::under_way;
}

}  // namespace lekalo::nest

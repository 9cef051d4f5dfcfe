#include "sheet_lane.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "lekalo/layout/completeness.hpp"
#include "nest/exact/builder.hpp"

namespace lekalo::nest {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
/// Shares of a box's area.
constexpr double kFirstShrink = 0.05, kLastShrink = 0.001, kMostShrink = 0.1;
/// A new proportion begins with so much more than the best box, and is given up where it ends with so much.
constexpr double kKickRoom = 0.12, kKickEnd = 0.04;
constexpr Patience kFill = {60, 2}, kBox = {40, 2}, kFine = {80, 2};
/// Of the pieces that lie nowhere: the share that is thrown in first.
constexpr std::size_t kFirstBatch = 8;
constexpr int kFailuresToFill = 100, kFailuresToReduce = 30, kFailuresToBox = 3;
/// Materials fuller than this are not tried.
constexpr double kFullest = 0.97;
/// Goals in a row that left nothing to be tried.
constexpr int kVainAttempts = 1000;
/// Fillings in vain after which the others get their turns too.
constexpr int kVainFills = 3;
/// Plans made to find kits that are worth more, and the share of the stock that they may take beyond what is
/// used.
constexpr int kPlans = 8;
constexpr double kMoreRoom = 0.1;
/// Places tried, of a kind of piece on a bin, after a rearrangement.
constexpr std::size_t kRefillTries = 4000;
/// Rooms made before a rearrangement, and so many slides at most, that with thousands of pieces these take no
/// longer than it does; sweeps of a room, rounds of relaxing.
constexpr std::size_t kRooms = 30, kSlides = 16'000;
constexpr int kSweeps = 2, kRelaxRounds = 200;
/// One piece in so many may lack for rooms to be worth their time where less stock is tried.
constexpr std::size_t kFewMissing = 8;
/// Sums of areas in another order.
constexpr double kRounding = 1e-12;

}  // namespace

SheetLane::SheetLane(const Problem& problem, const Items& items, std::uint64_t seed, std::uint64_t stream)
    : problem_(problem),
      items_(items),
      separator_(problem, items, Random(seed, stream + 1)),
      by_size_(by_size(problem, items)) {}

double SheetLane::reach_of(const State& state, std::uint32_t b, int axis) const {
  const Bin& bin = problem_.bins()[b];
  double reach = axis == 0 ? bin.locked_reach - bin.box.x0 : bin.locked_top - bin.box.y0;
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    const Spot& spot = state.spots[i];
    if (spot.bin != b) continue;
    const Box& box = problem_.forms()[spot.form].box;
    const double gap = problem_.border_gap_of(items_.parts[i]);
    reach = std::max(reach, gap + (axis == 0 ? spot.x + box.x1 - bin.box.x0 : spot.y + box.y1 - bin.box.y0));
  }
  return std::max(0.0, reach);
}

double SheetLane::leftover_of(const State& state, std::uint32_t b) const {
  const Box& box = problem_.bins()[b].box;
  const double height = box.y1 - box.y0;
  return (box.x1 - box.x0) * height -
         reach_of(state, b, 0) * (problem_.bins()[b].open ? height : reach_of(state, b, 1));
}

std::uint32_t SheetLane::emptiest(const State& state) const {
  std::uint32_t found = state.open_bins.front();
  double most = -kFar;
  for (const std::uint32_t bin : state.open_bins) {
    const double leftover = leftover_of(state, bin);
    if (leftover > most) {
      most = leftover;
      found = bin;
    }
  }
  return found;
}

double SheetLane::used_area(const State& state, std::uint32_t bin) const {
  double area = 0;
  for (std::size_t i = 0; i < items_.movable(); ++i)
    if (state.spots[i].bin == bin) area += problem_.area_of(items_.parts[i]);
  return area;
}

std::vector<std::uint32_t> SheetLane::nowhere(const State& state) const {
  std::vector<std::uint32_t> items;
  for (const std::uint32_t i : by_size_)
    if (state.spots[i].bin == kNowhere) items.push_back(i);
  return items;
}

void SheetLane::tidy(State& state) const {
  for (std::uint32_t b = 0; b < state.ends.size(); ++b) {
    state.ends[b] = problem_.bins()[b].box.x1;
    state.tops[b] = problem_.bins()[b].box.y1;
  }
  std::vector<char> used(problem_.bins().size(), 0);
  for (std::size_t i = 0; i < items_.movable(); ++i)
    if (state.spots[i].bin != kNowhere) used[state.spots[i].bin] = 1;
  std::erase_if(state.open_bins,
                [&](std::uint32_t b) { return used[b] == 0 && !problem_.bins()[b].holds_locked; });
}

std::vector<layout::PieceCount> SheetLane::placed_pieces(const State& state) const {
  std::vector<layout::PieceCount> placed = problem_.locked_pieces();
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    const Spot& spot = state.spots[i];
    if (spot.bin == kNowhere) continue;
    layout::PieceCount& count = placed[items_.parts[i]];
    ++(problem_.forms()[spot.form].mirrored ? count.mirrored : count.upright);
  }
  return placed;
}

double SheetLane::missing_value(const State& state) const {
  const layout::Document& document = problem_.document();
  if (document.kits.empty()) return 0;
  const std::vector<std::int64_t> complete = layout::kits_made(document, placed_pieces(state)).complete;
  double missing = 0;
  for (std::size_t k = 0; k < complete.size(); ++k)
    missing += document.kits[k].value * static_cast<double>(document.kits[k].demand - complete[k]);
  return missing;
}

std::vector<std::uint32_t> SheetLane::pieces_for_a_kit(const State& state,
                                                       const std::vector<std::uint32_t>& missing) {
  const layout::Document& document = problem_.document();
  const layout::KitsMade made = layout::kits_made(document, placed_pieces(state));
  std::vector<std::uint32_t> best;
  double most = 0;
  for (std::uint32_t k = 0; k < document.kits.size(); ++k) {
    const layout::Kit& kit = document.kits[k];
    if (made.complete[k] >= kit.demand || kit.value <= 0) continue;
    std::vector<layout::PieceCount> left = made.left;
    std::vector<std::uint32_t> pieces;
    double area = 0;
    bool fine = true;
    for (const layout::KitPiece& piece : kit.pieces) {
      std::int64_t needed = piece.count;
      layout::PieceCount& there = left[piece.part];
      const auto use = [&](std::int64_t& of) {
        const std::int64_t taken = std::min(needed, of);
        of -= taken;
        needed -= taken;
      };
      if (!piece.mirrored || !*piece.mirrored) use(there.upright);
      if (!piece.mirrored || *piece.mirrored) use(there.mirrored);
      for (const std::uint32_t i : missing) {
        if (needed == 0) break;
        if (items_.parts[i] != piece.part || std::find(pieces.begin(), pieces.end(), i) != pieces.end())
          continue;
        const Forms hand = problem_.forms_of(piece.part, piece.mirrored);
        if (items_.forms[i].first < hand.first || items_.forms[i].last > hand.last) continue;
        pieces.push_back(i);
        area += problem_.area_of(piece.part);
        --needed;
      }
      fine = fine && needed == 0;
    }
    if (!fine || pieces.empty()) continue;
    const double rank = kit.value / area * separator_.random().uniform(0.5, 1);
    if (rank <= most) continue;
    most = rank;
    best = std::move(pieces);
  }
  return best;
}

std::vector<std::int64_t> SheetLane::planned_kits() {
  const layout::Document& document = problem_.document();
  Random& random = separator_.random();
  const State& state = separator_.state();
  const std::vector<std::int64_t> made = layout::kits_made(document, placed_pieces(state)).complete;
  double value_now = 0, stock = 0, used = 0;
  for (std::size_t k = 0; k < made.size(); ++k)
    value_now += document.kits[k].value * static_cast<double>(made[k]);
  for (const std::uint32_t bin : state.open_bins) stock += problem_.bins()[bin].area;
  const std::vector<layout::PieceCount> placed = placed_pieces(state);
  for (std::uint32_t p = 0; p < placed.size(); ++p)
    used += problem_.area_of(p) * static_cast<double>(placed[p].total());
  std::vector<double> areas(made.size(), 0);
  for (std::size_t k = 0; k < made.size(); ++k)
    for (const layout::KitPiece& piece : document.kits[k].pieces)
      areas[k] += problem_.area_of(piece.part) * static_cast<double>(piece.count);
  for (int tries = 0; tries < kPlans; ++tries) {
    // As full as it is, or somewhat more.
    const double room = std::min(stock, used + random.uniform(0, kMoreRoom) * stock) * (1 + kRounding);
    std::vector<std::int64_t> kits(made.size(), 0);
    double value = 0, area = 0;
    std::vector<std::size_t> order(kits.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
    if (tries % 2 == 0)
      std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return document.kits[a].value * areas[b] > document.kits[b].value * areas[a];
      });
    for (const std::size_t k : order)
      while (kits[k] < document.kits[k].demand && area + areas[k] <= room) {
        if (tries % 2 == 1 && random.below(4) == 0) break;
        ++kits[k];
        area += areas[k];
        value += document.kits[k].value;
      }
    if (value > value_now * (1 + kRounding)) return kits;
  }
  return {};
}

void SheetLane::replace_by(const std::vector<std::int64_t>& kits) {
  const layout::Document& document = problem_.document();
  const std::size_t n = items_.movable();
  std::vector<char> is_needed(n, 0);
  std::vector<layout::PieceCount> locked = problem_.locked_pieces();
  const auto first = static_cast<std::size_t>(separator_.random().below(n));
  for (const bool either : {false, true})
    for (std::size_t k = 0; k < kits.size(); ++k)
      for (const layout::KitPiece& piece : document.kits[k].pieces) {
        if (piece.mirrored.has_value() == either) continue;
        std::int64_t needed = kits[k] * piece.count;
        const auto use = [&](std::int64_t& of) {
          const std::int64_t taken = std::min(needed, of);
          of -= taken;
          needed -= taken;
        };
        if (!piece.mirrored || !*piece.mirrored) use(locked[piece.part].upright);
        if (!piece.mirrored || *piece.mirrored) use(locked[piece.part].mirrored);
        const Forms hand = problem_.forms_of(piece.part, piece.mirrored);
        for (const bool nowhere : {false, true})  // those that lie somewhere first
          for (std::size_t m = 0; m < n && needed > 0; ++m) {
            const std::size_t i = (first + m) % n;
            const Spot& spot = separator_.state().spots[i];
            if (is_needed[i] != 0 || items_.parts[i] != piece.part || (spot.bin == kNowhere) != nowhere)
              continue;
            const bool serves = nowhere
                                    ? items_.forms[i].first >= hand.first && items_.forms[i].last <= hand.last
                                    : spot.form >= hand.first && spot.form < hand.last;
            if (!serves) continue;
            is_needed[i] = 1;
            --needed;
          }
      }
  for (std::size_t i = 0; i < n; ++i) {
    Spot spot = separator_.state().spots[i];
    if (is_needed[i] != 0 && spot.bin == kNowhere) {
      separator_.put_anywhere(i);
    } else if (is_needed[i] == 0 && spot.bin != kNowhere) {
      spot.bin = kNowhere;
      separator_.set_spot(i, spot);
    }
  }
}

Merit SheetLane::merit_of(const State& state) const {
  Merit merit;
  merit.missing = missing_value(state);
  for (std::size_t i = 0; i < items_.movable(); ++i)
    if (state.spots[i].bin == kNowhere) {
      const int priority = problem_.document().parts[items_.parts[i]].priority;
      merit.unplaced += problem_.area_of(items_.parts[i]) * (1 + std::max(0, priority));
    }
  for (const std::uint32_t bin : state.open_bins)
    merit.cost += problem_.document().stocks[problem_.bins()[bin].stock].cost;
  if (!state.open_bins.empty()) merit.reach = -leftover_of(state, emptiest(state));
  return merit;
}

void SheetLane::go_on_from(const State& state) {
  best_.state = state;
  tidy(best_.state);
  best_.merit = merit_of(best_.state);
  rounds_ = reductions_ = vain_fills_ = 0;
  choose_goal();
  attempt();
}

/// In turns: pieces that lie nowhere, less stock, a smaller box. The first two only where there is hope.
void SheetLane::choose_goal() {
  current_ = best_;
  failures_ = 0;
  is_kick_ = false;
  goal_ = Goal::none;
  ++rounds_;
  const std::size_t missing = nowhere(best_.state).size();
  // What finds no place again and again does not keep the rest from getting better.
  if (missing > 0 &&
      (vain_fills_ < kVainFills || rounds_ % kVainFills == 0 || best_.state.open_bins.empty())) {
    ++vain_fills_;
    goal_ = Goal::fill;
    batch_ = 1 + missing / kFirstBatch;
    for (std::uint32_t b = 0; b < problem_.bins().size(); ++b) {
      auto& open = current_.state.open_bins;
      if (std::find(open.begin(), open.end(), b) == open.end()) open.push_back(b);
    }
    return;
  }
  // Again and again, but ever less often.
  if (reductions_ < 2 || rounds_ % (1 << std::min(reductions_, 6)) == 0) {
    ++reductions_;
    if (begin_reduction()) return;
  }
  if (begin_box() || missing > 0 || best_.state.open_bins.size() > 1) return;
  goal_ = Goal::none;
}

/// Does with stock that costs less: the most spacious, or all but one at random.
bool SheetLane::begin_reduction() {
  const auto& bins = problem_.bins();
  const auto& open = best_.state.open_bins;
  if (open.size() < 2) return false;
  const auto cost_of = [&](std::uint32_t b) { return problem_.document().stocks[bins[b].stock].cost; };
  std::vector<std::uint32_t> chosen;
  double cost = 0, room = 0;
  const auto choose = [&](std::uint32_t b) {
    chosen.push_back(b);
    cost += cost_of(b);
    room += bins[b].area;
  };
  for (std::uint32_t b = 0; b < bins.size(); ++b)
    if (bins[b].holds_locked) choose(b);
  double needed = 0;
  for (std::size_t i = 0; i < items_.movable(); ++i)
    if (best_.state.spots[i].bin != kNowhere) needed += problem_.area_of(items_.parts[i]);
  std::vector<std::uint32_t> order(bins.size());
  std::iota(order.begin(), order.end(), 0u);
  Random& random = separator_.random();
  // Spacious ones for their price first; where that was tried, by chance others.
  const double noise = reductions_ <= 1 ? 0 : 0.3;
  std::vector<double> rank;
  for (const std::uint32_t b : order)
    rank.push_back(bins[b].area / std::max(cost_of(b), 1e-9) * (1 + noise * random.uniform(-1, 1)));
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return rank[a] > rank[b]; });
  for (const std::uint32_t b : order) {
    if (bins[b].holds_locked || cost + cost_of(b) >= best_.merit.cost) continue;
    choose(b);
  }
  if (chosen.empty() || cost >= best_.merit.cost || needed > kFullest * room) return false;
  goal_ = Goal::reduce;
  current_.state.open_bins = chosen;
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    Spot& spot = current_.state.spots[i];
    if (std::find(chosen.begin(), chosen.end(), spot.bin) == chosen.end()) spot.bin = kNowhere;
  }
  current_.merit = merit_of(current_.state);
  batch_ = 1 + nowhere(current_.state).size() / kFirstBatch;
  return true;
}

/// \return whether the box can be smaller at all
bool SheetLane::begin_box() {
  goal_ = Goal::box;
  target_ = emptiest(best_.state);
  ratio_ = kFirstShrink;
  skew_ = 0;
  failures_ = 0;
  // The first round from what is there, then with other proportions.
  is_kick_ = rounds_ > 1 && !problem_.bins()[target_].open;
  const double width = reach_of(best_.state, target_, 0), height = reach_of(best_.state, target_, 1);
  return width * height * (1 - kLastShrink) > used_area(best_.state, target_) / kFullest;
}

void SheetLane::begin_separation() {
  ++attempts_;
  separator_.forget_weights();
  const double overlap = separator_.overlap();
  attempt_.begin(overlap, separator_.state());
}

void SheetLane::attempt() {
  rooms_left_ = 0;
  for (int vain = 0; goal_ != Goal::none && !separator_.is_stopped(); ++vain) {
    if (goal_ != Goal::box) return begin_rooms();
    if (attempt_box()) return;
    if (vain > kVainAttempts) {
      goal_ = Goal::none;
      return;
    }
    on_stuck();
  }
}

/// A filling: first in rooms made for one piece at a time, then by a rearrangement.
void SheetLane::begin_rooms() {
  if (goal_ == Goal::reduce && nowhere(current_.state).size() > items_.movable() / kFewMissing)
    return throw_in();
  rooms_left_ = std::clamp<std::size_t>(kSlides / (kSweeps * items_.movable()), 1, kRooms);
}

/// Slides what lies on a bin away from a point anywhere and puts a missing piece there, if all that overlaps
/// then can be shifted apart. Else everything stays as it was slid, which the next one begins with.
void SheetLane::try_room() {
  Random& random = separator_.random();
  --rooms_left_;
  separator_.load(current_.state);
  const auto& open = current_.state.open_bins;
  const std::uint32_t bin = open[random.below(open.size())];
  const Box& box = problem_.bins()[bin].box;
  const geom::Point at = {random.uniform(box.x0, box.x1), random.uniform(box.y0, box.y1)};
  for (int k = 0; k < kSweeps; ++k) separator_.make_room(bin, at);
  State slid = separator_.state();
  current_.state.spots = slid.spots;
  tidy(slid);
  if (!slid.open_bins.empty()) current_.merit.reach = -leftover_of(slid, emptiest(slid));
  const std::vector<std::uint32_t> missing = nowhere(current_.state);
  separator_.put_near(missing[any_of(missing)], bin, at);
  if (separator_.relax(kRelaxRounds)) {
    attempt_.begin(0, separator_.state());
    on_valid();
    return attempt();
  }
  if (rooms_left_ == 0) throw_in();
}

/// Mostly the first, which is the largest or the most wanted.
std::size_t SheetLane::any_of(const std::vector<std::uint32_t>& missing) {
  Random& random = separator_.random();
  return random.below(2) == 0 ? 0 : random.below(missing.size());
}

/// Missing pieces, a kit's or another plan's, wherever chance puts them; what overlaps then is to be
/// separated.
void SheetLane::throw_in() {
  Random& random = separator_.random();
  separator_.load(current_.state);
  std::vector<std::uint32_t> missing = nowhere(current_.state);
  if (failures_ > 2 && failures_ % 2 == 0) exchange();
  if (!problem_.document().kits.empty() && random.below(4) != 0) {
    if (failures_ > 0 && random.below(2) == 0) {
      const std::vector<std::int64_t> kits = planned_kits();
      if (!kits.empty()) {
        replace_by(kits);
        return begin_separation();
      }
    }
    const std::vector<std::uint32_t> pieces = pieces_for_a_kit(current_.state, missing);
    if (!pieces.empty()) {
      for (const std::uint32_t i : pieces) separator_.put_anywhere(i);
      return begin_separation();
    }
  }
  batch_ = std::clamp<std::size_t>(batch_, 1, missing.size());
  for (std::size_t k = 0; k < batch_; ++k) {
    const std::size_t pick = any_of(missing);
    separator_.put_anywhere(missing[pick]);
    missing.erase(missing.begin() + static_cast<std::ptrdiff_t>(pick));
  }
  begin_separation();
}

/// Two pieces change places, so that the next attempt is another one.
void SheetLane::exchange() {
  Random& random = separator_.random();
  const std::size_t n = items_.movable();
  const auto a = static_cast<std::size_t>(random.below(n)), b = static_cast<std::size_t>(random.below(n));
  const Spot s = separator_.state().spots[a], t = separator_.state().spots[b];
  if (s.bin == kNowhere || t.bin == kNowhere || items_.parts[a] == items_.parts[b]) return;
  if (!problem_.follows_grain(s.form, t.bin) || !problem_.follows_grain(t.form, s.bin)) return;
  const auto middle = [&](const Spot& spot) {
    const Box& box = problem_.forms()[spot.form].box;
    return geom::Point{spot.x + 0.5 * (box.x0 + box.x1), spot.y + 0.5 * (box.y0 + box.y1)};
  };
  const geom::Point way = middle(t) - middle(s);
  Spot to = s;
  to.x += way.x;
  to.y += way.y;
  to.bin = t.bin;
  separator_.set_spot(a, to);
  to = t;
  to.x -= way.x;
  to.y -= way.y;
  to.bin = s.bin;
  separator_.set_spot(b, to);
  for (const std::uint32_t bin : {s.bin, t.bin})
    separator_.set_limits(bin, separator_.state().ends[bin], separator_.state().tops[bin]);
}

bool SheetLane::attempt_box() {
  const Bin& bin = problem_.bins()[target_];
  Random& random = separator_.random();
  const State& from = current_.state;
  separator_.load(from);
  const double width = reach_of(from, target_, 0), height = reach_of(from, target_, 1);
  const double most_x = bin.box.x1 - bin.box.x0, most_y = bin.box.y1 - bin.box.y0;
  double least_x = std::max(separator_.least_side(target_, 0), bin.locked_reach - bin.box.x0);
  double least_y = std::max(separator_.least_side(target_, 1), bin.locked_top - bin.box.y0);
  double w = width, h = height;
  if (bin.open) {
    least_x = std::max(least_x, used_area(from, target_) / most_y);
    w = std::max(least_x, width * (1 - ratio_));
    h = most_y;
  } else {
    const double used = used_area(from, target_);
    double area = std::max(width * height * (1 - ratio_), used / kFullest);
    if (is_kick_) {
      area = width * height * (1 + kKickRoom);
      const double low = std::log(std::max(least_x, area / most_y)),
                   high = std::log(std::min(most_x, area / least_y));
      w = low < high ? std::exp(random.uniform(low, high)) : width;
      h = area / w;
    } else {
      // Along one side, along the other, or both with another proportion.
      const double log_ratio = std::log(area / (width * height));
      const std::uint64_t way = random.below(4);
      const double share = way == 0 ? 1 : way == 1 ? 0 : random.uniform(-1, 2);
      w = width * std::exp(share * log_ratio);
      h = area / w;
    }
    // What one side cannot do the other has to.
    if (w < least_x || w > most_x) {
      w = std::clamp(w, std::min(least_x, most_x), most_x);
      h = area / w;
    }
    if (h < least_y || h > most_y) {
      h = std::clamp(h, std::min(least_y, most_y), most_y);
      w = std::clamp(area / h, std::min(least_x, most_x), most_x);
    }
  }
  if (!is_kick_ && w * h >= width * height * (1 - 1e-12)) return false;
  for (std::size_t i = 0; i < items_.movable(); ++i) {
    Spot spot = separator_.state().spots[i];
    if (spot.bin != target_) continue;
    // Middles of the boxes keep their share of the way.
    const Box& b = problem_.forms()[spot.form].box;
    const double mx = 0.5 * (b.x0 + b.x1), my = 0.5 * (b.y0 + b.y1);
    spot.x = bin.box.x0 + (spot.x + mx - bin.box.x0) * w / width - mx;
    spot.y = bin.box.y0 + (spot.y + my - bin.box.y0) * h / height - my;
    separator_.set_spot(i, spot);
  }
  separator_.set_limits(target_, bin.box.x0 + w, bin.box.y0 + h);
  begin_separation();
  return true;
}

void SheetLane::keep_if_best() {
  if (!(current_.merit < best_.merit)) return;
  if (current_.merit.cost < best_.merit.cost) reductions_ = 0;
  if (current_.merit.unplaced < best_.merit.unplaced || current_.merit.missing < best_.merit.missing)
    vain_fills_ = 0;
  best_ = current_;
}

/// Whether a valid state is better than the one in hand; then it is in hand.
bool SheetLane::take(State state) {
  tidy(state);
  Merit merit = merit_of(state);
  const bool better = is_kick_ || merit < current_.merit;
  // As many pieces as before, lying otherwise: from there the next attempt is another one.
  const bool level = goal_ != Goal::box && merit.missing <= current_.merit.missing &&
                     merit.unplaced <= current_.merit.unplaced * (1 + kRounding);
  if (!better && !level) return false;
  const std::vector<std::uint32_t> open = current_.state.open_bins;
  current_ = {std::move(state), merit};
  keep_if_best();
  // What is filled keeps its stock open.
  if (goal_ != Goal::box) current_.state.open_bins = open;
  return better;
}

void SheetLane::on_valid() {
  if (problem_.unit() > 0) separator_.snap(problem_.unit());
  const bool gained = take(goal_ == Goal::box ? separator_.state() : refilled(separator_.state()));
  if (!gained) return on_stuck();
  failures_ = 0;
  if (goal_ == Goal::box) {
    is_kick_ = false;
    ratio_ = std::min(kMostShrink, 1.2 * ratio_);
    // Another sheet may be the one with least on it now.
    target_ = emptiest(current_.state);
  } else {
    const std::size_t missing = nowhere(current_.state).size();
    if (missing == 0) return choose_goal();
    batch_ = std::min(2 * batch_, missing);
  }
}

State SheetLane::without_conflicts(State state) {
  separator_.load(state);
  while (separator_.overlap() > 0 && !separator_.is_stopped()) {
    std::size_t least = items_.movable();
    double lowest = kFar;
    for (std::size_t i = 0; i < items_.movable(); ++i) {
      if (!separator_.is_in_conflict(i)) continue;
      const double area = problem_.area_of(items_.parts[i]);
      if (area < lowest) {
        lowest = area;
        least = i;
      }
    }
    if (least == items_.movable()) break;
    state.spots[least].bin = kNowhere;
    separator_.set_spot(least, state.spots[least]);
  }
  return state;
}

/// The state with what lies nowhere put where there is room as it is: a rearrangement in vain may have made
/// some.
State SheetLane::refilled(const State& state) {
  Placer placer(problem_, items_, Random(separator_.random().bits()));
  placer.load(state);
  const bool alike = items_.partners.empty();
  std::set<std::pair<std::uint32_t, std::uint32_t>> full;  // bin, first form
  for (const std::uint32_t i : nowhere(state)) {
    if (separator_.is_stopped()) break;
    for (const std::uint32_t bin : state.open_bins) {
      const std::pair key(bin, items_.forms[i].first);
      if (full.contains(key) || placer.place_low(i, bin, kRefillTries)) {
        if (placer.state().spots[i].bin != kNowhere) break;
        continue;
      }
      if (alike) full.insert(key);
    }
  }
  refill_work_ += placer.work();
  return placer.state();
}

void SheetLane::on_stuck() {
  ++failures_;
  if (goal_ == Goal::box) {
    if (is_kick_) return choose_goal();
    // Not worth the last per mille: others are better already.
    const double behind = current_.merit.reach - best_.merit.reach;
    const double box = (problem_.bins()[target_].box.x1 - problem_.bins()[target_].box.x0) *
                           (problem_.bins()[target_].box.y1 - problem_.bins()[target_].box.y0) +
                       best_.merit.reach;
    if (failures_ >= kFailuresToBox) {
      ratio_ *= 0.5;
      failures_ = 0;
    }
    if (ratio_ < kLastShrink || (ratio_ < 0.02 && behind > kKickEnd * box)) choose_goal();
    return;
  }
  if (take(refilled(without_conflicts(attempt_.least())))) failures_ = 0;
  const std::size_t missing = nowhere(current_.state).size();
  if (missing == 0) return choose_goal();
  batch_ = std::max<std::size_t>(1, batch_ / 2);
  if (failures_ >= (goal_ == Goal::fill ? kFailuresToFill : kFailuresToReduce)) choose_goal();
}

void SheetLane::step() {
  if (rooms_left_ > 0) return try_room();
  const double overlap = separator_.pass();
  if (overlap <= 0 || (separator_.deepest() < problem_.unit() && separator_.snap(problem_.unit()))) {
    on_valid();
    return attempt();
  }
  const Patience patience = goal_ != Goal::box ? kFill : ratio_ > 0.01 ? kBox : kFine;
  switch (attempt_.after_pass(overlap, separator_.state(), patience)) {
    case Attempt::Next::on:
      return;
    case Attempt::Next::stuck:
      on_stuck();
      return attempt();
    case Attempt::Next::from_least:
      separator_.load(attempt_.least());
      separator_.overlap();
  }
}

void SheetLane::run(std::uint64_t work) {
  const std::uint64_t until = this->work() + work;
  while (goal_ != Goal::none && this->work() < until && !separator_.is_stopped()) step();
}

}  // namespace lekalo::nest

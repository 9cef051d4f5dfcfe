#include "kit_choice.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>

namespace lekalo::layout {
namespace {

/// A search ends after this many steps. A step has a length that does not grow with the kits. What a person
/// orders needs some tens of steps.
constexpr std::size_t kMostSteps = 5000, kTakersInAStep = 64;
/// Nothing is searched where the kits that compete, times the supplies they compete for, are more than this.
constexpr std::size_t kMostTable = 100'000;
/// Sums of the same values in another order may differ by this, relatively.
constexpr double kRounding = 1e-12;

/// The number of pieces of a kind that are there, and how many of them one kit takes.
struct Supply {
  std::int64_t there = 0;
  /// Each kit and its pieces, ascending by kit.
  std::vector<std::pair<std::size_t, std::int64_t>> takers;
};

/// Returns three supplies for a part: its upright pieces, its mirrored ones, and all of them. Whole kits can
/// be made exactly when none of the three runs out.
std::vector<Supply> supplies_of(const Document& document, const std::vector<PieceCount>& placed) {
  std::map<std::pair<std::uint32_t, int>, Supply> supplies;
  for (std::size_t k = 0; k < document.kits.size(); ++k)
    for (const KitPiece& piece : document.kits[k].pieces) {
      const auto take = [&](int hand, std::int64_t there) {
        Supply& supply = supplies[{piece.part, hand}];
        supply.there = there;
        if (supply.takers.empty() || supply.takers.back().first != k) supply.takers.emplace_back(k, 0);
        supply.takers.back().second += piece.count;
      };
      const PieceCount& count = placed[piece.part];
      take(2, count.total());
      if (piece.mirrored) take(*piece.mirrored ? 1 : 0, *piece.mirrored ? count.mirrored : count.upright);
    }
  std::vector<Supply> all;
  for (auto& [kind, supply] : supplies) all.push_back(std::move(supply));
  return all;
}

/// Branch and bound over kits that compete for supplies.
class Choice {
 public:
  /// \param most  the kits that can be made at most, by kit
  Choice(const Document& document, const std::vector<Supply>& supplies, std::vector<std::size_t> kits,
         const std::vector<std::int64_t>& most)
      : kits_(std::move(kits)), now_(kits_.size()), best_(kits_.size()), takes_(kits_.size()) {
    std::map<std::size_t, std::size_t> index;
    for (std::size_t i = 0; i < kits_.size(); ++i) {
      index[kits_[i]] = i;
      values_.push_back(document.kits[kits_[i]].value);
      most_.push_back(most[kits_[i]]);
    }
    for (const Supply& supply : supplies) {
      for (const auto& [kit, count] : supply.takers) takes_[index[kit]].emplace_back(left_.size(), count);
      left_.push_back(supply.there);
      takers_ += supply.takers.size();
    }
  }

  /// Returns the best numbers of kits that were found, by kit of those given.
  const std::vector<std::int64_t>& best() {
    start_with_dear_ones();
    if (kits_.size() * left_.size() > kMostTable) return best_;
    prepare_bounds();
    search(0, 0);
    return best_;
  }
  const std::vector<std::size_t>& kits() const noexcept { return kits_; }

 private:
  struct Taker {
    /// The value of the kit for each piece it takes.
    double each = 0;
    std::size_t kit = 0;
    std::int64_t count = 0;
  };

  std::int64_t room_for(std::size_t kit) const {
    std::int64_t room = most_[kit];
    for (const auto& [supply, count] : takes_[kit]) room = std::min(room, left_[supply] / count);
    return room;
  }
  void take(std::size_t kit, std::int64_t kits) {
    for (const auto& [supply, count] : takes_[kit]) left_[supply] -= kits * count;
  }

  /// Makes the dearest kits first. This gives the search something to beat, and a result if it does not come
  /// to its end.
  void start_with_dear_ones() {
    std::vector<std::size_t> order(kits_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values_[a] > values_[b]; });
    for (const std::size_t kit : order) {
      best_[kit] = room_for(kit);
      take(kit, best_[kit]);
      best_value_ += values_[kit] * static_cast<double>(best_[kit]);
    }
    for (const std::size_t kit : order) take(kit, -best_[kit]);
  }

  void prepare_bounds() {
    dearest_first_.resize(left_.size());
    free_value_.assign(left_.size(), std::vector<double>(kits_.size() + 1, 0));
    std::vector<char> takes(kits_.size() * left_.size(), 0);
    for (std::size_t i = 0; i < kits_.size(); ++i)
      for (const auto& [supply, count] : takes_[i]) {
        dearest_first_[supply].push_back({values_[i] / static_cast<double>(count), i, count});
        takes[i * left_.size() + supply] = 1;
      }
    for (std::size_t s = 0; s < left_.size(); ++s) {
      std::stable_sort(dearest_first_[s].begin(), dearest_first_[s].end(),
                       [](const Taker& a, const Taker& b) { return a.each > b.each; });
      for (std::size_t i = kits_.size(); i-- > 0;)
        free_value_[s][i] =
            free_value_[s][i + 1] +
            (takes[i * left_.size() + s] != 0 ? 0 : values_[i] * static_cast<double>(most_[i]));
    }
  }

  /// Returns a value that the kits from this one on cannot exceed: it allows fractions of kits, and minds one
  /// supply at a time.
  double bound(std::size_t from) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t s = 0; s < left_.size(); ++s) {
      double value = free_value_[s][from];
      auto there = static_cast<double>(left_[s]);
      for (const Taker& taker : dearest_first_[s]) {
        if (taker.kit < from) continue;
        const double pieces = std::min(there, static_cast<double>(most_[taker.kit] * taker.count));
        value += taker.each * pieces;
        there -= pieces;
      }
      least = std::min(least, value);
    }
    return least;
  }

  /// Tries large numbers of the first kits first, so that they stay among equal results.
  void search(std::size_t kit, double value) {
    if (kit == kits_.size()) {
      const bool better = value > best_value_ * (1 + kRounding);
      const bool earlier = value >= best_value_ * (1 - kRounding) && now_ > best_;
      if (!better && !earlier) return;
      best_ = now_;
      best_value_ = std::max(value, best_value_);
      return;
    }
    const std::int64_t room = room_for(kit);
    for (std::int64_t count = room; count >= 0 && steps_ <= kMostSteps; --count) {
      steps_ += 1 + takers_ / kTakersInAStep;
      now_[kit] = count;
      take(kit, count);
      const double with = value + values_[kit] * static_cast<double>(count);
      const double most = with + bound(kit + 1);
      const bool may_be_better = most > best_value_ * (1 + kRounding);
      // Among equal results the one with more of the first kits counts.
      const bool may_be_earlier =
          most >= best_value_ * (1 - kRounding) &&
          std::lexicographical_compare_three_way(
              now_.begin(), now_.begin() + static_cast<std::ptrdiff_t>(kit) + 1, best_.begin(),
              best_.begin() + static_cast<std::ptrdiff_t>(kit) + 1) >= 0;
      if (may_be_better || may_be_earlier) search(kit + 1, with);
      take(kit, -count);
    }
    now_[kit] = 0;
  }

  std::vector<std::size_t> kits_;
  std::vector<std::int64_t> now_, best_, most_;
  std::vector<double> values_;
  /// By kit: each supply and the pieces taken from it.
  std::vector<std::vector<std::pair<std::size_t, std::int64_t>>> takes_;
  /// By supply: the pieces left.
  std::vector<std::int64_t> left_;
  /// By supply: its takers.
  std::vector<std::vector<Taker>> dearest_first_;
  /// By supply and kit: the value of all kits from that one on that do not need the supply.
  std::vector<std::vector<double>> free_value_;
  double best_value_ = 0;
  std::size_t takers_ = 0, steps_ = 0;
};

}  // namespace

std::vector<std::int64_t> most_valuable_kits(const Document& document,
                                             const std::vector<PieceCount>& placed) {
  std::vector<Supply> supplies = supplies_of(document, placed);
  std::vector<std::int64_t> most;
  for (const Kit& kit : document.kits) most.push_back(kit.demand);
  for (const Supply& supply : supplies)
    for (const auto& [kit, count] : supply.takers) most[kit] = std::min(most[kit], supply.there / count);
  // No kit competes for a supply that has enough for all.
  std::erase_if(supplies, [&](const Supply& supply) {
    std::int64_t wanted = 0;
    for (const auto& [kit, count] : supply.takers) wanted += most[kit] * count;
    return wanted <= supply.there;
  });
  // Kits that compete for one of the remaining supplies are chosen together.
  std::vector<std::size_t> before(document.kits.size());
  std::iota(before.begin(), before.end(), std::size_t{0});
  const auto first_of = [&](std::size_t kit) {
    while (before[kit] != kit) kit = before[kit] = before[before[kit]];
    return kit;
  };
  for (const Supply& supply : supplies)
    for (const auto& [kit, count] : supply.takers) {
      const std::size_t a = first_of(supply.takers.front().first), b = first_of(kit);
      before[std::max(a, b)] = std::min(a, b);
    }
  struct KitGroup {
    std::vector<std::size_t> kits;
    std::vector<Supply> supplies;
  };
  std::map<std::size_t, KitGroup> groups;
  for (Supply& supply : supplies) groups[first_of(supply.takers.front().first)].supplies.push_back(supply);
  for (std::size_t k = 0; k < before.size(); ++k)
    if (const auto group = groups.find(first_of(k)); group != groups.end()) group->second.kits.push_back(k);
  for (auto& [first, group] : groups) {
    Choice choice(document, group.supplies, std::move(group.kits), most);
    const std::vector<std::int64_t>& best = choice.best();
    for (std::size_t i = 0; i < best.size(); ++i) most[choice.kits()[i]] = best[i];
  }
  return most;
}

}  // namespace lekalo::layout

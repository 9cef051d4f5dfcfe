#include "kits.hpp"

#include <algorithm>
#include <numeric>

#include "lekalo/layout/completeness.hpp"

namespace lekalo::nest {
namespace {

/// Takes pieces of a hand that a kit may have from those that are there. \return how many it still needs
std::int64_t still_needed(std::int64_t needed, const layout::KitPiece& piece, layout::PieceCount& there) {
  const auto use = [&](std::int64_t& of) {
    const std::int64_t taken = std::min(needed, of);
    of -= taken;
    needed -= taken;
  };
  if (!piece.mirrored || !*piece.mirrored) use(there.upright);
  if (!piece.mirrored || *piece.mirrored) use(there.mirrored);
  return needed;
}

bool is_within(const Forms& forms, const Forms& hand) {
  return forms.first >= hand.first && forms.last <= hand.last;
}

}  // namespace

std::vector<std::uint32_t> pieces_for_a_kit(Search& search, const std::vector<std::uint32_t>& missing) {
  const Problem& problem = search.problem;
  const Items& items = search.items;
  const layout::Document& document = problem.document();
  const layout::KitsMade made =
      layout::kits_made(document, placed_pieces(problem, items, search.current.state));
  std::vector<std::uint32_t> best;
  double most = 0;
  for (std::uint32_t k = 0; k < document.kits.size(); ++k) {
    const layout::Kit& kit = document.kits[k];
    if (made.complete[k] >= kit.demand || kit.value <= 0) continue;
    std::vector<layout::PieceCount> left = made.left;
    std::vector<std::uint32_t> pieces;
    double area = 0;
    bool is_complete = true;
    for (const layout::KitPiece& piece : kit.pieces) {
      std::int64_t needed = still_needed(piece.count, piece, left[piece.part]);
      const Forms hand = problem.forms_of(piece.part, piece.mirrored);
      for (const std::uint32_t i : missing) {
        if (needed == 0) break;
        if (items.parts[i] != piece.part || !is_within(items.forms[i], hand) ||
            std::find(pieces.begin(), pieces.end(), i) != pieces.end())
          continue;
        pieces.push_back(i);
        area += problem.area_of(piece.part);
        --needed;
      }
      is_complete = is_complete && needed == 0;
    }
    if (!is_complete || pieces.empty()) continue;
    const double rank = kit.value / area * search.random().uniform(0.5, 1);
    if (rank <= most) continue;
    most = rank;
    best = std::move(pieces);
  }
  return best;
}

std::vector<std::int64_t> planned_kits(Search& search) {
  constexpr double kRounding = 1e-12;  // areas are added up in another order
  const Problem& problem = search.problem;
  const layout::Document& document = problem.document();
  Random& random = search.random();
  const State& state = search.separator.state();
  const std::vector<layout::PieceCount> placed = placed_pieces(problem, search.items, state);
  const std::vector<std::int64_t> made = layout::kits_made(document, placed).complete;
  double value_now = 0, stock = 0, used = 0;
  for (std::size_t k = 0; k < made.size(); ++k)
    value_now += document.kits[k].value * static_cast<double>(made[k]);
  for (const std::uint32_t bin : state.open_bins) stock += problem.bins()[bin].area;
  for (std::uint32_t p = 0; p < placed.size(); ++p)
    used += problem.area_of(p) * static_cast<double>(placed[p].total());
  std::vector<double> areas(made.size(), 0);
  for (std::size_t k = 0; k < made.size(); ++k)
    for (const layout::KitPiece& piece : document.kits[k].pieces)
      areas[k] += problem.area_of(piece.part) * static_cast<double>(piece.count);
  for (int tries = 0; tries < tuning::kPlans; ++tries) {
    // The stock gets as full as it is, or somewhat fuller.
    const double room =
        std::min(stock, used + random.uniform(0, tuning::kMoreRoom) * stock) * (1 + kRounding);
    std::vector<std::int64_t> kits(made.size(), 0);
    double value = 0, area = 0;
    std::vector<std::size_t> order(kits.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    for (std::size_t k = order.size(); k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
    // Every second plan takes the kits that are worth most for their area first; the others leave it to
    // chance.
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

void replace_by(Search& search, const std::vector<std::int64_t>& kits) {
  const Items& items = search.items;
  const layout::Document& document = search.problem.document();
  Separator& separator = search.separator;
  const std::size_t n = items.movable();
  std::vector<char> is_needed(n, 0);
  std::vector<layout::PieceCount> locked = search.problem.locked_pieces();
  const auto first = static_cast<std::size_t>(search.random().below(n));
  for (const bool either : {false, true})
    for (std::size_t k = 0; k < kits.size(); ++k)
      for (const layout::KitPiece& piece : document.kits[k].pieces) {
        if (piece.mirrored.has_value() == either) continue;
        std::int64_t needed = still_needed(kits[k] * piece.count, piece, locked[piece.part]);
        const Forms hand = search.problem.forms_of(piece.part, piece.mirrored);
        for (const bool nowhere : {false, true})  // those that lie somewhere first
          for (std::size_t m = 0; m < n && needed > 0; ++m) {
            const std::size_t i = (first + m) % n;
            const Spot& spot = separator.state().spots[i];
            if (is_needed[i] != 0 || items.parts[i] != piece.part || (spot.bin == kNowhere) != nowhere)
              continue;
            if (!is_within(nowhere ? items.forms[i] : Forms{spot.form, spot.form + 1}, hand)) continue;
            is_needed[i] = 1;
            --needed;
          }
      }
  for (std::size_t i = 0; i < n; ++i) {
    Spot spot = separator.state().spots[i];
    if (is_needed[i] != 0 && spot.bin == kNowhere) {
      separator.put_anywhere(i);
    } else if (is_needed[i] == 0 && spot.bin != kNowhere) {
      spot.bin = kNowhere;
      separator.set_spot(i, spot);
    }
  }
}

}  // namespace lekalo::nest

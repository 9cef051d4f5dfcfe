#include "wanted.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "lekalo/layout/check.hpp"
#include "nest/exact/builder.hpp"

namespace lekalo::nest {
namespace {

/// How many pieces of one part are wanted: of either hand, upright, mirrored.
struct Hands {
  std::int64_t either = 0, upright = 0, mirrored = 0;
  /// The count that a piece which is there already serves: that of its own hand while such are wanted.
  std::int64_t& of(bool is_mirrored) {
    std::int64_t& own = is_mirrored ? mirrored : upright;
    return own > 0 ? own : either;
  }
};

/// All pieces that parts and kits ask for.
std::vector<Hands> hands_of(const layout::Document& document) {
  std::vector<Hands> wanted(document.parts.size());
  for (std::size_t p = 0; p < wanted.size(); ++p) wanted[p].either = document.parts[p].demand;
  for (const layout::Kit& kit : document.kits)
    for (const layout::KitPiece& piece : kit.pieces) {
      Hands& hands = wanted[piece.part];
      (!piece.mirrored   ? hands.either
       : *piece.mirrored ? hands.mirrored
                         : hands.upright) += kit.demand * piece.count;
    }
  return wanted;
}

/// The pieces that are wanted beside the locked ones. A locked piece that no kit wants of its hand serves
/// one that may be of either.
std::vector<Hands> hands_wanted(const layout::Document& document) {
  std::vector<Hands> wanted = hands_of(document);
  for (const layout::Placement& p : document.placements)
    if (p.locked) --wanted[p.part].of(p.mirrored);
  return wanted;
}

bool has(const Forms& forms, std::uint32_t form) noexcept { return form >= forms.first && form < forms.last; }

/// The form of a part at a rotation, or the one that is turned least from it.
std::uint32_t nearest_form(const Problem& problem, const layout::Placement& p) {
  const std::uint32_t same = problem.form_of(p.part, p.rotation, p.mirrored);
  if (same < problem.forms().size()) return same;
  const Forms forms = problem.forms_of(p.part, p.mirrored);
  std::uint32_t best = forms.first;
  double most = -2;
  for (std::uint32_t f = forms.first; f < forms.last; ++f) {
    const double cosine = problem.forms()[f].c * static_cast<double>(p.rotation.c) * 0x1p-52 +
                          problem.forms()[f].s * static_cast<double>(p.rotation.s) * 0x1p-52;
    if (cosine <= most) continue;
    most = cosine;
    best = f;
  }
  return best;
}

/// Placements that are not locked and break no rule among themselves or against locked ones. Those that
/// break most rules are left out first.
std::vector<layout::Placement> sound_placements(const layout::Document& document) {
  std::vector<layout::Violation> violations =
      layout::check_some(document, document.placements, {}, layout::Depths::left_out);
  std::vector<layout::Placement> sound;
  std::map<std::uint64_t, std::size_t> broken;  // rules broken, by id
  for (const layout::Placement& p : document.placements)
    if (!p.locked) broken[p.id] = 0;
  while (true) {
    for (auto& [id, count] : broken) count = 0;
    for (const layout::Violation& v : violations)
      for (const std::uint64_t id : {v.a, v.b})
        if (const auto at = broken.find(id); at != broken.end()) ++at->second;
    const auto worst = std::max_element(broken.begin(), broken.end(),
                                        [](const auto& a, const auto& b) { return a.second < b.second; });
    if (worst == broken.end() || worst->second == 0) break;
    std::erase_if(violations,
                  [&](const layout::Violation& v) { return v.a == worst->first || v.b == worst->first; });
    broken.erase(worst);
  }
  for (const layout::Placement& p : document.placements)
    if (broken.contains(p.id)) sound.push_back(p);
  return sound;
}

}  // namespace

void add_partners(const Problem& problem, double reach, Items& items) {
  const layout::Document& document = problem.document();
  if (!(reach > 0) || document.kits.empty()) return;
  items.pair_reach = reach;
  items.partners.assign(items.movable(), kNowhere);
  using Pool = std::vector<std::uint32_t>;
  struct Pools {
    Pool either, upright, mirrored;
  };
  std::vector<Pools> pools(document.parts.size());
  for (auto i = static_cast<std::uint32_t>(items.movable()); i-- > 0;) {  // the first ones are taken last
    const std::uint32_t p = items.parts[i];
    (items.forms[i] == problem.forms_of(p)          ? pools[p].either
     : items.forms[i] == problem.forms_of(p, false) ? pools[p].upright
                                                    : pools[p].mirrored)
        .push_back(i);
  }
  std::vector<Hands> wanted = hands_of(document);
  for (std::size_t k = 0; k < items.fixed.size(); ++k) {
    const Form& form = problem.forms()[items.fixed[k].form];
    if (problem.kind_of(form) != SearchShape::Kind::part) continue;
    const std::uint32_t p = problem.part_of(form);
    std::int64_t& serves = wanted[p].of(form.mirrored);
    if (--serves < 0) continue;  // nobody wants it
    (&serves == &wanted[p].either    ? pools[p].either
     : &serves == &wanted[p].upright ? pools[p].upright
                                     : pools[p].mirrored)
        .push_back(static_cast<std::uint32_t>(items.movable() + k));
  }
  const auto take = [](Pool& from, Pool& or_from, std::int64_t count) {
    Pool taken;
    for (; count > 0 && !(from.empty() && or_from.empty()); --count) {
      Pool& pool = from.empty() ? or_from : from;
      taken.push_back(pool.back());
      pool.pop_back();
    }
    return taken;
  };
  const auto pair = [&](std::uint32_t a, std::uint32_t b) {
    if (a < items.movable()) items.partners[a] = b;
    if (b < items.movable()) items.partners[b] = a;
  };
  for (const layout::Kit& kit : document.kits)
    for (std::int64_t copy = 0; copy < kit.demand; ++copy) {
      std::map<std::uint32_t, std::array<std::int64_t, 3>> counts;  // by part: either, upright, mirrored
      for (const layout::KitPiece& piece : kit.pieces)
        counts[piece.part][piece.mirrored ? (*piece.mirrored ? 2 : 1) : 0] += piece.count;
      for (const auto& [part, count] : counts) {
        Pools& of = pools[part];
        const Pool upright = take(of.upright, of.either, count[1]),
                   mirrored = take(of.mirrored, of.either, count[2]);
        Pool rest = take(of.either, of.either, count[0]);
        const std::size_t both = std::min(upright.size(), mirrored.size());
        for (std::size_t k = 0; k < both; ++k) pair(upright[k], mirrored[k]);
        rest.insert(rest.end(), upright.begin() + static_cast<std::ptrdiff_t>(both), upright.end());
        rest.insert(rest.end(), mirrored.begin() + static_cast<std::ptrdiff_t>(both), mirrored.end());
        for (std::size_t k = 0; k + 1 < rest.size(); k += 2) pair(rest[k], rest[k + 1]);
      }
    }
}

Wanted wanted_items(const Problem& problem, bool from_given) {
  const layout::Document& document = problem.document();
  Wanted wanted;
  const auto add = [&](std::uint32_t p, std::int64_t count, std::optional<bool> mirrored) {
    if (count <= 0) return;
    const Forms forms = problem.forms_of(p, mirrored);
    if (forms.first == forms.last) {
      wanted.unplaced.push_back({p, count, Reason::no_angle});
    } else if (!problem.fits_somewhere(p, forms)) {
      wanted.unplaced.push_back({p, count, Reason::too_large});
    } else {
      wanted.items.parts.insert(wanted.items.parts.end(), static_cast<std::size_t>(count), p);
      wanted.items.forms.insert(wanted.items.forms.end(), static_cast<std::size_t>(count), forms);
    }
  };
  std::vector<Hands> hands = hands_wanted(document);
  if (from_given) {  // given pieces are wanted, whatever the demand
    std::vector<Hands> left = hands;
    for (const layout::Placement& p : document.placements) {
      if (p.locked) continue;
      std::int64_t& serves = left[p.part].of(p.mirrored);
      if (serves > 0)
        --serves;
      else
        ++(p.mirrored ? hands[p.part].mirrored : hands[p.part].upright);
    }
  }
  for (std::uint32_t p = 0; p < hands.size(); ++p) {
    add(p, hands[p].either, std::nullopt);
    add(p, hands[p].upright, false);
    add(p, hands[p].mirrored, true);
  }
  for (std::uint32_t b = 0; b < problem.bins().size(); ++b)
    for (const Obstacle& o : problem.bins()[b].obstacles) wanted.items.fixed.push_back({o.x, o.y, o.form, b});
  wanted.ids.assign(wanted.items.movable(), 0);
  wanted.start = empty_state(problem, wanted.items);
  if (!from_given) return wanted;
  const std::vector<layout::Placement> sound = sound_placements(document);
  for (const layout::Placement& p : document.placements) {
    if (p.locked) continue;
    const Forms same_hand = problem.forms_of(p.part, p.mirrored);
    if (same_hand.first == same_hand.last) continue;
    const std::uint32_t form = nearest_form(problem, p);
    // An item that has to be of this hand is preferred to one that may be of either.
    std::size_t item = wanted.items.movable();
    for (std::size_t i = 0; i < wanted.items.movable(); ++i) {
      if (wanted.ids[i] != 0 || wanted.items.parts[i] != p.part || !has(wanted.items.forms[i], form))
        continue;
      if (item == wanted.items.movable() || wanted.items.forms[i] == same_hand) item = i;
    }
    if (item == wanted.items.movable()) continue;
    wanted.ids[item] = p.id;
    if (problem.forms()[form].rotation != p.rotation ||
        std::find(sound.begin(), sound.end(), p) == sound.end())
      continue;
    const auto& bins = problem.bins();
    for (std::uint32_t b = 0; b < bins.size(); ++b) {
      if (bins[b].stock != p.stock || bins[b].copy != p.copy) continue;
      wanted.start.spots[item] = {geom::mm_from_grid(p.at.x), geom::mm_from_grid(p.at.y), form, b};
      auto& open = wanted.start.open_bins;
      if (std::find(open.begin(), open.end(), b) == open.end()) open.push_back(b);
    }
  }
  return wanted;
}

}  // namespace lekalo::nest

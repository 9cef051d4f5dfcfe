#include "lekalo/nest/nest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <thread>

#include "lekalo/layout/check.hpp"
#include "nest/exact/builder.hpp"
#include "nest/exact/reason.hpp"
#include "nest/exact/settle.hpp"
#include "nest/strand/lane.hpp"
#include "nest/strand/sheet_lane.hpp"

namespace lekalo::nest {
namespace {

constexpr std::size_t kLanes = 2;
/// Of one strand between two merges.
constexpr std::uint64_t kSegment = 200'000;
/// Merges without a gain of its own after which a strand goes on from the best.
constexpr int kMergesAlone = 20;
/// Streams of chance of what makes the first states; those of the strands come before.
constexpr std::uint64_t kBuilderStreams = 1000;
/// Likewise of what gives pieces another place, by merge.
constexpr std::uint64_t kMendingStreams = 1'000'000;
/// Of a first layout: it is not left unfinished before, whoever wants to stop.
constexpr std::uint64_t kFirstWork = 1'000'000;
constexpr std::int64_t kMostPieces = 100'000;

struct Wanted {
  Items items;
  std::vector<Unplaced> unplaced;
  /// By item: the placement it is in the given layout, 0 for a new one, and where that lies.
  std::vector<std::uint64_t> ids;
  State start;
  bool starts_somewhere = false;
};

/// Pieces of one part: of either hand, upright, mirrored.
struct Hands {
  std::int64_t either = 0, upright = 0, mirrored = 0;
  /// Where a piece that is there already belongs: to those of its hand while they are wanted.
  std::int64_t& of(bool is_mirrored) {
    std::int64_t& own = is_mirrored ? mirrored : upright;
    return own > 0 ? own : either;
  }
};

/// All that is wanted.
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

/// What is still wanted beside what is locked. A locked piece that no kit wants of its hand serves where
/// either does.
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

/// Placements that are not locked and break no rule among themselves or against what is locked: those that
/// break most are left out first.
std::vector<layout::Placement> sound_placements(const layout::Document& document) {
  std::vector<layout::Violation> violations =
      layout::check_some(document, document.placements, {}, layout::Depths::left_out);
  std::vector<layout::Placement> sound;
  std::map<std::uint64_t, std::size_t> broken;  // rules, by id
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

/// Two and two of a kit's pieces of one part: left and right ones first. Those that are locked serve the
/// first kits.
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
  if (from_given) {  // what lies there is wanted, whatever the demand
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
    // One that has to be of this hand rather than one that may be of either.
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
      wanted.starts_somewhere = true;
      auto& open = wanted.start.open_bins;
      if (std::find(open.begin(), open.end(), b) == open.end()) open.push_back(b);
    }
  }
  return wanted;
}

Result<void> check_document(const layout::Document& document, bool from_given) {
  if (document.stocks.empty())
    return failure(ErrorCode::bad_input, "the layout has no stock to nest on: add a strip, sheets or hides");
  std::int64_t pieces = 0;
  for (std::uint32_t p = 0; p < document.parts.size(); ++p) {
    pieces += layout::wanted(document, p);
    if (pieces > kMostPieces)
      return failure(
          ErrorCode::bad_input,
          fmt::format("more than {} pieces are wanted; nest them in several layouts", kMostPieces));
  }
  const bool has_given = from_given && std::any_of(document.placements.begin(), document.placements.end(),
                                                   [](const layout::Placement& p) { return !p.locked; });
  if (pieces == 0 && !has_given)
    return failure(ErrorCode::bad_input, "nothing to nest: no part has a demand and no kit is wanted");
  layout::Document locked = document;
  std::erase_if(locked.placements, [](const layout::Placement& p) { return !p.locked; });
  const auto violations = layout::check(locked);
  if (!violations.empty())
    return failure(ErrorCode::bad_input,
                   fmt::format("placement {}, which is to stay, breaks a rule ({}); move or unlock it first",
                               violations[0].a, layout::name_of(violations[0].kind)));
  return {};
}

/// What a strand is begun with: its own choices, and how much work they took.
struct Begun {
  State state;
  std::uint64_t work = 0;
  bool ended_early = false;
};

template <class Strand>
class Run {
 public:
  Run(const Problem& problem, const Wanted& wanted, const Options& options, const RunControl& control)
      : problem_(problem), wanted_(wanted), options_(options), control_(control) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      lanes_.push_back(std::make_unique<Strand>(problem, wanted.items, options.seed, k));
      lanes_.back()->separator().watch(control.stop);
    }
    begun_.resize(kLanes);
  }

  Nested go() {
    best_.document = problem_.document();
    std::erase_if(best_.document.placements, [](const layout::Placement& p) { return !p.locked; });
    best_.unplaced = wanted_.unplaced;
    if (wanted_.items.movable() == 0) return best_;
    build();
    if (is_over()) return best_;
    each_lane([&](Strand& lane, std::size_t k) { lane.start(begun_[k].state); });
    while (!is_over() &&
           std::any_of(lanes_.begin(), lanes_.end(), [](const auto& l) { return !l->is_done(); })) {
      each_lane([](Strand& lane, std::size_t) { lane.run(kSegment); });
      // What was ended in the middle does not count: the last merge is what the same work gives again.
      if (control_.stop_requested()) break;
      merge();
    }
    return best_;
  }

 private:
  template <class Task>
  void each_lane(Task task) {
    if (options_.threads < 2 || lanes_.size() < 2) {
      for (std::size_t k = 0; k < lanes_.size(); ++k) task(*lanes_[k], k);
      return;
    }
    std::vector<std::thread> threads;
    for (std::size_t k = 1; k < lanes_.size(); ++k) threads.emplace_back([&, k] { task(*lanes_[k], k); });
    task(*lanes_[0], 0);
    for (std::thread& thread : threads) thread.join();
  }

  bool is_over() const { return control_.stop_requested() || best_.work >= control_.work_limit; }

  /// First layouts, the better one for show at once. A run that ends here ends between two pieces of the
  /// first strand, and the others do not count: so the same work ends it there again.
  void build() {
    const std::vector<std::uint32_t> order = by_size(problem_, wanted_.items);
    std::atomic<bool> first_ended{false};
    each_lane([&](Strand&, std::size_t k) {
      Begun& begun = begun_[k];
      Placer placer(problem_, wanted_.items, Random(options_.seed, kBuilderStreams + k));
      begun.state = built(problem_, wanted_.items, placer, wanted_.start, order, [&] {
        begun.ended_early =
            first_ended || (placer.work() >= kFirstWork &&
                            (control_.stop_requested() || (k == 0 && placer.work() >= control_.work_limit)));
        if (k == 0 && begun.ended_early) first_ended = true;
        return begun.ended_early;
      });
      begun.work = placer.work();
    });
    if (begun_[0].work >= control_.work_limit ||
        std::any_of(begun_.begin(), begun_.end(), [](const Begun& b) { return b.ended_early; }))
      lanes_.resize(1);
    begin_merge();
    std::size_t first = 0;
    for (std::size_t k = 1; k < lanes_.size(); ++k)
      if (lanes_[k]->merit_of(begun_[k].state) < lanes_[first]->merit_of(begun_[first].state)) first = k;
    const State& state = begun_[first].state;
    show(settled(problem_, wanted_.items, state), lanes_[first]->merit_of(state));
    end_merge();
  }

  void begin_merge() {
    ++best_.merges;
    best_.work = 0;
    for (std::size_t k = 0; k < lanes_.size(); ++k) best_.work += begun_[k].work + lanes_[k]->work();
  }

  void end_merge() {
    if (!control_.progress) return;
    const double part = control_.work_limit == std::numeric_limits<std::uint64_t>::max()
                            ? 0
                            : static_cast<double>(best_.work) / static_cast<double>(control_.work_limit);
    control_.progress({best_.work, std::min(1.0, part)});
  }

  void show(Settled exact, const Merit& merit) {
    state_ = std::move(exact.state);
    merit_ = merit;
    best_.document = numbered(std::move(exact.document));
    count_unplaced();
    if (options_.improved) options_.improved(best_);
  }

  /// What the exact check does not leave whole: what was taken out gets another place; better than what was
  /// shown or not, the strand goes on from what there is.
  void show_mended(Strand& strand, const State& rest) {
    Placer placer(problem_, wanted_.items, Random(options_.seed, kMendingStreams + best_.merges));
    const State mended = built(problem_, wanted_.items, placer, rest, by_size(problem_, wanted_.items), {});
    const Merit merit = strand.merit_of(mended);
    if (merit < merit_) show(settled(problem_, wanted_.items, mended), merit);
    strand.go_on_from(state_);
  }

  void merge() {
    begin_merge();
    std::size_t first = 0;
    for (std::size_t k = 1; k < lanes_.size(); ++k)
      if (lanes_[k]->merit() < lanes_[first]->merit()) first = k;
    Strand& leader = *lanes_[first];
    if (leader.merit() < merit_) {
      Settled exact = settled(problem_, wanted_.items, leader.best());
      if (exact.is_whole)
        show(std::move(exact), leader.merit());
      else
        show_mended(leader, exact.state);
    }
    alone_.resize(lanes_.size(), 0);
    merits_.resize(lanes_.size());
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      const Merit now = lanes_[k]->merit();
      const bool gains = now < merits_[k];
      merits_[k] = now;
      // One that still gains goes its own way.
      if (!(leader.merit() < now) || (gains && !lanes_[k]->is_done())) {
        alone_[k] = 0;
      } else if (++alone_[k] >= kMergesAlone || lanes_[k]->is_done()) {
        alone_[k] = 0;
        lanes_[k]->start(leader.best());
      }
    }
    end_merge();
  }

  /// Given pieces keep their ids, new ones get the next.
  layout::Document numbered(layout::Document document) const {
    const std::uint64_t first = problem_.document().next_id;
    document.next_id = first;
    for (layout::Placement& p : document.placements)
      if (!p.locked) {
        const std::uint64_t given = wanted_.ids[p.id - first];
        p.id = given != 0 ? given : document.next_id++;
      }
    std::sort(document.placements.begin(), document.placements.end(),
              [](const layout::Placement& a, const layout::Placement& b) { return a.id < b.id; });
    return document;
  }

  void count_unplaced() {
    best_.unplaced = wanted_.unplaced;
    std::vector<std::int64_t> missing(problem_.document().parts.size(), 0);
    for (const std::uint32_t part : wanted_.items.parts) ++missing[part];
    for (const layout::Placement& p : best_.document.placements)
      if (!p.locked) --missing[p.part];
    for (std::uint32_t p = 0; p < missing.size(); ++p)
      if (missing[p] > 0) best_.unplaced.push_back({p, missing[p], reason_of(p)});
    std::stable_sort(best_.unplaced.begin(), best_.unplaced.end(),
                     [](const Unplaced& a, const Unplaced& b) { return a.part < b.part; });
  }

  Reason reason_of(std::uint32_t part) {
    // Another piece of it has a place, so it is room that is missing.
    for (const layout::Placement& p : best_.document.placements)
      if (p.part == part) return Reason::no_stock;
    const auto known = reasons_.find(part);
    if (known != reasons_.end()) return known->second;
    return reasons_[part] = reason_alone(problem_, part);
  }

  const Problem& problem_;
  const Wanted& wanted_;
  const Options& options_;
  const RunControl& control_;
  std::vector<std::unique_ptr<Strand>> lanes_;
  std::vector<Begun> begun_;
  std::vector<int> alone_;     ///< merges since a strand gained or led
  std::vector<Merit> merits_;  ///< of the strands at the last merge
  Merit merit_;
  State state_;  ///< what best_ shows, on the grid
  Nested best_;
  std::map<std::uint32_t, Reason> reasons_;
};

}  // namespace

std::string_view name_of(Reason reason) noexcept {
  switch (reason) {
    case Reason::no_angle:
      return "no-angle";
    case Reason::too_large:
      return "too-large";
    case Reason::no_zone:
      return "no-zone";
    case Reason::no_stock:
      return "no-stock";
  }
  return "";
}

Result<Nested> nest(const layout::Document& document, const Options& options, const RunControl& control) {
  if (Result<void> fine = check_document(document, options.from_given); !fine)
    return tl::unexpected(fine.error());
  SearchOptions search;
  search.angles_of_any = std::clamp<std::size_t>(options.angles, 1, 360);
  search.given_angles = options.from_given;
  const Problem problem(document, search);
  Wanted wanted = wanted_items(problem, options.from_given);
  add_partners(problem, options.pair_distance, wanted.items);
  const bool strip = problem.bins().size() == 1 && problem.bins()[0].open;
  return strip ? Run<Lane>(problem, wanted, options, control).go()
               : Run<SheetLane>(problem, wanted, options, control).go();
}

}  // namespace lekalo::nest

#include "lekalo/nest/nest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "lane.hpp"
#include "lekalo/layout/check.hpp"
#include "settle.hpp"

namespace lekalo::nest {
namespace {

constexpr std::size_t kLanes = 2;
/// Of one strand between two merges.
constexpr std::uint64_t kSegment = 200'000;
/// Merges without a gain of its own after which a strand goes on from the best.
constexpr int kMergesAlone = 20;
constexpr std::int64_t kMostPieces = 100'000;

struct Wanted {
  Items items;
  std::vector<Unplaced> unplaced;
};

/// Pieces of one part: of either hand, upright, mirrored.
struct Hands {
  std::int64_t either = 0, upright = 0, mirrored = 0;
};

/// What is still wanted beside what is locked. A locked piece that no kit wants of its hand serves where
/// either does.
std::vector<Hands> hands_wanted(const layout::Document& document) {
  std::vector<Hands> wanted(document.parts.size());
  for (std::size_t p = 0; p < wanted.size(); ++p) wanted[p].either = document.parts[p].demand;
  for (const layout::Kit& kit : document.kits)
    for (const layout::KitPiece& piece : kit.pieces) {
      Hands& hands = wanted[piece.part];
      (!piece.mirrored   ? hands.either
       : *piece.mirrored ? hands.mirrored
                         : hands.upright) += kit.demand * piece.count;
    }
  for (const layout::Placement& p : document.placements) {
    if (!p.locked) continue;
    Hands& hands = wanted[p.part];
    std::int64_t& own = p.mirrored ? hands.mirrored : hands.upright;
    --(own > 0 ? own : hands.either);
  }
  return wanted;
}

Wanted wanted_items(const Problem& problem) {
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
  const std::vector<Hands> hands = hands_wanted(document);
  for (std::uint32_t p = 0; p < hands.size(); ++p) {
    add(p, hands[p].either, std::nullopt);
    add(p, hands[p].upright, false);
    add(p, hands[p].mirrored, true);
  }
  for (std::uint32_t b = 0; b < problem.bins().size(); ++b)
    for (const Obstacle& o : problem.bins()[b].obstacles) wanted.items.fixed.push_back({o.x, o.y, o.form, b});
  return wanted;
}

Result<void> check_document(const layout::Document& document) {
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
  if (pieces == 0)
    return failure(ErrorCode::bad_input, "nothing to nest: no part has a demand and no kit is wanted");
  layout::Document locked = document;
  std::erase_if(locked.placements, [](const layout::Placement& p) { return !p.locked; });
  const auto violations = layout::check(locked);
  if (!violations.empty())
    return failure(ErrorCode::bad_input,
                   fmt::format("the locked placement {} breaks a rule ({}); unlock or move it first",
                               violations[0].a, layout::name_of(violations[0].kind)));
  return {};
}

/// The state without what keeps it from being exact: for a first layout there must be one.
std::optional<layout::Document> settled_somehow(const Problem& problem, const Items& items, State state) {
  while (true) {
    if (auto document = settled(problem, items, state)) return document;
    std::size_t last = items.movable();
    for (std::size_t i = 0; i < items.movable(); ++i)
      if (state.spots[i].bin != kNowhere) last = i;
    if (last == items.movable()) return std::nullopt;
    state.spots[last].bin = kNowhere;
  }
}

class Run {
 public:
  Run(const Problem& problem, const Wanted& wanted, const Options& options, const RunControl& control)
      : problem_(problem), wanted_(wanted), options_(options), control_(control) {
    for (std::size_t k = 0; k < kLanes; ++k)
      lanes_.push_back(std::make_unique<Lane>(problem, wanted.items, options.seed, k));
  }

  Nested go() {
    if (wanted_.items.movable() > 0) {
      each_lane([](Lane& lane) { lane.build(); });
      merge();
      while (!control_.stop_requested() && best_.work < control_.work_limit &&
             std::any_of(lanes_.begin(), lanes_.end(), [](const auto& lane) { return !lane->is_done(); })) {
        each_lane([](Lane& lane) { lane.run(kSegment); });
        merge();
      }
    } else {
      best_.document = problem_.document();
      std::erase_if(best_.document.placements, [](const layout::Placement& p) { return !p.locked; });
      best_.unplaced = wanted_.unplaced;
    }
    return best_;
  }

 private:
  template <class Task>
  void each_lane(Task task) {
    if (options_.threads < 2) {
      for (const auto& lane : lanes_) task(*lane);
      return;
    }
    std::vector<std::thread> threads;
    for (std::size_t k = 1; k < lanes_.size(); ++k) threads.emplace_back([&, k] { task(*lanes_[k]); });
    task(*lanes_[0]);
    for (std::thread& thread : threads) thread.join();
  }

  void merge() {
    ++best_.merges;
    best_.work = 0;
    std::size_t first = 0;
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      best_.work += lanes_[k]->work();
      if (lanes_[k]->merit() < lanes_[first]->merit()) first = k;
    }
    const Lane& leader = *lanes_[first];
    if (!has_any_ || leader.merit() < merit_) {
      auto document = has_any_ ? settled(problem_, wanted_.items, leader.best())
                               : settled_somehow(problem_, wanted_.items, leader.best());
      if (document) {
        has_any_ = true;
        merit_ = leader.merit();
        best_.document = std::move(*document);
        count_unplaced();
        if (options_.improved) options_.improved(best_);
      }
    }
    alone_.resize(lanes_.size(), 0);
    for (std::size_t k = 0; k < lanes_.size(); ++k) {
      if (!(leader.merit() < lanes_[k]->merit())) {
        alone_[k] = 0;
      } else if (++alone_[k] >= kMergesAlone || lanes_[k]->is_done()) {
        alone_[k] = 0;
        lanes_[k]->start(leader.best());
      }
    }
    if (control_.progress) {
      const double part = control_.work_limit == std::numeric_limits<std::uint64_t>::max()
                              ? 0
                              : static_cast<double>(best_.work) / static_cast<double>(control_.work_limit);
      control_.progress({best_.work, std::min(1.0, part)});
    }
  }

  void count_unplaced() {
    best_.unplaced = wanted_.unplaced;
    std::vector<std::int64_t> missing(problem_.document().parts.size(), 0);
    for (const std::uint32_t part : wanted_.items.parts) ++missing[part];
    for (const layout::Placement& p : best_.document.placements)
      if (!p.locked) --missing[p.part];
    for (std::uint32_t p = 0; p < missing.size(); ++p)
      if (missing[p] > 0) best_.unplaced.push_back({p, missing[p], Reason::no_room});
    std::sort(best_.unplaced.begin(), best_.unplaced.end(),
              [](const Unplaced& a, const Unplaced& b) { return a.part < b.part; });
  }

  const Problem& problem_;
  const Wanted& wanted_;
  const Options& options_;
  const RunControl& control_;
  std::vector<std::unique_ptr<Lane>> lanes_;
  std::vector<int> alone_;
  Merit merit_;
  bool has_any_ = false;
  Nested best_;
};

}  // namespace

std::string_view name_of(Reason reason) noexcept {
  switch (reason) {
    case Reason::no_angle:
      return "no-angle";
    case Reason::too_large:
      return "too-large";
    case Reason::no_room:
      return "no-room";
  }
  return "";
}

Result<Nested> nest(const layout::Document& document, const Options& options, const RunControl& control) {
  if (Result<void> fine = check_document(document); !fine) return tl::unexpected(fine.error());
  SearchOptions search;
  search.angles_of_any = std::clamp<std::size_t>(options.angles, 1, 360);
  const Problem problem(document, search);
  const Wanted wanted = wanted_items(problem);
  return Run(problem, wanted, options, control).go();
}

}  // namespace lekalo::nest

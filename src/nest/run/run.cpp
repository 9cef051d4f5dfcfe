#include "run.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <memory>

#include "lekalo/base/parallel.hpp"
#include "nest/exact/builder.hpp"
#include "nest/exact/reason.hpp"
#include "nest/exact/settle.hpp"
#include "nest/strand/strand.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

/// The numbers of the random streams that build the first states: this one for the first strand, and the
/// following ones for the others. The strands themselves have the streams below.
constexpr std::uint64_t kBuilderStreams = 1000;
/// The numbers of the random streams that place again what the exact check took out: this one and the
/// following ones, by merge.
constexpr std::uint64_t kMendingStreams = 1'000'000;

/// The first state of a strand and how much work it took.
struct Begun {
  State state;
  std::uint64_t work = 0;
  bool ended_early = false;
};

class Run {
 public:
  Run(const Problem& problem, const Wanted& wanted, const Options& options, const RunControl& control)
      : problem_(problem), wanted_(wanted), options_(options), control_(control) {
    for (std::size_t k = 0; k < tuning::kStrands; ++k) {
      strands_.push_back(std::make_unique<Strand>(problem, wanted.items, options.seed, k));
      strands_.back()->watch(control.stop);
    }
    begun_.resize(tuning::kStrands);
  }

  Nested go() {
    best_.document = problem_.document();
    std::erase_if(best_.document.placements, [](const layout::Placement& p) { return !p.locked; });
    best_.unplaced = wanted_.unplaced;
    if (wanted_.items.movable() == 0) return best_;
    build();
    if (is_over()) return best_;
    each_strand([&](Strand& strand, std::size_t k) { strand.start(begun_[k].state); });
    while (!is_over() &&
           std::any_of(strands_.begin(), strands_.end(), [](const auto& l) { return !l->is_done(); })) {
      each_strand([](Strand& strand, std::size_t) { strand.run(tuning::kSegment); });
      // A stop may end the strands in the middle. The work since the last merge does not count then, so that
      // the same work gives the same result again.
      if (control_.stop_requested()) break;
      merge();
    }
    return best_;
  }

 private:
  template <class Task>
  void each_strand(Task task) {
    share_out(strands_.size(), options_.threads, [&](std::size_t k) { task(*strands_[k], k); });
  }

  bool is_over() const { return control_.stop_requested() || best_.work >= control_.work_limit; }

  /// Builds the first layouts and shows the better one. A run that ends here ends between two pieces of the
  /// first strand, and the other strands do not count, so that the same work ends it there again.
  void build() {
    const std::vector<std::uint32_t> order = by_size(problem_, wanted_.items);
    std::atomic<bool> first_ended{false};
    each_strand([&](Strand&, std::size_t k) {
      Begun& begun = begun_[k];
      Placer placer(problem_, wanted_.items, Random(options_.seed, kBuilderStreams + k));
      begun.state = built(problem_, wanted_.items, placer, wanted_.start, order, [&] {
        begun.ended_early =
            first_ended || (placer.work() >= tuning::kFirstWork &&
                            (control_.stop_requested() || (k == 0 && placer.work() >= control_.work_limit)));
        if (k == 0 && begun.ended_early) first_ended = true;
        return begun.ended_early;
      });
      begun.work = placer.work();
    });
    if (begun_[0].work >= control_.work_limit ||
        std::any_of(begun_.begin(), begun_.end(), [](const Begun& b) { return b.ended_early; }))
      strands_.resize(1);
    begin_merge();
    std::size_t first = 0;
    std::vector<Merit> merits;
    for (std::size_t k = 0; k < strands_.size(); ++k) {
      merits.push_back(merit_of(problem_, wanted_.items, begun_[k].state));
      if (merits[k] < merits[first]) first = k;
    }
    show(settled(problem_, wanted_.items, begun_[first].state), merits[first]);
    end_merge();
  }

  void begin_merge() {
    ++best_.merges;
    best_.work = 0;
    for (std::size_t k = 0; k < strands_.size(); ++k) best_.work += begun_[k].work + strands_[k]->work();
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

  /// Shows a state from which the exact check took something out. What was taken out gets another place. The
  /// strand then goes on from the best layout, whether this one was better or not.
  void show_mended(Strand& strand, const State& rest) {
    Placer placer(problem_, wanted_.items, Random(options_.seed, kMendingStreams + best_.merges));
    const State mended = built(problem_, wanted_.items, placer, rest, by_size(problem_, wanted_.items), {});
    const Merit merit = merit_of(problem_, wanted_.items, mended);
    if (merit < merit_) show(settled(problem_, wanted_.items, mended), merit);
    strand.go_on_from(state_);
  }

  void merge() {
    begin_merge();
    std::size_t first = 0;
    for (std::size_t k = 1; k < strands_.size(); ++k)
      if (strands_[k]->merit() < strands_[first]->merit()) first = k;
    Strand& leader = *strands_[first];
    if (leader.merit() < merit_) {
      Settled exact = settled(problem_, wanted_.items, leader.best());
      if (exact.is_whole)
        show(std::move(exact), leader.merit());
      else
        show_mended(leader, exact.state);
    }
    alone_.resize(strands_.size(), 0);
    merits_.resize(strands_.size());
    for (std::size_t k = 0; k < strands_.size(); ++k) {
      const Merit now = strands_[k]->merit();
      const bool gains = now < merits_[k];
      merits_[k] = now;
      // A strand that still gains something is not made to follow the leader.
      if (!(leader.merit() < now) || (gains && !strands_[k]->is_done())) {
        alone_[k] = 0;
      } else if (++alone_[k] >= tuning::kMergesAlone || strands_[k]->is_done()) {
        alone_[k] = 0;
        strands_[k]->start(leader.best());
      }
    }
    end_merge();
  }

  /// Returns the layout with ids: pieces that were given keep theirs, and new ones get the next.
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
    // If another piece of the part has a place, this one only lacks room.
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
  std::vector<std::unique_ptr<Strand>> strands_;
  std::vector<Begun> begun_;
  /// By strand: the merges since it gained something or led.
  std::vector<int> alone_;
  /// By strand: its merit at the last merge.
  std::vector<Merit> merits_;
  Merit merit_;
  /// The state that best_ shows, on the grid.
  State state_;
  Nested best_;
  std::map<std::uint32_t, Reason> reasons_;
};

}  // namespace

Nested run(const Problem& problem, const Wanted& wanted, const Options& options, const RunControl& control) {
  return Run(problem, wanted, options, control).go();
}

}  // namespace lekalo::nest

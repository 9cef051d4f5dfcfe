#include "run.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <map>
#include <memory>

#include "lekalo/base/parallel.hpp"
#include "lekalo/base/stop.hpp"
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
/// The number of the random stream of the sketch.
constexpr std::uint64_t kSketchStream = 999;
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
      : problem_(problem), wanted_(wanted), options_(options), control_(control), begun_(tuning::kStrands) {}

  Nested go() {
    best_.document = problem_.given();
    std::erase_if(best_.document.placements, [](const layout::Placement& p) { return !p.locked; });
    best_.unplaced = wanted_.unplaced;
    if (wanted_.items.movable() == 0) return best_;
    sketch();
    build();
    // A stop takes down whatever goes on, and the best stays as it was shown last. The work since the last
    // merge does not count then, so that the same work gives the same result again.
    const bool searched = wanted_.items.movable() <= tuning::kMostToSearch;
    try {
      if (searched && !is_over()) search();
    } catch (const Stopped&) {
    }
    best_.searched = searched;
    return best_;
  }

 private:
  template <class Task>
  void each_strand(Task task) {
    share_out(strands_.size(), options_.threads, [&](std::size_t k) { task(*strands_[k], k); });
  }

  bool is_over() const { return control_.stop_requested() || best_.work >= control_.work_limit; }

  void search() {
    for (std::size_t k = 0; k < count_; ++k)
      strands_.push_back(std::make_unique<Strand>(problem_, wanted_.items, options_.seed, k));
    each_strand([&](Strand& strand, std::size_t k) { strand.start(begun_[k].state); });
    while (!is_over() &&
           std::any_of(strands_.begin(), strands_.end(), [](const auto& l) { return !l->is_done(); })) {
      each_strand([&](Strand& strand, std::size_t k) {
        const std::uint64_t before = strand.work();
        strand.run(tuning::kSegment, [&] {
          if (k == 0) tell(best_.work + strand.work() - before);  // on the caller's thread
        });
      });
      merge();
    }
  }

  /// Shows something at once where the first layouts of a large order take their time. Its work does not
  /// count, because nothing goes on from it.
  void sketch() {
    const std::size_t items = wanted_.items.movable();
    std::size_t corners = 0;
    for (const std::uint32_t part : wanted_.items.parts)
      corners += problem_.document().parts[part].outline.polygon.points.size();
    if (items < tuning::kManyToBuild && corners < tuning::kManyCorners) return;
    // Two outlines take time by the product of their corners.
    const double detail =
        std::max(1.0, static_cast<double>(corners) / static_cast<double>(items * tuning::kEnoughCorners));
    tuning::Tries tries = tuning::kSketchTries;
    tries.in_all = static_cast<std::size_t>(static_cast<double>(tries.in_all) / (detail * detail));
    Placer placer(problem_, wanted_.items, Random(options_.seed, kSketchStream));
    State state;
    try {
      state =
          built(problem_, wanted_.items, placer, wanted_.start, by_size(problem_, wanted_.items), {}, tries);
    } catch (const Stopped&) {
      state = placer.state();
    }
    is_sketch_ = true;
    show_to_the_end(state, merit_of(problem_, wanted_.items, state));
    is_sketch_ = false;
    has_sketch_ = true;
    tell(0);
  }

  /// Builds the first layouts and shows the better one. A run that its work ends here ends between two pieces
  /// of the first strand, and the other strands do not count, so that the same work ends it there again. One
  /// that is stopped shows the pieces that lie.
  void build() {
    const std::vector<std::uint32_t> order = by_size(problem_, wanted_.items);
    std::atomic<bool> first_ended{false};
    share_out(count_, options_.threads, [&](std::size_t k) {
      Begun& begun = begun_[k];
      Placer placer(problem_, wanted_.items, Random(options_.seed, kBuilderStreams + k));
      try {
        begun.state = built(problem_, wanted_.items, placer, wanted_.start, order, [&] {
          if (k == 0) tell(placer.work());
          begun.ended_early = first_ended || (k == 0 && placer.work() >= tuning::kFirstWork &&
                                              placer.work() >= control_.work_limit);
          if (k == 0 && begun.ended_early) first_ended = true;
          return begun.ended_early;
        });
      } catch (const Stopped&) {
        begun.state = placer.state();
        begun.ended_early = true;
      }
      begun.work = placer.work();
    });
    if (begun_[0].work >= control_.work_limit ||
        std::any_of(begun_.begin(), begun_.end(), [](const Begun& b) { return b.ended_early; }))
      count_ = 1;
    begin_merge();
    std::size_t first = 0;
    std::vector<Merit> merits;
    for (std::size_t k = 0; k < count_; ++k) {
      merits.push_back(merit_of(problem_, wanted_.items, begun_[k].state));
      if (merits[k] < merits[first]) first = k;
    }
    if (!has_sketch_ || merits[first] < merit_) show_to_the_end(begun_[first].state, merits[first]);
    end_merge();
  }

  /// Shows a state that breaks no rule, whoever wants to stop.
  void show_to_the_end(const State& state, const Merit& merit) {
    const RunControl nobody;
    const Listening listening(nobody);
    show(settled(problem_, wanted_.items, state), merit);
  }

  void begin_merge() {
    merges_ = best_.merges + 1;
    work_ = 0;
    for (std::size_t k = 0; k < count_; ++k) work_ += begun_[k].work;
    for (const auto& strand : strands_) work_ += strand->work();
  }

  void end_merge() {
    best_.merges = merges_;
    best_.work = work_;
    tell(best_.work);
  }

  void tell(std::uint64_t work) const {
    if (!control_.progress) return;
    const double part = control_.work_limit == std::numeric_limits<std::uint64_t>::max()
                            ? 0
                            : static_cast<double>(work) / static_cast<double>(control_.work_limit);
    control_.progress({work, std::min(1.0, part)});
  }

  void show(Settled exact, const Merit& merit) {
    Nested better{numbered(std::move(exact.document)), {}, work_, merges_};
    better.unplaced = unplaced_of(better.document);
    state_ = std::move(exact.state);
    merit_ = merit;
    best_ = std::move(better);
    if (options_.improved) options_.improved(best_);
  }

  /// Shows a state from which the exact check took something out. What was taken out gets another place. The
  /// strand then goes on from the best layout, whether this one was better or not.
  void show_mended(Strand& strand, const State& rest) {
    Placer placer(problem_, wanted_.items, Random(options_.seed, kMendingStreams + merges_));
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

  std::vector<Unplaced> unplaced_of(const layout::Document& document) {
    std::vector<Unplaced> unplaced = wanted_.unplaced;
    std::vector<std::int64_t> missing(document.parts.size(), 0);
    for (const std::uint32_t part : wanted_.items.parts) ++missing[part];
    std::vector<bool> lies(document.parts.size(), false);
    for (const layout::Placement& p : document.placements) {
      lies[p.part] = true;
      if (!p.locked) --missing[p.part];
    }
    for (std::uint32_t p = 0; p < missing.size(); ++p)
      if (missing[p] > 0) unplaced.push_back({p, missing[p], reason_of(p, lies[p])});
    std::stable_sort(unplaced.begin(), unplaced.end(),
                     [](const Unplaced& a, const Unplaced& b) { return a.part < b.part; });
    return unplaced;
  }

  Reason reason_of(std::uint32_t part, bool lies) {
    if (is_sketch_ || begun_[0].ended_early) return Reason::not_tried;
    // If another piece of the part has a place, this one only lacks room.
    if (lies) return Reason::no_stock;
    const auto known = reasons_.find(part);
    if (known != reasons_.end()) return known->second;
    RunControl until_stop;
    until_stop.stop = control_.stop;
    const Listening listening(until_stop);
    try {
      return reasons_[part] = reason_alone(problem_, part);
    } catch (const Stopped&) {
      return Reason::not_tried;
    }
  }

  const Problem& problem_;
  const Wanted& wanted_;
  const Options& options_;
  const RunControl& control_;
  std::vector<std::unique_ptr<Strand>> strands_;
  std::vector<Begun> begun_;
  /// The strands that count.
  std::size_t count_ = tuning::kStrands;
  /// Those of the merge that goes on; best_ has those of the last one that was done.
  std::uint64_t work_ = 0, merges_ = 0;
  /// By strand: the merges since it gained something or led.
  std::vector<int> alone_;
  /// By strand: its merit at the last merge.
  std::vector<Merit> merits_;
  Merit merit_;
  /// The state that best_ shows, on the grid.
  State state_;
  bool is_sketch_ = false, has_sketch_ = false;
  Nested best_;
  std::map<std::uint32_t, Reason> reasons_;
};

}  // namespace

Nested run(const Problem& problem, const Wanted& wanted, const Options& options, const RunControl& control) {
  return Run(problem, wanted, options, control).go();
}

}  // namespace lekalo::nest

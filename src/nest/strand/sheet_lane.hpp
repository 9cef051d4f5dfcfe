#pragma once

#include <cstdint>
#include <vector>

#include "nest/moves/attempt.hpp"
#include "nest/moves/merit.hpp"
#include "nest/separator/separator.hpp"

namespace lekalo::nest {

/// One strand of the search on sheets and hides; strands run on their own between merges. In turns it takes
/// pieces that lie nowhere in, does with less stock, and makes the box smaller that holds what is on the
/// sheet used least: each by asking for a little more than there is and ending the overlaps.
/// docs/design/nest.md
class SheetLane {
 public:
  SheetLane(const Problem& problem, const Items& items, std::uint64_t seed, std::uint64_t stream);

  /// Goes on from a valid state.
  void start(const State& state) { go_on_from(state); }
  void go_on_from(const State& state);
  /// Until about so much more work is done; less where nothing is left to be gained.
  void run(std::uint64_t work);

  const State& best() const noexcept { return best_.state; }
  const Merit& merit() const noexcept { return best_.merit; }
  /// Of any valid state.
  Merit merit_of(const State& state) const;
  std::uint64_t work() const noexcept {
    return separator_.work() + refill_work_ + attempts_ * items_.movable();
  }
  /// Nothing is left to be gained.
  bool is_done() const noexcept { return goal_ == Goal::none; }
  Separator& separator() noexcept { return separator_; }

 private:
  enum class Goal { fill, reduce, box, none };
  struct Valid {
    State state;
    Merit merit;
  };

  // What there is.
  double missing_value(const State& state) const;
  double reach_of(const State& state, std::uint32_t bin, int axis) const;
  /// What is outside the box from the corner that holds what is on a bin, mm^2.
  double leftover_of(const State& state, std::uint32_t bin) const;
  std::uint32_t emptiest(const State& state) const;
  double used_area(const State& state, std::uint32_t bin) const;
  std::vector<std::uint32_t> nowhere(const State& state) const;
  /// Limits of sheets taken back, sheets with nothing on them given back.
  void tidy(State& state) const;

  // What is asked for next.
  void choose_goal();
  bool begin_reduction();
  bool begin_box();
  /// Until one has begun: there is something to be separated.
  void attempt();
  void begin_rooms();
  void try_room();
  void throw_in();
  std::size_t any_of(const std::vector<std::uint32_t>& missing);
  bool attempt_box();
  void exchange();
  /// Pieces by part that are placed, locked ones too.
  std::vector<layout::PieceCount> placed_pieces(const State& state) const;
  /// Items that lie nowhere and make one more of the kit that is worth most for its missing material; none
  /// where no kit can be completed that way.
  std::vector<std::uint32_t> pieces_for_a_kit(const State& state, const std::vector<std::uint32_t>& missing);
  /// Kits, by number, that are worth more than those complete now and for which there may be room; none where
  /// none were thought of.
  std::vector<std::int64_t> planned_kits();
  /// Takes out what serves none of these kits and throws in what lacks for them.
  void replace_by(const std::vector<std::int64_t>& kits);
  void on_valid();
  void on_stuck();
  bool take(State state);
  void keep_if_best();
  /// The state without items that overlap others, as few and as small as it goes.
  State without_conflicts(State state);
  State refilled(const State& state);

  void begin_separation();
  void step();

  const Problem& problem_;
  const Items& items_;
  Separator separator_;
  std::vector<std::uint32_t> by_size_;
  Valid best_, current_;
  Goal goal_ = Goal::none;
  int failures_ = 0;
  std::uint64_t attempts_ = 0;  ///< each looks at every piece
  std::uint64_t refill_work_ = 0;
  int rounds_ = 0;              ///< goals chosen
  int reductions_ = 0;          ///< goals `reduce` since the best has as many sheets as now
  int vain_fills_ = 0;          ///< goals `fill` since one gained something
  std::size_t rooms_left_ = 0;  ///< to be tried before the rearrangement of this attempt
  std::size_t batch_ = 1;       ///< pieces thrown in at once
  std::uint32_t target_ = 0;    ///< the bin whose box gets smaller
  double ratio_ = 0, skew_ = 0;
  bool is_kick_ = false;  ///< the box under way is a new proportion, larger than it should be
  Attempt attempt_;
};

}  // namespace lekalo::nest

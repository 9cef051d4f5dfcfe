#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "schedule.hpp"

namespace lekalo::nest {

/// One strand of the search. Between merges strands run on their own: each lets the moves of its schedule
/// take turns, and keeps the best valid state. docs/design/nest.md, steps 5 to 10; nest-sheets.md.
class Strand {
 public:
  /// A strand with the usual schedule of the problem's stock.
  /// \param stream  its number, which decides its stream of chance; strand 1 of a strip looks on the
  /// lattice too
  Strand(const Problem& problem, const Items& items, std::uint64_t seed, std::uint64_t stream);
  Strand(const Problem& problem, const Items& items, Random random, Schedule schedule);

  /// Is given a valid state that may be better. On sheets it goes on from that at once. On a strip the
  /// attempt under way ends first, and only a better state is gone on from.
  void start(const State& state);
  /// Goes on from a valid state, better or not, and forgets what it had.
  void go_on_from(const State& state);
  /// Runs until about so much more work is done; less where nothing is left to be gained.
  /// \param stepped  hears of every step; may be empty
  void run(std::uint64_t work, const std::function<void()>& stepped = {});

  const State& best() const noexcept { return search_.best.state; }
  const Merit& merit() const noexcept { return search_.best.merit; }
  /// Work so far, in candidate places looked at.
  std::uint64_t work() const noexcept { return search_.work(); }
  /// Nothing is left to be gained.
  bool is_done() const noexcept { return move_ == nullptr; }

 private:
  void begin_turn(const Move* last);
  void next_attempt(Outcome outcome);
  bool take_offered();
  void step();

  Search search_;
  Schedule schedule_;
  Move* move_ = nullptr;          ///< the one whose turn it is
  std::optional<State> offered_;  ///< by another strand, until the attempt under way has failed
};

}  // namespace lekalo::nest

#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "nest/moves/move.hpp"

namespace lekalo::nest {

/// Chooses which move has the next turn: the first in a list that may have one and has something to gain.
class Schedule {
 public:
  /// True if a move may have the turn after this one; null: the strand goes on from another state.
  using When = std::function<bool(const Move* last)>;

  /// Adds a move at the end of the list. Without a condition it may have any turn.
  void add(std::unique_ptr<Move> move, When when = {}) {
    rules_.push_back({std::move(move), std::move(when)});
  }
  /// The move whose turn it is, begun; null where no move has anything to gain.
  [[nodiscard]] Move* next(Search& search, const Move* last) const;

 private:
  struct Rule {
    std::unique_ptr<Move> move;
    When when;
  };
  std::vector<Rule> rules_;
};

/// The turns on one strip. \param lattice_unit  0 for a strand that does not look on the lattice
[[nodiscard]] Schedule strip_schedule(double lattice_unit);
/// The turns on sheets and hides.
[[nodiscard]] Schedule sheet_schedule();

}  // namespace lekalo::nest

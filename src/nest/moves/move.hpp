#pragma once

#include "search.hpp"

namespace lekalo::nest {

/// One way of getting a better layout: it asks for a little more than there is and has the overlaps ended.
///
/// A turn of a move, as a strand calls it:
///
///   begin      once; false gives the turn to another move
///   attempt    leaves a state with overlaps in the separator
///   step       again and again, until the overlaps have ended or are not worth more work
///   on_valid   or on_failure; then attempt again, until one of them says that the turn is over
///
/// A strand looks at its budget between two steps only, so a step does about one pass of the separator.
/// Whatever a move decides by chance it draws from search.random(): that makes a run repeatable. Work
/// outside the separator is added to search.other_work, in candidate places. docs/design/nest.md says how a
/// move is added.
class Move {
 public:
  virtual ~Move() = default;
  Move() = default;
  Move(const Move&) = delete;
  Move& operator=(const Move&) = delete;

  /// A turn is offered, search.current is the best. False: the move has nothing to gain now.
  virtual bool begin(Search& search) = 0;
  /// \return under_way; failed where there is nothing to separate, which counts as a failure; over;
  /// finished
  virtual Outcome attempt(Search& search) = 0;
  /// \return under_way, valid, failed or over
  virtual Outcome step(Search& search) = 0;
  /// Nothing in the separator overlaps: takes the state if it is better.
  /// \return under_way for another attempt; failed where it is not better; over
  virtual Outcome on_valid(Search& search) = 0;
  /// The attempt has failed, or its state was not better.
  /// \return under_way for another attempt; over
  virtual Outcome on_failure(Search& search) = 0;
};

}  // namespace lekalo::nest

#pragma once

#include <cstdint>
#include <vector>

#include "attempt.hpp"
#include "merit.hpp"

namespace lekalo::nest {

/// A move gives one of these after each of its acts (Move).
enum class Outcome : std::uint8_t {
  under_way,  ///< its turn goes on
  valid,      ///< no overlaps are left in the separator
  failed,     ///< the attempt has come to nothing
  over,       ///< its turn is over
  finished    ///< no move can gain anything any more
};

/// A state without overlaps and its merit.
struct Valid {
  State state;
  Merit merit;
};

/// A strand and its moves share this: the problem, the separator with the state being worked on and the
/// only source of chance, the best state, and the attempt under way.
struct Search {
  Search(const Problem& problem, const Items& items, Random random);

  const Problem& problem;
  const Items& items;
  Separator separator;
  std::vector<std::uint32_t> by_size;  ///< items by priority, then by size, large ones first
  std::vector<std::uint32_t> large;    ///< the largest items, at least two, that make up most of all hulls
  Valid best;                          ///< what the strand would give now
  Valid current;                       ///< what this turn goes on from; the best when a turn begins
  Attempt attempt;
  /// Share of the length by which explore asks for a shorter strip; insert sets it back to the first one.
  double shorter = tuning::kFirstShorter;
  int turns = 0;  ///< turns since the strand went on from another state, this one included
  /// How often the best got cheaper, and how often more pieces came in, restarts included: moves that gave
  /// up try again when these have changed.
  int cheaper = 0, fuller = 0;
  /// Work outside the separator, in candidate places.
  std::uint64_t other_work = 0;

  Random& random() noexcept { return separator.random(); }
  /// Work so far, in candidate places.
  std::uint64_t work() const noexcept { return separator.work() + other_work; }
  bool is_on_lattice() const noexcept { return separator.lattice() > 0; }
  Merit merit_of(const State& state) const { return nest::merit_of(problem, items, state); }
  /// Items that lie nowhere, by size.
  std::vector<std::uint32_t> nowhere(const State& state) const;
  /// An index below count: every second time the first, which is the largest or the most wanted.
  std::size_t pick(std::size_t count);
  /// Gives sheets back that hold nothing, and takes limits of sheets back. A strip keeps its limit, up to
  /// which insert throws pieces in.
  void tidy(State& state) const;
  /// Makes the current state the best if it is better.
  void keep_if_best();
  /// Begins an attempt with the state in the separator.
  void begin_separation();
  /// Judges a pass that left so much overlap: valid, failed where patience ends, or under_way.
  Outcome after_pass(double overlap, Patience patience);
};

/// The middle of the box of an item that lies there, mm.
[[nodiscard]] geom::Point middle_of(const Problem& problem, const Spot& spot);

}  // namespace lekalo::nest

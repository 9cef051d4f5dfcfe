#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "nest/moves/attempt.hpp"
#include "nest/moves/merit.hpp"
#include "nest/separator/separator.hpp"

namespace lekalo::nest {

/// One strand of the search on one strip; strands run on their own between merges. It takes pieces that lie
/// nowhere in and shortens the strip, each by asking for a little more than there is and ending the overlaps.
class Lane {
 public:
  Lane(const Problem& problem, const Items& items, std::uint64_t seed, std::uint64_t stream);

  /// Goes on from a valid state; where an attempt is under way, from its end, and only if that is better.
  void start(const State& state);
  /// Goes on from a valid state, better or not; what was is forgotten.
  void go_on_from(const State& state);
  /// Until about so much more work is done; less where nothing is left to be gained.
  void run(std::uint64_t work);

  const State& best() const noexcept { return best_; }
  const Merit& merit() const noexcept { return merit_; }
  /// Of any valid state.
  Merit merit_of(const State& state) const;
  Separator& separator() noexcept { return separator_; }
  std::uint64_t work() const noexcept { return separator_.work(); }
  /// Nothing is left to be gained.
  bool is_done() const noexcept { return done_; }

 private:
  struct Failed {
    State state;
    double overlap;
  };
  enum class Phase { insert, explore, compress };
  /// How far along the strip what lies there reaches, border gaps included, mm.
  double reach_of(const State& state) const;
  double used_area(const State& state) const;
  void choose_goal();
  void choose_goal_again();
  void next_attempt();
  void attempt_insert();
  void attempt_shrink(bool random_split);
  void attempt_disrupted();
  void squeeze(double length, double shorter, double share);
  void limit(double length);
  void compact();
  bool fits_wider();
  void enter_lattice();
  void leave_lattice();
  void begin_separation();
  void step();
  void on_valid();
  void on_stuck();
  void on_failure();
  bool take_offered();

  const Problem& problem_;
  const Items& items_;
  const Bin& strip_;
  Separator separator_;
  std::vector<std::uint32_t> by_size_, large_;
  State best_;
  std::optional<State> offered_;
  Merit merit_;
  bool done_ = false;
  Phase phase_ = Phase::explore;
  double ratio_ = 0;
  int failures_ = 0;
  std::vector<Failed> pool_;
  Attempt attempt_;
  int passes_ = 0, relax_after_ = 0;
  double lattice_unit_ = 0;  ///< 0: this strand does not look there
  double lattice_ = 0;       ///< that or a half or quarter of it
  bool on_lattice_ = false;
  int lattice_halvings_ = 0;
  std::uint64_t lattice_until_ = 0;
};

}  // namespace lekalo::nest

#pragma once

#include <cstdint>
#include <vector>

#include "separator.hpp"

namespace lekalo::nest {

/// One strand of the search for the shortest strip; strands run on their own between merges.
class StripLane {
 public:
  StripLane(const Problem& problem, const Items& items, std::uint64_t seed, std::uint64_t stream);

  /// A first valid state: parts placed one by one, large ones first.
  void build();
  /// Goes on until about so much more work is done.
  void run(std::uint64_t work);
  /// A shorter valid state found elsewhere.
  void adopt(const State& best, double length);

  const State& best() const noexcept { return best_; }
  double length() const noexcept { return length_; }
  std::uint64_t work() const noexcept { return separator_.work(); }
  std::uint64_t passes() const noexcept { return passes_; }
  const char* phase() const noexcept { return compressing_ ? "compress" : "explore"; }

 private:
  struct Failed {
    State state;
    double overlap;
  };
  double reach_of(const State& state) const;
  void start_shrunk(double ratio, bool random_split);
  void start_disrupted();
  void step();
  void on_valid();
  void on_stuck();

  const Problem& problem_;
  const Items& items_;
  Separator separator_;
  std::vector<std::uint32_t> large_;  ///< items, with the largest hulls
  State best_;
  double length_ = 0;
  bool compressing_ = false;
  double ratio_ = 0.02;
  int failures_ = 0;
  std::vector<Failed> pool_;
  State least_;
  double least_overlap_ = 0, strike_overlap_ = 0;
  int without_gain_ = 0, strikes_ = 0;
  std::uint64_t passes_ = 0;
  void begin_separation();
};

}  // namespace lekalo::nest

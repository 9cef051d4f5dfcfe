#pragma once

#include <cstdint>
#include <vector>

#include "lekalo/base/random.hpp"
#include "problem.hpp"

namespace lekalo::nest {

/// Where an item lies.
struct Spot {
  double x = 0, y = 0;
  std::uint32_t form = 0;
  std::uint32_t bin = 0;
};

/// All items and the end of the strip.
struct State {
  std::vector<Spot> spots;  ///< by item
  std::vector<double> ends;  ///< by bin: x1
};

/// What is moved: pieces of parts; those that are locked come last and stay.
struct Items {
  std::vector<std::uint32_t> parts;  ///< by item
  std::size_t movable = 0;
};

/// Overlap minimisation with guided local search. docs/design/nest.md
class Separator {
 public:
  Separator(const Problem& problem, const Items& items, Random random);

  void load(const State& state);
  const State& state() const noexcept { return state_; }
  Random& random() noexcept { return random_; }

  /// Weights as at the beginning.
  void forget_weights();
  /// Sum of all depths now. 0: valid but for rounding.
  double overlap();
  /// Moves every item in conflict once, in random order, then raises the weights of what is still in
  /// conflict. Returns overlap().
  double pass();
  /// Candidate places looked at.
  std::uint64_t work() const noexcept { return work_; }
  /// Moves item i to the free place found with the least cost x + small y; false if none.
  bool place_low(std::size_t i, std::size_t samples);
  void set_end(std::uint32_t bin, double x1);
  void set_spot(std::size_t i, const Spot& spot);
  bool is_in_conflict(std::size_t i);
  /// The depths of item i with all others, unweighted.
  double loss_of(std::size_t i);

 private:
  struct Range {
    double x0, x1, y0, y1;
  };
  struct Candidate {
    Spot spot;
    double loss;
  };
  Range range_of(std::uint32_t form, std::uint32_t bin, std::uint32_t part) const;
  void gather(const Box& box, std::uint32_t bin, std::size_t but);
  double evaluate(std::size_t i, const Spot& spot, double limit);
  double evaluate_all(std::size_t i, const Spot& spot, double limit);
  void descend(std::size_t i, Candidate& from, double step, double until);
  void push_out(std::size_t i, Candidate& from);
  void move(std::size_t i);
  float& weight(std::size_t i, std::size_t j) { return weights_[i * total_ + j]; }

  const Problem& problem_;
  const Items& items_;
  Random random_;
  State state_;
  std::size_t total_ = 0;
  std::vector<Box> boxes_;
  std::vector<float> weights_;
  std::vector<std::uint32_t> near_;
  Box near_box_;
  std::uint32_t near_bin_ = 0;
  bool near_valid_ = false;
  std::vector<std::uint32_t> order_;
  struct Conflict {
    std::uint32_t a, b;
    double depth;
  };
  std::vector<Conflict> conflicts_;
  std::vector<char> in_conflict_;
  std::vector<double> min_dim_;
  std::uint64_t work_ = 0;
  double tolerance_ = 0;
};

}  // namespace lekalo::nest

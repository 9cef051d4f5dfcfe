#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "box_list.hpp"
#include "cost_sums.hpp"
#include "lekalo/base/random.hpp"
#include "neighbour_grid.hpp"
#include "nest/table/problem.hpp"

namespace lekalo::nest {

/// All items and the end of the strip.
struct State {
  std::vector<Spot> spots;               ///< by item that is moved, then what stays
  std::vector<double> ends;              ///< by bin: x up to which items may lie
  std::vector<double> tops;              ///< likewise y
  std::vector<std::uint32_t> open_bins;  ///< those that may be used
};

/// What is moved, and after that what stays.
struct Items {
  std::vector<std::uint32_t> parts;  ///< by item that is moved
  std::vector<Forms> forms;          ///< likewise: those it may have
  std::vector<Spot> fixed;           ///< obstacles of all bins
  /// By item: the one that it has to lie near, moved or fixed, kNowhere for most; empty where there are none.
  /// The middles of their boxes are no further apart than that, mm, on one bin.
  std::vector<std::uint32_t> partners;
  double pair_reach = 0;
  std::size_t movable() const noexcept { return parts.size(); }
  std::size_t total() const noexcept { return parts.size() + fixed.size(); }
};
/// How much further from its partner item i would lie there than it may, mm.
[[nodiscard]] double too_far_from_partner(const Problem& problem, const Items& items, const State& state,
                                          std::size_t i, const Spot& spot);
/// Depths up to this are rounding, mm: what is left of them is set right on the grid.
inline constexpr double kTolerance = 3e-6;

/// Overlap minimisation with guided local search. docs/design/nest.md
class Separator {
 public:
  Separator(const Problem& problem, const Items& items, Random random);

  void load(const State& state);
  const State& state() const noexcept { return state_; }
  Random& random() noexcept { return random_; }
  /// Where this flag is set pass(), relax() and overlap() end in the middle: nothing is worth anything then.
  void watch(const std::atomic<bool>* stop) noexcept { stop_ = stop; }
  bool is_stopped() const noexcept { return stop_ != nullptr && stop_->load(std::memory_order_relaxed); }

  /// Weights as at the beginning.
  void forget_weights();
  /// Sum of all depths now. 0: valid but for rounding.
  double overlap();
  /// Moves every item in conflict once, in random order, then raises the weights of what is still in
  /// conflict. Returns overlap().
  double pass();
  /// Shifts all pairs that overlap apart by what each lacks, over and over, at most so many rounds. Whether
  /// nothing overlaps any more; else everything is back where it was.
  bool relax(int rounds);
  /// From now on every item lies at multiples of `unit` from the first corner of its bin, and moves to one of
  /// the cheapest of them all; 0: anywhere again. False where the tables of that would be too large.
  bool use_lattice(double unit);
  /// mm; 0: items lie anywhere.
  double lattice() const noexcept { return lattice_; }
  /// Puts every item on the lattice in use, valid or not.
  void to_lattice();
  /// Puts every item on the multiples of `unit` nearest to it; takes it back where that is not valid.
  bool snap(double unit);
  /// The largest depth that the last overlap() found, mm.
  double deepest() const noexcept { return deepest_; }
  /// Candidate places looked at; grids of them and relaxing count as many as would take that long.
  std::uint64_t work() const noexcept { return work_; }
  /// Anywhere on the open bins.
  void put_anywhere(std::size_t i);
  /// Slides what lies on a bin away from a point as far as it goes, what is furthest from it first: the room
  /// between all gathers there. \pre nothing overlaps
  void make_room(std::uint32_t bin, geom::Point at);
  /// The cheapest place found around a point, whatever overlaps there.
  void put_near(std::size_t i, std::uint32_t bin, geom::Point at);
  /// The length (axis 0) or height (axis 1) that the widest item on it needs.
  double least_side(std::uint32_t bin, int axis) const;
  /// Items beyond are pushed back.
  void set_limits(std::uint32_t bin, double x1, double y1);
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
  /// The cheapest places of a move, best first.
  struct Choice {
    static constexpr std::size_t kMost = 3;
    std::array<Candidate, kMost> places;
    std::size_t count = 0;
    double worst() const noexcept {
      return count < kMost ? std::numeric_limits<double>::infinity() : places[kMost - 1].loss;
    }
    void offer(const Candidate& candidate);
  };
  Range range_of(std::uint32_t form, std::uint32_t bin, std::uint32_t part) const;
  void gather(const Box& box, std::uint32_t bin, std::size_t but);
  double evaluate(std::size_t i, const Spot& spot, double limit);
  bool is_free(std::size_t i, const Spot& spot);
  double evaluate_all(std::size_t i, const Spot& spot, double limit);
  void descend(std::size_t i, Candidate& from, double step, double until);
  void push_out(std::size_t i, Candidate& from);
  void move(std::size_t i);
  bool make_grid(double pitch);
  bool sums_pay() const;
  void move_on_lattice(std::size_t i);
  void choose_on_grid(std::size_t i, std::uint32_t bin, Choice& choice);
  void fill_grid(std::size_t i, std::uint32_t form, std::uint32_t bin, const Range& range);
  const NodeGrid* fixed_costs(std::uint32_t form, std::uint32_t bin);
  float heaviest_obstacle(std::size_t i, std::uint32_t bin) const;
  void add_raised(std::size_t i, std::uint32_t form, std::uint32_t bin);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> close_pairs(double margin) const;
  /// What an overlap costs before its weight.
  double value_of(std::size_t i, std::size_t j, double depth, double area) const noexcept;
  double cost_of(double depth, double area) const noexcept;
  std::uint32_t any_bin();
  double area_of(const Spot& a, const Spot& b) const;
  /// How much too far from its partner item i would lie there, mm.
  double distance_too_far(std::size_t i, const Spot& spot) const;
  float& weight(std::size_t i, std::size_t j) { return weights_[i * total_ + j]; }

  const Problem& problem_;
  const Items& items_;
  Random random_;
  State state_;
  std::size_t total_ = 0;
  std::vector<Box> boxes_;
  std::vector<float> weights_;
  std::vector<std::size_t> raised_;  ///< indices of weights above 1
  BoxList list_;
  std::optional<NeighbourGrid> cells_;  ///< instead of the list where there are many items
  const std::atomic<bool>* stop_ = nullptr;
  std::vector<std::uint32_t> near_;
  std::vector<std::uint32_t> order_;
  struct Conflict {
    std::uint32_t a, b;
    double depth;
  };
  std::vector<Conflict> conflicts_;
  std::vector<char> in_conflict_;
  std::vector<double> min_dim_;
  double deepest_ = 0;
  std::uint64_t work_ = 0;
  std::optional<CostGrid> grid_;
  NodeGrid nodes_;  ///< of the item being moved, in one form
  /// By bin and form: what the obstacles there cost, made when first asked for; empty: each has rasters.
  std::vector<std::optional<NodeGrid>> fixed_costs_;
  std::optional<CostSums> sums_;  ///< not where adding up anew is cheaper
  double lattice_ = 0;            ///< 0: anywhere
  double unit_ = 0;               ///< mm: the middling part's size
  std::vector<double> size_;      ///< in units; 1 for what stays
  std::vector<double> root_;      ///< of the sizes
};

}  // namespace lekalo::nest

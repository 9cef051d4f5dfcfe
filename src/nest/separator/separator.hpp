#pragma once

#include <algorithm>
#include <array>
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

/// The spots of all items, and how far each bin may be used.
struct State {
  std::vector<Spot> spots;               ///< by item; those that move come before the fixed ones
  std::vector<double> ends;              ///< by bin: x up to which items may lie
  std::vector<double> tops;              ///< by bin: y up to which items may lie
  std::vector<std::uint32_t> open_bins;  ///< the bins that may be used
};

/// The items: those that move, and after them those that stay.
struct Items {
  std::vector<std::uint32_t> parts;  ///< by item that moves: its part
  std::vector<Forms> forms;          ///< by item that moves: the forms it may have
  std::vector<Spot> fixed;           ///< obstacles of all bins
  /// By item that moves: the item that it has to lie near, kNowhere for most; empty where no item has a
  /// partner.
  std::vector<std::uint32_t> partners;
  /// How far apart the middles of the boxes of partners may be, mm; they have to lie on one bin.
  double pair_reach = 0;
  std::size_t movable() const noexcept { return parts.size(); }
  std::size_t total() const noexcept { return parts.size() + fixed.size(); }
};
/// How much further from its partner item i would lie there than it may, mm.
[[nodiscard]] double too_far_from_partner(const Problem& problem, const Items& items, const State& state,
                                          std::size_t i, const Spot& spot);
/// mm. Depths up to this count as rounding, and settled() ends what is left of them on the grid.
inline constexpr double kTolerance = 3e-6;

/// Ends overlaps by guided local search. docs/design/nest.md, steps 2 to 4.
class Separator {
 public:
  Separator(const Problem& problem, const Items& items, Random random);

  void load(const State& state);
  const State& state() const noexcept { return state_; }
  Random& random() noexcept { return random_; }
  /// Sets all weights back to 1.
  void forget_weights();
  /// The sum of all depths now, mm; 0 where the state is valid but for rounding.
  double overlap();
  /// Moves every item in conflict once, in random order, then raises the weights of pairs still in
  /// conflict.
  /// \return overlap()
  double pass();
  /// Shifts all pairs that overlap apart by their depths, over and over, at most so many rounds. True if
  /// nothing overlaps any more; else everything is back where it was.
  bool relax(int rounds);
  /// From now on every item lies at multiples of `unit` from the first corner of its bin, and moves to one
  /// of the cheapest of all these places. 0: items lie anywhere again. False where the grid for that would
  /// be too large.
  bool use_lattice(double unit);
  /// The unit of the lattice in use, mm; 0 where items lie anywhere.
  double lattice() const noexcept { return lattice_; }
  /// Puts every item on the lattice in use, valid or not.
  void to_lattice();
  /// Puts every item on the multiples of `unit` nearest to it. False, and nothing moved, where that is not
  /// valid.
  bool snap(double unit);
  /// The largest depth that the last overlap() found, mm.
  double deepest() const noexcept { return deepest_; }
  /// Work so far: candidate places looked at. Grids and relaxing count as the places that take as long.
  std::uint64_t work() const noexcept { return work_; }
  /// Puts item i anywhere on the open bins.
  void put_anywhere(std::size_t i);
  /// Slides every item on a bin away from a point as far as it goes, the furthest first, so that the room
  /// between all of them gathers there. \pre nothing overlaps
  void make_room(std::uint32_t bin, geom::Point at);
  /// Puts item i to the cheapest place found around a point, whatever it overlaps there.
  void put_near(std::size_t i, std::uint32_t bin, geom::Point at);
  /// The length (axis 0) or height (axis 1) that the widest item on a bin needs, mm.
  double least_side(std::uint32_t bin, int axis) const;
  /// Sets how far a bin may be used, and pushes items beyond that back.
  void set_limits(std::uint32_t bin, double x1, double y1);
  void set_spot(std::size_t i, const Spot& spot);
  bool is_in_conflict(std::size_t i);

 private:
  /// The places where the origin of a form may lie on a bin, mm; empty where the form does not fit.
  struct Range {
    double x0, x1, y0, y1;
    bool is_empty() const noexcept { return x1 < x0 || y1 < y0; }
    /// A spot of the same form at the place nearest to (x, y).
    Spot clamped(const Spot& spot, double x, double y) const noexcept {
      return {std::max(x0, std::min(x1, x)), std::max(y0, std::min(y1, y)), spot.form, spot.bin};
    }
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
  std::uint32_t any_form(std::size_t i);
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
  /// The cost of an overlap of two items before its weight.
  double value_of(std::size_t i, std::size_t j, double depth, double area) const noexcept;
  double cost_of(double depth, double area) const noexcept;
  std::uint32_t any_bin();
  double area_of(const Spot& a, const Spot& b) const;
  /// too_far_from_partner() in this state.
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
  std::optional<NeighbourGrid> cells_;  ///< used instead of the list where there are many items
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
  NodeGrid nodes_;  ///< the costs of the item being moved, in one form
  /// By bin and form: what the obstacles there cost, made when first asked for. Empty where each obstacle
  /// has rasters of its own.
  std::vector<std::optional<NodeGrid>> fixed_costs_;
  std::optional<CostSums> sums_;  ///< none where adding up anew is cheaper
  double lattice_ = 0;            ///< unit of the lattice, mm; 0 where items lie anywhere
  double unit_ = 0;               ///< the middling part's size, mm
  std::vector<double> size_;      ///< by item, in units; 1 for fixed ones
  std::vector<double> root_;      ///< by item: the root of its size
};

}  // namespace lekalo::nest

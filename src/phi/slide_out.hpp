#pragma once

#include <optional>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// Finds how far `a` must slide in one direction until it is free of what is forbidden, which is `b`, or all
/// outside `b`. It computes in floating point, with coordinates in steps about a's first point.
class SlideOut {
 public:
  /// \param outside_of_b  when true, the complement of `b` is forbidden
  SlideOut(const geom::GridRegion& a, const geom::GridRegion& b, geom::GridPoint b_shift, bool outside_of_b);

  struct Stop {
    double distance = 0;  ///< steps
    geom::Point direction;
    /// The directions of the two edges in contact at the end; one of them is the edge that the other's vertex
    /// slides past.
    geom::Point edge_of_a, edge_of_b;
  };
  /// Returns the least distance >= 0 along `direction` (unit) at which `a` is free, when it is below `limit`.
  [[nodiscard]] std::optional<Stop> along(geom::Point direction, double limit);

  /// Takes a point that `a` and the forbidden have in common. A line through it shows at once of most
  /// directions that they are not good.
  void probe_at(geom::Point place) { probe_ = place; }

  /// Returns the middle of a large piece of what `a` and the forbidden have in common while `a` is where it
  /// is. Pieces are cut along x.
  [[nodiscard]] std::optional<geom::Point> place_in_common();

 private:
  /// An edge in the order of heights across the direction.
  struct Edge {
    double low = 0, high = 0, at_low = 0, slope = 0;
    geom::Point direction;
    [[nodiscard]] double at(double y) const noexcept { return at_low + (y - low) * slope; }
  };
  /// The crossing of an edge and a slab.
  struct Crossing {
    double bottom = 0, top = 0;
    const Edge* edge = nullptr;
  };
  struct Interval {
    double from = 0, to = 0;
    const Edge* of_a = nullptr;
    const Edge* of_b = nullptr;
  };
  struct Outline {
    std::vector<geom::Point> points;
    std::vector<std::uint32_t> loop_starts;
    std::vector<geom::Point> turned;
    std::vector<Edge> edges;
    std::vector<const Edge*> active;
    std::vector<Crossing> crossings;
    double low = 0, high = 0;
    std::size_t next = 0;

    void turn(geom::Point direction);
    /// Gives, ascending, the places where the line at this height crosses edges.
    void cross_line(double height, std::vector<double>& places) const;
    void collect_edges(double from, double to);
    void cross_slab(double bottom, double top);
  };

  /// Calls visit(bottom, top, crossings of a, crossings of the forbidden) for every slab between neighbouring
  /// heights until it returns false. Returns false then, and where a slab is forbidden in its whole width.
  /// \pre both outlines are turned
  template <class Visit>
  bool visit_slabs(Visit&& visit);

  /// Returns a distance that `a` must slide at least, found from its cross section at one height.
  [[nodiscard]] double least_at(double height);

  Outline a_, b_;
  bool outside_of_b_;
  std::vector<double> heights_;
  std::vector<Interval> intervals_;
  std::optional<geom::Point> probe_;
  std::vector<double> line_a_, line_b_;
};

}  // namespace lekalo::phi

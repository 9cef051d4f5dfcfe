#pragma once

#include <optional>
#include <vector>

#include "lekalo/geom/grid_region.hpp"

namespace lekalo::phi {

/// How far `a` must slide in one direction until it is free of what is forbidden: `b`, or all outside `b`.
/// Floating point; coordinates in steps about a's first point.
class SlideOut {
 public:
  /// \param outside_of_b  what is forbidden is the complement of `b`
  SlideOut(const geom::GridRegion& a, const geom::GridRegion& b, geom::GridPoint b_shift, bool outside_of_b);

  struct Stop {
    double distance = 0;  ///< steps
    geom::Point direction;
    /// Directions of the two edges in contact at the end; one is the edge that the other's vertex slides
    /// past.
    geom::Point edge_of_a, edge_of_b;
  };
  /// The least distance >= 0 along `direction` (unit) at which `a` is free, when it is below `limit`.
  [[nodiscard]] std::optional<Stop> along(geom::Point direction, double limit);

  /// A point of what `a` and the forbidden have in common: a line through it tells most directions apart from
  /// good ones at once.
  void probe_at(geom::Point place) { probe_ = place; }

  /// The middle of a large piece of what `a` and the forbidden have in common where `a` is; cut along x.
  [[nodiscard]] std::optional<geom::Point> place_in_common();

 private:
  struct Edge {  ///< upwards across the direction
    double low = 0, high = 0, at_low = 0, slope = 0;
    geom::Point direction;
    [[nodiscard]] double at(double y) const noexcept { return at_low + (y - low) * slope; }
  };
  struct Crossing {  ///< of an edge and a slab
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
    /// Ascending places where the line at this height crosses edges.
    void cross_line(double height, std::vector<double>& places) const;
    void collect_edges(double from, double to);
    void cross_slab(double bottom, double top);
  };

  /// visit(bottom, top, crossings of a, crossings of the forbidden) for every slab between neighbouring
  /// heights until it returns false; false then, or where a slab is forbidden in its whole width.
  /// \pre both turned
  template <class Visit>
  bool visit_slabs(Visit&& visit);

  /// A distance that `a` must slide at least, by its cross section at one height.
  [[nodiscard]] double least_at(double height);

  Outline a_, b_;
  bool outside_of_b_;
  std::vector<double> heights_;
  std::vector<Interval> intervals_;
  std::optional<geom::Point> probe_;
  std::vector<double> line_a_, line_b_;
};

}  // namespace lekalo::phi

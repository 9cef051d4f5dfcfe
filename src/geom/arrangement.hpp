#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/geom/region.hpp"
#include "piece.hpp"

namespace lekalo::geom::detail {

/// Contours to be overlaid: their edges one after the other, each with the operand it belongs to.
struct Outlines {
  static constexpr std::size_t kOperands = 2;

  std::vector<Edge> edges;
  std::vector<std::uint8_t> operand;
  /// By edge: the one after it along its contour.
  std::vector<std::uint32_t> next;
  /// True where the edges are curves in no order: then those that coincide do not cancel.
  bool loose = false;

  void add(const Contour& contour, std::uint8_t operand_of_all);
  void add(const std::vector<Region>& regions, std::uint8_t operand_of_all);
};

/// Returns the largest coordinate, where arcs count with their whole circles.
[[nodiscard]] double extent(const Outlines& outlines) noexcept;

/// A stretch of a piece between two vertices, with no vertex in between.
struct Stretch {
  /// Vertices, in the direction of the edge that the stretch is cut from.
  std::uint32_t from = 0, to = 0;
  std::uint32_t piece = 0;
  /// True for an arc that is long enough to be told from its chord.
  bool curved = false;
  /// The height of its middle above the chord, positive on the left of its direction.
  double height = 0;
};

struct Arrangement;
/// Returns the stretch as a piece between its vertices.
[[nodiscard]] Piece piece_between(const Arrangement& a, const Stretch& s);

/// A stretch, or several that coincide. `weight` says how much higher the winding number of each operand is
/// on its left.
struct MapEdge {
  /// The first of the stretches, which gives the edge its direction and shape.
  std::uint32_t stretch = 0;
  std::array<std::int32_t, Outlines::kOperands> weight{};
};

/// The plane cut by outlines. No two vertices are closer than `snap`, edges meet in vertices only, and every
/// vertex lies within kHot * snap of every edge that ends in it.
struct Arrangement {
  double snap = 0;
  std::vector<Piece> pieces;
  std::vector<Point> vertices;
  /// Along each outline edge, outline edge after outline edge.
  std::vector<Stretch> stretches;
  /// By outline edge its first stretch, and the number of stretches at the end.
  std::vector<std::uint32_t> origin_starts;
  /// By stretch: the edge that it is part of, or kNoEdge where it cancelled another.
  std::vector<std::uint32_t> edge_of_stretch;
  /// The edges in the order of their stretches. An edge without weight is here only if it is short.
  std::vector<MapEdge> edges;
  /// True when there is more than limits let through; then nothing else is there.
  bool too_much = false;
};
/// Edges that cancel are left out, but not those of up to this many snaps across the mouth of a crack. They
/// make the crack a face, and a thin face is turned over (PlanarMap::loops).
inline constexpr double kShortGap = 4;
inline constexpr std::uint32_t kNoEdge = 0xffffffff;
inline constexpr double kHot = 1.25;
/// Arcs shorter than this many snaps become lines, less than a quarter of their length away.
inline constexpr double kShortArc = 16;

[[nodiscard]] Arrangement arrange(const Outlines& outlines, double snap);

}  // namespace lekalo::geom::detail

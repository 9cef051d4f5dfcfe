#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/geom/region.hpp"
#include "piece.hpp"

namespace lekalo::geom::detail {

/// Contours to be overlaid: their edges one after the other, each with the operand that it belongs to.
struct Outlines {
  static constexpr std::size_t kOperands = 2;

  std::vector<Edge> edges;
  std::vector<std::uint8_t> operand;
  std::vector<std::uint32_t> next;  ///< the edge after this one along its contour

  void add(const Contour& contour, std::uint8_t operand_of_all);
  void add(const std::vector<Region>& regions, std::uint8_t operand_of_all);
};

/// Largest coordinate, arcs with their whole circles.
[[nodiscard]] double extent(const Outlines& outlines) noexcept;

/// A stretch of a piece between two vertices and nothing in between.
struct Stretch {
  std::uint32_t from = 0, to = 0;  ///< vertices, in the direction of the edge it is cut from
  std::uint32_t piece = 0;
  bool curved = false;  ///< an arc long enough to tell it from its chord
  double height = 0;    ///< of its middle above the chord, positive on the left of its direction
};

struct Arrangement;
/// The stretch as a piece between its vertices.
[[nodiscard]] Piece piece_between(const Arrangement& a, const Stretch& s);

/// A stretch, or several that coincide: how much the winding number of each operand is higher on the left.
struct MapEdge {
  std::uint32_t stretch = 0;  ///< the first of them, whose direction and shape it has
  std::array<std::int32_t, Outlines::kOperands> weight{};
};

/// The plane cut by outlines: vertices no two of which are closer than `snap`, and edges that meet in
/// vertices only. Every vertex lies within kHot * snap of every edge it ends.
struct Arrangement {
  double snap = 0;
  std::vector<Piece> pieces;
  std::vector<Point> vertices;
  std::vector<Stretch> stretches;            ///< along each outline edge, outline edge after outline edge
  std::vector<std::uint32_t> origin_starts;  ///< per outline edge its first stretch; one more at the end
  std::vector<MapEdge> edges;  ///< in the order of their stretches; those without weight only if short
};
/// In snaps. Edges that cancel are left out, but not across the mouth of a crack: they make a face of it, and
/// a thin face is turned over (PlanarMap::loops).
inline constexpr double kShortGap = 4;
inline constexpr double kHot = 1.25;
/// Arcs shorter than this many snaps become lines, less than a quarter of their length away.
inline constexpr double kShortArc = 16;

[[nodiscard]] Arrangement arrange(const Outlines& outlines, double snap);

}  // namespace lekalo::geom::detail

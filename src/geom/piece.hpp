#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom::detail {

/// Step 1 of docs/design/boolean.md: edges are cut into pieces before they are intersected. A piece is a
/// line, or an arc of at most a quarter turn between two axis directions, so that it runs in one direction in
/// x and in y.
struct Piece {
  EdgeKind kind = EdgeKind::line;
  Point from, to, centre;
  /// The radius of the whole arc: the mean of its ends'.
  double radius = 0;
  /// The edge that the piece is cut from.
  std::uint32_t origin = 0;
  bool step =
      false;  ///< the line from an arc's end to its mean radius, where they differ by more than `slack`
};

[[nodiscard]] inline bool is_arc(const Piece& piece) noexcept { return piece.kind != EdgeKind::line; }

/// Appends the pieces of an edge in its direction. All ends but the two outermost are rounded.
void append_pieces(const Edge& edge, std::uint32_t origin, double slack, std::vector<Piece>& pieces);

[[nodiscard]] Box box_of(const Piece& piece) noexcept;

/// Returns the distance from the line or the circle that carries the piece, positive on the left of its
/// direction.
[[nodiscard]] double side(const Piece& piece, Point p) noexcept;

/// Orders points along the piece: grows from 0 at `from` to length_squared(piece) at `to`.
[[nodiscard]] inline double along(const Piece& piece, Point p) noexcept {
  return dot(p - piece.from, piece.to - piece.from);
}
[[nodiscard]] inline double length_squared(const Piece& piece) noexcept { return along(piece, piece.to); }

/// Says whether a ray from p to the right crosses the piece. An end that is level with the ray counts as
/// above it, so that pieces that share an end count it once. It is exact for lines; an arc's crossing is
/// rounded.
[[nodiscard]] bool crosses_ray(const Piece& piece, Point p) noexcept;

struct Crossings {
  std::array<Point, 2> points;
  int count = 0;
};
/// Returns the places where two pieces cross in points that are ends of neither, or touch. Each point is
/// within rounding of both pieces, also at the smallest angle. Points up to `slack` beyond the end of an arc
/// may come too.
[[nodiscard]] Crossings crossings(const Piece& a, const Piece& b, double slack) noexcept;

}  // namespace lekalo::geom::detail

#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::geom::detail {

/// Edges are cut into pieces before they are intersected. A piece is a line, or an arc of a quarter turn at
/// most between two axis directions, so that it runs in one direction in x and in y.
struct Piece {
  EdgeKind kind = EdgeKind::line;
  Point from, to, centre;
  double radius = 0;         ///< of the whole arc: the mean of its ends'
  std::uint32_t origin = 0;  ///< the edge it is cut from
  bool step =
      false;  ///< the line from an arc's end to its mean radius, where they differ by more than `slack`
};

[[nodiscard]] inline bool is_arc(const Piece& piece) noexcept { return piece.kind != EdgeKind::line; }

/// Appends the pieces of an edge in its direction, all but the outermost ends rounded.
void append_pieces(const Edge& edge, std::uint32_t origin, double slack, std::vector<Piece>& pieces);

[[nodiscard]] Box box_of(const Piece& piece) noexcept;

/// Distance from the line or the circle that carries the piece, positive on the left of its direction.
[[nodiscard]] double side(const Piece& piece, Point p) noexcept;

/// Order along the piece: grows from 0 at `from` to length_squared(piece) at `to`.
[[nodiscard]] inline double along(const Piece& piece, Point p) noexcept {
  return dot(p - piece.from, piece.to - piece.from);
}
[[nodiscard]] inline double length_squared(const Piece& piece) noexcept { return along(piece, piece.to); }

/// The answer says whether a ray from p to the right crosses the piece; an end counts as above the ray where
/// it is on it, so that pieces that share an end count it once. Exact for lines; an arc's crossing is
/// rounded.
[[nodiscard]] bool crosses_ray(const Piece& piece, Point p) noexcept;

struct Crossings {
  std::array<Point, 2> points;
  int count = 0;
};
/// The places where two pieces cross in points that are ends of neither, or touch; each point is within
/// rounding of both, also at the smallest angle. Points up to `slack` beyond the end of an arc may come too.
[[nodiscard]] Crossings crossings(const Piece& a, const Piece& b, double slack) noexcept;

}  // namespace lekalo::geom::detail

#pragma once

#include <string>
#include <vector>

#include "verify/number/span.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {

/// Regions of lines and arcs as they are written, every number enclosed in doubles. Lengths in mm.

struct Vec {
  Span x, y;
};
[[nodiscard]] inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline Vec operator-(const Vec& a) { return {-a.x, -a.y}; }
[[nodiscard]] inline Vec operator*(const Vec& a, Span by) { return {a.x * by, a.y * by}; }
[[nodiscard]] inline Span dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline Span cross(const Vec& a, const Vec& b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline Span length(const Vec& a) { return square_root(squared(a.x) + squared(a.y)); }
/// \pre surely not (0, 0)
[[nodiscard]] inline Vec unit(const Vec& a) {
  const Span whole = length(a);
  return {a.x / whole, a.y / whole};
}

/// How far an arc turns, against half a turn: exact, from the decimals.
enum class Sweep { less, half, more, full };

/// One side of a contour. An arc is the circle about its centre with the mean radius of its two ends, between
/// their directions. What joins an end to that circle along the radius is a line of its own, or, where the
/// ends hardly miss the circle, no farther than `off` from the end.
struct Side {
  bool arc = false;
  Vec from, to;
  Vec centre;
  Span radius;
  double off = 0;
  Sweep sweep = Sweep::less;
  bool ccw = true;
  Vec first, last;    ///< unit directions of an arc's ends, counter-clockwise from first to last
  bool open = false;  ///< no wall of a pocket
  /// The ends as they are written; of what joins an arc to them nothing is.
  bool written = true;
  Vec written_from, written_to;
};

/// A side's decimals in mm, exactly as they stand in the file.
struct WrittenSide {
  bool arc = false, ccw = true;
  Decimal from_x, from_y, to_x, to_y, centre_x, centre_y;
};

/// A set of pieces: inside the outer contour and in no hole of it. The outline belongs to it.
struct Shape {
  std::vector<Side> sides;
  std::vector<WrittenSide> exact;                       ///< of the same numbers, before any placement
  std::vector<std::size_t> contour_starts = {0};        ///< in sides; and the number of sides
  std::vector<std::size_t> piece_starts = {0};          ///< in contours; and the number of contours
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;  ///< a box that holds it
};

/// Coordinates may be this large, mm.
inline constexpr double kLargestCoordinate = 1e9;

/// Reads `{"units": "mm" / "inch", "outer": [edges], "holes": [[edges], ...]}` or `{"units", "pieces":
/// [{"outer", "holes"}, ...]}`; without units they are mm, or inches if that is what `inch` says. Contours
/// must be closed: each edge begins with the very decimals at which the one before ends. An edge with
/// `"open": true` is open.
[[nodiscard]] Shape read_shape(Json value, const std::string& path, std::string& complaint,
                               bool inch = false);

/// The answer says whether two shapes have the same edges in the same order, each contour in either direction
/// from the same first point, with coordinates equal to `tolerance` mm.
[[nodiscard]] bool same_edges(const Shape& a, const Shape& b, double tolerance);

/// (cosine, sine) of a rotation, a shift, and whether x is mirrored before.
struct Motion {
  Span cosine, sine;
  bool mirrored = false;
  Vec shift;
};
[[nodiscard]] Vec placed(const Vec& point, const Motion& motion);
[[nodiscard]] Shape placed(const Shape& shape, const Motion& motion);

struct Box {
  double low_x, low_y, high_x, high_y;
};
/// Holds the side.
[[nodiscard]] Box box_of(const Side& side);

}  // namespace lekalo::verify

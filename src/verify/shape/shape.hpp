#pragma once

#include <memory>
#include <string>
#include <vector>

#include "contour_tree.hpp"
#include "side_tree.hpp"
#include "verify/number/span.hpp"
#include "verify/read/fields.hpp"

namespace lekalo::verify {

/// Regions of lines and arcs as they are written, with every number enclosed in doubles. Lengths are in mm.

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
[[nodiscard]] inline bool surely_not_zero(const Vec& a) { return length(a).low > 0; }
/// \pre surely_not_zero
[[nodiscard]] inline Vec unit(const Vec& a) {
  const Span whole = length(a);
  return {a.x / whole, a.y / whole};
}

/// An arc's turn against half a turn, decided exactly from the decimals.
enum class Sweep { less, half, more, full };

/// One side of a contour. An arc is the circle about its centre with the mean radius of its two ends, between
/// their directions. The way from an end to that circle along the radius is a line of its own. Where the ends
/// hardly miss the circle there is no such line, and the end is no farther than `off` from the circle.
struct Side {
  bool arc = false;
  Vec from, to;
  Vec centre;
  Span radius;
  double off = 0;
  Sweep sweep = Sweep::less;
  bool ccw = true;
  /// The unit directions of an arc's ends, counter-clockwise from first to last.
  Vec first, last;
  /// True for a side that is no wall of a pocket.
  bool open = false;
  /// The ends as the file has them. `written` is false for a line that joins an arc to its end, which the
  /// file does not have.
  bool written = true;
  Vec written_from, written_to;
};

[[nodiscard]] inline Side side_between(const Vec& from, const Vec& to) {
  Side side;
  side.from = from, side.to = to;
  return side;
}

/// The decimals of a side in mm, exactly as they stand in the file.
struct WrittenSide {
  bool arc = false, ccw = true;
  Decimal from_x, from_y, to_x, to_y, centre_x, centre_y;
};

/// A set of pieces. A piece is inside its outer contour and in no hole; the outline belongs to it.
struct Shape {
  std::vector<Side> sides;
  /// The sides' numbers as they are written, before any placement.
  std::vector<WrittenSide> exact;
  /// Indices of sides; the last is the number of sides.
  std::vector<std::size_t> contour_starts = {0};
  /// Indices of contours; the last is the number of contours.
  std::vector<std::size_t> piece_starts = {0};
  /// A box that holds the shape.
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;
  /// Over the sides, made by `bound`.
  std::shared_ptr<const SideTree> tree = {};
  /// Over the contours, made by `bound`.
  std::shared_ptr<const ContourTree> contours = {};
};

/// Reads a list of edges in mm that need not hang together; what is wrong goes to `complaint`.
[[nodiscard]] std::vector<Side> read_loose_edges(Json value, const std::string& path, std::string& complaint);

/// Reads `{"units": "mm" / "inch", "outer": [edges], "holes": [[edges], ...]}` or `{"units", "pieces":
/// [{"outer", "holes"}, ...]}`; without units they are mm, or inches if that is what `inch` says. Contours
/// must be closed: each edge begins where the one before ends, at the decimals of the same double, and
/// coordinates are within limits::kLargestCoordinate. An edge with
/// `"open": true` is open.
[[nodiscard]] Shape read_shape(Json value, const std::string& path, std::string& complaint,
                               bool inch = false);

/// Makes the box of a shape and the trees over its sides and contours. Whoever makes or moves sides calls it.
void bound(Shape& shape);

/// Returns the outline through points in mm, in their order, without those that repeat the one before.
[[nodiscard]] Shape outline_through(const std::vector<Decimal>& x, const std::vector<Decimal>& y);

/// Says whether two shapes have the same edges in the same order, each contour in either direction from the
/// same first point, with coordinates equal to `tolerance` mm. \param walls  the same of them are open
[[nodiscard]] bool same_edges(const Shape& a, const Shape& b, double tolerance, bool walls = false);

/// A motion: (cosine, sine) of a rotation, a shift, and whether x is mirrored before.
struct Motion {
  Span cosine, sine;
  bool mirrored = false;
  Vec shift;
};
[[nodiscard]] Vec placed(const Vec& point, const Motion& motion);
[[nodiscard]] Shape placed(const Shape& shape, const Motion& motion);

/// Returns a box that holds the side.
[[nodiscard]] Box box_of(const Side& side);

}  // namespace lekalo::verify

#pragma once

#include <string>
#include <vector>

#include "fields.hpp"
#include "span.hpp"

namespace lekalo::verify {

/// Regions of lines and arcs as they are written in a result, every number enclosed in doubles. Lengths in
/// mm.

struct Vec {
  Span x, y;
};
[[nodiscard]] inline Vec operator+(const Vec& a, const Vec& b) { return {a.x + b.x, a.y + b.y}; }
[[nodiscard]] inline Vec operator-(const Vec& a, const Vec& b) { return {a.x - b.x, a.y - b.y}; }
[[nodiscard]] inline Span dot(const Vec& a, const Vec& b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline Span cross(const Vec& a, const Vec& b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline Span squared(Span a) {
  const Span product = a * a;
  return {std::max(0.0, product.low), product.high};
}
[[nodiscard]] inline Span length(const Vec& a) { return square_root(squared(a.x) + squared(a.y)); }

/// One edge of a contour. An arc is the circle about its centre with the mean radius of its two ends, between
/// their directions; `off` is how far an end may be from that circle.
struct Side {
  bool arc = false;
  Vec from, to;
  Vec centre;
  Span radius;
  double off = 0;
  bool full = false;
  Vec first, last;  ///< end directions of an arc, counter-clockwise from first to last
};

struct Shape {
  std::vector<Side> sides;
  std::vector<std::size_t> contour_starts = {0};        ///< and the number of sides
  double low_x = 0, low_y = 0, high_x = 0, high_y = 0;  ///< a box that holds it
};

/// Reads `{"units": "mm", "outer": [edges], "holes": [[edges], ...]}` or `{"units": "mm", "pieces":
/// [{"outer", "holes"}, ...]}`. Contours must be closed: each edge begins with the very decimals at which the
/// one before ends.
[[nodiscard]] Shape read_shape(Json value, const std::string& path, std::string& complaint);

/// Whether two shapes have the same edges in the same order, each contour in either direction from the same
/// first point, with coordinates equal to `tolerance` mm.
[[nodiscard]] bool same_edges(const Shape& a, const Shape& b, double tolerance);

/// The shape moved by the rotation (cosine, sine) of its points, mirrored in x before if asked for, and a
/// shift.
[[nodiscard]] Shape placed(const Shape& shape, Span cosine, Span sine, bool mirrored, const Vec& shift);

}  // namespace lekalo::verify

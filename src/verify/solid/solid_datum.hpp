#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "solid_number.hpp"

namespace lekalo::verify {

/// A demand on the place of a part: none of its points is farther from a plane, a line or a point of the
/// blank's frame than `within`.
struct SolidDatum {
  enum class On : std::uint8_t { plane, axis, point };
  std::string name;
  On on = On::plane;
  Both3 through{};    ///< a point of the plane or the line, or the point
  Both3 direction{};  ///< across the plane or along the line, of any length but 0
  double within{};    ///< mm; the double nearest to the decimal
  /// The triangles whose corners are the points, in ascending order; none where the points are given.
  std::vector<std::uint32_t> triangles = {};
  std::vector<Both3> points = {};  ///< three of each triangle, or those given; part coordinates
};

/// Returns the part of a vector that goes straight away from the datum: for that of a place from `through` it
/// is as long as the place is off.
template <class Number>
[[nodiscard]] Of3<Number> straight_off(const SolidDatum& datum, const Of3<Number>& way) {
  if (datum.on == SolidDatum::On::point) return way;
  const Of3<Number> n = as<Number>(datum.direction);
  const Of3<Number> along = n * Number(dot(way, n) / dot(n, n));
  return datum.on == SolidDatum::On::plane ? along : way - along;
}

}  // namespace lekalo::verify

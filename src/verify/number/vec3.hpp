#pragma once

#include <array>

#include "exact.hpp"
#include "span.hpp"

namespace lekalo::verify {

/// A point or a vector of space: of doubles, of enclosures, of fractions and of integers.
template <class Number>
using Of3 = std::array<Number, 3>;
using Near3 = Of3<double>;
using Vec3 = Of3<Span>;
using Exact3 = Of3<Fraction>;
using Whole3 = Of3<Integer>;

[[nodiscard]] inline Vec3 just(const Near3& p) { return {just(p[0]), just(p[1]), just(p[2])}; }

template <class Number>
[[nodiscard]] Of3<Number> operator-(const Of3<Number>& a, const Of3<Number>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class Number>
[[nodiscard]] Of3<Number> operator+(const Of3<Number>& a, const Of3<Number>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class Number>
[[nodiscard]] Of3<Number> operator*(const Of3<Number>& a, const Number& by) {
  return {a[0] * by, a[1] * by, a[2] * by};
}
template <class Number>
[[nodiscard]] Number dot(const Of3<Number>& a, const Of3<Number>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
[[nodiscard]] Of3<Number> cross(const Of3<Number>& a, const Of3<Number>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Returns the normal of a triangle, twice as long as its area.
template <class Number>
[[nodiscard]] Of3<Number> normal(const std::array<Of3<Number>, 3>& t) {
  return cross(t[1] - t[0], t[2] - t[0]);
}
[[nodiscard]] inline Span length(const Vec3& a) {
  return square_root(squared(a[0]) + squared(a[1]) + squared(a[2]));
}

/// Encloses a number, by itself where a double is that.
[[nodiscard]] inline Span enclosed(const Fraction& value) {
  const double cut = cut_to_double(value);
  return Fraction(cut) == value ? just(cut) : outwards(cut, cut);
}
[[nodiscard]] inline Vec3 enclosed(const Exact3& p) {
  return {enclosed(p[0]), enclosed(p[1]), enclosed(p[2])};
}

/// Returns the sign of a number that is surely not 0, and else 0.
[[nodiscard]] inline int sure_sign(Span a) { return a.low > 0 ? 1 : (a.high < 0 ? -1 : 0); }

}  // namespace lekalo::verify

#pragma once

#include "lekalo/geom/expansion.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::geom::detail {

/// Step 2 of docs/design/geometry.md: the tiers of `turn` after turn_filter. Each has its own entry, so that
/// tests can ask which one answered and hold each against the next. A tier that cannot decide answers
/// kUndecided.

[[nodiscard]] constexpr int sign_of(double v) noexcept { return (v > 0) - (v < 0); }

/// The four differences of a cross product (b - a) x (d - c), each exactly as a rounded value and its error.
struct TurnDifferences {
  DoubleDouble x1, y1, x2, y2;

  constexpr TurnDifferences(Point a, Point b, Point c, Point d) noexcept
      : x1(two_sum(b.x, -a.x)), y1(two_sum(b.y, -a.y)), x2(two_sum(d.x, -c.x)), y2(two_sum(d.y, -c.y)) {}
  [[nodiscard]] constexpr bool exact() const noexcept {
    return x1.lo == 0 && y1.lo == 0 && x2.lo == 0 && y2.lo == 0;
  }
};

/// Decides where no difference rounded: for neighbouring points of one drawing, and for everything on a grid.
[[nodiscard]] constexpr int turn_of_exact_differences(const TurnDifferences& t) noexcept {
  if (!t.exact()) return kUndecided;
  const DoubleDouble left = two_product(t.x1.hi, t.y2.hi);
  const DoubleDouble right = two_product(t.y1.hi, t.x2.hi);
  // `hi` is the nearest double of a product, and rounding keeps order. So the two decide where they differ.
  if (left.hi != right.hi) return left.hi > right.hi ? 1 : -1;
  return sign_of(left.lo - right.lo);
}

/// Always decides, by the sum of the sixteen components of the eight exact products.
[[nodiscard]] constexpr int turn_by_expansion(const TurnDifferences& t) noexcept {
  Expansion<16> sum;
  sum.add(two_product(t.x1.lo, t.y2.lo));
  sum.add(two_product(-t.y1.lo, t.x2.lo));
  sum.add(two_product(t.x1.hi, t.y2.lo));
  sum.add(two_product(t.x1.lo, t.y2.hi));
  sum.add(two_product(-t.y1.hi, t.x2.lo));
  sum.add(two_product(-t.y1.lo, t.x2.hi));
  sum.add(two_product(t.x1.hi, t.y2.hi));
  sum.add(two_product(-t.y1.hi, t.x2.hi));
  return sum.sign();
}

}  // namespace lekalo::geom::detail

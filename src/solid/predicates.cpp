#include "lekalo/solid/predicates.hpp"

#include <cmath>
#include <initializer_list>

#include "lekalo/geom/expansion.hpp"

namespace lekalo::solid {
namespace {

using geom::DoubleDouble;
using geom::two_product;
using geom::two_sum;

/// Six products of two differences, each a double and its error, times a third: 6 x 8 products of three
/// doubles, each exactly four doubles.
using Sum = geom::Expansion<192>;

void add_product(Sum& sum, DoubleDouble a, DoubleDouble b, DoubleDouble c) noexcept {
  for (const double x : {a.lo, a.hi}) {
    for (const double y : {b.lo, b.hi}) {
      const DoubleDouble xy = two_product(x, y);
      for (const double z : {c.lo, c.hi}) {
        sum.add(two_product(xy.lo, z));
        sum.add(two_product(xy.hi, z));
      }
    }
  }
}

int exact_side(Vector a, Vector b, Vector c, Vector p) noexcept {
  const DoubleDouble ux = two_sum(b.x, -a.x), uy = two_sum(b.y, -a.y), uz = two_sum(b.z, -a.z);
  const DoubleDouble vx = two_sum(c.x, -a.x), vy = two_sum(c.y, -a.y), vz = two_sum(c.z, -a.z);
  const DoubleDouble wx = two_sum(p.x, -a.x), wy = two_sum(p.y, -a.y), wz = two_sum(p.z, -a.z);
  Sum sum;
  add_product(sum, uy, vz, wx);
  add_product(sum, -uz, vy, wx);
  add_product(sum, uz, vx, wy);
  add_product(sum, -ux, vz, wy);
  add_product(sum, ux, vy, wz);
  add_product(sum, -uy, vx, wz);
  return sum.sign();
}

}  // namespace

int side_of_plane(Vector a, Vector b, Vector c, Vector p) noexcept {
  const Vector u = b - a, v = c - a, w = p - a;
  const double x1 = u.y * v.z, x2 = u.z * v.y, y1 = u.z * v.x, y2 = u.x * v.z, z1 = u.x * v.y, z2 = u.y * v.x;
  const double sum = (x1 - x2) * w.x + (y1 - y2) * w.y + (z1 - z2) * w.z;
  const double size = (std::abs(x1) + std::abs(x2)) * std::abs(w.x) +
                      (std::abs(y1) + std::abs(y2)) * std::abs(w.y) +
                      (std::abs(z1) + std::abs(z2)) * std::abs(w.z);
  // Each of the six products of three differences is rounded eight times at most, by 2^-53 of itself: three
  // differences, two products, the difference of two and the two sums; 9 pays for second order and for
  // rounding `size`.
  const double bound = 0x9p-53 * size;
  if (sum > bound) return 1;
  if (sum < -bound) return -1;
  return exact_side(a, b, c, p);
}

}  // namespace lekalo::solid

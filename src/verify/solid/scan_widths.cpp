#include "scan_widths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "solid_number.hpp"

namespace lekalo::verify {
namespace {

/// Enclosures of squared radii wider than this part of them come from fractions, and so do the widths of
/// triangles that leave less than this part of the squared radius.
constexpr double kLoose = 0x1p-36, kNearlyUnknown = 0.01;

template <class Number>
using Corners = std::array<Of3<Number>, 3>;

/// A triangle as its smallest circle needs it: the squares of its longest side and of the two others, their
/// product across it, and the square of twice the area.
template <class Number>
struct Sides {
  Number longest, one, other, along, area;

  Sides(const Corners<Number>& p, std::size_t across) {
    const Of3<Number> a = p[(across + 1) % 3] - p[across], b = p[(across + 2) % 3] - p[across], c = b - a,
                      n = cross(a, b);
    longest = dot(c, c), one = dot(a, a), other = dot(b, b), along = dot(a, b), area = dot(n, n);
  }
};

/// Returns the corner across the longest side.
template <class Number, class Less>
std::size_t across_longest(const Corners<Number>& p, const Less& less) {
  std::array<Number, 3> squares;
  for (std::size_t k = 0; k < 3; ++k) {
    const Of3<Number> side = p[(k + 2) % 3] - p[(k + 1) % 3];
    squares[k] = dot(side, side);
  }
  std::size_t at = 0;
  for (const std::size_t k : {1U, 2U})
    if (less(squares[at], squares[k])) at = k;
  return at;
}

/// Returns the squared radius of the smallest circle around a triangle.
Fraction squared_circle(const Corners<Fraction>& p) {
  const Sides<Fraction> s(p, across_longest(p, [](const Fraction& a, const Fraction& b) { return a < b; }));
  if (sgn(s.along) <= 0) return s.longest / 4;
  return s.longest * s.one * s.other / (4 * s.area);
}
/// The circle through the corners is not smaller than it, and the one about the longest side not larger, so
/// that both together enclose it where the angle is not told from a right one.
Span squared_circle(const Corners<Span>& p) {
  const Sides<Span> s(p, across_longest(p, [](Span a, Span b) { return a.low + a.high < b.low + b.high; }));
  const Span about_side = s.longest * just(0.25);
  if (s.along.high <= 0) return about_side;
  const Span through = s.longest * s.one * s.other / (just(4) * s.area);
  return {s.along.low > 0 ? std::max(about_side.low, through.low) : about_side.low, through.high};
}

class Widths {
 public:
  Widths(const SolidMesh& mesh, const WrittenSolidScan& scan) : mesh_(mesh), scan_(scan) {
    if (!scan.underside) return;
    level_ = approximate(scan.underside->z);
    flat_ = approximate(scan.underside->flat);
  }

  /// The widths by the radius or by the dip.
  [[nodiscard]] ScanWidths by(bool radius) const {
    ScanWidths made;
    made.widest = just(0);
    for (std::uint32_t k = 0; k < mesh_.triangles.size(); ++k) {
      ask();
      const std::optional<Span> width = width_of(k, radius);
      if (!width) {
        ++made.unknown;
        made.unknown_area = made.unknown_area + area(k);
      }
      const Span is = width.value_or(enclosed(guard_of(k)));
      made.widest = {std::max(made.widest.low, is.low), std::max(made.widest.high, is.high)};
      made.of.push_back(is);
    }
    return made;
  }

 private:
  /// Returns how many corners are of the underside. The numbers count as their nearest doubles.
  [[nodiscard]] std::size_t below(std::uint32_t triangle) const {
    if (!scan_.underside) return 0;
    return static_cast<std::size_t>(std::ranges::count_if(
        mesh_.triangles[triangle],
        [&](std::uint32_t vertex) { return std::abs(mesh_.near[vertex][2] - level_) <= flat_; }));
  }
  [[nodiscard]] Fraction guard_of(std::uint32_t triangle) const {
    const Fraction guard = to_fraction(scan_.guard);
    return below(triangle) > 0 ? std::max(guard, to_fraction(scan_.underside->flat)) : guard;
  }

  [[nodiscard]] std::optional<Span> width_of(std::uint32_t triangle, bool radius) const {
    if (below(triangle) == 3) return enclosed(scan_.underside->flat);
    const Fraction guard = guard_of(triangle);
    if (!radius) return enclosed(Fraction(guard + to_fraction(*scan_.max_dip)));
    const Fraction reach = to_fraction(*scan_.min_radius);
    const Span whole = enclosed(reach), circle = squared_circle(corners(triangle));
    const Span left = squared(whole - enclosed(guard)) - circle;
    if (circle.high - circle.low <= kLoose * circle.high &&
        left.low > kNearlyUnknown * whole.high * whole.high)
      return whole - square_root(left);
    const Fraction inner = reach - guard, exact = inner * inner - squared_circle(exact_corners(triangle));
    if (sgn(exact) <= 0) return std::nullopt;
    return whole - square_root(enclosed(exact));
  }

  [[nodiscard]] Corners<Span> corners(std::uint32_t triangle) const {
    Corners<Span> at;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[k][axis] = mesh_.enclosed(mesh_.triangles[triangle][k], axis);
    return at;
  }
  [[nodiscard]] Corners<Fraction> exact_corners(std::uint32_t triangle) const {
    ask(10);
    Corners<Fraction> at;
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t axis = 0; axis < 3; ++axis)
        at[k][axis] = mesh_.exact(mesh_.triangles[triangle][k], axis);
    return at;
  }
  [[nodiscard]] Span area(std::uint32_t triangle) const {
    const Corners<Span> p = corners(triangle);
    return length(cross(p[1] - p[0], p[2] - p[0])) * just(0.5);
  }

  const SolidMesh& mesh_;
  const WrittenSolidScan& scan_;
  double level_ = 0, flat_ = 0;
};

}  // namespace

ScanWidths scan_widths(const SolidMesh& mesh, const WrittenSolidScan& scan) {
  const Widths widths(mesh, scan);
  if (!scan.min_radius) return widths.by(false);
  ScanWidths by_radius = widths.by(true);
  if (!scan.max_dip) return by_radius;
  ScanWidths by_dip = widths.by(false);
  return by_radius.unknown == 0 && by_radius.widest.high <= by_dip.widest.high ? std::move(by_radius)
                                                                               : std::move(by_dip);
}

}  // namespace lekalo::verify

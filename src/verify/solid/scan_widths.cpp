#include "scan_widths.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lekalo/base/stop.hpp"
#include "verify/number/both.hpp"

namespace lekalo::verify {
namespace {

/// The enclosure of what a circle leaves of a squared radius decides where it is no wider than this part of
/// it; else fractions do.
constexpr double kLoose = 0x1p-36;

template <class Number>
using Corners = std::array<Of3<Number>, 3>;

template <class Number>
using AtCorners = std::array<Number, 3>;

double size_of(Span value) { return value.low + value.high; }
const Fraction& size_of(const Fraction& value) { return value; }

/// Returns the product of the two sides at the largest angle, or 0 where it is no acute one. Of spans the low
/// end is the least of all corners', because the largest angle may be another one than it seems to be.
Span acute(const AtCorners<Span>& products, std::size_t at) {
  const double least = std::ranges::min(products, {}, &Span::low).low;
  return {std::max(0.0, least), std::max(0.0, products[at].high)};
}
Fraction acute(const AtCorners<Fraction>& products, std::size_t at) {
  return std::max(Fraction(), products[at]);
}

/// Returns the squared diameter of the smallest circle around a triangle: the square of the longest side,
/// over 1 - c^2 where the angle across it is an acute one, of the cosine c.
template <class Number>
Number squared_diameter(const Corners<Number>& p) {
  AtCorners<Number> products;
  for (std::size_t k = 0; k < 3; ++k) products[k] = dot(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
  const auto least = std::ranges::min_element(
      products, {}, [](const Number& product) -> decltype(auto) { return size_of(product); });
  const auto at = static_cast<std::size_t>(least - products.begin());
  const Of3<Number> a = p[(at + 1) % 3] - p[at], b = p[(at + 2) % 3] - p[at], longest = b - a;
  const Number along = acute(products, at), sides = dot(a, a) * dot(b, b);
  return Number(dot(longest, longest) * sides) / Number(sides - along * along);
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
    const Span whole = enclosed(reach);
    const Span left = squared(whole - enclosed(guard)) - squared_diameter(corners(triangle)) * just(0.25);
    if (left.high - left.low <= kLoose * left.low) return whole - square_root(left);
    const Fraction inner = reach - guard,
                   exact = inner * inner - squared_diameter(exact_corners(triangle)) / 4;
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
    return length(normal(p)) * just(0.5);
  }

  const SolidMesh& mesh_;
  const WrittenSolidScan& scan_;
  double level_{}, flat_{};
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

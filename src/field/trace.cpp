#include "lekalo/field/trace.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lekalo::field {
namespace {

using geom::Point;

/// The direction along the level line with higher values on the left.
std::optional<Point> along(const Function& f, Point p) {
  const Point gradient = f(p).gradient;
  const double length = norm(gradient);
  if (!(length > 1e-12)) return std::nullopt;
  return (-1 / length) * geom::perpendicular(gradient);
}

}  // namespace

std::vector<Point> gradient_spiral(const Function& f, Point start, double step, std::size_t most) {
  std::vector<Point> path;
  for (Point at = start; path.size() < most;) {
    if (!(f(at).value > 0)) break;
    path.push_back(at);
    const auto way = along(f, at);
    if (!way) break;
    at = at + step * *way;
  }
  return path;
}

Point peak_of(const Function& f, Point start, double step, double tolerance) {
  Point at = start;
  Jet jet = f(at);
  while (step > tolerance) {
    const double length = norm(jet.gradient);
    if (!(length > 1e-12)) break;
    const Point next = at + (step / length) * jet.gradient;
    const Jet there = f(next);
    if (there.value > jet.value)
      at = next, jet = there;
    else
      step *= 0.5;
  }
  return at;
}

}  // namespace lekalo::field

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

/// To the level along the gradient; nothing where that does not come to an end.
std::optional<Point> back_to_level(const Function& f, Point p, double level, double tolerance) {
  for (int i = 0; i < 20; ++i) {
    const Jet at = f(p);
    const double square = dot(at.gradient, at.gradient);
    if (!(square > 1e-24)) return std::nullopt;
    const double off = (level - at.value) / square;
    if (std::abs(off) * std::sqrt(square) <= 0.5 * tolerance) return p;
    p = p + off * at.gradient;
  }
  return std::nullopt;
}

}  // namespace

std::vector<Point> level_line(const Function& f, Point start, double longest, double tolerance,
                              std::size_t most) {
  std::vector<Point> line{start};
  const double level = f(start).value;
  double step = longest, whole = 0;
  Point at = start;
  while (line.size() < most) {
    const auto k1 = along(f, at);
    if (!k1) return line;
    const auto k2 = along(f, at + (0.5 * step) * *k1);
    const auto k3 = k2 ? along(f, at + (0.75 * step) * *k2) : k2;
    if (!k3) return line;
    const Point next = at + (step / 9) * (2.0 * *k1 + 3.0 * *k2 + 4.0 * *k3);
    const auto k4 = along(f, next);
    if (!k4) return line;
    const double error = (step / 72) * norm(-5.0 * *k1 + 6.0 * *k2 + 8.0 * *k3 - 9.0 * *k4);
    if (error > 0.5 * tolerance && step > 1e-6 * longest) {
      step *= 0.5;
      continue;
    }
    const auto put = back_to_level(f, next, level, tolerance);
    if (!put) return line;
    const double moved = norm(*put - at);
    // Round: what is left to the beginning is ahead and shorter than this step.
    if (whole > 2 * step && norm(start - at) <= moved && dot(start - at, *k1) >= 0) {
      line.push_back(start);
      return line;
    }
    line.push_back(*put);
    whole += moved;
    at = *put;
    if (error < 0.05 * tolerance) step = std::min(longest, 1.5 * step);
  }
  return line;
}

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

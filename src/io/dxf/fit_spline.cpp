#include "fit_spline.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::io {
namespace {

using geom::Point;

/// The derivatives at all points, by elimination: the rows have a dominant diagonal, so no pivot is needed.
std::vector<Point> derivatives(const std::vector<Point>& points, const std::vector<double>& chords,
                               std::optional<Point> begins, std::optional<Point> ends) {
  const std::size_t n = points.size();
  const auto slope = [&](std::size_t i) { return (1 / chords[i]) * (points[i + 1] - points[i]); };
  std::vector<double> above(n, 0);
  std::vector<Point> right(n);
  // The first row is eliminated into itself, each further one by the row before it.
  above[0] = begins ? 0 : 0.5;
  right[0] = begins ? *begins : 1.5 * slope(0);
  for (std::size_t i = 1; i < n; ++i) {
    const bool last = i + 1 == n;
    const double below = last ? (ends ? 0 : 1) : chords[i];
    const double diagonal = last ? (ends ? 1 : 2) : 2 * (chords[i - 1] + chords[i]);
    const double after = last ? 0 : chords[i - 1];
    const Point wanted =
        last ? (ends ? *ends : 3 * slope(i - 1)) : 3 * (chords[i] * slope(i - 1) + chords[i - 1] * slope(i));
    const double left = diagonal - below * above[i - 1];
    above[i] = after / left;
    right[i] = (1 / left) * (wanted - below * right[i - 1]);
  }
  for (std::size_t i = n - 1; i-- > 0;) right[i] = right[i] - above[i] * right[i + 1];
  return right;
}

std::optional<Point> unit(std::optional<Point> direction) {
  if (!direction) return std::nullopt;
  const double length = geom::norm(*direction);
  if (!(length > 0)) return std::nullopt;
  return (1 / length) * *direction;
}

}  // namespace

std::optional<BoundedShape> spline_through(const std::vector<Point>& points, double point_error,
                                           std::optional<Point> begins, std::optional<Point> ends) {
  std::vector<Point> apart;
  for (const Point& p : points)
    if (apart.empty() || !(p == apart.back())) apart.push_back(p);
  if (apart.size() < 2) return std::nullopt;
  begins = unit(begins), ends = unit(ends);
  std::vector<double> chords;
  for (std::size_t i = 0; i + 1 < apart.size(); ++i) chords.push_back(geom::norm(apart[i + 1] - apart[i]));
  const std::vector<Point> slopes = derivatives(apart, chords, begins, ends);
  Spline spline;
  spline.degree = 3;
  spline.knots.assign(4, 0.0);
  double parameter = 0, size = 0;
  for (std::size_t i = 0; i < chords.size(); ++i) {
    const double third = chords[i] / 3;
    if (i == 0) spline.poles.push_back(apart[0]);
    spline.poles.push_back(apart[i] + third * slopes[i]);
    spline.poles.push_back(apart[i + 1] - third * slopes[i + 1]);
    spline.poles.push_back(apart[i + 1]);
    // Chords that are lost beside the length so far would leave knots that do not ascend.
    parameter = std::max(parameter + chords[i], std::nextafter(parameter, HUGE_VAL));
    spline.knots.insert(spline.knots.end(), i + 1 == chords.size() ? 4 : 3, parameter);
  }
  for (const Point& p : spline.poles) size = std::max({size, std::abs(p.x), std::abs(p.y)});
  // A derivative is off by at most three times what the slopes beside it are off, since its row weighs its
  // neighbours half as much as itself; a third of a chord carries that into a pole.
  const auto [least, most] = std::minmax_element(chords.begin(), chords.end());
  const double share = 1 + 6 * *most / *least;
  return BoundedShape{std::move(spline), 2 * share * (point_error + 8 * kUnitRoundoff * size)};
}

}  // namespace lekalo::io

#include "bezier.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "io/text/decimal.hpp"
#include "lekalo/base/angle.hpp"
#include "lekalo/geom/arc_ends.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::io {
namespace {

WeightedPoint between(const WeightedPoint& a, const WeightedPoint& b, double t) noexcept {
  const double s = 1 - t;
  return {s * a.x + t * b.x, s * a.y + t * b.y, s * a.w + t * b.w};
}

bool in_range(double v) { return geom::is_exact_coordinate(v) && std::abs(v) <= kLargestMillimetres; }

std::optional<std::string> point_fault(geom::Point p) {
  if (in_range(p.x) && in_range(p.y)) return std::nullopt;
  return fmt::format("its point ({}, {}) is not finite or beyond {} mm", p.x, p.y, kLargestMillimetres);
}

std::optional<std::string> fault(const geom::Edge& edge) {
  if (auto found = point_fault(edge.from)) return found;
  if (auto found = point_fault(edge.to)) return found;
  if (edge.kind == geom::EdgeKind::line) return std::nullopt;
  if (auto found = point_fault(edge.centre)) return found;
  const double from = norm(edge.from - edge.centre), to = norm(edge.to - edge.centre);
  const double allowed = geom::allowed_radius_difference(edge);
  if (from > 0 && to > 0 && std::abs(from - to) <= allowed) return std::nullopt;
  return fmt::format("its ends are {} and {} mm from its centre; they may differ by {:.3g} mm", from, to,
                     allowed);
}

std::optional<std::string> fault(const EllipseArc& arc) {
  for (const geom::Point p : {arc.from, arc.to, arc.centre, arc.u, arc.v})
    if (auto found = point_fault(p)) return found;
  if (!(std::abs(arc.begin) <= kLargestParameter && arc.begin < arc.end &&
        arc.end <= arc.begin + 2 * kPi * (1 + 0x1p-40)))
    return fmt::format("its arc from {} to {} rad is none or more than a turn", arc.begin, arc.end);
  return std::nullopt;
}

std::optional<std::string> fault(const Spline& spline) {
  const std::size_t n = spline.degree, poles = spline.poles.size();
  if (n < 1 || n > kHighestDegree)
    return fmt::format("its degree is {}; 1 to {} are read", n, kHighestDegree);
  if (poles <= n || spline.knots.size() != poles + n + 1)
    return fmt::format("{} poles and {} knots are no spline of degree {}", poles, spline.knots.size(), n);
  for (const geom::Point p : spline.poles)
    if (auto found = point_fault(p)) return found;
  for (std::size_t i = 0; i < spline.knots.size(); ++i)
    if (!std::isfinite(spline.knots[i]) || (i > 0 && spline.knots[i] < spline.knots[i - 1]))
      return fmt::format("its knot {} is {}; knots are finite and do not descend", i, spline.knots[i]);
  if (!std::isfinite(spline.knots.back() - spline.knots.front()) || !(spline.knots[n] < spline.knots[poles]))
    return fmt::format("its knots span {} to {}", spline.knots[n], spline.knots[poles]);
  // A knot inside the span that stands degree + 1 times splits the curve between two poles.
  for (std::size_t i = 1; i + n + 1 < spline.knots.size(); ++i) {
    if (spline.knots[i] != spline.knots[i + n] || !(spline.knots[i] > spline.knots[n]) ||
        !(spline.knots[i] < spline.knots[poles]))
      continue;
    if (spline.poles[i - 1] != spline.poles[i])
      return fmt::format("it jumps from ({}, {}) to ({}, {}) mm at its knot {}", spline.poles[i - 1].x,
                         spline.poles[i - 1].y, spline.poles[i].x, spline.poles[i].y, i);
  }
  if (spline.weights.empty()) return std::nullopt;
  if (spline.weights.size() != poles)
    return fmt::format("{} weights do not match {} poles", spline.weights.size(), poles);
  const auto [least, largest] = std::minmax_element(spline.weights.begin(), spline.weights.end());
  for (const double w : spline.weights)
    if (!std::isfinite(w) || !(w > 0)) return fmt::format("its weight {} is not above 0", w);
  if (!(*largest / *least <= kLargestWeightRatio))
    return fmt::format("its weights {} and {} differ by more than a factor of {}", *least, *largest,
                       kLargestWeightRatio);
  return std::nullopt;
}

/// The piece over the knots [span] to [span + 1], by blossoms: pole j is the blossom of degree - j times the
/// left knot and j times the right one.
Bezier piece_over(const Spline& spline, const std::vector<WeightedPoint>& poles, std::size_t span) {
  const std::size_t n = spline.degree;
  Bezier piece;
  piece.degree = n;
  for (std::size_t j = 0; j <= n; ++j) {
    std::array<WeightedPoint, kHighestDegree + 1> local;
    for (std::size_t i = 0; i <= n; ++i) local[i] = poles[span - n + i];
    for (std::size_t level = 1; level <= n; ++level) {
      const double t = spline.knots[level <= n - j ? span : span + 1];
      for (std::size_t i = n; i >= level; --i) {
        const double low = spline.knots[span - n + i], high = spline.knots[span + i + 1 - level];
        local[i] = between(local[i - 1], local[i], (t - low) / (high - low));
      }
    }
    piece.poles[j] = local[n];
  }
  return piece;
}

}  // namespace

std::optional<std::string> fault_of_shape(const Shape& shape) {
  return std::visit([](const auto& s) { return fault(s); }, shape);
}

BezierChain bezier_chain(const Spline& spline) {
  BezierChain chain;
  std::vector<WeightedPoint> poles;
  double size = 0, heaviest = 1;
  if (!spline.weights.empty()) heaviest = *std::max_element(spline.weights.begin(), spline.weights.end());
  for (std::size_t i = 0; i < spline.poles.size(); ++i) {
    const geom::Point p = spline.poles[i];
    const double w = spline.weights.empty() ? 1 : spline.weights[i] / heaviest;
    poles.push_back({w * p.x, w * p.y, w});
    size = std::max({size, std::abs(p.x), std::abs(p.y)});
  }
  for (std::size_t span = spline.degree; span < spline.poles.size(); ++span)
    if (spline.knots[span] < spline.knots[span + 1]) chain.pieces.push_back(piece_over(spline, poles, span));
  chain.error = kCurveRounding * size;
  return chain;
}

BezierChain bezier_chain(const EllipseArc& arc) {
  BezierChain chain;
  const auto at = [&arc](geom::SinCos angle, double out) {
    return arc.centre + (out * angle.cosine) * arc.u + (out * angle.sine) * arc.v;
  };
  const double sweep = arc.end - arc.begin;
  const auto count = static_cast<std::size_t>(std::ceil(sweep / (kPi / 2) - 0x1p-20));
  const double half = sweep / (2 * static_cast<double>(std::max<std::size_t>(count, 1)));
  const double weight = geom::sincos(half).cosine;
  double size = norm(arc.centre) + norm(arc.u) + norm(arc.v);
  geom::Point from = arc.from;
  for (std::size_t i = 0; i < std::max<std::size_t>(count, 1); ++i) {
    const double middle = arc.begin + (2 * static_cast<double>(i) + 1) * half;
    const bool last = i + 1 >= count;
    const geom::Point corner = at(geom::sincos(middle), 1 / weight);
    const geom::Point to = last ? arc.to : at(geom::sincos(middle + half), 1);
    Bezier piece;
    piece.degree = 2;
    piece.poles[0] = {from.x, from.y, 1};
    piece.poles[1] = {weight * corner.x, weight * corner.y, weight};
    piece.poles[2] = {to.x, to.y, 1};
    chain.pieces.push_back(piece);
    from = to;
  }
  // The ends of the file take the place of the computed ones; so far they may move the curve.
  const double moved =
      std::max(norm(arc.from - at(geom::sincos(arc.begin), 1)), norm(arc.to - at(geom::sincos(arc.end), 1)));
  chain.error = kCurveRounding * size + moved;
  return chain;
}

Bezier part_of(const Bezier& piece, double begin, double end) noexcept {
  Bezier part = piece;
  const std::size_t n = piece.degree;
  if (end < 1)
    for (std::size_t level = 1; level <= n; ++level)
      for (std::size_t i = n; i >= level; --i) part.poles[i] = between(part.poles[i - 1], part.poles[i], end);
  if (begin > 0) {
    const double t = begin / end;
    for (std::size_t level = 1; level <= n; ++level)
      for (std::size_t i = 0; i + level <= n; ++i)
        part.poles[i] = between(part.poles[i], part.poles[i + 1], t);
  }
  return part;
}

geom::Point point_at(const Bezier& piece, double t) noexcept {
  if (t <= 0) return piece.poles[0].point();
  if (t >= 1) return piece.poles[piece.degree].point();
  return part_of(piece, 0, t).poles[piece.degree].point();
}

}  // namespace lekalo::io

#include "curve_edges.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bezier.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::io {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// Radii above this many chords are not used: their arcs are nearly lines, and their centres' own digits
/// would be the limit (kCurveRounding counts on this).
constexpr double kLargestRadiusInChords = 256;
/// The shortest step, in Bezier pieces. Parts of a curve that short are lines within any tolerance that
/// rounding leaves, so that it is not reached but by tolerances that cannot be met.
constexpr double kShortestStep = 0x1p-30;
/// The number of times that the bounds of a piece are halved before its arc is given up.
constexpr int kBoundDepth = 4;

/// The table of binomial(n, i) for n up to twice the highest degree, exact.
class Binomials {
 public:
  constexpr Binomials() {
    for (std::size_t n = 0; n <= 2 * kHighestDegree; ++n) {
      rows_[n][0] = rows_[n][n] = 1;
      for (std::size_t i = 1; i < n; ++i) rows_[n][i] = rows_[n - 1][i - 1] + rows_[n - 1][i];
    }
  }
  [[nodiscard]] constexpr double operator()(std::size_t n, std::size_t i) const { return rows_[n][i]; }

 private:
  std::array<std::array<double, 2 * kHighestDegree + 1>, 2 * kHighestDegree + 1> rows_{};
};
constexpr Binomials kBinomial;

/// A ratio of two polynomials in Bernstein form, the lower one's coefficients above 0. Its values lie between
/// the least and the largest ratio of coefficients.
struct BernsteinRatio {
  std::size_t degree = 0;
  std::array<double, 2 * kHighestDegree + 1> above{}, below{};
};

/// The largest magnitude of the ratio, if it is proven to be at most `limit`.
std::optional<double> largest_magnitude(const BernsteinRatio& ratio, double limit, int depth) {
  const std::size_t n = ratio.degree;
  double largest = 0;
  for (std::size_t i = 0; i <= n; ++i) largest = std::max(largest, std::abs(ratio.above[i]) / ratio.below[i]);
  if (largest <= limit) return largest;
  const bool ends_within = std::abs(ratio.above[0]) <= limit * ratio.below[0] &&
                           std::abs(ratio.above[n]) <= limit * ratio.below[n];
  if (depth == 0 || !ends_within) return std::nullopt;
  BernsteinRatio left = ratio, right = ratio;
  for (std::size_t level = 1; level <= n; ++level) {
    for (std::size_t i = 0; i + level <= n; ++i) {
      right.above[i] = 0.5 * (right.above[i] + right.above[i + 1]);
      right.below[i] = 0.5 * (right.below[i] + right.below[i + 1]);
    }
    left.above[level] = right.above[0];
    left.below[level] = right.below[0];
  }
  const auto a = largest_magnitude(left, limit, depth - 1);
  if (!a) return a;
  const auto b = largest_magnitude(right, limit, depth - 1);
  return b ? std::optional(std::max(*a, *b)) : b;
}

/// (|C|^2 - 2 C . c) for the points C of the piece: |C - c|^2 less the square of the distance of c from the
/// origin, without the cancellation.
BernsteinRatio beyond_circle(const Bezier& piece, Point origin, Point centre) {
  const std::size_t n = piece.degree;
  std::array<Point, kHighestDegree + 1> local;
  std::array<double, kHighestDegree + 1> towards{};
  for (std::size_t i = 0; i <= n; ++i) {
    local[i] = piece.poles[i].point() - origin;
    towards[i] = dot(local[i], centre);
  }
  BernsteinRatio ratio;
  ratio.degree = 2 * n;
  for (std::size_t i = 0; i <= n; ++i) {
    for (std::size_t j = 0; j <= n; ++j) {
      const double share =
          kBinomial(n, i) * kBinomial(n, j) / kBinomial(2 * n, i + j) * piece.poles[i].w * piece.poles[j].w;
      ratio.above[i + j] += share * (dot(local[i], local[j]) - towards[i] - towards[j]);
      ratio.below[i + j] += share;
    }
  }
  return ratio;
}

/// A candidate arc of at most a quarter turn, origin at its beginning.
struct ArcCandidate {
  Edge arc;
  Point centre;          ///< from the arc's beginning
  double radius = 0;     ///< at its beginning
  Point first, last;     ///< end directions from the centre, counter-clockwise
  double end_error = 0;  ///< difference of the radii at its ends
};

/// The arc through three points, if it is one of at most a quarter turn and not nearly a line.
std::optional<ArcCandidate> arc_through(Point from, Point middle, Point to) {
  const Point m = middle - from, q = to - from;
  const double turn = cross(m, q), chord = norm(q);
  if (turn == 0 || !std::isfinite(turn)) return std::nullopt;
  const Point ideal =
      (1 / (2 * turn)) * Point{dot(m, m) * q.y - dot(q, q) * m.y, dot(q, q) * m.x - dot(m, m) * q.x};
  if (!(norm(ideal) <= kLargestRadiusInChords * chord)) return std::nullopt;
  ArcCandidate made;
  const bool left = turn > 0;
  made.arc = {left ? EdgeKind::arc_ccw : EdgeKind::arc_cw, from, to, from + ideal};
  made.centre = made.arc.centre - from;
  made.radius = norm(made.centre);
  made.first = left ? -made.centre : q - made.centre;
  made.last = left ? q - made.centre : -made.centre;
  if (!(dot(made.first, made.last) >= 0) || !(cross(made.first, made.last) > 0)) return std::nullopt;
  made.end_error = std::abs(norm(q - made.centre) - made.radius);
  return made;
}

/// A bound on the distance of the piece from the arc and back, if it is proven to be within `limit`.
std::optional<double> distance_bound(const ArcCandidate& arc, const Bezier& piece, double limit) {
  const Point bisector = arc.first + arc.last;
  double aside = 0;  // poles outside the wedge between the arc's ends
  for (std::size_t i = 0; i <= piece.degree; ++i) {
    const Point p = piece.poles[i].point() - arc.arc.from - arc.centre;
    if (!(dot(p, bisector) > 0)) return std::nullopt;
    aside = std::max({aside, -cross(arc.first, p) / norm(arc.first), -cross(p, arc.last) / norm(arc.last)});
  }
  const double left = limit - 2 * aside - arc.end_error;
  if (!(aside <= arc.radius / 4) || !(left > 0)) return std::nullopt;
  const double radial = std::min(left, arc.radius / 2);
  // ||C - c| - r| <= e where ||C - c|^2 - r^2| <= e (2 r - e).
  const auto squared = largest_magnitude(beyond_circle(piece, arc.arc.from, arc.centre),
                                         radial * (2 * arc.radius - radial), kBoundDepth);
  if (!squared) return std::nullopt;
  const double e = *squared / (arc.radius + std::sqrt(std::max(0.0, arc.radius * arc.radius - *squared)));
  return e + 2 * aside + arc.end_error;
}

/// The largest distance of a pole from the segment: a bound for the whole piece, the segment's surroundings
/// being convex.
double distance_bound(Point from, Point to, const Bezier& piece) {
  const Point along = to - from;
  const double squared = dot(along, along);
  double largest = 0;
  for (std::size_t i = 0; i <= piece.degree; ++i) {
    const Point p = piece.poles[i].point() - from;
    const double t = squared > 0 ? std::clamp(dot(p, along) / squared, 0.0, 1.0) : 0;
    largest = std::max(largest, norm(p - t * along));
  }
  return largest;
}

/// Goes along a chain of Bezier pieces with lines and arcs as long as the tolerance lets them be.
class Follower {
 public:
  Follower(const BezierChain& chain, double tolerance) : pieces_(chain.pieces), tolerance_(tolerance) {}

  /// The edges from the curve's first to its last point, both as given; nothing if the tolerance is out of
  /// reach.
  std::optional<CurveEdges> follow(Point first, Point last) {
    CurveEdges made;
    const auto end = static_cast<double>(pieces_.size());
    double at = 0, step = 1;
    Point from = first;
    while (at < end) {
      ask();
      if (made.edges.size() == kMostEdgesOfACurve) return std::nullopt;
      const double rest = end - at;
      // The last two steps share what is left, so that no short remainder stays at the end.
      double next = rest <= step ? end : at + (rest < 2 * step ? rest / 2 : step);
      std::optional<Fitted> fitted;
      for (;;) {
        if (!(next > at) || next - at < kShortestStep) return std::nullopt;
        const Point to = next < end ? point(next) : last;
        fitted = fit(at, next, from, to);
        if (fitted) break;
        next = at + 0.8 * (next - at);
      }
      if (at == 0) {
        for (double longer = 2 * next; longer <= end; longer *= 2) {
          const auto more = fit(0, longer, from, longer < end ? point(longer) : last);
          if (!more) break;
          fitted = more;
          next = longer;
        }
      }
      step = 1.25 * (next - at);
      if (fitted->edge.from != fitted->edge.to) made.edges.push_back(fitted->edge);
      made.curve_error = std::max(made.curve_error, fitted->error);
      from = fitted->edge.to;
      at = next;
    }
    return made;
  }

 private:
  struct Fitted {
    Edge edge;
    double error = 0;
  };

  [[nodiscard]] std::size_t piece_at(double s) const {
    return std::min(static_cast<std::size_t>(s), pieces_.size() - 1);
  }
  [[nodiscard]] Point point(double s) const {
    const std::size_t i = piece_at(s);
    return point_at(pieces_[i], s - static_cast<double>(i));
  }
  /// Calls visit for the parts of pieces between two places until one returns false.
  template <class Visit>
  bool all_between(double begin, double end, Visit&& visit) const {
    for (std::size_t i = piece_at(begin); i < pieces_.size() && static_cast<double>(i) < end; ++i) {
      const auto base = static_cast<double>(i);
      const double low = std::max(0.0, begin - base), high = std::min(1.0, end - base);
      if (!(low < high)) continue;
      if (!visit(low == 0 && high == 1 ? pieces_[i] : part_of(pieces_[i], low, high))) return false;
    }
    return true;
  }

  [[nodiscard]] std::optional<Fitted> fit(double begin, double end, Point from, Point to) const {
    Fitted fitted{{EdgeKind::line, from, to, {}}, 0};
    const bool straight = all_between(begin, end, [&](const Bezier& part) {
      fitted.error = std::max(fitted.error, distance_bound(from, to, part));
      return fitted.error <= tolerance_;
    });
    if (straight) return fitted;
    const auto arc = arc_through(from, point(begin + 0.5 * (end - begin)), to);
    if (!arc) return std::nullopt;
    fitted = {arc->arc, 0};
    const bool round = all_between(begin, end, [&](const Bezier& part) {
      const auto bound = distance_bound(*arc, part, tolerance_);
      if (bound) fitted.error = std::max(fitted.error, *bound);
      return bound.has_value();
    });
    return round ? std::optional(fitted) : std::nullopt;
  }

  const std::vector<Bezier>& pieces_;
  double tolerance_;
};

Result<CurveEdges> follow(const BezierChain& chain, Point first, Point last, double tolerance) {
  if (auto made = Follower(chain, tolerance).follow(first, last)) {
    made->rounding = chain.error;
    return *std::move(made);
  }
  return failure(ErrorCode::bad_input,
                 fmt::format("is not within {} mm of {} lines and arcs; use a larger curve tolerance",
                             tolerance, kMostEdgesOfACurve));
}

Result<CurveEdges> edges(const Edge& edge, double) {
  CurveEdges made;
  if (edge.kind != EdgeKind::line || edge.from != edge.to) made.edges.push_back(edge);
  if (edge.kind == EdgeKind::line && !made.edges.empty()) made.edges[0].centre = {};
  return made;
}

/// The arc of a circle, if the ellipse is one within rounding.
std::optional<CurveEdges> as_circle(const EllipseArc& arc, double rounding) {
  const double uu = dot(arc.u, arc.u), vv = dot(arc.v, arc.v), uv = dot(arc.u, arc.v);
  // u, v and rounding: the squares of the half axes differ by this.
  const double difference = std::sqrt((uu - vv) * (uu - vv) + 4 * uv * uv);
  if (!(difference <= 0x1p-40 * (uu + vv)) || cross(arc.u, arc.v) == 0) return std::nullopt;
  const Edge edge{cross(arc.u, arc.v) > 0 ? EdgeKind::arc_ccw : EdgeKind::arc_cw, arc.from, arc.to,
                  arc.centre};
  const bool whole = arc.end - arc.begin > 3.2;
  if (edge.from == edge.to ? !whole : std::abs(geom::arc_sweep(edge) - (arc.end - arc.begin)) > 1e-6)
    return std::nullopt;
  return CurveEdges{{edge}, 0, rounding + difference / std::sqrt(uu + vv)};
}

Result<CurveEdges> edges(const EllipseArc& arc, double tolerance) {
  const BezierChain chain = bezier_chain(arc);
  if (auto circle = as_circle(arc, chain.error)) return *std::move(circle);
  return follow(chain, arc.from, arc.to, tolerance);
}

Result<CurveEdges> edges(const Spline& spline, double tolerance) {
  const BezierChain chain = bezier_chain(spline);
  // The poles themselves at clamped ends: a weight may have cost the last digit.
  const auto exact = [&](Point computed, Point pole) {
    return norm(computed - pole) <= chain.error ? pole : computed;
  };
  const Point first = exact(point_at(chain.pieces.front(), 0), spline.poles.front());
  Point last = exact(point_at(chain.pieces.back(), 1), spline.poles.back());
  // Periodic splines end where they begin but for rounding.
  if (norm(last - first) <= 2 * chain.error) last = first;
  if (spline.degree > 1) return follow(chain, first, last, tolerance);
  CurveEdges made;
  Point from = first;
  for (const Bezier& piece : chain.pieces) {
    const Point to = &piece == &chain.pieces.back() ? last : point_at(piece, 1);
    if (to != from) made.edges.push_back({EdgeKind::line, from, to, {}});
    from = to;
  }
  made.rounding = chain.error;
  return made;
}

}  // namespace

Result<CurveEdges> edges_of(const Shape& shape, double tolerance) {
  if (auto fault = fault_of_shape(shape))
    return failure(ErrorCode::bad_input, fmt::format("cannot be used: {}", *fault));
  return std::visit([tolerance](const auto& s) { return edges(s, tolerance); }, shape);
}

}  // namespace lekalo::io

#include "patches.hpp"

#include <GeomConvert_BSplineCurveToBezierCurve.hxx>
#include <GeomConvert_BSplineSurfaceToBezierSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nets.hpp"

namespace lekalo::step {
namespace {

using Point = std::array<double, 4>;
constexpr double kInfinite = std::numeric_limits<double>::infinity();

Point weighed(const gp_Pnt& p, double weight) {
  return {p.X() * weight, p.Y() * weight, p.Z() * weight, weight};
}

double length(const Point& p) { return std::hypot(p[0], p[1], p[2]); }

Point operator-(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2], a[3] - b[3]};
}

/// Cuts a Bezier curve whose control points stand `step` apart to the parameters from..to: control point k is
/// the blossom of n - k times the one and k times the other.
void cut_curve(Point* points, std::size_t degree, std::size_t step, double from, double to) {
  std::vector<Point> cut(degree + 1), row(degree + 1);
  for (std::size_t k = 0; k <= degree; ++k) {
    for (std::size_t i = 0; i <= degree; ++i) row[i] = points[i * step];
    for (std::size_t round = 1; round <= degree; ++round) {
      const double t = round <= degree - k ? from : to;
      for (std::size_t i = 0; i + round <= degree; ++i)
        for (std::size_t axis = 0; axis < 4; ++axis)
          row[i][axis] = (1 - t) * row[i][axis] + t * row[i + 1][axis];
    }
    cut[k] = row[0];
  }
  for (std::size_t k = 0; k <= degree; ++k) points[k * step] = cut[k];
}

/// The longest vector, and the largest weight, of some.
struct Longest {
  double vector = 0, weight = 0;
  void hold(const Point& p) {
    vector = std::max(vector, length(p)), weight = std::max(weight, std::abs(p[3]));
  }
  Longest operator*(double factor) const { return {factor * vector, factor * weight}; }
};

}  // namespace

void DerivativeBounds::hold(const DerivativeBounds& other) noexcept {
  u = std::max(u, other.u), v = std::max(v, other.v);
  uu = std::max(uu, other.uu);
  kink_u += other.kink_u;
}

Patches::Patches(const Handle(Geom_BSplineSurface) & surface) {
  GeomConvert_BSplineSurfaceToBezierSurface convert(surface);
  const int spans_u = convert.NbUPatches(), spans_v = convert.NbVPatches();
  TColStd_Array1OfReal knots_u(1, spans_u + 1), knots_v(1, spans_v + 1);
  convert.UKnots(knots_u);
  convert.VKnots(knots_v);
  u_ = {surface->UDegree(), {knots_u.begin(), knots_u.end()}, {}, 0};
  v_ = {surface->VDegree(), {knots_v.begin(), knots_v.end()}, {}, 0};
  if (surface->IsUPeriodic()) u_.period = u_.knots.back() - u_.knots.front();
  if (surface->IsVPeriodic()) v_.period = v_.knots.back() - v_.knots.front();
  const auto is_kink = [](int degree, int multiplicity) { return multiplicity >= degree; };
  // Knots that the conversion left out have none.
  u_.kinks.assign(u_.knots.size(), surface->NbUKnots() != spans_u + 1);
  v_.kinks.assign(v_.knots.size(), surface->NbVKnots() != spans_v + 1);
  if (surface->NbUKnots() == spans_u + 1)
    for (int k = 0; k <= spans_u; ++k)
      u_.kinks[static_cast<std::size_t>(k)] = is_kink(u_.degree, surface->UMultiplicity(k + 1));
  if (surface->NbVKnots() == spans_v + 1)
    for (int k = 0; k <= spans_v; ++k)
      v_.kinks[static_cast<std::size_t>(k)] = is_kink(v_.degree, surface->VMultiplicity(k + 1));
  for (int i = 1; i <= spans_u; ++i)
    for (int j = 1; j <= spans_v; ++j) {
      const Handle(Geom_BezierSurface) patch = convert.Patch(i, j);
      Points& points = patches_.emplace_back();
      for (int a = 1; a <= patch->NbUPoles(); ++a)
        for (int b = 1; b <= patch->NbVPoles(); ++b)
          points.push_back(weighed(patch->Pole(a, b), patch->Weight(a, b)));
    }
}

Patches::Patches(const Handle(Geom_BSplineCurve) & curve) {
  GeomConvert_BSplineCurveToBezierCurve convert(curve);
  const int spans = convert.NbArcs();
  TColStd_Array1OfReal knots(1, spans + 1);
  convert.Knots(knots);
  u_ = {curve->Degree(), {knots.begin(), knots.end()}, {}, 0};
  if (curve->IsPeriodic()) u_.period = u_.knots.back() - u_.knots.front();
  u_.kinks.assign(u_.knots.size(), curve->NbKnots() != spans + 1);
  if (curve->NbKnots() == spans + 1)
    for (int k = 0; k <= spans; ++k)
      u_.kinks[static_cast<std::size_t>(k)] = curve->Multiplicity(k + 1) >= u_.degree;
  v_ = {0, {0, 1}, {false, false}, 0};
  for (int i = 1; i <= spans; ++i) {
    const Handle(Geom_BezierCurve) arc = convert.Arc(i);
    Points& points = patches_.emplace_back();
    for (int a = 1; a <= arc->NbPoles(); ++a) points.push_back(weighed(arc->Pole(a), arc->Weight(a)));
  }
}

Patches::Patches(const Handle(Geom_BSplineCurve) & curve, const gp_Dir& along) : Patches(curve) {
  v_ = {1, {0, 1}, {false, false}, 0};
  for (Points& points : patches_) {
    Points both;
    for (const Point& p : points) {
      both.push_back(p);
      both.push_back({p[0] + p[3] * along.X(), p[1] + p[3] * along.Y(), p[2] + p[3] * along.Z(), p[3]});
    }
    points = std::move(both);
  }
}

std::vector<Patches::Cell> Patches::spans(const Axis& axis, Range range) {
  std::vector<Cell> found;
  const double first = axis.knots.front();
  const std::size_t count = axis.knots.size() - 1;
  double rounds_from = 0, rounds_to = 0;
  if (axis.period > 0) {
    rounds_from = std::floor((range.low - first) / axis.period);
    rounds_to = std::floor((range.high - first) / axis.period);
  }
  for (double round = rounds_from; round <= rounds_to; ++round)
    for (std::size_t span = 0; span < count; ++span) {
      const double begin = axis.knots[span] + round * axis.period,
                   end = axis.knots[span + 1] + round * axis.period;
      // Beyond its ends the spline goes on as its last polynomials.
      found.push_back({span, axis.period == 0 && span == 0 ? -kInfinite : begin,
                       axis.period == 0 && span + 1 == count ? kInfinite : end, begin, end - begin, end});
    }
  return found;
}

std::vector<Patches::Piece> Patches::pieces(const Axis& axis, Range range) {
  std::vector<Piece> found;
  for (const auto& [span, first, last, begin, size, end] : spans(axis, range)) {
    double low = std::max(range.low, first), high = std::min(range.high, last);
    if (!(low <= high) || (low == high && range.width() > 0)) continue;
    // Differences over a sliver are rounding: a piece is as wide as the box, or as its span.
    constexpr double kNarrowest = 1e-3;
    const double width = std::max({high - low, std::min(range.width(), size), kNarrowest * size});
    if (low >= begin && high <= end) {
      low = std::max(begin, std::min(low, end - width));
      high = low + width;
    } else {
      high = std::max(high, low + width);
    }
    found.push_back({span, (low - begin) / size, (high - begin) / size, low, high - low});
  }
  return found;
}

Patches::Points Patches::cut(const Piece& u, const Piece& v) const {
  Points net = patch(u.span, v.span);
  const std::size_t rows = net.size() / columns();
  for (std::size_t j = 0; j < columns(); ++j) cut_curve(&net[j], rows - 1, columns(), u.from, u.to);
  for (std::size_t i = 0; i < rows; ++i) cut_curve(&net[i * columns()], columns() - 1, 1, v.from, v.to);
  return net;
}

/// With S = N / w, taken from a point c in the middle so that |S - c| <= r: w S_u = N_u - (S - c) w_u, and so
/// on for the second derivative along u, where N is the numerator less c w.
DerivativeBounds Patches::bounds(const Points& net, double width_u, double width_v) const {
  Point low{kInfinite, kInfinite, kInfinite, kInfinite}, high{-kInfinite, -kInfinite, -kInfinite, -kInfinite};
  for (const Point& p : net) {
    if (!(p[3] > 0)) return {kInfinite, kInfinite, kInfinite, 0};
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const double x = axis < 3 ? p[axis] / p[3] : p[3];
      low[axis] = std::min(low[axis], x), high[axis] = std::max(high[axis], x);
    }
  }
  double r = 0;
  Points moved = net;
  for (Point& p : moved) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] -= 0.5 * (low[axis] + high[axis]) * p[3];
    r = std::max(r, length(p) / p[3]);
  }
  const std::size_t n = columns(), rows = net.size() / n;
  const auto at = [&](std::size_t i, std::size_t j) -> const Point& { return moved[i * n + j]; };
  Longest u, v, uu;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i + 1 < rows) u.hold(at(i + 1, j) - at(i, j));
      if (j + 1 < n) v.hold(at(i, j + 1) - at(i, j));
      if (i + 2 < rows) uu.hold((at(i + 2, j) - at(i + 1, j)) - (at(i + 1, j) - at(i, j)));
    }
  const double p = static_cast<double>(rows - 1), q = static_cast<double>(n - 1);
  u = u * (p / width_u), v = v * (q / width_v);
  uu = uu * (p * (p - 1) / (width_u * width_u));
  const double least = low[3];
  DerivativeBounds made;
  made.u = (u.vector + r * u.weight) / least;
  made.v = (v.vector + r * v.weight) / least;
  made.uu = (uu.vector + 2 * made.u * u.weight + r * uu.weight) / least;
  return made;
}

/// Two patches meet along a line: so much the first derivative across it jumps there, at most. With equal
/// N and w on the line, w [S_u] = [N_u] - (S - c) [w_u].
double Patches::jump(const Points& before, double width_before, const Points& after,
                     double width_after) const {
  const std::size_t n = columns(), rows = before.size() / n;
  const std::size_t count = n, degree = rows - 1;
  const auto place = [&](std::size_t i, std::size_t k) { return i * n + k; };
  Point middle = after[place(0, count / 2)];
  double r = 0, least = kInfinite;
  Longest jumps;
  for (std::size_t k = 0; k < count; ++k) {
    const Point &at = after[place(0, k)], to = after[place(1, k)], from = before[place(degree - 1, k)],
                end = before[place(degree, k)];
    if (!(at[3] > 0) || !(length(at - end) <= 1e-9 * (1 + length(at)))) return kInfinite;
    Point difference{}, away{};
    for (std::size_t axis = 0; axis < 4; ++axis) {
      const double c = axis < 3 ? middle[axis] / middle[3] : 0;
      const double forwards = (to[axis] - at[axis]) - c * (to[3] - at[3]),
                   backwards = (end[axis] - from[axis]) - c * (end[3] - from[3]);
      difference[axis] = static_cast<double>(degree) * (forwards / width_after - backwards / width_before);
      away[axis] = at[axis] / at[3] - c;
    }
    jumps.hold(difference);
    r = std::max(r, length(away)), least = std::min(least, at[3]);
  }
  return (jumps.vector + r * jumps.weight) / least;
}

DerivativeBounds Patches::over(Range u, Range v) const {
  DerivativeBounds made;
  const std::vector<Piece> pieces_u = pieces(u_, u), pieces_v = pieces(v_, v);
  for (const Piece& a : pieces_u)
    for (const Piece& b : pieces_v) made.hold(bounds(cut(a, b), a.width, b.width));
  add_kinks(pieces_u, pieces_v, made);
  return made;
}

std::vector<Patches::Cell> Patches::cells(const Axis& axis, Range range) {
  std::vector<Cell> found = spans(axis, range);
  std::erase_if(found, [&](const Cell& cell) {
    const bool meets = cell.low < range.high && range.low < cell.high;
    // A range without width that lies at a knot is in one of the cells beside it.
    return !meets && !(range.low == range.high && cell.low <= range.low && range.high <= cell.high);
  });
  return found;
}

std::vector<gp_XYZ> Patches::hull(Range range) const {
  std::vector<gp_XYZ> made;
  for (const Cell& cell : cells(u_, range)) {
    const double low = std::max(range.low, cell.low), high = std::min(range.high, cell.high);
    const Piece piece{cell.span, (low - cell.begin) / cell.size, (high - cell.begin) / cell.size, low,
                      high - low};
    for (const Point& p : cut(piece, Piece{0, 0, 1, 0, 1})) {
      if (!(p[3] > 0)) return {};
      made.emplace_back(p[0] / p[3], p[1] / p[3], p[2] / p[3]);
    }
  }
  return made;
}

namespace {

/// A corner of a piece of a triangle.
struct Clipped {
  double u = 0, v = 0;
  gp_XYZ flat;
};

/// The part of a convex polygon whose points have a coordinate on one side of a limit.
std::vector<Clipped> clipped(const std::vector<Clipped>& polygon, double Clipped::*at, double limit,
                             bool above) {
  if (!std::isfinite(limit)) return polygon;
  const auto over = [&](const Clipped& p) { return above ? p.*at - limit : limit - p.*at; };
  std::vector<Clipped> made;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Clipped &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double of_a = over(a), of_b = over(b);
    if (of_a >= 0) made.push_back(a);
    if ((of_a < 0) == (of_b < 0)) continue;
    const double share = of_a / (of_a - of_b);
    made.push_back(
        {a.u + share * (b.u - a.u), a.v + share * (b.v - a.v), a.flat + share * (b.flat - a.flat)});
  }
  return made;
}

}  // namespace

double Patches::farthest(const std::array<gp_Pnt2d, 3>& at, const std::array<gp_XYZ, 3>& flat,
                         double enough) const {
  const auto range = [](double a, double b, double c) {
    return Range{std::min({a, b, c}), std::max({a, b, c})};
  };
  const std::vector<Cell> cells_u = cells(u_, range(at[0].X(), at[1].X(), at[2].X())),
                          cells_v = cells(v_, range(at[0].Y(), at[1].Y(), at[2].Y()));
  std::vector<Clipped> whole;
  for (std::size_t k = 0; k < 3; ++k) whole.push_back({at[k].X(), at[k].Y(), flat[k]});
  std::vector<TriangleNet> nets;
  for (const Cell& u : cells_u) {
    const std::vector<Clipped> strip =
        clipped(clipped(whole, &Clipped::u, u.low, true), &Clipped::u, u.high, false);
    for (const Cell& v : cells_v) {
      const std::vector<Clipped> piece =
          clipped(clipped(strip, &Clipped::v, v.low, true), &Clipped::v, v.high, false);
      for (std::size_t k = 1; k + 1 < piece.size(); ++k) {
        const Clipped &a = piece[0], &b = piece[k], &c = piece[k + 1];
        const auto in_u = [&](const Clipped& p) { return (p.u - u.begin) / u.size; };
        const auto in_v = [&](const Clipped& p) { return (p.v - v.begin) / v.size; };
        nets.push_back(net_over(patch(u.span, v.span), columns(), {in_u(a), in_u(b), in_u(c)},
                                {in_v(a), in_v(b), in_v(c)}, {a.flat, b.flat, c.flat}));
      }
    }
  }
  return step::farthest(std::move(nets), enough);
}

double Patches::farthest(const Fan& fan, bool swapped, double enough) const {
  const Range along{std::min(fan.u_a, fan.u_b), std::max(fan.u_a, fan.u_b)},
      out{std::min(fan.v_tip, fan.v_base), std::max(fan.v_tip, fan.v_base)};
  // The flat triangle at a place of the box, which is linear each way.
  const auto flat = [&](double u, double v) {
    const double t = fan.u_a == fan.u_b ? 0 : (u - fan.u_a) / (fan.u_b - fan.u_a),
                 s = fan.v_base == fan.v_tip ? 0 : (v - fan.v_tip) / (fan.v_base - fan.v_tip);
    return fan.tip + s * ((1 - t) * fan.a + t * fan.b - fan.tip);
  };
  const Range of_u = swapped ? out : along, of_v = swapped ? along : out;
  std::vector<BoxNet> nets;
  for (const Cell& u : cells(u_, of_u))
    for (const Cell& v : cells(v_, of_v)) {
      const Range in_u{std::max(of_u.low, u.low), std::min(of_u.high, u.high)},
          in_v{std::max(of_v.low, v.low), std::min(of_v.high, v.high)};
      const auto piece = [](const Cell& cell, Range range) {
        return Piece{cell.span, (range.low - cell.begin) / cell.size, (range.high - cell.begin) / cell.size,
                     range.low, range.width()};
      };
      std::array<gp_XYZ, 4> corners;
      for (std::size_t a = 0; a < 2; ++a)
        for (std::size_t b = 0; b < 2; ++b) {
          const double x = a == 0 ? in_u.low : in_u.high, y = b == 0 ? in_v.low : in_v.high;
          corners[2 * a + b] = swapped ? flat(y, x) : flat(x, y);
        }
      nets.push_back(net_over(cut(piece(u, in_u), piece(v, in_v)), columns(), corners));
    }
  return step::farthest(std::move(nets), enough);
}

/// A kink counts where two pieces of the box meet in it; the patches beside it are taken whole across it.
void Patches::add_kinks(const std::vector<Piece>& u, const std::vector<Piece>& v,
                        DerivativeBounds& made) const {
  const auto whole = [](const Axis& axis, std::size_t span) {
    return Piece{span, 0, 1, axis.knots[span], axis.knots[span + 1] - axis.knots[span]};
  };
  for (std::size_t i = 0; i + 1 < u.size(); ++i) {
    const std::size_t after = u[i + 1].span;
    if (!u_.kinks[after]) continue;
    const Piece x = whole(u_, u[i].span), y = whole(u_, after);
    double most = 0;
    for (const Piece& b : v) most = std::max(most, jump(cut(x, b), x.width, cut(y, b), y.width));
    made.kink_u += most;
  }
}

}  // namespace lekalo::step

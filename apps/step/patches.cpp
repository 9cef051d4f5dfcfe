#include "patches.hpp"

#include <GeomConvert_BSplineCurveToBezierCurve.hxx>
#include <GeomConvert_BSplineSurfaceToBezierSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

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

/// Bounds of the second derivatives of a polynomial patch over its box.
DerivativeBounds second(const std::vector<Point>& net, std::size_t columns, double width_u, double width_v) {
  const std::size_t n = columns, rows = net.size() / n;
  const auto at = [&](std::size_t i, std::size_t j) -> const Point& { return net[i * n + j]; };
  Longest value, uu, uv, vv;
  for (const Point& p : net) value.hold(p);
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i + 2 < rows) uu.hold((at(i + 2, j) - at(i + 1, j)) - (at(i + 1, j) - at(i, j)));
      if (j + 2 < n) vv.hold((at(i, j + 2) - at(i, j + 1)) - (at(i, j + 1) - at(i, j)));
      if (i + 1 < rows && j + 1 < n) uv.hold((at(i + 1, j + 1) - at(i, j + 1)) - (at(i + 1, j) - at(i, j)));
    }
  const double p = static_cast<double>(rows - 1), q = static_cast<double>(n - 1);
  uu = uu * (p * (p - 1) / (width_u * width_u)), vv = vv * (q * (q - 1) / (width_v * width_v));
  uv = uv * (p * q / (width_u * width_v));
  return {0, 0, uu.vector, uv.vector, vv.vector, 0, 0, value.vector};
}

}  // namespace

void DerivativeBounds::hold(const DerivativeBounds& other) noexcept {
  u = std::max(u, other.u), v = std::max(v, other.v);
  value = std::max(value, other.value);
  uu = std::max(uu, other.uu), uv = std::max(uv, other.uv), vv = std::max(vv, other.vv);
  kink_u += other.kink_u, kink_v += other.kink_v;
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

std::vector<Patches::Piece> Patches::pieces(const Axis& axis, Range range) {
  std::vector<Piece> found;
  const double first = axis.knots.front();
  const std::size_t spans = axis.knots.size() - 1;
  double rounds_from = 0, rounds_to = 0;
  if (axis.period > 0) {
    rounds_from = std::floor((range.low - first) / axis.period);
    rounds_to = std::floor((range.high - first) / axis.period);
  }
  for (double round = rounds_from; round <= rounds_to; ++round)
    for (std::size_t span = 0; span < spans; ++span) {
      const double begin = axis.knots[span] + round * axis.period,
                   end = axis.knots[span + 1] + round * axis.period, size = end - begin;
      // Beyond its ends the spline goes on as its last polynomials.
      const bool opens = axis.period == 0 && span == 0, closes = axis.period == 0 && span + 1 == spans;
      double low = opens ? range.low : std::max(range.low, begin);
      double high = closes ? range.high : std::min(range.high, end);
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
  Points net = patches_[u.span * (v_.knots.size() - 1) + v.span];
  const std::size_t rows = net.size() / columns();
  for (std::size_t j = 0; j < columns(); ++j) cut_curve(&net[j], rows - 1, columns(), u.from, u.to);
  for (std::size_t i = 0; i < rows; ++i) cut_curve(&net[i * columns()], columns() - 1, 1, v.from, v.to);
  return net;
}

/// With S = N / w, taken from a point c in the middle so that |S - c| <= r: w S_u = N_u - (S - c) w_u, and so
/// on for the second derivatives, where N is the numerator less c w.
DerivativeBounds Patches::bounds(const Points& net, double width_u, double width_v) const {
  Point low{kInfinite, kInfinite, kInfinite, kInfinite}, high{-kInfinite, -kInfinite, -kInfinite, -kInfinite};
  for (const Point& p : net) {
    if (!(p[3] > 0)) return {kInfinite, kInfinite, kInfinite, kInfinite, kInfinite, 0, 0, kInfinite};
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
  Longest u, v, uu, uv, vv;
  for (std::size_t i = 0; i < rows; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (i + 1 < rows) u.hold(at(i + 1, j) - at(i, j));
      if (j + 1 < n) v.hold(at(i, j + 1) - at(i, j));
      if (i + 2 < rows) uu.hold((at(i + 2, j) - at(i + 1, j)) - (at(i + 1, j) - at(i, j)));
      if (j + 2 < n) vv.hold((at(i, j + 2) - at(i, j + 1)) - (at(i, j + 1) - at(i, j)));
      if (i + 1 < rows && j + 1 < n) uv.hold((at(i + 1, j + 1) - at(i, j + 1)) - (at(i + 1, j) - at(i, j)));
    }
  const double p = static_cast<double>(rows - 1), q = static_cast<double>(n - 1);
  u = u * (p / width_u), v = v * (q / width_v);
  uu = uu * (p * (p - 1) / (width_u * width_u)), vv = vv * (q * (q - 1) / (width_v * width_v));
  uv = uv * (p * q / (width_u * width_v));
  const double least = low[3];
  DerivativeBounds made{0, 0, 0, 0, 0, 0, 0, kInfinite};
  made.u = (u.vector + r * u.weight) / least;
  made.v = (v.vector + r * v.weight) / least;
  made.uu = (uu.vector + 2 * made.u * u.weight + r * uu.weight) / least;
  made.vv = (vv.vector + 2 * made.v * v.weight + r * vv.weight) / least;
  made.uv = (uv.vector + made.u * v.weight + made.v * u.weight + r * uv.weight) / least;
  return made;
}

/// Two patches meet along a line: so much the first derivative across it jumps there, at most. With equal
/// N and w on the line, w [S_u] = [N_u] - (S - c) [w_u].
double Patches::jump(const Points& before, double width_before, const Points& after, double width_after,
                     bool along_u, const Points& reach) const {
  const std::size_t n = columns(), rows = before.size() / n;
  const std::size_t count = along_u ? n : rows, degree = (along_u ? rows : n) - 1;
  const auto place = [&](std::size_t i, std::size_t k) { return along_u ? i * n + k : k * n + i; };
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
  for (const Point& p : reach)
    r = std::max(r, std::hypot(p[0] - middle[0] / middle[3], p[1] - middle[1] / middle[3],
                               p[2] - middle[2] / middle[3]));
  return (jumps.vector + r * jumps.weight) / least;
}

DerivativeBounds Patches::over(Range u, Range v) const {
  DerivativeBounds made;
  const std::vector<Piece> pieces_u = pieces(u_, u), pieces_v = pieces(v_, v);
  for (const Piece& a : pieces_u)
    for (const Piece& b : pieces_v) made.hold(bounds(cut(a, b), a.width, b.width));
  add_kinks(pieces_u, pieces_v, {}, made);
  return made;
}

std::array<double, 4> Affine::operator()(double x, double y) const {
  std::array<double, 4> made{0, 0, 0, 1};
  for (std::size_t axis = 0; axis < 3; ++axis)
    made[axis] = at[axis] + (x - u) * along_u[axis] + (y - v) * along_v[axis];
  return made;
}

/// The control points of N - L w, one degree higher each way than those of N and w.
Patches::Points Patches::less(const Points& net, const Affine& flat, const Piece& u, const Piece& v) const {
  const std::size_t n = columns(), rows = net.size() / n;
  Points made((rows + 1) * (n + 1), Point{});
  for (std::size_t a = 0; a < 2; ++a)
    for (std::size_t b = 0; b < 2; ++b) {
      const Point corner =
          flat(u.low + static_cast<double>(a) * u.width, v.low + static_cast<double>(b) * v.width);
      for (std::size_t i = 0; i < rows; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          const Point& p = net[i * n + j];
          const double share = static_cast<double>(a == 0 ? rows - i : i + 1) / static_cast<double>(rows) *
                               static_cast<double>(b == 0 ? n - j : j + 1) / static_cast<double>(n);
          Point& to = made[(i + a) * (n + 1) + j + b];
          for (std::size_t axis = 0; axis < 3; ++axis) to[axis] += share * (p[axis] - corner[axis] * p[3]);
        }
    }
  return made;
}

/// A polynomial with the value 0 at three corners is bounded by its second derivatives, and S - L is such a
/// one divided by the weight.
DerivativeBounds Patches::over(Range u, Range v, const Affine& flat) const {
  const std::vector<Piece> pieces_u = pieces(u_, u), pieces_v = pieces(v_, v);
  DerivativeBounds made;
  double least = kInfinite;
  for (const Piece& a : pieces_u)
    for (const Piece& b : pieces_v) {
      const Points net = cut(a, b);
      for (const Point& p : net) least = std::min(least, p[3]);
      made.hold(second(less(net, flat, a, b), columns() + 1, a.width, b.width));
    }
  if (!(least > 0)) return {0, 0, kInfinite, kInfinite, kInfinite, 0, 0, kInfinite};
  made.uu /= least, made.uv /= least, made.vv /= least, made.value /= least;
  Points reach;
  for (const double x : {u.low, u.high})
    for (const double y : {v.low, v.high}) reach.push_back(flat(x, y));
  add_kinks(pieces_u, pieces_v, reach, made);
  return made;
}

/// A kink counts where two pieces of the box meet in it; the patches beside it are taken whole across it.
void Patches::add_kinks(const std::vector<Piece>& u, const std::vector<Piece>& v, const Points& reach,
                        DerivativeBounds& made) const {
  const auto whole = [](const Axis& axis, std::size_t span) {
    return Piece{span, 0, 1, axis.knots[span], axis.knots[span + 1] - axis.knots[span]};
  };
  for (std::size_t i = 0; i + 1 < u.size(); ++i) {
    const std::size_t after = u[i + 1].span;
    if (!u_.kinks[after]) continue;
    const Piece x = whole(u_, u[i].span), y = whole(u_, after);
    double most = 0;
    for (const Piece& b : v) most = std::max(most, jump(cut(x, b), x.width, cut(y, b), y.width, true, reach));
    made.kink_u += most;
  }
  for (std::size_t j = 0; j + 1 < v.size(); ++j) {
    const std::size_t after = v[j + 1].span;
    if (!v_.kinks[after]) continue;
    const Piece x = whole(v_, v[j].span), y = whole(v_, after);
    double most = 0;
    for (const Piece& a : u)
      most = std::max(most, jump(cut(a, x), x.width, cut(a, y), y.width, false, reach));
    made.kink_v += most;
  }
}

}  // namespace lekalo::step

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "drawing.hpp"
#include "verify/number/interval.hpp"
#include "verify/number/surely.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

/// Maps that keep circles but for this share have been rounded.
constexpr double kKeepsCircles = 0x1p-36;
constexpr double kMostStrokes = 20'000;

Vec direction_of_degrees(const Fraction& degrees) {
  const Turn turn = turn_by_degrees(degrees);
  return {{turn.cosine.low_double(), turn.cosine.high_double()},
          {turn.sine.low_double(), turn.sine.high_double()}};
}

/// Says whether a line of a length, or a circle of a radius, draws nothing. Beyond the doubles it may draw.
bool is_nothing(const Span& size) { return !is_positive(size) && size.high < kInfinity; }

using Poles = std::array<Vec, 4>;

/// Returns the poles of the part of a cubic between two parameters.
Poles part_of(const Poles& whole, double from, double to) {
  const auto mixed = [](const Vec& a, const Vec& b, double t) {
    return a * (just(1) - just(t)) + b * just(t);
  };
  // Each pole is the blossom of the cubic at three ends of the part.
  const auto blossom = [&](double r, double s, double t) {
    const Vec ab = mixed(whole[0], whole[1], r), bc = mixed(whole[1], whole[2], r),
              cd = mixed(whole[2], whole[3], r);
    return mixed(mixed(ab, bc, s), mixed(bc, cd, s), t);
  };
  return {blossom(from, from, from), blossom(from, from, to), blossom(from, to, to), blossom(to, to, to)};
}

/// A cubic and its chord are off at equal parameters by at most an eighth of the second derivative, which is
/// between six times these bends.
double off_by_bend(const Poles& p) {
  const Vec bend = p[0] - p[1] * just(2) + p[2], other = p[1] - p[2] * just(2) + p[3];
  return (just(0.75) * just(std::max(length(bend).high, length(other).high))).high;
}

/// Returns a distance within which a cubic and its chord run along each other. Where the poles lie between
/// the two ends, seen along the chord, the cubic does, and is beside every point of the chord; so it is as
/// near as its poles are. Lines that are written as cubics are lines by this, however unevenly their poles
/// stand.
double off_its_chord(const Poles& p) {
  const Vec chord = p[3] - p[0];
  const Span whole = length(chord);
  double aside = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (!is_positive(dot(chord, p[k] - p[0])) || !is_positive(dot(chord, p[3] - p[k]))) return off_by_bend(p);
    aside = std::max(aside, (absolute(cross(chord, p[k] - p[0])) / whole).high);
  }
  return std::min(aside, off_by_bend(p));
}

/// Returns an arc of less than half a turn whose ends lie in the directions of those of a cubic, and how far
/// the two are from each other; nothing where the cubic is shown to leave the arc's sector.
///
/// The squared distance of the cubic from a centre is a polynomial of degree 6, and lies between the least
/// and the largest of its Bernstein coefficients. If the cubic stays in the sector then every point of it has
/// one of the arc in its direction, and since it runs from one end to the other, every point of the arc has
/// one of the cubic. So the two are as near as their distances from the centre.
std::optional<CurvePiece> arc_along(const Poles& p) {
  // Any centre will do, so that of the circle through three points is made of new doubles.
  const Vec half = (p[0] + p[3] + (p[1] + p[2]) * just(3)) * just(0.125);
  const double ax = p[0].x.low, ay = p[0].y.low, bx = half.x.low - ax, by = half.y.low - ay,
               cx = p[3].x.low - ax, cy = p[3].y.low - ay;
  const double turn = 2 * (bx * cy - by * cx), b = bx * bx + by * by, c = cx * cx + cy * cy;
  const Vec centre{just(ax + (cy * b - by * c) / turn), just(ay + (bx * c - cx * b) / turn)};
  const bool ccw = !std::signbit(turn);
  Poles v;
  for (std::size_t k = 0; k < 4; ++k) v[k] = p[ccw ? k : 3 - k] - centre;
  // The sector is convex, so it holds the cubic if it holds the poles.
  if (!is_positive(cross(v[0], v[3]))) return std::nullopt;
  for (std::size_t k = 1; k < 3; ++k)
    if (!is_positive(cross(v[0], v[k])) || !is_positive(cross(v[k], v[3]))) return std::nullopt;
  const auto own = [](const Vec& a) { return dot(a, a); };
  const Span two = just(2), three = just(3);
  const std::array<Span, 7> squares{own(v[0]),
                                    dot(v[0], v[1]),
                                    (two * dot(v[0], v[2]) + three * own(v[1])) / just(5),
                                    (dot(v[0], v[3]) + just(9) * dot(v[1], v[2])) / just(10),
                                    (two * dot(v[1], v[3]) + three * own(v[2])) / just(5),
                                    dot(v[2], v[3]),
                                    own(v[3])};
  Span square = squares[0];
  for (const Span& s : squares) square = {std::min(square.low, s.low), std::max(square.high, s.high)};
  if (!is_positive(square)) return std::nullopt;
  const Span away = square_root(square);
  Side side;
  side.arc = true;
  side.centre = centre, side.radius = just(0.5 * (away.low + away.high));
  side.first = unit(v[0]), side.last = unit(v[3]);
  side.from = centre + side.first * side.radius, side.to = centre + side.last * side.radius;
  return CurvePiece{side, absolute(away - side.radius).high};
}

}  // namespace

Affine operator*(const Affine& after, const Affine& before) {
  return {after.direction(before.x), after.direction(before.y), after(before.shift)};
}

void CurveMaker::line(const Affine& map, const Vec& from, const Vec& to) { stroke(map(from), map(to), 0); }

void CurveMaker::stroke(const Vec& from, const Vec& to, double off) {
  if (!is_nothing(length(to - from))) curve_.pieces.push_back({side_between(from, to), off});
}

bool CurveMaker::too_many(double strokes, const char* curves) {
  if (strokes <= kMostStrokes) return false;
  drawing_.not_read.insert(fmt::format("{} that are large against the tolerance", curves));
  return true;
}

template <class Part, class Take>
void CurveMaker::in_parts(const Part& whole, const char* curves, const Take& take) {
  std::vector<Part> open{whole};
  for (double count{}; !open.empty(); ++count) {
    if (too_many(count, curves)) return;
    const Part part = open.back();
    open.pop_back();
    const std::optional<std::array<Part, 2>> two = take(part);
    if (two) open.push_back((*two)[1]), open.push_back((*two)[0]);
  }
}

void CurveMaker::arc(const Affine& map, const DrawnArc& arc) {
  const Vec turned{-map.x.y, map.x.x};
  const Span size = length(map.x);
  const bool mirrors = is_positive(-cross(map.x, map.y));
  const Vec off = mirrors ? map.y + turned : map.y - turned;
  if (!(length(off).high <= kKeepsCircles * size.low)) {
    if (!arc.from_deg) return strokes(map, arc);
    return ellipse(map, arc.centre, {arc.radius, just(0)}, {just(0), arc.radius}, *arc.from_deg, *arc.to_deg);
  }
  Side side;
  side.arc = true;
  side.centre = map(arc.centre);
  side.radius = arc.radius * size;
  side.first = unit(map.direction(mirrors ? arc.last : arc.first));
  side.last = unit(map.direction(mirrors ? arc.first : arc.last));
  side.sweep = arc.sweep;
  side.from = side.centre + side.first * side.radius, side.to = side.centre + side.last * side.radius;
  if (!is_nothing(side.radius)) curve_.pieces.push_back({side, (length(off) * arc.radius).high});
}

/// An arc whose angles are not stated is halved until its chords are near enough.
void CurveMaker::strokes(const Affine& map, const DrawnArc& arc) {
  Side whole;
  whole.arc = true;
  whole.centre = arc.centre, whole.radius = arc.radius;
  whole.first = arc.first, whole.last = arc.last, whole.sweep = arc.sweep;
  const double reach = (arc.radius * (length(map.x) + length(map.y))).high;
  const auto on_circle = [&](const Vec& direction) { return map(arc.centre + direction * arc.radius); };
  using Halves = std::optional<std::array<Side, 2>>;
  in_parts(whole, "arcs of ellipses", [&](const Side& piece) -> Halves {
    // Less than half a turn is at most pi / 2 times its chord on the unit circle, and a chord of h is within
    // h^2 / 8 of the half diameters.
    const double turn = 1.5708 * length(piece.first - piece.last).high;
    if (piece.sweep != Sweep::less || !(turn * turn * reach <= 8 * off_)) return halves(piece);
    stroke(on_circle(piece.first), on_circle(piece.last), off_);
    return std::nullopt;
  });
}

void CurveMaker::bulge(const Affine& map, const Vec& from, const Vec& to, const Decimal& bulge) {
  // An arc that turns clockwise is the other way the one that turns counter-clockwise.
  if (sgn(bulge.digits) < 0) return this->bulge(map, to, from, {-bulge.digits, bulge.exponent});
  const Span b = enclosed(bulge), whole = length(to - from);
  if (is_nothing(whole)) return line(map, from, to);
  // A flat arc is its chord within its height.
  if (b.high < 1e-7)
    return stroke(map(from), map(to), (just(0.5) * b * whole * (length(map.x) + length(map.y))).high);
  const Vec chord = to - from, left{-chord.y, chord.x};
  const Span up = (just(1) - b * b) / (just(4) * b);
  DrawnArc arc;
  arc.centre = (from + to) * just(0.5) + left * up;
  arc.radius = whole * (just(1) + b * b) / (just(4) * b);
  arc.first = unit(from - arc.centre), arc.last = unit(to - arc.centre);
  const int against = compare(bulge, Decimal{1, 0});
  arc.sweep = against < 0 ? Sweep::less : (against > 0 ? Sweep::more : Sweep::half);
  this->arc(map, arc);
}

void CurveMaker::ellipse(const Affine& map, const Vec& centre, const Vec& u, const Vec& v,
                         const Fraction& from_deg, const Fraction& to_deg) {
  const Vec middle = map(centre), along = map.direction(u), across = map.direction(v);
  const double reach = (length(along) + length(across)).high;
  // Between parameters h apart a chord is within h^2 / 8 of the half diameters.
  const double turn = cut_to_double(to_deg - from_deg) * 0.0174533;
  const double count = std::ceil(std::abs(turn) * std::sqrt(reach / (8 * off_)) + 4);
  if (too_many(count, "ellipses")) return;
  Vec at{};
  for (double k = 0; k <= count; ++k) {
    const Vec d = direction_of_degrees(from_deg + (to_deg - from_deg) * Fraction(k) / Fraction(count));
    const Vec next = middle + along * d.x + across * d.y;
    if (k > 0) stroke(at, next, off_);
    at = next;
  }
}

/// A cubic is halved until each part is near enough to an arc or to a line.
void CurveMaker::cubic(const Affine& map, const std::array<Vec, 4>& given) {
  Poles whole;
  for (std::size_t k = 0; k < 4; ++k) whole[k] = map(given[k]);
  const double bend = off_by_bend(whole);
  struct Part {
    double from, to;
  };
  using Halves = std::optional<std::array<Part, 2>>;
  in_parts(Part{0, 1}, "Bezier curves", [&](const Part& of) -> Halves {
    const Poles part = part_of(whole, of.from, of.to);
    // The bound of the whole shrinks with the square of the share; that of a short part is mostly rounding.
    const double share = of.to - of.from;
    const double off_line = std::min(off_its_chord(part), step_up(bend * share * share));
    if (off_line <= off_) return stroke(part[0], part[3], off_line), std::nullopt;
    if (const std::optional<CurvePiece> along = arc_along(part); along && along->off <= off_)
      return curve_.pieces.push_back(*along), std::nullopt;
    const double middle = 0.5 * (of.from + of.to);
    return {{Part{of.from, middle}, Part{middle, of.to}}};
  });
}

void CurveMaker::done(const std::string& layer, bool hidden) {
  if (!curve_.pieces.empty()) {
    curve_.layer = layer, curve_.hidden = hidden;
    drawing_.curves.push_back(std::move(curve_));
  }
  curve_ = {};
}

}  // namespace lekalo::verify

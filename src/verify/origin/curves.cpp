#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "drawing.hpp"
#include "verify/number/interval.hpp"
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

bool surely_apart(const Vec& a, const Vec& b) {
  const Vec d = a - b;
  return d.x.low > 0 || d.x.high < 0 || d.y.low > 0 || d.y.high < 0;
}

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
    if (!(dot(chord, p[k] - p[0]).low >= 0 && dot(chord, p[3] - p[k]).low >= 0)) return off_by_bend(p);
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
  const bool ccw = turn > 0;
  Poles v;
  for (std::size_t k = 0; k < 4; ++k) v[k] = p[ccw ? k : 3 - k] - centre;
  // The sector is convex, so it holds the cubic if it holds the poles.
  if (!(cross(v[0], v[3]).low > 0)) return std::nullopt;
  for (std::size_t k = 1; k < 3; ++k)
    if (!(cross(v[0], v[k]).low >= 0 && cross(v[k], v[3]).low >= 0)) return std::nullopt;
  const Span two = just(2), three = just(3);
  const std::array<Span, 7> squares{dot(v[0], v[0]),
                                    dot(v[0], v[1]),
                                    (two * dot(v[0], v[2]) + three * dot(v[1], v[1])) / just(5),
                                    (dot(v[0], v[3]) + just(9) * dot(v[1], v[2])) / just(10),
                                    (two * dot(v[1], v[3]) + three * dot(v[2], v[2])) / just(5),
                                    dot(v[2], v[3]),
                                    dot(v[3], v[3])};
  Span square = squares[0];
  for (const Span& s : squares) square = {std::min(square.low, s.low), std::max(square.high, s.high)};
  if (!(square.low > 0)) return std::nullopt;
  const Span away = square_root(square);
  Side side;
  side.arc = true;
  side.centre = centre, side.radius = just(0.5 * (away.low + away.high));
  side.first = unit(v[0]), side.last = unit(v[3]);
  side.from = centre + side.first * side.radius, side.to = centre + side.last * side.radius;
  return CurvePiece{side,
                    std::max((just(away.high) - side.radius).high, (side.radius - just(away.low)).high)};
}

}  // namespace

Affine operator*(const Affine& after, const Affine& before) {
  return {after.direction(before.x), after.direction(before.y), after(before.shift)};
}

void CurveMaker::line(const Affine& map, const Vec& from, const Vec& to) {
  const Vec a = map(from), b = map(to);
  if (surely_apart(a, b)) curve_.pieces.push_back({side_between(a, b), 0});
}

void CurveMaker::arc(const Affine& map, const DrawnArc& arc) {
  const Vec turned{-map.x.y, map.x.x};
  const Span size = length(map.x), handed = cross(map.x, map.y);
  const bool mirrors = handed.high < 0;
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
  if (!(side.radius.low > 0)) return;
  curve_.pieces.push_back({side, (length(off) * arc.radius).high});
}

/// An arc whose angles are not stated is halved until its chords are near enough.
void CurveMaker::strokes(const Affine& map, const DrawnArc& arc) {
  Side whole;
  whole.arc = true;
  whole.centre = arc.centre, whole.radius = arc.radius;
  whole.first = arc.first, whole.last = arc.last, whole.sweep = arc.sweep;
  const double reach = (arc.radius * (length(map.x) + length(map.y))).high;
  const auto on_circle = [&](const Vec& direction) { return map(arc.centre + direction * arc.radius); };
  std::vector<Side> open{whole};
  for (double count = 0; !open.empty(); ++count) {
    if (!(count <= kMostStrokes))
      return void(drawing_.not_read.insert("arcs of ellipses that are large against the tolerance"));
    const Side piece = open.back();
    open.pop_back();
    // Less than half a turn is at most pi / 2 times its chord on the unit circle, and a chord of h is within
    // h^2 / 8 of the half diameters.
    const double turn = 1.5708 * length(piece.first - piece.last).high;
    if (piece.sweep == Sweep::less && turn * turn * reach <= 8 * off_) {
      curve_.pieces.push_back({side_between(on_circle(piece.first), on_circle(piece.last)), off_});
      continue;
    }
    const std::array<Side, 2> two = halves(piece);
    open.push_back(two[1]), open.push_back(two[0]);
  }
}

void CurveMaker::bulge(const Affine& map, const Vec& from, const Vec& to, const Decimal& bulge) {
  if (sgn(bulge.digits) == 0 || !surely_apart(from, to)) return line(map, from, to);
  const bool ccw = sgn(bulge.digits) > 0;
  Decimal size = bulge;
  size.digits = abs(size.digits);
  const Span b = enclosed(size), whole = length(to - from);
  // A flat arc is its chord within its height.
  if (b.high < 1e-7) {
    line(map, from, to);
    if (!curve_.pieces.empty())
      curve_.pieces.back().off = (just(0.5) * b * whole * (length(map.x) + length(map.y))).high;
    return;
  }
  const Vec chord = to - from, left{-chord.y, chord.x};
  const Span up = (just(1) - b * b) / (just(4) * b);
  DrawnArc arc;
  arc.centre = (from + to) * just(0.5) + left * (ccw ? up : -up);
  arc.radius = whole * (just(1) + b * b) / (just(4) * b);
  const Vec a = unit(from - arc.centre), c = unit(to - arc.centre);
  arc.first = ccw ? a : c, arc.last = ccw ? c : a;
  const int against = compare(size, Decimal{1, 0});
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
  if (!(count <= kMostStrokes))
    return void(drawing_.not_read.insert("ellipses that are large against the tolerance"));
  Vec at{};
  for (double k = 0; k <= count; ++k) {
    const Vec d = direction_of_degrees(from_deg + (to_deg - from_deg) * Fraction(k) / Fraction(count));
    const Vec next = middle + along * d.x + across * d.y;
    if (k > 0) curve_.pieces.push_back({side_between(at, next), off_});
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
  std::vector<Part> open{{0, 1}};
  for (double count = 0; !open.empty(); ++count) {
    if (!(count <= kMostStrokes))
      return void(drawing_.not_read.insert("Bezier curves that are large against the tolerance"));
    const auto [from, to] = open.back();
    open.pop_back();
    const Poles part = part_of(whole, from, to);
    // The bound of the whole shrinks with the square of the share; that of a short part is mostly rounding.
    const double share = to - from;
    const double off_line = std::min(off_its_chord(part), step_up(bend * share * share));
    if (off_line <= off_) {
      if (surely_apart(part[0], part[3])) curve_.pieces.push_back({side_between(part[0], part[3]), off_line});
      continue;
    }
    if (const std::optional<CurvePiece> along = arc_along(part); along && along->off <= off_) {
      curve_.pieces.push_back(*along);
      continue;
    }
    const double middle = 0.5 * (from + to);
    open.push_back({middle, to}), open.push_back({from, middle});
  }
}

void CurveMaker::done(const std::string& layer, bool hidden) {
  if (!curve_.pieces.empty()) {
    curve_.layer = layer, curve_.hidden = hidden;
    drawing_.curves.push_back(std::move(curve_));
  }
  curve_ = {};
}

}  // namespace lekalo::verify

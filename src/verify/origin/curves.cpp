#include <array>
#include <cmath>
#include <utility>

#include "drawing.hpp"
#include "verify/number/interval.hpp"
#include "verify/shape/stretch.hpp"

namespace lekalo::verify {
namespace {

/// Maps that keep circles but for this share have been rounded.
constexpr double kKeepsCircles = 0x1p-36;
constexpr double kMostStrokes = 20'000;

Side line_between(const Vec& from, const Vec& to) {
  Side side;
  side.from = from, side.to = to;
  return side;
}

Vec direction_of_degrees(const Fraction& degrees) {
  const Turn turn = turn_by_degrees(degrees);
  return {{turn.cosine.low_double(), turn.cosine.high_double()},
          {turn.sine.low_double(), turn.sine.high_double()}};
}

bool surely_apart(const Vec& a, const Vec& b) {
  const Vec d = a - b;
  return d.x.low > 0 || d.x.high < 0 || d.y.low > 0 || d.y.high < 0;
}

}  // namespace

Affine operator*(const Affine& after, const Affine& before) {
  return {after.direction(before.x), after.direction(before.y), after(before.shift)};
}

void CurveMaker::line(const Affine& map, const Vec& from, const Vec& to) {
  const Vec a = map(from), b = map(to);
  if (surely_apart(a, b)) curve_.pieces.push_back({line_between(a, b), 0});
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
      curve_.pieces.push_back({line_between(on_circle(piece.first), on_circle(piece.last)), off_});
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
    if (k > 0) curve_.pieces.push_back({line_between(at, next), off_});
    at = next;
  }
}

void CurveMaker::cubic(const Affine& map, const std::array<Vec, 4>& given) {
  std::array<Vec, 4> p;
  for (std::size_t k = 0; k < 4; ++k) p[k] = map(given[k]);
  const Vec bend = p[0] - p[1] * just(2) + p[2], other = p[1] - p[2] * just(2) + p[3];
  // The second derivative is between six times these; a chord over 1 / n is within an eighth of it over n^2.
  const double most = 6 * std::max(length(bend).high, length(other).high);
  const double count = std::ceil(std::sqrt(most / (8 * off_)) + 1);
  if (!(count <= kMostStrokes))
    return void(drawing_.not_read.insert("Bezier curves that are large against the tolerance"));
  Vec at = p[0];
  for (double k = 1; k <= count; ++k) {
    const Span t = just(k) / just(count), s = just(1) - t;
    const Vec ab = p[0] * s + p[1] * t, bc = p[1] * s + p[2] * t, cd = p[2] * s + p[3] * t;
    const Vec next = k == count ? p[3] : (ab * s + bc * t) * s + (bc * s + cd * t) * t;
    if (surely_apart(at, next)) curve_.pieces.push_back({line_between(at, next), off_});
    at = next;
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

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/nc/joints.hpp"

namespace lekalo::nc {
namespace {

using geom::Point;

constexpr double kChordHeight = 0.01;    // mm
constexpr double kLongestChord = 0.4;    // rad
constexpr double kShortestPhase = 0.02;  // mm

geom::Ring chords_of(const geom::Contour& contour) {
  geom::Ring ring;
  for (const geom::Edge& edge : contour) {
    ring.push_back(edge.from);
    if (edge.kind == geom::EdgeKind::line) continue;
    const double sweep = geom::arc_sweep(edge), radius = geom::arc_radius(edge);
    const double turn = std::min(kLongestChord, std::sqrt(8 * kChordHeight / radius));
    const auto pieces = static_cast<int>(std::ceil(sweep / turn));
    const Point out = edge.from - edge.centre;
    const double hand = edge.kind == geom::EdgeKind::arc_ccw ? 1 : -1;
    for (int k = 1; k < pieces; ++k) {
      const auto [sine, cosine] = geom::sincos(hand * sweep * k / pieces);
      ring.push_back(edge.centre + cosine * out + sine * geom::perpendicular(out));
    }
  }
  return ring;
}

/// Twice the area of a ring and its centre times six areas, about a point near it.
void add_moments(const geom::Ring& ring, Point about, double& twice_area, Point& moments) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i] - about, b = ring[i + 1 == ring.size() ? 0 : i + 1] - about;
    const double cross = geom::cross(a, b);
    twice_area += cross;
    moments = moments + cross * (a + b);
  }
}

/// The highest and lowest points of a part on lines parallel to Y between two neighbouring corners.
struct Strip {
  double from = 0, to = 0, top_from = 0, top_to = 0, bottom_from = 0, bottom_to = 0;

  [[nodiscard]] double at(double x, double y_from, double y_to) const {
    return y_from + (y_to - y_from) * std::clamp((x - from) / (to - from), 0.0, 1.0);
  }
};

/// The upper and the lower edge of a ring over X, from left to right.
class Envelope {
 public:
  explicit Envelope(const geom::Ring& ring) {
    struct Side {
      Point left, right;
    };
    std::vector<Side> sides;
    std::vector<double> stops;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      Point a = ring[i], b = ring[i + 1 == ring.size() ? 0 : i + 1];
      stops.push_back(a.x);
      if (a.x > b.x) std::swap(a, b);
      if (a.x < b.x) sides.push_back({a, b});
    }
    std::sort(stops.begin(), stops.end());
    stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.left.x < b.left.x; });
    std::vector<Side> open;
    std::size_t next = 0;
    for (std::size_t k = 0; k + 1 < stops.size(); ++k) {
      ask();
      const double from = stops[k], to = stops[k + 1];
      std::erase_if(open, [&](const Side& side) { return !(side.right.x > from); });
      for (; next < sides.size() && !(sides[next].left.x > from); ++next) open.push_back(sides[next]);
      Strip strip{from, to, -kFar, -kFar, kFar, kFar};
      double top = -kFar, bottom = kFar;
      for (const Side& side : open) {
        const auto height = [&](double x) {
          const double share = (x - side.left.x) / (side.right.x - side.left.x);
          return side.left.y + share * (side.right.y - side.left.y);
        };
        const double middle = height(0.5 * (from + to));
        if (middle > top) top = middle, strip.top_from = height(from), strip.top_to = height(to);
        if (middle < bottom) bottom = middle, strip.bottom_from = height(from), strip.bottom_to = height(to);
      }
      strips_.push_back(strip);
    }
  }

  [[nodiscard]] double left() const { return strips_.front().from; }
  [[nodiscard]] double right() const { return strips_.back().to; }

  /// The part of a line parallel to Y that is in the hull of the part wherever the line lies from `from` to
  /// `to`; false where the part is not above all these lines.
  bool surely(double from, double to, double& bottom, double& top) const {
    if (!(from >= left() && to <= right())) return false;
    bottom = -kFar, top = kFar;
    auto strip = std::upper_bound(strips_.begin(), strips_.end(), from,
                                  [](double x, const Strip& s) { return x < s.to; });
    for (; strip != strips_.end() && strip->from <= to; ++strip)
      for (const double x : {std::max(from, strip->from), std::min(to, strip->to)}) {
        top = std::min(top, strip->at(x, strip->top_from, strip->top_to));
        bottom = std::max(bottom, strip->at(x, strip->bottom_from, strip->bottom_to));
      }
    return bottom <= top;
  }

 private:
  static constexpr double kFar = 1e300;
  std::vector<Strip> strips_;
};

/// How far p lies within the convex hull of the points; below 0 outside, and where there is no hull.
double depth_in_hull(const std::vector<Point>& points, Point p) {
  const std::vector<std::size_t> hull = geom::convex_hull(points);
  if (hull.size() < 3) return -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point a = points[hull[i]], side = points[hull[i + 1 == hull.size() ? 0 : i + 1]] - a;
    least = std::min(least, geom::cross(side, p - a) / geom::norm(side));
  }
  return least;
}

/// A part on slats parallel to Y.
class Standing {
 public:
  Standing(const geom::Ring& ring, Point centre, double pitch, std::vector<Point> joints)
      : envelope_(ring), centre_(centre), pitch_(pitch), joints_(std::move(joints)) {}

  [[nodiscard]] bool holds() const { return holds(0, pitch_); }

 private:
  /// True when the part stands with a slat anywhere between these distances to the right of its left end. The
  /// points of a hull that move by no more than `length` move its edges by no more.
  [[nodiscard]] bool holds(double phase, double length) const {
    ask();
    std::vector<Point> supports = joints_;
    for (double x = envelope_.left() + phase; x <= envelope_.right(); x += pitch_) {
      double bottom = 0, top = 0;
      if (!envelope_.surely(x, x + length, bottom, top)) continue;
      supports.push_back({x, bottom});
      supports.push_back({x, top});
    }
    if (depth_in_hull(supports, centre_) >= kTippingMargin + length) return true;
    if (!(length > kShortestPhase)) return false;
    return holds(phase, 0.5 * length) && holds(phase + 0.5 * length, 0.5 * length);
  }

  Envelope envelope_;
  Point centre_;
  double pitch_;
  std::vector<Point> joints_;
};

}  // namespace

Point centre_of_mass(const geom::Region& part) {
  double twice_area = 0;
  Point moments, about = part.outer.front().from;
  add_moments(chords_of(part.outer), about, twice_area, moments);
  for (const geom::Contour& hole : part.holes) add_moments(chords_of(hole), about, twice_area, moments);
  return about + (1 / (3 * twice_area)) * moments;
}

double size_of(const geom::Region& part) {
  const geom::Ring points = chords_of(part.outer);
  const std::vector<std::size_t> hull = geom::convex_hull(points);
  double most = 0;
  for (const std::size_t a : hull)
    for (const std::size_t b : hull) most = std::max(most, geom::norm(points[b] - points[a]));
  return most;
}

bool tips(const geom::Region& part, const Slats& slats, const std::vector<Point>& joints) {
  const auto turned = [&](Point p) { return slats.along_x ? Point{p.y, p.x} : p; };
  geom::Ring ring = chords_of(part.outer);
  for (Point& p : ring) p = turned(p);
  std::vector<Point> held;
  for (const Point p : joints) held.push_back(turned(p));
  return !Standing(ring, turned(centre_of_mass(part)), slats.pitch_mm, std::move(held)).holds();
}

}  // namespace lekalo::nc

#include "lekalo/locate/edge_allowance.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/distance.hpp"
#include "lekalo/geom/edge_distance.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/phi/region.hpp"

namespace lekalo::locate {
namespace {

using geom::BlankFromPart;
using geom::Curve;
using geom::EdgeKind;
using geom::Point;
using geom::RegionIndex;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// A stretch of an arc turns by no more than this.
constexpr double kLongestTurn = 1;  ///< radians

bool is_arc(const Curve& curve) { return curve.edge.kind != EdgeKind::line; }

/// The points of an edge of the part by their way along it.
class Track {
 public:
  explicit Track(const Curve& curve) : curve_(curve), length_(curve.length) {
    if (!is_arc(curve)) return;
    const Point out = curve.edge.from - curve.edge.centre;
    from_angle_ = geom::direction_angle(out.x, out.y);
    sign_ = curve.edge.kind == EdgeKind::arc_ccw ? 1 : -1;
    length_ = curve.radius * geom::arc_sweep(curve.edge);
  }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] double sweep() const { return is_arc(curve_) ? length_ / curve_.radius : 0; }

  [[nodiscard]] Point at(double along) const {
    if (is_arc(curve_)) {
      const auto [sine, cosine] = geom::sincos(from_angle_ + sign_ * along / curve_.radius);
      return curve_.edge.centre + curve_.radius * Point{cosine, sine};
    }
    return along < length_ ? curve_.edge.from + along * curve_.unit : curve_.edge.to;
  }
  /// Returns the way to a point of the edge.
  [[nodiscard]] double along(Point p) const {
    if (!is_arc(curve_)) return std::clamp(dot(p - curve_.edge.from, curve_.unit), 0.0, length_);
    const Point out = p - curve_.edge.centre;
    const double whole = kTurn, sweep = length_ / curve_.radius;
    double turn = sign_ * (geom::direction_angle(out.x, out.y) - from_angle_);
    if (turn < 0) turn += whole;
    // Rounding may put the point a little beyond an end, and the nearer end says which.
    if (turn > sweep) return turn - sweep < whole - turn ? length_ : 0;
    return std::min(curve_.radius * turn, length_);
  }
  /// Returns how far a stretch of this length lies from its chord at most.
  [[nodiscard]] double sagitta(double length) const {
    return is_arc(curve_) ? length * length / (8 * curve_.radius) : 0;
  }
  /// Returns half the difference of an arc's radii. Points by angle are this close to the curve that is
  /// meant.
  [[nodiscard]] double slack() const {
    if (!is_arc(curve_)) return 0;
    const geom::Edge& e = curve_.edge;
    return 0.5 * std::abs(norm(e.from - e.centre) - norm(e.to - e.centre));
  }

 private:
  const Curve& curve_;
  double length_, from_angle_ = 0, sign_ = 1;
};

/// Returns a distance that no point of the segment from a to b exceeds from the curve.
double largest_distance(Point a, Point b, const Curve& curve) {
  const auto from_point = [&](Point p) { return std::max(norm(a - p), norm(b - p)); };
  if (!is_arc(curve)) {
    // A line is convex, and the distance from a convex set is convex along the segment.
    return std::max(norm(a - nearest_on(curve, a)), norm(b - nearest_on(curve, b)));
  }
  // The corners must lie in directions that the arc faces, in a convex piece of them. For a wide arc that
  // piece is a half plane.
  const Point to_a = a - curve.edge.centre, to_b = b - curve.edge.centre;
  const bool after_first = cross(curve.first, to_a) >= 0 && cross(curve.first, to_b) >= 0;
  const bool before_last = cross(to_a, curve.last) >= 0 && cross(to_b, curve.last) >= 0;
  if (curve.full || (curve.wide ? after_first || before_last : after_first && before_last)) {
    const double nearest = geom::distance_to_segment(curve.edge.centre, a, b);
    return std::max(std::abs(std::max(norm(to_a), norm(to_b)) - curve.radius),
                    std::abs(curve.radius - nearest));
  }
  return std::min(from_point(curve.edge.from), from_point(curve.edge.to));
}

/// One edge of the part in the blank.
class EdgeSearch {
 public:
  EdgeSearch(const Curve& curve, const RegionIndex& blank, const BlankFromPart& pose, double rounding)
      : placed_(phi::placed(curve, pose)), track_(curve), blank_(blank), pose_(pose), rounding_(rounding) {}

  EdgeAllowance measure(std::size_t stretches, double tolerance) {
    EdgeAllowance found;
    found.length = track_.length();
    const NearestPoint closest = nearest_of(placed_);
    if (closest.distance > rounding_) side_ = blank_.contains(pose_(track_.at(0))) ? 1 : -1;
    for (std::size_t k = 0; k <= stretches; ++k) {
      const double share = static_cast<double>(k) / static_cast<double>(stretches);
      found.samples.push_back(at(share * found.length, k == 0 ? 0 : found.samples.back().blank_edge));
    }
    const double error = rounding_ + track_.slack();
    // The whole edge is on one side, so one extreme comes by a formula.
    if (side_ != 0) {
      const OutlinePoint nearest = at(track_.along(pose_.inverse()(closest.point)), closest.blank_edge);
      const Extreme farthest = search(found.samples, side_, tolerance);
      const double near = side_ * closest.distance, far = side_ * farthest.bound;
      found.least = side_ > 0 ? nearest : farthest.point;
      found.most = side_ > 0 ? farthest.point : nearest;
      found.least_low = (side_ > 0 ? near : far) - error;
      found.most_high = (side_ > 0 ? far : near) + error;
    } else {
      const Extreme low = search(found.samples, -1, tolerance), high = search(found.samples, 1, tolerance);
      found.least = low.point, found.most = high.point;
      found.least_low = -low.bound - error, found.most_high = high.bound + error;
    }
    for (const OutlinePoint& extreme : {found.least, found.most}) insert(extreme, found.samples);
    return found;
  }

 private:
  struct NearestPoint {
    double distance = kInfinity;
    Point point;  ///< of the part, blank frame
    std::uint32_t blank_edge = 0;
  };
  [[nodiscard]] NearestPoint nearest_of(const Curve& curve) const {
    const geom::Box box = geom::curve_box(curve);
    const Point middle = 0.5 * (box.low + box.high);
    const double radius = 0.5 * norm(box.high - box.low);
    NearestPoint best;
    double limit = kInfinity;
    blank_.visit_within(middle, radius, limit, [&](std::uint32_t j) {
      const geom::ClosestPoints close = closest_points(curve, blank_.curves()[j]);
      if (close.distance < best.distance) best = {close.distance, close.a, j}, limit = close.distance;
    });
    return best;
  }

  [[nodiscard]] OutlinePoint at(double along, std::uint32_t likely) const {
    OutlinePoint point{along, track_.at(along), {}, 0, 0};
    point.in_blank = pose_(point.in_part);
    const RegionIndex::Nearest nearest = blank_.nearest(point.in_blank, likely);
    point.blank_edge = nearest.edge;
    if (nearest.distance > rounding_) {
      const int side = side_ != 0 ? side_ : (blank_.contains(point.in_blank) ? 1 : -1);
      point.allowance = side * nearest.distance;
    }
    return point;
  }

  struct Stretch {
    OutlinePoint a, b;
    double bound = 0;
    /// Orders by bound; among equal bounds the first along the edge comes first.
    friend bool operator<(const Stretch& left, const Stretch& right) {
      return left.bound != right.bound ? left.bound < right.bound : left.a.along > right.a.along;
    }
  };
  struct Extreme {
    OutlinePoint point;
    /// No point has more (times the sign).
    double bound = 0;
  };

  /// Returns a bound that no point between a and b exceeds in allowance (times the sign).
  [[nodiscard]] double bound(const OutlinePoint& a, const OutlinePoint& b, int sign) const {
    const double at_a = sign * a.allowance, at_b = sign * b.allowance, length = b.along - a.along;
    double most = 0.5 * (at_a + at_b + length);
    for (const std::uint32_t j : {a.blank_edge, b.blank_edge}) {
      ask();
      const double far = largest_distance(a.in_blank, b.in_blank, blank_.curves()[j]);
      most = std::min(most, far + track_.sagitta(length));
    }
    if (side_ == 0 && at_a < 0 && at_b < 0 && most > std::max(at_a, at_b)) {
      // The stretch is wholly on the other side if it does not meet the boundary.
      const NearestPoint closest = nearest_of(stretch_of(a, b));
      if (closest.distance > rounding_) most = std::min(most, -closest.distance);
    }
    return std::max({most, at_a, at_b});
  }
  [[nodiscard]] Curve stretch_of(const OutlinePoint& a, const OutlinePoint& b) const {
    geom::Edge edge = placed_.edge;
    edge.from = a.in_blank, edge.to = b.in_blank;
    return geom::make_curve(edge);
  }

  /// Returns the most allowance times the sign.
  [[nodiscard]] Extreme search(const std::vector<OutlinePoint>& samples, int sign, double tolerance) const {
    OutlinePoint best = samples.front();
    const auto keep = [&](const OutlinePoint& point) {
      if (sign * point.allowance > sign * best.allowance) best = point;
    };
    std::for_each(samples.begin(), samples.end(), keep);
    std::vector<Stretch> open;
    const auto add = [&](const OutlinePoint& a, const OutlinePoint& b) {
      const double most = bound(a, b, sign);
      if (most <= sign * best.allowance) return;
      open.push_back({a, b, most});
      std::push_heap(open.begin(), open.end());
    };
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) add(samples[k], samples[k + 1]);
    for (std::size_t split = 0; !open.empty() && open.front().bound > sign * best.allowance + tolerance;
         ++split) {
      const Stretch widest = open.front();
      const double middle = 0.5 * (widest.a.along + widest.b.along);
      if (split == kMostSplits || !(middle > widest.a.along && middle < widest.b.along)) break;
      std::pop_heap(open.begin(), open.end());
      open.pop_back();
      const OutlinePoint point = at(middle, widest.a.blank_edge);
      keep(point);
      add(widest.a, point);
      add(point, widest.b);
    }
    const double reached = sign * best.allowance;
    return {best, open.empty() ? reached : std::max(reached, open.front().bound)};
  }

  static void insert(const OutlinePoint& point, std::vector<OutlinePoint>& samples) {
    const auto after =
        std::lower_bound(samples.begin(), samples.end(), point,
                         [](const OutlinePoint& a, const OutlinePoint& b) { return a.along < b.along; });
    if (after == samples.end() || after->along != point.along) samples.insert(after, point);
  }

  Curve placed_;
  Track track_;
  const RegionIndex& blank_;
  BlankFromPart pose_;
  double rounding_;
  /// The side of the whole edge: 1 inside the blank, -1 outside, 0 where it meets the boundary.
  int side_ = 0;
};

double largest_number(const RegionIndex& index) {
  double largest = 0;
  for (const Curve& curve : index.curves()) {
    largest = std::max(largest, curve.radius);
    for (const Point p : {curve.edge.from, curve.edge.to})
      largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  }
  return largest;
}

}  // namespace

Result<std::vector<EdgeAllowance>> edge_allowances(const std::vector<geom::Region>& part_regions,
                                                   const std::vector<geom::Region>& blank_regions,
                                                   const BlankFromPart& pose, double step, double tolerance) {
  if (!(step > 0) || !(tolerance > 0)) {
    return failure(
        ErrorCode::usage,
        fmt::format("the step along the outline is {} mm and the tolerance {} mm; both must be above 0", step,
                    tolerance));
  }
  const RegionIndex part(part_regions), blank(blank_regions);
  std::vector<std::size_t> stretches;
  double total = 0;
  for (const Curve& curve : part.curves()) {
    const Track track(curve);
    const double count =
        std::max({1.0, std::ceil(track.length() / step), std::ceil(track.sweep() / kLongestTurn)});
    total += count + 1;
    if (!(total <= static_cast<double>(kMaxOutlinePoints))) {
      return failure(
          ErrorCode::usage,
          fmt::format("a step of {} mm gives more than {} points along the outline; choose a longer one",
                      step, kMaxOutlinePoints));
    }
    stretches.push_back(static_cast<std::size_t>(count));
  }
  const double far = std::abs(pose.translation.x) + std::abs(pose.translation.y);
  const double rounding =
      2 * geom::kEdgeDistanceError * (2 * largest_number(part) + largest_number(blank) + far);
  std::vector<EdgeAllowance> edges;
  for (std::size_t k = 0; k < stretches.size(); ++k)
    edges.push_back(EdgeSearch(part.curves()[k], blank, pose, rounding).measure(stretches[k], tolerance));
  return edges;
}

}  // namespace lekalo::locate

#include "allowance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify {
namespace {

/// Two distances that the filter computes in doubles may differ by so much where the true ones do not, for
/// points with coordinates up to 1 in magnitude: by twice the error of one. With u = 2^-53: a point is within
/// 2 u of the exact one in each coordinate, a unit normal within 8 u, and the sum of two products of a normal
/// with a difference up to 2 gathers less than 60 u. Clamping to a segment moves its foot by a few u more.
/// 128 u covers all of it.
constexpr double kFilterSlack = 0x1p-45;

Turn rotation(const Decimal& angle, Precision precision) {
  return turn_by(Interval(angle, precision + angle_bits(angle)));
}

/// Returns direction x (R v + t - a), which is the distance times the direction's length.
Interval scaled_distance(const Point& v, const Point& a, const Point& direction, const Point& shift,
                         const Turn& turn, Precision precision) {
  return turn.cosine * Interval(cross(direction, v), precision) +
         turn.sine * Interval(dot(direction, v), precision) +
         Interval(cross(direction, shift - a), precision);
}

Interval length(const Point& direction, Precision precision) {
  return square_root(Interval(dot(direction, direction), precision));
}

// ---- the filter in doubles --------------------------------------------------------------------------------

struct IntervalPoint {
  Interval x, y;
};

struct FlatPoint {
  double x = 0, y = 0;
};

FlatPoint operator-(FlatPoint a, FlatPoint b) { return {a.x - b.x, a.y - b.y}; }

/// The outlines as seen from one corner of the blank, so that a blank far from the origin keeps its digits.
/// The placed points of the part are intervals. Both outlines also stand here as doubles in units of 2^scale,
/// which makes no coordinate larger than 1.
class SeenFromBlank {
 public:
  SeenFromBlank(const Outline& blank, const Outline& part, const Pose& pose, const Turn& turn,
                Precision precision)
      : blank_(blank), precision_(precision), origin_(blank.corner(0)) {
    const Interval tx(pose.shift.x - origin_.x, precision), ty(pose.shift.y - origin_.y, precision);
    for (const Point& v : part.points) {
      const Interval x(v.x, precision), y(v.y, precision);
      placed_.push_back({turn.cosine * x - turn.sine * y + tx, turn.sine * x + turn.cosine * y + ty});
    }
    for (const IntervalPoint& p : placed_) {
      scale_ = std::max({scale_, bits_of(p.x), bits_of(p.y)});
    }
    for (const Point& q : blank.points) {
      scale_ = std::max({scale_, bits_of(q.x - origin_.x), bits_of(q.y - origin_.y)});
    }
    for (const IntervalPoint& p : placed_) {
      flat_part_.push_back({p.x.nearly_low(scale_), p.y.nearly_low(scale_)});
    }
    for (const Point& q : blank.points) {
      flat_blank_.push_back({scaled_down(q.x - origin_.x, scale_), scaled_down(q.y - origin_.y, scale_)});
    }
  }

  [[nodiscard]] const std::vector<FlatPoint>& flat_part() const { return flat_part_; }
  [[nodiscard]] const std::vector<FlatPoint>& flat_blank() const { return flat_blank_; }
  [[nodiscard]] const IntervalPoint& placed(std::size_t i) const { return placed_[i]; }
  [[nodiscard]] IntervalPoint blank_point(std::size_t i) const {
    const Point q = blank_.points[i] - origin_;
    return {Interval(q.x, precision_), Interval(q.y, precision_)};
  }

  /// Gives the unit normal to the left of hull edge j, and the edge's dent in units of 2^scale.
  void flat_line(std::size_t j, FlatPoint& normal, double& dent) const {
    const Point side = blank_.side(j);
    const long size = std::max(bits_of(side.x), bits_of(side.y));
    const double x = scaled_down(side.x, size), y = scaled_down(side.y, size);
    const double side_length = std::sqrt(x * x + y * y);
    normal = {-y / side_length, x / side_length};
    dent = scaled_down(blank_.dents[j], size + scale_) / side_length;
  }

 private:
  const Outline& blank_;
  Precision precision_;
  Point origin_;
  std::vector<IntervalPoint> placed_;
  std::vector<FlatPoint> flat_part_, flat_blank_;
  long scale_ = {};
};

struct FlatBox {
  FlatPoint low, high;
};

/// Points in the order of an outline, with the boxes of halves of halves of them.
class PointTree {
 public:
  explicit PointTree(std::vector<FlatPoint> points) : points_(std::move(points)) {
    if (!points_.empty()) build(0, 0, points_.size());
  }

  /// Calls visit(i, point) in order for all points but those in boxes for which skip(box) is true.
  template <class Skip, class Visit>
  void visit_but(const Skip& skip, const Visit& visit) const {
    if (!points_.empty()) descend(0, 0, points_.size(), skip, visit);
  }

 private:
  static constexpr std::size_t kLeaf = 8;

  void build(std::size_t node, std::size_t begin, std::size_t end) {
    if (node >= boxes_.size()) boxes_.resize(node + 1);
    FlatBox box{points_[begin], points_[begin]};
    for (std::size_t i = begin + 1; i < end; ++i) {
      const FlatPoint p = points_[i];
      box = {{std::min(box.low.x, p.x), std::min(box.low.y, p.y)},
             {std::max(box.high.x, p.x), std::max(box.high.y, p.y)}};
    }
    boxes_[node] = box;
    if (end - begin <= kLeaf) return;
    const std::size_t middle = begin + (end - begin) / 2;
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
  }

  template <class Skip, class Visit>
  void descend(std::size_t node, std::size_t begin, std::size_t end, const Skip& skip,
               const Visit& visit) const {
    if (skip(boxes_[node])) return;
    ask();
    if (end - begin <= kLeaf) {
      for (std::size_t i = begin; i < end; ++i) visit(i, points_[i]);
      return;
    }
    const std::size_t middle = begin + (end - begin) / 2;
    descend(2 * node + 1, begin, middle, skip, visit);
    descend(2 * node + 2, middle, end, skip, visit);
  }

  std::vector<FlatPoint> points_;
  std::vector<FlatBox> boxes_;
};

using Pair = std::pair<std::size_t, std::size_t>;

/// Finds the pairs (row, point) whose true distance may be the least, given distances within half
/// kFilterSlack of the true ones. Step 3 of docs/design/verify.md decides between them exactly. \param row_of
/// gives of a row's number what tells the distance of a point, and a bound for those in a box
template <class RowOf>
std::vector<Pair> near_minimal(std::size_t rows, std::vector<FlatPoint> points, RowOf row_of) {
  const PointTree tree(std::move(points));
  double limit = std::numeric_limits<double>::infinity();
  const auto visit_below_limit = [&](const auto& row, const auto& visit) {
    tree.visit_but([&](const FlatBox& box) { return row.bound(box) > limit + kFilterSlack; }, visit);
  };
  for (std::size_t r = 0; r < rows; ++r) {
    const auto row = row_of(r);
    visit_below_limit(row, [&](std::size_t, FlatPoint p) { limit = std::min(limit, row.distance(p)); });
  }
  limit += kFilterSlack;
  std::vector<Pair> pairs;
  for (std::size_t r = 0; r < rows; ++r) {
    const auto row = row_of(r);
    visit_below_limit(row, [&](std::size_t i, FlatPoint p) {
      if (!(row.distance(p) > limit)) pairs.emplace_back(r, i);
    });
  }
  return pairs;
}

/// A line by a point of it and its unit normal, moved in by a dent.
struct LineRow {
  FlatPoint at, normal;
  double dent = 0;
  [[nodiscard]] double distance(FlatPoint p) const {
    const FlatPoint w = p - at;
    return normal.x * w.x + normal.y * w.y - dent;
  }
  [[nodiscard]] double bound(const FlatBox& box) const {
    const FlatPoint low = box.low - at, high = box.high - at;
    return std::min(normal.x * low.x, normal.x * high.x) + std::min(normal.y * low.y, normal.y * high.y) -
           dent;
  }
};

struct SegmentRow {
  FlatPoint a, b;
  /// No number where the segment is too short for doubles, and then the pair is decided exactly.
  [[nodiscard]] double distance(FlatPoint p) const {
    const FlatPoint e = b - a, w = p - a;
    const double t = std::clamp((w.x * e.x + w.y * e.y) / (e.x * e.x + e.y * e.y), 0.0, 1.0);
    const FlatPoint rest{w.x - t * e.x, w.y - t * e.y};
    return std::sqrt(rest.x * rest.x + rest.y * rest.y);
  }
  /// The distance of the segment's box.
  [[nodiscard]] double bound(const FlatBox& box) const {
    const double x = std::max({0.0, std::min(a.x, b.x) - box.high.x, box.low.x - std::max(a.x, b.x)}),
                 y = std::max({0.0, std::min(a.y, b.y) - box.high.y, box.low.y - std::max(a.y, b.y)});
    return std::sqrt(x * x + y * y);
  }
};

std::vector<FlatPoint> chosen(const std::vector<FlatPoint>& points, const std::vector<std::size_t>& which) {
  std::vector<FlatPoint> found;
  found.reserve(which.size());
  for (const std::size_t i : which) found.push_back(points[i]);
  return found;
}

// ---- exact minima -----------------------------------------------------------------------------------------

Interval least_of(const std::vector<Interval>& values) {
  Interval least = values.front();
  for (const Interval& value : values) least = minimum(least, value);
  return least;
}

/// Returns the least signed distance from the lines of the hull's edges. With `dented` each edge is first
/// moved in by its dent.
Interval line_minimum(const Outline& blank, const Outline& part, const Pose& pose, const Turn& turn,
                      const SeenFromBlank& scene, bool dented, Precision precision) {
  const auto line = [&](std::size_t j) {
    LineRow row;
    row.at = scene.flat_blank()[blank.hull[j]];
    scene.flat_line(j, row.normal, row.dent);
    if (!dented) row.dent = 0;
    return row;
  };
  std::vector<Interval> values;
  for (const auto& [j, i] : near_minimal(blank.hull.size(), chosen(scene.flat_part(), part.hull), line)) {
    const Point side = blank.side(j);
    Interval value = scaled_distance(part.corner(i), blank.corner(j), side, pose.shift, turn, precision);
    if (dented) value = value - Interval(blank.dents[j], precision);
    values.push_back(value / length(side, precision));
  }
  return least_of(values);
}

Interval segment_distance(const IntervalPoint& p, const IntervalPoint& a, const IntervalPoint& b) {
  const IntervalPoint e{b.x - a.x, b.y - a.y}, w{p.x - a.x, p.y - a.y}, z{p.x - b.x, p.y - b.y};
  const Interval along = w.x * e.x + w.y * e.y, squared = square(e.x) + square(e.y);
  const Interval from_a = square_root(square(w.x) + square(w.y)),
                 from_b = square_root(square(z.x) + square(z.y));
  if (certainly_zero(squared) || certainly_negative(along)) return from_a;
  if (certainly_above(along, squared)) return from_b;
  if (!certainly_positive(squared)) return hull(Interval(p.x.precision()), from_a);
  const Interval cross_product = e.x * w.y - e.y * w.x;
  Interval nearest = square_root(square(cross_product) / squared);
  if (!certainly_positive(along)) nearest = hull(nearest, from_a);
  if (!certainly_above(squared, along)) nearest = hull(nearest, from_b);
  return nearest;
}

/// Returns the distance between two outlines that do not cross: from part points to blank edges, and from
/// blank points to part edges. Hull corners of the blank need not be looked at, because they are never
/// nearest to the inside of a part edge.
Interval outline_distance(const Outline& blank, const Outline& part, const SeenFromBlank& scene) {
  const std::size_t n = blank.points.size(), m = part.points.size();
  std::vector<bool> is_corner(n, false);
  for (const std::size_t i : blank.hull) is_corner[i] = true;
  std::vector<std::size_t> others;
  for (std::size_t i = 0; i < n; ++i) {
    if (!is_corner[i]) others.push_back(i);
  }
  const auto blank_edge = [&](std::size_t j) {
    return SegmentRow{scene.flat_blank()[j], scene.flat_blank()[(j + 1) % n]};
  };
  const auto part_edge = [&](std::size_t j) {
    return SegmentRow{scene.flat_part()[j], scene.flat_part()[(j + 1) % m]};
  };
  std::vector<Interval> values;
  for (const auto& [j, i] : near_minimal(n, scene.flat_part(), blank_edge)) {
    values.push_back(segment_distance(scene.placed(i), scene.blank_point(j), scene.blank_point((j + 1) % n)));
  }
  for (const auto& [j, i] : near_minimal(m, chosen(scene.flat_blank(), others), part_edge)) {
    values.push_back(
        segment_distance(scene.blank_point(others[i]), scene.placed(j), scene.placed((j + 1) % m)));
  }
  return least_of(values);
}

}  // namespace

Interval allowance(const Outline& blank, const Outline& part, const Pose& pose, Precision precision) {
  const Turn turn = rotation(pose.angle, precision);
  const SeenFromBlank scene(blank, part, pose, turn, precision);
  const Interval outer = line_minimum(blank, part, pose, turn, scene, false, precision);
  if (blank.convex()) return outer;
  const Interval inner = line_minimum(blank, part, pose, turn, scene, true, precision);
  return certainly_positive(inner) ? outline_distance(blank, part, scene) : hull(inner, outer);
}

Interval line_distance(const Point& v, const Point& a, const Point& direction, const Pose& pose,
                       Precision precision) {
  return scaled_distance(v, a, direction, pose.shift, rotation(pose.angle, precision), precision) /
         length(direction, precision);
}

Precision working_precision(const Outline& blank, const Outline& part) {
  long widest = {};
  for (const Outline* outline : {&blank, &part}) {
    for (const Point& p : outline->points) widest = std::max({widest, bits_of(p.x), bits_of(p.y)});
  }
  return 256 + 6 * static_cast<Precision>(widest);
}

}  // namespace lekalo::verify

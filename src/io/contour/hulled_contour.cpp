#include "hulled_contour.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "contour_points.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/double_double.hpp"
#include "lekalo/geom/predicates.hpp"

namespace lekalo::io {
namespace {

using geom::DoubleDouble;
using geom::Point;

struct Vector {
  DoubleDouble x, y;
};

Vector between(Point from, Point to) { return {geom::two_sum(to.x, -from.x), geom::two_sum(to.y, -from.y)}; }
DoubleDouble cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }
DoubleDouble dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }

/// The length of a vector. \pre it is not zero
DoubleDouble length(Vector a) { return geom::sqrt(dot(a, a)); }

/// The margin pays for 30 operations of double-double arithmetic and for leaving the low half out.
double rounded_up(DoubleDouble value, double scale) {
  return std::nextafter(std::abs(value.hi) + 0x1p-96 * scale, std::numeric_limits<double>::infinity());
}

/// File indices without points equal to the one before them, and without closing points equal to the first.
std::vector<std::size_t> without_duplicates(const geom::Ring& points, std::vector<std::size_t>& duplicates) {
  std::vector<std::size_t> ring;
  for (std::size_t i = 0; i < points.size(); ++i) {
    (ring.empty() || points[i] != points[ring.back()] ? ring : duplicates).push_back(i);
  }
  while (ring.size() > 1 && points[ring.back()] == points[ring.front()]) {
    duplicates.push_back(ring.back());
    ring.pop_back();
  }
  std::sort(duplicates.begin(), duplicates.end());
  return ring;
}

/// A strictly convex ring whose corners are numbered on and on around it, so that a chord may cross its
/// beginning.
class HullChords {
 public:
  HullChords(const geom::Ring& hull, double tolerance) : hull_(hull), tolerance_(tolerance) {}

  /// True when all corners strictly between corners i and j > i lie within the tolerance of their segment.
  [[nodiscard]] bool straight(std::size_t i, std::size_t j) const {
    const auto near = [&](std::size_t k) {
      return distance_to_segment_up(corner(k), corner(i), corner(j)) <= tolerance_;
    };
    if (j - i <= 2) return j - i < 2 || near(i + 1);
    return near(farthest(i, j)) && near(i + 1) && near(j - 1);
  }

  /// Returns the largest j <= last with straight(i, j). The search doubles and halves its step, because what
  /// lies between a chord and a convex ring only grows with j.
  [[nodiscard]] std::size_t farthest_straight(std::size_t i, std::size_t last) const {
    std::size_t good = i + 1, step = 1;
    while (good + step <= last && straight(i, good + step)) {
      ask();
      good += step;
      step *= 2;
    }
    for (; step > 0; step /= 2) {
      if (good + step <= last && straight(i, good + step)) good += step;
    }
    return good;
  }

 private:
  [[nodiscard]] Point corner(std::size_t k) const { return hull_[k % hull_.size()]; }

  /// Returns the corner that is farthest from the chord's line. The edges lead away from that line first and
  /// then back to it, so halving finds the corner.
  [[nodiscard]] std::size_t farthest(std::size_t i, std::size_t j) const {
    std::size_t low = i + 1, high = j - 1;
    while (low < high) {
      const std::size_t middle = low + (high - low) / 2;
      if (geom::turn(corner(i), corner(j), corner(middle), corner(middle + 1)) >= 0) {
        high = middle;
      } else {
        low = middle + 1;
      }
    }
    return low;
  }

  const geom::Ring& hull_;
  double tolerance_;
};

/// The indices of the corners that stay, ascending; fewer than three when the hull is no wider than the
/// tolerance. Cost: O(corners log^2 corners).
std::vector<std::size_t> true_corners(const geom::Ring& hull, double tolerance) {
  const std::size_t n = hull.size();
  std::vector<std::size_t> kept;
  if (!(tolerance > 0)) {
    for (std::size_t j = 0; j < n; ++j) kept.push_back(j);
    return kept;
  }
  const HullChords chords(hull, tolerance);
  // convex_hull begins with the point lowest in (x, y), so the outcome does not depend on where the file
  // begins. The first chord stops one corner short of where it began: a chord needs two ends.
  for (std::size_t j = 0; j < n; j = chords.farthest_straight(j, j == 0 ? n - 1 : n)) kept.push_back(j);
  // The walk kept the first corner without looking at it, so it is looked at now.
  if (kept.size() > 3 && chords.straight(kept.back(), kept[1] + n)) kept.erase(kept.begin());
  return kept;
}

/// Counts how often the next corner stands lower in the ring, which should meet the corners in their order,
/// forwards or backwards.
std::size_t count_falls(const std::vector<std::size_t>& corners) {
  std::size_t falls = 0;
  for (std::size_t j = 0; j < corners.size(); ++j)
    falls += corners[(j + 1) % corners.size()] < corners[j] ? 1 : 0;
  return falls;
}

/// A corner that stands neither between its neighbours forwards nor backwards; \pre there is one
std::size_t out_of_order(const std::vector<std::size_t>& corners) {
  const std::size_t n = corners.size();
  const auto rises = [&](std::size_t j) { return corners[(j + 1) % n] > corners[j % n]; };
  std::size_t j = 0;
  while (rises(j) == rises(j + 1)) ++j;
  return corners[(j + 1) % n];
}

}  // namespace

double depth_left_of_line_up(Point p, Point a, Point b) {
  const int side = geom::orientation(a, b, p);
  if (side == 0) return 0;
  const Vector chord = between(a, b), arm = between(a, p);
  return side * rounded_up(cross(chord, arm) / length(chord), std::abs(arm.x.hi) + std::abs(arm.y.hi));
}

double distance_to_segment_up(Point p, Point a, Point b) {
  const auto distance = [](Vector v) {
    return v.x.hi == 0 && v.y.hi == 0 ? 0.0 : rounded_up(length(v), std::abs(v.x.hi) + std::abs(v.y.hi));
  };
  const Vector chord = between(a, b), arm = between(a, p);
  const DoubleDouble along = dot(chord, arm);
  if (a == b || along.hi <= 0) return distance(arm);
  if ((along - dot(chord, chord)).hi >= 0) return distance(between(b, p));
  return std::abs(depth_left_of_line_up(p, a, b));
}

std::string HulledContour::name(std::size_t position) const {
  const std::size_t index = ring[position];
  const Point p = file->points[index];
  const std::string place =
      file->places_are_lines ? fmt::format("line {}: ", file->places[index]) : std::string();
  return fmt::format("point {} ({}{}, {} mm)", index, place, p.x, p.y);
}

Result<HulledContour> find_hull(const ContourFile& file, double tolerance) {
  HulledContour outline;
  outline.file = &file;
  outline.ring = without_duplicates(file.points, outline.duplicates);
  const std::size_t n = outline.ring.size();
  if (n < 3) {
    return refuse(file.name, fmt::format("{} different point{} in a row; a contour needs at least 3", n,
                                         n == 1 ? "" : "s"));
  }
  geom::Ring points, hull_points;
  for (const std::size_t index : outline.ring) points.push_back(file.points[index]);
  const std::vector<std::size_t> hull = geom::convex_hull(points);
  if (hull.size() < 3) {
    return refuse(file.name,
                  fmt::format("the contour has no area: all its points lie on the line through {} and {}",
                              outline.name(hull[0]), outline.name(hull[1])));
  }
  for (const std::size_t position : hull) hull_points.push_back(points[position]);
  for (const std::size_t j : true_corners(hull_points, tolerance)) outline.corners.push_back(hull[j]);
  if (outline.corners.size() < 3) {
    return refuse(file.name,
                  fmt::format("the contour has no area: it is no wider than the rounding of its numbers, "
                              "{:.3g} mm",
                              tolerance));
  }

  const std::size_t falls = count_falls(outline.corners);
  outline.reversed = falls != 1;
  if (falls != 1 && falls + 1 != outline.corners.size()) {
    return refuse(file.name,
                  fmt::format("the contour crosses itself or goes around more than once: {} stands out of "
                              "order",
                              outline.name(out_of_order(outline.corners))));
  }
  if (outline.reversed) {
    std::reverse(outline.ring.begin(), outline.ring.end());
    for (std::size_t& position : outline.corners) position = n - 1 - position;
  }
  std::sort(outline.corners.begin(), outline.corners.end());
  return outline;
}

}  // namespace lekalo::io

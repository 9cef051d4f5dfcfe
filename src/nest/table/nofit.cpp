#include "nofit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lekalo/base/stop.hpp"
#include "nest/tuning/tuning.hpp"

namespace lekalo::nest {
namespace {

using geom::Point;

struct Bounds {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  void add(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
};

struct Sum {
  ConvexPiece corners;
  Bounds box;
};

/// The shifts of b at which two convex pieces overlap: the Minkowski sum of a and b turned about the
/// origin.
Sum difference_of(const ConvexPiece& a, const ConvexPiece& b) {
  const auto lowest = [](const ConvexPiece& p, double sign) {
    std::size_t best = 0;
    for (std::size_t k = 1; k < p.size(); ++k) {
      const double y = sign * p[k].y, by = sign * p[best].y;
      if (y < by || (y == by && sign * p[k].x < sign * p[best].x)) best = k;
    }
    return best;
  };
  const std::size_t n = a.size(), m = b.size();
  const std::size_t a0 = lowest(a, 1), b0 = lowest(b, -1);
  Sum sum;
  std::size_t i = 0, j = 0;
  while (i < n || j < m) {
    const Point p = a[(a0 + i) % n], q = b[(b0 + j) % m];
    sum.corners.push_back(p - q);
    const Point da = a[(a0 + i + 1) % n] - p, db = q - b[(b0 + j + 1) % m];
    const double side = i >= n ? -1 : j >= m ? 1 : cross(da, db);
    if (side >= 0) ++i;
    if (side <= 0) ++j;
  }
  for (const Point p : sum.corners) sum.box.add(p);
  return sum;
}

/// The part of a segment strictly inside a convex polygon, as [from, to] along it; empty when from >= to.
std::pair<double, double> inside_of(const ConvexPiece& polygon, Point start, Point direction, double length,
                                    double reserve) {
  double from = 0, to = length;
  const std::size_t n = polygon.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Point p = polygon[k], edge = polygon[k + 1 == n ? 0 : k + 1] - p;
    const double edge_length = norm(edge);
    if (edge_length == 0) continue;
    // The segment is inside this edge where cross(edge, start + s direction - p) / |edge| > reserve.
    const double at_start = cross(edge, start - p) / edge_length - reserve;
    const double rate = cross(edge, direction) / edge_length;
    if (std::abs(rate) < 1e-13) {
      if (at_start <= 0) return {0, 0};
    } else if (rate > 0) {
      from = std::max(from, -at_start / rate);
    } else {
      to = std::min(to, -at_start / rate);
    }
    if (from >= to) return {0, 0};
  }
  return {from, to};
}

/// The area that p and q moved by t have in common.
double area_in_common(const ConvexPiece& p, const ConvexPiece& q, Point t) {
  ConvexPiece at, next;
  for (const Point c : q) at.push_back(c + t);
  for (std::size_t e = 0; e < p.size() && !at.empty(); ++e) {
    const Point from = p[e], along = p[e + 1 == p.size() ? 0 : e + 1] - from;
    next.clear();
    for (std::size_t k = 0; k < at.size(); ++k) {
      const Point c = at[k], d = at[k + 1 == at.size() ? 0 : k + 1];
      const double side_c = cross(along, c - from), side_d = cross(along, d - from);
      if (side_c >= 0) next.push_back(c);
      if ((side_c > 0 && side_d < 0) || (side_c < 0 && side_d > 0))
        next.push_back(c + (side_c / (side_c - side_d)) * (d - c));
    }
    std::swap(at, next);
  }
  double twice = 0;
  for (std::size_t k = 1; k + 1 < at.size(); ++k) twice += cross(at[k] - at[0], at[k + 1] - at[0]);
  return 0.5 * twice;
}

/// Looks at a box that are a step together.
constexpr std::size_t kPerStep = 64;

using Intervals = std::vector<std::pair<double, double>>;  ///< along a segment, mm

struct Contact {
  Point from, to;
};

/// Adds the shifts at which a corner of one shape, that is no dent, lies on an edge of the other from
/// outside.
void add_contacts(const SearchOutline& edges_of, const SearchOutline& corners_of, bool edges_move,
                  std::vector<Contact>& to) {
  for (const auto& loop : edges_of.loops) {
    for (std::size_t e = 0; e < loop.size(); ++e) {
      const Point a = loop[e], b = loop[(e + 1) % loop.size()];
      const Point along = b - a;
      const Point out = {along.y, -along.x};
      const double size = norm(out);
      if (size == 0) continue;
      ask();
      for (const auto& corners : corners_of.loops) {
        const std::size_t n = corners.size();
        for (std::size_t v = 0; v < n; ++v) {
          const Point p = corners[v], before = corners[(v + n - 1) % n] - p, after = corners[(v + 1) % n] - p;
          const double slack = -1e-9 * size;
          if (dot(before, out) < slack * norm(before) || dot(after, out) < slack * norm(after)) continue;
          if (cross(before, after) > 0) continue;  // a dent
          if (edges_move)
            to.push_back({p - a, p - b});
          else
            to.push_back({a - p, b - p});
        }
      }
    }
  }
}

/// Intervals of a segment that lie inside the sums, sorted.
void cover(const std::vector<Sum>& sums, Point start, Point direction, double length, double reserve,
           Intervals& into) {
  into.clear();
  ask(1 + sums.size() / kPerStep);
  Bounds box;
  box.add(start);
  box.add(start + length * direction);
  for (const Sum& sum : sums) {
    // A segment along an axis has a flat box: it may run inside a sum that its box only touches.
    if (sum.box.low.x > box.high.x || sum.box.high.x < box.low.x || sum.box.low.y > box.high.y ||
        sum.box.high.y < box.low.y)
      continue;
    const auto [from, to] = inside_of(sum.corners, start, direction, length, reserve);
    if (from < to) into.emplace_back(from, to);
  }
  std::sort(into.begin(), into.end());
}

/// Visits what intervals leave of a segment, without gaps that are rounding.
template <class Visit>
void visit_gaps(const Intervals& intervals, double length, double rounding, Visit visit) {
  double at = 0;
  for (const auto& [from, to] : intervals) {
    if (from > at + rounding) visit(at, from);
    at = std::max(at, to);
  }
  if (length > at + rounding) visit(at, length);
}

/// The border of the region of shifts at which two shapes overlap: the contacts, less what lies inside a
/// sum.
std::vector<NoFit::Segment> border_of(const SearchOutline& a, const SearchOutline& b,
                                      const std::vector<Sum>& sums, double size,
                                      const NoFit::IsFree& is_free) {
  const double outward = 1e-10 * size, reserve = 1e-11 * size;
  std::vector<Contact> contacts;
  add_contacts(a, b, false, contacts);
  add_contacts(b, a, true, contacts);
  std::vector<NoFit::Segment> border;
  Intervals covered, at_all;
  for (const Contact& contact : contacts) {
    const double length = norm(contact.to - contact.from);
    if (!(length > 0)) continue;
    const Point direction = (1 / length) * (contact.to - contact.from);
    const Point out = {direction.y, -direction.x};
    cover(sums, contact.from + outward * out, direction, length, reserve, covered);
    visit_gaps(covered, length, 4 * outward, [&](double from, double to) {
      border.push_back({contact.from + from * direction, direction, to - from, false});
    });
    // If both sides of a contact are forbidden, the contact itself may be free: a slot just wide enough.
    if (!is_free) continue;
    cover(sums, contact.from, direction, length, reserve, at_all);
    visit_gaps(at_all, length, 4 * outward, [&](double from, double to) {
      double at = from;
      for (const auto& [low, high] : covered) {
        const double begin = std::max(at, low), end = std::min(to, high);
        if (begin >= end) continue;
        at = end;
        if (is_free(contact.from + 0.5 * (begin + end) * direction))
          border.push_back({contact.from + begin * direction, direction, end - begin, true});
      }
    });
  }
  return border;
}

}  // namespace

SearchOutline turned(const SearchOutline& outline, double c, double s) {
  SearchOutline result = outline;
  const auto turn = [&](Point& p) { p = {c * p.x - s * p.y, s * p.x + c * p.y}; };
  for (auto& loop : result.loops)
    for (Point& p : loop) turn(p);
  for (auto& piece : result.pieces)
    for (Point& p : piece) turn(p);
  return result;
}

NoFit::NoFit(const SearchOutline& a, const SearchOutline& b, double gap, std::size_t cells,
             const IsFree& is_free, const Box& window, bool with_areas, std::size_t most_narrow)
    : gap_(gap) {
  // nest.md, step 1: the sums of convex pieces, the border, and the raster over both.
  std::vector<Sum> sums;
  Bounds all;
  for (const ConvexPiece& p : a.pieces)
    for (const ConvexPiece& q : b.pieces) {
      ask();
      sums.push_back(difference_of(p, q));
      all.add(sums.back().box.low);
      all.add(sums.back().box.high);
    }
  if (sums.empty()) return;
  const double size = std::max(all.high.x - all.low.x, all.high.y - all.low.y);
  tie_ = 1e-8 * size;
  segments_ = border_of(a, b, sums, size, is_free);

  const double margin = gap_ + 1e-9 * size;
  all.low = all.low - Point{margin, margin};
  all.high = all.high + Point{margin, margin};
  if (window.x1 > window.x0) {
    Bounds of_b;
    for (const auto& loop : b.loops)
      for (const Point p : loop) of_b.add(p);
    all.low = {std::max(all.low.x, window.x0 - of_b.high.x), std::max(all.low.y, window.y0 - of_b.high.y)};
    all.high = {std::min(all.high.x, window.x1 - of_b.low.x), std::min(all.high.y, window.y1 - of_b.low.y)};
  }
  const double w = all.high.x - all.low.x, h = all.high.y - all.low.y;
  const double side = std::sqrt(w * h / static_cast<double>(cells));
  per_mm_ = 1 / side;
  x0_ = all.low.x;
  y0_ = all.low.y;
  columns_ = static_cast<std::uint32_t>(std::ceil(w * per_mm_)) + 1;
  rows_ = static_cast<std::uint32_t>(std::ceil(h * per_mm_)) + 1;
  width_ = columns_;
  height_ = rows_;
  cells_.assign(std::size_t{columns_} * rows_, kClear);
  nodes_.assign(std::size_t{columns_ + 1} * (rows_ + 1), 0);
  if (segments_.size() <= most_narrow)
    fill_all(lists_);
  else
    fill_all(wide_lists_);
  if (!with_areas) return;
  area_columns_ = static_cast<std::uint32_t>(std::ceil(w * per_mm_ / tuning::kAreaCell)) + 1;
  const auto area_rows = static_cast<std::uint32_t>(std::ceil(h * per_mm_ / tuning::kAreaCell)) + 1;
  area_per_mm_ = per_mm_ / tuning::kAreaCell;
  area_width_ = area_columns_;
  area_height_ = area_rows;
  areas_.assign(std::size_t{area_columns_ + 1} * (area_rows + 1), 0);
  for (std::uint32_t j = 0; j <= area_rows; ++j)
    for (std::uint32_t i = 0; i <= area_columns_; ++i) {
      const Point t = {x0_ + i / area_per_mm_, y0_ + j / area_per_mm_};
      ask(1 + sums.size() / kPerStep);
      double area = 0;
      auto sum = sums.begin();
      for (const ConvexPiece& p : a.pieces)
        for (const ConvexPiece& q : b.pieces) {
          const Bounds& box = (sum++)->box;
          if (t.x <= box.low.x || t.x >= box.high.x || t.y <= box.low.y || t.y >= box.high.y) continue;
          area += area_in_common(p, q, t);
        }
      areas_[std::size_t{j} * (area_columns_ + 1) + i] = static_cast<float>(area);
    }
}

template <class Index>
void NoFit::fill_all(std::vector<Index>& lists) {
  std::uint32_t square = 1;
  while (square < columns_ || square < rows_) square *= 2;
  std::vector<Index> every(segments_.size());
  std::iota(every.begin(), every.end(), Index{0});
  if (!every.empty()) fill(0, 0, square, every, lists);
}

/// Fills the cells of a square block, by quarters. Segments that are nearest to no point of a block are
/// left out on the way down.
template <class Index>
void NoFit::fill(std::uint32_t x, std::uint32_t y, std::uint32_t size, const std::vector<Index>& candidates,
                 std::vector<Index>& lists) {
  if (x >= columns_ || y >= rows_) return;
  ask(1 + candidates.size() / kPerStep);
  const double side = 1 / per_mm_;
  const double radius = 0.5 * size * side * 1.4142136 + tie_;
  const Point centre = {x0_ + (x + 0.5 * size) * side, y0_ + (y + 0.5 * size) * side};
  std::vector<double> distances;
  double least = std::numeric_limits<double>::infinity();
  for (const Index k : candidates) {
    const Segment& s = segments_[k];
    const Point d = centre - s.from;
    const double along = std::clamp(dot(d, s.direction), 0.0, s.length);
    distances.push_back(norm(d - along * s.direction));
    least = std::min(least, distances.back());
  }
  std::vector<Index> kept;
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (distances[k] <= least + 2 * radius) kept.push_back(candidates[k]);
  if (size > 1) {
    const std::uint32_t half = size / 2;
    fill(x, y, half, kept, lists);
    fill(x + half, y, half, kept, lists);
    fill(x, y + half, half, kept, lists);
    fill(x + half, y + half, half, kept, lists);
    return;
  }
  const Index* begin = kept.data();
  const Index* end = begin + kept.size();
  const double middle = signed_distance(begin, end, centre.x, centre.y).distance + gap_;
  std::uint32_t& cell = cells_[std::size_t{y} * columns_ + x];
  if (middle < -radius) {
    cell = kClear;
  } else if (middle > radius) {
    cell = kDeep;
  } else {
    cell = static_cast<std::uint32_t>(lists.size()) + 2;
    lists.push_back(static_cast<Index>(kept.size()));
    lists.insert(lists.end(), kept.begin(), kept.end());
  }
  for (std::uint32_t j = 0; j < 2; ++j)
    for (std::uint32_t i = 0; i < 2; ++i) {
      const Point p = {x0_ + (x + i) * side, y0_ + (y + j) * side};
      nodes_[std::size_t{y + j} * (columns_ + 1) + x + i] =
          static_cast<float>(std::max(0.0, signed_distance(begin, end, p.x, p.y).distance + gap_));
    }
}

template <class Index>
NoFit::Signed NoFit::signed_distance(const Index* begin, const Index* end, double x,
                                     double y) const noexcept {
  double best = std::numeric_limits<double>::infinity(), best_side = 0;
  Point nearest;
  bool two_sided = false;
  for (const Index* k = begin; k != end; ++k) {
    const Segment& s = segments_[*k];
    const double dx = x - s.from.x, dy = y - s.from.y;
    double along = dx * s.direction.x + dy * s.direction.y;
    const double side = s.direction.x * dy - s.direction.y * dx;
    along = along < 0 ? 0 : along > s.length ? s.length : along;
    const double ex = dx - along * s.direction.x, ey = dy - along * s.direction.y;
    const double distance = std::sqrt(ex * ex + ey * ey);
    // At a corner two edges are equally near, and the one whose line is further away knows the side.
    if (distance < best - tie_ ||
        (distance < best + tie_ && (distance < best ? std::abs(side) >= std::abs(best_side) - tie_
                                                    : std::abs(side) > std::abs(best_side) + tie_))) {
      best_side = side;
      two_sided = s.two_sided;
      nearest = {s.from.x + along * s.direction.x, s.from.y + along * s.direction.y};
      if (distance < best) best = distance;
    } else if (distance < best) {
      best = distance;
    }
  }
  return {best_side > 0 || two_sided ? best : -best, nearest};
}

template <class Visit>
auto NoFit::near_border(std::uint32_t cell, Visit visit) const noexcept {
  if (wide_lists_.empty()) {
    const std::uint16_t* list = &lists_[cell - 2];
    return visit(list + 1, list + 1 + *list);
  }
  const std::uint32_t* list = &wide_lists_[cell - 2];
  return visit(list + 1, list + 1 + *list);
}

double NoFit::depth_near(std::uint32_t cell, double x, double y) const noexcept {
  const double distance = near_border(cell, [&](const auto* begin, const auto* end) {
    return signed_distance(begin, end, x, y).distance + gap_;
  });
  return distance > 0 ? distance : 0;
}

NoFit::Way NoFit::way_out(double x, double y) const noexcept {
  const double fx = (x - x0_) * per_mm_, fy = (y - y0_) * per_mm_;
  if (!(fx >= 0 && fy >= 0 && fx < width_ && fy < height_)) return {};
  const auto ix = static_cast<std::uint32_t>(fx), iy = static_cast<std::uint32_t>(fy);
  const std::uint32_t cell = cells_[iy * columns_ + ix];
  if (cell == kClear) return {};
  if (cell == kDeep) {
    const float* node = &nodes_[iy * (columns_ + 1) + ix];
    const double u = fx - ix, v = fy - iy;
    const double a = static_cast<double>(node[0]), b = static_cast<double>(node[1]),
                 c = static_cast<double>(node[columns_ + 1]), d = static_cast<double>(node[columns_ + 2]);
    const Point up = {(b - a) * (1 - v) + (d - c) * v, (c - a) * (1 - u) + (d - b) * u};
    const double length = norm(up);
    const double value = (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
    if (!(length > 0)) return {value, {1, 0}};
    return {value, (-1 / length) * up};
  }
  return near_border(cell, [&](const auto* begin, const auto* end) { return way_near(begin, end, {x, y}); });
}

template <class Index>
NoFit::Way NoFit::way_near(const Index* begin, const Index* end, Point p) const noexcept {
  const Signed at = signed_distance(begin, end, p.x, p.y);
  if (!(at.distance + gap_ > 0)) return {};
  const Point to = at.distance >= 0 ? at.nearest - p : p - at.nearest;
  const double length = norm(to);
  if (length > 1e-12) return {at.distance + gap_, (1 / length) * to};
  // On the border the way out leads across the nearest edge.
  double best = std::numeric_limits<double>::infinity();
  Point direction;
  for (const Index* k = begin; k != end; ++k) {
    const Segment& s = segments_[*k];
    const double side = std::abs(cross(s.direction, p - s.from));
    if (side < best) {
      best = side;
      direction = {s.direction.y, -s.direction.x};
    }
  }
  return {at.distance + gap_, direction};
}

}  // namespace lekalo::nest

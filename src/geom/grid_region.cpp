#include "lekalo/geom/grid_region.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "lekalo/base/stop.hpp"
#include "lekalo/geom/box_tree.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/geom/wide_product.hpp"

namespace lekalo::geom {
namespace {

using Loop = std::vector<GridPoint>;

std::string loop_name(std::size_t loop) { return loop == 0 ? "outline" : fmt::format("hole {}", loop - 1); }

std::string place(GridPoint p) {
  const Point mm = mm_from_grid(p);
  return fmt::format("({:.6g}, {:.6g})", mm.x, mm.y);
}

Int128 twice_area(const GridPoint* points, std::size_t n) noexcept {
  Int128 sum = 0;
  for (std::size_t i = 1; i + 1 < n; ++i) sum += cross(points[i] - points[0], points[i + 1] - points[0]);
  return sum;
}

bool nearer_than_resolution(GridPoint a, GridPoint b) noexcept {
  const GridPoint d = b - a;
  return dot(d, d) < kGridResolution * kGridResolution;
}

/// Says, exactly, whether p is nearer to the segment a b than the resolution.
bool nearer_than_resolution(GridPoint p, GridPoint a, GridPoint b) noexcept {
  const GridPoint along = b - a, to = p - a;
  const Int128 at = dot(to, along), length = dot(along, along);
  if (at <= 0) return nearer_than_resolution(p, a);
  if (at >= length) return nearer_than_resolution(p, b);
  const Int128 height = cross(along, to);
  return wide_product(height, height) < wide_product(Int128{kGridResolution} * kGridResolution, length);
}

bool cross_each_other(GridPoint a, GridPoint b, GridPoint c, GridPoint d) noexcept {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

/// Joins points that follow one another too closely into the first of them.
void thin(Loop& loop) {
  Loop kept;
  for (const GridPoint p : loop)
    if (kept.empty() || !nearer_than_resolution(kept.back(), p)) kept.push_back(p);
  while (kept.size() > 1 && nearer_than_resolution(kept.back(), kept.front())) kept.pop_back();
  loop = std::move(kept);
}

Result<void> check_reach(const Loop& loop, std::size_t index) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    constexpr std::int64_t kMost = kGridLimit / 4;
    if (loop[i].x < -kMost || loop[i].x > kMost || loop[i].y < -kMost || loop[i].y > kMost)
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}: point {} at {} mm is further from the origin than {} mm; check the units",
                      loop_name(index), i, place(loop[i]), mm_from_grid(kMost)));
  }
  return {};
}

/// The edges of a region by their numbers, without a copy of their points.
class RegionEdges {
 public:
  explicit RegionEdges(const GridRegion& region) : region_(region), next_(region.points.size()) {
    for (std::size_t l = 0; l < region.loops(); ++l) {
      const std::uint32_t begin = region.loop_starts[l], end = region.loop_starts[l + 1];
      for (std::uint32_t i = begin; i < end; ++i) next_[i] = i + 1 == end ? begin : i + 1;
    }
  }
  [[nodiscard]] std::uint32_t size() const noexcept { return static_cast<std::uint32_t>(next_.size()); }
  [[nodiscard]] GridPoint from(std::uint32_t i) const noexcept { return region_.points[i]; }
  [[nodiscard]] GridPoint to(std::uint32_t i) const noexcept { return region_.points[next_[i]]; }
  [[nodiscard]] std::size_t loop(std::uint32_t i) const noexcept {
    const auto& starts = region_.loop_starts;
    return static_cast<std::size_t>(std::upper_bound(starts.begin(), starts.end(), i) - starts.begin()) - 1;
  }
  [[nodiscard]] std::uint32_t index_in_loop(std::uint32_t i) const noexcept {
    return i - region_.loop_starts[loop(i)];
  }

 private:
  const GridRegion& region_;
  std::vector<std::uint32_t> next_;  ///< the point at which each edge ends
};

BoxTree tree_of(const RegionEdges& edges) {
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const GridPoint a = edges.from(i), b = edges.to(i);
    constexpr double kMargin = kGridResolution;
    boxes.push_back({{static_cast<double>(std::min(a.x, b.x)) - kMargin,
                      static_cast<double>(std::min(a.y, b.y)) - kMargin},
                     {static_cast<double>(std::max(a.x, b.x)), static_cast<double>(std::max(a.y, b.y))}});
  }
  return BoxTree(boxes);
}

/// Refuses edges that meet, or come nearer than the resolution without being neighbours. Names the first two.
Result<void> check_meetings(const GridRegion& region) {
  const RegionEdges edges(region);
  std::optional<std::pair<std::uint32_t, std::uint32_t>> first;
  tree_of(edges).visit_pairs([&](std::uint32_t i, std::uint32_t j) {
    if (first && *first <= std::pair{i, j}) return;
    const GridPoint a = edges.from(i), b = edges.to(i), c = edges.from(j), d = edges.to(j);
    const bool i_then_j = b == c, j_then_i = d == a;
    const bool near =
        (!i_then_j && !j_then_i && cross_each_other(a, b, c, d)) ||
        (!j_then_i && nearer_than_resolution(a, c, d)) || (!i_then_j && nearer_than_resolution(b, c, d)) ||
        (!i_then_j && nearer_than_resolution(c, a, b)) || (!j_then_i && nearer_than_resolution(d, a, b));
    if (near) first = {i, j};
  });
  if (!first) return {};
  const auto [i, j] = *first;
  return failure(
      ErrorCode::bad_input,
      fmt::format("{}: edge {} from {} and {} edge {} from {} (mm) cross, touch or come nearer than {:.1g} "
                  "mm; an outline may not meet itself",
                  loop_name(edges.loop(i)), edges.index_in_loop(i), place(edges.from(i)),
                  edges.loop(i) == edges.loop(j) ? "its own" : loop_name(edges.loop(j)),
                  edges.index_in_loop(j), place(edges.from(j)), mm_from_grid(kGridResolution)));
}

PointLocation locate_in_loop(const GridPoint* points, std::size_t n, GridPoint p) noexcept {
  bool inside = false;
  for (std::size_t i = 0, j = n - 1; i < n; j = i++) {
    const GridPoint a = points[j], b = points[i];
    if ((a.y > p.y) == (b.y > p.y)) {
      // Both ends are on one side, or both are level with p, and then p may lie on the level edge.
      if (a.y == p.y && b.y == p.y && std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x))
        return PointLocation::boundary;
      if (b == p) return PointLocation::boundary;
      continue;
    }
    const int side = turn(a, b, p);
    if (side == 0) return PointLocation::boundary;
    if ((side > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside ? PointLocation::inside : PointLocation::outside;
}

const GridPoint* loop_begin(const GridRegion& region, std::size_t l) noexcept {
  return region.points.data() + region.loop_starts[l];
}
std::size_t loop_size(const GridRegion& region, std::size_t l) noexcept {
  return region.loop_starts[l + 1] - region.loop_starts[l];
}

GridBox bounds_of(const GridPoint* points, std::size_t n) noexcept {
  GridBox box{points[0], points[0]};
  for (std::size_t i = 1; i < n; ++i) {
    box.low = {std::min(box.low.x, points[i].x), std::min(box.low.y, points[i].y)};
    box.high = {std::max(box.high.x, points[i].x), std::max(box.high.y, points[i].y)};
  }
  return box;
}

/// Refuses a hole that lies outside the outline or in another hole. The loops do not meet, so one point tells
/// where a whole loop lies.
Result<void> check_nesting(const GridRegion& region) {
  const auto inside = [&](std::size_t hole, std::size_t loop) {
    ask(1 + loop_size(region, loop) / 16);
    return locate_in_loop(loop_begin(region, loop), loop_size(region, loop), *loop_begin(region, hole)) ==
           PointLocation::inside;
  };
  std::vector<Box> boxes;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    const GridBox box = bounds_of(loop_begin(region, l), loop_size(region, l));
    boxes.push_back({{static_cast<double>(box.low.x), static_cast<double>(box.low.y)},
                     {static_cast<double>(box.high.x), static_cast<double>(box.high.y)}});
  }
  for (std::size_t h = 1; h < region.loops(); ++h)
    if (!inside(h, 0))
      return failure(ErrorCode::bad_input, fmt::format("{}: it lies outside the outline, at {} mm",
                                                       loop_name(h), place(*loop_begin(region, h))));
  std::optional<std::pair<std::size_t, std::size_t>> nested;
  BoxTree(boxes).visit_pairs([&](std::uint32_t i, std::uint32_t j) {
    if (i == 0 || (nested && std::pair<std::size_t, std::size_t>{i, j} > *nested)) return;
    if (inside(i, j)) nested = {i, j};
    if (inside(j, i)) nested = {j, i};
  });
  if (!nested) return {};
  const auto [inner, outer] = *nested;
  return failure(ErrorCode::bad_input, fmt::format("{}: it lies inside {}, at {} mm", loop_name(inner),
                                                   loop_name(outer), place(*loop_begin(region, inner))));
}

/// No arc is cut into more chords, so that they can be counted.
constexpr double kMostChordsOfArc = 1e12;

/// The points of an arc's chords between its ends, as grid_region_of_curves states them.
class ArcChords {
 public:
  ArcChords(const Edge& arc, ChordSide side, double tolerance)
      : arc_(arc), outside_((arc.kind == EdgeKind::arc_ccw) == (side == ChordSide::grow)) {
    const double from = norm(arc.from - arc.centre), to = norm(arc.to - arc.centre);
    radius_ = outside_ ? std::max(from, to) + kMargin : std::max(0.0, std::min(from, to) - kMargin);
    // The sagitta of half an angle h is r (1 / cos h - 1) outside and r (1 - cos h) inside.
    const double room = tolerance - std::abs(from - to) - kMargin;
    const double most = std::max(from, to);
    const double sine_half = std::sqrt(std::min(0.25, std::max(room, kMargin) / (3.0 * most)));
    const double sweep = arc_sweep(arc);
    const double count = std::ceil(sweep / (4.0 * sine_half));
    const double pieces = std::max({std::ceil(sweep / 1.6), arc.from == arc.to ? 3.0 : 1.0, count});
    pieces_ = static_cast<std::size_t>(std::min(kMostChordsOfArc, pieces));
    step_ = (arc.kind == EdgeKind::arc_ccw ? sweep : -sweep) / static_cast<double>(pieces_);
  }
  [[nodiscard]] std::size_t count() const noexcept { return outside_ ? pieces_ : pieces_ - 1; }
  [[nodiscard]] Point operator[](std::size_t i) const noexcept {
    const double angle =
        outside_ ? (static_cast<double>(i) + 0.5) * step_ : static_cast<double>(i + 1) * step_;
    const Point out = arc_.from - arc_.centre;
    const SinCos turn = sincos(angle);
    return at_radius({turn.cosine * out.x - turn.sine * out.y, turn.sine * out.x + turn.cosine * out.y},
                     outside_ ? radius_ / sincos(step_ / 2).cosine : radius_);
  }
  /// Returns the point at which an end that is not on the circle of the chords is joined to it, straight
  /// along its direction, because the arc may run on the other end's radius from there on. There is one only
  /// where the radii differ by more than the margin.
  [[nodiscard]] std::optional<Point> join(Point end) const noexcept {
    const Point out = end - arc_.centre;
    if (std::abs(norm(out) - radius_) <= 2 * kMargin) return std::nullopt;
    return at_radius(out, radius_);
  }

 private:
  /// Pays for rounding to the grid, for thinning and for rounding the turned vertex, with 2 steps left.
  static constexpr double kMargin = 8 * kGridStep;
  [[nodiscard]] Point at_radius(Point out, double radius) const noexcept {
    return arc_.centre + (radius / norm(out)) * out;
  }
  const Edge& arc_;
  bool outside_;
  double radius_ = 0, step_ = 0;
  std::size_t pieces_ = 1;
};

Result<Loop> grid_loop(const Contour& contour, std::size_t index, ChordSide side, double tolerance) {
  Loop loop;
  const auto add = [&](Point p) {
    if (!fits_grid(p.x) || !fits_grid(p.y)) return false;
    loop.push_back({grid_from_mm(p.x), grid_from_mm(p.y)});
    return true;
  };
  for (std::size_t e = 0; e < contour.size(); ++e) {
    bool fits = add(contour[e].from);
    if (contour[e].kind != EdgeKind::line && fits) {
      const ArcChords chords(contour[e], side, tolerance);
      if (const auto join = chords.join(contour[e].from)) fits = add(*join);
      for (std::size_t i = 0; i < chords.count() && fits; ++i) fits = add(chords[i]);
      if (const auto join = chords.join(contour[e].to); join && fits) fits = add(*join);
    }
    if (!fits)
      return failure(
          ErrorCode::bad_input,
          fmt::format("{}: edge {} from ({}, {}) reaches further from the origin than {} mm; check the units",
                      loop_name(index), e, contour[e].from.x, contour[e].from.y, mm_from_grid(kGridLimit)));
  }
  return loop;
}

}  // namespace

Result<GridRegion> make_grid_region(std::vector<Loop> loops) {
  if (loops.empty()) return failure(ErrorCode::bad_input, "outline: it has no points");
  GridRegion region;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    Loop& loop = loops[l];
    LEKALO_CHECK(check_reach(loop, l));
    thin(loop);
    if (loop.size() < 3)
      return failure(ErrorCode::bad_input, fmt::format("{}: it has {} different points; an area needs three",
                                                       loop_name(l), loop.size()));
    const Int128 area = twice_area(loop.data(), loop.size());
    if (area == 0) return failure(ErrorCode::bad_input, fmt::format("{}: its area is 0", loop_name(l)));
    if ((area > 0) != (l == 0)) std::reverse(loop.begin() + 1, loop.end());
    region.points.insert(region.points.end(), loop.begin(), loop.end());
    region.loop_starts.push_back(static_cast<std::uint32_t>(region.points.size()));
    loop = Loop();
  }
  LEKALO_CHECK(check_meetings(region));
  LEKALO_CHECK(check_nesting(region));
  return region;
}

std::size_t points_of_curves(const Region& region, ChordSide side, double tolerance) {
  std::size_t points = 0;
  for (std::size_t l = 0; l <= region.holes.size(); ++l)
    for (const Edge& edge : l == 0 ? region.outer : region.holes[l - 1]) {
      ++points;
      if (edge.kind == EdgeKind::line) continue;
      const ArcChords chords(edge, side, tolerance);
      points += chords.count();
      for (const Point end : {edge.from, edge.to}) points += chords.join(end) ? 1 : 0;
    }
  return points;
}

Result<GridRegion> grid_region_of_curves(const Region& region, ChordSide side, double tolerance,
                                         std::size_t most_points) {
  if (!(tolerance >= 0x1p-16))
    return failure(
        ErrorCode::bad_input,
        fmt::format("a chord tolerance of {} mm is below {} mm, 16 steps of the grid", tolerance, 0x1p-16));
  if (const std::size_t points = points_of_curves(region, side, tolerance); points > most_points)
    return failure(ErrorCode::bad_input,
                   fmt::format("{} points with chords within {} mm; at most {} are taken: a larger tolerance "
                               "needs fewer",
                               points, tolerance, most_points));
  std::vector<Loop> loops;
  for (std::size_t l = 0; l <= region.holes.size(); ++l) {
    LEKALO_TRY(auto loop, grid_loop(l == 0 ? region.outer : region.holes[l - 1], l, side, tolerance));
    loops.push_back(std::move(loop));
  }
  return make_grid_region(std::move(loops));
}

GridRegion rectangle(const GridBox& box) {
  return {{box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}}, {0, 4}};
}

Region region_of_lines(const GridRegion& region) {
  Region lines;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    Contour& contour = l == 0 ? lines.outer : lines.holes.emplace_back();
    const std::uint32_t begin = region.loop_starts[l], end = region.loop_starts[l + 1];
    for (std::uint32_t i = begin; i < end; ++i)
      contour.push_back({EdgeKind::line,
                         mm_from_grid(region.points[i]),
                         mm_from_grid(region.points[i + 1 == end ? begin : i + 1]),
                         {}});
  }
  return lines;
}

GridBox bounds(const GridRegion& region) noexcept {
  return region.points.empty() ? GridBox{} : bounds_of(region.points.data(), region.points.size());
}

Int128 twice_area(const GridRegion& region) noexcept {
  Int128 sum = 0;
  for (std::size_t l = 0; l < region.loops(); ++l)
    sum += twice_area(loop_begin(region, l), loop_size(region, l));
  return sum;
}

double area_mm2(const GridRegion& region) noexcept {
  return static_cast<double>(twice_area(region)) * (0.5 * kGridStep * kGridStep);
}

GridRegion turned(const GridRegion& region, GridRotation rotation, bool mirrored) {
  GridRegion result;
  result.loop_starts = region.loop_starts;
  result.points.reserve(region.points.size());
  for (const GridPoint p : region.points) result.points.push_back(turned(p, rotation, mirrored));
  if (mirrored)
    for (std::size_t l = 0; l < result.loops(); ++l)
      std::reverse(result.points.begin() + result.loop_starts[l] + 1,
                   result.points.begin() + result.loop_starts[l + 1]);
  return result;
}

GridRegion moved(GridRegion region, GridPoint by) noexcept {
  for (GridPoint& p : region.points) p = p + by;
  return region;
}

PointLocation locate_point(const GridRegion& region, GridPoint p) noexcept {
  PointLocation location = PointLocation::outside;
  for (std::size_t l = 0; l < region.loops(); ++l) {
    const PointLocation in_loop = locate_in_loop(loop_begin(region, l), loop_size(region, l), p);
    if (in_loop == PointLocation::boundary) return in_loop;
    if (l == 0) {
      if (in_loop == PointLocation::outside) return in_loop;
      location = PointLocation::inside;
    } else if (in_loop == PointLocation::inside) {
      return PointLocation::outside;
    }
  }
  return location;
}

}  // namespace lekalo::geom

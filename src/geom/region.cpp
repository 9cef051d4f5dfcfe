#include "lekalo/geom/region.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/arc_ends.hpp"
#include "lekalo/geom/chain.hpp"
#include "lekalo/geom/double_double.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/same_outline.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::geom {

namespace {

constexpr double kUnitRoundoff = 0x1p-53;
/// An arc's sweep is off by direction_angle's 1e-15 and by the rounding of the dot and cross product before
/// it.
constexpr double kSweepError = 4e-15;

bool is_arc(const Edge& edge) { return edge.kind != EdgeKind::line; }

/// An arc as the counter-clockwise turn about the centre that covers the same curve.
struct CcwArc {
  Point centre, from, to;

  explicit CcwArc(const Edge& arc)
      : centre(arc.centre),
        from(arc.kind == EdgeKind::arc_ccw ? arc.from : arc.to),
        to(arc.kind == EdgeKind::arc_ccw ? arc.to : arc.from) {}

  [[nodiscard]] bool full() const { return from == to; }
  /// Says whether the arc turns by more than a half; decided exactly.
  [[nodiscard]] bool beyond_half() const { return full() || orientation(centre, from, to) < 0; }
  /// Says whether the arc reaches the direction of `axis`, a unit vector along x or y; decided exactly.
  [[nodiscard]] bool reaches(Point axis) const {
    const Point origin;
    const int from_side = turn(centre, from, origin, axis), to_side = turn(origin, axis, centre, to);
    // One product of each dot is 0 and the other is a rounded difference, which keeps its sign.
    const bool at_from = from_side == 0 && dot(from - centre, axis) > 0;
    const bool at_to = to_side == 0 && dot(to - centre, axis) > 0;
    if (full() || at_from || at_to) return true;
    return beyond_half() ? from_side > 0 || to_side > 0 : from_side > 0 && to_side > 0;
  }
};

double sweep_of(const CcwArc& t) {
  if (t.full()) return 2 * kPi;
  const Point from = t.from - t.centre, to = t.to - t.centre;
  const double angle = direction_angle(dot(from, to), cross(from, to));
  // The rounded cross product may miss the sign of a turn close to nothing, a half or a whole. The exact one
  // says which side it is on.
  const double size = std::abs(angle);
  return t.beyond_half() ? 2 * kPi - size : size;
}

/// Returns x - sin(x) for x in [0, 2 pi] without losing the small difference of two near numbers.
double angle_minus_sine(double x) {
  if (x > 1) return x - sincos(x).sine;
  // The series is x^3 / 3! - x^5 / 5! + ..., to x^17: the first term left out is below u of the first one for
  // x <= 1.
  double sum = 0;
  for (int k = 17; k >= 3; k -= 2) sum = x * x / (k * (k - 1)) * (1 - sum);
  return sum * x;
}

struct BoundedArea {
  double value = 0, error = 0;
};

/// Returns the area between an arc's chord and its curve, including the steps between the two radii and their
/// mean.
BoundedArea area_beside_chord(const Edge& arc) {
  const CcwArc t(arc);
  const double r = arc_radius(arc), sweep = sweep_of(t);
  const double step = norm(t.from - t.centre) - norm(t.to - t.centre);
  // The second term is there because r^2 - r_from r_to == (r_from - r_to)^2 / 4.
  const double value = (r * r * angle_minus_sine(sweep) + step * step * sincos(sweep).sine / 4) / 2;
  // An error of kSweepError in the sweep changes the area by r^2 (1 - cos sweep) / 2 times as much.
  const double by_sweep = kSweepError * r * r * std::min(1.0, sweep * sweep / 4);
  return {arc.kind == EdgeKind::arc_ccw ? value : -value, by_sweep + 8 * kUnitRoundoff * std::abs(value)};
}

BoundedArea area_with_error(const Contour& contour) {
  DoubleDouble doubled;
  double largest = 0, arcs_error = 0;
  for (const Edge& edge : contour) {
    doubled = doubled + two_product(edge.from.x, edge.to.y) - two_product(edge.from.y, edge.to.x);
    largest = std::max({largest, std::abs(edge.from.x), std::abs(edge.from.y)});
    if (!is_arc(edge)) continue;
    const BoundedArea beside = area_beside_chord(edge);
    doubled = doubled + DoubleDouble{2 * beside.value};
    arcs_error += beside.error;
  }
  const double value = (doubled.hi + doubled.lo) / 2;
  const double count = static_cast<double>(contour.size());
  return {value, 2 * kUnitRoundoff * std::abs(value) + count * 0x1p-98 * largest * largest + arcs_error};
}

std::string text(Point p) { return fmt::format("({}, {})", p.x, p.y); }

bool is_exact(const Edge& edge) {
  return geom::is_exact(edge.from) && geom::is_exact(edge.to) &&
         (!is_arc(edge) || geom::is_exact(edge.centre));
}

std::optional<std::string> arc_fault(const Edge& arc, bool alone) {
  const double from = norm(arc.from - arc.centre), to = norm(arc.to - arc.centre);
  if (arc.from == arc.centre || arc.to == arc.centre) {
    return fmt::format("an end of the arc lies at its centre {}", text(arc.centre));
  }
  const double allowed = allowed_radius_difference(arc);
  if (!(std::abs(from - to) <= allowed)) {
    return fmt::format(
        "the arc's ends {} and {} are {} and {} mm from its centre {}; they may differ by {:.3g} mm",
        text(arc.from), text(arc.to), from, to, text(arc.centre), allowed);
  }
  if (arc.from == arc.to) {
    if (alone) return std::nullopt;
    return fmt::format("the arc begins and ends at {}: a full circle must be the only edge of its contour",
                       text(arc.from));
  }
  const bool same_side = dot(arc.from - arc.centre, arc.to - arc.centre) > 0;
  if (same_side && orientation(arc.centre, arc.from, arc.to) == 0) {
    return fmt::format(
        "the arc's ends {} and {} lie in one direction from its centre {}: a full circle needs equal ends",
        text(arc.from), text(arc.to), text(arc.centre));
  }
  return std::nullopt;
}

std::optional<std::string> edge_fault(const Contour& contour, std::size_t i, bool closed = true) {
  const Edge& edge = contour[i];
  if (!is_exact(edge)) {
    return fmt::format("a coordinate of {} to {} is not 0 or a number of magnitude {:.3g} to {:.3g}",
                       text(edge.from), text(edge.to), kSmallestExactCoordinate, kLargestExactCoordinate);
  }
  const std::size_t before = i == 0 ? contour.size() - 1 : i - 1;
  const Point joint = contour[before].to;
  if (edge.from != joint && (closed || i > 0)) {
    return fmt::format("it begins at {}, but edge {} ends at {}, {:.3g} mm away", text(edge.from), before,
                       text(joint), norm(edge.from - joint));
  }
  if (is_arc(edge)) return arc_fault(edge, contour.size() == 1);
  if (edge.from == edge.to) return fmt::format("the line at {} has no length", text(edge.from));
  return std::nullopt;
}

Result<Contour> normalised(Contour contour, bool counter_clockwise, const std::string& name) {
  if (contour.empty()) return failure(ErrorCode::bad_input, name + " has no edges");
  for (std::size_t i = 0; i < contour.size(); ++i) {
    if (!is_arc(contour[i])) contour[i].centre = {};
    if (const auto fault = edge_fault(contour, i)) {
      return failure(ErrorCode::bad_input, fmt::format("{}, edge {}: {}", name, i, *fault));
    }
  }
  const BoundedArea found = area_with_error(contour);
  if (!(std::abs(found.value) > found.error)) {
    return failure(ErrorCode::bad_input, fmt::format("{} encloses no area ({:.3g} mm^2)", name, found.value));
  }
  return (found.value > 0) == counter_clockwise ? contour : reversed(contour);
}

}  // namespace

Result<Contour> make_chain(Contour edges) {
  if (edges.empty()) return failure(ErrorCode::bad_input, "there are no edges");
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (!is_arc(edges[i])) edges[i].centre = {};
    if (const auto fault = edge_fault(edges, i, false))
      return failure(ErrorCode::bad_input, fmt::format("edge {}: {}", i, *fault));
  }
  return edges;
}

double arc_radius(const Edge& arc) noexcept {
  return (norm(arc.from - arc.centre) + norm(arc.to - arc.centre)) / 2;
}

double arc_sweep(const Edge& arc) noexcept { return sweep_of(CcwArc(arc)); }

Result<Region> make_region(Contour outer, std::vector<Contour> holes) {
  Region region;
  LEKALO_TRY(region.outer, normalised(std::move(outer), true, "outer contour"));
  for (std::size_t i = 0; i < holes.size(); ++i) {
    LEKALO_TRY(auto hole, normalised(std::move(holes[i]), false, fmt::format("hole {}", i)));
    region.holes.push_back(std::move(hole));
  }
  return region;
}

double signed_area(const Contour& contour) noexcept { return area_with_error(contour).value; }

std::size_t edges_in(const std::vector<Region>& regions) noexcept {
  std::size_t edges = 0;
  for (const Region& region : regions) {
    edges += region.outer.size();
    for (const Contour& hole : region.holes) edges += hole.size();
  }
  return edges;
}

double area(const Region& region) noexcept {
  double sum = signed_area(region.outer);
  for (const Contour& hole : region.holes) sum += signed_area(hole);
  return sum;
}

double area(const std::vector<Region>& regions) noexcept {
  double sum = 0;
  for (const Region& region : regions) sum += area(region);
  return sum;
}

Box bounds(const Contour& contour) noexcept {
  if (contour.empty()) return {};
  Box box{contour[0].from, contour[0].from};
  const auto include = [&box](Point p) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  };
  for (const Edge& edge : contour) {
    include(edge.from);
    if (!is_arc(edge)) continue;
    const CcwArc arc(edge);
    const double r = arc_radius(edge);
    for (const Point end : {edge.from - edge.centre, edge.to - edge.centre}) {
      // The curve at the mean radius may stand further out than the end that is given.
      if (norm(end) < r) include(edge.centre + (r / norm(end)) * end);
    }
    for (const Point axis : {Point{1, 0}, Point{0, 1}, Point{-1, 0}, Point{0, -1}}) {
      if (arc.reaches(axis)) include(edge.centre + r * axis);
    }
  }
  return box;
}

namespace {

/// Returns the edges, each in one of its two directions, in one order.
std::vector<Edge> sorted_edges(const std::vector<Region>& regions) {
  const auto key = [](const Edge& e) {
    return std::tuple(e.kind, e.from.x, e.from.y, e.to.x, e.to.y, e.centre.x, e.centre.y);
  };
  std::vector<Edge> edges;
  const auto add = [&](const Contour& contour) {
    for (const Edge& edge : contour) {
      const bool back = edge.kind == EdgeKind::line
                            ? std::tie(edge.to.x, edge.to.y) < std::tie(edge.from.x, edge.from.y)
                            : edge.kind == EdgeKind::arc_cw;
      edges.push_back(back ? reversed(edge) : edge);
    }
  };
  for (const Region& region : regions) {
    add(region.outer);
    for (const Contour& hole : region.holes) add(hole);
  }
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  return edges;
}

}  // namespace

bool same_outline(const std::vector<Region>& a, const std::vector<Region>& b) {
  return edges_in(a) == edges_in(b) && sorted_edges(a) == sorted_edges(b);
}

Edge reversed(Edge edge) noexcept {
  std::swap(edge.from, edge.to);
  if (edge.kind != EdgeKind::line)
    edge.kind = edge.kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
  return edge;
}

Contour reversed(const Contour& contour) {
  Contour result(contour.size());
  std::transform(contour.rbegin(), contour.rend(), result.begin(), [](const Edge& e) { return reversed(e); });
  return result;
}

}  // namespace lekalo::geom

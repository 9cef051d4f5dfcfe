#include "nc/knife/knife_path.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/geom/trig.hpp"

namespace lekalo::nc {
namespace detail {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

/// The longest arc, in radians, that is written as one chord.
constexpr double kLongestKnifeChord = 0.5;

/// Returns the direction of travel at a place on the edge.
Point knife_direction(const Edge& edge, Point at) {
  const Point along = edge.kind == EdgeKind::line      ? edge.to - edge.from
                      : edge.kind == EdgeKind::arc_ccw ? geom::perpendicular(at - edge.centre)
                                                       : -geom::perpendicular(at - edge.centre);
  return (1 / geom::norm(along)) * along;
}

/// Returns the angle from a counter-clockwise to b, in [-pi, pi].
double knife_turn(Point a, Point b) { return geom::direction_angle(geom::dot(a, b), geom::cross(a, b)); }

double knife_length(const Edge& edge) {
  return edge.kind == EdgeKind::line ? geom::norm(edge.to - edge.from)
                                     : geom::arc_radius(edge) * geom::arc_sweep(edge);
}

class StrokeMaker {
 public:
  StrokeMaker(const geom::Contour& contour, const KnifeOptions& options)
      : contour_(contour), options_(options) {}

  std::vector<KnifeStroke> strokes(Point heading) && {
    const std::size_t n = contour_.size();
    const Point begin = contour_.front().from, first = knife_direction(contour_.front(), begin);
    strokes_.emplace_back();
    if (drags()) {
      put(begin, heading, 0);
      swivel(begin, heading, knife_turn(heading, first), 0);
    }
    put(begin, first, 0);
    for (std::size_t k = 0; k < n; ++k) {
      along(k, 1);
      if (k + 1 < n) corner(k);
    }
    overcut();
    return std::move(strokes_);
  }

 private:
  [[nodiscard]] bool drags() const { return options_.kind == KnifeKind::drag; }
  [[nodiscard]] const Edge& after(std::size_t k) const { return contour_[(k + 1) % contour_.size()]; }

  /// How far the direction turns at the end of an edge.
  [[nodiscard]] double turn_after(std::size_t k) const {
    const Point at = contour_[k].to;
    return knife_turn(knife_direction(contour_[k], at), knife_direction(after(k), at));
  }

  void put(Point tip, Point direction, std::size_t edge) {
    const Point axis = tip + options_.offset_mm * direction;
    const double step = options_.step_mm;
    const Point written{step * std::round(axis.x / step), step * std::round(axis.y / step)};
    KnifeStroke& stroke = strokes_.back();
    if (!stroke.points.empty() && stroke.points.back() == written) return;
    stroke.points.push_back(written);
    stroke.edges.push_back(edge);
  }

  /// Returns the longest angle of a chord of an arc of the axis.
  [[nodiscard]] double chord_angle(double radius) const {
    return std::min(kLongestKnifeChord, std::sqrt(8 * options_.chord_tolerance_mm / radius));
  }

  /// Turns the axis about the tip; the place after the turn is not put.
  void swivel(Point tip, Point from, double turn, std::size_t edge) {
    const auto pieces = static_cast<int>(std::ceil(std::abs(turn) / chord_angle(options_.offset_mm)));
    const double begin = geom::direction_angle(from.x, from.y);
    for (int k = 1; k < pieces; ++k) {
      const auto [sine, cosine] = geom::sincos(begin + turn * k / pieces);
      put(tip, {cosine, sine}, edge);
    }
  }

  /// Goes on to the edge behind edge k.
  void corner(std::size_t k) {
    const Point at = contour_[k].to;
    const double turn = turn_after(k);
    const std::size_t next = (k + 1) % contour_.size();
    if (std::abs(turn) > options_.turn_above) {
      if (drags())
        swivel(at, knife_direction(contour_[k], at), turn, next);
      else
        strokes_.emplace_back();
    }
    put(at, knife_direction(contour_[next], at), next);
  }

  /// Follows an edge up to a share of it.
  void along(std::size_t k, double share) {
    const Edge& edge = contour_[k];
    if (edge.kind == EdgeKind::line) {
      const Point end = share == 1 ? edge.to : edge.from + share * (edge.to - edge.from);
      return put(end, knife_direction(edge, edge.to), k);
    }
    const double radius = geom::arc_radius(edge), sweep = share * geom::arc_sweep(edge),
                 reach = std::sqrt(radius * radius + options_.offset_mm * options_.offset_mm);
    const auto pieces = static_cast<int>(std::ceil(sweep / chord_angle(reach)));
    const Point out = edge.from - edge.centre;
    const double begin = geom::direction_angle(out.x, out.y);
    for (int i = 1; i <= pieces; ++i) {
      const double angle = sweep * i / pieces;
      const auto [sine, cosine] =
          geom::sincos(edge.kind == EdgeKind::arc_ccw ? begin + angle : begin - angle);
      const Point at = i == pieces && share == 1 ? edge.to : edge.centre + radius * Point{cosine, sine};
      put(at, knife_direction(edge, at), k);
    }
  }

  void overcut() {
    double left = options_.overcut_mm;
    const std::size_t n = contour_.size();
    for (std::size_t k = 0; k < n && left > 0; ++k) {
      const std::size_t before = k == 0 ? n - 1 : k - 1;
      if (!drags() && std::abs(turn_after(before)) > options_.turn_above) return;
      corner(before);
      const double length = knife_length(contour_[k]);
      along(k, std::min(1.0, left / length));
      left -= length;
    }
  }

  const geom::Contour& contour_;
  const KnifeOptions& options_;
  std::vector<KnifeStroke> strokes_;
};

}  // namespace

std::vector<KnifeStroke> knife_strokes(const geom::Contour& contour, const KnifeOptions& options,
                                       geom::Point heading) {
  return StrokeMaker(contour, options).strokes(heading);
}

}  // namespace detail

KnifeCut Knife::cut(const geom::Contour& contour) {
  KnifeCut made;
  if (options_.kind == KnifeKind::tangential) {
    // Numbers are rounded in x and in y.
    made.off_mm = 0.7072 * options_.step_mm;
    for (const geom::Edge& edge : contour)
      if (edge.kind != geom::EdgeKind::line) {
        made.off_mm += options_.chord_tolerance_mm;
        break;
      }
  }
  for (detail::KnifeStroke& stroke : detail::knife_strokes(contour, options_, heading_)) {
    if (options_.kind == KnifeKind::drag)
      made.off_mm = std::max(made.off_mm, detail::farthest_tip(contour, stroke, options_, heading_));
    made.strokes.push_back(std::move(stroke.points));
  }
  return made;
}

}  // namespace lekalo::nc

#include <algorithm>
#include <cmath>

#include "lekalo/geom/edge_distance.hpp"
#include "nc/knife/knife_path.hpp"

namespace lekalo::nc::detail {
namespace {

using geom::Point;

/// Measures how far a tip is from the edges of a contour around the one that it should be on.
class TipMeasure {
 public:
  TipMeasure(const geom::Contour& contour, double around) : around_(around) {
    curves_.reserve(contour.size());
    for (const geom::Edge& edge : contour) curves_.push_back(geom::make_curve(edge));
  }

  [[nodiscard]] double off(Point tip, std::size_t edge) const {
    const std::size_t n = curves_.size();
    double least = to_edge(tip, edge);
    for (const std::size_t step : {std::size_t{1}, n - 1}) {
      double gone = 0;
      std::size_t i = edge;
      // Edges may be shorter than what the tip is off by.
      for (std::size_t k = 1; k < n && gone <= around_; ++k) {
        i = (i + step) % n;
        least = std::min(least, to_edge(tip, i));
        gone += geom::norm(curves_[i].edge.to - curves_[i].edge.from);
      }
    }
    return least;
  }

 private:
  [[nodiscard]] double to_edge(Point tip, std::size_t i) const {
    return geom::norm(geom::nearest_on(curves_[i], tip) - tip);
  }

  double around_;
  std::vector<geom::Curve> curves_;
};

}  // namespace

double farthest_tip(const geom::Contour& contour, const KnifeStroke& stroke, const KnifeOptions& options,
                    Point& heading) {
  const double offset = options.offset_mm;
  const TipMeasure measure(contour, 4 * options.tolerance_mm);
  // The tip is looked at so often, where the blade turns, that it is nowhere farther by more than half a
  // step.
  const double step = std::min(offset, options.tolerance_mm) / 8;
  double farthest = measure.off(stroke.points.front() - offset * heading, stroke.edges.front());
  for (std::size_t i = 1; i < stroke.points.size(); ++i) {
    const Point from = stroke.points[i - 1], way = stroke.points[i] - from;
    const double length = geom::norm(way);
    const Point along = (1 / length) * way, left = geom::perpendicular(along);
    // The tip moves along the blade alone. So the tangent of half the angle between blade and motion shrinks
    // by a factor e over each length of the offset.
    constexpr double kOpposite = 1e8;
    const double cosine = geom::dot(heading, along), sine = geom::dot(heading, left);
    double half = std::clamp(sine / std::max(1 + cosine, 1e-16), -kOpposite, kOpposite);
    for (double gone = 0; gone < length;) {
      const bool runs_straight = std::abs(half) * offset < options.tolerance_mm / 100;
      const double by = std::min(length - gone, runs_straight ? std::max(step, length / 2) : step);
      gone = by == length - gone ? length : gone + by;
      half *= std::exp(-by / offset);
      const double square = half * half;
      heading = ((1 - square) / (1 + square)) * along + (2 * half / (1 + square)) * left;
      farthest = std::max(farthest, measure.off(from + gone * along - offset * heading, stroke.edges[i]));
    }
  }
  return farthest + step / 2;
}

}  // namespace lekalo::nc::detail

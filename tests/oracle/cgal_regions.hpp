#pragma once

// Regions as CGAL's general polygons of line and circle segments, exact. CGAL's Boolean set operations are
// under the GPL: for tests and benchmarks alone, nothing that is shipped links them.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/General_polygon_set_2.h>
#include <CGAL/Gps_circle_segment_traits_2.h>

#include <cmath>
#include <iterator>
#include <list>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::oracle {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Traits = CGAL::Gps_circle_segment_traits_2<Kernel>;
using PolygonSet = CGAL::General_polygon_set_2<Traits>;
using Polygon = Traits::General_polygon_2;
using PolygonWithHoles = Traits::General_polygon_with_holes_2;
using ExactCurve = Traits::X_monotone_curve_2;

/// \pre arcs whose ends lie exactly on one circle about their centre: coordinates on a grid
inline Polygon exact_polygon(const geom::Contour& contour) {
  Polygon polygon;
  for (const geom::Edge& e : contour) {
    const Kernel::Point_2 from(e.from.x, e.from.y), to(e.to.x, e.to.y);
    if (e.kind == geom::EdgeKind::line) {
      polygon.push_back(ExactCurve(from, to));
      continue;
    }
    const Kernel::Point_2 centre(e.centre.x, e.centre.y);
    const auto turn = e.kind == geom::EdgeKind::arc_ccw ? CGAL::COUNTERCLOCKWISE : CGAL::CLOCKWISE;
    const Kernel::Circle_2 circle(centre, CGAL::squared_distance(centre, from), turn);
    const Traits::Curve_2 curve =
        e.from == e.to
            ? Traits::Curve_2(circle)
            : Traits::Curve_2(circle, Traits::Point_2(from.x(), from.y()), Traits::Point_2(to.x(), to.y()));
    std::vector<boost::variant<Traits::Point_2, ExactCurve>> parts;
    Traits().make_x_monotone_2_object()(curve, std::back_inserter(parts));
    for (const auto& part : parts) polygon.push_back(boost::get<ExactCurve>(part));
  }
  return polygon;
}

inline PolygonSet exact_set(const std::vector<geom::Region>& pieces) {
  PolygonSet set;
  for (const geom::Region& r : pieces) {
    std::vector<Polygon> holes;
    for (const geom::Contour& h : r.holes) holes.push_back(exact_polygon(h));
    set.join(PolygonWithHoles(exact_polygon(r.outer), holes.begin(), holes.end()));
  }
  return set;
}

inline double area_of(const Polygon& polygon) {
  double doubled = 0;
  for (auto c = polygon.curves_begin(); c != polygon.curves_end(); ++c) {
    const double x0 = CGAL::to_double(c->source().x()), y0 = CGAL::to_double(c->source().y()),
                 x1 = CGAL::to_double(c->target().x()), y1 = CGAL::to_double(c->target().y());
    doubled += x0 * y1 - x1 * y0;
    if (c->is_linear()) continue;
    const auto circle = c->supporting_circle();
    const double r2 = CGAL::to_double(circle.squared_radius()), half = 0.5 * std::hypot(x1 - x0, y1 - y0);
    // X-monotone: half a turn at most.
    const double sweep = 2 * std::asin(std::min(1.0, half / std::sqrt(r2)));
    const double beside = r2 * (sweep - std::sin(sweep));
    doubled += c->orientation() == CGAL::COUNTERCLOCKWISE ? beside : -beside;
  }
  return 0.5 * doubled;
}

inline double area_of(const PolygonSet& set) {
  std::list<PolygonWithHoles> pieces;
  set.polygons_with_holes(std::back_inserter(pieces));
  double sum = 0;
  for (const PolygonWithHoles& p : pieces) {
    sum += area_of(p.outer_boundary());
    for (auto h = p.holes_begin(); h != p.holes_end(); ++h) sum += area_of(*h);
  }
  return sum;
}

}  // namespace lekalo::oracle

#include "load.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/trig.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;

constexpr int kLooks = 18;  // directions over the leading half of the rim
constexpr double kDegreesApart = 180.0 / kLooks;

/// The degrees of the rim's leading half that are farther than the radius from what is cut.
double degrees_in_material(Point at, Point heading, bool back, const geom::RegionIndex& before, double r,
                           std::uint32_t& likely) {
  // The look goes from the side where the material is, over straight ahead, to the other side.
  const Point side = back ? perpendicular(heading) : -perpendicular(heading);
  double degrees = 0, last = 0;
  for (int i = 0; i <= kLooks; ++i) {
    const auto [sine, cosine] = geom::sincos(kPi * i / kLooks);
    const Point rim = at + r * (cosine * side + sine * heading);
    const auto near = before.nearest(rim, likely);
    likely = near.edge;
    const double beyond = near.distance - r;
    if (i > 0) {
      if (beyond > 0 && last > 0) degrees += kDegreesApart;
      if ((beyond > 0) != (last > 0))
        degrees += kDegreesApart * std::max(beyond, last) / (std::max(beyond, last) - std::min(beyond, last));
      // Nothing is met beyond the far end of the arc.
      if (last > 0 && !(beyond > 0)) break;
    }
    last = beyond;
  }
  return degrees;
}

}  // namespace

Load load_of(const std::vector<Edge>& pass, bool back, const geom::RegionIndex& before, double r, double held,
             double spacing) {
  Load load;
  double last = 0;
  std::uint32_t likely = 0;
  for (const Edge& edge : pass) {
    const double length = length_of(edge);
    const double pieces = std::max(1.0, std::ceil(length / spacing));
    for (double i = 0; i < pieces; ++i) {
      const Point at = place_at(edge, (i + 0.5) / pieces);
      const double degrees = degrees_in_material(at, heading_at(edge, at), back, before, r, likely);
      load.length += length / pieces;
      if (degrees > held) load.beyond += length / pieces;
      load.largest = std::max(load.largest, std::min(degrees, last));
      last = degrees;
    }
  }
  return load;
}

}  // namespace lekalo::mill

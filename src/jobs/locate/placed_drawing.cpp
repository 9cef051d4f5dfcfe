#include "placed_drawing.hpp"

#include <utility>

#include "lekalo/geom/pose.hpp"
#include "lekalo/io/drawing/written_drawing.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/svg/svg.hpp"

namespace lekalo::jobs {
namespace {

geom::Contour placed(const geom::Contour& contour, const geom::BlankFromPart& pose) {
  geom::Contour out;
  for (const geom::Edge& edge : contour) {
    geom::Edge e{edge.kind, pose(edge.from), {}, {}};
    if (edge.kind != geom::EdgeKind::line) {
      e.centre = pose(edge.centre);
      if (pose.mirrored)
        e.kind = edge.kind == geom::EdgeKind::arc_ccw ? geom::EdgeKind::arc_cw : geom::EdgeKind::arc_ccw;
    }
    out.push_back(e);
  }
  for (std::size_t k = 0; k < out.size(); ++k) out[k].to = out[(k + 1) % out.size()].from;
  return out;
}

}  // namespace

Result<std::string> placed_drawing(DrawingFormat format, const std::vector<geom::Region>& part,
                                   const std::vector<geom::Region>& blank, const locate::Placement& placement,
                                   bool mirrored) {
  const auto pose = geom::BlankFromPart::from_angle(placement.theta, {placement.x, placement.y}, mirrored);
  std::vector<io::LayeredRegion> drawn;
  for (const geom::Region& region : blank) drawn.push_back({region, "BLANK", {}});
  for (const geom::Region& region : part) {
    std::vector<geom::Contour> holes;
    for (const geom::Contour& hole : region.holes) holes.push_back(placed(hole, pose));
    LEKALO_TRY(geom::Region moved, geom::make_region(placed(region.outer, pose), std::move(holes)));
    drawn.push_back({std::move(moved), "PART", {}});
  }
  return format == DrawingFormat::svg ? io::svg_drawing(drawn) : io::dxf_drawing(drawn);
}

}  // namespace lekalo::jobs

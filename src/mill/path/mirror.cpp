#include "mirror.hpp"

#include <utility>

namespace lekalo::mill {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

namespace {

Point mirrored(Point p) { return {-p.x, p.y}; }

EdgeKind mirrored(EdgeKind kind) {
  return kind == EdgeKind::line ? kind : kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
}

geom::Contour mirrored(const geom::Contour& contour) {
  geom::Contour made;
  for (const Edge& e : contour)
    made.push_back({mirrored(e.kind), mirrored(e.from), mirrored(e.to), mirrored(e.centre)});
  return made;
}

}  // namespace

Result<std::vector<Region>> mirrored(const std::vector<Region>& regions) {
  std::vector<Region> made;
  for (const Region& region : regions) {
    std::vector<geom::Contour> holes;
    for (const geom::Contour& hole : region.holes) holes.push_back(mirrored(hole));
    LEKALO_TRY(auto other, geom::make_region(mirrored(region.outer), std::move(holes)));
    made.push_back(std::move(other));
  }
  return made;
}

PocketPath mirrored(PocketPath path) {
  for (PathMove& move : path.moves) {
    move.to = mirrored(move.to), move.centre = mirrored(move.centre);
    move.shape = mirrored(move.shape);
  }
  return path;
}

}  // namespace lekalo::mill

#include "pocket_input.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "lekalo/disk/files.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "shapes.hpp"

namespace lekalo::cli {
namespace {

using geom::EdgeKind;
using geom::Point;

bool listed(const std::vector<std::string>& layers, const std::string& label) {
  return std::find(layers.begin(), layers.end(), label) != layers.end();
}

Result<void> known(const Shape& shape, const std::vector<std::string>& layers, const std::string& path) {
  for (const std::string& layer : layers)
    if (!listed(shape.labels, layer))
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: no outline has an edge on the layer \"{}\"", path, layer));
  return {};
}

/// The same edge, in this direction or the other.
bool same(const geom::Edge& a, const geom::Edge& b) {
  const bool arcs = a.kind != EdgeKind::line;
  if (arcs != (b.kind != EdgeKind::line) || (arcs && !(a.centre == b.centre))) return false;
  return (a.kind == b.kind && a.from == b.from && a.to == b.to) ||
         ((!arcs || a.kind != b.kind) && a.from == b.to && a.to == b.from);
}

/// What lies straight out of an edge, so wide that the tool may stand on it.
Result<geom::Region> strip_beyond(const geom::Edge& edge, double width) {
  if (edge.kind == EdgeKind::line) {
    const Point way = edge.to - edge.from;
    const Point out = (-width / geom::norm(way)) * geom::perpendicular(way);
    return geom::make_region({{EdgeKind::line, edge.from, edge.from + out, {}},
                              {EdgeKind::line, edge.from + out, edge.to + out, {}},
                              {EdgeKind::line, edge.to + out, edge.to, {}},
                              {edge.kind, edge.to, edge.from, {}}});
  }
  // The material lies on the left: beyond a counter-clockwise arc is farther from its centre.
  const double radius = geom::arc_radius(edge);
  const double other = edge.kind == EdgeKind::arc_ccw ? radius + width : std::max(0.0, radius - width);
  const auto moved = [&](Point p) { return edge.centre + (other / radius) * (p - edge.centre); };
  geom::Edge back = edge;
  std::swap(back.from, back.to);
  back.kind = edge.kind == EdgeKind::arc_ccw ? EdgeKind::arc_cw : EdgeKind::arc_ccw;
  geom::Contour contour;
  if (other > 0) {
    contour = {{EdgeKind::line, edge.from, moved(edge.from), {}},
               {edge.kind, moved(edge.from), moved(edge.to), edge.centre},
               {EdgeKind::line, moved(edge.to), edge.to, {}},
               back};
  } else {
    contour = {
        {EdgeKind::line, edge.from, edge.centre, {}}, {EdgeKind::line, edge.centre, edge.to, {}}, back};
  }
  return geom::make_region(std::move(contour));
}

}  // namespace

Result<PocketInput> read_pocket_input(const PocketOptions& o) {
  Result<std::string> bytes = disk::read_file(o.pocket);
  if (!bytes) return tl::unexpected(bytes.error());
  ShapeOptions how = o.shape;
  if (!how.layers.empty()) {
    how.layers.insert(how.layers.end(), o.island_layers.begin(), o.island_layers.end());
    how.layers.insert(how.layers.end(), o.open_layers.begin(), o.open_layers.end());
  }
  Result<Shape> shape = read_shape(*bytes, o.pocket, how);
  if (!shape) return tl::unexpected(shape.error());
  for (const auto* layers : {&o.island_layers, &o.open_layers})
    if (Result<void> good = known(*shape, *layers, o.pocket); !good) return tl::unexpected(good.error());

  std::size_t edge = 0;
  std::vector<geom::Region> all = shape->regions;
  std::vector<geom::Edge> open;
  for (const geom::Region& region : shape->regions) {
    const auto look = [&](const geom::Contour& contour, bool outer) -> Result<void> {
      for (const geom::Edge& e : contour) {
        const std::string& layer = shape->labels[edge++];
        if (outer && listed(o.island_layers, layer))
          return failure(ErrorCode::bad_input,
                         fmt::format("{}: the island on layer \"{}\" at ({:.6g}, {:.6g}) lies in no pocket",
                                     o.pocket, layer, e.from.x, e.from.y));
        if (!listed(o.open_layers, layer) && std::none_of(shape->open.begin(), shape->open.end(),
                                                          [&](const geom::Edge& s) { return same(s, e); }))
          continue;
        open.push_back(e);
        Result<geom::Region> strip = strip_beyond(e, o.path.tool_diameter / 2 + o.path.stock_to_leave);
        if (!strip)
          return failure(strip.error().code,
                         fmt::format("{}: the open edge at ({:.6g}, {:.6g}): {}", o.pocket, e.from.x,
                                     e.from.y, strip.error().message));
        all.push_back(std::move(*strip));
      }
      return {};
    };
    if (Result<void> good = look(region.outer, true); !good) return tl::unexpected(good.error());
    for (const geom::Contour& hole : region.holes)
      if (Result<void> good = look(hole, false); !good) return tl::unexpected(good.error());
  }
  PocketInput input;
  input.bytes = std::move(*bytes);
  input.pockets = std::move(shape->regions);
  input.extended = input.pockets;
  input.notices = std::move(shape->notices);
  if (all.size() > input.pockets.size()) {
    Result<geom::BooleanResult> whole = geom::united(all);
    if (!whole) return failure(whole.error().code, fmt::format("{}: {}", o.pocket, whole.error().message));
    input.extended = std::move(whole->regions);
  }
  input.document = io::regions_json(input.pockets, open);
  return input;
}

}  // namespace lekalo::cli

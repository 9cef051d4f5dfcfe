#include "layout_outline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "io/shape/region_reader.hpp"
#include "io/shape/region_text.hpp"
#include "io/text/grid_decimal.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/io/layout/layout_json.hpp"

namespace lekalo::io::detail {
namespace {

using geom::GridPoint;
using geom::GridRegion;
using geom::Point;
using layout::Outline;

static_assert(limits::kLargestOutline == geom::mm_from_grid(geom::kGridLimit / 4),
              "make_grid_region takes no more");

bool has_arcs(const geom::Region& region) {
  const auto arcs = [](const geom::Contour& contour) {
    return std::any_of(contour.begin(), contour.end(),
                       [](const geom::Edge& edge) { return edge.kind != geom::EdgeKind::line; });
  };
  return arcs(region.outer) || std::any_of(region.holes.begin(), region.holes.end(), arcs);
}

double perimeter(const GridRegion& region) {
  double sum = 0;
  for (std::size_t l = 0; l < region.loops(); ++l)
    for (std::uint32_t i = region.loop_starts[l]; i < region.loop_starts[l + 1]; ++i) {
      const std::uint32_t next = i + 1 == region.loop_starts[l + 1] ? region.loop_starts[l] : i + 1;
      sum += geom::norm(geom::mm_from_grid(region.points[next] - region.points[i]));
    }
  return sum;
}

/// A polygon and a drawing that cannot be the same shape: somebody changed one of them alone. Areas and
/// extents; no proof that they are.
std::optional<std::string> difference(const GridRegion& polygon, const geom::Region& curves,
                                      double tolerance) {
  // The outlines may differ by twice what chords and the band of inconsistent arcs may do.
  const double off = 2 * (tolerance + 2 * geom::kArcConsistency);
  const double drawn = geom::area(curves), cut = geom::area_mm2(polygon);
  if (!(std::abs(drawn - cut) <= off * (perimeter(polygon) + 4 * off)))
    return fmt::format("the area of the polygon is {:.6g} mm2, that of the curves {:.6g} mm2", cut, drawn);
  const geom::GridBox box = geom::bounds(polygon);
  const geom::Box extent = geom::bounds(curves.outer);
  const Point low = geom::mm_from_grid(box.low) - extent.low,
              high = geom::mm_from_grid(box.high) - extent.high;
  const double worst = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y)});
  if (!(worst <= off)) return fmt::format("polygon and curves reach {:.6g} mm differently far", worst);
  return std::nullopt;
}

GridRegion read_polygon(JsonReader& reader, JsonValue value) {
  if (!reader.expect_object(value, {"outer", "holes"})) return {};
  std::vector<std::vector<GridPoint>> loops;
  std::size_t points = 0;
  if (const auto outer = reader.need(value, "outer", "the points of the outline"))
    loops.push_back(read_loop(reader, *outer, 1, points));
  if (const auto holes = value.find("holes"); holes && reader.expect_list(*holes, kMostOutlinePoints))
    for (const JsonValue hole : *holes) loops.push_back(read_loop(reader, hole, 1, points));
  if (!reader.ok()) return {};
  auto region = geom::make_grid_region(std::move(loops));
  if (!region) {
    reader.refuse(value, region.error());
    return {};
  }
  return *std::move(region);
}

std::optional<geom::Region> read_curves(JsonReader& reader, JsonValue value) {
  if (!reader.expect_object(value, {"outer", "holes", "islands"})) return std::nullopt;
  auto region = read_region(value, fmt::format("{}: {}", reader.name(), value.path()), 1);
  if (region) return *std::move(region);
  reader.take(region.error());
  return std::nullopt;
}

void write_loop(JsonWriter& json, const GridRegion& region, std::size_t loop) {
  json.begin_list();
  for (std::uint32_t i = region.loop_starts[loop]; i < region.loop_starts[loop + 1]; ++i) {
    json.begin_list();
    append_mm(json.raw(), region.points[i].x);
    append_mm(json.raw(), region.points[i].y);
    json.end();
  }
  json.end();
}

}  // namespace

GridPoint outline_point(JsonReader& reader, JsonValue at, JsonValue x, JsonValue y, double mm_per_unit) {
  if (!reader.ok()) return {};
  if (!x.is_number() || !y.is_number()) {
    reader.refuse(at, "a point needs two numbers, x and y");
    return {};
  }
  const Point mm{x.number() * mm_per_unit, y.number() * mm_per_unit};
  if (!(std::abs(mm.x) <= limits::kLargestOutline && std::abs(mm.y) <= limits::kLargestOutline)) {
    reader.refuse(at, fmt::format("({}, {}) is further from the origin than {} mm; check the units", mm.x,
                                  mm.y, limits::kLargestOutline));
    return {};
  }
  return {geom::grid_from_mm(mm.x), geom::grid_from_mm(mm.y)};
}

std::vector<GridPoint> read_loop(JsonReader& reader, JsonValue list, double mm_per_unit,
                                 std::size_t& points) {
  std::vector<GridPoint> loop;
  if (!reader.expect_list(list, kMostOutlinePoints)) return loop;
  points += list.size();
  if (points > kMostOutlinePoints) {
    reader.refuse(list,
                  fmt::format("an outline of more than {} points; make it coarser", kMostOutlinePoints));
    return loop;
  }
  loop.reserve(list.size());
  for (const JsonValue point : list) {
    if (point.kind() != JsonKind::list || point.size() != 2) {
      reader.refuse(point, "a point [x, y] of two numbers is needed");
      return {};
    }
    auto coordinate = point.begin();
    const JsonValue x = *coordinate, y = *++coordinate;
    loop.push_back(outline_point(reader, point, x, y, mm_per_unit));
    if (!reader.ok()) return {};
  }
  return loop;
}

Result<Outline> outline_of_curves(const geom::Region& region, geom::ChordSide side, double chord_tolerance) {
  LEKALO_TRY(auto polygon, geom::grid_region_of_curves(region, side, chord_tolerance, kMostOutlinePoints));
  Outline outline;
  outline.polygon = std::move(polygon);
  if (has_arcs(region)) {
    outline.curves.push_back(region);
    outline.chord_tolerance_mm = chord_tolerance;
  }
  return outline;
}

Outline read_outline(JsonReader& reader, JsonValue value, geom::ChordSide side, std::size_t& chords_made) {
  Outline outline;
  if (!reader.expect_object(value, {"polygon", "curves", "chord_tolerance"})) return outline;
  const auto polygon = value.find("polygon"), curves = value.find("curves"),
             tolerance = value.find("chord_tolerance");
  if (!polygon && !curves) {
    reader.refuse(value, "\"polygon\" or \"curves\", the shape, is missing");
    return outline;
  }
  if (tolerance && !curves)
    reader.refuse(*tolerance, "it belongs to \"curves\", which are not here; leave it out");
  if (polygon) outline.polygon = read_polygon(reader, *polygon);
  if (!curves) return outline;

  const double chord =
      tolerance ? reader.number(*tolerance, limits::kLeastChordTolerance, limits::kMostChordTolerance)
                : kUsualChordTolerance;
  auto region = read_curves(reader, *curves);
  if (!reader.ok()) return outline;
  if (!polygon) {
    auto made = outline_of_curves(*region, side, chord);
    if (!made) {
      reader.refuse(*curves, made.error());
      return outline;
    }
    ++chords_made;
    return *std::move(made);
  }
  if (const auto differs = difference(outline.polygon, *region, chord))
    reader.refuse(value, fmt::format("{}; correct one of them, or leave the polygon out to have it made of "
                                     "the curves",
                                     *differs));
  outline.curves.push_back(*std::move(region));
  outline.chord_tolerance_mm = chord;
  return outline;
}

void write_outline(JsonWriter& json, const Outline& outline) {
  json.begin_object().key("polygon").begin_object().key("outer");
  write_loop(json, outline.polygon, 0);
  if (outline.polygon.loops() > 1) {
    json.key("holes").begin_list();
    for (std::size_t l = 1; l < outline.polygon.loops(); ++l) write_loop(json, outline.polygon, l);
    json.end();
  }
  json.end();
  if (!outline.curves.empty()) {
    write_region(json.key("curves"), outline.curves[0]);
    json.field("chord_tolerance", outline.chord_tolerance_mm);
  }
  json.end();
}

}  // namespace lekalo::io::detail

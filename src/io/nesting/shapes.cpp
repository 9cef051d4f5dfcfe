#include "shapes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "io/layout/layout_outline.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/curve_faces.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"

namespace lekalo::io::detail {
namespace {

using geom::GridPoint;
using geom::GridRegion;

/// Trying hole after hole costs the square of their number.
constexpr std::size_t kMostHolesTried = 1000;

/// The path runs back along itself at b.
bool is_spike(GridPoint a, GridPoint b, GridPoint c) {
  return geom::cross(b - a, c - b) == 0 && geom::dot(b - a, c - b) < 0;
}

/// Takes off the tips of spikes, exactly: what the loop winds around stays the same. The number of tips
/// dropped.
std::size_t without_spikes(std::vector<GridPoint>& loop) {
  std::vector<GridPoint> kept;
  std::size_t dropped = 0;
  for (const GridPoint p : loop) {
    while (true) {
      if (!kept.empty() && kept.back() == p) kept.pop_back();
      if (kept.size() < 2 || !is_spike(kept[kept.size() - 2], kept.back(), p)) break;
      kept.pop_back();
      ++dropped;
    }
    kept.push_back(p);
  }
  // Around the first point.
  std::size_t begin = 0;
  for (bool changed = true; changed && kept.size() - begin > 2;) {
    ask(kept.size());
    changed = true;
    if (kept.back() == kept[begin]) {
      kept.pop_back();
    } else if (is_spike(kept[kept.size() - 2], kept.back(), kept[begin])) {
      kept.pop_back();
      ++dropped;
    } else if (is_spike(kept.back(), kept[begin], kept[begin + 1])) {
      ++begin;
      ++dropped;
    } else {
      changed = false;
    }
  }
  kept.erase(kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(begin));
  if (dropped > 0) loop = std::move(kept);
  return dropped;
}

geom::Point middle_of(const geom::Edge& line) { return 0.5 * (line.from + line.to); }

/// The loop in mm as lines.
geom::Contour lines_of(const std::vector<GridPoint>& loop) {
  geom::Contour contour;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const geom::Point from = geom::mm_from_grid(loop[i]),
                      to = geom::mm_from_grid(loop[(i + 1) % loop.size()]);
    if (!(from == to)) contour.push_back({geom::EdgeKind::line, from, to, {}});
  }
  return contour;
}

void add_outline(geom::Region region, geom::ChordSide side, std::vector<layout::Outline>& outlines) {
  auto polygon = geom::grid_region_of_curves(region, side, kUsualChordTolerance);
  // A face that is lost in the steps of the grid holds nothing.
  if (!polygon) return;
  layout::Outline outline;
  outline.polygon = *std::move(polygon);
  outlines.push_back(std::move(outline));
}

/// Everything that a loop encloses, face by face.
Result<std::vector<layout::Outline>> enclosed_by(const std::vector<GridPoint>& loop) {
  LEKALO_TRY(const geom::CutFaces faces, geom::faces_between(lines_of(loop)));
  std::vector<layout::Outline> outlines;
  for (const geom::CutContour& face : faces.contours)
    add_outline({face.contour, {}}, geom::ChordSide::grow, outlines);
  return outlines;
}

/// Only what loops wind around an odd number of times; nothing where one of them is no contour.
Result<std::vector<layout::Outline>> odd_within(const Loops& loops) {
  std::vector<geom::Contour> contours;
  for (const auto& loop : loops) {
    contours.push_back(lines_of(loop));
    if (!geom::make_region(contours.back())) return std::vector<layout::Outline>{};
  }
  LEKALO_TRY(const geom::CutFaces cut, geom::contours_around(contours, geom::FillRule::even_odd));
  std::vector<layout::Outline> outlines;
  for (const geom::CutContour& outer : cut.contours) {
    if (!(geom::signed_area(outer.contour) > 0)) continue;
    const geom::RegionIndex inside({{outer.contour, {}}});
    geom::Region region{outer.contour, {}};
    for (const geom::CutContour& hole : cut.contours)
      if (geom::signed_area(hole.contour) < 0 && inside.contains(middle_of(hole.contour.front())))
        region.holes.push_back(hole.contour);
    add_outline(std::move(region), geom::ChordSide::shrink, outlines);
  }
  return outlines;
}

}  // namespace

std::string NestingShapes::place(JsonValue at) const {
  const std::string path = at.path();
  return reader_.name() + (path.empty() ? "" : ": " + path);
}

Loops NestingShapes::typed(JsonValue shape) {
  Loops loops;
  if (!reader_.ok()) return loops;
  const bool capitals = shape.find("Type").has_value();
  const auto word = [capitals](const char* capital, const char* small) { return capitals ? capital : small; };
  if (!reader_.expect_object(shape, {word("Type", "type"), word("Data", "data")})) return loops;
  const auto type = reader_.need(shape, word("Type", "type"), "the kind of shape");
  const auto data = reader_.need(shape, word("Data", "data"), "its points");
  if (!type || !data) return loops;
  std::size_t points = 0;
  if (type->text_is(word("SimplePolygon", "simple_polygon"))) {
    loops.push_back(read_loop(reader_, *data, mm_per_unit_, points));
  } else if (type->text_is(word("Polygon", "polygon"))) {
    const char *outer_key = word("Outer", "outer"), *inner_key = word("Inner", "inner");
    if (!reader_.expect_object(*data, {outer_key, inner_key})) return loops;
    const auto outer = reader_.need(*data, outer_key, "the points of the outline");
    if (!outer) return loops;
    loops.push_back(read_loop(reader_, *outer, mm_per_unit_, points));
    if (const auto inner = data->find(inner_key); inner && reader_.expect_list(*inner, kMostOutlinePoints))
      for (const JsonValue hole : *inner) loops.push_back(read_loop(reader_, hole, mm_per_unit_, points));
  } else {
    reader_.refuse(*type, fmt::format("shapes of this kind are not read; known are \"{}\" and \"{}\"",
                                      word("SimplePolygon", "simple_polygon"), word("Polygon", "polygon")));
  }
  return loops;
}

std::vector<GridPoint> NestingShapes::vertex_loop(JsonValue list, std::size_t& points) {
  std::vector<GridPoint> loop;
  if (!reader_.expect_list(list, kMostOutlinePoints)) return loop;
  points += list.size();
  if (points > kMostOutlinePoints)
    reader_.refuse(list,
                   fmt::format("an outline of more than {} points; make it coarser", kMostOutlinePoints));
  for (const JsonValue point : list) {
    if (!reader_.expect_object(point, {"x", "y"})) break;
    const auto x = reader_.need(point, "x", "a coordinate"), y = reader_.need(point, "y", "a coordinate");
    if (!x || !y) break;
    loop.push_back(outline_point(reader_, point, *x, *y, mm_per_unit_));
  }
  return loop;
}

Loops NestingShapes::vertices(JsonValue shape) {
  Loops loops;
  std::size_t points = 0;
  const auto outer = reader_.need(shape, "vertices", "the points of the outline");
  if (!outer) return loops;
  loops.push_back(vertex_loop(*outer, points));
  const auto holes = shape.find("holes");
  if (!holes || !reader_.expect_list(*holes, kMostOutlinePoints)) return loops;
  for (const JsonValue hole : *holes) {
    if (!reader_.expect_object(hole, {"type", "vertices", "holes"})) return loops;
    if (const auto type = hole.find("type"); type && !type->text_is("polygon"))
      reader_.refuse(*type, "holes of this kind are not read; \"polygon\" is");
    if (const auto inner = hole.find("holes"); inner && inner->size() > 0)
      reader_.refuse(*inner, "a hole within a hole; make what is in it an item of its own");
    if (const auto list = reader_.need(hole, "vertices", "the points of the hole"))
      loops.push_back(vertex_loop(*list, points));
    if (!reader_.ok()) return loops;
  }
  return loops;
}

void NestingShapes::drop_spikes(JsonValue at, Loops& loops) {
  std::size_t dropped = 0;
  for (auto& loop : loops) dropped += without_spikes(loop);
  if (dropped > 0)
    notices.push_back(
        fmt::format("{}: {} {} where the outline ran back along itself dropped; the area is the "
                    "same",
                    place(at), dropped, dropped == 1 ? "point" : "points"));
}

layout::Outline NestingShapes::outline(JsonValue at, Loops loops) {
  layout::Outline outline;
  if (!reader_.ok()) return outline;
  drop_spikes(at, loops);
  auto region = geom::make_grid_region(std::move(loops));
  if (region) {
    outline.polygon = *std::move(region);
  } else {
    reader_.refuse(at, region.error());
  }
  return outline;
}

std::vector<layout::Outline> NestingShapes::zone(JsonValue at, Loops loops, Stricter stricter) {
  if (!reader_.ok()) return {};
  drop_spikes(at, loops);
  if (auto region = geom::make_grid_region(loops)) {
    layout::Outline outline;
    outline.polygon = *std::move(region);
    return {std::move(outline)};
  }
  const bool larger = stricter == Stricter::larger;
  auto outlines = larger ? enclosed_by(loops[0]) : odd_within(loops);
  if (!outlines) {
    reader_.refuse(at, outlines.error());
    return {};
  }
  notices.push_back(
      fmt::format("{}: the zone crosses itself; the reading that forbids more counts: {}", place(at),
                  larger ? "all that it encloses" : "what it winds around an odd number of times"));
  return *std::move(outlines);
}

void NestingShapes::stock(JsonValue at, Loops loops, layout::Stock& stock) {
  if (!reader_.ok()) return;
  drop_spikes(at, loops);
  if (auto whole = geom::make_grid_region(loops)) {
    stock.outline.polygon = *std::move(whole);
    return;
  }
  if (loops.size() > kMostHolesTried)
    return reader_.refuse(at, "holes meet each other or the outline, and there are too many to try them");
  Loops kept{loops[0]};
  auto material = geom::make_grid_region(kept);
  if (!material) return reader_.refuse(at, material.error());
  std::vector<std::size_t> meeting;
  for (std::size_t h = 1; h < loops.size(); ++h) {
    kept.push_back(loops[h]);
    if (auto with = geom::make_grid_region(kept)) {
      material = std::move(with);
      continue;
    }
    kept.pop_back();
    auto alone = geom::make_grid_region({loops[h]});
    if (!alone) return reader_.refuse(at, fmt::format("hole {}: {}", h - 1, alone.error().message));
    layout::Defect defect{fmt::format("hole-{}", h - 1), kNeverTolerated, {}};
    defect.outline.polygon = *std::move(alone);
    stock.defects.push_back(std::move(defect));
    meeting.push_back(h - 1);
  }
  stock.outline.polygon = *std::move(material);
  notices.push_back(
      fmt::format("{}: of its holes, {} meet the outline or another hole; they are kept as "
                  "defects that no part tolerates, so that the same places stay forbidden",
                  place(at), joined_text(meeting, ", ")));
}

void merge_alike(std::vector<layout::Stock>& stocks) {
  std::vector<layout::Stock> kept;
  std::map<std::pair<std::size_t, std::int64_t>, std::vector<std::size_t>> by_size;
  for (layout::Stock& stock : stocks) {
    const GridRegion& polygon = stock.outline.polygon;
    auto& candidates = by_size[{polygon.points.size(), static_cast<std::int64_t>(geom::twice_area(polygon))}];
    const auto alike = std::find_if(candidates.begin(), candidates.end(), [&](std::size_t k) {
      layout::Stock other = stock;
      other.id = kept[k].id;
      other.name = kept[k].name;
      other.count = kept[k].count;
      return other == kept[k];
    });
    if (alike == candidates.end()) {
      candidates.push_back(kept.size());
      kept.push_back(std::move(stock));
    } else {
      kept[*alike].count += stock.count;
    }
  }
  stocks = std::move(kept);
}

}  // namespace lekalo::io::detail

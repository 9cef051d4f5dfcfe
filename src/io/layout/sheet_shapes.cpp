#include "sheet_shapes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>

#include "lekalo/base/angle.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/layout/label_place.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::io::detail {
namespace {

using geom::GridPoint;
using geom::GridRegion;
using geom::Point;
using layout::Document;
using layout::Placement;
using layout::Sheet;

constexpr double kLargestLetter = 6, kSmallestLetter = 0.5;  // mm
constexpr double kLongestGrainLine = 150;                    // mm

struct Motion {
  geom::GridRotation rotation;
  bool mirrored = false;
  GridPoint shift;

  [[nodiscard]] geom::BlankFromPart pose() const {
    return {static_cast<double>(rotation.c) * 0x1p-52, static_cast<double>(rotation.s) * 0x1p-52,
            geom::mm_from_grid(shift), mirrored};
  }
};

/// Says whether the polygon is what the drawing gives, so that they lie as near to each other as grid_region
/// says.
bool is_of_curves(const layout::Outline& outline, geom::ChordSide side) {
  if (outline.curves.empty()) return false;
  const auto made = geom::grid_region_of_curves(outline.curves.front(), side, outline.chord_tolerance_mm,
                                                kMostOutlinePoints);
  return made && *made == outline.polygon;
}

geom::Contour moved(const geom::Contour& contour, const Motion& motion) {
  const geom::BlankFromPart pose = motion.pose();
  geom::Contour result;
  for (geom::Edge edge : contour) {
    edge.from = pose(edge.from), edge.to = pose(edge.to);
    if (edge.kind != geom::EdgeKind::line) {
      edge.centre = pose(edge.centre);
      if (motion.mirrored)
        edge.kind = edge.kind == geom::EdgeKind::arc_ccw ? geom::EdgeKind::arc_cw : geom::EdgeKind::arc_ccw;
    }
    result.push_back(edge);
  }
  return result;
}

/// A text that is turned and moved, and where the part is mirrored written the other way round.
layout::PartText moved(layout::PartText text, const Motion& motion) {
  const geom::BlankFromPart pose = motion.pose();
  text.at = pose(text.at);
  const double turn = geom::direction_angle(pose.cosine, pose.sine) * kDegreesPerRadian;
  double degrees = std::fmod(turn + (motion.mirrored ? -text.degrees : text.degrees), 360);
  if (degrees < 0) degrees += 360;
  text.degrees = degrees;
  text.mirrored = text.mirrored != motion.mirrored;
  return text;
}

geom::Region placed(const layout::Outline& outline, bool with_arcs, const Motion& motion) {
  if (with_arcs) {
    std::vector<geom::Contour> holes;
    for (const geom::Contour& hole : outline.curves.front().holes) holes.push_back(moved(hole, motion));
    auto region = geom::make_region(moved(outline.curves.front().outer, motion), std::move(holes));
    if (region) return *std::move(region);
  }
  return geom::region_of_lines(
      geom::moved(geom::turned(outline.polygon, motion.rotation, motion.mirrored), motion.shift));
}

/// The stretch of the line from p along `way` that lies in the material around p, as parameters.
std::pair<double, double> stretch_in(const GridRegion& outline, Point p, Point way) {
  double back = -1e300, ahead = 1e300;
  for (std::size_t l = 0; l < outline.loops(); ++l) {
    const std::uint32_t begin = outline.loop_starts[l], end = outline.loop_starts[l + 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      const Point a = geom::mm_from_grid(outline.points[i]),
                  b = geom::mm_from_grid(outline.points[i + 1 == end ? begin : i + 1]);
      const double sa = geom::cross(way, a - p), sb = geom::cross(way, b - p);
      if ((sa > 0) == (sb > 0)) continue;
      const double t = geom::dot(way, a - p) + sa / (sa - sb) * geom::dot(way, b - a);
      if (t >= 0) ahead = std::min(ahead, t);
      if (t <= 0) back = std::max(back, t);
    }
  }
  return {back, ahead};
}

std::vector<Point> grain_line(const layout::Part& part, const Placement& placement, const GridRegion& outline,
                              const LabelPlace& place) {
  if (!part.grain) return {};
  const auto rotation = geom::rotation_from_degrees(part.grain->degrees);
  const Motion motion{placement.rotation, placement.mirrored, {}};
  Point way = motion.pose().rotate(
      {static_cast<double>(rotation.c) * 0x1p-52, static_cast<double>(rotation.s) * 0x1p-52});
  way = (1 / geom::norm(way)) * way;
  const auto [back, ahead] = stretch_in(outline, place.at, way);
  if (!(ahead - back < 1e7)) return {};
  const double half = std::min(0.35 * (ahead - back), 0.5 * kLongestGrainLine);
  const Point middle = place.at + 0.5 * (ahead + back) * way;
  return {middle - half * way, middle + half * way};
}

/// Counts for each part the others that lie around it: in how many of their holes it is.
std::vector<std::size_t> depths(const std::vector<PlacedShape>& parts,
                                const std::vector<GridRegion>& outlines) {
  std::vector<std::size_t> depth(parts.size(), 0);
  std::vector<geom::GridBox> boxes;
  for (const GridRegion& outline : outlines) boxes.push_back(bounds(outline));
  for (std::size_t around = 0; around < parts.size(); ++around) {
    ask(parts.size());
    if (outlines[around].loops() < 2) continue;
    GridRegion full;
    full.points.assign(outlines[around].points.begin(),
                       outlines[around].points.begin() + outlines[around].loop_starts[1]);
    full.loop_starts = {0, outlines[around].loop_starts[1]};
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const geom::GridBox &inner = boxes[i], &outer = boxes[around];
      if (i == around || inner.low.x < outer.low.x || inner.low.y < outer.low.y ||
          inner.high.x > outer.high.x || inner.high.y > outer.high.y)
        continue;
      if (locate_point(full, outlines[i].points.front()) == geom::PointLocation::inside) ++depth[i];
    }
  }
  return depth;
}

std::string sheet_name(const Document& document, Sheet sheet) {
  const layout::Stock& stock = document.stocks[sheet.stock];
  return stock.count > 1 ? fmt::format("{}#{}", stock.id, sheet.copy + 1) : stock.id;
}

class SheetMaker {
 public:
  SheetMaker(const Document& document, std::vector<std::string>& notes) : document_(document) {
    for (const layout::Part& part : document.parts) {
      with_arcs_.push_back(is_of_curves(part.outline, geom::ChordSide::grow));
      if (!with_arcs_.back() && !part.outline.curves.empty())
        notes.push_back(fmt::format(
            "part {}: its polygon is not what its curves give, so the polygon is written, without "
            "arcs",
            part.id));
    }
  }

  SheetShapes make(Sheet sheet, GridPoint shift) const {
    SheetShapes made{sheet, sheet_name(document_, sheet), {}, {}, {}, {}};
    const layout::Stock& stock = document_.stocks[sheet.stock];
    std::vector<GridRegion> outlines;
    for (const Placement& placement : document_.placements)
      if (Sheet{placement.stock, placement.copy} == sheet) add_part(placement, shift, made, outlines);
    made.material = material(stock, outlines, shift);
    const Motion still{{}, false, shift};
    for (const layout::Defect& defect : stock.defects)
      made.defects.push_back(
          placed(defect.outline, is_of_curves(defect.outline, geom::ChordSide::grow), still));
    for (const layout::QualityZone& zone : stock.zones)
      made.zones.push_back(placed(zone.outline, is_of_curves(zone.outline, geom::ChordSide::grow), still));
    sort_inner_first(made.parts, outlines);
    return made;
  }

 private:
  void add_part(const Placement& placement, GridPoint shift, SheetShapes& to,
                std::vector<GridRegion>& outlines) const {
    const layout::Part& part = document_.parts[placement.part];
    const Motion motion{placement.rotation, placement.mirrored, placement.at + shift};
    const GridRegion outline = geom::moved(placed_outline(part, placement), shift);
    PlacedShape shape;
    shape.placement = &placement;
    shape.part = &part;
    shape.region = placed(part.outline, with_arcs_[placement.part], motion);
    for (const layout::PartArea& area : part.areas)
      shape.areas.push_back(placed(area.outline, is_of_curves(area.outline, geom::ChordSide::grow), motion));
    for (const layout::PartMark& mark : part.marks) shape.marks.push_back({&mark, moved(mark.edges, motion)});
    for (const layout::PartText& text : part.texts) shape.texts.push_back(moved(text, motion));
    const LabelPlace place = label_place(outline);
    shape.grain = grain_line(part, placement, outline, place);
    shape.label = fmt::format("{} {}", part.name.empty() ? part.id : part.name, placement.id);
    // Widths are multiples of the font's size, of which capitals are 0.72.
    const LabelFit fit =
        fitted_label(outline, std::max(1.0, text_width(shape.label)) / 0.72, kSmallestLetter, kLargestLetter);
    shape.label_at = fit.middle;
    shape.label_height = fit.height;
    to.parts.push_back(std::move(shape));
    outlines.push_back(outline);
  }

  /// The stock's outline; that of a strip is as long as it is used.
  static geom::Region material(const layout::Stock& stock, const std::vector<GridRegion>& outlines,
                               GridPoint shift) {
    const geom::GridBox box = bounds(stock.outline.polygon);
    if (stock.kind != layout::StockKind::strip)
      return placed(stock.outline, is_of_curves(stock.outline, geom::ChordSide::shrink), {{}, false, shift});
    std::int64_t length = outlines.empty() ? box.high.y - box.low.y : 1;
    for (const GridRegion& outline : outlines)
      length = std::max(length, bounds(outline).high.x - shift.x - box.low.x);
    const GridPoint low = box.low + shift,
                    high{low.x + std::min(length, box.high.x - box.low.x), box.high.y + shift.y};
    return geom::region_of_lines(geom::rectangle({low, high}));
  }

  static void sort_inner_first(std::vector<PlacedShape>& parts, const std::vector<GridRegion>& outlines) {
    const std::vector<std::size_t> depth = depths(parts, outlines);
    std::vector<std::size_t> order(parts.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return depth[a] > depth[b]; });
    std::vector<PlacedShape> sorted;
    for (const std::size_t i : order) sorted.push_back(std::move(parts[i]));
    parts = std::move(sorted);
  }

  const Document& document_;
  std::vector<bool> with_arcs_;
};

/// The box around the sheet's material and its parts, mm.
geom::Box extent(const SheetShapes& sheet) {
  geom::Box box = geom::bounds(sheet.material.outer);
  for (const PlacedShape& part : sheet.parts) {
    const geom::Box one = geom::bounds(part.region.outer);
    box.low = {std::min(box.low.x, one.low.x), std::min(box.low.y, one.low.y)};
    box.high = {std::max(box.high.x, one.high.x), std::max(box.high.y, one.high.y)};
  }
  return box;
}

}  // namespace

Result<std::vector<Sheet>> sheets_to_write(const Document& document, const std::string& sheet) {
  if (sheet.empty()) {
    std::set<Sheet> used;
    for (const Placement& placement : document.placements) used.insert({placement.stock, placement.copy});
    if (used.empty())
      return failure(ErrorCode::bad_input, "nothing is placed, so there is no sheet in use to write");
    return std::vector<Sheet>(used.begin(), used.end());
  }
  const auto stock_named = [&](std::string_view id) -> std::optional<std::uint32_t> {
    for (std::uint32_t i = 0; i < document.stocks.size(); ++i)
      if (document.stocks[i].id == id) return i;
    return std::nullopt;
  };
  if (const auto stock = stock_named(sheet)) return std::vector<Sheet>{{*stock, 0}};
  const std::size_t mark = sheet.rfind('#');
  if (mark != std::string::npos) {
    std::int64_t copy = 0;
    const auto [end, error] = std::from_chars(sheet.data() + mark + 1, sheet.data() + sheet.size(), copy);
    const auto stock = stock_named(std::string_view(sheet).substr(0, mark));
    const bool number = error == std::errc{} && end == sheet.data() + sheet.size();
    if (stock && number && copy >= 1 && copy <= document.stocks[*stock].count)
      return std::vector<Sheet>{{*stock, copy - 1}};
  }
  std::string known;
  constexpr std::size_t kMostNamed = 5;
  for (std::size_t i = 0; i < std::min(kMostNamed, document.stocks.size()); ++i)
    known += fmt::format("{}{} ({})", i == 0 ? "" : ", ", document.stocks[i].id, document.stocks[i].count);
  return failure(
      ErrorCode::usage,
      fmt::format("there is no sheet {}; a sheet is STOCK or STOCK#COPY, of the stocks (copies) {}", sheet,
                  known));
}

std::vector<SheetShapes> sheet_shapes(const Document& document, const std::vector<Sheet>& sheets,
                                      bool side_by_side, std::vector<std::string>& notes) {
  const SheetMaker maker(document, notes);
  std::vector<SheetShapes> made;
  for (const Sheet& sheet : sheets) {
    SheetShapes shapes = maker.make(sheet, {});
    if (side_by_side && !made.empty()) {
      // The sheets stand apart by whole tens of millimetres, so that coordinates keep their decimals.
      const geom::Box before = extent(made.back()), box = extent(shapes);
      const double space = std::max(20.0, 0.05 * (before.high.x - before.low.x));
      const double by = 10 * std::ceil((before.high.x + space - box.low.x) / 10);
      if (geom::fits_grid(2 * by)) shapes = maker.make(sheet, {geom::grid_from_mm(by), 0});
    }
    made.push_back(std::move(shapes));
  }
  return made;
}

}  // namespace lekalo::io::detail

#include "placed_sheet.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "verify/layout/grid_number.hpp"
#include "verify/number/span.hpp"

namespace lekalo::verify {
namespace {

using Contours = std::vector<std::vector<Stroke>>;

Place place_of(GridPoint p) {
  return {std::ldexp(static_cast<double>(p.x), -20), std::ldexp(static_cast<double>(p.y), -20)};
}
double middle(Span s) { return 0.5 * (s.low + s.high); }
Place place_of(const Vec& v) { return {middle(v.x), middle(v.y)}; }

Place turned(Place p, GridTurn turn, bool mirrored) {
  const double c = std::ldexp(static_cast<double>(turn.c), -52),
               s = std::ldexp(static_cast<double>(turn.s), -52);
  const double x = mirrored ? -p.x : p.x;
  return {c * x - s * p.y, s * x + c * p.y};
}

/// The loops of a polygon; each begins where its last edge ends.
Contours polygon_contours(const GridOutline& outline, const WrittenPiece& piece) {
  Contours contours;
  GridPoint begin;
  bool open = false;
  const auto on_sheet = [&](GridPoint p) {
    return place_of(placed(p, piece.turn, piece.mirrored, piece.at));
  };
  for (const GridEdge& edge : outline.edges) {
    if (!open) contours.emplace_back(), begin = edge.from;
    contours.back().push_back(line_between(on_sheet(edge.from), on_sheet(edge.to)));
    open = !(edge.to == begin);
  }
  return contours;
}

Contours curve_contours(const Shape& shape, const WrittenPiece& piece) {
  const Place shift = place_of(piece.at);
  const auto on_sheet = [&](const Vec& v) { return turned(place_of(v), piece.turn, piece.mirrored) + shift; };
  Contours contours;
  for (std::size_t c = 0; c + 1 < shape.contour_starts.size(); ++c) {
    std::vector<Stroke>& contour = contours.emplace_back();
    for (std::size_t k = shape.contour_starts[c]; k < shape.contour_starts[c + 1]; ++k) {
      const Side& side = shape.sides[k];
      if (!side.written) continue;
      const Place from = on_sheet(side.written_from), to = on_sheet(side.written_to);
      contour.push_back(side.arc ? arc_about(from, to, on_sheet(side.centre), side.ccw != piece.mirrored)
                                 : line_between(from, to));
    }
  }
  return contours;
}

Contours contours_of(const WrittenOutline& outline, const WrittenPiece& piece) {
  return outline.drawn != nullptr ? curve_contours(*outline.drawn, piece) : polygon_contours(outline, piece);
}

void add(const char* layer, const Contours& contours, PlacedSheet& sheet) {
  for (const std::vector<Stroke>& contour : contours) sheet.lines.push_back({layer, contour, true});
}

/// The place of what is no part.
WrittenPiece still() {
  WrittenPiece piece;
  piece.turn.c = std::int64_t{1} << 52;
  return piece;
}

/// Adds the stock's outline; that of a strip is as long as it is used.
void add_material(const WrittenStock& stock, std::int64_t used, PlacedSheet& sheet) {
  if (stock.kind != "strip") return add("SHEET", contours_of(stock.outline, still()), sheet);
  const GridBox& box = stock.outline.box;
  const std::int64_t length = std::min(std::max<std::int64_t>(used, 1), box.high_x);
  const GridOutline rectangle = make_outline({{{0, 0}, {length, 0}, {length, box.high_y}, {0, box.high_y}}});
  add("SHEET", polygon_contours(rectangle, still()), sheet);
}

PlacedSheet sheet_of(const WrittenLayout& layout, SheetOf which) {
  const WrittenStock& stock = layout.stocks[which.first];
  PlacedSheet sheet{which, stock.id, {}, {}};
  if (stock.count > 1) sheet.name = fmt::format("{}#{}", stock.id, which.second + 1);
  std::int64_t used = std::numeric_limits<std::int64_t>::min();
  for (const WrittenPiece& piece : layout.placements) {
    if (SheetOf{piece.stock, piece.copy} != which) continue;
    const WrittenPart& part = layout.parts[piece.part];
    used = std::max(used, placed_outline(part.outline, piece).box.high_x);
    PlacedSheet::Part& placed_part = sheet.parts.emplace_back();
    placed_part.id = piece.id;
    placed_part.contours = contours_of(part.outline, piece);
    placed_part.inside = placed_inside(part, piece);
    add("CUT", placed_part.contours, sheet);
    for (const WrittenArea& area : part.areas) add("AREA", contours_of(area.outline, piece), sheet);
    if (!part.grain) continue;
    const GridTurn grain = turn_of_degrees(part.grain->degrees);
    placed_part.grain =
        turned({std::ldexp(static_cast<double>(grain.c), -52), std::ldexp(static_cast<double>(grain.s), -52)},
               piece.turn, piece.mirrored);
  }
  add_material(stock, used, sheet);
  for (const WrittenStockFeature& defect : stock.defects)
    add("DEFECT", contours_of(defect.outline, still()), sheet);
  for (const WrittenStockFeature& zone : stock.zones) add("ZONE", contours_of(zone.outline, still()), sheet);
  return sheet;
}

/// The extent in x of the material and the parts.
std::pair<double, double> extent_x(const PlacedSheet& sheet) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  std::vector<Stroke> pieces;
  for (const DrawnLine& line : sheet.lines)
    if (line.layer == "SHEET" || line.layer == "CUT")
      for (const Stroke& edge : line.edges) add_pieces(edge, kInfinity, pieces);
  for (const Stroke& s : pieces) {
    low = std::min({low, s.from.x, s.to.x}), high = std::max({high, s.from.x, s.to.x});
    if (!s.arc) continue;
    for (const double side : {-1.0, 1.0}) {
      const Place extreme = s.centre + Place{side * s.radius, 0};
      if (distance(extreme, s) > 1e-12 * (s.radius + std::abs(extreme.x))) continue;
      low = std::min(low, extreme.x), high = std::max(high, extreme.x);
    }
  }
  return {low, high};
}

void move_by(double by, PlacedSheet& sheet) {
  const Place shift{by, 0};
  const auto move = [&](Stroke& edge) {
    edge.from = edge.from + shift, edge.to = edge.to + shift, edge.centre = edge.centre + shift;
  };
  for (DrawnLine& line : sheet.lines) std::ranges::for_each(line.edges, move);
  for (PlacedSheet::Part& part : sheet.parts)
    for (std::vector<Stroke>& contour : part.contours) std::ranges::for_each(contour, move);
  for (PlacedSheet::Part& part : sheet.parts)
    for (PlacedInside& inside : part.inside) move_by(by, inside);
}

}  // namespace

Result<std::vector<PlacedSheet>> placed_sheets(const WrittenLayout& layout, const std::string& file,
                                               const std::string& sheet) {
  std::map<SheetOf, bool> used;
  for (const WrittenPiece& piece : layout.placements) used[{piece.stock, piece.copy}] = true;
  if (used.empty())
    return failure(ErrorCode::bad_input, fmt::format("{}: nothing is placed, so nothing was exported", file));
  std::vector<PlacedSheet> sheets;
  std::string names;
  for (const auto& [which, is_used] : used) {
    PlacedSheet one = sheet_of(layout, which);
    names += (names.empty() ? "" : ", ") + one.name;
    // The first copy has its stock's name too.
    const bool first = which.second == 0 && layout.stocks[which.first].id == sheet;
    if (sheet.empty() || one.name == sheet || first) sheets.push_back(std::move(one));
  }
  if (sheets.empty())
    return failure(ErrorCode::usage,
                   fmt::format("{}: nothing lies on a sheet {}, only on {}", file, sheet, names));
  return sheets;
}

void put_side_by_side(std::vector<PlacedSheet>& sheets) {
  for (std::size_t i = 1; i < sheets.size(); ++i) {
    const auto before = extent_x(sheets[i - 1]), own = extent_x(sheets[i]);
    const double space = std::max(20.0, 0.05 * (before.second - before.first));
    move_by(10 * std::ceil((before.second + space - own.first) / 10), sheets[i]);
  }
}

void add_pieces(const Stroke& edge, double longest, std::vector<Stroke>& pieces) {
  if (edge.arc)
    add_arc(edge.from, edge.to, edge.centre, edge.ccw, longest, pieces);
  else
    add_line(edge.from, edge.to, longest, pieces);
}

}  // namespace lekalo::verify

#include "sheet_figures.hpp"

#include <algorithm>
#include <map>
#include <utility>

namespace lekalo::verify {

Wide twice_area(const GridOutline& outline) {
  Wide sum = 0;
  for (const GridEdge& e : outline.edges) sum += Wide{e.from.x} * e.to.y - Wide{e.to.x} * e.from.y;
  return sum;
}

std::vector<SheetFigures> sheets_of(const WrittenLayout& layout) {
  std::map<std::pair<std::size_t, std::int64_t>, SheetFigures> sheets;
  for (const WrittenPiece& piece : layout.placements) {
    if (piece.copy >= layout.stocks[piece.stock].count) continue;
    SheetFigures& sheet = sheets[{piece.stock, piece.copy}];
    sheet.stock = piece.stock, sheet.copy = piece.copy;
    sheet.parts.push_back(placed_outline(layout.parts[piece.part].outline, piece));
    sheet.parts_area += twice_area(sheet.parts.back());
    sheet.last = std::max(sheet.last, sheet.parts.back().box.high_x);
  }
  std::vector<SheetFigures> list;
  for (auto& [which, sheet] : sheets) {
    const WrittenStock& stock = layout.stocks[sheet.stock];
    const GridBox& box = stock.outline.box;
    const std::int64_t used = std::max(sheet.last, box.low_x + 1) - box.low_x;
    sheet.material_area =
        stock.kind == "strip" ? 2 * Wide{used} * (box.high_y - box.low_y) : twice_area(stock.outline);
    list.push_back(std::move(sheet));
  }
  return list;
}

bool is_free(const GridBox& box, const SheetFigures& sheet, const WrittenStock& stock) {
  if (!(box.low_x < box.high_x && box.low_y < box.high_y)) return false;
  if (stock.open && box.high_x > std::max(sheet.last, stock.outline.box.low_x + 1)) return false;
  const GridOutline rectangle = make_outline(
      {{{box.low_x, box.low_y}, {box.high_x, box.low_y}, {box.high_x, box.high_y}, {box.low_x, box.high_y}}});
  return !have_common_disc({&rectangle}, {&stock.outline}) &&
         std::none_of(sheet.parts.begin(), sheet.parts.end(),
                      [&](const GridOutline& part) {
                        return have_common_disc({&rectangle, &part}, {});
                      }) &&
         std::none_of(stock.defects.begin(), stock.defects.end(), [&](const WrittenStockFeature& defect) {
           return have_common_disc({&rectangle, &defect.outline}, {});
         });
}

}  // namespace lekalo::verify

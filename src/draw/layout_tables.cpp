#include "layout_tables.hpp"

#include <fmt/core.h>

#include <string>

#include "draw/paper/report_sheet.hpp"
#include "draw/paper/view.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;

constexpr Rect kColumn{12, 20, 273, 178};
constexpr double kRow = 4.2;
constexpr double kTableGap = 7;

struct Field {
  const char* heading;
  double width;  ///< mm
  Anchor anchor;
};
struct Row {
  std::vector<std::string> cells;
  Colour colour = kInk;
};
struct Table {
  std::string heading;
  std::vector<Field> fields;
  std::vector<Row> rows;
};

Table sheets_table(const LayoutPicture& picture) {
  Table table{fmt::format("Sheets: density {:.2f} %, cost {:g}", 100 * picture.completeness.density,
                          picture.completeness.cost),
              {{"sheet", 60, Anchor::start},
               {"parts", 20, Anchor::end},
               {"material mm2", 34, Anchor::end},
               {"parts mm2", 34, Anchor::end},
               {"defects mm2", 30, Anchor::end},
               {"used %", 20, Anchor::end},
               {"length mm", 30, Anchor::end},
               {"largest rectangle left mm", 45, Anchor::end}},
              {}};
  for (const layout::SheetUse& use : picture.completeness.sheets) {
    const layout::Stock& stock = picture.document.stocks[use.sheet.stock];
    const Point left = geom::mm_from_grid(use.remnant.high - use.remnant.low);
    table.rows.push_back(
        {{stock.count > 1 ? fmt::format("{} #{}", stock.id, use.sheet.copy + 1) : stock.id,
          fmt::format("{}", use.parts), fmt::format("{:.1f}", use.material_area),
          fmt::format("{:.1f}", use.parts_area), fmt::format("{:.1f}", use.defect_area),
          fmt::format("{:.2f}", 100 * use.density()), fmt::format("{:.3f}", use.used_length_mm),
          left.x > 0 ? fmt::format("{:.1f} x {:.1f}", left.x, left.y) : "-"}});
  }
  return table;
}

Table parts_table(const LayoutPicture& picture) {
  const layout::Completeness& c = picture.completeness;
  Table table{fmt::format("Parts: {} placed", picture.document.placements.size()),
              {{"part", 50, Anchor::start},
               {"name", 70, Anchor::start},
               {"size mm", 40, Anchor::end},
               {"area mm2", 30, Anchor::end},
               {"wanted", 17, Anchor::end},
               {"placed", 17, Anchor::end},
               {"mirrored", 17, Anchor::end},
               {"missing", 16, Anchor::end},
               {"too many", 16, Anchor::end}},
              {}};
  for (std::uint32_t i = 0; i < picture.document.parts.size(); ++i) {
    const layout::Part& part = picture.document.parts[i];
    const geom::GridBox box = bounds(part.outline.polygon);
    const Point size = geom::mm_from_grid(box.high - box.low);
    table.rows.push_back({{part.id, part.name, fmt::format("{:.1f} x {:.1f}", size.x, size.y),
                           fmt::format("{:.1f}", geom::area_mm2(part.outline.polygon)),
                           fmt::format("{}", layout::wanted(picture.document, i)),
                           fmt::format("{}", c.placed[i].total()), fmt::format("{}", c.placed[i].mirrored),
                           fmt::format("{}", c.missing[i]), fmt::format("{}", c.surplus[i])},
                          c.missing[i] > 0 ? kDoubt : kInk});
  }
  return table;
}

Table pieces_table(const LayoutPicture& picture) {
  Table table{"Pieces", {{"piece", 273, Anchor::start}}, {}};
  for (const std::string& piece : picture.pieces) table.rows.push_back({{piece}});
  return table;
}

Table kits_table(const LayoutPicture& picture) {
  Table table{"Kits",
              {{"kit", 50, Anchor::start},
               {"name", 70, Anchor::start},
               {"wanted", 20, Anchor::end},
               {"complete", 20, Anchor::end},
               {"", 6, Anchor::start},
               {"missing", 107, Anchor::start}},
              {}};
  for (std::size_t i = 0; i < picture.document.kits.size(); ++i) {
    const layout::Kit& kit = picture.document.kits[i];
    const layout::KitCount& count = picture.completeness.kits[i];
    table.rows.push_back({{kit.id, kit.name, fmt::format("{}", kit.demand), fmt::format("{}", count.complete),
                           "", count.missing.empty() ? "nothing" : ""},
                          count.missing.empty() ? kInk : kDoubt});
    for (const layout::MissingPiece& piece : count.missing)
      table.rows.push_back(
          {{"", "", "", "", "",
            fmt::format("{} {}{}", piece.count, picture.document.parts[piece.part].id,
                        piece.mirrored ? (*piece.mirrored ? ", mirrored" : ", upright") : "")},
           kDoubt});
  }
  return table;
}

class Pages {
 public:
  explicit Pages(const std::string& name) : name_(name) {}

  void put(const Table& table) {
    if (table.rows.empty()) return;
    // A heading alone at the foot of a page is avoided, because it says nothing there.
    if (pages_.empty() || y_ + kTableGap + 3 * kRow > kColumn.bottom()) begin_page();
    begin_table(table, table.heading);
    for (const Row& row : table.rows) {
      if (y_ + kRow > kColumn.bottom()) {
        begin_page();
        begin_table(table, table.heading + ", continued");
      }
      y_ += kRow;
      cells(table, row.cells, {.size = kReportSmall, .colour = row.colour, .kind = "cell"});
    }
    y_ += kTableGap;
  }

  std::vector<Scene> finish() && {
    for (std::size_t i = 0; i < pages_.size(); ++i)
      Sheet(pages_[i].items)
          .text(kColumn.right(), 13, 60, fmt::format("tables, {} of {}", i + 1, pages_.size()),
                {.size = kReportSmall, .colour = kGrey, .anchor = Anchor::end});
    return std::move(pages_);
  }

 private:
  void begin_page() {
    Scene& page = pages_.emplace_back();
    page.width = kLayoutPage.width, page.height = kLayoutPage.height;
    page.items.push_back(PathItem{{kLayoutPage.ring()}, true, filled(kPaper), {"page", ""}});
    Sheet(page.items).text(kColumn.x, 13, 200, name_, {.size = 4.2, .bold = true, .kind = "title"});
    y_ = kColumn.y;
  }

  void begin_table(const Table& table, const std::string& heading) {
    y_ = Sheet(pages_.back().items).heading(kColumn, y_, heading) + kRow;
    std::vector<std::string> names;
    for (const Field& field : table.fields) names.emplace_back(field.heading);
    cells(table, names, {.size = kReportSmall, .colour = kGrey, .kind = "column"});
  }

  void cells(const Table& table, const std::vector<std::string>& words, TextStyle style) {
    Sheet sheet(pages_.back().items);
    constexpr double kBetween = 2;
    double x = kColumn.x;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const Field& field = table.fields[i];
      style.anchor = field.anchor;
      const double width = field.width - kBetween;
      if (!words[i].empty())
        sheet.text(field.anchor == Anchor::end ? x + width : x, y_, width, words[i], style);
      x += field.width;
    }
  }

  const std::string& name_;
  std::vector<Scene> pages_;
  double y_ = 0;
};

}  // namespace

std::vector<Scene> layout_tables(const LayoutPicture& picture) {
  Pages pages(picture.name);
  pages.put(pieces_table(picture));
  if (!picture.pieces.empty()) return std::move(pages).finish();
  pages.put(parts_table(picture));
  pages.put(kits_table(picture));
  pages.put(sheets_table(picture));
  return std::move(pages).finish();
}

}  // namespace lekalo::draw

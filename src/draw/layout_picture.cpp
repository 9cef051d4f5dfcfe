#include "lekalo/draw/layout_picture.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "draw/paper/colour.hpp"
#include "draw/paper/printed_number.hpp"
#include "draw/paper/report_sheet.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "layout_tables.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/io/layout/label_place.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/layout/part_text.hpp"
#include "region_rings.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;
using geom::Ring;
using layout::Document;
using layout::Placement;
using layout::StockKind;
using layout::Violation;

constexpr Rect kLayoutDrawing{8, 17, 281, 128};
constexpr double kTables = 152;  ///< where the tables begin
constexpr std::size_t kMostViolations = 99;
/// The chords of arcs of marks, mm.
constexpr double kMarkSag = 0.05, kMarkStep = 50;

/// Fills for parts: light enough for black print, different in lightness as well as in hue.
constexpr std::array<Colour, 10> kPartFills = {{{166, 206, 227},
                                                {178, 223, 138},
                                                {253, 205, 151},
                                                {202, 178, 214},
                                                {255, 245, 170},
                                                {140, 200, 190},
                                                {244, 190, 200},
                                                {190, 190, 190},
                                                {150, 180, 230},
                                                {220, 200, 160}}};
constexpr Colour kPartLine{52, 62, 75}, kBad{200, 0, 27}, kDefectFill{120, 40, 40}, kZoneLine{130, 90, 170};

std::vector<Ring> rings_of(const geom::GridRegion& outline) {
  std::vector<Ring> rings;
  for (std::size_t l = 0; l < outline.loops(); ++l) {
    ask();
    Ring& ring = rings.emplace_back();
    for (std::uint32_t i = outline.loop_starts[l]; i < outline.loop_starts[l + 1]; ++i)
      ring.push_back(geom::mm_from_grid(outline.points[i]));
  }
  return rings;
}

Paint fill_and_line(Colour fill, double alpha, Colour line, double width) {
  return with_fill(stroked_round(line, width), fill, alpha);
}

/// Parallel lines at 45 degrees over a box, to be clipped.
std::vector<Ring> hatch(const Rect& box, double step) {
  std::vector<Ring> lines;
  const double reach = box.height;
  for (double x = box.x - reach + step - std::fmod(box.x - reach, step); x < box.right(); x += step)
    lines.push_back({{x, box.bottom()}, {x + reach, box.y}});
  return lines;
}

class LayoutComposer {
 public:
  explicit LayoutComposer(const LayoutPicture& picture)
      : picture_(picture), document_(picture.document), sheet_(scene_.items) {
    scene_.width = kLayoutPage.width, scene_.height = kLayoutPage.height;
    for (const Violation& v : picture.violations) bad_.insert(v.a), bad_.insert(v.b);
    for (const Placement& placement : document_.placements)
      on_sheet_[{placement.stock, placement.copy}].push_back(&placement);
  }

  Scene compose() && {
    scene_.title = "lekalo: " + picture_.name;
    const std::string pieces = counted(picture_.pieces.size(), "piece");
    scene_.description = is_stock() ? pieces
                                    : fmt::format("{} placed, {}, density {:.2f} %",
                                                  counted(document_.placements.size(), "part"),
                                                  counted(picture_.violations.size(), "violation"),
                                                  100 * picture_.completeness.density);
    scene_.items.push_back(PathItem{{kLayoutPage.ring()}, true, filled(kPaper), {"page", ""}});
    sheet_.text(8, 11, 190, picture_.name, {.size = 4.6, .bold = true, .kind = "title"});
    const bool valid = picture_.violations.empty();
    const std::string verdict = valid ? "no violations" : counted(picture_.violations.size(), "violation");
    sheet_.text(289, 11, 90, is_stock() ? pieces : verdict,
                {.size = 3.8,
                 .colour = is_stock() ? kInk
                           : valid    ? kGood
                                      : kBad,
                 .anchor = Anchor::end,
                 .bold = true,
                 .kind = "verdict"});
    draw_sheets();
    draw_tables();
    return std::move(scene_);
  }

 private:
  [[nodiscard]] bool is_stock() const { return !picture_.pieces.empty(); }

  struct Framed {
    layout::Sheet sheet;
    geom::Box box;  ///< mm, of what is shown
  };

  /// Sheets in use; all stocks when nothing is placed.
  [[nodiscard]] std::vector<Framed> framed_sheets() const {
    std::vector<Framed> framed;
    const auto add = [&](layout::Sheet sheet) {
      const layout::Stock& stock = document_.stocks[sheet.stock];
      const geom::GridBox whole = bounds(stock.outline.polygon);
      geom::Box box{geom::mm_from_grid(whole.low), geom::mm_from_grid(whole.high)};
      const auto placed = on_sheet_.find(sheet);
      geom::Box parts = box;
      bool any = false;
      if (placed != on_sheet_.end())
        for (const Placement* placement : placed->second) {
          ask();
          const geom::GridBox one = bounds(placed_outline(document_.parts[placement->part], *placement));
          const geom::Box mm{geom::mm_from_grid(one.low), geom::mm_from_grid(one.high)};
          parts = any ? joined(parts, mm) : mm;
          any = true;
        }
      // A strip is drawn as far as it is used, and a little more.
      if (stock.kind == StockKind::strip)
        box.high.x = std::min(box.high.x, std::max(any ? 1.02 * parts.high.x : 0.0, box.high.y - box.low.y));
      framed.push_back({sheet, any ? joined(box, parts) : box});
    };
    for (const auto& [sheet, placements] : on_sheet_) add(sheet);
    if (framed.empty())
      for (std::uint32_t stock = 0; stock < document_.stocks.size(); ++stock) add({stock, 0});
    return framed;
  }

  void draw_sheets() {
    const std::vector<Framed> framed = framed_sheets();
    if (framed.empty()) return;
    // The number of columns is the one that shows them largest.
    const std::size_t count = framed.size();
    std::size_t columns = 1;
    double best = 0;
    for (std::size_t c = 1; c <= count; ++c) {
      const std::size_t rows = (count + c - 1) / c;
      double scale = 1e300;
      for (const Framed& one : framed) {
        const Point size = one.box.high - one.box.low;
        scale = std::min({scale, (kLayoutDrawing.width / static_cast<double>(c) - 4) / size.x,
                          (kLayoutDrawing.height / static_cast<double>(rows) - 7) / size.y});
      }
      if (scale > best) best = scale, columns = c;
    }
    const std::size_t rows = (count + columns - 1) / columns;
    const double width = kLayoutDrawing.width / static_cast<double>(columns),
                 height = kLayoutDrawing.height / static_cast<double>(rows);
    for (std::size_t i = 0; i < count; ++i) {
      const Rect cell{kLayoutDrawing.x + width * static_cast<double>(i % columns),
                      kLayoutDrawing.y + height * static_cast<double>(i / columns), width, height};
      draw_sheet(framed[i], cell);
    }
  }

  void draw_sheet(const Framed& framed, const Rect& cell) {
    const Rect room{cell.x + 2, cell.y + 5, cell.width - 4, cell.height - 7};
    const View view = fitted(framed.box, room);
    const layout::Stock& stock = document_.stocks[framed.sheet.stock];
    const std::string title = stock.count > 1
                                  ? fmt::format("{} ({} of {})", stock.id, framed.sheet.copy + 1, stock.count)
                                  : stock.id;
    sheet_.text(cell.x + 2, cell.y + 3.6, cell.width - 4, title,
                {.size = kReportSmall, .colour = kGrey, .kind = "sheet-name"});
    // A strip goes on beyond what is shown of it.
    const Point corner = view({framed.box.low.x, framed.box.high.y}),
                opposite = view({framed.box.high.x, framed.box.low.y});
    const Rect shown = Rect{corner.x, corner.y, opposite.x - corner.x, opposite.y - corner.y}.grown(0.6);
    scene_.items.push_back(ClipBegin{{shown.ring()}});
    path(rings_of(stock.outline.polygon), view, shown, fill_and_line(kBlankFill, 1, kBlankLine, 0.3),
         {"stock", stock.id});
    ClipBegin material;
    for (const Ring& ring : rings_of(stock.outline.polygon))
      material.lines.push_back(on_paper(ring, view, shown));
    scene_.items.push_back(std::move(material));
    for (const layout::QualityZone& zone : stock.zones) {
      Paint paint = fill_and_line(kZoneLine, 0.10, kZoneLine, 0.25);
      paint.dash = 1.2;
      path(rings_of(zone.outline.polygon), view, shown, paint,
           {"zone", fmt::format("{}: quality {}", zone.id, zone.quality)});
    }
    scene_.items.push_back(ClipEnd{});
    const auto placed = on_sheet_.find(framed.sheet);
    if (placed != on_sheet_.end())
      for (const Placement* placement : placed->second) draw_part(*placement, view, shown);
    for (const layout::Defect& defect : stock.defects)
      path(rings_of(defect.outline.polygon), view, shown, fill_and_line(kDefectFill, 0.7, kDefectFill, 0.25),
           {"defect", fmt::format("{}: severity {}", defect.id, defect.severity)});
    for (const layout::QualityZone& zone : stock.zones) label_zone(zone, stock, view);
    for (const layout::SheetUse& use : picture_.completeness.sheets)
      if (use.sheet == framed.sheet) draw_remnant(use, view, shown);
    scene_.items.push_back(ClipEnd{});
    for (std::size_t i = 0; i < std::min(picture_.violations.size(), kMostViolations); ++i) {
      const Violation& v = picture_.violations[i];
      if (v.stock == framed.sheet.stock && v.copy == framed.sheet.copy) draw_mark(i + 1, v, view);
    }
  }

  /// Writes at the zone's upper end, where it runs into fewer parts' names than in the middle.
  void label_zone(const layout::QualityZone& zone, const layout::Stock& stock, const View& view) {
    // The highest corner of the zone on the material, or the highest of the material in the zone.
    const geom::GridRegion &outline = zone.outline.polygon, &material = stock.outline.polygon;
    std::optional<geom::GridPoint> top;
    const auto consider = [&](const geom::GridRegion& corners, const geom::GridRegion& around) {
      for (const geom::GridPoint p : corners.points)
        if (locate_point(around, p) != geom::PointLocation::outside && (!top || p.y > top->y)) top = p;
    };
    consider(outline, material);
    consider(material, outline);
    if (!top) return;
    const Point paper = view(geom::mm_from_grid(*top));
    sheet_.text(paper.x + 0.8, paper.y + 2.6, 40, fmt::format("quality {}", zone.quality),
                {.size = 2.0, .colour = kZoneLine, .kind = "zone-label"});
  }

  void path(const std::vector<Ring>& rings, const View& view, const Rect& visible, const Paint& paint,
            Meaning meaning) {
    PathItem item{{}, true, paint, std::move(meaning)};
    for (const Ring& ring : rings)
      if (Ring line = on_paper(ring, view, visible); line.size() > 2) item.lines.push_back(std::move(line));
    if (!item.lines.empty()) scene_.items.push_back(std::move(item));
  }

  void draw_part(const Placement& placement, const View& view, const Rect& room) {
    const layout::Part& part = document_.parts[placement.part];
    const geom::GridRegion outline = placed_outline(part, placement);
    const std::vector<Ring> rings = rings_of(outline);
    const bool bad = bad_.contains(placement.id);
    const Colour fill = kPartFills[placement.part % kPartFills.size()];
    path(rings, view, room, fill_and_line(fill, 0.85, bad ? kBad : kPartLine, bad ? 0.5 : 0.22),
         {bad ? "part bad" : "part",
          fmt::format("{} (placement {}{}{})", part.name.empty() ? part.id : part.name, placement.id,
                      placement.mirrored ? ", mirrored" : "", placement.locked ? ", locked" : "")});
    draw_part_marks(part, placement, view, room);
    const geom::GridBox box = bounds(outline);
    const Point low = view(geom::mm_from_grid(box.low)), high = view(geom::mm_from_grid(box.high));
    const Rect on_page{low.x, high.y, high.x - low.x, low.y - high.y};
    if (bad) {
      ClipBegin clip;
      for (const Ring& ring : rings) clip.lines.push_back(on_paper(ring, view, room));
      scene_.items.push_back(std::move(clip));
      PathItem lines{hatch(on_page, 1.6), false, stroked(kBad, 0.18), {"hatch", ""}};
      scene_.items.push_back(std::move(lines));
      scene_.items.push_back(ClipEnd{});
    }
    // A name where it fits; the placement's number where that does.
    const double size = std::min(2.6, on_page.height / 3);
    for (const std::string& label :
         {part.name.empty() ? part.id : part.name, fmt::format("{}", placement.id)}) {
      if (size < 0.9 || io::text_width(label) * size > 0.7 * on_page.width) continue;
      const Point paper = view(io::label_place(outline).at);
      sheet_.text(paper.x, paper.y + 0.35 * size, on_page.width, label,
                  {.size = size, .colour = kInk, .anchor = Anchor::middle, .kind = "part-label"});
      break;
    }
  }

  /// Draws what is engraved, bent or cut within a part, thin, in the colours of its drawing; texts as
  /// strokes, bends dashed.
  void draw_part_marks(const layout::Part& part, const Placement& placement, const View& view,
                       const Rect& room) {
    constexpr auto kOne = static_cast<double>(geom::GridRotation::kOne);
    const double c = static_cast<double>(placement.rotation.c) / kOne,
                 s = static_cast<double>(placement.rotation.s) / kOne;
    const Point at = geom::mm_from_grid(placement.at);
    std::map<std::pair<std::string, std::string>, std::vector<Ring>> by_look;
    const auto add = [&](const std::string& kind, const std::string& colour, Ring line) {
      ask();
      for (Point& p : line) {
        if (placement.mirrored) p.x = -p.x;
        p = Point{c * p.x - s * p.y, s * p.x + c * p.y} + at;
      }
      Ring shown = on_paper(line, view, room);
      if (shown.size() > 1) by_look[{kind, colour}].push_back(std::move(shown));
    };
    for (const layout::PartMark& mark : part.marks)
      add(mark.role == layout::MarkRole::bend ? "bend" : "mark", mark.colour,
          chain_points(mark.edges, kMarkSag, kMarkStep));
    for (const layout::PartText& text : part.texts)
      for (Ring& stroke : layout::text_strokes(text)) add("text", text.colour, std::move(stroke));
    for (auto& [look, lines] : by_look) {
      const bool bend = look.first == "bend";
      scene_.items.push_back(PathItem{std::move(lines),
                                      false,
                                      stroked(mark_colour(look.second), 0.1, bend ? 0.8 : 0),
                                      {look.first, part.id}});
    }
  }

  /// The colour that a mark has in its drawing. What is drawn for a dark screen is seen on paper, too.
  static Colour mark_colour(const std::string& said) {
    constexpr unsigned kTooLight = 200;
    if (said.size() != 7) return kPartLine;
    unsigned rgb = 0;
    std::from_chars(said.data() + 1, said.data() + said.size(), rgb, 16);
    const unsigned red = rgb >> 16U, green = (rgb >> 8U) & 0xffU, blue = rgb & 0xffU;
    if (std::min({red, green, blue}) > kTooLight) return kPartLine;
    return {static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
            static_cast<std::uint8_t>(blue)};
  }

  void draw_remnant(const layout::SheetUse& use, const View& view, const Rect& room) {
    if (use.remnant.low == use.remnant.high) return;
    const Point low = geom::mm_from_grid(use.remnant.low), high = geom::mm_from_grid(use.remnant.high);
    Paint paint = stroked(kGood, 0.3, 1.6);
    path({{low, {high.x, low.y}, high, {low.x, high.y}}}, view, room, paint,
         {"remnant",
          fmt::format("largest rectangle left: {:.1f} x {:.1f} mm", high.x - low.x, high.y - low.y)});
  }

  void draw_mark(std::size_t number, const Violation& v, const View& view) {
    const Point at = view(v.at);
    if (norm(v.direction) > 0) {
      const Point way{v.direction.x, -v.direction.y}, tip = at + 7.0 * way, side = perpendicular(way);
      scene_.items.push_back(PathItem{{{at, tip}}, false, stroked(kBad, 0.4), {"way-out", ""}});
      scene_.items.push_back(PathItem{{{tip, tip - 1.8 * way + 0.7 * side, tip - 1.8 * way - 0.7 * side}},
                                      true,
                                      filled(kBad),
                                      {"way-out", ""}});
    }
    scene_.items.push_back(
        DotItem{at, 1.7, fill_and_line(kPaper, 1, kBad, 0.4), {"violation", std::string(name_of(v.kind))}});
    sheet_.text(
        at.x, at.y + 0.8, 3, fmt::format("{}", number),
        {.size = 2.1, .colour = kBad, .anchor = Anchor::middle, .bold = true, .kind = "violation-number"});
  }

  void draw_tables() {
    if (is_stock()) {
      pieces_table({8, kTables, 281, 54});
      return;
    }
    const bool bad = !picture_.violations.empty();
    const Rect left{8, kTables, 88, 54}, middle{103, kTables, 90, 54}, right{200, kTables, 89, 54};
    sheets_table(left);
    parts_table(middle);
    if (bad)
      violations_table(right);
    else
      kits_table(right);
  }

  /// Rows until the column is full; the last one says how many are not shown.
  template <class Row>
  void rows(const Rect& column, double y, std::size_t count, Row&& row) {
    const auto fit = static_cast<std::size_t>((column.bottom() - y) / kReportSmallLine);
    const std::size_t shown = count <= fit ? count : fit - 1;
    for (std::size_t i = 0; i < shown; ++i) row(i, y += kReportSmallLine);
    if (shown < count)
      sheet_.text(column.x, y + kReportSmallLine, column.width, fmt::format("and {} more", count - shown),
                  {.size = kReportSmall, .colour = kGrey});
  }

  void sheets_table(const Rect& column) {
    const layout::Completeness& c = picture_.completeness;
    const double y =
        sheet_.heading(column, column.y, fmt::format("Material: density {:.2f} %", 100 * c.density));
    rows(column, y, c.sheets.size(), [&](std::size_t i, double at) {
      const layout::SheetUse& use = c.sheets[i];
      const layout::Stock& stock = document_.stocks[use.sheet.stock];
      const Point remnant = geom::mm_from_grid(use.remnant.high - use.remnant.low);
      std::string text = fmt::format("{}{}: {} {}, {:.2f} %", stock.id,
                                     stock.count > 1 ? fmt::format(" #{}", use.sheet.copy + 1) : "",
                                     use.parts, use.parts == 1 ? "part" : "parts", 100 * use.density());
      if (stock.kind == StockKind::strip) text += fmt::format(", length {:.3f} mm", use.used_length_mm);
      if (use.defect_area > 0)
        text += fmt::format(", defects {:.2f} %", 100 * use.defect_area / use.material_area);
      if (remnant.x > 0) text += fmt::format(", left {:.0f} x {:.0f} mm", remnant.x, remnant.y);
      sheet_.text(column.x, at, column.width, text, {.size = kReportSmall});
    });
  }

  void parts_table(const Rect& column) {
    const layout::Completeness& c = picture_.completeness;
    const double y =
        sheet_.heading(column, column.y, fmt::format("Parts: {} placed", document_.placements.size()));
    rows(column, y, document_.parts.size(), [&](std::size_t i, double at) {
      const layout::Part& part = document_.parts[i];
      swatch(column, at, i);
      std::string text = fmt::format("{}: {}", part.name.empty() ? part.id : part.name, c.placed[i].total());
      if (c.placed[i].mirrored > 0) text += fmt::format(" ({} mirrored)", c.placed[i].mirrored);
      if (c.missing[i] > 0) text += fmt::format(", {} missing", c.missing[i]);
      if (c.surplus[i] > 0) text += fmt::format(", {} too many", c.surplus[i]);
      sheet_.text(column.x + 4, at, column.width - 4, text,
                  {.size = kReportSmall, .colour = c.missing[i] > 0 ? kDoubt : kInk});
    });
  }

  void pieces_table(const Rect& column) {
    rows(column, sheet_.heading(column, column.y, "Pieces"), picture_.pieces.size(),
         [&](std::size_t i, double at) {
           swatch(column, at, i);
           sheet_.text(column.x + 4, at, column.width - 4, picture_.pieces[i], {.size = kReportSmall});
         });
  }

  /// The colour of a part beside its row.
  void swatch(const Rect& column, double at, std::size_t part) {
    scene_.items.push_back(PathItem{{Rect{column.x, at - 2, 2.6, 2.3}.ring()},
                                    true,
                                    fill_and_line(kPartFills[part % kPartFills.size()], 1, kPartLine, 0.15),
                                    {"swatch", ""}});
  }

  void kits_table(const Rect& column) {
    const layout::Completeness& c = picture_.completeness;
    if (document_.kits.empty()) return;
    const double y = sheet_.heading(column, column.y, "Kits");
    std::vector<std::pair<std::string, Colour>> lines;
    for (std::size_t i = 0; i < document_.kits.size(); ++i) {
      const layout::Kit& kit = document_.kits[i];
      lines.push_back({fmt::format("{}: {} of {} complete", kit.name.empty() ? kit.id : kit.name,
                                   c.kits[i].complete, kit.demand),
                       c.kits[i].missing.empty() ? kGood : kDoubt});
      for (const layout::MissingPiece& piece : c.kits[i].missing)
        lines.push_back({fmt::format("    missing {} {}{}", piece.count, document_.parts[piece.part].id,
                                     piece.mirrored ? (*piece.mirrored ? ", mirrored" : ", upright") : ""),
                         kDoubt});
    }
    rows(column, y, lines.size(), [&](std::size_t i, double at) {
      sheet_.text(column.x, at, column.width, lines[i].first,
                  {.size = kReportSmall, .colour = lines[i].second});
    });
  }

  void violations_table(const Rect& column) {
    const double y = sheet_.heading(column, column.y, "Violations");
    rows(column, y, picture_.violations.size(), [&](std::size_t i, double at) {
      const Violation& v = picture_.violations[i];
      std::string text = fmt::format("{}  {}: placement {}", i + 1, name_of(v.kind), v.a);
      if (v.b != 0) text += fmt::format(" and {}", v.b);
      if (v.amount_mm > 0) text += fmt::format(", {} mm", short_number_up(v.amount_mm));
      text += fmt::format(" at ({:.1f}, {:.1f})", v.at.x, v.at.y);
      sheet_.text(column.x, at, column.width, text, {.size = kReportSmall, .colour = kBad});
    });
  }

  const LayoutPicture& picture_;
  const Document& document_;
  Scene scene_;
  Sheet sheet_;
  std::set<std::uint64_t> bad_;
  std::map<layout::Sheet, std::vector<const Placement*>> on_sheet_;
};

}  // namespace

std::string layout_svg(const LayoutPicture& picture) { return scene_svg(LayoutComposer(picture).compose()); }
Result<std::string> layout_png(const LayoutPicture& picture, int width_px) {
  return scene_png(LayoutComposer(picture).compose(), width_px);
}
Result<std::string> layout_pdf(const LayoutPicture& picture) {
  return scene_pdf(LayoutComposer(picture).compose(), layout_tables(picture));
}

}  // namespace lekalo::draw

#include "lekalo/io/layout/layout_export.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/svg/svg.hpp"
#include "support/layout_texts.hpp"
#include "support/profile_parts.hpp"

namespace lekalo::io::io_layout_export_test {
namespace {

using cases::add_part;
using cases::Json;
using cases::outline_json;
using cases::place;
using cases::rectangle;

Json circle_json(double x, double y, double r, bool ccw = true) {
  return Json::array(
      {{{"arc", {{"from", {x + r, y}}, {"to", {x + r, y}}, {"centre", {x, y}}, {"ccw", ccw}}}}});
}

/// Two sheets: a washer with a disc in its hole, a D of a line and an arc, turned and mirrored; a plate with
/// a square hole on the second.
Json sample() {
  Json layout = cases::empty_layout();
  Json& sheet = layout["stocks"][0];
  sheet["count"] = 3;
  sheet["defects"] = {{{"id", "knot"}, {"severity", 1}, {"outline", outline_json(rectangle(90, 90, 5, 5))}}};
  sheet["zones"] = {{{"id", "edge"}, {"quality", 1}, {"outline", outline_json(rectangle(0, 95, 100, 5))}}};
  Json& washer = add_part(
      layout, "washer",
      {{"curves",
        {{"outer", circle_json(0, 0, 20)}, {"holes", Json::array({circle_json(0, 0, 12, false)})}}}});
  washer["grain"] = {{"deg", 90}, {"tolerance_deg", 90}};
  add_part(layout, "disc", {{"curves", {{"outer", circle_json(0, 0, 8)}}}})["name"] = "Диск";
  Json half =
      Json::array({{{"line", {{"from", {0, -15}}, {"to", {0, 15}}}}},
                   {{"arc", {{"from", {0, 15}}, {"to", {0, -15}}, {"centre", {0, 0}}, {"ccw", true}}}}});
  add_part(layout, "d", {{"curves", {{"outer", half}}}})["mirror"] = true;
  Json& plate = add_part(layout, "plate", outline_json(rectangle(0, 0, 30, 20), {rectangle(5, 5, 10, 10)}));
  plate["areas"] = {{{"quality", 0}, {"outline", outline_json(rectangle(20, 5, 5, 5))}}};
  place(layout, "washer", 25, 25);
  place(layout, "disc", 26, 25.5);
  place(layout, "d", 75, 30, 33.3)["mirrored"] = true;
  place(layout, "plate", 20, 60, 10);
  place(layout, "plate", 10, 10)["copy"] = 2;
  return layout;
}

layout::Document document_of(const Json& layout) {
  auto read = read_layout(layout.dump(), "layout");
  if (!read) throw std::logic_error("test input: " + read.error().message);
  return std::move(read->document);
}

Exported exported(const layout::Document& document, ExportForm form, const std::vector<ExportWord>& words) {
  const auto request = read_export_words(form, words, "--");
  if (!request) throw std::logic_error(request.error().message);
  auto made = export_layout(document, "Sample", *request);
  if (!made) throw std::logic_error(made.error().message);
  return *std::move(made);
}

struct LayerSum {
  std::size_t pieces = 0, holes = 0, arcs = 0;
  double area = 0;
};
std::map<std::string, LayerSum> by_layer(const Drawing& drawing) {
  std::map<std::string, LayerSum> sums;
  for (const char* layer : kExportLayers) {
    DrawingOptions options;
    options.take = {layer};
    const auto regions = make_regions(drawing, options);
    if (!regions) continue;
    LayerSum& sum = sums[layer];
    for (const auto& one : regions->regions) {
      ++sum.pieces;
      sum.holes += one.holes.size();
      sum.area += geom::area(one);
      cases::each_contour(one, [&](const geom::Contour& contour) {
        for (const geom::Edge& edge : contour) sum.arcs += edge.kind != geom::EdgeKind::line;
      });
    }
  }
  return sums;
}

constexpr double kPi = std::numbers::pi;
const double kWasher = kPi * (400 - 144), kDisc = kPi * 64, kHalf = kPi * 225 / 2, kPlate = 500;

/// A grid step on either side of 100 mm of outline.
constexpr double kOff = 2e-4;

void expect_sample(const std::map<std::string, LayerSum>& sums) {
  const LayerSum& cut = sums.at("CUT");
  EXPECT_EQ(cut.pieces, 5U);
  EXPECT_EQ(cut.holes, 3U);
  EXPECT_EQ(cut.arcs, 4U);
  EXPECT_NEAR(cut.area, kWasher + kDisc + kHalf + 2 * kPlate, kOff);
  EXPECT_EQ(sums.at("SHEET").pieces, 2U);
  EXPECT_NEAR(sums.at("SHEET").area, 20000, kOff);
  EXPECT_NEAR(sums.at("DEFECT").area, 50, kOff);
  EXPECT_NEAR(sums.at("ZONE").area, 1000, kOff);
  EXPECT_NEAR(sums.at("AREA").area, 50, kOff);
}

TEST(LayoutExport, ADrawingOpenedAgainGivesThePartsAndTheSheetsAlone) {
  const layout::Document document = document_of(sample());
  for (const ExportForm form : {ExportForm::dxf, ExportForm::svg}) {
    const Exported made = exported(document, form, {});
    const auto opened = read_any_layout(made.files.at(0).bytes, "out");
    ASSERT_TRUE(opened) << opened.error().message;
    const layout::Document& again = opened->document;
    double cut = 0;
    for (const layout::Part& part : again.parts) cut += geom::area_mm2(part.outline.polygon);
    EXPECT_EQ(again.parts.size(), 5U);
    EXPECT_NEAR(cut, kWasher + kDisc + kHalf + 2 * kPlate, 2.0);  // chords outside of arcs
    ASSERT_EQ(again.stocks.size(), 2U);
    EXPECT_EQ(again.stocks[0].id, "SHEET");
    EXPECT_EQ(again.stocks[1].id, "SHEET-2");
    ASSERT_FALSE(opened->notices.empty());
    EXPECT_NE(opened->notices[0].find("its parts are on CUT and its sheets on SHEET"), std::string::npos);
    // What was asked for counts.
    PartOptions options;
    options.drawing.take = {"DEFECT"};
    const auto defect = read_any_layout(made.files.at(0).bytes, "out", options);
    ASSERT_TRUE(defect) << defect.error().message;
    ASSERT_EQ(defect->document.parts.size(), 1U);  // one a sheet, and they are equal
    EXPECT_EQ(defect->document.parts[0].demand, 2);
    EXPECT_TRUE(defect->document.stocks.empty());
  }
}

TEST(LayoutExport, DxfReadAgainHasEveryLayerWithTrueArcs) {
  const layout::Document document = document_of(sample());
  for (const char* unit : {"mm", "inch"}) {
    const Exported made = exported(document, ExportForm::dxf, {{"unit", unit}});
    ASSERT_EQ(made.files.size(), 1U);
    const auto drawing = parse_dxf(made.files[0].bytes, "out.dxf");
    ASSERT_TRUE(drawing) << drawing.error().message;
    EXPECT_EQ(drawing->notices, std::vector<std::string>{}) << unit;
    EXPECT_EQ(drawing->millimetres_per_unit, unit == std::string("mm") ? 1 : 25.4);
    expect_sample(by_layer(*drawing));
    EXPECT_TRUE(drawing->unread.empty());
    EXPECT_EQ(drawing->texts.size(), 7U);  // five parts, two sheets
  }
}

TEST(LayoutExport, SvgReadAgainIsTheSame) {
  const Exported made = exported(document_of(sample()), ExportForm::svg, {});
  const auto drawing = parse_svg(made.files[0].bytes, "out.svg");
  ASSERT_TRUE(drawing) << drawing.error().message;
  expect_sample(by_layer(*drawing));
  EXPECT_NE(made.files[0].bytes.find("Диск 2"), std::string::npos);
}

TEST(LayoutExport, PlacedArcsLieWithinTheirToleranceOfTheCheckedOutlineAndPolygonsAreIt) {
  const layout::Document document = document_of(sample());
  const Exported made = exported(document, ExportForm::dxf, {{"sheet", "s#1"}, {"only", "CUT"}});
  const auto drawing = parse_dxf(made.files[0].bytes, "out.dxf");
  ASSERT_TRUE(drawing);
  DrawingOptions options;
  const auto regions = make_regions(*drawing, options);
  ASSERT_TRUE(regions);
  ASSERT_EQ(regions->regions.size(), 4U);
  for (const layout::Placement& placement : document.placements) {
    if (placement.copy != 0) continue;
    const layout::Part& part = document.parts[placement.part];
    const geom::GridRegion outline = placed_outline(part, placement);
    // The one whose box is the same within a tenth of a millimetre.
    const geom::GridBox box = bounds(outline);
    std::size_t found = 0;
    for (const auto& one : regions->regions) {
      const geom::Box drawn = geom::bounds(one.outer);
      if (geom::norm(drawn.low - geom::mm_from_grid(box.low)) > 0.1 ||
          geom::norm(drawn.high - geom::mm_from_grid(box.high)) > 0.1)
        continue;
      ++found;
      const bool round = !part.outline.curves.empty();
      double inside = 0;
      for (const geom::GridPoint p : outline.points) {
        const geom::Point mm = geom::mm_from_grid(p);
        const double off = double(cases::distance_to_boundary({mm.x, mm.y}, one));
        inside = std::max(inside, off);
        if (!round) {
          EXPECT_EQ(off, 0);
        }
      }
      EXPECT_LE(inside, part.outline.chord_tolerance_mm + 1e-5);
      if (round) {
        EXPECT_GT(inside, 0);
      }
    }
    EXPECT_EQ(found, 1U) << "placement " << placement.id;
  }
}

TEST(LayoutExport, CurvesThatAreNotWhatThePolygonSaysAreNotWritten) {
  layout::Document document = document_of(sample());
  document.parts[1].outline.curves[0].outer = cases::circle_contour({0.001, 0}, 8);
  const Exported made = exported(document, ExportForm::dxf, {{"only", "CUT"}});
  ASSERT_EQ(made.notes.size(), 1U);
  EXPECT_NE(made.notes[0].find("part disc: its polygon is not what its curves give"), std::string::npos);
  EXPECT_EQ(by_layer(*parse_dxf(made.files[0].bytes, "out.dxf")).at("CUT").arcs, 3U);
}

/// Pen to lines of plotter units, read by the rules of the language alone.
struct Plot {
  struct Line {
    int pen = 0;
    std::vector<std::pair<long, long>> points;
  };
  std::vector<Line> lines;
  std::vector<std::string> labels;
};
Plot read_plot(const std::string& text) {
  Plot plot;
  int pen = 0;
  std::pair<long, long> at{0, 0};
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == ';' || text[i] == '\n') {
      ++i;
      continue;
    }
    const std::string code = text.substr(i, 2);
    i += 2;
    if (code == "LB") {
      const std::size_t end = text.find('\x03', i);
      plot.labels.push_back(text.substr(i, end - i));
      i = end + 1;
      continue;
    }
    const std::size_t end = text.find(';', i);
    EXPECT_NE(end, std::string::npos) << code;
    std::string numbers = text.substr(i, end - i);
    i = end + 1;
    std::replace(numbers.begin(), numbers.end(), ',', ' ');
    std::istringstream stream(numbers);
    std::vector<double> values;
    for (double v = 0; stream >> v;) values.push_back(v);
    if (code == "SP") {
      pen = static_cast<int>(values.at(0));
    } else if (code == "PU" || code == "PD") {
      EXPECT_EQ(values.size() % 2, 0U);
      if (code == "PD") plot.lines.push_back({pen, {at}});
      for (std::size_t k = 0; k + 1 < values.size(); k += 2) {
        at = {static_cast<long>(values[k]), static_cast<long>(values[k + 1])};
        if (code == "PD") plot.lines.back().points.push_back(at);
      }
    } else {
      EXPECT_TRUE(code == "IN" || code == "PA" || code == "SI" || code == "LO") << code;
    }
  }
  return plot;
}

TEST(LayoutExport, HpglReadAgainHasTheAreasWithinItsBound) {
  const Exported made = exported(document_of(sample()), ExportForm::hpgl, {{"tolerance", "0.05"}});
  ASSERT_EQ(made.files.size(), 2U);
  EXPECT_EQ(made.files[0].sheet, "s#1");
  EXPECT_EQ(made.files[1].sheet, "s#3");
  const Plot plot = read_plot(made.files[0].bytes);
  std::map<int, double> area, length;
  std::map<int, std::size_t> count;
  for (const Plot::Line& line : plot.lines) {
    ++count[line.pen];
    for (std::size_t k = 0; k + 1 < line.points.size(); ++k) {
      const auto [ax, ay] = line.points[k];
      const auto [bx, by] = line.points[k + 1];
      area[line.pen] += 0.025 * 0.025 * (double(ax) * double(by) - double(ay) * double(bx)) / 2;
      length[line.pen] += 0.025 * std::hypot(bx - ax, by - ay);
    }
    if (line.pen != 2) {
      EXPECT_EQ(line.points.front(), line.points.back());
    }
  }
  EXPECT_EQ(count[1], 6U);  // 4 outlines, 2 holes
  EXPECT_EQ(count[2], 1U);  // the grain of the washer
  EXPECT_EQ(count[4], 1U);
  const double off = 0.05 + 0.018;
  EXPECT_NEAR(area[1], kWasher + kDisc + kHalf + kPlate, off * length[1]);
  EXPECT_LT(area[1],
            kWasher + kDisc + kHalf + kPlate);  // chords of convex arcs lie inside; the hole's are fewer
  EXPECT_NEAR(area[4], 10000, 1e-6);
  EXPECT_EQ(plot.labels, (std::vector<std::string>{"???? 2", "washer 1", "d 3", "plate 4"}));
  // The disc in the washer's hole is cut before the washer, holes before outlines.
  EXPECT_LT(made.files[0].bytes.find("LB???? 2"), made.files[0].bytes.find("LBwasher 1"));
}

TEST(LayoutExport, GcodeOfEachSheetNamesItsPlacements) {
  const Exported made = exported(document_of(sample()), ExportForm::gcode,
                                 {{"kerf", "0.2"}, {"feed", "900"}, {"lead-in", "1"}});
  ASSERT_EQ(made.files.size(), 2U);
  const std::string& first = made.files[0].bytes;
  for (const char* id : {"(PLACEMENT 1 HOLE 1)", "(PLACEMENT 1 OUTLINE)", "(PLACEMENT 2 OUTLINE)",
                         "(PLACEMENT 3 OUTLINE)", "(PLACEMENT 4 HOLE 1)"})
    EXPECT_NE(first.find(id), std::string::npos) << id;
  EXPECT_EQ(first.find("PLACEMENT 5"), std::string::npos);
  EXPECT_LT(first.find("(PLACEMENT 2 OUTLINE)"), first.find("(PLACEMENT 1 HOLE 1)"));
  EXPECT_LT(first.find("(PLACEMENT 1 HOLE 1)"), first.find("(PLACEMENT 1 OUTLINE)"));
  EXPECT_NE(first.find("G2 "), std::string::npos);
  EXPECT_NE(made.files[1].bytes.find("PLACEMENT 5"), std::string::npos);
}

TEST(LayoutExport, AStripIsAsLongAsItIsUsed) {
  Json layout = cases::empty_layout();
  layout["stocks"][0] = {{"id", "s"}, {"kind", "strip"}, {"height", 50}};
  add_part(layout, "p", outline_json(rectangle(0, 0, 30, 20)));
  place(layout, "p", 12, 5);
  const Exported made = exported(document_of(layout), ExportForm::dxf, {});
  EXPECT_NEAR(by_layer(*parse_dxf(made.files[0].bytes, "out.dxf")).at("SHEET").area, 42 * 50, 1e-9);
}

TEST(LayoutExport, WordsThatWillNotDoAreRefusedInOneSentence) {
  struct Case {
    ExportForm form;
    std::vector<ExportWord> words;
    const char* says;
  };
  const ExportWord kerf{"kerf", "0.2"}, feed{"feed", "900"};
  const Case wrong[] = {
      {ExportForm::gcode, {}, "--kerf is missing"},
      {ExportForm::gcode, {kerf}, "--feed is missing"},
      {ExportForm::gcode, {{"kerf", "0"}, feed}, "--kerf 0: has to be a number from 0.01 to 100"},
      {ExportForm::gcode, {{"kerf", "nan"}, feed}, "--kerf nan"},
      {ExportForm::gcode, {{"kerf", "0.2mm"}, feed}, "--kerf 0.2mm"},
      {ExportForm::gcode, {{"kerf", ""}, feed}, "--kerf "},
      {ExportForm::gcode, {kerf, {"feed", "1e99"}}, "--feed 1e99"},
      {ExportForm::gcode, {kerf, feed, {"post", "heidenhain"}}, "has to be one of linuxcnc, grbl, fanuc"},
      {ExportForm::gcode, {kerf, feed, {"tolerance", "0.1"}}, "at most a quarter of the kerf"},
      {ExportForm::gcode, {kerf, feed, {"depth", "3"}}, "--process router"},
      {ExportForm::gcode, {kerf, feed, {"process", "router"}}, "--speed is missing"},
      {ExportForm::gcode, {kerf, feed, {"process", "router"}, {"speed", "9"}}, "--depth is missing"},
      {ExportForm::gcode, {kerf, feed, {"post", "grbl"}}, "the beam stays dark"},
      {ExportForm::gcode, {kerf, feed, {"only", "CUT"}}, "--only has no meaning for the form gcode"},
      {ExportForm::dxf, {kerf}, "--kerf has no meaning for the form dxf"},
      {ExportForm::dxf, {{"unit", "cm"}}, "has to be one of mm, inch"},
      {ExportForm::dxf, {{"only", "CUT,cut"}}, "the layers are CUT, MARK"},
      {ExportForm::dxf, {{"only", "CUT,"}}, "the layers are CUT, MARK"},
      {ExportForm::svg, {{"unit", "mm"}}, "--unit has no meaning for the form svg"},
      {ExportForm::hpgl, {{"tolerance", "-1"}}, "--tolerance -1"},
      {ExportForm::hpgl, {{"colour", "red"}}, "there is no option --colour"},
  };
  for (const Case& one : wrong) {
    const auto request = read_export_words(one.form, one.words, "--");
    ASSERT_FALSE(request) << one.says;
    EXPECT_EQ(request.error().code, ErrorCode::usage);
    EXPECT_NE(request.error().message.find(one.says), std::string::npos) << request.error().message;
  }
}

TEST(LayoutExport, LayoutsThatWillNotDoAreRefusedInOneSentence) {
  const auto trouble = [](const Json& layout, ExportForm form, const std::vector<ExportWord>& words) {
    const auto request = read_export_words(form, words, "--");
    if (!request) return request.error().message;
    const auto made = export_layout(document_of(layout), "x", *request);
    return made ? std::string("none") : made.error().message;
  };
  const std::vector<ExportWord> cut{{"kerf", "0.2"}, {"feed", "900"}};
  Json layout = sample();
  EXPECT_NE(trouble(layout, ExportForm::dxf, {{"sheet", "t"}}).find("there is no sheet t"),
            std::string::npos);
  for (const char* copy : {"s#0", "s#4", "s#", "s#1x", "s#99999999999999999999"})
    EXPECT_NE(trouble(layout, ExportForm::dxf, {{"sheet", copy}}).find("there is no sheet s#"),
              std::string::npos)
        << copy;
  EXPECT_NE(trouble(layout, ExportForm::gcode, {cut[0], cut[1], {"sheet", "s#2"}}).find("no part to cut"),
            std::string::npos);
  EXPECT_EQ(trouble(layout, ExportForm::dxf, {{"sheet", "s#2"}}), "none");  // an empty sheet may be drawn
  EXPECT_NE(trouble(layout, ExportForm::dxf, {{"sheet", "s#2"}, {"only", "CUT"}}).find("nothing to write"),
            std::string::npos);
  place(layout, "plate", 20.5, 60.5, 10);
  EXPECT_NE(trouble(layout, ExportForm::gcode, cut).find("placements 4 and 6 overlap"), std::string::npos);
  layout["placements"] = Json::array();
  EXPECT_NE(trouble(layout, ExportForm::svg, {}).find("nothing is placed"), std::string::npos);
  place(layout, "plate", 0, 0);
  place(layout, "plate", 30.15, 0);
  EXPECT_NE(
      trouble(layout, ExportForm::gcode, cut).find("placements 1 and 2 are too near for the kerf of 0.2 mm"),
      std::string::npos);
  place(layout, "plate", 300000, 0);
  EXPECT_NE(trouble(layout, ExportForm::hpgl, {}).find("further than plotters count"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::io::io_layout_export_test

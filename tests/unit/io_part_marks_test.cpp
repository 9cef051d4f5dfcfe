#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "lekalo/io/formats/part_file.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/layout_json.hpp"

/// What lies inside a part goes with it: from a drawing to a layout, and from an export back.
namespace lekalo::io::io_part_marks_test {
namespace {

using layout::MarkRole;

std::string line(double x0, double y0, double x1, double y1, const std::string& look = "8\nCUT\n") {
  return fmt::format("0\nLINE\n{}10\n{}\n20\n{}\n11\n{}\n21\n{}\n", look, x0, y0, x1, y1);
}
std::string square(double x, double y, double side, const std::string& look = "8\nCUT\n") {
  return line(x, y, x + side, y, look) + line(x + side, y, x + side, y + side, look) +
         line(x + side, y + side, x, y + side, look) + line(x, y + side, x, y, look);
}
std::string text(double x, double y, const std::string& letters,
                 const std::string& look = "8\nNOTE\n62\n5\n") {
  return fmt::format("0\nTEXT\n{}10\n{}\n20\n{}\n40\n3\n1\n{}\n", look, x, y, letters);
}
std::string drawing(const std::string& entities) {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" + entities +
         "0\nENDSEC\n0\nEOF\n";
}

/// A square with a hole, a square of engraving, a dashed line, a line outside a layer's rule, and texts.
const std::string kPlate =
    drawing(square(0, 0, 100) + square(10, 10, 20) + square(40, 10, 20, "8\nENG\n62\n1\n") +
            line(0, 50, 100, 50, "8\nCUT\n6\nDASHED\n") + line(5, 60, 30, 60) + text(10, 80, "Жук") +
            text(10, 70, "skip", "8\nDIM\n") + line(5, 90, 9, 90, "8\nDIM\n") + text(300, 0, "title"));

PartsFile read(const std::string& bytes, const std::string& rows = "") {
  PartOptions options;
  if (!rows.empty()) {
    auto rules = read_layer_rules(R"({"format": "lekalo-layers/1", "layers": [)" + rows + "]}", "shop.json");
    if (!rules) throw std::logic_error(rules.error().message);
    options.layer_rules = *std::move(rules);
  }
  auto file = read_parts(bytes, "plate.dxf", options);
  if (!file) throw std::logic_error(file.error().message);
  return *std::move(file);
}

std::string told(const layout::Part& part) {
  constexpr const char* kRoles[] = {"mark", "engrave", "bend", "cut"};
  std::string said = fmt::format("{} holes", part.outline.polygon.loops() - 1);
  for (const layout::PartMark& mark : part.marks)
    said += fmt::format("; {} {} {} of {}", kRoles[static_cast<int>(mark.role)], mark.layer, mark.colour,
                        mark.edges.size());
  for (const layout::PartText& one : part.texts)
    said += fmt::format("; {} {} {} '{}' at {},{}", kRoles[static_cast<int>(one.role)], one.layer, one.colour,
                        one.text, one.at.x, one.at.y);
  return said;
}

TEST(PartMarks, WithoutRulesOpenLinesAndTextsAreMarks) {
  const PartsFile file = read(kPlate);
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(told(file.parts[0]),
            "2 holes; mark CUT  of 1; mark CUT  of 1; mark DIM  of 1; "
            "mark NOTE #0000ff 'Жук' at 10,80; mark DIM  'skip' at 10,70");
  std::string notices;
  for (const std::string& notice : file.notices) notices += notice + "\n";
  EXPECT_NE(notices.find("plate.dxf: 2 texts are kept on their parts"), std::string::npos) << notices;
  EXPECT_NE(
      notices.find("plate.dxf: 1 text lies on no part and is left out, the first is 'title' at (300, 0) mm"),
      std::string::npos)
      << notices;
}

TEST(PartMarks, RulesSayWhatALayerIs) {
  const PartsFile file = read(kPlate,
                              R"({"name": "eng", "colour": "#ff0000", "role": "engrave"},
                                 {"line_type": "dashed", "role": "bend"}, {"name": "DIM", "role": "ignore"},
                                 {"name": "NOTE", "role": "engrave"}, {"name": "CUT", "role": "cut"})");
  ASSERT_EQ(file.parts.size(), 1U);
  EXPECT_EQ(told(file.parts[0]),
            "1 holes; cut CUT  of 1; engrave ENG #ff0000 of 1; engrave ENG #ff0000 of 1; "
            "engrave ENG #ff0000 of 1; engrave ENG #ff0000 of 1; bend CUT  of 1; "
            "engrave NOTE #0000ff 'Жук' at 10,80");
  EXPECT_NE(std::find(file.notices.begin(), file.notices.end(),
                      "plate.dxf: 1 line and 1 text are on layers that shop.json says to ignore"),
            file.notices.end());
}

TEST(PartMarks, PartsThatDifferInATextAreTwo) {
  const std::string two =
      drawing(square(0, 0, 100) + square(200, 0, 100) + text(10, 10, "A") + text(210, 10, "B"));
  EXPECT_EQ(read(two).parts.size(), 2U);
  const std::string same =
      drawing(square(0, 0, 100) + square(200, 0, 100) + text(10, 10, "A") + text(210, 10, "A"));
  ASSERT_EQ(read(same).parts.size(), 1U);
  EXPECT_EQ(read(same).parts[0].demand, 2);
}

bool same_layer_of_exports(const std::string& layer) { return layer == "CUT" || layer == "cut"; }

TEST(PartMarks, AnExportReadAgainHasThemAll) {
  layout::Document document;
  document.stocks.emplace_back();
  document.stocks[0].id = "s";
  document.stocks[0].outline.polygon =
      *geom::make_grid_region({{{0, 0}, {1 << 29, 0}, {1 << 29, 1 << 29}, {0, 1 << 29}}});
  document.parts =
      read(kPlate, R"({"name": "ENG", "role": "engrave"}, {"name": "DIM", "role": "mark"})").parts;
  for (layout::PartMark& mark : document.parts[0].marks) mark.colour = "#112233";
  for (layout::PartText& one : document.parts[0].texts) one.colour = "#112233";
  document.parts[0].marks[0].layer = "cut";  // a layer of exports, in either case
  document.placements.push_back(
      {1, 0, 0, 0, geom::rotation_from_degrees(0), false, {1 << 20, 1 << 20}, false});
  for (const auto form : {ExportForm::dxf, ExportForm::svg}) {
    ExportRequest request;
    request.form = form;
    const auto made = export_layout(document, "x", request);
    ASSERT_TRUE(made.has_value()) << made.error().message;
    const PartsFile again = read(made->files[0].bytes);
    ASSERT_EQ(again.parts.size(), 1U);
    const layout::Part &was = document.parts[0], &is = again.parts[0];
    ASSERT_EQ(is.marks.size(), was.marks.size());
    for (std::size_t i = 0; i < is.marks.size(); ++i) {
      EXPECT_EQ(is.marks[i].layer, same_layer_of_exports(was.marks[i].layer) ? "INSIDE" : was.marks[i].layer);
      EXPECT_EQ(is.marks[i].colour, was.marks[i].colour);
      EXPECT_EQ(is.marks[i].edges.front().from, was.marks[i].edges.front().from + (geom::Point{1, 1}));
    }
    // Texts of SVG are not read.
    ASSERT_EQ(is.texts.size(), form == ExportForm::dxf ? was.texts.size() : 0U);
    for (std::size_t i = 0; i < is.texts.size(); ++i) {
      layout::PartText moved = was.texts[i];
      moved.at = moved.at + (geom::Point{1, 1});
      moved.role = MarkRole::mark;
      EXPECT_EQ(is.texts[i], moved);
    }
  }
}

}  // namespace
}  // namespace lekalo::io::io_part_marks_test

// The drawings of other programs and people, held against what ezdxf and svgelements find in them
// (tests/corpus/drawings.csv, written by tests/support/drawings_oracle.py).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "io/formats/engraving.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "support/shared_data.hpp"

namespace lekalo::io {
namespace {

struct Row {
  std::string file, sha256, verdict;
  double enclosed_mm2 = 0, outline_mm = 0;
};

/// Cells may stand in quotes, which double inside.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"')
      quoted = !quoted;
    else if (c == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += c;
  }
  return cells;
}

std::vector<Row> rows() {
  std::ifstream in(cases::source_dir() + "/tests/corpus/drawings.csv");
  std::vector<Row> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    const auto cells = cells_of(line);
    if (cells.size() != 9) ADD_FAILURE() << line;
    const auto number = [](const std::string& text) { return text.empty() ? 0 : std::stod(text); };
    rows.push_back({cells[0], cells[1], cells[2], number(cells[7]), number(cells[8])});
  }
  return rows;
}

/// The diagonal of a box around the points that a curve is written with.
double size_of(const Shape& shape) {
  std::vector<geom::Point> points;
  if (const auto* edge = std::get_if<geom::Edge>(&shape)) points = {edge->from, edge->to};
  if (const auto* spline = std::get_if<Spline>(&shape)) points = spline->poles;
  if (const auto* arc = std::get_if<EllipseArc>(&shape))
    points = {arc->centre + arc->u, arc->centre - arc->u};
  geom::Point low = points.front(), high = low;
  for (const geom::Point& p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return geom::norm(high - low);
}

class Drawings : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = cases::shared_data();
    if (folder_.empty()) GTEST_SKIP() << "the drawings are kept outside the project, and are not here";
  }
  [[nodiscard]] std::string bytes_of(const Row& row) const {
    const auto bytes = disk::read_file(folder_ + "/" + row.file);
    EXPECT_TRUE(bytes.has_value()) << row.file;
    return bytes.value_or("");
  }
  std::string folder_;
};

TEST_F(Drawings, GiveLayoutsWhereTheyEncloseSomethingAndOneSentenceElsewhere) {
  std::size_t enclosing = 0, given = 0, parts = 0, marks = 0, files = 0;
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.file);
    const std::string bytes = bytes_of(row);
    EXPECT_EQ(sha256(bytes).substr(0, 16), row.sha256) << "another file than the table was made from";
    const auto read = read_any_layout(bytes, row.file);
    ++files;
    if (!read) {
      EXPECT_EQ(read.error().code, ErrorCode::bad_input);
      EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
      EXPECT_EQ(read.error().message.rfind(row.file, 0), 0u) << read.error().message;
    }
    if (row.verdict == "encloses") {
      ++enclosing;
      given += read ? 1 : 0;
      if (!read) std::printf("no layout: %s\n", read.error().message.c_str());
    } else if (row.verdict != "unknown") {
      ASSERT_FALSE(read.has_value()) << "nothing is enclosed";
    }
    if (read)
      for (const layout::Part& part : read->document.parts) {
        parts += static_cast<std::size_t>(part.demand);
        marks += part.marks.size() * static_cast<std::size_t>(part.demand);
      }
  }
  std::printf("%zu files, %zu enclose something, %zu layouts, %zu pieces, %zu marks\n", files, enclosing,
              given, parts, marks);
  EXPECT_GE(files, 170u);
  EXPECT_GE(static_cast<double>(given), 0.98 * static_cast<double>(enclosing));
}

TEST_F(Drawings, EveryCurveEndsInAPartAMarkOrOnTheList) {
  std::size_t all = 0, mended = 0, lost = 0;
  for (const Row& row : rows()) {
    SCOPED_TRACE(row.file);
    const std::string bytes = bytes_of(row);
    const DrawingFormat* format = drawing_format_by_content(bytes);
    ASSERT_NE(format, nullptr);
    const auto drawing = format->parse(bytes, row.file, std::nullopt);
    if (!drawing) continue;
    const auto drawn = make_regions(*drawing);
    if (!drawn) continue;
    std::vector<bool> kept(drawing->curves.size(), false);
    const auto keep = [&](const std::vector<std::uint32_t>& curves) {
      for (const std::uint32_t curve : curves) kept.at(curve) = true;
    };
    keep(drawn->curve_of_edge), keep(drawn->duplicates), keep(drawn->specks);
    for (const Mark& mark : drawn->marks) keep(mark.curve_of_edge);
    for (const SetAside& one : drawn->set_aside) keep(one.curves);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      ++all;
      if (kept[i] || drawing->layers[drawing->curves[i].layer].hidden) continue;
      // A mend takes off what is no larger than itself.
      if (size_of(drawing->curves[i].shape) <= DrawingOptions{}.repair) {
        ++mended;
        continue;
      }
      ++lost;
      const DrawnEntity& entity = drawing->entities[drawing->curves[i].entity];
      std::printf("%s: the %s at line %zu is in no part, mark or list\n", row.file.c_str(),
                  entity.type.c_str(), entity.line);
    }
  }
  std::printf("%zu curves, %zu taken off by mends, %zu lost\n", all, mended, lost);
  EXPECT_EQ(lost, 0u);
}

TEST_F(Drawings, WhatIsEnclosedIsWhatAnotherLibraryEncloses) {
  std::size_t compared = 0, agree = 0;
  for (const Row& row : rows()) {
    if (row.verdict != "encloses") continue;
    SCOPED_TRACE(row.file);
    const std::string bytes = bytes_of(row);
    const auto drawing = drawing_format_by_content(bytes)->parse(bytes, row.file, std::nullopt);
    if (!drawing) continue;
    const auto drawn = make_regions(*drawing);
    if (!drawn) continue;
    // Outer contours that lie in no other one: everything that is enclosed, holes filled.
    double area = 0;
    std::vector<geom::RegionIndex> outers;
    std::vector<double> areas;
    for (const geom::Region& region : drawn->regions) {
      outers.emplace_back(std::vector<geom::Region>{{region.outer, {}}});
      areas.push_back(geom::signed_area(region.outer));
    }
    for (std::size_t i = 0; i < outers.size(); ++i) {
      bool inner = false;
      for (std::size_t j = 0; j < outers.size() && !inner; ++j)
        inner = areas[j] > areas[i] && outers[j].contains(drawn->regions[i].outer.front().from);
      if (!inner) area += areas[i];
    }
    ++compared;
    // The other library's chords are within 0.002 mm, and it joins ends as far apart as mends may be.
    const double allowed = (drawn->tolerance + 0.004) * row.outline_mm + 0.05;
    const bool same = std::abs(area - row.enclosed_mm2) <= allowed;
    agree += same ? 1 : 0;
    if (!same)
      std::printf("%s: %.3f mm2, the other library %.3f, allowed %.3f\n", row.file.c_str(), area,
                  row.enclosed_mm2, allowed);
  }
  std::printf("%zu of %zu enclose what the other library encloses\n", agree, compared);
  EXPECT_GE(static_cast<double>(agree), 0.9 * static_cast<double>(compared));
}

}  // namespace
}  // namespace lekalo::io

// The drawings of other programs and people, held against what ezdxf and svgelements find in them
// (tests/corpus/drawings.csv, written by tests/support/drawings_oracle.py).

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/formats/any_layout.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "support/shared_data.hpp"

namespace lekalo::io::drawings_test {
namespace {

struct Row {
  std::string file, sha256, verdict;
  double enclosed = 0,
         outline = 0;  ///< mm2 of everything that the curves enclose, holes filled, and mm around it
};

/// Drawings of which parts do not cover all that the curves enclose, and why.
const std::map<std::string, std::string> kOtherAreas{
    {"drawings/ezdxf/3dface.dxf", "a field between closed outlines, of which one line alone is drawn"},
    {"drawings/ezdxf/columns_R2018.dxf", "a frame whose end lies on a curve"},
    {"drawings/ezdxf/custom_blocks.dxf", "holes that touch the outline all around leave segments"},
    {"drawings/ezdxf/multi_insert_with_attribs.dxf",
     "the oracle closes 15 of 25 flags: ends of the others lie beside their poles by rounding"},
    {"drawings/ezdxf/text_alignments.dxf", "circles about crosses, in which ends lie on curves"},
    {"drawings/ezdxf/text_mirror_true_type_font.dxf", "frames whose ends lie on curves"},
    {"drawings/ezdxf/text_oblique_rotate.dxf", "frames whose ends lie on curves"},
    {"drawings/ezdxf/text_stacked_true_type_font.dxf", "frames whose ends lie on curves"},
    {"drawings/ezdxf/uncommon.dxf", "ends on the inside of other curves"},
    {"drawings/ezdxf/xclip.dxf", "outlines that overlap with holes in common, and clipped copies"},
    {"dxf/squareandcircle.dxf", "a hole that touches the outline all around leaves its corners"},
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
    rows.push_back({cells[0], cells[1], cells[2], std::atof(cells[7].c_str()), std::atof(cells[8].c_str())});
  }
  return rows;
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
    } else if (row.verdict != "unknown" && row.verdict != "beyond") {
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

/// The area of all regions together, holes filled.
double covered(const std::vector<geom::Region>& regions) {
  std::vector<geom::Region> filled;
  for (const geom::Region& region : regions) filled.push_back({region.outer, {}});
  const auto all = geom::united(filled);
  EXPECT_TRUE(all.has_value());
  double area = 0;
  if (all)
    for (const geom::Region& region : all->regions) area += geom::signed_area(region.outer);
  return area;
}

TEST_F(Drawings, CoverWhatTheirCurvesEnclose) {
  std::size_t compared = 0, others = 0;
  for (const Row& row : rows()) {
    if (row.verdict != "encloses") continue;
    SCOPED_TRACE(row.file);
    const std::string bytes = bytes_of(row);
    const DrawingFormat* const format = drawing_format_by_content(bytes);
    const auto drawing = format == nullptr ? Result<Drawing>(failure(ErrorCode::bad_input, "no drawing"))
                                           : format->parse(bytes, row.file, std::nullopt);
    const auto made =
        drawing ? make_regions(*drawing) : Result<DrawnRegions>(tl::unexpected(drawing.error()));
    if (!made) continue;  // the test above counts these
    ++compared;
    const double area = covered(made->regions);
    // The other reader joins within 0.2 mm and flattens within 0.005.
    const double within = row.outline * (made->tolerance + 0.015) + 1e-6 * row.enclosed + 0.5;
    const bool agrees = std::abs(area - row.enclosed) <= within;
    others += agrees ? 0 : 1;
    if (!agrees) std::printf("%s: %.1f of %.1f mm2\n", row.file.c_str(), area, row.enclosed);
    EXPECT_EQ(agrees, kOtherAreas.count(row.file) == 0) << area << " of " << row.enclosed << " mm2";
  }
  std::printf("%zu compared, %zu cover otherwise, each with its reason\n", compared, others);
  EXPECT_GE(compared, 135u);
}

}  // namespace
}  // namespace lekalo::io::drawings_test

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "support/cases.hpp"
#include "support/drawn.hpp"
#include "support/json.hpp"
#include "support/places.hpp"
#include "support/shared_data.hpp"

// The layouts that `lekalo new` writes, against rasters that rsvg and ezdxf's drawing add-on make of the same
// drawings (tests/support/drawings_raster.py says how): both ways, so that a part, a mark or a lost curve
// that is not where the drawing has it is told, and what they enclose. A seeded draw of the drawings of the
// project and of LEKALO_SHARED_DATA/drawings; LEKALO_CASES=1000 takes all. It prints a line for each.

namespace lekalo::drawings_raster_test {
namespace {

namespace fs = std::filesystem;
using cases::Json;

/// Drawings that the rasters show otherwise, or that the others cannot read, and why.
const std::map<std::string, std::string> kOtherwise{
    {"dxf/array-rotated.dxf", "ezdxf refuses an INSERT of scale 0 along z"},
    {"dxf/arrayed-holes.dxf", "ezdxf refuses an INSERT of scale 0 along z"},
    {"dxf/blocks2.dxf", "ezdxf refuses an INSERT of scale 0 along z"},
    {"ezdxf/dimension_in_nested_blocks.dxf",
     "ezdxf draws dimensions in blocks as lines, and they are named as not read"},
    {"ezdxf/mtext_framed_columns.dxf",
     "ezdxf draws none of the frames of columns, which are lines in a block"},
    {"shops/henny-penny.svg", "a font without a page: nobody says where its corner is"},
};

std::vector<std::string> drawings() {
  const std::string project = cases::source_dir();
  std::vector<std::string> folders{project + "/examples/drawings"};
  for (const char* name : {"contours", "dxf", "dxf_styles", "svg"})
    folders.push_back(project + "/tests/corpus/data/" + name);
  if (!cases::shared_data().empty()) folders.push_back(cases::shared_data() + "/drawings");
  std::vector<std::string> files;
  for (const std::string& folder : folders) {
    std::vector<std::string> here;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      std::string ending = entry.path().extension().string();
      for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 'a' - 'A') : c;
      if (ending == ".dxf" || ending == ".svg") here.push_back(entry.path().string());
    }
    std::sort(here.begin(), here.end());
    files.insert(files.end(), here.begin(), here.end());
  }
  return files;
}

/// The interpreter that has what the rasters need; empty where none has.
std::string python() {
  for (const char* one : {"python3", "/usr/bin/python3"}) {
    const std::string probe = fmt::format("{} -B {}/tests/support/drawings_raster.py probe >/dev/null 2>&1",
                                          one, cases::source_dir());
    if (std::system(probe.c_str()) == 0) return one;
  }
  return {};
}

Json as_json(const geom::Edge& edge) {
  Json numbers{edge.from.x, edge.from.y, edge.to.x, edge.to.y};
  if (edge.kind != geom::EdgeKind::line)
    for (const double number :
         {edge.centre.x, edge.centre.y, edge.kind == geom::EdgeKind::arc_ccw ? 1.0 : 0.0})
      numbers.push_back(number);
  return numbers;
}

Json as_json(const std::vector<geom::Edge>& edges) {
  Json list = Json::array();
  for (const geom::Edge& edge : edges) list.push_back(as_json(edge));
  return list;
}

/// The outlines in their places, and what the reader keeps loose; null where nothing is enclosed.
Json drawn(const std::string& file) {
  const auto bytes = disk::read_file(file);
  const io::DrawingFormat* const format = bytes ? io::drawing_format_by_content(*bytes) : nullptr;
  if (format == nullptr) return nullptr;
  const auto drawing = format->parse(*bytes, file, std::nullopt);
  if (!drawing) return nullptr;
  const io::DrawingOptions how;
  const auto made = io::make_regions(*drawing, how);
  if (!made) return nullptr;
  Json regions = Json::array(), loose = Json::array(), specks = Json::array();
  for (const geom::Region& region : made->regions) {
    Json edges = as_json(region.outer);
    for (const geom::Contour& hole : region.holes)
      for (const geom::Edge& edge : hole) edges.push_back(as_json(edge));
    regions.push_back(std::move(edges));
  }
  const io::DrawingRecord record = io::record_of(*drawing, how, *made);
  for (const io::Mark& mark : made->marks) loose.push_back(as_json(mark.edges));
  for (const io::SetAside& aside : made->set_aside) loose.push_back(as_json(aside.edges));
  for (const geom::Point& speck : record.specks)
    specks.push_back(as_json(geom::Edge{geom::EdgeKind::line, speck, speck, {}}));
  return {{"file", file},
          {"regions", regions},
          {"loose", loose},
          {"specks", specks},
          {"loose_error", record.loose_error}};
}

std::string name_of(const std::string& file) {
  const fs::path path(file);
  return (path.parent_path().filename() / path.filename()).string();
}

std::vector<Json> answers(const std::string& command) {
  std::vector<Json> lines;
  FILE* const pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return lines;
  std::string text;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), n);
  EXPECT_EQ(pclose(pipe), 0) << command;
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    lines.push_back(Json::parse(text.substr(at, end - at)));
  return lines;
}

TEST(DrawingsRaster, LayoutsAreWhereOthersDrawThem) {
  const std::string interpreter = python();
  if (interpreter.empty())
    GTEST_SKIP() << "needs librsvg2-bin, python3-ezdxf, python3-numpy and python3-pil (tools/setup.sh)";
  auto files = drawings();
  Random random(cases::seed());
  cases::shuffle(files, random);
  files.resize(std::min(files.size(), cases::case_count(16)));
  std::string pattern = (fs::temp_directory_path() / "lekalo-raster-XXXXXX").string();
  ASSERT_NE(mkdtemp(pattern.data()), nullptr);
  std::size_t enclosing = 0;
  {
    std::ofstream lines(pattern + "/drawn.jsonl");
    for (const std::string& file : files) {
      const Json one = drawn(file);
      if (one.is_null()) continue;
      lines << one.dump() << '\n';
      ++enclosing;
    }
  }
  const auto compared =
      answers(fmt::format("{} -B {}/tests/support/drawings_raster.py {} {}/drawn.jsonl {}", interpreter,
                          cases::source_dir(), cases::program(), pattern, pattern));
  fs::remove_all(pattern);
  ASSERT_EQ(compared.size(), enclosing);
  std::size_t agree = 0, others = 0, spoiled = 0, spoiled_told = 0, lost = 0, lost_told = 0, larger = 0,
              larger_told = 0;
  for (const Json& one : compared) {
    const std::string name = name_of(one["file"].get<std::string>());
    SCOPED_TRACE(name + ": " + one.dump());
    std::printf("%s: %s\n", name.c_str(), one.dump().c_str());
    if (one["verdict"] == "no layout") continue;
    const bool good = one["verdict"] == "compared" && one["off"] == 0 && one["bare"] == 0 &&
                      one["unplaced"].empty() && (one["aside"] == 0 || one["told_aside"] > 0) &&
                      std::abs(one["area_off"].get<double>()) <= one["area_may"].get<double>();
    EXPECT_EQ(good, kOtherwise.count(name) == 0);
    (good ? agree : others) += 1;
    if (one["verdict"] != "compared") continue;
    // A comparison that cannot fail says nothing: an edge half a millimetre beside itself, a part left out,
    // all outlines a little larger.
    for (const auto& [field, all, told] :
         {std::tuple{"spoiled_told", &spoiled, &spoiled_told}, std::tuple{"lost_told", &lost, &lost_told},
          std::tuple{"larger_told", &larger, &larger_told}}) {
      if (one[field].is_null()) continue;
      ++*all;
      *told += one[field].get<bool>() ? 1 : 0;
    }
  }
  std::printf(
      "%zu drawings, %zu enclose something, %zu agree, %zu differ; %zu of %zu spoiled edges, %zu of %zu lost "
      "parts and %zu of %zu outlines that are larger told\n",
      files.size(), enclosing, agree, others, spoiled_told, spoiled, lost_told, lost, larger_told, larger);
  EXPECT_GT(agree, 0U);
  EXPECT_GE(static_cast<double>(spoiled_told), 0.95 * static_cast<double>(spoiled));
  EXPECT_GE(static_cast<double>(lost_told), 0.95 * static_cast<double>(lost));
  EXPECT_GE(static_cast<double>(larger_told), 0.95 * static_cast<double>(larger));
}

}  // namespace
}  // namespace lekalo::drawings_raster_test

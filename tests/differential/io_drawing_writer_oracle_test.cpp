#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "lekalo/io/drawing_writer.hpp"
#include "lekalo/io/files.hpp"
#include "support/drawn_region_cases.hpp"

// Written DXF drawings as ezdxf and OGR see them (support/written_oracle.py, tools/setup.sh).

namespace lekalo::io {
namespace {

using geom::EdgeKind;
using nlohmann::json;

std::string python() {
  for (const char* name : {"python3", "/usr/bin/python3"})
    if (std::system(fmt::format("{} -c 'import ezdxf' 2>/dev/null", name).c_str()) == 0) return name;
  return {};
}

json seen_by_others(const std::string& interpreter, const std::string& file) {
  FILE* pipe = popen(
      fmt::format("{} {}/tests/support/written_oracle.py '{}'", interpreter, LEKALO_SOURCE_DIR, file).c_str(),
      "r");
  if (pipe == nullptr) return nullptr;
  std::string text;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), n);
  return pclose(pipe) == 0 ? json::parse(text, nullptr, false) : json(nullptr);
}

TEST(DrawingWriterOracle, EzdxfFindsNothingToRepairAndTheSameNumbers) {
  const std::string interpreter = python();
  ASSERT_FALSE(interpreter.empty()) << "python3-ezdxf is not installed (tools/setup.sh installs it)";
  const auto slot =
      cases::region_detail::region(cases::boolean_slot(10, 10, 30, 5), {cases::boolean_circle({20, 10}, 2)});
  auto regions = std::vector<LayeredRegion>{{slot, "Контур", {"CUT_INNER"}}};
  for (std::uint64_t index = 0; index < 20; ++index) {
    Random random(cases::seed(), 12000 + index);
    for (auto& region : cases::random_regions(random, index))
      regions.push_back({region, index % 2 == 0 ? "cut_inner" : "0", {}});
  }
  const auto text = dxf_drawing(regions);
  ASSERT_TRUE(text.has_value()) << text.error().message;
  const auto folder = std::filesystem::temp_directory_path() / "lekalo_drawing_writer_oracle";
  std::filesystem::create_directories(folder);
  const std::string file = (folder / "written.dxf").string();
  AtomicFiles files;
  ASSERT_TRUE(files.add(file, *text).has_value());
  ASSERT_TRUE(files.commit().has_value());
  const json seen = seen_by_others(interpreter, file);
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(seen.is_object()) << "written_oracle.py failed";
  EXPECT_EQ(seen["version"], "AC1021");  // for the Cyrillic name
  EXPECT_EQ(seen["insunits"], 4);
  EXPECT_EQ(seen["errors"], json::array());
  std::size_t k = 0;
  const auto check = [&](const geom::Contour& contour, const std::string& layer) {
    ASSERT_LT(k, seen["entities"].size());
    const json& entity = seen["entities"][k];
    EXPECT_EQ(entity["layer"], layer);
    if (seen["ogr"].is_array()) {
      const json& line = seen["ogr"][k];
      EXPECT_EQ(line["closed"], true);
      // OGR 3.6 takes names in files of 2007 for ISO 8859-1.
      EXPECT_TRUE(k == 0 || line["layer"] == layer);
      // OGR's arcs are polylines in steps of 4 degrees.
      const geom::Box box = geom::bounds(contour);
      const double size = norm(box.high - box.low),
                   corners[] = {box.low.x, box.low.y, box.high.x, box.high.y};
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(line["box"][i].get<double>(), corners[i], 1e-3 * size);
    }
    ++k;
    const geom::Edge& first = contour.front();
    if (first.from == first.to) {
      EXPECT_EQ(entity["type"], "CIRCLE");
      EXPECT_EQ(entity["centre"], json({first.centre.x, first.centre.y}));
      EXPECT_NEAR(entity["radius"].get<double>(), geom::arc_radius(first), 1e-12);
      return;
    }
    EXPECT_EQ(entity["type"], "LWPOLYLINE");
    EXPECT_EQ(entity["closed"], true);
    std::size_t v = 0;
    for (const geom::Edge& edge : contour) {
      const json& vertex = entity["vertices"][v++];
      EXPECT_EQ(vertex[0], edge.from.x);
      EXPECT_EQ(vertex[1], edge.from.y);
      const double bulge = vertex[2];
      if (edge.kind == EdgeKind::line) {
        EXPECT_EQ(bulge, 0);
        continue;
      }
      double sweep = std::abs(4 * std::atan(bulge));
      if (geom::arc_sweep(edge) > 5.3)
        sweep += std::abs(4 * std::atan(entity["vertices"][v++][2].get<double>()));
      EXPECT_NEAR(sweep, geom::arc_sweep(edge), 1e-9);
      EXPECT_EQ(bulge > 0, edge.kind == EdgeKind::arc_ccw);
    }
    EXPECT_EQ(v, entity["vertices"].size());
  };
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const auto& one = regions[i];
    // Names that differ in case are the first one's layer.
    const std::string layer = one.layer == "cut_inner" ? "CUT_INNER" : one.layer;
    check(one.region.outer, layer);
    for (const geom::Contour& hole : one.region.holes) check(hole, i == 0 ? "CUT_INNER" : layer);
  }
  EXPECT_EQ(k, seen["entities"].size());
}

}  // namespace
}  // namespace lekalo::io

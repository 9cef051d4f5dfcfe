#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "lekalo/io/layout/layout_export.hpp"
#include "support/cases.hpp"
#include "support/json.hpp"
#include "support/layout_documents.hpp"
#include "support/places.hpp"

// Exported drawings as ezdxf reads them: areas by layer against the outlines on the grid.

namespace lekalo::io::io_layout_export_oracle_test {
namespace {

using cases::Json;

std::string python() {
  for (const char* name : {"python3", "/usr/bin/python3"})
    if (std::system(fmt::format("{} -c 'import ezdxf' 2>/dev/null", name).c_str()) == 0) return name;
  return {};
}

Json listed(const std::string& interpreter, const std::string& text) {
  const auto path =
      std::filesystem::temp_directory_path() / fmt::format("lekalo_export_oracle_{}.dxf", getpid());
  std::ofstream(path, std::ios::binary) << text;
  FILE* pipe = popen(fmt::format("{} -B {}/tests/support/dxf_oracle.py ezdxf '{}'", interpreter,
                                 cases::source_dir(), path.string())
                         .c_str(),
                     "r");
  std::string said;
  std::array<char, 65536> buffer{};
  if (pipe != nullptr)
    for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
      said.append(buffer.data(), n);
  const bool fine = pipe != nullptr && pclose(pipe) == 0;
  std::filesystem::remove(path);
  return fine ? Json::parse(said)[path.string()] : Json(nullptr);
}

/// A circle has no direction in DXF, so the sums of ezdxf's areas count holes that are circles as material.
double area_as_listed(const geom::Region& region) {
  double area = geom::area(region);
  for (const geom::Contour& hole : region.holes)
    if (hole.size() == 1) area += 2 * std::abs(geom::signed_area(hole));
  return area;
}

TEST(LayoutExportOracle, EzdxfFindsTheOutlinesOnTheirLayers) {
  const std::string interpreter = python();
  ASSERT_FALSE(interpreter.empty()) << "python3-ezdxf is not installed (tools/setup.sh installs it)";
  std::size_t compared = 0, with_arcs = 0;
  for (std::uint64_t index = 0; index < cases::case_count(8); ++index) {
    const layout::Document document = cases::random_document(cases::seed(), 300 + index);
    const double per_unit = index % 2 == 0 ? 1 : 25.4;
    const auto request = read_export_words(ExportForm::dxf, {{"unit", index % 2 == 0 ? "mm" : "inch"}}, "");
    const auto made = export_layout(document, "random", *request);
    if (!made) continue;  // nothing placed, or too far away for the format
    const Json seen = listed(interpreter, made->files[0].bytes);
    ASSERT_TRUE(seen.is_array()) << "dxf_oracle.py failed";
    std::map<std::string, double> area, length;
    for (const Json& entry : seen) {
      area[entry["layer"]] += entry["area"].get<double>() * per_unit * per_unit;
      length[entry["layer"]] += entry["length"].get<double>() * per_unit;
    }
    double cut = 0, defects = 0, slack = 0;
    std::map<std::pair<std::uint32_t, std::int64_t>, bool> sheets;
    for (const layout::Placement& placement : document.placements) {
      const layout::Part& part = document.parts[placement.part];
      sheets[{placement.stock, placement.copy}] = true;
      if (part.outline.curves.empty()) {
        cut += geom::area_mm2(placed_outline(part, placement));
      } else {
        cut += area_as_listed(part.outline.curves[0]);
        ++with_arcs;
      }
      slack += 1;
    }
    for (const auto& [sheet, used] : sheets)
      for (const layout::Defect& defect : document.stocks[sheet.first].defects)
        defects += defect.outline.curves.empty() ? geom::area_mm2(defect.outline.polygon)
                                                 : area_as_listed(defect.outline.curves[0]);
    // Integrals of curves that lie metres from the origin lose digits.
    EXPECT_NEAR(area["CUT"], cut, 0.01 * slack) << "seed " << cases::seed() << " case " << index;
    EXPECT_NEAR(area["DEFECT"], defects, 0.01 * slack);
    ++compared;
  }
  EXPECT_GT(compared, cases::case_count(8) / 5);
  EXPECT_GT(with_arcs, 0U);
}

}  // namespace
}  // namespace lekalo::io::io_layout_export_oracle_test

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/drawing/written_drawing.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/svg/svg.hpp"
#include "support/drawn_measures.hpp"
#include "support/drawn_region_cases.hpp"
#include "support/json.hpp"
#include "support/places.hpp"

// Written drawings as others see them: DXF as ezdxf and OGR do, SVG as svgelements does
// (support/written_oracle.py, support/dxf_oracle.py, tools/setup.sh).

namespace lekalo::io::io_drawing_writer_oracle_test {
namespace {

using cases::Json;
using geom::EdgeKind;

std::string python(const char* library) {
  for (const char* name : {"python3", "/usr/bin/python3"})
    if (std::system(fmt::format("{} -c 'import {}' 2>/dev/null", name, library).c_str()) == 0) return name;
  return {};
}

Json seen_by_others(const std::string& interpreter, const std::string& file,
                    const std::string& script = "written_oracle.py", const std::string& word = "") {
  FILE* pipe = popen(
      fmt::format("{} -B {}/tests/support/{} {} '{}'", interpreter, cases::source_dir(), script, word, file)
          .c_str(),
      "r");
  if (pipe == nullptr) return nullptr;
  std::string text;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), n);
  return pclose(pipe) == 0 ? Json::parse(text) : Json(nullptr);
}

struct WrittenFile {
  WrittenFile(const std::string& name, const std::string& text)
      : folder(std::filesystem::temp_directory_path() /
               fmt::format("lekalo_drawing_writer_oracle_{}", getpid())),
        path((folder / name).string()) {
    std::filesystem::create_directories(folder);
    disk::AtomicFiles files;
    EXPECT_TRUE(files.add(path, text).has_value());
    EXPECT_TRUE(files.commit().has_value());
  }
  ~WrittenFile() { std::filesystem::remove_all(folder); }
  WrittenFile(const WrittenFile&) = delete;
  WrittenFile& operator=(const WrittenFile&) = delete;
  std::filesystem::path folder;
  std::string path;
};

/// Independent of the library's own formulas, and seen from the contour's first point, so that little
/// cancels.
cases::DrawnMeasures measures_of(const geom::Contour& contour) {
  cases::DrawnMeasures sum;
  for (const geom::Edge& edge : contour) {
    const cases::DrawnMeasures one = cases::measure(cases::shifted(edge, -contour.front().from));
    sum.length += one.length, sum.area += one.area;
  }
  return sum;
}

TEST(DrawingWriterOracle, EzdxfFindsNothingToRepairAndTheSameNumbers) {
  const std::string interpreter = python("ezdxf");
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
  const WrittenFile written("written.dxf", *text);
  const Json seen = seen_by_others(interpreter, written.path);
  ASSERT_TRUE(seen.is_object()) << "written_oracle.py failed";
  EXPECT_EQ(seen["version"], "AC1021");  // for the Cyrillic name
  EXPECT_EQ(seen["insunits"], 4);
  EXPECT_EQ(seen["errors"], Json::array());
  std::size_t k = 0;
  const auto check = [&](const geom::Contour& contour, const std::string& layer) {
    ASSERT_LT(k, seen["entities"].size());
    const Json& entity = seen["entities"][k];
    EXPECT_EQ(entity["layer"], layer);
    if (seen["ogr"].is_array()) {
      const Json& line = seen["ogr"][k];
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
      EXPECT_EQ(entity["centre"], Json({first.centre.x, first.centre.y}));
      EXPECT_NEAR(entity["radius"].get<double>(), geom::arc_radius(first), 1e-12);
      return;
    }
    EXPECT_EQ(entity["type"], "LWPOLYLINE");
    EXPECT_EQ(entity["closed"], true);
    std::size_t v = 0;
    for (const geom::Edge& edge : contour) {
      const Json& vertex = entity["vertices"][v++];
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

std::vector<LayeredRegion> random_regions_on_layers() {
  std::vector<LayeredRegion> regions;
  for (std::uint64_t index = 0; index < 20; ++index) {
    Random random(cases::seed(), 12000 + index);
    for (auto& region : cases::random_regions(random, index))
      regions.push_back({region, fmt::format("L{}", regions.size()), {}});
  }
  return regions;
}

TEST(DrawingWriterOracle, EzdxfFindsTheSameLengthsAndAreas) {
  const std::string interpreter = python("ezdxf");
  ASSERT_FALSE(interpreter.empty()) << "python3-ezdxf is not installed (tools/setup.sh installs it)";
  const auto regions = random_regions_on_layers();
  const WrittenFile written("written.dxf", *dxf_drawing(regions));
  const Json seen = seen_by_others(interpreter, written.path, "dxf_oracle.py", "ezdxf");
  ASSERT_TRUE(seen.is_object()) << "dxf_oracle.py failed";
  std::map<std::pair<std::string, std::string>, cases::DrawnMeasures> wanted;
  for (const LayeredRegion& one : regions) {
    for (const geom::Contour& contour : cases::contours_of({one.region})) {
      const bool circle = contour.front().from == contour.front().to;
      const auto measures = measures_of(contour);
      auto& sum = wanted[{circle ? "CIRCLE" : "LWPOLYLINE", one.layer}];
      sum.length += measures.length;
      sum.area += circle ? std::abs(measures.area) : measures.area;  // a CIRCLE has no direction
    }
  }
  const Json& listed = seen[written.path];
  ASSERT_EQ(listed.size(), wanted.size());
  for (const Json& theirs : listed) {
    const auto& ours = wanted.at({theirs["type"], theirs["layer"]});
    EXPECT_NEAR(theirs["length"].get<double>(), ours.length, 1e-9 * ours.length) << theirs.dump();
    EXPECT_NEAR(theirs["area"].get<double>(), ours.area, 1e-9 * std::abs(ours.area)) << theirs.dump();
  }
}

TEST(DrawingWriterOracle, SvgelementsFindsTheSameLengthsAndAreas) {
  const std::string interpreter = python("svgelements");
  ASSERT_FALSE(interpreter.empty()) << "python3-svgelements is not installed (tools/setup.sh installs it)";
  const auto regions = random_regions_on_layers();
  const WrittenFile written("written.svg", *svg_drawing(regions));
  const Json seen = seen_by_others(interpreter, written.path);
  ASSERT_TRUE(seen.is_array()) << "written_oracle.py failed";
  std::size_t k = 0;
  for (const LayeredRegion& one : regions) {
    for (const geom::Contour& contour : cases::contours_of({one.region})) {
      ASSERT_LT(k, seen.size());
      const Json& theirs = seen[k++];
      const auto ours = measures_of(contour);
      EXPECT_NEAR(theirs["length"].get<double>(), ours.length, 1e-9 * ours.length) << one.layer;
      EXPECT_NEAR(std::abs(theirs["area"].get<double>()), std::abs(ours.area), 1e-9 * std::abs(ours.area))
          << one.layer;
    }
  }
  EXPECT_EQ(k, seen.size());
}

}  // namespace
}  // namespace lekalo::io::io_drawing_writer_oracle_test

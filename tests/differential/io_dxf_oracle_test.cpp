#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "support/drawn_curves.hpp"
#include "support/json.hpp"
#include "support/places.hpp"

// Drawings against ezdxf (curve by curve, blocks and arrays expanded) and OGR (lengths and boxes of its
// polylines); see support/dxf_oracle.py. Both come as Debian packages (tools/setup.sh); where one is missing
// its comparison is skipped.

namespace lekalo::io_dxf_oracle_test {
namespace {

using cases::Json;

std::vector<std::string> corpus() {
  std::vector<std::string> files;
  for (const char* folder : {"dxf", "dxf_styles", "contours"}) {
    const auto path = std::filesystem::path(cases::source_dir() + "/tests/corpus/data") / folder;
    for (const auto& entry : std::filesystem::directory_iterator(path)) {
      // A spline by fit points alone is another curve to each program.
      if (entry.path().extension() == ".dxf" && entry.path().filename() != "ezdxf-spline.dxf")
        files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// The interpreter that has the library; Debian's own is not always the first in the path. Empty: none.
std::string python_with(const std::string& library) {
  for (const char* python : {"python3", "/usr/bin/python3"}) {
    const std::string probe = fmt::format("{} {}/tests/support/dxf_oracle.py probe {} 2>/dev/null", python,
                                          cases::source_dir(), library);
    if (std::system(probe.c_str()) == 0) return python;
  }
  return {};
}

Json listing(const std::string& python, const std::string& library, const std::vector<std::string>& files) {
  std::string command =
      fmt::format("{} {}/tests/support/dxf_oracle.py {}", python, cases::source_dir(), library);
  for (const std::string& file : files) command += " '" + file + "'";
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return nullptr;
  std::string text;
  std::array<char, 65536> buffer{};
  for (std::size_t n = 0; (n = fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    text.append(buffer.data(), n);
  return pclose(pipe) == 0 ? Json::parse(text) : Json(nullptr);
}

struct Sum {
  std::size_t curves = 0;
  drawn::Integrals total;
};

TEST(IoDxfOracle, EzdxfFindsTheSameCurvesLengthsPlacesAndAreas) {
  const std::string python = python_with("ezdxf");
  ASSERT_FALSE(python.empty()) << "python3-ezdxf is not installed (tools/setup.sh installs it)";
  const auto files = corpus();
  const Json oracle = listing(python, "ezdxf", files);
  ASSERT_TRUE(oracle.is_object()) << "dxf_oracle.py failed";
  std::size_t compared = 0;
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    const auto drawing = io::parse_dxf(*disk::read_file(file), file);
    ASSERT_TRUE(drawing.has_value()) << drawing.error().message;
    std::map<std::pair<std::string, std::string>, Sum> found;
    double reach = 1;
    for (const io::DrawnCurve& curve : drawing->curves) {
      Sum& sum = found[{drawing->entities[curve.entity].type, drawing->layers[curve.layer].name}];
      const drawn::Integrals one = drawn::integrals(curve.shape);
      ++sum.curves;
      sum.total.length += one.length;
      sum.total.x += one.x;
      sum.total.y += one.y;
      sum.total.area += one.area;
      for (const double corner : drawn::box(curve.shape)) reach = std::max(reach, std::abs(corner));
    }
    const double scale = drawing->millimetres_per_unit;
    ASSERT_EQ(found.size(), oracle[file].size()) << oracle[file].dump();
    for (const Json& theirs : oracle[file]) {
      const auto ours = found.find({theirs["type"], theirs["layer"]});
      ASSERT_NE(ours, found.end()) << theirs.dump();
      const auto& [curves, total] = ours->second;
      EXPECT_EQ(curves, theirs["curves"].get<std::size_t>()) << theirs.dump();
      const double length = scale * theirs["length"].get<double>(), tolerance = 1e-9 * length;
      EXPECT_NEAR(total.length, length, tolerance) << theirs.dump();
      EXPECT_NEAR(total.x, scale * scale * theirs["x"].get<double>(), tolerance * reach) << theirs.dump();
      EXPECT_NEAR(total.y, scale * scale * theirs["y"].get<double>(), tolerance * reach) << theirs.dump();
      // Where the areas of one kind cancel, rounding is what is left of both sums.
      const double area = scale * scale * theirs["area"].get<double>();
      EXPECT_NEAR(total.area, area, 1e-9 * std::abs(area) + 1e-14 * length * reach) << theirs.dump();
      compared += curves;
    }
  }
  EXPECT_GT(compared, 1000U);
}

TEST(IoDxfOracle, OgrFindsTheSameLengthsAndBoxesOnEachLayer) {
  const std::string python = python_with("ogr");
  ASSERT_FALSE(python.empty()) << "python3-gdal is not installed (tools/setup.sh installs it)";
  const auto files = corpus();
  const Json oracle = listing(python, "ogr", files);
  ASSERT_TRUE(oracle.is_object()) << "dxf_oracle.py failed";
  std::size_t compared = 0;
  for (const std::string& file : files) {
    if (oracle[file].is_null()) continue;  // OGR does not open it
    SCOPED_TRACE(file);
    const auto drawing = io::parse_dxf(*disk::read_file(file), file);
    ASSERT_TRUE(drawing.has_value()) << drawing.error().message;
    // OGR draws dimensions with lines.
    if (std::any_of(drawing->unread.begin(), drawing->unread.end(),
                    [](const io::Unread& unread) { return unread.name == "DIMENSION"; })) {
      continue;
    }
    std::map<std::string, std::pair<double, std::array<double, 4>>> found;
    std::set<std::string> with_splines;
    for (const io::DrawnCurve& curve : drawing->curves) {
      const auto [entry, is_new] =
          found.try_emplace(drawing->layers[curve.layer].name,
                            std::pair{0.0, std::array<double, 4>{HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL}});
      if (std::holds_alternative<io::Spline>(curve.shape)) with_splines.insert(entry->first);
      entry->second.first += drawn::integrals(curve.shape).length;
      const auto box = drawn::box(curve.shape);
      for (std::size_t k = 0; k < 4; ++k) {
        double& side = entry->second.second[k];
        side = k < 2 ? std::min(side, box[k]) : std::max(side, box[k]);
      }
    }
    const double scale = drawing->millimetres_per_unit;
    for (const Json& theirs : oracle[file]) {
      const auto layer = theirs["layer"].get<std::string>();
      // OGR takes UTF-8 names of new drawings for the code page of old ones.
      if (std::any_of(layer.begin(), layer.end(),
                      [](char c) { return static_cast<unsigned char>(c) >= 0x80; }))
        continue;
      const auto ours = found.find(layer);
      ASSERT_NE(ours, found.end()) << theirs.dump();
      // OGR gives polylines, here in steps of 0.1 degrees, whose chords are shorter by 1e-7 at least: its
      // lengths say that nothing is missing; ezdxf's parameters, above, say that the curves are right.
      // It draws splines coarsely, and beyond the knots that count.
      if (with_splines.count(ours->first) != 0) continue;
      const double length = scale * theirs["length"].get<double>();
      EXPECT_NEAR(ours->second.first, length, 1e-4 * length) << theirs.dump();
      // OGR draws polylines in steps.
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(ours->second.second[k], scale * theirs["box"][k].get<double>(), 2e-3 * length)
            << theirs.dump();
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 20U);
}

}  // namespace
}  // namespace lekalo::io_dxf_oracle_test

// Every file of the shared nesting data loads; areas, counts and rules are those that this test's own reading
// of the JSON gives.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "lekalo/disk/files.hpp"
#include "lekalo/disk/open_layout.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"
#include "support/json.hpp"
#include "support/shared_data.hpp"

namespace lekalo::io::io_nesting_test {
namespace {

using cases::Json;
namespace fs = std::filesystem;

Json load(const fs::path& path) { return Json::parse(disk::read_file(path.string()).value()); }

double x_of(const Json& p) { return p.is_array() ? p[0].get<double>() : p["x"].get<double>(); }
double y_of(const Json& p) { return p.is_array() ? p[1].get<double>() : p["y"].get<double>(); }
double ring_area(const Json& ring) {
  double twice = 0;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    twice += (x_of(ring[j]) - x_of(ring[0])) * (y_of(ring[i]) - y_of(ring[0])) -
             (y_of(ring[j]) - y_of(ring[0])) * (x_of(ring[i]) - x_of(ring[0]));
  return std::abs(twice) / 2;
}
/// Of a shape in any of the spellings: outline less holes.
double shape_area(const Json& s) {
  if (s.contains("shapes")) return shape_area(s["shapes"][0]);
  const Json& data = s.contains("data") ? s["data"] : s.contains("Data") ? s["Data"] : s;
  if (data.is_array()) return ring_area(data);
  if (data.contains("width")) return data["width"].get<double>() * data["height"].get<double>();
  const auto list = [&](const char* a, const char* b) {
    return data.contains(a) ? data[a] : data.value(b, Json::array());
  };
  double area = ring_area(list("Outer", "vertices"));
  for (const Json& hole : list("Inner", "holes"))
    area -= ring_area(hole.is_object() ? hole["vertices"] : hole);
  return area;
}

struct Sums {
  double parts = 0, zones = 0, stocks = 0;  ///< area times demand or count, mm2
  std::int64_t demand = 0, count = 0;
};

Sums sums_of(const layout::Document& d) {
  Sums sums;
  for (const layout::Part& part : d.parts) {
    sums.demand += part.demand;
    sums.parts += static_cast<double>(part.demand) * geom::area_mm2(part.outline.polygon);
    for (const auto& area : part.areas) sums.zones += geom::area_mm2(area.outline.polygon);
  }
  for (const layout::Stock& stock : d.stocks) {
    sums.count += stock.count;
    sums.stocks += static_cast<double>(stock.count) * geom::area_mm2(stock.outline.polygon);
    for (const auto& zone : stock.zones)
      sums.zones += static_cast<double>(stock.count) * geom::area_mm2(zone.outline.polygon);
  }
  return sums;
}

Result<LayoutFile> open(const fs::path& path, bool inches = false) {
  disk::OpenOptions options;
  if (inches) options.parts.unit = LengthUnit::inch;
  return disk::open_layout(path.string(), options);
}

class Nesting : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = cases::shared_data();
    if (folder_.empty()) GTEST_SKIP() << "no ../shared/data; LEKALO_SHARED_DATA names another folder";
    folder_ += "/nesting";
    ASSERT_TRUE(fs::is_directory(folder_)) << folder_;
  }
  std::vector<fs::path> files(const std::string& folder) const {
    std::set<fs::path> sorted;
    for (const auto& entry : fs::directory_iterator(folder_ + "/" + folder)) sorted.insert(entry.path());
    return {sorted.begin(), sorted.end()};
  }
  std::string folder_;
};

TEST_F(Nesting, StripsHaveTheirAreasAndDemands) {
  std::size_t seen = 0;
  for (const char* kind : {"strip", "strip-inflated"})
    for (const fs::path& path : files(kind)) {
      const auto file = open(path);
      ASSERT_TRUE(file.has_value()) << file.error().message;
      const Json json = load(path);
      Sums expected;
      for (const Json& item : json["items"]) {
        expected.demand += item["demand"].get<std::int64_t>();
        expected.parts += item["demand"].get<double>() * shape_area(item["shape"]);
      }
      const Sums sums = sums_of(file->document);
      EXPECT_EQ(sums.demand, expected.demand) << path;
      EXPECT_NEAR(sums.parts, expected.parts, 1e-6 * expected.parts) << path;
      ASSERT_EQ(file->document.stocks.size(), 1u);
      EXPECT_TRUE(file->document.stocks[0].open_length);
      EXPECT_NEAR(geom::mm_from_grid(geom::bounds(file->document.stocks[0].outline.polygon).high.y),
                  json["strip_height"].get<double>(), geom::kGridStep);
      for (std::size_t i = 0; i < file->document.parts.size(); ++i)
        EXPECT_EQ(file->document.parts[i].rotations.size(), json["items"][i]["allowed_orientations"].size());
      ++seen;
    }
  EXPECT_EQ(seen, 13u);
}

TEST_F(Nesting, SheetsHaveTheirAreasCountsAndRotations) {
  std::size_t seen = 0, mirrored = 0, turned = 0, holes = 0;
  for (const fs::path& path : files("sheets")) {
    const std::string stem = path.stem().string();
    const bool inches = stem == "chair" || stem == "stepladder" || stem == "stool_x10";
    const double scale = inches ? 25.4 * 25.4 : 1;
    const auto file = open(path, inches);
    ASSERT_TRUE(file.has_value()) << file.error().message;
    const Json json = load(path);
    Sums expected;
    for (const Json& item : json["item_types"]) {
      const auto copies = item.value("copies", std::int64_t{1});
      expected.demand += copies;
      expected.parts += scale * static_cast<double>(copies) * shape_area(item);
    }
    for (const Json& bin : json["bin_types"]) {
      const auto copies = bin.value("copies", std::int64_t{1});
      expected.count += copies;
      expected.stocks += scale * static_cast<double>(copies) * shape_area(bin);
    }
    const Sums sums = sums_of(file->document);
    EXPECT_EQ(sums.demand, expected.demand) << path;
    EXPECT_EQ(sums.count, expected.count) << path;
    EXPECT_NEAR(sums.parts, expected.parts, 1e-7 * expected.parts) << path;
    EXPECT_NEAR(sums.stocks, expected.stocks, 1e-7 * expected.stocks) << path;
    for (std::size_t i = 0; i < file->document.parts.size(); ++i) {
      const layout::Part& part = file->document.parts[i];
      const Json& item = json["item_types"][i];
      EXPECT_EQ(part.may_mirror, item.value("allow_mirroring", false));
      EXPECT_EQ(part.rotations.size(),
                item.contains("allowed_rotations") ? item["allowed_rotations"].size() : 1u);
      EXPECT_TRUE(rotation_allowed(part, {}));
      mirrored += part.may_mirror ? 1 : 0;
      turned += part.rotations.size() > 1 ? 1 : 0;
      holes += part.outline.polygon.loops() - 1;
    }
    ++seen;
  }
  EXPECT_EQ(seen, 5u);
  EXPECT_GT(turned, 0u);
  EXPECT_GT(holes, 10u);
  EXPECT_EQ(mirrored, 0u);  // none of the five allows it
}

TEST_F(Nesting, HidesKeepEveryHoleAndZone) {
  std::size_t seen = 0, as_defects = 0;
  for (const fs::path& path : files("leather")) {
    const auto file = open(path);
    ASSERT_TRUE(file.has_value()) << file.error().message;
    const Json json = load(path);
    Sums expected;
    std::size_t holes = 0, found = 0;
    for (const Json& item : json["Items"]) {
      expected.demand += item["Demand"].get<std::int64_t>();
      expected.parts += item["Demand"].get<double>() * shape_area(item["Shape"]);
      for (const Json& zone : item["Zones"]) expected.zones += shape_area(zone["Shape"]);
    }
    for (const Json& object : json["Objects"]) {
      expected.count += object["Stock"].get<std::int64_t>();
      expected.stocks += shape_area(object["Shape"]);
      for (const Json& zone : object["Zones"]) expected.zones += shape_area(zone["Shape"]);
      if (object["Shape"]["Type"] == "Polygon") holes += object["Shape"]["Data"]["Inner"].size();
    }
    Sums sums = sums_of(file->document);
    for (const layout::Stock& stock : file->document.stocks) {
      found += stock.outline.polygon.loops() - 1 + stock.defects.size();
      as_defects += stock.defects.size();
      for (const layout::Defect& defect : stock.defects) {
        EXPECT_EQ(defect.severity, kNeverTolerated);
        sums.stocks -= geom::area_mm2(defect.outline.polygon);
      }
    }
    EXPECT_EQ(file->notices.empty(), sums_of(file->document).stocks == sums.stocks);
    EXPECT_EQ(found, holes) << path;
    EXPECT_EQ(sums.demand, expected.demand) << path;
    EXPECT_EQ(sums.count, expected.count) << path;
    EXPECT_NEAR(sums.parts, expected.parts, 1e-9 * expected.parts) << path;
    EXPECT_NEAR(sums.zones, expected.zones, 1e-9 * expected.zones) << path;
    EXPECT_NEAR(sums.stocks, expected.stocks, 1e-9 * expected.stocks) << path;
    for (std::size_t i = 0; i < file->document.parts.size(); ++i) {
      const Json& base = json["Items"][i].value("BaseQuality", Json());
      EXPECT_EQ(file->document.parts[i].quality, base.is_null() ? layout::kBestQuality : base.get<int>());
      EXPECT_TRUE(file->document.parts[i].rotations.empty());
    }
    ++seen;
  }
  EXPECT_EQ(seen, 3u);
  EXPECT_GT(as_defects, 5u);  // Test1 has holes across its outlines
}

TEST_F(Nesting, PlacementsLieInTheirStripAndComeBack) {
  std::size_t seen = 0;
  for (const fs::path& path : files("layouts")) {
    const auto file = open(path);
    ASSERT_TRUE(file.has_value()) << file.error().message;
    const Json json = load(path);
    const layout::Document& document = file->document;
    ASSERT_EQ(document.placements.size(), json["placements"].size());
    double area = 0, reach = 0;
    for (std::size_t i = 0; i < document.placements.size(); ++i) {
      const layout::Part& part = document.parts[document.placements[i].part];
      EXPECT_TRUE(rotation_allowed(part, document.placements[i].rotation));
      const geom::GridBox box = geom::bounds(placed_outline(part, document.placements[i]));
      EXPECT_GE(geom::mm_from_grid(box.low.y), -0.01) << path;
      EXPECT_LE(geom::mm_from_grid(box.high.y), json["strip_height"].get<double>() + 0.01) << path;
      reach = std::max(reach, geom::mm_from_grid(box.high.x));
      area += geom::area_mm2(part.outline.polygon);
    }
    EXPECT_NEAR(reach, json["length"].get<double>(), 0.5) << path;
    EXPECT_NEAR(area / (json["length"].get<double>() * json["strip_height"].get<double>()),
                json["density"].get<double>(), 2e-3)
        << path;

    const auto text = write_placements(document, 0, json["instance"].get<std::string>());
    ASSERT_TRUE(text.has_value()) << text.error().message;
    layout::Document instance = document;
    instance.placements.clear();
    const auto again = read_placements(*text, "again.json", instance);
    ASSERT_TRUE(again.has_value()) << again.error().message;
    for (std::size_t i = 0; i < document.placements.size(); ++i) {
      const layout::Part& part = document.parts[document.placements[i].part];
      EXPECT_EQ(placed_outline(part, document.placements[i]),
                placed_outline(part, again->document.placements[i]));
    }
    const Json written = Json::parse(*text);
    EXPECT_NEAR(written["length"].get<double>(), reach, 1e-6);
    ++seen;
  }
  EXPECT_EQ(seen, 4u);
}

TEST_F(Nesting, WhatIsReadIsWrittenAndReadAgainAsItIs) {
  for (const char* kind : {"strip", "strip-inflated", "sheets", "leather", "layouts"})
    for (const fs::path& path : files(kind)) {
      const auto file = open(path);
      ASSERT_TRUE(file.has_value()) << file.error().message;
      const auto again = read_layout(write_layout(file->document), "again.json");
      ASSERT_TRUE(again.has_value()) << again.error().message;
      EXPECT_TRUE(again->document == file->document) << path;
    }
}

}  // namespace
}  // namespace lekalo::io::io_nesting_test

#include "lekalo/io/nesting/nesting_files.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "lekalo/disk/files.hpp"
#include "lekalo/disk/open_layout.hpp"
#include "support/places.hpp"

namespace lekalo::io::io_nesting_files_test {
namespace {

namespace fs = std::filesystem;

const std::string kJobs = cases::source_dir() + "/fuzz/corpus/nesting_files/";

Result<LayoutFile> job(const std::string& name, std::optional<LengthUnit> unit = std::nullopt) {
  return read_nesting(disk::read_file(kJobs + name).value(), name, unit);
}

/// A strip of one item with this outline.
std::string strip_of(const std::string& points) {
  return R"({"strip_height": 10, "items": [{"id": 0, "demand": 1, "shape": {"type": "simple_polygon", "data": )" +
         points + "}}]}";
}

TEST(NestingFiles, StripsDropSpikesAndKeepTheArea) {
  const auto file = job("strip.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  const layout::Document& d = file->document;
  ASSERT_EQ(d.parts.size(), 2u);
  EXPECT_EQ(d.parts[0].demand, 2);
  EXPECT_EQ(d.parts[0].rotations.size(), 2u);
  EXPECT_TRUE(d.parts[1].rotations.empty());
  EXPECT_EQ(geom::area_mm2(d.parts[0].outline.polygon), 3);
  EXPECT_EQ(d.parts[0].outline.polygon.points.size(), 3u);
  EXPECT_EQ(geom::area_mm2(d.parts[1].outline.polygon), 40);
  ASSERT_EQ(file->notices.size(), 1u);
  EXPECT_NE(file->notices[0].find("items[0].shape: 1 point where"), std::string::npos) << file->notices[0];
}

TEST(NestingFiles, SpikesGoWhereverTheyStand) {
  for (const char* points :
       {"[[0,0],[-5,0],[4,0],[0,3]]", "[[4,0],[0,3],[0,0],[-5,0]]", "[[-5,0],[4,0],[0,3],[0,0]]",
        "[[0,0],[4,0],[0,3],[0,9],[0,3],[0,7],[0,0]]", "[[0,0],[4,0],[6,-1.5],[8,-3],[4,0],[0,3]]"}) {
    const auto file = read_nesting(strip_of(points), "s.json");
    ASSERT_TRUE(file.has_value()) << points << file.error().message;
    EXPECT_EQ(geom::area_mm2(file->document.parts[0].outline.polygon), 6) << points;
    EXPECT_EQ(file->notices.size(), 1u) << points;
  }
}

TEST(NestingFiles, OutlinesThatMeetThemselvesAreRefused) {
  for (const char* points : {"[[0,0],[4,4],[4,0],[0,4]]", "[[0,0],[4,0],[4,4],[2,0],[0,4]]", "[[0,0],[1,0]]",
                             "[[0,0],[9,0],[3,0]]", "[[0,0],[4,0],[2,2],[4,4],[0,4],[2,2]]"}) {
    const auto file = read_nesting(strip_of(points), "s.json");
    ASSERT_FALSE(file.has_value()) << points;
    EXPECT_EQ(file.error().message.rfind("s.json: items[0].shape: outline: ", 0), 0u) << file.error().message;
  }
}

TEST(NestingFiles, ZonesThatCrossThemselvesAreReadSoThatTheyForbidMore) {
  const auto shape = [](const std::string& points) {
    return R"({"Type": "SimplePolygon", "Data": )" + points + "}";
  };
  const auto zone = [&](int quality, const std::string& points) {
    return fmt::format(R"("Zones": [{{"Quality": {}, "Shape": {}}}])", quality, shape(points));
  };
  // Two lobes about (5, 5), of 25 mm2 each; what is wound around is nothing in all. Then a loop of 1 mm2 at
  // the corner of a square.
  const std::string bow = "[[0,0],[10,10],[10,0],[0,10]]",
                    loop = "[[0,0],[10,0],[10,11],[9,11],[9,10],[11,10],[0,10]]";
  const auto areas = [&](const std::string& item_zones, const std::string& hide_zones) {
    const std::string square = shape("[[0,0],[50,0],[50,50],[0,50]]");
    const auto file =
        read_nesting(fmt::format(R"({{"Items": [{{"Demand": 1, "BaseQuality": 2, "Shape": {0}, {1}}}], )"
                                 R"("Objects": [{{"Cost": 1, "Stock": 1, "Shape": {0}, {2}}}]}})",
                                 square, item_zones, hide_zones),
                     "h.json");
    EXPECT_TRUE(file.has_value()) << file.error().message;
    double part = 0, hide = 0;
    if (!file) return std::pair{part, hide};
    for (const auto& area : file->document.parts[0].areas) part += geom::area_mm2(area.outline.polygon);
    for (const auto& one : file->document.stocks[0].zones) hide += geom::area_mm2(one.outline.polygon);
    EXPECT_EQ(file->notices.size(), 2u);
    return std::pair{part, hide};
  };
  // An area that asks for less than its part is read as small as it may be, every other zone as large.
  const auto low = areas(zone(1, bow), zone(1, bow)), high = areas(zone(3, bow), zone(1, loop));
  EXPECT_NEAR(low.first, 0, 1e-4);
  EXPECT_NEAR(low.second, 50, 1e-4);
  EXPECT_NEAR(high.first, 50, 1e-4);
  EXPECT_NEAR(high.second, 101.5, 0.6);
}

TEST(NestingFiles, SheetsInInchesWithGaps) {
  const auto file = job("sheets.json", LengthUnit::inch);
  ASSERT_TRUE(file.has_value()) << file.error().message;
  const layout::Document& d = file->document;
  EXPECT_EQ(d.rules.gap, geom::grid_from_mm_up(12.7));
  EXPECT_EQ(d.rules.border_gap, geom::grid_from_mm_up(25.4));
  EXPECT_EQ(d.stocks[0].count, 2);
  EXPECT_NEAR(geom::area_mm2(d.stocks[0].outline.polygon), 5000 * 25.4 * 25.4, 1);
  EXPECT_EQ(d.parts[0].demand, 3);
  EXPECT_TRUE(d.parts[0].may_mirror);
  EXPECT_EQ(d.parts[0].rotations, (std::vector<layout::AngleRange>{{0, 90}}));
  EXPECT_EQ(d.parts[0].outline.polygon.loops(), 2u);
  EXPECT_EQ(d.parts[1].rotations, (std::vector<layout::AngleRange>{{0, 0}}));
  EXPECT_NEAR(geom::area_mm2(d.parts[1].outline.polygon), 12 * 25.4 * 25.4, 1e-3);
}

TEST(NestingFiles, HolesAcrossTheBorderOfAHideBecomeDefects) {
  const auto file = job("hides.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  const layout::Stock& hide = file->document.stocks[0];
  EXPECT_EQ(hide.outline.polygon.loops(), 2u);
  ASSERT_EQ(hide.defects.size(), 1u);
  EXPECT_EQ(hide.defects[0].id, "hole-1");
  EXPECT_EQ(hide.defects[0].severity, kNeverTolerated);
  EXPECT_EQ(geom::area_mm2(hide.defects[0].outline.polygon), 112.5);
  EXPECT_EQ(file->document.parts[0].quality, layout::kBestQuality);
  EXPECT_EQ(file->document.parts[0].areas.size(), 1u);
  EXPECT_EQ(file->notices.size(), 2u);  // that, and DemandMax
}

TEST(NestingFiles, StocksThatAreAlikeBecomeACount) {
  const std::string square = R"({"Type": "SimplePolygon", "Data": [[0, 0], [9, 0], [9, 9], [0, 9]]})";
  const std::string item = R"([{"Demand": 1, "Shape": )" + square + "}]";
  const auto hides = [&](const std::string& objects) {
    return read_nesting(R"({"Items": )" + item + R"(, "Objects": [)" + objects + "]}", "h.json")
        ->document.stocks;
  };
  const std::string one = R"({"Cost": 1, "Stock": 2, "Shape": )" + square + "}";
  const std::string dear = R"({"Cost": 3, "Stock": 1, "Shape": )" + square + "}";
  const auto stocks = hides(one + "," + dear + "," + one);
  ASSERT_EQ(stocks.size(), 2u);
  EXPECT_EQ(stocks[0].count, 4);
  EXPECT_EQ(stocks[1].cost, 3);
}

TEST(NestingFiles, RefusesWithPlaceAndWayOut) {
  const auto refused = [](const std::string& text, const char* expected) {
    const auto file = read_nesting(text, "j.json");
    ASSERT_FALSE(file.has_value()) << text;
    EXPECT_EQ(file.error().code, ErrorCode::bad_input);
    EXPECT_NE(file.error().message.find(expected), std::string::npos) << file.error().message;
  };
  refused("{}", "no job of a nesting program; known are");
  refused(R"({"placements": []})", "the file of the items");
  refused(R"({"items": []})", "\"strip_height\", the strip's height, is missing");
  refused(R"({"strip_height": -1, "items": []})", "strip_height: -1 is out of range");
  refused(R"({"strip_height": 1, "items": [], "hole": 1})", "unknown field 'hole'");
  refused(R"({"strip_height": 1, "items": [{"demand": 1, "shape": {"type": "circle", "data": 1}}]})",
          "items[0].shape.type: shapes of this kind are not read");
  refused(R"({"bin_types": [{"type": "circle"}]})", "bin_types[0].type: shapes of this kind are not read");
  refused(R"({"bin_types": [], "item_types": [{"shapes": [{}, {}]}]})",
          "item_types[0].shapes: an item of 2 shapes; a part is one piece");
  refused(R"({"Objects": [{"Shape": {"Type": "SimplePolygon", "Data": [[0, 0], [1e7, 0], [0, 1]]}}]})",
          "Objects[0].Shape.Data[1]: (10000000, 0) is further from the origin than 262144 mm");
}

TEST(NestingFiles, PlacementsComeBackWithinAStep) {
  const auto items = job("strip.json");
  const auto placed =
      read_placements(disk::read_file(kJobs + "placements.json").value(), "p.json", items->document);
  ASSERT_TRUE(placed.has_value()) << placed.error().message;
  layout::Document d = placed->document;
  ASSERT_EQ(d.placements.size(), 2u);
  EXPECT_EQ(d.placements[0].rotation, (geom::GridRotation{-geom::GridRotation::kOne, 0}));
  // A rotation that is no angle of few digits.
  d.placements[1].rotation = geom::rotation_from_pair(0.28, 0.96);
  d.placements[1].at = {123456789, -987654321};
  const auto text = write_placements(d, 0, "strip.json");
  ASSERT_TRUE(text.has_value()) << text.error().message;
  const auto again = read_placements(*text, "again.json", items->document);
  ASSERT_TRUE(again.has_value()) << again.error().message;
  for (std::size_t i = 0; i < 2; ++i) {
    const layout::Part& part = d.parts[d.placements[i].part];
    const geom::GridRegion before = placed_outline(part, d.placements[i]),
                           after = placed_outline(part, again->document.placements[i]);
    ASSERT_EQ(before.points.size(), after.points.size());
    for (std::size_t k = 0; k < before.points.size(); ++k) {
      EXPECT_LE(std::abs(before.points[k].x - after.points[k].x), 1);
      EXPECT_LE(std::abs(before.points[k].y - after.points[k].y), 1);
    }
  }
  d.placements[0].mirrored = true;
  EXPECT_NE(write_placements(d, 0, "s").error().message.find("placement 1 is mirrored"), std::string::npos);
  EXPECT_FALSE(write_placements(d, 1, "s").has_value());
  EXPECT_FALSE(write_placements(items->document, 0, "s").has_value());
}

TEST(NestingFiles, PlacementsOfAnotherFileAreRefused) {
  const auto refused = [](const std::string& text, const char* expected) {
    const auto file = read_placements(text, "p.json", job("strip.json")->document);
    ASSERT_FALSE(file.has_value()) << text;
    EXPECT_NE(file.error().message.find(expected), std::string::npos) << file.error().message;
  };
  refused(R"({"strip_height": 11, "placements": []})",
          "strip_height: 11 mm, but the strip of the items is 10 mm");
  refused(R"({"placements": [{"item": 2, "rotation": 0, "x": 0, "y": 0}]})",
          "placements[0].item: there is no item 2 among the 2");
  refused(R"({"placements": [{"item": 0, "rotation": 0, "x": 0}]})", "placements[0]: \"y\"");
}

TEST(OpenLayout, TellsFilesApartByWhatIsInThem) {
  const fs::path folder = fs::temp_directory_path() / fmt::format("lekalo-open-{}", ::getpid());
  fs::create_directories(folder / "sub");
  const auto put = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return (folder / name).string();
  };
  const auto opened = [&](const std::string& name, const std::string& text) {
    const auto file = disk::open_layout(put(name, text));
    EXPECT_TRUE(file.has_value()) << (file ? "" : file.error().message);
    return file ? file->document : layout::Document{};
  };
  for (const char* name : {"strip.json", "sheets.json", "hides.json"}) {
    const std::string text = disk::read_file(kJobs + name).value();
    EXPECT_EQ(opened("job.txt", text), read_nesting(text, "job")->document);
    EXPECT_EQ(opened("layout.dat", write_layout(read_nesting(text, "job")->document)),
              read_nesting(text, "job")->document);
  }
  put("items.json", disk::read_file(kJobs + "strip.json").value());
  const std::string placements = disk::read_file(kJobs + "placements.json").value();
  EXPECT_EQ(opened("p.json", placements).placements.size(), 2u);
  EXPECT_EQ(opened("sub/p.json", placements).placements.size(), 2u);  // its items are in the folder above
  fs::remove(folder / "items.json");
  const auto lost = disk::open_layout((folder / "p.json").string());
  ASSERT_FALSE(lost.has_value());
  EXPECT_NE(lost.error().message.find("the file of its items, 'items.json', is neither"), std::string::npos);

  const auto region = opened("plate.json", R"({"units": "mm", "pieces": [
      {"outer": [{"arc": {"from": [5, 0], "to": [5, 0], "centre": [0, 0], "ccw": true}}]},
      {"outer": [{"line": {"from": [20, 0], "to": [30, 0]}}, {"line": {"from": [30, 0], "to": [30, 9]}},
                 {"line": {"from": [30, 9], "to": [20, 0]}}]}]})");
  ASSERT_EQ(region.parts.size(), 2u);
  EXPECT_EQ(region.parts[0].id, "plate");
  EXPECT_EQ(region.parts[1].id, "plate-2");
  EXPECT_EQ(region.parts[0].outline.curves.size(), 1u);
  EXPECT_TRUE(region.parts[1].outline.curves.empty());
  EXPECT_GT(geom::area_mm2(region.parts[0].outline.polygon), 78.5398);
  const auto tree = opened("t.json", R"({"units": "mm", "shape": {"difference": [
      {"name": "plate", "rectangle": {"corner": [0, 0], "size": [30, 20]}}, {"circle": {"centre": [15, 10], "radius": 4}}]}})");
  ASSERT_EQ(tree.parts.size(), 1u);
  EXPECT_EQ(tree.parts[0].id, "plate");
  EXPECT_EQ(tree.parts[0].outline.polygon.loops(), 2u);
  const auto svg = opened(
      "s.svg", R"(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
      <g id="soles"><rect id="left" x="1" y="1" width="10" height="10"/><rect x="21" y="1" width="10" height="10"/></g></svg>)");
  ASSERT_EQ(svg.parts.size(), 1u);
  EXPECT_EQ(svg.parts[0].id, "s");
  EXPECT_EQ(svg.parts[0].name, "soles, left");
  EXPECT_EQ(svg.parts[0].demand, 2);
  const auto other = disk::open_layout(put("o.json", "{\"a\": 1}"));
  ASSERT_FALSE(other.has_value());
  EXPECT_NE(other.error().message.find("no layout; known are"), std::string::npos);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace lekalo::io::io_nesting_files_test

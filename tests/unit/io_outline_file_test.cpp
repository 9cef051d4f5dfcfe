#include "lekalo/io/formats/outline_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "lekalo/base/random.hpp"
#include "lekalo/io/formats/part_file.hpp"
#include "support/boolean_cases.hpp"
#include "support/io_contours.hpp"
#include "support/scan_files.hpp"

namespace lekalo::io::io_outline_file_test {
namespace {

const io_cases::GridRing kPlate{{0, 0}, {80, 0}, {80, 40}, {0, 40}};
const io_cases::GridRing kDented{{0, 0}, {80, 0}, {80, 40}, {40, 39}, {0, 40}};

std::string svg(const std::string& path) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" width="80mm" height="40mm" viewBox="0 0 80 40"><path d=")" +
         path + R"("/></svg>)";
}

/// The plate in every form, by the name of its file.
std::map<std::string, std::string> plates() {
  return {{"points.csv", io_cases::csv(kPlate, 0)},
          {"points.TXT", "0 0\n80 0\n80 40\n0 40\n"},
          {"points.json", io_cases::json(kPlate, 0)},
          {"regions.JSON", io_cases::region(kPlate, 0)},
          {"pieces.json",
           R"({"units": "mm", "pieces": [)" + io_cases::region(kPlate, 0).replace(0, 16, "{") + "]}"},
          {"tree.json", R"({"units": "mm", "shape": {"rectangle": {"corner": [0, 0], "size": [80, 40]}}})"},
          {"drawing.dxf", io_cases::dxf_entities(io_cases::polyline(kPlate, 0))},
          {"drawing.Svg", svg("M0 0H80V40H0Z")}};
}

ReadOutline outline_in(const std::string& bytes, const std::string& name,
                       const OutlineOptions& options = {}) {
  Result<ReadOutline> read = read_outline(bytes, name, options);
  EXPECT_TRUE(read.has_value()) << name << ": " << (read ? "" : read.error().message);
  return read ? std::move(*read) : ReadOutline{};
}

std::string refusal_of(const std::string& bytes, const std::string& name,
                       const OutlineOptions& options = {}) {
  const Result<ReadOutline> read = read_outline(bytes, name, options);
  EXPECT_FALSE(read.has_value()) << name;
  EXPECT_EQ(read ? ErrorCode::usage : read.error().code, ErrorCode::bad_input);
  return read ? "" : read.error().message;
}

TEST(OutlineFile, LinesThatMayChangeTheMaterialAreRefused) {
  OutlineOptions part;
  part.may_lack_holes = true;
  const std::string plate = "M0 0H80V40H0Z ";
  // Within a part a hole that is not seen leaves it larger than it is; of a blank it would be material.
  for (const char* within : {"M10 10H30", "M0 10H80", "M40 0A20 20 0 0 0 60 20"}) {
    const ReadOutline read = outline_in(svg(plate + within), "a.svg", part);
    EXPECT_NEAR(cases::area_of(read.outline.regions), 3200, 1e-6) << within;
    EXPECT_NE(refusal_of(svg(plate + within), "a.svg").find("may be the edge of a hole"), std::string::npos);
  }
  // Whatever reaches out may be more of the part, a chain of arcs too whose ends are inside.
  for (const char* outside : {"M70 10H90", "M85 10H95", "M70 10A15 15 0 1 1 70 30", "M10 10H30V50"})
    EXPECT_NE(refusal_of(svg(plate + outside), "a.svg", part).find("more of the part"), std::string::npos)
        << outside;
  // A tab that crosses the edge may be meant to belong to the part, or to be cut off it.
  const std::string tab = R"("/><path d="M75 10H90V15H75Z)";
  EXPECT_NE(refusal_of(svg(plate + tab), "a.svg", part).find("crosses that of"), std::string::npos);
}

TEST(OutlineFile, EveryFormGivesTheSameOutline) {
  for (const auto& [name, bytes] : plates()) {
    const ReadOutline read = outline_in(bytes, name);
    ASSERT_EQ(read.outline.regions.size(), 1U) << name;
    EXPECT_NEAR(cases::area_of(read.outline.regions), 3200, 1e-6) << name;
    EXPECT_NEAR(cases::length_of(read.outline.regions), 240, 1e-6) << name;
    EXPECT_LT(read.outline.tolerance, 1e-8) << name;
    EXPECT_EQ(read.outline.labels.size(), 4U) << name;
    EXPECT_FALSE(read.outline.convex.has_value()) << name;
    EXPECT_TRUE(read.open.empty() && !read.scan && !read.contour) << name;
  }
}

TEST(OutlineFile, LayersAndPrimitivesAreTheLabelsOfTheirEdges) {
  const std::vector<std::string> cut(4, "CUT"), none(4, "");
  EXPECT_EQ(outline_in(plates().at("drawing.dxf"), "a.dxf").outline.labels, cut);
  EXPECT_EQ(outline_in(plates().at("regions.JSON"), "a.json").outline.labels, none);
  const std::string named =
      R"({"units": "mm", "shape": {"name": "CUT", "rectangle": {"corner": [0, 0], "size": [80, 40]}}})";
  EXPECT_EQ(outline_in(named, "a.json").outline.labels, cut);
}

TEST(OutlineFile, ItsOptionsReachTheReader) {
  OutlineOptions inches, joined, layer;
  inches.units = LengthUnit::inch;
  EXPECT_NEAR(cases::area_of(outline_in(plates().at("points.csv"), "a.csv", inches).outline.regions),
              3200 * 25.4 * 25.4, 1e-6);
  EXPECT_FALSE(read_outline(plates().at("regions.JSON"), "a.json", inches).has_value());
  // The path ends 0.5 mm from where it begins.
  const std::string open = svg("M0 0H80V40H0V0.5");
  refusal_of(open, "a.svg");
  joined.join = 0.6;
  EXPECT_EQ(outline_in(open, "a.svg", joined).outline.regions.size(), 1U);
  const std::string two = io_cases::dxf_entities(
      io_cases::polyline(kPlate, 0) + io_cases::polyline({{100, 0}, {110, 0}, {110, 10}}, 0, 1, "OTHER"));
  EXPECT_EQ(outline_in(two, "a.dxf").outline.regions.size(), 2U);
  layer.layers = {"OTHER"};
  EXPECT_NEAR(cases::area_of(outline_in(two, "a.dxf", layer).outline.regions), 50, 1e-9);
}

TEST(OutlineFile, ConvexPolygonsAreKnownInEveryFormThatHoldsTheirDecimals) {
  const auto convex = [](const std::string& bytes, const std::string& name, bool only_convex_will_do = false,
                         const OutlineOptions& options = {}) {
    return OutlineFile(bytes, name, options).is_convex(only_convex_will_do);
  };
  for (const char* name : {"points.csv", "points.TXT", "points.json", "regions.JSON", "drawing.dxf"})
    EXPECT_TRUE(convex(plates().at(name), name)) << name;
  for (const char* name : {"tree.json", "drawing.Svg"}) {
    EXPECT_FALSE(convex(plates().at(name), name)) << name;
    EXPECT_FALSE(convex(plates().at(name), name, true)) << name;
  }
  const std::string points = io_cases::csv(kDented, 0),
                    drawing = io_cases::dxf_entities(io_cases::polyline(kDented, 0));
  for (const bool only : {false, true}) {
    EXPECT_EQ(convex(points, "a.csv", only), only);
    EXPECT_EQ(convex(drawing, "a.dxf", only), only);
    EXPECT_FALSE(convex(io_cases::region(kDented, 0), "a.json", only));
  }
  // The reader of contours knows nothing of layers and joining.
  OutlineOptions layers, join, scan;
  layers.layers = {"CUT"};
  join.join = 0.1;
  scan.scan.emplace();
  EXPECT_FALSE(convex(plates().at("drawing.dxf"), "a.dxf", true, layers));
  EXPECT_FALSE(convex(plates().at("drawing.dxf"), "a.dxf", true, join));
  EXPECT_FALSE(convex(plates().at("points.csv"), "a.csv", true, scan));
  // What cannot be read is left to the reader that has the words for it.
  EXPECT_TRUE(convex("0 0\n80 zero\n", "a.csv"));
  EXPECT_EQ(convex("0\nSECTION\n", "a.dxf", true), true);
  EXPECT_EQ(convex("0\nSECTION\n", "a.dxf", false), false);
}

TEST(OutlineFile, AConvexOutlineKeepsTheWayBackToItsFile) {
  // Clockwise, in inches, with a point on an edge and one twice.
  const std::string bytes = "0 0\n0 1\n0 2\n0 2\n4 2\n4 0\n";
  OutlineOptions options;
  options.units = LengthUnit::inch;
  OutlineFile file(bytes, "a.csv", options);
  ASSERT_TRUE(file.is_convex(false));
  const Result<ReadOutline> read = file.as_convex();
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(read->outline.convex && read->contour);
  const locate::ConvexOutline& convex = *read->outline.convex;
  ASSERT_EQ(convex.polygon.size(), 4U);
  ASSERT_EQ(convex.vertex_numbers.size(), 4U);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::uint32_t index = convex.vertex_numbers[k];
    EXPECT_EQ(convex.polygon[k], read->contour->points[index]);
    // The file runs the other way: an edge has the number of the point at which it arrives.
    EXPECT_EQ(convex.edge_numbers[k], convex.vertex_numbers[(k + 1) % 4]);
  }
  EXPECT_EQ(read->contour->unit, LengthUnit::inch);
  EXPECT_EQ(read->contour->points.size(), 6U);
  EXPECT_EQ(read->contour->points[4], (geom::Point{101.6, 50.8}));
  EXPECT_EQ(read->contour->dropped, (std::vector<std::size_t>{1, 3}));
  EXPECT_FALSE(read->contour->trim.has_value());
  EXPECT_EQ(read->notices.size(), 2U);
  EXPECT_TRUE(read->outline.regions.empty());
}

TEST(OutlineFile, TrimmingCutsDentsInwards) {
  const std::string bytes = io_cases::csv(kDented, 0);
  OutlineFile file(bytes, "a.csv", {});
  ASSERT_TRUE(file.is_convex(true));
  EXPECT_FALSE(file.as_convex().has_value());
  EXPECT_FALSE(file.as_convex(0.5).has_value());
  const Result<ReadOutline> read = file.as_convex(1.5);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(read->outline.convex && read->contour && read->contour->trim);
  EXPECT_EQ(read->contour->trim->tolerance, 1.5);
  EXPECT_GE(read->contour->trim->loss, 1);
  EXPECT_EQ(read->contour->trim->contour, read->outline.convex->polygon.vertices());
  EXPECT_TRUE(read->outline.convex->vertex_numbers.empty());
  for (const geom::Point& p : read->contour->trim->contour) EXPECT_LE(p.y, 39);
}

TEST(OutlineFile, AskingWhetherItIsConvexChangesNoAnswer) {
  for (const auto& [name, bytes] : plates()) {
    OutlineFile file(bytes, name, {});
    static_cast<void>(file.is_convex(true));
    const Result<ReadOutline> read = file.as_regions();
    ASSERT_TRUE(read) << name;
    EXPECT_EQ(read->outline.regions, outline_in(bytes, name).outline.regions) << name;
    EXPECT_EQ(read->notices, outline_in(bytes, name).notices) << name;
  }
}

TEST(OutlineFile, PointsThatAreNotConvexComeWithAdvice) {
  const ReadOutline read = outline_in(io_cases::csv(kDented, 0), "a.csv");
  ASSERT_EQ(read.notices.size(), 1U);
  EXPECT_NE(read.notices[0].find("a.csv is not convex and is taken as it is"), std::string::npos);
}

TEST(OutlineFile, PointsThatTurnToAndFroLookMeasured) {
  const auto looks_measured = [](const std::string& bytes) {
    return OutlineFile(bytes, "a.csv", {}).looks_measured();
  };
  const auto round = [](int count, double noise) {
    std::string points;
    Random random(7);
    for (int k = 0; k < count; ++k) {
      const double angle = 2 * std::numbers::pi * k / count, radius = 50 + noise * random.uniform(-1, 1);
      points += fmt::format("{:.4f} {:.4f}\n", radius * std::cos(angle), radius * std::sin(angle));
    }
    return points;
  };
  EXPECT_TRUE(looks_measured(round(400, 0.02)));
  EXPECT_FALSE(looks_measured(round(400, 0)));
  EXPECT_FALSE(looks_measured(round(59, 2)));

  std::string finger_joints, saw;
  for (int k = 0; k < 40; ++k) {
    finger_joints += fmt::format("{0} 0\n{0} 5\n{1} 5\n{1} 0\n", 10 * k, 10 * k + 5);
    saw += fmt::format("{} 0\n{} 8\n", 10 * k, 10 * k + 5);
  }
  EXPECT_FALSE(looks_measured(finger_joints + "400 -90\n0 -90\n"));
  EXPECT_FALSE(looks_measured(saw + "400 -90\n0 -90\n"));
}

TEST(OutlineFile, MeasuredPointsAreOfTheirOptionsOrEnding) {
  OutlineOptions options;
  options.scan.emplace();
  std::string points;
  for (int k = 0; k < 320; ++k) {  // every 0.75 mm along the plate
    const double s = 0.75 * k;
    const auto [x, y] = s < 80    ? std::pair{s, 0.0}
                        : s < 120 ? std::pair{80.0, s - 80}
                        : s < 200 ? std::pair{200 - s, 40.0}
                                  : std::pair{0.0, 240 - s};
    points += fmt::format("{} {}\n", x, y);
  }
  const ReadOutline read = outline_in(points, "a.csv", options);
  ASSERT_TRUE(read.scan.has_value());
  EXPECT_EQ(read.scan->points, 320U);
  EXPECT_LT(cases::area_of(read.outline.regions), 3200);
  const std::string ply = scan_files::ply_ascii({{0, 0, 0}, {80, 0, 0}, {80, 40, 0}});
  EXPECT_FALSE(OutlineFile(ply, "a.PLY", {}).is_convex(true));
}

TEST(OutlineFile, EdgesThatAreNoWallsAreListed) {
  std::string bytes = io_cases::region(kPlate, 0);
  bytes.replace(bytes.find("}}"), 2, R"(}, "open": true})");
  const ReadOutline read = outline_in(bytes, "a.json");
  ASSERT_EQ(read.open.size(), 1U);
  EXPECT_EQ(read.open[0].to, (geom::Point{80, 0}));
}

TEST(OutlineFile, RefusalsNameTheFileAndThePlace) {
  EXPECT_NE(refusal_of("0 0\n1 0\n0 0\n", "a.csv").find("a.csv: fewer than three different points"),
            std::string::npos);
  EXPECT_NE(refusal_of("0 0\n80 zero\n", "b.txt").find("b.txt: line 2"), std::string::npos);
  EXPECT_NE(refusal_of("0 0\n90 50\n90 0\n0 40\n", "c.csv").find("outlines must not meet"),
            std::string::npos);
  EXPECT_NE(refusal_of(R"({"outer": [{"line": {"from": [0, 0], "to": 1}}]})", "d.json").find("d.json"),
            std::string::npos);
  EXPECT_NE(refusal_of("<svg><path d=\"M0 0L1 1\"/></svg>", "e.svg").find("e.svg"), std::string::npos);
  EXPECT_NE(refusal_of("a stone", "f.stl").find("contours are read from"), std::string::npos);
  EXPECT_NE(refusal_of("a stone", "none").find("a name without ending"), std::string::npos);
}

/// By what is in them: names say nothing.
TEST(PartFile, FormsAreToldApartByTheirContent) {
  const auto area = [](const std::string& bytes) {
    const Result<PartsFile> read = read_parts(bytes, "part");
    EXPECT_TRUE(read.has_value()) << (read ? "" : read.error().message);
    return read && read->parts.size() == 1 ? read->parts[0].outline.polygon.points.size() : 0;
  };
  for (const char* name : {"regions.JSON", "tree.json", "drawing.dxf", "drawing.Svg"}) {
    const std::string bytes = plates().at(name);
    EXPECT_EQ(area(bytes), 4U) << name;
    EXPECT_EQ(area("\xef\xbb\xbf" + bytes), 4U) << name;
  }
  EXPECT_EQ(area(" \r\n\t" + plates().at("regions.JSON")), 4U);
  EXPECT_FALSE(read_parts("ply\nformat ascii 1.0\n", "part").has_value());
}

}  // namespace
}  // namespace lekalo::io::io_outline_file_test

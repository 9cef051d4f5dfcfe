#include "lekalo/io/shape/shape_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "lekalo/geom/region_check.hpp"
#include "support/boolean_cases.hpp"
#include "support/places.hpp"

namespace lekalo::io::io_shape_tree_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

std::string document(const std::string& shape) { return R"({"units": "mm", "shape": )" + shape + "}"; }

ShapeFile read(const std::string& shape) {
  auto file = parse_shape_tree(document(shape), "part.json");
  EXPECT_TRUE(file.has_value()) << shape << "\n" << (file ? "" : file.error().message);
  if (!file) return {};
  EXPECT_FALSE(geom::fault_of(file->regions).has_value()) << shape;
  EXPECT_GT(file->tolerance, 0);
  EXPECT_LT(file->tolerance, 1e-8);
  EXPECT_EQ(file->name_of_edge.size(), geom::edges_in(file->regions));
  return *std::move(file);
}

void expect_measures(const std::string& shape, double area, double length) {
  const ShapeFile file = read(shape);
  EXPECT_NEAR(cases::area_of(file.regions), area, 1e-9 * area) << shape;
  EXPECT_NEAR(cases::length_of(file.regions), length, 1e-9 * length) << shape;
}

TEST(ShapeTree, PrimitivesHaveTheirAreaAndPerimeter) {
  expect_measures(R"({"circle": {"centre": [3, -4], "radius": 5}})", 25 * kPi, 10 * kPi);
  expect_measures(R"({"circle": {"diameter": 5}})", 6.25 * kPi, 5 * kPi);
  expect_measures(R"({"rectangle": {"size": [30, 20.5]}})", 615, 101);
  expect_measures(R"({"rectangle": {"corner": [1, 2], "size": [3, 4]}})", 12, 14);
  expect_measures(R"({"rounded_rectangle": {"size": [30, 20], "radius": 4}})", 600 - 64 + 16 * kPi,
                  100 - 32 + 8 * kPi);
  expect_measures(R"({"slot": {"from": [0, 0], "to": [30, 40], "width": 10}})", 500 + 25 * kPi,
                  100 + 10 * kPi);
  expect_measures(R"({"regular_polygon": {"sides": 6, "across_flats": 10}})", 50 * std::sqrt(3.0),
                  60 / std::sqrt(3.0));
  expect_measures(R"({"regular_polygon": {"sides": 4, "radius": 10, "corner_deg": 12}})", 200,
                  40 * std::sqrt(2.0));
  expect_measures(R"({"regular_polygon": {"sides": 5, "radius": 2}})", 10 * std::sin(0.4 * kPi),
                  20 * std::sin(0.2 * kPi));
  expect_measures(R"({"polygon": [[0, 0], [0, 3], [4, 0]]})", 6, 12);
  expect_measures(
      R"({"region": {"outer": [{"arc": {"from": [1, 0], "to": [-1, 0], "centre": [0, 0], "ccw": true}},
      {"line": {"from": [-1, 0], "to": [1, 0]}}]}})",
      0.5 * kPi, kPi + 2);
}

TEST(ShapeTree, RoundedCornersThatMeetLeaveNoSides) {
  expect_measures(R"({"rounded_rectangle": {"size": [30, 20], "radius": 10}})", 200 + 100 * kPi,
                  20 + 20 * kPi);
  EXPECT_EQ(read(R"({"rounded_rectangle": {"size": [30, 20], "radius": 10}})").regions[0].outer.size(), 6u);
  EXPECT_EQ(read(R"({"rounded_rectangle": {"size": [0.3, 0.3], "radius": 0.15}})").regions[0].outer.size(),
            1u);
}

TEST(ShapeTree, QuarterTurnsMirrorsAndMovesOnAGridAreExact) {
  const std::string slot = R"({"slot": {"from": [10, 2], "to": [30, 2], "width": 4}})";
  const auto same = [](const ShapeFile& a, const ShapeFile& b) {
    EXPECT_EQ(a.regions.size(), 1u);
    EXPECT_EQ(cases::area_of(a.regions), cases::area_of(b.regions));
    for (const geom::Edge& e : a.regions[0].outer) {
      const auto& outer = b.regions[0].outer;
      EXPECT_NE(std::find(outer.begin(), outer.end(), e), outer.end());
    }
  };
  const ShapeFile plain = read(slot);
  std::string turned = slot;
  for (int i = 0; i < 4; ++i)
    turned = R"({"rotate": {"by_deg": 90, "about": [7, 9], "shape": )" + turned + "}}";
  same(read(turned), plain);
  same(read(R"({"rotate": {"by_deg": -270, "shape": )" + slot + "}}"),
       read(R"({"slot": {"from": [-2, 10], "to": [-2, 30], "width": 4}})"));
  same(read(R"({"rotate": {"by_deg": 540, "shape": )" + slot + "}}"),
       read(R"({"slot": {"from": [-10, -2], "to": [-30, -2], "width": 4}})"));
  same(read(R"({"mirror": {"flip": "x", "shape": )" + slot + "}}"),
       read(R"({"slot": {"from": [-10, 2], "to": [-30, 2], "width": 4}})"));
  same(read(R"({"mirror": {"flip": "y", "shape": )" + slot + "}}"),
       read(R"({"slot": {"from": [10, -2], "to": [30, -2], "width": 4}})"));
  same(read(R"({"mirror": {"from": [0, 0], "to": [3, 3], "shape": )" + slot + "}}"),
       read(R"({"slot": {"from": [2, 10], "to": [2, 30], "width": 4}})"));
  same(read(R"({"mirror": {"from": [5, 1], "to": [5, 0], "shape": )" + slot + "}}"),
       read(R"({"slot": {"from": [0, 2], "to": [-20, 2], "width": 4}})"));
  same(read(R"({"scale": {"by": 0.5, "about": [10, 2], "shape": )" + slot + "}}"),
       read(R"({"slot": {"from": [10, 2], "to": [20, 2], "width": 2}})"));
  same(read(R"({"move": {"by": [-10, 0.5], "shape": )" + slot + "}}"),
       read(R"({"slot": {"from": [0, 2.5], "to": [20, 2.5], "width": 4}})"));
}

TEST(ShapeTree, HalfPlanesCutWhatSomethingElseBounds) {
  const std::string disc = R"({"circle": {"radius": 10}})";
  const std::string right = R"({"half_plane": {"from": [0, 1], "to": [0, 0]}})";  // left of downwards: x > 0
  expect_measures(R"({"intersection": [)" + disc + "," + right + "]}", 50 * kPi, 10 * kPi + 20);
  expect_measures(R"({"intersection": [)" + right + "," + disc + "]}", 50 * kPi, 10 * kPi + 20);
  expect_measures(R"({"difference": [)" + disc + "," + right + "]}", 50 * kPi, 10 * kPi + 20);
  const ShapeFile kept = read(R"({"intersection": [)" + disc + "," + right + "]}"),
                  rest = read(R"({"difference": [)" + disc + "," + right + "]}");
  for (const geom::Edge& e : kept.regions.at(0).outer) EXPECT_GE(std::min(e.from.x, e.to.x), 0);
  for (const geom::Edge& e : rest.regions.at(0).outer) EXPECT_LE(std::max(e.from.x, e.to.x), 0);
  // A union with a half-plane may stand below something bounded; a half-plane may miss or hold everything.
  expect_measures(R"({"intersection": [)" + disc + R"(, {"union": [)" + right +
                      R"(, {"rectangle": {"corner": [-4, -1], "size": [5, 2]}}]}]})",
                  50 * kPi + 8, 10 * kPi + 20 + 8);
  expect_measures(R"({"difference": [)" + disc + R"(, {"half_plane": {"from": [50, 1], "to": [50, 0]}}]})",
                  100 * kPi, 20 * kPi);
  expect_measures(
      R"({"intersection": [)" + disc + R"(, {"half_plane": {"from": [-50, 1], "to": [-50, 0]}}]})", 100 * kPi,
      20 * kPi);
  // Half-planes alone, when they enclose something; turned, mirrored and scaled.
  const std::string three =
      R"({"intersection": [{"half_plane": {"from": [0, 0], "to": [1, 0]}}, {"half_plane": {"from": [0, 5], "to": [0, 0]}},
          {"half_plane": {"from": [3, 0], "to": [0, 4]}}]})";
  expect_measures(three, 6, 12);
  expect_measures(R"({"rotate": {"by_deg": 33, "about": [100, 4], "shape": )" + three + "}}", 6, 12);
  expect_measures(R"({"mirror": {"from": [1, 0], "to": [2, 7], "shape": )" + three + "}}", 6, 12);
  expect_measures(R"({"intersection": [{"scale": {"by": 2, "shape": {"mirror": {"flip": "x", "shape": )" +
                      right + "}}}}, " + disc + "]}",
                  50 * kPi, 10 * kPi + 20);
}

TEST(ShapeTree, InchesAndTheUnitAskedFor) {
  const std::string square = R"("shape": {"rectangle": {"size": [1, 1]}}})";
  const auto inches = parse_shape_tree(R"({"units": "inch", )" + square, "p");
  ASSERT_TRUE(inches.has_value());
  EXPECT_EQ(inches->unit, LengthUnit::inch);
  EXPECT_NEAR(cases::area_of(inches->regions), 25.4 * 25.4, 1e-9);
  const auto asked = parse_shape_tree("{" + square, "p", LengthUnit::inch);
  ASSERT_TRUE(asked.has_value());
  EXPECT_EQ(asked->regions, inches->regions);
  EXPECT_FALSE(parse_shape_tree(R"({"units": "mm", )" + square, "p", LengthUnit::inch).has_value());
}

TEST(ShapeTree, EdgesKnowTheNameNearestToTheirPrimitive) {
  std::ifstream in(cases::source_dir() + "/examples/regions/flange.json");
  std::stringstream text;
  text << in.rdbuf();
  const auto file = parse_shape_tree(text.str(), "flange.json");
  ASSERT_TRUE(file.has_value()) << file.error().message;
  ASSERT_EQ(file->regions.size(), 1u);
  EXPECT_EQ(file->regions[0].holes.size(), 9u);
  EXPECT_LT(file->tolerance, 1e-9);
  EXPECT_FALSE(geom::fault_of(file->regions).has_value());
  std::vector<std::string> found;
  const auto look = [&](const geom::Contour& contour, std::size_t& edge) {
    for (const geom::Edge& e : contour) {
      const std::uint32_t name = file->name_of_edge.at(edge++);
      ASSERT_NE(name, kNoName);
      const std::string& said = file->names.at(name);
      found.push_back(said);
      const bool arc = e.kind != geom::EdgeKind::line;
      EXPECT_TRUE(said != "rim" || (arc && std::abs(geom::arc_radius(e) - 60) < 1e-9));
      EXPECT_TRUE(said != "bore" || (arc && std::abs(geom::arc_radius(e) - 31) < 1e-9));
      EXPECT_TRUE(said != "bolt holes" || (arc && geom::arc_radius(e) < 6.6));
      EXPECT_TRUE(said != "flat" || (!arc && e.from.x == -52 && e.to.x == -52));
      EXPECT_TRUE(said != "nut pocket" || (!arc && e.from.y < -45));
    }
  };
  std::size_t edge = 0;
  look(file->regions[0].outer, edge);
  for (const geom::Contour& hole : file->regions[0].holes) look(hole, edge);
  const auto count = [&](const char* name) { return std::count(found.begin(), found.end(), name); };
  EXPECT_EQ(count("bolt holes"), 6);
  EXPECT_EQ(count("bore"), 1);
  EXPECT_EQ(count("flat"), 1);
  EXPECT_EQ(count("slot"), 4);
  EXPECT_EQ(count("nut pocket"), 6);
  EXPECT_EQ(count("rim"), 3);
  EXPECT_EQ(count("ears"), 8);
}

TEST(ShapeTree, NamesWithoutAndOfCoincidingEdges) {
  const ShapeFile file = read(R"({"difference": [{"rectangle": {"size": [10, 10]}},
      {"rectangle": {"corner": [0, -5], "size": [5, 5]}, "name": "notch"}]})");
  std::size_t notch = 0;
  for (const std::uint32_t name : file.name_of_edge) notch += name == 0 ? 1 : 0;
  EXPECT_EQ(notch, 2u);  // the two sides that coincide with the part's lie outside the result
  EXPECT_EQ(file.name_of_edge.size(), 6u);
}

TEST(ShapeTree, RefusesWithOneSentenceThatNamesThePlace) {
  struct Case {
    std::string shape;
    const char* said;
  };
  const std::string disc = R"({"circle": {"radius": 1}})";
  std::string deep = disc;
  for (int i = 0; i < 70; ++i) deep = R"({"union": [)" + deep + "]}";
  std::string many = disc;
  for (int i = 0; i < 10'000; ++i) many += "," + disc;
  const std::string half_plane = R"({"half_plane": {"from": [0, 0], "to": [1, 0]}})";
  std::string half_planes = disc;
  for (int i = 0; i < 1'001; ++i) half_planes += "," + half_plane;
  const Case cases[] = {
      {"{}", "no shape here"},
      {"[]", "a shape is an object, not array"},
      {R"({"name": "x"})", "no shape here"},
      {R"({"cone": {}})", "shape: unknown word \"cone\""},
      {R"({"circle": {"radius": 1}, "slot": {}})", "together"},
      {R"({"circle": {"radius": 1}, "name": ""})", "\"name\" must be a text"},
      {R"({"circle": {"radius": 1}, "name": 3})", "\"name\" must be a text"},
      {R"({"difference": [)" + disc + R"(, {"circle": {"radius": -3}}]})",
       "shape.difference[1].circle: \"radius\" is -3"},
      {R"({"difference": [)" + disc + R"(, {"circle": {"radios": 3}}]})",
       "shape.difference[1].circle: unknown word \"radios\""},
      {R"({"circle": {}})", "one of these is missing: radius, diameter"},
      {R"({"circle": {"radius": 1, "diameter": 2}})", "together; give one"},
      {R"({"circle": {"radius": "1"}})", "\"radius\" must be a number, not string"},
      {R"({"circle": {"radius": 1e10}})", "numbers go up to 1e+09"},
      {R"({"circle": {"radius": 1e-300}})", "shape.circle: "},
      {R"({"circle": {"radius": 9e8, "centre": [9e8, 0]}})", "coordinates go up to"},
      {R"({"circle": {"radius": 1, "centre": [1]}})", "shape.circle.centre: two numbers"},
      {R"({"circle": {"radius": 1, "centre": [1, 1e11]}})",
       "shape.circle.centre: [1, 100000000000] is too far out"},
      {R"({"rectangle": {"size": [3, 0]}})", "width and height must be above 0"},
      {R"({"rectangle": {}})", "\"size\" is missing"},
      {R"({"rectangle": {"size": [3, 1], "corner": [0, 0], "centre": [0, 0]}})", "give one"},
      {R"({"rounded_rectangle": {"size": [3, 1], "radius": 0.6}})", "half of the shorter side, 0.5"},
      {R"({"rounded_rectangle": {"size": [3, 1]}})", "\"radius\" is missing"},
      {R"({"slot": {"from": [3, 1], "to": [3, 1], "width": 2}})", "are one point"},
      {R"({"slot": {"from": [3, 1], "to": [4, 1]}})", "\"width\" is missing"},
      {R"({"regular_polygon": {"sides": 2, "radius": 1}})", "whole number from 3"},
      {R"({"regular_polygon": {"sides": 6.5, "radius": 1}})", "whole number from 3"},
      {R"({"regular_polygon": {"sides": -6, "radius": 1}})", "whole number from 3"},
      {R"({"regular_polygon": {"sides": 5, "across_flats": 1}})", "no two sides are parallel"},
      {R"({"polygon": [[0, 0], [1, 1]]})", "at least three points"},
      {R"({"polygon": [[0, 0], [1, 1], 3]})", "shape.polygon[2]: two numbers"},
      {R"({"polygon": [[0, 0], [1, 1], [2, 2]]})", "shape.polygon: "},
      {R"({"polygon": [[0, 0], [4, 4], [4, 0], [0, 3]]})", "shape.polygon: "},
      {R"({"region": {"outer": []}})", "shape.region"},
      {R"({"region": {"outer": [{"arc": {"from": [1, 0], "to": [1, 0], "centre": [0, 0], "ccw": true}}],
           "holes": [[{"arc": {"from": [2, 0], "to": [2, 0], "centre": [1, 0], "ccw": true}}]]}})",
       "shape.region: "},
      {R"({"half_plane": {"from": [0, 0], "to": [0, 0]}})", "too near each other"},
      {R"({"half_plane": {"from": [0, 0], "to": [0, 1]}})", "the shape has no end"},
      {R"({"union": [)" + disc + R"(, {"half_plane": {"from": [0, 0], "to": [0, 1]}}]})",
       "the shape has no end"},
      {R"({"intersection": [{"half_plane": {"from": [0, 0], "to": [0, 1]}}, {"half_plane": {"from": [0, 0], "to": [1, 0]}}]})",
       "the shape has no end"},
      {R"({"union": []})", "a list of at least one shape"},
      {R"({"union": {}})", "a list of at least one shape"},
      {R"({"difference": [)" + disc + "," + disc + "]}", "nothing is left"},
      {R"({"intersection": [)" + disc + R"(, {"circle": {"radius": 1, "centre": [9, 9]}}]})",
       "nothing is left"},
      {R"({"intersection": [{"half_plane": {"from": [0, 0], "to": [0, 1]}}, {"half_plane": {"from": [1, 1], "to": [1, 0]}}]})",
       "nothing is left"},
      {R"({"move": {"shape": )" + disc + "}}", "\"by\" is missing"},
      {R"({"move": {"by": [1, 2]}})", "\"shape\", what it does this to, is missing"},
      {R"({"move": {"by": [1e9, 2], "shape": )" + disc + "}}", "coordinates go up to"},
      {R"({"rotate": {"shape": )" + disc + "}}", "\"by_deg\" is missing"},
      {R"({"rotate": {"by_deg": 3, "shape": {"circle": {"radius": 0}}}})",
       "shape.rotate.shape.circle: \"radius\" is 0"},
      {R"({"scale": {"by": 0, "shape": )" + disc + "}}", "a factor from 1e-06"},
      {R"({"scale": {"by": -2, "shape": )" + disc + "}}", "a factor from 1e-06"},
      {R"({"mirror": {"flip": "z", "shape": )" + disc + "}}", "\"flip\" must be"},
      {R"({"mirror": {"flip": [[[]]], "shape": )" + disc + "}}", "\"flip\" must be"},
      {R"({"mirror": {"flip": "x", "from": [0, 0], "shape": )" + disc + "}}", "together"},
      {R"({"mirror": {"from": [0, 0], "shape": )" + disc + "}}", "\"to\" is missing"},
      {R"({"mirror": {"from": [0, 0], "to": [0, 0], "shape": )" + disc + "}}", "are one point"},
      {deep, "nested more than 64 deep"},
      {R"({"union": [)" + many + "]}", "more than 10000 primitives"},
      {R"({"intersection": [)" + half_planes + "]}", "more than 1000 half-planes; give what they enclose"},
  };
  for (const Case& c : cases) {
    const auto file = parse_shape_tree(document(c.shape), "part.json");
    const std::string shown = c.shape.substr(0, 200);
    ASSERT_FALSE(file.has_value()) << shown;
    EXPECT_EQ(file.error().code, ErrorCode::bad_input) << shown;
    EXPECT_EQ(file.error().message.find("part.json: shape"), 0u) << file.error().message;
    EXPECT_NE(file.error().message.find(c.said), std::string::npos) << file.error().message << "\n" << shown;
    EXPECT_EQ(file.error().message.find('\n'), std::string::npos) << file.error().message;
  }
  for (const char* bad :
       {"", "{}", "[]", "3", R"({"shape": {}, "sape": 3})", R"({"units": "m", "shape": {}})"}) {
    const auto file = parse_shape_tree(bad, "part.json");
    ASSERT_FALSE(file.has_value()) << bad;
    EXPECT_EQ(file.error().message.find("part.json"), 0u) << file.error().message;
  }
}

TEST(ShapeTree, BracketsWithoutEndAreRefused) {
  const std::string opened(1'000'000, '['), closed(1'000'000, ']');
  EXPECT_FALSE(parse_shape_tree(document(opened + closed), "p").has_value());
  EXPECT_FALSE(parse_shape_tree(opened, "p").has_value());
  for (const char* key : {"units", "shape", "name"}) {
    const std::string bytes = "{\"" + std::string(key) + "\": " + opened + closed + "}";
    EXPECT_FALSE(parse_shape_tree(bytes, "p").has_value()) << key;
  }
}

}  // namespace
}  // namespace lekalo::io::io_shape_tree_test

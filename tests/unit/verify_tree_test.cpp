#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "support/drawn_text.hpp"
#include "verify/origin/tree.hpp"
#include "verify/origin/tree_check.hpp"
#include "verify/read/json.hpp"

/// What the checker takes a tree of shapes for, and which regions it accepts as what the tree means.
namespace lekalo::verify::verify_tree_test {
namespace {

std::string told(const Tree& tree, std::size_t node) {
  const Tree::Node& at = tree.nodes[node];
  if (at.kind == Tree::Kind::primitive) {
    const Primitive& primitive = tree.primitives[at.primitive];
    std::string text = primitive.name + (primitive.half_plane ? "half" : "") + "[";
    for (const Side& side : primitive.shape.sides) text += cases::drawn_side(side);
    return text + " ]";
  }
  std::string text = at.kind == Tree::Kind::unite ? "U(" : at.kind == Tree::Kind::intersect ? "I(" : "D(";
  for (const std::size_t child : at.children) text += told(tree, child);
  return text + ")";
}
std::string read(const std::string& shape, LengthUnit unit = LengthUnit::millimetre) {
  const Result<Json> json = parse_json(shape, "t.json");
  if (!json) return json.error().message;
  std::string complaint;
  const Tree tree = read_tree(*json, unit, complaint);
  return complaint.empty() ? told(tree, tree.nodes.size() - 1) : complaint;
}

TEST(VerifyTree, PrimitivesAreTheirSides) {
  EXPECT_EQ(read(R"({"circle": {"radius": 5}})"), "[ A 0,0 5 5,0 5,0 o ]");
  EXPECT_EQ(read(R"({"circle": {"centre": [1, 2], "diameter": 10}})"), "[ A 1,2 5 6,2 6,2 o ]");
  EXPECT_EQ(read(R"({"circle": {"centre": [1, 2], "radius": 1}})", LengthUnit::inch),
            "[ A 25.4,50.8 25.4 50.8,50.8 50.8,50.8 o ]");
  EXPECT_EQ(read(R"({"rectangle": {"size": [4, 2]}})"),
            "[ L -2,-1 2,-1 L 2,-1 2,1 L 2,1 -2,1 L -2,1 -2,-1 ]");
  EXPECT_EQ(read(R"({"rectangle": {"size": [4, 2], "centre": [5, 6]}})"),
            "[ L 3,5 7,5 L 7,5 7,7 L 7,7 3,7 L 3,7 3,5 ]");
  EXPECT_EQ(read(R"({"rectangle": {"size": [4, 2], "corner": [5, 6]}})"),
            "[ L 5,6 9,6 L 9,6 9,8 L 9,8 5,8 L 5,8 5,6 ]");
  EXPECT_EQ(read(R"({"rectangle": {"size": [0.5, 0.5], "corner": [0, 0]}})"),
            "[ L 0,0 0.5,0 L 0.5,0 0.5,0.5 L 0.5,0.5 0,0.5 L 0,0.5 0,0 ]");
  EXPECT_EQ(read(R"({"polygon": [[0, 0], [4, 0], [0, 3]]})"), "[ L 0,0 4,0 L 4,0 0,3 L 0,3 0,0 ]");
  EXPECT_EQ(read(R"({"half_plane": {"from": [0, 0], "to": [1, 2]}})"), "half[ L 0,0 1,2 ]");
  EXPECT_EQ(read(R"({"slot": {"from": [0, 0], "to": [10, 0], "width": 4}})"),
            "[ L 0,-2 10,-2 A 10,0 2 10,-2 10,2 = L 10,2 0,2 A 0,0 2 0,2 0,-2 = ]");
  EXPECT_EQ(read(R"({"regular_polygon": {"sides": 4, "radius": 5}})"),
            "[ L 5,0 0,5 L 0,5 -5,0 L -5,0 0,-5 L 0,-5 5,0 ]");
  EXPECT_EQ(
      read(R"({"regular_polygon": {"sides": 4, "across_flats": 6, "corner_deg": 45, "centre": [1, 1]}})"),
      "[ L 4,4 -2,4 L -2,4 -2,-2 L -2,-2 4,-2 L 4,-2 4,4 ]");
  EXPECT_EQ(read(R"({"regular_polygon": {"sides": 3, "radius": 2}})"),
            "[ L 2,0 -1,1.732 L -1,1.732 -1,-1.732 L -1,-1.732 2,0 ]");
  EXPECT_EQ(
      read(
          R"({"region": {"outer": [{"line": {"from": [0, 0], "to": [4, 0]}}, {"line": {"from": [4, 0], "to": [0, 3]}},
                                        {"line": {"from": [0, 3], "to": [0, 0]}}]}})"),
      "[ L 0,0 4,0 L 4,0 0,3 L 0,3 0,0 ]");
}

TEST(VerifyTree, RoundedRectanglesLoseTheSidesThatTheirQuartersLeaveNothingOf) {
  EXPECT_EQ(read(R"({"rounded_rectangle": {"size": [10, 6], "corner": [0, 0], "radius": 1}})"),
            "[ L 1,0 9,0 A 9,1 1 9,0 10,1 - L 10,1 10,5 A 9,5 1 10,5 9,6 - L 9,6 1,6 A 1,5 1 1,6 0,5 - L 0,5 "
            "0,1 A 1,1 1 0,1 1,0 - ]");
  EXPECT_EQ(
      read(R"({"rounded_rectangle": {"size": [10, 6], "corner": [0, 0], "radius": 3}})"),
      "[ L 3,0 7,0 A 7,3 3 7,0 10,3 - A 7,3 3 10,3 7,6 - L 7,6 3,6 A 3,3 3 3,6 0,3 - A 3,3 3 0,3 3,0 - ]");
  EXPECT_EQ(
      read(R"({"rounded_rectangle": {"size": [6, 10], "corner": [0, 0], "radius": 3}})"),
      "[ A 3,3 3 3,0 6,3 - L 6,3 6,7 A 3,7 3 6,7 3,10 - A 3,7 3 3,10 0,7 - L 0,7 0,3 A 3,3 3 0,3 3,0 - ]");
}

TEST(VerifyTree, ListsAreOperationsAndNamesAreInherited) {
  const std::string c = R"({"circle": {"radius": 5}})", circle = "[ A 0,0 5 5,0 5,0 o ]";
  EXPECT_EQ(read(R"({"union": [)" + c + ", " + c + "]}"), "U(" + circle + circle + ")");
  EXPECT_EQ(read(R"({"intersection": [)" + c + "]}"), "I(" + circle + ")");
  EXPECT_EQ(read(R"({"difference": [)" + c + R"(, {"union": [)" + c + "]}]}"),
            "D(" + circle + "U(" + circle + "))");
  EXPECT_EQ(read(R"({"name": "a", "union": [)" + c + R"(, {"name": "b", "circle": {"radius": 5}}]})"),
            "U(a" + circle + "b" + circle + ")");
  EXPECT_EQ(read(R"({"move": {"by": [0, 0], "shape": {"circle": {"radius": 5}}}, "name": "m"})"),
            "m" + circle);
}

TEST(VerifyTree, MapsMoveWhatIsBelowThem) {
  const auto mapped = [](const std::string& word, const std::string& how) {
    return read("{\"" + word + "\": {" + how +
                R"(, "shape": {"slot": {"from": [0, 0], "to": [10, 0], "width": 4}}}})");
  };
  const auto half = [](const std::string& word, const std::string& how) {
    return read("{\"" + word + "\": {" + how +
                R"(, "shape": {"half_plane": {"from": [1, 0], "to": [3, 0]}}}})");
  };
  EXPECT_EQ(mapped("move", R"("by": [5, 6])"),
            "[ L 5,4 15,4 A 15,6 2 15,4 15,8 = L 15,8 5,8 A 5,6 2 5,8 5,4 = ]");
  EXPECT_EQ(mapped("rotate", R"("by_deg": 90)"),
            "[ L 2,0 2,10 A 0,10 2 2,10 -2,10 = L -2,10 -2,0 A 0,0 2 -2,0 2,0 = ]");
  EXPECT_EQ(mapped("rotate", R"("by_deg": 90, "about": [10, 0])"),
            "[ L 12,-10 12,0 A 10,0 2 12,0 8,0 = L 8,0 8,-10 A 10,-10 2 8,-10 12,-10 = ]");
  EXPECT_EQ(mapped("scale", R"("by": 2)"),
            "[ L 0,-4 20,-4 A 20,0 4 20,-4 20,4 = L 20,4 0,4 A 0,0 4 0,4 0,-4 = ]");
  EXPECT_EQ(mapped("scale", R"("by": 0.5, "about": [10, 0])"),
            "[ L 5,-1 10,-1 A 10,0 1 10,-1 10,1 = L 10,1 5,1 A 5,0 1 5,1 5,-1 = ]");
  EXPECT_EQ(mapped("mirror", R"("flip": "x")"),
            "[ L 0,-2 -10,-2 A -10,0 2 -10,-2 -10,2 = L -10,2 0,2 A 0,0 2 0,2 0,-2 = ]");
  EXPECT_EQ(mapped("mirror", R"("flip": "y")"),
            "[ L 0,2 10,2 A 10,0 2 10,2 10,-2 = L 10,-2 0,-2 A 0,0 2 0,-2 0,2 = ]");
  EXPECT_EQ(mapped("mirror", R"("from": [0, 5], "to": [3, 5])"),
            "[ L 0,12 10,12 A 10,10 2 10,12 10,8 = L 10,8 0,8 A 0,10 2 0,8 0,12 = ]");
  EXPECT_EQ(half("move", R"("by": [5, 6])"), "half[ L 6,6 8,6 ]");
  EXPECT_EQ(half("mirror", R"("flip": "x")"), "half[ L -3,0 -1,0 ]");
  EXPECT_EQ(half("mirror", R"("flip": "y")"), "half[ L 3,0 1,0 ]");
  EXPECT_EQ(half("mirror", R"("from": [0, 0], "to": [1, 1])"), "half[ L 0,3 0,1 ]");
  EXPECT_EQ(
      read(
          R"({"move": {"by": [1, 0], "shape": {"scale": {"by": 2, "shape": {"half_plane": {"from": [1, 0], "to": [3, 0]}}}}}})"),
      "half[ L 3,0 7,0 ]");
  EXPECT_EQ(read(R"({"union": [{"half_plane": {"from": [1, 0], "to": [3, 0]}},
                     {"move": {"by": [0, 7], "shape": {"half_plane": {"from": [1, 0], "to": [3, 0]}}}}]})"),
            "U(half[ L 1,0 3,0 ]half[ L 1,7 3,7 ])");
}

TEST(VerifyTree, WhatItDoesNotKnowIsRefusedWithItsPlace) {
  const auto refused = [](const std::string& shape) { return read("{" + shape + "}"); };
  EXPECT_EQ(read("3"), "shape is not an object");
  EXPECT_EQ(read("{}"), "shape. is not an object");
  EXPECT_EQ(refused(R"("ball": {"radius": 5})"), "shape.ball: \"ball\" is no shape");
  EXPECT_EQ(refused(R"("circle": {"radius": 5}, "slot": {})"), "shape has two words for its shape");
  EXPECT_EQ(refused(R"("circle": {"radius": 5, "colour": 1})"), "shape.circle: \"colour\" is no word here");
  EXPECT_EQ(refused(R"("circle": {"radius": 5}, "name": "")"), "shape.name is empty");
  const std::string edges =
      R"({"line": {"from": [4, 0], "to": [0, 3]}}, {"line": {"from": [0, 3], "to": [0, 0]}}]})";
  EXPECT_EQ(
      refused(R"("region": {"outer": [{"line": {"from": [0, 0], "to": [4, 0]}, "colour": 1}, )" + edges),
      "field outer[0].colour is not one of a region file");
  EXPECT_EQ(refused(R"("region": {"hols": [], "outer": [{"line": {"from": [0, 0], "to": [4, 0]}}, )" + edges),
            "shape.region: \"hols\" is no word here");
  EXPECT_EQ(refused(R"("circle": 5)"), "shape.circle is not an object");
  EXPECT_EQ(refused(R"("union": [])"), "shape.union is not a list of shapes");
  EXPECT_EQ(refused(R"("union": {})"), "shape.union is not a list of shapes");
  EXPECT_EQ(refused(R"("union": {"a": {"circle": {"radius": 1}}})"), "shape.union is not a list of shapes");
  EXPECT_EQ(refused(R"("union": [{"circle": {"radius": 0}}])"),
            "shape.union[0].circle.radius is not above 0");
  EXPECT_EQ(refused(R"("circle": {"radius": 0})"), "shape.circle.radius is not above 0");
  EXPECT_EQ(refused(R"("circle": {"radius": -1})"), "shape.circle.radius is not above 0");
  EXPECT_EQ(refused(R"("circle": {"radius": 1, "centre": [1]})"), "shape.circle.centre is not two numbers");
  EXPECT_EQ(refused(R"("circle": {"radius": 1, "centre": [1, 2, 3]})"),
            "shape.circle.centre is not two numbers");
  EXPECT_EQ(refused(R"("circle": {"radius": 1, "centre": [1, "2"]})"),
            "shape.circle.centre is not two numbers");
  EXPECT_EQ(refused(R"("circle": {"radius": 1, "centre": 1})"), "shape.circle.centre is not two numbers");
  for (const char* size : {"[0, 1]", "[1, 0]", "[-1, 1]", "[1, -1]"})
    EXPECT_EQ(refused(R"("rectangle": {"size": )" + std::string(size) + "}"),
              "shape.rectangle.size is not above 0")
        << size;
  EXPECT_EQ(refused(R"("polygon": [[0, 0], [1, 0]])"), "shape.polygon has fewer than three points");
  EXPECT_EQ(refused(R"("polygon": 3)"), "shape.polygon is not a list of points");
  EXPECT_EQ(refused(R"("slot": {"from": [1, 1], "to": [1, 1], "width": 4})"),
            "shape.slot is a slot of no length");
  EXPECT_EQ(refused(R"("regular_polygon": {"sides": 2, "radius": 1})"),
            "shape.regular_polygon.sides is out of range");
  EXPECT_EQ(refused(R"("regular_polygon": {"sides": 10000, "radius": 1})").substr(0, 2), "[ ");
  EXPECT_EQ(refused(R"("regular_polygon": {"sides": 10001, "radius": 1})"),
            "shape.regular_polygon.sides is out of range");
  EXPECT_EQ(refused(R"("scale": {"by": 0, "shape": {"circle": {"radius": 1}}})"),
            "shape.scale.by is not above 0");
  EXPECT_EQ(refused(R"("mirror": {"flip": "z", "shape": {"circle": {"radius": 1}}})"),
            "shape.mirror.flip is neither x nor y");
  EXPECT_EQ(refused(R"("mirror": {"from": [1, 1], "to": [1, 1], "shape": {"circle": {"radius": 1}}})"),
            "shape.mirror is a line through one point twice");
  for (const char* words : {R"("move": {"by": [0, 0], "x": 1)", R"("rotate": {"by_deg": 0, "x": 1)",
                            R"("scale": {"by": 1, "x": 1)", R"("mirror": {"flip": "x", "x": 1)",
                            R"("mirror": {"from": [0, 0], "to": [1, 0], "x": 1)"})
    EXPECT_NE(refused(words + std::string(R"(, "shape": {"circle": {"radius": 1}}})"))
                  .find("\"x\" is no word here"),
              std::string::npos)
        << words;
}

// ---- what a tree means ------------------------------------------------------------------------------------

/// Says "" where the region is what the tree means, else the fault, or "open: ".
std::string judged(const std::string& shape, const std::string& region, double reach = 1e-6) {
  std::string complaint;
  const Tree tree = read_tree(*parse_json(shape, "t.json"), LengthUnit::millimetre, complaint);
  const Shape used = read_shape(*parse_json(region, "r.json"), "r.json", complaint, false);
  if (!complaint.empty()) return complaint;
  const TreeVerdict verdict = check_tree(tree, used, reach);
  if (!verdict.fault.empty()) return "wrong";
  return verdict.open.empty() ? "" : "open";
}
std::string polygon(const std::vector<std::array<double, 2>>& p, const std::string& holes = "") {
  std::string edges;
  for (std::size_t k = 0; k < p.size(); ++k)
    edges += fmt::format(R"({}{{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", k == 0 ? "" : ", ", p[k][0],
                         p[k][1], p[(k + 1) % p.size()][0], p[(k + 1) % p.size()][1]);
  return R"({"outer": [)" + edges + "]" + (holes.empty() ? "" : R"(, "holes": [)" + holes + "]") + "}";
}
const std::string kRound = R"([{"arc": {"from": [6, 5], "to": [6, 5], "centre": [5, 5], "ccw": false}}])";
const std::string kSquare = R"({"rectangle": {"size": [10, 10], "corner": [0, 0]}})",
                  kDisc = R"({"circle": {"centre": [5, 5], "radius": 1}})";

TEST(VerifyTree, ARegionIsWhatTheTreeMeans) {
  const std::string square = polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}});
  EXPECT_EQ(judged(kSquare, square), "");
  EXPECT_EQ(judged(kSquare, polygon({{0, 0}, {10, 0}, {10, 10.1}, {0, 10}})), "wrong");
  EXPECT_EQ(judged(kSquare, polygon({{0, 0}, {10, 0}, {10, 9}, {0, 9}})), "wrong");
  EXPECT_EQ(judged(R"({"union": [)" + kSquare + ", " + kDisc + "]}", square), "");
  EXPECT_EQ(judged(R"({"intersection": [)" + kSquare + ", " + kDisc + "]}", square), "wrong");
  EXPECT_EQ(judged(R"({"difference": [)" + kSquare + ", " + kDisc + "]}", square), "wrong");
  EXPECT_EQ(judged(R"({"difference": [)" + kSquare + ", " + kDisc + "]}",
                   polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, kRound)),
            "");
  EXPECT_EQ(judged(kSquare, polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, kRound)), "wrong");
  EXPECT_EQ(judged(R"({"union": [)" + kSquare + R"(, {"rectangle": {"size": [10, 4], "corner": [5, 3]}}]})",
                   polygon({{0, 0}, {10, 0}, {10, 3}, {15, 3}, {15, 7}, {10, 7}, {10, 10}, {0, 10}})),
            "");
  EXPECT_EQ(judged(R"({"union": [)" + kSquare + R"(, {"rectangle": {"size": [10, 4], "corner": [5, 3]}}]})",
                   square),
            "wrong");
  EXPECT_EQ(
      judged(R"({"intersection": [)" + kSquare + R"(, {"half_plane": {"from": [4, 10], "to": [4, 0]}}]})",
             polygon({{4, 0}, {10, 0}, {10, 10}, {4, 10}})),
      "");
  EXPECT_EQ(
      judged(R"({"intersection": [)" + kSquare + R"(, {"half_plane": {"from": [4, 0], "to": [4, 10]}}]})",
             polygon({{4, 0}, {10, 0}, {10, 10}, {4, 10}})),
      "wrong");
  // Two squares side by side are one; what joins them is no edge.
  EXPECT_EQ(judged(R"({"union": [)" + kSquare + R"(, {"rectangle": {"size": [10, 10], "corner": [10, 0]}}]})",
                   polygon({{0, 0}, {10, 0}, {20, 0}, {20, 10}, {10, 10}, {0, 10}})),
            "");
  EXPECT_EQ(judged(kSquare, polygon({{0, 0}, {10, 0}, {10, 10}, {0, 10.0000005}})), "");
}

TEST(VerifyTree, EachOfManyHalfPlanesCounts) {
  constexpr int kSides = 12;
  const auto corner = [](double k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    return std::pair{100 * std::cos(angle), 100 * std::sin(angle)};
  };
  std::string planes;
  for (int k = 0; k < kSides; ++k) {
    const auto [x0, y0] = corner(k);
    const auto [x1, y1] = corner(k + 1);
    planes += fmt::format(R"({}{{"half_plane": {{"from": [{}, {}], "to": [{}, {}]}}}})", k > 0 ? ", " : "",
                          x0, y0, x1, y1);
  }
  const std::string tree = R"({"intersection": [{"rectangle": {"size": [300, 300]}}, )" + planes + "]}";
  for (int left_out = -1; left_out < kSides; ++left_out) {
    // Without one of the lines the two beside it go on to where they meet.
    const double far = std::cos(std::numbers::pi / kSides) / std::cos(2 * std::numbers::pi / kSides);
    std::vector<std::array<double, 2>> points;
    for (int k = 0; k < kSides; ++k) {
      const auto [x, y] = corner(k == left_out ? k + 0.5 : k);
      if (k == left_out)
        points.push_back({far * x, far * y});
      else if (left_out < 0 || k != (left_out + 1) % kSides)
        points.push_back({x, y});
    }
    EXPECT_EQ(judged(tree, polygon(points)), left_out < 0 ? "" : "wrong") << left_out;
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_tree_test

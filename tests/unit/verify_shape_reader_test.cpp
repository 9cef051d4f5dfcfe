// Regions as the checker reads them: what it refuses, what it makes of arcs, boxes, placements, comparisons.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>
#include <vector>

#include "verify/read/json.hpp"
#include "verify/shape/shape.hpp"
#include "verify/shape/shape_distance.hpp"

namespace lekalo::verify::verify_shape_reader_test {
namespace {

std::string line(const std::string& from, const std::string& to, const std::string& more = "") {
  return fmt::format(R"({{"line": {{"from": [{}], "to": [{}]}}{}}})", from, to, more);
}
std::string arc(const std::string& from, const std::string& to, const std::string& centre,
                const char* ccw = "true") {
  return fmt::format(R"({{"arc": {{"from": [{}], "to": [{}], "centre": [{}], "ccw": {}}}}})", from, to,
                     centre, ccw);
}
std::string region(const std::vector<std::string>& edges, const std::string& more = "") {
  return fmt::format(R"({{"outer": [{}]{}}})", fmt::join(edges, ", "), more);
}
const std::vector<std::string> kSquare{line("0, 0", "10, 0"), line("10, 0", "10, 10"),
                                       line("10, 10", "0, 10"), line("0, 10", "0, 0")};

struct Read {
  Shape shape;
  std::string complaint;
};
Read read(const std::string& text, bool inch = false) {
  const auto json = parse_json(text, "r");
  Read made;
  if (!json) return {{}, json.error().message};
  made.shape = read_shape(*json, "r", made.complaint, inch);
  return made;
}
std::string complaint(const std::string& text) { return read(text).complaint; }
Shape shape(const std::string& text) {
  Read made = read(text);
  EXPECT_EQ(made.complaint, "") << text;
  return made.shape;
}
bool is(Span span, double value) {
  return span.low <= value && span.high >= value && span.high - span.low < 1e-9;
}
bool is(const Vec& v, double x, double y) { return is(v.x, x) && is(v.y, y); }

TEST(VerifyShapeReader, ASquareHasFourSidesAndItsBox) {
  const Shape s = shape(region(kSquare));
  ASSERT_EQ(s.sides.size(), 4U);
  ASSERT_EQ(s.exact.size(), 4U);
  EXPECT_EQ(s.contour_starts, (std::vector<std::size_t>{0, 4}));
  EXPECT_EQ(s.piece_starts, (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(is(s.sides[1].from, 10, 0) && is(s.sides[1].to, 10, 10));
  EXPECT_TRUE(s.sides[1].written && !s.sides[1].open && !s.sides[1].arc);
  EXPECT_EQ(s.low_x, 0);
  EXPECT_EQ(s.low_y, 0);
  EXPECT_EQ(s.high_x, 10);
  EXPECT_EQ(s.high_y, 10);
}

TEST(VerifyShapeReader, PiecesHolesAndIslandsAreContours) {
  const std::string hole =
      "[" + line("2, 2", "2, 4") + ", " + line("2, 4", "4, 4") + ", " + line("4, 4", "2, 2") + "]";
  const Shape one = shape(region(kSquare, ", \"holes\": [" + hole + "], \"islands\": []"));
  EXPECT_EQ(one.contour_starts, (std::vector<std::size_t>{0, 4, 7}));
  EXPECT_EQ(one.piece_starts, (std::vector<std::size_t>{0, 2}));
  const Shape two = shape(fmt::format(R"({{"pieces": [{}, {}]}})", region(kSquare),
                                      region(kSquare, ", \"islands\": [" + hole + "]")));
  EXPECT_EQ(two.contour_starts, (std::vector<std::size_t>{0, 4, 8, 11}));
  EXPECT_EQ(two.piece_starts, (std::vector<std::size_t>{0, 1, 3}));
}

TEST(VerifyShapeReader, UnitsAreMillimetresUnlessTheFileOrTheCallerSaysInches) {
  EXPECT_EQ(shape(region(kSquare, R"(, "units": "mm")")).high_x, 10);
  EXPECT_EQ(read(region(kSquare, R"(, "units": "mm")"), true).shape.high_x, 10);
  EXPECT_TRUE(is(read(region(kSquare), true).shape.sides[0].to, 254, 0));
  EXPECT_TRUE(is(shape(region(kSquare, R"(, "units": "inch")")).sides[0].to, 254, 0));
  EXPECT_EQ(complaint(region(kSquare, R"(, "units": "cm")")), "the units of r are not mm or inch");
}

TEST(VerifyShapeReader, WhatIsNoRegionIsRefused) {
  EXPECT_EQ(complaint("{}"), "r.outer is not a list of edges");
  EXPECT_EQ(complaint(R"({"pieces": []})"), "r has no edges");
  EXPECT_EQ(complaint(R"({"outer": []})"), "r.outer is not closed");
  EXPECT_EQ(complaint(region({line("0, 0", "1, 0"), line("1, 0", "1, 1")})), "r.outer is not closed");
  EXPECT_EQ(complaint(region({line("0, 0", "1, 0"), line("2, 0", "0, 0")})),
            "r.outer[1] does not begin where the edge before it ends");
  EXPECT_EQ(complaint(region({line("0, 0", "0, 0")})), "r.outer[0] has no length");
  EXPECT_EQ(complaint(region({line("0, 0", "1, 0", R"(, "open": 1)")})),
            "r.outer[0].open is neither true nor false");
  EXPECT_EQ(complaint(region({line("0", "1, 0")})), "r.outer[0].from is not two numbers");
  EXPECT_EQ(complaint(region({line("0, 0, 0", "1, 0")})), "r.outer[0].from is not two numbers");
  EXPECT_EQ(complaint(region({line("0, 0, 0, 0", "1, 0")})), "r.outer[0].from is not two numbers");
  EXPECT_EQ(complaint(region({R"({"line": {"from": [0, 0], "to": [1, 0]}, "arc": {}})"})),
            "r.outer[0] is a line and an arc");
  EXPECT_EQ(complaint(region({arc("1, 0", "0, 1", "0, 0", "1")})),
            "r.outer[0].ccw is neither true nor false");
  EXPECT_EQ(complaint(region({arc("1, 0", "2, 0", "0, 0")})),
            "r.outer[0] is an arc that is a full circle or nothing");
  EXPECT_EQ(complaint(region({arc("0, 0", "0, 0", "0, 0")})), "r.outer[0] is an arc without a radius");
}

TEST(VerifyShapeReader, CoordinatesReachToABillionMillimetres) {
  const auto far = [](const std::string& x) {
    return complaint(region({line("0, 0", x + ", 0"), line(x + ", 0", "0, 1"), line("0, 1", "0, 0")}));
  };
  EXPECT_EQ(far("1e9"), "");
  EXPECT_EQ(far("-1e9"), "");
  EXPECT_EQ(far("1.0000001e9"), "r.outer[0].to is farther than 1000000000 mm from the origin");
  EXPECT_EQ(far("-1e10"), "r.outer[0].to is farther than 1000000000 mm from the origin");
}

/// Decimals of one double are one point; the next double is another.
TEST(VerifyShapeReader, ContoursCloseAsDoublesDo) {
  const std::string third = "0.3333333333333333", same = "0.33333333333333331", next = "0.3333333333333334";
  const auto around = [](const std::string& a, const std::string& b, const std::string& begin,
                         const std::string& end) {
    return complaint(
        region({line(begin + ", 0", a + ", 5"), line(b + ", 5", "4, 4"), line("4, 4", end + ", 0")}));
  };
  EXPECT_EQ(around(third, same, "0", "0"), "");
  EXPECT_EQ(around(third, next, "0", "0"), "r.outer[1] does not begin where the edge before it ends");
  EXPECT_EQ(around("2", "2", third, same), "");
  EXPECT_EQ(around("2", "2", third, next), "r.outer is not closed");
  EXPECT_EQ(
      complaint(region({line("0, " + third, "1, 5"), line("1, 5", "4, 4"), line("4, 4", "0, " + next)})),
      "r.outer is not closed");
  // The end that is written first counts: the outline is closed exactly.
  const Shape closed =
      shape(region({line("0, 0", third + ", 5"), line(same + ", 5", "4, 4"), line("4, 4", "0, 0")}));
  EXPECT_EQ(compare(closed.exact[0].to_x, closed.exact[1].from_x), 0);
}

TEST(VerifyShapeReader, ArcsKnowTheirTurn) {
  const auto turn = [](const std::string& from, const std::string& to, const char* ccw) {
    return shape(region({arc(from, to, "0, 0", ccw), line(to, from == to ? "9, 9" : from)})).sides[0].sweep;
  };
  EXPECT_EQ(turn("5, 0", "0, 5", "true"), Sweep::less);
  EXPECT_EQ(turn("5, 0", "0, 5", "false"), Sweep::more);
  EXPECT_EQ(turn("5, 0", "-5, 0", "true"), Sweep::half);
  EXPECT_EQ(turn("5, 0", "-5, 0", "false"), Sweep::half);
  EXPECT_EQ(turn("5, 0", "-5, 1e-30", "true"), Sweep::less);
  EXPECT_EQ(turn("5, 0", "-5, -1e-30", "true"), Sweep::more);
  const Shape circle = shape(region({arc("5, 0", "5, 0", "0, 0")}));
  ASSERT_EQ(circle.sides.size(), 1U);
  EXPECT_EQ(circle.sides[0].sweep, Sweep::full);
  EXPECT_TRUE(is(circle.sides[0].radius, 5));
  EXPECT_LE(circle.low_x, -5);
  EXPECT_GE(circle.high_y, 5);
  const Shape quarter = shape(region({arc("5, 0", "0, 5", "0, 0", "false"), line("0, 5", "5, 0")}));
  EXPECT_TRUE(is(quarter.sides[0].first, 0, 1) && is(quarter.sides[0].last, 1, 0)) << "counter-clockwise";
  EXPECT_FALSE(quarter.sides[0].ccw);
  EXPECT_TRUE(quarter.exact[0].arc && !quarter.exact[0].ccw);
  EXPECT_EQ(compare(quarter.exact[0].from_x, *parse_decimal("5")), 0);
}

/// Ends that miss the circle by more than rounding get lines to it.
TEST(VerifyShapeReader, ArcsThatMissTheirEndsAreJoined) {
  const Shape s = shape(region({arc("5, 0", "0, 6", "0, 0"), line("0, 6", "5, 0")}));
  ASSERT_EQ(s.sides.size(), 4U);
  EXPECT_EQ(s.exact.size(), 4U);
  EXPECT_TRUE(!s.sides[0].arc && !s.sides[0].written && is(s.sides[0].from, 5, 0) &&
              is(s.sides[0].to, 5.5, 0));
  EXPECT_TRUE(s.sides[1].arc && s.sides[1].written && is(s.sides[1].radius, 5.5) && s.sides[1].off == 0);
  EXPECT_TRUE(is(s.sides[1].written_from, 5, 0) && is(s.sides[1].written_to, 0, 6));
  EXPECT_TRUE(!s.sides[2].arc && !s.sides[2].written && is(s.sides[2].from, 0, 5.5) &&
              is(s.sides[2].to, 0, 6));
  const Shape near =
      shape(region({arc("5, 0", "0, 5.00000000000000001", "0, 0"), line("0, 5.00000000000000001", "5, 0")}));
  ASSERT_EQ(near.sides.size(), 2U);
  EXPECT_GT(near.sides[0].off, 0);
  EXPECT_LT(near.sides[0].off, 1e-14);
}

TEST(VerifyShapeReader, AnEdgeWithMoreMembersIsReadLikeOneWithout) {
  const std::string half = arc("10, 0", "-10, 0", "0, 0"), chord = line("-10, 0", "10, 0");
  const Shape usual = shape(region({half, chord}));
  std::string noted = half;
  noted.insert(1, R"("note": ["}", "]"], )");
  const std::string twice = R"({"line": {"from": [-10, 0], "to": [10, 0], "to": [10, 0]}})";
  for (const std::vector<std::string>& edges :
       {std::vector<std::string>{noted, chord}, {half, line("-10, 0", "10, 0", R"(, "open": false)")}}) {
    const Shape other = shape(region(edges));
    EXPECT_TRUE(same_edges(usual, other, 0));
  }
  EXPECT_EQ(complaint(region({half, twice})), "field r.outer[1].to is given twice");
}

TEST(VerifyShapeReader, OpenSidesAreMarked) {
  const Shape s = shape(region({line("0, 0", "9, 0", R"(, "open": true)"),
                                line("9, 0", "9, 9", R"(, "open": false)"), line("9, 9", "0, 0")}));
  EXPECT_TRUE(s.sides[0].open);
  EXPECT_FALSE(s.sides[1].open);
  EXPECT_FALSE(s.sides[2].open);
}

TEST(VerifyShapeReader, TheBoxOfAnArcReachesWhereItFaces) {
  const auto box = [](const std::string& from, const std::string& to) {
    return box_of(shape(region({arc(from, to, "10, 20"), line(to, from)})).sides[0]);
  };
  const auto about = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  const Box right = box("13, 16", "13, 24"), upper = box("14, 23", "6, 23"), left = box("7, 24", "7, 16"),
            lower = box("6, 17", "14, 17");
  EXPECT_TRUE(about(right.high_x, 15) && about(right.low_x, 13) && about(right.low_y, 16) &&
              about(right.high_y, 24));
  EXPECT_TRUE(about(upper.high_y, 25) && about(upper.low_y, 23) && about(upper.low_x, 6) &&
              about(upper.high_x, 14));
  EXPECT_TRUE(about(left.low_x, 5) && about(left.high_x, 7) && about(left.low_y, 16) &&
              about(left.high_y, 24));
  EXPECT_TRUE(about(lower.low_y, 15) && about(lower.high_y, 17) && about(lower.low_x, 6) &&
              about(lower.high_x, 14));
}

TEST(VerifyShapeReader, PlacedShapesAreTurnedMirroredAndShifted) {
  const Shape s = shape(region({arc("5, 0", "0, 5", "0, 0"), line("0, 5", "1, 1"), line("1, 1", "5, 0")}));
  const Motion quarter{just(0), just(1), false, {just(100), just(200)}};
  const Shape turned = placed(s, quarter);
  EXPECT_TRUE(is(turned.sides[0].from, 100, 205) && is(turned.sides[0].to, 95, 200) &&
              is(turned.sides[0].centre, 100, 200));
  EXPECT_TRUE(is(turned.sides[0].first, 0, 1) && is(turned.sides[0].last, -1, 0) && turned.sides[0].ccw);
  EXPECT_TRUE(std::abs(turned.low_x - 95) < 1e-9 && std::abs(turned.high_x - 100) < 1e-9);
  EXPECT_TRUE(std::abs(turned.low_y - 200) < 1e-9 && std::abs(turned.high_y - 205) < 1e-9);
  const Motion mirror{just(1), just(0), true, {just(0), just(0)}};
  const Shape mirrored = placed(s, mirror);
  EXPECT_TRUE(is(mirrored.sides[0].from, -5, 0) && is(mirrored.sides[1].to, -1, 1));
  EXPECT_TRUE(is(mirrored.sides[0].first, 0, 1) && is(mirrored.sides[0].last, -1, 0) &&
              !mirrored.sides[0].ccw);
}

TEST(VerifyShapeReader, ShapesWithTheSameEdgesAreTheSameEitherWayRound) {
  const std::vector<std::string> forth{arc("5, 0", "0, 5", "0, 0"), line("0, 5", "1, 1"),
                                       line("1, 1", "5, 0")};
  const Shape s = shape(region(forth));
  const auto same = [&](const std::vector<std::string>& edges, double tolerance = 1e-6) {
    const Shape other = shape(region(edges));
    EXPECT_EQ(same_edges(s, other, tolerance), same_edges(other, s, tolerance));
    return same_edges(s, other, tolerance);
  };
  EXPECT_TRUE(same(forth, 1e-12));
  EXPECT_TRUE(same({line("5, 0", "1, 1"), line("1, 1", "0, 5"), arc("0, 5", "5, 0", "0, 0", "false")}));
  EXPECT_TRUE(
      same({arc("5, 0", "0, 5", "0, 0"), line("0, 5", "1.0000005, 1"), line("1.0000005, 1", "5, 0")}));
  EXPECT_FALSE(same({arc("5, 0", "0, 5", "0, 0"), line("0, 5", "1.000002, 1"), line("1.000002, 1", "5, 0")}));
  EXPECT_FALSE(same({arc("5, 0", "0, 5", "0, 0"), line("0, 5", "1, 1.000002"), line("1, 1.000002", "5, 0")}));
  EXPECT_FALSE(same({line("5, 0", "0, 5"), line("0, 5", "1, 1"), line("1, 1", "5, 0")})) << "no arc";
  EXPECT_FALSE(same({arc("5, 0", "0, 5", "0, 0", "false"), line("0, 5", "1, 1"), line("1, 1", "5, 0")}))
      << "the other way";
  EXPECT_FALSE(same({arc("5, 0", "0, 5", "5, 5", "true"), line("0, 5", "1, 1"), line("1, 1", "5, 0")}))
      << "another centre";
  EXPECT_FALSE(same({line("0, 5", "1, 1"), line("1, 1", "5, 0"), arc("5, 0", "0, 5", "0, 0")}))
      << "from another point";
  EXPECT_FALSE(
      same({arc("5, 0", "0, 5", "0, 0"), line("0, 5", "1, 1"), line("1, 1", "2, 1"), line("2, 1", "5, 0")}));
  const Shape circle = shape(region({arc("5, 0", "5, 0", "0, 0")})),
              other = shape(region({arc("5, 0", "5, 0", "0, 0", "false")}));
  EXPECT_TRUE(same_edges(circle, other, 1e-9)) << "a circle has no direction";
  EXPECT_FALSE(same_edges(circle, shape(region({arc("5, 0", "5, 0", "0, 1")})), 1e-9));
  const std::string two = fmt::format(R"({{"pieces": [{}, {}]}})", region(forth), region(kSquare));
  const std::string hole =
      region(forth, ", \"holes\": [[" + fmt::format("{}", fmt::join(kSquare, ", ")) + "]]");
  EXPECT_FALSE(same_edges(shape(two), shape(hole), 1e-9)) << "a piece is no hole";
  EXPECT_FALSE(same_edges(shape(two), s, 1e-9));
  EXPECT_TRUE(same_edges(shape(two), shape(two), 1e-9));
}

TEST(VerifyShapeReader, AnOpenEdgeIsNoneOfItsNeighboursAndNotTheOneAcross) {
  const auto with_open = [](std::size_t edge, bool backwards = false) {
    const char* const corners[] = {"0, 0", "10, 0", "10, 10", "0, 10"};
    std::vector<std::string> edges;
    for (std::size_t k = 0; k < 4; ++k)
      edges.push_back(line(corners[backwards ? (4 - k) % 4 : k], corners[backwards ? 3 - k : (k + 1) % 4],
                           k == edge ? R"(, "open": true)" : ""));
    return shape(region(edges));
  };
  for (std::size_t a = 0; a < 4; ++a)
    for (std::size_t b = 0; b < 4; ++b) {
      EXPECT_EQ(same_edges(with_open(a), with_open(b), 0, true), a == b) << a << b;
      EXPECT_EQ(same_edges(with_open(a), with_open(b, true), 0, true), a == 3 - b) << a << b;
      EXPECT_TRUE(same_edges(with_open(a), with_open(b), 0)) << a << b;
    }
}

TEST(VerifyShapeReader, WhatAnEdgeLacksIsNamed) {
  const std::string arc_to = R"("to": [0, 1], "ccw": true)";
  const std::vector<std::pair<std::string, std::string>> table{
      {"{}", "r.outer[0] is not an object"},
      {R"({"line": 5})", "r.outer[0] is not an object"},
      {R"({"curve": {"from": [0, 0], "to": [1, 0]}})", "r.outer[0] is not an object"},
      {R"({"line": {"to": [1, 0]}})", "field r.outer[0].from is not a list"},
      {R"({"line": {"from": [0, 0]}})", "field r.outer[0].to is not a list"},
      {R"({"line": {"from": [0, 0], "centre": [1, 0]}})", "field r.outer[0].to is not a list"},
      {R"({"arc": {"from": [1, 0], "note": [0, 0], )" + arc_to + "}}",
       "field r.outer[0].centre is not a list"},
      {R"({"arc": {"from": [1, 0], "note": [0, 0], "to": [0, 1]}})", "field r.outer[0].centre is not a list"},
      {R"({"arc": {"note": true, "from": [1, 0], "to": [0, 1], "centre": [0, 0]}})",
       "r.outer[0].ccw is neither true nor false"},
      {R"({"arc": {"from": [1, 0], "note": true, "to": [0, 1], "centre": [0, 0]}})",
       "r.outer[0].ccw is neither true nor false"},
      {R"({"line": {"from": [0, 0], "to": "1, 0"}})", "field r.outer[0].to is not a list"},
      {R"({"line": {"from": [0, 0, 0, "a"], "to": [1, 0]}})", "r.outer[0].from is not two numbers"},
      {line("0, 0", "2e9, 2e9"), "r.outer[0].to is farther than 1000000000 mm from the origin"},
      {arc("0, 0", "1, 0", "0, 0"), "r.outer[0] is an arc that is a full circle or nothing"},
      {arc("1.000000000000000000000000000001, 1", "1, 6", "1, 1"), "r.outer[0] is an arc without a radius"},
      {arc("1, 6", "1.000000000000000000000000000001, 1", "1, 1"), "r.outer[0] is an arc without a radius"},
  };
  for (const auto& [edge, sentence] : table) EXPECT_EQ(complaint(region({edge})), sentence) << edge;
}

TEST(VerifyShapeReader, ABillionMillimetresInInches) {
  const auto far = [](const std::string& x) {
    return read(region({line("0, 0", x + ", 0"), line(x + ", 0", "0, 1"), line("0, 1", "0, 0")}), true)
        .complaint;
  };
  EXPECT_EQ(far("39370078.740157480314960629921259842"), "");
  EXPECT_EQ(far("39370078.741"), "r.outer[0].to is farther than 1000000000 mm from the origin");
}

TEST(VerifyShapeReader, OnlyTheLastEndIsMovedToTheBegin) {
  const std::string third = "0.3333333333333333", same = "0.33333333333333331";
  const Shape s = shape(region({line(third + ", 0", "9, 0"), line("9, 0", same + ", 0"),
                                line(same + ", 0", "9, 9"), line("9, 9", same + ", 0")}));
  EXPECT_EQ(compare(s.exact[1].to_x, *parse_decimal(same)), 0);
  EXPECT_EQ(compare(s.exact[3].to_x, *parse_decimal(third)), 0);
  // Loose edges have no begin to be moved to.
  const std::string loose = "[" + line(third + ", 0", same + ", 0") + "]";
  std::string said;
  EXPECT_EQ(read_loose_edges(*parse_json(loose, "r"), "r", said).size(), 1U);
  EXPECT_EQ(said, "");
}

TEST(VerifyShapeReader, OutlinesThroughPointsLeaveOutRepeatedOnes) {
  const auto through = [](const std::vector<std::string>& x) {
    std::vector<Decimal> xs, ys;
    for (const std::string& text : x) xs.push_back(*parse_decimal(text)), ys.push_back(Decimal{});
    ys.back() = *parse_decimal("0");
    return outline_through(xs, ys);
  };
  EXPECT_EQ(through({"0", "0", "3", "5", "5", "0", "0"}).sides.size(), 3U);
  const Shape two = through({"0", "3", "3", "0"});
  ASSERT_EQ(two.sides.size(), 2U);
  EXPECT_TRUE(is(two.sides[1].from, 3, 0) && is(two.sides[1].to, 0, 0));
  EXPECT_EQ(two.piece_starts, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(through({"4", "4", "4"}).sides.size(), 1U);
}

TEST(VerifyShapeReader, WholeNumbersBeyondDoublesAreEnclosedTightly) {
  for (const auto& [text, low, high] :
       std::vector<std::tuple<std::string, double, double>>{{"9007199254740993", 0x1p53, 0x1p53 + 2},
                                                            {"9007199254740994", 0x1p53 + 2, 0x1p53 + 2},
                                                            {"9007199254740995", 0x1p53 + 2, 0x1p53 + 4}}) {
    const Span found = enclosed(*parse_decimal(text));
    EXPECT_EQ(found.low, low) << text;
    EXPECT_EQ(found.high, high) << text;
  }
}

TEST(VerifyShapeReader, EqualWithinATolerance) {
  const auto triangle = [](const std::string& corner) {
    return shape(region({line("0, 0", corner), line(corner, "0, 9"), line("0, 9", "0, 0")}));
  };
  const Shape plain = triangle("0.5, 0.5");
  const auto same = [&](const std::string& corner, double tolerance) {
    return same_edges(plain, triangle(corner), tolerance);
  };
  EXPECT_TRUE(same("0.5, 0.5", 0));
  // One end of the enclosure is the same double, the other is not.
  for (const std::string near : {"0.5000000000000000001", "0.4999999999999999999"}) {
    EXPECT_FALSE(same(near + ", 0.5", 0)) << near;
    EXPECT_FALSE(same("0.5, " + near, 0)) << near;
  }
  // The bound itself is near enough, as it is computed.
  const double bound = absolute(just(0.5) - just(0.75)).high;
  for (const std::string off : {"0.75, 0.5", "0.5, 0.75"}) {
    EXPECT_TRUE(same(off, bound));
    EXPECT_FALSE(same(off, step_down(bound)));
  }
  // A circle of whatever direction, and an arc that hardly begins.
  const std::string out = line("5, 0", "6, 0"), back = line("6, 0", "5, 0");
  const Shape circle = shape(region({arc("5, 0", "5, 0", "0, 0"), out, back}));
  EXPECT_TRUE(same_edges(circle, shape(region({arc("5, 0", "5, 0", "0, 0", "false"), out, back})), 1e-6));
  EXPECT_FALSE(same_edges(
      circle, shape(region({arc("5, 0", "5, 1e-9", "0, 0"), line("5, 1e-9", "6, 0"), back})), 1e-6));
}

}  // namespace
}  // namespace lekalo::verify::verify_shape_reader_test

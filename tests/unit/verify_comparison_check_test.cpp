// What a result says about an earlier one, and about the distances of the blank's points from the part, is
// held against the numbers that it comes from, to their last places.

#include "verify/locate/comparison_check.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace lekalo::verify::verify_comparison_check_test {
namespace {

Decimal number(const std::string& text) { return *parse_decimal(text); }

// ---- the earlier result -----------------------------------------------------------------------------------

/// A part of corners (0, 0) and (3, 4) that was moved from `last` to `now`, with what is said of that.
struct Compared {
  std::string x = "0", y = "0", theta = "0", last_x = "0", last_y = "0", last_theta = "0";
  std::string dx = "0", dy = "0", dtheta = "0", dtheta_deg = "0", shift = "0", clearance = "1";
  std::string inputs = R"([{"role": "blank", "sha256": "b"}, {"role": "part", "sha256": "p"}])";
  bool same_part = true;
  RoundedPoints part{{0, 0}, {3, 4}};

  [[nodiscard]] std::string earlier() const {
    return fmt::format(R"({{"x": {}, "y": {}, "theta": {}, "clearance": 1, "inputs": {}}})", last_x, last_y,
                       last_theta, inputs);
  }
  /// Returns the sentences about it, joined.
  [[nodiscard]] std::string found() const { return found_in(earlier()); }
  [[nodiscard]] std::string found_in(const std::string& document) const {
    ResultDocument result;
    result.best = {number(x), number(y), number(theta), {}, {}};
    result.part_sha256 = "p";
    result.comparison = {same_part,          number(dx),    number(dy),        number(dtheta),
                         number(dtheta_deg), number(shift), number(clearance), {}};
    std::vector<std::string> findings;
    const auto last = check_comparison(result, {"earlier.json", document}, part, findings);
    if (last) {
      EXPECT_EQ(compare(last->x, number(last_x)), 0);
    }
    std::string all;
    for (const std::string& finding : findings) all += finding + "\n";
    return all;
  }
};

TEST(VerifyComparison, WhatIsSaidOfAnEarlierResultHoldsToTheLastPlace) {
  EXPECT_EQ(Compared{}.found(), "");
  Compared other;
  other.same_part = false;
  EXPECT_NE(other.found().find("same_part is false, but the two parts are one file"), std::string::npos);
  other.inputs = R"([{"role": "part", "sha256": "q"}, {"role": "blank", "sha256": "p"}])";
  EXPECT_EQ(other.found(), "");
  other.same_part = true;
  EXPECT_NE(other.found().find("same_part is true, but the two parts are different files"),
            std::string::npos);
  Compared clearance;
  clearance.clearance = "1.0000000000000000000001";
  EXPECT_NE(clearance.found().find("last_clearance is not that of the earlier result"), std::string::npos);

  // The part moved by (3, 4), and so did its corners; a place more of the larger of two numbers is a
  // rounding.
  Compared moved;
  moved.x = "8", moved.last_x = "5", moved.y = "-2", moved.last_y = "-6";
  moved.dx = "3", moved.dy = "4", moved.shift = "5";
  EXPECT_EQ(moved.found(), "");
  moved.dx = "3.0000000000000075", moved.dy = "3.999999999999995";
  EXPECT_EQ(moved.found(), "");
  moved.dx = "3.0000000000000085";
  EXPECT_NE(moved.found().find("comparison.dx is"), std::string::npos);
  EXPECT_EQ(moved.found().find("comparison.dy is"), std::string::npos);
  moved.dy = "3.999999999999993";
  EXPECT_NE(moved.found().find("comparison.dy is 3.999999999999993, but the two differ by 4"),
            std::string::npos);
  Compared nothing;
  nothing.dx = "1e-300";
  EXPECT_NE(nothing.found().find("comparison.dx is"), std::string::npos);
}

TEST(VerifyComparison, TheTurnIsTheShorterWayAndHalfATurnIsToTheLeft) {
  const std::string bad = "comparison.dtheta is", bad_degrees = "comparison.dtheta_deg is";
  const auto said = [](const std::string& theta, const std::string& last, const std::string& dtheta) {
    Compared c;
    c.theta = theta, c.last_theta = last, c.dtheta = dtheta;
    c.dtheta_deg = fmt::format("{}", std::stod(dtheta) * 360 / 6.283185307179586), c.shift = "100";
    return c.found();
  };
  EXPECT_EQ(said("0.5", "0.25", "0.25"), "");
  EXPECT_EQ(said("6.25", "0.25", "-0.283185307179586"), "");
  EXPECT_NE(said("6.25", "0.25", "6").find(bad), std::string::npos);
  EXPECT_NE(said("0.5", "0.25", "-0.25").find(bad), std::string::npos);
  EXPECT_EQ(said("1e-14", "0", "0"), "");
  // The rounding is 1e-14 for no turn at all, and that is still allowed.
  EXPECT_EQ(said("0", "0", "1e-14"), "");
  EXPECT_NE(said("0", "0", "1.001e-14").find(bad), std::string::npos);
  // Half a turn is written as one to the left, up to the last place that a rounding may have moved it.
  EXPECT_EQ(said("3.141592653589793", "0", "3.141592653589793"), "");
  EXPECT_EQ(said("-3.141592653589793", "0", "3.141592653589793"), "");
  EXPECT_EQ(said("3.141592653589793", "0", "3.1415926535898344"), "");
  EXPECT_NE(said("3.1415926535898", "0", "3.141592653589835").find(bad), std::string::npos);
  EXPECT_NE(said("3.2", "0", "3.2").find(bad), std::string::npos);
  EXPECT_EQ(said("3.2", "0", "-3.083185307179586"), "");

  Compared degrees;
  degrees.theta = degrees.dtheta = "0.5", degrees.shift = "100", degrees.dtheta_deg = "28.647889756541161";
  EXPECT_EQ(degrees.found(), "");
  degrees.dtheta_deg = "28.6478897565417";
  EXPECT_NE(degrees.found().find(bad_degrees), std::string::npos);
  degrees.theta = degrees.dtheta = "0", degrees.dtheta_deg = "1e-300";
  EXPECT_NE(degrees.found().find(bad_degrees), std::string::npos);
}

TEST(VerifyComparison, NoCornerMovedFurtherThanTheLargestShift) {
  const std::string bad = "comparison.largest_shift is";
  Compared still;
  // A part of the size of 1 mm may be off by 1e-14 mm, the smallest size that counts.
  still.part = {{0, 0}, {0.25, 0.5}};
  still.shift = "-1e-14";
  EXPECT_EQ(still.found(), "");
  still.shift = "-1.001e-14";
  EXPECT_NE(still.found().find(bad), std::string::npos);
  still.part = {{0, 0}, {-4, 1}};
  still.shift = "-3.9e-14";
  EXPECT_EQ(still.found(), "");
  still.part = {{0, 0}, {1, -4}};
  EXPECT_EQ(still.found(), "");
  still.shift = "-4.1e-14";
  EXPECT_NE(still.found().find(bad), std::string::npos);
  // What moved far may be off by more.
  Compared far;
  far.x = far.dx = far.shift = "3", far.part = {{0, 0}, {1, 1}};
  far.shift = "2.99999999999997";
  EXPECT_EQ(far.found(), "");
  far.shift = "2.99999999999995";
  EXPECT_NE(far.found().find(bad), std::string::npos);

  // A quarter turn moves the corner (3, 4) to (-4, 3) and leaves (0, 0), so that one moved by the root of 50.
  Compared turned;
  turned.theta = turned.dtheta = "1.5707963267948966", turned.dtheta_deg = "90";
  turned.shift = "7.0710678118654755";
  EXPECT_EQ(turned.found(), "");
  turned.shift = "7.07106781186";
  EXPECT_NE(turned.found().find("but a corner of the part moved 7.07106781186547"), std::string::npos);
  // The other corner counts as well, and the shift is added to the turn.
  turned.part = {{3, 4}, {0, 0}};
  EXPECT_NE(turned.found().find(bad), std::string::npos);
  turned.x = turned.dx = "7", turned.y = turned.dy = "1", turned.shift = "7.0710678118654755";
  EXPECT_EQ(turned.found(), "");  // (3, 4) is where it was, and (0, 0) is at (7, 1)
  turned.part = {{0, 0}, {3, 4}};
  turned.shift = "7.07";
  EXPECT_NE(turned.found().find(bad), std::string::npos);
}

TEST(VerifyComparison, AnEarlierResultThatCannotBeReadIsSaid) {
  EXPECT_NE(Compared{}.found_in("nothing").find("earlier.json:1: not JSON"), std::string::npos);
  EXPECT_EQ(Compared{}.found_in("{}"), "earlier.json: field x is missing\n");
}

// ---- deviations -------------------------------------------------------------------------------------------

/// A part, a blank, and what is said of the distances of the blank's points from the placed part.
struct Deviating {
  RoundedPoints part{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, blank{{-1, 0}, {7, 7}, {2, 1}};
  std::string x = "0", y = "0", theta = "0", least = "-1", greatest = "5";
  std::size_t points = 3;
  std::string head = "index,x,y,deviation\n", rows = "0,-1,0,1\n1,7,7,5\n2,2,1,-1\n";
  bool with_table = true;
  std::vector<std::string> notes = {};

  /// Returns the sentences about it, joined.
  std::string found() {
    ResultDocument result;
    result.best = {number(x), number(y), number(theta), {}, {}};
    result.deviations = {points, number(least), number(greatest)};
    std::vector<std::string> findings;
    notes.clear();
    const std::string bytes = head + rows;
    const std::optional<Document> table =
        with_table ? std::optional(Document{"table.csv", bytes}) : std::nullopt;
    const bool all = check_deviations(result, table, part, blank, findings, notes);
    EXPECT_EQ(all, notes.empty());
    std::string text;
    for (const std::string& finding : findings) text += finding + "\n";
    return text;
  }
};

TEST(VerifyComparison, DeviationsAreDistancesNegativeInside) {
  EXPECT_EQ(Deviating{}.found(), "");
  struct Row {
    double x, y, off;
  };
  // Beside every edge and corner, level with corners, and inside; the second part has a notch from above.
  const RoundedPoints box{{0, 0}, {4, 0}, {4, 3}, {0, 3}}, backwards{{0, 3}, {4, 3}, {4, 0}, {0, 0}},
      notched{{0, 0}, {8, 0}, {8, 8}, {6, 8}, {4, 2}, {2, 8}, {0, 8}},
      small{{0, 0}, {0.25, 0}, {0.25, 0.25}, {0, 0.25}},
      repeated{{0, 0}, {0, 0}, {4, 0}, {4, 3}, {4, 3}, {0, 3}, {0, 0}};
  const std::vector<Row> about_box{
      {2, -1, 1}, {2, 4, 1},      {5, 1, 1},      {-2, 1, 2},       {-3, -4, 5},      {7, -4, 5}, {7, 7, 5},
      {-3, 7, 5}, {2, 0.5, -0.5}, {2, 2.5, -0.5}, {0.25, 1, -0.25}, {3.75, 1, -0.25}, {-1, 0, 1}, {5, 0, 1},
      {-1, 3, 1}, {5, 3, 1},      {2, 1, -1},     {0, 0, 0},        {4, 3, 0},        {2, 0, 0}};
  const std::vector<Row> about_notch{{4, 6, 1.264911064067352},
                                     {4, 1, -1},
                                     {1, 2, -1},
                                     {7, 2, -1},
                                     {4, 9, 2.23606797749979},
                                     {-1, 2, 1},
                                     {9, 2, 1},
                                     {-3, 8, 3},
                                     {11, 8, 3},
                                     {1, 7, -1},
                                     {7, 7, -1}};
  const std::vector<Row> about_small{
      {0.125, 0.125, -0.125}, {0.125, 0.5, 0.25}, {0.5, 0.125, 0.25}, {-0.25, 0.125, 0.25}};
  const auto expect_all = [](const RoundedPoints& part, const std::vector<Row>& rows,
                             const std::string& what) {
    for (const Row& row : rows) {
      Deviating one;
      one.part = part, one.blank = {{row.x, row.y}}, one.points = 1;
      one.least = one.greatest = fmt::format("{}", row.off);
      one.rows = fmt::format("0,{},{},{}\n", row.x, row.y, row.off);
      EXPECT_EQ(one.found(), "") << what << ' ' << row.x << ' ' << row.y;
    }
  };
  expect_all(box, about_box, "box");
  expect_all(backwards, about_box, "backwards");
  expect_all(repeated, about_box, "repeated");
  expect_all(notched, about_notch, "notched");
  expect_all(small, about_small, "small");
}

TEST(VerifyComparison, DeviationsAreThoseOfThePlacedPart) {
  // A quarter turn and a shift put the box from (7, 2) to (10, 6).
  Deviating placed;
  placed.theta = "1.5707963267948966", placed.x = "10", placed.y = "2";
  placed.blank = {{10, 0}, {5, 4}, {8, 4}}, placed.least = "-1", placed.greatest = "2";
  placed.rows = "0,10,0,2\n1,5,4,2\n2,8,4,-1\n";
  EXPECT_EQ(placed.found(), "");
  placed.y = "3", placed.greatest = "3", placed.rows = "0,10,0,3\n1,5,4,2\n2,8,4,-1\n";
  EXPECT_EQ(placed.found(), "");
}

TEST(VerifyComparison, DeviationsMayBeOffByATrillionthOfTheCoordinates) {
  // The points of the blank are those of the part, so that they lie 0 mm off it and the slack is 1e-12 mm.
  Deviating square;
  square.part = square.blank = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}, square.points = 4;
  square.least = square.greatest = "1e-12";
  square.rows = "0,0,0,1e-12\n1,1,0,-1e-12\n2,1,1,0\n3,0,1,0\n";
  EXPECT_EQ(square.found(), "");
  square.least = "-1e-12", square.greatest = "-1e-12";
  EXPECT_EQ(square.found(), "");
  const std::string range = "deviations run from";
  square.least = "1.001e-12";
  EXPECT_NE(square.found().find(range), std::string::npos);
  square.least = "0", square.greatest = "1.001e-12";
  EXPECT_NE(square.found().find(range), std::string::npos);
  square.greatest = "0", square.rows = "0,0,0,1.001e-12\n1,1,0,0\n2,1,1,0\n3,0,1,0\n";
  EXPECT_NE(square.found().find("line 2 says 1.001e-12 mm, but the point lies"), std::string::npos)
      << square.found();
  // A blank of 100 mm may be off by a hundred times as much, along either axis.
  for (const bool upright : {false, true}) {
    Deviating far;
    far.part = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    far.blank = upright ? RoundedPoints{{0, 101}} : RoundedPoints{{-100, 0}};
    far.points = 1, far.least = far.greatest = "100.00000000009";
    far.rows = upright ? "0,0,101,100.00000000009\n" : "0,-100,0,99.99999999991\n";
    EXPECT_EQ(far.found(), "") << upright;
    far.least = "100.0000000002";
    EXPECT_NE(far.found().find(range), std::string::npos) << upright;
  }
}

TEST(VerifyComparison, ATableIsThatOfTheBlanksPoints) {
  const auto fault = [](const std::string& head, const std::string& rows) {
    Deviating table;
    table.head = head, table.rows = rows;
    return table.found();
  };
  const std::string head = "index,x,y,deviation\n";
  for (const auto& [text, told] : std::vector<std::pair<std::string, std::string>>{
           {"0,-1,0,1\n1,7,7,5\n2,2,1,-1\n", ""},
           {"0,-1,0,1\n1,7,7,5\n2,2,1,-1", ""},
           {"0,-1,0,1\n1,7.000000000000001,7,5\n2,2,1,-1\n", ""},
           {"0,-1,0,1\n1,7.000000000000003,7,5\n2,2,1,-1\n", "line 3 is not of point 1 of the blank"},
           {"0,-1,0,1\n1,7,7.000000000000003,5\n2,2,1,-1\n", "line 3 is not of point 1 of the blank"},
           {"0,-1,1e-300,1\n1,7,7,5\n2,2,1,-1\n", "line 2 is not of point 0 of the blank"},
           {"0,-1,0,1\n2,7,7,5\n2,2,1,-1\n", "line 3 is not of point 1 of the blank"},
           {"0,-1,0,1\n1,7,7,5.1\n2,2,1,-1\n", "line 3 says 5.1 mm, but the point lies 5 mm off the part"},
           {"0,-1,0,1\n1,7,7,5\n", "is not four numbers"},
           {"0,-1,0,1\n1,7,7,5\n2,2,1,-1\n3,0,0,0\n", "it goes on in line 5"},
           {"0,-1,0,1\n1,7,7,5,6\n2,2,1,-1\n", "line 3 is not four numbers"},
           {"0,-1,0,1\n1,7,x,5\n2,2,1,-1\n", "line 3 is not four numbers"},
           {"0,-1,0,1\n1,7,7,\n2,2,1,-1\n", "line 3 is not four numbers"},
           {"0,-1,0,1\n1,7,7\n2,2,1,-1\n", "line 3 is not four numbers"}}) {
    const std::string found = fault(head, text);
    EXPECT_EQ(found.empty(), told.empty()) << text << found;
    EXPECT_NE(found.find(told), std::string::npos) << text << found;
  }
  EXPECT_NE(fault("", "").find("its first line is not index,x,y,deviation"), std::string::npos);
  EXPECT_NE(fault("index;x;y;deviation\n", "").find("its first line is not index,x,y,deviation"),
            std::string::npos);
  // Numbers that are not there are not those before them.
  Deviating one;
  one.blank = {{1, 1}}, one.part = {{1, 0}, {2, 0}, {3, -1}}, one.points = 1, one.least = one.greatest = "1";
  one.rows = "0,1\n";
  EXPECT_NE(one.found().find("line 2 is not four numbers"), std::string::npos);
  // The first coordinate 0 is exactly that of the file.
  one.blank = {{0, 1}}, one.part = {{0, 0}, {2, 0}, {3, -1}}, one.rows = "0,0,1,1\n";
  EXPECT_EQ(one.found(), "");
  one.rows = "0,1e-300,1,1\n";
  EXPECT_NE(one.found().find("line 2 is not of point 0 of the blank"), std::string::npos);
}

TEST(VerifyComparison, WhatIsNotLookedAtOfDeviationsIsANote) {
  Deviating d;
  d.points = 4;
  EXPECT_NE(d.found().find("deviations.points is 4, but the blank has 3 points"), std::string::npos);
  d.points = 3, d.with_table = false;
  EXPECT_EQ(d.found(), "");
  ASSERT_EQ(d.notes.size(), 1U);
  EXPECT_NE(d.notes[0].find("it is not there"), std::string::npos);
  d.least = "0";
  EXPECT_NE(d.found().find("deviations run from 0 to 5 mm, but the blank's points lie from -1 to 5 mm"),
            std::string::npos);
  // 100 million pairs of points and some more are not looked at.
  d.part.resize(20'000), d.blank.resize(5'001), d.points = 5'001;
  EXPECT_EQ(d.found(), "");
  ASSERT_EQ(d.notes.size(), 1U);
  EXPECT_NE(d.notes[0].find("there are too many points"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::verify::verify_comparison_check_test

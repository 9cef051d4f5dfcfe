// What the checker holds against the demands of a result: at the placement, edge by edge, and between the
// numbers that the result says of all placements.

#include "verify/locate/demand_check.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/verify/verify.hpp"
#include "support/json.hpp"

namespace lekalo::verify::verify_demands_test {
namespace {

using Tree = cases::Json;

Shape shape(const std::string& text) {
  std::string complaint;
  const auto root = parse_json(text, "shape");
  Shape read = read_shape(*root, "shape", complaint);
  EXPECT_EQ(complaint, "");
  return read;
}

/// A rectangle, whose edges are 0 below, 1 right, 2 above and 3 left.
std::string rectangle(double x, double y, double to_x, double to_y) {
  return fmt::format(
      R"({{"outer": [{{"line": {{"from": [{0}, {1}], "to": [{2}, {1}]}}}}, {{"line": {{"from": [{2}, {1}], "to": [{2}, {3}]}}}}, )"
      R"({{"line": {{"from": [{2}, {3}], "to": [{0}, {3}]}}}}, {{"line": {{"from": [{0}, {3}], "to": [{0}, {1}]}}}}]}})",
      x, y, to_x, to_y);
}
std::string square(double from, double to) { return rectangle(from, from, to, to); }
const std::string kBlank = square(0, 100);

Tree demands() {
  return Tree::parse(
      R"({"minimum": 0, "features": [], "criterion": "smallest", "give_up": 0, "margin": 0, "margin_bound": 0,
    "margin_found": 0, "margin_gap": 0, "largest": 50, "smallest_largest": null, "trade_off": [], "grown_for": 0, "shift": 0,
    "bound": 0})");
}
Tree feature(const std::string& edges, const char* more = "") {
  Tree f = Tree::parse(R"({"name": "f", "edges": )" + edges +
                       R"(, "minimum": 0, "scale": 1, "maximum": null, "finished": null, "target": null})");
  if (*more != '\0') {
    const Tree changes = Tree::parse(more);
    for (const std::string& key : changes.keys()) f[key] = changes[key];
  }
  return f;
}

std::string complaint_of(const Tree& tree) {
  const std::string text = tree.dump();
  std::string complaint;
  (void)read_demands(*parse_json(text, "demands"), complaint);
  return complaint;
}

/// One check of these demands, for a part where it lies.
struct Checked {
  Checked(const Tree& tree, const std::string& part_text, double off = 0,
          const std::string& blank_text = kBlank)
      : text(tree.dump()), part(shape(part_text)), blank(shape(blank_text)) {
    std::string complaint;
    read = read_demands(*parse_json(text, "demands"), complaint);
    EXPECT_EQ(complaint, "");
    check.emplace(read, part, part, blank, just(off), findings);
  }
  std::string said() const {
    std::string all;
    for (const std::string& finding : findings) all += finding + "\n";
    return all;
  }
  std::string text;
  Shape part, blank;
  WrittenDemands read;
  std::vector<std::string> findings;
  std::optional<DemandCheck> check;
};

std::string placement(const Tree& tree, const std::string& part, double off = 0,
                      const std::string& blank = kBlank) {
  Checked one(tree, part, off, blank);
  one.check->check_placement();
  return one.said();
}

/// `shown`, `open`, or the findings.
std::string missing(const Tree& tree, const std::string& part, double off = 0,
                    const std::string& blank = kBlank) {
  Checked one(tree, part, off, blank);
  const bool shown = one.check->check_missing();
  return one.findings.empty() ? (shown ? "shown" : "open") : one.said();
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

// ---- how they are read ------------------------------------------------------------------------------------

TEST(VerifyDemands, NumbersThatCannotBeAreRefused) {
  Tree tree = demands();
  EXPECT_EQ(complaint_of(tree), "");
  for (const char* field : {"give_up", "grown_for", "minimum"}) {
    tree = demands();
    tree[field] = -0.5;
    EXPECT_EQ(complaint_of(tree), fmt::format("demands.{} is negative", field));
  }
  tree = demands();
  for (const char* field : {"margin", "margin_bound", "margin_found", "largest", "shift", "bound"})
    tree[field] = -1;
  EXPECT_EQ(complaint_of(tree), "");
  const auto with = [](const char* more) {
    Tree one = demands();
    one["features"].push_back(feature("[0]", more));
    return complaint_of(one);
  };
  tree["smallest_largest"] = Tree::parse(R"({"margin": 8, "found": 30, "bound": 29, "gap": 1, "kept": 30,
    "proof": {"grown_for": 0, "most": 29.5, "shift": 0.2, "bound": 0.1}})");
  EXPECT_EQ(complaint_of(tree), "");
  tree["smallest_largest"]["proof"]["grown_for"] = -0.5;
  EXPECT_EQ(complaint_of(tree), "demands.smallest_largest.proof.grown_for is negative");
  const std::string out = "demands.features[0] has a number out of range";
  EXPECT_EQ(with(""), "");
  EXPECT_EQ(with(R"({"minimum": -1})"), out);
  EXPECT_EQ(with(R"({"scale": 0})"), out);
  EXPECT_EQ(with(R"({"scale": -1})"), out);
  EXPECT_EQ(with(R"({"maximum": -1})"), out);
  EXPECT_EQ(with(R"({"maximum": 0})"), "");
  EXPECT_EQ(with(R"({"finished": 0})"), out);
  EXPECT_EQ(with(R"({"finished": -1})"), out);
  EXPECT_EQ(with(R"({"finished": 1, "maximum": 2, "minimum": 3, "target": 4})"), "");
}

TEST(VerifyDemands, PointsOfTheTradeOffHaveAMarginFrom0OnAndAHand) {
  const auto with = [](const char* mirrored, double margin) {
    Tree one = demands();
    Tree point = Tree::parse(
        R"({"x": 1, "y": 2, "theta": 0, "theta_deg": 0, "clearance": 4, "margin": 0, "largest": 5, "mirrored": )" +
        std::string(mirrored) + "}");
    point["margin"] = margin;
    one["trade_off"].push_back(point);
    return one;
  };
  EXPECT_EQ(complaint_of(with("true", 0)), "");
  EXPECT_EQ(complaint_of(with("true", -0.5)), "demands.trade_off[0].margin is negative");
  EXPECT_EQ(complaint_of(with("1", 0)), "demands.trade_off[0].mirrored is no truth value");
  EXPECT_EQ(complaint_of(with("null", 0)), "demands.trade_off[0].mirrored is no truth value");
  EXPECT_TRUE(Checked(with("true", 1), square(40, 60)).read.curve.at(0).mirrored);
  EXPECT_FALSE(Checked(with("false", 1), square(40, 60)).read.curve.at(0).mirrored);
}

TEST(VerifyDemands, AnEdgeHasOneFeatureAndTheFeatureAnEdgeOfThePart) {
  const auto with = [](std::vector<std::string> edges) {
    Tree one = demands();
    for (const std::string& e : edges) one["features"].push_back(feature(e));
    return Checked(one, square(40, 60)).said();
  };
  EXPECT_EQ(with({"[0, 3]", "[1]"}), "");
  EXPECT_EQ(with({"[4]"}), "feature \"f\" has edge 4, which the part has not\n");
  EXPECT_EQ(with({"[0, 1]", "[1]"}), "edge 1 belongs to two features\n");
}

TEST(VerifyDemands, WhatJoinsAnArcToItsEndsIsOfTheArcsEdgeWhereverItStands) {
  // The ends of the corner above right miss the circle by half a micrometre, and it is the first edge.
  const std::string part =
      R"({"outer": [{"arc": {"from": [60, 55], "to": [55, 60], "centre": [55, 55.000001], "ccw": true}}, )"
      R"({"line": {"from": [55, 60], "to": [10, 60]}}, {"line": {"from": [10, 60], "to": [10, 40]}}, )"
      R"({"line": {"from": [10, 40], "to": [60, 40]}}, {"line": {"from": [60, 40], "to": [60, 55]}}]})";
  const auto with = [&](const char* edges, double minimum) {
    Tree one = demands();
    one["features"].push_back(feature(edges));
    one["features"][0]["minimum"] = minimum;
    return placement(one, part);
  };
  EXPECT_EQ(with("[0]", 39.875), "");
  EXPECT_EQ(with("[0]", 40.125).substr(0, 13), "edge 0 needs ");
  EXPECT_EQ(with("[1]", 39.875).substr(0, 13), "edge 1 needs ");
  EXPECT_EQ(with("[4]", 39.875), "");
  EXPECT_EQ(with("[5]", 0), "feature \"f\" has edge 5, which the part has not\n");
}

// ---- at the placement -------------------------------------------------------------------------------------

TEST(VerifyDemands, EveryEdgeHasItsMinimumAndItsShareOfTheMargin) {
  // 40 mm stay all around.
  const auto with = [](double minimum, double margin, double off = 0) {
    Tree one = demands();
    one["minimum"] = minimum, one["margin"] = margin;
    return placement(one, square(40, 60), off);
  };
  EXPECT_EQ(with(10, 29.999), "");
  EXPECT_TRUE(has(with(10, 30.001), "edge 0 needs 40.00"));
  EXPECT_EQ(with(10, 28.999, 1), "");
  EXPECT_TRUE(has(with(10, 29.001, 1), "edge 0 needs "));
  EXPECT_EQ(with(50, -0.001), "");  // what is missing is another matter
  // A share of 2, and of the edge alone.
  Tree one = demands();
  one["features"].push_back(feature("[2]", R"({"minimum": 10, "scale": 2})"));
  one["margin"] = 14.999;
  EXPECT_EQ(placement(one, square(40, 60)), "");
  one["margin"] = 15.001;
  EXPECT_TRUE(has(placement(one, square(40, 60)), "edge 2 needs 40.00"));
  EXPECT_TRUE(has(placement(demands(), square(140, 160)), "edge 0 is not inside the blank"));
}

TEST(VerifyDemands, NoAllowanceIsAboveTheLargestOrTheMaximum) {
  const auto with = [](double largest, const char* more, double off = 0) {
    Tree one = demands();
    one["largest"] = largest;
    if (*more != '\0') one["features"].push_back(feature("[1]", more));
    return placement(one, rectangle(10, 20, 70, 60), off);  // 20 below, 30 right, 40 above, 10 left
  };
  EXPECT_EQ(with(40.001, ""), "");
  EXPECT_TRUE(has(with(39.999, ""), "the part has an allowance above 39.99"));
  EXPECT_EQ(with(41.001, "", 1), "");
  EXPECT_TRUE(has(with(40.999, "", 1), "the part has an allowance above "));
  // The right edge is 40 from above where it ends, and no point of it is farther than 40 from all.
  EXPECT_EQ(with(40.001, R"({"maximum": 30.001})"), "");
  EXPECT_TRUE(has(with(40.001, R"({"maximum": 29.999})"), "feature \"f\" has an allowance above 29.99"));
  // What is finished counts for the maximum of its own alone.
  EXPECT_EQ(with(40.001, R"({"maximum": 1, "finished": 30.001})"), "");
  EXPECT_TRUE(has(with(40.001, R"({"maximum": 99, "finished": 29.999})"),
                  "feature \"f\" has an allowance above 29.99"));
}

/// All four edges finished within so many mm.
Tree finished(double within) {
  Tree one = demands();
  Tree all = feature("[0, 1, 2, 3]");
  all["finished"] = within;
  one["features"].push_back(all);
  return one;
}

TEST(VerifyDemands, RimsThatAreFinishedMayStickOutAndNothingElse) {
  EXPECT_EQ(placement(finished(5), square(-3, 103)), "");
  EXPECT_EQ(placement(finished(5), square(3, 97)), "");
  EXPECT_EQ(placement(finished(2.5), square(-3, 103)),
            "the outline of the blank runs through the part's material beside its finished features\n");
  EXPECT_TRUE(has(placement(finished(2.5), square(3, 97)), "feature \"f\" has an allowance above 2.4"));
  // An outline that is off by 1 leaves as much less.
  EXPECT_EQ(placement(finished(4.1), square(-3, 103), 1), "");
  EXPECT_EQ(placement(finished(4.1), square(3, 97), 1), "");
  EXPECT_NE(placement(finished(3.9), square(3, 97), 1), "");
  // Edges of the blank that begin and end far outside the part run 3 mm into it beside edge 1.
  const std::string dented =
      R"({"outer": [{"line": {"from": [0, 0], "to": [100, 0]}}, {"line": {"from": [100, 0], "to": [100, 10]}},
       {"line": {"from": [100, 10], "to": [95, 50]}}, {"line": {"from": [95, 50], "to": [100, 90]}},
       {"line": {"from": [100, 90], "to": [100, 100]}}, {"line": {"from": [100, 100], "to": [0, 100]}},
       {"line": {"from": [0, 100], "to": [0, 0]}}]})";
  Tree right = demands();
  right["features"].push_back(feature("[1]", R"({"finished": 3.5})"));
  EXPECT_EQ(placement(right, rectangle(10, 20, 98, 80), 0, dented), "");
  right["features"] = Tree::parse("[]");
  right["features"].push_back(feature("[1]", R"({"finished": 2.5})"));
  EXPECT_EQ(placement(right, rectangle(10, 20, 98, 80), 0, dented),
            "the outline of the blank runs through the part's material beside its finished features\n");
  // A corner of the part sticks out of a blank whose edge there begins and ends beside the part.
  const std::string chamfered =
      R"({"outer": [{"line": {"from": [0, 19], "to": [89, 19]}}, {"line": {"from": [89, 19], "to": [99, 29]}},
       {"line": {"from": [99, 29], "to": [99, 100]}}, {"line": {"from": [99, 100], "to": [0, 100]}},
       {"line": {"from": [0, 100], "to": [0, 19]}}]})";
  const auto corner = [&](const char* within) {
    Tree one = demands();
    one["features"].push_back(feature("[0, 1]", within));
    return placement(one, rectangle(10, 20, 98, 80), 0, chamfered);
  };
  EXPECT_EQ(corner(R"({"finished": 4.5})"), "");
  EXPECT_EQ(corner(R"({"finished": 3.5})"),
            "the outline of the blank runs through the part's material beside its finished features\n");
  // One edge is not finished, and has its minimum.
  Tree three = finished(5);
  three.at("/features/0/edges").erase(3);
  EXPECT_EQ(placement(three, square(3, 97)), "");
  three["minimum"] = 4;
  EXPECT_TRUE(has(placement(three, square(3, 97)), "edge 3 needs "));
}

TEST(VerifyDemands, ThePartIsInsideTheBlankAsAWhole) {
  // No edge is near the blank's outline, but a hole of the blank is in the part.
  const std::string blank =
      R"({"outer": [{"line": {"from": [0, 0], "to": [100, 0]}}, {"line": {"from": [100, 0], "to": [100, 100]}},
       {"line": {"from": [100, 100], "to": [0, 100]}}, {"line": {"from": [0, 100], "to": [0, 0]}}],
       "holes": [[{"arc": {"from": [55, 50], "to": [55, 50], "centre": [50, 50], "ccw": false}}]]})";
  EXPECT_EQ(placement(demands(), square(30, 70), 0, blank),
            "the margin is not negative, but the part is not inside the blank\n");
  // All of the hole is within 60 mm of an edge that is finished.
  EXPECT_EQ(placement(finished(60), square(-3, 103), 0, blank), "");
}

/// Pieces had to be shorter than the two are apart.
TEST(VerifyDemands, AnOutlineCloseAlongAnEdgeIsNotBesideWhatIsFinished) {
  Tree one = demands();
  one["features"].push_back(feature("[1]", R"({"finished": 0.1})"));
  EXPECT_EQ(placement(one, rectangle(1e-6, 1e-6, 99.95, 100 - 1e-6)), "");
}

// ---- what is missing --------------------------------------------------------------------------------------

Tree lacking(double minimum, double margin) {
  Tree one = demands();
  one["minimum"] = minimum, one["margin"] = margin, one["margin_bound"] = margin,
  one["margin_found"] = margin;
  return one;
}

TEST(VerifyDemands, NoMoreIsMissingThanTheMarginSays) {
  const auto is_more = [](const Tree& tree, const std::string& part, double off = 0) {
    return has(missing(tree, part, off), "at edge 0 more is missing than the ");
  };
  EXPECT_EQ(missing(lacking(5, 0), square(-90, 200)), "shown");  // nothing is said to be missing
  EXPECT_EQ(missing(lacking(5, -3), square(2.001, 97.999)), "shown");
  EXPECT_TRUE(is_more(lacking(5, -3), square(1.999, 98.001)));
  EXPECT_EQ(missing(lacking(5, -3), square(3.001, 96.999), 1), "shown");
  EXPECT_TRUE(is_more(lacking(5, -3), square(0.5, 99.5), 1));
  // More is missing than the minimum: the part sticks out.
  EXPECT_EQ(missing(lacking(1, -3), rectangle(10, -1.999, 90, 50)), "shown");
  EXPECT_TRUE(is_more(lacking(1, -3), rectangle(10, -2.001, 90, 50)));
  EXPECT_TRUE(is_more(lacking(1, -3), square(200, 300)));
}

/// What edge 1 demands covers a hole of radius 5 beside it, whose middle sticks out furthest, and a notch 4
/// wide.
TEST(VerifyDemands, WhatIsDemandedMayEndInAHoleOrANotchOfTheBlank) {
  const std::string hole =
      R"({"outer": [{"line": {"from": [0, 0], "to": [100, 0]}}, {"line": {"from": [100, 0], "to": [100, 100]}},
       {"line": {"from": [100, 100], "to": [0, 100]}}, {"line": {"from": [0, 100], "to": [0, 0]}}],
       "holes": [[{"arc": {"from": [81, 50], "to": [81, 50], "centre": [76, 50], "ccw": false}}]]})";
  EXPECT_EQ(missing(lacking(20, -5.01), square(30, 70), 0, hole), "shown");
  EXPECT_EQ(missing(lacking(20, -5.02), square(30, 70), 0.01, hole), "shown");
  EXPECT_NE(missing(lacking(20, -4.99), square(30, 70), 0, hole), "shown");
  const std::string notch =
      R"({"outer": [{"line": {"from": [0, 0], "to": [100, 0]}}, {"line": {"from": [100, 0], "to": [100, 48]}},
       {"line": {"from": [100, 48], "to": [72, 48]}}, {"line": {"from": [72, 48], "to": [72, 52]}},
       {"line": {"from": [72, 52], "to": [100, 52]}}, {"line": {"from": [100, 52], "to": [100, 100]}},
       {"line": {"from": [100, 100], "to": [0, 100]}}, {"line": {"from": [0, 100], "to": [0, 0]}}]})";
  EXPECT_EQ(missing(lacking(20, -2.01), square(30, 70), 0, notch), "shown");
  EXPECT_NE(missing(lacking(20, -1.99), square(30, 70), 0, notch), "shown");
}

TEST(VerifyDemands, OfAFeatureNoMoreIsMissingThanItsMinimumSays) {
  const auto with = [](const char* more, const std::string& part, double off = 0) {
    Tree one = lacking(0, -3);
    one["features"].push_back(feature("[0, 1, 2, 3]", more));
    return missing(one, part, off);
  };
  EXPECT_EQ(with(R"({"minimum": 5})", square(2.001, 97.999)), "shown");
  EXPECT_NE(with(R"({"minimum": 5})", square(1.999, 98.001)), "shown");
  // A maximum may be passed by as much.
  EXPECT_EQ(with(R"({"maximum": 5})", square(7.999, 92.001)), "shown");
  EXPECT_TRUE(has(with(R"({"maximum": 5})", square(8.001, 91.999)),
                  "feature \"f\" has more than its maximum by more "));
  EXPECT_EQ(with(R"({"maximum": 5})", square(6.999, 93.001), 1), "shown");
  EXPECT_NE(with(R"({"maximum": 5})", square(7.001, 92.999), 1), "shown");
  // And what is finished may stick out and lie deep by as much.
  EXPECT_EQ(with(R"({"finished": 5})", square(7.999, 92.001)), "shown");
  EXPECT_NE(with(R"({"finished": 5})", square(8.001, 91.999)), "shown");
  // The corners of the first are 7.92 from the blank, and those of the second 8.06.
  EXPECT_EQ(with(R"({"finished": 5})", square(-5.6, 105.6)), "shown");
  EXPECT_EQ(with(R"({"finished": 5})", square(-5.7, 105.7)), "open");
  EXPECT_EQ(with(R"({"finished": 5, "minimum": 90})", square(-5.6, 105.6)), "shown");
  EXPECT_EQ(with(R"({"finished": 5, "maximum": 0})", square(7.999, 92.001)), "shown");
}

std::string disc(double radius) {
  return fmt::format(
      R"({{"outer": [{{"arc": {{"from": [{0}, 50], "to": [{0}, 50], "centre": [50, 50], "ccw": true}}}}]}})",
      50 + radius);
}

TEST(VerifyDemands, OfArcsEveryPointCounts) {
  // A disc of 10 mm in the middle has 40 mm to each side, and 50 less its diagonal to two of them at once.
  Tree one = demands();
  one["largest"] = 50 - std::sqrt(50) + 0.001;
  EXPECT_EQ(placement(one, disc(10)), "");
  one["largest"] = 50 - std::sqrt(50) - 0.001;
  EXPECT_TRUE(has(placement(one, disc(10)), "the part has an allowance above "));
  one["largest"] = 50;
  one["margin"] = 39.999;
  EXPECT_EQ(placement(one, disc(10)), "");
  one["margin"] = 40.001;
  EXPECT_TRUE(has(placement(one, disc(10)), "edge 0 needs "));
  EXPECT_EQ(missing(lacking(5, -3), disc(47.999)), "shown");
  EXPECT_TRUE(has(missing(lacking(5, -3), disc(48.001)), "at edge 0 more is missing "));
  EXPECT_EQ(missing(lacking(1, -3), disc(51.999)), "shown");
  EXPECT_TRUE(has(missing(lacking(1, -3), disc(52.001)), "at edge 0 more is missing "));
}

/// A feature of an edge that the part has not has been found; the other claims about it are of nothing.
TEST(VerifyDemands, AnEdgeThatThePartHasNotIsNothing) {
  Tree one = lacking(0, -3);
  one["features"].push_back(feature("[4]", R"({"maximum": 1})"));
  EXPECT_TRUE(has(missing(one, square(2, 98)), "has edge 4, which the part has not"));
  one["margin"] = 0;
  EXPECT_EQ(placement(one, square(40, 60)), "feature \"f\" has edge 4, which the part has not\n");
  EXPECT_TRUE(Checked(one, square(40, 60)).check->caps(just(0)).at(0).sides.empty());
}

/// An arc whose ends lie 0.001 within its circle, which begins the outline, and the lines to them.
TEST(VerifyDemands, LinesThatJoinAnArcToItsCircleBelongToItsEdge) {
  const std::string part =
      R"({"outer": [{"arc": {"from": [60, 40], "to": [60, 60], "centre": [60.001, 50], "ccw": true}},
      {"line": {"from": [60, 60], "to": [40, 60]}},
      {"arc": {"from": [40, 60], "to": [40, 40.002], "centre": [40, 50], "ccw": true}},
      {"line": {"from": [40, 40.002], "to": [60, 40]}}]})";
  Tree one = demands();
  one["features"].push_back(feature("[0]", R"({"maximum": 1})"));
  one["features"].push_back(feature("[2]", R"({"maximum": 2})"));
  one["features"].push_back(feature("[3]", R"({"maximum": 3})"));
  const Checked checked(one, part);
  EXPECT_EQ(checked.said(), "");
  const auto caps = checked.check->caps(just(0));
  ASSERT_EQ(checked.part.sides.size(), 6U);
  EXPECT_EQ(caps[0].sides, std::vector<std::size_t>{0});
  EXPECT_EQ(caps[1].sides, (std::vector<std::size_t>{2, 3, 4}));
  EXPECT_EQ(caps[2].sides, std::vector<std::size_t>{5});
}

/// The demands of every edge were once held against the edge before it, where the first one was such an arc.
TEST(VerifyDemands, AnOutlineThatBeginsWithAnArcThatMissesItsEndsHasItsEdgesInOrder) {
  const std::string part =
      R"({"outer": [{"arc": {"from": [60, 40], "to": [60, 60.002], "centre": [60, 50], "ccw": true}},
      {"line": {"from": [60, 60.002], "to": [10, 60]}}, {"line": {"from": [10, 60], "to": [10, 40]}},
      {"line": {"from": [10, 40], "to": [60, 40]}}]})";
  Tree one = demands();
  one["features"].push_back(feature("[3]", R"({"maximum": 11})"));
  EXPECT_TRUE(has(placement(one, part), "feature \"f\" has an allowance above 10.99"));
  one = demands();
  one["features"].push_back(feature("[2]", R"({"maximum": 11})"));
  EXPECT_EQ(placement(one, part), "");
  one = demands();
  one["features"].push_back(feature("[4]"));
  EXPECT_EQ(placement(one, part), "feature \"f\" has edge 4, which the part has not\n");
}

TEST(VerifyDemands, WhatIsOutsideIsNotDeep) {
  // No point of the part is in the blank: nothing of it is deep.
  Tree one = demands();
  one["largest"] = 5;
  EXPECT_FALSE(has(placement(one, square(140, 160)), "allowance above"));
  // A part that reaches from outside deep into the blank.
  EXPECT_TRUE(has(placement(one, rectangle(-50, 40, 50, 60)), "the part has an allowance above 4.99"));
  EXPECT_TRUE(has(placement(one, rectangle(-50, 40, 150, 60)), "the part has an allowance above 4.99"));
  one = demands();
  one["largest"] = 60;
  EXPECT_FALSE(has(placement(one, rectangle(-50, 40, 50, 60)), "allowance above"));
}

TEST(VerifyDemands, ACornerSticksOutBetweenEdgesWithTheirMiddleInside) {
  // A corner between two edges, both of which have their middle in the blank.
  const std::string wedge =
      R"({"outer": [{"line": {"from": [50, -5], "to": [90, 60]}}, {"line": {"from": [90, 60], "to": [10, 60]}},
      {"line": {"from": [10, 60], "to": [50, -5]}}]})";
  EXPECT_TRUE(has(missing(lacking(1, -3), wedge), "at edge 0 more is missing"));
  EXPECT_TRUE(has(missing(lacking(0, -3), rectangle(10, -3.001, 90, 50)), "at edge 0 more is missing"));
  EXPECT_EQ(missing(lacking(0, -3), rectangle(10, -2.999, 90, 50)), "shown");
  // What is missing is all that an edge needs.
  EXPECT_EQ(missing(lacking(3, -3), rectangle(10, 0.001, 90, 50)), "shown");
  EXPECT_TRUE(has(missing(lacking(3, -3), rectangle(10, -0.001, 90, 50)), "at edge 0 more is missing"));
}

/// A part of 2 by 40 whose right edge demands 20, and a hole or a notch of the blank beside its upper end.
TEST(VerifyDemands, WhatIsDemandedIsLookedAtInSquares) {
  const auto beside = [](double radius, double margin, double x = 0) {
    const std::string hole = fmt::format(
        R"({{"outer": [{{"line": {{"from": [{0}, 0], "to": [{1}, 0]}}}}, {{"line": {{"from": [{1}, 0], "to": [{1}, 300]}}}},
        {{"line": {{"from": [{1}, 300], "to": [{0}, 300]}}}}, {{"line": {{"from": [{0}, 300], "to": [{0}, 0]}}}}],
        "holes": [[{{"arc": {{"from": [{2}, 205], "to": [{2}, 205], "centre": [{3}, 205], "ccw": false}}}}]]}})",
        x, x + 200, x + 115 + radius, x + 115);
    Tree one = lacking(0, margin);
    one["features"].push_back(feature("[1]", R"({"minimum": 30})"));
    return missing(one, rectangle(x + 98, 50, x + 100, 210), 0, hole);
  };
  EXPECT_EQ(beside(6, -12), "shown");
  EXPECT_EQ(beside(9, -4), "open");
  EXPECT_EQ(beside(6, -12, 1000), "shown");
  EXPECT_EQ(beside(9, -4, 1000), "open");
}

// ---- the criteria -----------------------------------------------------------------------------------------

/// What is said about a result whose criterion is `largest`, with these changes.
std::string criteria(const char* changes, bool optimal = true) {
  Tree one = demands();
  one["criterion"] = "largest", one["margin"] = 8, one["margin_found"] = 10, one["margin_bound"] = 10.5;
  one["margin_gap"] = 0.5, one["give_up"] = 2, one["largest"] = 30;
  one["smallest_largest"] = Tree::parse(R"({"margin": 8, "found": 30, "bound": 29, "gap": 1, "kept": 30,
    "proof": {"grown_for": 7, "most": 29.5, "shift": 0.2, "bound": 0.1}})");
  const Tree made = Tree::parse(changes);
  for (const std::string& key : made.keys()) {
    if (key == "second") {
      for (const std::string& inner : made[key].keys()) one["smallest_largest"][inner] = made[key][inner];
    } else {
      one[key] = made[key];
    }
  }
  Checked checked(one, square(40, 60));
  checked.check->check_criteria(optimal);
  return checked.said();
}

TEST(VerifyDemands, TheNumbersOfTheCriteriaBelongTogether) {
  struct Case {
    const char* changes;
    const char* says;
  };
  const Case cases[] = {
      {"{}", ""},
      {R"({"margin_found": 10.5, "second": {"margin": 8.5}, "margin": 8.5})", ""},
      {R"({"margin_found": 10.6, "second": {"margin": 8.6}, "margin": 8.6})",
       "margin_found 10.6 is above margin_bound\n"},
      {R"({"margin": 10.5})", ""},
      {R"({"margin": 10.6})", "margin 10.6 is above margin_bound\n"},
      {R"({"margin_bound": 10.6})",
       "status is optimal, but margin_bound is 0.6 above margin_found, more than 0.5\n"},
      {R"({"second": {"margin": 8.1}})",
       "smallest_largest.margin 8.1 is not margin_found less give_up\nthe margin 8 is below 8.1, which was "
       "not to "
       "be given up\n"},
      {R"({"second": {"margin": 7.9}})", "smallest_largest.margin 7.9 is not margin_found less give_up\n"},
      {R"({"margin": 7.9})", "the margin 7.9 is below 8, which was not to be given up\n"},
      {R"({"second": {"bound": 30}})", "smallest_largest.kept 30 is neither bound and gap nor found\n"},
      {R"({"second": {"bound": 30, "kept": 31}})", ""},
      {R"({"second": {"bound": 30.5, "kept": 31.5}})", "smallest_largest.bound 30.5 is above found\n"},
      {R"({"second": {"bound": 29.5}})", "smallest_largest.kept 30 is neither bound and gap nor found\n"},
      {R"({"second": {"bound": 29.5, "kept": 30.5}})", ""},
      {R"({"second": {"bound": 28}})",
       "status is optimal, but smallest_largest.found is 2 above its bound, more than 1\n"},
      {R"({"second": {"bound": 28, "kept": 29}})",
       "smallest_largest.kept 29 is neither bound and gap nor found\nstatus is optimal, but "
       "smallest_largest.found "
       "is 2 above its bound, more than 1\n"},
      {R"({"largest": 30.1})", "largest 30.1 is above 30, which the second criterion found\n"},
      {R"({"largest": 30.1, "second": {"bound": 29.5, "kept": 30.5}})",
       "largest 30.1 is above 30, which the second criterion found\n"},
      {R"({"criterion": "even", "largest": 30.5, "second": {"bound": 29.5, "kept": 30.5}})", ""},
      {R"({"criterion": "even", "largest": 30.6, "second": {"bound": 29.5, "kept": 30.5}})",
       "largest 30.6 is above 30.5, which the second criterion found\n"},
      {R"({"second": {"proof": null}})", "nothing is said to prove smallest_largest.bound 29\n"},
      {R"({"second": {"proof": null, "found": 0.5, "bound": 0, "kept": 1}, "largest": 0.5})", ""},
      {R"({"smallest_largest": null})", "smallest_largest is missing, the second criterion\n"},
      {R"({"smallest_largest": null, "criterion": "other"})", ""},
      {R"({"smallest_largest": null, "criterion": "other", "margin": 7.9})",
       "the margin 7.9 is below 8, margin_found less give_up\n"},
      {R"({"smallest_largest": null, "criterion": "smallest", "margin": 10})", ""},
      {R"({"smallest_largest": null, "criterion": "smallest"})", "margin_found is not margin\n"},
      {R"({"criterion": "smallest", "margin": 10})",
       "there is a smallest_largest, which was not asked for or cannot be\n"},
      {R"({"margin_found": 0, "margin": 0, "margin_bound": 0, "second": {"margin": 0}})", ""},
      {R"({"margin_gap": 0.49999999999999994})", ""},  // by a rounding
      {R"({"second": {"bound": 28, "gap": 1.9999999999999998, "kept": 30}})", ""},
      {R"({"smallest_largest": null, "criterion": "other", "margin": 7.999999999999999})", ""},
      {R"({"smallest_largest": null, "criterion": "other", "margin": 9})", ""},
      // With more to give up than was found nothing is kept.
      {R"({"give_up": 20, "margin": 0, "second": {"margin": 0}})", ""},
      {R"({"give_up": 20, "margin": 0.5, "second": {"margin": -10}})",
       "smallest_largest.margin -10 is not margin_found less give_up\n"},
      // A margin below 0 is the first criterion's alone.
      {R"({"margin_found": 0, "margin": 0, "margin_bound": 0, "smallest_largest": null})",
       "smallest_largest is missing, the second criterion\n"},
      {R"({"margin_found": -1, "margin": -1, "margin_bound": -1, "smallest_largest": null})", ""},
      {R"({"margin_found": -1, "margin": -2, "margin_bound": -1, "smallest_largest": null})",
       "margin_found is not margin\n"},
  };
  for (const Case& one : cases) EXPECT_EQ(criteria(one.changes), one.says) << one.changes;
  EXPECT_EQ(criteria(R"({"margin_bound": 10.6})", false), "");
  EXPECT_EQ(criteria(R"({"second": {"bound": 28}})", false), "");
}

TEST(VerifyDemands, ACriterionThatIsNotKnownLeavesTheChoiceOpen) {
  const auto open = [](const char* criterion, double found) {
    Tree one = demands();
    one["criterion"] = criterion, one["margin_found"] = found;
    return Checked(one, square(40, 60)).check->leaves_choice_open();
  };
  for (const char* known : {"smallest", "largest", "even"}) {
    EXPECT_TRUE(knows_criterion(known));
    EXPECT_FALSE(open(known, 0));
  }
  EXPECT_FALSE(knows_criterion("other"));
  EXPECT_TRUE(open("other", 0));
  EXPECT_FALSE(open("other", -0.5));
}

// ---- all placements ---------------------------------------------------------------------------------------

TEST(VerifyDemands, ThePartIsGrownByTheMinimaAndTheirSharesOfTheMargin) {
  Tree one = demands();
  one["minimum"] = 1;
  one["features"].push_back(feature("[1]", R"({"minimum": 3, "scale": 0.5})"));
  one["features"].push_back(feature("[2]", R"({"finished": 4, "minimum": 9})"));
  const std::vector<double> by = Checked(one, square(40, 60)).check->growth(just(2));
  ASSERT_EQ(by.size(), 4U);
  EXPECT_NEAR(by[0], 3, 1e-12);
  EXPECT_NEAR(by[1], 4, 1e-12);
  EXPECT_NEAR(by[2], -4, 1e-12);
  EXPECT_NEAR(by[3], 3, 1e-12);
  for (const double none : Checked(demands(), square(40, 60)).check->growth(just(0))) EXPECT_EQ(none, 0);
  one = demands();
  one["features"].push_back(feature("[0, 1, 2, 3]"));
  for (const double none : Checked(one, square(40, 60)).check->growth(just(0))) EXPECT_EQ(none, 0);
}

TEST(VerifyDemands, CapsAreTheMaximaOfTheirSidesAndOneOfAllThatIsNotFinished) {
  Tree one = demands();
  one["features"].push_back(feature("[0]", R"({"maximum": 7})"));
  one["features"].push_back(feature("[1, 2]", R"({"finished": 4, "maximum": 9})"));
  one["features"].push_back(feature("[3]"));
  const Checked checked(one, square(40, 60));
  const auto caps = checked.check->caps(just(0.5));
  ASSERT_EQ(caps.size(), 2U);
  EXPECT_EQ(caps[0].sides, std::vector<std::size_t>{0});
  EXPECT_NEAR(caps[0].most, 7.5, 1e-12);
  EXPECT_EQ(caps[1].sides, (std::vector<std::size_t>{1, 2}));
  EXPECT_NEAR(caps[1].most, 4.5, 1e-12);
  const auto more = checked.check->caps(just(0.5), just(20));
  ASSERT_EQ(more.size(), 3U);
  EXPECT_EQ(more[2].sides, (std::vector<std::size_t>{0, 3}));
  EXPECT_NEAR(more[2].most, 20.5, 1e-12);
}

TEST(VerifyDemands, ThePartThatIsGrownIsAsFarAsItsEdgesReach) {
  Tree one = demands();
  one["minimum"] = 5;
  const auto off = [](const Tree& tree, double x, double y) {
    return Checked(tree, square(40, 60)).check->off_grown_part({just(x), just(y)}, just(2));
  };
  EXPECT_EQ(off(one, 50, 50), 0);
  EXPECT_EQ(off(one, 66, 50), 0);
  EXPECT_NEAR(off(one, 70, 50), 3, 1e-12);
  EXPECT_NEAR(off(one, 50, 30), 3, 1e-12);
  EXPECT_NEAR(off(one, 50, 75), 8, 1e-12);
  // What is finished has a rim that is none of it: 4 mm along the right edge, which counts for nothing.
  one["features"].push_back(feature("[1]", R"({"finished": 4})"));
  EXPECT_EQ(off(one, 50, 50), 0);
  EXPECT_EQ(off(one, 55.9, 50), 0);
  EXPECT_GT(off(one, 56.1, 50), 0);
  EXPECT_NEAR(off(one, 90, 50), std::hypot(30, 10) - 7, 1e-12);
}

/// A pivot beside a long finished edge once counted as far off as the next edge that grows.
TEST(VerifyDemands, BehindARimTheGrownPartBeginsAgain) {
  Tree one = demands();
  one["features"].push_back(feature("[1]", R"({"finished": 4})"));
  const auto off = [&](double x, double y, const std::string& part) {
    return Checked(one, part).check->off_grown_part({just(x), just(y)}, just(2));
  };
  const std::string tall = rectangle(40, 0, 60, 100);
  EXPECT_NEAR(off(61, 50, tall), 5, 1e-10);
  EXPECT_GE(off(61, 50, tall), 5);
  EXPECT_NEAR(off(58, 50, tall), 2, 1e-10);
  // The rim takes all of a thin part but what its other edges grow by.
  EXPECT_NEAR(off(61, 50, rectangle(57, 0, 60, 100)), 2, 1e-10);
  // Another edge's points count in the rim, too, where it grows by nothing.
  EXPECT_NEAR(Checked(one, tall).check->off_grown_part({just(58), just(0)}, just(0)), 0, 1e-12);
  // On the finished edge itself no side of it was looked at.
  EXPECT_NEAR(off(60, 50, tall), 4, 1e-10);
}

/// Behind the corner of a notch whose edges are finished the material begins on an arc, which was not looked
/// for.
TEST(VerifyDemands, BehindARimTheGrownPartBeginsAgainAboutACornerToo) {
  Tree one = demands();
  one["features"].push_back(feature("[0, 1, 2, 3, 4, 5]", R"({"finished": 4})"));
  const std::string l_shape =
      R"({"outer": [{"line": {"from": [0, 0], "to": [90, 0]}}, {"line": {"from": [90, 0], "to": [90, 40]}},
        {"line": {"from": [90, 40], "to": [40, 40]}}, {"line": {"from": [40, 40], "to": [40, 90]}},
        {"line": {"from": [40, 90], "to": [0, 90]}}, {"line": {"from": [0, 90], "to": [0, 0]}}]})";
  const auto off = [&](double x, double y) {
    return Checked(one, l_shape).check->off_grown_part({just(x), just(y)}, just(2));
  };
  EXPECT_NEAR(off(39, 38), 4 - std::hypot(1, 2), 1e-10);
  EXPECT_GE(off(39, 38), 4 - std::hypot(1, 2));
}

/// What is said of a bound for all placements, with a cap or without.
std::string bound(const char* changes, bool capped = false) {
  Tree one = demands();
  one["margin_bound"] = 10, one["grown_for"] = 8, one["bound"] = 2, one["shift"] = 5;
  if (capped) one["features"].push_back(feature("[0]", R"({"maximum": 90, "scale": 2})"));
  const Tree made = Tree::parse(changes);
  for (const std::string& key : made.keys()) one[key] = made[key];
  Checked checked(one, square(40, 60));
  checked.check->check_bound();
  return checked.said();
}

TEST(VerifyDemands, TheBoundOfTheMarginFollowsFromTheCertificates) {
  const std::string no = "margin_bound 10 does not follow from the bound";
  EXPECT_EQ(bound("{}"), "");
  EXPECT_EQ(bound(R"({"bound": 1.5})"), "");
  EXPECT_TRUE(bound(R"({"bound": 2.001})").starts_with(no));
  EXPECT_TRUE(bound(R"({"grown_for": 8.001})").starts_with(no));
  EXPECT_EQ(bound(R"({"grown_for": 10, "bound": 0})"), "");
  EXPECT_TRUE(bound(R"({"grown_for": 10.001, "bound": -1})").starts_with(no));
  // What is finished does not count for the least scale, and what needs less than the margin does.
  const auto scaled = [](const char* more) {
    Tree one = demands();
    one["margin_bound"] = 10, one["grown_for"] = 8, one["bound"] = 2, one["shift"] = 5;
    one["features"].push_back(feature("[0, 1, 2, 3]", more));
    Checked checked(one, square(40, 60));
    checked.check->check_bound();
    return checked.said();
  };
  EXPECT_EQ(scaled(R"({"scale": 1.5})"), "");
  EXPECT_TRUE(scaled(R"({"scale": 0.9})").starts_with(no));
  EXPECT_EQ(scaled(R"({"scale": 0.9, "finished": 3})"), "");
  // Below 0 the certificate bounds the margin itself.
  const std::string below = "margin_bound -1 does not follow from the bound";
  EXPECT_EQ(bound(R"({"margin_bound": -1, "grown_for": 0, "bound": -1})"), "");
  EXPECT_TRUE(bound(R"({"margin_bound": -1, "grown_for": 0, "bound": -0.999})").starts_with(below));
  EXPECT_TRUE(bound(R"({"margin_bound": -1, "grown_for": 0.001, "bound": -1})").starts_with(below));
  EXPECT_EQ(bound(R"({"margin_bound": 0, "grown_for": 0, "bound": 0})"), "");
  // With caps the certificate must not say more than what is left under them.
  EXPECT_EQ(bound(R"({"shift": 2})", true), "");
  EXPECT_TRUE(has(bound(R"({"shift": 1.999})", true), "is above its shift 1.99"));
  EXPECT_EQ(bound(R"({"shift": 1})"), "");
  Tree finished = demands();
  finished["margin_bound"] = 10, finished["grown_for"] = 8, finished["bound"] = 2, finished["shift"] = 1.999;
  finished["features"].push_back(feature("[0]", R"({"finished": 90})"));
  Checked checked(finished, square(40, 60));
  checked.check->check_bound();
  EXPECT_TRUE(has(checked.said(), "is above its shift 1.99"));
  EXPECT_EQ(bound(R"({"margin_bound": 0.5, "grown_for": 0.25, "bound": 0.25})"), "");
  EXPECT_TRUE(bound(R"({"margin_bound": -1, "grown_for": 2, "bound": -4})").starts_with(below));
}

TEST(VerifyDemands, TheBoundOfLargestAllowancesFollowsFromItsCertificate) {
  const auto with = [](const char* changes, bool capped = false) {
    Tree one = demands();
    one["smallest_largest"] = Tree::parse(R"({"margin": 8, "found": 30, "bound": 29, "gap": 1, "kept": 30,
      "proof": {"grown_for": 7, "most": 29.5, "shift": 0.25, "bound": 0.125}})");
    if (capped) one["features"].push_back(feature("[0]", R"({"maximum": 90})"));
    const Tree made = Tree::parse(changes);
    for (const std::string& key : made.keys())
      (made[key].is_null() || key == "margin" || key == "limit"
           ? one["smallest_largest"]
           : one["smallest_largest"]["proof"])[key == "limit" ? "bound" : key] = made[key];
    Checked checked(one, square(40, 60));
    checked.check->check_largest_bound();
    return checked.said();
  };
  const std::string nothing =
      "the certificate of largest allowances says nothing of placements with a margin of ";
  EXPECT_EQ(with("{}"), "");
  EXPECT_EQ(with(R"({"grown_for": 7.874})"), "");
  EXPECT_TRUE(with(R"({"grown_for": 7.876})").starts_with(nothing));
  EXPECT_TRUE(with(R"({"grown_for": 8.1, "bound": -1, "shift": 5})").starts_with(nothing));
  EXPECT_EQ(with(R"({"limit": 29.624})"), "");
  EXPECT_TRUE(with(R"({"limit": 29.626})").starts_with("smallest_largest.bound 29.626 does not follow"));
  EXPECT_EQ(with(R"({"shift": 0.126})", true), "");
  EXPECT_TRUE(has(with(R"({"shift": 0.125})", true), "of largest allowances is not below its shift"));
  EXPECT_TRUE(has(with(R"({"shift": 0.124})", true), "of largest allowances is not below its shift"));
  EXPECT_EQ(with(R"({"shift": 0.124, "limit": 29})"), "");
}

}  // namespace
}  // namespace lekalo::verify::verify_demands_test

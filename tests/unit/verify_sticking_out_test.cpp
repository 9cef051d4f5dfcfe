// How far a part sticks out of its blank where the farthest point lies inside the part, and how long that
// takes.

#include "verify/shape/sticking_out.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify::verify_sticking_out_test {
namespace {

Shape shape_of(const std::string& text) {
  std::string complaint;
  Shape made = read_shape(*parse_json(text, "shape"), "shape", complaint);
  EXPECT_EQ(complaint, "");
  return made;
}
std::string arc(double x0, double y0, double x1, double y1, double cx, double cy, bool ccw = true) {
  return fmt::format(R"({{"arc": {{"from": [{}, {}], "to": [{}, {}], "centre": [{}, {}], "ccw": {}}}}})", x0,
                     y0, x1, y1, cx, cy, ccw);
}
std::string line(double x0, double y0, double x1, double y1) {
  return fmt::format(R"({{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", x0, y0, x1, y1);
}
std::string joined(const std::vector<std::string>& parts) {
  std::string list;
  for (const std::string& part : parts) list += (list.empty() ? "" : ", ") + part;
  return "[" + list + "]";
}
std::string circle(double x, double y, double r) { return joined({arc(x + r, y, x + r, y, x, y)}); }
std::string polygon(const std::vector<std::array<double, 2>>& points) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const auto &from = points[k], &to = points[(k + 1) % points.size()];
    lines.push_back(line(from[0], from[1], to[0], to[1]));
  }
  return joined(lines);
}
std::string box(double x0, double y0, double x1, double y1) {
  return polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}});
}
/// A region with holes, and discs in these.
Shape region(const std::string& outer, const std::vector<std::string>& holes = {},
             const std::vector<std::string>& discs = {}) {
  std::vector<std::string> pieces{fmt::format(R"({{"outer": {}, "holes": {}}})", outer, joined(holes))};
  for (const std::string& disc : discs) pieces.push_back(fmt::format(R"({{"outer": {}}})", disc));
  return shape_of(fmt::format(R"({{"pieces": {}}})", joined(pieces)));
}
/// A wide frame with holes.
Shape frame(const std::vector<std::string>& holes, const std::vector<std::string>& discs = {}) {
  return region(box(-60, -60, 60, 60), holes, discs);
}

void expect_out(const Shape& part, const Shape& blank, double out, double tolerance = 1e-6) {
  const Span found = sticking_out(part, blank, tolerance);
  EXPECT_LE(found.low, out + 1e-9);
  EXPECT_GE(found.high, out - 1e-9);
  EXPECT_LE(found.high - found.low, 2.1 * tolerance);
}

TEST(StickingOut, AnArcOfAFullTurnIsCutBeforeItIsBounded) {
  // Both its ends are in one point, which does not stick out.
  expect_out(region(circle(0, 0, 4)), region(box(-9, -9, 9, 0)), 4);
  expect_out(region(joined({arc(4, 0, -4, 0, 0, 0), line(-4, 0, 4, 0)})), region(box(-9, -9, 9, 1)), 3);
}

TEST(StickingOut, TheWholePartIsSearched) {
  expect_out(region(box(0, 0, 40, 10)), frame({circle(36, 5, 3)}), 3);
  expect_out(region(box(0, 0, 10, 40)), frame({circle(5, 3, 2)}), 2);
}

// Each hole has two chambers, and the farthest point is in one of them, near a square whose centre is
// between: there the nearest points are in opposite directions.

/// What is in the half-planes of lines counts from their ends there.
TEST(StickingOut, TwoCornersThatFaceEachOtherAreNoGroove) {
  const double w = 5.0 / 3;
  const std::string corners = polygon({{-w, 3}, {0, 1}, {w, 3}, {w, -3}, {0, -1}, {-w, -3}});
  expect_out(region(box(-0.6, -0.6, 1.8, 1.8)), frame({corners}), 17.0 / 15);
  // Corners of arcs whose circles come a little or much nearer, where the arcs are not.
  for (const auto& [x, y, c, d] : std::vector<std::array<double, 4>>{{0.8, 2.6, 1.2, 2.6}, {1, 2, 3, 5}}) {
    const std::string arcs =
        joined({line(-w, 3, -x, y), arc(-x, y, 0, 1, c, d), arc(0, 1, x, y, -c, d), line(x, y, w, 3),
                line(w, 3, w, -3), line(w, -3, x, -y), arc(x, -y, 0, -1, -c, -d), arc(0, -1, -x, -y, c, -d),
                line(-x, -y, -w, -3), line(-w, -3, -w, 3)});
    expect_out(region(box(-0.6, -0.6, 1.8, 1.8)), frame({arcs}), 17.0 / 15);
  }
}

TEST(StickingOut, TwoDiscsThatFaceEachOtherAreNoGroove) {
  const double out = std::sqrt(4.36) - 1, w = 0.6 + out;
  expect_out(region(box(-0.65, -0.65, 1.95, 1.95)),
             frame({box(-w, -4, w, 4)}, {circle(0, 2, 1), circle(0, -2, 1)}), out);
}

TEST(StickingOut, BeyondTheWallOfAGrooveIsAnotherHole) {
  const Shape part = region(box(-3, -3, 3, 3));
  expect_out(part, frame({box(-5, -0.1, 5, 0.1), box(-2, 0.2, 2, 1.2)}), 0.5);
  const double y = 19.9 * 0.8, x = 19.9 * 0.6, over = 20.1 / 19.9;
  const std::string bent =
      joined({arc(x, y - 20, -x, y - 20, 0, -20), line(-x, y - 20, -x * over, y * over - 20),
              arc(-x * over, y * over - 20, x * over, y * over - 20, 0, -20, false),
              line(x * over, y * over - 20, x, y - 20)});
  expect_out(part, frame({bent, box(-2, 0.2, 2, 2.2)}), 1);
}

/// The deepest points of a groove are a line, along which squares are needed as long as it is not known to be
/// level.
TEST(StickingOut, GroovesOfEvenWidth) {
  const Shape part = region(box(-7, -7, 7, 7));
  expect_out(part, frame({box(-4, -0.5, 4, 0.5)}), 0.5);
  expect_out(part, frame({circle(0, 0, 5)}, {circle(0, 0, 4)}), 0.5, 1e-4);
  const auto part_of_ring = [](double x) {
    return joined({arc(x, -4, x, 4, 0, 0), line(x, 4, 0.8 * x, 3.2),
                   arc(0.8 * x, 3.2, 0.8 * x, -3.2, 0, 0, false), line(0.8 * x, -3.2, x, -4)});
  };
  expect_out(part, frame({part_of_ring(3)}), 0.5, 1e-4);
  expect_out(part, frame({part_of_ring(-3)}), 0.5, 1e-4);
}

// ---- how long it takes ------------------------------------------------------------------------------------

bool takes_at_most(std::uint64_t steps, const Shape& part, const Shape& blank, double tolerance,
                   double enough = kInfinity) {
  RunControl run;
  run.work_limit = steps;
  return stoppable(run, [&] { return sticking_out(part, blank, tolerance, enough); }).has_value();
}

TEST(StickingOut, NothingIsLookedAtOnceItIsKnownOrEnough) {
  const Shape plate = region(box(0, 0, 10, 10));
  EXPECT_TRUE(takes_at_most(30, plate, frame({}), 0));
  EXPECT_TRUE(takes_at_most(1000, plate, frame({circle(5, 0, 1)}), 0, 0.5));
  EXPECT_TRUE(takes_at_most(1000, plate, frame({box(1, 1, 9, 9)}), 0, 2));
}

TEST(StickingOut, LargeShapesGetFewerPieces) {
  // The blank has 4,000 sides, most of them far from the part, which so gets 1,001 pieces and as many
  // squares.
  std::vector<std::array<double, 2>> comb{{60, 60}, {-60, 60}};
  for (int k = 0; k < 3994; ++k) comb.push_back({-60 + 0.03 * k, k % 2 == 0 ? -60.0 : -50.0});
  const Shape blank = region(polygon(comb), {box(1, 1, 9, 9)}), part = region(box(0, 0, 10, 10));
  EXPECT_TRUE(takes_at_most(1100 * 4001, part, blank, 0));
  const Span found = sticking_out(part, blank, 0);
  EXPECT_LE(found.low, 4);
  EXPECT_GE(found.high, 4);
}

TEST(StickingOut, AnOutlineOfALargeShapeGetsFewerPieces) {
  // Its farthest point is on the outline of the part, and no piece there is ever known to stick out by no
  // more.
  std::vector<std::array<double, 2>> comb{{60, 60}, {-60, 60}};
  for (int k = 0; k < 3994; ++k) comb.push_back({-60 + 0.03 * k, k % 2 == 0 ? -60.0 : -50.0});
  const Shape blank = region(polygon(comb), {circle(5.3, 0, 0.7)}), part = region(box(0, 0, 10, 10));
  EXPECT_TRUE(takes_at_most(2200 * 4001, part, blank, 0));
}

TEST(StickingOut, SquaresThatHoldNoFarthestPointAreLeftOut) {
  // Squares at the origin, which counts for nothing, and beside circles where the arcs are not.
  const Shape part = region(box(-7, -7, 7, 7));
  const std::string lens = joined({arc(-5, 0, 5, 0, 0, 12), arc(5, 0, -5, 0, 0, -12)}),
                    slot = joined({line(-3, -1, 3, -1), arc(3, -1, 3, 1, 3, 0), line(3, 1, -3, 1),
                                   arc(-3, 1, -3, -1, -3, 0)});
  EXPECT_TRUE(takes_at_most(550, part, frame({polygon({{-1, 0}, {0, -2}, {1, 0}, {0, 2}})}), 1e-6));
  EXPECT_TRUE(takes_at_most(1130, part, frame({box(-3, -0.5, 3, 0.5)}), 1e-6));
  EXPECT_TRUE(takes_at_most(990, part, frame({lens}), 1e-6));
  EXPECT_TRUE(takes_at_most(3370, part, frame({slot}), 1e-6));
}

}  // namespace
}  // namespace lekalo::verify::verify_sticking_out_test

// Places in outlines and faults of outlines, at the bounds where rounding leaves them open.

#include "verify/shape/shape_inside.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "verify/read/json.hpp"
#include "verify/shape/shape_distance.hpp"

namespace lekalo::verify::verify_shape_inside_test {
namespace {

std::string line(double x0, double y0, double x1, double y1) {
  return fmt::format(R"({{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", x0, y0, x1, y1);
}
std::string arc(double x0, double y0, double x1, double y1, double cx, double cy, bool ccw = true) {
  return fmt::format(R"({{"arc": {{"from": [{}, {}], "to": [{}, {}], "centre": [{}, {}], "ccw": {}}}}})", x0,
                     y0, x1, y1, cx, cy, ccw);
}
std::string polygon(const std::vector<std::array<double, 2>>& corners) {
  std::string edges;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto &a = corners[k], &b = corners[(k + 1) % corners.size()];
    edges += (k == 0 ? "" : ", ") + line(a[0], a[1], b[0], b[1]);
  }
  return "[" + edges + "]";
}
std::string box(double low, double high) {
  return polygon({{low, low}, {high, low}, {high, high}, {low, high}});
}
std::string edges(const std::vector<std::string>& list) { return fmt::format("[{}]", fmt::join(list, ", ")); }
Shape shape(const std::string& text) {
  std::string complaint;
  const std::string whole = text[0] == '[' ? R"({"outer": )" + text + "}" : text;
  Shape made = read_shape(*parse_json(whole, "shape"), "shape", complaint);
  EXPECT_EQ(complaint, "") << whole;
  return made;
}
std::string pieces(const std::vector<std::string>& outer_and_holes) {
  std::string list;
  for (const std::string& piece : outer_and_holes) list += (list.empty() ? "" : ", ") + piece;
  return R"({"pieces": [)" + list + "]}";
}
std::string piece(const std::string& outer, const std::vector<std::string>& holes = {}) {
  return fmt::format(R"({{"outer": {}, "holes": [{}]}})", outer, fmt::join(holes, ", "));
}
std::string fault(const std::string& text) { return fault_of(shape(text)).value_or(""); }
Vec at(double x, double y) { return {just(x), just(y)}; }
using Answer = std::optional<bool>;

TEST(VerifyShapeInside, APlaceOnAnOutlineIsOpenAndOneStepBesideIsNot) {
  const Shape square = shape(box(0, 10)), disc = shape(edges({arc(5, 0, 5, 0, 0, 0)}));
  for (const auto& [x, y] : std::vector<std::array<double, 2>>{
           {10, 10}, {0, 0}, {10, 0}, {0, 10}, {10, 5}, {0, 5}, {5, 0}, {5, 10}})
    EXPECT_EQ(holds(square, at(x, y)), Answer{}) << x << ' ' << y;
  for (const auto& [x, y] :
       std::vector<std::array<double, 2>>{{5, 0}, {-5, 0}, {0, 5}, {0, -5}, {3, 4}, {-4, 3}})
    EXPECT_EQ(holds(disc, at(x, y)), Answer{}) << x << ' ' << y;
  EXPECT_EQ(holds(square, at(step_down(10), 5)), Answer{true});
  EXPECT_EQ(holds(square, at(step_up(10), 5)), Answer{false});
  EXPECT_EQ(holds(square, at(5, step_down(10))), Answer{true});
}

TEST(VerifyShapeInside, SegmentsOfCirclesWhateverTheirTurn) {
  Random random(7);
  for (int i = 0; i < 60; ++i) {
    const double from = 6.3 * random.uniform(), turn = 0.3 + 5.6 * random.uniform();
    const bool ccw = random.below(2) == 0;
    const double r = 5, x0 = r * std::cos(from), y0 = r * std::sin(from), x1 = r * std::cos(from + turn),
                 y1 = r * std::sin(from + turn);
    const Shape segment = shape(ccw ? edges({arc(x0, y0, x1, y1, 0, 0), line(x1, y1, x0, y0)})
                                    : edges({arc(x1, y1, x0, y0, 0, 0, false), line(x0, y0, x1, y1)}));
    for (int k = 0; k < 40; ++k) {
      const double x = 12 * random.uniform() - 6, y = 12 * random.uniform() - 6;
      const double beyond_chord =
          ((x1 - x0) * (y - y0) - (y1 - y0) * (x - x0)) / std::hypot(x1 - x0, y1 - y0);
      const double from_circle = std::hypot(x, y) - r;
      if (std::abs(from_circle) < 1e-6 || std::abs(beyond_chord) < 1e-6) continue;
      const bool inside = from_circle < 0 && beyond_chord < 0;
      EXPECT_EQ(holds(segment, at(x, y)), Answer{inside})
          << "from " << from << " turn " << turn << " at " << x << ' ' << y;
    }
  }
}

/// Ends of arcs on the lines of all rays that are tried, behind the place: the chords of arcs whose boxes do
/// not hold it count all the same.
TEST(VerifyShapeInside, EndsOfArcsLevelWithEveryRay) {
  std::vector<std::array<double, 2>> ends;
  const double step = std::atan2(4, 3);
  for (const double sign : {1.0, -1.0}) {
    ends.clear();
    for (int k = 0; k < 6; ++k)
      ends.push_back({-8 * std::cos(sign * k * step), -8 * std::sin(sign * k * step)});
    std::vector<std::string> list;
    for (std::size_t k = 0; k < 6; ++k) {
      const auto &a = ends[k], &b = ends[(k + 1) % 6];
      list.push_back(k == 5 ? line(a[0], a[1], b[0], b[1]) : arc(a[0], a[1], b[0], b[1], 0, 0, sign > 0));
    }
    EXPECT_EQ(holds(shape(edges(list)), at(0, 0)), Answer{true}) << sign;
  }
}

/// A half disc made by hand, whose arc ends a tenth inside the ends as written.
TEST(VerifyShapeInside, ARayThroughTheJointOfAnArcTellsNothing) {
  Shape half = shape(edges({arc(0, -5, 0, 5, 0, 0), line(0, 5, 0, -5)}));
  half.sides[0].off = 0.125;
  half.sides[0].from = half.sides[1].to = at(0, -5.125);
  half.sides[0].to = half.sides[1].from = at(0, 5.125);
  bound(half);
  EXPECT_EQ(holds(half, at(-0.12, 5.01)), Answer{false});
  EXPECT_EQ(holds(half, at(-0.12, -5.01)), Answer{false});
  EXPECT_EQ(holds(half, at(0.0625, 0)), Answer{true});
  // The direction of an end is known but roughly: a ray that may pass beside the arc tells nothing.
  Shape rough = shape(edges({arc(5, 0, -5, 0, 0, 0), line(-5, 0, 5, 0)}));
  rough.sides[0].first = {{0.9, 1}, {-0.3, 0.3}};
  rough.sides[0].from = rough.sides[1].to = at(4.8, 1.4);
  bound(rough);
  for (const double y : {0.4, 0.8, 1.2}) EXPECT_NE(holds(rough, at(4.75, y)), Answer{true}) << y;
}

TEST(VerifyShapeInside, APlaceInNestedPieces) {
  // An island in the hole of a ring, whichever is written first.
  const std::string island = piece(box(4, 6)), ring = piece(box(0, 10), {box(1, 9)});
  for (const bool swapped : {false, true}) {
    const Shape both = shape(pieces(swapped ? std::vector{ring, island} : std::vector{island, ring}));
    EXPECT_EQ(holds(both, at(5, 5)), Answer{true});
    EXPECT_EQ(holds(both, at(2, 5)), Answer{false});
    EXPECT_EQ(holds(both, at(0.5, 5)), Answer{true});
    EXPECT_EQ(holds(both, at(4, 5)), Answer{});
    EXPECT_EQ(holds(both, at(1, 5)), Answer{});
  }
  // A ring in a ring is in order, each hole belonging to its own.
  const std::string small = piece(box(4, 6), {box(4.5, 5.5)});
  EXPECT_EQ(fault(pieces({small, ring})), "");
  EXPECT_EQ(fault(pieces({ring, small})), "");
  EXPECT_EQ(fault(piece(box(0, 10), {box(11, 12)})), "hole 0 of piece 0 is not inside it");
  EXPECT_EQ(fault(piece(box(0, 10), {box(1, 9), box(4, 6)})), "hole 1 of piece 0 lies in its hole 0");
}

TEST(VerifyShapeInside, LyingWithin) {
  const Shape blank = shape(piece(box(0, 10), {box(4, 6)}));
  EXPECT_EQ(lies_within(shape(box(1, 3)), blank), Answer{true});
  EXPECT_EQ(lies_within(shape(box(11, 13)), blank), Answer{false});
  EXPECT_EQ(lies_within(shape(box(3, 7)), blank), Answer{false}) << "over the hole";
  EXPECT_EQ(lies_within(shape(piece(box(2, 8), {box(3, 7)})), blank), Answer{true});
  EXPECT_EQ(lies_within(shape(box(4.5, 5.5)), blank), Answer{false});
  EXPECT_EQ(lies_within(shape(pieces({piece(box(1, 3)), piece(box(11, 13))})), blank), Answer{false});
  EXPECT_EQ(lies_within(shape(pieces({piece(box(11, 13)), piece(box(1, 3))})), blank), Answer{false});
  EXPECT_EQ(lies_within(blank, blank), Answer{}) << "on its outline";
}

TEST(VerifyShapeInside, FaultsOfThreeSides) {
  const auto expect = [](const std::vector<std::string>& sides, const std::string& sentence) {
    EXPECT_EQ(fault(edges(sides)), sentence);
  };
  const std::string meet = " meet, or cannot be told from it";
  expect({line(0, 0, 5, 0), line(5, 0, 10, 0), line(10, 0, 0, 0)}, "side 0 runs back along side 2");
  expect({line(0, 0, 5, 0), line(5, 0, 0, 0)}, "side 1 runs back along side 0");
  // The third corner on the arc, whichever side the arc is.
  expect({arc(5, 0, -5, 0, 0, 0), line(-5, 0, 3, 4), line(3, 4, 5, 0)}, "sides 0 and 1" + meet);
  expect({line(3, 4, 5, 0), arc(5, 0, -5, 0, 0, 0), line(-5, 0, 3, 4)}, "sides 0 and 1" + meet);
  expect({line(-5, 0, 3, 4), line(3, 4, 5, 0), arc(5, 0, -5, 0, 0, 0)}, "sides 0 and 2" + meet);
  // The end of an arc on the side before it.
  expect({line(0, 0, 10, 0), arc(10, 0, 5, 0, 7.5, 0), line(5, 0, 0, 0)}, "sides 0 and 1" + meet);
  expect({arc(5, 0, -5, 0, 0, 0), line(-5, 0, 3, 3), line(3, 3, 5, 0)}, "");
  // Two arcs that miss their joint by as much: what joins them lies on itself.
  expect({arc(5, 0, 0, 6, 0, 0), arc(0, 6, -5, 0, 0, 0), line(-5, 0, 5, 0)}, "");
}

TEST(VerifyShapeInside, NeighboursCrossAgainDeepEnough) {
  // A side that leaves the end of an arc inwards by a slope, and leaves the circle again.
  const auto sliver = [](double slope) {
    return fault(edges({arc(0, -5, 5, 0, 0, 0), line(5, 0, 5 - 9 * slope, -9), line(5 - 9 * slope, -9, 0, -9),
                        line(0, -9, 0, -5)}));
  };
  EXPECT_EQ(sliver(0.0625), "sides 0 and 1 cross");
  EXPECT_EQ(sliver(0.0078125), "");
  // Sides of next to no length turn back as well as any.
  EXPECT_EQ(fault(R"({"outer": [{"line": {"from": [0.1, 0], "to": [0.10000000000000000001, 0]}},
    {"line": {"from": [0.10000000000000000001, 0], "to": [5, 5]}}, {"line": {"from": [5, 5], "to": [0, 5]}},
    {"line": {"from": [0, 5], "to": [0.1, 0]}}]})"),
            "side 1 runs back along side 0");
}

/// Lines that join an arc count as part of it, and its neighbours' neighbours are still looked at.
TEST(VerifyShapeInside, SidesBesideAJoinedArcAreCounted) {
  const std::string joined = arc(5, 0, -5.5, 0, 0, 0);
  const std::string meet = " meet, or cannot be told from it";
  const auto cut = [&](std::size_t begin) {
    // The last side but one comes back across the arc, two sides before it or behind it.
    const std::vector<std::string> around{joined, line(-5.5, 0, -7, -3), line(-7, -3, 0, 9), line(0, 9, 8, 2),
                                          line(8, 2, 5, 0)};
    std::vector<std::string> turned;
    for (std::size_t k = 0; k < around.size(); ++k) turned.push_back(around[(begin + k) % around.size()]);
    return fault(edges(turned));
  };
  for (std::size_t begin = 0; begin < 5; ++begin)
    EXPECT_NE(cut(begin).find(meet), std::string::npos) << begin;
  const auto back = [&](std::size_t begin) {
    const std::vector<std::string> around{
        joined,           line(-5.5, 0, -8, 2), line(-8, 2, -8, -9), line(-8, -9, 0, 9),
        line(0, 9, 8, 2), line(8, 2, 5, 0)};
    std::vector<std::string> turned;
    for (std::size_t k = 0; k < around.size(); ++k) turned.push_back(around[(begin + k) % around.size()]);
    return fault(edges(turned));
  };
  for (std::size_t begin = 0; begin < 6; ++begin)
    EXPECT_NE(back(begin).find(meet), std::string::npos) << begin;
  EXPECT_EQ(fault(edges({joined, line(-5.5, 0, -7, -3), line(-7, -3, 7, -3), line(7, -3, 5, 0)})), "");
}

}  // namespace
}  // namespace lekalo::verify::verify_shape_inside_test

// Exact relations of outlines on the grid: every case touches the bound.

#include "verify/layout/grid_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "lekalo/base/stop.hpp"

namespace lekalo::verify::verify_grid_outline_test {
namespace {

using Outlines = std::vector<GridOutline>;

GridLoop rectangle(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}
GridOutline box(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height) {
  return make_outline({rectangle(x, y, width, height)});
}

GridPoint turned(GridPoint p, int quarters) {
  for (; quarters > 0; --quarters) p = {-p.y, p.x};
  return p;
}
GridOutline turned(GridOutline outline, int quarters) {
  GridLoop loop;
  for (GridEdge& edge : outline.edges) {
    edge = {turned(edge.from, quarters), turned(edge.to, quarters)};
    loop.push_back(edge.from);
  }
  outline.box = make_outline({loop}).box;
  return outline;
}

bool common(const Outlines& in, const Outlines& out, int quarters = 0) {
  Outlines all;
  for (const Outlines* list : {&in, &out})
    for (const GridOutline& outline : *list) all.push_back(turned(outline, quarters));
  std::vector<const GridOutline*> ins, outs;
  for (const GridOutline& outline : all) (ins.size() < in.size() ? ins : outs).push_back(&outline);
  return have_common_disc(ins, outs);
}

TEST(VerifyGridOutline, LoopsAreTurnedAndTheBoxIsThatOfAllPoints) {
  const GridLoop outer{{5, 0}, {0, -20}, {-10, 3}, {1, 40}}, hole = rectangle(-2, 0, 3, 3);
  for (const bool reversed : {false, true}) {
    std::vector<GridLoop> loops{outer, hole};
    if (reversed)
      for (GridLoop& loop : loops) std::reverse(loop.begin(), loop.end());
    const GridOutline outline = make_outline(loops);
    EXPECT_EQ(outline.box.low_x, -10);
    EXPECT_EQ(outline.box.low_y, -20);
    EXPECT_EQ(outline.box.high_x, 5);
    EXPECT_EQ(outline.box.high_y, 40);
    ASSERT_EQ(outline.edges.size(), 8U);
    for (std::size_t begin : {0, 4}) {
      std::int64_t twice_area = 0;
      for (std::size_t k = begin; k < begin + 4; ++k) {
        const auto& [from, to] = outline.edges[k];
        twice_area += from.x * to.y - from.y * to.x;
      }
      EXPECT_EQ(twice_area > 0, begin == 0) << "material on the left";
    }
  }
}

std::string said(const std::vector<GridLoop>& loops) { return fault_of(loops).value_or(""); }

constexpr std::int64_t kMm = 1 << 20;

TEST(VerifyGridOutline, ThreeStepsAreEnoughAndLessAreNot) {
  EXPECT_EQ(said({{{0, 0}, {100, 0}, {50, 3}}}), "");
  EXPECT_NE(said({{{0, 0}, {100, 0}, {50, 2}}}).find("less than 3 steps"), std::string::npos);
  EXPECT_EQ(said({rectangle(0, 0, 3, 3)}), "");
  EXPECT_NE(said({rectangle(0, 0, 3, 2)}).find("less than 3 steps"), std::string::npos);
  // From a line of the direction (4, 3) the points are 15 / 5 and 14 / 5 steps away.
  EXPECT_EQ(said({{{0, 0}, {400, 300}, {199, 153}}}), "");
  EXPECT_NE(said({{{0, 0}, {400, 300}, {198, 152}}}).find("less than 3 steps"), std::string::npos);
  EXPECT_EQ(said({rectangle(0, 0, 100, 100), rectangle(3, 3, 20, 20)}), "");
  EXPECT_NE(said({rectangle(0, 0, 100, 100), rectangle(3, 2, 20, 20)}).find("less than 3 steps"),
            std::string::npos);
}

TEST(VerifyGridOutline, APointOnAnEdgeIsTooNearAndDoesNotCross) {
  // In both orders of the two loops, and with either end of the edge that touches.
  const GridLoop square = rectangle(0, 0, 10 * kMm, 10 * kMm);
  for (const GridPoint inner : {GridPoint{4 * kMm, 5 * kMm}, GridPoint{6 * kMm, 5 * kMm}})
    for (const bool first : {false, true}) {
      const GridLoop spike{{5 * kMm, 0}, inner, {5 * kMm, 8 * kMm}};
      GridLoop other = spike;
      std::rotate(other.begin(), other.begin() + (first ? 0 : 1), other.end());
      EXPECT_EQ(said({square, other}),
                "the point (5, 0) mm is less than 3 steps of 2^-20 mm from the edge (0, 0) mm to (10, 0) mm");
      EXPECT_EQ(said({other, square}),
                "the point (5, 0) mm is less than 3 steps of 2^-20 mm from the edge (0, 0) mm to (10, 0) mm");
    }
  // The edge that is touched begins farther to the right than the one that touches it.
  EXPECT_EQ(said({square, {{10 * kMm, 5 * kMm}, {4 * kMm, 4 * kMm}, {4 * kMm, 6 * kMm}}}),
            "the point (10, 5) mm is less than 3 steps of 2^-20 mm from the edge (10, 0) mm to (10, 10) mm");
  EXPECT_EQ(said({{{0, 0}, {10 * kMm, 10 * kMm}, {10 * kMm, 0}, {0, 10 * kMm}}}),
            "the edges from (10, 0) mm and (0, 0) mm cross");
}

TEST(VerifyGridOutline, TheFirstFaultFromLeftToRightIsNamed) {
  // Two bows, of which the left one is written last.
  const GridLoop right{{20 * kMm, 0}, {30 * kMm, 10 * kMm}, {30 * kMm, 0}, {20 * kMm, 10 * kMm}};
  const GridLoop left{{0, 0}, {10 * kMm, 10 * kMm}, {10 * kMm, 0}, {0, 10 * kMm}};
  EXPECT_EQ(said({right, left}), "the edges from (10, 0) mm and (0, 0) mm cross");
  EXPECT_EQ(said({left, right}), "the edges from (10, 0) mm and (0, 0) mm cross");
  // Of edges that begin at one x, the one that is written first: the upper bow here.
  const GridLoop above{{0, 20 * kMm}, {10 * kMm, 30 * kMm}, {10 * kMm, 20 * kMm}, {0, 30 * kMm}};
  EXPECT_EQ(said({above, left}), "the edges from (10, 20) mm and (0, 20) mm cross");
  // Of points that are there twice the leftmost, and of these the lowest.
  const GridLoop twice{{0, 0}, {8, 0}, {8, 9}, {0, 0}, {4, 4}, {8, 0}};
  EXPECT_EQ(said({twice}), "the point (0, 0) mm is there twice");
  EXPECT_EQ(said({{{8, kMm}, {8, 0}, {8, kMm}, {8, 0}}}), "the point (7.62939e-06, 0) mm is there twice");
}

TEST(VerifyGridOutline, HolesLieInTheOuterLoopAndInNoOther) {
  const GridLoop outer = rectangle(0, 0, 100, 100);
  struct Case {
    std::vector<GridLoop> loops;
    std::string_view sentence;
  };
  for (const auto& [loops, sentence] : std::initializer_list<Case>{
           {{outer, rectangle(10, 10, 80, 80)}, ""},
           {{outer, rectangle(10, 10, 30, 80), rectangle(50, 10, 30, 80)}, ""},
           {{outer, rectangle(110, 10, 30, 30)}, "hole 0 is not inside the outer loop"},
           {{outer, rectangle(-40, 10, 30, 30)}, "hole 0 is not inside the outer loop"},
           {{outer, rectangle(-40, 0, 30, 30)}, "hole 0 is not inside the outer loop"},
           {{outer, rectangle(-40, 100, 30, 30)}, "hole 0 is not inside the outer loop"},
           {{outer, rectangle(-40, -30, 30, 30)}, "hole 0 is not inside the outer loop"},
           {{outer, rectangle(10, 10, 80, 80), rectangle(20, 20, 10, 10)}, "hole 1 is inside hole 0"},
           {{outer, rectangle(20, 20, 10, 10), rectangle(10, 10, 80, 80)}, "hole 0 is inside hole 1"},
           {{outer, rectangle(220, 20, 10, 10), rectangle(210, 10, 80, 80)},
            "hole 0 is not inside the outer loop"},
           {{outer, rectangle(-10, -10, 120, 120)}, "hole 0 is not inside the outer loop"}})
    for (int quarters = 0; quarters < 4; ++quarters) {
      std::vector<GridLoop> all = loops;
      for (GridLoop& loop : all)
        for (GridPoint& p : loop) p = turned(p, quarters);
      EXPECT_EQ(said(all), sentence) << quarters;
    }
  // Vertices of the outer loop are level with the first point of a hole: a diamond, a step, a tip from either
  // side.
  const GridLoop hole{{40, 50}, {45, 45}, {50, 50}, {45, 55}};
  for (const GridLoop& around :
       {GridLoop{{100, 50}, {50, 100}, {0, 50}, {50, 0}},
        GridLoop{{0, 0}, {100, 0}, {100, 50}, {80, 50}, {80, 100}, {0, 100}},
        GridLoop{{0, 0}, {80, 0}, {80, 50}, {100, 50}, {100, 100}, {0, 100}},
        GridLoop{{0, 0}, {100, 0}, {100, 49}, {80, 49}, {80, 100}, {0, 100}},
        GridLoop{{0, 0}, {80, 0}, {80, 51}, {100, 51}, {100, 100}, {0, 100}},
        GridLoop{{0, 0}, {100, 0}, {70, 50}, {100, 100}, {0, 100}},
        GridLoop{{0, 0}, {90, 0}, {100, 50}, {90, 20}, {80, 20}, {80, 100}, {0, 100}},
        GridLoop{{0, 0}, {80, 0}, {80, 80}, {90, 80}, {100, 50}, {90, 100}, {0, 100}}})
    for (int quarters = 0; quarters < 4; ++quarters)
      for (const std::int64_t aside : {0, -1000, 1000}) {
        std::vector<GridLoop> all{around, hole};
        for (GridPoint& p : all[1]) p.x += aside;
        for (GridLoop& loop : all)
          for (GridPoint& p : loop) p = turned(p, quarters);
        EXPECT_EQ(said(all), aside == 0 ? "" : "hole 0 is not inside the outer loop")
            << aside << " " << quarters;
      }
}

TEST(VerifyGridOutline, WhatTouchesHasNoDiscInCommon) {
  const GridOutline square = box(0, 0, 10, 10);
  const GridOutline ring = make_outline({rectangle(0, 0, 30, 30), rectangle(10, 10, 10, 10)});
  const GridOutline diamond = make_outline({{{10, 5}, {15, 0}, {20, 5}, {15, 10}}});
  const GridOutline roof = make_outline({{{5, 10}, {15, 30}, {-5, 30}}});
  struct Case {
    Outlines in, out;
    bool common;
  };
  for (const auto& [in, out, expected] :
       std::initializer_list<Case>{{{square}, {}, true},
                                   {{square, box(10, 0, 10, 10)}, {}, false},
                                   {{square, box(9, 0, 10, 10)}, {}, true},
                                   {{square, box(10, 10, 10, 10)}, {}, false},
                                   {{square, box(9, 9, 10, 10)}, {}, true},
                                   {{square, diamond}, {}, false},
                                   {{box(0, 0, 11, 10), diamond}, {}, true},
                                   {{square, roof}, {}, false},
                                   {{ring, box(10, 10, 10, 10)}, {}, false},
                                   {{ring, box(10, 9, 10, 10)}, {}, true},
                                   {{ring, box(12, 12, 5, 5)}, {}, false},
                                   {{ring, ring}, {}, true},
                                   {{box(0, 10, 30, 10), box(10, 0, 10, 30)}, {}, true},
                                   {{square}, {square}, false},
                                   {{square}, {ring}, false},
                                   {{box(0, 0, 30, 30)}, {ring}, true},
                                   {{box(0, 0, 30, 30)}, {ring, box(10, 10, 10, 10)}, false},
                                   {{box(0, 0, 30, 30)}, {ring, box(10, 10, 10, 9)}, true},
                                   {{square}, {box(0, 0, 5, 10), box(5, 0, 5, 10)}, false},
                                   {{square}, {box(0, 0, 5, 10), box(6, 0, 4, 10)}, true},
                                   {{square, box(5, 0, 10, 10), box(0, 5, 20, 5)}, {}, true},
                                   {{square, box(5, 0, 10, 10), box(0, 5, 20, 5)}, {box(5, 5, 5, 5)}, false},
                                   {{square, box(5, 0, 10, 10)}, {box(5, 0, 5, 9)}, true},
                                   {{square, box(5, 0, 10, 10), box(0, 20, 20, 5)}, {}, false}})
    for (int quarters = 0; quarters < 4; ++quarters)
      EXPECT_EQ(common(in, out, quarters), expected) << in.size() << " " << out.size() << " " << quarters;
}

TEST(VerifyGridOutline, DirectionsThatAreNearlyOneAreTwo) {
  // The sides of the first triangle have the directions (100, 33) and (103, 34), whose cross product is 1;
  // the other touches it at the tip alone.
  GridLoop thin{{0, 0}, {100, 33}, {103, 34}};
  const GridLoop beside{{0, 0}, {60, 100}, {-10, 10}};
  for (int first = 0; first < 3; ++first, std::rotate(thin.begin(), thin.begin() + 1, thin.end()))
    for (int quarters = 0; quarters < 4; ++quarters) {
      EXPECT_FALSE(common({make_outline({thin}), make_outline({beside})}, {}, quarters));
      EXPECT_FALSE(common({make_outline({beside}), make_outline({thin})}, {}, quarters));
      EXPECT_TRUE(common({make_outline({thin}), box(-10, -10, 200, 200)}, {}, quarters));
    }
}

TEST(VerifyGridOutline, AnEdgeThatEndsAStepBeforeAPointDoesNotMeetIt) {
  const GridOutline corner = make_outline({{{0, 0}, {30, 0}, {30, 30}, {10, 30}, {10, 10}, {0, 10}}});
  for (const GridLoop& inside :
       {GridLoop{{11, 10}, {5, 2}, {25, 2}, {25, 12}}, GridLoop{{10, 9}, {8, 2}, {25, 2}, {25, 15}}})
    for (int quarters = 0; quarters < 4; ++quarters)
      EXPECT_FALSE(common({make_outline({inside})}, {corner}, quarters)) << quarters;
}

TEST(VerifyGridOutline, LargeOutlinesAreExact) {
  // The crossing of the diagonals is no vertex, and lies on the third outline's edge, or a step from it.
  constexpr std::int64_t kFar = std::int64_t{1} << 39;
  const GridOutline rising = make_outline({{{-kFar, -kFar}, {kFar, kFar - 1}, {-kFar, kFar}}});
  const GridOutline falling = make_outline({{{-kFar + 1, kFar}, {-kFar, -kFar}, {kFar, -kFar - 1}}});
  for (int quarters = 0; quarters < 4; ++quarters) {
    EXPECT_TRUE(common({rising, falling}, {}, quarters));
    EXPECT_TRUE(
        common({rising, falling, make_outline({{{-kFar, kFar - 5}, {-kFar + 7, -kFar + 3}, {3, 11}}})}, {},
               quarters));
    EXPECT_FALSE(
        common({rising, falling, make_outline({{{kFar, kFar}, {9, 5}, {kFar, -kFar}}})}, {}, quarters));
    EXPECT_FALSE(common({rising, falling}, {box(-kFar, -kFar, 2 * kFar, 2 * kFar)}, quarters));
  }
}

TEST(VerifyGridOutline, GapsAreExactFromPointsAndFromEdges) {
  const GridOutline square = box(0, 0, 10, 10);
  const GridOutline slope = make_outline({{{-400, 0}, {400, 600}, {-400, 600}}});  // of the direction (4, 3)
  const GridOutline tip = make_outline({{{300 + 15, 525 - 20}, {900, 0}, {901, 500}}});
  struct Case {
    GridOutline a, b;
    std::int64_t apart;
  };
  for (const auto& [a, b, apart] : std::initializer_list<Case>{
           {square, box(13, 0, 10, 10), 3},
           {square, box(13, 14, 10, 10), 5},
           {square, box(-22, -19, 10, 10), 15},
           {slope, tip, 25},
           {square, make_outline({{{15, 5}, {30, 0}, {30, 10}}}), 5},
           {square, make_outline({{{5, 15}, {0, 30}, {-10, 30}}}), 5},
           {box(0, 0, 300000, 300000), make_outline({{{300007, 150000}, {400000, 0}, {400000, 300000}}}), 7}})
    for (int quarters = 0; quarters < 4; ++quarters) {
      const GridOutline p = turned(a, quarters), q = turned(b, quarters);
      for (const auto& [one, other] : {std::pair{&p, &q}, std::pair{&q, &p}}) {
        EXPECT_FALSE(edges_nearer_than(*one, *other, apart)) << apart << " " << quarters;
        EXPECT_TRUE(edges_nearer_than(*one, *other, apart + 1)) << apart << " " << quarters;
      }
    }
  EXPECT_TRUE(edges_nearer_than(square, box(10, 0, 5, 5), 1));
  EXPECT_FALSE(edges_nearer_than(square, box(10, 0, 5, 5), 0));
  EXPECT_FALSE(edges_nearer_than(box(0, 10, 30, 10), box(10, 0, 10, 30), 0)) << "no point is nearer than 0";
  EXPECT_TRUE(edges_nearer_than(box(0, 1000, 3000, 1000), box(1000, 0, 1000, 3000), 1)) << "edges that cross";
}

/// Teeth that go up, 10 steps wide and apart, from a back of the height 10.
GridOutline comb(std::int64_t x, std::int64_t y, int teeth) {
  GridLoop loop{{x, y}, {x + 20 * std::int64_t{teeth}, y}};
  for (int k = teeth; k-- > 0;) {
    const std::int64_t at = x + 20 * std::int64_t{k};
    for (const GridPoint p : {GridPoint{at + 20, y + 10}, GridPoint{at + 20, y + 20000},
                              GridPoint{at + 10, y + 20000}, GridPoint{at + 10, y + 10}})
      loop.push_back(p);
  }
  return make_outline({loop});
}

TEST(VerifyGridOutline, CombsTakeFewStepsHoweverTheyLie) {
  // A ray along the teeth meets one or two of them, and one across meets up to 500.
  RunControl run;
  run.work_limit = 100'000;
  const GridOutline left = comb(0, 0, 500), right = comb(10000, 0, 500), around = box(0, 0, 20000, 50000);
  for (int quarters = 0; quarters < 4; ++quarters) {
    const auto inside = stoppable(run, [&] { return !common({left}, {around}, quarters); });
    ASSERT_TRUE(inside) << quarters;
    EXPECT_TRUE(*inside);
  }
  // Of combs that touch only what lies where both are is looked at.
  run.work_limit = 4000;
  for (int quarters = 0; quarters < 4; ++quarters)
    for (const Outlines& both : {Outlines{left, right}, Outlines{right, left}}) {
      const auto overlap = stoppable(run, [&] { return common(both, {}, quarters); });
      ASSERT_TRUE(overlap) << quarters;
      EXPECT_FALSE(*overlap);
    }
}

}  // namespace
}  // namespace lekalo::verify::verify_grid_outline_test

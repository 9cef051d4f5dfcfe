#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "verify/drawn/drawn_file.hpp"
#include "verify/profile/loose_check.hpp"

/// Whether cuts surround a place, asked of cuts that are written down as lines and arcs.
namespace lekalo::verify::verify_loose_check_test {
namespace {

constexpr double kKerf = 1;

Strokes way(const std::vector<Place>& places) {
  Strokes strokes;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    strokes.push_back(line_between(places[i], places[i + 1]));
  return strokes;
}
Place on_circle(double radius, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Each cut follows a contour of its own, unless a number is said.
LooseCheck of_cuts(const std::vector<Strokes>& cuts, const std::vector<std::size_t>& of = {}) {
  LooseCheck check(kKerf);
  for (std::size_t i = 0; i < cuts.size(); ++i) check.add(cuts[i], of.empty() ? i : of[i]);
  return check;
}
/// Asked of a contour that none of the cuts follows.
bool surround(const std::vector<Strokes>& cuts, Place p) {
  return of_cuts(cuts).is_loose(p, cuts.size(), cuts.size());
}

/// Four sides of a square of 100 mm about the origin, whose corners are open by `gap`.
std::vector<Strokes> sides(double gap) {
  const double far = 50, end = 50 - gap;
  return {way({{-end, -far}, {far, -far}}), way({{far, -end}, {far, far}}), way({{end, far}, {-far, far}}),
          way({{-far, end}, {-far, -far}})};
}

TEST(VerifyLooseCheck, SidesThatMeetSurroundWhatIsBetween) {
  EXPECT_TRUE(surround(sides(0.9), {0, 0}));
  EXPECT_TRUE(surround(sides(0.9), {49, -49}));
  EXPECT_FALSE(surround(sides(1.1), {0, 0})) << "it hangs on by a tenth of a millimetre in each corner";
  for (const Place outside : {Place{-60, 0}, {60, 0}, {0, 60}, {0, -60}, {-60, -49}, {60, 49}})
    EXPECT_FALSE(surround(sides(0.9), outside));
  for (std::size_t open = 0; open < 4; ++open) {
    std::vector<Strokes> cuts = sides(0.9);
    cuts.erase(cuts.begin() + static_cast<std::ptrdiff_t>(open));
    EXPECT_FALSE(surround(cuts, {0, 0}));
  }
  // Kerfs that touch leave nothing between them that is told.
  EXPECT_FALSE(surround(sides(1), {0, 0}));
}

TEST(VerifyLooseCheck, SidesInAnyOrderAndDirectionSurround) {
  std::vector<Strokes> cuts = sides(0.9);
  for (int order = 0; order < 24; ++order) {
    for (unsigned turned = 0; turned < 16; ++turned) {
      std::vector<Strokes> some = cuts;
      for (std::size_t i = 0; i < 4; ++i)
        if ((turned >> i & 1U) != 0) std::swap(some[i][0].from, some[i][0].to);
      EXPECT_TRUE(surround(some, {3, -7})) << order << " " << turned;
      EXPECT_FALSE(surround(some, {-70, -7})) << order << " " << turned;
    }
    std::next_permutation(cuts.begin(), cuts.end(), [](const Strokes& a, const Strokes& b) {
      return std::pair(a[0].from.x, a[0].from.y) < std::pair(b[0].from.x, b[0].from.y);
    });
  }
}

TEST(VerifyLooseCheck, CutsMeetAnywhereAlongThem) {
  // Sides that run past each other, ones that end on the middle of another, and one whose middle is nearest.
  EXPECT_TRUE(surround({way({{-50, 0}, {50, 0}}), way({{-7, -9}, {-7, 60}}), way({{-60, 43}, {60, 43}}),
                        way({{13, 60}, {13, -5}})},
                       {0, 20}));
  EXPECT_TRUE(surround({way({{-50, 0}, {50, 0}}), way({{-7, 0.8}, {-7, 43}}), way({{-60, 43.8}, {60, 43.8}}),
                        way({{13, 43}, {13, 0.8}})},
                       {0, 20}));
  EXPECT_FALSE(surround({way({{-50, 0}, {50, 0}}), way({{-7, 0.8}, {-7, 43}}), way({{-60, 43.8}, {60, 43.8}}),
                         way({{13, 43}, {13, 1.2}})},
                        {0, 20}));
  EXPECT_FALSE(surround({way({{-50, 0}, {50, 0}}), way({{-7, 0.8}, {-7, 43}}), way({{-60, 43.8}, {60, 43.8}}),
                         way({{13, 42.6}, {13, 0.8}})},
                        {0, 20}));
  // Beside the arc, far from its ends, lines end.
  Strokes arc{arc_about(on_circle(30, -90), on_circle(30, 90), {0, 0}, true)};
  const auto closed = [&](double apart) {
    return std::vector<Strokes>{arc, way({{-20, -17}, on_circle(30 - apart, -37)}),
                                way({on_circle(30 - apart, 41), {-20, 17}}),
                                way({{-20, 17.5}, {-20, -17.5}})};
  };
  EXPECT_TRUE(surround(closed(0.85), {15, 0}));
  EXPECT_FALSE(surround(closed(1.15), {15, 0}));
  // An arc is no chord: what lies beside it lies on one side, all along.
  for (int degrees = -34; degrees <= 38; ++degrees) {
    EXPECT_TRUE(surround(closed(0.85), on_circle(29.48, degrees))) << degrees;
    EXPECT_FALSE(surround(closed(0.85), on_circle(30.52, degrees))) << degrees;
  }
}

TEST(VerifyLooseCheck, ItSaysWhenKerfsCloseRoundAPlaceOrBetweenTwo) {
  // Three sides, and a fourth that meets the end of the first as it begins, and that of the third a kerf
  // before its own end.
  LooseCheck check =
      of_cuts({way({{0, 10}, {0, 0}, {10, 0}, {10, 10}}), way({{0, 10}, {10, 10}}), way({{5, 10}, {5, 0}})});
  const auto closed = check.parted_at({2, 5});
  ASSERT_TRUE(closed);
  EXPECT_EQ(check.cut_of(closed->piece), 1U);
  EXPECT_NEAR(closed->share, 0.9, 1e-6);
  EXPECT_FALSE(check.parted_at({2, 15}));
  EXPECT_FALSE(check.parted_at({2, 5}, Place{3, 6}));
  EXPECT_TRUE(check.parted_at({2, 5}, Place{15, 5}));
  const auto halved = check.parted_at({2, 5}, Place{8, 5});
  ASSERT_TRUE(halved);
  EXPECT_EQ(check.cut_of(halved->piece), 2U);
  EXPECT_NEAR(halved->share, 0.9, 1e-6);
}

TEST(VerifyLooseCheck, OneCutThatComesBackToItselfSurrounds) {
  EXPECT_TRUE(surround({way({{0, 0}, {30, 0}, {30, 30}, {0, 30}, {0, 0.5}})}, {10, 10}));
  EXPECT_FALSE(surround({way({{0, 0}, {30, 0}, {30, 30}, {0, 30}, {0, 1.5}})}, {10, 10}));
  EXPECT_FALSE(surround({way({{0, 0}, {30, 0}, {30, 30}, {0, 30}, {0, 0.5}})}, {40, 10}));
  // A hole in a kerf's own way: two rounds about it in opposite directions are closed, too.
  EXPECT_TRUE(surround(
      {way({{0, 0}, {30, 0}, {30, 30}, {0, 30}, {0, 0}, {0, 30}, {30, 30}, {30, 0}, {0, 0}})}, {10, 10}));
}

TEST(VerifyLooseCheck, CutsBeforeCountAndNoneOfTheContourItself) {
  LooseCheck check = of_cuts(sides(0.9), {7, 8, 9, 8});
  EXPECT_EQ(check.steps(), 0U);
  EXPECT_TRUE(check.is_loose({0, 0}, 4, 6));
  const std::size_t once = check.steps();
  EXPECT_GE(once, 24U) << "six pieces of each side";
  EXPECT_FALSE(check.is_loose({0, 0}, 3, 6)) << "the last one comes after it";
  EXPECT_FALSE(check.is_loose({0, 0}, 0, 6));
  EXPECT_FALSE(check.is_loose({0, 0}, 4, 8));
  EXPECT_FALSE(check.is_loose({0, 0}, 4, 9));
  EXPECT_FALSE(check.is_loose({0, 0}, 4, 7));
  EXPECT_EQ(check.steps(), 6 * once);
  // What comes later is seen once it is there.
  LooseCheck growing(kKerf);
  const std::vector<Strokes> cuts = sides(0.9);
  for (std::size_t i = 0; i < 3; ++i) growing.add(cuts[i], i);
  EXPECT_TRUE(growing.kerfs_meet());
  EXPECT_FALSE(growing.is_loose({0, 0}, 3, 9));
  growing.add(cuts[3], 3);
  EXPECT_TRUE(growing.is_loose({0, 0}, 4, 9));
}

TEST(VerifyLooseCheck, KerfsMeetWhereMoreThanNeighboursAlongACutAreNear) {
  const Strokes bar = way({{0, 0}, {30, 0}});
  EXPECT_FALSE(of_cuts({bar}).kerfs_meet());
  EXPECT_FALSE(of_cuts({bar, way({{0, 1.1}, {30, 1.1}})}).kerfs_meet());
  EXPECT_TRUE(of_cuts({bar, way({{0, 0.9}, {30, 0.9}})}).kerfs_meet());
  EXPECT_FALSE(of_cuts({bar, way({{30, 0}, {60, 0}})}, {4, 4}).kerfs_meet())
      << "two stretches of one contour";
  EXPECT_FALSE(of_cuts({way({{0, 0}, {10, 0}, {10, 0.3}, {10, 0.6}, {10, 10}})}).kerfs_meet());
  EXPECT_TRUE(of_cuts({way({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0.5}, {1, 0.5}})}).kerfs_meet());
}

}  // namespace
}  // namespace lekalo::verify::verify_loose_check_test

#include "lekalo/phi/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "phi/pair_memory.hpp"

namespace lekalo::phi_scene_test {
namespace {

using geom::GridPoint;
using phi::BodyIndex;

constexpr std::int64_t kMm = geom::kGridPerMm;

geom::GridRegion box(std::int64_t x0, std::int64_t y0, std::int64_t x1, std::int64_t y1) {
  return geom::make_grid_region({{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}).value();
}
geom::GridRegion triangle(std::int64_t side) {
  return geom::make_grid_region({{{0, 0}, {side, 0}, {0, side}}}).value();
}

/// Asked so often that the engine has learned what it can.
bool forbidden(const phi::Scene& scene, const phi::Probe& probe) {
  const bool first = scene.forbidden(probe);
  for (int i = 0; i < 40; ++i) EXPECT_EQ(scene.forbidden(probe), first);
  EXPECT_EQ(!scene.forbidding(probe).empty(), first);
  return first;
}

TEST(Scene, TouchingIsAllowedAndOneStepIsNot) {
  phi::Scene scene({{0, 0}, {100 * kMm, 100 * kMm}}, 16);
  const auto fixed = scene.add_shape(triangle(10 * kMm));
  const auto moving =
      scene.add_shape(geom::turned(triangle(10 * kMm), {-geom::GridRotation::kOne, 0}, false));
  scene.put({.shape = fixed, .at = {20 * kMm, 20 * kMm}});
  // Their slanting edges lie on one line.
  const GridPoint touching{30 * kMm, 30 * kMm};
  EXPECT_FALSE(forbidden(scene, {.shape = moving, .at = touching}));
  EXPECT_TRUE(forbidden(scene, {.shape = moving, .at = touching - GridPoint{1, 0}}));
  EXPECT_FALSE(forbidden(scene, {.shape = moving, .at = touching + GridPoint{1, 0}}));
  EXPECT_FALSE(forbidden(scene, {.shape = moving, .at = touching - GridPoint{1, -1}}));
}

TEST(Scene, TheLargerGapCountsToTheStep) {
  phi::Scene scene({{0, 0}, {100 * kMm, 100 * kMm}}, 16);
  const auto shape = scene.add_shape(box(0, 0, 10 * kMm, 10 * kMm));
  scene.put({.shape = shape, .at = {20 * kMm, 20 * kMm}, .gap = 3 * kMm});
  const auto beside = [&](std::int64_t distance) { return GridPoint{30 * kMm + distance, 21 * kMm}; };
  EXPECT_FALSE(forbidden(scene, {.shape = shape, .at = beside(3 * kMm)}));
  EXPECT_TRUE(forbidden(scene, {.shape = shape, .at = beside(3 * kMm - 1)}));
  EXPECT_FALSE(forbidden(scene, {.shape = shape, .at = beside(4 * kMm), .gap = 4 * kMm}));
  EXPECT_TRUE(forbidden(scene, {.shape = shape, .at = beside(4 * kMm - 1), .gap = 4 * kMm}));
  // Corner to corner: 3, 4, 5.
  const GridPoint corner{30 * kMm + 3 * kMm, 30 * kMm + 4 * kMm};
  EXPECT_FALSE(forbidden(scene, {.shape = shape, .at = corner, .gap = 5 * kMm}));
  EXPECT_TRUE(forbidden(scene, {.shape = shape, .at = corner, .gap = 5 * kMm + 1}));
}

TEST(Scene, ContainersHoldWithTheirGap) {
  phi::Scene scene({{0, 0}, {100 * kMm, 100 * kMm}}, 16);
  const auto sheet = scene.add_shape(box(0, 0, 100 * kMm, 50 * kMm));
  const auto part = scene.add_shape(triangle(10 * kMm));
  const BodyIndex border = scene.put({.shape = sheet, .gap = 2 * kMm, .layers = 2, .container = true});
  EXPECT_FALSE(forbidden(scene, {.shape = part, .at = {2 * kMm, 2 * kMm}, .layers = 2}));
  EXPECT_TRUE(forbidden(scene, {.shape = part, .at = {2 * kMm - 1, 2 * kMm}, .layers = 2}));
  EXPECT_TRUE(forbidden(scene, {.shape = part, .at = {2 * kMm, 38 * kMm + 1}, .layers = 2}));
  EXPECT_FALSE(forbidden(scene, {.shape = part, .at = {500 * kMm, 0}, .layers = 1}));
  EXPECT_FALSE(forbidden(scene, {.shape = part, .at = {500 * kMm, 0}, .layers = 2, .except = border}));
  EXPECT_FALSE(forbidden(scene, {.shape = part, .at = {500 * kMm, 0}, .layers = 2, .tolerates = 1}));
  scene.take(border);
  EXPECT_FALSE(forbidden(scene, {.shape = part, .at = {500 * kMm, 0}, .layers = 2}));
}

TEST(Scene, PuttingBackUndoesTaking) {
  phi::Scene scene({{0, 0}, {100 * kMm, 100 * kMm}}, 16);
  const auto shape = scene.add_shape(triangle(10 * kMm));
  std::vector<BodyIndex> bodies;
  for (std::int64_t i = 0; i < 8; ++i) bodies.push_back(scene.put({.shape = shape, .at = {11 * kMm * i, 0}}));
  const std::vector<phi::Body> taken = {scene.body(bodies[2]), scene.body(bodies[5])};
  scene.take(bodies[2]);
  scene.take(bodies[5]);
  EXPECT_FALSE(forbidden(scene, {.shape = shape, .at = taken[0].at}));
  EXPECT_EQ(scene.put(taken[1]), bodies[5]);
  EXPECT_EQ(scene.put(taken[0]), bodies[2]);
  EXPECT_TRUE(forbidden(scene, {.shape = shape, .at = taken[0].at}));
  EXPECT_EQ(scene.at({23 * kMm, kMm}, 1), (std::vector<BodyIndex>{bodies[2]}));
  EXPECT_EQ(scene.near(scene.box(shape), 2 * kMm, 1), (std::vector<BodyIndex>{bodies[0], bodies[1]}));
}

// However many bodies lie on one place, and wherever they lie.
TEST(Scene, CrowdedCellsAndBodiesBeyondTheWorldAnswer) {
  phi::Scene scene({{0, 0}, {100 * kMm, 100 * kMm}}, 400);
  const auto shape = scene.add_shape(triangle(10 * kMm));
  std::vector<BodyIndex> crowd;
  for (int i = 0; i < 100; ++i) crowd.push_back(scene.put({.shape = shape, .at = {50 * kMm, 50 * kMm}}));
  const BodyIndex far = scene.put({.shape = shape, .at = {-400'000 * kMm, 300'000 * kMm}});
  EXPECT_EQ(scene.forbidding({.shape = shape, .at = {51 * kMm, 51 * kMm}}), crowd);
  EXPECT_EQ(scene.forbidding({.shape = shape, .at = {-400'001 * kMm, 300'001 * kMm}}),
            std::vector<BodyIndex>{far});
  Random random(1);
  while (crowd.size() > 1) {
    const std::size_t at = random.below(crowd.size());
    scene.take(crowd[at]);
    crowd.erase(crowd.begin() + static_cast<std::ptrdiff_t>(at));
    EXPECT_EQ(scene.forbidding({.shape = shape, .at = {51 * kMm, 51 * kMm}}), crowd);
  }
}

TEST(Scene, CopiesAndAssignmentsAnswerAlike) {
  phi::Scene scene({{0, 0}, {100 * kMm, 100 * kMm}}, 16);
  const auto shape = scene.add_shape(triangle(10 * kMm));
  const BodyIndex body = scene.put({.shape = shape, .at = {20 * kMm, 20 * kMm}});
  EXPECT_TRUE(forbidden(scene, {.shape = shape, .at = {21 * kMm, 21 * kMm}}));
  phi::Scene copy = scene;
  copy.take(body);
  const auto other = copy.add_shape(box(0, 0, kMm, kMm));
  copy.put({.shape = other, .at = {70 * kMm, 70 * kMm}});
  EXPECT_FALSE(forbidden(copy, {.shape = shape, .at = {21 * kMm, 21 * kMm}}));
  EXPECT_TRUE(forbidden(copy, {.shape = shape, .at = {66 * kMm, 69 * kMm}}));
  EXPECT_TRUE(forbidden(scene, {.shape = shape, .at = {21 * kMm, 21 * kMm}}));
  scene = std::move(copy);
  EXPECT_TRUE(forbidden(scene, {.shape = shape, .at = {66 * kMm, 69 * kMm}}));
  EXPECT_FALSE(forbidden(scene, {.shape = shape, .at = {21 * kMm, 21 * kMm}}));
}

// With room for few maps the engine forgets most, and answers as before.
TEST(PairMemory, KeepsWithinItsRoomAndStaysRight) {
  constexpr std::size_t kRoom = 200'000;
  phi::PairMemory memory(kRoom);
  Random random(2);
  std::vector<phi::FlatOutline> outlines;
  for (std::int64_t i = 0; i < 30; ++i) outlines.push_back(phi::flat_outline(triangle((5 + i) * kMm)));
  std::size_t most = 0, hits = 0;
  for (std::size_t k = 0; k < 100'000; ++k) {
    const std::size_t a = random.below(30), b = random.below(30);
    const phi::OutlinePair pair{outlines[a], outlines[b]};
    const auto along = [&](std::int64_t low, std::int64_t high) {
      return low + 1 + static_cast<std::int64_t>(random.below(static_cast<std::size_t>(high - low - 1)));
    };
    const GridPoint shift{along(-pair.moving.width, pair.fixed.width),
                          along(-pair.moving.height, pair.fixed.height)};
    const phi::PairMemory::Key key = 30 * a + b;
    phi::ContactMap* map = memory.find(key);
    if (map == nullptr) map = &memory.add(key, pair);
    const bool found = map->forbidden(shift, pair);
    ASSERT_EQ(found, phi::interiors_meet(pair.fixed.region, pair.moving.region, shift)) << k;
    hits += found ? 1 : 0;
    if (k % 1000 == 0) most = std::max(most, memory.bytes());
  }
  EXPECT_LT(most, 3 * kRoom);  // a look at every 64th map
  EXPECT_GT(most, kRoom / 4);
  EXPECT_GT(hits, 25'000u);
  EXPECT_LT(hits, 125'000u);
}

}  // namespace
}  // namespace lekalo::phi_scene_test

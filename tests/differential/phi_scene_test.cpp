// The collision engine against asking every body by phi/outline_relation.hpp, which has its own oracle.

#include "lekalo/phi/scene.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "lekalo/phi/outline_relation.hpp"
#include "support/cases.hpp"
#include "support/grid_cases.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::phi_scene_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;
using phi::BodyIndex;

/// Bodies and answers kept as simply as can be.
struct Plain {
  struct Placed {
    BodyIndex index;
    phi::Body body;
  };
  const phi::Scene& scene;
  std::vector<Placed> bodies;

  [[nodiscard]] bool forbids(const Placed& placed, const phi::Probe& probe) const {
    const phi::Body& body = placed.body;
    if (placed.index == probe.except || (body.layers & probe.layers) == 0 || body.rank <= probe.tolerates)
      return false;
    const GridRegion &theirs = scene.outline(body.shape), &ours = scene.outline(probe.shape);
    const GridPoint shift = probe.at - body.at;
    if (body.container ? !phi::lies_within(theirs, ours, shift) : phi::interiors_meet(theirs, ours, shift))
      return true;
    return phi::edges_nearer_than(theirs, ours, std::max(body.gap, probe.gap), shift);
  }
  [[nodiscard]] std::vector<BodyIndex> forbidding(const phi::Probe& probe) const {
    std::vector<BodyIndex> found;
    for (const Placed& placed : bodies)
      if (forbids(placed, probe)) found.push_back(placed.index);
    std::sort(found.begin(), found.end());
    return found;
  }
  [[nodiscard]] phi::NearestBody nearest(const phi::Probe& probe, std::int64_t within) const {
    phi::NearestBody best;
    best.edges.distance_mm = 1e300;
    for (const Placed& placed : bodies) {
      const phi::Body& body = placed.body;
      if (body.container || placed.index == probe.except || (body.layers & probe.layers) == 0 ||
          body.rank <= probe.tolerates)
        continue;
      const GridRegion &theirs = scene.outline(body.shape), &ours = scene.outline(probe.shape);
      const phi::NearestBody one{placed.index, phi::interiors_meet(theirs, ours, probe.at - body.at),
                                 phi::edge_distance(theirs, ours, probe.at - body.at)};
      const bool is_nearer = one.overlaps != best.overlaps
                                 ? one.overlaps
                                 : (one.overlaps || one.edges.distance_mm == best.edges.distance_mm
                                        ? one.body < best.body
                                        : one.edges.distance_mm < best.edges.distance_mm);
      if (is_nearer) best = one;
    }
    if (best.body == phi::kNoBody || (!best.overlaps && best.edges.distance_mm > geom::mm_from_grid(within)))
      return {};
    return best;
  }
  [[nodiscard]] std::vector<BodyIndex> at(GridPoint p, std::uint32_t layers) const {
    std::vector<BodyIndex> found;
    for (const Placed& placed : bodies)
      if (!placed.body.container && (placed.body.layers & layers) != 0 &&
          locate_point(scene.outline(placed.body.shape), p - placed.body.at) != geom::PointLocation::outside)
        found.push_back(placed.index);
    std::sort(found.begin(), found.end());
    return found;
  }
  [[nodiscard]] std::vector<BodyIndex> near(const geom::GridBox& box, std::int64_t reach,
                                            std::uint32_t layers) const {
    std::vector<BodyIndex> found;
    for (const Placed& placed : bodies) {
      if ((placed.body.layers & layers) == 0) continue;
      const geom::GridBox own = bounds(scene.outline(placed.body.shape));
      const GridPoint low = own.low + placed.body.at, high = own.high + placed.body.at;
      if (placed.body.container || (low.x <= box.high.x + reach && high.x >= box.low.x - reach &&
                                    low.y <= box.high.y + reach && high.y >= box.low.y - reach))
        found.push_back(placed.index);
    }
    std::sort(found.begin(), found.end());
    return found;
  }
};

std::string place(std::size_t i) {
  return "seed " + std::to_string(cases::seed()) + " case " + std::to_string(i);
}

/// Any other side of an outline; a container that holds it now and then.
GridRegion partner(Random& random, const GridRegion& a) {
  switch (random.below(4)) {
    case 0:
      return a;
    case 1:
      return cases::loop_region(a, a.loops() - 1);
    default:
      return cases::any_outline(random);
  }
}

// One pair asked so often that its map is made and used all over, mostly about places near contact.
TEST(Scene, PairsNearContactAreAnsweredAsByTheOutlinesAlone) {
  const std::size_t pairs = cases::case_count(1000);
  std::size_t asked = 0, hits = 0, on_contact = 0;
  for (std::size_t i = 0; i < pairs; ++i) {
    Random random(cases::seed(), 40'000 + i);
    const GridRegion a = cases::any_outline(random), b = partner(random, a);
    const geom::GridBox box_a = bounds(a), box_b = bounds(b);
    const std::int64_t reach = (box_a.high.x - box_a.low.x + box_b.high.x - box_b.low.x);
    phi::Scene scene({{-3 * reach, -3 * reach}, {3 * reach, 3 * reach}}, 1 + random.below(2000));
    const phi::ShapeIndex shapes[2] = {scene.add_shape(a), scene.add_shape(b)};
    const std::size_t first = random.below(2);
    phi::Body body{.shape = shapes[first], .container = random.below(3) == 0};
    const double size = static_cast<double>(reach) / 2;
    body.at = {cases::between(random, -reach, reach), cases::between(random, -reach, reach)};
    if (random.below(3) == 0) body.gap = static_cast<std::int64_t>(size * random.uniform(0, 0.2));
    const Plain plain{scene, {{scene.put(body), body}}};
    const GridRegion& fixed = scene.outline(shapes[first]);
    const GridRegion& moving = scene.outline(shapes[1 - first]);
    for (std::size_t k = 0; k < 250; ++k, ++asked) {
      phi::Probe probe{.shape = shapes[1 - first]};
      GridPoint shift = cases::touching_shift(random, fixed, moving);
      switch (random.below(6)) {
        case 0:  // anywhere
          shift = {cases::between(random, -reach, reach), cases::between(random, -reach, reach)};
          break;
        case 1:  // where boundaries touch, to the step
          break;
        case 2:  // at the gap, about
          if (body.gap > 0) {
            const GridPoint direction = cases::grid_direction(random, static_cast<double>(body.gap));
            shift =
                shift + direction + GridPoint{cases::between(random, -1, 1), cases::between(random, -1, 1)};
            break;
          }
          [[fallthrough]];
        default:
          shift = shift + cases::small_offset(random, size, fixed);
      }
      probe.at = body.at + shift;
      const bool expected = plain.forbids(plain.bodies[0], probe);
      ASSERT_EQ(scene.forbidden(probe), expected)
          << place(i) << " question " << k << " shift " << shift.x << " " << shift.y << " gap " << body.gap
          << " container " << body.container;
      hits += expected ? 1 : 0;
      on_contact += body.gap == 0 && !expected && phi::edges_nearer_than(fixed, moving, 1, shift) ? 1 : 0;
    }
  }
  std::printf("%zu questions, %zu forbidden, %zu clear and touching\n", asked, hits, on_contact);
  EXPECT_GT(hits, asked / 10);
  EXPECT_LT(hits, asked * 9 / 10);
  EXPECT_GT(on_contact, asked / 100);
}

// Bodies come and go, with layers, ranks, gaps, containers, few shapes or ever new ones.
TEST(Scene, AnswersStayRightWhileBodiesComeAndGo) {
  const std::size_t scenes = cases::case_count(60);
  std::size_t asked = 0, hits = 0, some_nearest = 0;
  for (std::size_t i = 0; i < scenes; ++i) {
    Random random(cases::seed(), 50'000 + i);
    const bool many_shapes = random.below(2) == 0, gaps = random.below(2) == 0;
    const std::int64_t side = cases::grid_point(400, 0).x;
    // Bodies beyond the world count as well.
    phi::Scene scene({{0, 0}, {side / (1 + static_cast<std::int64_t>(random.below(2))), side}},
                     1 + random.below(500));
    std::vector<GridRegion> parts;
    for (std::size_t k = 0; k < 5; ++k) parts.push_back(cases::random_part(random, k).outline.polygon);
    std::vector<phi::ShapeIndex> shapes;
    const auto shape = [&] {
      if (shapes.size() > 8 && (!many_shapes || random.below(3) > 0))
        return shapes[random.below(shapes.size())];
      shapes.push_back(scene.add_shape(geom::turned(parts[random.below(parts.size())],
                                                    cases::any_rotation(random), random.below(4) == 0)));
      return shapes.back();
    };
    const auto somewhere = [&] {
      return GridPoint{cases::between(random, -side / 8, side), cases::between(random, -side / 8, side)};
    };
    Plain plain{scene, {}};
    const auto put = [&](const phi::Body& body) { plain.bodies.push_back({scene.put(body), body}); };
    put({.shape = scene.add_shape(cases::outline_of({cases::star(random, {200, 200}, 150, 260, 12)}).polygon),
         .gap = gaps ? 1000 : 0,
         .layers = 2,
         .container = true});
    for (std::size_t step = 0; step < 1500; ++step) {
      if (plain.bodies.size() < 30 || random.below(8) == 0) {
        phi::Body body{.shape = shape(), .at = somewhere()};
        if (random.below(3) == 0 && !shapes.empty())
          body.at = cases::grid_point(static_cast<double>(random.below(400)),
                                      static_cast<double>(random.below(400)));
        body.layers = 1 + static_cast<std::uint32_t>(random.below(3));
        body.rank = cases::between(random, -2, 2);
        if (gaps && random.below(4) == 0) body.gap = cases::between(random, 0, side / 50);
        put(body);
      }
      if (plain.bodies.size() > 60 || random.below(8) == 0) {
        const std::size_t at = 1 + random.below(plain.bodies.size() - 1);
        scene.take(plain.bodies[at].index);
        if (random.below(2) == 0) {  // and back: the same index
          ASSERT_EQ(scene.put(plain.bodies[at].body), plain.bodies[at].index);
        } else {
          plain.bodies[at] = plain.bodies.back();
          plain.bodies.pop_back();
        }
      }
      phi::Probe probe{.shape = shape(), .at = somewhere()};
      if (random.below(2) == 0) {
        // A body dragged a little, or put exactly where another one of its kind touches.
        const Plain::Placed& own = plain.bodies[random.below(plain.bodies.size())];
        probe.shape = own.body.shape;
        probe.except = own.index;
        const double most = random.below(2) == 0 ? 3 : 1e-4;
        probe.at = own.body.at + cases::grid_point(random.uniform(-most, most), random.uniform(-most, most));
      } else if (random.below(2) == 0) {
        const Plain::Placed& other = plain.bodies[random.below(plain.bodies.size())];
        probe.at = other.body.at +
                   cases::touching_shift(random, scene.outline(other.body.shape), scene.outline(probe.shape));
      }
      probe.layers = 1 + static_cast<std::uint32_t>(random.below(3));
      probe.tolerates = random.below(2) == 0 ? -3 : cases::between(random, -2, 2);
      if (gaps && random.below(3) == 0) probe.gap = cases::between(random, 0, side / 50);
      const std::vector<BodyIndex> expected = plain.forbidding(probe);
      ASSERT_EQ(scene.forbidding(probe), expected) << place(i) << " step " << step;
      ASSERT_EQ(scene.forbidden(probe), !expected.empty()) << place(i) << " step " << step;
      if (step % 8 == 0) {
        const GridPoint p = somewhere();
        ASSERT_EQ(scene.at(p, probe.layers), plain.at(p, probe.layers)) << place(i) << " step " << step;
        const GridPoint q = somewhere();
        const geom::GridBox box{{std::min(p.x, q.x), std::min(p.y, q.y)},
                                {std::max(p.x, q.x), std::max(p.y, q.y)}};
        ASSERT_EQ(scene.near(box, side / 40, probe.layers), plain.near(box, side / 40, probe.layers))
            << place(i) << " step " << step;
      }
      if (step % 16 == 0) {
        const std::int64_t within = cases::between(random, 0, random.below(2) == 0 ? side / 40 : 2 * side);
        const phi::NearestBody nearest = scene.nearest(probe, within), other = plain.nearest(probe, within);
        ASSERT_EQ(nearest.body, other.body) << place(i) << " step " << step;
        ASSERT_EQ(nearest.overlaps, other.overlaps) << place(i) << " step " << step;
        ASSERT_EQ(nearest.edges.distance_mm, other.edges.distance_mm) << place(i) << " step " << step;
        const double measured =
            nearest.body == phi::kNoBody ? 0 : norm(nearest.edges.on_a - nearest.edges.on_b);
        ASSERT_NEAR(measured, nearest.edges.distance_mm, 1e-9) << place(i) << " step " << step;
        some_nearest += nearest.body != phi::kNoBody && !nearest.overlaps ? 1 : 0;
      }
      ++asked;
      hits += expected.empty() ? 0 : 1;
    }
    // A copy answers alike and goes its own way.
    phi::Scene copy = scene;
    for (const Plain::Placed& placed : plain.bodies)
      if (placed.index != plain.bodies[0].index) copy.take(placed.index);
    for (std::size_t k = 0; k < 20; ++k) {
      const phi::Probe probe{.shape = shape(), .at = somewhere(), .tolerates = -3};
      ASSERT_FALSE(k < 10 && copy.forbidden({.shape = shapes[0], .at = probe.at, .tolerates = -3}));
      ASSERT_EQ(scene.forbidding(probe), plain.forbidding(probe)) << place(i);
    }
  }
  std::printf("%zu questions, %zu forbidden, %zu nearest\n", asked, hits, some_nearest);
  EXPECT_GT(some_nearest, asked / 100);
  EXPECT_GT(hits, asked / 5);
  EXPECT_LT(hits, asked * 9 / 10);
}

// Layouts as they are worked on: nudges from dense places, by 1e-7 to 10^-2.5 of the part or to the step.
TEST(Scene, NudgesInLayoutsAreAnsweredAsByTheOutlinesAlone) {
  const std::size_t layouts = cases::case_count(40);
  std::size_t asked = 0, hits = 0;
  for (std::size_t i = 0; i < layouts; ++i) {
    const layout::Document document = cases::random_layout(cases::seed(), 700 + i, 25);
    if (document.placements.empty()) continue;
    Random random(cases::seed(), 60'000 + i);
    phi::Scene scene({{0, 0}, cases::grid_point(300, 250)}, 4 * document.placements.size());
    Plain plain{scene, {}};
    for (const layout::Placement& placement : document.placements) {
      const layout::Part& part = document.parts[placement.part];
      const phi::Body body{.shape = scene.add_shape(
                               geom::turned(part.outline.polygon, placement.rotation, placement.mirrored)),
                           .at = placement.at,
                           .gap = part.gap.value_or(document.rules.gap)};
      plain.bodies.push_back({scene.put(body), body});
    }
    for (std::size_t k = 0; k < 4000; ++k, ++asked) {
      const Plain::Placed& own = plain.bodies[random.below(plain.bodies.size())];
      phi::Probe probe{.shape = own.body.shape, .at = own.body.at, .gap = own.body.gap, .except = own.index};
      if (random.below(3) > 0) {  // against another one
        const Plain::Placed& other = plain.bodies[random.below(plain.bodies.size())];
        probe.at = other.body.at +
                   cases::touching_shift(random, scene.outline(other.body.shape), scene.outline(probe.shape));
      }
      probe.at = probe.at + cases::small_offset(random, 3e7, scene.outline(probe.shape));
      const std::vector<BodyIndex> expected = plain.forbidding(probe);
      ASSERT_EQ(scene.forbidden(probe), !expected.empty()) << place(i) << " question " << k;
      ASSERT_EQ(scene.forbidding(probe), expected) << place(i) << " question " << k;
      hits += expected.empty() ? 0 : 1;
    }
  }
  std::printf("%zu questions, %zu forbidden\n", asked, hits);
  EXPECT_GT(hits, asked / 10);
  EXPECT_LT(hits, asked * 9 / 10);
}

}  // namespace
}  // namespace lekalo::phi_scene_test

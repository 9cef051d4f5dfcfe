#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "support/cases.hpp"
#include "support/drawn.hpp"

// Never a false yes: a plate with a hole is drawn with small loops, gaps, doubles and spikes. Wherever a
// point is further from the clean outlines than the spoiling went and the stated loss, it is in a region
// exactly when it is in the clean plate, or something is set aside and it is in no region that the plate does
// not have.

namespace lekalo::io::io_drawing_repair_test {
namespace {

using cases::Sketch;
using geom::Point;

struct Spoiled {
  Sketch sketch;
  std::vector<geom::Region> clean;
  double by = 0;  ///< mm: how far the spoiling went at most
};

std::vector<Point> star(Random& random, Point centre, double least, double most) {
  const std::size_t corners = 3 + random.below(8);
  std::vector<Point> ring;
  for (std::size_t i = 0; i < corners; ++i) {
    const auto [sine, cosine] = geom::sincos(
        6.283185307179586 * (static_cast<double>(i) + 0.5 * random.uniform()) / static_cast<double>(corners));
    ring.push_back(centre + random.uniform(least, most) * Point{cosine, sine});
  }
  return ring;
}

geom::Contour contour_of(const std::vector<Point>& ring) {
  geom::Contour contour;
  for (std::size_t i = 0; i < ring.size(); ++i)
    contour.push_back({geom::EdgeKind::line, ring[i], ring[(i + 1) % ring.size()], {}});
  return contour;
}

/// Draws a ring with some faults.
void draw(Random& random, Spoiled& spoiled, const std::vector<Point>& ring) {
  Sketch& sketch = spoiled.sketch;
  const std::size_t n = ring.size();
  const bool one_entity = random.below(2) == 0;
  const auto first = static_cast<std::uint32_t>(sketch.drawing().curves.size());
  std::vector<Point> way;
  for (std::size_t i = 0; i < n; ++i) {
    const Point before = ring[(i + n - 1) % n], at = ring[i], after = ring[(i + 1) % n];
    const Point in = (1 / norm(at - before)) * (at - before), out = (1 / norm(after - at)) * (after - at);
    const double e = random.uniform(0.001, 0.19);
    switch (random.below(6)) {
      case 0:  // both edges run over the corner, and a loop is left behind it
        way.insert(way.end(), {at + (0.6 * e) * in, at - (0.6 * e) * out});
        spoiled.by = std::max(spoiled.by, e);
        break;
      case 1:  // a spike
        way.insert(way.end(), {at, at + e * in, at});
        spoiled.by = std::max(spoiled.by, e);
        break;
      default:
        way.push_back(at);
    }
  }
  for (std::size_t i = 0; i < way.size(); ++i) {
    const Point from = way[i], to = way[(i + 1) % way.size()];
    // A gap that is joined, or one that is bridged.
    const double gap = random.below(12) == 0 ? random.uniform(0, 0.15) : 0;
    const Point along = norm(to - from) > 2 ? (gap / norm(to - from)) * (to - from) : Point{};
    sketch.line(from + along, to);
    if (random.below(12) == 0) sketch.line(from + along, to);  // twice
    spoiled.by = std::max(spoiled.by, norm(along));
  }
  for (const Point at : ring)
    if (random.below(8) == 0) {
      const double e = random.uniform(0.01, 0.15);
      sketch.add(Spline{3, {0, 0, 0, 0, 1, 1, 1, 1}, {at, at + Point{e, 0}, at + Point{0, e}, at}, {}},
                 "loop");
      spoiled.by = std::max(spoiled.by, e);
    }
  if (one_entity)
    for (std::size_t k = first; k < sketch.drawing().curves.size(); ++k)
      sketch.drawing().curves[k].entity = first;
}

TEST(IoDrawingRepair, NoPointIsInARegionThatIsNotInTheCleanPlate) {
  std::size_t whole = 0, cases_run = 0;
  for (std::size_t index = 0; index < cases::case_count(300); ++index) {
    Random random(cases::seed(), index);
    Spoiled spoiled;
    const auto outer = star(random, {0, 0}, 20, 40), hole = star(random, {0, 0}, 3, 8);
    auto region = geom::make_region(contour_of(outer), {contour_of(hole)});
    ASSERT_TRUE(region);
    if (geom::fault_of({*region})) continue;
    spoiled.clean.push_back(*region);
    draw(random, spoiled, outer);
    draw(random, spoiled, hole);
    const auto found = make_regions(spoiled.sketch.drawing());
    ++cases_run;
    if (!found) continue;
    const double far = spoiled.by + found->tolerance + 1e-6;
    EXPECT_LE(found->repaired, 0.2);
    const geom::RegionIndex clean(spoiled.clean), made(found->regions);
    const geom::RegionIndex plate({geom::Region{spoiled.clean[0].outer, {}}});
    // A hole that is left alone would be a part where there is none; only scraps of the spoiling are small.
    for (const geom::Region& one : found->regions) {
      const geom::Box box = geom::bounds(one.outer);
      EXPECT_TRUE(geom::area(one) > 0.9 * geom::area(spoiled.clean[0]) || norm(box.high - box.low) <= 1)
          << geom::area(one) << " case " << index;
    }
    const bool is_whole = found->set_aside.empty() && found->marks.empty();
    whole += found->set_aside.empty() ? 1 : 0;
    for (int k = 0; k < 40; ++k) {
      const Point p{random.uniform(-42, 42), random.uniform(-42, 42)};
      if (clean.nearest(p).distance <= far) continue;
      EXPECT_FALSE(made.contains(p) && !plate.contains(p)) << p.x << ", " << p.y << " case " << index;
      if (is_whole) {
        EXPECT_EQ(made.contains(p), clean.contains(p)) << p.x << ", " << p.y << " case " << index;
      }
    }
  }
  // Most are mended, and not merely refused.
  EXPECT_GE(whole, cases_run / 2);
}

}  // namespace
}  // namespace lekalo::io::io_drawing_repair_test

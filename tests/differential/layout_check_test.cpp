// layout::check on random layouts against the definitions: every pair, triangles, fractions, areas.

#include "lekalo/layout/check.hpp"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "layout/quality.hpp"
#include "support/cases.hpp"
#include "support/grid_cases.hpp"
#include "support/grid_oracle.hpp"

namespace lekalo::layout::layout_check_test {
namespace {

using geom::GridPoint;
using geom::GridRegion;
using Cuts = std::vector<const oracle::Cut*>;

constexpr std::int64_t mm = geom::kGridPerMm;

struct Fraction {
  mpq_class x, y;
};
using Polygon = std::vector<Fraction>;

/// Convex polygon by half plane left of a b.
Polygon clipped(const Polygon& polygon, GridPoint a, GridPoint b) {
  const auto height = [&](const Fraction& p) -> mpq_class {
    return mpq_class(b.x - a.x) * (p.y - mpq_class(a.y)) - mpq_class(b.y - a.y) * (p.x - mpq_class(a.x));
  };
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Fraction &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const mpq_class hp = height(p), hq = height(q);
    if (hp >= 0) kept.push_back(p);
    if ((hp < 0) == (hq < 0)) continue;
    const mpq_class share = hp / (hp - hq);
    kept.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
  }
  return kept;
}

/// Twice the area that all have in common, by triangles of each.
mpq_class common_area(const Cuts& cuts, std::size_t from, const Polygon& polygon) {
  if (polygon.size() < 3) return 0;
  if (from == cuts.size()) {
    mpq_class sum = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Fraction &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      sum += p.x * q.y - p.y * q.x;
    }
    return sum;
  }
  mpq_class sum = 0;
  for (const oracle::Triangle& t : cuts[from]->material())
    sum +=
        common_area(cuts, from + 1, clipped(clipped(clipped(polygon, t[0], t[1]), t[1], t[2]), t[2], t[0]));
  return sum;
}
mpq_class common_area(const Cuts& cuts) {
  constexpr long kFar = 1L << 42;
  return common_area(cuts, 0, {{-kFar, -kFar}, {kFar, -kFar}, {kFar, kFar}, {-kFar, kFar}});
}
/// Area in all of `inside` and none of `without`, by inclusion and exclusion.
mpq_class area_left(const Cuts& inside, const Cuts& without) {
  mpq_class sum = 0;
  for (std::size_t subset = 0; subset < (std::size_t{1} << without.size()); ++subset) {
    Cuts all = inside;
    int sign = 1;
    for (std::size_t i = 0; i < without.size(); ++i)
      if ((subset >> i & 1) != 0) all.push_back(without[i]), sign = -sign;
    sum += sign * common_area(all);
  }
  return sum;
}

/// Outlines with few corners on a coarse lattice, so that edges and corners fall on one another; some turned.
GridRegion coarse_outline(Random& random, std::int64_t scale) {
  for (;;) {
    std::vector<GridPoint> loop;
    switch (random.below(3)) {
      case 0:
        loop = cases::lattice_shape(random, {4, 0});
        break;
      case 1:
        loop = cases::lattice_shape(random, {4, 4});
        break;
      default: {
        loop = cases::star(random, 28, 0.3, 3 + random.below(4));
        for (GridPoint& p : loop) p = {p.x / 4 * 4, p.y / 4 * 4};
      }
    }
    const std::int64_t x = cases::between(random, -4, 4) * 4, y = cases::between(random, -4, 4) * 4;
    for (GridPoint& p : loop) p = {(p.x + x) * scale, (p.y + y) * scale};
    if (auto made = geom::make_grid_region({loop}))
      return random.below(3) == 0 ? geom::turned(*made, cases::any_rotation(random), false) : *made;
  }
}

TEST(CommonCorner, IsThereJustWhenAreaIsLeft) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(300), 100'000);
  std::size_t there = 0;
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed(), 1 + i);
    std::vector<GridRegion> regions;
    const std::size_t inside = 2 + random.below(2), without = random.below(3);
    const std::int64_t scale = random.below(2) == 0 ? 5 : 100'000'003;
    for (std::size_t k = 0; k < inside + without; ++k) regions.push_back(coarse_outline(random, scale));
    if (random.below(3) == 0 && without > 0) regions.back() = regions[0];
    std::vector<oracle::Cut> cuts(regions.begin(), regions.end());
    std::vector<const GridRegion*> in, out;
    Cuts cuts_in, cuts_out;
    for (std::size_t k = 0; k < regions.size(); ++k) {
      (k < inside ? in : out).push_back(&regions[k]);
      (k < inside ? cuts_in : cuts_out).push_back(&cuts[k]);
    }
    const bool left = area_left(cuts_in, cuts_out) > 0;
    ASSERT_EQ(common_corner(in, out).has_value(), left) << cases::seed() << " " << i;
    there += left ? 1 : 0;
  }
  std::printf("%zu sets of outlines, %zu with area left\n", count, there);
  EXPECT_GT(there, count / 5);
  EXPECT_LT(there, count * 4 / 5);
}

using Found = std::tuple<ViolationKind, std::uint64_t, std::uint64_t, std::uint32_t>;

Outline small_outline(Random& random) {
  for (;;) {
    GridRegion region = cases::any_outline(random);
    const geom::GridBox box = bounds(region);
    if (box.high.x - box.low.x < 120 * mm && box.high.y - box.low.y < 120 * mm &&
        box.high.x - box.low.x > 2 * mm)
      return {std::move(region), {}, 0};
  }
}

Document layout(Random& random) {
  Document document;
  Stock stock;
  stock.id = "hide";
  stock.count = 2;
  for (;;) {
    auto made = geom::make_grid_region(
        {cases::star(random, 300.0 * mm, 0.6, 9), {{0, 0}, {30 * mm, 0}, {0, 30 * mm}}});
    if (!made) continue;
    stock.outline.polygon = std::move(*made);
    break;
  }
  const auto anywhere = [&](Outline outline) {
    const GridPoint by = cases::grid_direction(random, random.uniform(0, 250) * mm);
    outline.polygon = geom::moved(std::move(outline.polygon), by);
    return outline;
  };
  for (int i = 0; i < 5; ++i) {
    stock.defects.push_back(
        {std::to_string(i), 1 + static_cast<int>(random.below(3)), anywhere(small_outline(random))});
    stock.zones.push_back(
        {std::to_string(i), static_cast<int>(random.below(4)), anywhere(small_outline(random))});
  }
  document.stocks = {stock};
  const auto gap = [&] { return cases::between(random, 0, 8) * mm; };
  document.rules = {gap(), gap(), gap()};
  for (int i = 0; i < 4; ++i) {
    Part part;
    part.id = std::to_string(i);
    part.outline = small_outline(random);
    part.quality = static_cast<int>(random.below(4));
    part.tolerated_severity = static_cast<int>(random.below(3));
    part.may_mirror = true;
    if (random.below(2) == 0)
      part.areas.push_back({static_cast<int>(random.below(4)), small_outline(random)});
    if (random.below(2) == 0) part.gap = gap();
    if (random.below(2) == 0) part.border_gap = gap();
    if (random.below(2) == 0) part.defect_gap = gap();
    document.parts.push_back(std::move(part));
  }
  for (int i = 0; i < 9; ++i) {
    Placement placement;
    placement.id = document.next_id++;
    placement.part = static_cast<std::uint32_t>(random.below(4));
    placement.copy = static_cast<std::int64_t>(random.below(2));
    placement.rotation = cases::any_rotation(random);
    placement.mirrored = random.below(2) == 0;
    placement.at = cases::grid_direction(random, random.uniform(0, 250) * mm);
    document.placements.push_back(placement);
  }
  return document;
}

std::set<Found> by_definition(const Document& document) {
  std::set<Found> found;
  const Stock& stock = document.stocks[0];
  const oracle::Cut material(stock.outline.polygon);
  for (const Placement& p : document.placements) {
    const Part& part = document.parts[p.part];
    const oracle::Cut cut(placed_outline(part, p));
    if (!material.holds(cut, {}))
      found.insert({ViolationKind::outside, p.id, 0, 0});
    else if (material.edges_nearer_than(cut, part.border_gap.value_or(document.rules.border_gap), {}))
      found.insert({ViolationKind::border_gap, p.id, 0, 0});
    for (std::uint32_t d = 0; d < stock.defects.size(); ++d) {
      if (stock.defects[d].severity <= part.tolerated_severity) continue;
      const oracle::Cut defect(stock.defects[d].outline.polygon);
      if (defect.interiors_meet(cut, {}))
        found.insert({ViolationKind::defect, p.id, 0, d});
      else if (defect.edges_nearer_than(cut, part.defect_gap.value_or(document.rules.defect_gap), {}))
        found.insert({ViolationKind::defect_gap, p.id, 0, d});
    }
    for (std::uint32_t z = 0; z < stock.zones.size(); ++z) {
      const oracle::Cut zone(stock.zones[z].outline.polygon);
      const int quality = stock.zones[z].quality;
      mpq_class bad = 0;
      if (part.areas.empty()) {
        if (part.quality > quality) bad = common_area({&cut, &zone});
      } else {
        Part area_as_part = part;
        area_as_part.outline = part.areas[0].outline;
        const oracle::Cut area(placed_outline(area_as_part, p));
        if (part.areas[0].quality > quality) bad += common_area({&cut, &zone, &area});
        if (part.quality > quality) bad += area_left({&cut, &zone}, {&area});
      }
      if (bad > 0) found.insert({ViolationKind::quality, p.id, 0, z});
    }
    for (const Placement& q : document.placements) {
      if (q.id <= p.id || q.copy != p.copy) continue;
      const Part& other_part = document.parts[q.part];
      const oracle::Cut other(placed_outline(other_part, q));
      const std::int64_t gap =
          std::max(part.gap.value_or(document.rules.gap), other_part.gap.value_or(document.rules.gap));
      if (cut.interiors_meet(other, {}))
        found.insert({ViolationKind::overlap, p.id, q.id, 0});
      else if (cut.edges_nearer_than(other, gap, {}))
        found.insert({ViolationKind::gap, p.id, q.id, 0});
    }
  }
  return found;
}

TEST(LayoutCheck, FindsWhatTheDefinitionsSayAndEndsIt) {
  const std::size_t count = std::min<std::size_t>(cases::case_count(16), 4000);
  std::size_t kinds[11] = {};
  for (std::size_t i = 0; i < count; ++i) {
    Random random(cases::seed() + 9, 1 + i);
    const Document document = layout(random);
    const std::vector<Violation> violations = check(document);
    std::set<Found> found;
    for (const Violation& v : violations) {
      found.insert({v.kind, v.a, v.b, v.feature});
      ++kinds[static_cast<std::size_t>(v.kind)];
      ASSERT_GT(v.amount_mm, 0) << i;
      // Moved by a little more than the amount, the violation between the two is over.
      if (v.direction == geom::Point{} || v.kind == ViolationKind::gap ||
          v.kind == ViolationKind::border_gap || v.kind == ViolationKind::defect_gap)
        continue;
      Document moved = document;
      Placement& placement = *std::find_if(moved.placements.begin(), moved.placements.end(),
                                           [&](const Placement& p) { return p.id == v.a; });
      const double length = v.amount_mm * 0x1p20;
      placement.at = placement.at +
                     GridPoint{std::llround(length * v.direction.x), std::llround(length * v.direction.y)};
      for (const Violation& w : check(moved))
        ASSERT_FALSE(w.kind == v.kind && w.a == v.a && w.b == v.b && w.feature == v.feature) << i;
    }
    ASSERT_EQ(found.size(), violations.size());
    ASSERT_EQ(found, by_definition(document)) << "seed " << cases::seed() << " layout " << i;
  }
  for (int kind = 0; kind <= static_cast<int>(ViolationKind::quality); ++kind)
    EXPECT_TRUE(kinds[kind] > 0 || count < 64) << name_of(static_cast<ViolationKind>(kind));
}

}  // namespace
}  // namespace lekalo::layout::layout_check_test

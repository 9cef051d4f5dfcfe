// Polygons that lekalo makes of drawings are what the checker takes for theirs, on the side they are made
// for and on no other.

#include <gtest/gtest.h>

#include <algorithm>

#include "lekalo/geom/grid_region.hpp"
#include "lekalo/verify/layout.hpp"
#include "support/layout_texts.hpp"
#include "support/region_cases.hpp"

namespace lekalo::verify_layout_chords_test {
namespace {

using cases::Json;

Json contour_json(const geom::Contour& contour) {
  Json list = Json::array();
  const auto point = [](geom::Point p) { return Json{p.x, p.y}; };
  for (const geom::Edge& e : contour) {
    Json inner{{"from", point(e.from)}, {"to", point(e.to)}};
    const bool arc = e.kind != geom::EdgeKind::line;
    if (arc) inner["centre"] = point(e.centre), inner["ccw"] = e.kind == geom::EdgeKind::arc_ccw;
    list.push_back({{arc ? "arc" : "line", inner}});
  }
  return list;
}

Json outline_json(const geom::GridRegion& polygon, const geom::Region& curves, double tolerance) {
  std::vector<cases::Points> loops;
  for (std::size_t l = 0; l < polygon.loops(); ++l) {
    auto& loop = loops.emplace_back();
    for (std::uint32_t i = polygon.loop_starts[l]; i < polygon.loop_starts[l + 1]; ++i) {
      const geom::Point p = geom::mm_from_grid(polygon.points[i]);
      loop.emplace_back(p.x, p.y);
    }
  }
  Json outline = cases::outline_json(loops[0], {loops.begin() + 1, loops.end()});
  outline["curves"] = {{"outer", contour_json(curves.outer)}, {"holes", Json::array()}};
  for (const geom::Contour& hole : curves.holes) outline["curves"]["holes"].push_back(contour_json(hole));
  outline["chord_tolerance"] = tolerance;
  return outline;
}

bool has_arcs(const geom::Region& region) {
  const auto arc = [](const geom::Edge& e) { return e.kind != geom::EdgeKind::line; };
  bool any = std::any_of(region.outer.begin(), region.outer.end(), arc);
  for (const geom::Contour& hole : region.holes) any = any || std::any_of(hole.begin(), hole.end(), arc);
  return any;
}

TEST(LayoutChordsDifferential, TheCheckerTakesTheChordsThatAreMadeAndNoOthers) {
  int taken = 0, with_arcs = 0;
  for (std::size_t i = 0; i < cases::region_case_count(1); ++i) {
    for (const cases::RegionKind kind : cases::kRegionKinds) {
      const cases::RegionCase one = cases::region_case(cases::seed() + 41, i, kind);
      for (const auto& regions : {one.part, one.blank}) {
        for (const geom::Region& region : regions) {
          for (const double tolerance : {1e-4, 0.01, 0.3}) {
            for (const geom::ChordSide side : {geom::ChordSide::grow, geom::ChordSide::shrink}) {
              const auto polygon = geom::grid_region_of_curves(region, side, tolerance);
              if (!polygon) continue;  // chords of one contour may meet another
              const Json outline = outline_json(*polygon, region, tolerance);
              const auto verdict = [&](bool of_part) {
                Json layout = cases::empty_layout();
                if (of_part)
                  cases::add_part(layout, "a", outline);
                else
                  layout["stocks"][0]["outline"] = outline;
                return verify::verify_layout({"layout.json", layout.dump()});
              };
              const bool grown = side == geom::ChordSide::grow;
              const auto right = verdict(grown);
              ASSERT_TRUE(right) << right.error().message << "\n" << outline.dump();
              ++taken;
              if (!has_arcs(region)) continue;
              ++with_arcs;
              EXPECT_FALSE(verdict(!grown)) << outline.dump();
            }
          }
        }
      }
    }
  }
  EXPECT_GT(taken, 30);
  EXPECT_GT(with_arcs, 15);
}

}  // namespace
}  // namespace lekalo::verify_layout_chords_test

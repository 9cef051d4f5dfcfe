#pragma once

// Layouts on a lattice in which everything is wrong at once, much of it by touching alone.

#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "support/lattice_outlines.hpp"
#include "support/layout_texts.hpp"

namespace lekalo::cases {

inline Points in_mm(const std::vector<geom::GridPoint>& loop, double scale) {
  Points points;
  for (const geom::GridPoint p : loop)
    points.emplace_back(scale * static_cast<double>(p.x), scale * static_cast<double>(p.y));
  return points;
}
inline Json lattice_outline(const LatticeLoops& loops, double scale) {
  std::vector<Points> holes;
  for (std::size_t l = 1; l < loops.size(); ++l) holes.push_back(in_mm(loops[l], scale));
  return outline_json(in_mm(loops[0], scale), holes);
}

/// A crowded layout on a lattice: every kind of violation, many of them by touching alone.
inline Json crowded(Random& random) {
  const auto upto = [&](std::uint64_t n) { return static_cast<double>(random.below(n + 1)); };
  Json layout = empty_layout();
  layout["stocks"][0]["outline"] = outline_json(rectangle(0, 0, 40, 40), {rectangle(18, 18, 2, 4)});
  layout["stocks"][0]["grain_deg"] = 90 * upto(3);
  for (const char* list : {"defects", "zones"}) {
    for (int i = 0; i < 3; ++i) {
      Json outline = lattice_outline(lattice_polygon(random), 1);
      for (auto& loop : {&outline["polygon"]["outer"]})
        for (auto& p : *loop) p = {p[0].get<double>() + 12.0 * i, p[1].get<double>() + 12.0 * i};
      outline["polygon"].erase("holes");
      layout["stocks"][0][list].push_back({{"id", "f" + std::to_string(i)},
                                           {list[0] == 'd' ? "severity" : "quality", 1 + random.below(3)},
                                           {"outline", outline}});
    }
  }
  layout["rules"] = {{"gap", upto(2)}, {"border_gap", upto(1)}, {"defect_gap", upto(1)}};
  for (int i = 0; i < 4; ++i) {
    Json& part = add_part(layout, "p" + std::to_string(i), lattice_outline(lattice_polygon(random), 1));
    part["quality"] = random.below(4);
    part["tolerated_severity"] = random.below(3);
    part["rotations"] = {0, 90, {{"from", 170}, {"to", 200}}};
    part["mirror"] = random.below(2) == 0;
    part["grain"] = {{"deg", 90 * upto(1)}, {"tolerance_deg", 10}};
    part["areas"] = {{{"quality", random.below(4)}, {"outline", lattice_outline(lattice_polygon(random), 1)}},
                     {{"quality", random.below(4)}, {"outline", outline_json(rectangle(0, 0, 4, 8))}}};
  }
  for (int i = 0; i < 10; ++i) {
    Json& at = place(layout, "p" + std::to_string(random.below(4)), upto(36), upto(36), 90 * upto(3));
    at["mirrored"] = random.below(3) == 0;
    at["copy"] = random.below(4) == 0 ? 1 : 0;
  }
  return layout;
}

}  // namespace lekalo::cases

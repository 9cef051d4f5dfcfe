#pragma once

// Layouts of parts with lines and texts on them, as files say them.

#include <string>

#include "lekalo/base/random.hpp"
#include "support/layout_texts.hpp"

namespace lekalo::cases {

inline Json line_json(double x0, double y0, double x1, double y1) {
  return {{"line", {{"from", {x0, y0}}, {"to", {x1, y1}}}}};
}
inline Json arc_json(double x0, double y0, double x1, double y1, double cx, double cy, bool ccw) {
  return {{"arc", {{"from", {x0, y0}}, {"to", {x1, y1}}, {"centre", {cx, cy}}, {"ccw", ccw}}}};
}

/// Adds a plate of 60 x 40 with a hole and one of each: an open chain with an arc, a circle, a bend, a cut,
/// and texts with all that a text may have.
inline Json& add_marked_plate(Json& layout, const std::string& id) {
  Json& part = add_part(layout, id, outline_json(rectangle(0, 0, 60, 40), {rectangle(45, 5, 10, 10)}));
  part["mirror"] = true;
  part["marks"] = {{{"layer", "ENG"},
                    {"colour", "#ff0000"},
                    {"role", "engrave"},
                    {"edges", Json::array({line_json(5, 5, 15, 5), arc_json(15, 5, 15, 15, 15, 10, true),
                                           line_json(15, 15, 5, 15)})}},
                   {{"layer", "ENG"}, {"edges", Json::array({arc_json(34, 10, 34, 10, 30, 10, false)})}},
                   {{"layer", "a:b"},
                    {"colour", "#0000ff"},
                    {"role", "bend"},
                    {"edges", Json::array({line_json(0, 20, 60, 20)})}},
                   {{"role", "cut"}, {"edges", Json::array({line_json(20, 22, 25, 22)})}}};
  part["texts"] = {{{"text", "N7 Ж"}, {"at", {5, 25}}, {"height", 4}, {"layer", "TXT"}, {"role", "engrave"}},
                   {{"text", "a<b"},
                    {"at", {40, 34}},
                    {"height", 3},
                    {"deg", 350},
                    {"anchor", "middle"},
                    {"width_factor", 0.8},
                    {"colour", "#008000"},
                    {"layer", "TXT"}},
                   {{"text", "back"},
                    {"at", {40, 24}},
                    {"height", 2},
                    {"deg", 10},
                    {"anchor", "right"},
                    {"mirrored", true}}};
  return part;
}

/// A sheet of 700 x 500 with so many such plates, each turned by any angle and mirrored or not.
inline Json marked_layout(Random& random, int pieces) {
  Json layout = empty_layout();
  layout["stocks"][0]["outline"] = outline_json(rectangle(0, 0, 700, 500));
  add_marked_plate(layout, "plate");
  for (int i = 0; i < pieces; ++i)
    place(layout, "plate", 100.0 + 150 * (i % 4), 100.0 + 150 * (i / 4), random.uniform(0, 360))["mirrored"] =
        random.below(2) == 0;
  return layout;
}

}  // namespace lekalo::cases

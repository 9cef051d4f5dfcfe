#pragma once

#include <vector>

#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/draw/heat_scene.hpp"

namespace lekalo::draw {

/// The parts of pictures of heat that the page of maps and the report share. Each fills `room`.

/// Draws a layer in colours with its title above and its scale below; the greatest value has a ring.
void draw_heat_layer(const HeatScene& scene, const HeatLayer& layer, const Rect& room,
                     std::vector<Item>& items);
/// Draws stock and pocket where they are to be, dashed, and where they are at the end of the program, far
/// exaggerated.
void draw_heat_displacement(const HeatScene& scene, const Rect& room, std::vector<Item>& items);
/// The room that each of the strips takes on the page of maps, mm.
inline constexpr double kHeatStripHigh = 27;
/// Draws the strips of walls, unrolled, and the scale of their errors.
void draw_heat_strips(const HeatScene& scene, const Rect& room, std::vector<Item>& items);

}  // namespace lekalo::draw

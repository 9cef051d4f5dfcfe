#pragma once

#include <vector>

#include "picture_drawing.hpp"
#include "scene.hpp"
#include "view.hpp"

namespace lekalo::draw {

/// Draws title, names, status, numbers, colour scale and legend, from the top of `room` downwards. Returns
/// where they end.
double draw_panel(const LocatePicture& picture, const PictureOfRings& rings, const Located& shapes,
                  const Rect& room, std::vector<Item>& items);

}  // namespace lekalo::draw

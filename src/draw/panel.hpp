#pragma once

#include <vector>

#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "picture_drawing.hpp"

namespace lekalo::draw {

/// Draws title, names, status, numbers, colour scale and legend, from the top of `room` downwards. Returns
/// where they end.
double draw_panel(const LocatePicture& picture, const PictureOfRings& rings, const Located& shapes,
                  const Rect& room, std::vector<Item>& items);

}  // namespace lekalo::draw

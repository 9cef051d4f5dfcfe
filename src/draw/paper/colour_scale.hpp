#pragma once

#include <string>
#include <vector>

#include "colour.hpp"
#include "scene.hpp"
#include "view.hpp"

namespace lekalo::draw {

/// Draws the bar of colours that a range of allowances has, with a title above and numbers below, from the
/// top of `room` down. Returns the baseline of the numbers.
double draw_colour_scale(const ColourRange& range, const std::string& title, const Rect& room,
                         double title_size, double number_size, std::vector<Item>& items);

}  // namespace lekalo::draw

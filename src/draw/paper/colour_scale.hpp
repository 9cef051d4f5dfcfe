#pragma once

#include <string>
#include <vector>

#include "colour.hpp"
#include "scene.hpp"
#include "view.hpp"

namespace lekalo::draw {

/// The numbers beside a scale of colours: places from 0 to 1, and what stands there.
struct ScaleTicks {
  struct Tick {
    double share = 0;
    std::string text;
  };
  std::vector<Tick> ticks;
  std::string unit;
};
/// \param width  of the bar, in the unit of the letters' size
[[nodiscard]] ScaleTicks scale_ticks(const ColourRange& range, double width, double number_size);

/// Draws the bar of colours that a range of allowances has, with a title above and numbers below, from the
/// top of `room` down. Returns the baseline of the numbers.
double draw_colour_scale(const ColourRange& range, const std::string& title, const Rect& room,
                         double title_size, double number_size, std::vector<Item>& items);

}  // namespace lekalo::draw

#include "colour_scale.hpp"

#include <algorithm>
#include <cmath>

#include "lekalo/io/text/words.hpp"
#include "printed_number.hpp"

namespace lekalo::draw {

ScaleTicks scale_ticks(const ColourRange& range, double width, double number_size) {
  const double step = tick_step(range.low, range.high, width, number_size);
  const LengthScale unit = length_scale(step, range.high);
  ScaleTicks made{{}, unit.unit_name};
  for (double k = std::ceil(range.low / step * (1 - 1e-12)); k * step <= range.high * (1 + 1e-12); ++k) {
    const double share = (k * step - range.low) / (range.high - range.low);
    made.ticks.push_back({std::clamp(share, 0.0, 1.0), unit.text(k * step)});
  }
  return made;
}

double draw_colour_scale(const ColourRange& range, const std::string& title, const Rect& room,
                         double title_size, double number_size, std::vector<Item>& items) {
  constexpr double kBar = 3.6;
  const ScaleTicks scale = scale_ticks(range, room.width, number_size);
  double y = room.y + 5;
  items.push_back(TextItem{
      {room.x, y}, title + ", " + scale.unit, title_size, Anchor::start, kInk, false, {"scale-title", ""}});
  y += 2;
  for (int i = 0; i < kColourSteps; ++i) {
    // Each colour reaches to the end of the bar and is covered by the next: no seams.
    const double x = room.x + room.width * i / kColourSteps;
    items.push_back(PathItem{{{{x, y}, {room.right(), y}, {room.right(), y + kBar}, {x, y + kBar}}},
                             true,
                             filled(scale_colour(i)),
                             {"scale", ""}});
  }
  const double bottom = y + kBar, baseline = bottom + 0.9 + number_size;
  for (const auto& [share, number] : scale.ticks) {
    const double x = room.x + room.width * share;
    items.push_back(PathItem{{{{x, bottom}, {x, bottom + 0.8}}}, false, stroked(kInk, 0.2), {"tick", ""}});
    const double half = number_size * io::text_width(number) / 2;
    items.push_back(TextItem{{std::clamp(x, room.x + half, room.right() - half), baseline},
                             number,
                             number_size,
                             Anchor::middle,
                             kInk,
                             false,
                             {"tick-label", ""}});
  }
  return baseline;
}

}  // namespace lekalo::draw

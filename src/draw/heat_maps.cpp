#include <tuple>

#include "draw/paper/colour.hpp"
#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "heat_layers.hpp"
#include "lekalo/draw/heat_scene.hpp"
#include "lekalo/io/text/words.hpp"

namespace lekalo::draw {
namespace {

/// Without strips.
constexpr Rect kMapsPage{0, 0, 280, 182};
constexpr double kMapsMargin = 8, kMapsWide = 128, kMapsHigh = 76;

Scene composed_maps(const HeatScene& heat) {
  Scene scene;
  const double strips = kHeatStripHigh * static_cast<double>(heat.strips.size());
  const Rect page{0, 0, kMapsPage.width, kMapsPage.height + strips};
  scene.width = page.width, scene.height = page.height;
  scene.title = "lekalo heat: " + heat.name;
  scene.description = heat.title[0];
  scene.items.push_back(PathItem{{page.ring()}, true, filled(kPaper), {"page", ""}});
  const double room = kMapsPage.width - 2 * kMapsMargin;
  for (const auto& [words, y, size, bold] :
       {std::tuple{&heat.title[0], 10.0, 4.0, true}, {&heat.title[1], 16.0, 3.2, false}})
    scene.items.push_back(TextItem{{kMapsMargin, y},
                                   *words,
                                   io::fitting_size(*words, size, room),
                                   Anchor::start,
                                   kInk,
                                   bold,
                                   {"text", ""}});
  const double left = kMapsMargin, right = kMapsPage.width - kMapsMargin - kMapsWide, upper = 20,
               lower = upper + kMapsHigh + 3;
  draw_heat_layer(heat, heat.warmest, {left, upper, kMapsWide, kMapsHigh}, scene.items);
  draw_heat_layer(heat, heat.at_end, {right, upper, kMapsWide, kMapsHigh}, scene.items);
  draw_heat_layer(heat, heat.stress, {left, lower, kMapsWide, kMapsHigh}, scene.items);
  draw_heat_displacement(heat, {right, lower, kMapsWide, kMapsHigh}, scene.items);
  draw_heat_strips(heat, {left, lower + kMapsHigh + 3, room, strips}, scene.items);
  return scene;
}

}  // namespace

std::string heat_maps_svg(const HeatScene& scene) { return scene_svg(composed_maps(scene)); }

Result<std::string> heat_maps_png(const HeatScene& scene, int width_px) {
  return scene_png(composed_maps(scene), width_px);
}

}  // namespace lekalo::draw

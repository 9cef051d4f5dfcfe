#include "lekalo/draw/solid_picture.hpp"

#include <cmath>

#include "draw/paper/colour.hpp"
#include "lekalo/io/solid/solid_file.hpp"
#include "solid_look.hpp"

namespace lekalo::draw {

std::string solid_surface(const SolidScene& scene) {
  const SolidLook look(scene);
  solid::Mesh placed = scene.part;
  for (solid::Vector& p : placed.vertices) p = look.motion(p);
  io::PlyLook shown;
  for (const double allowance : scene.allowances) {
    const bool missing = look.missing() && look.value_of(allowance) < 0;
    const Colour colour = std::isnan(allowance) ? kPlainPart
                          : missing             ? kOutside
                                    : scale_colour(scale_step(allowance, look.range.low, look.range.high));
    shown.quality.push_back(allowance);
    shown.colours.push_back({colour.red, colour.green, colour.blue});
  }
  return io::ply_text(placed, shown);
}

}  // namespace lekalo::draw

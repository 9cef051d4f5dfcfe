#include "lekalo/draw/solid_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

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

std::string solid_points(const std::vector<solid::Vector>& points, const std::vector<double>& deviations) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const double deviation : deviations)
    if (deviation >= 0) least = std::min(least, deviation), greatest = std::max(greatest, deviation);
  io::PlyLook shown{deviations, {}};
  for (const double deviation : deviations) {
    const Colour colour = deviation < 0 ? kOutside : scale_colour(scale_step(deviation, least, greatest));
    shown.colours.push_back({colour.red, colour.green, colour.blue});
  }
  return io::ply_text({points, {}}, shown);
}

}  // namespace lekalo::draw

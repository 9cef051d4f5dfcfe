#include "plane.hpp"

#include <cmath>

#include "modes.hpp"

namespace lekalo::nc {

Wide steps_nearest(const geom::DoubleDouble& grains, Grains step) noexcept {
  const geom::DoubleDouble steps = grains / to_double_double(step);
  const double whole = std::floor(steps.hi);
  const double rest = (steps.hi - whole) + steps.lo;  // exact difference: whole is the floor of hi
  return static_cast<Wide>(whole) + static_cast<Wide>(std::floor(rest + 0.5));
}

RigidMotion::RigidMotion(double x_mm, double y_mm, double theta) noexcept
    : turn_(geom::sincos_double_double(theta)),
      shift_{geom::two_product(x_mm, kGrainsPerMillimetre), geom::two_product(y_mm, kGrainsPerMillimetre)},
      turns_(theta != 0.0) {}

RoundedHeight rounded_height(double z_mm, Grains step) noexcept {
  const geom::DoubleDouble exact = geom::two_product(z_mm, kGrainsPerMillimetre);
  const Grains shift = steps_nearest(exact, step) * step;
  return {shift, std::abs((to_double_double(shift) - exact).hi) / kGrainsPerMillimetre};
}

double with_height(double plane_mm, double height_mm) noexcept {
  if (height_mm == 0) return plane_mm;
  return rounded_up(std::sqrt(plane_mm * plane_mm + height_mm * height_mm));
}

}  // namespace lekalo::nc

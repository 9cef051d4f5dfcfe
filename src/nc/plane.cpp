#include "plane.hpp"

#include <cmath>

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

}  // namespace lekalo::nc

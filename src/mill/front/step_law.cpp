#include "step_law.hpp"

#include <cmath>

#include "lekalo/base/angle.hpp"
#include "lekalo/geom/trig.hpp"

namespace lekalo::mill {
double step_for(double r0, double r, double cosine) {
  const double b = r * cosine;
  return -b + std::sqrt(b * b + (r0 + r) * (r0 + r) - r * r) - r0;
}

double straight_pass_angle(double step_over) {
  const double cosine = 1 - 2 * step_over;
  return geom::direction_angle(cosine, std::sqrt(1 - cosine * cosine));
}

double most_held_degrees(double step_over) {
  return 1.25 * straight_pass_angle(step_over) * kDegreesPerRadian;
}

}  // namespace lekalo::mill

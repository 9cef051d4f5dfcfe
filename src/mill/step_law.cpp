#include "step_law.hpp"

#include <cmath>

namespace lekalo::mill {
namespace {

// 88 degrees: sine, and square of the sine of half of it.
constexpr double kWallSine = 0.9993908270190958;
constexpr double kWallHalfSquare = 0.4825502516487;

}  // namespace

double step_for(double r0, double r, double cosine) {
  const double b = r * cosine;
  return -b + std::sqrt(b * b + (r0 + r) * (r0 + r) - r * r) - r0;
}

// A rim point at the angle a from the wall is outside of the circle of radius fillet + r that the pass before
// left when d^2 + 2 d r sin(a) > 4 fillet r sin(a / 2)^2, d the way from the fillet's end.
double step_along_wall(double fillet, double r) {
  const double b = r * kWallSine;
  return -b + std::sqrt(b * b + 4 * fillet * r * kWallHalfSquare);
}

double fillet_for(double step, double r) {
  return (step * step + 2 * step * r * kWallSine) / (4 * r * kWallHalfSquare);
}

}  // namespace lekalo::mill

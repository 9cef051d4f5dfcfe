#include "trailing_blade.hpp"

#include <algorithm>
#include <cmath>

#include "drawn_file.hpp"

namespace lekalo::verify {
namespace {

/// The cosine of 170 degrees between blade and motion.
constexpr double kPushed = -0.985;
constexpr double kRounded = 0.036;  ///< mm, a plotter unit in x and in y
/// The tangent of half an angle that is as good as half a turn.
constexpr double kOpposite = 1e8;

}  // namespace

// Over a step s the blade turns by at most s / offset, and a way of length s that turns so far lies within
// s^2 / (2 offset) of its chord.
TrailingBlade::TrailingBlade(double offset, double within)
    : offset_(offset), within_(within), step_(std::sqrt(2 * offset * within)) {}

bool TrailingBlade::draw(Place from, Place to, std::vector<Stroke>& lines) {
  const double way = length(to - from);
  if (way == 0) {
    lines.push_back(line_between(tip(from), tip(from)));
    return true;
  }
  const Place along = unit(to - from), left = left_of(along);
  const double cosine = dot(forward_, along), sine = dot(forward_, left);
  // The part of the angle that nobody knows grows by a factor e over an offset: too much for a long way, and
  // nothing for the unit by which rounding may put the axis back.
  if (cosine < kPushed && way > std::max(0.5 * offset_, kRounded)) return false;
  double half = std::clamp(sine / std::max(1 + cosine, 1e-16), -kOpposite, kOpposite);
  Place last = tip(from);
  for (double left_over = way; left_over > 0;) {
    // From here on the tip stays within offset * sin(phi) of the line, and so do the ends of its chord.
    const bool is_straight = 2 * offset_ * std::abs(half) <= within_;
    const double by = is_straight ? left_over : std::min(step_, left_over);
    left_over -= by;
    half *= std::exp(-by / offset_);
    const double scale = 1 / (1 + half * half);
    forward_ = (scale * (1 - half * half)) * along + (2 * half * scale) * left;
    const Place next = tip(to - left_over * along);
    lines.push_back(line_between(last, next));
    last = next;
  }
  return true;
}

}  // namespace lekalo::verify

#include "choice.hpp"
#include "lekalo/locate/criterion.hpp"

namespace lekalo::locate {
namespace {

constexpr double kLongestStep = 64, kShortestStep = 1e-3;  // mm

/// Steps to the left, halved wherever one is not allowed.
Result<void> choose_leftmost(Choice& choice) {
  for (double step = kLongestStep; choice.free()[0] && step > kShortestStep;) {
    Placement next = choice.pose().at;
    next.x -= step;
    if (!choice.take(next)) step /= 2;
  }
  return {};
}

}  // namespace

/// As far to the left as the margin allows, so that what remains of the blank is one piece.
Criterion criterion_left() {
  return {.name = "left", .favours = "the one furthest to the left", .choose = choose_leftmost};
}

}  // namespace lekalo::locate

#include "choice.hpp"
#include "lekalo/locate/criterion.hpp"

namespace lekalo::locate {
namespace {

/// Step 6 of docs/design/locate-demands.md.
Result<void> choose_most_even(Choice& choice) {
  LEKALO_CHECK(choice.take_smallest_largest());
  const Choice::Pose start = choice.pose();
  const EvenPose best =
      most_even(choice.samples(), choice.clearance(), choice.caps(), start.at, start.mirrored, choice.spare(),
                choice.free(), choice.window(), [&](const Placement& at) { return choice.allows(at); });
  choice.take(best.at);
  return {};
}

}  // namespace

/// The allowance is to deviate least, in the mean square, from its targets (or its mean): a local optimum
/// among the placements with a largest allowance of at most SmallestLargest::kept.
Criterion criterion_even() {
  return {.name = "even", .favours = "the most even", .choose = choose_most_even};
}

}  // namespace lekalo::locate

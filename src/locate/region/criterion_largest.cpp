#include "choice.hpp"
#include "lekalo/locate/criterion.hpp"

namespace lekalo::locate {

/// The smallest largest allowance is looked for among the placements that keep the margin.
Criterion criterion_largest() {
  return {.name = "largest", .favours = "the smallest largest one", .choose = [](Choice& choice) {
            return choice.take_smallest_largest();
          }};
}

}  // namespace lekalo::locate

#include "lekalo/locate/criterion.hpp"

namespace lekalo::locate {

/// The largest margin, which is the smallest allowance where nothing else is demanded, is all that counts.
Criterion criterion_smallest() { return {.name = "smallest", .favours = ""}; }

}  // namespace lekalo::locate

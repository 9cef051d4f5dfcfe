#pragma once

#include "separator.hpp"

namespace lekalo::nest {

/// The longest length, mm, of which every gap and every corner of every part, at every angle it may have,
/// is a multiple. A layout that closes like a puzzle can then have everything at multiples of it. The
/// answer is 0 where there is no such length, where something lies fixed, or where the stock has too few or
/// too many such places to look through them all. docs/design/nest.md, step 8.
[[nodiscard]] double lattice_unit(const Problem& problem, const Items& items);

}  // namespace lekalo::nest

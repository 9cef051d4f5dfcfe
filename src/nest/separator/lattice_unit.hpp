#pragma once

#include "separator.hpp"

namespace lekalo::nest {

/// The longest length, mm, of which every corner of every part at every angle it may have, and every gap, is
/// a multiple: a layout that closes like a puzzle can then have everything at multiples of it. 0 where there
/// is none, where something lies fixed, or where the stock has too few or too many such places to look
/// through them all.
[[nodiscard]] double lattice_unit(const Problem& problem, const Items& items);

}  // namespace lekalo::nest

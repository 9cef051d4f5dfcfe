#pragma once

#include <vector>

#include "lekalo/nest/nest.hpp"

namespace lekalo::nest {

/// Places the pieces whose turn never came by their boxes alone, in columns beside what lies already, on
/// strips and sheets that are rectangles. It is for runs that end too early: a shop can cut from such a
/// layout, and from none it cannot. Pieces that break a rule there, and orders of kits, stay unplaced.
/// Cost: O(n log n + 500 copies) and one check of the layout.
void place_in_columns(layout::Document& document, std::vector<Unplaced>& unplaced);

}  // namespace lekalo::nest

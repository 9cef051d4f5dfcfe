#pragma once

#include <cstdint>
#include <vector>

#include "search.hpp"

namespace lekalo::nest {

/// The functions here choose which pieces to throw in so that kits get complete (fill, reduce).
/// docs/design/nest-sheets.md, step 4.

/// Missing items that complete one more kit: the one that is worth most for the area it lacks, blurred by
/// chance. Empty where no kit can be completed.
[[nodiscard]] std::vector<std::uint32_t> pieces_for_a_kit(Search& search,
                                                          const std::vector<std::uint32_t>& missing);
/// A plan: how many of each kit, worth more together than the complete ones in the separator and hardly
/// larger. Empty where chance finds none.
[[nodiscard]] std::vector<std::int64_t> planned_kits(Search& search);
/// Takes out of the separator what serves none of these kits and throws in what they lack.
void replace_by(Search& search, const std::vector<std::int64_t>& kits);

}  // namespace lekalo::nest

#pragma once

#include <array>
#include <optional>

#include "solid_inputs.hpp"

namespace lekalo::jobs {

/// A pose that a control's words can say, in these words.
struct WordedPose {
  nc::OffsetTurn turn;
  std::array<long long, 3> shift{};  ///< counts the last decimal
};

/// Rounding a pose to these words loses some of its last digits: no point of the part is farther off than
/// this share of its distance.
inline constexpr double kWordedLoss = 0x1p-42;

/// Moves a placement to the best of those beside it that the control's words can say, measured anew. Nothing,
/// and no change, where none of them is in the window, or where the control has no words for its rotation.
[[nodiscard]] Result<std::optional<WordedPose>> worded(const SolidLocateJob& job, const SolidInputs& in,
                                                       locate::SolidPlacement& best);

/// Writes the lines of the work offset that the job asks for and records them in the document, unless the
/// placement does not allow it; then a warning says why there are none.
void add_offset(const SolidLocateJob& job, const std::optional<WordedPose>& words, LocatedSolid& made);

/// Puts the lines before the independent checker. \pre there are lines
[[nodiscard]] Result<void> check_offset(const LocatedSolid& made);

}  // namespace lekalo::jobs

#pragma once

#include "lekalo/locate/solid.hpp"

namespace lekalo::locate {

/// The largest allowance at a pose: no point of the triangles that have a demand is farther from the blank's
/// surface, mm. It is told a thousandth of itself larger, or where the meshes are fine up to a fortieth, and
/// by what coordinates are off. Widths of the blank's triangles are not taken off, for what is
/// uncertain may be material. Rims of finished faces count like the rest of their triangles.
[[nodiscard]] double largest_allowance(const SolidProblem& problem, const SolidPose& pose);

/// Goes on from a placement to one whose largest allowance no small motion makes smaller, among those of the
/// window that are inside, keep datums and distances, and have a margin of at least `least_margin`. So there
/// is least to be cut where most is; a smaller one may be elsewhere, and nothing is proved of it. Where
/// nothing is better it returns `from`. A stop, or the work limit, leaves the best so far.
///
/// Refuses what place_solid refuses, and with ErrorCode::usage a placement that is not inside, or has less
/// margin. The same result for any number of threads.
/// Source: sequential linear programs in a box that shrinks (docs/design/locate-solid.md, "Criteria").
[[nodiscard]] Result<SolidPlacement> smallest_largest(const SolidProblem& problem, const SolidPlacement& from,
                                                      double least_margin, const SolidOptions& options);

}  // namespace lekalo::locate

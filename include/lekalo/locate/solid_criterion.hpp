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

/// How far the allowances deviate from what they should be at a pose: the root of the mean square of
/// allowance less target over 600 points of the triangles with a demand, chosen by area (docs/formats.md,
/// "Criteria"), mm. Points of triangles without a target aim at the mean of such points. The allowance is the
/// distance from the blank's surface; widths of its triangles are not taken off. Cost: O(log n) a point, and
/// O(n).
[[nodiscard]] double allowance_deviation(const SolidProblem& problem, const SolidPose& pose);

/// Goes on from a placement, as a rule that of smallest_largest, to one with a smaller allowance_deviation,
/// among those of the window that are inside, keep datums and distances, and have a margin of at least
/// `least_margin` and a largest allowance at most `give_up` mm above that of `from`, as far as a 128th of the
/// gap. It is one that no small motion makes better; nothing is proved of it. Where nothing is better it
/// returns `from`. A stop, or the work limit, leaves the best so far.
///
/// Refuses what smallest_largest refuses. The same result for any number of threads.
/// Source: Gauss-Newton steps with constraints (docs/design/locate-solid.md, "Criteria").
[[nodiscard]] Result<SolidPlacement> most_even(const SolidProblem& problem, const SolidPlacement& from,
                                               double least_margin, double give_up,
                                               const SolidOptions& options);

}  // namespace lekalo::locate

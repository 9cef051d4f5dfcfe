#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "drawn_shapes.hpp"
#include "lekalo/geom/double_double.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/drawing/written_drawing.hpp"

namespace lekalo::io {

/// Bulges and radii lose digits of an arc, so writers put the exact numbers beside it: docs/design/
/// drawing-regions.md, "Writers".

/// How many chords the centre lies to the left of the chord's middle, if it is moved along the chord to where
/// both ends are equally far. \pre from != to
[[nodiscard]] geom::DoubleDouble level_of_centre(const geom::Edge& arc) noexcept;
/// Tangent of a quarter of the sweep of the arc whose centre is at that level, positive counter-clockwise.
[[nodiscard]] geom::DoubleDouble bulge_of_level(geom::DoubleDouble level, bool ccw) noexcept;

inline constexpr std::size_t kMostPieces = 4;
/// Arcs with a larger sweep, radians, are written in halves: a gap between their ends that is small against
/// the difference of their radii leaves no bulge that means them.
inline constexpr double kWidestPiece = 5.3;

/// The number that the curves of an arc or circle in the file do not say.
struct ExactArc {
  std::size_t first = 0, count = 1;  ///< its curves, one to kMostPieces, counted from the entity's first
  geom::EdgeKind kind = geom::EdgeKind::line;  ///< line: a circle
  geom::Point point;                           ///< the centre; of a circle, where it begins
};

/// The text of an exact arc: "3 1 ccw 12.5 -4" or, for a circle, "0 1 start 7 2".
[[nodiscard]] std::string text_of(const ExactArc& arc);
/// Reads such a text; nothing where it is none, or where a number is not is_exact.
[[nodiscard]] std::optional<ExactArc> read_exact_arc(std::string_view text);

/// Returns the exact arcs of a contour, for a file from which `curves` are read: curves_of_edge[i] of them
/// for edge i.
[[nodiscard]] std::vector<ExactArc> exact_arcs_of(const geom::Contour& contour,
                                                  const std::vector<geom::Edge>& curves,
                                                  const std::vector<std::size_t>& curves_of_edge);

/// Puts arcs in the place of their curves where they are what kWrittenArcError allows, otherwise somebody has
/// moved the curves since. `error` then bounds the distance from what the curves mean too, so that it does
/// not matter which of the two counts. Returns how many do not fit and are left out. Cost: O(curves + arcs).
[[nodiscard]] std::size_t restore_exact_arcs(std::vector<BoundedShape>& curves,
                                             const std::vector<ExactArc>& arcs);

/// Returns the notice of a drawing about arcs that do not fit.
[[nodiscard]] std::string unfit_arcs_sentence(std::size_t count, const std::string& file);

}  // namespace lekalo::io

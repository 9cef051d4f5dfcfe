#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/text/json_reader.hpp"
#include "lekalo/geom/grid_region.hpp"
#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io::detail {

/// An outline of a layout: {"polygon", "curves", "chord_tolerance"}. Curves without a polygon are given
/// chords on `side` and counted in `chords_made`.
[[nodiscard]] layout::Outline read_outline(JsonReader& reader, JsonValue value, geom::ChordSide side,
                                           std::size_t& chords_made);
void write_outline(JsonWriter& json, const layout::Outline& outline);

/// The points [x, y] of a loop that this list holds, file units times mm_per_unit; counted into `points` up
/// to kMostOutlinePoints.
[[nodiscard]] std::vector<geom::GridPoint> read_loop(JsonReader& reader, JsonValue list, double mm_per_unit,
                                                     std::size_t& points);
/// Two coordinates of an outline's point in steps.
[[nodiscard]] geom::GridPoint outline_point(JsonReader& reader, JsonValue at, JsonValue x, JsonValue y,
                                            double mm_per_unit);

/// Curves as an outline: chords on `side`, the drawing kept where it has arcs. Fails as
/// grid_region_of_curves, and for more than kMostOutlinePoints.
[[nodiscard]] Result<layout::Outline> outline_of_curves(const geom::Region& region, geom::ChordSide side,
                                                        double chord_tolerance);

}  // namespace lekalo::io::detail

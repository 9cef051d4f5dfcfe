#pragma once

#include <array>
#include <vector>

#include "draw/paper/pixels.hpp"
#include "lekalo/geom/point.hpp"
#include "shaded_mesh.hpp"
#include "space_view.hpp"

namespace lekalo::draw {

/// Returns the lines in which a surface meets the plane through the view's centre across its direction, on
/// the screen. Those of a closed surface close.
[[nodiscard]] std::vector<std::array<geom::Point, 2>> section_lines(const ShadedMesh& surface,
                                                                    const SpaceView& view);

/// The section of a part, plain, in that of a blank, hatched.
[[nodiscard]] Pixels section_picture(const ShadedMesh& part, const ShadedMesh& blank, const SpaceView& view,
                                     int columns, int rows);

}  // namespace lekalo::draw

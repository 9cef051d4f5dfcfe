#pragma once

#include <vector>

#include "lekalo/solid/vector.hpp"

namespace lekalo::draw {

/// A place on the screen: samples or pixels, y down; z is larger nearer to the viewer, in the same unit.
struct ScreenPoint {
  double x = 0, y = 0, z = 0;
};

/// A view without perspective, so that lengths across it can be compared.
struct SpaceView {
  solid::Vector right{1, 0, 0}, up{0, 0, 1}, towards{0, -1, 0};  ///< of length 1; towards the viewer
  solid::Vector centre;                                          ///< it lies at x, y on the screen
  double x = 0, y = 0;
  double scale = 1;  ///< of the screen for a millimetre

  [[nodiscard]] ScreenPoint operator()(solid::Vector p) const noexcept {
    // The centre goes first, so that solids far from the origin keep their digits.
    const solid::Vector d = p - centre;
    return {x + scale * dot(right, d), y - scale * dot(up, d), scale * dot(towards, d)};
  }
};

/// The view from a direction in which z is up; from above and below y is.
[[nodiscard]] SpaceView seen_from(solid::Vector towards);
/// Moves and scales the view so that the points fill a screen of this size but for a margin at each side.
void fit(SpaceView& view, const std::vector<solid::Vector>& points, double width, double height,
         double margin);

}  // namespace lekalo::draw

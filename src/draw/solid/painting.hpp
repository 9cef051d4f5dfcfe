#pragma once

#include <vector>

#include "draw/paper/colour.hpp"
#include "draw/paper/pixels.hpp"
#include "shaded_mesh.hpp"
#include "space_view.hpp"

namespace lekalo::draw {

/// A part within a blank of glass, as shaded pixels.

inline constexpr Colour kPlainPart{176, 190, 204}, kGlass{118, 140, 166}, kUnknownGlass{226, 160, 28};

struct PaintedPart {
  ShadedMesh surface;
  /// The place of each vertex on the scale of colours, 0 to 1, below 0 where material is missing; or none,
  /// for a part of one colour.
  std::vector<double> values;
};

struct PaintedBlank {
  ShadedMesh surface;
  /// 1 for each triangle of the surface that nobody measured; or none.
  std::vector<unsigned char> unknown;
};

/// The least of a value that counts as one on the scale, so that rounding is not shown as missing material.
inline constexpr double kLeastValue = -1e-9;
[[nodiscard]] Colour colour_of_value(double value);

struct Painting {
  Pixels pixels;
  /// True for each of the marks that the part does not hide.
  std::vector<bool> seen;
};

/// \param view   in pixels
/// \param marks  places that may be hidden
/// The same for any number of threads.
[[nodiscard]] Painting paint(const PaintedPart& part, const PaintedBlank& blank, const SpaceView& view,
                             int columns, int rows, const std::vector<solid::Vector>& marks,
                             unsigned threads);

}  // namespace lekalo::draw

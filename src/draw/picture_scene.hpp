#pragma once

#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/draw/picture.hpp"

namespace lekalo::draw {

inline constexpr Rect kPage{0, 0, 250, 160};  ///< mm of paper

/// Returns white paper with title and description, with which both kinds of pictures begin.
[[nodiscard]] Scene empty_scene(const LocatePicture& picture);

/// Returns the picture of a localisation of regions.
[[nodiscard]] Scene composed_regions(const LocatePicture& picture, const PictureOfRegions& regions);

}  // namespace lekalo::draw

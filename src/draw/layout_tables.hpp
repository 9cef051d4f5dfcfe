#pragma once

#include <vector>

#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/draw/layout_picture.hpp"

namespace lekalo::draw {

inline constexpr Rect kLayoutPage{0, 0, 297, 210};  ///< mm of paper

/// Returns pages of 297 x 210 mm with a row for every sheet in use, every part and every kit with what it
/// lacks. Nothing is left out, however many there are.
[[nodiscard]] std::vector<Scene> layout_tables(const LayoutPicture& picture);

}  // namespace lekalo::draw

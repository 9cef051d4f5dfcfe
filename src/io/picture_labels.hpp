#pragma once

#include <string>
#include <vector>

#include "picture_scene.hpp"
#include "picture_view.hpp"

namespace lekalo::io::detail {

/// A text that belongs to a point of the drawing and should stand off it in a direction.
struct Label {
  geom::Point at;       ///< paper
  geom::Point outward;  ///< direction on the paper in which there is room, any length above 0
  std::string text;
};

/// Finds places for labels within `page`, one after the other: no label covers a line of `obstacles` (closed
/// lines on paper), another label or another label's leader. A label without such a place is left out.
void place_labels(const std::vector<Label>& labels, double size, const std::vector<geom::Ring>& obstacles,
                  const Rect& page, std::vector<Item>& items);

}  // namespace lekalo::io::detail

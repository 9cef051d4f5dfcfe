#pragma once

#include <string>
#include <vector>

#include "colour.hpp"
#include "scene.hpp"
#include "view.hpp"

namespace lekalo::draw {

/// A text that belongs to a point of the drawing and should stand off it in a direction.
struct Label {
  geom::Point at;       ///< paper
  geom::Point outward;  ///< direction on the paper in which there is room, any length above 0
  std::string text;
  const char* kind = "contact-label";
  Colour colour = kInk;
  bool any_side = false;  ///< rather on another side than nowhere
};

/// Labels keep off these closed lines on paper.
struct Obstacles {
  std::vector<geom::Ring> filled;  ///< no label on the line or inside
  std::vector<geom::Ring> lines;   ///< no label on the line
};

/// Finds places for labels within `page`, one after the other, clear of the obstacles, of other labels and of
/// their leaders. A label without such a place is left out.
void place_labels(const std::vector<Label>& labels, double size, const Obstacles& obstacles, const Rect& page,
                  std::vector<Item>& items);

}  // namespace lekalo::draw

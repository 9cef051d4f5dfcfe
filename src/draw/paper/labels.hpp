#pragma once

#include <string>
#include <vector>

#include "colour.hpp"
#include "scene.hpp"
#include "view.hpp"

namespace lekalo::draw {

/// A text that belongs to a point of the drawing and should stand off it in a direction.
struct Label {
  geom::Point at;  ///< paper
  /// The direction on the paper in which there is room, of any length above 0.
  geom::Point outward;
  std::string text;
  const char* kind = "contact-label";
  Colour colour = kInk;
  /// True when the label may stand on another side, if there is no room on this one.
  bool any_side = false;
};

/// Closed lines on paper that labels keep off.
struct Obstacles {
  /// No label stands on the line or inside.
  std::vector<geom::Ring> filled;
  /// No label stands on the line.
  std::vector<geom::Ring> lines;
};

/// Finds places for labels within `page`, one after the other, clear of the obstacles, of other labels and of
/// their leaders. A label without such a place is left out.
void place_labels(const std::vector<Label>& labels, double size, const Obstacles& obstacles, const Rect& page,
                  std::vector<Item>& items);

}  // namespace lekalo::draw

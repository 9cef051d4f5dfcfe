#pragma once

#include <optional>
#include <vector>

#include "draw/paper/scene.hpp"
#include "draw/paper/view.hpp"
#include "lekalo/draw/picture.hpp"
#include "lekalo/locate/allowance.hpp"

namespace lekalo::draw {

/// The geometry of a picture in the blank's frame, and its allowance along the contour.
struct Located {
  /// `part` is the placed part, `start` the part where it lay before.
  geom::Ring blank, part, start;
  std::vector<locate::AllowanceSample>
      samples;               ///< along the placed part; empty when its vertices are too many
  std::size_t thinnest = 0;  ///< index into the samples, the first of several
  /// The point of the blank's outline that is nearest to the thinnest sample.
  geom::Point blank_at_thinnest;
  double least = 0, greatest = 0;  ///< of the samples, mm
  double low = 0, high = 0;        ///< range of the colour scale, mm, low < high
  /// An allowance of at most this size cannot be told from 0, mm.
  double rounding = 0;
  [[nodiscard]] bool sticks_out() const { return least < -rounding; }
};
[[nodiscard]] Located located(const PictureOfRings& rings, const locate::Placement& result);

/// A contact as it is drawn: from the vertex to the foot of its perpendicular on the line of the blank's
/// edge.
struct ContactLine {
  std::size_t index = 0;
  geom::Point vertex, foot;  ///< blank frame
  geom::Point edge_from, edge_to;
};
/// Returns the lines of the contacts whose indices are valid.
[[nodiscard]] std::vector<ContactLine> contact_lines(const PictureOfRings& rings, const Located& shapes);
[[nodiscard]] std::string contact_label(const PictureOfRings& rings, const locate::Contact& contact);

/// Draws the blank, the placed part, what sticks out, and the coloured band inside the part's outline, as
/// seen in `view`. Nothing is drawn outside `visible`.
void draw_shapes(const Located& shapes, const View& view, const Rect& visible, std::vector<Item>& items);
void draw_start(const Located& shapes, const View& view, const Rect& visible, std::vector<Item>& items);
void draw_contacts(const PictureOfRings& rings, const std::vector<ContactLine>& lines, const View& view,
                   const Rect& visible, std::vector<Item>& items);

}  // namespace lekalo::draw

#pragma once

#include "draw/paper/report_sheet.hpp"
#include "draw/paper/view.hpp"
#include "solid_look.hpp"

namespace lekalo::draw {

/// A contact on the page.
struct ContactMark {
  std::size_t contact = 0;
  geom::Point at;
  bool seen = true;  ///< by the viewer: the part does not hide it
};

/// The view of part and blank, moved and scaled to fill a rectangle of paper of `fine` pixels a millimetre.
[[nodiscard]] SpaceView fitted(const SolidLook& look, SpaceView view, const Rect& image, double fine);
/// Draws part and blank, and returns where the contacts are.
std::vector<ContactMark> draw_solids(const SolidLook& look, const SpaceView& fitted_view, const Rect& image,
                                     double fine, unsigned threads, Sheet& sheet);
/// Labels have this much room beside the solids, mm of paper.
inline constexpr double kContactLabel = 25;
/// Marks the contacts and writes their lengths at both sides of the frame.
void draw_contact_lengths(const SolidLook& look, std::vector<ContactMark> marks, const Rect& frame,
                          Sheet& sheet);
/// Marks the contacts with their numbers.
void draw_contact_numbers(const std::vector<ContactMark>& marks, Sheet& sheet);
/// Draws the directions of the axes from a point on.
void draw_axes(const SpaceView& view, geom::Point origin, Sheet& sheet);

/// Draws a bar of a round length, at most `most` mm of paper long, from its left end on.
/// \param scale  mm of paper for a millimetre
void draw_scale_bar(double scale, geom::Point left, double most, Sheet& sheet);

/// Draws the scale of the colours and the legend from the top of the room down. Returns where they end.
double draw_solid_key(const SolidScene& scene, const SolidLook& look, const Rect& room, Sheet& sheet);

}  // namespace lekalo::draw

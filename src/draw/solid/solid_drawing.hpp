#pragma once

#include "draw/paper/report_sheet.hpp"
#include "draw/paper/view.hpp"
#include "solid_look.hpp"

namespace lekalo::draw {

/// Draws the placed part in its blank as a view shows it, fitted to the frame, with its contacts, the axes
/// and a scale bar. `fine` pixels are painted for a millimetre of paper.
void draw_view(const SolidScene& scene, const SolidLook& look, SpaceView view, const Rect& frame, double fine,
               unsigned threads, Sheet& sheet);

/// Draws a bar of a round length, at most `most` mm of paper long, from its left end on.
/// \param scale  mm of paper for a millimetre
void draw_scale_bar(double scale, geom::Point left, double most, Sheet& sheet);

/// Draws the scale of the colours and the legend from the top of the room down. Returns where they end.
double draw_solid_key(const SolidScene& scene, const SolidLook& look, const Rect& room, Sheet& sheet);

}  // namespace lekalo::draw

#pragma once

#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/locate/placement.hpp"

#include <vector>

namespace lekalo::io {

/// Everything the picture of a localisation shows.
struct LocatePicture {
  std::string title, part_name, blank_name, method, status;
  geom::Ring part, blank;  ///< mm, each in its own frame
  locate::Placement start; ///< where the part's own coordinates put it (drawn faint); x = y = theta = 0
  bool draw_start = true;
  locate::Placement result;
  double upper_bound = 0;
  bool has_upper_bound = false;
  std::vector<locate::Contact> contacts;  ///< indices into `part` and `blank` (edge k: blank[k] to blank[k + 1])
};

/// The picture as SVG text: blank, start, result, contacts, the allowance along the contour in colour with a scale,
/// and x, y, angle, minimum allowance, bound in print. Numbers in it are the result's, never recomputed by eye.
[[nodiscard]] std::string picture_svg(const LocatePicture& picture);
/// The same picture as PNG bytes, `width_px` wide.
[[nodiscard]] Result<std::string> picture_png(const LocatePicture& picture, int width_px = 1600);

}  // namespace lekalo::io

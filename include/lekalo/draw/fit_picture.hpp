#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::draw {

/// A surface of pressed parts along the axis: a curve for each interference, from one end to the other.
struct FitPanel {
  std::string title;                             ///< UTF-8
  std::vector<std::vector<geom::Point>> curves;  ///< x: mm along the axis, y: what is drawn of it
};

struct FitPicture {
  std::string title;
  std::vector<std::string> words;  ///< of each curve, in every panel
  std::vector<FitPanel> panels;
  double hub_from = 0, hub_to = 0;  ///< the ends of the hub along the axis, mm
};

/// One page (250 x 160 mm), the panels below one another, each with a scale of its own; the hub's ends are
/// dashed. Same input, same bytes (PNG: on a machine with the same libraries and fonts).
[[nodiscard]] std::string fit_svg(const FitPicture& picture);
/// \param width_px  100 to 20000, else ErrorCode::usage; ErrorCode::environment when the drawing library
/// fails
[[nodiscard]] Result<std::string> fit_png(const FitPicture& picture, int width_px = 1600);

}  // namespace lekalo::draw

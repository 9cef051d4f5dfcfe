#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::draw {

/// A short piece of a tool's path in a pocket, and what of the tool's rim met material there.
struct PocketStretch {
  geom::Point from, to;
  double engagement_deg = 0;
  bool entry = false;  ///< down into material
};

/// Holds what a program cuts of a pocket, for a picture or an animation.
struct PocketPicture {
  std::string name;  ///< UTF-8
  /// The fragments are drawn dashed and may be empty.
  std::vector<geom::Region> pockets, unreachable, fragments;
  double tool_diameter = 0;  ///< mm
  std::vector<PocketStretch> path;
  /// Places that could be cut and are not.
  std::vector<geom::Point> uncut;
  /// Names and values that are printed beside the picture.
  std::vector<std::pair<std::string, std::string>> figures;
};

/// One page (250 x 160 mm): the pocket, the path coloured by engagement with its scale (grey: below 3
/// degrees, through what is cut; green: entry), what no tool of this size reaches hatched in red, uncut
/// places as red rings, and the figures. Same input, same bytes (PNG: on a machine with the same libraries
/// and fonts).
[[nodiscard]] std::string pocket_svg(const PocketPicture& picture);
/// \param width_px  100 to 20000, else ErrorCode::usage; ErrorCode::environment when the drawing library
/// fails
[[nodiscard]] Result<std::string> pocket_png(const PocketPicture& picture, int width_px = 1600);

/// A page that plays the cut in a browser: the tool runs, what it clears turns light, its engaged rim is
/// coloured, and a graph of the engagement along the path follows; speed, pause and a slider. One file, no
/// links. At most some 20,000 places are kept.
[[nodiscard]] std::string pocket_animation(const PocketPicture& picture);

}  // namespace lekalo::draw

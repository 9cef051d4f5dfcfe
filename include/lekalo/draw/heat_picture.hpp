#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::draw {

/// A column of a wall's places, from above downwards.
struct HeatColumn {
  geom::Point at, outward;        ///< outward: from the pocket into the workpiece, of length 1
  std::vector<double> z;          ///< mm
  std::vector<double> errors_um;  ///< above 0 where the pocket is too large; as many
};

/// The walls of a pocket, and how far heat has them off.
struct HeatPicture {
  std::string name;                   ///< UTF-8
  geom::Box stock;                    ///< the block, or the box about its outline
  std::vector<geom::Region> outline;  ///< empty for a block
  std::vector<geom::Region> pockets;
  std::vector<HeatColumn> columns;   ///< along the walls, one contour after the other
  double spacing = 0, height = 0;    ///< of places along the wall, and up it, mm
  double tool_diameter = 0;          ///< mm
  double largest_um = 0;             ///< what the colours reach to, on both sides of 0; above 0
  std::array<std::string, 2> title;  ///< lines above the drawing
  /// Names and values that are printed beside the picture.
  std::vector<std::pair<std::string, std::string>> figures;
};

/// One page (250 x 160 mm): from above the stock, the pocket, and the wall where it lies when the workpiece
/// is cold, far exaggerated; below, the walls unrolled, each place in the colour of its error. Letters say
/// which places belong together. Same input, same bytes (PNG: on a machine with the same libraries and
/// fonts).
[[nodiscard]] std::string heat_svg(const HeatPicture& picture);
/// \param width_px  100 to 20000, else ErrorCode::usage; ErrorCode::environment when the drawing library
/// fails
[[nodiscard]] Result<std::string> heat_png(const HeatPicture& picture, int width_px = 1600);

}  // namespace lekalo::draw

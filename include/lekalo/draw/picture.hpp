#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/locate/placement.hpp"
#include "lekalo/locate/region.hpp"

namespace lekalo::draw {

/// Everything the picture of a localisation shows. All numbers are finite (upper_bound may be infinite), part
/// and blank have at least three points.
struct LocatePicture {
  std::string title;
  std::string part_name, blank_name;  ///< UTF-8; of a path the last name is shown, shortened where it is long
  std::string method, status;
  geom::Ring part, blank;  ///< mm, each in its own frame
  /// Where the part lay before: by default where its own coordinates put it. Drawn faint; in an inset when it
  /// lies far away from the blank.
  locate::Placement start;
  bool draw_start = true;
  locate::Placement result;
  double upper_bound = 0;
  bool has_upper_bound = false;
  double min_allowance = 0, shortfall = 0;  ///< mm; the demand is printed when it is above 0
  std::vector<locate::Contact>
      contacts;  ///< indices into `part` and `blank` (edge k: blank[k] to blank[k + 1])
  /// The numbers printed for vertices of the part and edges of the blank (those of the files); empty:
  /// indices.
  std::vector<std::uint32_t> vertex_numbers, edge_numbers;
};

/// The same for regions of lines and arcs.
struct RegionPicture {
  std::string part_name, blank_name;
  std::string status;
  std::vector<geom::Region> part, blank;  ///< mm, each in its own frame
  locate::Placement result;
  bool mirrored = false;
  std::optional<double> upper_bound;           ///< of the clearance
  std::optional<double> margin, margin_bound;  ///< of demands by feature
  double min_allowance = 0, shortfall = 0;
  std::vector<locate::RegionTouch> contacts;
};

/// The picture as SVG text (250 x 160 mm): blank, start, result, contacts, the allowance along the contour in
/// colour with a scale, and x, y, angle, minimum allowance, bound in print. The minimum allowance is the
/// result's, rounded down to the printed digits, the bound is rounded up. Where the thinnest place is too
/// small to see, an inset magnifies it.
///
/// Same input, same bytes. Text in the generic font "sans-serif", no scripts, no links.
/// Cost: O((n + m) log n), and at most a few thousand points are written for each outline.
[[nodiscard]] std::string picture_svg(const LocatePicture& picture);
/// The same picture as PNG bytes, `width_px` wide (100 to 20000, else ErrorCode::usage). Same input, same
/// bytes on a machine with the same libraries and fonts. ErrorCode::environment when the drawing library
/// fails.
[[nodiscard]] Result<std::string> picture_png(const LocatePicture& picture, int width_px = 1600);

/// Blank and placed part with their holes, the part's outline in the colour of the allowance over it with a
/// scale, contacts, and x, y, angle, minimum allowance and bound in print. Cost: O(p log n) for p points
/// drawn.
[[nodiscard]] std::string picture_svg(const RegionPicture& picture);
[[nodiscard]] Result<std::string> picture_png(const RegionPicture& picture, int width_px = 1600);

}  // namespace lekalo::draw

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/locate/placement.hpp"

namespace lekalo::draw {

/// A convex part in a convex blank.
struct PictureOfRings {
  geom::Ring part, blank;  ///< mm, each in its own frame, at least three points
  /// Indices into `part` and `blank` (edge k: blank[k] to blank[k + 1]).
  std::vector<locate::Contact> contacts;
  /// The numbers printed for vertices of the part and edges of the blank (those of the files); empty:
  /// indices.
  std::vector<std::uint32_t> vertex_numbers, edge_numbers;
  /// The part lay here before: by default where its own coordinates put it. It is drawn faint there, or in an
  /// inset when it lies far away from the blank.
  locate::Placement start;
  bool draw_start = true;
};

/// A part in a blank, both of lines and arcs, with holes, in several pieces if need be.
struct PictureOfRegions {
  std::vector<geom::Region> part, blank;  ///< mm, each in its own frame
  std::vector<locate::Touch> contacts;
  std::optional<double> margin, margin_bound;  ///< of demands by feature
};

/// Everything the picture of a localisation shows. All numbers are finite (upper_bound may be infinite).
struct LocatePicture {
  std::string title;
  /// The names in UTF-8. Of a path the last name is shown, shortened where it is long.
  std::string part_name, blank_name;
  std::string method, status;
  std::variant<PictureOfRings, PictureOfRegions> outlines;
  locate::Placement result;
  /// True when the part is mirrored; for regions alone.
  bool mirrored = false;
  std::optional<double> upper_bound;
  /// The demand and what is missing of it, mm. The demand is printed when it is above 0.
  double min_allowance = 0, shortfall = 0;
};

/// The picture as SVG text (250 x 160 mm): blank, placed part, contacts, the allowance along the outline in
/// colour with a scale, and x, y, angle, minimum allowance, bound in print. The minimum allowance is the
/// result's, rounded down to the printed digits, the bound is rounded up. Of convex outlines the start is
/// drawn too, and where the thinnest place is too small to see, an inset magnifies it.
///
/// Same input, same bytes. Text in the generic font "sans-serif", no scripts, no links.
/// Cost: O((n + m) log n), and at most a few thousand points are written for each outline.
[[nodiscard]] std::string picture_svg(const LocatePicture& picture);
/// The same picture as PNG bytes, `width_px` wide (100 to 20000, else ErrorCode::usage). Same input, same
/// bytes on a machine with the same libraries and fonts. ErrorCode::environment when the drawing library
/// fails.
[[nodiscard]] Result<std::string> picture_png(const LocatePicture& picture, int width_px = 1600);

}  // namespace lekalo::draw

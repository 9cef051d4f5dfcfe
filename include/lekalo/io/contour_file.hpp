#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/polygon.hpp"

namespace lekalo::io {

/// The points of a contour as they stand in a file (docs/formats.md), scaled to millimetres, in file order.
struct ContourFile {
  std::string name;                  ///< as given, for messages
  LengthUnit unit = LengthUnit::millimetre;
  geom::Ring points;                 ///< mm, file order, nothing dropped
  /// Where each point stands, for messages: line number (text, DXF) or index (JSON).
  std::vector<std::size_t> places;
  /// Every coordinate is within this of the decimal in the file, mm (reading and scaling round).
  double coordinate_error = 0;
  std::vector<std::string> notices;  ///< e.g. third numbers ignored
};

/// Parses the bytes of a contour file; the ending of `name` chooses the format. `unit` is what the user said, and
/// applies where the file does not say; a file that says otherwise is refused.
[[nodiscard]] Result<ContourFile> parse_contour(std::string_view bytes, const std::string& name,
                                                std::optional<LengthUnit> unit);

/// A contour as a strictly convex counter-clockwise polygon, and the way back to the file.
struct ConvexContour {
  geom::ConvexPolygon polygon;
  std::vector<std::size_t> file_index_of_vertex;  ///< per polygon vertex
  bool reversed = false;                          ///< the file runs clockwise
  std::vector<std::size_t> dropped;               ///< file indices of duplicates and collinear points, ascending
  double coordinate_error = 0;                    ///< mm; covers reading, scaling and what dropping changed
  std::vector<std::string> notices;

  /// Index of the blank edge in file order (docs/formats.md) for polygon edge k.
  [[nodiscard]] std::size_t file_edge(std::size_t polygon_edge) const;
};

/// Drops duplicates and collinear points, turns the contour counter-clockwise and checks that it is convex.
/// Refuses, naming the vertex, anything else: fewer than three corners, no area, self-crossing, a reflex
/// corner (with its depth, and the advice to use --trim for a probed blank).
[[nodiscard]] Result<ConvexContour> make_convex(const ContourFile& file);

/// A convex polygon inside a nearly convex contour.
struct TrimmedContour {
  geom::ConvexPolygon polygon;  ///< lies inside the file's contour: no point of it is outside
  double loss = 0;              ///< largest depth cut off the convex hull, mm, rounded up
  double coordinate_error = 0;
  std::vector<std::string> notices;
};

/// Cuts inwards: every edge of the convex hull moves in by the depth of the deepest dent under it, if that depth
/// is at most `tolerance` mm; else refused, naming the deepest point. Never outwards.
[[nodiscard]] Result<TrimmedContour> trim_to_convex(const ContourFile& file, double tolerance);

}  // namespace lekalo::io

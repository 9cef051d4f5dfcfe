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

/// Most points (or LINEs) of a contour file; more are refused.
inline constexpr std::size_t kMostContourPoints = 5'000'000;

/// The points of a contour as they stand in a file (docs/formats.md), scaled to millimetres, in file order.
struct ContourFile {
  std::string name;  ///< as given, for messages
  LengthUnit unit = LengthUnit::millimetre;
  /// The points in mm, at most 1e9, in file order; none is dropped, and each number is the double nearest to
  /// its decimal.
  geom::Ring points;
  /// The place of each point, for messages: its line, 1-based (text, DXF), or its index (JSON).
  std::vector<std::size_t> places;
  bool places_are_lines = true;
  /// Every coordinate is within this of the decimal in the file, mm: half a unit in the last place of the
  /// largest coordinate that is not proved to be a double. 0 when all are. Inches are scaled as decimals.
  double coordinate_error = 0;
  std::vector<std::string> notices;  ///< e.g. third numbers ignored
};

/// Parses the bytes of a contour file; the ending of `name`, in any case, chooses the format. `unit` is what
/// the user said, and applies where the file does not say (millimetres if neither does); a file that says
/// otherwise is refused.
///
/// Fails with ErrorCode::bad_input and one sentence that names the file, the line, point or entity, what
/// stands there and the way out. Never empty: at least one point. Cost: O(bytes), O(n log n) for LINEs.
[[nodiscard]] Result<ContourFile> parse_contour(std::string_view bytes, const std::string& name,
                                                std::optional<LengthUnit> unit);

/// A contour as a strictly convex counter-clockwise polygon, and the way back to the file.
struct ConvexContour {
  geom::ConvexPolygon polygon;
  std::vector<std::size_t> file_index_of_vertex;  ///< by polygon vertex
  /// True when the file runs clockwise.
  bool reversed = false;
  /// File indices of duplicates and collinear points, ascending.
  std::vector<std::size_t> dropped;
  /// mm; covers reading, scaling and what dropping changed: the polygon's outline and the outline through all
  /// points of the file are within coordinate_error - file.coordinate_error of each other, both ways.
  double coordinate_error = 0;
  std::vector<std::string> notices;

  /// Index of the blank edge in file order (docs/formats.md) for polygon edge k.
  [[nodiscard]] std::size_t file_edge(std::size_t polygon_edge) const;
};

/// Drops duplicates and collinear points, turns the contour counter-clockwise and checks that it is convex.
/// Refuses, naming the vertex, anything else: fewer than three corners, no area, self-crossing, a reflex
/// corner (with its depth, and the advice to use --trim for a probed blank).
///
/// A point is collinear when it lies within three file.coordinate_error of the segment between the corners
/// kept around it, and the contour does not run back there: points that are collinear as decimals are,
/// whatever reading made of them. With coordinate_error 0 only exactly collinear points are.
///
/// Laws (tests/property/io_convex_test.cpp): the polygon does not depend on where the file begins, on its
/// direction, on duplicates or on exactly collinear points.
/// Cost: O(n log n).
[[nodiscard]] Result<ConvexContour> make_convex(const ContourFile& file);

/// A convex polygon inside a nearly convex contour.
struct TrimmedContour {
  /// Lies inside the file's contour, also when both are read as exact decimals (the polygon's written in
  /// shortest form): no point of it is outside.
  geom::ConvexPolygon polygon;
  /// mm, rounded up: no placement has more than this less clearance than in the convex hull of the file.
  double loss = 0;
  /// mm; between the polygon's coordinates and their shortest decimals. (Reading the file is in the loss.)
  double coordinate_error = 0;
  std::vector<std::string> notices;
};

/// Cuts inwards: every edge of the convex hull moves in by the depth of the deepest dent under it, if that
/// depth is at most `tolerance` mm; else refused, naming the deepest point. Never outwards. Refuses with
/// ErrorCode::usage a tolerance that is not finite or negative, with bad_input a contour that does not run
/// once around its hull, and one of which nothing convex is left. Cost: O(n log n).
[[nodiscard]] Result<TrimmedContour> trim_to_convex(const ContourFile& file, double tolerance);

/// Holds what a result says of a blank that was trimmed.
struct TrimRecord {
  double tolerance = 0, loss = 0;  ///< mm
  geom::Ring contour;              ///< mm, counter-clockwise
};

}  // namespace lekalo::io

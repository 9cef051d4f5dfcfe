#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/scan/scan_file.hpp"
#include "lekalo/locate/outline.hpp"

namespace lekalo::io {

/// How measured points become the outline of a blank (locate/guaranteed_blank.hpp).
struct ScanReading {
  locate::ScanOptions measurement;
  std::optional<ScanSlice> slice;
};

/// How the file of an outline is read.
struct OutlineOptions {
  /// The unit of a file that does not say its own; millimetres if neither does.
  std::optional<LengthUnit> units;
  /// The tolerances of drawings, mm, and whether they are refused rather than mended; see DrawingOptions.
  std::optional<double> join, curve, repair;
  bool strict = false;
  /// True where lines of a drawing that enclose nothing, and shapes that were set aside, may be holes if they
  /// lie within its outline: that of a part, which is then held to be larger than it is. Elsewhere material,
  /// or room to cut, would be seen where there is none, and the drawing is refused.
  bool may_lack_holes = false;
  /// The layers of drawings that count; empty for all that are shown.
  std::vector<std::string> layers;
  /// Set when the file holds measured points.
  std::optional<ScanReading> scan;
};

/// The points along a convex outline, as its file has them.
struct ContourRecord {
  /// The unit of the file.
  LengthUnit unit = LengthUnit::millimetre;
  /// The points in mm, in file order; none is dropped.
  geom::Ring points;
  /// Indices of the points that are no corners of the outline.
  std::vector<std::size_t> dropped;
  std::optional<TrimRecord> trim;
};

struct ReadOutline {
  locate::Outline outline;  ///< with regions, or convex
  /// Edges that a region file says are no walls, as they are written.
  std::vector<geom::Edge> open;
  std::vector<std::string> notices;
  std::optional<ScanRecord> scan;        ///< of a blank that was measured
  std::optional<ContourRecord> contour;  ///< of a convex outline
  std::optional<DrawingRecord> drawing;  ///< of regions that were drawn
};

/// A file of an outline in any form: regions, a tree of primitives, a drawing, points along one outline, or a
/// scan; its ending and what is in it say which. Each reader sees the bytes once, and only when its answer
/// is asked for.
class OutlineFile {
 public:
  /// \pre bytes outlive this
  OutlineFile(std::string_view bytes, std::string name, OutlineOptions options);

  /// True if the file is to be read as a convex outline: it is a convex polygon, or one that only the reader
  /// of convex outlines has the words to refuse. With `only_convex_will_do` that includes polygons that are
  /// not convex.
  [[nodiscard]] bool is_convex(bool only_convex_will_do);

  /// True for points that turn to and fro as measured ones do: at a third of them or more, the outline bends
  /// back at the next point, and by less than a right angle, which teeth and joints do not.
  [[nodiscard]] bool looks_measured();

  /// Returns the outline as regions of lines and arcs; bad_input where outlines cross or touch, with the
  /// place.
  [[nodiscard]] Result<ReadOutline> as_regions();

  /// Returns the outline as a convex polygon: points are read as make_convex says. With `trim` in mm the
  /// outline is cut inwards as trim_to_convex says, and results then number the points of the trimmed
  /// outline.
  [[nodiscard]] Result<ReadOutline> as_convex(std::optional<double> trim = {});

 private:
  enum class Form { regions, tree, drawing, points, scan };
  [[nodiscard]] Form form() const;
  Result<ReadOutline>& drawn();
  Result<ContourFile>& points();
  [[nodiscard]] Result<ReadOutline> read_points();
  [[nodiscard]] Result<ReadOutline> read_regions() const;
  [[nodiscard]] Result<ReadOutline> read_tree() const;
  [[nodiscard]] Result<ReadOutline> read_drawing() const;
  [[nodiscard]] Result<ReadOutline> read_scan() const;

  std::string_view bytes_;
  std::string name_;
  OutlineOptions options_;
  Form form_;
  std::optional<Result<ReadOutline>> drawn_;
  std::optional<Result<ContourFile>> points_;
};

/// Returns the outline in a file as regions.
[[nodiscard]] inline Result<ReadOutline> read_outline(std::string_view bytes, const std::string& name,
                                                      const OutlineOptions& options) {
  return OutlineFile(bytes, name, options).as_regions();
}

}  // namespace lekalo::io

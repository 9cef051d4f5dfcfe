#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/layout/document.hpp"
#include "lekalo/layout/workspace.hpp"

namespace lekalo::io::detail {

/// A mark of a placed part, as drawn, turned and moved in doubles.
struct PlacedMark {
  const layout::PartMark* mark = nullptr;
  geom::Contour edges;
};

/// A sheet as it is written for machines and other programs: regions of lines and arcs, mm.
///
/// A part whose drawing has arcs, and whose polygon is what its drawing gives (grid_region_of_curves, so that
/// it holds the drawing), is its drawing turned and moved: within its chord tolerance, and nowhere more than
/// 2 grid steps beyond its placed outline. Every other part is its placed outline, exactly; see
/// docs/design/export.md.
struct PlacedShape {
  const layout::Placement* placement = nullptr;
  const layout::Part* part = nullptr;
  geom::Region region;
  std::vector<geom::Region> areas;
  std::vector<PlacedMark> marks;
  std::vector<layout::PartText> texts;  ///< in the sheet's frame
  std::vector<geom::Point> grain;       ///< two ends of a line in the part along its grain, or none
  geom::Point label_at;
  double label_height = 0;  ///< 0: there is no room
  std::string label;
};
struct SheetShapes {
  layout::Sheet sheet;
  std::string name;  ///< STOCK, or STOCK#COPY where there are several
  geom::Region material;
  std::vector<geom::Region> defects, zones;
  std::vector<PlacedShape> parts;  ///< by placement, but those that lie in a hole of another first
};

/// Sheets in use by stock and copy, or the one that `sheet` names ("STOCK", "STOCK#COPY"), in use or not.
/// Fails with ErrorCode::usage for one that is not there, ErrorCode::bad_input where nothing is placed.
[[nodiscard]] Result<std::vector<layout::Sheet>> sheets_to_write(const layout::Document& document,
                                                                 const std::string& sheet);

/// Shapes of sheets; `side_by_side` puts each to the right of the one before. Parts whose drawing is not what
/// their polygon says are named in `notes`.
[[nodiscard]] std::vector<SheetShapes> sheet_shapes(const layout::Document& document,
                                                    const std::vector<layout::Sheet>& sheets,
                                                    bool side_by_side, std::vector<std::string>& notes);

}  // namespace lekalo::io::detail

#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lekalo/geom/polygon.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"

namespace lekalo::io {

/// Closed lines that are engraved, not cut, by the rules of docs/design/drawing.md, "Engraving".
struct Engraved {
  struct Line {
    geom::Contour contour;
    std::uint32_t curve = 0;  ///< its first, into Drawing::curves
  };
  std::vector<Line> lines;
  /// The regions that are left, and for every edge the curve it came from.
  std::vector<geom::Region> regions;
  std::vector<std::uint32_t> curve_of_edge;
  /// For every region of before: its number now, or kNoRegion.
  std::vector<std::uint32_t> new_number;
  /// A sentence where parts lie in holes of another colour or layer, which may be engraving that no rule
  /// sees; else empty.
  std::string doubt;
};
inline constexpr std::uint32_t kNoRegion = 0xffffffff;

/// Takes the engraving out of the regions of a drawing. Cost: O(n log n), and the cut-outs of a
/// plate that may be letters times those that are.
/// \param said_to_be_cut  by layer: no closed line there is engraving, whatever it looks like
[[nodiscard]] Engraved without_engraving(const Drawing& drawing, const DrawnRegions& drawn,
                                         const std::vector<bool>& said_to_be_cut);

/// Numbers the innermost region within whose outer contour a point lies, kNoRegion where there is none.
class RegionsAround {
 public:
  explicit RegionsAround(const std::vector<geom::Region>& regions);
  [[nodiscard]] std::uint32_t innermost(geom::Point p) const;

 private:
  struct Outer {
    geom::Box box;
    double area = 0;
    geom::RegionIndex index;
  };
  std::vector<Outer> outers_;
};

}  // namespace lekalo::io

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::io {

/// The regions of a file in the JSON form of docs/design/geometry.md, in millimetres and normal direction.
struct RegionFile {
  std::string name;                          ///< as given, for messages
  LengthUnit unit = LengthUnit::millimetre;  ///< of the file
  std::vector<geom::Region> regions;         ///< one, or several pieces; never empty
  /// Every coordinate is within this of the decimal in the file, mm (reading and scaling round).
  double coordinate_error = 0;
};

/// Parses the bytes of a region file: `{"units", "outer": [edges], "holes" or "islands": [[edges], ...]}`, or
/// `{"units", "pieces": [{"outer", "holes"}, ...]}`. `unit` is what the user said, and applies where the file
/// does not say (millimetres if neither does); a file that says otherwise is refused.
///
/// Fails with ErrorCode::bad_input, naming file, piece, contour, edge and number. A word it does not know is
/// refused, never skipped: a hole under a misspelt key would be cut as material.
/// \param open  of pockets: gets the edges with `"open": true`, as they are written; else the word is refused
[[nodiscard]] Result<RegionFile> parse_regions(std::string_view bytes, const std::string& name,
                                               std::optional<LengthUnit> unit = std::nullopt,
                                               std::vector<geom::Edge>* open = nullptr);

/// The same form in millimetres, one edge a line; every number is the shortest decimal that reads back to the
/// same double. Law: parse_regions(regions_json(r)) gives r, for regions made by make_region.
/// \pre regions is not empty
/// \param open  edges of them that are to be said open
[[nodiscard]] std::string regions_json(const std::vector<geom::Region>& regions,
                                       const std::vector<geom::Edge>& open = {});

}  // namespace lekalo::io

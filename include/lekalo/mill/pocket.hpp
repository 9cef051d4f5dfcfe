#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/region.hpp"

namespace lekalo::mill {

struct PocketOptions {
  double tool_diameter = 6;   ///< mm
  double step_over = 0.4;     ///< part of the diameter, in (0, 0.5]
  double stock_to_leave = 0;  ///< mm
  double depth = 1;           ///< mm, above 0; one level
  double feed = 1500;         ///< mm/min, in the cut
  double link_feed = 5000;    ///< mm/min, at depth through what is cut already
  double plunge_feed = 300;   ///< mm/min
  double safe_height = 5;     ///< mm above the stock
  double ramp_angle = 0.05;   ///< rad, of the helix
};

/// One straight motion of the tool's middle to a place.
struct PathMove {
  enum class Kind { rapid, plunge, helix, cut, link };
  Kind kind = Kind::cut;
  geom::Point to;
  double z = 0;
};

struct PocketPath {
  std::vector<PathMove> moves;
  std::size_t fronts = 0;  ///< curves of equal arrival that were cut
};

/// A path that clears what the tool can reach of the pockets, by fronts: the places the tool's middle may be
/// are reached from an entry in steps that hold the engagement, and each step's boundary is cut, one way then
/// the other. docs/design/pocket.md says how and what it does not do yet.
///
/// bad_input for options out of range and where the tool fits nowhere.
[[nodiscard]] Result<PocketPath> pocket_path(const std::vector<geom::Region>& pockets,
                                             const PocketOptions& options);

/// The path as an RS-274 program: metric, absolute, XY plane, feeds on change.
[[nodiscard]] std::string program_of(const PocketPath& path, const PocketOptions& options);

}  // namespace lekalo::mill

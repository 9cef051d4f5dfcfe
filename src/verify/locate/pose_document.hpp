#pragma once

#include <optional>
#include <string>
#include <vector>

#include "demand_check.hpp"
#include "verify/pocket/program_check.hpp"
#include "verify/read/json.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {

/// The fields of a result for regions, which boxes of poses prove (docs/formats.md).

struct WrittenTouch {
  /// Numbers of edges through all pieces, each outer contour before its holes.
  std::size_t part_edge = 0, blank_edge = 0;
  Vec part, blank;
  double distance = 0, multiplier = 0;
};

struct RegionDocument {
  std::string status;
  Decimal x, y, theta, theta_deg;
  bool mirrored = false;
  Span clearance, upper_bound, gap, min_allowance, shortfall, part_tolerance, blank_tolerance;
  Decimal min_allowance_as_written, shortfall_as_written;
  /// True if there is an upper_bound or gap beside demands, although the margin has the bound then.
  bool bound_beside_demands = false;
  std::string mirror;
  Decimal window_from, window_to;
  Shape part, blank;
  std::vector<WrittenTouch> contacts;
  bool in_file = false;
  std::optional<Decimal> locked_x, locked_y;
  std::optional<WrittenDemands> demands;
  bool part_cut = false;
  Json scan, part_drawing, blank_drawing;
  std::optional<WrittenNc> nc;
};

[[nodiscard]] RegionDocument read_region_document(Json root, std::string& complaint);

/// Returns a field that is true or false, and complains of every other, because different readers would take
/// it differently.
[[nodiscard]] bool truth_of(Fields& fields, std::string_view key);

}  // namespace lekalo::verify

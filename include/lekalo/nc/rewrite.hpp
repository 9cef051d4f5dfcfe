#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/pose.hpp"

namespace lekalo::nc {

/// Rewrites an ISO 6983 / RS-274 program from the part's frame into the frame in which the blank was measured.
/// docs/design/nc-rewrite.md has the white list of words, the rule for each and the bound of the rounding.

enum class RewriteMode {
  coordinates,  ///< X Y I J of every motion turned and shifted; every other byte unchanged
  offset,       ///< LinuxCNC: one `G10 L2 P. X. Y. R.` before the first motion, the program unchanged
  g68           ///< Fanuc: local shift and G68 rotation before the first motion, cancelled at the end
};

/// The frame in which the probe reported the blank.
enum class ScanFrame {
  machine,  ///< machine coordinates (G53)
  wcs       ///< the work coordinate system that the program runs in
};

struct RewriteOptions {
  RewriteMode mode = RewriteMode::coordinates;
  ScanFrame scan_frame = ScanFrame::machine;
  int work_offset = 1;  ///< 1..9: G54 .. G59.3, the one that the program runs in
};

struct Rewritten {
  std::string program;             ///< the new program, same line ends
  /// No programmed point of the path lies further than this from its exact place, mm: what rounding to the
  /// written decimals can do. Take it off the clearance.
  double rounding_mm = 0;
  std::size_t motions = 0;         ///< blocks whose coordinates were rewritten, or stand under the rotation
  std::vector<std::string> notes;  ///< what the operator must know: frame, offset to set, decimals
};

/// Passes only words on the white list; anything else, and anything whose meaning would change under the motion,
/// is ErrorCode::program_refused with `name:line: reason`. The pose's exact angle is `theta`, its shift (x, y) in mm.
[[nodiscard]] Result<Rewritten> rewrite_program(std::string_view program, const std::string& name, double x, double y,
                                                double theta, const RewriteOptions& options);

}  // namespace lekalo::nc

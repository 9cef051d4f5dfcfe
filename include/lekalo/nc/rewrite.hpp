#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/nc_words.hpp"
#include "lekalo/base/units.hpp"

namespace lekalo::nc {

/// Rewrites an ISO 6983 / RS-274 program from the part's frame into the frame in which the blank was
/// measured. docs/design/nc-rewrite.md has the white list of words, the rule for each and the bound of the
/// rounding.

enum class RewriteMode {
  coordinates,  ///< X Y I J, and heights, of every motion turned and shifted; every other byte unchanged
  offset,       ///< LinuxCNC: one `G10 L2 P. X. Y. (Z.) R.` before the first motion, the program unchanged
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
  /// The work offset that the program runs in, 1..9 for G54 .. G59.3.
  int work_offset = 1;
  /// The unit until the program's first G20 or G21. Only programs that name none use it, with a note.
  LengthUnit start_unit = LengthUnit::millimetre;
  /// Decimals of a degree in `G68 R`, 0..9. Controls of increment system IS-B drop what is finer than 0.001
  /// degree, and the dropped angle would be in no bound.
  int g68_angle_decimals = 3;
  /// Arcs of G18 and G19, which do not stay in their plane when turned, become chords that stay within this
  /// of them, mm, 1e-5 to 1.
  double chord_tolerance = 1e-3;
  /// The control in whose language the program is. Without one it is guessed, and a note says so.
  std::optional<words::Control> control = {};
  /// M words that a shop allows beside those of the list: they move no axis.
  std::vector<int> allowed_m = {};
  /// A solid's program is shifted by this along Z too, mm; it counts as exact. Then whatever cuts has to be
  /// at a height that the program says.
  std::optional<double> z = {};
};

struct Rewritten {
  std::string program;  ///< the new program, same line ends
  /// No point of the programmed path lies further than this from its exact place, mm: rounding to the written
  /// decimals can do no more. Callers take it off the clearance.
  double rounding_mm = 0;
  /// The blocks whose coordinates were rewritten, or stand under the rotation.
  std::size_t motions = 0;
  /// Sentences for the operator: frame, offset to set, decimals.
  std::vector<std::string> notes;
  /// The control as whose program it was read.
  words::Control control = words::Control::linuxcnc;
};

/// Rewrites a program by the pose `p -> R(theta) p + (x, y, options.z)`, R about Z, the shift in mm; theta,
/// x and y count as exact.
///
/// \param name  the name of the program, for messages.
/// \return      passes only words on the white list. Anything else, and anything whose meaning would change
///              under the motion, is ErrorCode::program_refused with `name:line: reason`. ErrorCode::usage
///              when the pose is not finite or beyond 10^6 mm or geom::kMaxAngle, an option is out of range,
///              or the mode cannot serve the scan frame.
///
/// Properties (tests/property/nc_rewrite_test.cpp):
///   (1) coordinates: as many lines as before, and what is neither X Y I J of a motion, a height that z
///       shifts, nor supplied for a motion is byte for byte the same;
///   (2) the identity pose in mode coordinates changes no byte;
///   (3) every programmed point of the result lies within rounding_mm of the pose applied to its original.
///
/// Cost: O(bytes), a few passes when arcs need more decimals.
[[nodiscard]] Result<Rewritten> rewrite_program(std::string_view program, const std::string& name, double x,
                                                double y, double theta, const RewriteOptions& options);

}  // namespace lekalo::nc

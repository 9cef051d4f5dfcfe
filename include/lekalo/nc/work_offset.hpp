#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lekalo::nc {

/// The lines that set work offset and rotation for a part that lies anywhere, in the words of a control.
/// docs/design/nc-offset.md quotes the manual of each. A control without such a source is not offered.

enum class OffsetControl : unsigned char {
  linuxcnc,  ///< `G10 L2 P. X. Y. Z. R.`; turns about Z alone
  fanuc,     ///< `G68 X. Y. Z. I. J. K. R.`, the three-dimensional coordinate conversion
  siemens    ///< `TRANS X. Y. Z.` and `AROT X. Y. Z.`
};
inline constexpr std::array<std::string_view, 3> kOffsetControls{"linuxcnc", "fanuc", "siemens"};

struct OffsetForm {
  OffsetControl control = OffsetControl::linuxcnc;
  /// The work offset that the words set, or act on: 1 is G54. Up to 9 for LinuxCNC, 6 for Fanuc, 4 for
  /// Siemens.
  int work_offset = 1;
  /// The decimals of a degree and of a millimetre that the control takes, 0 to 6.
  int angle_decimals = 3, length_decimals = 3;
};

/// A rotation that the control's words can say. Numbers count the last decimal.
struct OffsetTurn {
  /// The rotation that the words make, of length 1 within 1e-15.
  std::array<double, 4> quaternion{1, 0, 0, 0};
  /// LinuxCNC: R, 0, 0. Fanuc: R, 0, 0, about `axis`. Siemens: about X, Y, Z.
  std::array<long long, 3> angles{};
  std::array<long long, 3> axis{0, 0, 1};  ///< Fanuc: I, J, K
};

/// The rotations next to this one that the words can say: each angle rounded up and down. Empty where the
/// control has no words for it, as LinuxCNC for a tilt.
[[nodiscard]] std::vector<OffsetTurn> written_turns(const std::array<double, 4>& quaternion,
                                                    const OffsetForm& form);

/// The lines, each with its end. \param shift  counts the last decimal of a length
[[nodiscard]] std::string offset_lines(const OffsetTurn& turn, const std::array<long long, 3>& shift,
                                       const OffsetForm& form, const std::vector<std::string>& sentences);

}  // namespace lekalo::nc

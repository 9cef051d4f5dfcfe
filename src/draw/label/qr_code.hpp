#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::draw {

/// The light margin that readers need around a code, in modules (ISO/IEC 18004).
inline constexpr int kQuietModules = 4;

/// A QR code as rows of square modules from the top, without its light margin.
struct QrCode {
  int version = 1;  ///< 1 to 40
  int modules = 0;  ///< on each side: 17 + 4 * version
  std::vector<bool> dark;

  [[nodiscard]] bool at(int row, int column) const {
    return dark[static_cast<std::size_t>(row) * static_cast<std::size_t>(modules) +
                static_cast<std::size_t>(column)];
  }
};

/// The code of a text, in the lowest version from `least_version` on that holds it at level M (15 % of it may
/// be unreadable), and in that version at the highest level that still holds it. The same text gives the same
/// code. ErrorCode::environment where lekalo was built without the library that makes them.
/// \param text  ASCII, not empty, at most 40 characters; capitals, digits and $%*+-./: take the least room
[[nodiscard]] Result<QrCode> qr_code(const std::string& text, int least_version = 1);

}  // namespace lekalo::draw

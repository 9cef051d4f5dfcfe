#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/geom/point.hpp"

namespace lekalo::io {

/// A LINE of a drawing, mm.
struct DxfLine {
  std::array<geom::Point, 2> ends;
  std::size_t line = 0;  ///< in the file, for messages
  std::string layer;
};

/// A line of a chain and the end at which it is entered.
struct ChainLink {
  std::size_t line = 0, entered_at = 0;
};

/// Orders LINEs into one closed chain (docs/formats.md): begins with the first, each next is the unused one
/// with an end nearest to the current end, at most `reach` mm away; among equals the first in the file. Fails
/// with ErrorCode::bad_input when the chain breaks, does not close or leaves lines over. Cost: O(n log n).
/// \pre lines is not empty
[[nodiscard]] Result<std::vector<ChainLink>> chain_lines(const std::vector<DxfLine>& lines, double reach,
                                                         const std::string& name);

}  // namespace lekalo::io

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "profile_moves.hpp"
#include "verify/drawn/line_match.hpp"
#include "verify/drawn/placed_sheet.hpp"

namespace lekalo::verify {

/// Tells engravings of a program from its cuts: they follow lines and texts of the layout, and nothing else.
class EngravedMarks {
 public:
  /// \pre the sheet outlives this
  explicit EngravedMarks(const PlacedSheet& sheet);

  /// Says whether every edge of a chain lies on the marks that may be engraved, and counts it then.
  [[nodiscard]] bool follows(const CutChain& chain);
  /// A sentence about how many marks are engraved all along; empty where the layout has none.
  [[nodiscard]] std::string note() const;

 private:
  const PlacedSheet& sheet_;
  EdgeSet marks_;
  std::vector<DrawnLine> chains_;
};

}  // namespace lekalo::verify

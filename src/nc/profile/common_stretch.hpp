#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "profile_path.hpp"

namespace lekalo::nc {

/// A straight stretch on which the paths round two parts are one line: edges of the two face each other at
/// one kerf (docs/design/common-line.md, step 1).
struct CommonStretch {
  std::array<std::size_t, 2> cuts{};  ///< the outlines that have it
  /// As the path of the first has it, in the direction of that path.
  WrittenEdge edge;
};

/// The path round a part, divided where its common stretches begin and end.
struct DividedOutline {
  struct Piece {
    std::size_t stretch = 0;
    WrittenEdge edge;              ///< the stretch as this path has it
    std::vector<WrittenEdge> run;  ///< what is the part's own up to the next stretch; may be empty
  };
  std::size_t cut = 0;
  std::vector<Piece> pieces;  ///< round about, at least one
};

struct CommonStretches {
  std::vector<CommonStretch> stretches;
  std::vector<DividedOutline> outlines;  ///< of the cuts that have a stretch, ascending
  double length_mm = 0;
};

/// Finds the stretches of at least a kerf on which two outlines are one line within the tolerance.
/// Cost: O(n log n) of the edges and pairs whose boxes meet.
[[nodiscard]] CommonStretches common_stretches(const std::vector<Cut>& cuts, const ProfileOptions& options);

}  // namespace lekalo::nc

#pragma once

#include <vector>

#include "profile_path.hpp"
#include "profile_proof.hpp"

namespace lekalo::nc {

/// A place where a cut may begin.
struct Start {
  std::vector<WrittenEdge> lead;  ///< one edge, or none: pierced on the contour
  std::size_t edge = 0;           ///< the path begins at the first point of this edge
  WrittenPoint pierce, on_contour;
};

/// The starts of one cut.
struct Starts {
  std::vector<Start> choices;  ///< never empty; all with leads of one length, or none with a lead
  double lead_mm = 0;          ///< their length; 0 where there was no room
};

/// Step 5 of docs/design/export.md: the longest leads, of full, half or a quarter of `lead_in_mm`, that stay
/// out of every part. They come from the waste side, at up to kMostStarts places spread over the path. New
/// edges begin in the middle of long ones, which changes `path`, as a curve, by rounding alone.
inline constexpr std::size_t kMostStarts = 12;
[[nodiscard]] Starts starts_of(std::vector<WrittenEdge>& path, double lead_in_mm, const KerfProof& proof,
                               const ProfileOptions& options);

}  // namespace lekalo::nc

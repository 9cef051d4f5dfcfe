#pragma once

#include <vector>

#include "profile_path.hpp"
#include "profile_proof.hpp"

namespace lekalo::nc {

/// Where a cut may begin.
struct Start {
  std::vector<WrittenEdge> lead;  ///< one edge, or none: pierced on the contour
  std::size_t edge = 0;           ///< of the path, which begins at its first point
  WrittenPoint pierce, on_contour;
};

/// The starts of one cut.
struct Starts {
  std::vector<Start> choices;  ///< never empty; all with leads of one length, or none with a lead
  double lead_mm = 0;          ///< of these; 0 where there was no room
};

/// The longest leads of full, half and a quarter of the length that stay out of every part, from the waste
/// side, at up to kMostStarts places spread over the path. Begins new edges in the middle of long ones, so
/// `path` changes, as a curve, by rounding alone.
inline constexpr std::size_t kMostStarts = 12;
[[nodiscard]] Starts starts_of(std::vector<WrittenEdge>& path, const KerfProof& proof,
                               const ProfileOptions& options);

}  // namespace lekalo::nc

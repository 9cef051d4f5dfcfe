#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "lekalo/base/error.hpp"
#include "profile_leads.hpp"

namespace lekalo::nc {

/// The joints of all cuts, and where each stretch between two of them begins.
struct JointedCuts {
  /// By cut: the starts behind its joints, one for each; empty for a cut without joints.
  std::vector<std::vector<Start>> starts;
  std::vector<JointGround> grounds;
  std::size_t parts = 0;
  std::vector<std::uint64_t> unheld;  ///< see ProfileProgram
};

/// Fails with ErrorCode::usage for joints out of their ranges, or without what they need.
[[nodiscard]] Result<void> check_joints(const ProfileOptions& options);

/// Places joints on outlines (docs/design/micro-joints.md) and marks them in the paths: the edges of a joint
/// are those with WrittenEdge::joint, and each begins and ends a stretch that is cut.
///
/// Fails with ErrorCode::bad_input where a part has no room for the joints that it needs, naming all such
/// parts.
[[nodiscard]] Result<JointedCuts> place_joints(const std::vector<ProfilePart>& parts, std::vector<Cut>& cuts,
                                               const std::vector<std::size_t>& enclosing,
                                               const Surroundings& around, const ProfileOptions& options);

}  // namespace lekalo::nc

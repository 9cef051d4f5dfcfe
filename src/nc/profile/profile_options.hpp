#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/nc/profile.hpp"
#include "profile_order.hpp"

namespace lekalo::nc {

/// Fails with ErrorCode::usage for a value out of its range; NaN is out of every range.
[[nodiscard]] Result<void> check_range(const std::string& what, double value, double low, double high);

/// Fails with ErrorCode::usage for a pierce, a spread of heat or joints that the other options do not allow.
[[nodiscard]] Result<void> check_pierce_and_order(const ProfileOptions& options);

/// Fails with ErrorCode::usage for common lines beside what does not go with them.
[[nodiscard]] Result<void> check_common_line(const ProfileOptions& options);

/// Fails with ErrorCode::bad_input where a cut has no start, naming all such cuts.
[[nodiscard]] Result<void> check_pierces(const std::vector<ProfilePart>& parts, const std::vector<Cut>& cuts,
                                         const std::vector<Starts>& starts, const ProfileOptions& options);

/// Counts the leads that meet the kerf of an earlier cut. With a stated diameter of pierces it fails instead,
/// naming all such cuts with the earlier ones.
/// \param met  settle_starts() of this order
[[nodiscard]] Result<void> check_crossings(const std::vector<ProfilePart>& parts,
                                           const std::vector<Cut>& cuts, const std::vector<OrderedCut>& order,
                                           const std::vector<std::optional<std::size_t>>& met,
                                           const ProfileOptions& options, ProfileProgram& program);

/// Counts the cuts that begin nearer to the cut before than the spread of heat that is asked for.
void tell_heat(const std::vector<Starts>& starts, const std::vector<OrderedCut>& order,
               const KerfsAround& kerfs, const ProfileOptions& options, ProfileProgram& program);

/// The numbers of the placements that have a cut in common.
[[nodiscard]] std::string placements_of(const std::vector<ProfilePart>& parts, const Cut& cut,
                                        const char* between);
/// "the outline of placement 3", "hole 2 of placement 3".
[[nodiscard]] std::string name_of_cut(const std::vector<ProfilePart>& parts, const Cut& cut);

}  // namespace lekalo::nc

#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"

// The rules by which results of a localisation are handed out, in the plane and in space.

namespace lekalo::jobs {

/// The proofs of up to this many intervals or boxes stand in the result itself.
inline constexpr std::size_t kInlineProof = 10'000;

/// A warning about the name of a file that cannot stand in a result as it is.
[[nodiscard]] std::optional<std::string> warning_of_name(const std::string& name);

/// Holds the checker's word on a result against the verdict that it has to have. Claims that the checker
/// leaves open, which a note of it names, are no reason to withhold a result.
[[nodiscard]] Result<void> held_against(const Result<verify::LocateReport>& report, verify::Verdict wanted);

}  // namespace lekalo::jobs

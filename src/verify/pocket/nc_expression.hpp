#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace lekalo::verify {

/// The variables that a program has set so far, by `12` or `<NAME>`. In a subprogram, with `globals_only`,
/// those below #100 and names without `_` are not understood.
using NcVariables = std::map<std::string, double, std::less<>>;

/// Computes the number at `at`, which `#`, `[` or a sign before them begins, and moves `at` behind it. Angles
/// are in degrees. None where it cannot be computed; then `complaint` says why.
[[nodiscard]] std::optional<double> computed(std::string_view text, std::size_t& at,
                                             const NcVariables& variables, bool globals_only,
                                             std::string& complaint);

/// Carries out `#1 = 2` or `#1 = #2 + 3`; false where the line is not such an assignment.
[[nodiscard]] bool assign(std::string_view text, NcVariables& variables, bool globals_only,
                          std::string& complaint);

}  // namespace lekalo::verify

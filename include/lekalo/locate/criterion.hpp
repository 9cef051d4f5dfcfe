#pragma once

#include <span>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::locate {

class Choice;  // src/locate/region/choice.hpp: what a criterion may ask and do

/// How one placement is chosen of those whose margin is nearly the largest. docs/design/extending.md shows
/// how a criterion is added.
struct Criterion {
  std::string_view name;     ///< the word that chooses it, also in results: small letters and dashes
  std::string_view favours;  ///< the allowance or placement that it goes on to, for help: "the most even"
  /// Goes on from the placement with the largest margin; nullptr: that one is the answer.
  Result<void> (*choose)(Choice& choice) = nullptr;
};

/// The list of all criteria, in the order in which help shows them. The first one is taken if none is chosen;
/// it is the only one that does not go on.
[[nodiscard]] std::span<const Criterion> criteria() noexcept;

/// The criterion of this name; none: nullptr.
[[nodiscard]] const Criterion* criterion_named(std::string_view name) noexcept;

/// The names of all criteria in one text.
[[nodiscard]] std::string criterion_names(std::string_view separator);

}  // namespace lekalo::locate

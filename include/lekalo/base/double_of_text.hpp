#pragma once

#include <optional>
#include <string_view>

namespace lekalo {

/// The double nearest to a decimal: [-] digits [. digits] [e|E [+|-] digits], a digit before or after the
/// point. None for any other text, for what is beyond doubles, and for what is not 0 and rounds to it. The
/// locale does not matter. Cost: O(text).
[[nodiscard]] std::optional<double> double_of_text(std::string_view text);

}  // namespace lekalo

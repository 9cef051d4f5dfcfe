#pragma once

#include <string_view>

namespace lekalo {

/// The answer says whether the bytes are UTF-8 without control characters (C0, DEL, C1). Cost: O(bytes).
[[nodiscard]] bool is_plain_text(std::string_view bytes) noexcept;

}  // namespace lekalo

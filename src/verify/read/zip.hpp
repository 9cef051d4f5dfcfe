#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace lekalo::verify {

/// Unpacks one file of a ZIP archive that is stored or deflated (RFC 1951), found by the directory at the
/// archive's end by its name in any case. Returns nothing where there is none, or it is damaged by its sum,
/// packed in another way, or of sizes beyond limits.hpp.
[[nodiscard]] std::optional<std::string> unzip(std::string_view archive, std::string_view name);

/// Inflates a deflated text of this many bytes; nothing for any other.
[[nodiscard]] std::optional<std::string> inflated(std::string_view packed, std::size_t size);

}  // namespace lekalo::verify

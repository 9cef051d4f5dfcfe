#pragma once

#include <string>
#include <string_view>

namespace lekalo::draw {

/// The bytes as RFC 4648 writes them, with padding: letters that need no escape in JSON, XML or an address.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace lekalo::draw

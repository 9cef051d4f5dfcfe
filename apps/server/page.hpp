#pragma once

#include <string>

#include "api.hpp"

namespace lekalo::server {

/// A file of the page, out of the binary; "/" is its index. \param path  of the request
[[nodiscard]] ApiAnswer answer_page(const std::string& method, const std::string& path);

}  // namespace lekalo::server

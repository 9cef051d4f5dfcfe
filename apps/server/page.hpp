#pragma once

#include <string>

#include "api.hpp"

namespace lekalo::server {

/// Answers with a file of the page, which is part of the binary; "/" is its index.
/// \param path  of the request
[[nodiscard]] ApiAnswer answer_page(const std::string& method, const std::string& path);

}  // namespace lekalo::server

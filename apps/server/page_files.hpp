#pragma once

#include <map>
#include <string_view>

namespace lekalo::server {

/// The files of the page by their paths ("/index.html"), compiled in.
[[nodiscard]] const std::map<std::string_view, std::string_view>& page_files();

}  // namespace lekalo::server

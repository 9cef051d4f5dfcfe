#pragma once

#include <map>
#include <string_view>

namespace lekalo::draw {

/// The files of the folder `heat_page`, by name, compiled in.
[[nodiscard]] const std::map<std::string_view, std::string_view>& heat_page_files();

}  // namespace lekalo::draw

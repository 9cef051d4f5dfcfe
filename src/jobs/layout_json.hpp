#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "lekalo/jobs/layout.hpp"

namespace lekalo::jobs {

using Json = nlohmann::ordered_json;

/// The members that the JSON of every job on a layout begins with.
[[nodiscard]] Json begin_layout_json(const char* format, const std::string& status, const Layout& layout);
/// Indented, with a line end; bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string dumped(const Json& json);

}  // namespace lekalo::jobs

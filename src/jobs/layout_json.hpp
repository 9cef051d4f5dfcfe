#pragma once

#include <cstdint>
#include <string>

#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/jobs/layout.hpp"

namespace lekalo::jobs {

/// The JSON of a job on a layout with the fields that it begins with; its object is open.
[[nodiscard]] io::JsonWriter begin_layout_json(const char* format, const std::string& status,
                                               const Layout& layout, std::uint64_t seed, std::uint64_t work);

}  // namespace lekalo::jobs

#pragma once

#include <cstdint>
#include <string>

#include "lekalo/io/text/json_writer.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/jobs/nest.hpp"

namespace lekalo::jobs {

/// The JSON of a job on a layout with the fields that it begins with; its object is open.
[[nodiscard]] io::JsonWriter begin_layout_json(const char* format, const std::string& status,
                                               const Layout& layout, std::uint64_t seed, std::uint64_t work);

/// Writes what is not placed as the field "unplaced" of an object that is open.
void write_unplaced(io::JsonWriter& json, const Nested& nested);

}  // namespace lekalo::jobs

#pragma once

#include "lekalo/io/locate/solid_result_json.hpp"
#include "lekalo/io/text/json_writer.hpp"

namespace lekalo::io {

/// Writes what is said of touches as results have it (docs/formats.md), where a value is due. Numbers stand
/// in the shortest form that reads back to the same double. \pre every number is finite
void write_touches(JsonWriter& json, const SolidTouchRecord& touches);

}  // namespace lekalo::io

#pragma once

#include <initializer_list>
#include <optional>

#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/text/json_writer.hpp"

// The form that all results of a localisation have: each field of the document on a line of its own.

namespace lekalo::io::detail {

inline JsonWriter& line_of(JsonWriter& json, const char* key) { return json.line(2).key(key); }

inline void lines(JsonWriter& json, std::initializer_list<JsonField> fields) {
  for (const JsonField& one : fields) json.line(2).field(one.key, one.value);
}

/// A list with a line for each item, which `write_item` writes.
template <class Items, class WriteItem>
void list_of_lines(JsonWriter& json, const Items& items, const WriteItem& write_item) {
  json.list_of_lines(items, 4, 2, write_item);
}

/// Writes what became of a program, or null.
void write_nc(JsonWriter& json, const std::optional<NcRecord>& nc);

}  // namespace lekalo::io::detail

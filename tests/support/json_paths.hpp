#pragma once

// Every place of a document in turn, for tests that change each.

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <initializer_list>
#include <string>

#include "support/json.hpp"

namespace lekalo::cases {

inline bool is_number(const Json& value) {
  try {
    return (void)value.get<double>(), true;
  } catch (const std::exception&) {
    return false;
  }
}

/// Calls each(path) for every field and item, of lists for the first, the second and the last.
inline void each_path(const Json& value, const std::string& path,
                      const std::function<void(const std::string&)>& each) {
  if (!path.empty()) each(path);
  if (value.is_object()) {
    for (const std::string& key : value.keys()) each_path(value[key], path + "/" + key, each);
  } else if (value.is_array()) {
    for (std::size_t i = 0; i < value.size(); ++i)
      if (i < 2 || i + 1 == value.size()) each_path(value[i], path + "/" + std::to_string(i), each);
  }
}

/// Says whether a path has one of these parts.
inline bool one_of(const std::string& path, std::initializer_list<const char*> parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const char* part) { return path.find(part) != path.npos; });
}

}  // namespace lekalo::cases

#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "support/json.hpp"

/// Changes of a file that was written, one at a time: every number moved by its last place and by its sign,
/// every text and truth, every member and item taken out, neighbours exchanged, every line of a text.
namespace lekalo::test {

using cases::Json;

struct Lie {
  std::string path;  ///< "/inputs/0/sha256", or "line 7"
  const char* how = "";
  std::function<std::string()> bytes;
};

/// Moves a number by what its file counts as the last place.
using LastPlace = std::function<double(double)>;
inline double next_double(double value) { return std::nextafter(value, 1e300); }

namespace detail {

inline bool is_number(const std::string& text) {
  return !text.empty() && (text[0] == '-' || (text[0] >= '0' && text[0] <= '9'));
}

inline void walk(const Json& at, const std::string& path,
                 const std::function<void(const Json&, const std::string&)>& visit) {
  visit(at, path);
  if (at.is_object())
    for (const std::string& key : at.keys()) walk(at[key], path + "/" + key, visit);
  if (at.is_array())
    for (std::size_t i = 0; i < at.size(); ++i) walk(at[i], path + "/" + std::to_string(i), visit);
}

}  // namespace detail

/// All changes of a JSON document.
inline std::vector<Lie> lies_of_json(const std::string& text, const LastPlace& last_place = next_double) {
  const auto tree = std::make_shared<const Json>(Json::parse(text));
  std::vector<Lie> lies;
  const auto put = [&](const std::string& path, const char* how, Json value) {
    lies.push_back({path, how, [tree, path, value] {
                      Json changed = *tree;
                      changed.at(path) = value;
                      return changed.dump();
                    }});
  };
  const auto take_out = [&](const std::string& parent, const std::string& path, const auto& which) {
    lies.push_back({path, "deleted", [tree, parent, which] {
                      Json changed = *tree;
                      (parent.empty() ? changed : changed.at(parent)).erase(which);
                      return changed.dump();
                    }});
  };
  detail::walk(*tree, "", [&](const Json& at, const std::string& path) {
    if (at.is_object())
      for (const std::string& key : at.keys()) take_out(path, path + "/" + key, key);
    if (at.is_array()) {
      for (std::size_t i = 0; i < at.size(); ++i) take_out(path, path + "/" + std::to_string(i), i);
      for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        if (at[i] == at[i + 1]) continue;
        Json swapped = at;
        std::swap(*(swapped.begin() + static_cast<std::ptrdiff_t>(i)),
                  *(swapped.begin() + static_cast<std::ptrdiff_t>(i + 1)));
        lies.push_back({path + "/" + std::to_string(i), "exchanged", [tree, path, swapped] {
                          Json changed = *tree;
                          changed.at(path) = swapped;
                          return changed.dump();
                        }});
      }
    }
    if (at.is_object() || at.is_array()) return;
    const std::string said = at.dump();
    if (detail::is_number(said)) {
      const double value = at.get<double>();
      put(path, "last place", last_place(value));
      put(path, "sign", value == 0 ? 1.0 : -value);
    } else if (said[0] == '"') {
      put(path, "text", at.get<std::string>() + "x");
    } else if (said[0] == 't' || said[0] == 'f') {
      put(path, "truth", Json::parse(said[0] == 't' ? "false" : "true"));
    } else {
      put(path, "null", 1);
    }
  });
  return lies;
}

}  // namespace lekalo::test

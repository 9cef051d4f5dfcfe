// Apart from the readers that take JSON as a tree already: they are built without exceptions too
// (bindings/wasm), this is not.

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "json_form.hpp"

namespace lekalo::io::detail {

Result<Json> parse_json(std::string_view bytes, const std::string& name) {
  std::vector<std::set<std::string>> keys;
  std::string repeated;
  const auto watch = [&](int, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) keys.emplace_back();
    if (event == Json::parse_event_t::object_end) keys.pop_back();
    if (event == Json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second) {
      repeated = value.get<std::string>();
    }
    return true;
  };
  try {
    Json json = Json::parse(bytes.begin(), bytes.end(), watch);
    if (!repeated.empty())
      return refuse(name, fmt::format("the key \"{}\" stands twice in one object", repeated));
    return json;
  } catch (const Json::parse_error& error) {
    const auto end = bytes.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, bytes.size()));
    return refuse(fmt::format("{}, line {}", name, 1 + std::count(bytes.begin(), end, '\n')),
                  "this is not JSON from here on");
  } catch (const Json::exception& error) {
    return refuse(name, fmt::format("this JSON cannot be read: {}", error.what()));
  }
}

}  // namespace lekalo::io::detail

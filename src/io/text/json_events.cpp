#include "lekalo/io/text/json_events.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

#include "lekalo/base/stop.hpp"

namespace lekalo::io {
namespace {

using Json = nlohmann::json;

/// Translates the events of the JSON library, whose names and types stay in this file.
class Translation {
 public:
  Translation(std::string_view bytes, JsonEvents& listener) : bytes_(bytes), listener_(listener) {}

  bool null() {
    ask();
    return listener_.null();
  }
  bool boolean(bool value) { return listener_.boolean(value); }
  bool number_integer(std::int64_t value) {
    ask();
    return listener_.integer(value);
  }
  bool number_unsigned(std::uint64_t value) {
    ask();
    return value <= static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())
               ? listener_.integer(static_cast<std::int64_t>(value))
               : listener_.number(static_cast<double>(value), fmt::format("{}", value));
  }
  bool number_float(double value, const std::string& text) {
    ask();
    return listener_.number(value, text);
  }
  bool string(const std::string& value) {
    ask();
    return listener_.text(value);
  }
  bool binary(Json::binary_t&) { return false; }  // JSON has none
  bool start_object(std::size_t) {
    ask();
    return listener_.begin_object();
  }
  bool key(const std::string& value) { return listener_.key(value); }
  bool end_object() { return listener_.end_object(); }
  bool start_array(std::size_t) {
    ask();
    return listener_.begin_list();
  }
  bool end_array() { return listener_.end_list(); }

  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error) {
    constexpr int kNumberTooLarge = 406;
    const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(position, bytes_.size()));
    // The parser reports the end of the text one beyond the last byte.
    listener_.broken({1 + static_cast<std::size_t>(std::count(bytes_.begin(), end, '\n')), position, token,
                      error.id == kNumberTooLarge, position > bytes_.size()});
    return false;
  }

 private:
  std::string_view bytes_;
  JsonEvents& listener_;
};

}  // namespace

bool parse_json(std::string_view bytes, JsonEvents& listener) {
  Translation translation(bytes, listener);
  return Json::sax_parse(bytes.begin(), bytes.end(), &translation);
}

}  // namespace lekalo::io

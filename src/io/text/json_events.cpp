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
    listener_.broken({line_of(end), position, token, error.id == kNumberTooLarge, position > bytes_.size()});
    return false;
  }

  /// The parser takes a zero byte for the end of the text, so that anything might follow it unread.
  bool ends_at_the_last_byte() {
    const auto zero = std::find(bytes_.begin(), bytes_.end(), '\0');
    if (zero == bytes_.end()) return true;
    const auto position = static_cast<std::size_t>(zero - bytes_.begin()) + 1;
    listener_.broken({line_of(zero), position, std::string(1, *zero), false, false});
    return false;
  }

 private:
  [[nodiscard]] std::size_t line_of(std::string_view::const_iterator at) const {
    return 1 + static_cast<std::size_t>(std::count(bytes_.begin(), at, '\n'));
  }

  std::string_view bytes_;
  JsonEvents& listener_;
};

}  // namespace

bool parse_json(std::string_view bytes, JsonEvents& listener) {
  Translation translation(bytes, listener);
  return Json::sax_parse(bytes.begin(), bytes.end(), &translation) && translation.ends_at_the_last_byte();
}

}  // namespace lekalo::io

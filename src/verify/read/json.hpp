#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::verify {

/// A JSON value as a piece of a checked document. No tree is built, and numbers stay the text that was
/// written. Only parse_json makes the first value, so the grammar holds for every piece.
struct Json {
  /// The text has no blanks around it.
  std::string_view text;

  [[nodiscard]] bool is_object() const { return starts_with('{'); }
  [[nodiscard]] bool is_array() const { return starts_with('['); }
  [[nodiscard]] bool is_string() const { return starts_with('"'); }
  [[nodiscard]] bool is_null() const { return starts_with('n'); }
  [[nodiscard]] bool is_bool() const { return starts_with('t') || starts_with('f'); }
  [[nodiscard]] bool is_number() const {
    return starts_with('-') || (!text.empty() && text[0] >= '0' && text[0] <= '9');
  }
  [[nodiscard]] bool is_true() const { return starts_with('t'); }

 private:
  [[nodiscard]] bool starts_with(char c) const { return !text.empty() && text[0] == c; }
};

/// Values nested deeper than this are refused.
inline constexpr int kMaxJsonDepth = 64;

/// Checks the whole document (RFC 8259; a byte order mark in front is allowed). bad_input names the line.
[[nodiscard]] Result<Json> parse_json(std::string_view bytes, std::string_view name);

/// Returns the text of a string with its escapes resolved.
/// \pre is_string()
[[nodiscard]] std::string json_text(Json string);

/// Walks through the items of a list or the members of an object, in order.
class JsonItems {
 public:
  explicit JsonItems(Json list_or_object);
  /// Returns the next item. For a member of an object its key is then in `key`, escapes resolved.
  [[nodiscard]] std::optional<Json> next();
  [[nodiscard]] std::string_view key() const { return key_; }

 private:
  std::string_view rest_;
  bool object_;
  std::string key_;
};

[[nodiscard]] std::size_t count_items(Json list);

/// Finds `keys` among the members of `object`; found[i] has empty text when keys[i] is absent. Returns false
/// when one of them is there twice, because readers differ in which of two they take.
[[nodiscard]] bool find_members(Json object, std::span<const std::string_view> keys, std::span<Json> found);

}  // namespace lekalo::verify

#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace lekalo::io {

/// How JSON text is laid out, and with that how it says a double: always so that it reads back to the same
/// one.
enum class JsonLayout : std::uint8_t {
  compact,   ///< `{"a":1.0,"b":[1,2]}`, no blanks
  indented,  ///< every item on a line of its own, two blanks for each object and list around it
  spaced     ///< `{"a": 1, "b": [1, 2]}`; lines break where line() says so
};

/// A value that holds no others: null, a truth, a number, a text. It does not own its text, so it lives no
/// longer than the call that it is made for.
class JsonScalar {
 public:
  JsonScalar(std::nullptr_t) noexcept {}
  JsonScalar(double number) noexcept : any_(number) {}
  JsonScalar(std::string_view text) noexcept : any_(text) {}
  JsonScalar(const std::string& text) noexcept : any_(std::string_view(text)) {}
  JsonScalar(const char* text) : any_(std::string_view(text)) {}
  template <std::integral Integer>
  JsonScalar(Integer value) noexcept {
    if constexpr (std::same_as<Integer, bool>)
      any_ = value;
    else if constexpr (std::signed_integral<Integer>)
      any_ = std::int64_t{value};
    else
      any_ = std::uint64_t{value};
  }
  /// null where there is none.
  template <class Value>
  JsonScalar(const std::optional<Value>& value) : JsonScalar(value ? JsonScalar(*value) : nullptr) {}

 private:
  friend class JsonWriter;
  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string_view> any_;
};

struct JsonField {
  std::string_view key;
  JsonScalar value;
};

/// Writes one JSON text from front to back: what is written stays, nothing is looked up, and members stand in
/// the order of the calls. Every JSON text of lekalo is written through it.
///
///     JsonWriter json(JsonLayout::spaced);
///     json.begin_object().fields({{"id", 7}, {"name", name}});
///     json.key("at").list({p.x, p.y}).end();
///
/// Bytes of texts that are not UTF-8 become U+FFFD. Doubles stand in the fewest digits that read back to the
/// same double, a whole one as `1`, and have to be finite. One exception is kept for the sake of the bytes
/// that earlier versions wrote: `compact` and `indented` say doubles as nlohmann/json does, a whole one as
/// `1.0`, rarely with a digit more, and null for one that is not finite.
///
/// Asserts that calls fit together: a value in an object follows a key, brackets are closed. Cost: O(bytes).
class JsonWriter {
 public:
  explicit JsonWriter(JsonLayout layout) noexcept : layout_(layout) {}

  JsonWriter& begin_object() { return begin('{', '}'); }
  JsonWriter& begin_list() { return begin('[', ']'); }
  /// Closes the innermost object or list that is open.
  JsonWriter& end();

  /// The name of the value that follows. \pre an object is open
  JsonWriter& key(std::string_view name);
  JsonWriter& value(const JsonScalar& scalar);
  /// Gives the text, for a value that the caller appends to it as JSON.
  [[nodiscard]] std::string& raw();

  /// Puts what comes next, a key, an item or a closing bracket, on a line of its own after so many blanks.
  /// \pre the layout is `spaced`
  JsonWriter& line(std::size_t indent);

  JsonWriter& field(std::string_view name, const JsonScalar& scalar) { return key(name).value(scalar); }
  JsonWriter& fields(std::initializer_list<JsonField> fields);
  JsonWriter& object(std::initializer_list<JsonField> all) { return begin_object().fields(all).end(); }

  JsonWriter& list(std::initializer_list<JsonScalar> items) { return list<>(items); }
  /// A list of what scalars are made of: numbers, texts.
  template <class Items>
  JsonWriter& list(const Items& items) {
    return list(items, [this](const auto& item) { value(item); });
  }
  /// A list for whose items `write(item)` writes one value each.
  template <class Items, class Write>
  JsonWriter& list(const Items& items, const Write& write) {
    begin_list();
    for (const auto& item : items) write(item);
    return end();
  }

  /// The same with a line for each item, after `indent` blanks, and one for the bracket, after `close`.
  template <class Items, class Write>
  JsonWriter& list_of_lines(const Items& items, std::size_t indent, std::size_t close, const Write& write) {
    begin_list();
    for (const auto& item : items) {
      line(indent);
      write(item);
    }
    if (!items.empty()) line(close);
    return end();
  }

  /// Hands out the text. \pre it is one whole value
  [[nodiscard]] std::string take();

 private:
  JsonWriter& begin(char open, char close);
  void begin_value();
  void begin_item();
  void append_break(std::size_t indent);
  void append_text(std::string_view text);
  void append_number(double number);

  JsonLayout layout_;
  bool first_ = true;  ///< nothing stands in the innermost bracket yet
  bool after_key_ = false;
  std::optional<std::size_t> line_;  ///< what comes next begins a line, after so many blanks
  std::string open_;                 ///< the closing brackets to come, the innermost last
  std::string text_;
};

}  // namespace lekalo::io

#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <iosfwd>
#include <string>
#include <type_traits>
#include <vector>

namespace lekalo::cases {

/// A JSON text as a tree to look into and to change; fields keep their order. The words are those of the
/// library that parses and prints it, which json.cpp alone includes: it costs every file seconds. Whole
/// numbers are those from -2^63 to 2^63 - 1. Who looks for what is not there gets a std::runtime_error, which
/// fails the test.
class Json {
 public:
  Json() noexcept;  ///< null
  Json(std::nullptr_t) noexcept : Json() {}
  Json(const char* text);
  Json(std::string text);
  Json(double number) noexcept;
  template <std::integral Whole>
  Json(Whole number) noexcept
      : Json(std::same_as<Whole, bool> ? Kind::truth : Kind::whole, static_cast<std::int64_t>(number)) {}
  /// An object when every item is a list of a text and a value, else a list.
  Json(std::initializer_list<Json> items);
  Json(std::vector<Json> list);
  Json(const Json& other);
  Json(Json&& other) noexcept;
  Json& operator=(Json other) noexcept;
  ~Json();

  [[nodiscard]] static Json array(std::initializer_list<Json> items = {});
  [[nodiscard]] static Json object();
  [[nodiscard]] static Json parse(const std::string& text);
  [[nodiscard]] std::string dump(int indent = -1) const;

  [[nodiscard]] bool is_null() const noexcept { return kind_ == Kind::null; }
  [[nodiscard]] bool is_array() const noexcept { return kind_ == Kind::list; }
  [[nodiscard]] bool is_object() const noexcept { return kind_ == Kind::object; }
  [[nodiscard]] std::size_t size() const noexcept { return items_.size(); }
  [[nodiscard]] bool empty() const noexcept { return items_.empty(); }
  template <class T>
  requires std::same_as<T, std::string> || std::is_arithmetic_v<T>
  [[nodiscard]] T get() const {
    if constexpr (std::same_as<T, std::string>)
      return text();
    else if constexpr (std::integral<T>)
      return static_cast<T>(whole());
    else
      return static_cast<T>(number());
  }

  operator double() const { return number(); }
  operator std::string() const { return text(); }

  /// A field of an object or an item of a list. Where the tree may change, a new field and the item after the
  /// last are added.
  Json& operator[](const std::string& key);
  const Json& operator[](const std::string& key) const;
  /// A number and a literal make a subscript of the language too, for a compiler that converts the tree.
  Json& operator[](const char* key) { return (*this)[std::string(key)]; }
  const Json& operator[](const char* key) const { return (*this)[std::string(key)]; }
  template <std::integral Index>
  Json& operator[](Index index) {
    if (static_cast<std::size_t>(index) == size()) push_back({});
    return const_cast<Json&>(item(static_cast<std::size_t>(index)));
  }
  template <std::integral Index>
  const Json& operator[](Index index) const {
    return item(static_cast<std::size_t>(index));
  }
  /// Goes down fields and indices, as "/certificate/0/from".
  Json& at(const std::string& path);
  const Json& at(const std::string& path) const;
  [[nodiscard]] bool contains(const std::string& key) const;
  [[nodiscard]] Json value(const std::string& key, Json otherwise) const;
  [[nodiscard]] const std::vector<std::string>& keys() const noexcept { return keys_; }

  [[nodiscard]] auto begin() noexcept { return items_.begin(); }
  [[nodiscard]] auto end() noexcept { return items_.end(); }
  [[nodiscard]] auto begin() const noexcept { return items_.begin(); }
  [[nodiscard]] auto end() const noexcept { return items_.end(); }
  [[nodiscard]] Json& back() { return (*this)[size() - 1]; }
  [[nodiscard]] const Json& back() const { return item(size() - 1); }
  void push_back(Json item);
  void erase(std::size_t index);
  void erase(const std::string& key);

  /// Numbers are compared by value, whole or not, and fields in their order.
  friend bool operator==(const Json& a, const Json& b);
  friend std::partial_ordering operator<=>(const Json& a, const Json& b);  ///< of numbers
  template <class Number>
  requires std::is_arithmetic_v<Number>
  friend bool operator==(const Json& a, Number b) { return a == Json(b); }
  template <class Number>
  requires std::is_arithmetic_v<Number>
  friend std::partial_ordering operator<=>(const Json& a, Number b) { return a <=> Json(b); }
  friend std::ostream& operator<<(std::ostream& stream, const Json& json);

 private:
  enum class Kind { null, truth, whole, number, text, list, object };
  friend struct JsonConversion;

  Json(Kind kind, std::int64_t whole) noexcept;
  [[nodiscard]] const std::string& text() const;
  [[nodiscard]] std::int64_t whole() const;
  [[nodiscard]] double number() const;
  [[nodiscard]] const Json& item(std::size_t index) const;

  Kind kind_ = Kind::null;
  std::int64_t whole_ = 0;
  double number_ = 0;
  std::string text_;
  std::vector<Json> items_;        ///< of lists and objects
  std::vector<std::string> keys_;  ///< of objects, one for each item
};

}  // namespace lekalo::cases

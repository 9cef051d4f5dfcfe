#pragma once

#include <fmt/core.h>

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "json.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {

/// The members of one object. Of all Fields of a document the first complaint is kept, and what a getter
/// returns after a complaint does not matter.
class Fields {
 public:
  Fields(Json object, std::string path, std::string& complaint)
      : path_(std::move(path)), complaint_(complaint) {
    if (!object.is_object()) {
      complain(fmt::format("{} is not an object", path_.empty() ? "it" : path_));
      return;
    }
    JsonItems items(object);
    while (const auto item = items.next()) members_.push_back({std::string(items.key()), *item});
    std::ranges::sort(members_, {}, &Member::key);
    const auto twice = std::ranges::adjacent_find(members_, {}, &Member::key);
    if (twice != members_.end()) complain(fmt::format("field {} is given twice", name(twice->key)));
  }

  [[nodiscard]] std::size_t size() const { return members_.size(); }
  [[nodiscard]] Json get(std::string_view key) const {
    const auto found = std::lower_bound(members_.begin(), members_.end(), key,
                                        [](const Member& m, std::string_view k) { return m.key < k; });
    return found == members_.end() || found->key != key ? Json{} : found->value;
  }

  /// Calls f(key) for each member.
  template <class F>
  void each_key(F f) const {
    for (const Member& member : members_) f(std::string_view(member.key));
  }

  [[nodiscard]] Decimal number(std::string_view key) { return number_of(get(key), name(key)); }
  [[nodiscard]] std::optional<Decimal> number_or_null(std::string_view key) {
    if (get(key).is_null()) return std::nullopt;
    return number(key);
  }
  [[nodiscard]] std::size_t index(std::string_view key) { return index_of(get(key), name(key)); }
  [[nodiscard]] std::string text(std::string_view key) {
    const Json value = get(key);
    if (value.is_string()) return json_text(value);
    complain(fmt::format("field {} is not a text", name(key)));
    return {};
  }
  /// Calls f(item, path of the item) for each item of a list.
  template <class F>
  void each(std::string_view key, F f) {
    const Json value = get(key);
    if (!value.is_array()) return complain(fmt::format("field {} is not a list", name(key)));
    JsonItems items(value);
    // One text for all paths: a list of coordinates would make one for each number.
    std::string path = name(key) + '[';
    const std::size_t stem = path.size();
    for (std::size_t i = 0; const auto item = items.next(); ++i) {
      path.resize(stem);
      fmt::format_to(std::back_inserter(path), "{}]", i);
      f(*item, std::as_const(path));
    }
  }
  /// Complains of a member that is not there, not even as null: whoever took it out may have meant to hide
  /// what it said.
  void require(std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys)
      if (get(key).text.empty()) complain(fmt::format("field {} is missing", name(key)));
  }
  [[nodiscard]] std::string name(std::string_view key) const {
    return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
  }
  void complain(const std::string& sentence) {
    if (complaint_.empty()) complaint_ = sentence;
  }

  [[nodiscard]] Decimal number_of(Json value, const std::string& what) {
    auto number = value.is_number() ? parse_decimal(value.text) : std::nullopt;
    if (number) return *std::move(number);
    complain_of(value, what, decimal_rule());
    return {};
  }
  [[nodiscard]] std::size_t index_of(Json value, const std::string& what) {
    const auto number = value.is_number() ? parse_decimal(value.text) : std::nullopt;
    if (number && sgn(number->digits) >= 0 && number->exponent >= 0 && compare(*number, Decimal{1, 15}) < 0) {
      return static_cast<std::size_t>(to_long(in_units(*number, 0)));
    }
    complain_of(value, what, "a whole number from 0 on");
    return 0;
  }

 private:
  void complain_of(Json value, const std::string& what, std::string_view wanted) {
    complain(value.text.empty() ? fmt::format("field {} is missing", what)
                                : fmt::format("field {} is {}, not {}", what, excerpt(value.text), wanted));
  }

  struct Member {
    std::string key;
    Json value;
  };

  std::vector<Member> members_;  ///< by key
  std::string path_;
  std::string& complaint_;
};

}  // namespace lekalo::verify

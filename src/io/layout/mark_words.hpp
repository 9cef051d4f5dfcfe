#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "lekalo/layout/document.hpp"

namespace lekalo::io::detail {

/// The words of files for what marks and texts of parts are.

inline constexpr std::array<std::pair<layout::MarkRole, std::string_view>, 4> kMarkRoles{
    {{layout::MarkRole::mark, "mark"},
     {layout::MarkRole::engrave, "engrave"},
     {layout::MarkRole::bend, "bend"},
     {layout::MarkRole::cut, "cut"}}};
inline constexpr std::array<std::pair<layout::TextAnchor, std::string_view>, 3> kTextAnchors{
    {{layout::TextAnchor::left, "left"},
     {layout::TextAnchor::middle, "middle"},
     {layout::TextAnchor::right, "right"}}};

template <class Value, std::size_t N>
[[nodiscard]] constexpr std::string_view word_among(
    const std::array<std::pair<Value, std::string_view>, N>& words, Value value) noexcept {
  return words[static_cast<std::size_t>(value)].second;
}
template <class Value, std::size_t N>
[[nodiscard]] std::optional<Value> value_among(const std::array<std::pair<Value, std::string_view>, N>& words,
                                               std::string_view word) noexcept {
  for (const auto& [value, name] : words)
    if (name == word) return value;
  return std::nullopt;
}

/// Says whether a text is a colour as layouts have it: "#0000ff", in lower case.
[[nodiscard]] inline bool is_colour(std::string_view text) noexcept {
  return text.size() == 7 && text[0] == '#' &&
         text.find_first_not_of("0123456789abcdef", 1) == std::string_view::npos;
}

}  // namespace lekalo::io::detail

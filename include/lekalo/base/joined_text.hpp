#pragma once

#include <string>
#include <string_view>
#include <type_traits>

namespace lekalo {

/// Texts or whole numbers in a row, `separator` between them. Stands for fmt::join, which builds the writers
/// of numbers anew in every file that calls it.
template <class Items>
[[nodiscard]] std::string joined_text(const Items& items, std::string_view separator) {
  std::string text;
  bool first = true;
  for (const auto& item : items) {
    if (!first) text += separator;
    first = false;
    if constexpr (std::is_integral_v<std::decay_t<decltype(item)>>) {
      text += std::to_string(item);
    } else {
      text += std::string_view(item);
    }
  }
  return text;
}

}  // namespace lekalo

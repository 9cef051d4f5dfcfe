#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace lekalo {

/// A count and what is counted, as notices and sentences say it.
[[nodiscard]] inline std::string counted(std::size_t count, std::string_view one, std::string_view many) {
  std::string text = std::to_string(count) + " ";
  return text += count == 1 ? one : many;
}
/// The same for words whose plural has an s: "1 part", "2 parts".
[[nodiscard]] inline std::string counted(std::size_t count, const std::string& one) {
  return counted(count, one, one + "s");
}

}  // namespace lekalo

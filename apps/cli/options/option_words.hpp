#pragma once

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <optional>
#include <string>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/units.hpp"
#include "lekalo/io/text/length_word.hpp"

namespace lekalo::cli {

template <class T>
struct Word {
  const char* name;
  T value;
};

template <class T, std::size_t N>
const char* name_in(const std::array<Word<T>, N>& words, T value) noexcept {
  for (const Word<T>& word : words) {
    if (word.value == value) return word.name;
  }
  return "";
}

template <class T, std::size_t N>
std::string list_of(const std::array<Word<T>, N>& words, const char* separator) {
  std::string list;
  for (const Word<T>& word : words) list += (list.empty() ? "" : separator) + std::string(word.name);
  return list;
}

inline constexpr std::array kUnits{Word<LengthUnit>{"mm", LengthUnit::millimetre},
                                   Word<LengthUnit>{"inch", LengthUnit::inch}};

/// Turns words into values and keeps all complaints. Words become numbers here rather than in CLI11,
/// whose messages do not name the range and which takes "nan" and "0x10".
class WordReader {
 public:
  /// Leaves `value` alone when the option was not given.
  template <class Number>
  void number(const char* option, const std::string& word, Number low, Number high, const char* wanted,
              Number& value) {
    if (word.empty()) return;
    Number parsed{};
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data(), end, parsed);
    if (error == std::errc{} && stop == end && low <= parsed && parsed <= high) {
      value = parsed;
    } else {
      complain(fmt::format("{}: \"{}\" is not {}", option, word, wanted));
    }
  }
  /// Reads a length with or without a unit (io/text/length_word.hpp).
  void length(const char* option, const std::string& word, double low, double high, const char* wanted,
              double& mm) {
    if (word.empty()) return;
    const std::optional<double> read = io::length_of(word);
    if (read && low <= *read && *read <= high) {
      mm = *read;
    } else {
      complain(fmt::format("{}: \"{}\" is not {}", option, word, wanted));
    }
  }
  template <class T, std::size_t N>
  void choice(const char* option, const std::string& word, const std::array<Word<T>, N>& words, T& value) {
    if (word.empty()) return;
    for (const Word<T>& candidate : words) {
      if (word == candidate.name) {
        value = candidate.value;
        return;
      }
    }
    complain(fmt::format("{}: \"{}\" is not one of {}", option, word, list_of(words, ", ")));
  }
  void require(bool condition, const std::string& complaint) {
    if (!condition) complain(complaint);
  }
  [[nodiscard]] const std::string& complaint() const { return complaint_; }

 private:
  void complain(const std::string& complaint) { complaint_ += (complaint_.empty() ? "" : "; ") + complaint; }
  std::string complaint_;
};

inline constexpr double kLargestLength = limits::kLargestCoordinate;  // mm
inline constexpr double kSmallestLength = 1e-300;                     // stands for "more than 0"

}  // namespace lekalo::cli

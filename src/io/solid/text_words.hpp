#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

namespace lekalo::io {

inline constexpr std::string_view kWordBlanks = " \t\r\v\f";

/// The words of a text one after the other, and the line of the last one, 1-based. A byte order mark is
/// passed over.
class TextWords {
 public:
  explicit TextWords(std::string_view text) : rest_(text) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  }

  [[nodiscard]] std::size_t line() const noexcept { return line_; }

  /// The next word, of whichever line.
  std::optional<std::string_view> next() {
    while (true) {
      if (const auto word = next_in_line()) return word;
      if (!next_line()) return std::nullopt;
    }
  }

  /// The next word of this line.
  std::optional<std::string_view> next_in_line() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(kWordBlanks), rest_.size()));
    const std::size_t end = std::min(rest_.find_first_of(" \t\r\v\f\n"), rest_.size());
    if (end == 0) return std::nullopt;
    const std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }

  /// Returns what is left of this line, without the blanks around it.
  std::string_view rest_of_line() {
    std::string_view words = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(words.size());
    words.remove_prefix(std::min(words.find_first_not_of(kWordBlanks), words.size()));
    return words.substr(0, words.find_last_not_of(kWordBlanks) + 1);
  }

  /// Goes to the next line; false where there is none.
  bool next_line() {
    const std::size_t end = rest_.find('\n');
    if (end == std::string_view::npos) {
      rest_ = {};
      return false;
    }
    rest_.remove_prefix(end + 1);
    ++line_;
    return true;
  }

 private:
  std::string_view rest_;
  std::size_t line_ = 1;
};

/// Says whether a word is another one, which has small letters, in any case.
[[nodiscard]] inline bool is_word(std::string_view word, std::string_view wanted) noexcept {
  return std::equal(word.begin(), word.end(), wanted.begin(), wanted.end(), [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a - 'A' + 'a') : a) == b;
  });
}

/// Says whether there are no bytes at the beginning that texts do not have.
[[nodiscard]] inline bool begins_as_text(std::string_view bytes) noexcept {
  constexpr std::size_t kLooked = 512;
  const std::string_view begin = bytes.substr(0, kLooked);
  return std::none_of(begin.begin(), begin.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < '\t' || (byte > '\r' && byte < ' ') || byte == 0x7f;
  });
}

}  // namespace lekalo::io

#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::io {

/// One pair of lines of an ASCII DXF file.
struct DxfGroup {
  int code = 0;
  std::string_view value;  ///< without blanks around it
  std::size_t line = 0;    ///< of the value, 1-based
};

/// Takes the groups off a DXF text one by one; nothing is copied.
class DxfGroups {
 public:
  DxfGroups(std::string_view bytes, const std::string& name)
      : name_(name), at_(bytes.data()), end_(bytes.data() + bytes.size()) {}

  /// Takes the next group; false at the end of the file and at the first fault, which is then in `fault`.
  bool next(DxfGroup& group) {
    if (at_ == end_) return false;
    const std::string_view code = next_line();
    if (!read_code(code, group.code)) return end_or_fault(code);
    if (at_ == end_) return ends_early();
    group.value = next_line();
    group.line = line_;
    return true;
  }
  [[nodiscard]] const std::optional<Error>& fault() const noexcept { return fault_; }

 private:
  static bool is_blank(char c) noexcept { return c == ' ' || c == '\t' || c == '\r'; }

  std::string_view next_line() noexcept {
    const auto* newline =
        static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    const char* begin = at_;
    const char* end = newline == nullptr ? end_ : newline;
    at_ = newline == nullptr ? end_ : newline + 1;
    ++line_;
    while (begin != end && is_blank(*begin)) ++begin;
    while (begin != end && is_blank(end[-1])) --end;
    return {begin, static_cast<std::size_t>(end - begin)};
  }

  /// Group codes are 0 to 1071.
  static bool read_code(std::string_view text, int& code) noexcept {
    if (text.empty() || text.size() > 4) return false;
    code = 0;
    for (const char c : text) {
      if (c < '0' || c > '9') return false;
      code = code * 10 + (c - '0');
    }
    return code <= 1071;
  }

  bool end_or_fault(std::string_view code);
  bool ends_early();

  const std::string& name_;
  const char* at_;
  const char* end_;
  std::size_t line_ = 0;
  std::optional<Error> fault_;
};

}  // namespace lekalo::io

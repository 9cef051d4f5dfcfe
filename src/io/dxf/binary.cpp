#include "binary.hpp"

#include <fmt/core.h>

#include <bit>
#include <cstdint>
#include <optional>

#include "io/text/refusal.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::io {
namespace {

/// How the value of a group is stored.
enum class Stored { text, real, int8, int16, int32, int64, bytes };

struct CodeRange {
  unsigned first, last;
  Stored stored;
};

// The DXF reference, "group code value types"; what no row names is text.
constexpr CodeRange kRanges[] = {
    {10, 59, Stored::real},      {60, 79, Stored::int16},    {90, 99, Stored::int32},
    {110, 149, Stored::real},    {160, 169, Stored::int64},  {170, 179, Stored::int16},
    {210, 239, Stored::real},    {270, 289, Stored::int16},  {290, 299, Stored::int8},
    {310, 319, Stored::bytes},   {370, 389, Stored::int16},  {400, 409, Stored::int16},
    {420, 429, Stored::int32},   {440, 459, Stored::int32},  {460, 469, Stored::real},
    {1004, 1004, Stored::bytes}, {1010, 1059, Stored::real}, {1060, 1070, Stored::int16},
    {1071, 1071, Stored::int32}};

Stored stored_as(unsigned code) {
  for (const CodeRange& range : kRanges)
    if (range.first <= code && code <= range.last) return range.stored;
  return Stored::text;
}

class BinaryGroups {
 public:
  BinaryGroups(std::string_view bytes, const std::string& name)
      : name_(name), bytes_(bytes), at_(kBinaryDxf.size()), long_codes_(begins_with_two_byte_code()) {}

  Result<std::string> as_text() {
    while (at_ < bytes_.size()) {
      ask();
      const auto code = read_code();
      if (!code) return ends_early();
      text_ += std::to_string(*code);
      text_ += '\n';
      if (!append_value(stored_as(*code))) return ends_early();
      text_ += '\n';
      ++groups_;
      if (*code == 0 && text_.ends_with("\n0\nEOF\n")) break;
    }
    return std::move(text_);
  }

 private:
  /// The first group is 0, SECTION.
  [[nodiscard]] bool begins_with_two_byte_code() const {
    return at_ + 1 < bytes_.size() && bytes_[at_] == '\0' && bytes_[at_ + 1] == '\0';
  }

  /// The next bytes as a number, lowest byte first.
  template <class Number>
  std::optional<Number> take() {
    if (bytes_.size() - at_ < sizeof(Number)) return std::nullopt;
    std::uint64_t bits = 0;
    for (std::size_t i = sizeof(Number); i-- > 0;)
      bits = bits << 8U | static_cast<unsigned char>(bytes_[at_ + i]);
    at_ += sizeof(Number);
    if constexpr (sizeof(Number) == 8) {
      return std::bit_cast<Number>(bits);
    } else {
      return static_cast<Number>(bits);
    }
  }

  std::optional<unsigned> read_code() {
    if (long_codes_) return take<std::uint16_t>();
    const auto code = take<std::uint8_t>();
    // A code above 254 stands in the two bytes behind 255.
    if (code && *code == 255) return take<std::uint16_t>();
    return code;
  }

  template <class Number>
  bool append() {
    const auto value = take<Number>();
    if (value) text_ += fmt::format("{}", *value);
    return value.has_value();
  }

  bool append_value(Stored stored) {
    switch (stored) {
      case Stored::real:
        return append<double>();
      case Stored::int16:
        return append<std::int16_t>();
      case Stored::int32:
        return append<std::int32_t>();
      case Stored::int64:
        return append<std::int64_t>();
      case Stored::int8: {
        const auto value = take<std::int8_t>();
        if (value) text_ += std::to_string(int{*value});
        return value.has_value();
      }
      case Stored::bytes: {
        // Pictures and the like, which no reader of curves wants.
        const auto length = take<std::uint8_t>();
        if (!length || bytes_.size() - at_ < *length) return false;
        at_ += *length;
        return true;
      }
      case Stored::text:
        break;
    }
    const std::size_t end = bytes_.find('\0', at_);
    if (end == std::string_view::npos) return false;
    for (const char c : bytes_.substr(at_, end - at_)) text_ += c == '\n' || c == '\r' ? ' ' : c;
    at_ = end + 1;
    return true;
  }

  [[nodiscard]] tl::unexpected<Error> ends_early() const {
    return refuse(name_,
                  fmt::format("this binary DXF ends within its group {}; it is not complete", groups_ + 1));
  }

  const std::string& name_;
  std::string_view bytes_;
  std::size_t at_, groups_ = 0;
  bool long_codes_;
  std::string text_;
};

}  // namespace

Result<std::string> text_of_binary_dxf(std::string_view bytes, const std::string& name) {
  return BinaryGroups(bytes, name).as_text();
}

}  // namespace lekalo::io

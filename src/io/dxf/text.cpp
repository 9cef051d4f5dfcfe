#include "text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>

#include <iconv.h>

#include "io/text/decimal.hpp"

namespace lekalo::io {
namespace {

bool is_ascii(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

/// The length of the well-formed UTF-8 sequence at the beginning (Unicode 15, table 3-7), 0 when there is
/// none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xc2 && first <= 0xdf   ? 2
                             : first >= 0xe0 && first <= 0xef ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
  if (length == 0) return 0;
  const unsigned low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t i = 2; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80) return 0;
  }
  return length;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

/// The C library's name of a code page.
std::string charset_of(std::string_view code_page) {
  const std::string page = folded(code_page);
  const std::size_t digits = page.find_first_of("0123456789");
  const bool numbered = page.rfind("ANSI_", 0) == 0 || page.rfind("DOS", 0) == 0;
  if (numbered && digits != std::string::npos) return "CP" + page.substr(digits);
  constexpr std::pair<std::string_view, const char*> kNamed[] = {{"GB2312", "CP936"},
                                                                 {"BIG5", "CP950"},
                                                                 {"KSC5601", "CP949"},
                                                                 {"JOHAB", "JOHAB"},
                                                                 {"MAC-ROMAN", "MACINTOSH"}};
  for (const auto& [known, charset] : kNamed) {
    if (page == known) return charset;
  }
  return "CP1252";
}

/// Code pages whose letters are pairs of bytes, which look like UTF-8 by chance.
bool is_double_byte(std::string_view charset) {
  constexpr std::string_view kPages[] = {"CP932", "CP936", "CP949", "CP950", "JOHAB"};
  return std::find(std::begin(kPages), std::end(kPages), charset) != std::end(kPages);
}

std::optional<std::string> converted(std::string_view text, const std::string& charset) {
  const iconv_t converter = iconv_open("UTF-8", charset.c_str());
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::nullopt;
  std::string in(text), out(4 * text.size() + 16, '\0');
  char* from = in.data();
  char* to = out.data();
  std::size_t from_left = in.size(), to_left = out.size();
  const std::size_t done = iconv(converter, &from, &from_left, &to, &to_left);
  iconv_close(converter);
  if (done == static_cast<std::size_t>(-1) || from_left != 0) return std::nullopt;
  out.resize(out.size() - to_left);
  return out;
}

void append_utf8(std::string& out, std::uint32_t letter) {
  if (letter < 0x80) {
    out += static_cast<char>(letter);
  } else if (letter < 0x800) {
    out += static_cast<char>(0xc0U | (letter >> 6U));
    out += static_cast<char>(0x80U | (letter & 0x3fU));
  } else {
    out += static_cast<char>(0xe0U | (letter >> 12U));
    out += static_cast<char>(0x80U | ((letter >> 6U) & 0x3fU));
    out += static_cast<char>(0x80U | (letter & 0x3fU));
  }
}

/// The letter that four hexadecimal digits name; none for surrogates and controls.
std::optional<std::uint32_t> escaped_letter(std::string_view digits) {
  if (digits.size() < 4) return std::nullopt;
  std::uint32_t letter = 0;
  for (const char c : digits.substr(0, 4)) {
    const char upper = c >= 'a' && c <= 'f' ? static_cast<char>(c - 'a' + 'A') : c;
    const bool is_digit = c >= '0' && c <= '9';
    if (!is_digit && !(upper >= 'A' && upper <= 'F')) return std::nullopt;
    letter = letter * 16 + static_cast<std::uint32_t>(is_digit ? c - '0' : upper - 'A' + 10);
  }
  if (letter < 0x20 || (letter >= 0x7f && letter < 0xa0) || (letter >= 0xd800 && letter < 0xe000)) {
    return std::nullopt;
  }
  return letter;
}

std::string unescaped(std::string text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::string_view rest = std::string_view(text).substr(at);
    const bool begins = rest.substr(0, 3) == "\\U+" || rest.substr(0, 3) == "\\u+";
    const auto letter = begins ? escaped_letter(rest.substr(3)) : std::nullopt;
    if (letter) {
      append_utf8(out, *letter);
      at += 7;
    } else {
      out += text[at++];
    }
  }
  return out;
}

}  // namespace

std::string folded(std::string_view name) {
  std::string out(name);
  for (char& c : out) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return out;
}

std::string text_of_name(std::string_view name, std::string_view code_page) {
  std::string text(name);
  if (!is_ascii(name)) {
    const std::string charset = charset_of(code_page);
    if (is_double_byte(charset) || !is_utf8(name)) {
      auto letters = converted(name, charset);
      if (!letters && is_utf8(name)) letters = text;
      if (!letters) letters = converted(name, "CP1252");
      if (letters) text = std::move(*letters);
    }
  }
  text = unescaped(std::move(text));
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(std::string_view(text).substr(at));
    const auto byte = static_cast<unsigned char>(text[at]);
    const bool is_control = byte < 0x20 || byte == 0x7f ||
                            (byte == 0xc2 && length == 2 && static_cast<unsigned char>(text[at + 1]) < 0xa0);
    if (length == 0 || is_control) {
      out += fmt::format("\\x{:02x}", byte);
      ++at;
    } else {
      out += text.substr(at, length);
      at += length;
    }
  }
  return out;
}

std::string shown(std::string_view name) {
  const bool plain = name.size() <= 40 &&
                     std::all_of(name.begin(), name.end(), [](char c) { return c >= 0x20 && c < 0x7f; });
  return plain && !name.empty() ? std::string(name) : excerpt(name);
}

}  // namespace lekalo::io

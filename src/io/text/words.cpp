#include "lekalo/io/text/words.hpp"

#include <algorithm>
#include <vector>

namespace lekalo::io {
namespace {

constexpr char32_t kReplacement = 0xFFFD, kEllipsis = 0x2026;

int continuation_bytes(unsigned char lead) {
  if (lead < 0x80) return 0;
  if (lead >= 0xC2 && lead <= 0xDF) return 1;
  if (lead >= 0xE0 && lead <= 0xEF) return 2;
  if (lead >= 0xF0 && lead <= 0xF4) return 3;
  return -1;
}

/// The character that a text begins with, or else the longest piece that could have become one.
struct Beginning {
  char32_t code = kReplacement;
  std::size_t bytes = 1;
  bool whole = false;
};

/// \pre text is not empty
Beginning beginning_of(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const int more = continuation_bytes(lead);
  if (more < 0) return {};
  char32_t code = more == 0 ? lead : static_cast<char32_t>(lead & (0x3F >> more));
  // Longer forms than needed, surrogates and what lies beyond Unicode show in the second byte.
  unsigned low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
  unsigned high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
  for (std::size_t i = 1; i <= static_cast<std::size_t>(more); ++i) {
    const unsigned byte = i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
    if (byte < low || byte > high) return {kReplacement, i, false};
    code = (code << 6) | (byte & 0x3F);
    low = 0x80;
    high = 0xBF;
  }
  return {code, static_cast<std::size_t>(more) + 1, true};
}

/// Takes one character off the front; bytes that are not UTF-8 give U+FFFD one by one.
char32_t take_character(std::string_view& text) {
  const Beginning first = beginning_of(text);
  text.remove_prefix(first.whole ? first.bytes : 1);
  return first.code;
}

void append(std::string& text, char32_t code) {
  const auto byte = [&text](char32_t value) { text += static_cast<char>(static_cast<unsigned char>(value)); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | (code >> 6));
    byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | (code >> 12));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | (code >> 18));
    byte(0x80 | ((code >> 12) & 0x3F));
    byte(0x80 | ((code >> 6) & 0x3F));
    byte(0x80 | (code & 0x3F));
  }
}

/// The escape of JSON for one unit of UTF-16.
void append_escape(std::string& text, char32_t unit) {
  text += "\\u";
  for (int shift = 12; shift >= 0; shift -= 4) text += "0123456789abcdef"[(unit >> shift) & 0xF];
}

char32_t shown(char32_t code) {
  if (code == '\t' || code == '\n' || code == '\r') return ' ';
  const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  // Marks that turn the writing direction would let a name rearrange what stands around it.
  const bool direction = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069);
  return control || direction || (code & 0xFFFE) == 0xFFFE ? kReplacement : code;
}

std::vector<char32_t> characters(std::string_view text) {
  std::vector<char32_t> codes;
  while (!text.empty()) codes.push_back(shown(take_character(text)));
  return codes;
}

bool is_among(char32_t code, std::u32string_view set) { return set.find(code) != std::u32string_view::npos; }

double width_of(char32_t code) {
  if (is_among(code, U" \u00A0.,:;!|'ijlI·")) return 0.40;
  if (is_among(code, U"()[]{}/\\-rtf\"")) return 0.46;
  if (is_among(code, U"mwMW@%—ЖШЩЮМФжшщюыЫДф")) return 1.10;
  if (code >= '0' && code <= '9') return 0.64;
  if (code >= 'A' && code <= 'Z') return 0.80;
  if (code < 0x80) return 0.66;
  if (code >= 0x2070 && code <= 0x209F) return 0.42;  // raised and lowered digits
  if (code >= 0x0410 && code <= 0x042F) return 0.86;
  if (code >= 0x0430 && code <= 0x044F) return 0.68;
  if (code < 0x0600) return 0.76;
  return 1.1;  // ideographs and whatever else
}

double width_of(const std::vector<char32_t>& codes) {
  double sum = 0;
  for (const char32_t code : codes) sum += width_of(code);
  return sum;
}

std::string to_utf8(const std::vector<char32_t>& codes) {
  std::string text;
  for (const char32_t code : codes) append(text, code);
  return text;
}

}  // namespace

std::string json_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : as_utf8(text)) {
    constexpr std::string_view kEscaped = "\b\t\n\f\r\"\\", kLetters = "btnfr\"\\";
    if (const std::size_t at = kEscaped.find(c); at != kEscaped.npos) {
      quoted += '\\';
      quoted += kLetters[at];
    } else if (static_cast<unsigned char>(c) < 0x20) {
      append_escape(quoted, static_cast<unsigned char>(c));
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

std::string ascii_json(std::string_view json) {
  std::string ascii;
  while (!json.empty()) {
    const char32_t code = take_character(json);
    if (code < 0x7F) {
      ascii += static_cast<char>(code);
    } else if (code < 0x10000) {
      append_escape(ascii, code);
    } else {
      append_escape(ascii, 0xD7C0 + (code >> 10));
      append_escape(ascii, 0xDC00 + (code & 0x3FF));
    }
  }
  return ascii;
}

std::string as_utf8(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const Beginning first = beginning_of(text);
    first.whole ? clean.append(text, 0, first.bytes) : clean.append("\xEF\xBF\xBD");
    text.remove_prefix(first.bytes);
  }
  return clean;
}

std::string clean_text(std::string_view text) { return to_utf8(characters(text)); }

std::string xml_text(std::string_view text) {
  std::string result;
  for (const char c : clean_text(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      case '\'':
        result += "&#39;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

double text_width(std::string_view utf8) { return width_of(characters(utf8)); }

double fitting_size(std::string_view utf8, double size, double width) {
  const double one = text_width(utf8);
  return one * size > width ? width / one : size;
}

std::string shortened(std::string_view utf8, double width) {
  const std::vector<char32_t> codes = characters(utf8);
  if (width_of(codes) <= width) return to_utf8(codes);
  const double room = width - width_of(kEllipsis);
  std::size_t head = 0, tail = codes.size();
  double used_head = 0, used_tail = 0;
  while (head < tail) {
    const bool at_end = used_tail <= 1.3 * used_head;
    const double next = width_of(at_end ? codes[tail - 1] : codes[head]);
    if (used_head + used_tail + next > room) break;
    if (at_end) {
      --tail;
      used_tail += next;
    } else {
      ++head;
      used_head += next;
    }
  }
  std::vector<char32_t> kept(codes.begin(), codes.begin() + static_cast<std::ptrdiff_t>(head));
  kept.push_back(kEllipsis);
  kept.insert(kept.end(), codes.begin() + static_cast<std::ptrdiff_t>(tail), codes.end());
  return to_utf8(kept);
}

std::vector<std::string> wrapped(std::string_view utf8, double width, std::size_t most_lines) {
  const std::vector<char32_t> codes = characters(utf8);
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (begin < codes.size()) {
    if (codes[begin] == ' ') {
      ++begin;
      continue;
    }
    std::size_t end = begin, blank = begin;  // the line would be [begin, end), or end at the last blank
    double used = 0;
    const bool last = lines.size() + 1 == most_lines;
    while (end < codes.size() && used + width_of(codes[end]) <= width) {
      if (codes[end] == ' ') blank = end;
      used += width_of(codes[end++]);
    }
    if (end < codes.size() && last) {
      while (end > begin && used + width_of(kEllipsis) > width) used -= width_of(codes[--end]);
    } else if (end < codes.size() && blank > begin && codes[end] != ' ') {
      end = blank;
    }
    end = std::max(end, begin + 1);  // a letter wider than the line still gets one
    std::vector<char32_t> line(codes.begin() + static_cast<std::ptrdiff_t>(begin),
                               codes.begin() + static_cast<std::ptrdiff_t>(end));
    while (!line.empty() && line.back() == ' ') line.pop_back();
    if (last && end < codes.size()) line.push_back(kEllipsis);
    lines.push_back(to_utf8(line));
    if (last) break;
    begin = end;
  }
  return lines;
}

std::string file_name(std::string_view path) {
  const std::size_t slash = path.find_last_of("/\\");
  return std::string(slash == std::string_view::npos || slash + 1 == path.size() ? path
                                                                                 : path.substr(slash + 1));
}

std::string ending_of(const std::string& name) {
  const std::size_t slash = name.find_last_of('/');
  const std::size_t dot = name.find_last_of('.');
  if (dot == std::string::npos || (slash != std::string::npos && dot < slash)) return {};
  std::string ending = name.substr(dot);
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

std::string stem_of(const std::string& path) {
  const std::string name = path.substr(path.find_last_of('/') + 1);
  const std::size_t dot = name.find_last_of('.');
  return dot == std::string::npos || dot == 0 || name == ".." ? name : name.substr(0, dot);
}

}  // namespace lekalo::io

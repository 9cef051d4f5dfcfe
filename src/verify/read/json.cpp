#include "json.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "lekalo/base/stop.hpp"
#include "verify/number/exact.hpp"

namespace lekalo::verify {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }

std::string_view without_mark(std::string_view bytes) {
  if (bytes.substr(0, 3) == "\xEF\xBB\xBF") bytes.remove_prefix(3);
  return bytes;
}

/// Checks the grammar from the front of a document, and keeps where and why it stopped.
class GrammarCheck {
 public:
  explicit GrammarCheck(std::string_view text) : text_(text) {}

  bool document() {
    if (!value(0)) return false;
    skip_blanks();
    return at_ == text_.size() || fail("there is more after the end of the document");
  }
  [[nodiscard]] std::size_t line() const {
    return 1 +
           static_cast<std::size_t>(std::count(text_.begin(), text_.begin() + static_cast<long>(at_), '\n'));
  }
  [[nodiscard]] const char* reason() const { return reason_; }

 private:
  [[nodiscard]] char here() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool fail(const char* reason) {
    reason_ = reason;
    return false;
  }
  void skip_blanks() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
  }
  bool take(char c) {
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool word(std::string_view expected) {
    if (text_.substr(at_, expected.size()) != expected) return fail("a value is not JSON");
    at_ += expected.size();
    return true;
  }

  bool value(int depth) {
    ask();
    if (depth > kMaxJsonDepth) return fail("lists and objects are nested more than 64 deep");
    skip_blanks();
    switch (here()) {
      case '{':
        return members(depth);
      case '[':
        return items(depth);
      case '"':
        return string();
      case 't':
        return word("true");
      case 'f':
        return word("false");
      case 'n':
        return word("null");
      default:
        return number();
    }
  }

  bool members(int depth) {
    take('{');
    skip_blanks();
    if (take('}')) return true;
    do {
      skip_blanks();
      if (here() != '"') return fail("an object needs a name in quotes here");
      if (!string()) return false;
      skip_blanks();
      if (!take(':')) return fail("a colon is missing after a name");
      if (!value(depth + 1)) return false;
      skip_blanks();
    } while (take(','));
    return take('}') || fail("an object is not closed");
  }

  bool items(int depth) {
    take('[');
    skip_blanks();
    if (take(']')) return true;
    do {
      if (!value(depth + 1)) return false;
      skip_blanks();
    } while (take(','));
    return take(']') || fail("a list is not closed");
  }

  bool string() {
    take('"');
    while (at_ < text_.size()) {
      const char c = text_[at_++];
      if (c == '"') return true;
      if (static_cast<unsigned char>(c) < 0x20) return fail("a text holds a control character");
      if (c == '\\' && !escape()) return fail("a text holds an escape that JSON does not know");
    }
    return fail("a text is not closed");
  }

  bool escape() {
    const char c = here();
    if (c == '\0') return false;  // the end of the document, too
    ++at_;
    if (c != 'u') return std::string_view("\"\\/bfnrt").find(c) != std::string_view::npos;
    for (int i = 0; i < 4; ++i, ++at_) {
      if (!is_hex(here())) return false;
    }
    return true;
  }

  bool digits() {
    if (!is_digit(here())) return fail("a value is not JSON");
    while (is_digit(here())) ++at_;
    return true;
  }

  bool number() {
    take('-');
    if (!take('0') && !digits()) return false;
    if (take('.') && !digits()) return false;
    if (take('e') || take('E')) {
      if (!take('-')) take('+');
      return digits();
    }
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  const char* reason_ = "";
};

/// Returns the length of the string at the front of checked text, quotes included.
std::size_t string_length(std::string_view text) {
  std::size_t n = 1;
  while (text[n] != '"') n += text[n] == '\\' ? 2 : 1;
  return n + 1;
}

/// Says of each character whether it ends a plain stretch between brackets and quotes.
constexpr std::array<bool, 256> kStructure = [] {
  std::array<bool, 256> table{};
  for (const char c : {'"', '{', '}', '[', ']'}) table[static_cast<unsigned char>(c)] = true;
  return table;
}();

/// Says of eight characters at once that none of them does. The answer is no also where one is a letter.
bool all_plain(std::string_view eight) {
  constexpr std::uint64_t kOnes = 0x0101010101010101;
  std::uint64_t word;
  std::memcpy(&word, eight.data(), sizeof word);
  const std::uint64_t quotes = word ^ '"' * kOnes;  // 0 where a quote stands
  return (word & '@' * kOnes) == 0 && ((quotes - kOnes) & ~quotes & 0x80 * kOnes) == 0;
}

/// Returns the length of the value at the front of checked text.
std::size_t value_length(std::string_view text) {
  if (text[0] == '"') return string_length(text);
  std::size_t n = 0;
  if (text[0] != '{' && text[0] != '[') {
    // The brackets around the value are taken off before, so that none comes behind it.
    while (n < text.size() && !is_blank(text[n]) && text[n] != ',') ++n;
    return n;
  }
  int depth = 0;
  do {
    // Every level of a document passes over what is in it, so that these loops are most of reading one.
    while (n + 8 <= text.size() && all_plain(text.substr(n, 8))) n += 8;
    while (!kStructure[static_cast<unsigned char>(text[n])]) ++n;
    const char c = text[n];
    if (c == '"') {
      n += string_length(text.substr(n));
      continue;
    }
    depth += c == '{' || c == '[' ? 1 : -1;
    ++n;
  } while (depth > 0);
  return n;
}

unsigned hex_value(std::string_view digits) {
  unsigned value = 0;
  for (const char c : digits) {
    value = value * 16 + static_cast<unsigned>(is_digit(c) ? c - '0' : (c | 0x20) - 'a' + 10);
  }
  return value;
}

void append_utf8(std::string& out, unsigned code) {
  if (code < 0x80) {
    out += static_cast<char>(code);
  } else if (code < 0x800) {
    out += static_cast<char>(0xC0 | (code >> 6));
    out += static_cast<char>(0x80 | (code & 0x3F));
  } else {
    out += static_cast<char>(0xE0 | (code >> 12));
    out += static_cast<char>(0x80 | ((code >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (code & 0x3F));
  }
}

}  // namespace

Result<Json> parse_json(std::string_view bytes, std::string_view name) {
  const std::string_view text = without_mark(bytes);
  GrammarCheck check(text);
  if (!check.document()) {
    return failure(ErrorCode::bad_input,
                   fmt::format("{}:{}: not JSON: {}", name, check.line(), check.reason()));
  }
  const std::size_t begin = text.find_first_not_of(" \t\n\r");
  return Json{text.substr(begin, value_length(text.substr(begin)))};
}

std::string json_text(Json string) {
  const std::string_view inner = string.text.substr(1, string.text.size() - 2);
  std::string out;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    if (inner[i] != '\\') {
      out += inner[i];
      continue;
    }
    const char c = inner[++i];
    if (c == 'u') {
      // The halves of a surrogate pair are kept apart, because such texts are only ever compared with plain
      // words.
      append_utf8(out, hex_value(inner.substr(i + 1, 4)));
      i += 4;
    } else {
      const std::string_view names = "bfnrt", values = "\b\f\n\r\t";
      const std::size_t which = names.find(c);
      out += which == std::string_view::npos ? c : values[which];
    }
  }
  return out;
}

JsonItems::JsonItems(Json list_or_object)
    : rest_(list_or_object.text.substr(1, list_or_object.text.size() - 2)),
      object_(list_or_object.is_object()) {}

std::optional<Json> JsonItems::next() {
  ask();
  const auto skip = [this] {
    std::size_t n = 0;
    while (n < rest_.size() && (is_blank(rest_[n]) || rest_[n] == ',' || rest_[n] == ':')) ++n;
    rest_.remove_prefix(n);
  };
  skip();
  if (rest_.empty()) return std::nullopt;
  if (object_) {
    const std::size_t length = string_length(rest_);
    key_ = json_text({rest_.substr(0, length)});
    rest_.remove_prefix(length);
    skip();
  }
  const Json item{rest_.substr(0, value_length(rest_))};
  rest_.remove_prefix(item.text.size());
  return item;
}

std::size_t count_items(Json list) {
  std::size_t count = 0;
  for (JsonItems items(list); items.next();) ++count;
  return count;
}

bool find_members(Json object, std::span<const std::string_view> keys, std::span<Json> found) {
  std::fill(found.begin(), found.end(), Json{});
  JsonItems members(object);
  while (const std::optional<Json> member = members.next()) {
    const auto key = std::find(keys.begin(), keys.end(), members.key());
    if (key == keys.end()) continue;
    Json& slot = found[static_cast<std::size_t>(key - keys.begin())];
    if (!slot.text.empty()) return false;
    slot = *member;
  }
  return true;
}

}  // namespace lekalo::verify

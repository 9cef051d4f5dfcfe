#include "text_rows.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace lekalo::verify {
namespace {

constexpr std::string_view kBlanks = " \t\r\v\f";

bool begins_with_number(std::string_view line) {
  if (line.starts_with('+') || line.starts_with('-')) line.remove_prefix(1);
  if (line.starts_with('.')) line.remove_prefix(1);
  return line.find_first_of("0123456789") == 0;
}

bool is_comment(std::string_view line) {
  return line.front() == '#' || line.front() == ';' || line.front() == '%' || line.substr(0, 2) == "//";
}

/// Cuts a line at blanks, or at one comma or semicolon with blanks around it.
std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t end = std::min(line.find_first_of(" \t\r\v\f,;"), line.size());
    fields.push_back(line.substr(0, end));
    line = trimmed(line.substr(end));
    if (line.empty()) return fields;
    if (line.front() == ',' || line.front() == ';') {
      line = trimmed(line.substr(1));
      if (line.empty()) {
        fields.emplace_back();
        return fields;
      }
    }
  }
}

/// A word before a number is a mistyped point, and no head of a table. A head may have blanks in its fields.
bool may_be_header(std::string_view line) {
  std::vector<std::string_view> fields;
  const std::size_t separator = line.find(line.find(';') == std::string_view::npos ? ',' : ';');
  if (separator == std::string_view::npos) {
    fields = fields_of(line);
  } else {
    const char mark = line[separator];
    for (std::size_t at = 0; at <= line.size();) {
      const std::size_t end = std::min(line.find(mark, at), line.size());
      fields.push_back(trimmed(line.substr(at, end - at)));
      at = end + 1;
    }
  }
  return fields.size() < 2 || fields.size() > 3 || !parse_decimal(fields[1]);
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

tl::unexpected<Error> bad_line(const Document& document, std::size_t line, const std::string& sentence) {
  return failure(ErrorCode::bad_input, fmt::format("{}:{}: {}", document.name, line, sentence));
}

Lines::Lines(std::string_view bytes) : rest_(bytes) {
  if (rest_.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
}

std::optional<std::string_view> Lines::next() {
  if (rest_.empty()) return std::nullopt;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  const std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++number_;
  return trimmed(line);
}

Result<void> read_text_rows(const Document& document, const std::function<Result<void>(TextRow&&)>& take,
                            bool in_space) {
  bool header_allowed = true, gap = false;
  Lines lines(document.bytes);
  while (const auto whole = lines.next()) {
    gap = gap || whole->empty();
    if (whole->empty() || is_comment(*whole)) continue;
    const std::string_view line = trimmed(whole->substr(0, whole->find('#')));
    if (std::exchange(header_allowed, false) && !begins_with_number(line) && may_be_header(line)) continue;
    const std::vector<std::string_view> fields = fields_of(line);
    if (fields.size() != 2 && fields.size() != 3 && !(in_space && fields.size() == 6))
      return bad_line(document, lines.number(),
                      fmt::format("{} fields where a point needs x and y: {}", fields.size(), excerpt(line)));
    TextRow row;
    row.count = fields.size(), row.line = lines.number(), row.after_a_gap = std::exchange(gap, false);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      auto number = parse_decimal(fields[i]);
      if (!number)
        return bad_line(document, lines.number(),
                        fmt::format("\"{}\" is not {}", excerpt(fields[i]), decimal_rule()));
      (i < 3 ? row.numbers[i] : row.direction[i - 3]) = *std::move(number);
    }
    LEKALO_CHECK(take(std::move(row)));
  }
  return {};
}

}  // namespace lekalo::verify

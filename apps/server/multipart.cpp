#include "multipart.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <utility>

namespace lekalo::server {
namespace {

constexpr std::string_view kLineEnd = "\r\n";
constexpr std::size_t kLongestBoundary = 72;  // RFC 2046, with its dashes
constexpr std::size_t kLongestHeader = 4096;

/// Takes what stands before a mark, and the mark; nothing where there is none within `most` bytes.
std::optional<std::string_view> take_until(std::string_view& rest, std::string_view mark,
                                           std::size_t most = std::string_view::npos) {
  const std::size_t at = rest.substr(0, most).find(mark);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view taken = rest.substr(0, at);
  rest.remove_prefix(at + mark.size());
  return taken;
}

bool begins_so(std::string_view line, std::string_view lower) {
  return line.size() >= lower.size() &&
         std::equal(lower.begin(), lower.end(), line.begin(), [](char a, char b) {
           return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
         });
}

/// The value of name="..." in a header; browsers write quotes and line ends in it as %22, %0D and %0A.
std::optional<std::string> parameter(std::string_view header, std::string_view name) {
  const std::string wanted = fmt::format("; {}=\"", name);
  const std::size_t at = header.find(wanted);
  if (at == std::string_view::npos) return std::nullopt;
  const std::string_view value = header.substr(at + wanted.size());
  const std::size_t end = value.find('"');
  if (end == std::string_view::npos) return std::nullopt;
  return std::string(value.substr(0, end));
}

}  // namespace

Result<std::vector<FormField>> read_form(std::string_view body) {
  const auto broken = [](const std::string& why) {
    return failure(ErrorCode::bad_input,
                   fmt::format("the request is no form (multipart/form-data): {}", why));
  };
  std::string_view rest = body;
  const auto boundary = take_until(rest, kLineEnd, kLongestBoundary + kLineEnd.size());
  if (!boundary || boundary->size() < 3 || boundary->substr(0, 2) != "--")
    return broken("its first line is no boundary");
  const std::string mark = fmt::format("{}{}", kLineEnd, *boundary);
  std::vector<FormField> fields;
  for (;;) {
    if (fields.size() == kMostFormFields)
      return broken(fmt::format("it has more than {} fields", kMostFormFields));
    FormField field;
    bool is_named = false;
    std::size_t header_bytes = 0;
    for (;;) {
      const auto line = take_until(rest, kLineEnd, kLongestHeader);
      if (!line) return broken("a header does not end");
      if (line->empty()) break;
      header_bytes += line->size();
      if (header_bytes > kLongestHeader) return broken("a header does not end");
      if (!begins_so(*line, "content-disposition: form-data")) continue;
      const auto name = parameter(*line, "name");
      is_named = name.has_value();
      field.name = name.value_or("");
      field.file = parameter(*line, "filename").value_or("");
    }
    if (!is_named) return broken("a field has no name");
    const auto value = take_until(rest, mark);
    if (!value) return broken("its last boundary is missing");
    field.value = *value;
    fields.push_back(std::move(field));
    if (rest.substr(0, 2) == "--") return fields;
    if (!take_until(rest, kLineEnd, kLineEnd.size())) return broken("a boundary does not end its line");
  }
}

}  // namespace lekalo::server

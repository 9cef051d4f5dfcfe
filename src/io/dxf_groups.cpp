#include "dxf_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "contour_points.hpp"

namespace lekalo::io {

std::optional<std::string_view> DxfGroups::next_line() {
  if (rest_.empty()) return std::nullopt;
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  std::string_view line = rest_.substr(0, end);
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  ++line_;
  line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
  return line.substr(0, line.find_last_not_of(kBlanks) + 1);
}

bool DxfGroups::next(DxfGroup& group) {
  const auto code = next_line();
  if (!code) return false;
  // Editors leave empty lines at the end.
  if (code->empty() && rest_.find_first_not_of(" \t\r\n\x1a") == std::string_view::npos) return false;
  const auto [end, error] = std::from_chars(code->data(), code->data() + code->size(), group.code);
  if (error != std::errc() || end != code->data() + code->size() || group.code < 0 || group.code > 1071) {
    fault_ = refuse_line(name_, line_, fmt::format("{} is not a DXF group code", excerpt(*code))).value();
    return false;
  }
  const auto value = next_line();
  if (!value) {
    fault_ = refuse_line(name_, line_, "the file ends after a group code; it is not complete").value();
    return false;
  }
  group.value = *value;
  group.line = line_;
  return true;
}

}  // namespace lekalo::io

#include "lekalo/nc/allow_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "lekalo/nc/decimal.hpp"

namespace lekalo::nc {
namespace {

/// They end the program, change tool or pallet, save modes or call subprograms.
constexpr std::array kNever{2, 6, 30, 60, 70, 71, 72, 73, 96, 97, 98, 99};

std::string_view trimmed(std::string_view text) {
  text = text.substr(0, text.find_first_of("#;("));
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

Result<std::vector<int>> parse_allow_list(std::string_view text, const std::string& name) {
  std::vector<int> allowed;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view word = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    const auto refuse = [&](const std::string& why) {
      return failure(ErrorCode::bad_input, fmt::format("{}:{}: {}", name, line, why));
    };
    const bool m = word.front() == 'M' || word.front() == 'm';
    const ParsedDecimal number = m ? parse_decimal(word.substr(1)) : ParsedDecimal{};
    const auto whole = number.value ? number.value->whole() : std::nullopt;
    if (!whole || *whole < 0 || *whole > 999)
      return refuse(fmt::format("\"{}\" is no M word such as M130, from M0 to M999", word.substr(0, 40)));
    if (std::ranges::find(kNever, *whole) != kNever.end())
      return refuse(fmt::format("M{} changes what the program means and cannot be allowed", *whole));
    allowed.push_back(static_cast<int>(*whole));
  }
  return allowed;
}

}  // namespace lekalo::nc

#include "access.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace lekalo::server {
namespace {

bool is_our_host(const AccessRules& rules, std::string_view host) {
  if (rules.any_host) return !host.empty();
  const bool is_v6 = rules.address.find(':') != std::string::npos;
  for (const std::string& name : {std::string("127.0.0.1"), std::string("localhost"), std::string("[::1]"),
                                  is_v6 ? "[" + rules.address + "]" : rules.address})
    if (host == fmt::format("{}:{}", name, rules.port) || (rules.port == 80 && host == name)) return true;
  return false;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string_view cookie_value(std::string_view cookies) {
  while (!cookies.empty()) {
    const std::size_t end = std::min(cookies.find(';'), cookies.size());
    const std::string_view one = trimmed(cookies.substr(0, end));
    cookies.remove_prefix(std::min(end + 1, cookies.size()));
    const std::size_t equal = one.find('=');
    if (equal != one.npos && one.substr(0, equal) == kTokenCookie) return one.substr(equal + 1);
  }
  return {};
}

}  // namespace

bool same_secret(std::string_view a, std::string_view b) noexcept {
  if (a.size() != b.size()) return false;
  unsigned difference = 0;
  for (std::size_t i = 0; i < a.size(); ++i) difference |= static_cast<unsigned char>(a[i] ^ b[i]);
  return difference == 0;
}

std::string refusal(const AccessRules& rules, const Credentials& request) {
  if (!is_our_host(rules, request.host)) return "this server does not go by that name (Host)";
  if (!request.origin.empty() && request.origin != fmt::format("http://{}", request.host))
    return "requests from pages of other sites are refused (Origin)";
  if (rules.token.empty()) return {};
  constexpr std::string_view kBearer = "Bearer ";
  const std::string_view bearer =
      request.authorization.starts_with(kBearer) ? request.authorization.substr(kBearer.size()) : "";
  for (const std::string_view given : {request.token, bearer, cookie_value(request.cookie)})
    if (same_secret(given, rules.token)) return {};
  return "the token is missing or wrong; open the address that the server printed";
}

}  // namespace lekalo::server

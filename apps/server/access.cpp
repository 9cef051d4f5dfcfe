#include "access.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <set>

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

std::optional<Refusal> refusal(const AccessRules& rules, const Credentials& request) {
  if (!is_our_host(rules, request.host)) return Refusal{"this server does not go by that name (Host)"};
  if (!request.origin.empty() && request.origin != fmt::format("http://{}", request.host))
    return Refusal{"requests from pages of other sites are refused (Origin)"};
  const std::string_view site = request.fetch_site;
  if (!site.empty() && site != "same-origin" && site != "none" && !request.opens_page)
    return Refusal{"requests from pages of other sites are refused (Sec-Fetch-Site)"};
  if (rules.token.empty()) return std::nullopt;
  constexpr std::string_view kBearer = "Bearer ";
  const std::string_view bearer =
      request.authorization.starts_with(kBearer) ? request.authorization.substr(kBearer.size()) : "";
  bool any = false;
  for (const std::string_view given : {request.token, bearer, cookie_value(request.cookie)}) {
    if (same_secret(given, rules.token)) return std::nullopt;
    any = any || !given.empty();
  }
  return Refusal{"the token is missing or wrong; open the page with ?token= and the server's token", any};
}

Result<void> check_token(std::string_view token) {
  constexpr std::size_t kShortest = 22, kShortestHexadecimal = 32, kLongest = 200, kLeastDifferent = 8;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto plain = [&](char c) {
    return digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-' || c == '_';
  };
  const auto hexadecimal = [&](char c) {
    return digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
  };
  const std::size_t shortest =
      std::all_of(token.begin(), token.end(), hexadecimal) ? kShortestHexadecimal : kShortest;
  const std::size_t different = std::set<char>(token.begin(), token.end()).size();
  if (std::all_of(token.begin(), token.end(), plain) && token.size() >= shortest &&
      token.size() <= kLongest && different >= kLeastDifferent)
    return {};
  return failure(ErrorCode::usage,
                 fmt::format("a token has at least 128 random bits: {} hexadecimal digits, or {} to {} "
                             "letters, digits, - or _; 'openssl rand -hex 16' makes one",
                             kShortestHexadecimal, kShortest, kLongest));
}

std::optional<double> Guesses::wrong(const std::string& peer, double now) {
  constexpr double kFree = 10, kLongestWait = 10;  // s
  constexpr std::size_t kMostPeers = 10'000;
  if (paid_until_.size() >= kMostPeers && now >= forgot_ + 1) {
    std::erase_if(paid_until_, [now](const auto& one) { return one.second <= now; });
    forgot_ = now;
  }
  // A peer that comes when so many guess at once shares one account with others like it.
  const bool known = paid_until_.find(peer) != paid_until_.end() || paid_until_.size() < kMostPeers;
  double& paid = paid_until_[known ? peer : std::string()];
  const double wait = std::max(paid, now) + 1 - now - kFree;
  if (wait > kLongestWait) return std::nullopt;
  paid = std::max(paid, now) + 1;
  return std::max(0.0, wait);
}

}  // namespace lekalo::server

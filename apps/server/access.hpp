#pragma once

#include <string>
#include <string_view>

namespace lekalo::server {

/// The values of a request's headers that say who asks (docs/protocol.md), empty where they are absent.
struct Credentials {
  std::string_view host, origin, authorization, cookie;
  std::string_view token;  ///< of the query
};

struct AccessRules {
  std::string address;  ///< the server listens as
  unsigned port = 0;
  bool any_host = false;  ///< it listens on every address of the machine
  std::string token;      ///< empty: none is asked for
};

/// Says why a request may not be answered; empty where it may. A page of another site can make a browser send
/// requests here, but with its own name as Origin, and, where its name was made to lead here, as Host.
[[nodiscard]] std::string refusal(const AccessRules& rules, const Credentials& request);
/// Compares all bytes whatever they are, so that the time says nothing.
[[nodiscard]] bool same_secret(std::string_view a, std::string_view b) noexcept;
/// The name of the cookie that carries the token on.
inline constexpr std::string_view kTokenCookie = "lekalo_token";

}  // namespace lekalo::server

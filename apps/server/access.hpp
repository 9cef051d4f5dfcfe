#pragma once

#include <string>
#include <string_view>

namespace lekalo::server {

/// The values of a request's headers that say who asks (docs/protocol.md), empty where they are absent.
struct Credentials {
  std::string_view host, origin, authorization, cookie;
  /// The token in the request's query.
  std::string_view token;
};

struct AccessRules {
  /// The address that the server listens on.
  std::string address;
  unsigned port = 0;
  /// True when the server listens on every address of the machine.
  bool any_host = false;
  /// The token that a request must carry; empty when none is asked for.
  std::string token;
};

/// Says why a request may not be answered; empty where it may. A page of another site can make a browser send
/// requests to this server, but the browser then gives that site's name as Origin. Where the site's name was
/// made to lead here, the browser gives that name as Host.
[[nodiscard]] std::string refusal(const AccessRules& rules, const Credentials& request);
/// Compares two secrets. All bytes are compared whatever they are, so that the time taken tells nothing about
/// them.
[[nodiscard]] bool same_secret(std::string_view a, std::string_view b) noexcept;
/// The name of the cookie that carries the token from request to request.
inline constexpr std::string_view kTokenCookie = "lekalo_token";

}  // namespace lekalo::server

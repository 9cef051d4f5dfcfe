#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"

namespace lekalo::server {

/// The values of a request's headers that say who asks (docs/protocol.md), empty where they are absent.
struct Credentials {
  std::string_view host, origin, authorization, cookie;
  /// The token in the request's query.
  std::string_view token;
  /// Sec-Fetch-Site, in which a browser says from where the request comes.
  std::string_view fetch_site;
  /// True when the browser says that somebody follows a link to the page itself.
  bool opens_page = false;
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

/// The reason why a request is not answered.
struct Refusal {
  std::string sentence;
  /// True when the request came with a token and it is another one: somebody may be guessing.
  bool wrong_token = false;
};

/// Says why a request may not be answered; nothing where it may. A page of another site can make a browser
/// send requests to this server, but the browser then gives that site's name as Origin, or says in
/// Sec-Fetch-Site that it is another one. Where the site's name was made to lead here, the browser gives that
/// name as Host.
[[nodiscard]] std::optional<Refusal> refusal(const AccessRules& rules, const Credentials& request);
/// Compares two secrets of one length. All bytes are compared whatever they are, so that the time taken tells
/// nothing about them.
[[nodiscard]] bool same_secret(std::string_view a, std::string_view b) noexcept;
/// The name of the cookie that carries the token from request to request.
inline constexpr std::string_view kTokenCookie = "lekalo_token";

/// Fails with ErrorCode::usage unless the token can have 128 random bits: 22 to 200 letters, digits, - or _,
/// at least 32 where all are hexadecimal digits, and at least 8 different ones.
[[nodiscard]] Result<void> check_token(std::string_view token);

/// Slows down who guesses tokens: ten wrong ones of a peer are answered at once, then one each second, and
/// further ones not at all. The right token is never held up, so nobody can lock others out, also not those
/// behind the same address.
class Guesses {
 public:
  /// Takes note of a wrong token. \param now  seconds of any clock that does not go back
  /// Returns how many seconds its answer has to wait; nothing where it gets none.
  [[nodiscard]] std::optional<double> wrong(const std::string& peer, double now);
  /// Returns how many peers are remembered.
  [[nodiscard]] std::size_t peers() const noexcept { return paid_until_.size(); }

 private:
  /// Each wrong token costs its peer a second; up to here the seconds are used up.
  std::map<std::string, double> paid_until_;
  double forgot_ = 0;  ///< when those who have paid were forgotten last
};

}  // namespace lekalo::server

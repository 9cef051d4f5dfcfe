#pragma once

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <string>
#include <string_view>
#include <tl/expected.hpp>

#include "access.hpp"
#include "messages.hpp"

namespace lekalo::server {

[[nodiscard]] inline std::string_view view(boost::beast::string_view text) {
  return {text.data(), text.size()};
}

/// A request that is not answered: the status and the sentence that it gets.
struct Declined {
  int status = 0;
  std::string sentence;
  /// True when somebody may be guessing the token.
  bool wrong_token = false;
};

/// Looks at the head of a request before anything of its body is read, and returns its target if it may be
/// answered: the target is understood, no header that counts stands twice, and access.hpp has nothing
/// against who asks.
[[nodiscard]] tl::expected<Target, Declined> admit(
    const AccessRules& rules, const boost::beast::http::request<boost::beast::http::string_body>& request);

}  // namespace lekalo::server

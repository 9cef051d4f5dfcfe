#include "admission.hpp"

#include <optional>
#include <string_view>

namespace lekalo::server {
namespace {

namespace http = boost::beast::http;

/// Says whether somebody follows a link to the page: nothing but the page's own files comes of it.
bool opens_page(const http::request<http::string_body>& request, const Target& target) {
  return (request.method() == http::verb::get || request.method() == http::verb::head) &&
         !target.path.starts_with("/api") && target.path != "/ws" &&
         view(request["Sec-Fetch-Mode"]) == "navigate" && view(request["Sec-Fetch-Dest"]) == "document";
}

}  // namespace

tl::expected<Target, Declined> admit(const AccessRules& rules,
                                     const http::request<http::string_body>& request) {
  std::optional<Target> target = parse_target(view(request.target()));
  if (!target) return tl::unexpected(Declined{400, "the target of the request is not understood"});
  for (const char* once : {"Host", "Origin", "Cookie", "Authorization", "Sec-Fetch-Site"})
    if (request.count(once) > 1)  // nobody could tell which of two counts
      return tl::unexpected(Declined{400, "a header that may stand once stands twice"});
  const std::string* const token = target->find("token");
  const std::optional<Refusal> why =
      refusal(rules, {view(request[http::field::host]), view(request[http::field::origin]),
                      view(request[http::field::authorization]), view(request[http::field::cookie]),
                      token != nullptr ? std::string_view(*token) : std::string_view(),
                      view(request["Sec-Fetch-Site"]), opens_page(request, *target)});
  if (why) return tl::unexpected(Declined{403, why->sentence, why->wrong_token});
  return std::move(*target);
}

}  // namespace lekalo::server

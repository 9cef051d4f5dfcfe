#include <boost/asio/buffer.hpp>
#include <boost/beast/http/parser.hpp>

#include "io_contour_check.hpp"
#include "lekalo/base/plain_text.hpp"
#include "server/api.hpp"
#include "server/network/admission.hpp"
#include "server/page.hpp"

// The heads of requests, as any bytes, through the parser, the rules of access and what is read from paths.
// Nobody gets in whose bytes lack our name or the token, and no path leads anywhere but to what is there.

namespace {

using namespace lekalo;
namespace http = boost::beast::http;

constexpr const char* kToken = "0123456789abcdef0123456789abcdef";

void check_path(const std::string& method, const std::string& path) {
  using fuzz::must;
  const auto changed = server::layout_changed_by(method, path);
  must(!changed || (*changed > 0 && path.starts_with("/api/layouts/")));
  must(server::most_body(method, path) == 0 || method == "POST" || method == "PUT");
  const bool is_long = server::takes_long(method, path, 0);
  must(!is_long || path.starts_with("/api/layouts/"));
  const server::ApiAnswer page = server::answer_page(method, path);
  must(page.status == 200 || page.status == 404 || page.status == 405);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using fuzz::must;
  http::request_parser<http::string_body> parser;
  parser.header_limit(16 * 1024);
  parser.body_limit(std::uint64_t{1} << 20);
  parser.eager(false);
  boost::beast::error_code error;
  parser.put(boost::asio::const_buffer(data, size), error);
  if (error || !parser.is_header_done()) return 0;
  const auto& request = parser.get();
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  const server::AccessRules open{"127.0.0.1", 8080, false, ""}, locked{"127.0.0.1", 8080, false, kToken};
  const auto target = server::admit(open, request), known = server::admit(locked, request);
  must(target || (target.error().status >= 400 && is_plain_text(target.error().sentence)));
  if (known) {
    must(bytes.find(":8080") != std::string::npos);
    // Without a sign that is written as a number, the token stands there as it is.
    must(bytes.find(kToken) != std::string::npos || bytes.find('%') != std::string::npos);
    must(target && target->path == known->path && target->fields == known->fields);
  }
  if (!target) return 0;
  must(request.count(http::field::host) == 1);
  must(target->path.starts_with('/') && target->path.find('?') == std::string::npos);
  for (std::size_t i = 0; i < target->fields.size(); ++i)
    must(target->find(target->fields[i].first) == &target->fields[i].second);  // no field stands twice
  check_path(std::string(request.method_string()), target->path);
  return 0;
}

#include "visit.hpp"

#include <fmt/core.h>
#include <sys/socket.h>

#include <array>
#include <atomic>
#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket/rfc6455.hpp>
#include <cerrno>
#include <chrono>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <utility>

#include "api.hpp"
#include "lekalo/base/plain_text.hpp"
#include "messages.hpp"
#include "page.hpp"
#include "talk.hpp"

namespace lekalo::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using boost::system::error_code;
using std::chrono::seconds;
using Request = http::request<http::string_body>;
using Reply = http::response<http::string_body>;

constexpr std::uint32_t kLargestHeader = 16 * 1024;
constexpr std::uint64_t kLargestUpload = std::uint64_t{64} << 20;
constexpr auto kBodyTime = seconds(120), kFarewell = seconds(1);

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// One HTTP connection, until it ends or becomes a Talk.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(Service& service, tcp::socket&& socket) : service_(service), socket_(std::move(socket)) {
    ++service_.connections;
  }
  ~Visit() { --service_.connections; }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(kLargestHeader);
    // This limit holds until the header says what the body is for.
    parser_->body_limit(kLargestUpload);
    socket_.expires_after(kHeaderTime);
    http::async_read_header(socket_, incoming_, *parser_,
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error) return self->broken(error);
                              self->take_header();
                            });
  }

 private:
  [[nodiscard]] std::string_view field(http::field name) const { return view(parser_->get()[name]); }

  void take_header() {
    const Request& request = parser_->get();
    version_ = request.version();
    keep_alive_ = request.keep_alive() && !service_.stopping;
    head_ = request.method() == http::verb::head;
    target_ = parse_target(view(request.target()));
    if (!target_) return refuse(400, "the target of the request is not understood");
    const std::string* const token = target_->find("token");
    // Each of these headers may stand only once, because nobody could tell which of two counts.
    for (const http::field once : {http::field::host, http::field::origin, http::field::cookie})
      if (request.count(once) > 1) return refuse(400, "a header that may stand once stands twice");
    const std::string why =
        refusal(service_.rules, {field(http::field::host), field(http::field::origin),
                                 field(http::field::authorization), field(http::field::cookie),
                                 token != nullptr ? std::string_view(*token) : std::string_view()});
    if (!why.empty()) return refuse(403, why);
    new_token_ = token != nullptr && !service_.rules.token.empty();
    if (target_->path == "/ws") return upgrade();
    const std::size_t most = most_body(view(request.method_string()), target_->path);
    parser_->body_limit(most);
    const auto length = parser_->content_length();
    if (length && *length > most)
      return refuse(413, most > 0 ? fmt::format("the file is larger than {} MiB", most >> 20)
                                  : "this request has no body");
    if (view(request[http::field::expect]) == "100-continue") return go_on();
    read_body();
  }
  /// Tells the client to send its body. Some clients wait for that before they send a file.
  void go_on() {
    reply_.emplace(http::status::continue_, version_);
    reply_->prepare_payload();
    write_reply([this] { read_body(); });
  }
  /// The compiler builds the writing of a reply once, here.
  void write_reply(std::function<void()> then) {
    http::async_write(socket_, *reply_,
                      [self = shared_from_this(), then = std::move(then)](error_code error, std::size_t) {
                        if (!error) then();
                      });
  }
  void read_body() {
    socket_.expires_after(kBodyTime);
    http::async_read(socket_, incoming_, *parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (error) return self->broken(error);
                       self->answer();
                     });
  }
  void broken(error_code error) {
    if (error == http::error::body_limit) return refuse(413, "the request is too large");
    if (error == http::error::header_limit) return refuse(431, "the headers of the request are too large");
    // This is a failure of the parser, and not of the connection.
    if (error.category() == http::make_error_code(http::error::bad_method).category() &&
        error != http::error::end_of_stream && error != http::error::partial_message)
      return refuse(400, "this is no HTTP request that is understood");
    error_code ignored;
    socket_.socket().shutdown(tcp::socket::shutdown_both, ignored);
  }
  void refuse(int status, const std::string& sentence) {
    keep_alive_ = false;  // the body, if any, is not read
    send(api_error(status, sentence));
  }

  void upgrade() {
    const Request& request = parser_->get();
    if (!websocket::is_upgrade(request)) return refuse(400, "/ws is a WebSocket");
    const std::string_view offered = field(http::field::sec_websocket_protocol);
    if (offered.find(kSubprotocol) == offered.npos)
      return refuse(400, "the WebSocket has to offer the subprotocol lekalo.1");
    const std::string* const layout = target_->find("layout");
    const auto id = layout != nullptr ? whole_number(*layout) : std::nullopt;
    if (!id || *id == 0) return refuse(400, "the layout is missing or no whole number: ?layout=");
    const std::string* const author = target_->find("author");
    constexpr std::size_t kLongestAuthor = 64;
    if (author != nullptr && (author->size() > kLongestAuthor || !is_plain_text(*author)))
      return refuse(400, "an author has at most 64 bytes of UTF-8 without control characters");
    if (service_.stopping) return refuse(503, "the server is about to stop");
    // The WebSocket has time-outs of its own.
    socket_.expires_never();
    server::start_talk(service_, socket_.release_socket(), static_cast<LayoutId>(*id),
                       author != nullptr ? *author : std::string(), request);
  }

  void answer() {
    Request request = parser_->release();
    const std::string method(view(request.method_string()));
    if (!target_->path.starts_with("/api")) return send(answer_page(method, target_->path));
    // The answer may take long, so it is not made on the network's thread.
    watch();
    asio::post(service_.api_pool, [self = shared_from_this(), method,
                                   body = std::move(request.body())]() mutable {
      Service& service = self->service_;
      const auto change_room = [&service](LayoutId id, const std::function<Result<Outbound>(Room&)>& change) {
        return service.change_room(id, change);
      };
      auto answer = std::make_shared<ApiAnswer>();
      try {
        *answer = answer_api(service.store, change_room, method, *self->target_, body, self->given_up_);
      } catch (const std::bad_alloc&) {
        *answer = api_error(503, "not enough memory for this");
      }
      // This thread lets go of the visit here, because whatever a connection does when it ends belongs to the
      // network's thread.
      asio::post(service.io, [self = std::move(self), answer] { self->send(std::move(*answer)); });
    });
  }

  /// Notes when the client goes away before it is answered, so that the work for it can stop.
  void watch() {
    socket_.socket().async_wait(tcp::socket::wait_read, [weak = weak_from_this()](error_code error) {
      const std::shared_ptr<Visit> self = weak.lock();
      if (!self || error) return;
      char byte = 0;
      const ssize_t count = ::recv(self->socket_.socket().native_handle(), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
      if (count == 0 || (count < 0 && errno != EAGAIN && errno != EWOULDBLOCK)) self->given_up_ = true;
    });
  }

  void send(ApiAnswer answer) {
    reply_.emplace(static_cast<http::status>(answer.status), version_);
    reply_->set(http::field::content_type, answer.type);
    reply_->set("Content-Security-Policy",
                "default-src 'self'; script-src 'self' 'wasm-unsafe-eval'; img-src 'self' blob: data:; "
                "style-src 'self' 'unsafe-inline'; frame-ancestors 'none'");
    reply_->set("X-Content-Type-Options", "nosniff");
    reply_->set("Cross-Origin-Opener-Policy", "same-origin");
    reply_->set("Cross-Origin-Embedder-Policy", "require-corp");
    reply_->set("Cross-Origin-Resource-Policy", "same-origin");
    // The address may hold the token, so no other site may learn it.
    reply_->set("Referrer-Policy", "no-referrer");
    reply_->set(http::field::cache_control, "no-store");
    if (!answer.allow.empty()) reply_->set(http::field::allow, answer.allow);
    if (!answer.file_name.empty())
      reply_->set(http::field::content_disposition,
                  fmt::format("attachment; filename=\"{}\"", answer.file_name));
    if (!answer.notes.empty()) reply_->set("Lekalo-Notes", answer.notes);
    if (new_token_)
      reply_->set(http::field::set_cookie, fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/",
                                                       kTokenCookie, service_.rules.token));
    reply_->keep_alive(keep_alive_);
    reply_->body() = std::move(answer.body);
    reply_->prepare_payload();
    if (head_) reply_->body().clear();
    socket_.expires_after(kBodyTime);
    write_reply([this] {
      if (keep_alive_) return read();
      hang_up();
    });
  }
  /// Ends the connection: nothing more is sent, and what is left of the body is read. If it were not read,
  /// the system would drop the answer together with the connection.
  void hang_up() {
    error_code ignored;
    socket_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    socket_.expires_after(kFarewell);
    rest_ = std::make_unique<std::array<char, 65536>>();
    swallow();
  }
  void swallow() {
    constexpr std::size_t kMost = std::size_t{4} << 20;
    socket_.async_read_some(asio::buffer(*rest_),
                            [self = shared_from_this()](error_code error, std::size_t count) {
                              self->swallowed_ += count;
                              if (!error && self->swallowed_ < kMost) self->swallow();
                            });
  }

  Service& service_;
  beast::tcp_stream socket_;
  beast::flat_buffer incoming_{kLargestHeader + 65536};
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<Target> target_;
  std::optional<Reply> reply_;
  std::unique_ptr<std::array<char, 65536>> rest_;
  std::size_t swallowed_ = 0;
  unsigned version_ = 11;
  bool keep_alive_ = false, head_ = false, new_token_ = false;
  std::atomic<bool> given_up_ = false;
};

}  // namespace

void start_visit(Service& service, tcp::socket&& socket) {
  std::make_shared<Visit>(service, std::move(socket))->read();
}

}  // namespace lekalo::server

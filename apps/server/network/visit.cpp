#include "visit.hpp"

#include <fmt/core.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
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

#include "admission.hpp"
#include "api.hpp"
#include "lekalo/base/stop.hpp"
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
using Clock = std::chrono::steady_clock;
using Request = http::request<http::string_body>;
using Reply = http::response<http::string_body>;

constexpr std::uint32_t kLargestHeader = 16 * 1024;
constexpr std::uint64_t kLargestUpload = std::uint64_t{64} << 20;
constexpr auto kFarewell = seconds(1);

/// Who counts as one: an address, and of those of IPv6 the first half, which one household has to itself.
std::string peer_of(const asio::ip::address& address) {
  if (!address.is_v6()) return address.to_string();
  const asio::ip::address_v6 six = address.to_v6();
  if (six.is_v4_mapped()) return asio::ip::make_address_v4(asio::ip::v4_mapped, six).to_string();
  asio::ip::address_v6::bytes_type bytes = six.to_bytes();
  std::fill(bytes.begin() + 8, bytes.end(), static_cast<unsigned char>(0));
  return asio::ip::make_address_v6(bytes).to_string();
}

/// One HTTP connection, until it ends or becomes a Talk.
class Visit : public std::enable_shared_from_this<Visit> {
 public:
  Visit(Service& service, tcp::socket&& socket) : service_(service), socket_(std::move(socket)) {}
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

  /// Serves the connection if there is a place for it; else it ends.
  void begin() {
    error_code ignored;
    const std::string peer = peer_of(socket_.socket().remote_endpoint(ignored).address());
    place_ = service_.places.give(
        peer,
        [weak = weak_from_this()] {
          if (const std::shared_ptr<Visit> self = weak.lock()) self->close();
        },
        Clock::now());
    if (place_) read();
  }

 private:
  void read() {
    parser_.emplace();
    parser_->header_limit(kLargestHeader);
    // This limit holds until the header says what the body is for.
    parser_->body_limit(kLargestUpload);
    place_->wait(Clock::now(), kHeaderTime);
    http::async_read_header(socket_, incoming_, *parser_,
                            [self = shared_from_this()](error_code error, std::size_t) {
                              if (error) return self->broken(error);
                              self->take_header();
                            });
  }
  [[nodiscard]] std::string_view field(http::field name) const { return view(parser_->get()[name]); }

  void take_header() {
    const Request& request = parser_->get();
    version_ = request.version();
    keep_alive_ = request.keep_alive() && !service_.stopping;
    head_ = request.method() == http::verb::head;
    tl::expected<Target, Declined> target = admit(service_.rules, request);
    if (!target) return decline(target.error());
    target_ = std::move(*target);
    new_token_ = target_->find("token") != nullptr && !service_.rules.token.empty();
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
  /// Writes the reply piece by piece, because who takes none of it for a while loses the place.
  void write_reply(std::function<void()> then) {
    serializer_.emplace(*reply_);
    place_->wait(Clock::now(), kPace);
    write_more(std::move(then));
  }
  void write_more(std::function<void()> then) {
    http::async_write_some(
        socket_, *serializer_,
        [self = shared_from_this(), then = std::move(then)](error_code error, std::size_t count) mutable {
          if (error) return;
          self->place_->moved(count, Clock::now());
          if (!self->serializer_->is_done()) return self->write_more(std::move(then));
          self->serializer_.reset();
          then();
        });
  }
  void read_body() {
    place_->wait(Clock::now(), kPace);
    read_more();
  }
  void read_more() {
    if (parser_->is_done()) return answer();
    http::async_read_some(
        socket_, incoming_, *parser_, [self = shared_from_this()](error_code error, std::size_t count) {
          if (error) return self->broken(error);
          const Places::Time now = Clock::now();
          self->place_->moved(count, now);
          if (!self->place_->hold(self->parser_->get().body().size(), now))
            return self->refuse(503, "too many files are on their way to the server; try again in a minute");
          self->read_more();
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

  /// Refuses a request; a wrong token later and later where there are many of one peer.
  void decline(const Declined& why) {
    if (!why.wrong_token) return refuse(why.status, why.sentence);
    const Places::Time now = Clock::now();
    const std::optional<double> wait =
        service_.guesses.wrong(place_->peer(), std::chrono::duration<double>(now.time_since_epoch()).count());
    if (!wait) return close();
    if (*wait == 0) return refuse(why.status, why.sentence);
    place_->wait(now, kHeaderTime);
    pause_.expires_after(std::chrono::milliseconds(static_cast<int>(*wait * 1000)));
    pause_.async_wait([self = shared_from_this()](error_code) {
      self->refuse(429, "too many wrong tokens came from your address; wait before the next");
    });
  }
  void close() {
    given_up_ = true;
    error_code ignored;
    socket_.socket().close(ignored);
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
    if (author != nullptr)
      if (const Result<void> fine = check_author(*author); !fine) return refuse(400, fine.error().message);
    if (service_.stopping) return refuse(503, "the server is about to stop");
    if (!place_->stay(Clock::now()))
      return refuse(503, "too many pages are open; close some, or try again later");
    server::start_talk(service_, socket_.release_socket(), std::move(place_), static_cast<LayoutId>(*id),
                       author != nullptr ? *author : std::string(), request);
  }

  void answer() {
    Request request = parser_->release();
    const std::string method(view(request.method_string()));
    if (!target_->path.starts_with("/api")) return send(answer_page(method, target_->path));
    // The answer may take a while, so it is not made on the network's thread.
    watch();
    place_->work();
    const bool is_long = takes_long(method, target_->path, request.body().size());
    const std::optional<LayoutId> changed = layout_changed_by(method, target_->path);
    const std::shared_ptr<OpenRoom> room = changed ? service_.take_room(*changed) : nullptr;
    const auto body = std::make_shared<const std::string>(std::move(request.body()));
    Work work = [self = shared_from_this(), method, room, is_long, body]() mutable {
      if (is_long && self->given_up_)
        self->answer_ = api_error(503, "nobody waited for this any more when its turn came");
      else
        self->make_answer(method, *body, room.get());
      // This thread lets go of the visit here, because whatever a connection does when it ends belongs to the
      // network's thread.
      Service& service = self->service_;
      asio::post(service.io, [self = std::move(self)] { self->send(std::move(self->answer_)); });
    };
    if (room && is_read_first(method, target_->path))
      service_.slow.post(
          place_->peer(), [self = shared_from_this(), room, body, work = std::move(work)]() mutable {
            self->read_before_turn(*body);
            Service& service = self->service_;
            asio::post(service.io,
                       [self = std::move(self), room = std::move(room), work = std::move(work)]() mutable {
                         room->turns->post(self->place_->peer(), std::move(work), Length::as_before);
                       });
          });
    else if (room)
      room->turns->post(place_->peer(), std::move(work), is_long ? Length::lengthy : Length::brief);
    else if (is_long)
      service_.slow.post(place_->peer(), std::move(work));
    else
      service_.quick.post(place_->peer(), std::move(work));
  }
  /// Reads what takes a while, so that nobody in the room waits for it.
  void read_before_turn(const std::string& body) {
    RunControl control;
    control.stop = &given_up_;
    try {
      auto read = stoppable(control, [&] { return read_first(body); });
      read_ = read ? *std::move(read)
                   : ReadFirst{Result<jobs::Layout>(failure(ErrorCode::usage, read.error().what()))};
    } catch (const std::bad_alloc&) {
      read_.additions = Result<jobs::Layout>(failure(ErrorCode::environment, kNoMemory));
    }
  }
  /// Makes the answer. It is called in the turn of the room, where the request changes one.
  void make_answer(const std::string& method, const std::string& body, OpenRoom* room) {
    const auto change_room = [&](const std::function<Result<Outbound>(Room&)>& change) {
      return service_.change_room(*room, change);
    };
    const auto answer = [&] {
      return answer_api(service_.store, change_room, method, *target_, body, std::move(read_), given_up_);
    };
    RunControl control;
    control.stop = &given_up_;
    if (room != nullptr) {  // what has begun is done to the end
      if (!service_.in_turn(*room, [&] { answer_ = answer(); })) answer_ = api_error(503, kNoMemory);
      return;
    }
    try {
      const tl::expected<ApiAnswer, Stopped> made = stoppable(control, answer);
      answer_ = made ? *made : api_error(503, made.error().what());
    } catch (const std::bad_alloc&) {
      answer_ = api_error(503, kNoMemory);
    }
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
    if (!place_->hold(answer.body.size(), Clock::now()))
      answer = api_error(503, "too many files are on their way from the server; try again in a minute");
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
    write_reply([this] {
      reply_.reset();
      static_cast<void>(place_->hold(0, Clock::now()));
      if (keep_alive_) return read();
      hang_up();
    });
  }
  /// Ends the connection: nothing more is sent, and what is left of the body is read. If it were not read,
  /// the system would drop the answer together with the connection.
  void hang_up() {
    error_code ignored;
    socket_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    place_->wait(Clock::now(), kFarewell);
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
  asio::steady_timer pause_{service_.io};
  std::unique_ptr<Place> place_;
  beast::flat_buffer incoming_{kLargestHeader + 65536};
  std::optional<http::request_parser<http::string_body>> parser_;
  std::optional<Target> target_;
  std::optional<Reply> reply_;
  std::optional<http::response_serializer<http::string_body>> serializer_;
  static constexpr const char* kNoMemory = "not enough memory for this";
  ReadFirst read_;
  ApiAnswer answer_;
  std::unique_ptr<std::array<char, 65536>> rest_;
  std::size_t swallowed_ = 0;
  unsigned version_ = 11;
  bool keep_alive_ = false, head_ = false, new_token_ = false;
  std::atomic<bool> given_up_ = false;  ///< nobody waits for the answer any more
};

}  // namespace

void start_visit(Service& service, tcp::socket&& socket) {
  std::make_shared<Visit>(service, std::move(socket))->begin();
}

}  // namespace lekalo::server

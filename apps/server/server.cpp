// The network: all of Boost.Beast is in this file, which is slow to compile.
//
// One thread runs the sockets and owns the connections; up to four run what takes long. A layout's room is
// touched on its strand alone, so commands of one layout take turns and those of others go on. What a room
// says goes back to the network's thread in the order it was said.

#include "server.hpp"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <csignal>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <unordered_map>
#include <utility>

#include "access.hpp"
#include "api.hpp"
#include "lekalo/base/plain_text.hpp"
#include "messages.hpp"
#include "outbox.hpp"
#include "page_files.hpp"
#include "room.hpp"

namespace lekalo::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using boost::system::error_code;
using std::chrono::seconds;

constexpr std::size_t kMostConnections = 512;
constexpr std::uint32_t kLargestHeader = 16 * 1024;
constexpr std::uint64_t kLargestUpload = std::uint64_t{64} << 20;
constexpr int kMostFaults = 20;
constexpr std::size_t kMostHeld = 64;
constexpr std::size_t kMostJobs = 4;
constexpr auto kProgressEvery = std::chrono::milliseconds(200);
constexpr auto kHeaderTime = seconds(30), kBodyTime = seconds(120), kSilence = seconds(60);
constexpr auto kFarewell = seconds(1);
constexpr std::string_view kSubprotocol = "lekalo.1";

using Request = http::request<http::string_body>;
using Reply = http::response<http::string_body>;

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

/// A room and the strand on which it is touched.
struct OpenRoom {
  OpenRoom(LayoutId layout, asio::thread_pool& pool) : id(layout), strand(pool.get_executor()) {}
  LayoutId id;
  asio::strand<asio::thread_pool::executor_type> strand;
  std::unique_ptr<Room> room;  ///< on the strand alone
  std::size_t users = 0;       ///< under Service::rooms_lock
};

class Talk;

/// What connections share.
struct Service {
  Service(const ServerOptions& options, Store opened)
      : store(std::move(opened)),
        pool(std::clamp<std::size_t>(std::thread::hardware_concurrency(), 2, 4)),
        rules{options.address, 0, false, options.token} {}

  Store store;
  std::unique_ptr<asio::io_context> network = std::make_unique<asio::io_context>(1);
  asio::io_context& io = *network;
  asio::thread_pool pool;         ///< runs the strands of rooms; nothing on it waits for another
  asio::thread_pool api_pool{2};  ///< requests, which may wait for a room
  asio::thread_pool job_pool{kMostJobs};
  std::atomic<bool> ending = false;  ///< jobs end
  AccessRules rules;
  bool stopping = false;  ///< of the network's thread, like the following
  std::size_t connections = 0;
  std::unordered_map<ClientNumber, std::weak_ptr<Talk>> talks;
  ClientNumber last_client = 0;
  std::mutex rooms_lock;
  std::map<LayoutId, std::shared_ptr<OpenRoom>> rooms;

  [[nodiscard]] std::shared_ptr<OpenRoom> take_room(LayoutId id) {
    const std::lock_guard lock(rooms_lock);
    std::shared_ptr<OpenRoom>& room = rooms[id];
    if (!room) room = std::make_shared<OpenRoom>(id, pool);
    ++room->users;
    return room;
  }
  /// A room nobody uses is closed: its memory goes, its layout is in the store.
  void give_back(const std::shared_ptr<OpenRoom>& room) {
    const std::lock_guard lock(rooms_lock);
    const auto at = rooms.find(room->id);
    if (--room->users == 0 && at != rooms.end() && at->second == room) rooms.erase(at);
  }
  /// On the room's strand.
  [[nodiscard]] Result<void> open(OpenRoom& room) {
    if (room.room) return {};
    Result<StoredLayout> layout = store.load(room.id);
    if (!layout) return tl::unexpected(layout.error());
    room.room = std::make_unique<Room>(store, room.id, std::move(*layout));
    return {};
  }
  /// From a room's strand.
  void deliver(Outbound out);
  /// On the room's strand: runs the jobs that were started there.
  void run_jobs(const std::shared_ptr<OpenRoom>& room);
  [[nodiscard]] Result<layout::Change> run_job(const std::shared_ptr<OpenRoom>& room, const JobStart& start);
  /// From a room's strand: the client's long command has ended.
  void free_client(ClientNumber client);
};

/// One WebSocket connection.
class Talk : public std::enable_shared_from_this<Talk> {
 public:
  Talk(Service& service, tcp::socket&& socket, LayoutId layout, std::string author)
      : service_(service),
        socket_(std::move(socket)),
        number_(++service.last_client),
        author_(std::move(author)),
        room_(service.take_room(layout)) {
    ++service_.connections;
  }
  ~Talk() {
    --service_.connections;
    service_.give_back(room_);
  }
  Talk(const Talk&) = delete;
  Talk& operator=(const Talk&) = delete;

  void run(const Request& request) {
    service_.talks[number_] = weak_from_this();
    websocket::stream_base::timeout times{};
    times.handshake_timeout = kHeaderTime;
    times.idle_timeout = kSilence;
    times.keep_alive_pings = true;
    socket_.set_option(times);
    socket_.set_option(websocket::stream_base::decorator([](websocket::response_type& response) {
      response.set(http::field::sec_websocket_protocol, std::string(kSubprotocol));
    }));
    socket_.read_message_max(kLargestMessage);
    socket_.auto_fragment(false);
    socket_.text(true);
    socket_.async_accept(request, [self = shared_from_this()](error_code error) {
      if (error) return self->over();
      self->in_room([](Talk& talk) {
        Result<void> opened = talk.service_.open(*talk.room_);
        if (!opened) return talk.fail_in_room(opened.error().message);
        Result<Outbound> out = talk.room_->room->join(talk.number_, talk.author_);
        if (!out) return talk.fail_in_room(out.error().message);
        talk.service_.deliver(std::move(*out));
      });
      self->read();
    });
  }

  /// A long command of this client has ended: what waited for it goes on.
  void is_free() {
    busy_ = false;
    go_on();
  }
  void hear(const Outgoing& message) {
    outbox_.push(message);
    write();
  }
  void say(const std::string& text) {
    hear({number_, std::make_shared<const std::string>(text), Loss::never});
  }
  void say_trouble(const std::string& type, const std::string& sentence) {
    // The sentences are ours, but may hold what came from outside.
    say(fmt::format("{{\"type\": \"{}\", \"message\": {}}}", type, text_as_json(sentence)));
  }
  /// Sends what waits, then closes.
  void close_after(websocket::close_code code) {
    if (!closing_) closing_ = code;
    write();
  }
  /// At once, whatever waits.
  void cut() { beast::get_lowest_layer(socket_).close(); }

  static std::string text_as_json(const std::string& text) {
    const std::string answer = api_error(0, text).body;  // {"error":TEXT}\n
    constexpr std::size_t kBefore = 9, kAfter = 2;
    return answer.substr(kBefore, answer.size() - kBefore - kAfter);
  }

 private:
  /// Runs something on the room's strand, while the connection lives on.
  template <class Work>
  void in_room(Work work) {
    asio::post(room_->strand, [self = shared_from_this(), work = std::move(work)]() mutable {
      work(*self);
      // The connection may end with this; that belongs to the network's thread.
      Service& service = self->service_;
      asio::post(service.io, [self = std::move(self)] {});
    });
  }
  void fail_in_room(const std::string& sentence) {
    asio::post(service_.io, [self = shared_from_this(), sentence] {
      self->say_trouble("error", sentence);
      self->close_after(websocket::close_code::policy_error);
    });
  }

  void read() {
    reading_ = true;
    socket_.async_read(incoming_, [self = shared_from_this()](error_code error, std::size_t) {
      self->reading_ = false;
      if (error) return self->over();
      self->take();
    });
  }
  void take() {
    const std::string bytes = beast::buffers_to_string(incoming_.data());
    incoming_.consume(incoming_.size());
    if (closing_) return read();
    Result<ClientMessage> message = socket_.got_text()
                                        ? parse_client_message(bytes)
                                        : failure(ErrorCode::bad_input, "messages are text frames of JSON");
    if (!message) {
      say_trouble("error", message.error().message);
      if (++faults_ == kMostFaults) close_after(websocket::close_code::policy_error);
      return read();
    }
    // During a long command others wait, but for what ends it.
    const bool waits =
        !std::holds_alternative<StopMessage>(*message) && !std::holds_alternative<SelectMessage>(*message);
    if (waits && (busy_ || working_ > 0 || !held_.empty()))
      held_.push_back(std::move(*message));
    else
      give(std::move(*message));
    go_on();
  }
  void give(ClientMessage message) {
    ++working_;
    in_room([said = std::move(message)](Talk& talk) {
      bool busy = false;
      if (talk.room_->room) {
        talk.service_.deliver(talk.room_->room->handle(talk.number_, said));
        busy = talk.room_->room->is_busy(talk.number_);
        talk.service_.run_jobs(talk.room_);
      }
      asio::post(talk.service_.io, [self = talk.shared_from_this(), busy] {
        --self->working_;
        // Its end is told after this, on the same way.
        self->busy_ = self->busy_ || busy;
        self->go_on();
      });
    });
  }
  /// The next message is read when this one is answered: who asks faster than he is answered waits.
  void go_on() {
    if (working_ > 0 || over_) return;
    if (!busy_ && !held_.empty()) {
      ClientMessage next = std::move(held_.front());
      held_.pop_front();
      return give(std::move(next));
    }
    if (!reading_ && held_.size() < kMostHeld) read();
  }

  void write() {
    if (writing_ || over_) return;
    if (outbox_.empty()) {
      if (closing_ && !closed_) {
        closed_ = true;
        socket_.async_close(*closing_, [self = shared_from_this()](error_code) { self->over(); });
      } else if (outbox_.take_refresh()) {
        in_room([](Talk& talk) {
          if (talk.room_->room) talk.service_.deliver(talk.room_->room->resend(talk.number_));
        });
      }
      return;
    }
    if (closed_) return;
    writing_ = outbox_.pop();
    socket_.async_write(asio::buffer(*writing_), [self = shared_from_this()](error_code error, std::size_t) {
      self->writing_.reset();
      if (error) return self->over();
      self->write();
    });
  }

  void over() {
    if (over_) return;
    over_ = true;
    service_.talks.erase(number_);
    cut();
    in_room([](Talk& talk) {
      if (talk.room_->room) talk.service_.deliver(talk.room_->room->leave(talk.number_));
    });
  }

  Service& service_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_buffer incoming_;
  ClientNumber number_;
  std::string author_;
  std::shared_ptr<OpenRoom> room_;
  Outbox outbox_;
  std::shared_ptr<const std::string> writing_;
  std::optional<websocket::close_code> closing_;
  std::deque<ClientMessage> held_;  ///< wait for the end of a long command
  int faults_ = 0, working_ = 0;    ///< working: messages the room has
  bool reading_ = false, busy_ = false, closed_ = false, over_ = false;
};

void Service::deliver(Outbound out) {
  if (out.empty()) return;
  asio::post(io, [this, out = std::move(out)] {
    for (const Outgoing& message : out) {
      const auto at = talks.find(message.to);
      if (at == talks.end()) continue;
      if (const std::shared_ptr<Talk> talk = at->second.lock()) talk->hear(message);
    }
  });
}

void Service::free_client(ClientNumber client) {
  asio::post(io, [this, client] {
    const auto at = talks.find(client);
    if (at == talks.end()) return;
    if (const std::shared_ptr<Talk> talk = at->second.lock()) talk->is_free();
  });
}

void Service::run_jobs(const std::shared_ptr<OpenRoom>& room) {
  for (JobStart& start : room->room->take_jobs())
    asio::post(job_pool, [this, room, start = std::move(start)] {
      Result<layout::Change> found = run_job(room, start);
      asio::post(room->strand, [this, room, number = start.number, found = std::move(found)] {
        const ClientNumber client = room->room->client_of(number);
        deliver(room->room->job_ended(number, found));
        if (!room->room->is_busy(client)) free_client(client);
        run_jobs(room);
      });
    });
}

Result<layout::Change> Service::run_job(const std::shared_ptr<OpenRoom>& room, const JobStart& start) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  auto next = begin + kProgressEvery;
  JobContext context;
  context.run.stop = start.stop.get();
  context.run.progress = [&](const Progress& progress) {
    if (ending) *start.stop = true;
    const auto now = Clock::now();
    if (now < next) return;
    next = now + kProgressEvery;
    const double passed = std::chrono::duration<double>(now - begin).count(), fraction = progress.fraction;
    constexpr double kEnoughToTell = 0.01;
    std::optional<double> left;
    if (fraction > kEnoughToTell) left = passed * (1 - fraction) / fraction;
    asio::post(room->strand, [this, room, number = start.number, fraction, left] {
      deliver(room->room->job_progress(number, fraction, left));
    });
  };
  context.improved = [&](const layout::Change& change) {
    asio::post(room->strand, [this, room, number = start.number, change] {
      deliver(room->room->job_improved(number, change));
    });
  };
  try {
    return start.job(start.document, context);
  } catch (const std::bad_alloc&) {
    return failure(ErrorCode::environment, "not enough memory for this");
  }
}

std::string media_type(std::string_view path) {
  constexpr std::pair<std::string_view, const char*> kTypes[] = {
      {".html", "text/html; charset=utf-8"},
      {".js", "text/javascript; charset=utf-8"},
      {".css", "text/css; charset=utf-8"},
      {".wasm", "application/wasm"},
      {".svg", "image/svg+xml"},
      {".png", "image/png"},
      {".json", "application/json"},
      {".ico", "image/x-icon"},
      {".webmanifest", "application/manifest+json"}};
  for (const auto& [ending, type] : kTypes)
    if (path.ends_with(ending)) return type;
  return "application/octet-stream";
}

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
    parser_->body_limit(kLargestUpload);  // until the header says what it is for
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
    // Each of them once: which of two counts would be anybody's guess.
    for (const http::field once : {http::field::host, http::field::origin, http::field::cookie})
      if (request.count(once) > 1) return refuse(400, "a header that may stand once stands twice");
    const std::string why =
        refusal(service_.rules, {field(http::field::host), field(http::field::origin),
                                 field(http::field::authorization), field(http::field::cookie),
                                 token != nullptr ? std::string_view(*token) : std::string_view()});
    if (!why.empty()) return refuse(403, why);
    new_token_ = token != nullptr && !service_.rules.token.empty();
    if (target_->path == "/ws") return start_talk();
    const std::size_t most = most_body(view(request.method_string()), target_->path);
    parser_->body_limit(most);
    const auto length = parser_->content_length();
    if (length && *length > most)
      return refuse(413, most > 0 ? fmt::format("the file is larger than {} MiB", most >> 20)
                                  : "this request has no body");
    if (view(request[http::field::expect]) == "100-continue") return go_on();
    read_body();
  }
  /// Some clients wait for a word before they send a file.
  void go_on() {
    reply_.emplace(http::status::continue_, version_);
    reply_->prepare_payload();
    http::async_write(socket_, *reply_, [self = shared_from_this()](error_code error, std::size_t) {
      if (!error) self->read_body();
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
    // A failure of the parser, not of the connection.
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

  void start_talk() {
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
    socket_.expires_never();  // the WebSocket has time-outs of its own
    std::make_shared<Talk>(service_, socket_.release_socket(), static_cast<LayoutId>(*id),
                           author != nullptr ? *author : std::string())
        ->run(request);
  }

  void answer() {
    Request request = parser_->release();
    const std::string method(view(request.method_string()));
    if (!target_->path.starts_with("/api")) return send(page(method));
    // The answer may take long: not on the network's thread.
    asio::post(service_.api_pool, [self = shared_from_this(), method, body = std::move(request.body())] {
      Service& service = self->service_;
      const auto change_room = [&service](LayoutId id, const std::function<Result<Outbound>(Room&)>& change) {
        return change_in_room(service, id, change);
      };
      auto answer = std::make_shared<ApiAnswer>();
      try {
        *answer = answer_api(service.store, change_room, method, *self->target_, body);
      } catch (const std::bad_alloc&) {
        *answer = api_error(503, "not enough memory for this");
      }
      asio::post(service.io, [self, answer] { self->send(std::move(*answer)); });
    });
  }
  static Result<void> change_in_room(Service& service, LayoutId id,
                                     const std::function<Result<Outbound>(Room&)>& change) {
    const std::shared_ptr<OpenRoom> room = service.take_room(id);
    std::promise<Result<void>> promise;
    asio::post(room->strand, [&] {
      Result<void> done = service.open(*room);
      if (done) {
        Result<Outbound> out = change(*room->room);
        if (out)
          service.deliver(std::move(*out));
        else
          done = tl::unexpected(out.error());
      }
      promise.set_value(std::move(done));
    });
    Result<void> done = promise.get_future().get();
    service.give_back(room);
    return done;
  }

  [[nodiscard]] ApiAnswer page(const std::string& method) const {
    if (method != "GET" && method != "HEAD") {
      ApiAnswer wrong = api_error(405, "the methods here are GET, HEAD");
      wrong.allow = "GET, HEAD";
      return wrong;
    }
    const std::string path = target_->path == "/" ? "/index.html" : target_->path;
    const auto file = page_files().find(path);
    if (file == page_files().end()) return api_error(404, "there is nothing here");
    return {200, std::string(file->second), media_type(path), {}, {}};
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
    reply_->set("Referrer-Policy", "no-referrer");  // the address may hold the token
    reply_->set(http::field::cache_control, "no-store");
    if (!answer.allow.empty()) reply_->set(http::field::allow, answer.allow);
    if (!answer.file_name.empty())
      reply_->set(http::field::content_disposition,
                  fmt::format("attachment; filename=\"{}\"", answer.file_name));
    if (new_token_)
      reply_->set(http::field::set_cookie, fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/",
                                                       kTokenCookie, service_.rules.token));
    reply_->keep_alive(keep_alive_);
    reply_->body() = std::move(answer.body);
    reply_->prepare_payload();
    if (head_) reply_->body().clear();
    socket_.expires_after(kBodyTime);
    http::async_write(socket_, *reply_, [self = shared_from_this()](error_code error, std::size_t) {
      if (error) return;
      if (self->keep_alive_) return self->read();
      self->hang_up();
    });
  }
  /// A body that was not read would otherwise make the system drop the answer with the connection.
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
};

class Acceptor {
 public:
  Acceptor(Service& service, tcp::acceptor&& socket)
      : service_(service), socket_(std::move(socket)), pause_(service.io) {}
  void next() {
    socket_.async_accept([this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted || !socket_.is_open()) return;
      if (error) return wait();  // out of descriptors, most likely
      error_code ignored;
      socket.set_option(tcp::no_delay(true), ignored);
      if (service_.connections < kMostConnections)
        std::make_shared<Visit>(service_, std::move(socket))->read();
      next();
    });
  }
  void close() {
    error_code ignored;
    socket_.close(ignored);
    pause_.cancel();
  }

 private:
  void wait() {
    pause_.expires_after(std::chrono::milliseconds(100));
    pause_.async_wait([this](error_code error) {
      if (!error) next();
    });
  }
  Service& service_;
  tcp::acceptor socket_;
  asio::steady_timer pause_;
};

/// Listens until a signal comes.
Result<void> run_until_signal(Service& service, tcp::acceptor&& socket, const ServerOptions& options,
                              const std::function<Result<void>(const std::string& url)>& listening) {
  Acceptor acceptor(service, std::move(socket));
  asio::signal_set signals(service.io, SIGINT, SIGTERM);
  asio::steady_timer farewell(service.io);
  const auto stop = [&] {
    if (service.stopping) return;
    service.stopping = true;
    acceptor.close();
    for (const auto& [number, weak] : service.talks)
      if (const std::shared_ptr<Talk> talk = weak.lock()) {
        talk->say_trouble("bye", "the server stops; everything that was acknowledged is kept");
        talk->close_after(websocket::close_code::going_away);
      }
    farewell.expires_after(kFarewell);
    farewell.async_wait([&](error_code) { service.io.stop(); });
  };
  signals.async_wait([&](error_code problem, int) {
    if (problem) return;
    signals.clear(problem);  // a second signal ends the program as usual
    stop();
  });

  const std::string host =
      options.address.find(':') != std::string::npos ? "[" + options.address + "]" : options.address;
  const std::string query = options.token.empty() ? "" : "?token=" + options.token;
  if (Result<void> said = listening(fmt::format("http://{}:{}/{}", host, service.rules.port, query)); !said)
    return said;
  acceptor.next();
  service.io.run();
  return {};
}

}  // namespace

Result<bool> is_loopback(const std::string& address) {
  error_code error;
  const auto parsed = asio::ip::make_address(address, error);
  if (error)
    return failure(ErrorCode::usage,
                   fmt::format("\"{}\" is no address to listen on; it has to be one like 127.0.0.1, 0.0.0.0 "
                               "or ::1",
                               address));
  return parsed.is_loopback();
}

Result<std::string> random_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    return failure(ErrorCode::environment, "the system gives no random bytes for a token");
  std::string token;
  for (const unsigned char byte : bytes) token += fmt::format("{:02x}", byte);
  return token;
}

Result<void> serve(const ServerOptions& options, Store store,
                   const std::function<Result<void>(const std::string& url)>& listening) {
  Service service(options, std::move(store));
  error_code error;
  const auto address = asio::ip::make_address(options.address, error);
  if (error) return failure(ErrorCode::usage, options.address + " is no address to listen on");
  tcp::acceptor socket(service.io);
  const tcp::endpoint wanted(address, options.port);
  socket.open(wanted.protocol(), error);
  if (!error) socket.set_option(asio::socket_base::reuse_address(true), error);
  if (!error) socket.bind(wanted, error);
  if (!error) socket.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use)
    return failure(ErrorCode::environment,
                   fmt::format("port {} of {} is in use; choose another with --port, or 0 for any",
                               options.port, options.address));
  if (error)
    return failure(ErrorCode::environment, fmt::format("cannot listen on port {} of {}: {}", options.port,
                                                       options.address, error.message()));
  service.rules.port = socket.local_endpoint().port();
  service.rules.any_host = address.is_unspecified();

  Result<void> done = run_until_signal(service, std::move(socket), options, listening);
  // What was begun is finished, then what waits for the network goes, while all it refers to is there.
  service.ending = true;
  service.api_pool.join();
  service.job_pool.join();
  service.pool.join();
  service.network.reset();
  return done;
}

}  // namespace lekalo::server

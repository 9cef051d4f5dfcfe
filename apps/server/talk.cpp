#include "talk.hpp"

#include <fmt/format.h>

#include <boost/asio/post.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "api.hpp"
#include "messages.hpp"
#include "outbox.hpp"

namespace lekalo::server {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using tcp = asio::ip::tcp;
using boost::system::error_code;
using Request = http::request<http::string_body>;

constexpr auto kSilence = std::chrono::seconds(60);
constexpr int kMostFaults = 20;
constexpr std::size_t kMostHeld = 64;

std::string text_as_json(const std::string& text) {
  const std::string answer = api_error(0, text).body;  // {"error":TEXT}\n
  constexpr std::size_t kBefore = 9, kAfter = 2;
  return answer.substr(kBefore, answer.size() - kBefore - kAfter);
}

/// One WebSocket connection.
class WebSocketTalk : public Talk, public std::enable_shared_from_this<WebSocketTalk> {
 public:
  WebSocketTalk(Service& service, tcp::socket&& socket, LayoutId layout, std::string author)
      : service_(service),
        socket_(std::move(socket)),
        number_(++service.last_client),
        author_(std::move(author)),
        room_(service.take_room(layout)) {
    ++service_.connections;
  }
  ~WebSocketTalk() override {
    --service_.connections;
    service_.give_back(room_);
  }
  WebSocketTalk(const WebSocketTalk&) = delete;
  WebSocketTalk& operator=(const WebSocketTalk&) = delete;

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
      self->in_room([](WebSocketTalk& talk) {
        Result<void> opened = talk.service_.open(*talk.room_);
        if (!opened) return talk.fail_in_room(opened.error().message);
        Result<Outbound> out = talk.room_->room->join(talk.number_, talk.author_);
        if (!out) return talk.fail_in_room(out.error().message);
        talk.service_.deliver(std::move(*out));
      });
      self->read();
    });
  }

  void is_free() override {
    busy_ = false;
    go_on();
  }
  void hear(const Outgoing& message) override {
    outbox_.push(message);
    write();
  }
  void say_goodbye(const std::string& sentence) override {
    say_trouble("bye", sentence);
    close_after(websocket::close_code::going_away);
  }

 private:
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
    in_room([said = std::move(message)](WebSocketTalk& talk) {
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
        in_room([](WebSocketTalk& talk) {
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
    in_room([](WebSocketTalk& talk) {
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

}  // namespace

void start_talk(Service& service, tcp::socket&& socket, LayoutId layout, std::string author,
                const Request& request) {
  std::make_shared<WebSocketTalk>(service, std::move(socket), layout, std::move(author))->run(request);
}

}  // namespace lekalo::server

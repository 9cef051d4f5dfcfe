#include "talk.hpp"

#include <boost/asio/post.hpp>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "lekalo/io/text/json_writer.hpp"
#include "messages.hpp"
#include "outbox.hpp"
#include "web_socket.hpp"

namespace lekalo::server {
namespace {

namespace asio = boost::asio;
using tcp = asio::ip::tcp;

constexpr auto kSilence = std::chrono::seconds(60);
constexpr int kMostFaults = 20;
constexpr std::size_t kMostHeld = 64;

/// One WebSocket connection.
class WebSocketTalk : public Talk, public std::enable_shared_from_this<WebSocketTalk> {
 public:
  WebSocketTalk(Service& service, tcp::socket&& socket, LayoutId layout, std::string author)
      : service_(service),
        socket_(std::move(socket), {std::string(kSubprotocol), kLargestMessage, kHeaderTime, kSilence}),
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

  void run(const Upgrade& request) {
    service_.talks[number_] = weak_from_this();
    socket_.accept(request, [self = shared_from_this()](bool done) {
      if (!done) return self->over();
      self->in_room([](WebSocketTalk& talk) {
        if (Result<void> joined = talk.join_room(); !joined) talk.fail_in_room(joined.error().message);
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
    close_after(WebSocket::Close::going_away);
  }

 private:
  void say(const std::string& text) {
    hear({number_, std::make_shared<const std::string>(text), Loss::never});
  }
  void say_trouble(const std::string& type, const std::string& sentence) {
    // The sentences are ours, but may hold what came from outside.
    io::JsonWriter json(io::JsonLayout::spaced);
    say(json.object({{"type", type}, {"message", sentence}}).take());
  }
  /// Sends everything that waits, then closes.
  void close_after(WebSocket::Close code) {
    if (!closing_) closing_ = code;
    write();
  }
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
  Result<void> join_room() {
    LEKALO_CHECK(service_.open(*room_));
    LEKALO_TRY(Outbound out, room_->room->join(number_, author_));
    service_.deliver(std::move(out));
    return {};
  }
  void fail_in_room(const std::string& sentence) {
    asio::post(service_.io, [self = shared_from_this(), sentence] {
      self->say_trouble("error", sentence);
      self->close_after(WebSocket::Close::policy);
    });
  }

  void read() {
    reading_ = true;
    socket_.read([self = shared_from_this()](bool done) {
      self->reading_ = false;
      if (!done) return self->over();
      self->take();
    });
  }
  void take() {
    const WebSocket::Message taken = socket_.message();
    if (closing_) return read();
    Result<ClientMessage> message = taken.is_text
                                        ? parse_client_message(taken.bytes)
                                        : failure(ErrorCode::bad_input, "messages are text frames of JSON");
    if (!message) {
      say_trouble("error", message.error().message);
      if (++faults_ == kMostFaults) close_after(WebSocket::Close::policy);
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
        socket_.close(*closing_, [self = shared_from_this()](bool) { self->over(); });
      } else if (outbox_.take_refresh()) {
        in_room([](WebSocketTalk& talk) {
          if (talk.room_->room) talk.service_.deliver(talk.room_->room->resend(talk.number_));
        });
      }
      return;
    }
    if (closed_) return;
    writing_ = outbox_.pop();
    socket_.write(*writing_, [self = shared_from_this()](bool done) {
      self->writing_.reset();
      if (!done) return self->over();
      self->write();
    });
  }

  void over() {
    if (over_) return;
    over_ = true;
    service_.talks.erase(number_);
    socket_.cut();
    in_room([](WebSocketTalk& talk) {
      if (talk.room_->room) talk.service_.deliver(talk.room_->room->leave(talk.number_));
    });
  }

  Service& service_;
  WebSocket socket_;
  ClientNumber number_;
  std::string author_;
  std::shared_ptr<OpenRoom> room_;
  Outbox outbox_;
  std::shared_ptr<const std::string> writing_;
  std::optional<WebSocket::Close> closing_;
  std::deque<ClientMessage> held_;  ///< wait for the end of a long command
  int faults_ = 0, working_ = 0;    ///< working: messages the room has
  bool reading_ = false, busy_ = false, closed_ = false, over_ = false;
};

}  // namespace

void start_talk(Service& service, tcp::socket&& socket, LayoutId layout, std::string author,
                const Upgrade& request) {
  std::make_shared<WebSocketTalk>(service, std::move(socket), layout, std::move(author))->run(request);
}

}  // namespace lekalo::server

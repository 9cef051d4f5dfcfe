#include "talk.hpp"

#include <algorithm>
#include <atomic>
#include <boost/asio/post.hpp>
#include <chrono>
#include <deque>
#include <memory>
#include <new>
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
using Clock = std::chrono::steady_clock;

constexpr auto kSilence = std::chrono::seconds(60);
constexpr int kMostFaults = 20;
constexpr std::size_t kMostHeld = 64;
/// Larger messages are not parsed on the network's thread, for which all wait.
constexpr std::size_t kParsedAtOnce = std::size_t{16} << 10;

/// One WebSocket connection.
class WebSocketTalk : public Talk, public std::enable_shared_from_this<WebSocketTalk> {
 public:
  WebSocketTalk(Service& service, tcp::socket&& socket, std::unique_ptr<Place> place, LayoutId layout,
                std::string author)
      : service_(service),
        socket_(std::move(socket), {std::string(kSubprotocol), kLargestMessage, kHeaderTime, kSilence}),
        number_(++service.last_client),
        author_(std::move(author)),
        room_(service.take_room(layout)),
        place_(std::move(place)) {}
  ~WebSocketTalk() override {
    // A large layout takes a while to be freed.
    service_.slow.post(place_->peer(), [room = std::move(room_)] {});
  }
  WebSocketTalk(const WebSocketTalk&) = delete;
  WebSocketTalk& operator=(const WebSocketTalk&) = delete;

  void run(const Upgrade& request) {
    service_.talks[number_] = weak_from_this();
    place_->work();
    place_->hand_over([weak = weak_from_this()] {
      if (const std::shared_ptr<WebSocketTalk> self = weak.lock()) self->over();
    });
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
    if (busy_) place_->heard(Clock::now());  // who waits for a long command is not silent
    // Who reads fast may have more than there is room for, because that lasts a moment.
    if (!count_bytes() && place_->waits_longer_than(std::chrono::seconds(1), Clock::now())) return over();
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
  /// Runs something in the room's turn, while the connection lives on.
  template <class Act>
  void in_room(Act act, Length length = Length::brief) {
    room_->turns->post(
        place_->peer(),
        [self = shared_from_this(), act = std::move(act)]() mutable {
          if (!self->service_.in_turn(*self->room_, [&] { act(*self); }))
            self->fail_in_room("there was not enough memory for this layout");
          // The connection may end with this; that belongs to the network's thread.
          Service& service = self->service_;
          asio::post(service.io, [self = std::move(self)] {});
        },
        length);
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
    WebSocket::Message taken = socket_.message();
    place_->heard(Clock::now());
    if (closing_) return read();
    if (taken.bytes.size() <= kParsedAtOnce) return take_parsed(parsed(taken), taken.bytes.size());
    parsing_ = true;  // nothing is read meanwhile, so messages keep their order
    service_.slow.post(place_->peer(), [self = shared_from_this(), taken = std::move(taken)]() mutable {
      Service& service = self->service_;
      asio::post(service.io, [self = std::move(self), message = parsed(taken), size = taken.bytes.size()]() {
        self->parsing_ = false;
        self->take_parsed(message, size);
      });
    });
  }
  static Result<ClientMessage> parsed(const WebSocket::Message& taken) {
    try {
      if (taken.is_text) return parse_client_message(taken.bytes);
      return failure(ErrorCode::bad_input, "messages are text frames of JSON");
    } catch (const std::bad_alloc&) {
      return failure(ErrorCode::environment, "not enough memory for this message");
    }
  }
  void take_parsed(Result<ClientMessage> message, std::size_t size) {
    if (over_) return;
    if (!message) {
      say_trouble("error", message.error().message);
      if (++faults_ == kMostFaults) close_after(WebSocket::Close::policy);
      return read();
    }
    held_bytes_ += size;
    held_.emplace_back(std::move(*message), size);
    // A client that sends little may stay where there is no room.
    if (!count_bytes() && held_bytes_ > kPaceBytes) return over();
    go_on();
  }
  void give(ClientMessage message) {
    ++working_;
    const auto act = [said = std::move(message)](WebSocketTalk& talk) {
      bool busy = false;
      if (talk.room_->room && !talk.gone_) {
        talk.service_.deliver(talk.room_->room->handle(talk.number_, said, talk.gone_));
        busy = talk.room_->room->is_busy(talk.number_);
        talk.service_.run_jobs(talk.room_, talk.place_->peer());
      }
      asio::post(talk.service_.io, [self = talk.shared_from_this(), busy] {
        --self->working_;
        // Its end is told after this, on the same way.
        self->busy_ = self->busy_ || busy;
        self->go_on();
      });
    };
    in_room(act, Length::as_before);
  }
  /// A message is answered before the next is given to the room. Others are read meanwhile, because only who
  /// reads hears that the client hangs up; who asks much faster than he is answered waits.
  void go_on() {
    if (over_) return;
    // During a long command others wait, but for what ends it.
    const auto passes = [this](const auto& one) {
      return !busy_ || std::holds_alternative<StopMessage>(one.first) ||
             std::holds_alternative<SelectMessage>(one.first);
    };
    const auto next = std::find_if(held_.begin(), held_.end(), passes);
    if (working_ == 0 && next != held_.end()) {
      ClientMessage message = std::move(next->first);
      held_bytes_ -= next->second;
      held_.erase(next);
      static_cast<void>(count_bytes());
      give(std::move(message));
    }
    if (!reading_ && !parsing_ && held_.size() < kMostHeld && held_bytes_ < kLargestMessage) read();
  }

  bool count_bytes() {
    return place_->hold(held_bytes_ + outbox_.bytes() + (writing_ ? writing_->size() : 0), Clock::now());
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
    place_->wait(Clock::now(), kPace * static_cast<int>(1 + writing_->size() / kPaceBytes));
    socket_.write(*writing_, [self = shared_from_this()](bool done) {
      self->writing_.reset();
      self->place_->work();
      static_cast<void>(self->count_bytes());
      if (!done) return self->over();
      self->write();
    });
  }

  void over() {
    if (over_) return;
    over_ = gone_ = true;
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
  std::unique_ptr<Place> place_;
  /// Messages, with their bytes, that wait for their turn.
  std::deque<std::pair<ClientMessage, std::size_t>> held_;
  std::size_t held_bytes_ = 0;
  int faults_ = 0, working_ = 0;  ///< working: messages the room has
  bool reading_ = false, parsing_ = false, busy_ = false, closed_ = false, over_ = false;
  /// Says to the room's turns that nobody waits for what comes.
  std::atomic<bool> gone_ = false;
};

}  // namespace

void start_talk(Service& service, tcp::socket&& socket, std::unique_ptr<Place> place, LayoutId layout,
                std::string author, const Upgrade& request) {
  std::make_shared<WebSocketTalk>(service, std::move(socket), std::move(place), layout, std::move(author))
      ->run(request);
}

}  // namespace lekalo::server

#pragma once

#include <cstddef>
#include <deque>
#include <memory>
#include <string>

#include "room.hpp"

namespace lekalo::server {

/// The messages that wait to be sent to one client. Their number is bounded: where a client reads slower than
/// others write, messages that a fresh `layout` makes needless are dropped, and the client gets such a
/// `layout` once it has read the rest.
class Outbox {
 public:
  /// \param limit  bytes that may wait. Answers to the client's own messages do not count, because the client
  /// can only have asked for one at a time.
  explicit Outbox(std::size_t limit = std::size_t{8} << 20) : limit_(limit) {}

  /// Puts a message behind the others. Once a message was dropped, all that may be lost are dropped until a
  /// fresh layout comes.
  void push(const Outgoing& message) {
    if (message.loss == Loss::fresh) behind_ = asked_ = false;
    if (message.loss == Loss::as_newer) {
      if (behind_) return;
      // A message larger than the limit is taken when nothing else waits, or it could never be sent.
      if (waiting_bytes_ > 0 && waiting_bytes_ + message.text->size() > limit_) {
        behind_ = true;
        waiting_bytes_ = 0;
        std::erase_if(waiting_, [](const Outgoing& one) { return one.loss != Loss::never; });
        return;
      }
    }
    if (message.loss != Loss::never) waiting_bytes_ += message.text->size();
    waiting_.push_back(message);
  }
  [[nodiscard]] bool empty() const noexcept { return waiting_.empty(); }
  [[nodiscard]] std::size_t bytes() const noexcept { return waiting_bytes_; }
  /// \pre !empty()
  [[nodiscard]] std::shared_ptr<const std::string> pop() {
    Outgoing message = std::move(waiting_.front());
    waiting_.pop_front();
    if (message.loss != Loss::never) waiting_bytes_ -= message.text->size();
    return std::move(message.text);
  }
  /// Returns true once, when everything that waited is sent and something was dropped. Room::resend is due
  /// then.
  [[nodiscard]] bool take_refresh() noexcept {
    if (!behind_ || asked_ || !waiting_.empty()) return false;
    asked_ = true;
    return true;
  }

 private:
  std::size_t limit_, waiting_bytes_ = 0;
  std::deque<Outgoing> waiting_;
  bool behind_ = false, asked_ = false;
};

}  // namespace lekalo::server

#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <string>

namespace lekalo::server {

/// The most connections, and bytes that are on their way to or from clients, in all and of one peer.
struct PlaceLimits {
  std::size_t connections = 512, connections_of_peer = 256;
  /// WebSockets that stay however silent they are; the rest is left to requests.
  std::size_t staying = 384, staying_of_peer = 192;
  std::size_t bytes = std::size_t{512} << 20, bytes_of_peer = std::size_t{256} << 20;
};

/// The time in which so many bytes have to move while the server waits for a client.
inline constexpr auto kPace = std::chrono::seconds(5);
inline constexpr std::size_t kPaceBytes = std::size_t{64} << 10;

class Place;

/// The places of all connections. Whoever the server waits for may lose the place: at the end of a time that
/// is said when the waiting begins, and before it to others, where connections or bytes are short. Then the
/// one goes that has been waited for longest, of the peer that has too much, or else of the one that has
/// most. So who is slow loses the own place, and takes nobody else's.
///
/// One thread uses it, and says what time it is.
class Places {
 public:
  using Time = std::chrono::steady_clock::time_point;
  explicit Places(const PlaceLimits& limits = {}) : limits_(limits) {}
  Places(const Places&) = delete;
  Places& operator=(const Places&) = delete;

  /// Returns a place for a connection of a peer; null where there is none.
  /// \param cut  ends the connection. It is called at most once, and may be while a place is given to another
  [[nodiscard]] std::unique_ptr<Place> give(const std::string& peer, std::function<void()> cut, Time now);
  /// Cuts those whose time is over.
  void sweep(Time now);
  void cut_all();

  [[nodiscard]] std::size_t connections() const noexcept { return all_.connections; }
  [[nodiscard]] std::size_t bytes() const noexcept { return all_.bytes; }

 private:
  friend class Place;
  struct Use {
    std::size_t connections = 0, staying = 0, bytes = 0;
  };
  /// Cuts who has been waited for longest, of a peer, or of the one that uses most of what is short (null).
  /// Returns false where there is nobody.
  bool cut_slowest(std::size_t Use::*what, const std::string* peer, const Place* but, Time now);
  void cut(Place& place);
  void release(Place& place);
  bool make_room(Place& place, std::size_t bytes, Time now);

  PlaceLimits limits_;
  Use all_;
  std::map<std::string, Use> of_peer_;
  std::list<Place*> places_;
};

/// The place of one connection; it is given back with the object.
class Place {
 public:
  using Time = Places::Time;
  ~Place();
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  /// Says that the server waits for the client from now on, and how long it will.
  void wait(Time now, std::chrono::milliseconds longest);
  /// Says that bytes have moved; each `kPaceBytes` of them begin the wait anew.
  void moved(std::size_t bytes, Time now);
  /// Says that the server does not wait for the client.
  void work() noexcept { waits_ = false; }
  [[nodiscard]] bool waits_longer_than(std::chrono::milliseconds time, Time now) const {
    return waits_ && now - since_ > time;
  }
  /// Keeps the place for a connection that may be silent for ever, unless others want to stay and it has been
  /// silent for longest. Returns false where there is no room.
  [[nodiscard]] bool stay(Time now);
  /// Says that there was a sign of the client.
  void heard(Time now) noexcept {
    if (!waits_) since_ = now;
  }
  /// Says how many bytes are on their way. Returns false, and counts as before, where there is no room for
  /// them. More than the limit is taken of who is alone.
  [[nodiscard]] bool hold(std::size_t bytes, Time now);
  [[nodiscard]] const std::string& peer() const noexcept { return peer_; }
  /// Hands the place to another connection of the peer, which takes the place of the first.
  void hand_over(std::function<void()> cut) { cut_ = std::move(cut); }

 private:
  friend class Places;
  Place(Places& places, std::string peer, std::function<void()> cut)
      : places_(places), peer_(std::move(peer)), cut_(std::move(cut)) {}
  Places& places_;
  std::string peer_;
  std::function<void()> cut_;
  std::list<Place*>::iterator at_;
  std::size_t bytes_ = 0, moved_ = 0;
  Time since_{}, until_{};
  std::chrono::milliseconds longest_{};
  bool waits_ = false, stays_ = false, given_ = true;
};

}  // namespace lekalo::server

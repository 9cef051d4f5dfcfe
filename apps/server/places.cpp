#include "places.hpp"

#include <utility>

namespace lekalo::server {

std::unique_ptr<Place> Places::give(const std::string& peer, std::function<void()> cut, Time now) {
  if (of_peer_[peer].connections >= limits_.connections_of_peer &&
      !cut_slowest(&Use::connections, &peer, nullptr, now))
    return nullptr;
  if (all_.connections >= limits_.connections && !cut_slowest(&Use::connections, nullptr, nullptr, now)) {
    if (of_peer_[peer].connections == 0) of_peer_.erase(peer);
    return nullptr;
  }
  std::unique_ptr<Place> place(new Place(*this, peer, std::move(cut)));
  place->at_ = places_.insert(places_.end(), place.get());
  ++all_.connections;
  ++of_peer_[peer].connections;
  return place;
}

void Places::sweep(Time now) {
  for (auto at = places_.begin(); at != places_.end();) {
    Place& place = **at++;
    if (place.waits_ && now >= place.until_) cut(place);
  }
}

void Places::cut_all() {
  while (!places_.empty()) cut(*places_.front());
}

void Places::cut(Place& place) {
  release(place);
  std::exchange(place.cut_, {})();
}

bool Places::cut_slowest(std::size_t Use::*what, const std::string* peer, const Place* but, Time now) {
  // Whose bytes moved a moment ago is not slow.
  const auto patience = std::chrono::seconds(what == &Use::bytes ? 1 : 0);
  const auto may_go = [&](const Place& place) {
    if (&place == but || (peer != nullptr && place.peer_ != *peer)) return false;
    return what == &Use::staying ? place.stays_ : place.waits_ && now - place.since_ >= patience;
  };
  Place* slowest = nullptr;
  std::size_t most = 0;
  for (Place* const place : places_) {
    if (!may_go(*place)) continue;
    const std::size_t use = of_peer_[place->peer_].*what;
    if (slowest != nullptr && (use < most || (use == most && place->since_ >= slowest->since_))) continue;
    slowest = place;
    most = use;
  }
  if (slowest == nullptr) return false;
  cut(*slowest);
  return true;
}

void Places::release(Place& place) {
  if (!std::exchange(place.given_, false)) return;
  const auto peer = of_peer_.find(place.peer_);
  for (Use* const use : {&all_, &peer->second}) {
    --use->connections;
    use->staying -= place.stays_ ? 1 : 0;
    use->bytes -= place.bytes_;
  }
  if (peer->second.connections == 0) of_peer_.erase(peer);
  places_.erase(place.at_);
}

bool Places::make_room(Place& place, std::size_t bytes, Time now) {
  const Use& mine = of_peer_[place.peer_];
  const auto fits = [&](const Use& use, std::size_t limit) {
    const std::size_t others = use.bytes - place.bytes_;
    return others == 0 || others + bytes <= limit;
  };
  while (!fits(mine, limits_.bytes_of_peer))
    if (!cut_slowest(&Use::bytes, &place.peer_, &place, now)) return false;
  while (!fits(all_, limits_.bytes))
    if (!cut_slowest(&Use::bytes, nullptr, &place, now)) return false;
  return true;
}

Place::~Place() { places_.release(*this); }

void Place::wait(Time now, std::chrono::milliseconds longest) {
  waits_ = true;
  since_ = now;
  longest_ = longest;
  until_ = now + longest;
  moved_ = 0;
}

void Place::moved(std::size_t bytes, Time now) {
  moved_ += bytes;
  if (moved_ >= kPaceBytes) wait(now, longest_);
}

bool Place::stay(Time now) {
  if (!given_) return false;
  const PlaceLimits& limits = places_.limits_;
  Places::Use& mine = places_.of_peer_[peer_];
  constexpr auto kStaying = &Places::Use::staying;
  if (mine.staying >= limits.staying_of_peer && !places_.cut_slowest(kStaying, &peer_, this, now))
    return false;
  if (places_.all_.staying >= limits.staying && !places_.cut_slowest(kStaying, nullptr, this, now))
    return false;
  stays_ = true;
  since_ = now;
  ++mine.staying;
  ++places_.all_.staying;
  return true;
}

bool Place::hold(std::size_t bytes, Time now) {
  if (!given_) return false;
  if (bytes > bytes_ && !places_.make_room(*this, bytes, now)) return false;
  for (Places::Use* const use : {&places_.all_, &places_.of_peer_[peer_]}) use->bytes += bytes - bytes_;
  bytes_ = bytes;
  return true;
}

}  // namespace lekalo::server

#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <unordered_map>

#include "access.hpp"
#include "lanes.hpp"
#include "places.hpp"
#include "room.hpp"
#include "server.hpp"

namespace lekalo::server {

/// A client's connection as the rest of the server knows it (talk.cpp). Only the network's thread uses it.
class Talk {
 public:
  Talk() = default;
  virtual ~Talk() = default;
  Talk(const Talk&) = delete;
  Talk& operator=(const Talk&) = delete;

  virtual void hear(const Outgoing& message) = 0;
  /// Tells the connection that a long command of this client has ended, so that what waited for it goes on.
  virtual void is_free() = 0;
  /// Sends a last sentence and closes the connection when that is sent.
  virtual void say_goodbye(const std::string& sentence) = 0;
};

/// A room and the turns in which alone it may be touched.
struct OpenRoom {
  OpenRoom(LayoutId layout, QuickLane& quick, SlowLane& slow)
      : id(layout), turns(std::make_shared<Turns>(quick, slow)) {}
  LayoutId id;
  std::shared_ptr<Turns> turns;
  std::unique_ptr<Room> room;  ///< used in its turns alone
};

/// Everything that the connections share.
///
/// One thread runs the sockets and owns the connections; it does nothing that takes long. A layout's room is
/// touched in its turns alone, so commands of one layout wait for each other, and those of other layouts go
/// on (lanes.hpp). What a room says goes back to the network's thread in the order in which it was said.
struct Service {
  Service(const ServerOptions& options, Store opened);

  Store store;
  std::unique_ptr<boost::asio::io_context> network = std::make_unique<boost::asio::io_context>(1);
  boost::asio::io_context& io = *network;
  AccessRules rules;
  /// This and what follows up to `rooms_lock` is used by the network's thread alone.
  bool stopping = false;
  Places places;
  Guesses guesses;
  std::unordered_map<ClientNumber, std::weak_ptr<Talk>> talks;
  ClientNumber last_client = 0;
  std::mutex rooms_lock;
  /// The rooms that somebody uses.
  std::map<LayoutId, std::weak_ptr<OpenRoom>> rooms;
  std::mutex jobs_lock;
  /// The stop flags of the jobs under way.
  std::set<std::atomic<bool>*> job_stops;
  /// The lanes stand last, because what they run uses the others.
  SlowLane slow, jobs;
  QuickLane quick;

  /// Returns the room of a layout. When nobody uses it any more it is closed: its memory is freed, and its
  /// layout is in the store.
  [[nodiscard]] std::shared_ptr<OpenRoom> take_room(LayoutId id);
  /// Reads the layout unless that was done. It is to be called in the room's turn.
  [[nodiscard]] Result<void> open(OpenRoom& room);
  /// Changes a layout and tells its clients. It is to be called in the room's turn.
  [[nodiscard]] Result<void> change_room(OpenRoom& room,
                                         const std::function<Result<Outbound>(Room&)>& change);
  /// Does something in the turn of a room. Where memory ends halfway, the room may be another than the store
  /// says: it is forgotten then, to be opened anew, and its clients are sent away. Returns false then.
  bool in_turn(OpenRoom& room, const std::function<void()>& act);
  /// Hands messages to the network's thread. It is to be called in a room's turn.
  void deliver(Outbound out);
  /// Runs the jobs that were started in the room. It is to be called in the room's turn.
  /// \param owner  for whom they run
  void run_jobs(const std::shared_ptr<OpenRoom>& room, const std::string& owner);
  /// Ends the jobs under way with what they have.
  void stop_jobs();
  /// Lets what was begun finish, and drops the rest, while everything that it refers to still exists. Returns
  /// false where something has not ended by then.
  [[nodiscard]] bool end(LaneTime until);

 private:
  [[nodiscard]] Result<layout::Change> run_job(const std::shared_ptr<OpenRoom>& room,
                                               const std::string& owner, const JobStart& start);
  void forget(OpenRoom& room);
  /// Does something in the room's turn, if the room is still open then.
  void post_to_room(const std::shared_ptr<OpenRoom>& room, const std::string& owner,
                    std::function<void()> act);
  /// Tells the client's connection that its long command has ended. It is to be called in a room's turn.
  void free_client(ClientNumber client);
};

}  // namespace lekalo::server

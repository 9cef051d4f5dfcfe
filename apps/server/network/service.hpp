#pragma once

#include <atomic>
#include <boost/asio/io_context.hpp>
#include <boost/asio/strand.hpp>
#include <boost/asio/thread_pool.hpp>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "access.hpp"
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

/// A room and the strand on which alone it may be touched.
struct OpenRoom {
  OpenRoom(LayoutId layout, boost::asio::thread_pool& pool) : id(layout), strand(pool.get_executor()) {}
  LayoutId id;
  boost::asio::strand<boost::asio::thread_pool::executor_type> strand;
  std::unique_ptr<Room> room;  ///< used on the strand alone
  std::size_t users = 0;       ///< guarded by Service::rooms_lock
};

/// Everything that the connections share.
///
/// One thread runs the sockets and owns the connections. Up to four threads do the work that takes long. A
/// layout's room is touched on its strand alone, so commands of one layout take turns while those of other
/// layouts go on. What a room says goes back to the network's thread in the order in which it was said.
struct Service {
  Service(const ServerOptions& options, Store opened);

  Store store;
  std::unique_ptr<boost::asio::io_context> network = std::make_unique<boost::asio::io_context>(1);
  boost::asio::io_context& io = *network;
  /// This pool runs the strands of rooms. Nothing on it waits for another room.
  boost::asio::thread_pool pool;
  /// This pool runs requests, which may wait for a room.
  boost::asio::thread_pool api_pool{2};
  boost::asio::thread_pool job_pool;
  /// Set when jobs are to end.
  std::atomic<bool> ending = false;
  AccessRules rules;
  /// This and what follows up to `rooms_lock` is used by the network's thread alone.
  bool stopping = false;
  std::size_t connections = 0;
  std::unordered_map<ClientNumber, std::weak_ptr<Talk>> talks;
  ClientNumber last_client = 0;
  std::mutex rooms_lock;
  std::map<LayoutId, std::shared_ptr<OpenRoom>> rooms;

  [[nodiscard]] std::shared_ptr<OpenRoom> take_room(LayoutId id);
  /// Gives a room back. When nobody uses it any more it is closed: its memory is freed, and its layout is in
  /// the store.
  void give_back(const std::shared_ptr<OpenRoom>& room);
  /// Reads the layout unless that was done. It is to be called on the room's strand.
  [[nodiscard]] Result<void> open(OpenRoom& room);
  /// Changes a layout on its strand, where nobody else changes it, and waits until that is done.
  [[nodiscard]] Result<void> change_room(LayoutId id, const std::function<Result<Outbound>(Room&)>& change);
  /// Hands messages to the network's thread. It is to be called on a room's strand.
  void deliver(Outbound out);
  /// Runs the jobs that were started in the room. It is to be called on the room's strand.
  void run_jobs(const std::shared_ptr<OpenRoom>& room);
  /// Lets what was begun finish. Then drops what waits for the network, while everything that it refers to
  /// still exists.
  void end();

 private:
  [[nodiscard]] Result<layout::Change> run_job(const std::shared_ptr<OpenRoom>& room, const JobStart& start);
  /// Tells the client's connection that its long command has ended. It is to be called on a room's strand.
  void free_client(ClientNumber client);
};

}  // namespace lekalo::server

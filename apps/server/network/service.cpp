#include "service.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>
#include <future>
#include <new>
#include <optional>
#include <thread>
#include <utility>

#include "time_left.hpp"

namespace lekalo::server {
namespace {

namespace asio = boost::asio;

constexpr std::size_t kMostJobs = 4;
constexpr auto kProgressEvery = std::chrono::milliseconds(200);

}  // namespace

Service::Service(const ServerOptions& options, Store opened)
    : store(std::move(opened)),
      pool(std::clamp<std::size_t>(std::thread::hardware_concurrency(), 2, 4)),
      job_pool(kMostJobs),
      rules{options.address, 0, false, options.token} {}

std::shared_ptr<OpenRoom> Service::take_room(LayoutId id) {
  const std::lock_guard lock(rooms_lock);
  std::shared_ptr<OpenRoom>& room = rooms[id];
  if (!room) room = std::make_shared<OpenRoom>(id, pool);
  ++room->users;
  return room;
}

void Service::give_back(const std::shared_ptr<OpenRoom>& room) {
  const std::lock_guard lock(rooms_lock);
  const auto at = rooms.find(room->id);
  if (--room->users == 0 && at != rooms.end() && at->second == room) rooms.erase(at);
}

Result<void> Service::open(OpenRoom& room) {
  if (room.room) return {};
  LEKALO_TRY(StoredLayout layout, store.load(room.id));
  room.room = std::make_unique<Room>(store, room.id, std::move(layout));
  return {};
}

Result<void> Service::change_room(LayoutId id, const std::function<Result<Outbound>(Room&)>& change) {
  const std::shared_ptr<OpenRoom> room = take_room(id);
  std::promise<Result<void>> promise;
  asio::post(room->strand, [&] {
    Result<void> done = open(*room);
    if (done) {
      Result<Outbound> out = change(*room->room);
      if (out)
        deliver(std::move(*out));
      else
        done = tl::unexpected(out.error());
    }
    promise.set_value(std::move(done));
  });
  Result<void> done = promise.get_future().get();
  give_back(room);
  return done;
}

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
  TimeLeft time_left;
  JobContext context;
  context.run.stop = start.stop.get();
  context.run.progress = [&](const Progress& progress) {
    if (ending) *start.stop = true;
    const auto now = Clock::now();
    if (now < next) return;
    next = now + kProgressEvery;
    time_left.take(std::chrono::duration<double>(now - begin).count(), progress.fraction);
    const double fraction = progress.fraction;
    const std::optional<double> left = time_left.seconds();
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

void Service::end() {
  ending = true;
  api_pool.join();
  job_pool.join();
  pool.join();
  network.reset();
}

}  // namespace lekalo::server

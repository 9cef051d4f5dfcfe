#include "service.hpp"

#include <algorithm>
#include <boost/asio/post.hpp>
#include <chrono>
#include <new>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "time_left.hpp"

namespace lekalo::server {
namespace {

namespace asio = boost::asio;

constexpr std::size_t kMostJobs = 4;
constexpr auto kProgressEvery = std::chrono::milliseconds(200);

std::size_t processors() { return std::max(1U, std::thread::hardware_concurrency()); }

}  // namespace

Service::Service(const ServerOptions& options, Store opened)
    : store(std::move(opened)),
      rules{options.address, 0, false, options.token},
      slow(std::max<std::size_t>(processors(), 2) + 1),
      jobs(kMostJobs),
      quick(std::clamp<std::size_t>(processors(), 2, 4), slow) {}

std::shared_ptr<OpenRoom> Service::take_room(LayoutId id) {
  const std::lock_guard lock(rooms_lock);
  std::erase_if(rooms, [](const auto& one) { return one.second.expired(); });
  std::shared_ptr<OpenRoom> room = rooms[id].lock();
  if (!room) rooms[id] = room = std::make_shared<OpenRoom>(id, quick, slow);
  return room;
}

Result<void> Service::open(OpenRoom& room) {
  if (room.room) return {};
  LEKALO_TRY(StoredLayout layout, store.load(room.id));
  room.room = std::make_unique<Room>(store, room.id, std::move(layout));
  return {};
}

Result<void> Service::change_room(OpenRoom& room, const std::function<Result<Outbound>(Room&)>& change) {
  LEKALO_CHECK(open(room));
  LEKALO_TRY(Outbound out, change(*room.room));
  deliver(std::move(out));
  return {};
}

bool Service::in_turn(OpenRoom& room, const std::function<void()>& act) {
  try {
    act();
    return true;
  } catch (const std::bad_alloc&) {
    forget(room);
    return false;
  }
}

void Service::forget(OpenRoom& room) {
  if (!room.room) return;
  std::vector<ClientNumber> clients = room.room->clients();
  room.room.reset();
  asio::post(io, [this, clients = std::move(clients)] {
    for (const ClientNumber client : clients) {
      const auto at = talks.find(client);
      if (at == talks.end()) continue;
      if (const std::shared_ptr<Talk> talk = at->second.lock())
        talk->say_goodbye("there was not enough memory; open the layout again");
    }
  });
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

void Service::post_to_room(const std::shared_ptr<OpenRoom>& room, const std::string& owner,
                           std::function<void()> act) {
  room->turns->post(owner, [this, room, act = std::move(act)] {
    if (room->room) in_turn(*room, act);
  });
}

void Service::run_jobs(const std::shared_ptr<OpenRoom>& room, const std::string& owner) {
  for (JobStart& start : room->room->take_jobs())
    jobs.post(owner, [this, room, owner, start = std::move(start)] {
      Result<layout::Change> found = run_job(room, owner, start);
      post_to_room(room, owner, [this, room, owner, number = start.number, found = std::move(found)] {
        const ClientNumber client = room->room->client_of(number);
        deliver(room->room->job_ended(number, found));
        if (!room->room->is_busy(client)) free_client(client);
        run_jobs(room, owner);
      });
    });
}

Result<layout::Change> Service::run_job(const std::shared_ptr<OpenRoom>& room, const std::string& owner,
                                        const JobStart& start) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  auto next = begin + kProgressEvery;
  TimeLeft time_left;
  JobContext context;
  context.run.stop = start.stop.get();
  context.run.progress = [&](const Progress& progress) {
    const auto now = Clock::now();
    if (now < next) return;
    next = now + kProgressEvery;
    time_left.take(std::chrono::duration<double>(now - begin).count(), progress.fraction);
    const double fraction = progress.fraction;
    const std::optional<double> left = time_left.seconds();
    post_to_room(room, owner, [this, room, number = start.number, fraction, left] {
      deliver(room->room->job_progress(number, fraction, left));
    });
  };
  context.improved = [&](const layout::Change& change) {
    post_to_room(room, owner, [this, room, number = start.number, change] {
      deliver(room->room->job_improved(number, change));
    });
  };
  {
    const std::lock_guard lock(jobs_lock);
    job_stops.insert(start.stop.get());
  }
  Result<layout::Change> found = [&]() -> Result<layout::Change> {
    try {
      return start.job(start.document, context);
    } catch (const std::bad_alloc&) {
      return failure(ErrorCode::environment, "not enough memory for this");
    }
  }();
  const std::lock_guard lock(jobs_lock);
  job_stops.erase(start.stop.get());
  return found;
}

void Service::stop_jobs() {
  const std::lock_guard lock(jobs_lock);
  for (std::atomic<bool>* const stop : job_stops) *stop = true;
}

bool Service::end(LaneTime until) {
  stop_jobs();
  const bool jobs_ended = jobs.end(until), slow_ended = slow.end(until), quick_ended = quick.end(until);
  if (!jobs_ended || !slow_ended || !quick_ended) return false;
  std::vector<std::shared_ptr<OpenRoom>> left;
  {
    const std::lock_guard lock(rooms_lock);
    for (const auto& [id, room] : rooms)
      if (std::shared_ptr<OpenRoom> one = room.lock()) left.push_back(std::move(one));
  }
  for (const std::shared_ptr<OpenRoom>& room : left) room->turns->clear();
  network.reset();
  return true;
}

}  // namespace lekalo::server

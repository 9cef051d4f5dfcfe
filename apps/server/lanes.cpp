#include "lanes.hpp"

#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <system_error>
#include <utility>

namespace lekalo::server {
namespace {

/// Threads beside those of the quick lane whose work turned out to be long.
constexpr std::size_t kMostOvertaken = 32, kMostOvertakenOfOwner = 8;
constexpr auto kWatchEvery = std::chrono::milliseconds(10);

/// Gives a thread a tenth of what others get of a processor that they want too. Failing is no harm.
void make_nice(int system_id) {
  constexpr int kNice = 10, kNicest = 19;
  const auto id = static_cast<id_t>(system_id);
  static_cast<void>(setpriority(PRIO_PROCESS, id, std::min(getpriority(PRIO_PROCESS, id) + kNice, kNicest)));
}

std::chrono::nanoseconds time_of(clockid_t clock) {
  timespec time{};
  if (clock_gettime(clock, &time) != 0) return {};
  return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
}

/// The time that a thread has computed.
std::chrono::nanoseconds computed_by(std::thread& thread) {
  clockid_t clock{};
  return pthread_getcpuclockid(thread.native_handle(), &clock) == 0 ? time_of(clock)
                                                                    : std::chrono::nanoseconds{};
}

}  // namespace

QuickLane::QuickLane(std::size_t threads, SlowLane& slow) : wanted_(threads), lane_of_long_(slow) {
  {
    const std::lock_guard lock(lock_);
    fill();
  }
  watcher_ = std::thread([this] { watch(); });
}

QuickLane::~QuickLane() {
  {
    const std::lock_guard lock(lock_);
    ending_ = watch_ends_ = true;
  }
  work_came_.notify_all();
  watch_on_.notify_one();
  watcher_.join();
  for (Worker& worker : workers_) worker.thread.join();
}

void QuickLane::post(const std::string& owner, Work work) {
  {
    const std::lock_guard lock(lock_);
    if (ending_) return;
    waiting_.push_back({owner, std::move(work)});
  }
  work_came_.notify_one();
}

bool QuickLane::end(LaneTime until) {
  std::deque<Piece> dropped;  // stands before the lock, because what it holds may end with it
  std::unique_lock lock(lock_);
  ending_ = true;
  dropped.swap(waiting_);
  work_came_.notify_all();
  return ended_.wait_until(lock, until, [this] { return quick_ + slow_ == 0; });
}

std::size_t QuickLane::overtaken() const {
  const std::lock_guard lock(lock_);
  return overtaken_;
}

/// Starts threads until as many take up work as are wanted. \pre lock_ is held
void QuickLane::fill() {
  while (!ending_ && quick_ < wanted_ && slow_ < kMostOvertaken) {
    Worker& worker = workers_.emplace_back();
    try {
      worker.thread = std::thread([this, &worker] { run(worker); });
    } catch (const std::system_error&) {  // out of threads: those that are there go on
      workers_.pop_back();
      return;
    }
    ++quick_;
  }
}

void QuickLane::run(Worker& worker) {
  std::unique_lock lock(lock_);
  worker.system_id = gettid();
  for (;;) {
    work_came_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (ending_) break;
    {
      Piece piece = std::move(waiting_.front());
      waiting_.pop_front();
      const auto overtaken = overtaken_of_.find(piece.owner);
      if (overtaken != overtaken_of_.end() && overtaken->second >= kMostOvertakenOfOwner) {
        lock.unlock();
        lane_of_long_.post(piece.owner, std::move(piece.work));
        lock.lock();
        continue;
      }
      worker.owner = std::move(piece.owner);
      const Work work = std::move(piece.work);
      worker.begun = std::chrono::steady_clock::now();
      worker.computed_before = time_of(CLOCK_THREAD_CPUTIME_ID);
      worker.busy = true;
      watch_on_.notify_one();
      lock.unlock();
      work();
      lock.lock();
      worker.busy = false;
    }
    if (worker.overtaken) break;  // another thread is in its place
  }
  if (worker.overtaken && --overtaken_of_[worker.owner] == 0) overtaken_of_.erase(worker.owner);
  --(worker.overtaken ? slow_ : quick_);
  worker.ended = true;
  fill();
  ended_.notify_all();
  watch_on_.notify_one();
}

void QuickLane::watch() {
  std::unique_lock lock(lock_);
  while (!watch_ends_) {
    for (auto worker = workers_.begin(); worker != workers_.end();) {
      const auto one = worker++;
      if (!one->ended || ending_) continue;
      one->thread.join();  // it has let go of the lock for the last time, or is about to
      workers_.erase(one);
    }
    const LaneTime now = std::chrono::steady_clock::now();
    bool any = false;
    for (Worker& worker : workers_) {
      if (!worker.busy) continue;
      any = any || !worker.overtaken || !worker.nice;
      look_after(worker, now);
    }
    if (any)
      watch_on_.wait_for(lock, kWatchEvery);
    else
      watch_on_.wait(lock);
  }
}

void QuickLane::look_after(Worker& worker, LaneTime now) {
  if (now - worker.begun < kLong) return;
  if (!worker.overtaken && slow_ < kMostOvertaken) {
    worker.overtaken = true;
    ++overtaken_;
    ++overtaken_of_[worker.owner];
    --quick_;
    ++slow_;
    fill();
  }
  if (worker.overtaken && !worker.nice && computed_by(worker.thread) - worker.computed_before >= kLong) {
    worker.nice = true;
    make_nice(worker.system_id);
  }
}

SlowLane::SlowLane(std::size_t threads) : most_of_owner_(std::max<std::size_t>(threads, 2) - 1) {
  for (std::size_t i = 0; i < threads; ++i) threads_.emplace_back([this] { run(); });
}

SlowLane::~SlowLane() {
  {
    const std::lock_guard lock(lock_);
    ending_ = true;
  }
  work_came_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void SlowLane::post(const std::string& owner, Work work) {
  {
    const std::lock_guard lock(lock_);
    if (ending_) return;
    Owner& his = owners_[owner];
    if (his.waiting.empty()) turns_.push_back(owner);
    his.waiting.push_back(std::move(work));
  }
  work_came_.notify_all();
}

bool SlowLane::end(LaneTime until) {
  std::map<std::string, Owner> dropped;  // stands before the lock, because what it holds may end with it
  std::unique_lock lock(lock_);
  ending_ = true;
  dropped.swap(owners_);
  turns_.clear();
  work_came_.notify_all();
  return ended_.wait_until(lock, until, [this] { return running_ == 0; });
}

/// The owner whose work is next; the end where none may go on.
std::list<std::string>::iterator SlowLane::next() {
  return std::find_if(turns_.begin(), turns_.end(),
                      [this](const std::string& owner) { return owners_[owner].running < most_of_owner_; });
}

void SlowLane::run() {
  make_nice(gettid());
  std::unique_lock lock(lock_);
  for (;;) {
    work_came_.wait(lock, [this] { return ending_ || next() != turns_.end(); });
    if (ending_) return;
    const auto turn = next();
    const std::string name = *turn;
    turns_.erase(turn);
    Owner& owner = owners_[name];
    Work work = std::move(owner.waiting.front());
    owner.waiting.pop_front();
    if (!owner.waiting.empty()) turns_.push_back(name);
    ++owner.running;
    ++running_;
    lock.unlock();
    work();
    work = {};
    lock.lock();
    --running_;
    ended_.notify_all();
    if (ending_) return;
    const auto at = owners_.find(name);
    if (--at->second.running == 0 && at->second.waiting.empty()) owners_.erase(at);
    work_came_.notify_all();
  }
}

void Turns::post(const std::string& owner, Work work, Length length) {
  const std::lock_guard lock(lock_);
  waiting_.push_back({owner, std::move(work), length});
  if (!running_) start();
}

void Turns::clear() {
  std::deque<Piece> dropped;
  const std::lock_guard lock(lock_);
  dropped.swap(waiting_);
}

/// Sends the next piece to its lane. \pre lock_ is held, and one waits
void Turns::start() {
  running_ = true;
  const auto run_next = [self = shared_from_this()] { self->run(); };
  const Piece& next = waiting_.front();
  if (next.length == Length::lengthy || (next.length == Length::as_before && is_slow_))
    slow_.post(next.owner, run_next);
  else
    quick_.post(next.owner, run_next);
}

void Turns::run() {
  Work work;
  Length length{};
  {
    const std::lock_guard lock(lock_);
    work = std::move(waiting_.front().work);
    length = waiting_.front().length;
  }
  const std::chrono::nanoseconds before = time_of(CLOCK_THREAD_CPUTIME_ID);
  work();
  work = {};
  const bool was_long = time_of(CLOCK_THREAD_CPUTIME_ID) - before >= kLong;
  const std::lock_guard lock(lock_);
  if (length == Length::as_before) is_slow_ = was_long;
  waiting_.pop_front();
  running_ = false;
  if (!waiting_.empty()) start();
}

}  // namespace lekalo::server

#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace lekalo::server {

/// Threads on which what is short never waits for what is long: docs/design/server.md, step 4. Work does not
/// throw, and never waits for other work.
using Work = std::function<void()>;
using LaneTime = std::chrono::steady_clock::time_point;

/// Work that lasts longer than this is long.
inline constexpr auto kLong = std::chrono::milliseconds(20);

/// The lane for work that is known to take long. A few threads, with less of the processor than others, take
/// it up in turns of its owners, and leave one thread to others than an owner who has all the rest.
class SlowLane {
 public:
  explicit SlowLane(std::size_t threads);
  ~SlowLane();
  SlowLane(const SlowLane&) = delete;
  SlowLane& operator=(const SlowLane&) = delete;

  void post(const std::string& owner, Work work);
  [[nodiscard]] bool end(LaneTime until);

 private:
  struct Owner {
    std::deque<Work> waiting;
    std::size_t running = 0;
  };
  void run();
  [[nodiscard]] std::list<std::string>::iterator next();

  const std::size_t most_of_owner_;
  std::mutex lock_;
  std::condition_variable work_came_, ended_;
  std::map<std::string, Owner> owners_;
  std::list<std::string> turns_;  ///< owners with work that waits, next first
  std::size_t running_ = 0;
  bool ending_ = false;
  std::vector<std::thread> threads_;
};

/// The lane for work that is expected to be short. Where some lasts longer all the same, another thread takes
/// the place of its own, so that nothing waits for it; and where it computes for so long, it goes on with
/// less of the processor than others. An owner whose work lasted longer too often goes to the slow lane.
class QuickLane {
 public:
  /// \param threads  that take up work at one time
  QuickLane(std::size_t threads, SlowLane& slow);
  /// Drops what has not begun, and waits for what has.
  ~QuickLane();
  QuickLane(const QuickLane&) = delete;
  QuickLane& operator=(const QuickLane&) = delete;

  /// \param owner  for whom it is done
  void post(const std::string& owner, Work work);
  /// Takes no more work, and waits until that which was begun has ended. Returns false if some has not by
  /// then.
  [[nodiscard]] bool end(LaneTime until);
  /// Returns how many pieces of work were overtaken so far.
  [[nodiscard]] std::size_t overtaken() const;

 private:
  struct Piece {
    std::string owner;
    Work work;
  };
  struct Worker {
    std::thread thread;
    std::string owner;  ///< of the work that it does
    int system_id = 0;
    LaneTime begun;
    std::chrono::nanoseconds computed_before{};
    bool busy = false, overtaken = false, nice = false, ended = false;
  };
  void fill();
  void run(Worker& worker);
  void watch();
  void look_after(Worker& worker, LaneTime now);

  const std::size_t wanted_;
  SlowLane& lane_of_long_;
  mutable std::mutex lock_;
  std::condition_variable work_came_, watch_on_, ended_;
  std::deque<Piece> waiting_;
  std::list<Worker> workers_;
  std::map<std::string, std::size_t> overtaken_of_;  ///< pieces of each owner that are under way
  /// Threads that take up work, threads whose work was overtaken, and pieces of work that were.
  std::size_t quick_ = 0, slow_ = 0, overtaken_ = 0;
  bool ending_ = false, watch_ends_ = false;
  std::thread watcher_;  // stands last, because it uses the others
};

/// How long a piece of work is expected to last.
enum class Length {
  brief,      ///< not long
  as_before,  ///< long if the last piece of which that was said was long
  lengthy     ///< long
};

/// Work on one thing that takes turns: one piece after the other, in the order in which they came, each on
/// the lane that fits.
class Turns : public std::enable_shared_from_this<Turns> {
 public:
  Turns(QuickLane& quick, SlowLane& slow) : quick_(quick), slow_(slow) {}
  /// \param owner  for whom it is done
  void post(const std::string& owner, Work work, Length length = Length::brief);
  /// Drops what waits. \pre the lanes have ended
  void clear();

 private:
  struct Piece {
    std::string owner;
    Work work;
    Length length = Length::brief;
  };
  void start();
  void run();

  QuickLane& quick_;
  SlowLane& slow_;
  std::mutex lock_;
  std::deque<Piece> waiting_;
  bool running_ = false, is_slow_ = false;
};

}  // namespace lekalo::server

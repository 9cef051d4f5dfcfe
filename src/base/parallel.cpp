#include "lekalo/base/parallel.hpp"

#include "lekalo/base/stop.hpp"

#ifdef LEKALO_WITH_THREADS
#include <algorithm>
#include <atomic>
#include <exception>
#include <thread>
#include <vector>
#endif

namespace lekalo {
namespace {

void do_in_turn(std::size_t count, const std::function<void(std::size_t)>& act) {
  for (std::size_t i = 0; i < count; ++i) act(i);
}

}  // namespace

#ifdef LEKALO_WITH_THREADS

void share_out(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& act) {
  const std::size_t workers = std::min<std::size_t>(count, threads);
  if (workers < 2) return do_in_turn(count, act);
  std::atomic<std::size_t> next{1};
  std::vector<std::exception_ptr> thrown(workers);
  const auto work = [&](std::size_t worker, std::size_t first) {
    try {
      for (std::size_t i = first; i < count; i = next++) act(i);
    } catch (...) {
      thrown[worker] = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  others.reserve(workers - 1);
  try {
    while (others.size() + 1 < workers)
      others.emplace_back([&work, &next, worker = others.size() + 1, caller = Listening::now()] {
        const Listening as_the_caller(caller);
        work(worker, next++);
      });
  } catch (const std::exception&) {
    // Those that run take the rest.
  }
  work(0, 0);
  for (std::thread& other : others) other.join();
  for (const std::exception_ptr& one : thrown)
    if (one) std::rethrow_exception(one);
}

#else

void share_out(std::size_t count, unsigned /*threads*/, const std::function<void(std::size_t)>& act) {
  do_in_turn(count, act);
}

#endif

}  // namespace lekalo

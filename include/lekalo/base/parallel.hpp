#pragma once

#include <cstddef>
#include <functional>

namespace lekalo {

/// The threads of a job whose caller asks for no number: they change the speed and nothing else.
inline constexpr unsigned kUsualThreads = 2;

/// Calls act(number) for every number below `count`, each once, on at most `threads` threads, and returns
/// when all are done. The caller's thread is one of them and begins with number 0; which thread takes which
/// of the others is open, so a result may not depend on it. Where the system gives no more threads, fewer do
/// the work. What act throws is thrown here, when no thread works any more; then some numbers may not be
/// done. Every thread listens to the stop of the caller's (base/stop.hpp).
///
/// This is the only place of the library that starts threads. Compiled without LEKALO_WITH_THREADS (an option
/// of CMake) it calls act in ascending order, as it does for one thread. Flags that another thread sets, and
/// what is made once by whoever needs it first, are atomics of the language and need no threads.
void share_out(std::size_t count, unsigned threads, const std::function<void(std::size_t)>& act);

}  // namespace lekalo

#pragma once

#include <atomic>
#include <memory>

namespace lekalo::nest {

/// Holds what is made by whoever needs it first, on whichever thread. Two may make it at the same time: the
/// first is kept, and both use that one.
template <class T>
class MadeOnce {
 public:
  MadeOnce() = default;
  MadeOnce(const MadeOnce&) = delete;
  MadeOnce& operator=(const MadeOnce&) = delete;
  ~MadeOnce() { delete find(); }

  /// Null until it is made.
  T* find() const noexcept { return made_.load(std::memory_order_acquire); }
  T& keep(std::unique_ptr<T> made) noexcept {
    T* kept = nullptr;
    if (made_.compare_exchange_strong(kept, made.get(), std::memory_order_acq_rel, std::memory_order_acquire))
      kept = made.release();
    return *kept;
  }

 private:
  std::atomic<T*> made_{nullptr};
};

}  // namespace lekalo::nest

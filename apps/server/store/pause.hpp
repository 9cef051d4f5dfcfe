#pragma once

#include <mutex>

namespace lekalo::server {

/// Lets others have their turn while rows that were read are looked at, which takes longer than to read them.
class Pause {
 public:
  explicit Pause(std::unique_lock<std::mutex>& turn) : turn_(turn) { turn_.unlock(); }
  ~Pause() { turn_.lock(); }
  Pause(const Pause&) = delete;
  Pause& operator=(const Pause&) = delete;

 private:
  std::unique_lock<std::mutex>& turn_;
};

}  // namespace lekalo::server

#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace lekalo::cases {

/// Each makes one of the program's Prepared.
inline std::vector<std::function<void()>>& preparations() {
  static std::vector<std::function<void()>> all;
  return all;
}

/// What many tests look at and is dear to make: it is made when it is first asked for. A trial of a mutant is
/// a child of a process that has made them all (tests/mutation/runner.cpp), so that no trial makes one again.
template <class T>
class Prepared {
 public:
  explicit Prepared(std::function<T()> make) : make_(std::move(make)) {
    preparations().emplace_back([this] { (void)**this; });
  }
  Prepared(const Prepared&) = delete;
  Prepared& operator=(const Prepared&) = delete;

  const T& operator*() const {
    if (!made_) made_.emplace(make_());
    return *made_;
  }
  const T* operator->() const { return &**this; }

 private:
  std::function<T()> make_;
  mutable std::optional<T> made_;
};

}  // namespace lekalo::cases

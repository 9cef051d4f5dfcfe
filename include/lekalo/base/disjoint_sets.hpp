#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace lekalo {

/// The numbers below a count in sets that are joined one by one; the smallest of a set stands for it.
/// Cost: O(log n) a question, amortised.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }
  /// Returns the number that stands for the set of i.
  [[nodiscard]] std::uint32_t of(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(std::uint32_t i, std::uint32_t j) {
    i = of(i);
    j = of(j);
    if (i < j) parent_[j] = i;
    if (j < i) parent_[i] = j;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace lekalo

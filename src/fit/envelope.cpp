#include "envelope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace lekalo::fit {
namespace {

/// The sums of a product, and the rows that are multiplied side by side.
constexpr std::size_t kSums = 4, kAtOnce = 4;

/// Two numbers in one register; the compiler makes much of its own of anything else.
using Pair = double __attribute__((vector_size(16)));
Pair pair_at(const double* p) {
  Pair pair;
  std::memcpy(&pair, p, sizeof pair);
  return pair;
}

/// Four sums, in an order that no option of the compiler changes.
double dot(const double* a, const double* b, std::size_t n) {
  Pair low{}, high{};
  std::size_t i = 0;
  for (; i + kSums <= n; i += kSums) {
    low += pair_at(a + i) * pair_at(b + i);
    high += pair_at(a + i + 2) * pair_at(b + i + 2);
  }
  double s0 = low[0];
  for (; i < n; ++i) s0 += a[i] * b[i];
  return (s0 + low[1]) + (high[0] + high[1]);
}

}  // namespace

Envelope::Envelope(const std::vector<std::size_t>& first) : first_(first), start_(first.size()) {
  std::size_t size = 0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    start_[i] = size - first[i];
    size += i - first[i] + 1;
  }
  entries_.resize(size);
}

void Envelope::clear() { std::fill(entries_.begin(), entries_.end(), 0.0); }

/// Rows that begin at one column, as those of neighbouring nodes do, are multiplied by this one side by side,
/// so that each of its entries is read once. Every sum has the order that dot() has.
void Envelope::factor_four(double* row, std::size_t first, std::size_t from, std::size_t j) const {
  const double* const a = row + (from - first);
  std::array<const double*, kAtOnce> b{};
  for (std::size_t q = 0; q < kAtOnce; ++q) b[q] = entries_.data() + (start_[j + q] + from);
  const std::size_t common = (j - from) / kSums * kSums;
  std::array<std::array<Pair, kSums / 2>, kAtOnce> sums{};
  for (std::size_t k = 0; k < common; k += kSums) {
    const Pair low = pair_at(a + k), high = pair_at(a + k + 2);
    for (std::size_t q = 0; q < kAtOnce; ++q) {
      sums[q][0] += low * pair_at(b[q] + k);
      sums[q][1] += high * pair_at(b[q] + k + 2);
    }
  }
  for (std::size_t q = 0; q < kAtOnce; ++q) {
    const std::size_t n = j + q - from;
    std::size_t k = common;
    for (; k + kSums <= n; k += kSums) {
      sums[q][0] += pair_at(a + k) * pair_at(b[q] + k);
      sums[q][1] += pair_at(a + k + 2) * pair_at(b[q] + k + 2);
    }
    double s0 = sums[q][0][0];
    const double s1 = sums[q][0][1], s2 = sums[q][1][0], s3 = sums[q][1][1];
    for (; k < n; ++k) s0 += a[k] * b[q][k];
    double& entry = row[j + q - first];
    entry = (entry - ((s0 + s1) + (s2 + s3))) / entries_[start_[j + q] + j + q];
  }
}

bool Envelope::factor() {
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const std::size_t first = first_[i];
    double* const row = entries_.data() + (start_[i] + first);
    for (std::size_t j = first; j < i;) {
      const std::size_t from = std::max(first, first_[j]);
      std::size_t alike = 1;
      while (alike < kAtOnce && j + alike < i && std::max(first, first_[j + alike]) == from) ++alike;
      if (alike == kAtOnce) {
        factor_four(row, first, from, j);
        j += kAtOnce;
        continue;
      }
      double& entry = row[j - first];
      const double* const other = entries_.data() + (start_[j] + from);
      entry = (entry - dot(row + (from - first), other, j - from)) / entries_[start_[j] + j];
      ++j;
    }
    double& diagonal = row[i - first];
    const double left = diagonal - dot(row, row, i - first);
    if (!(left > 0)) return false;
    diagonal = std::sqrt(left);
  }
  return true;
}

void Envelope::solve(std::vector<double>& right) const {
  for (std::size_t i = 0; i < first_.size(); ++i) {
    const double* const row = entries_.data() + (start_[i] + first_[i]);
    const double sum = dot(row, right.data() + first_[i], i - first_[i]);
    right[i] = (right[i] - sum) / row[i - first_[i]];
  }
  for (std::size_t i = first_.size(); i-- > 0;) {
    const double* const row = entries_.data() + (start_[i] + first_[i]);
    right[i] /= row[i - first_[i]];
    for (std::size_t j = first_[i]; j < i; ++j) right[j] -= row[j - first_[i]] * right[i];
  }
}

}  // namespace lekalo::fit

#include "envelope.hpp"

#include <algorithm>
#include <cmath>

namespace lekalo::fit {
namespace {

/// Four sums, in an order that no option of the compiler changes.
double dot(const double* a, const double* b, std::size_t n) {
  double s0 = 0, s1 = 0, s2 = 0, s3 = 0;
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    s0 += a[i] * b[i];
    s1 += a[i + 1] * b[i + 1];
    s2 += a[i + 2] * b[i + 2];
    s3 += a[i + 3] * b[i + 3];
  }
  for (; i < n; ++i) s0 += a[i] * b[i];
  return (s0 + s1) + (s2 + s3);
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

bool Envelope::factor() {
  for (std::size_t i = 0; i < first_.size(); ++i) {
    double* const row = entries_.data() + (start_[i] + first_[i]);
    for (std::size_t j = first_[i]; j < i; ++j) {
      const std::size_t from = std::max(first_[i], first_[j]);
      const double* const other = entries_.data() + (start_[j] + from);
      double& entry = row[j - first_[i]];
      entry = (entry - dot(row + (from - first_[i]), other, j - from)) / entries_[start_[j] + j];
    }
    double& diagonal = row[i - first_[i]];
    const double left = diagonal - dot(row, row, i - first_[i]);
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

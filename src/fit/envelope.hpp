#pragma once

#include <cstddef>
#include <vector>

namespace lekalo::fit {

/// A symmetric positive definite matrix of which each row is kept from its first entry to the diagonal, and
/// its Cholesky factor in the same place. For numberings along a body, whose rows are short.
class Envelope {
 public:
  /// \param first  of each row, the column of its first entry; not above the row
  explicit Envelope(const std::vector<std::size_t>& first);

  void clear();
  /// Adds to the entry and its mirror. \pre first[row] <= column <= row
  void add(std::size_t row, std::size_t column, double value) { entries_[start_[row] + column] += value; }

  /// Factors in place; false where the matrix is not positive definite. Cost: O(rows * width^2).
  [[nodiscard]] bool factor();
  /// Solves with the factor, in place. Cost: O(entries).
  void solve(std::vector<double>& right) const;

 private:
  void factor_four(double* row, std::size_t first, std::size_t from, std::size_t j) const;

  std::vector<std::size_t> first_;
  std::vector<std::size_t> start_;  // of each row: the place its column 0 would have, modulo 2^64
  std::vector<double> entries_;
};

}  // namespace lekalo::fit

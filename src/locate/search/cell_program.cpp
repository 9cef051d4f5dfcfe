#include "cell_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/base/assert.hpp"

namespace lekalo::locate {
namespace {

/// Far above what any program needs, this ends a cycle that rounding could cause. The bound is valid anyway.
constexpr int kMostPivots = 200;

/// The dual simplex method for one cell. Constraints are numbered: rows first, then the sides of the cell
/// (2 i for z_i <= half_i, 2 i + 1 for -z_i <= half_i).
template <std::size_t N>
class Simplex {
 public:
  Simplex(const std::vector<LinearBound<N>>& rows, const std::array<double, N>& half)
      : rows_(rows), half_(half) {}

  LinearSolution<N> run() {
    start();
    for (int n = 0; n < kMostPivots; ++n) {
      if (!meet()) break;
      const std::uint32_t entering = most_violated();
      if (entering == kNone || !pivot(entering)) break;
    }
    return solution();
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  using Vector = std::array<double, N + 1>;  // z, r
  using Matrix = std::array<Vector, N + 1>;

  [[nodiscard]] std::uint32_t side(std::size_t i, bool upper) const {
    return static_cast<std::uint32_t>(rows_.size() + 2 * i + (upper ? 0 : 1));
  }
  [[nodiscard]] Vector normal(std::uint32_t constraint) const {
    if (constraint < rows_.size()) {
      Vector n;
      for (std::size_t i = 0; i < N; ++i) n[i] = -rows_[constraint].slope[i];
      n[N] = 1;
      return n;
    }
    const std::size_t k = constraint - rows_.size();
    Vector n{};
    n[k / 2] = k % 2 == 0 ? 1 : -1;
    return n;
  }
  [[nodiscard]] double right_side(std::uint32_t constraint) const {
    return constraint < rows_.size() ? rows_[constraint].level : half_[(constraint - rows_.size()) / 2];
  }

  /// Starts with the row that bounds best alone, at the corner of the cell where it is highest. This is a
  /// dual feasible basis.
  void start() {
    double best = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < rows_.size(); ++k) {
      double top = rows_[k].level;
      for (std::size_t i = 0; i < N; ++i) top += std::abs(rows_[k].slope[i]) * half_[i];
      if (top < best) best = top, basis_[0] = k;
    }
    for (std::size_t i = 0; i < N; ++i) basis_[i + 1] = side(i, rows_[basis_[0]].slope[i] >= 0);
  }

  /// Computes inverse_, the inverse of the matrix whose rows are the basis's normals, and from it point_ and
  /// multiplier_. Returns false when the matrix is singular.
  bool meet() {
    Matrix a{};
    Matrix b{};
    for (std::size_t j = 0; j < N + 1; ++j) a[j] = normal(basis_[j]), b[j][j] = 1;
    for (std::size_t j = 0; j < N + 1; ++j) {
      std::size_t p = j;
      for (std::size_t k = j + 1; k < N + 1; ++k)
        if (std::abs(a[k][j]) > std::abs(a[p][j])) p = k;
      if (!(std::abs(a[p][j]) > 1e-13)) return false;
      std::swap(a[p], a[j]);
      std::swap(b[p], b[j]);
      const double scale = 1 / a[j][j];
      for (std::size_t i = 0; i < N + 1; ++i) a[j][i] *= scale, b[j][i] *= scale;
      for (std::size_t k = 0; k < N + 1; ++k) {
        if (k == j || a[k][j] == 0) continue;
        const double f = a[k][j];
        for (std::size_t i = 0; i < N + 1; ++i) a[k][i] -= f * a[j][i], b[k][i] -= f * b[j][i];
      }
    }
    inverse_ = b;
    for (std::size_t i = 0; i < N + 1; ++i) {
      point_[i] = 0;
      for (std::size_t j = 0; j < N + 1; ++j) point_[i] += inverse_[i][j] * right_side(basis_[j]);
    }
    multiplier_ = inverse_[N];  // r = sum of inverse_[N][j] times the right sides
    return true;
  }

  [[nodiscard]] std::uint32_t most_violated() const {
    constexpr double kTolerance = 1e-12;
    const double tolerance = kTolerance * (1 + std::abs(point_[N]));
    std::uint32_t worst = kNone;
    double by = tolerance;
    for (std::uint32_t k = 0; k < rows_.size(); ++k) {
      const LinearBound<N>& row = rows_[k];
      double top = row.level;
      for (std::size_t i = 0; i < N; ++i) top += row.slope[i] * point_[i];
      const double over = point_[N] - top;
      if (over > by) by = over, worst = k;
    }
    for (std::size_t i = 0; i < N; ++i) {
      const double over = std::abs(point_[i]) - half_[i];
      if (over > by) by = over, worst = side(i, point_[i] > 0);
    }
    return worst;
  }

  bool pivot(std::uint32_t entering) {
    const Vector n = normal(entering);
    std::size_t leaving = N + 1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < N + 1; ++j) {
      double w = 0;  // the entering normal is sum w_j times the basis's normals
      for (std::size_t i = 0; i < N + 1; ++i) w += n[i] * inverse_[i][j];
      if (!(w > 1e-12)) continue;
      const double ratio = std::max(multiplier_[j], 0.0) / w;
      if (ratio < least) least = ratio, leaving = j;
    }
    if (leaving == N + 1) return false;
    basis_[leaving] = entering;
    return true;
  }

  [[nodiscard]] LinearSolution<N> solution() const {
    LinearSolution<N> s;
    for (std::size_t i = 0; i < N; ++i) s.z[i] = std::clamp(point_[i], -half_[i], half_[i]);
    double sum = 0;
    for (std::size_t j = 0; j < N + 1; ++j) {
      if (basis_[j] >= rows_.size() || !(multiplier_[j] > 0)) continue;
      s.row[s.rows] = basis_[j], s.multiplier[s.rows++] = multiplier_[j];
      sum += multiplier_[j];
    }
    if (!(sum > 0)) s.rows = 1, s.row[0] = basis_[0], s.multiplier[0] = sum = 1;
    std::array<double, N> slope{};
    for (std::size_t j = 0; j < s.rows; ++j) {
      s.multiplier[j] /= sum;
      const LinearBound<N>& row = rows_[s.row[j]];
      s.bound += s.multiplier[j] * row.level;
      for (std::size_t i = 0; i < N; ++i) slope[i] += s.multiplier[j] * row.slope[i];
    }
    for (std::size_t i = 0; i < N; ++i) s.bound += std::abs(slope[i]) * half_[i];
    return s;
  }

  const std::vector<LinearBound<N>>& rows_;
  std::array<double, N> half_;
  std::array<std::uint32_t, N + 1> basis_{};
  Matrix inverse_{};
  Vector point_{}, multiplier_{};
};

}  // namespace

template <std::size_t N>
LinearSolution<N> solve_cell(const std::vector<LinearBound<N>>& rows, const std::array<double, N>& half) {
  LEKALO_ASSERT(!rows.empty());
  return Simplex<N>(rows, half).run();
}

template LinearSolution<3> solve_cell(const std::vector<LinearBound<3>>&, const std::array<double, 3>&);
template LinearSolution<6> solve_cell(const std::vector<LinearBound<6>>&, const std::array<double, 6>&);

}  // namespace lekalo::locate

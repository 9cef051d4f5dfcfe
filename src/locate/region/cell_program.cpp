#include "cell_program.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lekalo/base/assert.hpp"

namespace lekalo::locate {
namespace {

/// Far above what any program needs, this ends a cycle that rounding could cause. The bound is valid anyway.
constexpr int kMostPivots = 200;

using Vector4 = std::array<double, 4>;  // z, r
using Matrix4 = std::array<Vector4, 4>;

/// The dual simplex method for one cell. Constraints are numbered: rows first, then the six sides of the cell
/// (2 i for z_i <= half_i, 2 i + 1 for -z_i <= half_i).
class Simplex {
 public:
  Simplex(const std::vector<CellRow>& rows, const std::array<double, 3>& half) : rows_(rows), half_(half) {}

  CellSolution run() {
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

  [[nodiscard]] std::uint32_t side(std::size_t i, bool upper) const {
    return static_cast<std::uint32_t>(rows_.size() + 2 * i + (upper ? 0 : 1));
  }
  [[nodiscard]] Vector4 normal(std::uint32_t constraint) const {
    if (constraint < rows_.size()) {
      const auto& s = rows_[constraint].slope;
      return {-s[0], -s[1], -s[2], 1};
    }
    const std::size_t k = constraint - rows_.size();
    Vector4 n{};
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
      for (std::size_t i = 0; i < 3; ++i) top += std::abs(rows_[k].slope[i]) * half_[i];
      if (top < best) best = top, basis_[0] = k;
    }
    for (std::size_t i = 0; i < 3; ++i) basis_[i + 1] = side(i, rows_[basis_[0]].slope[i] >= 0);
  }

  /// Computes inverse_, the inverse of the matrix whose rows are the basis's normals, and from it point_ and
  /// multiplier_. Returns false when the matrix is singular.
  bool meet() {
    Matrix4 a{};
    Matrix4 b{};
    for (std::size_t j = 0; j < 4; ++j) a[j] = normal(basis_[j]), b[j][j] = 1;
    for (std::size_t j = 0; j < 4; ++j) {
      std::size_t p = j;
      for (std::size_t k = j + 1; k < 4; ++k)
        if (std::abs(a[k][j]) > std::abs(a[p][j])) p = k;
      if (!(std::abs(a[p][j]) > 1e-13)) return false;
      std::swap(a[p], a[j]);
      std::swap(b[p], b[j]);
      const double scale = 1 / a[j][j];
      for (std::size_t i = 0; i < 4; ++i) a[j][i] *= scale, b[j][i] *= scale;
      for (std::size_t k = 0; k < 4; ++k) {
        if (k == j || a[k][j] == 0) continue;
        const double f = a[k][j];
        for (std::size_t i = 0; i < 4; ++i) a[k][i] -= f * a[j][i], b[k][i] -= f * b[j][i];
      }
    }
    inverse_ = b;
    for (std::size_t i = 0; i < 4; ++i) {
      point_[i] = 0;
      for (std::size_t j = 0; j < 4; ++j) point_[i] += inverse_[i][j] * right_side(basis_[j]);
    }
    multiplier_ = inverse_[3];  // r = sum of inverse_[3][j] times the right sides
    return true;
  }

  [[nodiscard]] std::uint32_t most_violated() const {
    constexpr double kTolerance = 1e-12;
    const double tolerance = kTolerance * (1 + std::abs(point_[3]));
    std::uint32_t worst = kNone;
    double by = tolerance;
    for (std::uint32_t k = 0; k < rows_.size(); ++k) {
      const CellRow& row = rows_[k];
      const double over = point_[3] - (row.level + row.slope[0] * point_[0] + row.slope[1] * point_[1] +
                                       row.slope[2] * point_[2]);
      if (over > by) by = over, worst = k;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const double over = std::abs(point_[i]) - half_[i];
      if (over > by) by = over, worst = side(i, point_[i] > 0);
    }
    return worst;
  }

  bool pivot(std::uint32_t entering) {
    const Vector4 n = normal(entering);
    std::size_t leaving = 4;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < 4; ++j) {
      double w = 0;  // the entering normal is sum w_j times the basis's normals
      for (std::size_t i = 0; i < 4; ++i) w += n[i] * inverse_[i][j];
      if (!(w > 1e-12)) continue;
      const double ratio = std::max(multiplier_[j], 0.0) / w;
      if (ratio < least) least = ratio, leaving = j;
    }
    if (leaving == 4) return false;
    basis_[leaving] = entering;
    return true;
  }

  [[nodiscard]] CellSolution solution() const {
    CellSolution s;
    for (std::size_t i = 0; i < 3; ++i) s.z[i] = std::clamp(point_[i], -half_[i], half_[i]);
    double sum = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      if (basis_[j] >= rows_.size() || !(multiplier_[j] > 0)) continue;
      s.row[s.rows] = basis_[j], s.multiplier[s.rows++] = multiplier_[j];
      sum += multiplier_[j];
    }
    if (!(sum > 0)) s.rows = 1, s.row[0] = basis_[0], s.multiplier[0] = sum = 1;
    std::array<double, 3> slope{};
    for (std::size_t j = 0; j < s.rows; ++j) {
      s.multiplier[j] /= sum;
      const CellRow& row = rows_[s.row[j]];
      s.bound += s.multiplier[j] * row.level;
      for (std::size_t i = 0; i < 3; ++i) slope[i] += s.multiplier[j] * row.slope[i];
    }
    for (std::size_t i = 0; i < 3; ++i) s.bound += std::abs(slope[i]) * half_[i];
    return s;
  }

  const std::vector<CellRow>& rows_;
  std::array<double, 3> half_;
  std::array<std::uint32_t, 4> basis_{};
  Matrix4 inverse_{};
  Vector4 point_{}, multiplier_{};
};

}  // namespace

CellSolution solve_cell(const std::vector<CellRow>& rows, const std::array<double, 3>& half) {
  LEKALO_ASSERT(!rows.empty());
  return Simplex(rows, half).run();
}

}  // namespace lekalo::locate

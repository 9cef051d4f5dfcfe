#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "lattice.hpp"

namespace lekalo::heat {

/// How the voxels of a stretch of a row pass heat on: with six neighbours; with eighteen, all alike; or with
/// those that are whole.
enum class Stretch : std::uint8_t { six, eighteen, mixed };

/// Voxels that are whole: these pass heat on with eighteen neighbours (docs/design/heat.md, step 4).
struct Wholes {
  std::vector<float> voxel;        ///< 1 where it is whole, else 0
  std::vector<Stretch> stretches;  ///< of Lattice::kWide voxels, row by row
};

/// How much voxels hold and pass on.
template <class Real>
struct Flow {
  Lattice lattice;
  std::vector<Real> capacity;              ///< J/K
  std::vector<Real> loss;                  ///< W/K to the surroundings
  std::array<std::vector<Real>, 3> joint;  ///< W/K to the lower neighbour along each axis
  std::vector<Real> diagonal;              ///< of the system; 0 where a voxel has neither material nor joint

  const Wholes* wholes = nullptr;  ///< none on coarser levels
  std::array<Real, 3> link{};      ///< joints of whole voxels along each axis, W/K
  /// A square of four whole voxels across each axis takes this off its four sides and gives it to its two
  /// diagonals, W/K.
  std::array<Real, 3> bend{};
  Real held = 0;    ///< capacity of a whole voxel in the system, W/K
  Real shared = 0;  ///< part of it in each whole neighbour instead, W/K
};

/// One level of a multigrid. Its cycle only shows the way to the solution, for which single precision does.
struct FlowLevel {
  Flow<float> flow;
  std::vector<float> inverse;  ///< of the diagonal, 0 where that is
  std::vector<float> right, x, way, rest;
};

/// The equations (scale capacity + flow) x = b of voxels in space, by conjugate gradients with one multigrid
/// cycle as preconditioner (docs/design/heat.md, step 6). Their parts are set on the finest level.
class FlowSystem {
 public:
  explicit FlowSystem(const std::array<std::size_t, 3>& count, unsigned threads);

  [[nodiscard]] Flow<double>& finest() noexcept { return finest_; }
  [[nodiscard]] const Flow<double>& finest() const noexcept { return finest_; }
  /// Says which voxels of the lattice are whole, by 1 and 0. \param links  joints of two of them along each
  /// axis, W/K \param capacity  of one, J/K
  void set_wholes(std::vector<float> voxels, const std::array<double, 3>& links,
                  const std::array<double, 3>& pitch, double capacity);
  /// Carries what the finest level has to the others.
  void coarsen();
  /// Sets the factor of the capacity, 1/s.
  void scale(double per_second);

  /// Gives whole neighbours their part of what comes into each voxel, as they have it of the capacity.
  [[nodiscard]] Numbers spread(const Numbers& heat) const;
  /// flow = what leaves each voxel by conduction and to the surroundings at temperatures t, W.
  void flow(const Numbers& t, Numbers& out) const;
  /// Solves from the x that is given; false where some hundred iterations do not bring what is left of b to
  /// `part` of it.
  [[nodiscard]] bool solve(const Numbers& b, Numbers& x, double part);
  [[nodiscard]] std::uint64_t work() const noexcept { return work_; }

 private:
  /// Calls write(place, value of the matrix times x).
  template <class Real, class Write>
  void product(const Flow<Real>& flow, const std::vector<Real>& x, const Write& write) const;
  template <class Real>
  void set_diagonal(Flow<Real>& flow, Real per_second) const;
  void residual(FlowLevel& level) const;
  /// Betters level.x for level.right; from zero where x is nothing yet.
  void smooth(FlowLevel& level, bool from_zero) const;
  void cycle(std::size_t n);
  template <class Real>
  [[nodiscard]] double dot(const Numbers& a, const std::vector<Real>& b) const;

  std::unique_ptr<Wholes> wholes_ = std::make_unique<Wholes>();
  double whole_capacity_ = 0;
  Flow<double> finest_;
  std::vector<FlowLevel> levels_;
  unsigned threads_;
  std::uint64_t work_ = 0;
};

}  // namespace lekalo::heat

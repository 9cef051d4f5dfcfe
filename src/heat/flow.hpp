#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lattice.hpp"

namespace lekalo::heat {

/// How much voxels hold and pass on.
template <class Real>
struct Flow {
  Lattice lattice;
  std::vector<Real> capacity;              ///< J/K
  std::vector<Real> loss;                  ///< W/K to the surroundings
  std::array<std::vector<Real>, 3> joint;  ///< W/K to the lower neighbour along each axis
  std::vector<Real> diagonal;              ///< of the system; 0 where a voxel has neither material nor joint
};

/// One level of a multigrid. Its cycle only shows the way to the solution, for which single precision does.
struct FlowLevel {
  Flow<float> flow;
  std::vector<float> inverse;  ///< of the diagonal, 0 where that is
  std::vector<float> right, x, way, rest;
};

/// The equations (scale capacity + flow) x = b of voxels in space, by conjugate gradients with one multigrid
/// cycle as preconditioner (docs/design/heat.md, step 5). Their parts are set on the finest level.
class FlowSystem {
 public:
  explicit FlowSystem(const std::array<std::size_t, 3>& count, unsigned threads);

  [[nodiscard]] Flow<double>& finest() noexcept { return finest_; }
  [[nodiscard]] const Flow<double>& finest() const noexcept { return finest_; }
  /// Carries what the finest level has to the others.
  void coarsen();
  /// Sets the factor of the capacity, 1/s.
  void scale(double per_second);

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

  Flow<double> finest_;
  std::vector<FlowLevel> levels_;
  unsigned threads_;
  std::uint64_t work_ = 0;
};

}  // namespace lekalo::heat

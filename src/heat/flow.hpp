#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "lattice.hpp"

namespace lekalo::heat {

/// One level of a multigrid: how much voxels hold and pass on.
struct FlowLevel {
  Lattice lattice;
  Numbers capacity;              ///< J/K
  Numbers loss;                  ///< W/K to the surroundings
  std::array<Numbers, 3> joint;  ///< W/K to the lower neighbour along each axis
  Numbers diagonal, inverse;     ///< of the system; 0 where a voxel has neither material nor joint
  Numbers right, x, way, rest;   ///< of the cycle
};

/// The equations (scale capacity + flow) x = b of voxels in space, by conjugate gradients with one multigrid
/// cycle as preconditioner (docs/design/heat.md, step 5). Their parts are set on the finest level.
class FlowSystem {
 public:
  explicit FlowSystem(const std::array<std::size_t, 3>& count, unsigned threads);

  [[nodiscard]] FlowLevel& finest() noexcept { return levels_.front(); }
  [[nodiscard]] const FlowLevel& finest() const noexcept { return levels_.front(); }
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
  template <class Write>
  void product(const FlowLevel& level, const Numbers& x, const Write& write) const;
  void residual(const FlowLevel& level, const Numbers& b, const Numbers& x, Numbers& out) const;
  /// Betters level.x for level.right; from zero where x is nothing yet.
  void smooth(FlowLevel& level, bool from_zero) const;
  void cycle(std::size_t n);
  [[nodiscard]] double dot(const Numbers& a, const Numbers& b) const;

  std::vector<FlowLevel> levels_;
  unsigned threads_;
  std::uint64_t work_ = 0;
};

}  // namespace lekalo::heat

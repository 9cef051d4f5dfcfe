#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "hexahedron.hpp"
#include "lattice.hpp"

namespace lekalo::heat {

/// A displacement or a force at corners of voxels, each component by itself.
template <class Real>
using FieldOf = std::array<std::vector<Real>, kComponents>;
using Field = FieldOf<double>;

/// Hexahedra that are as stiff as their share of material, on a lattice of nodes.
template <class Real>
struct Hexahedra {
  std::array<std::size_t, 3> elements{};
  Lattice nodes;
  std::array<std::array<Real, kUnknowns>, kUnknowns> stiffness{};
  /// A node between whole elements: forces on it by the displacements of its 27 neighbours.
  std::array<std::array<std::array<Real, kComponents>, kComponents>, 27> whole{};
  std::vector<Real> share;    ///< of each element, at its low corner
  std::vector<Real> inverse;  ///< 1 / sum of a node's shares; 0 where it is held or has none
};

/// One level of a multigrid. Its cycle only shows the way to the solution, for which single precision does:
/// it halves the time.
struct ElasticLevel {
  Hexahedra<float> hexahedra;
  std::array<double, kComponents> diagonal{};  ///< of a node with one whole element
  double most = 0;  ///< bound of the eigenvalues of the matrix scaled by its diagonal
  FieldOf<float> right, x, way, rest;
};

/// Forces by displacements at the corners of voxels, and the displacements that given forces bring about, by
/// conjugate gradients with one multigrid cycle as preconditioner (docs/design/heat.md, step 10).
class ElasticSystem {
 public:
  ElasticSystem(const std::array<std::size_t, 3>& elements, const std::array<double, 3>& pitch, double youngs,
                double poisson, const std::array<bool, 6>& held, unsigned threads);

  [[nodiscard]] Hexahedra<double>& finest() noexcept { return finest_; }
  [[nodiscard]] const Hexahedra<double>& finest() const noexcept { return finest_; }
  [[nodiscard]] const Hexahedron& element() const noexcept { return element_; }
  /// Carries the shares of the finest level to the others.
  void coarsen();
  /// Solves from the x that is given, whose held nodes are 0; false where some hundred iterations do not
  /// bring what is left of b to `part` of it.
  [[nodiscard]] bool solve(const Field& b, Field& x, double part);
  [[nodiscard]] std::uint64_t work() const noexcept { return work_; }

 private:
  template <class Real, class Write>
  void product(const Hexahedra<Real>& hexahedra, const FieldOf<Real>& x, const Write& write) const;
  void residual(const ElasticLevel& level, FieldOf<float>& out) const;
  void smooth(ElasticLevel& level, bool from_zero) const;
  void restrict_to(const ElasticLevel& level, ElasticLevel& coarse) const;
  void add_from(const ElasticLevel& coarse, ElasticLevel& level) const;
  void cycle(std::size_t n);
  void factor();
  void solve_coarsest(ElasticLevel& level) const;
  template <class A, class B>
  [[nodiscard]] double dot(const FieldOf<A>& a, const FieldOf<B>& b) const;
  template <class Act>
  void each_run(const Lattice& nodes, const Act& act) const;

  Hexahedron element_;  // of the finest level
  Hexahedra<double> finest_;
  std::vector<ElasticLevel> levels_;
  std::array<bool, 6> held_;
  unsigned threads_;
  std::vector<std::size_t> coarse_nodes_;  // of the coarsest level, those that have unknowns
  Numbers factor_;                         // of its matrix, row by row
  std::uint64_t work_ = 0;
};

}  // namespace lekalo::heat

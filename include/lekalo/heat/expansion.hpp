#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/heat/body.hpp"

namespace lekalo::heat {

struct Elastic {
  double youngs_mpa = 0;       ///< above 0
  double poisson = 0;          ///< from 0 to below 0.5
  double expansion_per_k = 0;  ///< of a length
};

/// How a workpiece is held. Sides of its box that are held do not move at all: one is a plate under it, two
/// that face each other are the jaws of a vice. One that no side holds is free: of its rigid motions the one
/// is taken out that fits its underside best, and then the shift of the datum, where one is stated.
struct Holding {
  std::array<bool, kSides> held{};
  std::optional<Place> datum;  ///< a place that does not move; of no effect where a side is held
};

/// Quasi-static thermoelastic displacement of a body's voxels: hexahedra with incompatible modes (Wilson; R.
/// Taylor, P. Beresford & E. Wilson, Int. J. Numer. Meth. Eng. 10, 1976), as stiff as their share of
/// material. docs/design/heat.md, steps 8 to 11. The same input gives the same bits for any number of
/// threads.
///
/// Cost: one system of three unknowns a corner, some 5 to 25 iterations of 0.7 microseconds a voxel; memory
/// 210 bytes a voxel.
class Expansion {
 public:
  Expansion(const Grid& grid, const Elastic& elastic, const Holding& holding,
            unsigned threads = kUsualThreads);
  ~Expansion();
  Expansion(Expansion&&) noexcept;
  Expansion& operator=(Expansion&&) noexcept;

  /// Takes the shape of a body. \pre it is settled and of the same grid
  void follow(const Body& body);
  /// Finds the displacement, beginning with the last one. ErrorCode::refuted where the forces that are left
  /// over are not below `part` of the load after some hundred iterations, which a body that hangs together by
  /// corners alone may bring about. \param temperature  of each voxel in the grid's order, K above that at
  /// which nothing is displaced
  [[nodiscard]] Result<void> solve(std::span<const double> temperature, double part = 1e-6);

  /// Displacement at a place in the material or beside it, mm; linear along each axis of a voxel.
  [[nodiscard]] Place moved(Place place) const;
  /// Stress by von Mises at the middle of each voxel, MPa, in the grid's order; 0 where less than half is
  /// material.
  [[nodiscard]] std::vector<double> mises() const;
  /// Unknowns times iterations so far.
  [[nodiscard]] std::uint64_t work() const noexcept;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace lekalo::heat

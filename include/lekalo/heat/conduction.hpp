#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/parallel.hpp"
#include "lekalo/heat/body.hpp"

namespace lekalo::heat {

struct Conductor {
  double conductivity = 0;   ///< W/(mm K), above 0
  double heat_capacity = 0;  ///< of a volume, J/(mm^3 K), above 0
};

/// A film that is no resistance: the surface has the temperature of the surroundings.
inline constexpr double kNoResistance = std::numeric_limits<double>::infinity();

/// How heat leaves through surfaces, W/(mm^2 K); 0: not at all. The surroundings are at 0 K: all temperatures
/// are differences from theirs.
struct Films {
  std::array<double, kSides> sides{};  ///< of the stock's box
  double cut = 0;                      ///< walls inside the box
};

/// Heat that goes into one voxel, W. It may be negative.
struct Source {
  std::size_t cell = 0;
  double watts = 0;
};

/// All heat since the beginning, J. in = stored + lost + removed, but for rounding and what the equations are
/// left unsolved by, which balance() says.
struct HeatBook {
  double in = 0;       ///< brought by sources, and by the temperatures at the beginning
  double lost = 0;     ///< through surfaces
  double removed = 0;  ///< gone with material that was cut away
  double stored = 0;   ///< in the workpiece now

  /// Returns the heat that is not accounted for, as a part of all that was moved; 0 where nothing was.
  [[nodiscard]] double balance() const noexcept;
};

/// Transient conduction in a body's voxels (finite volumes with open shares of faces, second order in time,
/// docs/design/heat.md, steps 3 to 6). The same input gives the same bits for any number of threads.
///
/// Cost of a step: two systems of one unknown a voxel, each some 7 iterations of 50 ns a voxel. Memory:
/// 200 bytes a voxel.
class Conduction {
 public:
  /// \pre body is settled
  Conduction(const Body& body, const Conductor& conductor, const Films& films,
             unsigned threads = kUsualThreads);
  ~Conduction();
  Conduction(Conduction&&) noexcept;
  Conduction& operator=(Conduction&&) noexcept;

  /// Sets the temperature of each voxel, K, in the grid's order; those without material have none. The book
  /// has the difference of heat as brought in.
  void set(std::span<const double> temperature);
  /// Takes the shape that the body has now. Heat of material that is gone is booked as removed.
  /// \param changed  what Body::settle gave
  void follow(const Body& body, std::span<const Changed> changed);
  void surround(const Body& body, const Films& films);

  /// Goes on by some seconds, during which the sources are constant. ErrorCode::refuted where the equations
  /// are not solved to 1e-7 of what moves them, which no input is known to bring about. \pre seconds > 0;
  /// sources lie in material
  [[nodiscard]] Result<void> step(double seconds, std::span<const Source> sources);

  /// Temperature of each voxel, K, in the grid's order; 0 in those without material.
  [[nodiscard]] std::vector<double> temperatures() const;
  [[nodiscard]] double temperature(std::size_t cell) const;
  [[nodiscard]] const HeatBook& book() const noexcept;
  /// Unknowns times iterations so far.
  [[nodiscard]] std::uint64_t work() const noexcept;

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace lekalo::heat

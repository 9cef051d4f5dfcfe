#include "lekalo/fit/assembly.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace lekalo::fit {
namespace {

constexpr double kMostMm = 10000;
/// Beyond these the mesh of quadrilaterals would need more nodes than a run of seconds has.
constexpr double kThinnestWall = 0.01, kLongestInWalls = 100;

Result<void> refuse(std::size_t ring, const std::string& why) {
  return failure(ErrorCode::bad_input, fmt::format("{}: {}", ring_name(ring), why));
}

Result<void> check_material(std::size_t ring, const Material& m) {
  if (!(m.youngs_mpa >= 1 && m.youngs_mpa <= 1e7))
    return refuse(ring, fmt::format("Young's modulus is {} MPa; it has to be from 1 to 1e7", m.youngs_mpa));
  if (!(m.poisson >= 0 && m.poisson <= 0.49))
    return refuse(ring, fmt::format("Poisson's ratio is {}; it has to be from 0 to 0.49", m.poisson));
  if (!(m.yield_mpa >= 0 && m.yield_mpa <= m.youngs_mpa / 10))
    return refuse(ring, fmt::format("the yield stress is {} MPa; it has to be from 0 to a tenth of Young's "
                                    "modulus",
                                    m.yield_mpa));
  if (!(m.hardening_mpa >= 0 && m.hardening_mpa <= m.youngs_mpa))
    return refuse(
        ring, fmt::format("hardening is {} MPa; it has to be from 0 to Young's modulus", m.hardening_mpa));
  return {};
}

Result<void> check_ring(std::size_t index, const Ring& ring) {
  if (!(ring.outer_diameter > 0 && ring.outer_diameter <= kMostMm))
    return refuse(index, fmt::format("its outer diameter is {} mm; it has to be above 0 and at most {}",
                                     ring.outer_diameter, kMostMm));
  if (!(ring.length > 0 && ring.length <= kMostMm))
    return refuse(
        index, fmt::format("its length is {} mm; it has to be above 0 and at most {}", ring.length, kMostMm));
  if (!(ring.inner_diameter >= 0 && ring.inner_diameter < ring.outer_diameter))
    return refuse(index, fmt::format("its inner diameter is {} mm, not below its outer diameter of {} mm",
                                     ring.inner_diameter, ring.outer_diameter));
  const double wall = (ring.outer_diameter - ring.inner_diameter) / 2;
  if (!(wall >= kThinnestWall * ring.outer_diameter))
    return refuse(index, fmt::format("its wall is {:.6g} mm, thinner than a hundredth of its diameter of {} "
                                     "mm, which is a shell and not modelled",
                                     wall, ring.outer_diameter));
  if (!(ring.length <= kLongestInWalls * wall))
    return refuse(index, fmt::format("its length is {} mm, more than {} times its wall of {:.6g} mm; give "
                                     "the part of it that is near the seat",
                                     ring.length, kLongestInWalls, wall));
  return check_material(index, ring.material);
}

}  // namespace

bool Assembly::symmetric() const {
  return std::all_of(rings.begin(), rings.end(), [](const Ring& ring) { return ring.middle == 0; });
}

std::string ring_name(std::size_t ring) {
  return ring == 0 ? "the shaft" : ring == 1 ? "the hub" : fmt::format("ring {}", ring);
}

Result<void> check_assembly(const Assembly& assembly) {
  const std::vector<Ring>& rings = assembly.rings;
  if (rings.size() < 2 || rings.size() > 6)
    return failure(
        ErrorCode::bad_input,
        fmt::format("a fit needs a shaft, a hub and at most four more rings, not {} parts", rings.size()));
  for (std::size_t i = 0; i < rings.size(); ++i) {
    LEKALO_CHECK(check_ring(i, rings[i]));
    if (i > 0 && rings[i].inner_diameter != rings[i - 1].outer_diameter)
      return refuse(i, fmt::format("its inner diameter is {} mm, and what it sits on has {} mm",
                                   rings[i].inner_diameter, rings[i - 1].outer_diameter));
    if (i > 0 && rings[i].middle != 0) return refuse(i, "its middle is not at z = 0");
    const double over = rings[i].length / 2 + std::abs(rings[0].middle) - rings[0].length / 2;
    if (i > 0 && rings[0].middle != 0 && !(over <= 1e-9 * rings[0].length))
      return refuse(i, fmt::format("it hangs over the end of the shaft by {:.6g} mm", over));
  }
  return {};
}

}  // namespace lekalo::fit

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/solid/mesh.hpp"

namespace lekalo::locate {

/// The guaranteed blank in space: how far inside a scanner's mesh everything is material. The mesh is not
/// changed; each triangle i of it gets a width w_i, and
///   every q inside the mesh whose distance from each triangle i is above w_i, is material,
/// where, with g the guard and rho the radius of the smallest circle around the triangle,
///   w_i = g + H                             air inside the mesh through the true points lies within H of it
///   w_i = R - sqrt((R - g)^2 - rho^2)       a ball of radius R comes from outside to every place of the
///                                           surface, and no void is closed; rho < R - g
/// docs/design/scan.md has the proofs, and says what breaks them.

/// A statement about the side that no scanner sees: the mesh within `flat` of a level bounds something solid.
/// Each of its points there lies within `flat` of material, and air inside the mesh no farther from there.
struct SolidUnderside {
  double z = 0;     ///< mm, of the blank's frame
  double flat = 0;  ///< mm, > 0
};

struct SolidScan {
  /// No vertex of the mesh is farther than this from a true point of the surface, mm, >= 0.
  double guard = 0;
  std::optional<double> min_radius;  ///< R, mm, > guard
  std::optional<double> max_dip;     ///< H, mm, >= 0
  std::optional<SolidUnderside> underside;
  /// Every coordinate of the mesh may differ from that of the file by up to this, mm.
  double coordinate_error = 0;
};

struct GuaranteedSolid {
  /// One for each triangle, mm, rounded up. Unknown ones have those of a measured place, so that a pose can
  /// be looked for; nothing is proved with them.
  std::vector<double> widths;
  double widest = 0;  ///< mm
  /// No width is above the exact one by more than this, mm, whatever the coordinates may be off.
  double width_error = 0;
  /// Triangles that no assumption covers.
  std::vector<std::uint32_t> unknown;
  double unknown_area = 0;  ///< mm2
  /// Sentences. The claim is true if all of these are.
  std::vector<std::string> assumptions;
  [[nodiscard]] bool proved() const noexcept { return unknown.empty(); }
};

/// Makes the widths. With R and H the one whose widest triangle is narrower counts, for all triangles: the
/// claims do not hold mixed. Fails with ErrorCode::usage for numbers out of range, and without R and H.
/// \param mesh  closed (solid::closed_mesh). Cost: O(n).
[[nodiscard]] Result<GuaranteedSolid> guaranteed_solid(const solid::Mesh& mesh, const SolidScan& scan);

}  // namespace lekalo::locate

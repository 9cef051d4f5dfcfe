#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "lekalo/locate/solid.hpp"
#include "lekalo/solid/mesh_clearance.hpp"

namespace lekalo::locate {

/// A point of the part that was looked at, and where the blank's surface is nearest to it.
struct FarPoint {
  solid::Vector part, placed;  ///< in the part's frame, and as placed
  solid::Vector blank;         ///< the nearest point of the blank's surface
  double far = 0;              ///< mm
  std::uint32_t triangle = 0;  ///< of the part, which has the point
  std::uint32_t surface = 0;   ///< the blank's triangle
};

/// How far the farthest point of some triangles is from the blank's surface: at least `low` and at most
/// `high`.
struct Farthest {
  double low = 0, high = 0;
  std::vector<FarPoint> points;  ///< those that were looked at
};

/// Measures a SolidNear. Distances do not count the widths of the blank's triangles.
class NearFace {
 public:
  NearFace(const SolidNear& demand, const solid::Mesh& part);

  [[nodiscard]] const SolidNear& demand() const noexcept { return demand_; }

  /// Cuts the triangles until it is known that no point is farther than `enough`, or how far the farthest is
  /// within the slack, or `most_looked` points were looked at.
  [[nodiscard]] Farthest at(const solid::TriangleTree& blank, const solid::Motion& motion, double enough,
                            std::size_t most_looked) const;

  /// Looks at one point of it.
  [[nodiscard]] static FarPoint point_at(const solid::TriangleTree& blank, const solid::Motion& motion,
                                         solid::Vector part, std::uint32_t triangle);

 private:
  const SolidNear& demand_;
  std::vector<solid::Vector> corners_;
  std::vector<std::uint32_t> of_corner_;  ///< a triangle that has it
  std::vector<solid::Triangle> triangles_;
};

/// The six sides of a body: what is in it has n . q above `least`, for each.
struct BodySide {
  solid::Vector normal;  ///< of length 1
  double least = 0;
};
[[nodiscard]] std::vector<BodySide> sides_of(const SolidBody& body);

/// A body about the place q, or beside it, that stays `apart` away from the blank's surface and reaches far:
/// it stands on the plane of points which are so far away from the surface near q. None where there is no
/// room. \param error  so much farther off it stays, mm
[[nodiscard]] std::optional<SolidBody> body_beside(const solid::MeshClearance& clearance,
                                                   const std::vector<solid::Vector>& blank_points,
                                                   const FarPoint& point, double apart, double error,
                                                   double scale);

}  // namespace lekalo::locate

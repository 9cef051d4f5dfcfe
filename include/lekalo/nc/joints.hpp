#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "lekalo/geom/region.hpp"

namespace lekalo::nc {

/// Micro-joints: short stretches of an outline that are not cut, so that a part stays in the sheet
/// (docs/design/micro-joints.md). A router leaves tabs: there it cuts less deep.

enum class JointRule : std::uint8_t {
  none,
  count,   ///< every part has the same number
  tipping  ///< parts that would tip on the slats of the table have as many as they need
};

/// The bars on which a sheet lies.
struct Slats {
  double pitch_mm = 0;   ///< from one to the next, 1 to 1000
  bool along_x = false;  ///< they run along X; else along Y
};

struct JointOptions {
  JointRule rule = JointRule::none;
  std::size_t count = 0;  ///< of JointRule::count, 1 to 20
  /// Only parts up to this size have joints by the rule: the largest distance of two of their points, 0.1 to
  /// 10000; 0 for all parts.
  double up_to_mm = 0;
  /// The material between two ends of the kerf, where it is narrowest, 0.05 to 50.
  double width_mm = 0;
  Slats slats;  ///< of JointRule::tipping
  /// Routers alone: the height of tabs above the lower face, 0.01 up to less than the depth.
  double tab_height_mm = 0;
  /// Placements that have another number of joints than the rule says, 0 to 20 of them each, by id.
  std::vector<std::pair<std::uint64_t, std::size_t>> of;

  [[nodiscard]] bool wanted() const noexcept { return rule != JointRule::none || !of.empty(); }
};

/// Says whether a part that lies loose on slats tips, wherever the first of them is. It tips where its centre
/// of mass does not lie in the convex hull of its supports by kTippingMargin: of the part above every slat,
/// which is a line without width, and of the joints that hold it.
///
/// Never says no where it tips for some place of the slats. It may say yes though it tips for none, where its
/// centre of mass comes within 2 kTippingMargin of the edge of the hull. Arcs are chords in the material or
/// beside it, within 0.01 mm.
/// \param joints  points of the part that are held, up and down
/// Cost: O(n log n) of its edges, and edges times the places of slats that are looked at, up to 4096.
/// Source: statics; a rigid body on a plane stands when its weight acts within its supports.
inline constexpr double kTippingMargin = 0.05;  // mm
[[nodiscard]] bool tips(const geom::Region& part, const Slats& slats,
                        const std::vector<geom::Point>& joints = {});

/// Returns the centre of mass of a region, holes left out, by chords within 0.01 mm of its arcs.
[[nodiscard]] geom::Point centre_of_mass(const geom::Region& part);

/// Returns the largest distance of two points of a region, by the same chords.
[[nodiscard]] double size_of(const geom::Region& part);

}  // namespace lekalo::nc

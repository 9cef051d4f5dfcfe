#pragma once

#include <array>
#include <vector>

#include "even_placement.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/phi/region.hpp"

namespace lekalo::locate {

/// A criterion (lekalo/locate/criterion.hpp) asks the search here, and says here what it has chosen. At first
/// the placement with the largest margin found is chosen, and there is one that meets the demands.
///
/// A criterion goes on from one allowed placement to the next, so that no stage loses more than is stated of
/// what was best before it. The checker holds every result against that, whether it knows the criterion or
/// not.
class Choice {
 public:
  struct Pose {
    Placement at;  ///< its clearance is not set
    bool mirrored = false;
    [[nodiscard]] geom::BlankFromPart map() const {
      return geom::BlankFromPart::from_angle(at.theta, {at.x, at.y}, mirrored);
    }
  };
  Choice() = default;
  Choice(const Choice&) = delete;
  Choice& operator=(const Choice&) = delete;
  virtual ~Choice() = default;

  [[nodiscard]] virtual const Pose& pose() const = 0;

  /// The part there, mirrored as it is: within the window and where it is locked, with a margin of at least
  /// the largest found less what may be given up (which keeps the maxima), and after take_smallest_largest()
  /// with no allowance above SmallestLargest::kept.
  [[nodiscard]] virtual bool allows(const Placement& at) const = 0;

  /// Chooses the placement if it is allowed; returns whether it was.
  virtual bool take(const Placement& at) = 0;

  /// Chooses the placement with the smallest largest allowance, with a bound that is proved: step 5 of
  /// docs/design/locate-demands.md. The result then says what was found.
  virtual Result<void> take_smallest_largest() = 0;

  /// The outlines as they measure each other.
  [[nodiscard]] virtual const phi::RegionClearance& clearance() const = 0;
  /// Points of the edges that are not finished, with the allowances that they aim at.
  [[nodiscard]] virtual EvenSamples samples() const = 0;

  // For searches that make steps of their own: how far an allowed placement can be from the chosen one.
  /// How much of the clearance may be given up from here on, mm.
  [[nodiscard]] virtual double spare() const = 0;
  /// How deep edges may lie in the blank.
  [[nodiscard]] virtual std::vector<LocalCap> caps() const = 0;
  /// x, y, angle: what may change.
  [[nodiscard]] virtual std::array<bool, 3> free() const = 0;
  [[nodiscard]] virtual AngleWindow window() const = 0;
};

}  // namespace lekalo::locate

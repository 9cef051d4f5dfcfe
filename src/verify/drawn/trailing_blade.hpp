#pragma once

#include <vector>

#include "verify/pocket/stroke.hpp"

namespace lekalo::verify {

/// A blade that turns freely about an axis and touches the material `offset` behind it. The tip moves along
/// the blade alone, so that with phi, the angle from the motion of the axis to the blade, tan(phi / 2)
/// shrinks by a factor e over each `offset` of a straight way. While the blade is lifted it keeps its
/// direction.
class TrailingBlade {
 public:
  /// The blade begins with its axis in front of the tip, towards +x.
  /// \param within  how far the tip may be from the lines that draw() gives
  TrailingBlade(double offset, double within);

  /// Adds the lines that the tip draws while the axis goes straight from one place to another with the blade
  /// down. Returns false where the axis pushes the blade backwards by more than half an offset and more
  /// than a unit of rounding, so that nobody knows how it turns.
  [[nodiscard]] bool draw(Place from, Place to, std::vector<Stroke>& lines);

 private:
  [[nodiscard]] Place tip(Place axis) const { return axis - offset_ * forward_; }

  double offset_, within_, step_;
  Place forward_{1, 0};
};

}  // namespace lekalo::verify

#pragma once

#include <vector>

#include "stroke.hpp"

namespace lekalo::verify {

/// Which part of the tool's rim lies where the tool has already been: angle intervals of a circle.
class RimCover {
 public:
  /// \param at  middle of the tool, \param radius  its radius, mm
  void begin(Place at, double radius);
  /// What the tool swept along a stroke is gone.
  void add(const Stroke& stroke);
  /// The tool came here along this stroke, which ends here: the trailing half is gone, and what else it
  /// swept.
  void add_own(const Stroke& stroke);
  /// Angle of the rim that still meets material, radians. Rounding: 1e-7 for tools of some mm.
  [[nodiscard]] double open_angle();

 private:
  void add_circle_cuts(Place centre, double circle_radius);
  void add_line_cuts(Place through, Place direction, double offset);
  void cover_between_cuts(const Stroke& stroke, const Place* trailing_heading);

  struct Stretch {
    double begin, end;  // diamond angles, 0 to 4
  };
  Place at_;
  double radius_ = 0;
  std::vector<double> cuts_;
  std::vector<Stretch> covered_;
};

}  // namespace lekalo::verify

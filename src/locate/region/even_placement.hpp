#pragma once

#include <array>
#include <functional>
#include <optional>
#include <vector>

#include "lekalo/geom/pose.hpp"
#include "lekalo/locate/region.hpp"
#include "lekalo/phi/region.hpp"
#include "pose_search.hpp"

namespace lekalo::locate {

/// Points of edges at equal steps, each with the stretch that it stands for, and the allowances that they
/// should have.
struct EvenSamples {
  struct Sample {
    geom::Point at;  ///< part coordinates
    double length = 0, target = 0;
    bool has_target = false;
  };
  std::vector<Sample> samples;

  /// \param step  the largest distance between samples, mm
  void add(const geom::Edge& edge, double step, const std::optional<double>& target);
};

struct EvenPose {
  Placement at;  ///< its clearance is not set
  double deviation =
      0;  ///< root of the mean square of allowance - target; samples without one aim at the mean
};

/// Returns the deviation at a pose.
[[nodiscard]] double deviation_at(const EvenSamples& samples, const phi::RegionClearance& clearance,
                                  const geom::BlankFromPart& pose);

/// Lowers the deviation from a pose on by Gauss-Newton steps that keep `allowed` true. The result is a local
/// minimum, and nothing is proved about others. Steps are limited by the part's contacts, so that they slide
/// along what holds it.
/// \param caps     how deep edges may lie, part coordinates; steps aim to keep to that, and `allowed` decides
/// \param give_up  how much of the clearance at the start may be lost, mm; likewise
/// \param free     x, y, angle: what may change
[[nodiscard]] EvenPose most_even(const EvenSamples& samples, const phi::RegionClearance& clearance,
                                 const std::vector<LocalCap>& caps, const Placement& start, bool mirrored,
                                 double give_up, const std::array<bool, 3>& free, const AngleWindow& window,
                                 const std::function<bool(const Placement&)>& allowed);

}  // namespace lekalo::locate

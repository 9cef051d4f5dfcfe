#pragma once

#include <optional>
#include <vector>

#include "lekalo/heat/body.hpp"
#include "lekalo/jobs/heat.hpp"

namespace lekalo::jobs {

/// Measured temperatures say how much heat goes into a workpiece: step 12 of docs/design/heat-walls.md.

/// bad_input with one sentence where a measurement is outside of the stock or of the program, or in the air.
[[nodiscard]] Result<void> check_measured(const HeatJob& job, const HeatSource& source);
/// The same where the place that does not move is outside of the stock, or cut away by the program.
[[nodiscard]] Result<void> check_datum(const HeatJob& job, const HeatSource& source);

/// Follows the temperatures at measured places, step by step.
class MeasuredRises {
 public:
  explicit MeasuredRises(const std::vector<MeasuredTemperature>& measured)
      : measured_(measured), before_(measured.size()), found_(measured.size()) {}

  /// \param temperatures  of each voxel at the end of a step, K
  void take(const heat::Body& body, const std::vector<double>& temperatures, double begin, double end);
  /// The temperature of each place when it was measured, K.
  [[nodiscard]] const std::vector<double>& found() const { return found_; }

 private:
  const std::vector<MeasuredTemperature>& measured_;
  std::vector<double> before_, found_;
};

struct MeasuredHeat {
  heat::Interval heat_j;                    ///< into the workpiece
  heat::Interval share;                     ///< what is left of it
  double middle_share = 0;                  ///< the part of the middle work that is the middle heat
  std::vector<heat::Interval> supported_j;  ///< by each measurement
};

/// Returns the heat that what is stated and all measurements support. bad_input where there is none, and
/// where a measurement says nothing. \param rises  of each case, at each measured place, with all of the work
/// as heat
[[nodiscard]] Result<MeasuredHeat> measured_heat(const HeatJob& job, const heat::CuttingWork& work,
                                                 const std::vector<std::vector<double>>& rises);

}  // namespace lekalo::jobs

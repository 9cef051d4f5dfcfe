#pragma once

#include <cstdint>
#include <optional>

#include "solid_meter.hpp"

namespace lekalo::locate {

/// Measures as the meter does, and returns nothing where the flag of `run` is set meanwhile.
[[nodiscard]] std::optional<MeasuredSolid> measured_unless_stopped(const SolidMeter& meter,
                                                                   const FramedPose& pose, double most,
                                                                   std::size_t count, const RunControl& run,
                                                                   std::vector<SolidContact>& contacts);

/// The same of a glance.
[[nodiscard]] std::optional<double> glanced_unless_stopped(const SolidMeter& meter, const FramedPose& pose,
                                                           double most, std::size_t count,
                                                           const RunControl& run,
                                                           std::vector<SolidContact>& contacts);

/// Climbs from a pose until no step makes it better by `enough`: the linear program of the contacts, without
/// remainders, is solved in a box of steps up to `widest` mm, which shrinks where that does not help. What a
/// step meets is kept, so that the next program knows of it. Adds to `work`, and tells `run` how many of the
/// steps that may be are done. A stop leaves the best so far.
[[nodiscard]] MeasuredSolid climb(const SolidMeter& meter, const FramedPose& from, double widest,
                                  double enough, const RunControl& run, std::uint64_t& work);

/// The contacts that hold the part at a pose, with multipliers that balance and sum to 1.
[[nodiscard]] std::vector<SolidTouch> holding_contacts(const SolidMeter& meter, const MeasuredSolid& at,
                                                       double within);

}  // namespace lekalo::locate

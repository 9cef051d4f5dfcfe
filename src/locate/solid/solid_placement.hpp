#pragma once

#include "lekalo/base/error.hpp"
#include "solid_meter.hpp"

namespace lekalo::locate {

// Every method for solids begins and ends with these.

/// Refuses meshes without triangles, windows and numbers that make no sense.
[[nodiscard]] Result<void> check(const SolidProblem& problem, const SolidOptions& options);

[[nodiscard]] SolidFrame frame_of(const SolidProblem& problem);

/// A pose as the search counts it, which may be outside of the window.
[[nodiscard]] FramedPose framed(const SolidFrame& frame, const SolidPose& pose);

/// The pose in its own doubles, and what it has there.
[[nodiscard]] SolidPlacement placement(const SolidMeter& meter, const FramedPose& found);

}  // namespace lekalo::locate

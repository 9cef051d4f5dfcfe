#pragma once

#include "document.hpp"

namespace lekalo::verify {

/// Rechecks a result of `lekalo locate` that boxes of poses prove (docs/formats.md): clearance, contacts and
/// certificates, for the regions written in it.
[[nodiscard]] Result<LocateReport> check_poses(const LocateInputs& inputs, Json written);

}  // namespace lekalo::verify

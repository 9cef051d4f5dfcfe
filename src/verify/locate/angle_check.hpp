#pragma once

#include "document.hpp"

namespace lekalo::verify {

/// Rechecks a result of `lekalo locate` that intervals of the angle prove (docs/formats.md), against the points
/// in its files: clearances, contacts, and the certificate if there is one.
[[nodiscard]] Result<LocateReport> check_angles(const LocateInputs& inputs, Json written);

}  // namespace lekalo::verify

#pragma once

#include "document.hpp"

namespace lekalo::verify {

/// The answer says whether the document is the result of a localisation of regions, which says what shapes it
/// used.
[[nodiscard]] bool has_regions(Json result);

/// Rechecks a result of `lekalo locate` for regions (docs/formats.md): clearance, contacts and certificate,
/// for the regions written in it.
[[nodiscard]] Result<LocateReport> check_regions(const LocateInputs& inputs, Json result);

}  // namespace lekalo::verify

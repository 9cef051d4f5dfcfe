#pragma once

#include "lekalo/base/error.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

/// `lekalo export`: a layout, or a job of another program, in another form.
[[nodiscard]] Result<int> run_export(const ExportOptions& options);

}  // namespace lekalo::cli

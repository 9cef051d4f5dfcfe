#pragma once

#include <string>
#include <vector>

#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::io {

/// Pieces of a layout as JSON on one line, for reports and for those who follow a layout as it changes.

/// The placement exactly as write_layout writes it. Cost: O(1). \pre part and stock are the document's
[[nodiscard]] std::string placement_json(const layout::Document& document,
                                         const layout::Placement& placement);

/// A list of violations as `lekalo check --json` has it: docs/formats.md. Cost: O(violations).
[[nodiscard]] std::string violations_json(const layout::Document& document,
                                          const std::vector<layout::Violation>& violations);

/// What is placed and what is missing, as `lekalo show --json` has it: docs/cli.md. Cost: O(parts, kits and
/// sheets).
[[nodiscard]] std::string completeness_json(const layout::Document& document,
                                            const layout::Completeness& completeness);

}  // namespace lekalo::io

#pragma once

#include <string>
#include <vector>

#include "lekalo/base/counted.hpp"
#include "lekalo/base/error.hpp"
#include "lekalo/io/formats/layer_rules.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "options/options.hpp"
#include "outputs.hpp"

namespace lekalo::cli {

/// Reads any file that holds a layout or a job (jobs::open_layout), after a look at the outputs
/// (check_outputs), which may replace neither it nor `others`.
[[nodiscard]] Result<jobs::Layout> read_layout_input(const LayoutSource& source,
                                                     const std::vector<NamedPath>& outputs,
                                                     std::vector<NamedPath> others = {});

/// Reads the table of layers that --layer-rules names; an empty one where the path is empty.
[[nodiscard]] Result<io::LayerRules> layer_rules_of(const std::string& path);

/// "note: ..." lines.
[[nodiscard]] std::string notes(const std::vector<std::string>& notices);

/// The bytes of --picture, in the form that its ending says. \param name  for documents without one
[[nodiscard]] Result<std::string> picture_bytes(const std::string& path, const std::string& name,
                                                const layout::Document& document,
                                                const std::vector<layout::Violation>& violations);

/// Lines for people: sheets, parts, kits.
[[nodiscard]] std::string completeness_text(const layout::Document& document,
                                            const layout::Completeness& completeness);

}  // namespace lekalo::cli

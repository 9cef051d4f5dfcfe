#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/jobs/file.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/document.hpp"

namespace lekalo::jobs {

struct Edited {
  layout::Document document;
  std::string bytes;  ///< the document as "lekalo-layout/1"
  /// The rules that the document breaks, as the engine finds them. Commands in mode free, and a layout that
  /// was given, may break some.
  std::vector<layout::Violation> violations;
  std::vector<std::string> notices;  ///< the kits that lost parts
};

/// Carries out a log of commands (layout/command.hpp, docs/design/layout-commands.md) on a layout.
///
/// \param commands  a line each, the first one "lekalo-commands/1"
///
/// Fails with a sentence that names the file and line of the log: ErrorCode::bad_input where it cannot be
/// read, and as layout::plan does where a command is refused. Then nothing was carried out.
[[nodiscard]] Result<Edited> edit(layout::Document document, const File& commands);

}  // namespace lekalo::jobs

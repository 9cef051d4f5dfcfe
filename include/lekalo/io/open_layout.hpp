#pragma once

#include <string>
#include <string_view>

#include "lekalo/base/error.hpp"
#include "lekalo/io/layout_json.hpp"
#include "lekalo/io/part_file.hpp"

namespace lekalo::io {

struct OpenOptions {
  /// The file of the items that a file of placements places. Empty: where that file says, looked for beside
  /// it, then in the folder above, then under its last name beside it.
  std::string instance;
  PartOptions parts;  ///< its unit counts for jobs of other programs too
};

/// Reads whatever holds a layout or a part of one, told apart by what is in the file, not by its name: a
/// layout (layout_json.hpp), jobs and placements of other nesting programs (nesting_files.hpp), drawings,
/// regions and trees of primitives (part_file.hpp), which give a document of parts, and of sheets where an export of
/// lekalo has them.
///
/// Fails as the readers of these do, and with ErrorCode::bad_input for what is none of them, with the list of
/// what is known.
[[nodiscard]] Result<LayoutFile> open_layout(const std::string& path, const OpenOptions& options = {});

/// The same of bytes that came without a file, called `name` in sentences. Opens no file: placements, whose
/// items are in another one, are refused.
[[nodiscard]] Result<LayoutFile> read_any_layout(std::string_view bytes, const std::string& name,
                                                 const PartOptions& parts = {});

}  // namespace lekalo::io

#pragma once

#include <optional>
#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::verify {

/// The file of the lines of a work offset that a result for solids names (docs/formats.md, `offset`).
struct OffsetFile {
  std::string path, sha256;
};

/// Returns it, or nothing where the result has none. bad_input where it is not of the form of
/// docs/formats.md.
[[nodiscard]] Result<std::optional<OffsetFile>> offset_file(const Document& result);

/// Reads the lines by the manual of their control (docs/design/nc-offset.md), and says why they do not make
/// the pose of the result: its shift to the last digit, its rotation within 4e-14. \pre the result has a file
[[nodiscard]] Result<std::optional<std::string>> fault_of_offset(const Document& result,
                                                                 const Document& lines);

}  // namespace lekalo::verify

#pragma once

#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/io/formats/any_layout.hpp"

namespace lekalo::disk {

struct OpenOptions {
  /// The file of the items that a file of placements places. Empty: where that file says, looked for beside
  /// it, then in the folder above, then under its last name beside it.
  std::string instance;
  /// The unit of these counts for jobs of other programs too.
  io::PartOptions parts;
};

/// Finds the items of the placements in the file `path` on the disk: in `instance`, or, where that is empty,
/// as OpenOptions says.
[[nodiscard]] io::FindItems items_near(std::string path, std::string instance);

/// io::read_any_layout of a file; the items of a file of placements are read from the disk too.
[[nodiscard]] Result<io::AnyLayout> open_layout(const std::string& path, const OpenOptions& options = {});

}  // namespace lekalo::disk

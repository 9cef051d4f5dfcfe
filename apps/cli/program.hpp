#pragma once

#include <string>

#include "lekalo/base/error.hpp"
#include "lekalo/io/locate/result_json.hpp"
#include "options/options.hpp"

namespace lekalo::cli {

struct RewrittenProgram {
  std::string text;
  bool withheld = false;
};

/// Rewrites the NC program for the document's placement and records it there (`nc`), unless the placement
/// misses the allowance, with or without the rounding of the program; then a warning says why there is none.
[[nodiscard]] Result<RewrittenProgram> rewrite_for(const LocateOptions& options, const std::string& nc_bytes,
                                                   io::LocateDocument& document);

}  // namespace lekalo::cli

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::cli {

/// A path and the option that named it, for messages.
struct NamedPath {
  const char* option;
  std::string path;
};

/// Looks at the paths before any work is done: ErrorCode::usage when an output would replace an input or two
/// outputs are the same file (also through links), ErrorCode::environment when an output is a folder or a
/// device or its folder does not exist. Entries with an empty path are skipped.
[[nodiscard]] Result<void> check_outputs(const std::vector<NamedPath>& outputs,
                                         const std::vector<NamedPath>& inputs);

/// The path of one of several sheets, which are counted from 0: "cut.nc" becomes "cut-2.nc" for the second. A
/// sheet alone has the path itself.
[[nodiscard]] std::string path_of_sheet(const std::string& path, std::size_t sheet, std::size_t sheets);

/// Writes all of `text` to stdout and flushes; ErrorCode::environment when that fails.
[[nodiscard]] Result<void> print(std::string_view text);

/// `text` as the file `path`, complete or not at all; to stdout where the path is empty.
[[nodiscard]] Result<void> deliver(const std::string& path, std::string_view text);

/// One message on stderr, on one line whatever control characters a file name brings.
void complain(std::string_view message);

}  // namespace lekalo::cli

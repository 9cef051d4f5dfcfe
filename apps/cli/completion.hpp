#pragma once

#include <CLI/App.hpp>
#include <string>

#include "lekalo/base/error.hpp"

namespace lekalo::cli {

/// The completion script of a command tree for `bash`, `zsh` or `fish`; ErrorCode::usage for another shell.
[[nodiscard]] Result<std::string> completion_script(const CLI::App& app, const std::string& shell);

}  // namespace lekalo::cli

#pragma once

#include <string>
#include <vector>

#include "lekalo/base/error.hpp"
#include "options/form.hpp"

namespace lekalo::cli {

/// The completion script of these commands for `bash`, `zsh` or `fish`; ErrorCode::usage for another shell.
[[nodiscard]] Result<std::string> completion_script(const std::vector<Form>& forms, const std::string& shell);

}  // namespace lekalo::cli

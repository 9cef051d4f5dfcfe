#pragma once

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "form.hpp"
#include "lekalo/base/error.hpp"

namespace lekalo::cli {

/// A command line asks for the command of the form with this index, or for a text for stdout, which is the
/// help or the version.
using Asked = std::variant<std::size_t, std::string>;

/// Fills in the form of the command that is asked for. ErrorCode::usage with one sentence, and the way out,
/// for a command line that does not fit the forms. \param argv  as given to main.
[[nodiscard]] Result<Asked> read_command_line(const std::vector<Form>& forms, int argc,
                                              const char* const* argv);

}  // namespace lekalo::cli

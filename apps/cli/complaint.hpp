#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace lekalo::cli {

/// One sentence for a command line that does not parse, with the way out: CLI11's own do not know our words.
/// \param argv  as given to main.
[[nodiscard]] std::string complaint(const CLI::App& app, const CLI::ParseError& error, int argc,
                                    const char* const* argv);

/// For unknown words: the nearest of `known` when it is near enough to be meant, else empty.
[[nodiscard]] std::string nearest_word(const std::string& word, const std::vector<std::string>& known);

}  // namespace lekalo::cli

#pragma once

#include <CLI/App.hpp>
#include <functional>

#include "options.hpp"

namespace lekalo::cli {

/// Gives the options that were typed for one command; to be called after the command line is parsed.
using Typed = std::function<Result<Command>()>;

/// Each adds the options of its command, with help and footer, to `app`.
[[nodiscard]] Typed add_locate_form(CLI::App& app);
[[nodiscard]] Typed add_verify_form(CLI::App& app);
[[nodiscard]] Typed add_pocket_form(CLI::App& app);
[[nodiscard]] Typed add_simulate_form(CLI::App& app);
[[nodiscard]] Typed add_check_form(CLI::App& app);
[[nodiscard]] Typed add_show_form(CLI::App& app);
[[nodiscard]] Typed add_export_form(CLI::App& app);
[[nodiscard]] Typed add_edit_form(CLI::App& app);
[[nodiscard]] Typed add_nest_form(CLI::App& app);
[[nodiscard]] Typed add_serve_form(CLI::App& app);

}  // namespace lekalo::cli

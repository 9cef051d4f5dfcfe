#pragma once

#include <functional>

#include "form.hpp"
#include "options.hpp"

namespace lekalo::cli {

/// Gives the options that were typed for one command; to be called after the command line is read.
using Typed = std::function<Result<Command>()>;

/// Each adds the options and the footer of its command to `form`.
[[nodiscard]] Typed add_locate_form(Form& form);
[[nodiscard]] Typed add_verify_form(Form& form);
[[nodiscard]] Typed add_pocket_form(Form& form);
[[nodiscard]] Typed add_simulate_form(Form& form);
[[nodiscard]] Typed add_fit_form(Form& form);
[[nodiscard]] Typed add_heat_form(Form& form);
[[nodiscard]] Typed add_check_form(Form& form);
[[nodiscard]] Typed add_show_form(Form& form);
[[nodiscard]] Typed add_export_form(Form& form);
[[nodiscard]] Typed add_quote_form(Form& form);
[[nodiscard]] Typed add_edit_form(Form& form);
[[nodiscard]] Typed add_nest_form(Form& form);
[[nodiscard]] Typed add_new_form(Form& form);
[[nodiscard]] Typed add_serve_form(Form& form);
[[nodiscard]] Typed add_store_form(Form& form);
[[nodiscard]] Typed add_stock_form(Form& form);

}  // namespace lekalo::cli

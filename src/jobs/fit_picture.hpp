#pragma once

#include <string>

#include "lekalo/jobs/fit.hpp"

namespace lekalo::jobs {

/// Draws how bore, seat and outside grow along the axis in each case. Growths are by the specific pressure,
/// as the source has them: E times the growth, by the pressure and the seat's diameter. Empty where no
/// picture is asked for; usage for one as PDF.
[[nodiscard]] Result<std::string> drawn_fit(const FitJob& job, const Fitted& made);

}  // namespace lekalo::jobs

#pragma once

#include <string>
#include <vector>

#include "lekalo/jobs/heat.hpp"

namespace lekalo::jobs {

/// Sentences for people about a result of heat().

/// Two figures in a form of fmt, or one where both are told by the same.
[[nodiscard]] std::string between(const char* form, const heat::Interval& value);

/// Below which error all may be left, and whether a scaling of the program pays: where it takes off a fifth
/// at least of the largest error at the worst corner.
[[nodiscard]] std::vector<std::string> heat_decision(const HeatFound& found);

/// How long the workpiece takes to cool down, "to half in 10 s, to a tenth in 60 s", and whether a wait pays
/// before a finishing pass: where it is no longer than a minute or a quarter of the program.
struct HeatWait {
  std::string lasts, verdict;
};
[[nodiscard]] HeatWait heat_wait(const HeatFound& found);

}  // namespace lekalo::jobs

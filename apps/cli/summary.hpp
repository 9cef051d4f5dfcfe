#pragma once

#include <string>
#include <vector>

#include "lekalo/io/locate/result_json.hpp"
#include "lekalo/io/locate/solid_result_json.hpp"

namespace lekalo::cli {

/// The result in plain words, for people. Lengths are rounded to the safe side: clearances down, bounds up.
[[nodiscard]] std::string locate_summary(const io::LocateDocument& document,
                                         const std::vector<std::string>& written);

[[nodiscard]] std::string solid_summary(const io::SolidDocument& document,
                                        const std::vector<std::string>& written);

/// `value` with `decimals` decimals, never above it.
[[nodiscard]] std::string decimals_down(double value, int decimals);
/// Never below it.
[[nodiscard]] std::string decimals_up(double value, int decimals);

/// Text for people, on stderr.
void tell(const std::string& text);

}  // namespace lekalo::cli

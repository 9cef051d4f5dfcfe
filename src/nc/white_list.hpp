#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lekalo/base/nc_words.hpp"
#include "lekalo/nc/program.hpp"
#include "lekalo/nc/rewrite.hpp"

namespace lekalo::nc {

/// The words that may pass are in base/nc_words.hpp. docs/design/nc-rewrite.md says why each of them keeps
/// its meaning when the path is turned and shifted in the plane; here stands why others do not.

/// Drilling, tapping and boring cycles of the list.
[[nodiscard]] bool is_cycle(int tenths) noexcept;

/// Number of the work offset that a G word selects (G54 is 1 .. G59.3 is 9); \pre group work_offset.
[[nodiscard]] int work_offset_of(int tenths) noexcept;
/// `G54` .. `G59.3`; \pre 1 <= number <= 9.
[[nodiscard]] std::string work_offset_name(int number);

/// Tenths of a G or M word's number; nothing when it has more than one decimal or is out of range.
[[nodiscard]] std::optional<int> tenths_of(Decimal value) noexcept;

/// The word on the list, or null. An M word that a shop allows is on no list, and harmless.
[[nodiscard]] const words::Word* listed(const Word& word, words::Control control) noexcept;
[[nodiscard]] bool is_allowed(const Word& word, const std::vector<int>& allowed_m) noexcept;

/// True for M words of the list that change nothing that a later block depends on: a block that may be
/// skipped may hold them.
[[nodiscard]] bool m_may_be_skipped(int number) noexcept;

/// All words of the program that are not on the list of this control, and why they cannot be rewritten.
[[nodiscard]] std::vector<LineFault> refused_words(const Program& program, words::Control control,
                                                   const std::vector<int>& allowed_m);

/// The control in whose language the program most likely is: of these, which are some, the one that knows
/// most of its words.
[[nodiscard]] words::Control guess_control(const Program& program, const std::vector<int>& allowed_m,
                                           unsigned controls);

/// Refuses a program for all of this at once, with the lines. \pre not empty
[[nodiscard]] tl::unexpected<Error> refusal_of_all(const std::string& name, std::vector<LineFault> faults);

}  // namespace lekalo::nc

#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"

namespace lekalo::nc {

/// A program without subprograms, variables and expressions.
struct Unfolded {
  std::string text;
  /// For each line of the text, the line of the program that it comes from.
  std::vector<std::size_t> lines;
  std::size_t calls = 0;     ///< written out
  std::size_t computed = 0;  ///< numbers that were computed
};

/// Step 2 of docs/design/nc-rewrite.md: runs the program as far as subprograms (M98, M97, O words) and
/// variables go, and writes out what it meets: subprograms in the place of their calls, numbers in the place
/// of variables and expressions. Assignments and calls stay as comments. A program that has none of them
/// keeps every byte.
///
/// program_refused for a subprogram that is not in the file, a variable that the program has not set,
/// branches and loops, calls beside other words, more than ten calls in one another or ten million bytes.
[[nodiscard]] Result<Unfolded> unfold(std::string_view text, const std::string& name);

}  // namespace lekalo::nc

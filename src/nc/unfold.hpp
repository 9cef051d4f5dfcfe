#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/nc_words.hpp"
#include "lekalo/nc/program.hpp"

namespace lekalo::nc {

/// A word that writes a program out, where it stands first.
struct FlowUse {
  const words::FlowWord* word = nullptr;
  std::size_t line = 0;
};

/// A program without subprograms, variables and expressions.
struct Unfolded {
  std::string text;
  /// For each line of the text, the line of the program that it comes from.
  std::vector<std::size_t> lines;
  std::size_t calls = 0;     ///< written out
  std::size_t computed = 0;  ///< numbers that were computed
  std::vector<FlowUse> uses;
  /// Calls of blocks that are not in the file, which are left as they are: the control stops there.
  std::vector<std::string> notes;
};

/// True for a line that is a call, a definition or holds variables or expressions, so that unfold() writes it
/// anew.
[[nodiscard]] bool is_folded_line(std::string_view line);

/// Step 2 of docs/design/nc-rewrite.md: runs the program as far as subprograms (M98, M97, O words) and
/// variables go, and writes out what it meets: subprograms in the place of their calls, numbers in the place
/// of variables and expressions. Assignments and calls stay as comments. A program that has none of them
/// keeps every byte.
///
/// A fault is a subprogram that is not in the file, a variable that the program has not set, branches and
/// loops, calls beside other words, more than ten calls in one another or ten million bytes.
[[nodiscard]] tl::expected<Unfolded, LineFault> unfold(std::string_view text);

}  // namespace lekalo::nc

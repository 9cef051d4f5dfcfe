#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/base/nc_words.hpp"
#include "lekalo/verify/verify.hpp"

namespace lekalo::verify {

/// A line of a program, with its number from 1. Of a line that calls a subprogram the comments
/// are left.
struct NcLine {
  std::size_t number = 0;
  std::string_view text;
  bool in_subprogram = false;
};

/// The lines of a program in the order in which they run: those of subprograms (M98 with O and M99, M97 with
/// N, O words `sub`, `call` and `endsub`) in the place of their calls, as far as the control knows these. An
/// M97 whose N is nowhere stays as it is. bad_input with the line for subprograms that are not there or not
/// understood, and for more than a million lines.
[[nodiscard]] Result<std::vector<NcLine>> lines_in_order(const Document& program, words::Control control);

}  // namespace lekalo::verify

#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "lekalo/base/error.hpp"
#include "lekalo/nc/decimal.hpp"

namespace lekalo::nc {

/// The longest block LinuxCNC reads, in bytes without the line end.
inline constexpr std::size_t kMaxBlockLength = 255;

/// A letter with its number. Offsets count bytes from the beginning of the program.
struct Word {
  char letter = 0;  ///< upper case, whatever the file has
  Decimal value;
  bool has_point = false;  ///< written with a decimal point
  std::size_t letter_at = 0;
  std::size_t number_begin = 0, number_end = 0;
};

/// One line of the program.
struct Block {
  std::size_t line = 0;            ///< from 1
  std::size_t begin = 0, end = 0;  ///< bytes without the line end
  bool block_delete = false;       ///< begins with `/`
  bool tape_mark = false;          ///< a lone `%`
  bool nested_comment = false;     ///< holds a comment inside a comment
  std::vector<Word> words;
};

/// The fault of a line, as words that complete `name:line:`.
struct LineFault {
  std::size_t line = 0;
  std::string reason;
};

/// A program taken apart into words without losing a byte: what no word covers is comment, blank or line end.
struct Program {
  std::vector<Block> blocks;  ///< every line, also empty ones
  /// The end of the first line that has one, or a line feed.
  std::string line_end;
  /// The lines that could not be taken apart. A block with a fault ends before it.
  std::vector<LineFault> faults;
};

/// Takes the text apart. A fault is whatever is not made of comments and words with plain numbers:
/// expressions, variables, named O words, polar words, open comments, comments that act (Python, probe and
/// log files, printed variables), characters that are not ASCII outside comments, blanks inside a number,
/// lines too long.
///
/// \param lines  the number of each line for messages, where the text was made from another; else they count
///               from 1
[[nodiscard]] Program parse_program(std::string_view text, const std::vector<std::size_t>& lines = {});

/// `name:line: reason` as ErrorCode::program_refused.
[[nodiscard]] tl::unexpected<Error> refusal(const std::string& name, std::size_t line,
                                            const std::string& reason);

}  // namespace lekalo::nc

#pragma once

#include <string>

#include "option_words.hpp"

namespace lekalo::cli {

/// Reads a word like `40%` as a part of the tool's diameter, here 0.4. The sign may be left out. The share
/// may be from 1 % to `most_percent`, which is 50 or 100.
inline void read_step_over(WordReader& read, std::string word, double most_percent, double& part) {
  if (word.empty()) return;
  if (word.back() == '%') word.pop_back();
  // A sign alone is no number, and the complaint shows it as it was typed.
  if (word.empty()) word = "%";
  double percent = 0;
  read.number("--stepover", word, 1.0, most_percent,
              most_percent > 50 ? "a share of the tool's diameter from 1% to 100%"
                                : "a share of the tool's diameter from 1% to 50%",
              percent);
  part = percent / 100;
}

}  // namespace lekalo::cli

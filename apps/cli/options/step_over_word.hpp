#pragma once

#include <string>

#include "option_words.hpp"

namespace lekalo::cli {

/// `40%` of the tool's diameter, as a part of it; the sign may be left out.
inline void read_step_over(WordReader& read, std::string word, double most_percent, double& part) {
  if (word.empty()) return;
  if (word.back() == '%') word.pop_back();
  if (word.empty()) word = "%";
  double percent = 0;
  read.number("--stepover", word, 1.0, most_percent,
              most_percent > 50 ? "a share of the tool's diameter from 1% to 100%"
                                : "a share of the tool's diameter from 1% to 50%",
              percent);
  part = percent / 100;
}

}  // namespace lekalo::cli

#pragma once

#include <string>
#include <vector>

#include "form.hpp"
#include "option_words.hpp"
#include "options.hpp"

namespace lekalo::cli {

/// `FILE:DIAMETER`, as often as other tools were there before.
inline void read_after(WordReader& read, const std::vector<std::string>& words,
                       std::vector<EarlierFile>& after) {
  for (const std::string& word : words) {
    const std::size_t colon = word.find_last_of(':');
    const bool whole = colon != std::string::npos && colon > 0 && colon + 1 < word.size();
    read.require(whole, fmt::format("--after: \"{}\" is not a program and its tool's diameter, as in "
                                    "rough.ngc:10",
                                    word));
    if (!whole) continue;
    after.push_back({word.substr(0, colon), 0});
    read.number("--after", word.substr(colon + 1), 1e-3, 1e4,
                "a program with a diameter from 0.001 to 10000 mm behind a colon",
                after.back().tool_diameter);
  }
}

inline void add_after(const OptionAdder& add, std::vector<std::string>& words) {
  add("--after", words, "FILE:MM",
      "A program that ran before, and its tool's diameter in mm; again for more, in their order")
      .one_word_a_time = true;
}

}  // namespace lekalo::cli

#pragma once

#include <string>

#include "lekalo/base/nc_words.hpp"
#include "option_words.hpp"

namespace lekalo::cli {

/// The words that `--control` takes, for help and for complaints.
inline std::string control_list() {
  std::string list;
  for (const std::string_view word : words::kControlWords)
    list += (list.empty() ? "" : "|") + std::string(word);
  return list;
}

/// Reads a word of `--control`; leaves `control` alone when the option was not given.
template <class Control>
void read_control(WordReader& read, const std::string& word, Control& control) {
  if (word.empty()) return;
  const auto known = words::control_named(word);
  read.require(known.has_value(), fmt::format("--control: \"{}\" is not one of {}", word, control_list()));
  if (known) control = *known;
}

}  // namespace lekalo::cli

#pragma once

#include <bitset>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lekalo/base/nc_words.hpp"

namespace lekalo::verify {

/// Groups of words, of which a program has said one word each.
class SaidGroups {
 public:
  /// Takes what a word says. Blending, G64, takes back the exact path.
  void take(const words::Word& word) {
    constexpr int kBlending = 640;
    said_.set(static_cast<std::size_t>(word.group), word.tenths != kBlending);
  }
  [[nodiscard]] bool has(words::Group group) const { return said_[static_cast<std::size_t>(group)]; }

 private:
  std::bitset<words::kGroups> said_;
};

/// How a block moves, as far as modes depend on it.
struct Motions {
  bool with_feed = false, arcs = false;
};

/// Modes that a program does not say before the motions that depend on them. The control decides these, as it
/// is set up or as the program before it left them, so that such a program is neither right nor wrong.
class UnsaidModes {
 public:
  /// \param program  what the sentences call it
  UnsaidModes(words::Control control, std::string program)
      : control_(control), program_(std::move(program)) {}

  /// Looks at a block that moves, after its own words were said.
  void look(std::size_t line, const SaidGroups& said, const Motions& motions);

  /// A sentence for each mode that some block lacks, with the first such line.
  [[nodiscard]] const std::vector<std::string>& sentences() const noexcept { return sentences_; }

 private:
  words::Control control_;
  std::string program_;
  std::set<std::string_view> told_;
  std::vector<std::string> sentences_;
};

}  // namespace lekalo::verify

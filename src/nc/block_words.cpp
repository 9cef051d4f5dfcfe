#include "block_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <string_view>

namespace lekalo::nc {
namespace {

using words::Group;

bool takes(const words::Word& word, char letter) noexcept {
  return word.takes.find(letter) != std::string_view::npos;
}

Fault add_code(const Word& word, words::Control control, BlockWords& words) {
  const words::Word* const known = listed(word, control);
  const words::Word*& slot = words.codes[static_cast<std::size_t>(known->group)];
  if (slot != nullptr && word.letter == 'G')
    return fmt::format("G{} and another G word of the same modal group", known->tenths / 10);
  slot = known;
  words.all.push_back(known);
  if (word.letter == 'G') return {};
  words.tool_change = words.tool_change || known->group == Group::tool_change;
  words.program_end = words.program_end || known->tenths == 20 || known->tenths == 300;
  return {};
}

/// The words beside which a letter has a meaning, for the sentence that says that none is there.
std::string_view wanted_beside(char letter) noexcept {
  switch (letter) {
    case 'I':
    case 'J':
      return "G2 or G3";
    case 'K':
      return "G2, G3 or X, Y or Z of a canned cycle";
    case 'R':
      return "G2, G3 or X, Y or Z of a canned cycle";
    case 'L':
      return "X, Y or Z of a canned cycle";
    case 'P':
      return "G2, G3, G4, G64, a canned cycle or M62 to M65";
    case 'Q':
      return "G64 or a canned cycle";
    case 'H':
      return "G43 or G44";
    case 'D':
      return "G41 or G42";
    case 'U':
      return "G4";
    case 'A':
    case 'B':
    case 'C':
      return "a line, an arc or a canned cycle of Haas or Fanuc";
    default:
      return "a word that takes it";
  }
}

}  // namespace

int BlockWords::code(Group group) const {
  const words::Word* const found = word(group);
  return found == nullptr ? kNoCode : found->tenths;
}

bool BlockWords::goes_to_machine() const { return code(Group::once) != kNoCode && !dwells(); }

Fault collect(const Block& block, words::Control control, const std::vector<int>& allowed_m,
              BlockWords& words) {
  for (const Word& word : block.words) {
    if (word.letter == 'G' || word.letter == 'M') {
      words.allowed = words.allowed || is_allowed(word, allowed_m);
      if (is_allowed(word, allowed_m)) continue;
      if (Fault fault = add_code(word, control, words)) return fault;
      continue;
    }
    const Word*& slot = words.by_letter[static_cast<std::size_t>(word.letter - 'A')];
    if (slot != nullptr) return fmt::format("two {} words in one block", word.letter);
    slot = &word;
  }
  return {};
}

Fault check_takers(const BlockWords& words, words::Control control, const words::Word* motion) {
  const bool arc = motion != nullptr &&
                   (motion->tenths == words::kClockwise || motion->tenths == words::kCounterClockwise);
  const bool carried = motion != nullptr && (words.has_axis() || (arc && words.has_centre()));
  for (char letter = 'A'; letter <= 'Z'; ++letter) {
    if (words[letter] == nullptr || !words::is_taken(letter, control)) continue;
    const bool place = std::string_view("XYZ").find(letter) != std::string_view::npos;
    // The interpreter has the words for a rotary axis alone, and for one before any motion.
    const bool alone = std::string_view("ABC").find(letter) != std::string_view::npos &&
                       (motion == nullptr || !words.has_axis());
    const bool taken =
        std::ranges::any_of(words.all, [&](const words::Word* word) { return takes(*word, letter); });
    const bool beside_allowed = words.allowed && (letter == 'P' || letter == 'Q');
    if (!place && !alone && !taken && !beside_allowed && !(carried && takes(*motion, letter)))
      return fmt::format("{} without {} in its block", letter, wanted_beside(letter));
  }
  return {};
}

Fault check_skippable(const Block& block) {
  for (const Word& word : block.words) {
    const bool dwell = word.letter == 'G' && tenths_of(word.value) == words::kDwell;
    const bool harmless_m =
        word.letter == 'M' && word.value.whole() && m_may_be_skipped(static_cast<int>(*word.value.whole()));
    const bool harmless_letter = std::string_view("NPSF").find(word.letter) != std::string_view::npos;
    if (!dwell && !harmless_m && !harmless_letter)
      return fmt::format("{} in a block that the / switch may skip: where the tool then stands is not known",
                         word.letter);
  }
  return {};
}

}  // namespace lekalo::nc

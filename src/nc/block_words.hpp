#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "white_list.hpp"

namespace lekalo::nc {

/// The fault of a block, as words that complete `name:line:`; none when all is well.
using Fault = std::optional<std::string>;

/// The words of one block, looked up once. All of them are on the control's list.
struct BlockWords {
  std::array<const Word*, 26> by_letter{};                 ///< all but G and M, which may repeat
  std::array<const words::Word*, words::kGroups> codes{};  ///< null: none of this group
  std::vector<const words::Word*> all;                     ///< the G and M words of the list
  /// `allowed`: an M word that the shop allows; P and Q may stand beside it.
  bool tool_change = false, program_end = false, allowed = false;

  [[nodiscard]] const Word* operator[](char letter) const {
    return by_letter[static_cast<std::size_t>(letter - 'A')];
  }
  [[nodiscard]] const words::Word* word(words::Group group) const {
    return codes[static_cast<std::size_t>(group)];
  }
  /// Tenths, or kNoCode.
  [[nodiscard]] int code(words::Group group) const;
  [[nodiscard]] bool moves_xy() const { return (*this)['X'] != nullptr || (*this)['Y'] != nullptr; }
  [[nodiscard]] bool has_axis() const { return moves_xy() || (*this)['Z'] != nullptr; }
  [[nodiscard]] bool has_rotary() const {
    return (*this)['A'] != nullptr || (*this)['B'] != nullptr || (*this)['C'] != nullptr;
  }
  [[nodiscard]] bool has_centre() const {
    return (*this)['I'] != nullptr || (*this)['J'] != nullptr || (*this)['K'] != nullptr;
  }
  /// G28, G30 or G53.
  [[nodiscard]] bool goes_to_machine() const;
  [[nodiscard]] bool dwells() const { return code(words::Group::once) == words::kDwell; }
};

inline constexpr int kNoCode = -1;

/// Looks the words of a block up. Refuses two words of one letter or of one group.
[[nodiscard]] Fault collect(const Block& block, words::Control control, const std::vector<int>& allowed_m,
                            BlockWords& words);

/// Refuses letters that no word of the block, nor the motion in force, takes.
/// \param motion  the motion word in force, or null
[[nodiscard]] Fault check_takers(const BlockWords& words, words::Control control, const words::Word* motion);

/// The machine decides whether a block that begins with / runs, so it may hold only what no later block
/// depends on.
[[nodiscard]] Fault check_skippable(const Block& block);

}  // namespace lekalo::nc

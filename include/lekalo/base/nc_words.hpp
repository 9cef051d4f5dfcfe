#pragma once

#include <array>
#include <optional>
#include <string_view>

/// The words of NC programs that lekalo knows, as data. The rewriter (nc) and the checker (verify) share no
/// code, and they read this one table, so that what one of them takes, the other takes too. A word that is in
/// no row is refused by both. docs/design/nc-rewrite.md says for each word why it may pass.
namespace lekalo::words {

/// The languages of controls. The same word may mean something in one of them and nothing, or something else,
/// in another.
enum class Control : unsigned char { linuxcnc, haas, fanuc, grbl };

/// The words that choose a control, by its number, and the names that sentences give it.
inline constexpr std::array<std::string_view, 4> kControlWords{"linuxcnc", "haas", "fanuc", "grbl"};
inline constexpr std::array<std::string_view, 4> kControlNames{"LinuxCNC", "Haas", "Fanuc", "GRBL"};

[[nodiscard]] constexpr std::string_view word_of(Control control) noexcept {
  return kControlWords[static_cast<std::size_t>(control)];
}
[[nodiscard]] constexpr std::string_view name_of(Control control) noexcept {
  return kControlNames[static_cast<std::size_t>(control)];
}

/// Two words of one group exclude each other within a block.
enum class Group : unsigned char {
  once,  ///< acts in its block alone: a dwell, a way to a point of the machine
  motion,
  motion_off,  ///< G80
  plane,
  unit,
  distance,
  centre,
  feed_mode,
  compensation,
  tool_length,
  work_offset,
  path_control,
  look_ahead,
  scaling,
  rotation,
  retract,
  spindle_mode,
  stop,
  spindle,
  orientation,
  tool_change,
  coolant,
  speed_control,
  output,
  auxiliary,
};
inline constexpr std::size_t kGroups = 25;

/// A G or M word.
struct Word {
  char letter;
  /// Codes count tenths, so that G59.3 is 593.
  int tenths;
  Group group;
  /// The letters that have a meaning through this word.
  std::string_view takes;
  /// The controls that know the word with this meaning, one bit for each.
  unsigned controls;
  /// False where the control makes a path, or a feed, that the program does not say. Such a word turns with
  /// the part as any other, but what it cuts is not judged.
  bool judged = true;
};

[[nodiscard]] constexpr bool knows(const Word& word, Control control) noexcept {
  return (word.controls >> static_cast<unsigned>(control) & 1U) != 0;
}

inline constexpr int kRapid = 0, kFeed = 10, kClockwise = 20, kCounterClockwise = 30, kDwell = 40,
                     kHome = 280, kSecondHome = 300, kMachineFrame = 530, kMotionOff = 800;

namespace detail {
inline constexpr unsigned L = 1, H = 2, F = 4, B = 8, mills = L | H | F, all = mills | B;
inline constexpr std::string_view axes = "XYZABC", arc = "XYZABCIJKR", hole = "XYZABCRPQL";
/// LinuxCNC refuses P and Q beside cycles that do not wait and do not peck, and rotary axes beside all. Haas
/// shapes its pecks by I, J and K, where Fanuc has K for the L of the others.
inline constexpr std::string_view drill = "XYZRL", dwell = "XYZRPL", peck = "XYZRQL",
                                  shaped_peck = "XYZABCRPQLIJK", fanuc_hole = "XYZABCRPQKL";
}  // namespace detail

inline constexpr std::array kWords = [] {
  using enum Group;
  using namespace detail;
  return std::array{
      Word{'G', kRapid, motion, axes, all},
      Word{'G', kFeed, motion, axes, all},
      Word{'G', kClockwise, motion, "XYZABCIJKRP", L},
      Word{'G', kClockwise, motion, arc, H | F | B},
      Word{'G', kCounterClockwise, motion, "XYZABCIJKRP", L},
      Word{'G', kCounterClockwise, motion, arc, H | F | B},
      Word{'G', kDwell, once, "P", L | H | B},
      Word{'G', kDwell, once, "PXU", F},
      Word{'G', 51, look_ahead, "QPR", F},
      Word{'G', 170, plane, "", all},
      Word{'G', 180, plane, "", all},
      Word{'G', 190, plane, "", all},
      Word{'G', 200, unit, "", all},
      Word{'G', 210, unit, "", all},
      Word{'G', kHome, once, axes, all},
      Word{'G', kSecondHome, once, axes, all},
      Word{'G', 400, compensation, "", all},
      Word{'G', 410, compensation, "D", mills, false},
      Word{'G', 420, compensation, "D", mills, false},
      Word{'G', 430, tool_length, "H", mills},
      Word{'G', 440, tool_length, "H", H | F},
      Word{'G', 490, tool_length, "", all},
      Word{'G', 500, scaling, "", H | F},
      Word{'G', kMachineFrame, once, "", all},
      Word{'G', 540, work_offset, "", all},
      Word{'G', 550, work_offset, "", all},
      Word{'G', 560, work_offset, "", all},
      Word{'G', 570, work_offset, "", all},
      Word{'G', 580, work_offset, "", all},
      Word{'G', 590, work_offset, "", all},
      Word{'G', 591, work_offset, "", L},
      Word{'G', 592, work_offset, "", L},
      Word{'G', 593, work_offset, "", L},
      Word{'G', 610, path_control, "", all},
      Word{'G', 611, path_control, "", L},
      Word{'G', 640, path_control, "PQ", L},
      Word{'G', 640, path_control, "", H | F},
      Word{'G', 690, rotation, "", H | F},
      Word{'G', 730, motion, peck, L},
      Word{'G', 730, motion, shaped_peck, H},
      Word{'G', 730, motion, fanuc_hole, F},
      Word{'G', 740, motion, "XYZRP", L},
      Word{'G', 740, motion, hole, H},
      Word{'G', 740, motion, fanuc_hole, F},
      Word{'G', 760, motion, hole, H, false},
      Word{'G', 760, motion, fanuc_hole, F, false},
      Word{'G', kMotionOff, motion_off, "", all},
      Word{'G', 810, motion, drill, L},
      Word{'G', 810, motion, hole, H},
      Word{'G', 810, motion, fanuc_hole, F},
      Word{'G', 820, motion, dwell, L},
      Word{'G', 820, motion, hole, H},
      Word{'G', 820, motion, fanuc_hole, F},
      Word{'G', 830, motion, peck, L},
      Word{'G', 830, motion, shaped_peck, H},
      Word{'G', 830, motion, fanuc_hole, F},
      Word{'G', 840, motion, dwell, L},
      Word{'G', 840, motion, hole, H},
      Word{'G', 840, motion, fanuc_hole, F},
      Word{'G', 850, motion, drill, L},
      Word{'G', 850, motion, hole, H},
      Word{'G', 850, motion, fanuc_hole, F},
      Word{'G', 860, motion, dwell, L},
      Word{'G', 860, motion, hole, H},
      Word{'G', 860, motion, fanuc_hole, F},
      Word{'G', 870, motion, hole, H, false},
      Word{'G', 870, motion, fanuc_hole, F, false},
      Word{'G', 880, motion, hole, H, false},
      Word{'G', 880, motion, fanuc_hole, F, false},
      Word{'G', 890, motion, dwell, L},
      Word{'G', 890, motion, hole, H},
      Word{'G', 890, motion, fanuc_hole, F},
      Word{'G', 900, distance, "", all},
      Word{'G', 901, centre, "", L},
      Word{'G', 910, distance, "", all},
      Word{'G', 911, centre, "", all},
      Word{'G', 930, feed_mode, "", all, false},
      Word{'G', 940, feed_mode, "", all},
      Word{'G', 950, feed_mode, "", mills, false},
      Word{'G', 970, spindle_mode, "", mills},
      Word{'G', 980, retract, "", mills},
      Word{'G', 990, retract, "", mills},
      Word{'G', 1030, look_ahead, "P", H},
      Word{'G', 1870, look_ahead, "PE", H},
      Word{'M', 0, stop, "", all},
      Word{'M', 10, stop, "", all},
      Word{'M', 20, stop, "", all},
      Word{'M', 30, spindle, "", all},
      Word{'M', 40, spindle, "", all},
      Word{'M', 50, spindle, "", all},
      Word{'M', 60, tool_change, "", mills},
      Word{'M', 70, coolant, "", all},
      Word{'M', 80, coolant, "", all},
      Word{'M', 90, coolant, "", all},
      Word{'M', 100, auxiliary, "", H | F},
      Word{'M', 110, auxiliary, "", H | F},
      Word{'M', 120, auxiliary, "", H},
      Word{'M', 130, auxiliary, "", H},
      Word{'M', 190, orientation, "R", L},
      Word{'M', 190, orientation, "RP", H | F},
      Word{'M', 290, auxiliary, "", H | F},
      Word{'M', 300, stop, "", all},
      Word{'M', 310, auxiliary, "", H | F},
      Word{'M', 330, auxiliary, "", H | F},
      Word{'M', 410, auxiliary, "", H | F},
      Word{'M', 420, auxiliary, "", H | F},
      Word{'M', 480, speed_control, "", L | F},
      Word{'M', 490, speed_control, "", L | F},
      Word{'M', 620, output, "P", L},
      Word{'M', 630, output, "P", L},
      Word{'M', 640, output, "P", L},
      Word{'M', 650, output, "P", L},
      Word{'M', 830, auxiliary, "", H},
      Word{'M', 840, auxiliary, "", H},
      Word{'M', 880, auxiliary, "", H | F},
      Word{'M', 890, auxiliary, "", H | F},
      // Subprograms are written out, so only a call of a block that is not there is left.
      Word{'M', 970, auxiliary, "PL", H, false},
      Word{'M', 1380, auxiliary, "", H},
      Word{'M', 1390, auxiliary, "", H},
  };
}();

/// The word of this code that the control knows, or null.
[[nodiscard]] constexpr const Word* word_at(char letter, int tenths, Control control) noexcept {
  for (const Word& word : kWords)
    if (word.letter == letter && word.tenths == tenths && knows(word, control)) return &word;
  return nullptr;
}

/// A way to write a program out, subprograms and computed numbers, and the controls that know it.
struct FlowWord {
  std::string_view name;
  unsigned controls;
};
inline constexpr FlowWord kLocalCall{"M97", detail::H}, kCall{"M98", detail::mills},
    kNamedSubprogram{"an O word beside SUB or CALL", detail::L},
    kVariable{"a variable or expression", detail::mills}, kNamedVariable{"a variable with a name", detail::L};

[[nodiscard]] constexpr bool knows(const FlowWord& word, Control control) noexcept {
  return (word.controls >> static_cast<unsigned>(control) & 1U) != 0;
}

/// The other letters: those that need a word of the block, or the motion in force, which takes them, and
/// those that need none.
inline constexpr std::string_view kTakenLetters = "ABCEHIJKLPQRUXYZ", kFreeLetters = "DFNOST";
/// The letter D needs a word that takes it on LinuxCNC. Other controls keep it until G41 or G42 uses it.
[[nodiscard]] constexpr bool is_taken(char letter, Control control) noexcept {
  return kTakenLetters.find(letter) != std::string_view::npos ||
         (letter == 'D' && (control == Control::linuxcnc || control == Control::grbl));
}
/// A letter that some word of some control takes, or that needs none. U alone stands beside G4.
[[nodiscard]] constexpr bool is_letter_known(char letter) noexcept {
  return letter == 'G' || letter == 'M' || kTakenLetters.find(letter) != std::string_view::npos ||
         kFreeLetters.find(letter) != std::string_view::npos;
}

[[nodiscard]] constexpr std::optional<Control> control_named(std::string_view word) noexcept {
  for (std::size_t k = 0; k < kControlWords.size(); ++k)
    if (kControlWords[k] == word) return static_cast<Control>(k);
  return std::nullopt;
}

}  // namespace lekalo::words

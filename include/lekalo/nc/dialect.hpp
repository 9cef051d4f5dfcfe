#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "lekalo/base/nc_words.hpp"
#include "lekalo/base/units.hpp"

namespace lekalo::nc {

/// The form that one control wants its programs to have: everything in which the posts differ.
/// docs/design/export.md shows how a post is added.
///
/// Texts are whole lines, parted by `\n`, without a `\n` at their end; an empty text is no line. `{unit}` in
/// them stands for G20 or G21.
struct Dialect {
  /// The word that chooses the post, in small letters and digits.
  std::string_view name;
  /// The control's own name, for sentences.
  std::string_view control;
  /// The words that the control reads.
  words::Control language = words::Control::linuxcnc;

  struct Decimals {
    /// The decimals of a coordinate that the control reads without dropping digits, 1 to 9.
    int millimetre = 4, inch = 5;
    [[nodiscard]] constexpr int of(LengthUnit unit) const noexcept {
      return unit == LengthUnit::inch ? inch : millimetre;
    }
  } decimals{};

  /// Comments are capitals, digits, points and dashes between these marks.
  struct Comment {
    std::string_view open = "(", close = ")";
    /// The most letters between the marks; the others are left out.
    std::size_t longest = 60;
  } comment{};

  /// `G4 P` for a wait: in seconds with three decimals, unless the post says otherwise.
  struct Dwell {
    double units_per_second = 1;
    int decimals = 3;
  } dwell{};

  /// The first and the last line; empty for none.
  std::string_view tape_mark = "";
  /// The line after the tape mark and before a title; empty for none.
  std::string_view program_number = "";

  /// The lines that set every mode on which a program of this kind depends, and the lines that end it.
  struct Frame {
    std::string_view modes, end;
  };
  /// The frame of pockets. `{offset}` stands for G54 to G59. The end comes after M9 and M5, above the stock.
  Frame pocket{};
  /// The frame of cuts along outlines, in G54. The end comes after M5, at X0 Y0.
  Frame profile{};

  /// `{tool}` stands for the tool's number.
  std::string_view tool_change = "T{tool} M6\nG43 H{tool}";
  /// False where a program cannot change the tool on the way.
  bool changes_tools = true;
  std::string_view laser_on = "M3";
  /// True when the beam stays dark without an S word.
  bool laser_needs_power = false;
};

/// The list of all posts, in the order in which help shows them. The first one is taken if none is chosen.
[[nodiscard]] std::span<const Dialect> posts() noexcept;

/// Returns the post of the control that reads this language.
[[nodiscard]] const Dialect& post_of(words::Control language) noexcept;

/// Returns the post of this name, or nullptr.
[[nodiscard]] const Dialect* post_named(std::string_view name) noexcept;

/// Returns the names of all posts in one text, the last of them after `last_separator`.
[[nodiscard]] std::string post_names(std::string_view separator, std::string_view last_separator);

}  // namespace lekalo::nc

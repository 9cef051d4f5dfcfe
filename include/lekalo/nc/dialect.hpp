#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "lekalo/base/units.hpp"

namespace lekalo::nc {

/// The form that one control wants its programs to have: everything in which the posts differ.
/// docs/design/export.md shows how a post is added.
///
/// Texts are whole lines, parted by `\n`, without a `\n` at their end; an empty text is no line. `{unit}` in
/// them stands for G20 or G21.
struct Dialect {
  std::string_view name;     ///< the word that chooses the post: small letters and digits
  std::string_view control;  ///< the control's own name, for sentences

  struct Decimals {
    int millimetre = 4, inch = 5;  ///< 1 to 9: what the control reads of a coordinate without dropping digits
    [[nodiscard]] constexpr int of(LengthUnit unit) const noexcept {
      return unit == LengthUnit::inch ? inch : millimetre;
    }
  } decimals{};

  /// Comments are capitals, digits, points and dashes between these marks.
  struct Comment {
    std::string_view open = "(", close = ")";
    std::size_t longest = 60;  ///< letters between the marks, what is beyond is left out
  } comment{};

  /// `G4 P` for a wait: in seconds with three decimals, unless the post says otherwise.
  struct Dwell {
    double units_per_second = 1;
    int decimals = 3;
  } dwell{};

  std::string_view tape_mark = "";       ///< the first and the last line; empty: none
  std::string_view program_number = "";  ///< the line after the tape mark, before a title; empty: none

  /// The lines that set every mode on which a program of this kind depends, and the lines that end it.
  struct Frame {
    std::string_view modes, end;
  };
  Frame pocket{};   ///< `{offset}` stands for G54 to G59. The end comes after M9 and M5, above the stock
  Frame profile{};  ///< for cuts along outlines, in G54. The end comes after M5, at X0 Y0

  std::string_view tool_change = "T{tool} M6\nG43 H{tool}";  ///< `{tool}` stands for the tool's number
  std::string_view laser_on = "M3";
  bool laser_needs_power = false;  ///< without an S word the beam stays dark
};

/// The list of all posts, in the order in which help shows them. The first one is taken if none is chosen.
[[nodiscard]] std::span<const Dialect> posts() noexcept;

/// The post of this name; none: nullptr.
[[nodiscard]] const Dialect* post_named(std::string_view name) noexcept;

/// The names of all posts in one text, the last of them after `last_separator`.
[[nodiscard]] std::string post_names(std::string_view separator, std::string_view last_separator);

}  // namespace lekalo::nc

#include "white_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace lekalo::nc {
namespace {

struct GWord {
  int tenths;
  Group group;
};

constexpr std::array kWhiteList = {
    GWord{kRapid, Group::motion},
    GWord{kFeed, Group::motion},
    GWord{kClockwise, Group::motion},
    GWord{kCounterClockwise, Group::motion},
    GWord{40, Group::dwell},
    GWord{170, Group::plane},
    GWord{180, Group::plane},
    GWord{190, Group::plane},
    GWord{200, Group::unit},
    GWord{210, Group::unit},
    GWord{400, Group::compensation},
    GWord{410, Group::compensation},
    GWord{420, Group::compensation},
    GWord{430, Group::tool_length},
    GWord{440, Group::tool_length},
    GWord{490, Group::tool_length},
    GWord{540, Group::work_offset},
    GWord{550, Group::work_offset},
    GWord{560, Group::work_offset},
    GWord{570, Group::work_offset},
    GWord{580, Group::work_offset},
    GWord{590, Group::work_offset},
    GWord{591, Group::work_offset},
    GWord{592, Group::work_offset},
    GWord{593, Group::work_offset},
    GWord{610, Group::path_control},
    GWord{611, Group::path_control},
    GWord{640, Group::path_control},
    GWord{690, Group::rotation_cancel},
    GWord{730, Group::motion},
    GWord{740, Group::motion},
    GWord{kMotionOff, Group::cycle_cancel},
    GWord{810, Group::motion},
    GWord{820, Group::motion},
    GWord{830, Group::motion},
    GWord{840, Group::motion},
    GWord{850, Group::motion},
    GWord{860, Group::motion},
    GWord{890, Group::motion},
    GWord{900, Group::distance},
    GWord{901, Group::centre_distance},
    GWord{910, Group::distance},
    GWord{911, Group::centre_distance},
    GWord{930, Group::feed_mode},
    GWord{940, Group::feed_mode},
    GWord{950, Group::feed_mode},
    GWord{970, Group::spindle_mode},
    GWord{980, Group::retract},
    GWord{990, Group::retract},
};

struct Reason {
  int from, to;  ///< tenths, both included
  const char* why;
};

/// The words users meet most. A word in no row is refused too.
constexpr std::array kRefusedG = {
    Reason{50, 53, "splines are not rewritten; let the CAM system write lines and arcs"},
    Reason{70, 80, "lathe diameter and radius modes do not belong to a mill program"},
    Reason{100, 100, "it sets offsets inside the program; set them on the control before"},
    Reason{101, 101, "it sets offsets inside the program; set them on the control before"},
    Reason{150, 160, "polar coordinates cannot be rewritten; give X and Y"},
    Reason{280, 281, "it moves to a point of the machine, which does not turn with the part"},
    Reason{300, 301, "it moves to a point of the machine, which does not turn with the part"},
    Reason{330, 331, "thread cutting is not rewritten"},
    Reason{380, 389, "probing moves are not rewritten"},
    Reason{411, 411, "compensation by a radius in the program is not rewritten; use G41 with D"},
    Reason{421, 421, "compensation by a radius in the program is not rewritten; use G42 with D"},
    Reason{500, 511, "scaling and mirroring would change under the rotation"},
    Reason{520, 520, "it shifts the coordinate system inside the program"},
    Reason{530, 530, "it moves in machine coordinates, which do not turn with the part"},
    Reason{541, 541, "extended work offsets are not rewritten; use G54 to G59.3"},
    Reason{650, 671, "subprograms and macros cannot be rewritten; let the CAM system write them out"},
    Reason{680, 682, "the program turns its own coordinates already"},
    Reason{760, 760, "it threads on one control and bores with a sideways shift on another"},
    Reason{870, 880, "boring with a sideways shift or by hand is not rewritten"},
    Reason{920, 929, "it shifts the coordinate system inside the program"},
    Reason{960, 960, "constant surface speed follows X, which would change under the rotation"},
};

constexpr std::array kMWords = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 30, 48, 49, 62, 63, 64, 65};
constexpr std::array kSkippableMWords = {0, 1, 7, 8, 9};

}  // namespace

std::optional<Group> group_of(int tenths) noexcept {
  for (const GWord& word : kWhiteList)
    if (word.tenths == tenths) return word.group;
  return std::nullopt;
}

bool is_cycle(int tenths) noexcept { return group_of(tenths) == Group::motion && tenths > kCounterClockwise; }

int work_offset_of(int tenths) noexcept { return tenths <= 590 ? (tenths - 530) / 10 : tenths - 590 + 6; }

std::string work_offset_name(int number) {
  return number <= 6 ? fmt::format("G{}", 53 + number) : fmt::format("G59.{}", number - 6);
}

std::optional<int> tenths_of(Decimal value) noexcept {
  std::int64_t digits = value.digits;
  int decimals = value.decimals;
  for (; decimals > 1 && digits % 10 == 0; --decimals) digits /= 10;
  if (decimals > 1 || digits < 0 || digits > 9999) return std::nullopt;
  return static_cast<int>(decimals == 1 ? digits : 10 * digits);
}

std::string refused_g(Decimal value) {
  const std::string word = "G" + format_decimal(value.digits, value.decimals);
  if (const std::optional<int> tenths = tenths_of(value))
    for (const Reason& reason : kRefusedG)
      if (reason.from <= *tenths && *tenths <= reason.to) return fmt::format("{}: {}", word, reason.why);
  return fmt::format("{} is not on the list of words that can be rewritten", word);
}

bool m_on_list(int number) noexcept { return std::ranges::find(kMWords, number) != kMWords.end(); }

bool m_may_be_skipped(int number) noexcept {
  return std::ranges::find(kSkippableMWords, number) != kSkippableMWords.end();
}

std::string refused_m(Decimal value) {
  const std::string word = "M" + format_decimal(value.digits, value.decimals);
  const auto number = value.whole();
  if (number && *number >= 96 && *number <= 99)
    return fmt::format("{}: subprograms cannot be rewritten; let the CAM system write them out", word);
  if (number && *number >= 70 && *number <= 73)
    return fmt::format("{}: it saves or restores modal words, which are then not known here", word);
  if (number && *number >= 100 && *number <= 199)
    return fmt::format("{}: what a user's own M word does is not known here", word);
  return fmt::format("{} is not on the list of words that can be rewritten", word);
}

std::optional<std::string> refused_letter(char letter) {
  constexpr std::string_view kPassing = "DFGHIJLMNOPQRSTXYZ";
  if (kPassing.find(letter) != std::string_view::npos) return std::nullopt;
  switch (letter) {
    case 'A':
    case 'B':
    case 'C':
      return fmt::format("rotary axis {}: only X Y Z programs can be rewritten", letter);
    case 'U':
    case 'V':
    case 'W':
      return fmt::format("axis {}: only X Y Z programs can be rewritten", letter);
    case 'K':
      return std::string(
          "K: arcs outside the XY plane (G18, G19) do not stay in their plane when turned, and repeats by K "
          "are not "
          "rewritten");
    default:
      return fmt::format("{} is not on the list of words that can be rewritten", letter);
  }
}

}  // namespace lekalo::nc

#include "white_list.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace lekalo::nc {
namespace {

using words::Control;

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
    Reason{120, 130, "its circle begins in a direction of the machine; let the CAM system write it out"},
    Reason{150, 160, "polar coordinates cannot be rewritten; give X and Y"},
    Reason{281, 281, "it sets a point of the machine inside the program"},
    Reason{301, 301, "it sets a point of the machine inside the program"},
    Reason{330, 331, "thread cutting is not rewritten"},
    Reason{380, 389, "probing moves are not rewritten"},
    Reason{411, 411, "compensation by a radius in the program is not rewritten; use G41 with D"},
    Reason{421, 421, "compensation by a radius in the program is not rewritten; use G42 with D"},
    Reason{434, 435, "with it the control turns the tool's tip about rotary axes"},
    Reason{510, 511, "scaling and mirroring would change under the rotation"},
    Reason{520, 520, "it shifts the coordinate system inside the program"},
    Reason{541, 541, "extended work offsets are not rewritten; use G54 to G59.3"},
    Reason{650, 671, "subprograms and macros cannot be rewritten; let the CAM system write them out"},
    Reason{680, 682, "the program turns its own coordinates already"},
    Reason{700, 720, "its holes lie in directions of the machine; let the CAM system write them out"},
    Reason{760, 760, "it threads on one control and bores with a sideways shift on another"},
    Reason{870, 880, "boring with a sideways shift or by hand is not rewritten"},
    Reason{920, 929, "it shifts the coordinate system inside the program"},
    Reason{960, 960, "constant surface speed follows X, which would change under the rotation"},
};

constexpr std::array kSkippableMWords = {0, 1, 7, 8, 9};

constexpr const char* kNotListed = "is not on the list of words that can be rewritten";

std::string name_of(const Word& word) {
  return word.letter + format_decimal(word.value.digits, word.value.decimals);
}

/// The way out for a word that another control knows.
std::string other_control(const Word& word) {
  for (const Control other : {Control::linuxcnc, Control::haas, Control::fanuc, Control::grbl})
    if (listed(word, other) != nullptr)
      return fmt::format("; {} controls know it: --control {}", name_of(other), word_of(other));
  return "";
}

std::string refused_g(const Word& word) {
  const std::string other = other_control(word);
  if (const std::optional<int> tenths = tenths_of(word.value); tenths)
    for (const Reason& reason : kRefusedG)
      if (reason.from <= *tenths && *tenths <= reason.to)
        return fmt::format("{}: {}{}", name_of(word), reason.why, other);
  return fmt::format("{} {}{}", name_of(word), kNotListed, other);
}

std::string refused_m(const Word& word) {
  const auto number = word.value.whole();
  if (number && *number >= 96 && *number <= 99)
    return fmt::format("{}: subprograms cannot be rewritten; let the CAM system write them out",
                       name_of(word));
  if (number && *number >= 70 && *number <= 73)
    return fmt::format("{}: it saves or restores modal words, which are then not known here", name_of(word));
  if (number == 60) return "M60: another pallet is another part";
  if (const std::string other = other_control(word); !other.empty())
    return fmt::format("{} {}{}", name_of(word), kNotListed, other);
  if (!number || *number < 0 || *number > 999) return fmt::format("{} {}", name_of(word), kNotListed);
  return fmt::format("{} {}; if it moves no axis, --allow FILE with the line {} lets it pass", name_of(word),
                     kNotListed, name_of(word));
}

/// The reason to refuse a letter; none for a letter that can stand in a program on the list.
std::optional<std::string> refused_letter(const Word& word) {
  switch (word.letter) {
    case 'A':
    case 'B':
    case 'C':
      if (word.value.digits == 0) return std::nullopt;
      return fmt::format("rotary axis {}: only X Y Z programs can be rewritten", word.letter);
    case 'V':
    case 'W':
      return fmt::format("axis {}: only X Y Z programs can be rewritten", word.letter);
    default:
      if (words::is_letter_known(word.letter)) return std::nullopt;
      return fmt::format("{} {}", word.letter, kNotListed);
  }
}

std::optional<std::string> refusal_of(const Word& word, Control control, const std::vector<int>& allowed_m) {
  if (word.letter != 'G' && word.letter != 'M') return refused_letter(word);
  if (listed(word, control) != nullptr || is_allowed(word, allowed_m)) return std::nullopt;
  return word.letter == 'G' ? refused_g(word) : refused_m(word);
}

/// G80 beside G0 to G3, which LinuxCNC counts to one modal group.
bool ends_and_begins_motion(const Block& block) {
  bool ends = false, begins = false;
  for (const Word& word : block.words) {
    if (word.letter != 'G') continue;
    const int tenths = tenths_of(word.value).value_or(words::kMachineFrame);
    ends = ends || tenths == words::kMotionOff;
    begins = begins || tenths <= words::kCounterClockwise;
  }
  return ends && begins;
}

}  // namespace

bool is_cycle(int tenths) noexcept { return tenths >= 730 && tenths <= 890 && tenths != words::kMotionOff; }

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

const words::Word* listed(const Word& word, Control control) noexcept {
  const auto tenths = tenths_of(word.value);
  return tenths ? words::word_at(word.letter, *tenths, control) : nullptr;
}

bool is_allowed(const Word& word, const std::vector<int>& allowed_m) noexcept {
  const auto number = word.value.whole();
  return word.letter == 'M' && number && std::ranges::find(allowed_m, *number) != allowed_m.end();
}

bool m_may_be_skipped(int number) noexcept {
  return std::ranges::find(kSkippableMWords, number) != kSkippableMWords.end();
}

std::vector<LineFault> refused_words(const Program& program, Control control,
                                     const std::vector<int>& allowed_m) {
  std::vector<LineFault> refused;
  for (const Block& block : program.blocks) {
    for (const Word& word : block.words)
      if (const auto reason = refusal_of(word, control, allowed_m)) refused.push_back({block.line, *reason});
    if (control == Control::linuxcnc && ends_and_begins_motion(block))
      refused.push_back(
          {block.line, "G80 beside G0 to G3; Haas, Fanuc and GRBL controls read it: --control haas"});
    if (block.nested_comment && control == Control::linuxcnc)
      refused.push_back({block.line,
                         "a comment inside a comment; Haas, Fanuc and GRBL controls read it: "
                         "--control haas"});
  }
  return refused;
}

namespace {

/// The letters of blocks in which no word takes them for this control, nor the motion in force.
std::size_t idle_letters(const Program& program, Control control) {
  std::size_t idle = 0;
  const words::Word* motion = nullptr;
  const auto takes = [](const words::Word* word, char letter) {
    return word != nullptr && word->takes.find(letter) != std::string_view::npos;
  };
  for (const Block& block : program.blocks) {
    for (const Word& word : block.words)
      if (const words::Word* known = listed(word, control);
          known != nullptr && (known->group == words::Group::motion || known->tenths == words::kMotionOff))
        motion = known->group == words::Group::motion ? known : nullptr;
    for (const Word& word : block.words) {
      if (std::string_view("PQDLKABC").find(word.letter) == std::string_view::npos) continue;
      const bool used =
          takes(motion, word.letter) || std::ranges::any_of(block.words, [&](const Word& other) {
            return takes(listed(other, control), word.letter);
          });
      if (!used && words::is_taken(word.letter, control)) ++idle;
    }
  }
  return idle;
}

}  // namespace

Control guess_control(const Program& program, const std::vector<int>& allowed_m, unsigned controls) {
  const bool numbered = std::ranges::any_of(program.blocks, [](const Block& block) {
    return !block.words.empty() && block.words.front().letter == 'O';
  });
  const std::array order = numbered
                               ? std::array{Control::fanuc, Control::haas, Control::linuxcnc, Control::grbl}
                               : std::array{Control::linuxcnc, Control::fanuc, Control::haas, Control::grbl};
  const auto unknown = [&](Control control) {
    const bool possible = (controls >> static_cast<unsigned>(control) & 1U) != 0;
    return std::pair(!possible,
                     refused_words(program, control, allowed_m).size() + idle_letters(program, control));
  };
  return *std::ranges::min_element(order, {}, unknown);
}

tl::unexpected<Error> refusal_of_all(const std::string& name, std::vector<LineFault> faults) {
  struct SameFaults {
    std::string reason, lines;
    std::size_t count = 0;
  };
  std::ranges::stable_sort(faults, {}, &LineFault::line);
  std::vector<SameFaults> groups;
  for (const LineFault& fault : faults) {
    auto group = std::ranges::find(groups, fault.reason, &SameFaults::reason);
    if (group == groups.end()) group = groups.insert(groups.end(), {fault.reason, "", 0});
    group->lines += fmt::format("{}{}", group->count++ == 0 ? "" : ", ", fault.line);
  }
  if (faults.size() == 1) return refusal(name, faults.front().line, faults.front().reason);
  std::string sentence = fmt::format("{} words cannot be rewritten: ", faults.size());
  for (const SameFaults& group : groups)
    sentence += fmt::format("{}line{} {}: {}", &group == &groups.front() ? "" : " / ",
                            group.count == 1 ? "" : "s", group.lines, group.reason);
  return refusal(name, faults.front().line, sentence);
}

}  // namespace lekalo::nc

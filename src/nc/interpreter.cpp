#include "interpreter.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "arc.hpp"
#include "lekalo/base/angle.hpp"
#include "white_list.hpp"

namespace lekalo::nc {
namespace {

/// The fault of a block, as words that complete `name:line:`; none when all is well.
using Fault = std::optional<std::string>;

constexpr int kNone = -1;
/// A coordinate beyond this many millimetres or inches is taken for a slip, and would not fit a control.
constexpr std::int64_t kLargestCoordinate = 1'000'000;
constexpr std::int64_t kLargestRepeat = 10'000;

/// The state of the control that later blocks depend on.
struct Modal {
  LengthUnit unit = LengthUnit::millimetre;
  int motion = kNone;
  int plane = 170;
  int compensation = 400;
  bool incremental = false, absolute_centre = false;
  bool x_known = false, y_known = false;
  GridPoint position;
};

/// The words of one block, looked up once.
struct Words {
  std::array<const Word*, 26> by_letter{};  ///< all but G and M, which may repeat
  std::array<int, kGroups> g{};             ///< tenths, or kNone
  bool tool_change = false, program_end = false, output = false;

  [[nodiscard]] const Word* operator[](char letter) const {
    return by_letter[static_cast<std::size_t>(letter - 'A')];
  }
  [[nodiscard]] int code(Group group) const { return g[static_cast<std::size_t>(group)]; }
  [[nodiscard]] bool moves_xy() const { return (*this)['X'] != nullptr || (*this)['Y'] != nullptr; }
  [[nodiscard]] bool has_axis() const { return moves_xy() || (*this)['Z'] != nullptr; }
};

Fault add_g(const Word& word, Words& words) {
  const auto tenths = tenths_of(word.value);
  const auto group = tenths ? group_of(*tenths) : std::nullopt;
  if (!group) return refused_g(word.value);
  int& slot = words.g[static_cast<std::size_t>(*group)];
  if (slot != kNone) return fmt::format("G{} and another G word of the same modal group", *tenths / 10);
  slot = *tenths;
  return {};
}

Fault add_m(const Word& word, Words& words) {
  const auto number = word.value.whole();
  if (!number || *number < 0 || *number > 999 || !m_on_list(static_cast<int>(*number)))
    return refused_m(word.value);
  words.tool_change = words.tool_change || *number == 6;
  words.program_end = words.program_end || *number == 2 || *number == 30;
  words.output = words.output || *number >= 62;
  return {};
}

Fault collect(const Block& block, Words& words) {
  words.g.fill(kNone);
  for (const Word& word : block.words) {
    if (Fault fault = refused_letter(word.letter)) return fault;
    if (word.letter == 'G') {
      if (Fault fault = add_g(word, words)) return fault;
    } else if (word.letter == 'M') {
      if (Fault fault = add_m(word, words)) return fault;
    } else {
      const Word*& slot = words.by_letter[static_cast<std::size_t>(word.letter - 'A')];
      if (slot != nullptr) return fmt::format("two {} words in one block", word.letter);
      slot = &word;
    }
  }
  return {};
}

class Interpreter {
 public:
  Interpreter(const Program& program, const RewriteOptions& options) : program_(program), options_(options) {
    modal_.unit = options.start_unit;
  }

  Fault run_block(std::size_t index) {
    const Block& block = program_.blocks[index];
    index_ = index;
    if (block.tape_mark && any_words_ && !result_.end_block) result_.end_block = index;
    if (block.words.empty()) return {};
    if (ended_) return "words after the end of the program (M2, M30)";

    Words words;
    if (Fault fault = collect(block, words)) return fault;
    if (block.block_delete) return check_skippable(block);
    if (Fault fault = check_program_number(block, words)) return fault;
    any_words_ = true;
    note_first_axis_block(words);
    if (Fault fault = set_modes(words)) return fault;
    if (Fault fault = check_companions(words)) return fault;
    if (Fault fault = move(words)) return fault;
    if (words.program_end) end_program(words);
    return {};
  }

  Interpretation take_result() {
    result_.cycle_at_end = is_cycle(modal_.motion);
    result_.compensation_at_end = modal_.compensation != 400;
    return std::move(result_);
  }

 private:
  std::size_t line() const { return program_.blocks[index_].line; }

  /// The machine decides whether a block that begins with / runs, so it may hold only what no later block
  /// depends on.
  Fault check_skippable(const Block& block) const {
    for (const Word& word : block.words) {
      const bool dwell = word.letter == 'G' && tenths_of(word.value) == 40;
      const bool harmless_m =
          word.letter == 'M' && word.value.whole() && m_may_be_skipped(static_cast<int>(*word.value.whole()));
      const bool harmless_letter = std::string_view("NPSF").find(word.letter) != std::string_view::npos;
      if (!dwell && !harmless_m && !harmless_letter)
        return fmt::format(
            "{} in a block that the / switch may skip: where the tool then stands is not known", word.letter);
    }
    return {};
  }

  /// `O1234` names a program on Fanuc controls; any other O word is a subprogram or a branch.
  Fault check_program_number(const Block& block, const Words& words) {
    if (words['O'] == nullptr) return {};
    if (block.words.size() != 1 || any_words_ || !words['O']->value.whole() || words['O']->has_point)
      return "O words (subprograms, branches) cannot be rewritten; let the CAM system write them out";
    result_.program_number = block.line;
    return {};
  }

  void note_first_axis_block(const Words& words) {
    const int compensation = words.code(Group::compensation);
    const bool first = !result_.first_axis_block && (words.has_axis() || compensation == 410 ||
                                                     compensation == 420 || words['I'] || words['J']);
    if (first) {
      result_.first_axis_block = index_;
      // An inserted line stands before the block: a unit word of the block itself comes too late for it,
      // unless the line can say the same because nothing was said so far.
      const bool says_unit = words.code(Group::unit) != kNone && !result_.unit_stated;
      result_.unit_at_first = says_unit ? unit_of(words) : modal_.unit;
      result_.incremental_at_first = modal_.incremental;
    }
    if (!result_.first_axis_block) {
      result_.unit_stated = result_.unit_stated || words.code(Group::unit) != kNone;
      result_.distance_stated = result_.distance_stated || words.code(Group::distance) != kNone;
      result_.plane_stated = result_.plane_stated || words.code(Group::plane) != kNone;
      result_.offset_stated = result_.offset_stated || words.code(Group::work_offset) != kNone;
    } else if (words.code(Group::work_offset) != kNone && !result_.late_work_offset) {
      result_.late_work_offset = line();
    }
    unit_ever_stated_ = unit_ever_stated_ || words.code(Group::unit) != kNone;
    const int plane = words.code(Group::plane);
    if (plane != kNone && plane != 170 && !result_.other_plane) result_.other_plane = line();
    if (words.code(Group::rotation_cancel) != kNone && !result_.rotation_cancel)
      result_.rotation_cancel = line();
  }

  static LengthUnit unit_of(const Words& words) {
    return words.code(Group::unit) == 200 ? LengthUnit::inch : LengthUnit::millimetre;
  }

  /// Modal words act before the motion of their block, wherever they stand in it.
  Fault set_modes(const Words& words) {
    if (words.code(Group::unit) != kNone) modal_.unit = unit_of(words);
    if (words.code(Group::plane) != kNone) modal_.plane = words.code(Group::plane);
    if (words.code(Group::distance) != kNone) modal_.incremental = words.code(Group::distance) == 910;
    if (words.code(Group::centre_distance) != kNone)
      modal_.absolute_centre = words.code(Group::centre_distance) == 901;
    if (Fault fault = set_motion(words)) return fault;
    if (words.code(Group::compensation) != kNone) modal_.compensation = words.code(Group::compensation);
    if (words.tool_change) modal_.x_known = modal_.y_known = false;
    if (modal_.compensation != 400) {
      if (modal_.plane != 170) return "G41 and G42 are rewritten in the XY plane (G17) only";
      note_once(
          compensation_noted_,
          fmt::format(
              "line {}: with G41/G42 the bound on rounding holds for the programmed contour; the control "
              "computes the tool's path from it",
              line()));
    }
    if (const int offset = words.code(Group::work_offset); offset != kNone)
      return set_work_offset(work_offset_of(offset));
    return {};
  }

  Fault set_motion(const Words& words) {
    const int motion = words.code(Group::motion);
    const bool cancels = words.code(Group::cycle_cancel) != kNone;
    if (cancels && is_cycle(motion)) return "G80 and a canned cycle in one block";
    if (motion != kNone)
      modal_.motion = motion;
    else if (cancels)
      modal_.motion = kMotionOff;
    return {};
  }

  Fault set_work_offset(int number) {
    if (number == options_.work_offset) return {};
    return fmt::format(
        "{0} is selected, but the motion is computed for {1}: several work offsets cannot be rewritten; "
        "if {0} is the only one, choose it (work offset {2}: --wcs {2})",
        work_offset_name(number), work_offset_name(options_.work_offset), number);
  }

  /// Refuses words that mean something only beside another one.
  Fault check_companions(const Words& words) const {
    const bool arc = modal_.motion == kClockwise || modal_.motion == kCounterClockwise;
    const bool cycle = is_cycle(modal_.motion);
    const bool arc_here = arc && (words.moves_xy() || words['I'] != nullptr || words['J'] != nullptr);
    const bool cycle_here = cycle && words.has_axis();
    const bool dwell = words.code(Group::dwell) != kNone;
    const int path = words.code(Group::path_control), length = words.code(Group::tool_length);
    const int compensation = words.code(Group::compensation);
    struct Rule {
      char letter;
      bool allowed;
      const char* beside;
    };
    const Rule rules[] = {
        {'I', arc, "G2 or G3"},
        {'J', arc, "G2 or G3"},
        {'R', arc || cycle_here, "G2, G3 or X, Y or Z of a canned cycle"},
        {'L', cycle_here, "X, Y or Z of a canned cycle"},
        {'P', arc_here || cycle_here || dwell || path == 640 || words.output,
         "G2, G3, G4, G64, a canned cycle or M62 to M65"},
        {'Q', cycle_here || path == 640, "G64 or a canned cycle"},
        {'H', length != kNone, "G43, G44 or G49"},
        {'D', compensation == 410 || compensation == 420, "G41 or G42"},
    };
    for (const Rule& rule : rules)
      if (words[rule.letter] != nullptr && !rule.allowed)
        return fmt::format("{} without {} in its block", rule.letter, rule.beside);
    if (dwell && (words.has_axis() || words['I'] != nullptr || words['J'] != nullptr))
      return "G4 beside axis words: some controls read X as seconds; give the dwell a block of its own";
    return {};
  }

  Fault move(const Words& words) {
    const bool centre_words = words['I'] != nullptr || words['J'] != nullptr;
    if (!words.has_axis() && !centre_words) {
      const bool radius_alone = words['R'] != nullptr;
      if (radius_alone) return "R without an end point";
      return {};
    }
    if (modal_.motion == kNone) return "axis words before any motion word: write G0 or G1 first";
    if (modal_.motion == kMotionOff) return "axis words while G80 is active: write G0 or G1";
    if (Fault fault = check_range(words)) return fault;
    switch (modal_.motion) {
      case kRapid:
      case kFeed:
        return move_line(words);
      case kClockwise:
      case kCounterClockwise:
        return move_arc(words);
      default:
        return drill(words);
    }
  }

  Fault check_range(const Words& words) const {
    for (const char letter : {'X', 'Y', 'Z', 'I', 'J', 'R'}) {
      const Word* word = words[letter];
      if (word == nullptr) continue;
      if (word->value.decimals > kMaxDecimals)
        return fmt::format("{} has more than {} decimals", letter, kMaxDecimals);
      const Grains length = to_grains(word->value, modal_.unit),
                   limit = kLargestCoordinate * quantum(modal_.unit, 0);
      if (length > limit || length < -limit)
        return fmt::format("{}{} is beyond {}", letter,
                           format_decimal(word->value.digits, word->value.decimals), kLargestCoordinate);
    }
    return {};
  }

  Motion begin_motion(const Words& words, MotionKind kind) const {
    Motion motion;
    motion.block = index_;
    motion.kind = kind;
    motion.unit = modal_.unit;
    motion.incremental = modal_.incremental;
    motion.start_known = modal_.x_known && modal_.y_known;
    motion.start = motion.end = modal_.position;
    motion.x = words['X'];
    motion.y = words['Y'];
    motion.i = words['I'];
    motion.j = words['J'];
    return motion;
  }

  /// Follows the X and Y words to the end of the motion; afterwards both coordinates are known.
  Fault reach(const Words& words, Motion& motion) {
    const auto apply = [&](const Word* word, Grains& coordinate, bool& known) {
      if (word == nullptr) return;
      const Grains length = to_grains(word->value, modal_.unit);
      coordinate = modal_.incremental ? coordinate + motion.repeats * length : length;
      known = known || !modal_.incremental;
    };
    apply(words['X'], motion.end.x, modal_.x_known);
    apply(words['Y'], motion.end.y, modal_.y_known);
    if (words.moves_xy() && (!modal_.x_known || !modal_.y_known))
      return modal_.incremental ? Fault(
                                      "an incremental move while X and Y are not known; begin, and go on "
                                      "after a tool change, "
                                      "with G90 and both X and Y")
                                : fmt::format(
                                      "moves in {} while {} is not known; give both X and Y in the first "
                                      "move, and in the first "
                                      "one after a tool change",
                                      words['X'] != nullptr ? 'X' : 'Y', words['X'] != nullptr ? 'Y' : 'X');
    const Grains limit = kLargestCoordinate * quantum(LengthUnit::inch, 0);
    for (const Grains coordinate : {motion.end.x, motion.end.y})
      if (coordinate > limit || coordinate < -limit)
        return fmt::format("leads further than {} inches from the origin", kLargestCoordinate);
    modal_.position = motion.end;
    return {};
  }

  Fault move_line(const Words& words) {
    if (modal_.motion == kFeed && !(modal_.x_known && modal_.y_known))
      note_once(
          unknown_start_noted_,
          fmt::format(
              "line {}: feeds from wherever the machine stands; that stretch is not part of the program's "
              "path and does not turn",
              line()));
    if (!words.moves_xy()) return {};
    Motion motion = begin_motion(words, MotionKind::line);
    if (Fault fault = reach(words, motion)) return fault;
    add(motion);
    return {};
  }

  Fault move_arc(const Words& words) {
    if (modal_.plane != 170)
      return "an arc outside the XY plane (G18, G19) does not stay in its plane when turned";
    if (!modal_.x_known || !modal_.y_known)
      return "an arc from a point that is not known; give both X and Y before it";
    const bool by_centre = words['I'] != nullptr || words['J'] != nullptr;
    if (by_centre == (words['R'] != nullptr))
      return by_centre ? "an arc with both a centre (I J) and a radius (R)"
                       : "an arc without centre (I J) or radius (R)";
    Motion motion = begin_motion(words, by_centre ? MotionKind::arc_by_centre : MotionKind::arc_by_radius);
    motion.clockwise = modal_.motion == kClockwise;
    motion.absolute_centre = modal_.absolute_centre;
    if (Fault fault = read_turns(words, motion)) return fault;
    if (Fault fault = by_centre ? read_centre(words, motion) : read_radius(words, motion)) return fault;
    if (Fault fault = reach(words, motion)) return fault;
    if (Fault fault = check_arc(motion)) return fault;
    add(motion);
    return {};
  }

  static Fault read_turns(const Words& words, Motion& motion) {
    if (words['P'] == nullptr) return {};
    const auto turns = words['P']->value.whole();
    if (!turns || *turns < 1 || *turns > kLargestRepeat)
      return "P of an arc must be a whole number of turns, at least 1";
    motion.turns = *turns;
    return {};
  }

  Fault read_centre(const Words& words, Motion& motion) const {
    if (motion.absolute_centre && (words['I'] == nullptr || words['J'] == nullptr))
      return "G90.1 needs both I and J";
    motion.centre = motion.absolute_centre ? GridPoint{} : motion.start;
    if (words['I'] != nullptr) motion.centre.x += to_grains(words['I']->value, modal_.unit);
    if (words['J'] != nullptr) motion.centre.y += to_grains(words['J']->value, modal_.unit);
    return {};
  }

  Fault read_radius(const Words& words, Motion& motion) const {
    if (!words.moves_xy()) return "an arc by radius without an end point in X or Y";
    motion.radius = to_grains(words['R']->value, modal_.unit);
    return {};
  }

  /// Refuses arcs that controls refuse, and those that they read in two ways.
  static Fault check_arc(const Motion& motion) {
    if (motion.kind == MotionKind::arc_by_radius) {
      if (motion.end == motion.start) return "an arc by radius that ends where it starts";
      if (motion.radius == 0 ||
          !radius_reaches(to_vector(motion.start), to_vector(motion.end), to_double_double(motion.radius)))
        return "the radius R is too small to reach the end point";
    }
    const Arc arc = motion_arc(motion);
    if (!radii_agree(arc, motion.unit))
      return fmt::format("the centre is {:.5f} mm from the start but {:.5f} mm from the end of the arc",
                         arc.start_radius, arc.end_radius);
    const double apart = std::min(arc.sweep, kTurn - arc.sweep);
    if (motion.end != motion.start && apart < kSmallestSweep)
      return fmt::format(
          "the ends of the arc differ, but seen from its centre by {:.1e} rad only: a control may run a "
          "full circle or nothing; give a full circle the same end as start",
          std::max(apart, 0.0));
    return {};
  }

  Fault drill(const Words& words) {
    if (modal_.plane != 170) return "a canned cycle outside the XY plane (G18, G19)";
    if (modal_.compensation != 400) return "a canned cycle while G41 or G42 is active";
    Motion motion = begin_motion(words, MotionKind::cycle);
    if (words['L'] != nullptr) {
      const auto repeats = words['L']->value.whole();
      if (!repeats || *repeats < 1 || *repeats > kLargestRepeat)
        return fmt::format("L of a canned cycle must be a whole number from 1 to {}", kLargestRepeat);
      if (modal_.incremental) motion.repeats = *repeats;
    }
    if (!words.moves_xy() && !motion.start_known)
      return "a canned cycle while X and Y are not known; give both";
    if (Fault fault = reach(words, motion)) return fault;
    if (words.moves_xy()) add(motion);
    return {};
  }

  void add(const Motion& motion) {
    if (!unit_ever_stated_)
      note_once(unit_noted_,
                fmt::format("the program names no unit before line {}: {} assumed ({} must be active)",
                            line(), modal_.unit == LengthUnit::inch ? "inches are" : "millimetres are",
                            modal_.unit == LengthUnit::inch ? "G20" : "G21"));
    for (const Word* word : {motion.x, motion.y, motion.i, motion.j})
      if (word != nullptr && !word->has_point && word->value.digits != 0)
        note_once(point_noted_,
                  fmt::format("line {}: {}{} has no decimal point and is read as a whole number of {}; some "
                              "controls read it as increments",
                              line(), word->letter, word->value.digits,
                              modal_.unit == LengthUnit::inch ? "inches" : "millimetres"));
    result_.motions.push_back(motion);
  }

  void end_program(const Words& words) {
    ended_ = true;
    result_.end_block = index_;
    result_.end_moves = words.has_axis() || words['I'] != nullptr || words['J'] != nullptr;
  }

  void note_once(bool& noted, std::string text) {
    if (!noted) result_.notes.push_back(std::move(text));
    noted = true;
  }

  const Program& program_;
  const RewriteOptions& options_;
  Modal modal_;
  Interpretation result_;
  std::size_t index_ = 0;
  bool any_words_ = false, ended_ = false, unit_ever_stated_ = false;
  bool compensation_noted_ = false, unknown_start_noted_ = false, unit_noted_ = false, point_noted_ = false;
};

}  // namespace

Result<Interpretation> interpret(const Program& program, const std::string& name,
                                 const RewriteOptions& options) {
  Interpreter interpreter(program, options);
  for (std::size_t index = 0; index < program.blocks.size(); ++index)
    if (Fault fault = interpreter.run_block(index)) return refusal(name, program.blocks[index].line, *fault);
  return interpreter.take_result();
}

}  // namespace lekalo::nc

#include "interpreter.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "interpreter_state.hpp"
#include "lekalo/base/stop.hpp"

namespace lekalo::nc {

using words::Control;
using words::Group;

Fault Interpreter::run_block(std::size_t index) {
  const Block& block = program_.blocks[index];
  index_ = index;
  if (block.tape_mark && any_words_ && !result_.end_block) result_.end_block = index;
  if (block.words.empty()) return {};
  if (ended_) return "words after the end of the program (M2, M30)";

  BlockWords words;
  if (Fault fault = collect(block, control_, options_.allowed_m, words)) return fault;
  if (block.block_delete) {
    if (Fault fault = check_skippable(block)) return fault;
    return check_takers(words, control_, nullptr);
  }
  if (Fault fault = check_program_number(block, words)) return fault;
  any_words_ = true;
  note_first_axis_block(words);
  note_rotary(words);
  if (Fault fault = set_modes(words)) return fault;
  if (Fault fault = check_dwell(words)) return fault;
  if (Fault fault = check_takers(words, control_, modal_.motion)) return fault;
  if (options_.z)
    if (Fault fault = follow_height(words)) return fault;
  if (!words.dwells())
    if (Fault fault = words.goes_to_machine() ? go_to_machine(words) : move(words)) return fault;
  if (words.program_end) end_program(words);
  return {};
}

Interpretation Interpreter::take_result() {
  result_.cycle_at_end = on_cycle();
  result_.compensation_at_end = modal_.compensation != 400;
  return std::move(result_);
}

/// `O1234` names a program on most controls; any other O word is a subprogram or a branch.
Fault Interpreter::check_program_number(const Block& block, const BlockWords& words) {
  if (words['O'] == nullptr) return {};
  if (block.words.size() != 1 || any_words_ || !words['O']->value.whole() || words['O']->has_point)
    return "O words (subprograms, branches) cannot be rewritten; let the CAM system write them out";
  result_.program_number = block.line;
  return {};
}

namespace {

LengthUnit unit_of(const BlockWords& words) {
  return words.code(Group::unit) == 200 ? LengthUnit::inch : LengthUnit::millimetre;
}

/// True when the block depends on where X, Y and Z are counted from.
bool depends_on_frame(const BlockWords& words) {
  const int compensation = words.code(Group::compensation);
  if (compensation == 410 || compensation == 420) return true;
  return !words.dwells() && !words.goes_to_machine() && (words.has_axis() || words.has_centre());
}

}  // namespace

void Interpreter::note_first_axis_block(const BlockWords& words) {
  if (!result_.first_axis_block && depends_on_frame(words)) {
    result_.first_axis_block = index_;
    // An inserted line stands before the block: a unit word of the block itself comes too late for it,
    // unless the line can say the same because nothing was said so far.
    const bool says_unit = words.word(Group::unit) != nullptr && !result_.unit_stated;
    result_.unit_at_first = says_unit ? unit_of(words) : modal_.unit;
    result_.incremental_at_first = modal_.incremental;
  }
  if (!result_.first_axis_block) {
    result_.unit_stated = result_.unit_stated || words.word(Group::unit) != nullptr;
    result_.distance_stated = result_.distance_stated || words.word(Group::distance) != nullptr;
    result_.plane_stated = result_.plane_stated || words.word(Group::plane) != nullptr;
    result_.offset_stated = result_.offset_stated || words.word(Group::work_offset) != nullptr;
  }
  note_modes(words);
}

void Interpreter::note_modes(const BlockWords& words) {
  unit_ever_stated_ = unit_ever_stated_ || words.word(Group::unit) != nullptr;
  const int plane = words.code(Group::plane), motion = words.code(Group::motion);
  if (plane != kNoCode && plane != 170 && !result_.other_plane) result_.other_plane = line();
  if (words.word(Group::rotation) != nullptr && !result_.rotation_cancel) result_.rotation_cancel = line();
  if ((motion == 760 || motion == 870) && !result_.sideways_bore) result_.sideways_bore = line();
}

void Interpreter::note_rotary(const BlockWords& words) {
  for (const char axis : {'A', 'B', 'C'})
    if (words[axis] != nullptr)
      note_once(rotary_noted_,
                fmt::format("line {0}: {1} must stand at 0 when the program begins", line(), axis));
}

/// Modal words act before the motion of their block, wherever they stand in it.
Fault Interpreter::set_modes(const BlockWords& words) {
  if (words.word(Group::unit) != nullptr) modal_.unit = unit_of(words);
  if (words.word(Group::plane) != nullptr) modal_.plane = words.code(Group::plane);
  if (words.word(Group::distance) != nullptr) modal_.incremental = words.code(Group::distance) == 910;
  if (words.word(Group::centre) != nullptr) modal_.absolute_centre = words.code(Group::centre) == 901;
  if (words.word(Group::feed_mode) != nullptr) modal_.inverse_time = words.code(Group::feed_mode) == 930;
  if (Fault fault = set_motion(words)) return fault;
  if (words.word(Group::compensation) != nullptr) modal_.compensation = words.code(Group::compensation);
  if (words.tool_change) modal_.x_known = modal_.y_known = false;
  const int length = words.code(Group::tool_length);
  if (words.tool_change || length != kNoCode) modal_.z_known = modal_.z_follows = false;
  // Without a length the tool stays up where it is.
  if (words.tool_change || length == 430 || length == 440) modal_.z_home = false;
  if (modal_.compensation != 400) {
    if (modal_.plane != 170) return "G41 and G42 are rewritten in the XY plane (G17) only";
    note_once(compensation_noted_,
              fmt::format("line {}: with G41/G42 the bound on rounding holds for the programmed contour; the "
                          "control computes the tool's path from it",
                          line()));
  }
  return set_work_offset(words);
}

Fault Interpreter::set_motion(const BlockWords& words) {
  const words::Word* const motion = words.word(Group::motion);
  const bool cancels = words.word(Group::motion_off) != nullptr;
  if (cancels && motion != nullptr && is_cycle(motion->tenths)) return "G80 and a canned cycle in one block";
  if (motion != nullptr || cancels) modal_.motion = motion;
  modal_.motion_off = modal_.motion == nullptr && (cancels || modal_.motion_off);
  return {};
}

/// With a scan in machine coordinates every offset has to be zero in X and Y, so it does not matter which one
/// is selected. Else, and where the control turns the frame of one offset, the program may use that one only.
Fault Interpreter::set_work_offset(const BlockWords& words) {
  const words::Word* const word = words.word(Group::work_offset);
  if (word == nullptr) return {};
  const int number = work_offset_of(word->tenths);
  const bool any = options_.mode == RewriteMode::coordinates && options_.scan_frame == ScanFrame::machine;
  if (number != options_.work_offset && !any)
    return fmt::format(
        "{0} is selected, but the motion is computed for {1}: several work offsets cannot be rewritten; "
        "if {0} is the only one, choose it (work offset {2}: --wcs {2})",
        work_offset_name(number), work_offset_name(options_.work_offset), number);
  if (std::ranges::find(result_.offsets, number) == result_.offsets.end()) result_.offsets.push_back(number);
  if (result_.first_axis_block)
    for (const Word& each : program_.blocks[index_].words)
      if (each.letter == 'G' && listed(each, control_) == word) result_.late_offsets.push_back(&each);
  // Another offset is another frame: where the tool stands in it is not said.
  if (offset_ != 0 && offset_ != number)
    modal_.x_known = modal_.y_known = modal_.z_known = modal_.z_follows = false;
  offset_ = number;
  return {};
}

/// Some controls read X beside G4 as seconds; others take any axis word for a move.
Fault Interpreter::check_dwell(const BlockWords& words) const {
  if (!words.dwells()) return {};
  const bool seconds = words.word(Group::once)->takes.find('X') != std::string_view::npos;
  const bool moves = words['Y'] != nullptr || words['Z'] != nullptr || words.has_centre() ||
                     words.has_rotary() || (words['X'] != nullptr && !seconds);
  if (moves)
    return "G4 beside axis words: some controls read X as seconds; give the dwell a block of its own";
  return {};
}

void Interpreter::end_program(const BlockWords& words) {
  ended_ = true;
  result_.end_block = index_;
  result_.end_moves = words.has_axis() || words.has_centre();
}

void Interpreter::note_once(bool& noted, std::string text) {
  if (!noted) result_.notes.push_back(std::move(text));
  noted = true;
}

Result<Interpretation> interpret(const Program& program, const std::string& name,
                                 const RewriteOptions& options, Control control) {
  Interpreter interpreter(program, options, control);
  for (std::size_t index = 0; index < program.blocks.size(); ++index) {
    ask();
    if (Fault fault = interpreter.run_block(index)) return refusal(name, program.blocks[index].line, *fault);
  }
  return interpreter.take_result();
}

}  // namespace lekalo::nc

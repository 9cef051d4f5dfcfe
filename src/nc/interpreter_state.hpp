#pragma once

#include <string>

#include "block_words.hpp"
#include "interpreter.hpp"

namespace lekalo::nc {

/// The state of the control that later blocks depend on.
struct Modal {
  LengthUnit unit = LengthUnit::millimetre;
  /// The motion in force; null before any, and after G80.
  const words::Word* motion = nullptr;
  bool motion_off = false;  ///< G80
  int plane = 170;
  int compensation = 400;
  bool incremental = false, absolute_centre = false, inverse_time = false;
  bool x_known = false, y_known = false, z_known = false;
  GridPoint position;
  Grains z = 0;
  bool z_home = false;       ///< Z stands at a point of the machine, above everything
  bool z_follows = false;    ///< Z is known, or was before cycles that begin and end by it
  bool cycle_steps = false;  ///< the cycle's Z and R were said under G91
};

/// Follows a program block by block. interpreter.cpp has its modes, interpreter_moves.cpp its motions.
class Interpreter {
 public:
  Interpreter(const Program& program, const RewriteOptions& options, words::Control control)
      : program_(program), options_(options), control_(control) {
    modal_.unit = options.start_unit;
  }

  Fault run_block(std::size_t index);
  Interpretation take_result();

 private:
  [[nodiscard]] std::size_t line() const { return program_.blocks[index_].line; }
  [[nodiscard]] bool on_motion(int tenths) const {
    return modal_.motion != nullptr && modal_.motion->tenths == tenths;
  }
  [[nodiscard]] bool on_arc() const {
    return on_motion(words::kClockwise) || on_motion(words::kCounterClockwise);
  }
  [[nodiscard]] bool on_cycle() const { return modal_.motion != nullptr && is_cycle(modal_.motion->tenths); }

  Fault check_program_number(const Block& block, const BlockWords& words);
  void note_first_axis_block(const BlockWords& words);
  void note_modes(const BlockWords& words);
  Fault set_modes(const BlockWords& words);
  Fault set_motion(const BlockWords& words);
  Fault set_work_offset(const BlockWords& words);
  Fault check_dwell(const BlockWords& words) const;
  void note_rotary(const BlockWords& words);
  void end_program(const BlockWords& words);
  void note_once(bool& noted, std::string text);

  Fault go_to_machine(const BlockWords& words);
  Fault move(const BlockWords& words);
  Fault check_range(const BlockWords& words) const;
  [[nodiscard]] Motion begin_motion(const BlockWords& words, MotionKind kind) const;
  Fault reach(const BlockWords& words, Motion& motion);
  void reach_z(const BlockWords& words);
  Fault follow_height(const BlockWords& words);
  Fault follow_height_to_machine(const BlockWords& words);
  Fault follow_cycle(const BlockWords& words);
  [[nodiscard]] Fault step_from_height() const;
  void add_height(const Word* word);
  void note_unit();
  void note_point(const Word* word);
  Fault move_line(const BlockWords& words);
  Fault move_arc(const BlockWords& words);
  Fault read_turns(const BlockWords& words, Motion& motion) const;
  Fault read_centre(const BlockWords& words, Motion& motion) const;
  Fault read_radius(const BlockWords& words, Motion& motion) const;
  Fault drill(const BlockWords& words);
  Fault read_repeats(const BlockWords& words, Motion& motion, bool& drills) const;
  void add(const Motion& motion);

  const Program& program_;
  const RewriteOptions& options_;
  words::Control control_;
  Modal modal_;
  Interpretation result_;
  std::size_t index_ = 0;
  int offset_ = 0;  ///< the work offset last selected; 0: none yet
  bool any_words_ = false, ended_ = false, unit_ever_stated_ = false;
  bool compensation_noted_ = false, unknown_start_noted_ = false, unit_noted_ = false, point_noted_ = false,
       rotary_noted_ = false, machine_noted_ = false;
};

}  // namespace lekalo::nc

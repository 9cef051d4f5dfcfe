// The motions of a program: lines, arcs, cycles and ways to points of the machine.

#include <fmt/core.h>

#include <algorithm>

#include "arc.hpp"
#include "interpreter_state.hpp"
#include "lekalo/base/angle.hpp"

namespace lekalo::nc {
namespace {

using words::Control;

/// A coordinate beyond this many millimetres or inches is taken for a slip, and would not fit a control.
constexpr std::int64_t kLargestCoordinate = 1'000'000;
constexpr std::int64_t kLargestRepeat = 10'000;

constexpr const char* kSendHome =
    "it moves X and Y to a point of the machine while Z stands where the program left it; send Z home in a "
    "block before (G28 G91 Z0 or G53 G0 Z0)";

/// Refuses arcs that controls refuse, and those that they read in two ways.
Fault check_arc(const Motion& motion, Control control) {
  if (motion.kind == MotionKind::arc_by_radius) {
    const auto [start, end] = arc_ends(motion);
    if (same_point(start, end)) return "an arc by radius that ends where it starts";
    if (motion.radius == 0 || !radius_reaches(start, end, to_double_double(motion.radius)))
      return "the radius R is too small to reach the end point";
  }
  const Arc arc = motion_arc(motion);
  if (!radii_agree(arc, motion.unit) && !(control != Control::linuxcnc && radii_nearly_agree(arc)))
    return fmt::format("the centre is {:.5f} mm from the start but {:.5f} mm from the end of the arc",
                       arc.start_radius, arc.end_radius);
  const double apart = std::min(arc.sweep, kTurn - arc.sweep);
  if (!same_point(arc.start, arc.end) && apart < kSmallestSweep)
    return fmt::format(
        "the ends of the arc differ, but seen from its centre by {:.1e} rad only: a control may run a "
        "full circle or nothing; give a full circle the same end as start",
        std::max(apart, 0.0));
  return {};
}

bool is_zero(const Word* word) { return word == nullptr || word->value.digits == 0; }

}  // namespace

/// G28, G30 and G53 go to points of the machine, which do not turn with the part. A way along Z alone means
/// the same wherever the part lies. One in X and Y may only be made with Z out of the way.
Fault Interpreter::go_to_machine(const BlockWords& words) {
  const words::Word& code = *words.word(words::Group::once);
  const bool frame = code.tenths == words::kMachineFrame;
  if (modal_.compensation != 400) return fmt::format("G{} while G41 or G42 is active", code.tenths / 10);
  if (frame && !(on_motion(words::kRapid) || on_motion(words::kFeed))) return "G53 without G0 or G1";
  if (frame && modal_.incremental) return "G53 under G91, where controls differ; write G90";
  if (frame && !words.has_axis()) return {};
  if (Fault fault = check_range(words)) return fault;
  if (result_.first_axis_block) result_.machine_blocks.push_back(index_);
  const bool all = !words.has_axis();
  if (words.moves_xy() || all) {
    if (!modal_.z_home) return fmt::format("G{}: {}", code.tenths / 10, kSendHome);
    if (!frame && !all && !(modal_.incremental && is_zero(words['X']) && is_zero(words['Y'])))
      return fmt::format("G{}: it goes by a point of the program; write G91 X0 Y0, which goes by none",
                         code.tenths / 10);
    if (all || words['X'] != nullptr) modal_.x_known = false;
    if (all || words['Y'] != nullptr) modal_.y_known = false;
    note_once(machine_noted_,
              fmt::format("line {}: with Z home the tool goes to a point of the machine, from wherever the "
                          "part lies",
                          line()));
  }
  if (words['Z'] == nullptr) return {};
  modal_.z_known = false;
  modal_.z_home = !frame || is_zero(words['Z']);
  return {};
}

Fault Interpreter::move(const BlockWords& words) {
  if (!words.has_axis() && !words.has_centre()) {
    if (words['R'] != nullptr && on_arc()) return "R without an end point";
    // Controls read such a word as a motion, and an arc or a cycle needs more words than that.
    if (words.has_rotary() && !(on_motion(words::kRapid) || on_motion(words::kFeed)))
      return "a rotary axis alone while neither G0 nor G1 is active: write G0 before it";
    return {};
  }
  if (modal_.motion == nullptr)
    return modal_.motion_off ? "axis words while G80 is active: write G0 or G1"
                             : "axis words before any motion word: write G0 or G1 first";
  if (Fault fault = check_range(words)) return fault;
  if (on_cycle()) return drill(words);
  if (on_arc()) return move_arc(words);
  if (Fault fault = move_line(words)) return fault;
  reach_z(words);
  return {};
}

Fault Interpreter::check_range(const BlockWords& words) const {
  for (const char letter : {'X', 'Y', 'Z', 'I', 'J', 'K', 'R'}) {
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

Motion Interpreter::begin_motion(const BlockWords& words, MotionKind kind) const {
  Motion motion;
  motion.block = index_;
  motion.kind = kind;
  motion.unit = modal_.unit;
  motion.incremental = modal_.incremental;
  motion.inverse_time = modal_.inverse_time;
  motion.start_known = modal_.x_known && modal_.y_known;
  motion.start = motion.end = modal_.position;
  motion.x = words['X'];
  motion.y = words['Y'];
  const bool turns = kind == MotionKind::arc_by_centre || kind == MotionKind::arc_by_radius;
  motion.i = turns ? words['I'] : nullptr;
  motion.j = turns ? words['J'] : nullptr;
  return motion;
}

/// Follows the X and Y words to the end of the motion; afterwards both coordinates are known.
Fault Interpreter::reach(const BlockWords& words, Motion& motion) {
  const auto apply = [&](const Word* word, Grains& coordinate, bool& known) {
    if (word == nullptr) return;
    const Grains length = to_grains(word->value, modal_.unit);
    coordinate = modal_.incremental ? coordinate + motion.repeats * length : length;
    known = known || !modal_.incremental;
  };
  apply(words['X'], motion.end.x, modal_.x_known);
  apply(words['Y'], motion.end.y, modal_.y_known);
  if (words.moves_xy() && (!modal_.x_known || !modal_.y_known))
    return modal_.incremental
               ? Fault(
                     "an incremental move while X and Y are not known; begin, and go on after a tool change, "
                     "with G90 and both X and Y")
               : fmt::format(
                     "moves in {} while {} is not known; give both X and Y in the first move, and in the "
                     "first one after a tool change",
                     words['X'] != nullptr ? 'X' : 'Y', words['X'] != nullptr ? 'Y' : 'X');
  const Grains limit = kLargestCoordinate * quantum(LengthUnit::inch, 0);
  for (const Grains coordinate : {motion.end.x, motion.end.y})
    if (coordinate > limit || coordinate < -limit)
      return fmt::format("leads further than {} inches from the origin", kLargestCoordinate);
  modal_.position = motion.end;
  return {};
}

/// Z of a line or an arc. Only arcs outside the XY plane need to know it.
void Interpreter::reach_z(const BlockWords& words) {
  const Word* const word = words['Z'];
  if (word == nullptr) return;
  const Grains limit = kLargestCoordinate * quantum(LengthUnit::inch, 0);
  modal_.z = (modal_.incremental ? modal_.z : 0) + to_grains(word->value, modal_.unit);
  modal_.z_known = (modal_.z_known || !modal_.incremental) && modal_.z <= limit && modal_.z >= -limit;
  modal_.z_home = false;
}

/// Shifts heights of a solid's program: every word that says one is found, and steps have to begin at one.
Fault Interpreter::follow_height(const BlockWords& words) {
  if (words.dwells()) return {};
  if (words.goes_to_machine()) return follow_height_to_machine(words);
  if (!words.has_axis() && !words.has_centre()) return {};
  if (on_cycle()) return follow_cycle(words);
  const Word* const z = words['Z'];
  if (z != nullptr && modal_.incremental)
    if (Fault fault = step_from_height()) return fault;
  if (z != nullptr && !modal_.incremental) add_height(z);
  const bool known = modal_.z_known || z != nullptr;
  modal_.z_follows = modal_.z_follows || known;
  if (!known && (on_arc() || on_motion(words::kFeed)))
    return "it cuts at a Z that the program has not said, so it cannot be shifted along Z; give Z before";
  return {};
}

/// G28 and G30 go by the height that their Z says, and G53 has a height of the machine.
Fault Interpreter::follow_height_to_machine(const BlockWords& words) {
  const words::Word& code = *words.word(words::Group::once);
  const Word* const z = words['Z'];
  if (z != nullptr && code.tenths != words::kMachineFrame) {
    const bool in_frame = options_.mode == RewriteMode::coordinates || result_.first_axis_block;
    if (!modal_.incremental && !in_frame)
      return fmt::format("G{} by a height of the program before its first motion; write G91 Z0",
                         code.tenths / 10);
    if (!modal_.incremental) add_height(z);
    if (modal_.incremental && !is_zero(z))
      if (Fault fault = step_from_height()) return fault;
  }
  if (z != nullptr || !words.has_axis()) modal_.z_follows = false;
  return {};
}

/// The control keeps Z and R of a cycle as numbers, so that they change their meaning with G90 and G91.
Fault Interpreter::follow_cycle(const BlockWords& words) {
  const Word *const z = words['Z'], *const r = words['R'];
  if (!modal_.z_follows)
    return "a canned cycle from a Z that the program has not said, so it cannot be shifted along Z; give Z "
           "before";
  const bool both = z != nullptr && r != nullptr;
  if (!both && modal_.cycle_steps != modal_.incremental)
    return "a canned cycle goes on under another of G90 and G91, where controls differ what its Z and R are; "
           "give both again";
  if (z != nullptr || r != nullptr) modal_.cycle_steps = modal_.incremental;
  if (modal_.incremental) return {};
  for (const Word* const word : {z, r})
    if (word != nullptr) add_height(word);
  return {};
}

Fault Interpreter::step_from_height() const {
  if (modal_.z_known) return {};
  return "a step along Z from a Z that the program has not said, so it cannot be shifted; give Z in G90 "
         "before";
}

void Interpreter::add_height(const Word* word) {
  note_unit();
  note_point(word);
  result_.heights.push_back({index_, word, modal_.unit});
}

Fault Interpreter::move_line(const BlockWords& words) {
  if (on_motion(words::kFeed) && !(modal_.x_known && modal_.y_known))
    note_once(unknown_start_noted_,
              fmt::format("line {}: feeds from wherever the machine stands; that stretch is not part of the "
                          "program's path and does not turn",
                          line()));
  if (!words.moves_xy()) return {};
  Motion motion = begin_motion(words, MotionKind::line);
  if (Fault fault = reach(words, motion)) return fault;
  add(motion);
  return {};
}

Fault Interpreter::move_arc(const BlockWords& words) {
  if (!modal_.x_known || !modal_.y_known)
    return "an arc from a point that is not known; give both X and Y before it";
  if (modal_.plane != 170 && !modal_.z_known)
    return "an arc outside the XY plane from a Z that is not known; give Z before it";
  const char across = modal_.plane == 170 ? 'K' : modal_.plane == 180 ? 'J' : 'I';
  if (words[across] != nullptr)
    return fmt::format("{} beside an arc of G{}, which has no such centre", across, modal_.plane / 10);
  const bool by_centre = words.has_centre();
  if (by_centre == (words['R'] != nullptr))
    return by_centre ? "an arc with both a centre (I J) and a radius (R)"
                     : "an arc without centre (I J) or radius (R)";
  Motion motion = begin_motion(words, by_centre ? MotionKind::arc_by_centre : MotionKind::arc_by_radius);
  motion.clockwise = on_motion(words::kClockwise);
  motion.absolute_centre = modal_.absolute_centre;
  motion.plane = modal_.plane;
  motion.start_z = modal_.z;
  if (Fault fault = read_turns(words, motion)) return fault;
  if (Fault fault = by_centre ? read_centre(words, motion) : read_radius(words, motion)) return fault;
  if (Fault fault = reach(words, motion)) return fault;
  reach_z(words);
  motion.end_z = modal_.z;
  if (motion.plane != 170 && !modal_.z_known) return "Z leads too far";
  if (Fault fault = check_arc(motion, control_)) return fault;
  add(motion);
  return {};
}

Fault Interpreter::read_turns(const BlockWords& words, Motion& motion) const {
  if (words['P'] == nullptr || words.dwells()) return {};
  const auto turns = words['P']->value.whole();
  if (!turns || *turns < 1 || *turns > kLargestRepeat)
    return "P of an arc must be a whole number of turns, at least 1";
  motion.turns = *turns;
  return {};
}

Fault Interpreter::read_centre(const BlockWords& words, Motion& motion) const {
  const bool flat = motion.plane == 170;
  const Word* const i = words['I'];
  const Word* const j = words['J'];
  const Word* const k = words['K'];
  const int given = (i != nullptr) + (j != nullptr) + (k != nullptr);
  if (motion.absolute_centre && given != 2)
    return flat ? "G90.1 needs both I and J" : "G90.1 needs both words of the centre";
  motion.centre = motion.absolute_centre ? GridPoint{} : motion.start;
  motion.centre_z = motion.absolute_centre ? 0 : motion.start_z;
  if (i != nullptr) motion.centre.x += to_grains(i->value, modal_.unit);
  if (j != nullptr) motion.centre.y += to_grains(j->value, modal_.unit);
  if (k != nullptr) motion.centre_z += to_grains(k->value, modal_.unit);
  return {};
}

Fault Interpreter::read_radius(const BlockWords& words, Motion& motion) const {
  if (motion.plane == 170 && !words.moves_xy()) return "an arc by radius without an end point in X or Y";
  motion.radius = to_grains(words['R']->value, modal_.unit);
  return {};
}

Fault Interpreter::drill(const BlockWords& words) {
  if (modal_.plane != 170) return "a canned cycle outside the XY plane (G18, G19)";
  if (modal_.compensation != 400) return "a canned cycle while G41 or G42 is active";
  Motion motion = begin_motion(words, MotionKind::cycle);
  bool drills = true;
  if (Fault fault = read_repeats(words, motion, drills)) return fault;
  if (!words.moves_xy() && !motion.start_known)
    return "a canned cycle while X and Y are not known; give both";
  if (Fault fault = reach(words, motion)) return fault;
  if (!drills && !(motion.start_known && motion.end == motion.start))
    return "no hole (L0, K0) beside another X or Y: controls differ whether the tool goes there; take X and "
           "Y "
           "out";
  modal_.z_known = modal_.z_home = false;
  if (words.moves_xy()) add(motion);
  return {};
}

Fault Interpreter::read_repeats(const BlockWords& words, Motion& motion, bool& drills) const {
  for (const char letter : {'L', 'K'}) {
    if (words[letter] == nullptr || (letter == 'K' && control_ == Control::haas)) continue;
    const std::int64_t least = control_ == Control::linuxcnc ? 1 : 0;
    const auto repeats = words[letter]->value.whole();
    if (letter == 'K' && control_ == Control::linuxcnc)
      return "K beside a canned cycle, where LinuxCNC repeats by L";
    if (!repeats || *repeats < least || *repeats > kLargestRepeat)
      return fmt::format("{} of a canned cycle must be a whole number from {} to {}", letter, least,
                         kLargestRepeat);
    drills = *repeats != 0;
    if (modal_.incremental && drills) motion.repeats = *repeats;
  }
  return {};
}

void Interpreter::add(const Motion& motion) {
  note_unit();
  for (const Word* word : {motion.x, motion.y, motion.i, motion.j})
    if (word != nullptr) note_point(word);
  result_.motions.push_back(motion);
}

void Interpreter::note_unit() {
  if (unit_ever_stated_) return;
  note_once(unit_noted_,
            fmt::format("the program names no unit before line {}: {} assumed ({} must be active)", line(),
                        modal_.unit == LengthUnit::inch ? "inches are" : "millimetres are",
                        modal_.unit == LengthUnit::inch ? "G20" : "G21"));
}

void Interpreter::note_point(const Word* word) {
  if (word->has_point || word->value.digits == 0) return;
  note_once(point_noted_,
            fmt::format("line {}: {}{} has no decimal point and is read as a whole number of {}; some "
                        "controls read it as increments",
                        line(), word->letter, word->value.digits,
                        modal_.unit == LengthUnit::inch ? "inches" : "millimetres"));
}

}  // namespace lekalo::nc

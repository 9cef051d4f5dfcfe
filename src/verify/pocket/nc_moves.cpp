#include "nc_moves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "nc_arc.hpp"
#include "nc_block.hpp"
#include "nc_cycle.hpp"
#include "nc_flow.hpp"
#include "nc_program.hpp"

namespace lekalo::verify {
namespace {

using words::Control;
using words::Group;
using words::kClockwise;
using words::kCounterClockwise;
using words::kFeed;
using words::kRapid;

constexpr double kFarthest = limits::kLargestProgramCoordinate;  // mm
constexpr std::array<char, 3> kAxes{'X', 'Y', 'Z'};
constexpr double kMostPecks = 10'000;

bool is_arc(const words::Word* code) {
  return code != nullptr && (code->tenths == kClockwise || code->tenths == kCounterClockwise);
}
bool is_line(const words::Word* code) {
  return code != nullptr && (code->tenths == kRapid || code->tenths == kFeed);
}
bool is_cycle(const words::Word* code) { return code != nullptr && code->tenths > kCounterClockwise; }
bool takes(const words::Word& code, char letter) { return code.takes.find(letter) != std::string_view::npos; }
bool is_number_of_turns(double value) {
  return value >= 1 && value <= kMostPecks && value == std::floor(value);
}

class ProgramReader {
 public:
  ProgramReader(const Document& program, const NcReading& reading)
      : program_(program),
        top_(reading.top),
        control_(reading.control),
        judged_(reading.judged),
        heights_apart_(reading.heights_apart),
        lines_(reading.control, reading.allowed_m) {}

  Result<NcProgram> read() {
    LEKALO_TRY(const std::vector<NcLine> order, lines_in_order(program_, control_));
    for (const NcLine& line : order) {
      ask();
      line_ = line.number;
      NcBlock block;
      block.line = line.number;
      if (!lines_.read(line.text, line.in_subprogram, block))
        complain(lines_.complaint());
      else if (!block.empty())
        act(block);
      if (!complaint_.empty()) break;
    }
    if (!complaint_.empty())
      return failure(ErrorCode::bad_input, fmt::format("{}:{}: {}", program_.name, line_, complaint_));
    return NcProgram{std::move(moves_), std::move(events_), std::move(dwells_)};
  }

 private:
  bool complain(const std::string& sentence) {
    if (complaint_.empty()) complaint_ = sentence;
    return false;
  }

  [[nodiscard]] bool is_known() const { return known_[0] && known_[1] && known_[2]; }

  /// Refuses blocks whose words do not fit together, and those that make a path that nobody here knows.
  bool fits(const NcBlock& block) {
    const words::Word* motion = block.code(Group::motion);
    const words::Word* once = block.code(Group::once);
    const bool moves = motion != nullptr || block.has_axis() || block.has_rotary();
    if (once != nullptr && once->tenths == words::kDwell && moves &&
        !(takes(*once, 'X') && !block['Y'] && !block['Z'] && !block.has_rotary()))
      return complain("a dwell beside a motion; give it a block of its own");
    const bool off = block.code(Group::motion_off) != nullptr;
    if (is_cycle(motion) && !block.has_axis())
      return complain(fmt::format("{} without X, Y or Z", name_of(*motion)));
    if (off && motion != nullptr && (control_ == Control::linuxcnc || is_cycle(motion)))
      return complain(fmt::format("{} and {} exclude each other", name_of(*block.code(Group::motion_off)),
                                  name_of(*motion)));
    for (const words::Word* code : block.codes)
      if (judged_ && !code->judged)
        return complain(
            fmt::format("{} makes the control compute path or feed, which is not judged", name_of(*code)));
    // A whole number means millimetres or thousandths by a setting of the control. K beside a cycle counts
    // holes.
    if (const std::size_t at = block.pointless.find_first_of(
            is_cycle(motion == nullptr ? motion_ : motion) ? "XYZIJRQ" : "XYZIJKRQ");
        judged_ && at != std::string::npos && (control_ == Control::haas || control_ == Control::fanuc))
      return complain(fmt::format("{0} has no decimal point, and {1} controls may count it in thousandths",
                                  block.pointless[at], name_of(control_)));
    // A rotary word alone makes no arc and no hole, so only a line in force takes it.
    const bool carries = block.has_axis() || is_line(motion_);
    const words::Word* carried = motion == nullptr && carries && !off ? motion_ : nullptr;
    for (const char letter : words::kTakenLetters)
      if (block[letter] && !has_one_taker(block, letter, carried)) return false;
    const bool takes_d = words::is_taken('D', control_);
    return !block['D'] || !takes_d || has_one_taker(block, 'D', nullptr);
  }

  bool has_one_taker(const NcBlock& block, char letter, const words::Word* carried) {
    if (!block.allowed.empty() && (letter == 'P' || letter == 'Q')) return true;
    const words::Word* once = block.code(Group::once);
    auto takers =
        std::ranges::count_if(block.codes, [&](const words::Word* code) { return takes(*code, letter); });
    if (carried != nullptr && (once == nullptr || !takes(*once, letter)) && takes(*carried, letter)) ++takers;
    const bool axis = letter == 'X' || letter == 'Y' || letter == 'Z';
    if (takers == 0)
      return complain(axis ? "a motion before any of G0, G1, G2, G3"
                           : fmt::format("no word of the block takes {}", letter));
    // Beside G28 other controls take a motion word for the blocks to come.
    const bool homes = control_ != Control::linuxcnc && once != nullptr && takes(*once, letter);
    return takers == 1 || homes || complain(fmt::format("two words of the block take {}", letter));
  }

  /// Says whether the word is a height of the program, and no step nor a place of the machine.
  [[nodiscard]] bool is_height(const NcBlock& block, char letter) const {
    const words::Word* once = block.code(Group::once);
    if (incremental_ || (once != nullptr && once->tenths == words::kMachineFrame)) return false;
    return letter == 'Z' || (letter == 'R' && once == nullptr && is_cycle(motion_) && block.has_axis());
  }

  /// The words that the moves of the block do not show.
  [[nodiscard]] std::string rest_of(const NcBlock& block, bool moved, std::vector<double>& heights) const {
    constexpr std::array kShown{Group::motion,   Group::motion_off, Group::plane,      Group::unit,
                                Group::distance, Group::centre,     Group::work_offset};
    std::string rest;
    for (const words::Word* code : block.codes)
      if ((code->group == Group::motion && is_cycle(code)) ||
          std::ranges::find(kShown, code->group) == kShown.end())
        rest += name_of(*code) + " ";
    // The words have to say whether it is a rapid where no move is seen, as up from a Z that is not known.
    // A cycle is seen at its places.
    const bool goes = block.has_axis() || block.has_rotary();
    if (motion_ != nullptr && !moved && goes && block.code(Group::once) == nullptr)
      rest += name_of(*motion_) + " ";
    for (const int m : block.allowed) rest += fmt::format("M{} ", m);
    const bool turns = is_arc(motion_) && block.code(Group::once) == nullptr;
    const std::string_view shown = turns ? "NOXYIJKRP" : block.code(Group::once) != nullptr ? "NO" : "NOXY";
    for (char letter = 'A'; letter <= 'Z'; ++letter) {
      if (!block[letter] || shown.find(letter) != std::string_view::npos) continue;
      if (letter == 'Z' && moved && known_[2]) continue;
      if (heights_apart_ && is_height(block, letter)) {
        rest += fmt::format("{} ", letter);
        heights.push_back(*block[letter] * unit_);
        continue;
      }
      const bool length = std::string_view("XYZRQF").find(letter) != std::string_view::npos;
      rest += fmt::format("{}{} ", letter, *block[letter] * (length ? unit_ : 1));
    }
    return rest;
  }

  /// The words act in LinuxCNC's order, wherever they stand in the block.
  void act(const NcBlock& block) {
    if (ended_) return void(complain("words after the end of the program"));
    if (!fits(block)) return;
    const std::size_t before = moves_.size();
    upright_.reset();
    run(block);
    std::vector<double> heights;
    const std::string rest = rest_of(block, moves_.size() > before, heights);
    if (!rest.empty() || moves_.size() > before)
      events_.push_back({block.line, rest, std::move(heights), before, moves_.size(), upright_,
                         work_offset_ == nullptr ? 0 : work_offset_->tenths, by_time_, said_,
                         block.has_axis()});
  }

  void run(const NcBlock& block) {
    for (const words::Word* code : block.codes) said_.take(*code);
    if (const words::Word* code = block.code(Group::feed_mode))
      feed_ = 0, by_time_ = code->tenths == 930;  // G94 takes back the F before it
    const words::Word* unit = block.code(Group::unit);
    const double new_unit = unit == nullptr ? unit_ : unit->tenths == 200 ? 25.4 : 1;
    if (block['F']) {
      if (!(*block['F'] > 0)) return void(complain("a feed that is not above 0"));
      if (new_unit != unit_)
        return void(complain("a feed beside a change of its unit; give it a block of its own"));
      feed_ = *block['F'] * unit_;
    }
    unit_ = new_unit;
    change_tool(block);
    change_offsets(block);
    if (const words::Word* code = block.code(Group::spindle)) spindle_ = code->tenths;
    if (const words::Word* code = block.code(Group::plane)) set_plane(code->tenths);
    if (const words::Word* code = block.code(Group::distance)) incremental_ = code->tenths == 910;
    if (const words::Word* code = block.code(Group::centre)) absolute_centre_ = code->tenths == 901;
    if (const words::Word* code = block.code(Group::retract))
      to_r_plane_ = code->tenths == 990, says_retract_ = true;
    if (block.code(Group::motion_off) != nullptr) motion_ = nullptr;
    if (const words::Word* code = block.code(Group::motion)) set_motion(code);
    const words::Word* once = block.code(Group::once);
    if (once != nullptr && once->tenths == words::kDwell)
      dwells_.push_back({moves_.size(), dwell_of(block)});
    else if (once != nullptr)
      go_to_machine(block, *once);
    else if (block.has_axis() || is_arc(block.code(Group::motion)))
      move(block);
    if (const words::Word* code = block.code(Group::stop)) ended_ = code->tenths == 20 || code->tenths == 300;
  }

  /// LinuxCNC and grbl count seconds. Haas and Fanuc count thousandths where there is no decimal point, and
  /// Fanuc's P never has one.
  [[nodiscard]] double dwell_of(const NcBlock& block) const {
    const char letter = block['P'] ? 'P' : block['X'] ? 'X' : 'U';
    const bool pointless = block.pointless.find(letter) != std::string::npos;
    const bool thousandths = (control_ == Control::fanuc && (letter == 'P' || pointless)) ||
                             (control_ == Control::haas && pointless);
    return *block[letter] / (thousandths ? 1000 : 1);
  }

  void set_plane(int tenths) {
    plane_ = tenths == 170 ? ArcPlane::xy : tenths == 180 ? ArcPlane::zx : ArcPlane::yz;
  }

  /// A cycle counts the plane to go back to from where the first of a row of cycles begins.
  void set_motion(const words::Word* code) {
    if (!is_cycle(motion_)) initial_z_ = at_[2];
    if (code != motion_) cycle_ = {}, has_cycle_ = false;
    motion_ = code;
  }

  /// The report is of one tool. Nobody knows where it stands after a change.
  void change_tool(const NcBlock& block) {
    const bool changes = block.code(Group::tool_change) != nullptr;
    if (judged_ && (changes || block['T']) && has_cut_) complain("a change of the tool after the first cut");
    if (changes) known_ = {}, spindle_ = 50;
  }

  /// Offsets move what the words for axes mean.
  void change_offsets(const NcBlock& block) {
    const words::Word* work = block.code(Group::work_offset);
    const words::Word* length = block.code(Group::tool_length);
    const bool other_work = work != nullptr && work != work_offset_;
    const bool other_length = length != nullptr && (length != tool_length_ || block['H'] != tool_length_of_);
    if (judged_ && (other_work || other_length) && is_known())
      complain(fmt::format("{} after the first motion changes where the program's places are",
                           name_of(other_work ? *work : *length)));
    if (other_work) known_ = {};
    if (other_length) known_[2] = false;
    if (work != nullptr) work_offset_ = work;
    if (length != nullptr) tool_length_ = length, tool_length_of_ = block['H'];
  }

  /// A way along Z to a place of the machine that the program does not say. G28 and G30 go by the place that
  /// their words say.
  void go_to_machine(const NcBlock& block, const words::Word& code) {
    if (judged_ && (block['X'] || block['Y'] || !block['Z']))
      return void(complain(
          fmt::format("{} to a place of the machine in X and Y; Z alone is understood", name_of(code))));
    if (code.tenths == words::kMachineFrame) {
      if (motion_ == nullptr || motion_->tenths != kRapid || incremental_)
        return void(complain("G53 without G0 and G90"));
    } else {
      const words::Word* before = std::exchange(motion_, words::word_at('G', kRapid, control_));
      if (!block['X'] && !block['Y']) move(block);
      motion_ = before;
    }
    const bool all = !block.has_axis();
    for (std::size_t i = 0; i < 3; ++i)
      if (all || block[kAxes[i]]) known_[i] = false;
  }

  void move(const NcBlock& block) {
    if (is_cycle(motion_)) return drill(block);
    std::array<double, 3> to = at_;
    const bool were_known = is_known(), xy_known = known_[0] && known_[1];
    z_was_said_ = known_[2];
    for (std::size_t i = 0; i < 3; ++i)
      if (!go_along(i, block[kAxes[i]], to)) return;
    const std::array<double, 3> from = std::exchange(at_, to);
    const bool rapid = motion_->tenths == kRapid;
    if (judged_ && !rapid && !(feed_ > 0)) return void(complain("a motion with feed before any F"));
    if (judged_ && !were_known) return arrive(rapid);
    if (!xy_known) return appear(rapid, block.line);
    if (is_arc(motion_)) return turn(block, from);
    add_line(rapid, from, block.line);
  }

  /// Follows the word of one axis.
  bool go_along(std::size_t i, std::optional<double> word, std::array<double, 3>& to) {
    if (!word) return true;
    if (incremental_ && !known_[i] && (judged_ || i < 2))
      return complain(fmt::format("a step of {} from a place that no block has said", kAxes[i]));
    to[i] = *word * unit_ + (incremental_ ? to[i] : 0);
    known_[i] = known_[i] || !incremental_;
    return std::abs(to[i]) <= kFarthest ||
           complain(fmt::format("{} is farther than {} mm from the origin", kAxes[i], kFarthest));
  }

  /// To the next hole of a cycle.
  bool go_along_xy(const NcBlock& block) {
    go_along(0, block['X'], at_);
    go_along(1, block['Y'], at_);
    return complaint_.empty();
  }

  void add_line(bool rapid, const std::array<double, 3>& from, std::size_t line) {
    if (from == at_) return;
    has_cut_ = has_cut_ || !rapid || std::min(from[2], at_[2]) < top_;
    moves_.push_back(straight(rapid, from, line));
  }

  [[nodiscard]] Move straight(bool rapid, const std::array<double, 3>& from, std::size_t line) const {
    return {.rapid = rapid,
            .from = {from[0], from[1]},
            .to = {at_[0], at_[1]},
            .centre = {},
            .from_z = from[2],
            .to_z = at_[2],
            .from_z_said = z_was_said_,
            .to_z_said = known_[2],
            .feed = rapid ? 0 : feed_,
            .line = line};
  }

  /// Nobody sees what a motion from an unknown place cuts, so it may only be one that cuts nothing.
  void arrive(bool rapid) {
    if (!rapid)
      complain(is_arc(motion_) ? "an arc from a place that no block has said"
                               : "a motion with feed from a place that no block has said");
    else if (known_[2] && at_[2] < top_)
      complain(fmt::format("G0 below Z {:g} from a place that no block has said", top_));
  }

  /// A motion comes from a place that is not known, and goes to one that is.
  void appear(bool rapid, std::size_t line) {
    z_was_said_ = known_[2];
    if (is_arc(motion_)) return void(complain("an arc from a place that no block has said"));
    if (known_[0] && known_[1]) moves_.push_back(straight(rapid, at_, line));
  }

  void turn(const NcBlock& block, const std::array<double, 3>& from) {
    NcArc arc{plane_, motion_->tenths == kCounterClockwise, from, at_, {}, 1};
    if (const auto p = block['P']) {
      if (!is_number_of_turns(*p)) return void(complain("P of an arc is not a number of turns"));
      arc.turns = static_cast<int>(*p);
    }
    if (!find_centre(block, arc)) return;
    if (plane_ != ArcPlane::xy && !known_[2]) return void(complain("an arc from a Z that no block has said"));
    if (const std::string fault = complaint_about(arc, !judged_); !fault.empty())
      return void(complain(fault));
    if (plane_ != ArcPlane::xy) upright_ = arc;
    has_cut_ = true;
    add_arc_moves(arc, straight(false, from, block.line), moves_);
  }

  bool find_centre(const NcBlock& block, NcArc& arc) {
    const auto axes = axes_of(plane_);
    constexpr std::array<char, 3> kCentres{'I', 'J', 'K'};
    const auto first = block[kCentres[axes[0]]], second = block[kCentres[axes[1]]];
    if (block[kCentres[axes[2]]])
      return complain(fmt::format("no arc in this plane takes {}", kCentres[axes[2]]));
    if (block['R']) {
      if (first || second) return complain("an arc with a radius and a centre");
      const auto centre = centre_of_radius(arc, *block['R'] * unit_, complaint_);
      if (centre) arc.centre = *centre;
      return centre.has_value();
    }
    if (!first && !second)
      return complain(plane_ == ArcPlane::xy ? "an arc without I, J or R" : "an arc without a centre or R");
    if (absolute_centre_ && !(first && second))
      return complain(plane_ == ArcPlane::xy ? "an absolute centre needs both I and J"
                                             : "an absolute centre needs both of its words");
    arc.centre = {first.value_or(0) * unit_, second.value_or(0) * unit_};
    if (!absolute_centre_) arc.centre[0] += arc.from[axes[0]], arc.centre[1] += arc.from[axes[1]];
    return true;
  }

  void drill(const NcBlock& block) {
    if (judged_ && !is_known()) return void(complain("a canned cycle from a place that no block has said"));
    if (plane_ != ArcPlane::xy) return void(complain("a canned cycle outside the XY plane"));
    if (judged_ && !(feed_ > 0)) return void(complain("a motion with feed before any F"));
    // LinuxCNC begins with either, as it was left.
    if (judged_ && control_ == Control::linuxcnc && !says_retract_)
      return void(complain("a canned cycle before G98 or G99"));
    double repeats = 1;
    for (const char letter : {'L', 'K'}) {
      if (!block[letter] || (letter == 'K' && control_ == Control::haas)) continue;
      const bool none = control_ != Control::linuxcnc && *block[letter] == 0;
      if (!is_number_of_turns(*block[letter]) && !none)
        return void(complain(fmt::format("{} of a canned cycle is not a number of holes", letter)));
      repeats = *block[letter];
    }
    if (judged_ && block['L'] && control_ == Control::fanuc)
      return void(complain("L beside a canned cycle, which not every Fanuc control reads; K repeats it"));
    if (judged_ && control_ == Control::haas && (block['I'] || block['J'] || block['K']))
      return void(complain("pecks shaped by I, J and K"));
    if (!judged_) return visit(block, repeats);
    if (!read_cycle(block)) return;
    const double before = to_r_plane_ ? at_[2] : std::max(initial_z_, at_[2]);
    cycle_.clear = to_r_plane_ ? cycle_.high : std::max(initial_z_, cycle_.high);
    if (before < cycle_.high) lift(cycle_.high, block.line);
    double over = std::max(before, cycle_.high);
    for (double k = 0; k < repeats; ++k) {
      hole(block, over);
      over = cycle_.clear;
    }
  }

  /// The places of the holes alone; what is done there stands in the words of the block.
  void visit(const NcBlock& block, double repeats) {
    z_was_said_ = known_[2];
    const bool both = block['Z'] && block['R'];
    if (both) cycle_incremental_ = incremental_;
    if (heights_apart_ && cycle_incremental_ != incremental_)
      return void(complain("a canned cycle that goes on under another of G90 and G91 without its Z and R"));
    // No hole is a place all the same, which the words must say alike.
    for (double k = 0; k < std::max(1.0, repeats); ++k) {
      if (!go_along_xy(block)) return;
      if (!known_[0] || !known_[1]) return void(complain("a canned cycle at a place that no block has said"));
      moves_.push_back(straight(true, at_, block.line));
    }
    known_[2] = false;
  }

  void lift(double z, std::size_t line) {
    const auto from = at_;
    at_[2] = z;
    add_line(true, from, line);
  }

  void hole(const NcBlock& block, double over) {
    const auto from = at_;
    if (!go_along_xy(block)) return;
    at_[2] = over;
    add_line(true, from, block.line);
    lift(cycle_.high, block.line);
    for (const NcPlunge& plunge : plunges_of(cycle_)) {
      const auto above = at_;
      at_[2] = plunge.to_z;
      add_line(plunge.rapid, above, block.line);
    }
  }

  /// Z, R and Q hold until another cycle or G80. The first block of a cycle says them all.
  bool read_cycle(const NcBlock& block) {
    const int code = motion_->tenths;
    const bool pecks = code == 730 || code == 830;
    const bool waits = code == 820 || code == 860 || code == 890;
    const bool changes = incremental_ != cycle_incremental_;
    if ((!has_cycle_ || changes) && !(block['Z'] && block['R']))
      return complain(fmt::format("{} without Z and R in its first block", name_of(*motion_)));
    if (!has_cycle_ && pecks && !block['Q'])
      return complain(fmt::format("{} without Q in its first block", name_of(*motion_)));
    if (!has_cycle_ && waits && !block['P'] && control_ == Control::linuxcnc)
      return complain(fmt::format("{} without P in its first block", name_of(*motion_)));
    const int turning = code == 740 ? 40 : code == 840 ? 30 : spindle_;
    if (control_ == Control::linuxcnc && (code == 740 || code == 840 || code == 860) &&
        (spindle_ != turning || spindle_ == 50))
      return complain(fmt::format("{} while the spindle does not turn so", name_of(*motion_)));
    if (incremental_ && to_r_plane_ && has_cycle_ && (block['Z'] || block['R']))
      return complain("Z or R of a cycle changed under G91 and G99");
    if (to_r_plane_ && has_cycle_ && block['R'] && *block['R'] * unit_ != cycle_.high)
      return complain("R of a cycle changed under G99");
    // LinuxCNC then goes to the new R where the last hole was.
    if (!to_r_plane_ && has_cycle_ && block['R'] && initial_z_ < cycle_.high)
      return complain("R of a cycle changed above the plane that it began at");
    cycle_.tenths = code;
    if (block['Q']) cycle_.peck = *block['Q'] * unit_;
    if (pecks && !(cycle_.peck > 0)) return complain("Q of a cycle is not above 0");
    const double base = incremental_ ? (to_r_plane_ ? at_[2] : initial_z_) : 0;
    if (block['R']) cycle_.high = *block['R'] * unit_ + base;
    if (block['R'] && incremental_ && !block['Z']) return complain("R of a cycle without Z under G91");
    if (block['Z']) cycle_.low = *block['Z'] * unit_ + (incremental_ ? cycle_.high : 0);
    has_cycle_ = true, cycle_incremental_ = incremental_;
    if (!(std::max(std::abs(cycle_.low), std::abs(cycle_.high)) <= kFarthest))
      return complain(fmt::format("Z is farther than {} mm from the origin", kFarthest));
    if (pecks && !((cycle_.high - cycle_.low) / cycle_.peck <= kMostPecks))
      return complain("Q of a cycle makes more than 10000 steps");
    return cycle_.high >= cycle_.low || complain("R of a cycle is below its Z");
  }

  const Document& program_;
  double top_;
  Control control_;
  bool judged_, heights_apart_;
  NcLines lines_;
  std::vector<NcEvent> events_;
  std::vector<NcDwell> dwells_;
  std::optional<NcArc> upright_;  ///< of the block at hand
  std::vector<Move> moves_;
  std::string complaint_;
  std::array<double, 3> at_{};
  std::array<bool, 3> known_{};
  bool z_was_said_ = false;  ///< before the block at hand
  double unit_ = 1, feed_ = 0, initial_z_ = 0;
  const words::Word *motion_ = nullptr, *work_offset_ = nullptr, *tool_length_ = nullptr;
  std::optional<double> tool_length_of_;
  ArcPlane plane_ = ArcPlane::xy;
  NcCycle cycle_;
  bool incremental_ = false, absolute_centre_ = false, to_r_plane_ = false, says_retract_ = false,
       has_cut_ = false;
  bool has_cycle_ = false, cycle_incremental_ = false, ended_ = false, by_time_ = false;
  SaidGroups said_;
  int spindle_ = 50;  ///< M3, M4 or M5, in tenths
  std::size_t line_ = 0;
};

}  // namespace

Result<NcProgram> read_program(const Document& program, const NcReading& reading) {
  return ProgramReader(program, reading).read();
}

Result<std::vector<Move>> read_moves(const Document& program, double top, Control control) {
  LEKALO_TRY(NcProgram read, read_program(program, {.control = control, .top = top}));
  return std::move(read.moves);
}

}  // namespace lekalo::verify

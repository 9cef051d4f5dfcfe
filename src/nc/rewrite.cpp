#include "lekalo/nc/rewrite.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "foreign.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/trig.hpp"
#include "modes.hpp"
#include "straighten.hpp"
#include "unfold.hpp"
#include "white_list.hpp"

namespace lekalo::nc {
namespace {

constexpr double kLargestShift = 1e6;  // mm
/// Computed numbers are written with twelve decimals; a hundred thousand steps add up to less.
constexpr double kComputed = 1e-5;  // mm

Result<void> check_request(const std::string& name, double x, double y, double theta,
                           const RewriteOptions& options) {
  const auto wrong = [&](const std::string& what) {
    return failure(ErrorCode::usage, fmt::format("{}: {}", name, what));
  };
  if (!(std::abs(x) <= kLargestShift && std::abs(y) <= kLargestShift))
    return wrong(fmt::format("the shift ({}, {}) is not within {} mm", x, y, kLargestShift));
  if (options.z && !(std::abs(*options.z) <= kLargestShift))
    return wrong(fmt::format("the shift {} along Z is not within {} mm", *options.z, kLargestShift));
  if (!(std::abs(theta) <= geom::kMaxAngle))
    return wrong(fmt::format("the angle {} is not within {} rad", theta, geom::kMaxAngle));
  if (options.work_offset < 1 || options.work_offset > 9)
    return wrong(fmt::format("work offset {} is none of 1 (G54) to 9 (G59.3)", options.work_offset));
  if (!(options.chord_tolerance >= 1e-5 && options.chord_tolerance <= 1))
    return wrong(fmt::format("a chord tolerance of {} is not 0.00001 to 1 mm", options.chord_tolerance));
  if (options.g68_angle_decimals < 0 || options.g68_angle_decimals > 9)
    return wrong(fmt::format("{} decimals of a degree are not 0 to 9", options.g68_angle_decimals));
  return {};
}

Result<Rewritten> run_mode(const RewriteJob& job) {
  switch (job.options.mode) {
    case RewriteMode::coordinates:
      return rewrite_coordinates(job);
    case RewriteMode::offset:
      return insert_offset(job);
    case RewriteMode::g68:
      return insert_g68(job);
  }
  return failure(ErrorCode::usage, job.name + ": no such rewrite mode");
}

}  // namespace

std::string apply_edits(std::string_view text, std::vector<Edit> edits) {
  std::ranges::stable_sort(edits, {}, [](const Edit& edit) { return std::pair(edit.at, edit.length); });
  std::string result;
  std::size_t done = 0;
  for (const Edit& edit : edits) {
    ask();
    result += text.substr(done, edit.at - done);
    result += edit.text;
    done = edit.at + edit.length;
  }
  result += text.substr(done);
  return result;
}

namespace {

/// A program as it is worked on: its text, taken apart, and its meaning.
struct Reading {
  std::string_view text;
  Program program;
  Interpretation interpretation;
};

/// Step 3.
Result<Reading> follow(std::string_view text, Program program, const std::string& name,
                       const RewriteOptions& options, words::Control control) {
  Reading reading{text, std::move(program), {}};
  std::vector<LineFault> faults = reading.program.faults;
  std::ranges::move(refused_words(reading.program, control, options.allowed_m), std::back_inserter(faults));
  if (!faults.empty()) return refusal_of_all(name, std::move(faults));
  LEKALO_TRY(reading.interpretation, interpret(reading.program, name, options, control));
  return reading;
}

/// Refuses a program that could not be unfolded, and names the unknown words of its other lines too.
tl::unexpected<Error> refuse_folded(std::string_view text, const std::string& name, LineFault fault,
                                    const RewriteOptions& options) {
  Program program = parse_program(text);
  const auto folded = [&](std::size_t line) {
    const Block& block = program.blocks[line - 1];
    return line == fault.line || is_folded_line(text.substr(block.begin, block.end - block.begin));
  };
  const words::Control control = options.control.value_or(guess_control(program, options.allowed_m, ~0U));
  std::vector<LineFault> faults = program.faults;
  std::ranges::move(refused_words(program, control, options.allowed_m), std::back_inserter(faults));
  std::erase_if(faults, [&](const LineFault& each) { return folded(each.line); });
  faults.push_back(std::move(fault));
  return refusal_of_all(name, std::move(faults));
}

/// The control that was named, or the one in whose language the program most likely is.
Result<words::Control> control_of(const Unfolded& unfolded, const Program& program, const std::string& name,
                                  const RewriteOptions& options) {
  const auto others = [](const FlowUse& use) {
    std::string list;
    for (const words::Control each :
         {words::Control::linuxcnc, words::Control::haas, words::Control::fanuc, words::Control::grbl})
      if (knows(*use.word, each)) list += fmt::format("{}{}", list.empty() ? "" : "|", word_of(each));
    return list;
  };
  unsigned controls = ~0U;
  for (const FlowUse& use : unfolded.uses) {
    if (options.control && !knows(*use.word, *options.control))
      return refusal(name, use.line,
                     fmt::format("{} is no word of {} controls; --control {} has it", use.word->name,
                                 words::name_of(*options.control), others(use)));
    controls &= use.word->controls;
    if (controls == 0)
      return refusal(name, use.line,
                     fmt::format("{} is a word of {} controls alone, and line {} has one of others",
                                 use.word->name, others(use), unfolded.uses.front().line));
  }
  if (options.control) return *options.control;
  return guess_control(program, options.allowed_m, controls);
}

/// An arc outside the XY plane stays an arc where nothing turns and its centre counts from its start.
bool must_straighten(const Interpretation& interpretation, const RigidMotion& motion,
                     const RewriteOptions& options) {
  if (options.mode == RewriteMode::g68 && interpretation.other_plane) return true;
  const bool keeps = !motion.turns();
  return std::ranges::any_of(interpretation.motions, [&](const Motion& each) {
    return each.plane != 170 && !(keeps && !each.absolute_centre);
  });
}

/// The blocks that move in X and Y, and those that say a height.
std::size_t moved_blocks(const Interpretation& interpretation) {
  std::set<std::size_t> blocks;
  for (const Motion& motion : interpretation.motions) blocks.insert(motion.block);
  for (const Height& height : interpretation.heights) blocks.insert(height.block);
  return blocks.size();
}

}  // namespace

Result<Rewritten> rewrite_program(std::string_view text, const std::string& name, double x, double y,
                                  double theta, const RewriteOptions& options) {
  // The steps of docs/design/nc-rewrite.md.
  LEKALO_CHECK(check_request(name, x, y, theta, options));  // 1
  const bool marked = text.starts_with(kByteOrderMark);
  if (marked) text.remove_prefix(kByteOrderMark.size());
  if (const auto foreign = foreign_program(text))
    return refusal(
        name, foreign->line,
        fmt::format("{} is a word of {} controls, whose language is not rewritten; let the CAM system "
                    "write the program for LinuxCNC, Haas, Fanuc or GRBL",
                    foreign->word, foreign->control));
  auto written_out = unfold(text);  // 2
  if (!written_out) return refuse_folded(text, name, std::move(written_out.error()), options);
  const Unfolded& unfolded = *written_out;
  Program program = parse_program(unfolded.text, unfolded.lines);
  LEKALO_TRY(const words::Control control, control_of(unfolded, program, name, options));
  LEKALO_TRY(Reading reading, follow(unfolded.text, std::move(program), name, options, control));  // 3
  const RigidMotion machine_from_part(x, y, theta);
  Straightened chords;
  if (must_straighten(reading.interpretation, machine_from_part, options)) {  // 4
    LEKALO_TRY(chords, straighten(unfolded.text, name, reading.program, reading.interpretation,
                                  options.chord_tolerance));
    LEKALO_TRY(reading,
               follow(chords.text, parse_program(chords.text, chords.lines), name, options, control));
  }
  const RewriteJob job{reading.text,      name,  reading.program, reading.interpretation,
                       machine_from_part, theta, options,         control};
  LEKALO_TRY(Rewritten result, run_mode(job));  // 5
  if (options.z) result.motions = moved_blocks(reading.interpretation);
  // 6. What the mode has to say comes first.
  const std::vector<std::string>& notes = reading.interpretation.notes;
  result.notes.insert(result.notes.end(), notes.begin(), notes.end());
  result.notes.insert(result.notes.end(), unfolded.notes.begin(), unfolded.notes.end());
  result.control = control;
  if (marked)
    result.notes.emplace_back(
        "the byte order mark at its beginning, which controls stumble over, is left out");
  if (unfolded.computed > 0) result.rounding_mm += kComputed;
  result.rounding_mm =
      chords.arcs > 0 ? rounded_up(result.rounding_mm + chords.chord_mm) : result.rounding_mm;
  if (chords.arcs > 0)
    result.notes.push_back(fmt::format(
        "{} written as chords within {:.2g} mm",
        counted(chords.arcs, "arc of G18 and G19 is", "arcs of G18 and G19 are"), chords.chord_mm));
  if (unfolded.calls > 0)
    result.notes.push_back(counted(unfolded.calls, "call of a subprogram is", "calls of subprograms are") +
                           " written out");
  if (unfolded.computed > 0)
    result.notes.push_back(counted(unfolded.computed, "variable or expression is computed",
                                   "variables and expressions are computed") +
                           ": the program sets no variable of the control any more");
  if (!options.control)
    result.notes.push_back(
        fmt::format("read as a program for {} controls; --control names another", words::name_of(control)));
  return result;
}

}  // namespace lekalo::nc

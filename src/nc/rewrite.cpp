#include "lekalo/nc/rewrite.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "foreign.hpp"
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

/// Steps 2 and 3: takes a text apart and follows it.
Result<Reading> read(std::string_view text, const std::string& name, const std::vector<std::size_t>& lines,
                     const RewriteOptions& options, std::optional<words::Control>& control) {
  Reading reading{text, {}, {}};
  LEKALO_TRY(reading.program, parse_program(text, name, lines));
  if (!control) control = guess_control(reading.program, options.allowed_m);
  const auto refused = refused_words(reading.program, *control, options.allowed_m);
  if (!refused.empty()) return refusal(name, refused.front().line, sentence_of(refused));
  LEKALO_TRY(reading.interpretation, interpret(reading.program, name, options, *control));
  return reading;
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

}  // namespace

Result<Rewritten> rewrite_program(std::string_view text, const std::string& name, double x, double y,
                                  double theta, const RewriteOptions& options) {
  // The steps of docs/design/nc-rewrite.md.
  LEKALO_CHECK(check_request(name, x, y, theta, options));  // 1
  if (const auto foreign = foreign_program(text))
    return refusal(
        name, foreign->line,
        fmt::format("{} is a word of {} controls, whose language is not rewritten; let the CAM system "
                    "write the program for LinuxCNC, Haas, Fanuc or GRBL",
                    foreign->word, foreign->control));
  std::optional<words::Control> control = options.control;
  LEKALO_TRY(const Unfolded unfolded, unfold(text, name));                                   // 2
  LEKALO_TRY(Reading reading, read(unfolded.text, name, unfolded.lines, options, control));  // 2 and 3
  const RigidMotion machine_from_part(x, y, theta);
  Straightened chords;
  if (must_straighten(reading.interpretation, machine_from_part, options)) {  // 4
    LEKALO_TRY(chords, straighten(unfolded.text, name, reading.program, reading.interpretation,
                                  options.chord_tolerance));
    LEKALO_TRY(reading, read(chords.text, name, chords.lines, options, control));
  }
  const RewriteJob job{reading.text,      name,  reading.program, reading.interpretation,
                       machine_from_part, theta, options,         *control};
  LEKALO_TRY(Rewritten result, run_mode(job));  // 5
  // 6. What the mode has to say comes first.
  const std::vector<std::string>& notes = reading.interpretation.notes;
  result.notes.insert(result.notes.end(), notes.begin(), notes.end());
  result.control = *control;
  if (unfolded.computed > 0) result.rounding_mm += kComputed;
  result.rounding_mm =
      chords.arcs > 0 ? rounded_up(result.rounding_mm + chords.chord_mm) : result.rounding_mm;
  if (chords.arcs > 0)
    result.notes.push_back(
        fmt::format("{} arcs of G18 and G19 are written as chords within {:.2g} mm of them", chords.arcs,
                    chords.chord_mm));
  if (unfolded.calls > 0)
    result.notes.push_back(fmt::format("{} calls of subprograms are written out", unfolded.calls));
  if (unfolded.computed > 0)
    result.notes.push_back(
        fmt::format("{} variables and expressions are computed: the program sets no "
                    "variable of the control any more",
                    unfolded.computed));
  if (!options.control)
    result.notes.push_back(
        fmt::format("read as a program for {} controls; --control names another", words::name_of(*control)));
  return result;
}

}  // namespace lekalo::nc

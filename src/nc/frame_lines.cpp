#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "arc.hpp"
#include "lekalo/base/angle.hpp"
#include "modes.hpp"
#include "white_list.hpp"

namespace lekalo::nc {
namespace {

using geom::DoubleDouble;

constexpr DoubleDouble kExactPi{kPi, 0x1.1a62633145c07p-53};
/// LinuxCNC reads an angle in double precision, and nine decimals of a degree are 2e-11 rad.
constexpr int kOffsetAngleDecimals = 9;

/// The smallest box with sides along X and Y that holds the programmed path, and the full circles of its
/// arcs. In grains.
struct Extent {
  bool empty = true;
  double low_x = 0, high_x = 0, low_y = 0, high_y = 0;

  void add(const Vector& p, double margin) {
    if (empty) {
      low_x = high_x = p.x.hi;
      low_y = high_y = p.y.hi;
      empty = false;
    }
    low_x = std::min(low_x, p.x.hi - margin);
    high_x = std::max(high_x, p.x.hi + margin);
    low_y = std::min(low_y, p.y.hi - margin);
    high_y = std::max(high_y, p.y.hi + margin);
  }
  [[nodiscard]] Vector middle() const {
    return {DoubleDouble{(low_x + high_x) / 2}, DoubleDouble{(low_y + high_y) / 2}};
  }
  /// The distance from the middle to a corner, mm.
  [[nodiscard]] double reach_mm() const {
    return millimetres({DoubleDouble{(high_x - low_x) / 2}, DoubleDouble{(high_y - low_y) / 2}});
  }
};

Extent extent_of(const std::vector<Motion>& motions) {
  Extent extent;
  for (const Motion& motion : motions) {
    if (motion.start_known) extent.add(to_vector(motion.start), 0);
    extent.add(to_vector(motion.end), 0);
    if (motion.kind != MotionKind::arc_by_centre && motion.kind != MotionKind::arc_by_radius) continue;
    const Arc arc = motion_arc(motion);
    extent.add(arc.centre, std::max(arc.start_radius, arc.end_radius) * kGrainsPerMillimetre);
  }
  return extent;
}

/// The rigid motion, rounded to the numbers that the inserted words can say.
struct RoundedMotion {
  std::string degrees, x, y;
  std::string z;  ///< ` Z` and the height, of solids alone
  double rounding_mm = 0;
};

/// The angle is rounded first; then the shift is chosen so that the middle of the program lands where it
/// should, and is rounded in its turn. So the error of the angle grows from the middle of the program, and
/// not from its origin, which may be far away.
RoundedMotion round_motion(const RewriteJob& job, int angle_decimals, LengthUnit unit) {
  const DoubleDouble exact_degrees = DoubleDouble{job.theta} * DoubleDouble{180.0} / kExactPi;
  double power = 1;
  for (int k = 0; k < angle_decimals; ++k) power *= 10;
  const Wide turn = static_cast<Wide>(360 * power);
  Wide steps = steps_nearest(DoubleDouble{power} * exact_degrees, 1);
  const DoubleDouble written_theta = to_double_double(steps) * kExactPi / DoubleDouble{180.0 * power};
  steps %= turn;
  if (2 * steps > turn) steps -= turn;
  if (2 * steps <= -turn) steps += turn;

  // R(written) = R(exact) R(change) with a change below 1 degree: its series ends soon.
  const DoubleDouble change = written_theta - DoubleDouble{job.theta};
  const Extent extent = extent_of(job.interpretation.motions);
  const Vector middle = extent.middle();
  const DoubleDouble square = change * change;
  DoubleDouble sine = change, cosine{1.0}, term = change;
  DoubleDouble cosine_term{1.0};
  for (int n = 2; n <= 16; n += 2) {
    cosine_term = -cosine_term * square / DoubleDouble{static_cast<double>((n - 1) * n)};
    term = -term * square / DoubleDouble{static_cast<double>(n * (n + 1))};
    cosine = cosine + cosine_term;
    sine = sine + term;
  }
  const Vector changed{cosine * middle.x - sine * middle.y, sine * middle.x + cosine * middle.y};
  const Vector shift = job.machine_from_part(middle) - job.machine_from_part.rotate(changed);

  const Grains step = quantum(unit, kLeastDecimals);
  const Wide x = steps_nearest(shift.x, step), y = steps_nearest(shift.y, step);
  const Vector lost = to_vector({x * step, y * step}) - shift;
  RoundedMotion rounded{format_decimal(steps, angle_decimals), format_decimal(x, kLeastDecimals),
                        format_decimal(y, kLeastDecimals), "",
                        rounded_up(millimetres(lost) + std::abs(change.hi) * extent.reach_mm())};
  if (job.options.z) {
    const RoundedHeight height = rounded_height(*job.options.z, step);
    rounded.z = " Z" + format_decimal(height.shift / step, kLeastDecimals);
    rounded.rounding_mm = with_height(rounded.rounding_mm, height.lost_mm);
  }
  return rounded;
}

/// Modal words that the inserted line needs, where the program states them only later or not at all. They say
/// what is in force at the first motion, so they change nothing for the program.
std::string modal_prefix(const Interpretation& program, int work_offset, bool for_g68) {
  std::string words;
  if (!program.unit_stated) words += program.unit_at_first == LengthUnit::inch ? "G20 " : "G21 ";
  if (for_g68 && !program.plane_stated) words += "G17 ";
  if (for_g68 && !program.distance_stated) words += "G90 ";
  if (!for_g68 && !program.offset_stated) words += work_offset_name(work_offset) + " ";
  return words;
}

/// Under G68 no block may go to a point of the machine: it is cancelled before such a block, and said anew
/// before the next motion in X and Y. Returns whether it is in force at the end.
Result<bool> suspend_rotation(const RewriteJob& job, const std::string& turn, std::vector<Edit>& edits) {
  const Interpretation& program = job.interpretation;
  bool turned = true;
  auto next = program.motions.begin();
  for (const std::size_t index : program.machine_blocks) {
    for (; next != program.motions.end() && next->block < index; ++next) {
      if (turned) continue;
      const Block& block = job.program.blocks[next->block];
      if (next->incremental)
        return refusal(job.name, block.line,
                       "the motion after a point of the machine is in G91, but G68 must be given in G90");
      edits.push_back({block.begin, 0, turn});
      turned = true;
    }
    if (turned) edits.push_back({job.program.blocks[index].begin, 0, "G69" + job.program.line_end});
    turned = false;
  }
  if (turned || next == program.motions.end()) return turned;
  if (next->incremental)
    return refusal(job.name, job.program.blocks[next->block].line,
                   "the motion after a point of the machine is in G91, but G68 must be given in G90");
  edits.push_back({job.program.blocks[next->block].begin, 0, turn});
  return true;
}

/// True where the program has no place that the frame would move.
bool moves_nowhere(const RewriteJob& job) {
  const Interpretation& program = job.interpretation;
  return program.motions.empty() && !(job.options.z && program.first_axis_block);
}

Rewritten unchanged(const RewriteJob& job) {
  Rewritten result;
  result.program = job.text;
  result.notes.push_back("the program does not move in X or Y: nothing was written");
  return result;
}

std::string reach_note(double rounding_mm) {
  return fmt::format("rounding the shift and the angle moves no programmed point by more than {:.2g} mm",
                     rounding_mm);
}

}  // namespace

/// Step 5b of docs/design/nc-rewrite.md.
Result<Rewritten> insert_offset(const RewriteJob& job) {
  if (job.options.scan_frame != ScanFrame::machine)
    return failure(
        ErrorCode::usage,
        fmt::format(
            "{}: mode offset replaces {}, whose present value is not known here, so it needs a scan in "
            "machine coordinates; for a scan in the work coordinate system use mode coordinates",
            job.name, work_offset_name(job.options.work_offset)));
  const Interpretation& program = job.interpretation;
  if (program.program_number)
    return refusal(job.name, *program.program_number,
                   "LinuxCNC, for which mode offset is, has no program numbers (O)");
  if (program.rotation_cancel)
    return refusal(job.name, *program.rotation_cancel, "LinuxCNC, for which mode offset is, has no G69");
  if (moves_nowhere(job)) return unchanged(job);

  const RoundedMotion motion = round_motion(job, kOffsetAngleDecimals, program.unit_at_first);
  const std::string offset = work_offset_name(job.options.work_offset);
  Rewritten result;
  result.program = apply_edits(
      job.text, {{job.program.blocks[*program.first_axis_block].begin, 0,
                  fmt::format("{}G10 L2 P{} X{} Y{}{} R{}{}",
                              modal_prefix(program, job.options.work_offset, false), job.options.work_offset,
                              motion.x, motion.y, motion.z, motion.degrees, job.program.line_end)}});
  result.rounding_mm = motion.rounding_mm;
  result.motions = program.motions.size();
  result.notes.push_back(
      fmt::format("the scan was taken in machine coordinates: the program sets X, Y{} and rotation of {} "
                  "itself, whatever they were; {}no G92 shift may be active",
                  job.options.z ? ", Z" : "", offset, job.options.z ? "" : "its Z stays, and "));
  result.notes.push_back(
      fmt::format("LinuxCNC keeps {} after the program: set it anew, with R0, before other work", offset));
  result.notes.push_back(reach_note(motion.rounding_mm));
  return result;
}

/// Step 5c.
Result<Rewritten> insert_g68(const RewriteJob& job) {
  const Interpretation& program = job.interpretation;
  const std::string offset = work_offset_name(job.options.work_offset);
  if (program.rotation_cancel)
    return refusal(job.name, *program.rotation_cancel,
                   "G69 would cancel the rotation of mode g68; remove it");
  if (moves_nowhere(job)) return unchanged(job);
  const std::size_t first_line = job.program.blocks[*program.first_axis_block].line;
  if (program.incremental_at_first)
    return refusal(job.name, first_line,
                   "the first motion is in G91, but G68 must be given in G90: write G90 before it");
  if (program.sideways_bore)
    return refusal(
        job.name, *program.sideways_bore,
        "G76 and G87 shift the tool sideways, and whether G68 turns that way is up to the control; "
        "use mode coordinates");
  if (program.end_moves)
    return refusal(
        job.name, job.program.blocks[*program.end_block].line,
        "the block that ends the program moves too, but the rotation must be cancelled in between: split it");
  if (program.compensation_at_end)
    return refusal(
        job.name, job.program.blocks.back().line,
        "G41 or G42 is active at the end, but the rotation can be cancelled only after G40: add G40");

  const RoundedMotion motion = round_motion(job, job.options.g68_angle_decimals, program.unit_at_first);
  const std::string& eol = job.program.line_end;
  const std::string turn = fmt::format("G68 X0 Y0 R{}{}", motion.degrees, eol);
  std::vector<Edit> edits;
  const bool says_offset = !program.offset_stated && !program.late_offsets.empty();
  edits.push_back({job.program.blocks[*program.first_axis_block].begin, 0,
                   fmt::format("{}{}G52 X{} Y{}{}{}{}", says_offset ? offset + eol : "",
                               modal_prefix(program, job.options.work_offset, true), motion.x, motion.y,
                               motion.z, eol, turn)});
  // The same offset again is no change, and may not be said under G68.
  for (const Word* word : program.late_offsets)
    edits.push_back({word->letter_at, word->number_end - word->letter_at, ""});
  LEKALO_TRY(const bool turned, suspend_rotation(job, turn, edits));
  const std::string cancel =
      fmt::format("{}{}{}G52 X0 Y0{}", program.cycle_at_end ? "G80 " : "", turned ? "G69" : "",
                  turned || program.cycle_at_end ? eol : "", job.options.z ? " Z0" : "");
  if (program.end_block)
    edits.push_back({job.program.blocks[*program.end_block].begin, 0, cancel + eol});
  else
    edits.push_back({job.text.size(), 0, job.text.back() == '\n' ? cancel + eol : eol + cancel});

  Rewritten result;
  result.program = apply_edits(job.text, std::move(edits));
  result.rounding_mm = motion.rounding_mm;
  result.motions = program.motions.size();
  result.notes.push_back(job.options.scan_frame == ScanFrame::wcs
                             ? fmt::format("the scan was taken in {}: the program must run in the same {}, "
                                           "unchanged since the scan, and no "
                                           "other G52 shift or G68 rotation may be active",
                                           offset, offset)
                             : fmt::format("the scan was taken in machine coordinates: {} must be zero in {} "
                                           "when the program runs, and no "
                                           "other G52 shift or G68 rotation may be active",
                                           offset, shifted_axes(job.options)));
  result.notes.push_back(
      fmt::format("a program stopped before its end leaves G68 and G52 active: cancel them with G69 and G52 "
                  "X0 Y0{}",
                  job.options.z ? " Z0" : ""));
  result.notes.push_back(
      fmt::format("the angle has {} decimals of a degree, what the control is taken to read",
                  job.options.g68_angle_decimals));
  result.notes.push_back(reach_note(motion.rounding_mm));
  return result;
}

}  // namespace lekalo::nc

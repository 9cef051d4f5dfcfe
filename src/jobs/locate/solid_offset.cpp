#include "solid_offset.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/version.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/locate/solid_at.hpp"
#include "lekalo/verify/offset.hpp"

namespace lekalo::jobs {
namespace {

using solid::Vector;

bool is_tilted(const locate::SolidPose& pose) { return pose.quaternion[1] != 0 || pose.quaternion[2] != 0; }

/// The place where the part's middle is to be: where it is, but a step's half within the window.
Vector aim(const SolidInputs& in, const locate::SolidPose& pose, double half) {
  const Vector at = motion_of(pose)(in.pivot), start = motion_of(in.problem.start)(in.pivot);
  const double most = in.problem.shift - half;
  if (!(most > 0)) return at;
  return {std::clamp(at.x, start.x - most, start.x + most), std::clamp(at.y, start.y - most, start.y + most),
          std::clamp(at.z, start.z - most, start.z + most)};
}

/// Why these words are not written; empty: they are.
std::string hindrance(const SolidLocateJob& job, const io::SolidDocument& d, bool worded) {
  if (!d.inside()) return "the part is not inside the blank";
  if (d.scan && !d.scan->proved()) return "parts of the blank are unknown";
  const bool linuxcnc = job.options.offset->form.control == nc::OffsetControl::linuxcnc;
  if (is_tilted(d.pose) && (linuxcnc || job.options.offset->axes == 3))
    return fmt::format(
        "the part lies tilted, which {} cannot follow; place it with --freedom c-xyz or xyz from a start "
        "that "
        "is not tilted{}",
        linuxcnc ? "G10 L2, whose R turns about Z," : "a machine of three axes",
        linuxcnc ? "" : ", or say --axes 5 for a machine that tilts");
  if (!worded) return "no pose beside it that its words can say is in the window; say a wider one";
  return *d.clearance < job.options.min_allowance ? "the allowance is not met" : "";
}

std::vector<std::string> sentences_of(const SolidLocateJob& job, const io::SolidDocument& d) {
  const nc::OffsetForm& form = job.options.offset->form;
  const int code = 53 + form.work_offset;
  std::vector<std::string> all{fmt::format("LEKALO {} WORK OFFSET FOR {}", kVersion, job.part.name)};
  switch (form.control) {
    case nc::OffsetControl::linuxcnc:
      all.push_back("THE SCAN IS IN MACHINE COORDINATES - NO G92 MAY BE ACTIVE");
      all.push_back("LINUXCNC KEEPS IT - SET IT ANEW WITH R0 BEFORE OTHER WORK");
      break;
    case nc::OffsetControl::fanuc:
      all.push_back(fmt::format("G{} HAS TO BE ZERO FOR A SCAN IN MACHINE COORDINATES", code));
      all.push_back("NO G52 OR G92 MAY BE ACTIVE - G69 ENDS IT");
      break;
    case nc::OffsetControl::siemens:
      all.push_back(fmt::format("G{} HAS TO BE ZERO FOR A SCAN IN MACHINE COORDINATES", code));
      all.push_back("NO OTHER FRAME MAY BE ACTIVE - TRANS ALONE ENDS IT");
      break;
  }
  all.push_back("FOR PROGRAMS IN THE FRAME OF THE PART");
  if (is_tilted(d.pose)) all.push_back("TURN THE TOOL TO THE NEW Z BEFORE IT CUTS");
  return all;
}

}  // namespace

Result<std::optional<WordedPose>> worded(const SolidLocateJob& job, const SolidInputs& in,
                                         locate::SolidPlacement& best) {
  const nc::OffsetForm& form = job.options.offset->form;
  double power = 1;
  for (int k = 0; k < form.length_decimals; ++k) power *= 10;
  const Vector to = aim(in, best.pose, 0.5 / power);
  const locate::SolidOptions how{job.options.gap, job.options.min_allowance, job.options.threads, {}};
  std::optional<WordedPose> words;
  std::optional<locate::SolidPlacement> found;
  for (const nc::OffsetTurn& turn : nc::written_turns(best.pose.quaternion, form)) {
    const Vector shift = to - locate::motion_of({turn.quaternion, {}}).turned(in.pivot);
    WordedPose here{
        turn, {std::llround(shift.x * power), std::llround(shift.y * power), std::llround(shift.z * power)}};
    const auto length = [&](std::size_t k) { return static_cast<double>(here.shift[k]) / power; };
    LEKALO_TRY(std::optional<locate::SolidPlacement> made,
               locate::solid_at(in.problem, {turn.quaternion, {length(0), length(1), length(2)}}, how));
    if (!made ||
        (found && std::pair(made->inside, made->margin) <= std::pair(found->inside, found->margin)))
      continue;
    found = std::move(made), words = here;
  }
  if (!found) return words;
  found->work = best.work;
  best = *std::move(found);
  return words;
}

void add_offset(const SolidLocateJob& job, const std::optional<WordedPose>& words, LocatedSolid& made) {
  if (!job.options.offset) return;
  io::SolidDocument& d = made.document;
  if (const std::string why = hindrance(job, d, words.has_value()); !why.empty()) {
    made.offset_withheld = true;
    d.warnings.push_back("no work offset was written, because " + why);
    return;
  }
  const nc::OffsetForm& form = job.options.offset->form;
  made.offset = nc::offset_lines(words->turn, words->shift, form, sentences_of(job, d));
  d.offset = io::OffsetRecord{std::string(nc::kOffsetControls[static_cast<std::size_t>(form.control)]),
                              job.options.offset->axes,
                              form.work_offset,
                              {job.outputs.offset, io::sha256(made.offset)}};
}

Result<void> check_offset(const LocatedSolid& made) {
  LEKALO_TRY(
      const std::optional<std::string> fault,
      verify::fault_of_offset({"result", made.result}, {made.document.offset->output.path, made.offset}));
  if (!fault) return {};
  return failure(ErrorCode::refuted, "the self-check refuted the work offset: " + *fault);
}

}  // namespace lekalo::jobs

#include "heat_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "earlier_programs.hpp"
#include "interrupt.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/heat_result.hpp"
#include "lekalo/jobs/heat_words.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using heat::Interval;

Result<void> check_paths(const HeatOptions& o) {
  std::vector<NamedPath> inputs{{"program", o.program}, {"--pocket", o.pocket}};
  if (!o.stock.empty()) inputs.push_back({"--stock", o.stock});
  for (const EarlierFile& file : o.after) inputs.push_back({"--after", file.path});
  return check_outputs({{"-o", o.output},
                        {"--picture", o.picture},
                        {"--maps", o.maps},
                        {"--report", o.report},
                        {"--animation", o.animation},
                        {"--corrected", o.corrected}},
                       inputs);
}

Result<jobs::HeatResultJob> read_job(const HeatOptions& o) {
  jobs::HeatResultJob job{o.job,
                          jobs::picture_form(o.picture),
                          jobs::picture_form(o.maps),
                          jobs::picture_form(o.report),
                          !o.animation.empty(),
                          {},
                          o.corrected};
  if (!o.corrected.empty()) job.correction = jobs::CorrectionWish{o.finish};
  LEKALO_TRY(job.heat.material, heat::material_of(o.material));
  LEKALO_TRY(job.heat.film, heat::film_of(o.cooling.empty() ? "dry" : o.cooling));
  jobs::HeatSourceJob& source = job.heat.source;
  source.program.name = o.program;
  LEKALO_TRY(source.program.bytes, disk::read_file(o.program));
  source.pocket.name = o.pocket;
  LEKALO_TRY(source.pocket.bytes, disk::read_file(o.pocket));
  if (!o.stock.empty()) {
    source.stock.outline = jobs::File{o.stock, {}};
    LEKALO_TRY(source.stock.outline->bytes, disk::read_file(o.stock));
  }
  LEKALO_TRY(source.after, read_earlier(o.after));
  return job;
}

/// Rounds to hundredths, and to no -0.
double hundredths(double um) { return std::round(100 * um) / 100 + 0.0; }

/// Says how much measured temperatures leave of the share.
std::string calibrated(const jobs::HeatJob& job, const jobs::HeatFound& found) {
  if (job.measured.empty()) return {};
  const Interval stated = job.material[heat::Property::share];
  return fmt::format("  measured             leaves {} of the stated share of {}, and {} J of {} J\n",
                     jobs::between("{:.3g}", found.share), jobs::between("{:.3g}", stated),
                     jobs::between("{:.0f}", found.heat_j),
                     jobs::between("{:.0f}", found.source.work.into_workpiece_j));
}

/// The corrected program, where there is one.
std::string correction(const jobs::HeatResultJob& job, const jobs::HeatResult& made) {
  if (!made.correction || made.correction->program.empty()) return {};
  const jobs::HeatCorrection& c = *made.correction;
  if (c.rounds == 0)
    return fmt::format("{} is the program itself: without heat nothing is moved.\n", job.corrected_as);
  return fmt::format(
      "{}: with its finishing passes moved, walls lie {:+.2f} to {:+.2f} um from their places; the largest\n"
      "error is {} um over the intervals, and no wall lies more than {:.2f} um inside the cold workpiece.\n",
      job.corrected_as, hundredths(c.after.least), hundredths(c.after.most),
      jobs::between("{:.2f}", c.after_over.largest), std::max(0.0, c.after_over.most.greatest));
}

std::string words_of(const jobs::HeatResultJob& job, const jobs::HeatResult& made) {
  const jobs::HeatFound& found = made.found;
  const heat::CuttingWork& work = found.source.work;
  std::string text;
  for (const std::string& warning : made.warnings) text += warning + "\n";
  text += fmt::format(
      "When the workpiece is cold, walls lie {:+.2f} to {:+.2f} um from their places, {:+.2f} in the mean\n"
      "(below 0: the pocket is too small); the largest error is {} um over share, force and cooling.\n",
      hundredths(found.errors.least), hundredths(found.errors.most), hundredths(found.errors.mean),
      jobs::between("{:.2f}", found.largest_um));
  for (const std::string& sentence : jobs::heat_decision(found)) text += sentence + "\n";
  text += correction(job, made);
  const double balance = found.book.in > 0 ? found.book.in : 1,
               of_yield = 100 / job.heat.material[heat::Property::yield].least;
  text += fmt::format(
      "  time                 {:.0f} s, cutting {:.0f} s\n"
      "  work of the cuts     {} J for {:.0f} mm3, at most {} W\n"
      "  into the workpiece   {} J, of which {:.0f} % stay, {:.0f} % go through surfaces, {:.0f} % with "
      "chips\n"
      "  warmest              {} K above the surroundings; the figures of {} hold up to {:.0f} C\n"
      "  largest error by     share {}, force {}, film {} um, each by itself\n"
      "  stress               {} MPa by von Mises, {} % of the yield stress, at X {:.1f} Y {:.1f} Z {:.1f}\n"
      "  places of walls      {}, and {} that the program does not cut\n",
      work.seconds, work.cutting_seconds, jobs::between("{:.0f}", work.work_j), work.volume_mm3,
      jobs::between("{:.0f}", work.greatest_power_w), jobs::between("{:.0f}", found.heat_j),
      100 * found.book.stored / balance, 100 * found.book.lost / balance, 100 * found.book.removed / balance,
      jobs::between("{:.3g}", found.warmest_k), job.heat.material.name, job.heat.material.limit_c(),
      jobs::between("{:.2f}", found.sensitivity.share), jobs::between("{:.2f}", found.sensitivity.force),
      jobs::between("{:.2f}", found.sensitivity.film), jobs::between("{:.3g}", found.stress_mpa),
      jobs::between("{:.0f}", {found.stress_mpa.least * of_yield, found.stress_mpa.greatest * of_yield}),
      found.middle().stress_at.x, found.middle().stress_at.y, found.middle().stress_at.z, found.walls.size(),
      found.uncut);
  text += calibrated(job.heat, found);
  const jobs::HeatWait wait = jobs::heat_wait(found);
  text += fmt::format("  cooling down         {}: {}\n", wait.lasts, wait.verdict);
  return text +
         "All of this is computed and not proved. The machine's growth, residual stress and deflection by "
         "force\n"
         "are not modelled: docs/design/heat-walls.md\n";
}

}  // namespace

Result<int> run_heat(const HeatOptions& o) {
  LEKALO_CHECK(check_paths(o));
  LEKALO_TRY(const jobs::HeatResultJob job, read_job(o));
  LEKALO_TRY(const jobs::HeatResult made, jobs::heat_result(job, progress_lines()));
  disk::AtomicFiles files;
  if (!o.output.empty()) LEKALO_CHECK(files.add(o.output, made.json));
  for (const auto& [path, bytes] : {std::pair{&o.picture, &made.picture},
                                    {&o.maps, &made.maps},
                                    {&o.report, &made.report},
                                    {&o.animation, &made.animation}})
    if (!path->empty()) LEKALO_CHECK(files.add(*path, *bytes));
  const bool corrects = made.correction && !made.correction->program.empty();
  if (corrects) LEKALO_CHECK(files.add(o.corrected, made.correction->program));
  LEKALO_CHECK(files.commit());
  if (o.json) LEKALO_CHECK(print(made.json));
  tell(words_of(job, made));
  return made.correction && !corrects ? 1 : 0;
}

}  // namespace lekalo::cli

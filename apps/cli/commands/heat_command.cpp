#include "heat_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "earlier_programs.hpp"
#include "interrupt.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/heat_result.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using heat::Interval;

Result<void> check_paths(const HeatOptions& o) {
  std::vector<NamedPath> inputs{{"program", o.program}, {"--pocket", o.pocket}};
  if (!o.stock.empty()) inputs.push_back({"--stock", o.stock});
  for (const EarlierFile& file : o.after) inputs.push_back({"--after", file.path});
  return check_outputs({{"-o", o.output}, {"--picture", o.picture}}, inputs);
}

Result<jobs::HeatResultJob> read_job(const HeatOptions& o) {
  jobs::HeatResultJob job{o.job, jobs::picture_form(o.picture)};
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

/// Two figures, or one where both are told by the same.
std::string between(const char* form, const Interval& value) {
  const std::string least = fmt::format(fmt::runtime(form), value.least),
                    greatest = fmt::format(fmt::runtime(form), value.greatest);
  return least == greatest ? least : least + " to " + greatest;
}

/// Rounds to hundredths, and to no -0.
double hundredths(double um) { return std::round(100 * um) / 100 + 0.0; }

/// Rounds away from 0, so that what is below it may be left alone.
double up(double um) { return std::ceil(10 * um) / 10; }

/// A scaling pays where it takes off a fifth at least of the largest error at the worst corner.
std::string decision(const jobs::HeatFound& found) {
  constexpr double kPays = 0.8;
  const double before = found.largest_um.greatest, after = found.scaled_over.largest.greatest;
  std::string text = fmt::format("Where walls may lie {:.1f} um off, leave it.\n", up(before));
  if (!(before > 0)) return text;
  const jobs::UniformScaling& s = found.scaling;
  const std::string scaling = fmt::format(
      "scaling the program by {:.6f} about X {:.3f} Y {:.3f} with a shift of X {:+.2f} Y {:+.2f} um",
      s.factor, s.centre[0], s.centre[1], s.shift_um[0], s.shift_um[1]);
  if (after <= kPays * before)
    text += fmt::format("Else {} leaves {} um: that is plain growth, and a control can do it.\n", scaling,
                        between("{:.1f}", found.scaled_over.largest));
  else
    text += fmt::format(
        "Do not scale by this alone: {} may leave {:.1f} um; state the share, the force or the\n"
        "cooling more closely, or cool more.\n",
        scaling, up(after));
  return text;
}

/// Says how much measured temperatures leave of the share.
std::string calibrated(const jobs::HeatJob& job, const jobs::HeatFound& found) {
  if (job.measured.empty()) return {};
  const Interval stated = job.material[heat::Property::share];
  return fmt::format("  measured             leaves {} of the stated share of {}, and {} J of {} J\n",
                     between("{:.3g}", found.share), between("{:.3g}", stated),
                     between("{:.0f}", found.heat_j), between("{:.0f}", found.source.work.into_workpiece_j));
}

/// A wait pays where it is no longer than a minute or a quarter of the program.
std::string waiting(const jobs::HeatFound& found) {
  constexpr double kMinute = 60, kPart = 0.25;
  const auto half = jobs::waits_over(found.cases, &jobs::HeatCase::half_s),
             tenth = jobs::waits_over(found.cases, &jobs::HeatCase::tenth_s);
  const auto told = [](const std::array<std::optional<double>, 2>& wait) {
    if (!wait[0]) return std::string("more than a day");
    if (!wait[1]) return fmt::format("{:.0f} s or more", *wait[0]);
    return between("{:.0f}", {*wait[0], *wait[1]}) + " s";
  };
  const double worth = std::max(kMinute, kPart * found.source.work.seconds);
  const char* const pays = tenth[1] && *tenth[1] <= worth   ? "that pays before a finishing pass"
                           : tenth[0] && *tenth[0] <= worth ? "that may pay before a finishing pass"
                                                            : "waiting does not pay";
  return fmt::format("  cooling down         to half in {}, to a tenth in {}: {}\n", told(half), told(tenth),
                     pays);
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
      between("{:.2f}", found.largest_um));
  text += decision(found);
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
      work.seconds, work.cutting_seconds, between("{:.0f}", work.work_j), work.volume_mm3,
      between("{:.0f}", work.greatest_power_w), between("{:.0f}", found.heat_j),
      100 * found.book.stored / balance, 100 * found.book.lost / balance, 100 * found.book.removed / balance,
      between("{:.3g}", found.warmest_k), job.heat.material.name, job.heat.material.limit_c(),
      between("{:.2f}", found.sensitivity.share), between("{:.2f}", found.sensitivity.force),
      between("{:.2f}", found.sensitivity.film), between("{:.3g}", found.stress_mpa),
      between("{:.0f}", {found.stress_mpa.least * of_yield, found.stress_mpa.greatest * of_yield}),
      found.middle().stress_at.x, found.middle().stress_at.y, found.middle().stress_at.z, found.walls.size(),
      found.uncut);
  text += calibrated(job.heat, found);
  return text + waiting(found) +
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
  if (!o.picture.empty()) LEKALO_CHECK(files.add(o.picture, made.picture));
  LEKALO_CHECK(files.commit());
  if (o.json) LEKALO_CHECK(print(made.json));
  tell(words_of(job, made));
  return 0;
}

}  // namespace lekalo::cli

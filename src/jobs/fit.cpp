#include "lekalo/jobs/fit.hpp"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "fit_document.hpp"
#include "fit_picture.hpp"
#include "lekalo/fit/material.hpp"
#include "lekalo/verify/claims.hpp"

namespace lekalo::jobs {
namespace {

/// Peaks give way by 0.4 (DIN 7190-1:2017) to 0.8 (before) of both Rz, in diameter: an interval.
constexpr double kLeastSmoothed = 0.4, kMostSmoothed = 0.8;

tl::unexpected<Error> refused(const std::string& sentence) { return failure(ErrorCode::bad_input, sentence); }

std::string names_of_materials() {
  std::string names;
  for (const fit::KnownMaterial& m : fit::known_materials())
    names += (names.empty() ? "" : ", ") + std::string(m.name);
  return names;
}

Result<fit::Material> material_of(const MaterialWords& words, double inner, double outer) {
  fit::Material material;
  if (!words.name.empty()) {
    const fit::KnownMaterial* const known = fit::known_material(words.name);
    if (known == nullptr)
      return refused(
          fmt::format("{}: no such material; there are {}, or give --youngs, --poisson and --yield",
                      words.name, names_of_materials()));
    material = fit::material_in(*known, inner, outer);
    if (material.yield_mpa == 0 && !words.yield_mpa)
      return refused(fmt::format("{}: no yield stress is known of a section as thick as {} mm; give --yield",
                                 words.name, inner > 0 ? (outer - inner) / 2 : outer));
  } else if (!words.youngs_mpa || !words.poisson || !words.yield_mpa) {
    return refused(fmt::format("without --material ({}) a metal needs --youngs, --poisson and --yield",
                               names_of_materials()));
  } else {
    material.name = "as stated";
  }
  for (const auto& [word, number] : {std::pair{&words.youngs_mpa, &material.youngs_mpa},
                                     {&words.poisson, &material.poisson},
                                     {&words.yield_mpa, &material.yield_mpa},
                                     {&words.hardening_mpa, &material.hardening_mpa},
                                     {&words.expansion_per_k, &material.expansion_per_k}})
    if (*word) *number = **word;
  if (!(material.yield_mpa > 0)) return refused("the yield stress has to be above 0 MPa");
  return material;
}

/// The middle of the shaft as seen from that of the hub.
Result<double> middle_of_shaft(const FitJob& job, double shaft_length) {
  const double most = shaft_length - job.length;
  if (!job.from_end) return 0.0;
  if (!(*job.from_end >= 0 && *job.from_end <= most))
    return refused(
        fmt::format("the hub ends {} mm from the end of the shaft; on a shaft of {} mm a hub of {} mm "
                    "does so from 0 to {:.6g} mm",
                    *job.from_end, shaft_length, job.length, most));
  const double middle = *job.from_end - most / 2;
  return std::abs(middle) <= 1e-9 * shaft_length ? 0.0 : middle;
}

Result<fit::Assembly> assembled(const FitJob& job, double diameter) {
  fit::Assembly assembly;
  const double shaft_length = job.shaft_length > 0 ? job.shaft_length : 3 * job.length;
  const MaterialWords& of_shaft = job.shaft_material ? *job.shaft_material : job.material;
  if (!(job.bore >= 0 && job.bore < diameter))
    return refused(
        fmt::format("the shaft: its bore is {} mm, not below its diameter of {} mm", job.bore, diameter));
  if (!(job.hub_outer > diameter))
    return refused(fmt::format("the hub: its outer diameter is {} mm, not above its bore of {} mm",
                               job.hub_outer, diameter));
  if (shaft_length < job.length)
    return refused(fmt::format("the shaft is {} mm long and the hub {} mm; it has to be as long at least",
                               shaft_length, job.length));
  LEKALO_TRY(const fit::Material shaft, material_of(of_shaft, job.bore, diameter));
  LEKALO_TRY(const double middle, middle_of_shaft(job, shaft_length));
  assembly.rings.push_back({job.bore, diameter, shaft_length, shaft, middle});
  double inner = diameter;
  std::vector<OuterRing> rings{{job.hub_outer, 0}};
  rings.insert(rings.end(), job.more.begin(), job.more.end());
  for (const OuterRing& ring : rings) {
    LEKALO_TRY(const fit::Material material, material_of(job.material, inner, ring.outer_diameter));
    assembly.rings.push_back({inner, ring.outer_diameter, job.length, material, 0});
    inner = ring.outer_diameter;
  }
  LEKALO_CHECK(fit::check_assembly(assembly));
  return assembly;
}

double stated_most(const FitJob& job) {
  return job.most_interference > 0 ? job.most_interference : job.interference;
}

struct Interference {
  double at_least = 0, at_most = 0;  // um
};

Result<Interference> interference_of(const FitJob& job, const std::optional<fit::NamedFit>& named) {
  Interference i{1000 * job.interference, 1000 * stated_most(job)};
  std::string whose = fmt::format("the interference is {} um", i.at_least);
  if (named) {
    i = {named->least_um, named->greatest_um};
    whose = fmt::format("{}: the interference is {} to {} um", job.fit, i.at_least, i.at_most);
  }
  if (!(i.at_least > 0))
    return refused(whose +
                   ", and has to be above 0 throughout; choose a tighter fit, or state one with "
                   "--diameter MM --interference MM");
  if (job.roughness_um) {
    const double rz = (*job.roughness_um)[0] + (*job.roughness_um)[1];
    i.at_least -= kMostSmoothed * rz, i.at_most -= kLeastSmoothed * rz;
    if (!(i.at_least > 0))
      return refused(
          fmt::format("{}, and smoothing takes up to {:.6g} um of it, so nothing may be left; choose a "
                      "tighter fit or smoother surfaces",
                      whose, kMostSmoothed * rz));
  }
  return i;
}

/// One path through all cases. What has yielded through and does not harden carries no more.
Result<void> press_all(const FitJob& job, const Interference& interference, Fitted& made,
                       const PhaseListener& phases, std::uint64_t& work) {
  std::vector<std::pair<const char*, double>> stations{{"pressing", interference.at_most}};
  if (interference.at_least != interference.at_most)
    stations = {{"pressing the least interference", interference.at_least},
                {"pressing the mean interference", (interference.at_least + interference.at_most) / 2},
                {"pressing the greatest interference", interference.at_most}};
  fit::Pressing pressing(made.assembly);
  for (const auto& [words, um] : stations) {
    const ProgressListener listening = begin_phase(phases, words);
    std::vector<double> seats{um / 1000};
    for (const OuterRing& ring : job.more) seats.push_back(ring.interference);
    FitCase one;
    one.interference = um / 1000;
    LEKALO_TRY(one.pressed, pressing.press(seats));
    if (one.pressed.state == fit::State::full)
      for (std::size_t i = 0; i < one.pressed.rings.size(); ++i)
        if (one.pressed.rings[i].through && made.assembly.rings[i].material.hardening_mpa == 0)
          return refused(
              fmt::format("{} yields through its whole wall at {:.6g} um and does not harden, so it carries "
                          "no more; choose a smaller interference, a thicker wall, or state --hardening",
                          fit::ring_name(i), um));
    LEKALO_TRY(one.released, pressing.released());
    one.din = fit::din_7190(made.assembly, one.interference);
    made.cases.push_back(std::move(one));
  }
  work = pressing.work();
  return {};
}

/// The diameter of the shaft before pressing and before smoothing: in the middle of its limits, or beyond
/// that of a hub whose bore is the nominal one.
double seat_diameter(const FitJob& job, const Fitted& made) {
  const double diameter = made.assembly.rings.front().outer_diameter;
  if (!made.named) return diameter + (job.interference + stated_most(job)) / 2;
  return diameter + (made.named->shaft_limits.lower_um + made.named->shaft_limits.upper_um) / 2000;
}

/// The profile for the mean interference, pressed again at all of them, and its files.
Result<void> correct(const FitJob& job, Fitted& made, const PhaseListener& phases) {
  const ProgressListener listening = begin_phase(phases, "pressing again with the turned profile");
  std::vector<std::vector<double>> interferences;
  std::vector<fit::Pressed> pressed;
  for (const FitCase& one : made.cases)
    interferences.push_back(one.pressed.interference), pressed.push_back(one.pressed);
  LEKALO_TRY(made.corrected, fit::corrected(made.assembly, interferences, pressed, made.cases.size() / 2,
                                            *job.cylindrical, seat_diameter(job, made)));
  if (!job.table_as.empty()) made.table = fit::profile_csv(*made.corrected);
  if (!job.drawing_as.empty()) made.drawing = fit::profile_dxf(*made.corrected);
  if (!job.program_as.empty()) made.program = fit::turning_program(*made.corrected, job.turning);
  return {};
}

/// The files that the document names, in its order.
std::vector<verify::Document> files_of(const FitJob& job, const Fitted& made) {
  std::vector<verify::Document> files;
  for (const auto& [name, bytes] : {std::pair{&job.table_as, &made.table},
                                    {&job.drawing_as, &made.drawing},
                                    {&job.program_as, &made.program}})
    if (!bytes->empty()) files.push_back({*name, *bytes});
  return files;
}

}  // namespace

Result<Fitted> fit(const FitJob& job, const PhaseListener& phases) {
  Fitted made;
  double diameter = job.diameter;
  if (!job.fit.empty()) {
    LEKALO_TRY(made.named, fit::read_fit(job.fit));
    diameter = made.named->diameter_mm;
  }
  if (!(diameter > 0)) return refused(fmt::format("the diameter is {} mm; it has to be above 0", diameter));
  for (const OuterRing& ring : job.more)
    if (!(ring.interference > 0))
      return refused(fmt::format("the interference of the ring of {} mm is {} mm; it has to be above 0",
                                 ring.outer_diameter, ring.interference));
  LEKALO_TRY(const Interference interference, interference_of(job, made.named));
  LEKALO_TRY(made.assembly, assembled(job, diameter));
  std::uint64_t work = 0;
  if (job.cylindrical == fit::Surface::bore && job.bore == 0)
    return refused(
        "the shaft has no bore that could be made cylindrical; give --bore, or choose the outside");
  LEKALO_CHECK(press_all(job, interference, made, phases, work));
  if (job.cylindrical) LEKALO_CHECK(correct(job, made, phases));
  LEKALO_TRY(made.picture, drawn_fit(job, made));
  made.json = fit_json(job, made, work);
  LEKALO_TRY(const verify::ClaimReport report,
             verify::verify_fit_report({"the result", made.json}, files_of(job, made)));
  if (!report.findings.empty())
    return failure(ErrorCode::refuted, "the checker refutes the result: " + report.findings.front());
  return made;
}

}  // namespace lekalo::jobs

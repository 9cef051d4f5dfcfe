#include "lekalo/jobs/heat_result.hpp"

#include <fmt/core.h>

#include "heat_document.hpp"
#include "heat_path.hpp"
#include "heat_picture.hpp"
#include "heat_scene.hpp"
#include "heat_voxels.hpp"
#include "lekalo/verify/claims.hpp"

namespace lekalo::jobs {
namespace {

/// How far heat gets ahead of a tool that goes at its mean feed, mm: what it passes within that has taken
/// heat away with the chips.
double ahead_of_tool(const heat::Material& material, const HeatSource& source) {
  using heat::Property;
  double way = 0, seconds = 0;
  for (const heat::ToolPiece& piece : source.pieces)
    if (!piece.rim.empty()) way += piece.length, seconds += piece.seconds;
  const double diffusivity =
      material[Property::conductivity].middle() * 1e6 /
      (material[Property::density].middle() * material[Property::heat_capacity].middle());
  return diffusivity * seconds / way;
}

std::vector<std::string> warnings_of(const HeatJob& job, const HeatFound& found) {
  std::vector<std::string> warnings;
  const double greatest = job.ambient_c + found.warmest_k.greatest;
  if (greatest > job.material.limit_c())
    warnings.push_back(
        fmt::format("the workpiece may get {:.0f} degrees C warm, and the figures of {} hold up "
                    "to {:.0f}",
                    greatest, job.material.name, job.material.limit_c()));
  const double ahead = ahead_of_tool(job.material, found.source);
  if (ahead < job.pitch)
    warnings.push_back(fmt::format(
        "heat gets {:.2g} mm ahead of the tool at its mean feed, and voxels of {:.3g} mm are larger: "
        "less of it leaves with the chips than would, and walls may lie a fifth less far off; "
        "--voxel {:.2g} shows it",
        ahead, job.pitch, ahead));
  for (const auto& told : {thin_voxels(job, found), path_off_walls(job, found)})
    if (told) warnings.push_back(*told);
  if (const auto& read = found.source.stock.read)
    warnings.insert(warnings.end(), read->notices.begin(), read->notices.end());
  warnings.insert(warnings.end(), found.source.unsaid.begin(), found.source.unsaid.end());
  return warnings;
}

/// The files that the document names, in its order.
std::vector<verify::Document> files_of(const HeatSourceJob& source) {
  std::vector<verify::Document> files{{source.program.name, source.program.bytes},
                                      {source.pocket.name, source.pocket.bytes}};
  if (source.stock.outline) files.push_back({source.stock.outline->name, source.stock.outline->bytes});
  for (const EarlierProgram& before : source.after)
    files.push_back({before.program.name, before.program.bytes});
  return files;
}

}  // namespace

Result<HeatResult> heat_result(const HeatResultJob& job, const PhaseListener& phases) {
  HeatResult made;
  HeatJob recorded = job.heat;
  recorded.record = job.maps || job.report || job.animation;
  LEKALO_TRY(made.found, heat(recorded, phases));
  made.warnings = warnings_of(job.heat, made.found);
  CorrectedFile corrected{job.corrected_as, nullptr};
  std::vector<verify::Document> files = files_of(job.heat.source);
  if (job.correction) {
    LEKALO_TRY(made.correction, heat_correction(job.heat, made.found, *job.correction, phases));
    if (made.correction->program.empty()) {
      made.warnings.push_back(made.correction->why_not);
    } else {
      corrected.correction = &*made.correction;
      if (made.correction->dropped_um > 0)
        made.warnings.push_back(
            fmt::format("a control of increment system IS-B drops the last decimals of {}, up to {:.2f} um, "
                        "which is in no "
                        "figure here; let the control read them, or state the program with fewer decimals",
                        job.corrected_as, made.correction->dropped_um));
      files.push_back({job.corrected_as, made.correction->program});
    }
  }
  made.json = heat_json(job.heat, made.found, made.warnings, corrected);
  const ProgressListener listening = begin_phase(phases, "following the program again");
  LEKALO_TRY(const verify::ClaimReport report, verify::verify_heat_report({"the result", made.json}, files));
  if (!report.findings.empty())
    return failure(ErrorCode::refuted, "the checker refutes the result: " + report.findings.front());
  LEKALO_TRY(made.picture, drawn_heat(job, made.found));
  LEKALO_CHECK(add_heat_scenes(job, made));
  return made;
}

}  // namespace lekalo::jobs

#include "lekalo/jobs/simulate.hpp"

#include <fmt/core.h>

#include "jobs/document/earlier_documents.hpp"
#include "jobs/document/report_document.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "simulate_picture.hpp"

namespace lekalo::jobs {
namespace {

std::string report_json(const SimulateJob& job, const Simulated& done) {
  io::JsonWriter json = begin_document("lekalo-simulate");
  json.field("units", "mm").key("inputs").begin_list();
  write_file(json, "program", job.program);
  write_file(json, "pocket", job.pocket);
  write_earlier(json, job.after);
  write_machining(json.end(), job.machining);
  write_report(json, done.report);
  if (!done.unsaid.empty()) json.key("unsaid").list(done.unsaid);
  json.field("version", kVersion);
  return end_document(json);
}

std::string samples_csv(const verify::SimulateReport& r) {
  std::string text = "x,y,z,length,engagement_deg,line,entry\n";
  for (const verify::EngagementSample& s : r.samples)
    text += fmt::format("{:.5f},{:.5f},{:.5f},{:.5f},{:.3f},{},{}\n", s.x, s.y, s.z, s.length, s.engagement,
                        s.line, s.entry ? 1 : 0);
  return text;
}

Result<void> add_pictures(const SimulateJob& job, Simulated& done) {
  if (!job.picture && !job.animation) return {};
  std::vector<geom::Edge> open;
  LEKALO_TRY(const io::RegionFile pocket, io::parse_regions(job.pocket.bytes, job.pocket.name, {}, &open));
  const draw::PocketPicture picture =
      cut_picture_of(job.pocket.name, pocket.regions, job.machining.tool_diameter,
                     job.machining.stock_to_leave, done.report);
  LEKALO_TRY(done.picture, drawn(picture, job.picture));
  if (job.animation) done.animation = draw::pocket_animation(picture);
  return {};
}

}  // namespace

Result<Simulated> simulate(const SimulateJob& job, const PhaseListener& phases) {
  Simulated done;
  const verify::Document program{job.program.name, job.program.bytes};
  const std::vector<verify::EarlierProgram> earlier = earlier_documents(job.after);
  LEKALO_TRY(done.report, verify::simulate(program, {job.pocket.name, job.pocket.bytes}, job.machining,
                                           earlier, begin_phase(phases, "following the program")));
  LEKALO_TRY(done.unsaid, verify::unsaid_modes(program, job.machining, earlier));
  done.json = report_json(job, done);
  if (job.samples) done.samples = samples_csv(done.report);
  LEKALO_CHECK(add_pictures(job, done));
  return done;
}

}  // namespace lekalo::jobs

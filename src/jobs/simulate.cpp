#include "lekalo/jobs/simulate.hpp"

#include <fmt/core.h>

#include "earlier_documents.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "report_document.hpp"
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

/// The checker calls the program itself "program", whatever its file is called.
Result<std::vector<std::string>> unsaid_of(const SimulateJob& job) {
  const double top = job.machining.top;
  LEKALO_TRY(std::vector<std::string> all,
             verify::unsaid_modes({"program", job.program.bytes}, top, job.machining.control));
  for (const EarlierProgram& earlier : job.after) {
    LEKALO_TRY(
        const std::vector<std::string> more,
        verify::unsaid_modes({earlier.program.name, earlier.program.bytes}, top, job.machining.control));
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
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
  LEKALO_TRY(done.report,
             verify::simulate({job.program.name, job.program.bytes}, {job.pocket.name, job.pocket.bytes},
                              job.machining, earlier_documents(job.after),
                              begin_phase(phases, "following the program")));
  LEKALO_TRY(done.unsaid, unsaid_of(job));
  done.json = report_json(job, done);
  if (job.samples) done.samples = samples_csv(done.report);
  LEKALO_CHECK(add_pictures(job, done));
  return done;
}

}  // namespace lekalo::jobs

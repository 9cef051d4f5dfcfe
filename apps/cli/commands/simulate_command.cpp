#include "simulate_command.hpp"

#include "cut_words.hpp"
#include "earlier_programs.hpp"
#include "interrupt.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/simulate.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

Result<void> check_paths(const SimulateOptions& o) {
  std::vector<NamedPath> inputs{{"program", o.program}, {"--pocket", o.pocket}};
  for (const EarlierFile& file : o.after) inputs.push_back({"--after", file.path});
  return check_outputs({{"--samples", o.samples}, {"--picture", o.picture}, {"--animation", o.animation}},
                       inputs);
}

Result<jobs::SimulateJob> read_job(const SimulateOptions& o) {
  jobs::SimulateJob job;
  job.program.name = o.program;
  LEKALO_TRY(job.program.bytes, disk::read_file(o.program));
  job.pocket.name = o.pocket;
  LEKALO_TRY(job.pocket.bytes, disk::read_file(o.pocket));
  LEKALO_TRY(job.after, read_earlier(o.after));
  job.machining = o.machining;
  job.picture = jobs::picture_form(o.picture);
  job.animation = !o.animation.empty();
  job.samples = !o.samples.empty();
  return job;
}

Result<void> write_all(const SimulateOptions& o, const jobs::Simulated& done) {
  disk::AtomicFiles files;
  if (!o.samples.empty()) LEKALO_CHECK(files.add(o.samples, done.samples));
  if (!o.picture.empty()) LEKALO_CHECK(files.add(o.picture, done.picture));
  if (!o.animation.empty()) LEKALO_CHECK(files.add(o.animation, done.animation));
  return files.commit();
}

}  // namespace

Result<int> run_simulate(const SimulateOptions& o) {
  LEKALO_CHECK(check_paths(o));
  LEKALO_TRY(const jobs::SimulateJob job, read_job(o));
  LEKALO_TRY(const jobs::Simulated done, jobs::simulate(job, progress_lines()));
  LEKALO_CHECK(write_all(o, done));
  if (o.json) LEKALO_CHECK(print(done.json));
  std::string unsaid;
  for (const std::string& sentence : done.unsaid) unsaid += sentence + "\n";
  tell(unsaid + report_rows(done.report));
  return 0;
}

}  // namespace lekalo::cli

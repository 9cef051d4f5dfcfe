#include "locate_command.hpp"

#include <array>
#include <chrono>
#include <optional>

#include "interrupt.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/locate.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

Result<jobs::File> read_named(const std::string& path) {
  LEKALO_TRY(std::string bytes, disk::read_file(path));
  return jobs::File{path, std::move(bytes)};
}

Result<void> read_if_named(const std::string& path, std::optional<jobs::File>& to) {
  if (path.empty()) return {};
  LEKALO_TRY(to, read_named(path));
  return {};
}

Result<jobs::LocateJob> read_files(const LocateOptions& o) {
  jobs::LocateJob job{{}, {}, {}, {}, {}, {}, o.job, o.outputs, o.warnings};
  LEKALO_TRY(job.part, read_named(o.part));
  LEKALO_TRY(job.blank, read_named(o.blank));
  LEKALO_CHECK(read_if_named(o.nc, job.program));
  LEKALO_CHECK(read_if_named(o.allow, job.allow));
  LEKALO_CHECK(read_if_named(o.features, job.features));
  LEKALO_CHECK(read_if_named(o.compare, job.earlier));
  return job;
}

Result<jobs::Located> located(const jobs::LocateJob& job, const LocateOptions& o) {
  if (o.seconds) StopRequests::end_at(*o.seconds);
  std::optional<ProgressLine> line;
  RunControl run;
  run.stop = StopRequests::flag();
  run.work_limit = o.work;
  run.progress = [&line](const Progress& progress) {
    if (!line) line.emplace("searching");
    line->show(progress);
  };
  return jobs::locate(job, run, [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  });
}

/// All files, or none: they get their names only after stdout has taken the result. Returns their names.
Result<std::vector<std::string>> write_all(const LocateOptions& o, const jobs::Located& made) {
  const std::array<std::pair<const std::string*, const std::string*>, 8> documents{
      {{&o.output, &made.result},
       {&o.outputs.certificate, &made.certificate},
       {&o.picture, &made.picture},
       {&o.report, &made.report},
       {&o.allowances, &made.allowances},
       {&o.drawing, &made.drawing},
       {&o.outputs.deviations, &made.deviations},
       {&o.outputs.program, &made.program}}};
  disk::AtomicFiles files;
  std::vector<std::string> written;
  for (const auto& [path, bytes] : documents) {
    if (path->empty() || (bytes == &made.program && !made.document.nc)) continue;
    LEKALO_CHECK(files.add(*path, *bytes));
    written.push_back(*path);
  }
  if (o.json) LEKALO_CHECK(print(made.result));
  LEKALO_CHECK(files.commit());
  return written;
}

}  // namespace

Result<int> run_locate(const LocateOptions& o) {
  LEKALO_CHECK(check_outputs({{"-o", o.output},
                              {"--certificate", o.outputs.certificate},
                              {"--picture", o.picture},
                              {"--report", o.report},
                              {"--allowances", o.allowances},
                              {"--drawing", o.drawing},
                              {"--deviations", o.outputs.deviations},
                              {"--nc-out", o.outputs.program}},
                             {{"--part", o.part},
                              {"--blank", o.blank},
                              {"--nc", o.nc},
                              {"--allow", o.allow},
                              {"--compare", o.compare},
                              {"--features", o.features}}));
  LEKALO_TRY(const jobs::LocateJob job, read_files(o));
  LEKALO_TRY(const jobs::Located made, located(job, o));
  const ToTheEnd to_the_end;
  LEKALO_TRY(const std::vector<std::string> written, write_all(o, made));
  tell(locate_summary(made.document, written));
  return made.holds() ? 0 : 1;
}

}  // namespace lekalo::cli

#include "locate_command.hpp"

#include <chrono>
#include <optional>
#include <utility>

#include "interrupt.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/jobs/locate.hpp"
#include "lekalo/jobs/locate_solid.hpp"
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

Result<jobs::LocateJob> read_files(const LocateOptions& o, jobs::File part, jobs::File blank) {
  jobs::LocateJob job{std::move(part), std::move(blank), {}, {}, {}, {}, o.job, o.outputs, o.warnings};
  LEKALO_CHECK(read_if_named(o.nc, job.program));
  LEKALO_CHECK(read_if_named(o.allow, job.allow));
  LEKALO_CHECK(read_if_named(o.features, job.features));
  LEKALO_CHECK(read_if_named(o.compare, job.earlier));
  return job;
}

Result<jobs::SolidLocateJob> read_solids(const LocateOptions& o, jobs::File part, jobs::File blank) {
  jobs::SolidLocateJob job{std::move(part), std::move(blank), {}, {}, {}, {}, o.solid, {}, o.warnings};
  LEKALO_CHECK(read_if_named(o.start, job.start));
  LEKALO_CHECK(read_if_named(o.nominal, job.nominal));
  LEKALO_CHECK(read_if_named(o.features, job.features));
  LEKALO_CHECK(read_if_named(o.nc, job.program));
  LEKALO_CHECK(read_if_named(o.allow, job.allow));
  job.outputs.certificate = o.outputs.certificate, job.outputs.mesh = o.mesh;
  job.outputs.program = o.outputs.program;
  job.outputs.offset = o.offset_out;
  job.outputs.allowances = o.outputs.allowances;
  if (!o.outputs.deviations.empty())
    job.outputs.deviations =
        o.outputs.deviations.ends_with(".ply") ? jobs::SolidPointsForm::ply : jobs::SolidPointsForm::csv;
  job.outputs.report = o.outputs.report;
  if (!o.picture.empty())
    job.outputs.picture = o.picture.ends_with(".html")  ? jobs::SolidPictureForm::html
                          : o.picture.ends_with(".ply") ? jobs::SolidPictureForm::ply
                                                        : jobs::SolidPictureForm::png;
  return job;
}

/// Does a job of localisation, with progress, Ctrl-C and the limits of time and work.
template <class Job, class Work>
auto searched(const Job& job, const LocateOptions& o, const Work& work) {
  if (o.seconds) StopRequests::end_at(*o.seconds);
  std::optional<ProgressLine> line;
  RunControl run;
  run.stop = StopRequests::flag();
  run.work_limit = o.work;
  run.progress = [&line](const Progress& progress) {
    if (!line) line.emplace("searching");
    line->show(progress);
  };
  return work(job, run, [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  });
}

struct Output {
  const std::string *path, *bytes;
};

/// All files, or none: they get their names only after stdout has taken the result. Returns their names.
Result<std::vector<std::string>> write_all(const LocateOptions& o, const std::string& result,
                                           const std::vector<Output>& documents) {
  disk::AtomicFiles files;
  std::vector<std::string> written;
  for (const auto& [path, bytes] : documents) {
    if (path->empty()) continue;
    LEKALO_CHECK(files.add(*path, *bytes));
    written.push_back(*path);
  }
  if (o.json) LEKALO_CHECK(print(result));
  LEKALO_CHECK(files.commit());
  return written;
}

Result<int> locate_outline(const LocateOptions& o, jobs::File part, jobs::File blank) {
  LEKALO_TRY(const jobs::LocateJob job, read_files(o, std::move(part), std::move(blank)));
  const auto located = [](const auto& outlines, const RunControl& run, const jobs::Stopwatch& stopwatch) {
    return jobs::locate(outlines, run, stopwatch, StopRequests::interrupt());
  };
  LEKALO_TRY(const jobs::Located made, searched(job, o, located));
  const ToTheEnd to_the_end;
  std::vector<Output> documents{{&o.output, &made.result},
                                {&o.outputs.certificate, &made.certificate},
                                {&o.picture, &made.picture},
                                {&o.report, &made.report},
                                {&o.allowances, &made.allowances},
                                {&o.drawing, &made.drawing},
                                {&o.outputs.deviations, &made.deviations}};
  if (made.document.nc) documents.push_back({&o.outputs.program, &made.program});
  LEKALO_TRY(const std::vector<std::string> written, write_all(o, made.result, documents));
  tell(locate_summary(made.document, written));
  return made.holds() ? 0 : 1;
}

Result<int> locate_solid(const LocateOptions& o, jobs::File part, jobs::File blank) {
  LEKALO_TRY(const jobs::SolidLocateJob job, read_solids(o, std::move(part), std::move(blank)));
  const auto located = [](const auto& solids, const RunControl& run, const jobs::Stopwatch& stopwatch) {
    return jobs::locate_solid(solids, run, stopwatch, progress_lines());
  };
  LEKALO_TRY(const jobs::LocatedSolid made, searched(job, o, located));
  const ToTheEnd to_the_end;
  std::vector<Output> documents{
      {&o.output, &made.result},         {&o.outputs.certificate, &made.certificate},
      {&o.picture, &made.picture},       {&o.report, &made.report},
      {&o.allowances, &made.allowances}, {&o.outputs.deviations, &made.deviations}};
  if (!made.mesh.empty()) documents.push_back({&o.mesh, &made.mesh});
  if (made.document.nc) documents.push_back({&o.outputs.program, &made.program});
  if (made.document.offset) documents.push_back({&o.offset_out, &made.offset});
  LEKALO_TRY(const std::vector<std::string> written, write_all(o, made.result, documents));
  tell(solid_summary(made.document, written));
  return made.holds() ? 0 : 1;
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
                              {"--mesh", o.mesh},
                              {"--nc-out", o.outputs.program},
                              {"--offset-out", o.offset_out}},
                             {{"--part", o.part},
                              {"--blank", o.blank},
                              {"--nc", o.nc},
                              {"--allow", o.allow},
                              {"--compare", o.compare},
                              {"--features", o.features},
                              {"--start", o.start},
                              {"--nominal-blank", o.nominal}}));
  LEKALO_TRY(jobs::File part, read_named(o.part));
  LEKALO_TRY(jobs::File blank, read_named(o.blank));
  LEKALO_TRY(const bool solids, jobs::are_solids(part, blank));
  if (const std::string& wrong = solids ? o.not_for_solids : o.not_for_outlines; !wrong.empty())
    return failure(ErrorCode::usage, wrong + " (see lekalo locate --help)");
  return solids ? locate_solid(o, std::move(part), std::move(blank))
                : locate_outline(o, std::move(part), std::move(blank));
}

}  // namespace lekalo::cli

#include "pocket_command.hpp"

#include <fmt/core.h>

#include <utility>

#include "cut_words.hpp"
#include "earlier_programs.hpp"
#include "interrupt.hpp"
#include "lekalo/disk/files.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

Result<void> check_paths(const PocketOptions& o) {
  std::vector<NamedPath> inputs{{"pocket", o.pocket}};
  for (const EarlierFile& file : o.after) inputs.push_back({"--after", file.path});
  return check_outputs({{"-o", o.output}, {"--picture", o.picture}, {"--animation", o.animation}}, inputs);
}

Result<jobs::PocketJob> read_job(const PocketOptions& o) {
  jobs::PocketJob job;
  job.pocket.name = o.pocket;
  LEKALO_TRY(job.pocket.bytes, disk::read_file(o.pocket));
  LEKALO_TRY(job.after, read_earlier(o.after));
  job.options = o;
  job.written_as = o.output;
  job.picture = jobs::picture_form(o.picture);
  job.animation = !o.animation.empty();
  job.images = !o.images.empty();
  return job;
}

/// Writes everything that was asked for, and returns the names of the files.
Result<std::vector<std::string>> write_all(const PocketOptions& o, const jobs::Pocketed& made) {
  disk::AtomicFiles files;
  std::vector<std::string> written;
  const auto add = [&](const std::string& path, const std::string& bytes) -> Result<void> {
    if (path.empty()) return {};
    written.push_back(path);
    return files.add(path, bytes);
  };
  LEKALO_CHECK(add(o.output, made.program));
  LEKALO_CHECK(add(o.picture, made.picture));
  LEKALO_CHECK(add(o.animation, made.animation));
  for (const auto& [ending, bytes] : made.images) LEKALO_CHECK(add(o.images + ending, bytes));
  LEKALO_CHECK(files.commit());
  return written;
}

std::string words(const PocketOptions& o, const jobs::Pocketed& made) {
  std::string text;
  for (const std::string& notice : made.notices) text += notice + "\n";
  if (o.rest_of > 0)
    text += fmt::format(
        "Supposed: a tool of {:g} mm has cut all that lekalo pocket cuts with it (--after FILE:{:g} "
        "takes the program that ran)\n",
        o.rest_of, o.rest_of);
  return text + ramp_notices(made.ramps) + hot_cut_notices(made.hot_cuts) + report_rows(made.report);
}

}  // namespace

Result<int> run_pocket(const PocketOptions& o) {
  LEKALO_CHECK(check_paths(o));
  LEKALO_TRY(const jobs::PocketJob job, read_job(o));
  LEKALO_TRY(const jobs::Pocketed made, jobs::pocket(job, progress_lines()));
  LEKALO_TRY(const std::vector<std::string> written, write_all(o, made));
  if (o.json || o.output.empty()) LEKALO_CHECK(print(o.json ? made.json : made.program));
  std::string text = words(o, made);
  for (const std::string& name : written) text += fmt::format("Written: {}\n", name);
  tell(text);
  return 0;
}

}  // namespace lekalo::cli

#include "export_command.hpp"

#include <fmt/core.h>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/export.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

std::string processes_of(const ExportOptions& o) { return o.form.process ? o.form.process->file.name : ""; }

/// Writes one file for each sheet, all or none of them, and returns the lines that say so.
Result<std::string> write_sheets(const ExportOptions& o, const std::vector<io::ExportedFile>& sheets) {
  std::vector<NamedPath> paths;
  for (std::size_t i = 0; i < sheets.size(); ++i)
    paths.push_back({"--output", path_of_sheet(o.output, i, sheets.size())});
  LEKALO_CHECK(check_outputs(
      paths,
      {{"the layout", o.source.path}, {"--instance", o.source.instance}, {"--processes", processes_of(o)}}));
  disk::AtomicFiles files;
  std::string said;
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    LEKALO_CHECK(files.add(paths[i].path, sheets[i].bytes));
    said += fmt::format("Written: {}", paths[i].path);
    said += sheets.size() == 1 ? "\n" : fmt::format(", sheet {}\n", sheets[i].sheet);
  }
  LEKALO_CHECK(files.commit());
  return said;
}

}  // namespace

Result<int> run_export(const ExportOptions& o) {
  jobs::ExportOptions form = o.form;
  std::string said;
  if (form.process) {
    LEKALO_TRY(form.process->file.bytes, disk::read_file(form.process->file.name));
  }
  LEKALO_TRY(const jobs::Layout input,
             read_layout_input(o.source, {{"--output", o.output}}, {{"--processes", processes_of(o)}}));
  LEKALO_TRY(const io::Exported made, jobs::export_layout(input, form));
  if (o.form.form == jobs::LayoutForm::placements && o.form.instance_name.empty() &&
      input.instance_name.empty())
    said += "note: the placements do not say where their items stand; --instance-name does\n";
  said += notes(input.notices) + notes(made.notes);
  if (!o.output.empty()) {
    LEKALO_TRY(const std::string written, write_sheets(o, made.files));
    said += written;
  } else if (made.files.size() > 1) {
    return failure(ErrorCode::usage,
                   fmt::format("{} sheets are in use and each is a file of its own: name the files with "
                               "--output, or one sheet with --sheet, for example --sheet {}",
                               made.files.size(), made.files.front().sheet));
  } else {
    LEKALO_CHECK(print(made.files.front().bytes));
  }
  tell(said);
  return 0;
}

}  // namespace lekalo::cli

#include "export_command.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <filesystem>
#include <set>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/layout/process_file.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/export.hpp"
#include "lekalo/jobs/material.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// "cut.nc" becomes "cut-2.nc" for the second of several sheets.
std::string numbered(const std::string& path, std::size_t number) {
  const std::filesystem::path whole(path);
  return (whole.parent_path() /
          (whole.stem().string() + fmt::format("-{}", number) + whole.extension().string()))
      .string();
}

/// Writes one file for each sheet, all or none of them, and returns the lines that say so.
Result<std::string> write_sheets(const ExportOptions& o, const std::vector<io::ExportedFile>& sheets) {
  std::vector<NamedPath> paths;
  for (std::size_t i = 0; i < sheets.size(); ++i)
    paths.push_back({"--output", sheets.size() == 1 ? o.output : numbered(o.output, i + 1)});
  LEKALO_CHECK(check_outputs(paths, {{"the layout", o.source.path},
                                     {"--instance", o.source.instance},
                                     {"--processes", o.process ? o.process->path : ""}}));
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

struct TakenProcess {
  io::ExportRequest request;
  std::string said;  ///< a line that names the entry
};

Result<TakenProcess> take_process(const ProcessSource& source) {
  LEKALO_TRY(const std::string bytes, disk::read_file(source.path));
  LEKALO_TRY(const io::ProcessFile file, io::read_processes(bytes, io::as_utf8(source.path)));
  LEKALO_TRY(const std::size_t index,
             io::find_process(file, source.material, source.thickness_mm, source.kind));
  const io::CutProcess& process = file.processes[index];
  LEKALO_TRY(io::ExportRequest request, io::process_request(process, source.words, "--"));
  return TakenProcess{std::move(request),
                      fmt::format("note: the process is entry {} of {}: {}, {} mm ({})\n", index + 1,
                                  file.name, process.material, process.thickness_mm, process.kind)};
}

/// Tells the sheets in use that are of another material than the process is for.
std::string other_materials(const layout::Document& document, const ProcessSource& process) {
  std::set<std::uint32_t> used;
  for (const layout::Placement& placement : document.placements) used.insert(placement.stock);
  std::string text;
  for (const std::uint32_t i : used) {
    const layout::Stock& stock = document.stocks[i];
    const bool other_name = !stock.material.name.empty() && stock.material.name != process.material,
               other_thickness = stock.material.thickness != 0 &&
                                 stock.material.thickness != geom::grid_from_mm(process.thickness_mm);
    if (other_name || other_thickness)
      text += fmt::format("warning: {} is of {}, and the process is for {}, {} mm\n", stock.id,
                          jobs::words_of(stock.material), process.material, process.thickness_mm);
  }
  return text;
}

}  // namespace

Result<int> run_export(const ExportOptions& o) {
  jobs::ExportOptions form = o.form;
  std::string said;
  if (o.process) {
    LEKALO_TRY(TakenProcess taken, take_process(*o.process));
    form.machine = std::move(taken.request);
    said = std::move(taken.said);
  }
  LEKALO_TRY(const jobs::Layout input,
             read_layout_input(o.source, {{"--output", o.output}},
                               {{"--processes", o.process ? o.process->path : ""}}));
  if (o.process) said += other_materials(input.document, *o.process);
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

#include "lekalo/jobs/export.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <set>
#include <utility>

#include "lekalo/draw/label/layout_labels.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/layout/process_file.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/show.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/material_words.hpp"
#include "lekalo/verify/claims.hpp"

namespace lekalo::jobs {
namespace {

std::string title_of(const Layout& layout, const ExportOptions& options) {
  if (!options.title.empty()) return options.title;
  return layout.document.name.empty() ? io::stem_of(layout.name) : layout.document.name;
}

/// Adds the name of the file to a fault that lacks it.
tl::unexpected<Error> fault_of(const Layout& layout, const Error& error) {
  if (layout.name.empty()) return tl::unexpected(error);
  return failure(error.code, fmt::format("{}: {}", io::as_utf8(layout.name), error.message));
}

Result<std::string> placements_of(const Layout& layout, const std::string& instance_name) {
  const Result<std::size_t> stock = io::strip_in_use(layout.document);
  if (!stock) return fault_of(layout, stock.error());
  return io::write_placements(layout.document, *stock,
                              instance_name.empty() ? layout.instance_name : instance_name);
}

Result<std::string> drawn(const Layout& layout, const ExportOptions& options) {
  return layout_picture(layout.document, title_of(layout, options), layout::check(layout.document),
                        options.form == LayoutForm::pdf ? PictureForm::pdf : PictureForm::png);
}

/// Begins what the QR codes of the layout's labels say (docs/formats.md): whoever has the file can tell
/// whether a label is of it, and a layout that was changed since has other labels.
std::string label_code(const Layout& layout) {
  std::string digits = io::sha256(layout_bytes(layout)).substr(0, 10);
  for (char& c : digits)
    if (c >= 'a') c = static_cast<char>(c - 'a' + 'A');
  return "LK/" + digits;
}

Result<std::string> labels_of(const Layout& layout, const ExportOptions& options) {
  const layout::Completeness completeness = layout::completeness(layout.document);
  Result<std::string> made =
      draw::labels_pdf({io::as_utf8(title_of(layout, options)), layout.document, completeness,
                        label_code(layout), options.labels.least_remnant_mm},
                       options.labels.paper);
  if (!made) return fault_of(layout, made.error());
  return made;
}

/// Tells the stocks in use that are of another material than the process is for.
void tell_other_materials(const layout::Document& document, const io::CutProcess& process,
                          std::vector<std::string>& notes) {
  std::set<std::uint32_t> used;
  for (const layout::Placement& placement : document.placements) used.insert(placement.stock);
  for (const std::uint32_t i : used) {
    const layout::Stock& stock = document.stocks[i];
    const layout::Material& of = stock.material;
    const bool other_name = !of.name.empty() && of.name != process.material,
               other_thickness =
                   of.thickness != 0 && of.thickness != geom::grid_from_mm(process.thickness_mm);
    if (other_name || other_thickness)
      notes.push_back(fmt::format("stock {} is of {}, and the process is for {}, {} mm", stock.id,
                                  words_of(of), process.material, process.thickness_mm));
  }
}

/// Cuts that parts share have no contour of their own, and what their order holds and frees is easily got
/// wrong: the independent checker looks at every program before anyone has it.
Result<void> check_common_lines(const Layout& layout, const io::ExportRequest& request,
                                const std::vector<io::ExportedFile>& programs) {
  const std::string bytes = layout_bytes(layout);
  const verify::Document document{layout.name, bytes};
  for (const io::ExportedFile& program : programs) {
    const std::string name = "the program of sheet " + program.sheet;
    verify::ProfileWords words;
    words.sheet = program.sheet;
    words.kerf_mm = request.profile.kerf_mm, words.tolerance_mm = request.profile.tolerance_mm;
    words.control = request.profile.post.language;
    words.pierce_diameter_mm = request.profile.pierce_diameter_mm;
    words.common_line = true;
    LEKALO_TRY(const verify::ClaimReport report,
               verify::verify_profile({name, program.bytes}, document, words));
    std::vector<std::string> reasons = report.findings;
    reasons.insert(reasons.end(), report.unchecked.begin(), report.unchecked.end());
    if (!reasons.empty())
      return failure(
          ErrorCode::refuted,
          fmt::format("sheet {}: with common lines the independent checker does not confirm the program, so "
                      "it is not written ({}); leave out common-line, or lay parts in rows, grids and pairs",
                      program.sheet, reasons.front()));
  }
  return {};
}

Result<io::Exported> machine_files(const Layout& layout, const ExportOptions& options) {
  LEKALO_TRY(const MachineRequest machine, machine_request(layout, options));
  LEKALO_TRY(io::Exported made, export_machine(layout, options, machine.request));
  made.notes.insert(made.notes.begin(), machine.notes.begin(), machine.notes.end());
  return made;
}

}  // namespace

Result<io::Exported> export_layout(const Layout& layout, const ExportOptions& options) {
  const auto alone = [](std::string&& bytes) { return io::Exported{{{"", std::move(bytes), {}}}, {}}; };
  switch (options.form) {
    case LayoutForm::layout:
      break;
    case LayoutForm::placements:
      return placements_of(layout, options.instance_name).map(alone);
    case LayoutForm::pdf:
    case LayoutForm::png:
      return drawn(layout, options).map(alone);
    case LayoutForm::labels:
      return labels_of(layout, options).map(alone);
    case LayoutForm::machine:
      return machine_files(layout, options);
  }
  return alone(layout_bytes(layout));
}

Result<MachineRequest> machine_request(const Layout& layout, const ExportOptions& options) {
  MachineRequest made{options.machine, {}};
  if (const auto& choice = options.process) {
    LEKALO_TRY(const io::ProcessFile file,
               io::read_processes(choice->file.bytes, io::as_utf8(choice->file.name)));
    std::string kind;
    for (const auto& [name, value] : choice->words)
      if (name == "process") kind = value;
    LEKALO_TRY(const std::size_t index,
               io::find_process(file, choice->material, choice->thickness_mm, kind, choice->form));
    const io::CutProcess& process = file.processes[index];
    LEKALO_TRY(made.request, io::process_request(process, choice->words, choice->prefix));
    made.notes.push_back(fmt::format("the process is entry {} of {}: {}, {} mm ({})", index + 1, file.name,
                                     process.material, process.thickness_mm, process.kind));
    tell_other_materials(layout.document, process, made.notes);
  }
  return made;
}

Result<io::Exported> export_machine(const Layout& layout, const ExportOptions& options,
                                    const io::ExportRequest& request) {
  Result<io::Exported> made = io::export_layout(layout.document, title_of(layout, options), request);
  if (!made) return fault_of(layout, made.error());
  if (request.form == io::ExportForm::gcode && request.profile.common_line) {
    if (const Result<void> confirmed = check_common_lines(layout, request, made->files); !confirmed)
      return fault_of(layout, confirmed.error());
  }
  return made;
}

}  // namespace lekalo::jobs

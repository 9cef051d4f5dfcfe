#include "export_command.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/draw/layout_picture.hpp"
#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/nesting/nesting_files.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/layout/completeness.hpp"
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

std::string title_of(const LayoutInput& input) {
  return input.document.name.empty() ? std::filesystem::path(input.path).stem().string()
                                     : input.document.name;
}

/// One file for each sheet, all or none of them.
Result<int> write_for_machines(const ExportOptions& o, const LayoutInput& input) {
  const Result<io::Exported> made = io::export_layout(input.document, title_of(input), o.request);
  if (!made)
    return failure(made.error().code, fmt::format("{}: {}", io::as_utf8(input.path), made.error().message));
  std::string said = notes(input.notices) + notes(made->notes);
  const std::size_t count = made->files.size();
  if (o.output.empty()) {
    if (count > 1)
      return failure(ErrorCode::usage,
                     fmt::format("{} sheets are in use and each is a file of its own: name the files with "
                                 "--output, or one sheet with --sheet, for example --sheet {}",
                                 count, made->files.front().sheet));
    LEKALO_CHECK(print(made->files.front().bytes));
    tell(said);
    return 0;
  }
  std::vector<NamedPath> paths;
  for (std::size_t i = 0; i < count; ++i)
    paths.push_back({"--output", count == 1 ? o.output : numbered(o.output, i + 1)});
  LEKALO_CHECK(check_outputs(paths, {{"the layout", o.source.path}, {"--instance", o.source.instance}}));
  disk::AtomicFiles files;
  for (std::size_t i = 0; i < count; ++i) {
    LEKALO_CHECK(files.add(paths[i].path, made->files[i].bytes));
    said += fmt::format("Written: {}", paths[i].path);
    said += count == 1 ? "\n" : fmt::format(", sheet {}\n", made->files[i].sheet);
  }
  LEKALO_CHECK(files.commit());
  tell(said);
  return 0;
}

Result<std::string> pdf_bytes(const LayoutInput& input) {
  const layout::Completeness completeness = layout::completeness(layout::Workspace(input.document));
  const std::vector<layout::Violation> violations = layout::check(input.document);
  return draw::layout_pdf({io::as_utf8(title_of(input)), input.document, completeness, violations});
}

}  // namespace

Result<int> run_export(const ExportOptions& o) {
  LEKALO_TRY(const LayoutInput input, read_layout_input(o.source, {{"--output", o.output}}));
  if (o.format == ExportFormat::machine) return write_for_machines(o, input);
  std::string text = input.text, warning;
  if (o.format == ExportFormat::placements) {
    const Result<std::size_t> stock = io::strip_in_use(input.document);
    if (!stock)
      return failure(stock.error().code, fmt::format("{}: {}", o.source.path, stock.error().message));
    const std::string& instance = o.instance_name.empty() ? input.instance_name : o.instance_name;
    if (instance.empty())
      warning = "note: the placements do not say where their items stand; --instance-name does\n";
    LEKALO_TRY(text, io::write_placements(input.document, *stock, instance));
  } else if (o.format == ExportFormat::pdf) {
    LEKALO_TRY(text, pdf_bytes(input));
  }
  LEKALO_CHECK(deliver(o.output, text));
  std::string said = warning + notes(input.notices);
  if (!o.output.empty()) said += fmt::format("Written: {}\n", o.output);
  tell(said);
  return 0;
}

}  // namespace lekalo::cli

#include "export_command.hpp"

#include <fmt/format.h>

#include "layout_input.hpp"
#include "lekalo/io/files.hpp"
#include "lekalo/io/nesting_files.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
Result<int> run_export(const ExportOptions& o) {
  const Result<LayoutInput> input = read_layout_input(o.source, {{"--output", o.output}});
  if (!input) return tl::unexpected(input.error());
  std::string text = input->text, warning;
  if (o.format == ExportFormat::placements) {
    const Result<std::size_t> stock = io::strip_in_use(input->document);
    if (!stock)
      return failure(stock.error().code, fmt::format("{}: {}", o.source.path, stock.error().message));
    const std::string& instance = o.instance_name.empty() ? input->instance_name : o.instance_name;
    if (instance.empty())
      warning = "note: the placements do not say where their items stand; --instance-name does\n";
    Result<std::string> written = io::write_placements(input->document, *stock, instance);
    if (!written) return tl::unexpected(written.error());
    text = std::move(*written);
  }
  if (Result<void> done = deliver(o.output, text); !done) return tl::unexpected(done.error());
  std::string said = warning + notes(input->notices);
  if (!o.output.empty()) said += fmt::format("Written: {}\n", o.output);
  tell(said);
  return 0;
}

}  // namespace lekalo::cli

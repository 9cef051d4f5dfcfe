#include "export_command.hpp"

#include <fmt/format.h>

#include "layout_input.hpp"
#include "lekalo/io/files.hpp"
#include "lekalo/io/nesting_files.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// The strip that something lies on; the first of several.
Result<std::size_t> strip_of(const layout::Document& document, const std::string& path) {
  for (std::size_t stock = 0; stock < document.stocks.size(); ++stock) {
    if (document.stocks[stock].kind != layout::StockKind::strip) continue;
    for (const layout::Placement& placement : document.placements)
      if (placement.stock == stock) return stock;
  }
  return failure(
      ErrorCode::bad_input,
      fmt::format("{}: nothing lies on a strip; the form 'placements' holds the parts of one strip", path));
}

}  // namespace

Result<int> run_export(const ExportOptions& o) {
  if (Result<void> fine = check_outputs({{"--output", o.output}},
                                        {{"the layout", o.source.path}, {"--instance", o.source.instance}});
      !fine)
    return tl::unexpected(fine.error());
  const Result<LayoutInput> input = read_layout_input(o.source);
  if (!input) return tl::unexpected(input.error());
  std::string text = input->text, warning;
  if (o.format == ExportFormat::placements) {
    const Result<std::size_t> stock = strip_of(input->document, o.source.path);
    if (!stock) return tl::unexpected(stock.error());
    const std::string& instance = o.instance_name.empty() ? input->instance_name : o.instance_name;
    if (instance.empty())
      warning = "note: the placements do not say where their items stand; --instance-name does\n";
    Result<std::string> written = io::write_placements(input->document, *stock, instance);
    if (!written) return tl::unexpected(written.error());
    text = std::move(*written);
  }
  if (o.output.empty()) {
    if (Result<void> done = print(text); !done) return tl::unexpected(done.error());
  } else {
    io::AtomicFiles files;
    if (Result<void> done = files.add(o.output, text).and_then([&] { return files.commit(); }); !done)
      return tl::unexpected(done.error());
  }
  std::string said = warning;
  for (const std::string& notice : input->notices) said += "note: " + notice + "\n";
  if (!o.output.empty()) said += fmt::format("Written: {}\n", o.output);
  tell(said);
  return 0;
}

}  // namespace lekalo::cli

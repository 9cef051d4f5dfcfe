#include "quote_command.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "layout_input.hpp"
#include "lekalo/base/counted.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/quote.hpp"
#include "lekalo/verify/claims.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// Reads the files that are typed, each once.
class QuoteInput {
 public:
  explicit QuoteInput(const QuoteOptions& options) : options_(options) {}

  Result<std::vector<jobs::Layout>> read() {
    for (const LayoutSource& source : options_.sources) LEKALO_CHECK(add(source));
    return std::move(layouts_);
  }
  [[nodiscard]] const std::vector<NamedPath>& files() const { return files_; }

 private:
  Result<void> add(const LayoutSource& source) {
    LEKALO_TRY(const std::string bytes, disk::read_file(source.path));
    // Whatever is no JSON is told by the reader of layouts.
    const Result<verify::Kind> kind = verify::kind_of({source.path, bytes});
    if (!kind || *kind != verify::Kind::order_report) return add_layout(source);
    files_.push_back({"the order", source.path});
    LEKALO_TRY(const std::vector<verify::NamedFile> names, verify::named_files({source.path, bytes}));
    for (const verify::NamedFile& name : names) {
      if (name.role != "nested") continue;
      if (name.path.empty())
        return failure(
            ErrorCode::bad_input,
            fmt::format("{}: the layouts of this order were not written; nest it again with -o FILE",
                        io::as_utf8(source.path)));
      LayoutSource one = source;
      one.path = place_of(source.path, name.path);
      LEKALO_CHECK(add_layout(one));
      if (layouts_.back().inputs.front().sha256 != name.sha256)
        return failure(ErrorCode::bad_input, fmt::format("{}: {} is not the layout of this order any more",
                                                         io::as_utf8(source.path), io::as_utf8(one.path)));
    }
    return {};
  }

  /// A layout stands where the report says, or else beside the report.
  static std::string place_of(const std::string& report, const std::string& path) {
    std::error_code error;
    if (std::filesystem::exists(path, error)) return path;
    const std::filesystem::path beside =
        std::filesystem::path(report).parent_path() / std::filesystem::path(path).filename();
    return std::filesystem::exists(beside, error) ? beside.string() : path;
  }

  Result<void> add_layout(const LayoutSource& source) {
    files_.push_back({"the layout", source.path});
    LEKALO_TRY(jobs::Layout layout, read_layout_input(source, {}));
    layouts_.push_back(std::move(layout));
    return {};
  }

  const QuoteOptions& options_;
  std::vector<jobs::Layout> layouts_;
  std::vector<NamedPath> files_;
};

std::string seconds_words(std::int64_t ms) { return fmt::format("{:.1f} s", static_cast<double>(ms) / 1000); }

/// The quote for people: its sum, and the time that it takes.
std::string summary_of(const jobs::Quote& quote) {
  jobs::QuoteTime time;
  std::int64_t pieces = 0, pierces = 0;
  for (const jobs::QuoteSheet& sheet : quote.sheets)
    time += sheet.time, pieces += sheet.pieces, pierces += sheet.pierces;
  const auto money = [&](std::int64_t amount) {
    std::int64_t unit = 1;
    for (int i = 0; i < quote.rates.decimals; ++i) unit *= 10;
    return quote.rates.decimals == 0 ? fmt::format("{} {}", amount, quote.rates.currency)
                                     : fmt::format("{}.{:0{}} {}", amount / unit, amount % unit,
                                                   quote.rates.decimals, quote.rates.currency);
  };
  return fmt::format(
      "{} on {}: cutting {}, {} in {}, travel {}, set-up {}\nsum {}, margin {}, tax {}, total {}\n",
      counted(static_cast<std::size_t>(pieces), "piece"), counted(quote.sheets.size(), "sheet"),
      seconds_words(time.cut), counted(static_cast<std::size_t>(pierces), "pierce"),
      seconds_words(time.pierce), seconds_words(time.travel), seconds_words(time.setup),
      money(quote.subtotal), money(quote.margin), money(quote.tax), money(quote.total));
}

}  // namespace

Result<int> run_quote(const QuoteOptions& o) {
  jobs::QuoteOptions job = o.job;
  QuoteInput input(o);
  LEKALO_TRY(const std::vector<jobs::Layout> layouts, input.read());
  LEKALO_TRY(job.rates.bytes, disk::read_file(job.rates.name));
  if (job.processes) {
    LEKALO_TRY(job.processes->bytes, disk::read_file(job.processes->name));
  }
  std::vector<NamedPath> inputs = input.files();
  inputs.push_back({"--rates", job.rates.name});
  if (job.processes) inputs.push_back({"--processes", job.processes->name});
  LEKALO_TRY(const jobs::Quote quote, jobs::quote(layouts, job));

  std::vector<NamedPath> outputs{{"--output", o.pdf}, {"--output", o.csv}};
  std::vector<std::string> programs;
  if (!o.programs.empty())
    for (std::size_t i = 0; i < quote.sheets.size(); ++i) {
      programs.push_back(path_of_sheet(o.programs, i, quote.sheets.size()));
      outputs.push_back({"--gcode", programs.back()});
    }
  LEKALO_CHECK(check_outputs(outputs, inputs));
  disk::AtomicFiles files;
  for (std::size_t i = 0; i < programs.size(); ++i)
    LEKALO_CHECK(files.add(programs[i], quote.sheets[i].program));
  if (!o.csv.empty()) LEKALO_CHECK(files.add(o.csv, jobs::quote_csv(quote)));
  if (!o.pdf.empty()) {
    LEKALO_TRY(const std::string pdf, jobs::quote_pdf(quote));
    LEKALO_CHECK(files.add(o.pdf, pdf));
  }
  if (o.json)
    LEKALO_CHECK(print(jobs::quote_json(quote, layouts, job, programs)));
  else if (o.pdf.empty() && o.csv.empty())
    LEKALO_CHECK(print(jobs::quote_csv(quote)));
  LEKALO_CHECK(files.commit());
  std::string said;
  for (const jobs::Layout& layout : layouts) said += notes(layout.notices);
  said += notes(quote.notes) + summary_of(quote);
  for (const NamedPath& output : outputs)
    if (!output.path.empty()) said += fmt::format("Written: {}\n", output.path);
  tell(said);
  return 0;
}

}  // namespace lekalo::cli

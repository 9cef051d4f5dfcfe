#include "nest_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <optional>
#include <vector>

#include "interrupt.hpp"
#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/material.hpp"
#include "lekalo/jobs/nest.hpp"
#include "lekalo/jobs/order_report.hpp"
#include "lekalo/layout/material_words.hpp"
#include "order_input.hpp"
#include "outputs.hpp"
#include "server/stock/stock_file.hpp"
#include "stock_words.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

/// A second that a run takes longer than its time limit is within what is promised, s.
constexpr double kUnnoticed = 1;

/// The checks at the end, and writing, take about as long as reading did. The time limit holds for all of it;
/// but what is read is placed, however long that took.
double end_of_search(double limit, double reading) { return limit - std::max(reading - kUnnoticed, 0.0); }

double processor_seconds() {
  timespec at{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &at);
  return static_cast<double>(at.tv_sec) + 1e-9 * static_cast<double>(at.tv_nsec);
}

const char* sentence_of(nest::Reason reason) {
  switch (reason) {
    case nest::Reason::no_angle:
      return "no angle is allowed for it on this stock";
    case nest::Reason::too_large:
      return "too large for the stock at every angle tried";
    case nest::Reason::no_zone:
      return "nowhere on the stock are zones and defects good enough for it";
    case nest::Reason::no_stock:
      return "no stock is left with room for it";
    case nest::Reason::not_tried:
      return "the time was over before its turn";
  }
  return "";
}

/// The best layout so far, as the progress line says it.
std::string text_of(const jobs::NestStanding& standing) {
  std::string text = standing.density > 0 ? fmt::format(", density {:.2f} %", 100 * standing.density) : "";
  text += standing.sheets == 1 ? fmt::format(", length {:.1f}", standing.length_mm)
                               : fmt::format(", {} sheets", standing.sheets);
  if (standing.kits_wanted > 0)
    text += fmt::format(", {} of {} kits", standing.kits_complete, standing.kits_wanted);
  return text;
}

/// The layouts that are to be nested: one, or those of an order.
Result<std::vector<jobs::MaterialLayout>> read_input(const NestOptions& o) {
  const std::vector<NamedPath> outputs{
      {"--output", o.output}, {"--picture", o.picture}, {"--stream", o.stream}};
  if (o.order) return read_order_input(*o.order, outputs);
  std::vector<jobs::MaterialLayout> layouts(1);
  jobs::Layout& input = layouts.front().layout;
  LEKALO_TRY(input, read_layout_input(o.source, outputs));
  if (input.document.stocks.empty())
    return failure(ErrorCode::usage,
                   fmt::format("{} has parts and no sheet to place them on; say one: --sheet 3000x1500, or "
                               "--strip 1500",
                               io::as_utf8(o.source.path)));
  return layouts;
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// Nests with a stream of better layouts, a progress line, and a clock that may end it. The result is added
/// to the files that are to appear.
/// \param seconds  that the clock leaves
Result<jobs::Nested> nest_watched(const jobs::MaterialLayout& given, const NestOptions& o,
                                  std::optional<double> seconds, disk::AtomicFiles& files) {
  const auto begin = Clock::now();
  const std::string output = jobs::path_with(o.output, given.file_word),
                    stream = jobs::path_with(o.stream, given.file_word);
  std::string standing;
  jobs::NestOptions options = o.search;
  options.standing = [&](const jobs::NestStanding& now) { standing = text_of(now); };
  if (!stream.empty())
    options.improved = [&](const layout::Document&, std::string_view bytes) {
      return deliver(stream, bytes);
    };
  if (!output.empty())
    options.while_checked = [&](std::string_view bytes) { return files.add(output, bytes); };
  ProgressLine line(given.file_word.empty() ? "nesting" : "nesting " + layout::words_of(given.material));
  RunControl control;
  control.stop = StopRequests::flag();
  control.work_limit = o.work;
  control.progress = [&](const Progress& progress) {
    const double share = seconds ? std::min(1.0, seconds_since(begin) / *seconds) : 0;
    line.show({progress.work, std::max(progress.fraction, share)}, standing);
  };
  return jobs::nest(given.layout.document, options, control);
}

/// Nests one layout after the other. Each has an equal share of the time that is left when its turn comes.
/// \param begin  of the command
Result<std::vector<jobs::NestedMaterial>> nest_all(std::vector<jobs::MaterialLayout> layouts,
                                                   const NestOptions& o, Clock::time_point begin,
                                                   disk::AtomicFiles& files) {
  const double end = o.seconds ? end_of_search(*o.seconds, seconds_since(begin)) : 0;
  std::vector<jobs::NestedMaterial> all;
  for (std::size_t i = 0; i < layouts.size(); ++i) {
    std::optional<double> share;
    if (o.seconds) {
      const double passed = seconds_since(begin);
      share = std::max(0.0, end - passed) / static_cast<double>(layouts.size() - i);
      StopRequests::end_at(passed + *share);
    }
    LEKALO_TRY(jobs::Nested nested, nest_watched(layouts[i], o, share, files));
    const std::string picture = jobs::path_with(o.picture, layouts[i].file_word);
    if (!picture.empty()) {
      const ToTheEnd to_the_end;
      LEKALO_TRY(const std::string drawn, picture_bytes(picture, o.source.path, nested.document, {}));
      LEKALO_CHECK(files.add(picture, drawn));
    }
    std::string output = jobs::path_with(o.output, layouts[i].file_word);
    all.push_back({std::move(layouts[i]), std::move(nested), std::move(output)});
  }
  return all;
}

/// Lines for people about one layout.
std::string text_of(const jobs::NestedMaterial& one) {
  const jobs::Nested& nested = one.nested;
  std::string text = completeness_text(nested.document, nested.completeness);
  for (const nest::Unplaced& u : nested.unplaced)
    text += fmt::format("not placed: {} of {}: {}\n", u.count, nested.document.parts[u.part].id,
                        sentence_of(u.reason));
  if (nested.rows)
    text +=
        nested.rows->most_in_row == 1
            ? "edges in common: none that are worth their material\n"
            : fmt::format(
                  "edges in common: {:.0f} mm, in rows of up to {} parts; in trials before the search rows "
                  "took {:.1f} % of the material that it takes without them\n",
                  nested.rows->shared_mm, nested.rows->most_in_row, 100 * nested.rows->material_share);
  if (!nested.searched)
    text += "note: an order of so many pieces gets a first layout, and no search for a better one\n";
  return text;
}

std::string text_of(const std::string& whose, const jobs::OrderFigures& figures) {
  return fmt::format("{}: {} placed, {} missing, {}, density {:.3f} %\n", whose, figures.placed,
                     figures.missing, counted(figures.sheets, "sheet"), 100 * figures.density());
}

/// Lines for people about all layouts.
/// \param seconds  processor time
std::string text_of(const std::vector<jobs::NestedMaterial>& all, double seconds) {
  std::string text, written;
  std::vector<jobs::OrderFigures> figures;
  std::uint64_t work = 0;
  for (const jobs::NestedMaterial& one : all) {
    text += notes(one.given.layout.notices);
    figures.push_back(jobs::figures_of(one.nested));
    if (all.size() > 1) text += text_of(layout::words_of(one.given.material), figures.back());
    text += text_of(one);
    if (all.size() > 1) text += fmt::format("  work {}\n", one.nested.work);
    work += one.nested.work;
    if (!one.written_as.empty()) written += fmt::format("Written: {}\n", one.written_as);
  }
  if (all.size() > 1) text += text_of("in all", jobs::sum_of(figures));
  text += fmt::format("work {} in {:.1f} s of processor time; checked twice\n", work, seconds);
  return text + written;
}

using server::StockFile;
using server::StockOpening;

/// The ids of the pieces that are free.
Result<std::vector<std::int64_t>> free_pieces(const std::string& stock) {
  LEKALO_TRY(StockFile file, StockFile::open(stock, StockOpening::find));
  LEKALO_TRY(const std::vector<jobs::StockItem> items, file.items());
  std::vector<std::int64_t> free;
  for (const jobs::StockItem& item : items)
    if (item.state == jobs::StockState::free) free.push_back(item.id);
  return free;
}

/// Allocates what the layouts use. Returns what is to be said of it.
Result<std::string> allocate(const NestOptions& o, const std::vector<jobs::NestedMaterial>& all) {
  std::vector<jobs::LayoutToCut> layouts;
  for (const jobs::NestedMaterial& one : all) {
    if (one.nested.document.placements.empty()) continue;
    layouts.push_back({one.written_as.empty() ? "the layout" : one.written_as, one.nested.document});
  }
  if (layouts.empty())
    return fmt::format("order {}: nothing is placed, so nothing is allocated\n", o.allocate);
  LEKALO_TRY(StockFile file, StockFile::open(o.order->stock, StockOpening::find));
  LEKALO_TRY(const jobs::StockOrder order, file.allocate(o.allocate, layouts));
  LEKALO_TRY(const std::vector<jobs::StockItem> items, file.items());
  return allocated_text(order, items);
}

/// Gives back what was allocated for files that could not be written.
Error given_back(const NestOptions& o, Error error) {
  const auto back = StockFile::open(o.order->stock, StockOpening::find).and_then([&](StockFile file) {
    return file.cancel(o.allocate);
  });
  error.message += back ? fmt::format("; nothing is allocated to order {}", o.allocate)
                        : fmt::format("; order {} stays allocated: {}", o.allocate, back.error().message);
  return error;
}

/// One run of the nester over an order, with the files that are to appear.
struct NestRun {
  std::vector<jobs::NestedMaterial> all;
  std::string allocated;  ///< what is to be said of it
  double seconds = 0;     ///< of processor time, without reading
  disk::AtomicFiles files;
};

/// A run that finds the pieces of its layouts gone is made anew as often as this, with what is free then.
constexpr int kMostRuns = 3;

Result<void> nest_once(const NestOptions& o, Clock::time_point begin, NestRun& run) {
  LEKALO_TRY(std::vector<jobs::MaterialLayout> layouts, read_input(o));
  if (!o.json) LEKALO_CHECK(several_need_files(layouts, o.output));
  const double start = processor_seconds();
  LEKALO_TRY(run.all, nest_all(std::move(layouts), o, begin, run.files));
  run.seconds = processor_seconds() - start;
  return {};
}

/// Nests and allocates. Other processes may take pieces from the same stock while this one nests: then it
/// nests anew.
Result<void> nest_and_allocate(const NestOptions& o, Clock::time_point begin, std::optional<NestRun>& run) {
  NestOptions given = o;
  for (int runs = 1;; ++runs) {
    LEKALO_TRY(const std::vector<std::int64_t> before, free_pieces(o.order->stock));
    LEKALO_CHECK(nest_once(given, begin, run.emplace()));
    const ToTheEnd to_the_end;
    Result<std::string> allocated = allocate(o, run->all);
    if (allocated) {
      run->allocated = *std::move(allocated);
      return {};
    }
    if (allocated.error().code != ErrorCode::bad_input || runs == kMostRuns)
      return tl::unexpected(allocated.error());
    LEKALO_TRY(const std::vector<std::int64_t> now, free_pieces(o.order->stock));
    if (now == before) return tl::unexpected(allocated.error());
    tell("note: another order took pieces of this layout meanwhile; it is nested anew on what is free\n");
    if (o.seconds) given.seconds = seconds_since(begin) + *o.seconds;
  }
}

}  // namespace

Result<int> run_nest(const NestOptions& o) {
  const auto begin = Clock::now();
  std::optional<NestRun> run;
  if (o.allocate.empty())
    LEKALO_CHECK(nest_once(o, begin, run.emplace()));
  else
    LEKALO_CHECK(nest_and_allocate(o, begin, run));
  const std::vector<jobs::NestedMaterial>& all = run->all;
  const double seconds = run->seconds;
  const ToTheEnd to_the_end;
  if (const Result<void> written = run->files.commit(); !written)
    return tl::unexpected(run->allocated.empty() ? written.error() : given_back(o, written.error()));
  const jobs::NestedMaterial& first = all.front();
  if (o.json && all.size() > 1)
    LEKALO_CHECK(print(jobs::order_json(all, o.search, seconds)));
  else if (o.json)
    LEKALO_CHECK(
        print(jobs::nest_json(first.given.layout, o.search, first.nested, first.written_as, seconds)));
  else if (o.output.empty())
    LEKALO_CHECK(print(first.nested.bytes));
  tell(text_of(all, seconds) + run->allocated);
  const bool complete = std::all_of(
      all.begin(), all.end(), [](const jobs::NestedMaterial& one) { return one.nested.unplaced.empty(); });
  return complete ? 0 : 1;
}

}  // namespace lekalo::cli

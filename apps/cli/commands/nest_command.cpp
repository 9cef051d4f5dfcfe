#include "nest_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <ctime>

#include "interrupt.hpp"
#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/nest.hpp"
#include "order_input.hpp"
#include "outputs.hpp"
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

Result<jobs::Layout> read_input(const NestOptions& o) {
  const std::vector<NamedPath> outputs{
      {"--output", o.output}, {"--picture", o.picture}, {"--stream", o.stream}};
  if (o.order) return read_order_input(*o.order, outputs);
  LEKALO_TRY(jobs::Layout input, read_layout_input(o.source, outputs));
  if (input.document.stocks.empty())
    return failure(ErrorCode::usage,
                   fmt::format("{} has parts and no sheet to place them on; say one: --sheet 3000x1500, or "
                               "--strip 1500",
                               io::as_utf8(o.source.path)));
  return input;
}

/// Nests with a stream of better layouts, a progress line, and a clock that may end it. The result is added
/// to the files that are to appear.
Result<jobs::Nested> nest_watched(const layout::Document& document, const NestOptions& o,
                                  disk::AtomicFiles& files) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  std::string standing;
  jobs::NestOptions options = o.search;
  options.standing = [&](const jobs::NestStanding& now) { standing = text_of(now); };
  if (!o.stream.empty())
    options.improved = [&](const layout::Document&, std::string_view bytes) {
      return deliver(o.stream, bytes);
    };
  if (!o.output.empty())
    options.while_checked = [&](std::string_view bytes) { return files.add(o.output, bytes); };
  ProgressLine line("nesting");
  RunControl control;
  control.stop = StopRequests::flag();
  control.work_limit = o.work;
  control.progress = [&](const Progress& progress) {
    const double passed = std::chrono::duration<double>(Clock::now() - begin).count();
    const double share = o.seconds ? std::min(1.0, passed / *o.seconds) : 0;
    line.show({progress.work, std::max(progress.fraction, share)}, standing);
  };
  return jobs::nest(document, options, control);
}

}  // namespace

Result<int> run_nest(const NestOptions& o) {
  const auto begin = std::chrono::steady_clock::now();
  LEKALO_TRY(const jobs::Layout input, read_input(o));
  const double reading = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (o.seconds) StopRequests::end_at(end_of_search(*o.seconds, reading));
  const double start = processor_seconds();
  disk::AtomicFiles files;
  LEKALO_TRY(const jobs::Nested nested, nest_watched(input.document, o, files));
  const double seconds = processor_seconds() - start;
  const ToTheEnd to_the_end;
  if (!o.picture.empty()) {
    LEKALO_TRY(const std::string picture, picture_bytes(o.picture, o.source.path, nested.document, {}));
    LEKALO_CHECK(files.add(o.picture, picture));
  }
  LEKALO_CHECK(files.commit());
  if (o.json)
    LEKALO_CHECK(print(jobs::nest_json(input, o.search, nested, o.output, seconds)));
  else if (o.output.empty())
    LEKALO_CHECK(print(nested.bytes));
  std::string said = notes(input.notices) + completeness_text(nested.document, nested.completeness);
  for (const nest::Unplaced& u : nested.unplaced)
    said += fmt::format("not placed: {} of {}: {}\n", u.count, nested.document.parts[u.part].id,
                        sentence_of(u.reason));
  if (!nested.searched)
    said += "note: an order of so many pieces gets a first layout, and no search for a better one\n";
  said += fmt::format("work {} in {:.1f} s of processor time; checked twice\n", nested.work, seconds);
  if (!o.output.empty()) said += fmt::format("Written: {}\n", o.output);
  tell(said);
  return nested.unplaced.empty() ? 0 : 1;
}

}  // namespace lekalo::cli

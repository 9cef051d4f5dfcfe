#include "nest_command.hpp"

#include <fmt/format.h>

#include <chrono>
#include <ctime>
#include <map>

#include "interrupt.hpp"
#include "layout_input.hpp"
#include "lekalo/disk/files.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/nest/nest.hpp"
#include "lekalo/verify/layout.hpp"
#include "outputs.hpp"
#include "summary.hpp"

namespace lekalo::cli {
namespace {

using Json = nlohmann::ordered_json;

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
  }
  return "";
}

/// The last line of defence: what is written passes both checks.
Result<void> recheck(const layout::Document& document, const std::string& text) {
  const auto violations = layout::check(document);
  if (!violations.empty())
    return failure(ErrorCode::refuted,
                   fmt::format("the layout found breaks a rule ({}), so it was not written; please report it",
                               layout::name_of(violations[0].kind)));
  const Result<verify::LayoutVerdict> verdict = verify::verify_layout({"the layout found", text});
  if (!verdict) return failure(ErrorCode::refuted, verdict.error().message);
  if (!verdict->violations.empty())
    return failure(ErrorCode::refuted,
                   fmt::format("the independent checker finds a broken rule ({}) in the layout found, so it "
                               "was not written; please report it",
                               verify::name_of(verdict->violations[0].kind)));
  return {};
}

Json remnant_of(const layout::SheetUse& use) {
  if (!(use.remnant.low.x < use.remnant.high.x)) return nullptr;
  return {geom::mm_from_grid(use.remnant.low.x), geom::mm_from_grid(use.remnant.low.y),
          geom::mm_from_grid(use.remnant.high.x), geom::mm_from_grid(use.remnant.high.y)};
}

Json report_of(const LayoutInput& input, const NestOptions& o, const nest::Nested& found,
               const layout::Completeness& c, double seconds) {
  Json json = begin_layout_json("lekalo-nest", found.unplaced.empty() ? "complete" : "incomplete", input);
  json["seed"] = o.seed;
  json["work"] = found.work;
  json["merges"] = found.merges;
  json["density"] = c.density;
  json["cost"] = c.cost;
  Json stocks = Json::array();
  for (const layout::SheetUse& use : c.sheets) {
    const layout::Stock& stock = found.document.stocks[use.sheet.stock];
    stocks.push_back({{"stock", stock.id},
                      {"copy", use.sheet.copy},
                      {"parts", use.parts},
                      {"density", use.density()},
                      {"length", use.used_length_mm},
                      {"remnant", remnant_of(use)}});
  }
  if (c.sheets.size() == 1) json["length"] = c.sheets[0].used_length_mm;
  json["stocks"] = std::move(stocks);
  Json kits = Json::array();
  for (std::size_t i = 0; i < found.document.kits.size(); ++i)
    kits.push_back({{"kit", found.document.kits[i].id},
                    {"complete", c.kits[i].complete},
                    {"wanted", found.document.kits[i].demand},
                    {"value", found.document.kits[i].value}});
  json["kits"] = std::move(kits);
  Json unplaced = Json::array();
  for (const nest::Unplaced& u : found.unplaced)
    unplaced.push_back(
        {{"part", found.document.parts[u.part].id}, {"count", u.count}, {"reason", nest::name_of(u.reason)}});
  json["unplaced"] = std::move(unplaced);
  json["run"] = {{"cpu_seconds", seconds}, {"threads", o.threads}};
  return json;
}

/// What the progress line says of the best layout so far.
std::string standing_of(const nest::Nested& found) {
  const layout::Document& document = found.document;
  std::map<layout::Sheet, double> reach;
  double parts = 0;
  for (const layout::Placement& p : document.placements) {
    const geom::GridRegion outline = placed_outline(document.parts[p.part], p);
    parts += geom::area_mm2(outline);
    double& far = reach[{p.stock, p.copy}];
    far = std::max(far, geom::mm_from_grid(geom::bounds(outline).high.x));
  }
  double material = 0, length = 0;
  for (const auto& [sheet, far] : reach) {
    const geom::GridRegion& outline = document.stocks[sheet.stock].outline.polygon;
    const geom::GridBox box = geom::bounds(outline);
    length = far;
    material += document.stocks[sheet.stock].kind == layout::StockKind::strip
                    ? far * geom::mm_from_grid(box.high.y - box.low.y)
                    : geom::area_mm2(outline);
  }
  std::string text = material > 0 ? fmt::format(", density {:.2f} %", 100 * parts / material) : "";
  text +=
      reach.size() == 1 ? fmt::format(", length {:.1f}", length) : fmt::format(", {} sheets", reach.size());
  if (!document.kits.empty()) {
    std::vector<layout::PieceCount> placed(document.parts.size());
    for (const layout::Placement& p : document.placements)
      ++(p.mirrored ? placed[p.part].mirrored : placed[p.part].upright);
    std::int64_t complete = 0, wanted = 0;
    for (const std::int64_t kits : layout::kits_made(document, std::move(placed)).complete) complete += kits;
    for (const layout::Kit& kit : document.kits) wanted += kit.demand;
    text += fmt::format(", {} of {} kits", complete, wanted);
  }
  return text;
}

/// Every better layout as a file, after both checks like the last one.
class Stream {
 public:
  explicit Stream(std::string path) : path_(std::move(path)) {}
  void take(const layout::Document& document) {
    if (path_.empty() || !trouble_) return;
    const std::string text = io::write_layout(document);
    trouble_ = recheck(document, text).and_then([&] { return deliver(path_, text); });
  }
  /// What went wrong; later ones are not written then.
  const Result<void>& trouble() const noexcept { return trouble_; }

 private:
  std::string path_;
  Result<void> trouble_;
};

}  // namespace

Result<int> run_nest(const NestOptions& o) {
  const Result<LayoutInput> input =
      read_layout_input(o.source, {{"--output", o.output}, {"--picture", o.picture}, {"--stream", o.stream}});
  if (!input) return tl::unexpected(input.error());
  nest::Options options;
  options.seed = o.seed;
  options.threads = o.threads;
  options.angles = o.angles;
  options.from_given = !o.from_scratch;
  options.pair_distance = o.pair_distance;
  RunControl control;
  control.work_limit = o.work;
  Stream stream(o.stream);
  std::string standing;
  options.improved = [&](const nest::Nested& better) {
    stream.take(better.document);
    standing = standing_of(better);
  };
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const double start = processor_seconds();
  Result<nest::Nested> found = failure(ErrorCode::usage, "");
  {
    const StopRequests stop(o.seconds);
    ProgressLine line("nesting");
    control.stop = stop.flag();
    control.progress = [&](const Progress& progress) {
      const double passed = std::chrono::duration<double>(Clock::now() - begin).count();
      const double share = o.seconds ? std::min(1.0, passed / *o.seconds) : 0;
      line.show({progress.work, std::max(progress.fraction, share)}, standing);
    };
    found = nest::nest(input->document, options, control);
  }
  if (!found) return tl::unexpected(found.error());
  if (!stream.trouble()) return tl::unexpected(stream.trouble().error());
  const double seconds = processor_seconds() - start;
  const std::string text = io::write_layout(found->document);
  if (Result<void> fine = recheck(found->document, text); !fine) return tl::unexpected(fine.error());

  const layout::Completeness c = layout::completeness(layout::Workspace(found->document));
  disk::AtomicFiles files;
  if (!o.output.empty())
    if (Result<void> done = files.add(o.output, text); !done) return tl::unexpected(done.error());
  if (!o.picture.empty()) {
    const Result<std::string> picture = picture_bytes(o.picture, o.source.path, found->document, c, {});
    if (!picture) return tl::unexpected(picture.error());
    if (Result<void> done = files.add(o.picture, *picture); !done) return tl::unexpected(done.error());
  }
  if (Result<void> done = files.commit(); !done) return tl::unexpected(done.error());
  if (o.json) {
    if (Result<void> done = print(dumped(report_of(*input, o, *found, c, seconds))); !done)
      return tl::unexpected(done.error());
  } else if (o.output.empty()) {
    if (Result<void> done = print(text); !done) return tl::unexpected(done.error());
  }
  std::string said = notes(input->notices) + completeness_text(found->document, c);
  for (const nest::Unplaced& u : found->unplaced)
    said += fmt::format("not placed: {} of {}: {}\n", u.count, found->document.parts[u.part].id,
                        sentence_of(u.reason));
  said += fmt::format("work {} in {:.1f} s of processor time; checked twice\n", found->work, seconds);
  if (!o.output.empty()) said += fmt::format("Written: {}\n", o.output);
  tell(said);
  return found->unplaced.empty() ? 0 : 1;
}

}  // namespace lekalo::cli

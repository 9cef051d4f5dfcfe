#include <algorithm>
#include <optional>
#include <string_view>

#include "jobs/document/report_document.hpp"
#include "lekalo/base/version.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/jobs/quote.hpp"
#include "money.hpp"

namespace lekalo::jobs {
namespace {

/// Writes the members of a quote into a document that is open.
class QuoteWriter {
 public:
  QuoteWriter(io::JsonWriter& json, const Quote& quote)
      : json_(json), quote_(quote), decimals_(quote.rates.decimals) {}

  void write() {
    const io::Rates& rates = quote_.rates;
    json_.fields({{"currency", rates.currency}, {"decimals", decimals_}});
    json_.key("sheets").list(quote_.sheets, [&](const QuoteSheet& sheet) { write(sheet); });
    json_.key("parts").list(quote_.parts, [&](const QuotePart& part) { write(part); });
    json_.key("orders").list(quote_.orders, [&](const QuoteOrder& order) {
      json_.begin_object();
      write(order.purpose);
      json_.fields({{"pieces", order.pieces}, {"amount", money(order.amount)}}).end();
    });
    json_.key("lines").list(quote_.lines, [&](const QuoteLine& line) { write(line); });
    json_.fields({{"subtotal", money(quote_.subtotal)},
                  {"margin_percent", decimal_of(rates.margin_percent, 6)},
                  {"margin", money(quote_.margin)},
                  {"tax_percent", decimal_of(rates.tax_percent, 6)},
                  {"tax", money(quote_.tax)},
                  {"total", money(quote_.total)}});
  }

 private:
  [[nodiscard]] std::string money(std::int64_t amount) const { return decimal_of(amount, decimals_); }

  void write(const layout::Purpose& purpose) {
    json_.fields({{"customer", purpose.customer}, {"due", purpose.due}, {"label", purpose.label}});
  }
  void write(const QuoteTime& time) {
    json_.fields({{"cut_s", decimal_of(time.cut, 3)},
                  {"pierce_s", decimal_of(time.pierce, 3)},
                  {"travel_s", decimal_of(time.travel, 3)},
                  {"setup_s", decimal_of(time.setup, 3)}});
  }

  void write(const QuoteSheet& sheet) {
    json_.begin_object().fields({{"layout", sheet.layout},
                                 {"stock", sheet.stock},
                                 {"copy", sheet.copy},
                                 {"material", sheet.material.name},
                                 {"thickness", geom::mm_from_grid(sheet.material.thickness)},
                                 {"pieces", sheet.pieces},
                                 {"parts_area_mm2", sheet.parts_area_mm2},
                                 {"material_area_mm2", sheet.material_area_mm2}});
    json_.key("remnant");
    if (sheet.remnant) {
      const geom::Point low = geom::mm_from_grid(sheet.remnant->low),
                        high = geom::mm_from_grid(sheet.remnant->high);
      json_.list({low.x, low.y, high.x, high.y});
    } else {
      json_.value(nullptr);
    }
    json_.fields({{"pierces", sheet.pierces},
                  {"cut_mm", decimal_of(sheet.cut_um, 3)},
                  {"travel_mm", decimal_of(sheet.travel_um, 3)}});
    write(sheet.time);
    json_.field("amount", money(sheet.amount)).end();
  }

  void write(const QuotePart& part) {
    json_.begin_object().fields({{"layout", part.layout}, {"part", part.id}, {"name", part.name}});
    write(part.purpose);
    json_.fields(
        {{"pieces", part.pieces}, {"pierces", part.pierces}, {"cut_mm", decimal_of(part.cut_um, 3)}});
    write(part.time);
    json_.field("amount", money(part.amount)).end();
  }

  void write(const QuoteLine& line) {
    const QuoteUnit unit = unit_of(line.kind, line.by_sheet);
    json_.object({{"sheet", line.sheet},
                  {"part", line.part},
                  {"pieces", line.pieces},
                  {"what", unit.name},
                  {"quantity", decimal_of(line.quantity, unit.decimals)},
                  {"unit", unit.unit},
                  {"rate", decimal_of(line.rate, 6)},
                  {"per", unit.per},
                  {"amount", money(line.amount)}});
  }

  io::JsonWriter& json_;
  const Quote& quote_;
  int decimals_;
};

}  // namespace

std::string quote_json(const Quote& quote, const std::vector<Layout>& layouts, const QuoteOptions& options,
                       const std::vector<std::string>& programs) {
  io::JsonWriter json = begin_document("lekalo-quote");
  json.fields({{"status", "quoted"}, {"units", "mm"}}).key("inputs").begin_list();
  for (const Layout& layout : layouts)
    for (const LayoutInput& input : layout.inputs)
      json.object({{"role", input.role}, {"path", input.name}, {"sha256", input.sha256}});
  write_file(json, "rates", options.rates);
  if (options.processes) write_file(json, "processes", *options.processes);
  std::vector<std::string> warnings;
  for (const Layout& layout : layouts)
    warnings.insert(warnings.end(), layout.notices.begin(), layout.notices.end());
  warnings.insert(warnings.end(), quote.notes.begin(), quote.notes.end());
  json.end().key("warnings").list(warnings);
  json.fields({{"seed", 0}, {"work", quote.lines.size()}, {"version", kVersion}});
  json.key("outputs").begin_list();
  for (std::size_t i = 0; i < programs.size(); ++i)
    write_file(json, "program", {programs[i], quote.sheets[i].program});
  json.end();
  if (std::find(options.words.begin(), options.words.end(), io::ExportWord{"common-line", "yes"}) !=
      options.words.end())
    json.field("common_line", true);
  QuoteWriter(json, quote).write();
  json.key("run").object({});
  return end_document(json);
}

}  // namespace lekalo::jobs

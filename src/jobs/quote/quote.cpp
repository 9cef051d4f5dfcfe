#include "lekalo/jobs/quote.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "lekalo/base/counted.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/layout/process_file.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/jobs/export.hpp"
#include "lekalo/layout/completeness.hpp"
#include "lekalo/layout/material_words.hpp"
#include "money.hpp"

namespace lekalo::jobs {
namespace {

constexpr std::int64_t kWholeSheet = 1'000'000'000;  ///< units of a quantity of sheets in one

std::int64_t thousandths(double value) { return static_cast<std::int64_t>(std::llround(1000 * value)); }

/// The pieces of one part on one sheet.
struct QuoteShare {
  std::size_t sheet = 0, part = 0;
  std::int64_t pieces = 0, pierces = 0, cut_um = 0;
  double cut_s = 0, pierce_s = 0, cut_mm = 0;
  /// The area of the pieces in thousandths of a mm^2.
  std::int64_t area = 0;
  std::int64_t material = 0;  ///< units of a quantity of material
  QuoteTime time;
  [[nodiscard]] std::int64_t own() const noexcept { return time.cut + time.pierce; }
};

/// The part of a sheet's material that is charged, and its rate.
struct QuoteCharge {
  const io::MaterialRate* rate = nullptr;
  std::int64_t quantity = 0;
};

class Quoter {
 public:
  Quoter(const std::vector<Layout>& layouts, const QuoteOptions& options)
      : layouts_(layouts), options_(options) {}

  Result<Quote> make() {
    LEKALO_TRY(quote_.rates, io::read_rates(options_.rates.bytes, io::as_utf8(options_.rates.name)));
    for (std::size_t i = 0; i < layouts_.size(); ++i) LEKALO_CHECK(add_layout(i));
    share_time();
    LEKALO_CHECK(price());
    quote_.title = title();
    return std::move(quote_);
  }

 private:
  [[nodiscard]] std::string named(const Layout& layout, const std::string& sentence) const {
    return layout.name.empty() ? sentence : fmt::format("{}: {}", io::as_utf8(layout.name), sentence);
  }

  [[nodiscard]] std::string title() const {
    if (!options_.title.empty()) return io::as_utf8(options_.title);
    std::string names;
    for (const Layout& layout : layouts_)
      names += (names.empty() ? "" : ", ") +
               (layout.document.name.empty() ? io::stem_of(layout.name) : layout.document.name);
    return io::as_utf8(names);
  }

  /// The material of stock; the options say what it does not.
  Result<layout::Material> material_of(const Layout& layout, const layout::Stock& stock) const {
    layout::Material material = stock.material;
    if (material.name.empty()) material.name = options_.material;
    if (material.thickness == 0) material.thickness = geom::grid_from_mm(options_.thickness_mm);
    if (!material.name.empty() && material.thickness != 0) return material;
    const bool none = material.name.empty() && material.thickness == 0;
    const char* const missing = none                    ? "neither material nor thickness"
                                : material.name.empty() ? "no material"
                                                        : "no thickness";
    std::string say;
    if (material.name.empty()) say += options_.prefix + "material NAME";
    if (material.thickness == 0) say += (none ? " and " : "") + options_.prefix + "thickness MM";
    return failure(ErrorCode::usage,
                   named(layout, fmt::format("stock {} says {}, so nobody knows its rate: say {}", stock.id,
                                             missing, say)));
  }

  /// The process of a layout is for what the options say, or else for what all its stock in use is of.
  Result<std::optional<ProcessChoice>> process_of(const Layout& layout) const {
    if (!options_.processes) return std::optional<ProcessChoice>();
    ProcessChoice choice{*options_.processes, options_.material, options_.thickness_mm, options_.words,
                         options_.prefix};
    std::optional<layout::Material> first;
    for (const layout::Placement& placement : layout.document.placements) {
      LEKALO_TRY(const layout::Material material,
                 material_of(layout, layout.document.stocks[placement.stock]));
      if (!first) first = material;
      if (*first == material) continue;
      if (!choice.material.empty() && choice.thickness_mm != 0) break;
      return failure(
          ErrorCode::usage,
          named(layout, fmt::format("its stock is of {} and of {}, which one process cannot cut: say "
                                    "{}material and {}thickness, or quote a layout for each",
                                    words_of(*first), words_of(material), options_.prefix, options_.prefix)));
    }
    if (!first) return std::optional(std::move(choice));
    if (choice.material.empty()) choice.material = first->name;
    if (choice.thickness_mm == 0) {
      LEKALO_TRY(choice.thickness_mm, thickness_of_process(*first));
    }
    return std::optional(std::move(choice));
  }

  /// The thickness as a process of the material says it, since processes are compared exactly and layouts on
  /// their grid.
  Result<double> thickness_of_process(const layout::Material& material) const {
    LEKALO_TRY(const io::ProcessFile file,
               io::read_processes(options_.processes->bytes, io::as_utf8(options_.processes->name)));
    for (const io::CutProcess& process : file.processes)
      if (geom::grid_from_mm(process.thickness_mm) == material.thickness) return process.thickness_mm;
    constexpr double kShown = 1e4;
    return std::round(geom::mm_from_grid(material.thickness) * kShown) / kShown;
  }

  Result<void> add_layout(std::size_t index) {
    const Layout& layout = layouts_[index];
    if (layout.document.placements.empty())
      return failure(ErrorCode::bad_input, named(layout, "nothing is placed, so there is nothing to quote"));
    ExportOptions form;
    form.form = LayoutForm::machine;
    LEKALO_TRY(form.process, process_of(layout));
    if (!form.process) {
      LEKALO_TRY(form.machine, io::read_export_words(io::ExportForm::gcode, options_.words, options_.prefix));
    }
    LEKALO_TRY(const MachineRequest machine, machine_request(layout, form));
    LEKALO_TRY(io::Exported made, export_machine(layout, form, machine.request));
    for (const std::string& note : machine.notes) quote_.notes.push_back(named(layout, note));
    for (const std::string& note : made.notes) quote_.notes.push_back(named(layout, note));

    // Strips are charged up to the length used, so that their remnants are looked for there, as of those
    // without an end: what lies behind is not paid for and cannot be paid back.
    layout::Document charged = layout.document;
    for (layout::Stock& stock : charged.stocks)
      if (stock.kind == layout::StockKind::strip) stock.open_length = true;
    const layout::Completeness completeness = layout::completeness(charged);
    const std::int64_t missing =
        std::accumulate(completeness.missing.begin(), completeness.missing.end(), std::int64_t{0});
    if (missing > 0)
      quote_.notes.push_back(
          named(layout, fmt::format("{} that {} wanted {} not placed, and not in the quote",
                                    counted(static_cast<std::size_t>(missing), "piece"),
                                    missing == 1 ? "is" : "are", missing == 1 ? "is" : "are")));
    if (made.files.size() != completeness.sheets.size())
      return failure(ErrorCode::bad_input,
                     named(layout,
                           "a placement lies on a copy of the stock that is not there; lekalo check says "
                           "which"));
    const std::vector<std::size_t> parts = add_parts(index);
    for (std::size_t k = 0; k < completeness.sheets.size(); ++k)
      LEKALO_CHECK(add_sheet(index, parts, completeness.sheets[k], std::move(made.files[k]),
                             machine.request.profile.post.dwell.units_per_second));
    return {};
  }

  /// Adds the parts that are placed. Returns the index in the quote of each part of the layout.
  std::vector<std::size_t> add_parts(std::size_t index) {
    const layout::Document& document = layouts_[index].document;
    std::vector<std::int64_t> pieces(document.parts.size());
    for (const layout::Placement& placement : document.placements) ++pieces[placement.part];
    std::vector<std::size_t> indices(document.parts.size());
    for (std::size_t i = 0; i < document.parts.size(); ++i) {
      if (pieces[i] == 0) continue;
      const layout::Part& part = document.parts[i];
      indices[i] = quote_.parts.size();
      QuotePart& made = quote_.parts.emplace_back();
      made.layout = index, made.id = part.id, made.name = part.name, made.purpose = part.purpose;
      made.pieces = pieces[i];
    }
    return indices;
  }

  Result<void> add_sheet(std::size_t index, const std::vector<std::size_t>& parts,
                         const layout::SheetUse& use, io::ExportedFile&& file, double dwell_units) {
    const Layout& layout = layouts_[index];
    const layout::Stock& stock = layout.document.stocks[use.sheet.stock];
    QuoteSheet sheet;
    sheet.layout = index, sheet.stock = stock.id, sheet.copy = use.sheet.copy, sheet.name = file.sheet;
    LEKALO_TRY(sheet.material, material_of(layout, stock));
    sheet.pieces = static_cast<std::int64_t>(use.parts);
    sheet.parts_area_mm2 = use.parts_area, sheet.material_area_mm2 = use.material_area;
    sheet.program = std::move(file.bytes);
    LEKALO_TRY(const QuoteCharge charge, charge_of(stock, use, sheet));
    std::vector<QuoteShare> shares = shares_on(layout, parts, use.sheet);
    LEKALO_CHECK(time_program(layout, use.sheet, file.cuts, dwell_units, sheet, shares));
    std::vector<std::int64_t> areas;
    for (const QuoteShare& share : shares) areas.push_back(share.area);
    const std::vector<std::int64_t> material = shares_of(charge.quantity, areas);
    for (std::size_t i = 0; i < shares.size(); ++i) shares[i].material = material[i];
    shares_.insert(shares_.end(), shares.begin(), shares.end());
    charges_.push_back(charge);
    quote_.sheets.push_back(std::move(sheet));
    return {};
  }

  Result<QuoteCharge> charge_of(const layout::Stock& stock, const layout::SheetUse& use,
                                QuoteSheet& sheet) const {
    const geom::GridBox box = bounds(stock.outline.polygon);
    const geom::Point size = geom::mm_from_grid(box.high - box.low);
    std::optional<io::PlaneSize> side;
    if (stock.kind != layout::StockKind::strip) side = io::PlaneSize{size.x, size.y};
    LEKALO_TRY(const io::MaterialRate* const rate, io::find_rate(quote_.rates, sheet.material, side));
    const geom::Point left = geom::mm_from_grid(use.remnant.high - use.remnant.low);
    const bool is_kept =
        rate->least_remnant_mm && left.x > 0 && std::min(left.x, left.y) >= *rate->least_remnant_mm;
    if (is_kept) sheet.remnant = use.remnant;
    const double remnant = is_kept ? left.x * left.y : 0;
    if (!rate->sheet) return QuoteCharge{rate, std::llround(use.material_area - remnant)};
    const double worth = static_cast<double>(rate->remnant_percent) / (100.0 * io::kOneInMillionths) *
                         remnant / use.material_area;
    return QuoteCharge{rate, kWholeSheet - std::llround(static_cast<double>(kWholeSheet) * worth)};
  }

  /// The parts on a sheet with their pieces and areas, in the order of the quote.
  [[nodiscard]] std::vector<QuoteShare> shares_on(const Layout& layout, const std::vector<std::size_t>& parts,
                                                  layout::Sheet sheet) const {
    std::map<std::uint32_t, std::int64_t> pieces;
    for (const layout::Placement& placement : layout.document.placements)
      if (placement.stock == sheet.stock && placement.copy == sheet.copy) ++pieces[placement.part];
    std::vector<QuoteShare> shares;
    for (const auto& [part, count] : pieces) {
      QuoteShare& share = shares.emplace_back();
      share.sheet = quote_.sheets.size(), share.part = parts[part], share.pieces = count;
      share.area = count * thousandths(geom::area_mm2(layout.document.parts[part].outline.polygon));
    }
    return shares;
  }

  /// Gives each part the motions that cut it. A cut that placements have in common goes to their parts by
  /// equal shares of its time and length, and its pierce to the first. Travel is the sheet's.
  Result<void> time_program(const Layout& layout, layout::Sheet on, const std::vector<nc::CutLines>& cuts,
                            double dwell_units, QuoteSheet& sheet, std::vector<QuoteShare>& shares) const {
    LEKALO_TRY(const nc::TimedProgram timed,
               nc::timed_program(sheet.program, "the program of sheet " + sheet.name, dwell_units,
                                 quote_.rates.machine));
    std::map<std::uint64_t, std::uint32_t> part_of;
    std::map<std::uint32_t, std::size_t> share_of;
    for (const layout::Placement& placement : layout.document.placements)
      if (placement.stock == on.stock && placement.copy == on.copy) {
        part_of.emplace(placement.id, placement.part);
        share_of.emplace(placement.part, 0);
      }
    for (std::size_t k = 0; auto& [part, share] : share_of) share = k++;

    std::size_t cut = 0;
    const auto cut_at = [&](std::size_t line) -> const nc::CutLines* {
      while (cut < cuts.size() && cuts[cut].last < line) ++cut;
      return cut == cuts.size() || line < cuts[cut].first ? nullptr : &cuts[cut];
    };
    const auto share_with = [&](std::uint64_t placement) -> QuoteShare& {
      return shares[share_of.at(part_of.at(placement))];
    };
    double travel_s = 0, travel_mm = 0;
    for (const nc::TimedMotion& motion : timed.motions) {
      ask();
      const nc::CutLines* const of = motion.kind == nc::TimedKind::travel ? nullptr : cut_at(motion.line);
      if (of == nullptr) {
        travel_s += motion.seconds, travel_mm += motion.length_mm;
        continue;
      }
      const double each = 1.0 / static_cast<double>(1 + of->others.size());
      const auto add_to = [&](QuoteShare& share) {
        if (motion.kind == nc::TimedKind::cut)
          share.cut_s += each * motion.seconds, share.cut_mm += each * motion.length_mm;
        else
          share.pierce_s += each * motion.seconds;
      };
      add_to(share_with(of->id));
      for (const std::uint64_t other : of->others) add_to(share_with(other));
    }
    cut = 0;
    for (const std::size_t line : timed.pierces)
      if (const nc::CutLines* const of = cut_at(line)) ++share_with(of->id).pierces;
    sheet.travel_um = thousandths(travel_mm), sheet.time.travel = thousandths(travel_s);
    sheet.time.setup = quote_.rates.setup_per_sheet_ms;
    for (QuoteShare& share : shares) {
      share.time.cut = thousandths(share.cut_s), share.time.pierce = thousandths(share.pierce_s);
      share.cut_um = thousandths(share.cut_mm);
      sheet.time.cut += share.time.cut, sheet.time.pierce += share.time.pierce;
      sheet.pierces += share.pierces, sheet.cut_um += share.cut_um;
    }
    return {};
  }

  /// Travel and set-up of a sheet are shared out by the time that its parts take for themselves, and so is
  /// the set-up of the whole quote.
  void share_time() {
    std::vector<std::int64_t> all;
    for (const QuoteShare& share : shares_) all.push_back(share.own());
    const std::vector<std::int64_t> once = shares_of(quote_.rates.setup_once_ms, all);
    for (std::size_t first = 0; first < shares_.size();) {
      std::size_t end = first;
      while (end < shares_.size() && shares_[end].sheet == shares_[first].sheet) ++end;
      const std::vector<std::int64_t> own(all.begin() + static_cast<std::ptrdiff_t>(first),
                                          all.begin() + static_cast<std::ptrdiff_t>(end));
      QuoteTime& time = quote_.sheets[shares_[first].sheet].time;
      const std::vector<std::int64_t> travel = shares_of(time.travel, own),
                                      setup = shares_of(time.setup, own);
      for (std::size_t i = first; i < end; ++i) {
        shares_[i].time.travel = travel[i - first];
        shares_[i].time.setup = setup[i - first] + once[i];
        time.setup += once[i];
      }
      first = end;
    }
  }

  Result<void> price() {
    for (const QuoteShare& share : shares_) {
      LEKALO_CHECK(price_lines(share));
      QuotePart& part = quote_.parts[share.part];
      part.time += share.time, part.pierces += share.pierces, part.cut_um += share.cut_um;
    }
    for (const QuotePart& part : quote_.parts) {
      const auto same = std::find_if(quote_.orders.begin(), quote_.orders.end(),
                                     [&](const QuoteOrder& order) { return order.purpose == part.purpose; });
      QuoteOrder& order = same != quote_.orders.end() ? *same : quote_.orders.emplace_back();
      order.purpose = part.purpose;
      order.pieces += part.pieces, order.amount += part.amount;
    }
    tell_rounding();
    const io::Rates& rates = quote_.rates;
    const auto percent = [&](std::int64_t amount, io::Millionths rate) {
      return money_of(amount, rates.decimals, rate, 100, rates.decimals);
    };
    LEKALO_TRY(quote_.margin, percent(quote_.subtotal, rates.margin_percent));
    LEKALO_TRY(quote_.tax, percent(quote_.subtotal + quote_.margin, rates.tax_percent));
    quote_.total = quote_.subtotal + quote_.margin + quote_.tax;
    return {};
  }

  /// Many lines of few units each may be rounded away; whoever sends the quote is to know.
  void tell_rounding() {
    constexpr double kTold = 0.01;
    double unrounded = 0, unit = 1;
    for (int i = 0; i < quote_.rates.decimals; ++i) unit *= 10;
    for (const QuoteLine& line : quote_.lines) {
      const QuoteUnit of = unit_of(line.kind, line.by_sheet);
      unrounded += static_cast<double>(line.quantity) * static_cast<double>(line.rate) * unit /
                   (std::pow(10.0, of.decimals + 6) * static_cast<double>(of.per));
    }
    const double off = static_cast<double>(quote_.subtotal) - unrounded;
    if (std::abs(off) > kTold * unrounded)
      quote_.notes.push_back(
          fmt::format("rounding line by line makes the sum {:.1f} % {}; more \"decimals\" in {} are finer",
                      100 * std::abs(off) / unrounded, off < 0 ? "smaller" : "larger", quote_.rates.name));
  }

  Result<void> price_lines(const QuoteShare& share) {
    const io::Rates& rates = quote_.rates;
    const QuoteCharge& charge = charges_[share.sheet];
    struct Factor {
      QuoteKind kind;
      std::int64_t quantity;
      io::Millionths rate;
    };
    for (const Factor& factor : {Factor{QuoteKind::machine, share.time.machine(), rates.per_hour},
                                 {QuoteKind::setup, share.time.setup, rates.setup_per_hour},
                                 {QuoteKind::pierces, share.pierces, rates.per_pierce},
                                 {QuoteKind::cut, share.cut_um, rates.per_m_cut},
                                 {QuoteKind::material, share.material, charge.rate->price}}) {
      if (factor.quantity == 0 || factor.rate == 0) continue;
      const bool by_sheet = factor.kind == QuoteKind::material && charge.rate->sheet;
      const QuoteUnit unit = unit_of(factor.kind, by_sheet);
      LEKALO_TRY(const std::int64_t amount,
                 money_of(factor.quantity, unit.decimals, factor.rate, unit.per, rates.decimals));
      quote_.lines.push_back({share.sheet, share.part, share.pieces, factor.kind, by_sheet, factor.quantity,
                              factor.rate, amount});
      quote_.sheets[share.sheet].amount += amount;
      quote_.parts[share.part].amount += amount;
      quote_.subtotal += amount;
      if (quote_.subtotal > kMostMoney)
        return failure(ErrorCode::bad_input,
                       "the sum of the quote has more than 15 digits; look at the rates again");
    }
    return {};
  }

  const std::vector<Layout>& layouts_;
  const QuoteOptions& options_;
  Quote quote_;
  std::vector<QuoteShare> shares_;    ///< by sheet and part
  std::vector<QuoteCharge> charges_;  ///< by sheet
};

}  // namespace

QuoteUnit unit_of(QuoteKind kind, bool by_sheet) noexcept {
  switch (kind) {
    case QuoteKind::machine:
      return {"machine", "s", 3, 3600};
    case QuoteKind::setup:
      return {"set-up", "s", 3, 3600};
    case QuoteKind::pierces:
      return {"pierces", "pierce", 0, 1};
    case QuoteKind::cut:
      return {"cut", "m", 6, 1};
    case QuoteKind::material:
      break;
  }
  return by_sheet ? QuoteUnit{"material", "sheet", 9, 1} : QuoteUnit{"material", "m2", 6, 1};
}

Result<Quote> quote(const std::vector<Layout>& layouts, const QuoteOptions& options) {
  return Quoter(layouts, options).make();
}

}  // namespace lekalo::jobs

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "layout_claims.hpp"
#include "report_fields.hpp"
#include "same_layout.hpp"
#include "sheet_figures.hpp"

namespace lekalo::verify {
namespace {

/// Sums of doubles over a million parts are nearer than this to the exact figure.
constexpr double kSumRounding = 1e-12;

double share(Wide part, Wide whole) { return static_cast<double>(part) / static_cast<double>(whole); }

/// Pieces by hand, as placed or as wanted; `either` are wanted in whichever hand.
struct Hands {
  std::int64_t upright{}, mirrored{}, either{};
};

/// Rechecks one report of nest or check.
class LayoutReport {
 public:
  LayoutReport(const Document& report, const std::vector<NamedFile>& names,
               const std::vector<Document>& files, Json root)
      : report_(report), names_(names), files_(files), fields_(root, "", complaint_) {}

  Result<ClaimReport> nest() {
    common("lekalo-nest");
    (void)fields_.get("outputs"), (void)fields_.index("merges");
    LEKALO_TRY(const Document layout, file("nested"));
    LEKALO_TRY(written_, read_layout(layout));
    LEKALO_TRY(const LayoutVerdict verdict, verify_layout(layout));
    claims_.findings = sentences(verdict.violations);
    LEKALO_CHECK(compare_given());
    compare_sums();
    compare_sheets();
    compare_kits();
    compare_status(compare_unplaced(fields_) == 0);
    fields_.refuse_others();
    LEKALO_CHECK(fine());
    claims_.notes.push_back(fmt::format("every rule and figure was rechecked for {} placements in {}",
                                        verdict.placements, layout.name));
    return std::move(claims_);
  }

  /// Rechecks an order of several layouts.
  Result<ClaimReport> order() {
    common("lekalo-order");
    (void)fields_.get("outputs");
    LEKALO_CHECK(fine());
    std::vector<WrittenLayout> layouts;
    std::size_t placements = 0;
    std::set<std::string> written;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i].role != "nested") continue;
      if (!written.insert(names_[i].path).second)
        fields_.complain(fmt::format("it names {} twice among its outputs", names_[i].path));
      LEKALO_TRY(WrittenLayout layout, read_layout(files_[i]));
      layouts.push_back(std::move(layout));
      LEKALO_TRY(const LayoutVerdict verdict, verify_layout(files_[i]));
      for (const std::string& sentence : sentences(verdict.violations))
        claims_.findings.push_back(fmt::format("{}: {}", files_[i].name, sentence));
      placements += verdict.placements;
    }
    OrderTotals all;
    compare_items(fields_, "layouts", layouts.size(), claims_, [&](ReportFields& item, std::size_t i) {
      written_ = std::move(layouts[i]);
      sheets_ = sheets_of(written_);
      compare_material(item);
      OrderTotals own;
      for (const SheetFigures& sheet : sheets_) own.add(sheet, written_.stocks[sheet.stock].cost);
      own.placed = written_.placements.size();
      own.missing = compare_unplaced(item);
      (void)item.index("work");
      compare_order_totals(item, own);
      all.add(own);
    });
    compare_status(all.missing == 0);
    compare_order_totals(fields_, all);
    fields_.refuse_others();
    LEKALO_CHECK(fine());
    claims_.unchecked.emplace_back(
        "that stocks and parts are those of the order's drawings was not rechecked");
    claims_.notes.push_back(fmt::format("every rule and figure was rechecked for {} placements in {} layouts",
                                        placements, layouts.size()));
    return std::move(claims_);
  }

  Result<ClaimReport> check() {
    common("lekalo-check");
    LEKALO_TRY(const Document layout, file("layout"));
    const Json valid = fields_.get("valid");
    if (!valid.is_bool()) fields_.complain("field valid is neither true nor false");
    std::vector<std::string> checkers, disagreements;
    fields_.each("checked_by", [&](Json, const std::string& path) { checkers.push_back(path); });
    fields_.each("disagreements", [&](Json, const std::string& path) { disagreements.push_back(path); });
    std::set<Finding> told;
    fields_.each("violations", [&](Json item, const std::string& path) {
      if (!told.insert(read_violation(item, path)).second)
        claims_.findings.push_back(fmt::format("{} is there twice", path));
    });
    fields_.refuse_others();
    LEKALO_CHECK(fine());
    const char* status = !disagreements.empty() ? "refuted" : told.empty() ? "valid" : "violations";
    if (status_ != status)
      claims_.findings.push_back(fmt::format("status is {} and is to be {}", status_, status));
    if (valid.is_true() != told.empty())
      claims_.findings.emplace_back("valid is not what the violations say");
    if (!disagreements.empty())
      claims_.unchecked.emplace_back("disagreements: what another checker found cannot be rechecked");
    LEKALO_CHECK(compare_violations(layout, told));
    return std::move(claims_);
  }

  /// Rechecks of a report of show what nest says too.
  Result<ClaimReport> show() {
    common("lekalo-show");
    if (status_ != "shown") fields_.complain("field status is not \"shown\"");
    LEKALO_TRY(const Document layout, file("layout"));
    LEKALO_TRY(const std::optional<LayoutVerdict> verdict, verdict_of(layout, "violations, density, cost"));
    if (verdict) {
      LEKALO_TRY(written_, read_layout(layout));
      compare(fields_, "violations", static_cast<double>(verdict->violations.size()), claims_);
      sheets_ = sheets_of(written_);
      compare_totals();
    } else {
      for (const char* figure : {"violations", "density", "cost"}) (void)fields_.number(figure);
    }
    for (const char* list : {"sheets", "kits", "parts"}) {
      fields_.each(list, [](Json, const std::string&) {});
      claims_.unchecked.push_back(fmt::format("{}: what lekalo show counts there", list));
    }
    fields_.refuse_others();
    LEKALO_CHECK(fine());
    return std::move(claims_);
  }

 private:
  using Finding =
      std::tuple<std::string, std::uint64_t, std::uint64_t, std::string, std::int64_t, std::string>;

  [[nodiscard]] Result<void> fine() const {
    if (complaint_.empty()) return {};
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", report_.name, complaint_));
  }

  /// The fields that every report on a layout has; seed, work, version, warnings and run are information.
  void common(std::string_view format) {
    check_format(fields_, format, complaint_);
    status_ = fields_.text("status");
    (void)fields_.get("inputs"), (void)fields_.text("version"), (void)fields_.index("work");
    (void)fields_.index("seed");
    fields_.each("warnings", [](Json, const std::string&) {});
    if (!fields_.get("run").is_object()) fields_.complain("field run is not an object");
  }

  /// Returns the one file of a role.
  Result<Document> file(const char* role) {
    LEKALO_CHECK(fine());
    std::optional<Document> found;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i].role != role) continue;
      if (found) fields_.complain(fmt::format("it names two files with the role \"{}\"", role));
      found = files_[i];
    }
    if (!found) fields_.complain(fmt::format("it names no file with the role \"{}\"", role));
    LEKALO_CHECK(fine());
    return *found;
  }

  Result<void> compare_given() {
    const bool ordered =
        std::any_of(names_.begin(), names_.end(), [](const NamedFile& f) { return f.role == "part"; });
    if (ordered) {
      claims_.unchecked.emplace_back(
          "that stocks and parts are those of the order's drawings was not rechecked");
      return {};
    }
    LEKALO_TRY(const Document given, file("layout"));
    if (kind_of(given) != Kind::layout) {
      claims_.unchecked.push_back(fmt::format(
          "that stocks and parts are those of {}, which is in another form, was not rechecked", given.name));
      return {};
    }
    LEKALO_TRY(const WrittenLayout before, read_layout(given, true));
    for (std::string& difference : differences(written_, before))
      claims_.findings.push_back(std::move(difference));
    return {};
  }

  void compare_near(ReportFields& fields, std::string_view key, double found) {
    const double written = fields.number(key);
    if (!(std::abs(written - found) <= kSumRounding * std::abs(found)))
      claims_.findings.push_back(fmt::format("{} is {} and is to be {}", fields.name(key), written, found));
  }

  void compare_totals() {
    double cost = 0;
    Wide parts = 0, material = 0;
    for (const SheetFigures& sheet : sheets_) {
      cost += written_.stocks[sheet.stock].cost;
      parts += sheet.parts_area, material += sheet.material_area;
    }
    compare_near(fields_, "density", sheets_.empty() ? 0 : share(parts, material));
    compare(fields_, "cost", cost, claims_);
  }

  void compare_sums() {
    sheets_ = sheets_of(written_);
    compare_totals();
    if (sheets_.size() == 1) compare(fields_, "length", length_of(sheets_[0]), claims_);
  }

  static double length_of(const SheetFigures& sheet) { return static_cast<double>(sheet.last) * kStep; }

  void compare_text(ReportFields& fields, const char* key, const std::string& found) {
    if (const std::string written = fields.text(key); written != found)
      claims_.findings.push_back(
          fmt::format("{} is \"{}\" and is to be \"{}\"", fields.name(key), excerpt(written), found));
  }

  void compare_sheets() {
    compare_items(fields_, "stocks", sheets_.size(), claims_, [&](ReportFields& item, std::size_t i) {
      const SheetFigures& sheet = sheets_[i];
      const WrittenStock& stock = written_.stocks[sheet.stock];
      compare_text(item, "stock", stock.id);
      compare(item, "copy", static_cast<double>(sheet.copy), claims_);
      compare(item, "parts", static_cast<double>(sheet.parts.size()), claims_);
      compare_near(item, "density", share(sheet.parts_area, sheet.material_area));
      compare(item, "length", length_of(sheet), claims_);
      compare_remnant(item, sheet, stock);
    });
  }

  /// The claim is that the rectangle is free, not that there is none larger.
  void compare_remnant(ReportFields& item, const SheetFigures& sheet, const WrittenStock& stock) {
    if (item.get("remnant").is_null()) return;
    std::vector<std::int64_t> steps;
    item.each("remnant", [&](Json number, const std::string&) {
      const auto value = number.is_number() ? parse_decimal(number.text) : std::nullopt;
      const auto step = value ? steps_of(approximate(*value), ToStep::nearest, 1e6) : std::nullopt;
      if (!step || static_cast<double>(*step) * kStep != approximate(*value)) return;
      steps.push_back(*step);
    });
    if (steps.size() != 4 || !is_free({steps[0], steps[1], steps[2], steps[3]}, sheet, stock))
      claims_.findings.push_back(fmt::format("{} is no free rectangle", item.name("remnant")));
  }

  std::vector<Hands> placed_hands() const {
    std::vector<Hands> hands(written_.parts.size());
    for (const WrittenPiece& piece : written_.placements)
      ++(piece.mirrored ? hands[piece.part].mirrored : hands[piece.part].upright);
    return hands;
  }

  static void add(const WrittenKit& kit, std::int64_t times, std::vector<Hands>& to) {
    for (const WrittenKitPiece& piece : kit.pieces) {
      Hands& hands = to[piece.part];
      (piece.mirrored ? (*piece.mirrored ? hands.mirrored : hands.upright) : hands.either) +=
          times * piece.count;
    }
  }

  /// Pieces that are wanted and not there.
  static std::int64_t missing(const Hands& wanted, const Hands& there) {
    const std::int64_t upright = there.upright - wanted.upright, mirrored = there.mirrored - wanted.mirrored;
    const std::int64_t left = std::max<std::int64_t>(0, upright) + std::max<std::int64_t>(0, mirrored);
    return std::max<std::int64_t>(0, -upright) + std::max<std::int64_t>(0, -mirrored) +
           std::max<std::int64_t>(0, wanted.either - left);
  }

  /// The kits said to be complete can all be made of what is placed, and none could be made besides.
  void compare_kits() {
    const std::vector<Hands> there = placed_hands();
    std::vector<Hands> taken(there.size());
    std::vector<std::size_t> unfinished;
    compare_items(fields_, "kits", written_.kits.size(), claims_, [&](ReportFields& item, std::size_t i) {
      const WrittenKit& kit = written_.kits[i];
      compare_text(item, "kit", kit.id);
      compare(item, "wanted", static_cast<double>(kit.demand), claims_);
      compare(item, "value", kit.value, claims_);
      const auto complete = static_cast<std::int64_t>(item.index("complete"));
      add(kit, std::min<std::int64_t>(complete, kit.demand + 1), taken);
      if (complete > kit.demand)
        claims_.findings.push_back(fmt::format("{} is more than is wanted", item.name("complete")));
      if (complete < kit.demand) unfinished.push_back(i);
    });
    const auto can_be_made = [&](const std::vector<Hands>& wanted) {
      for (std::size_t part = 0; part < wanted.size(); ++part)
        if (missing(wanted[part], there[part]) > 0) return false;
      return true;
    };
    if (!can_be_made(taken))
      claims_.findings.emplace_back("kits: more are complete than the placements make");
    for (const std::size_t i : unfinished) {
      std::vector<Hands> more = taken;
      add(written_.kits[i], 1, more);
      if (can_be_made(more))
        claims_.findings.push_back(fmt::format("kits[{}].complete is less than the placements make", i));
    }
  }

  /// The sums of an order, or of a layout of it.
  struct OrderTotals {
    std::size_t placed = 0, sheets = 0;
    std::int64_t missing = 0;
    Wide parts_area = 0, material_area = 0;
    double cost = 0;
    void add(const SheetFigures& sheet, double sheet_cost) {
      ++sheets;
      parts_area += sheet.parts_area, material_area += sheet.material_area;
      cost += sheet_cost;
    }
    void add(const OrderTotals& other) {
      placed += other.placed, sheets += other.sheets, missing += other.missing;
      parts_area += other.parts_area, material_area += other.material_area;
      cost += other.cost;
    }
  };

  void compare_order_totals(ReportFields& fields, const OrderTotals& totals) {
    compare(fields, "placed", static_cast<double>(totals.placed), claims_);
    compare(fields, "missing", static_cast<double>(totals.missing), claims_);
    compare(fields, "sheets", static_cast<double>(totals.sheets), claims_);
    compare_near(fields, "density", totals.sheets == 0 ? 0 : share(totals.parts_area, totals.material_area));
    compare(fields, "cost", totals.cost, claims_);
  }

  /// The material of a layout of an order is that of all its parts and stocks.
  void compare_material(ReportFields& item) {
    WrittenMaterial said;
    if (!item.get("material").is_null()) said.name = item.text("material");
    const double thickness = item.number_or_null("thickness").value_or(0);
    const auto differs = [&](const WrittenMaterial& found) {
      return found.name != said.name || static_cast<double>(found.thickness) * kStep != thickness;
    };
    for (const WrittenPart& part : written_.parts)
      if (differs(part.material))
        claims_.findings.push_back(
            fmt::format("{} is not that of the part \"{}\"", item.name("material"), excerpt(part.id)));
    for (const WrittenStock& stock : written_.stocks)
      if (differs(stock.material))
        claims_.findings.push_back(
            fmt::format("{} is not that of the stock \"{}\"", item.name("material"), excerpt(stock.id)));
  }

  void compare_status(bool complete) {
    if (const char* status = complete ? "complete" : "incomplete"; status_ != status)
      claims_.findings.push_back(fmt::format("status is {} and is to be {}", excerpt(status_), status));
  }

  /// Returns the number of pieces that are to be told.
  std::int64_t compare_unplaced(ReportFields& of) {
    std::vector<Hands> wanted(written_.parts.size());
    for (std::size_t p = 0; p < wanted.size(); ++p) wanted[p].either = written_.parts[p].demand;
    for (const WrittenKit& kit : written_.kits) add(kit, kit.demand, wanted);
    const std::vector<Hands> there = placed_hands();
    std::map<std::string, std::int64_t> told;
    of.each("unplaced", [&](Json item, const std::string& path) {
      ReportFields fields(item, path, complaint_);
      if (!complaint_.empty()) return;
      const std::string part = fields.text("part");
      const std::size_t count = fields.index("count");
      if (count == 0) fields.complain(fmt::format("field {} is 0", fields.name("count")));
      told[part] += static_cast<std::int64_t>(count);
      (void)fields.text("reason");
      fields.refuse_others();
    });
    std::int64_t all = 0;
    for (std::size_t p = 0; p < wanted.size(); ++p) {
      const std::int64_t count = missing(wanted[p], there[p]);
      all += count;
      const auto found = told.find(written_.parts[p].id);
      const std::int64_t said = found == told.end() ? 0 : found->second;
      if (said != count)
        claims_.findings.push_back(fmt::format("{} says {} of \"{}\" and is to say {}", of.name("unplaced"),
                                               said, written_.parts[p].id, count));
      if (found != told.end()) told.erase(found);
    }
    for (const auto& [part, count] : told)
      claims_.findings.push_back(
          fmt::format("{} names a part \"{}\", which is not there", of.name("unplaced"), excerpt(part)));
    return all;
  }

  Finding read_violation(Json item, const std::string& path) {
    ReportFields fields(item, path, complaint_);
    if (!complaint_.empty()) return {};
    Finding finding{fields.text("kind"),
                    fields.index("a"),
                    0,
                    fields.text("stock"),
                    static_cast<std::int64_t>(fields.index("copy")),
                    {}};
    if (!fields.get("b").is_null()) std::get<2>(finding) = fields.index("b");
    if (fields.has("feature")) std::get<5>(finding) = fields.text("feature");
    (void)fields.number("amount_mm");
    fields.each("at", [](Json, const std::string&) {});
    if (!fields.get("direction").is_null()) fields.each("direction", [](Json, const std::string&) {});
    fields.refuse_others();
    return finding;
  }

  /// Judges a layout of a report; nothing where the checker reads no such form, or its polygons are not made
  /// yet. The figures made from it are unchecked then.
  Result<std::optional<LayoutVerdict>> verdict_of(const Document& layout, std::string_view figures) {
    if (kind_of(layout) != Kind::layout) {
      claims_.unchecked.push_back(
          fmt::format("{}: {} is in a form that the checker does not read", figures, layout.name));
      return std::optional<LayoutVerdict>();
    }
    Result<LayoutVerdict> verdict = verify_layout(layout);
    if (verdict) return std::optional(*std::move(verdict));
    LEKALO_TRY(const WrittenLayout unmade, read_layout(layout, true));
    claims_.unchecked.push_back(fmt::format("{}: {}", figures, verdict.error().message));
    return std::optional<LayoutVerdict>();
  }

  Result<void> compare_violations(const Document& layout, const std::set<Finding>& told) {
    LEKALO_TRY(const std::optional<LayoutVerdict> verdict, verdict_of(layout, "violations"));
    if (!verdict) return {};
    std::set<Finding> found;
    for (const LayoutViolation& v : verdict->violations)
      found.emplace(std::string(name_of(v.kind)), v.a, v.b, v.stock, v.copy, v.feature);
    if (found != told)
      claims_.findings.push_back(
          fmt::format("violations are not those of {}, which breaks {} rules", layout.name, found.size()));
    if (!told.empty())
      claims_.unchecked.emplace_back(
          "violations: by how much, where, and the way out (amount_mm, at, direction)");
    claims_.notes.push_back(fmt::format("every rule was rechecked for {} placements", verdict->placements));
    return {};
  }

  const Document& report_;
  const std::vector<NamedFile>& names_;
  const std::vector<Document>& files_;
  std::string complaint_, status_;
  ReportFields fields_;
  WrittenLayout written_;
  std::vector<SheetFigures> sheets_;
  ClaimReport claims_;
};

}  // namespace

Result<ClaimReport> verify_layout_report(const Document& report, const std::vector<Document>& files) {
  LEKALO_TRY(const Json root, parse_json(report.bytes, report.name));
  LEKALO_TRY(const std::vector<NamedFile> names, named_files(report));
  LayoutReport rechecked(report, names, files, root);
  LEKALO_TRY(const Kind kind, kind_of(report));
  switch (kind) {
    case Kind::nest_report:
      return rechecked.nest();
    case Kind::order_report:
      return rechecked.order();
    case Kind::show_report:
      return rechecked.show();
    default:
      return rechecked.check();
  }
}

}  // namespace lekalo::verify

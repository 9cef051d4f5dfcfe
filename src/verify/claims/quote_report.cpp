#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "lekalo/base/nc_words.hpp"
#include "quote_rates.hpp"
#include "report_fields.hpp"
#include "same_layout.hpp"
#include "sheet_figures.hpp"
#include "verify/profile/profile_moves.hpp"

namespace lekalo::verify {
namespace {

/// Sums of doubles over a million parts are nearer than this to the exact figure.
constexpr double kQuotedSumRounding = 0x1p-40;
/// Shares are whole units of a quantity's last decimal, and what they are shares of was rounded as well.
const Fraction kShareRounding = 2, kChargeRounding = 1;
/// A length that is written in thousandths, for each part of a sheet; and of all of it, by arcs whose ends
/// lie on circles of two radii.
constexpr double kLengthRounding = 1e-3, kLengthShare = 1e-6;

enum What : std::uint8_t { machine, setup, pierces, cut, material };
constexpr std::array<std::string_view, 5> kWhats{"machine", "set-up", "pierces", "cut", "material"};

Fraction of_wide(Wide value) {
  const Wide low = value & ((Wide{1} << 62) - 1), high = value >> 62;
  return Fraction((Integer(static_cast<long>(high)) << 62) + Integer(static_cast<long>(low)));
}

/// Half of twice an area in square steps, in mm^2.
Fraction square_mm(Wide twice_steps) {
  Fraction area = of_wide(twice_steps) / (Integer(1) << 41);
  area.canonicalize();
  return area;
}

/// The value to the last of so many decimals, halves up. \pre value >= 0
Fraction rounded(const Fraction& value, unsigned long decimals) {
  const Fraction scaled = 2 * value * power_of_ten(decimals) + 1;
  const Integer whole = scaled.get_num() / (2 * scaled.get_den());
  Fraction result(whole, power_of_ten(decimals));
  result.canonicalize();
  return result;
}

struct QuotedTime {
  Fraction cut, pierce, travel, setup;
  [[nodiscard]] Fraction machine() const { return cut + pierce + travel; }
  QuotedTime& operator+=(const QuotedTime& other) {
    cut += other.cut, pierce += other.pierce, travel += other.travel, setup += other.setup;
    return *this;
  }
  friend bool operator==(const QuotedTime&, const QuotedTime&) = default;
};

/// A sheet of the quote as it is written, and as it is to be.
struct QuotedSheet {
  std::size_t layout = 0, stock = 0;
  std::int64_t copy = 0;
  WrittenMaterial material;
  const WrittenPrice* price = nullptr;
  std::map<std::size_t, std::int64_t> pieces;  ///< of parts of the layout
  Fraction charge;                             ///< exactly, in mm^2 or parts of a sheet
  Fraction length, amount;
  std::int64_t pierces = 0;
  QuotedTime time;
  std::array<Fraction, 5> sums;  ///< of its lines, by what
  Fraction lines;                ///< the sum of their amounts
  std::size_t parts = 0;
};

struct QuotedPart {
  std::size_t layout = 0, part = 0;
  std::string customer, due, label;
  std::int64_t pieces = 0, pierces = 0;
  Fraction length, amount, lines;
  QuotedTime time;
  std::array<Fraction, 5> sums;
};

/// The contours of an outline: a loop ends where the next one begins elsewhere.
std::int64_t contours_of(const GridOutline& outline) {
  std::int64_t contours = 1;
  for (std::size_t i = 1; i < outline.edges.size(); ++i)
    if (outline.edges[i].from != outline.edges[i - 1].to) ++contours;
  return contours;
}

class QuoteReport {
 public:
  QuoteReport(const Document& report, const std::vector<NamedFile>& names, const std::vector<Document>& files,
              Json root)
      : report_(report), names_(names), files_(files), fields_(root, "", complaint_) {}

  Result<ClaimReport> checked() {
    common();
    LEKALO_CHECK(read_files());
    if (layouts_.empty()) return std::move(claims_);
    if (const std::string currency = fields_.text("currency"); currency != rates_.currency)
      finding(fmt::format("currency is {} and is to be {}", excerpt(currency), rates_.currency));
    compare(fields_, "decimals", static_cast<double>(rates_.decimals), claims_);
    read_common_line();
    list_wanted();
    compare_items(fields_, "sheets", sheets_.size(), claims_,
                  [&](ReportFields& item, std::size_t i) { read_sheet(item, i); });
    compare_items(fields_, "parts", parts_.size(), claims_,
                  [&](ReportFields& item, std::size_t i) { read_part(item, i); });
    fields_.each("lines", [&](Json value, const std::string& path) {
      ReportFields item(value, path, complaint_);
      if (complaint_.empty()) read_line(item);
      item.refuse_others();
    });
    LEKALO_CHECK(fine());
    compare_sums();
    compare_shares();
    compare_orders();
    compare_totals();
    LEKALO_CHECK(compare_programs());
    fields_.refuse_others();
    LEKALO_CHECK(fine());
    claims_.unchecked.emplace_back(
        "seconds: they are those of a model of the machine, and so is how they are shared out; their sums "
        "hold");
    claims_.notes.push_back(fmt::format("{} lines of {} parts on {} sheets were reckoned again", told_.size(),
                                        parts_.size(), sheets_.size()));
    return std::move(claims_);
  }

 private:
  [[nodiscard]] Result<void> fine() const {
    if (complaint_.empty()) return {};
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", report_.name, complaint_));
  }
  void finding(std::string sentence) { claims_.findings.push_back(std::move(sentence)); }

  void common() {
    check_format(fields_, "lekalo-quote", complaint_);
    if (fields_.text("status") != "quoted") fields_.complain("field status is not \"quoted\"");
    (void)fields_.get("inputs"), (void)fields_.get("outputs"), (void)fields_.text("version");
    (void)fields_.index("work"), (void)fields_.index("seed");
    fields_.each("warnings", [](Json, const std::string&) {});
    if (!fields_.get("run").is_object()) fields_.complain("field run is not an object");
  }

  /// Reads the layouts and the rates. Without a layout that can be read nothing is left to be reckoned.
  Result<void> read_files() {
    LEKALO_CHECK(fine());
    std::optional<Document> rates;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::string& role = names_[i].role;
      if (role == "rates") {
        if (rates) fields_.complain("it names two files with the role \"rates\"");
        rates = files_[i];
      } else if (role == "program") {
        programs_.push_back(files_[i]);
      } else if (role == "layout") {
        Result<WrittenLayout> layout =
            kind_of(files_[i]) == Kind::layout
                ? read_layout(files_[i])
                : failure(ErrorCode::bad_input,
                          fmt::format("{} is in a form that the checker does not read", files_[i].name));
        if (!layout) {
          claims_.unchecked.push_back(fmt::format("all of the quote: {}", layout.error().message));
          layouts_.clear();
          return {};
        }
        layouts_.push_back(*std::move(layout));
      } else if (role != "processes") {
        fields_.complain(fmt::format("it names a file with the role \"{}\"", excerpt(role)));
      }
    }
    if (!rates) fields_.complain("it names no file with the role \"rates\"");
    if (layouts_.empty()) fields_.complain("it names no file with the role \"layout\"");
    LEKALO_CHECK(fine());
    LEKALO_TRY(rates_, read_written_rates(*rates));
    return {};
  }

  /// The sheets in use and the parts that are placed, in the order of the layouts.
  void list_wanted() {
    for (std::size_t l = 0; l < layouts_.size(); ++l) {
      const WrittenLayout& layout = layouts_[l];
      for (SheetFigures& figures : sheets_of(layout)) {
        QuotedSheet& sheet = sheets_.emplace_back();
        sheet.layout = l, sheet.stock = figures.stock, sheet.copy = figures.copy;
        figures_.push_back(std::move(figures));
      }
      std::vector<std::int64_t> pieces(layout.parts.size());
      for (const WrittenPiece& piece : layout.placements) {
        ++pieces[piece.part];
        for (QuotedSheet& sheet : sheets_)
          if (sheet.layout == l && sheet.stock == piece.stock && sheet.copy == piece.copy)
            ++sheet.pieces[piece.part];
      }
      for (std::size_t p = 0; p < pieces.size(); ++p) {
        if (pieces[p] == 0) continue;
        QuotedPart& part = parts_.emplace_back();
        part.layout = l, part.part = p, part.pieces = pieces[p];
      }
    }
  }

  /// A decimal that stands as a text, so that no reader makes a double of it.
  Fraction decimal(ReportFields& fields, const char* key) {
    const std::string text = fields.text(key);
    if (const auto number = parse_decimal(text)) return to_fraction(*number);
    fields.complain(fmt::format("field {} is no number in a text", fields.name(key)));
    return 0;
  }

  QuotedTime time_of(ReportFields& fields) {
    QuotedTime time;
    time.cut = decimal(fields, "cut_s"), time.pierce = decimal(fields, "pierce_s");
    time.travel = decimal(fields, "travel_s"), time.setup = decimal(fields, "setup_s");
    return time;
  }

  void compare_near(ReportFields& fields, const char* key, const Fraction& found) {
    const double written = fields.number(key), exact = cut_to_double(found);
    if (!(std::abs(written - exact) <= kQuotedSumRounding * exact))
      finding(fmt::format("{} is {} and is to be {}", fields.name(key), written, exact));
  }
  void compare_word(ReportFields& fields, const char* key, const std::string& found) {
    if (const std::string written = fields.text(key); written != found)
      finding(fmt::format("{} is \"{}\" and is to be \"{}\"", fields.name(key), excerpt(written),
                          excerpt(found)));
  }

  /// With common lines one pierce may be for the outlines of several parts.
  void read_common_line() {
    if (!fields_.has("common_line")) return;
    if (fields_.get("common_line").text != "true") finding("common_line is there and is not true");
    has_common_lines_ = true;
  }

  void read_sheet(ReportFields& item, std::size_t i) {
    QuotedSheet& sheet = sheets_[i];
    const WrittenStock& stock = layouts_[sheet.layout].stocks[sheet.stock];
    const SheetFigures& figures = figures_[i];
    compare(item, "layout", static_cast<double>(sheet.layout), claims_);
    compare_word(item, "stock", stock.id);
    compare(item, "copy", static_cast<double>(sheet.copy), claims_);
    sheet.material.name = item.text("material");
    sheet.material.thickness = std::llround(item.number("thickness") / kStep);
    if (!stock.material.name.empty() && stock.material.name != sheet.material.name)
      finding(fmt::format("{} is not that of the stock", item.name("material")));
    if (stock.material.thickness != 0 && stock.material.thickness != sheet.material.thickness)
      finding(fmt::format("{} is not that of the stock", item.name("thickness")));
    compare(item, "pieces", static_cast<double>(figures.parts.size()), claims_);
    compare_near(item, "parts_area_mm2", square_mm(figures.parts_area));
    compare_near(item, "material_area_mm2", square_mm(figures.material_area));
    sheet.price = price_of(sheet, stock);
    if (sheet.price == nullptr) finding(fmt::format("{}: there is no rate for it", item.name("material")));
    read_charge(item, sheet, figures, stock);
    sheet.pierces = static_cast<std::int64_t>(item.index("pierces"));
    sheet.length = decimal(item, "cut_mm");
    (void)decimal(item, "travel_mm");
    sheet.time = time_of(item);
    sheet.amount = decimal(item, "amount");
  }

  /// The rate of the sheet's size where there is one, else that of a square metre.
  [[nodiscard]] const WrittenPrice* price_of(const QuotedSheet& sheet, const WrittenStock& stock) const {
    constexpr double kSameSide = 0.5;  // mm
    const GridBox& box = stock.outline.box;
    const auto [small, large] = std::minmax({static_cast<double>(box.high_x - box.low_x) * kStep,
                                             static_cast<double>(box.high_y - box.low_y) * kStep});
    const WrittenPrice* by_area = nullptr;
    for (const WrittenPrice& price : rates_.prices) {
      if (price.material != sheet.material) continue;
      if (!price.sheet)
        by_area = &price;
      else if (stock.kind != "strip" && std::abs(price.sheet->first - small) <= kSameSide &&
               std::abs(price.sheet->second - large) <= kSameSide)
        return &price;
    }
    return by_area;
  }

  /// The remnant is free and large enough to be one, and what is charged is what is left without it. That
  /// there is none larger is not claimed.
  void read_charge(ReportFields& item, QuotedSheet& sheet, const SheetFigures& figures,
                   const WrittenStock& stock) {
    Fraction remnant = 0;
    if (!item.get("remnant").is_null()) {
      std::vector<std::int64_t> steps;
      item.each("remnant", [&](Json number, const std::string& path) {
        const double mm = item.number_of(number, path);
        const auto step = steps_of(mm, ToStep::nearest, 1e6);
        if (step && static_cast<double>(*step) * kStep == mm) steps.push_back(*step);
      });
      // An empty box is not free.
      const GridBox box = steps.size() == 4 ? GridBox{steps[0], steps[1], steps[2], steps[3]} : GridBox{};
      // Behind the length used a strip is not charged, so nothing is taken off for what is left there.
      if (!is_free(box, figures, stock) || (stock.kind == "strip" && box.high_x > figures.last)) {
        finding(fmt::format("{} is no free rectangle", item.name("remnant")));
      } else {
        const std::int64_t width = box.high_x - box.low_x, height = box.high_y - box.low_y;
        remnant = square_mm(2 * Wide{width} * height);
        if (sheet.price != nullptr &&
            !(sheet.price->least_remnant &&
              static_cast<double>(std::min(width, height)) * kStep >= *sheet.price->least_remnant))
          finding(fmt::format("{} is too small for a remnant by the rates", item.name("remnant")));
      }
    }
    const Fraction area = square_mm(figures.material_area);
    if (sheet.price != nullptr)
      sheet.charge = sheet.price->sheet ? Fraction(1 - sheet.price->remnant_percent / 100 * remnant / area)
                                        : Fraction(area - remnant);
  }

  void read_part(ReportFields& item, std::size_t i) {
    QuotedPart& part = parts_[i];
    const WrittenPart& written = layouts_[part.layout].parts[part.part];
    compare(item, "layout", static_cast<double>(part.layout), claims_);
    compare_word(item, "part", written.id);
    (void)item.text("name");
    compare_word(item, "customer", written.customer);
    compare_word(item, "due", written.due);
    compare_word(item, "label", written.label);
    part.customer = written.customer, part.due = written.due, part.label = written.label;
    compare(item, "pieces", static_cast<double>(part.pieces), claims_);
    part.pierces = static_cast<std::int64_t>(item.index("pierces"));
    part.length = decimal(item, "cut_mm");
    part.time = time_of(item);
    part.amount = decimal(item, "amount");
  }

  void read_line(ReportFields& item) {
    const std::size_t s = item.index("sheet"), p = item.index("part");
    const std::string what = item.text("what"), unit = item.text("unit");
    const Fraction quantity = decimal(item, "quantity"), rate = decimal(item, "rate"),
                   amount = decimal(item, "amount");
    const double per = item.number("per"), pieces = item.number("pieces");
    if (!complaint_.empty()) return;
    const auto* const known = std::find(kWhats.begin(), kWhats.end(), what);
    const std::string name = item.name("what");
    if (known == kWhats.end() || s >= sheets_.size() || p >= parts_.size() ||
        sheets_[s].layout != parts_[p].layout || !sheets_[s].pieces.contains(parts_[p].part))
      return finding(fmt::format("{}: there is no such thing to pay for", name));
    const auto kind = static_cast<What>(known - kWhats.begin());
    if (!told_.emplace(s, p, kind).second) return finding(fmt::format("{} is there twice", name));
    QuotedSheet& sheet = sheets_[s];
    QuotedPart& part = parts_[p];
    if (pieces != static_cast<double>(sheet.pieces[part.part]))
      finding(fmt::format("{} is {} and is to be {}", item.name("pieces"), pieces, sheet.pieces[part.part]));
    const bool by_sheet = kind == material && sheet.price != nullptr && sheet.price->sheet;
    constexpr std::array<std::string_view, 5> kUnits{"s", "s", "pierce", "m", "m2"};
    if (unit != (by_sheet ? "sheet" : kUnits[kind]))
      finding(fmt::format("{} is not its unit", item.name("unit")));
    const double wanted_per = kind == machine || kind == setup ? 3600 : 1;
    if (per != wanted_per)
      finding(fmt::format("{} is {} and is to be {}", item.name("per"), per, wanted_per));
    if (rate != rate_of(kind, sheet)) finding(fmt::format("{} is not that of the rates", item.name("rate")));
    if (sgn(quantity) <= 0) return finding(fmt::format("{} is not above 0", item.name("quantity")));
    if (amount != rounded(Fraction(quantity * rate / static_cast<long>(wanted_per)), rates_.decimals))
      finding(fmt::format("{} is not quantity times rate, rounded half up", item.name("amount")));
    if (kind == pierces && quantity < sheet.pieces[part.part] * least_pierces(part))
      finding(fmt::format("{}: fewer pierces than contours", item.name("quantity")));
    sheet.sums[kind] += quantity, part.sums[kind] += quantity;
    sheet.lines += amount, part.lines += amount;
    if (kind == material) shares_[s].emplace_back(p, quantity);
  }

  /// A piece has one for each contour, or for each hole where its outline may be cut with those of others.
  [[nodiscard]] std::int64_t least_pierces(const QuotedPart& part) const {
    return contours_of(layouts_[part.layout].parts[part.part].outline) - (has_common_lines_ ? 1 : 0);
  }

  [[nodiscard]] Fraction rate_of(What what, const QuotedSheet& sheet) const {
    switch (what) {
      case machine:
        return rates_.per_hour;
      case setup:
        return rates_.setup_per_hour;
      case pierces:
        return rates_.per_pierce;
      case cut:
        return rates_.per_m_cut;
      case material:
        break;
    }
    return sheet.price == nullptr ? Fraction(0) : sheet.price->price;
  }

  /// Complains where a sum of lines, which are there where the rate is above 0, is not the figure beside
  /// them.
  void compare_sum(const std::string& of, What what, const Fraction& rate, const Fraction& sum,
                   const Fraction& figure) {
    if (sgn(rate) > 0 && sum != figure)
      finding(fmt::format("{}: its lines of {} are not all of it", of, kWhats[what]));
  }

  void compare_sums() {
    QuotedTime on_sheets, of_parts;
    Fraction length_on_sheets = 0, length_of_parts = 0;
    std::int64_t pierces_on_sheets = 0, pierces_of_parts = 0;
    const auto sums = [&](const std::string& of, const auto& it) {
      compare_sum(of, machine, rates_.per_hour, it.sums[machine], it.time.machine());
      compare_sum(of, setup, rates_.setup_per_hour, it.sums[setup], it.time.setup);
      compare_sum(of, pierces, rates_.per_pierce, it.sums[pierces], it.pierces);
      compare_sum(of, cut, rates_.per_m_cut, it.sums[cut], it.length / 1000);
      if (it.amount != it.lines) finding(fmt::format("{}.amount is not the sum of its lines", of));
    };
    for (std::size_t i = 0; i < sheets_.size(); ++i) {
      sums(fmt::format("sheets[{}]", i), sheets_[i]);
      on_sheets += sheets_[i].time, length_on_sheets += sheets_[i].length,
          pierces_on_sheets += sheets_[i].pierces;
      subtotal_ += sheets_[i].lines;
    }
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      sums(fmt::format("parts[{}]", i), parts_[i]);
      of_parts += parts_[i].time, length_of_parts += parts_[i].length, pierces_of_parts += parts_[i].pierces;
      if (parts_[i].pierces < parts_[i].pieces * least_pierces(parts_[i]))
        finding(fmt::format("parts[{}].pierces: fewer than contours", i));
    }
    if (!(on_sheets == of_parts)) finding("the seconds of sheets and of parts have not the same sums");
    if (length_on_sheets != length_of_parts) finding("cut_mm of sheets and of parts have not the same sum");
    if (pierces_on_sheets != pierces_of_parts)
      finding("pierces of sheets and of parts have not the same sum");
    const Fraction wanted = rates_.setup_once + rates_.setup_per_sheet * static_cast<long>(sheets_.size());
    if (abs(Fraction(on_sheets.setup - wanted)) * 1000 > static_cast<long>(sheets_.size() + 1))
      finding("setup_s of all sheets is not that of the rates");
  }

  /// The material of a sheet is shared out by the areas of its parts.
  void compare_shares() {
    for (std::size_t s = 0; s < sheets_.size(); ++s) {
      const QuotedSheet& sheet = sheets_[s];
      if (sheet.price == nullptr || sgn(sheet.price->price) == 0) continue;
      // A quantity counts parts of a sheet by thousand millions, and m^2 by mm^2.
      const Fraction units = sheet.price->sheet ? power_of_ten(9) : power_of_ten(6);
      const Fraction wanted = sheet.price->sheet ? Fraction(sheet.charge * units) : sheet.charge;
      if (abs(Fraction(sheet.sums[material] * units - wanted)) > kChargeRounding)
        finding(fmt::format("sheets[{}]: its lines of material are not what is charged of it", s));
      Fraction whole = 0;
      const auto weight = [&](const QuotedPart& part) {
        return Fraction(of_wide(twice_area(layouts_[part.layout].parts[part.part].outline)) *
                        sheet.pieces.at(part.part));
      };
      for (const auto& [p, quantity] : shares_[s]) whole += weight(parts_[p]);
      for (const auto& [p, quantity] : shares_[s])
        if (abs(Fraction(quantity * units - wanted * weight(parts_[p]) / whole)) > kShareRounding)
          finding(
              fmt::format("sheets[{}]: the share of the part \"{}\" in its material is not that of its area",
                          s, excerpt(layouts_[sheet.layout].parts[parts_[p].part].id)));
    }
  }

  void compare_orders() {
    using Purpose = std::tuple<std::string, std::string, std::string>;
    struct Order {
      Purpose purpose;
      std::int64_t pieces;
      Fraction amount;
    };
    std::vector<Order> orders;
    for (const QuotedPart& part : parts_) {
      const Purpose purpose(part.customer, part.due, part.label);
      const auto same =
          std::find_if(orders.begin(), orders.end(), [&](const Order& o) { return o.purpose == purpose; });
      if (same == orders.end()) {
        orders.push_back({purpose, part.pieces, part.lines});
      } else {
        same->pieces += part.pieces, same->amount += part.lines;
      }
    }
    compare_items(fields_, "orders", orders.size(), claims_, [&](ReportFields& item, std::size_t i) {
      const auto& [customer, due, label] = orders[i].purpose;
      compare_word(item, "customer", customer);
      compare_word(item, "due", due);
      compare_word(item, "label", label);
      compare(item, "pieces", static_cast<double>(orders[i].pieces), claims_);
      compare_money(item, "amount", orders[i].amount);
    });
  }

  void compare_money(ReportFields& fields, const char* key, const Fraction& found) {
    if (decimal(fields, key) != found)
      finding(fmt::format("{} is not what follows from the lines", fields.name(key)));
  }

  void compare_totals() {
    const Fraction margin = rounded(Fraction(subtotal_ * rates_.margin_percent / 100), rates_.decimals);
    const Fraction tax = rounded(Fraction((subtotal_ + margin) * rates_.tax_percent / 100), rates_.decimals);
    compare_money(fields_, "subtotal", subtotal_);
    compare_money(fields_, "margin", margin);
    compare_money(fields_, "tax", tax);
    compare_money(fields_, "total", subtotal_ + margin + tax);
    if (decimal(fields_, "margin_percent") != rates_.margin_percent)
      finding("margin_percent is not that of the rates");
    if (decimal(fields_, "tax_percent") != rates_.tax_percent)
      finding("tax_percent is not that of the rates");
  }

  /// Lengths and pierces of the programs, where these were written.
  Result<void> compare_programs() {
    if (programs_.empty()) {
      claims_.unchecked.emplace_back(
          "cut_mm, travel_mm, pierces beyond the contours: the programs were not written (--gcode)");
      return {};
    }
    claims_.unchecked.emplace_back("travel_mm, and cut_mm by part: only cut_mm of sheets is rechecked");
    if (programs_.size() != sheets_.size()) {
      finding(fmt::format("it names {} programs for {} sheets", programs_.size(), sheets_.size()));
      return {};
    }
    for (std::size_t i = 0; i < programs_.size(); ++i) {
      LEKALO_TRY(const ProfileProgram program, read_profile(programs_[i], words::Control::linuxcnc));
      double mm = 0;
      std::int64_t begun = 0;
      const Place* before = nullptr;
      for (const CutChain& chain : program.chains) {
        // A further pass goes on where the one before ended.
        const Place& from = chain.edges.front().from;
        if (before == nullptr || before->x != from.x || before->y != from.y) ++begun;
        for (const Stroke& edge : chain.edges) mm += length(edge);
        before = &chain.edges.back().to;
      }
      const double written = cut_to_double(sheets_[i].length);
      const double room =
          kLengthRounding * static_cast<double>(sheets_[i].pieces.size() + 1) + kLengthShare * mm;
      if (!(std::abs(written - mm) <= room))
        finding(fmt::format("sheets[{}].cut_mm is {} and its program cuts {:.3f}", i, written, mm));
      if (sheets_[i].pierces != begun)
        finding(fmt::format("sheets[{}].pierces is {} and its program begins {} cuts", i, sheets_[i].pierces,
                            begun));
    }
    return {};
  }

  const Document& report_;
  const std::vector<NamedFile>& names_;
  const std::vector<Document>& files_;
  std::string complaint_;
  ReportFields fields_;
  WrittenRates rates_;
  std::vector<WrittenLayout> layouts_;
  std::vector<Document> programs_;
  bool has_common_lines_ = false;
  std::vector<QuotedSheet> sheets_;
  std::vector<SheetFigures> figures_;  ///< by sheet
  std::vector<QuotedPart> parts_;
  std::set<std::tuple<std::size_t, std::size_t, What>> told_;
  std::map<std::size_t, std::vector<std::pair<std::size_t, Fraction>>> shares_;  ///< of material, by sheet
  Fraction subtotal_;
  ClaimReport claims_;
};

}  // namespace

Result<ClaimReport> verify_quote_report(const Document& report, const std::vector<Document>& files) {
  LEKALO_TRY(const std::vector<NamedFile> names, named_files(report));
  LEKALO_TRY(const Json root, parse_json(report.bytes, report.name));
  return QuoteReport(report, names, files, root).checked();
}

}  // namespace lekalo::verify

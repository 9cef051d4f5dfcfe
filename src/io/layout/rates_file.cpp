#include "lekalo/io/layout/rates_file.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <tuple>
#include <utility>

#include "io/text/file_faults.hpp"
#include "io/text/json_reader.hpp"
#include "io/text/json_tree.hpp"
#include "io/text/refusal.hpp"
#include "lekalo/geom/grid.hpp"
#include "lekalo/io/text/excerpt.hpp"
#include "lekalo/layout/material_words.hpp"

namespace lekalo::io {
namespace {

using detail::JsonKind;
using detail::JsonTree;
using detail::JsonValue;

constexpr std::string_view kRatesFormat = "lekalo-rates/1";
constexpr std::size_t kMostRatedMaterials = 10'000, kMostPrintedLines = 12;
constexpr double kHighestRate = 1e9;
/// A side of a stock is that of a sheet of the file within this, mm: sheets are sold by whole millimetres.
constexpr double kSameSide = 0.5;

struct RuleName {
  const char* name;
  nc::JunctionRule rule;
};
constexpr std::array kRuleNames{RuleName{"exact stop", nc::JunctionRule::exact_stop},
                                RuleName{"exact path", nc::JunctionRule::exact_path},
                                RuleName{"junction deviation", nc::JunctionRule::deviation}};

class RatesReader {
 public:
  explicit RatesReader(const std::string& name) : name_(name) { rates_.name = name; }

  Result<Rates> read(JsonValue root) {
    LEKALO_CHECK(expect_format(root, name_, "file of rates", kRatesFormat));
    known(root, {"format", "currency", "decimals", "issuer", "terms", "machine", "rates", "margin_percent",
                 "tax_percent", "materials"});
    currency(root);
    if (const auto decimals = whole(root, "decimals", 0, 4)) rates_.decimals = static_cast<int>(*decimals);
    lines(root, "issuer", rates_.issuer), lines(root, "terms", rates_.terms);
    rates_.margin_percent = rate(root, "margin_percent", 1000, false).value_or(0);
    rates_.tax_percent = rate(root, "tax_percent", 1000, false).value_or(0);
    machine(root);
    hourly(root);
    materials(root);
    LEKALO_CHECK(faults_.refused(name_));
    return std::move(rates_);
  }

 private:
  void complain(const std::string& what) { faults_.add(what); }

  void known(JsonValue object, std::initializer_list<std::string_view> keys) {
    for (const JsonValue item : object) {
      if (std::find(keys.begin(), keys.end(), item.key()) != keys.end()) continue;
      std::string list;
      for (const std::string_view key : keys) list += (list.empty() ? "" : ", ") + std::string(key);
      complain(fmt::format("there is no key {}; known are {}", excerpt(item.key()), list));
    }
  }

  /// A member that is an object; nothing after a complaint.
  std::optional<JsonValue> object(JsonValue root, const char* key, const char* what) {
    const auto found = root.find(key);
    if (!found)
      complain(fmt::format("{} is missing: {}", key, what));
    else if (found->kind() != JsonKind::object)
      complain(fmt::format("{} has to be an object, not {}", key, name_of(found->kind())));
    else
      return found;
    return std::nullopt;
  }

  void currency(JsonValue root) {
    const auto found = root.find("currency");
    if (!found) return complain("currency is missing: three capitals, for example \"EUR\"");
    if (found->kind() == JsonKind::text) {
      const std::string_view said = found->text();
      if (said.size() == 3 &&
          std::all_of(said.begin(), said.end(), [](char c) { return c >= 'A' && c <= 'Z'; })) {
        rates_.currency = said;
        return;
      }
    }
    complain("currency has to be three capitals, for example \"EUR\"");
  }

  std::optional<double> number(JsonValue object, const char* key, double low, double high, bool needed) {
    const auto found = object.find(key);
    if (!found) {
      if (needed) complain(fmt::format("{} is missing", key));
      return std::nullopt;
    }
    return in_range(*found, key, low, high);
  }
  std::optional<double> in_range(JsonValue item, const char* key, double low, double high) {
    if (item.is_number() && item.number() >= low && item.number() <= high) return item.number();
    complain(fmt::format("{}{} has to be a number from {:g} to {:g}", key,
                         item.is_number() ? fmt::format(" {}:", item.number()) : "", low, high));
    return std::nullopt;
  }
  std::optional<double> whole(JsonValue object, const char* key, double low, double high) {
    const auto found = number(object, key, low, high, false);
    if (found && *found != std::floor(*found)) {
      complain(fmt::format("{} {}: has to be a whole number", key, *found));
      return std::nullopt;
    }
    return found;
  }

  /// A number with six decimals or fewer, from 0. The double nearest to such a decimal is that of no other.
  std::optional<Millionths> rate(JsonValue object, const char* key, double high, bool needed) {
    const auto found = number(object, key, 0, high, needed);
    if (!found) return std::nullopt;
    const auto millionths =
        static_cast<Millionths>(std::llround(*found * static_cast<double>(kOneInMillionths)));
    if (static_cast<double>(millionths) / static_cast<double>(kOneInMillionths) == *found) return millionths;
    complain(fmt::format("{} {}: has to have at most six decimals", key, *found));
    return std::nullopt;
  }

  static bool is_printable(std::string_view said) {
    return !said.empty() && said.size() <= detail::kLongestText &&
           std::none_of(said.begin(), said.end(),
                        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  }

  void lines(JsonValue root, const char* key, std::vector<std::string>& to) {
    const auto found = root.find(key);
    if (!found) return;
    bool fine = found->kind() == JsonKind::list && found->size() <= kMostPrintedLines;
    if (fine)
      for (const JsonValue line : *found) {
        fine = fine && line.kind() == JsonKind::text && is_printable(line.text());
        if (fine) to.emplace_back(line.text());
      }
    if (!fine)
      complain(
          fmt::format("{} has to be a list of at most {} texts of 1 to {} bytes without control characters",
                      key, kMostPrintedLines, detail::kLongestText));
  }

  /// A rate of each axis: one number for all, or a list of three.
  void axes(JsonValue machine, const char* key, std::array<double, 3>& to) {
    const auto found = machine.find(key);
    if (!found) return complain(fmt::format("{} is missing: a number, or a list of X, Y and Z", key));
    if (found->kind() != JsonKind::list) {
      if (const auto all = in_range(*found, key, 1, 1e6)) to.fill(*all);
      return;
    }
    if (found->size() != 3)
      return complain(fmt::format("{} has to be a number, or a list of three: X, Y and Z", key));
    std::size_t axis = 0;
    for (const JsonValue item : *found) {
      if (const auto one = in_range(item, key, 1, 1e6)) to[axis] = *one;
      ++axis;
    }
  }

  void machine(JsonValue root) {
    const auto found = object(root, "machine", "how fast it moves");
    if (!found) return;
    faults_.where = "machine: ";
    known(*found, {"rapid_mm_per_min", "acceleration_mm_per_s2", "junctions", "junction_deviation_mm",
                   "settle_s", "setup_s_once", "setup_s_per_sheet"});
    nc::MachineModel& model = rates_.machine;
    axes(*found, "rapid_mm_per_min", model.rapid_mm_per_min);
    axes(*found, "acceleration_mm_per_s2", model.acceleration_mm_per_s2);
    junctions(*found);
    model.settle_s = number(*found, "settle_s", 0, 10, false).value_or(0);
    const auto milliseconds = [&](const char* key) {
      return static_cast<std::int64_t>(std::llround(1000 * number(*found, key, 0, 1e6, false).value_or(0)));
    };
    rates_.setup_once_ms = milliseconds("setup_s_once");
    rates_.setup_per_sheet_ms = milliseconds("setup_s_per_sheet");
    faults_.where.clear();
  }

  void junctions(JsonValue machine) {
    std::string names;
    for (const RuleName& rule : kRuleNames)
      names += (names.empty() ? "\"" : ", \"") + std::string(rule.name) + '"';
    const auto found = machine.find("junctions");
    if (!found) return complain(fmt::format("junctions is missing: one of {}", names));
    const auto* const rule = std::find_if(kRuleNames.begin(), kRuleNames.end(),
                                          [&](const RuleName& one) { return found->text_is(one.name); });
    if (rule == kRuleNames.end()) return complain(fmt::format("junctions has to be one of {}", names));
    rates_.machine.junctions = rule->rule;
    const bool deviates = rule->rule == nc::JunctionRule::deviation;
    if (!deviates && machine.find("junction_deviation_mm"))
      complain("junction_deviation_mm has a meaning for the junctions \"junction deviation\" alone");
    if (deviates)
      rates_.machine.junction_deviation_mm =
          number(machine, "junction_deviation_mm", 1e-4, 1, true).value_or(0.01);
  }

  void hourly(JsonValue root) {
    const auto found = object(root, "rates", "what an hour, a pierce and a metre cost");
    if (!found) return;
    faults_.where = "rates: ";
    known(*found, {"per_hour", "setup_per_hour", "per_pierce", "per_m_cut"});
    rates_.per_hour = rate(*found, "per_hour", kHighestRate, true).value_or(0);
    rates_.setup_per_hour = rate(*found, "setup_per_hour", kHighestRate, false).value_or(rates_.per_hour);
    rates_.per_pierce = rate(*found, "per_pierce", kHighestRate, false).value_or(0);
    rates_.per_m_cut = rate(*found, "per_m_cut", kHighestRate, false).value_or(0);
    faults_.where.clear();
  }

  void materials(JsonValue root) {
    const auto list = root.find("materials");
    if (!list || list->kind() != JsonKind::list || list->size() == 0 || list->size() > kMostRatedMaterials)
      return complain(fmt::format("materials has to be a list of 1 to {} entries", kMostRatedMaterials));
    std::size_t entry = 0;
    for (const JsonValue item : *list) {
      faults_.where = fmt::format("material {}: ", ++entry);
      if (item.kind() == JsonKind::object)
        material(item, entry);
      else
        complain(fmt::format("an object is needed, not {}", name_of(item.kind())));
    }
    faults_.where.clear();
  }

  void material(JsonValue json, std::size_t entry) {
    known(json, {"material", "thickness_mm", "per_m2", "per_sheet", "sheet_mm", "remnant_percent",
                 "least_remnant_mm"});
    MaterialRate made;
    const auto name = json.find("material");
    if (name && name->kind() == JsonKind::text && is_printable(name->text()))
      made.material = name->text();
    else
      complain("material has to be the name that the layout says, without control characters");
    if (const auto thickness = number(json, "thickness_mm", 0.001, 1000, true))
      made.thickness = geom::grid_from_mm(*thickness);
    const bool by_sheet = json.find("per_sheet").has_value();
    if (by_sheet == json.find("per_m2").has_value())
      complain("either per_m2 or per_sheet is needed, and not both");
    else
      made.price = rate(json, by_sheet ? "per_sheet" : "per_m2", kHighestRate, true).value_or(0);
    if (by_sheet)
      sheet(json, made);
    else
      for (const char* const key : {"sheet_mm", "remnant_percent"})
        if (json.find(key)) complain(fmt::format("{} has a meaning beside per_sheet alone", key));
    made.least_remnant_mm = number(json, "least_remnant_mm", 0, 1e6, false);
    if (by_sheet == made.sheet.has_value() && !made.material.empty() && made.thickness > 0) {
      const auto [place, is_new] =
          first_.emplace(std::tuple(made.material, made.thickness, made.sheet ? made.sheet->width_mm : 0,
                                    made.sheet ? made.sheet->height_mm : 0),
                         entry);
      if (!is_new) complain(fmt::format("{} is material {} already", described_rate(made), place->second));
    }
    rates_.materials.push_back(std::move(made));
  }

  void sheet(JsonValue json, MaterialRate& made) {
    const auto size = json.find("sheet_mm");
    if (!size || size->kind() != JsonKind::list || size->size() != 2)
      return complain("sheet_mm is needed beside per_sheet: the two sides of the sheet in mm");
    std::array<double, 2> sides{};
    std::size_t side = 0;
    for (const JsonValue item : *size) sides[side++] = in_range(item, "sheet_mm", 1, 1e6).value_or(1);
    made.sheet = PlaneSize{std::min(sides[0], sides[1]), std::max(sides[0], sides[1])};
    made.remnant_percent = rate(json, "remnant_percent", 100, false).value_or(0);
    if (made.remnant_percent > 0 && !json.find("least_remnant_mm"))
      complain("remnant_percent needs least_remnant_mm: from which shorter side on a remnant is kept");
  }

 public:
  static std::string described_rate(const MaterialRate& rate) {
    std::string said = layout::words_of({rate.material, rate.thickness});
    if (rate.sheet)
      said += fmt::format(", sheets of {:g} x {:g} mm", rate.sheet->height_mm, rate.sheet->width_mm);
    return said;
  }

 private:
  const std::string& name_;
  FileFaults faults_;
  Rates rates_;
  std::map<std::tuple<std::string, std::int64_t, double, double>, std::size_t> first_;
};

}  // namespace

Result<Rates> read_rates(std::string_view bytes, const std::string& name) {
  LEKALO_TRY(const JsonTree tree, JsonTree::parse(bytes, name));
  return RatesReader(name).read(tree.root());
}

Result<const MaterialRate*> find_rate(const Rates& rates, const layout::Material& material,
                                      const std::optional<PlaneSize>& size) {
  const MaterialRate* by_area = nullptr;
  std::string there;
  std::size_t told = 0;
  for (const MaterialRate& rate : rates.materials) {
    if (told++ < FileFaults::kMostTold) there += (told == 1 ? "" : "; ") + RatesReader::described_rate(rate);
    if (rate.material != material.name || rate.thickness != material.thickness) continue;
    if (!rate.sheet)
      by_area = &rate;
    else if (size &&
             std::abs(std::min(size->width_mm, size->height_mm) - rate.sheet->width_mm) <= kSameSide &&
             std::abs(std::max(size->width_mm, size->height_mm) - rate.sheet->height_mm) <= kSameSide)
      return &rate;
  }
  if (by_area != nullptr) return by_area;
  if (told > FileFaults::kMostTold) there += fmt::format("; and {} more", told - FileFaults::kMostTold);
  return failure(
      ErrorCode::bad_input,
      fmt::format("{}: there is no rate for {}{}; there are: {}", rates.name, layout::words_of(material),
                  size ? fmt::format(", sheets of {:g} x {:g} mm", std::max(size->width_mm, size->height_mm),
                                     std::min(size->width_mm, size->height_mm))
                       : " by the square metre",
                  there));
}

}  // namespace lekalo::io

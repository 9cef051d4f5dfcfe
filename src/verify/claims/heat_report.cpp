#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>
#include <utility>

#include "heat_correction_check.hpp"
#include "heat_fields.hpp"
#include "lekalo/base/limits.hpp"
#include "machining_fields.hpp"
#include "report_fields.hpp"
#include "verify/heat/cut_work.hpp"
#include "verify/heat/measured_places.hpp"
#include "verify/heat/wall_places.hpp"
#include "verify/origin/origin.hpp"
#include "verify/read/known_fields.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify {
namespace {

/// Pieces of the path are this part of the tool's diameter.
constexpr double kPiece = 0.125;
/// The heat may miss its balance by this part (docs/design/heat-walls.md).
constexpr double kBalanced = 1e-3;
/// Figures that follow from measurements are told apart to this part: rises stand to 1e-12 K.
constexpr double kMeasured = 1e-8;

class HeatReport : private HeldFigures {
 public:
  HeatReport(const Document& report, Json root, const std::vector<NamedFile>& names,
             const std::vector<Document>& files)
      : report_(report), names_(names), files_(files), fields_(root, "", complaint_) {}

  Result<ClaimReport> rechecked() {
    check_format(fields_, "lekalo-heat", complaint_);
    for (const char* known : {"inputs", "warnings", "seed", "work", "version", "run"})
      (void)fields_.get(known);
    if (fields_.text("status") != "computed") fields_.complain("field status is not \"computed\"");
    read_words();
    read_files();
    LEKALO_CHECK(fine());
    check_outline();
    LEKALO_CHECK(fine());
    LEKALO_TRY(const CutHistory history, follow());
    read_measured();
    LEKALO_CHECK(fine());
    check_booked(history);
    check_measured_places(history);
    read_walls();
    read_cases();
    LEKALO_CHECK(fine());
    LEKALO_CHECK(check_places(history));
    check_together();
    LEKALO_CHECK(check_correction(history));
    fields_.refuse_others();
    LEKALO_CHECK(fine());
    LEKALO_CHECK(name_unchecked());
    return std::move(claims_);
  }

 private:
  [[nodiscard]] Result<void> fine() const {
    if (complaint_.empty()) return {};
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", report_.name, complaint_));
  }
  void require(bool condition, const std::string& sentence) {
    if (!condition) fields_.complain(sentence);
  }

  CheckedRange read_range(ReportFields& fields, std::string_view key, double least, double greatest) {
    const CheckedRange range = range_of(fields, key);
    require(range.least >= least && range.least <= range.greatest && range.greatest <= greatest,
            fmt::format("field {} is no interval from {:g} to {:g}", fields.name(key), least, greatest));
    return range;
  }

  void read_words() {
    read_machining(fields_, options_);
    cutting_.diameter = options_.tool_diameter;
    cutting_.teeth = static_cast<double>(fields_.index("teeth"));
    cutting_.spindle_rpm = fields_.number("spindle_rpm");
    require(options_.tool_diameter > 0 && cutting_.teeth >= 1 && cutting_.spindle_rpm > 0,
            "tool_mm, teeth and spindle_rpm are not all above 0");
    cutting_.wear = read_range(fields_, "wear", 1, 5);
    film_ = read_range(fields_, "film_w_m2k", 0, 1e5);
    ambient_ = fields_.number("ambient_c");
    spacing_ = fields_.number("voxel_mm");
    require(spacing_ > 0, "field voxel_mm is not above 0");
    read_material();
    read_holding();
    ReportFields stock(fields_.get("stock"), "stock", complaint_);
    if (!complaint_.empty()) return;
    const auto low = stock.numbers<2>("low_mm"), high = stock.numbers<2>("high_mm");
    stock_ = {low[0], low[1], high[0], high[1], stock.number("thickness_mm")};
    read_outline(stock);
    stock.refuse_others();
    require(low[0] < high[0] && low[1] < high[1] && stock_.thickness > 0, "field stock is no block");
  }

  /// The outline of a stock that is no block, as it is stated; check_outline() compares it with its file.
  void read_outline(ReportFields& stock) {
    const Json outline = stock.get("outline");
    if (outline.is_null()) return;
    ReportFields f(outline, "stock.outline", complaint_);
    if (!complaint_.empty()) return;
    const Json regions = f.get("regions");
    outline_drawing_ = f.get("drawing"), outline_scan_ = f.get("scan");
    outline_tolerance_ = f.number("tolerance_mm");
    require(outline_tolerance_ >= 0, "field stock.outline.tolerance_mm is below 0");
    for (const auto& [key, value] :
         {std::pair{"regions", regions}, {"drawing", outline_drawing_}, {"scan", outline_scan_}}) {
      if (value.text.empty()) f.complain(fmt::format("field stock.outline.{} is missing", key));
      refuse_unknown_fields(value, key, complaint_);
    }
    f.refuse_others();
    if (!complaint_.empty()) return;
    if (Fields(regions, "stock.outline.regions", complaint_).text("units") != "mm")
      f.complain("the units of stock.outline.regions are not mm");
    stock_.outline = read_shape(regions, "stock.outline.regions", complaint_);
  }

  /// An outline is what its file means, and the box is about it.
  void check_outline() {
    require(stock_.outline.has_value() == followed_.stock.has_value(),
            "field stock.outline and a file with the role \"stock\" go together");
    if (!complaint_.empty() || !stock_.outline) return;
    if (const auto fault = fault_of(*stock_.outline))
      return find(fmt::format("stock.outline.regions are none: {}", *fault));
    const Origin origin = check_origin(
        {*followed_.stock, *stock_.outline, outline_tolerance_, outline_scan_, outline_drawing_});
    if (origin.fault)
      find(fmt::format("stock.outline is not what {} means: {}", followed_.stock->name, *origin.fault));
    if (origin.open)
      claims_.unchecked.push_back(fmt::format("stock.outline: that it is what {} means was not rechecked: {}",
                                              followed_.stock->name, *origin.open));
    if (outline_tolerance_ > 0)
      claims_.notes.push_back(
          fmt::format("stock.outline is within {} mm of what the file means", outline_tolerance_));
    for (const auto& [key, written, found] : {std::tuple{"low_mm[0]", stock_.low_x, stock_.outline->low_x},
                                              {"low_mm[1]", stock_.low_y, stock_.outline->low_y},
                                              {"high_mm[0]", stock_.high_x, stock_.outline->high_x},
                                              {"high_mm[1]", stock_.high_y, stock_.outline->high_y}})
      hold(fmt::format("stock.{}", key), written, found, kWithin);
  }

  void read_material() {
    ReportFields m(fields_.get("material"), "material", complaint_);
    if (!complaint_.empty()) return;
    (void)m.text("name");
    cutting_.force = read_range(m, "cutting_force_n_mm2", 1, 1e4);
    cutting_.exponent = read_range(m, "force_exponent", 0, 0.6);
    cutting_.share = read_range(m, "share", 0, 1);
    for (const char* key :
         {"conductivity_w_mk", "density_kg_m3", "heat_capacity_j_kgk", "expansion_per_k", "youngs_mpa"})
      (void)read_range(m, key, 1e-9, 1e6);
    yield_ = read_range(m, "yield_mpa", 1, 5000).least;
    (void)read_range(m, "poisson", 0, 0.49);
    std::array<double, 2> borders{};
    for (const auto& [key, border] : {std::pair{"melting_c", &borders[0]}, {"glass_c", &borders[1]}}) {
      if (!m.get(key).is_null()) *border = read_range(m, key, 40, 4000).least;
    }
    m.refuse_others();
    require(borders[0] > 0 || borders[1] > 0, "field material has neither melting_c nor glass_c");
    limit_ = borders[1] > 0 ? borders[1] : (borders[0] - 273.15) / 2;
  }

  void read_holding() {
    ReportFields holding(fields_.get("holding"), "holding", complaint_);
    if (!complaint_.empty()) return;
    constexpr std::array<std::string_view, 4> kKinds{"free", "plate", "vice-x", "vice-y"};
    if (std::ranges::find(kKinds, holding.text("kind")) == kKinds.end())
      holding.complain("field holding.kind is not free, plate, vice-x or vice-y");
    if (!holding.get("datum_mm").is_null()) (void)holding.numbers<3>("datum_mm");
    holding.refuse_others();
  }

  /// A corrected program stands beside the one that was followed.
  void read_files() {
    (void)fields_.has("outputs");
    std::vector<NamedFile> names;
    std::vector<Document> files;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (names_[i].role == "corrected" && !corrected_)
        corrected_ = files_[i];
      else
        names.push_back(names_[i]), files.push_back(files_[i]);
    }
    read_followed(fields_, names, files, followed_, true);
  }

  Result<CutHistory> follow() {
    Result<CutHistory> history = cut_history(*followed_.program, *followed_.pocket, options_,
                                             followed_.earlier, kPiece * options_.tool_diameter);
    // An option out of its range is one of the result, and not of a command line.
    if (!history && history.error().code == ErrorCode::usage)
      return failure(ErrorCode::bad_input, fmt::format("{}: {}", report_.name, history.error().message));
    return history;
  }

  void check_booked(const CutHistory& history) {
    const BookedWork found = booked_work(history, stock_, cutting_, options_.top);
    ReportFields b(fields_.get("booked"), "booked", complaint_);
    if (!complaint_.empty()) return;
    hold_booked(b, found);
    b.refuse_others();
    claims_.notes.push_back(
        fmt::format("the work of the cuts was made anew from {}", followed_.program->name));
    const CheckedRange& work = found.work_j;
    work_ = work, seconds_ = found.seconds;
    const CheckedRange heat = calibrated(found.into_j);
    heat_ = measured_.empty() ? work.middle() * cutting_.share.middle() : heat.middle();
    if (heat_ > 0) parts_ = {heat.least / heat_, heat.greatest / heat_};
    const double summed = measured_.empty() ? kSummed : kMeasured;
    hold("heat_parts", range_of(fields_, "heat_parts"), parts_, kFine + summed * parts_.greatest);
  }

  void read_measured() {
    fields_.each("measured", [&](Json item, const std::string& path) {
      ReportFields f(item, path, complaint_);
      if (!complaint_.empty()) return;
      CheckedMeasurement m{f.number("temperature_c"),
                           f.number("uncertainty_k"),
                           f.numbers<3>("at_mm"),
                           f.number("seconds"),
                           {}};
      f.each("rises_k",
             [&](Json number, const std::string& at) { m.rises.push_back(f.number_of(number, at)); });
      supported_.push_back(range_of(f, "supported_j"));
      f.refuse_others();
      if (!(m.uncertainty > 0)) f.complain(fmt::format("field {} is not above 0", f.name("uncertainty_k")));
      if (m.rises.size() != (film_.least < film_.greatest ? 3U : 1U) ||
          !std::ranges::all_of(m.rises, [](double rise) { return rise > 0; }))
        f.complain(fmt::format("field {} is not a rise above 0 for each case", f.name("rises_k")));
      measured_.push_back(std::move(m));
    });
  }

  void check_measured_places(const CutHistory& history) {
    for (std::size_t i = 0; i < measured_.size(); ++i)
      if (const std::string fault =
              no_place_for(measured_[i], history, stock_, options_.tool_diameter, options_.top);
          !fault.empty())
        find(fmt::format("measured[{}] {}", i, fault));
  }

  /// Measurements leave a part of the heat that the stated shares make, and of the share.
  CheckedRange calibrated(CheckedRange heat) {
    ReportFields f(fields_.get("calibrated"), "calibrated", complaint_);
    if (!complaint_.empty()) return heat;
    for (std::size_t i = 0; i < measured_.size(); ++i) {
      const CheckedRange found = supported_heat(measured_[i], ambient_, work_.middle());
      hold(fmt::format("measured[{}].supported_j", i), supported_[i], found,
           kShown + kMeasured * std::abs(found.greatest));
      heat = {std::max(heat.least, found.least), std::min(heat.greatest, found.greatest)};
    }
    if (!(heat.least <= heat.greatest)) find("measured: no heat supports all that was measured");
    CheckedRange share = cutting_.share;
    if (!measured_.empty())
      share = {std::max(share.least, heat.least / work_.greatest),
               std::min(share.greatest, heat.greatest / work_.least)};
    hold("calibrated.share", range_of(f, "share"), share, kFine + kMeasured * share.greatest);
    hold("calibrated.into_workpiece_j", range_of(f, "into_workpiece_j"), heat,
         kShown + kMeasured * std::abs(heat.greatest));
    f.refuse_others();
    share_ = share;
    return heat;
  }

  void read_walls() {
    fields_.each("walls", [&](Json item, const std::string& path) {
      ReportFields f(item, path, complaint_);
      if (!complaint_.empty()) return;
      const auto at = f.numbers<3>("at_mm");
      const auto outward = f.numbers<2>("outward");
      walls_.push_back({at, outward, f.number("seconds"), f.number("error_um"), range_of(f, "errors_um")});
      f.refuse_others();
    });
    uncut_ = fields_.index("uncut_places");
    require(!walls_.empty(), "field walls is empty");
    for (const HeatWall& w : walls_)
      centre_[0] += w.at[0] / static_cast<double>(walls_.size()),
          centre_[1] += w.at[1] / static_cast<double>(walls_.size());
  }

  void read_cases() {
    fields_.each("cases", [&](Json item, const std::string& path) {
      ReportFields f(item, path, complaint_);
      if (!complaint_.empty()) return;
      HeatCaseRead one;
      one.film = f.number("film_w_m2k");
      f.each("errors_um",
             [&](Json number, const std::string& at) { one.errors.push_back(f.number_of(number, at)); });
      if (one.errors.size() != walls_.size())
        f.complain(fmt::format("field {} has {} numbers, and walls {} places", f.name("errors_um"),
                               one.errors.size(), walls_.size()));
      if (!complaint_.empty()) return;
      one.summary = summary_of(one.errors);
      hold_summary(f, "wall_error_um", one.summary, kWithin);
      read_scaling(f, one);
      one.warmest = f.number("warmest_k"), one.stress = f.number("stress_mpa");
      if (!(one.warmest >= 0 && one.stress >= 0)) find(path + " has a temperature or a stress below 0");
      read_stress_and_waits(f, one);
      one.balance = read_balance(f);
      f.refuse_others();
      cases_.push_back(std::move(one));
    });
    if (!complaint_.empty()) return;
    const std::vector<double> films = film_.least < film_.greatest
                                          ? std::vector{film_.least, film_.middle(), film_.greatest}
                                          : std::vector{film_.middle()};
    require(cases_.size() == films.size(), fmt::format("field cases has not {} items", films.size()));
    if (!complaint_.empty()) return;
    for (std::size_t i = 0; i < films.size(); ++i)
      hold(fmt::format("cases[{}].film_w_m2k", i), cases_[i].film, films[i], kSummed * films[i]);
  }

  /// The largest stress is in the block, while the program runs; what cools down comes to a half before it
  /// comes to a tenth, and without a film to neither.
  void read_stress_and_waits(ReportFields& f, HeatCaseRead& one) {
    const auto at = f.numbers<3>("stress_at_mm");
    const bool inside = at[0] >= stock_.low_x && at[0] <= stock_.high_x && at[1] >= stock_.low_y &&
                        at[1] <= stock_.high_y && at[2] <= options_.top &&
                        at[2] >= options_.top - stock_.thickness;
    if (!inside) find(f.name("stress_at_mm") + " is outside of the stock");
    const double seconds = f.number("stress_seconds");
    if (!(seconds >= 0 && seconds <= seconds_ + kShown))
      find(f.name("stress_seconds") + " is outside of the program");
    one.half = f.number_or_null("half_s");
    one.tenth = f.number_or_null("tenth_s");
    const bool falls =
        (!one.half && !one.tenth) || (one.half && *one.half > 0 && (!one.tenth || *one.tenth > *one.half));
    if (!falls || (one.half && one.film == 0))
      find(f.name("half_s") + " and tenth_s do not go together, or with the film");
  }

  /// The scaling leaves the least squares: no change of it makes their sum smaller.
  void read_scaling(ReportFields& parent, HeatCaseRead& one) {
    ReportFields f(parent.get("uniform_scaling"), parent.name("uniform_scaling"), complaint_);
    if (!complaint_.empty()) return;
    one.factor = f.number("factor"), one.shift = f.numbers<2>("shift_um");
    const auto centre = f.numbers<2>("centre_mm");
    for (const std::size_t axis : {0U, 1U})
      hold(f.name("centre_mm"), centre[axis], centre_[axis], 2 * kShown);
    const std::vector<double> left = left_by(one, 1, one);
    std::array<double, 3> slope{}, scale{};
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const HeatWall& w = walls_[i];
      const std::array<double, 3> way{
          (w.at[0] - centre_[0]) * w.outward[0] + (w.at[1] - centre_[1]) * w.outward[1], w.outward[0],
          w.outward[1]};
      for (std::size_t k = 0; k < 3; ++k) slope[k] += way[k] * left[i], scale[k] += std::abs(way[k]);
    }
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs(slope[k]) <= kWithin * scale[k] + kSummed))
        find(f.name(k == 0 ? "factor" : "shift_um") + " does not leave the least squares of the errors");
    hold_summary(f, "left_um", summary_of(left), kWithin);
    f.refuse_others();
  }

  /// Returns what the scaling of a case leaves of a part of another's errors, um.
  [[nodiscard]] std::vector<double> left_by(const HeatCaseRead& by, double part,
                                            const HeatCaseRead& of) const {
    std::vector<double> left;
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const HeatWall& w = walls_[i];
      double e = part * of.errors[i];
      for (const std::size_t axis : {0U, 1U})
        e += w.outward[axis] * (1000 * (by.factor - 1) * (w.at[axis] - centre_[axis]) + by.shift[axis]);
      left.push_back(e);
    }
    return left;
  }

  /// Heat that was brought in is that of the cuts, and is all somewhere.
  HeatBalance read_balance(ReportFields& parent) {
    ReportFields f(parent.get("heat_balance"), parent.name("heat_balance"), complaint_);
    if (!complaint_.empty()) return {};
    const HeatBalance b{f.number("in_j"),      f.number("stored_j"),     f.number("lost_j"),
                        f.number("removed_j"), f.number("not_placed_j"), f.number("unaccounted_part")};
    f.refuse_others();
    const double within = 8 * kShown + 1e-9 * heat_;
    hold(f.name("in_j"), b.in + b.not_placed, heat_, within);
    const double moved =
        std::max({std::abs(b.in), std::abs(b.stored), std::abs(b.lost), std::abs(b.removed)});
    const double missing = std::abs(b.in - b.stored - b.lost - b.removed);
    if (!(missing <= kBalanced * moved + within))
      find(f.name("in_j") + " is not what is stored, lost and removed");
    hold(f.name("unaccounted_part"), b.unaccounted * moved, missing, within);
    for (const double j : {b.in, b.stored, b.lost, b.removed, b.not_placed})
      if (!(j >= -kBalanced * moved - within)) find(f.name("in_j") + " or another heat is below 0");
    return b;
  }

  /// Every place of a wall that the program cuts is there once, where the wall is, and the tool was beside it
  /// when it is said to have been.
  Result<void> check_places(const CutHistory& history) {
    LEKALO_TRY(const Json root, parse_json(followed_.pocket->bytes, followed_.pocket->name));
    std::string fault;
    refuse_unknown_words(root, fault);
    const Shape pocket = read_shape(root, followed_.pocket->name, fault);
    if (!fault.empty()) return failure(ErrorCode::bad_input, fault);
    WallPlaces places(wall_stations(pocket, spacing_), history, options_.top, stock_.thickness,
                      options_.tool_diameter / 2 + options_.stock_to_leave, spacing_);
    if (places.too_many())
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: the walls of {} have more than {} places {} mm apart (voxel_mm)",
                                 report_.name, followed_.pocket->name, limits::kMostHeatPlaces, spacing_));
    std::vector<std::vector<std::size_t>> walls(places.stations() * places.heights());
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      const HeatWall& w = walls_[i];
      const auto which = places.find(w.at[0], w.at[1], w.at[2]);
      if (!which) {
        find(fmt::format("walls[{}].at_mm is no place of a wall", i));
        continue;
      }
      walls[which->station * places.heights() + which->height].push_back(i);
      for (const std::size_t axis : {0U, 1U})
        hold(fmt::format("walls[{}].outward", i), w.outward[axis],
             places.station(which->station).outward[axis], 1e-9);
    }
    std::size_t uncut = 0;
    for (std::size_t s = 0; s < places.stations(); ++s) {
      if (claims_.findings.size() > kMostFaults) return {};
      places.go_to(s);
      for (std::size_t h = 0; h < places.heights(); ++h) {
        const std::vector<std::size_t>& here = walls[s * places.heights() + h];
        const WallPlaces::Cut cut = places.cut(h);
        uncut += here.empty() ? 1 : 0;
        if (!cut.near_limit && cut.is_cut == here.empty())
          find(fmt::format("walls has {} place at X {:.6f} Y {:.6f}, height {}, which the program {}",
                           here.empty() ? "no" : "a", places.station(s).x, places.station(s).y, h,
                           cut.is_cut ? "cuts" : "does not cut"));
        if (here.size() > 1) find(fmt::format("walls[{}] is there twice", here[1]));
        for (const std::size_t i : here)
          if (!places.visited(h, walls_[i].seconds))
            find(fmt::format("walls[{}].seconds: the tool does not cut the place then", i));
      }
    }
    hold("uncut_places", static_cast<double>(uncut_), static_cast<double>(uncut), 0);
    return {};
  }

  /// A figure of every case at both ends and at the middle of its heat: `of(case, part)`.
  template <class F>
  [[nodiscard]] CheckedRange over(F of) const {
    CheckedRange range{HUGE_VAL, -HUGE_VAL};
    for (const HeatCaseRead& one : cases_)
      for (const double part : {parts_.least, 1.0, parts_.greatest}) {
        const double value = of(one, part);
        range = {std::min(range.least, value), std::max(range.greatest, value)};
      }
    return range;
  }
  template <class F>
  [[nodiscard]] IntervalSummary summaries_over(F of) const {
    return {over([&](const HeatCaseRead& c, double part) { return of(c, part).least; }),
            over([&](const HeatCaseRead& c, double part) { return of(c, part).most; }),
            over([&](const HeatCaseRead& c, double part) { return of(c, part).mean; }),
            over([&](const HeatCaseRead& c, double part) { return of(c, part).largest(); })};
  }

  /// Figures of all cases together follow from them.
  void check_together() {
    const HeatCaseRead& middle = cases_[cases_.size() / 2];
    const double within = kWithin * (1 + parts_.greatest);
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      hold(fmt::format("walls[{}].error_um", i), walls_[i].error, middle.errors[i], 0);
      hold(fmt::format("walls[{}].errors_um", i), walls_[i].errors,
           over([&](const HeatCaseRead& c, double part) { return part * c.errors[i]; }), within);
      if (heat_ == 0 && middle.errors[i] != 0)
        find(fmt::format("walls[{}].error_um is not 0 without heat", i));
    }
    hold_summary(fields_, "wall_error_um", middle.summary, within, true,
                 summaries_over([](const HeatCaseRead& c, double part) {
                   return ErrorSummary{part * c.summary.least, part * c.summary.most, part * c.summary.mean};
                 }));
    ReportFields scaling(fields_.get("uniform_scaling"), "uniform_scaling", complaint_);
    if (!complaint_.empty()) return;
    hold("uniform_scaling.factor", scaling.number("factor"), middle.factor, 0);
    const auto shift = scaling.numbers<2>("shift_um"), centre = scaling.numbers<2>("centre_mm");
    for (const std::size_t axis : {0U, 1U}) {
      hold("uniform_scaling.shift_um", shift[axis], middle.shift[axis], 0);
      hold("uniform_scaling.centre_mm", centre[axis], centre_[axis], 2 * kShown);
    }
    hold("uniform_scaling.factors", range_of(scaling, "factors"),
         over([](const HeatCaseRead& c, double part) { return 1 + part * (c.factor - 1); }),
         kFine * (2 + parts_.greatest));
    hold_summary(scaling, "left_um", summary_of(left_by(middle, 1, middle)), within, true,
                 summaries_over([&](const HeatCaseRead& c, double part) {
                   return summary_of(left_by(middle, part, c));
                 }));
    scaling.refuse_others();
    const HeatBalance balance = read_balance(fields_);
    if (!(balance == middle.balance)) find("heat_balance is not that of the middle case");
    hold_range("warmest_k", middle.warmest,
               over([](const HeatCaseRead& c, double part) { return part * c.warmest; }), within);
    hold_range("stress_mpa", middle.stress,
               over([](const HeatCaseRead& c, double part) { return part * c.stress; }), within);
    check_of_yield(within);
    check_waits();
    check_sensitivity(within);
    hold("limit_c", fields_.number("limit_c"), limit_, kShown);
    if (const double least =
            ambient_ + parts_.least * over([](const HeatCaseRead& c, double) { return c.warmest; }).least;
        least > limit_ + kShown)
      find("warmest_k is beyond limit_c throughout, where the figures of the material do not hold");
  }

  /// The checker rebuilds from its bytes what a corrected program leaves.
  Result<void> check_correction(const CutHistory& history) {
    const bool said = !fields_.get("correction").is_null(),
               summed = !fields_.get("after_correction_um").is_null();
    require(said == corrected_.has_value() && summed == said,
            "field correction, field after_correction_um and the file with the role \"corrected\" are not "
            "all there or all absent");
    LEKALO_CHECK(fine());
    if (!said) return {};
    const HeatCaseRead& middle = cases_[cases_.size() / 2];
    HeatCorrectionJob job{report_, followed_, *corrected_, options_, cutting_, stock_};
    job.spacing = spacing_, job.parts = parts_;
    job.before = middle.summary.largest();
    job.greatest_before =
        over([](const HeatCaseRead& c, double part) { return part * c.summary.largest(); }).greatest;
    job.scaled = summary_of(left_by(middle, 1, middle)).largest();
    job.cases = cases_.size();
    LEKALO_TRY(const std::vector<std::string> findings, correction_faults(job, history, fields_, complaint_));
    claims_.findings.insert(claims_.findings.end(), findings.begin(), findings.end());
    return {};
  }

  void check_of_yield(double within) {
    const CheckedRange stress = over([](const HeatCaseRead& c, double part) { return part * c.stress; });
    hold("stress_of_yield", range_of(fields_, "stress_of_yield"),
         {stress.least / yield_, stress.greatest / yield_}, within / yield_ + kShown);
  }

  void check_waits() {
    ReportFields f(fields_.get("cooling_down"), "cooling_down", complaint_);
    if (!complaint_.empty()) return;
    for (const auto& [key, wait] :
         {std::pair{"half_s", &HeatCaseRead::half}, {"tenth_s", &HeatCaseRead::tenth}}) {
      std::vector<std::optional<double>> said;
      f.each(key,
             [&](Json item, const std::string& path) { said.push_back(f.number_or_null_of(item, path)); });
      bool always = true;
      double least = HUGE_VAL, greatest = 0;
      for (const HeatCaseRead& one : cases_) {
        always = always && one.*wait;
        if (one.*wait) least = std::min(least, *(one.*wait)), greatest = std::max(greatest, *(one.*wait));
      }
      const bool right = said.size() == 2 && said[0].has_value() == std::isfinite(least) &&
                         (!said[0] || *said[0] == least) && said[1].has_value() == always &&
                         (!said[1] || *said[1] == greatest);
      if (!right) find(f.name(key) + " is not that of the cases");
    }
    f.refuse_others();
  }

  /// The largest error, where one figure alone is anywhere in its interval.
  void check_sensitivity(double within) {
    ReportFields f(fields_.get("sensitivity_um"), "sensitivity_um", complaint_);
    if (!complaint_.empty()) return;
    const double largest = cases_[cases_.size() / 2].summary.largest();
    for (const auto& [key, figure] : {std::pair{"share", &share_}, {"force", &work_}}) {
      const double middle = figure->middle();
      // No figure takes the heat beyond what is left of it.
      const CheckedRange parts = middle > 0
                                     ? CheckedRange{std::max(figure->least / middle, parts_.least),
                                                    std::min(figure->greatest / middle, parts_.greatest)}
                                     : CheckedRange{1, 1};
      hold(f.name(key), range_of(f, key), {parts.least * largest, parts.greatest * largest}, within);
    }
    CheckedRange film{HUGE_VAL, 0};
    for (const HeatCaseRead& one : cases_)
      film = {std::min(film.least, one.summary.largest()), std::max(film.greatest, one.summary.largest())};
    hold(f.name("film"), range_of(f, "film"), film, within);
    f.refuse_others();
  }

  void hold_range(const char* key, double middle, const CheckedRange& found, double within) {
    ReportFields f(fields_.get(key), key, complaint_);
    if (!complaint_.empty()) return;
    hold(f.name("middle"), f.number("middle"), middle, 0);
    hold(key, {f.number("least"), f.number("greatest")}, found, within);
    f.refuse_others();
  }

  Result<void> name_unchecked() {
    claims_.unchecked = {
        "cases: by how much walls lie off is computed in voxels and not proved; that all figures made of "
        "it go together is rechecked",
        "heat_balance: how much heat is stored, lost and removed is computed in voxels and not proved; "
        "that it is the heat of the cuts is rechecked",
        "warmest_k, stress_mpa, cooling_down: they are computed in voxels and not proved",
        "material, film_w_m2k, holding, ambient_c: they are what was stated, and nobody measured them"};
    if (!measured_.empty())
      claims_.unchecked.push_back(
          "measured: temperatures, places and times are what was stated; rises_k are computed in voxels and "
          "not proved");
    if (corrected_)
      claims_.unchecked.emplace_back(
          "correction: by how much the workpiece is displaced when the corrected program cuts is computed in "
          "voxels and not proved; what that program cuts, and leaves by these figures, is rebuilt from its "
          "bytes");
    LEKALO_TRY(const std::vector<std::string> unsaid,
               unsaid_modes(*followed_.program, options_, followed_.earlier));
    claims_.unchecked.insert(claims_.unchecked.end(), unsaid.begin(), unsaid.end());
    return {};
  }

  const Document& report_;
  const std::vector<NamedFile>& names_;
  const std::vector<Document>& files_;
  ReportFields fields_;
  SimulateOptions options_;
  CheckedCutting cutting_;
  CheckedStock stock_;
  Json outline_drawing_, outline_scan_;
  double outline_tolerance_ = 0;
  CheckedRange film_, parts_{1, 1};
  CheckedRange work_, share_;
  std::vector<CheckedMeasurement> measured_;
  std::vector<CheckedRange> supported_;  ///< as written
  double ambient_ = 0, spacing_ = 0, limit_ = 0, yield_ = 1, seconds_ = 0;
  double heat_ = 0;  ///< of the workpiece at the middles, J
  FollowedFiles followed_;
  std::vector<HeatWall> walls_;
  std::size_t uncut_ = 0;
  std::array<double, 2> centre_{};
  std::vector<HeatCaseRead> cases_;
  std::optional<Document> corrected_;
};

}  // namespace

Result<ClaimReport> verify_heat_report(const Document& report, const std::vector<Document>& files) {
  LEKALO_TRY(const Json root, parse_json(report.bytes, report.name));
  LEKALO_TRY(const std::vector<NamedFile> names, named_files(report));
  return HeatReport(report, root, names, files).rechecked();
}

}  // namespace lekalo::verify

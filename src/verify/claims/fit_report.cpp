#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "report_fields.hpp"
#include "verify/fit/iso286.hpp"
#include "verify/fit/rings.hpp"
#include "verify/fit/turning_check.hpp"

namespace lekalo::verify {
namespace {

/// Figures stand to 1e-6 of a micrometre, a megapascal or a newton.
constexpr double kShown = 1.1e-6;
/// Elements keep Betti's theorem to this part; the test unit.verify_fit holds it over many fits.
constexpr double kBetti = 1e-3;
/// Differences of displacements where surfaces touch, um: two figures and what the iteration leaves.
constexpr double kTouch = 1e-5;
/// Turned diameters and places stand in whole tenths of a micrometre.
constexpr double kDecimal = 5.2e-5;
/// Peaks give way by 0.4 to 0.8 of both Rz.
constexpr double kLeastSmoothed = 0.4, kMostSmoothed = 0.8;

struct Row {
  double z = 0;
  std::optional<double> bore, shaft, hub_bore, hub;  // um
};

/// Rows from z = 0 on stand for both halves.
double halves(const std::vector<Row>& rows) { return rows[0].z < 0 ? 1 : 2; }

/// The integral of what is there from end to end; the rows are corners and middles of elements in turn.
double integral(const std::vector<Row>& rows, std::optional<double> Row::*figure) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < rows.size(); i += 2)
    if (rows[i].*figure && rows[i + 1].*figure && rows[i + 2].*figure)
      sum += (rows[i + 2].z - rows[i].z) / 6 *
             (*(rows[i].*figure) + 4 * *(rows[i + 1].*figure) + *(rows[i + 2].*figure));
  return halves(rows) * sum;
}

/// The row of z = 0. \pre read_profile() took them
const Row& middle_row(const std::vector<Row>& rows) {
  return *std::find_if(rows.begin(), rows.end(), [](const Row& row) { return row.z == 0; });
}

class FitReport {
 public:
  FitReport(const Document& report, Json root, const std::vector<NamedFile>& names,
            const std::vector<Document>& files)
      : report_(report), names_(names), files_(files), fields_(root, "", complaint_) {}

  Result<ClaimReport> rechecked() {
    check_format(fields_, "lekalo-fit", complaint_);
    for (const char* known : {"inputs", "outputs", "warnings", "seed", "work", "version", "run"})
      (void)fields_.get(known);
    if (fields_.text("status") != "computed") fields_.complain("field status is not \"computed\"");
    read_rings();
    read_words();
    if (!complaint_.empty()) return refused();
    check_fit();
    check_cases();
    if (complaint_.empty()) check_correction();
    fields_.refuse_others();
    if (!complaint_.empty()) return refused();
    claims_.unchecked = {
        "profile: how growths are distributed along the axis is computed by finite elements and not proved; "
        "their means "
        "are rechecked, of parts that do not yield",
        "state: it is computed by finite elements and not proved",
        "stresses: they are computed by finite elements and not proved",
        "middle_pressure_mpa: it is computed by finite elements and not proved",
        "released: it is computed by finite elements and not proved"};
    if (corrected_)
      claims_.unchecked.emplace_back(
          "correction: how the turned surface grows is computed by finite elements and not proved");
    return std::move(claims_);
  }

 private:
  [[nodiscard]] tl::unexpected<Error> refused() const {
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", report_.name, complaint_));
  }
  void find(const std::string& sentence) { claims_.findings.push_back(sentence); }
  void hold(const std::string& what, double written, double found, double within) {
    if (!(std::abs(written - found) <= within))
      find(fmt::format("{} is {} and is to be {:.9g}", what, written, found));
  }

  /// Two numbers, or none where there is null.
  static std::optional<std::array<double, 2>> pair_or_null(ReportFields& fields, std::string_view key) {
    if (fields.get(key).is_null()) return {};
    return fields.numbers<2>(key);
  }

  void read_rings() {
    fields_.each("rings", [&](Json item, const std::string& path) {
      ReportFields f(item, path, complaint_);
      if (!complaint_.empty()) return;
      CheckedRing ring{f.number("inner_diameter_mm"), f.number("outer_diameter_mm"), f.number("length_mm"),
                       f.number("youngs_mpa"),        f.number("poisson"),           f.number("yield_mpa"),
                       f.number("hardening_mpa"),     f.number("expansion_per_k"),   f.number("middle_mm")};
      (void)f.text("material");
      const std::string name = rings_.empty()       ? "the shaft"
                               : rings_.size() == 1 ? "the hub"
                                                    : fmt::format("ring {}", rings_.size());
      if (f.text("name") != name) f.complain(fmt::format("field {} is not \"{}\"", f.name("name"), name));
      f.refuse_others();
      const bool sound = ring.inner >= 0 && ring.outer > ring.inner && ring.length > 0 && ring.youngs > 0 &&
                         ring.poisson >= 0 && ring.poisson < 0.5 && ring.yield > 0 && ring.hardening >= 0 &&
                         ring.expansion >= 0;
      if (!sound || (!rings_.empty() && ring.inner != rings_.back().outer))
        f.complain(fmt::format("{} is no ring of a fit", path));
      rings_.push_back(ring);
    });
    if (rings_.size() < 2) fields_.complain("field rings has fewer than two");
    if (!complaint_.empty()) return;
    for (std::size_t i = 1; i < rings_.size(); ++i)
      if (rings_[i].length > rings_[0].length || rings_[i].length != rings_[1].length ||
          rings_[i].middle != 0)
        fields_.complain(
            "field rings: a ring is longer than the shaft, not as long as the hub, or elsewhere");
    const double over = rings_[1].length / 2 + std::abs(rings_[0].middle) - rings_[0].length / 2;
    if (!(over <= 1e-6)) fields_.complain("field rings: the hub hangs over an end of the shaft");
    if (fields_.number("diameter_mm") != rings_[0].outer)
      fields_.complain("field diameter_mm is not that of the shaft");
  }

  void read_words() {
    if (!complaint_.empty()) return;
    roughness_ = pair_or_null(fields_, "roughness_um");
    friction_ = pair_or_null(fields_, "friction");
    clearance_ = fields_.number_or_null("clearance_um");
  }

  /// The cases that a named fit has, by the table of the checker.
  void check_fit() {
    const Json value = fields_.get("fit");
    if (value.is_null()) return;
    ReportFields f(value, "fit", complaint_);
    const std::string hole = f.text("hole"), shaft = f.text("shaft");
    const auto hole_limits = pair_or_null(f, "hole_limits_um"),
               shaft_limits = pair_or_null(f, "shaft_limits_um");
    f.refuse_others();
    if (!complaint_.empty()) return;
    const std::optional<ClassLimits> h = iso286_limits(rings_[0].outer, hole),
                                     s = iso286_limits(rings_[0].outer, shaft);
    if (!h || !s || hole[0] >= 'a' || shaft[0] < 'a')
      return find(fmt::format("fit: {}/{} has no limits at {} mm", hole, shaft, rings_[0].outer));
    if (!hole_limits || !shaft_limits || *hole_limits != std::array{h->lower, h->upper} ||
        *shaft_limits != std::array{s->lower, s->upper})
      find(fmt::format("fit: the limits of {}/{} at {} mm are {} to {} and {} to {} um", hole, shaft,
                       rings_[0].outer, h->lower, h->upper, s->lower, s->upper));
    shaft_middle_ = (s->lower + s->upper) / 2;
    const double rz = roughness_ ? (*roughness_)[0] + (*roughness_)[1] : 0;
    const double least = s->lower - h->upper - kMostSmoothed * rz,
                 most = s->upper - h->lower - kLeastSmoothed * rz;
    wanted_ = {least, (least + most) / 2, most};
  }

  void check_cases() {
    std::size_t count = 0;
    fields_.each("cases", [&](Json item, const std::string& path) {
      ReportFields f(item, path, complaint_);
      if (!complaint_.empty()) return;
      check_case(f, path, count++);
      f.refuse_others();
    });
    if (!complaint_.empty()) return;
    if (!wanted_.empty() ? count != wanted_.size() : count != 1 && count != 3)
      find(fmt::format("cases has {} items", count));
    if (count == 3 && !(interferences_[0] < interferences_[2]))
      find("cases[0].interference_um is not below that of the last case");
    if (count == 3)
      hold("cases[1].interference_um", interferences_[1], (interferences_[0] + interferences_[2]) / 2,
           2 * kShown);
  }

  void check_case(ReportFields& f, const std::string& path, std::size_t index) {
    const double interference = f.number("interference_um");
    interferences_.push_back(interference);
    if (!(interference > 0)) find(path + ".interference_um is not above 0");
    if (index < wanted_.size()) hold(path + ".interference_um", interference, wanted_[index], kShown);
    const std::vector<double> pressures = read_seats(f, path, interference);
    const std::vector<bool> yields = read_stresses(f, path);
    const std::vector<Row> rows = read_profile(f, path);
    const double touching = f.number("touching_mm"), pressure = f.number("pressure_mpa");
    const double growth = f.number("hub_outer_growth_um");
    const std::optional<double> closure = f.number_or_null("shaft_bore_closure_um");
    (void)f.number("middle_pressure_mpa");
    check_state(f, path, yields);
    check_released(f);
    check_by_formulas(f, path, interference);
    rows_.push_back(rows);
    if (!complaint_.empty()) return;
    hold(path + ".pressure_mpa", pressure, pressures[0], 0);
    const Row& middle = middle_row(rows);
    hold(path + ".hub_outer_growth_um", growth, middle.hub.value_or(0), 0);
    if (closure.has_value() != middle.bore.has_value())
      find(path + ".shaft_bore_closure_um is there where the shaft has no bore, or the other way round");
    else if (closure)
      hold(path + ".shaft_bore_closure_um", *closure, -*middle.bore, 0);
    check_touching(rows, path, interference, touching);
    check_means(rows, path, pressures, yields);
  }

  std::vector<double> read_seats(ReportFields& f, const std::string& path, double interference) {
    std::vector<double> pressures;
    f.each("seats", [&](Json item, const std::string& place) {
      ReportFields seat(item, place, complaint_);
      if (!complaint_.empty()) return;
      const double of = seat.number("interference_um"), force = seat.number("force_n");
      const double pressure = seat.number("pressure_mpa");
      seat.refuse_others();
      const std::size_t i = pressures.size();
      pressures.push_back(pressure);
      if (i + 1 >= rings_.size()) return;
      const double area = std::numbers::pi * rings_[i].outer * rings_[i + 1].length;
      hold(place + ".pressure_mpa", pressure, force / area, kShown * (1 + 1 / area));
      if (i == 0) {
        hold(place + ".interference_um", of, interference, 0);
        force_ = force;
      } else if (!(of > 0)) {
        find(place + ".interference_um is not above 0");
      }
    });
    if (pressures.size() + 1 != rings_.size())
      f.complain(fmt::format("field {}.seats has not one of each seat", path));
    return pressures;
  }

  std::vector<bool> read_stresses(ReportFields& f, const std::string& path) {
    std::vector<bool> yields;
    f.each("stresses", [&](Json item, const std::string& place) {
      ReportFields stress(item, place, complaint_);
      if (!complaint_.empty()) return;
      const Json does = stress.get("yields");
      if (!does.is_bool()) stress.complain(fmt::format("field {}.yields is neither true nor false", place));
      const double part = stress.number("plastic_part"), middle = stress.number("middle_mises_mpa");
      const double largest = stress.number("largest_mises_mpa");
      stress.refuse_others();
      const std::size_t i = yields.size();
      yields.push_back(does.is_true());
      if (i >= rings_.size()) return;
      const double most = rings_[i].yield + kShown;
      if (!(part >= 0 && part <= 1) || (part > 0 && !does.is_true()))
        find(place + ".plastic_part does not go with what yields");
      if (!(middle >= 0 && middle <= largest)) find(place + ".middle_mises_mpa is above the largest");
      if ((!does.is_true() || rings_[i].hardening == 0) && !(largest <= most * (1 + 1e-9)))
        find(place + ".largest_mises_mpa is above the yield stress");
    });
    if (yields.size() != rings_.size())
      f.complain(fmt::format("field {}.stresses has not one of each ring", path));
    return yields;
  }

  void check_state(ReportFields& f, const std::string& path, const std::vector<bool>& yields) {
    const std::string state = f.text("state");
    const bool any = std::find(yields.begin(), yields.end(), true) != yields.end();
    bool hardens = false;
    for (const CheckedRing& ring : rings_) hardens = hardens || ring.hardening > 0;
    if (state != "elastic" && state != "plastic" && state != "full")
      f.complain(fmt::format("field {}.state is not elastic, plastic or full", path));
    else if ((state == "elastic") == any || (state == "full" && !hardens))
      find(fmt::format("{}.state is {}, which does not go with what yields and hardens", path, state));
  }

  void check_released(ReportFields& f) {
    ReportFields released(f.get("released"), f.name("released"), complaint_);
    if (!complaint_.empty()) return;
    for (const char* key : {"hub_bore_growth_um", "hub_outer_growth_um", "shaft_growth_um"})
      (void)released.number(key);
    released.refuse_others();
  }

  /// Formulas give these: DIN 7190, friction, shrinking.
  void check_by_formulas(ReportFields& f, const std::string& path, double interference) {
    const std::optional<CheckedDin> din = checked_din(rings_, interference / 1000);
    const Json written = f.get("din_7190");
    if (!written.is_null() && !written.is_object())
      f.complain(fmt::format("field {}.din_7190 is missing, or neither null nor an object", path));
    if (written.is_object()) {
      ReportFields d(written, path + ".din_7190", complaint_);
      const std::string state = d.text("state");
      const double pressure = d.number("pressure_mpa"), growth = d.number("hub_outer_growth_um");
      d.refuse_others();
      if (!din) return find(path + ".din_7190 is said where its form does not hold");
      if (state != (din->yields ? "plastic" : "elastic")) find(path + ".din_7190.state is another");
      hold(path + ".din_7190.pressure_mpa", pressure, din->pressure, kShown);
      hold(path + ".din_7190.hub_outer_growth_um", growth, 1000 * din->growth, kShown);
    } else if (din) {
      find(path + ".din_7190 is not said where its form holds");
    }
    const auto force = pair_or_null(f, "press_force_n");
    if (force.has_value() != friction_.has_value())
      find(path + ".press_force_n does not go with friction");
    else if (force)
      for (const std::size_t i : {0U, 1U})
        hold(path + ".press_force_n", (*force)[i], (*friction_)[i] * force_, kShown * (1 + (*friction_)[i]));
    const std::optional<double> shrink = f.number_or_null("shrink_difference_k");
    const bool known = clearance_ && rings_[1].expansion > 0;
    if (shrink.has_value() != known)
      find(path + ".shrink_difference_k does not go with the clearance");
    else if (shrink)
      hold(path + ".shrink_difference_k", *shrink,
           (interference + *clearance_) / 1000 / (rings_[1].expansion * rings_[1].inner), 1e-5);
  }

  /// Rows from the middle to the shaft's end; those of the hub end with it.
  std::vector<Row> read_profile(ReportFields& f, const std::string& path) {
    std::vector<Row> rows;
    f.each("profile", [&](Json item, const std::string& place) {
      ReportFields r(item, place, complaint_);
      if (!complaint_.empty()) return;
      Row row{r.number("z_mm"), r.number_or_null("bore_um"), r.number_or_null("shaft_um"),
              r.number_or_null("hub_bore_um"), r.number_or_null("hub_um")};
      r.refuse_others();
      rows.push_back(row);
    });
    if (!complaint_.empty()) return {};
    const auto wrong = [&](const std::string& why) {
      f.complain(fmt::format("field {}.profile {}", path, why));
      return std::vector<Row>();
    };
    if (rows.size() < 3 || rows.size() % 2 == 0) return wrong("has not rows of whole elements");
    const double start = rings_[0].middle == 0 ? 0 : rings_[0].middle - rings_[0].length / 2;
    const double end = rings_[0].middle + rings_[0].length / 2, hub_end = rings_[1].length / 2;
    if (std::abs(rows[0].z - start) > kShown || std::abs(rows.back().z - end) > kShown)
      return wrong("does not go from the middle, or from the left end, to the right end of the shaft");
    if (std::none_of(rows.begin(), rows.end(), [](const Row& row) { return row.z == 0; }))
      return wrong("has no row in the middle of the hub");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Row& row = rows[i];
      if (i > 0 && !(row.z > rows[i - 1].z)) return wrong("is not in order");
      if (i % 2 == 1 && std::abs(row.z - (rows[i - 1].z + rows[i + 1].z) / 2) > 2 * kShown)
        return wrong("has a row that is not in the middle of its neighbours");
      const bool on_hub = std::abs(row.z) <= hub_end + kShown;
      if (!row.shaft || row.hub.has_value() != on_hub || row.hub_bore.has_value() != on_hub ||
          row.bore.has_value() != (rings_[0].inner > 0))
        return wrong("has a row of other surfaces than there are");
    }
    return rows;
  }

  /// Surfaces that touch are apart by the interference; none is nearer.
  void check_touching(const std::vector<Row>& rows, const std::string& path, double interference,
                      double touching) {
    double length = 0;
    const auto gap = [&](const Row& row) { return *row.hub_bore - *row.shaft - interference; };
    for (const Row& row : rows)
      if (row.hub_bore && !(gap(row) >= -kTouch))
        return find(fmt::format("{}.profile: shaft and hub overlap at z = {}", path, row.z));
    const auto touches = [&](const Row& row) { return row.hub_bore && gap(row) <= kTouch; };
    for (std::size_t i = 0; i + 2 < rows.size(); i += 2)
      if (touches(rows[i]) && touches(rows[i + 1]) && touches(rows[i + 2]))
        length += halves(rows) * (rows[i + 2].z - rows[i].z);
    hold(path + ".touching_mm", touching, length, 1e-4);
  }

  /// Betti's theorem with a ring that grows evenly: mean growths are those of mean pressures.
  void check_means(const std::vector<Row>& rows, const std::string& path,
                   const std::vector<double>& pressures, const std::vector<bool>& yields) {
    const auto mean = [&](const char* name, std::optional<double> Row::*figure, std::size_t i,
                          double diameter, double inside, double outside) {
      if (yields[i]) return;
      const double found = integral(rows, figure) / rings_[i].length;
      const double wanted = 1000 * mean_growth(rings_[i], diameter, inside, outside);
      // Each of two pressures counts, also where they nearly cancel.
      const double scale = 1000 * (std::abs(mean_growth(rings_[i], diameter, inside, 0)) +
                                   std::abs(mean_growth(rings_[i], diameter, 0, outside)));
      if (!(std::abs(found - wanted) <= kBetti * scale + kTouch))
        find(fmt::format("{}.profile: the mean of {} is {:.6g} um and its pressures make {:.6g} um", path,
                         name, found, wanted));
    };
    const double of_shaft = pressures[0] * rings_[1].length / rings_[0].length;
    mean("shaft_um", &Row::shaft, 0, rings_[0].outer, 0, of_shaft);
    if (rings_[0].inner > 0) mean("bore_um", &Row::bore, 0, rings_[0].inner, 0, of_shaft);
    mean("hub_bore_um", &Row::hub_bore, 1, rings_[1].inner, pressures[0],
         pressures.size() > 1 ? pressures[1] : 0);
    mean("hub_um", &Row::hub, rings_.size() - 1, rings_.back().outer, pressures.back(), 0);
  }

  /// The turned profile takes off what the surface grows at the mean interference; files say the same.
  void check_correction() {
    const Json value = fields_.get("correction");
    if (value.text.empty()) return fields_.complain("field correction is missing");
    if (value.is_null()) {
      if (!files_.empty()) fields_.complain("field outputs names files of a correction that is not there");
      return;
    }
    corrected_ = true;
    ReportFields f(value, "correction", complaint_);
    const std::string surface = f.text("surface");
    const double nominal = f.number("nominal_mm");
    const std::size_t at = f.index("case");
    if (surface != "outside" && surface != "bore" && surface != "seat")
      f.complain("field correction.surface is not outside, bore or seat");
    if (at != rows_.size() / 2 || (surface == "bore" && rings_[0].inner == 0))
      f.complain("field correction is of another case, or of a bore that is not there");
    if (!complaint_.empty()) return;
    surface_ = surface == "bore"   ? TurnedSurface::bore
               : surface == "seat" ? TurnedSurface::seat
                                   : TurnedSurface::outside;
    hold("correction.nominal_mm", nominal, nominal_of_surface(), 1e-9 * rings_.back().outer);
    const Remains remains = check_remains(f, at);
    const std::vector<TurnedGrowth> turned = read_turned(f);
    const std::optional<TurningClaim> turning = read_turning(f);
    f.refuse_others();
    if (!complaint_.empty()) return;
    check_turned(turned, nominal, at, remains);
    std::vector<ProfilePoint> half;
    for (const TurnedGrowth& t : turned) half.push_back(t.point);
    check_files(half, turning);
  }

  /// Turned points, and what they grow when they are pressed again, um.
  struct TurnedGrowth {
    ProfilePoint point;
    double grows = 0;
  };
  struct Remains {
    double before = 0, after = 0;  // um, at the interference that counts
  };

  /// The growth of the corrected surface in a row, um; of a seat where the hub is.
  [[nodiscard]] std::optional<double> growth_in(const Row& row) const {
    if (surface_ == TurnedSurface::bore) return row.bore;
    if (surface_ == TurnedSurface::outside) return row.hub;
    return row.hub_bore ? row.shaft : std::nullopt;
  }

  /// The diameter of the surface before pressing; of a shaft that of the middle of its limits, or above a
  /// bore of the nominal diameter by the mean interference before smoothing.
  [[nodiscard]] double nominal_of_surface() const {
    if (surface_ == TurnedSurface::bore) return rings_[0].inner;
    if (surface_ == TurnedSurface::outside) return rings_.back().outer;
    if (shaft_middle_) return rings_[0].outer + *shaft_middle_ / 1000;
    const double rz = roughness_ ? (*roughness_)[0] + (*roughness_)[1] : 0;
    const double least = interferences_.front() + kMostSmoothed * rz,
                 most = interferences_.back() + kLeastSmoothed * rz;
    return rings_[0].outer + (least + most) / 2000;
  }

  void check_turned(const std::vector<TurnedGrowth>& turned, double nominal, std::size_t at,
                    const Remains& remains) {
    std::vector<ProfilePoint> wanted;  // with a growth for a diameter
    const auto as_written = [](double z) { return std::round(1e4 * z); };
    for (const Row& row : rows_[at])
      if (growth_in(row) && (wanted.empty() || as_written(row.z) > as_written(wanted.back().z)))
        wanted.push_back({row.z, *growth_in(row) / 1000});
    if (turned.size() != wanted.size()) return find("correction.profile has other places than the surface");
    // A seat's profile keeps the hub's bore a cylinder, which has grown by what it grew in the mean.
    const double bore = integral(rows_[at], &Row::hub_bore) / rings_[1].length - interferences_[at];
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (std::size_t i = 0; i < turned.size(); ++i) {
      const ProfilePoint& p = turned[i].point;
      const double after = 1000 * (p.diameter - nominal) + turned[i].grows;
      least = std::min(least, after), most = std::max(most, after);
      const bool keeps = surface_ == TurnedSurface::seat
                             ? std::abs(after - bore) <= most_left(remains.before)
                             : std::abs(p.diameter - (nominal - wanted[i].diameter)) <= kDecimal;
      if (!(keeps && std::abs(p.z - wanted[i].z) <= kDecimal))
        return find(
            fmt::format("correction.profile at z = {} does not take off what the surface grows", p.z));
    }
    hold("correction.remains.after_um", remains.after, most - least, 1e-5);
  }

  /// A surface that varies by so much, um, is a cylinder.
  static double most_left(double before) { return std::max(1.0, 0.05 * before) + kShown; }

  Remains check_remains(ReportFields& f, std::size_t at) {
    Remains remains;
    std::size_t count = 0;
    f.each("remains", [&](Json item, const std::string& place) {
      ReportFields r(item, place, complaint_);
      if (!complaint_.empty()) return;
      const double interference = r.number("interference_um"), before = r.number("before_um"),
                   after = r.number("after_um");
      r.refuse_others();
      const std::size_t i = count++;
      if (i >= rows_.size()) return;
      hold(place + ".interference_um", interference, interferences_[i], 0);
      double least = HUGE_VAL, most = -HUGE_VAL;
      for (const Row& row : rows_[i])
        if (const auto grows = growth_in(row)) least = std::min(least, *grows), most = std::max(most, *grows);
      hold(place + ".before_um", before, most - least, 4 * kShown);
      if (i == at) remains = {before, after};
      if (i == at && !(after >= 0 && after <= most_left(before))) find(place + ".after_um is no cylinder");
    });
    if (count != rows_.size()) f.complain("field correction.remains has not one of each case");
    return remains;
  }

  std::vector<TurnedGrowth> read_turned(ReportFields& f) {
    std::vector<TurnedGrowth> half;
    f.each("profile", [&](Json item, const std::string& place) {
      ReportFields p(item, place, complaint_);
      if (!complaint_.empty()) return;
      half.push_back({{p.number("z_mm"), p.number("diameter_mm")}, p.number("pressed_um")});
      p.refuse_others();
    });
    return half;
  }

  std::optional<TurningClaim> read_turning(ReportFields& f) {
    const Json value = f.get("turning");
    if (value.is_null()) return {};
    ReportFields t(value, "correction.turning", complaint_);
    const std::string control = t.text("control"), x = t.text("x");
    const CheckedRing& part = surface_ == TurnedSurface::outside ? rings_.back() : rings_[0];
    TurningClaim claim{control == "fanuc",          x == "radius",           surface_,
                       t.number("feed_mm_per_min"), t.number("spindle_rpm"), part.middle + part.length / 2};
    t.refuse_others();
    if ((control != "fanuc" && control != "linuxcnc") || (x != "radius" && x != "diameter"))
      t.complain("field correction.turning is of no such control, or X");
    return claim;
  }

  void check_files(const std::vector<ProfilePoint>& half, const std::optional<TurningClaim>& turning) {
    std::vector<ProfilePoint> whole(half.rbegin(), half.rend());
    if (rings_[0].middle == 0)
      for (const ProfilePoint& p : half)
        if (p.z > 0) whole.push_back({-p.z, p.diameter});
    bool program = false;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const std::string& role = names_[i].role;
      std::optional<std::string> fault;
      if (role == "profile") {
        fault = fault_of_profile_table(files_[i].bytes, whole);
      } else if (role == "drawing") {
        fault = fault_of_profile_drawing(files_[i].bytes, whole);
      } else if (role == "program" && turning) {
        program = true;
        fault = fault_of_turning(files_[i].bytes, whole, *turning);
      } else {
        fault = "no such file is one of a correction";
      }
      if (fault) find(fmt::format("the {} {} is not the turned profile: {}", role, files_[i].name, *fault));
    }
    if (turning.has_value() != program) find("correction.turning is said without a program");
  }

  const Document& report_;
  const std::vector<NamedFile>& names_;
  const std::vector<Document>& files_;
  std::string complaint_;
  ReportFields fields_;
  ClaimReport claims_;
  std::vector<CheckedRing> rings_;
  std::optional<std::array<double, 2>> roughness_, friction_;
  std::optional<double> clearance_;
  std::vector<double> wanted_;          // interferences of a named fit, um
  std::vector<std::vector<Row>> rows_;  // of each case
  std::vector<double> interferences_;
  bool corrected_ = false;
  TurnedSurface surface_ = TurnedSurface::outside;  // that is corrected
  std::optional<double> shaft_middle_;              // of a named fit: the middle of the shaft's limits, um
  double force_ = 0;                                // of the first seat in the case at hand
};

}  // namespace

Result<ClaimReport> verify_fit_report(const Document& report, const std::vector<Document>& files) {
  LEKALO_TRY(const Json root, parse_json(report.bytes, report.name));
  LEKALO_TRY(const std::vector<NamedFile> names, named_files(report));
  if (names.size() != files.size())
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: names {} files, not {}", report.name, names.size(), files.size()));
  return FitReport(report, root, names, files).rechecked();
}

}  // namespace lekalo::verify

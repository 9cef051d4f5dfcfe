#include "solid_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "certificate.hpp"
#include "rims.hpp"
#include "scan_widths.hpp"
#include "self_crossing.hpp"
#include "solid_document.hpp"
#include "solid_features.hpp"
#include "solid_near.hpp"
#include "solid_window.hpp"
#include "touch_widths.hpp"
#include "triangle_distance.hpp"
#include "verify/number/both.hpp"
#include "verify/pocket/program_check.hpp"

namespace lekalo::verify {
namespace {

/// A depth may be told larger than it is by this part of it, or of what is allowed.
constexpr double kDeepSlack = 1.0 / 32;
/// How even allowances are may be told otherwise than it is by this part of the largest: less than any
/// statement about them means, and more than roundings make.
constexpr double kDeviationSlack = 0x1p-20;

/// Points of contact are printed for people: they may be off by this share of the blank's size.
constexpr double kReadingTolerance = 1e-6;

/// Says whether a number that was computed in doubles may be meant for another one.
bool is_near(const Decimal& written, const Fraction& real, const Fraction& size) {
  return abs(to_fraction(written) - real) <= size / 1'000'000'000'000'000;
}

double size_of(const SolidMesh& mesh) {
  std::array<double, 3> low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
  for (const auto& p : mesh.near)
    for (std::size_t axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], p[axis]), high[axis] = std::max(high[axis], p[axis]);
  return std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
}

/// Says whether a point may be no further than `slack` from a triangle by its number in the file.
bool is_near_triangle(const std::array<Decimal, 3>& point, const SolidMesh& mesh, std::size_t number,
                      double slack) {
  const auto triangle = mesh.triangle_of_file(number);
  if (!triangle) return false;
  const Vec3 p{enclosed(point[0]), enclosed(point[1]), enclosed(point[2])};
  Triangle3 at{};
  for (std::size_t corner = 0; corner < 3; ++corner)
    for (std::size_t axis = 0; axis < 3; ++axis)
      at[corner][axis] = mesh.enclosed(mesh.triangles[*triangle][corner], axis);
  return distance({p, p, p}, at).low <= slack;
}

class SolidCheck {
 public:
  SolidCheck(const LocateInputs& inputs, SolidDocument document) : inputs_(inputs), d_(std::move(document)) {}

  Result<LocateReport> run() {
    LEKALO_TRY(const std::optional<SolidMesh> part, read_input("part", inputs_.part, d_.part));
    LEKALO_TRY(std::optional<SolidMesh> blank, read_input("blank", inputs_.blank, d_.blank));
    LEKALO_TRY(const Json certificate, certificate_of());
    const bool has_certificate = certificate.is_object();
    if (blank) {
      LEKALO_TRY(const bool has_widths, check_scan(*blank));
      LEKALO_CHECK(check_points(*blank));
      if (!has_widths) blank.reset();
    }
    if (part && blank) {
      LEKALO_TRY(const SolidPair pair, SolidPair::make(*part, *blank, d_.pose));
      if (!d_.demands)
        check_clearance(pair);
      else if (demands_)
        LEKALO_CHECK(check_margin(pair, *part, *blank));
      if (demands_) check_datums(*blank), check_nears(*part, *blank);
      if (demands_.has_value() == d_.demands.has_value()) check_largest(*part, *blank);
      check_contacts(pair, *part, *blank);
      if (has_certificate && bound() && demands_.has_value() == d_.demands.has_value())
        LEKALO_CHECK(check_certificate(certificate, *part, *blank));
    }
    check_pose();
    check_derived();
    for (const std::string& fault : faults_of_choice(d_)) find("{}", fault);
    check_status(has_certificate);
    check_nc();
    if (!d_.inside) note("the part does not lie in the blank at the placement, so there is no clearance");
    report_.verdict = !report_.findings.empty() ? Verdict::refuted
                      : open_                   ? Verdict::incomplete
                      : !has_certificate        ? Verdict::unproved
                                                : Verdict::confirmed;
    return std::move(report_);
  }

 private:
  template <class... Args>
  void find(fmt::format_string<Args...> format, Args&&... args) {
    report_.findings.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  void note(std::string sentence) { report_.notes.push_back(std::move(sentence)); }

  /// The bound that the certificate proves, or nothing.
  [[nodiscard]] const std::optional<Decimal>& bound() const {
    return d_.demands ? d_.demands->bound : d_.upper_bound;
  }

  Result<std::optional<SolidMesh>> read_input(const char* role, const Document& document,
                                              const WrittenSolid& written);
  Result<void> check_crossings(const SolidMesh& mesh, const std::string& name);
  [[nodiscard]] Result<Json> certificate_of() const;
  Result<std::optional<ScanWidths>> widths_by_touches(const SolidMesh& blank);
  Result<bool> check_scan(SolidMesh& blank);
  Result<void> check_points(const SolidMesh& blank);
  Result<void> read_demands(const SolidReading& part);
  void tell_clearance(Span of_triangles);
  void check_clearance(const SolidPair& pair);
  Result<void> check_margin(const SolidPair& pair, const SolidMesh& part, const SolidMesh& blank);
  void check_datums(const SolidMesh& blank);
  void check_nears(const SolidMesh& part, const SolidMesh& blank);
  void check_largest(const SolidMesh& part, const SolidMesh& blank);
  void check_farthest(const PlacedSolid& part, const std::vector<std::uint32_t>& triangles,
                      const PlacedSolid& blank, const Decimal& largest, double slack, double within,
                      const std::string& what);
  [[nodiscard]] bool keeps_datums() const;
  [[nodiscard]] bool keeps_maximum(std::size_t feature) const;
  [[nodiscard]] bool keeps_maxima() const;
  [[nodiscard]] std::optional<SolidDemand> demand_of(std::size_t feature) const;
  /// The triangles of the part that are of a feature, in their order.
  [[nodiscard]] std::vector<std::uint32_t> triangles_of(const SolidMesh& part, std::size_t feature) const;
  [[nodiscard]] Rims rims_of(const SolidMesh& part) const;
  [[nodiscard]] PartBounds bounds_of(const SolidMesh& part, const Rims& rims) const;
  void check_contacts(const SolidPair& pair, const SolidMesh& part, const SolidMesh& blank);
  Result<void> check_certificate(Json certificate, const SolidMesh& part, const SolidMesh& blank);
  void check_pose();
  void check_derived();
  void check_derived_of_demands();
  void check_status(bool has_certificate);
  void check_nc();

  const LocateInputs& inputs_;
  SolidDocument d_;
  std::optional<SolidDemands> demands_;
  bool open_ = false;
  /// The bodies that the meshes stand for may differ from them by so much together, mm.
  Decimal deviation_;
  LocateReport report_;
};

/// Returns nothing where the file is in a form that is not read here.
Result<std::optional<SolidMesh>> SolidCheck::read_input(const char* role, const Document& document,
                                                        const WrittenSolid& written) {
  LEKALO_TRY(SolidReading reading, read_solid(document, written.unit));
  if (reading.open) {
    open_ = true;
    note(fmt::format("what is said of the {} was not rechecked: {} is not read here, because {}", role,
                     document.name, *reading.open));
    return std::nullopt;
  }
  if (reading.mesh.triangles.size() != written.triangles)
    find("the {} is said to have {} triangles, but {} has {}", role, written.triangles, document.name,
         reading.mesh.triangles.size());
  if (reading.unit != written.unit)
    find("the {} is said to be in another unit than {} says", role, document.name);
  const auto& [is, said] = std::tie(reading.deviation, written.deviation);
  if (is.has_value() != said.has_value() || (is && compare(*is, *said) != 0))
    find("the {} is said to deviate {} from the body that it stands for, but {} says {}", role,
         said ? fmt::format("by {} mm", approximate(*said)) : "by nothing", document.name,
         is ? fmt::format("{} mm", approximate(*is)) : "nothing");
  if (is) {
    note(fmt::format(
        "{} says that its triangles are within {} mm of the STEP model that lekalo-step made them of; "
        "that was proved there, and is not rechecked",
        document.name, approximate(*is)));
    deviation_ = deviation_ - (Decimal{} - *is);
  }
  if (d_.demands && &written == &d_.part) LEKALO_CHECK(read_demands(reading));
  LEKALO_TRY(SolidMesh made, closed(std::move(reading.mesh), document.name));
  // All that a scan or touches prove rests on the odd count alone, and so on no side of the blank's sheets.
  if (&written == &d_.part || !d_.scan) LEKALO_CHECK(check_crossings(made, document.name));
  return made;
}

/// Refuses a mesh that goes through itself so that inside changes sides: then nothing says where the material
/// is.
Result<void> SolidCheck::check_crossings(const SolidMesh& mesh, const std::string& name) {
  const SelfCrossings found = self_crossings(PlacedSolid(mesh));
  const auto where = [&](const SelfCrossing& crossing) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g}), on triangle {}", crossing.place[0], crossing.place[1],
                       crossing.place[2], mesh.numbers[crossing.triangle] + 1);
  };
  if (found.changing)
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: the surface crosses itself at {}, where inside changes from one side of it "
                    "to the other, so that nothing says where the material is",
                    name, where(*found.changing)));
  if (found.first)
    note(fmt::format(
        "{}: the surface crosses itself at {}; what lies between was not found to be {:g} mm thick "
        "anywhere, and what is inside was told by an odd count",
        name, where(*found.first), found.depth));
  if (!found.complete)
    note(fmt::format(
        "{}: that the surface does not cross itself was not rechecked to the end, for too many of "
        "its triangles lie on each other",
        name));
  return {};
}

/// Rebuilds the demands from the file of features, and holds what the result says of them against it.
Result<void> SolidCheck::read_demands(const SolidReading& part) {
  if (!inputs_.features) {
    open_ = true;
    note(
        "the file of features is not there, so what the triangles demand, and the margin, were not "
        "rechecked");
    return {};
  }
  LEKALO_TRY(demands_, read_solid_features(*inputs_.features, part, d_.part.unit));
  SolidDemands& is = *demands_;
  if (is.minimum) is.minimum = std::max(*is.minimum, approximate(d_.min_allowance));
  const WrittenSolidDemands& said = *d_.demands;
  const auto same = [](const std::optional<Decimal>& written, std::optional<double> value) {
    return written.has_value() == value.has_value() && (!value || approximate(*written) == *value);
  };
  const auto told = [](std::optional<double> minimum) {
    return minimum ? fmt::format("{}", *minimum) : "nothing";
  };
  if (!same(said.minimum, is.minimum))
    find("demands.minimum is {}, but {} demands {}",
         told(said.minimum ? std::optional(approximate(*said.minimum)) : std::nullopt),
         inputs_.features->name, told(is.minimum));
  if (said.datums.size() != is.datums.size()) {
    find("demands.datums has {} datums, but {} has {}", said.datums.size(), inputs_.features->name,
         is.datums.size());
    demands_.reset();
    return {};
  }
  for (std::size_t k = 0; k < is.datums.size(); ++k)
    if (said.datums[k].name != is.datums[k].name || approximate(said.datums[k].within) != is.datums[k].within)
      find("demands.datums[{}] is not what {} says: \"{}\" within {} mm", k, inputs_.features->name,
           is.datums[k].name, is.datums[k].within);
  if (said.features.size() != is.features.size()) {
    find("demands.features has {} features, but {} has {}", said.features.size(), inputs_.features->name,
         is.features.size());
    demands_.reset();
    return {};
  }
  for (std::size_t k = 0; k < is.features.size(); ++k) {
    const SolidFeature& feature = is.features[k];
    const WrittenSolidDemands::Feature& one = said.features[k];
    std::optional<double> minimum, scale;
    if (feature.demand) minimum = feature.demand->minimum, scale = feature.demand->scale;
    for (const bool finished : {false, true}) {
      const auto& told_within = finished ? one.finished : one.maximum;
      const std::optional<double> within = feature.finished == finished ? feature.within : std::nullopt;
      if (!same(told_within, within))
        find("demands.features[{}] {} {}, but {} says {}", k, finished ? "is finished to" : "has the maximum",
             told(told_within ? std::optional(approximate(*told_within)) : std::nullopt),
             inputs_.features->name, told(within));
    }
    if (!same(one.target, feature.target))
      find("demands.features[{}] has the target {}, but {} says {}", k,
           told(one.target ? std::optional(approximate(*one.target)) : std::nullopt), inputs_.features->name,
           told(feature.target));
    if (!same(one.rim, feature.rim > 0 ? std::optional(feature.rim) : std::nullopt))
      find("demands.features[{}] has the rim {}, but {} says {}", k,
           told(one.rim ? std::optional(approximate(*one.rim)) : std::nullopt), inputs_.features->name,
           feature.rim);
    if (one.name != feature.name || one.triangles != feature.triangles || !same(one.minimum, minimum) ||
        !same(one.scale, scale) || one.as_cast != feature.as_cast())
      find("demands.features[{}] is not what {} says: \"{}\" has {} triangles{}", k, inputs_.features->name,
           feature.name, feature.triangles,
           feature.demand     ? fmt::format(", minimum {} and scale {}", *minimum, *scale)
           : feature.finished ? " that are finished"
                              : " as cast");
  }
  return {};
}

/// Says whether the result states that all datums are kept.
bool SolidCheck::keeps_datums() const {
  for (std::size_t k = 0; k < demands_->datums.size(); ++k)
    if (to_fraction(d_.demands->datums[k].off) > Fraction(demands_->datums[k].within)) return false;
  return true;
}

/// Says the same of the maximum of a feature, or of its distance if it is finished; and of all of them.
bool SolidCheck::keeps_maximum(std::size_t feature) const {
  const auto& within = demands_->features[feature].within;
  const auto& largest = d_.demands->features[feature].largest;
  return !within || !largest || to_fraction(*largest) <= Fraction(*within);
}
bool SolidCheck::keeps_maxima() const {
  for (std::size_t k = 0; k < demands_->features.size(); ++k)
    if (!keeps_maximum(k)) return false;
  return true;
}

std::vector<std::uint32_t> SolidCheck::triangles_of(const SolidMesh& part, std::size_t feature) const {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t)
    if (demands_->feature_of[part.numbers[t]] == feature + 1) triangles.push_back(t);
  return triangles;
}

void SolidCheck::check_farthest(const PlacedSolid& part, const std::vector<std::uint32_t>& triangles,
                                const PlacedSolid& blank, const Decimal& largest, double slack, double within,
                                const std::string& what) {
  bool is_open = false;
  if (const auto fault = fault_of_farthest(part, triangles, blank, enclosed(largest), slack, within, is_open))
    find("{} {}", what, *fault);
  if (!is_open) return;
  open_ = true;
  note(fmt::format("{} was not rechecked to the end, for the meshes are too fine", what));
}

/// Holds how far the points of features with a maximum, or that are finished, are said to be from the blank's
/// surface against them.
void SolidCheck::check_nears(const SolidMesh& part, const SolidMesh& blank) {
  const PlacedSolid placed(part, SolidMotion(d_.pose)), around(blank);
  for (std::size_t k = 0; k < demands_->features.size(); ++k) {
    const SolidFeature& feature = demands_->features[k];
    const auto& largest = d_.demands->features[k].largest;
    if (!feature.within || !largest) continue;
    const std::vector<std::uint32_t> triangles = triangles_of(part, k);
    if (triangles.empty()) continue;
    // A maximum far below all distances is not worth a search to its last digits.
    const double slack = kDeepSlack * std::max(*feature.within, 0x1p-10 * approximate(*largest));
    check_farthest(placed, triangles, around, *largest, slack, slack / 16,
                   fmt::format("feature \"{}\": its {}", feature.name,
                               feature.finished ? "distance from the blank's surface" : "largest allowance"));
  }
  for (std::size_t k = 0; k < demands_->features.size(); ++k)
    if (d_.inside && !keeps_maximum(k))
      find("inside is true, but a {}", demands_->features[k].finished
                                           ? "finished face is too far from the blank's surface"
                                           : "maximum is not kept");
}

/// Holds the largest allowance of all that has a demand, and how even allowances are, against its points.
void SolidCheck::check_largest(const SolidMesh& part, const SolidMesh& blank) {
  if (!d_.choice || !d_.choice->largest) return;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t)
    if (!demands_ || demand_of(demands_->feature_of[part.numbers[t]])) triangles.push_back(t);
  if (triangles.empty()) return;
  const PlacedSolid placed(part, SolidMotion(d_.pose)), around(blank);
  // Few faces of a part lie nearly as deep as allowed, and many nearly as deep as the deepest.
  const double slack = kDeepSlack * approximate(*d_.choice->largest);
  check_farthest(placed, triangles, around, *d_.choice->largest, slack, slack / 2, "choice.largest");
  if (!d_.choice->deviation) return;
  std::vector<std::optional<double>> targets;
  for (const std::uint32_t t : triangles) {
    const std::uint32_t feature = demands_ ? demands_->feature_of[part.numbers[t]] : 0;
    targets.push_back(feature > 0 ? demands_->features[feature - 1].target : std::nullopt);
  }
  const Span is = deviation_of(placed, triangles, targets, around), said = enclosed(*d_.choice->deviation);
  const double off = kDeviationSlack * std::max(approximate(*d_.choice->largest), is.high);
  if (said.high < is.low - off || said.low > is.high + off)
    find("choice.deviation is said to be {}, but it is {}", approximate(*d_.choice->deviation),
         0.5 * (is.low + is.high));
}

/// Holds how far the part is said to be off its datums against its points.
void SolidCheck::check_datums(const SolidMesh& blank) {
  const SolidMotion motion(d_.pose);
  const double slack = kReadingTolerance * std::max(1.0, size_of(blank));
  for (std::size_t k = 0; k < demands_->datums.size(); ++k) {
    const SolidDatum& datum = demands_->datums[k];
    const Fraction off = to_fraction(d_.demands->datums[k].off);
    const Span said = enclosed(off);
    double most = 0;
    bool is_farther = sgn(off) < 0;
    for (const Both3& point : datum.points) {
      const Span far = length(straight_off(datum, motion(as<Span>(point)) - as<Span>(datum.through)));
      most = std::max(most, far.high);
      if (far.high <= said.low) continue;
      const Exact3 way = straight_off(datum, motion(as<Fraction>(point)) - as<Fraction>(datum.through));
      is_farther = is_farther || dot(way, way) > off * off;
    }
    if (is_farther || said.low > step_up(most + slack))
      find("datum \"{}\": the part is said to be off it by up to {} mm, but it is by {}", datum.name,
           approximate(d_.demands->datums[k].off), most);
  }
  for (const WrittenSolidDemands::Datum& one : d_.demands->datums) {
    const Fraction off = to_fraction(one.off), within = to_fraction(one.within);
    if (one.missed.has_value() != (off > within))
      find("datum \"{}\": it is off by {} mm of {}, so that missed has to be {}", one.name,
           approximate(one.off), approximate(one.within), off > within ? "there" : "left out");
    else if (one.missed && !is_near(*one.missed, off - within, abs(off) + within))
      find("datum \"{}\": missed is not off less within", one.name);
  }
  if (d_.inside && !keeps_datums()) find("inside is true, but a datum is not kept");
}

/// The demand of triangles of a feature, counted from 1, or of none; nothing of what is as cast.
std::optional<SolidDemand> SolidCheck::demand_of(std::size_t feature) const {
  if (feature > 0) return demands_->features[feature - 1].demand;
  return demands_->minimum ? std::optional(SolidDemand{.minimum = *demands_->minimum}) : std::nullopt;
}

/// Returns null where there is none.
Result<Json> SolidCheck::certificate_of() const {
  if (!d_.boxes_in_file || !inputs_.certificate) return d_.certificate;
  return read_solid_certificate_document(*inputs_.certificate);
}

/// Holds a blank that was touched against its files; returns nothing where that cannot be done, or fails.
Result<std::optional<ScanWidths>> SolidCheck::widths_by_touches(const SolidMesh& blank) {
  if (!inputs_.points || !d_.points || !inputs_.nominal || !d_.nominal) {
    find("the blank was touched, but the result names no touches or no nominal mesh, or was checked without");
    return std::nullopt;
  }
  LEKALO_TRY(const SolidReading touches, read_measured_points(*inputs_.points, d_.points->unit));
  LEKALO_TRY(SolidReading nominal, read_solid(*inputs_.nominal, d_.nominal->unit));
  for (const auto& [reading, file] :
       {std::pair<const SolidReading*, const Document*>{&touches, &*inputs_.points},
        {&nominal, &*inputs_.nominal}}) {
    if (!reading->open) continue;
    open_ = true;
    note(
        fmt::format("the blank, and what is said of the part in it, were not rechecked: {} is not read here, "
                    "because {}",
                    file->name, *reading->open));
    return std::nullopt;
  }
  if (nominal.mesh.triangles.size() != d_.nominal->triangles)
    find("the nominal mesh is said to have {} triangles, but {} has {}", d_.nominal->triangles,
         inputs_.nominal->name, nominal.mesh.triangles.size());
  LEKALO_TRY(const SolidMesh mesh, closed(std::move(nominal.mesh), inputs_.nominal->name));
  return touch_widths(mesh, blank, touches, *d_.scan, report_.findings);
}

/// Gives the blank its widths, and holds what the result says of them against them. False where the blank is
/// not known.
Result<bool> SolidCheck::check_scan(SolidMesh& blank) {
  if (d_.nominal && !(d_.scan && d_.scan->touches))
    find("inputs name a nominal mesh, but scan has no touches");
  const auto is_off = [](const Decimal& written, Span is) {
    const double slack = kReadingTolerance * std::max(1.0, is.high), value = approximate(written);
    return !(value >= is.low - slack && value <= is.high + slack);
  };
  if (!d_.scan) {
    if (sgn(d_.unknown_area.digits) != 0)
      find("unknown_area_mm2 is {}, but all of a closed mesh is known", approximate(d_.unknown_area));
    return true;
  }
  ScanWidths widths;
  if (d_.scan->touches) {
    LEKALO_TRY(std::optional<ScanWidths> by_touches, widths_by_touches(blank));
    if (!by_touches) return false;
    widths = *std::move(by_touches);
  } else {
    widths = scan_widths(blank, *d_.scan);
  }
  if (is_off(d_.unknown_area, widths.unknown_area))
    find("unknown_area_mm2 is {}, but {} mm2 are unknown", approximate(d_.unknown_area),
         widths.unknown_area.high);
  if (is_off(d_.scan->widest, widths.widest))
    find("scan.widest is {}, but the widest triangle has {} mm", approximate(d_.scan->widest),
         widths.widest.high);
  if (d_.scan->unknown_triangles != widths.unknown)
    find("scan.unknown_triangles is {}, but there are {}", d_.scan->unknown_triangles, widths.unknown);
  if (d_.scan->proved != (widths.unknown == 0))
    find("scan.proved is {}, but {} triangles are unknown", d_.scan->proved, widths.unknown);
  if (widths.unknown > 0) {
    open_ = true;
    note(fmt::format(
        "{} triangles of the scan are unknown, {:.6g} mm2, so that nothing of the blank is proved",
        widths.unknown, widths.unknown_area.high));
  }
  blank.widths = std::move(widths.of);
  return true;
}

/// Holds the blank against the points that it was made from.
Result<void> SolidCheck::check_points(const SolidMesh& blank) {
  if (d_.points.has_value() != inputs_.points.has_value()) {
    find("the result {} points that its blank was made from",
         d_.points ? "was checked without the" : "names no");
    return {};
  }
  if (!d_.points) {
    if (d_.scan && !d_.scan->left_out.empty())
      find("scan.left_out names points, but there is no file of points");
    return {};
  }
  if (!d_.scan) {
    find("the blank was made from points, but scan is null");
    return {};
  }
  if (d_.scan->max_dip)
    find("the blank was made from points, but scan.max_dip is said of measured triangles");
  LEKALO_TRY(const SolidReading reading, read_measured_points(*inputs_.points, d_.points->unit));
  if (reading.open) {
    open_ = true;
    note(fmt::format(
        "that the blank was made from measured points was not rechecked: {} is not read here, because {}",
        inputs_.points->name, *reading.open));
    return {};
  }
  if (reading.unit != d_.points->unit)
    find("the points are said to be in another unit than {} says", inputs_.points->name);
  const auto& points = reading.mesh.near;
  if (points.size() != d_.points->count)
    find("{} points are said to be measured, but {} has {}", d_.points->count, inputs_.points->name,
         points.size());
  if (d_.scan->touches) return {};
  for (const std::string& fault : faults_of_points(points, blank, *d_.scan)) find("{}", fault);
  return {};
}

/// The clearance of the bodies may differ from that of the triangles by how far they deviate.
void SolidCheck::tell_clearance(Span of_triangles) {
  const Span off = enclosed(deviation_);
  const Span least = sgn(deviation_.digits) == 0
                         ? of_triangles
                         : outwards(of_triangles.low - off.high, of_triangles.high + off.high);
  report_.clearance_low = fmt::format("{}", least.low);
  report_.clearance_high = fmt::format("{}", least.high);
}

/// A part that touches the blank's surface is not inside.
void SolidCheck::check_clearance(const SolidPair& pair) {
  const bool is_number = d_.clearance && sgn(d_.clearance->digits) > 0;
  const Decimal of_triangles = (is_number ? *d_.clearance : Decimal{}) - (Decimal{} - deviation_);
  const SolidAnswer answer = pair.check(of_triangles);
  if (!d_.inside) {
    if (!answer.fault && !answer.open) find("inside is false, but the part lies in the blank");
    return;
  }
  tell_clearance(answer.least);
  if (answer.fault) find("{}", *answer.fault);
  if (answer.open) find("inside is true, but the part touches the blank's surface");
}

/// The triangles of each demand are looked at for themselves.
Result<void> SolidCheck::check_margin(const SolidPair& pair, const SolidMesh& part, const SolidMesh& blank) {
  std::vector<std::vector<std::uint32_t>> of_feature(demands_->features.size() + 1);
  for (std::uint32_t t = 0; t < part.triangles.size(); ++t)
    of_feature[demands_->feature_of[part.numbers[t]]].push_back(t);
  const Fraction clearance = d_.clearance ? to_fraction(*d_.clearance) : Fraction(0),
                 deviation = to_fraction(deviation_);
  const Rims rims = rims_of(part);
  std::optional<std::string> fault = pair.swallowed();
  Span least{kInfinity, kInfinity};
  bool any = false;
  for (std::size_t k = 0; k < of_feature.size(); ++k) {
    const auto demand = demand_of(k);
    if (!demand) continue;
    Both needed{std::max(clearance, Fraction(0))};
    if (d_.demands->margin) {
      const Fraction margin = to_fraction(*d_.demands->margin);
      needed.exact =
          std::max(needed.exact, Fraction(Fraction(demand->minimum) + Fraction(demand->scale) * margin));
    }
    // It is demanded of the bodies, and looked for at the triangles.
    needed.exact += deviation;
    needed.near = enclosed(needed.exact);
    std::vector<std::uint32_t> whole, in_rims;
    for (const std::uint32_t t : of_feature[k]) (rims.spare(t) ? whole : in_rims).push_back(t);
    for (const bool cut : {false, true}) {
      const SolidMesh surface = cut ? rims.rest(in_rims) : part_of(part, whole);
      if (surface.triangles.empty()) continue;
      any = true;
      if (cut) {
        needed.exact += Fraction(rims.off());
        needed.near = enclosed(needed.exact);
      }
      LEKALO_TRY(const SolidPair of_surface, SolidPair::make(surface, blank, d_.pose));
      const SolidAnswer answer = of_surface.check_surface(needed);
      least = {std::min(least.low, answer.least.low), std::min(least.high, answer.least.high)};
      if (fault) continue;
      const std::string whose = k == 0 ? "" : fmt::format("feature \"{}\": ", demands_->features[k - 1].name);
      if (answer.fault)
        fault = whose + *answer.fault;
      else if (answer.open)
        fault = whose + "it touches the blank's surface";
    }
  }
  if (!any) find("all of the part is as cast or finished, so that there is no margin");
  if (!d_.inside) {
    if (!fault && keeps_datums() && keeps_maxima())
      find("inside is false, but all of the part that demands something lies in the blank");
    return {};
  }
  tell_clearance(least);
  if (fault) find("{}", *fault);
  return {};
}

Rims SolidCheck::rims_of(const SolidMesh& part) const {
  Rims made(part);
  for (std::size_t k = 0; k < demands_->features.size(); ++k) {
    if (!(demands_->features[k].rim > 0)) continue;
    const std::vector<std::uint32_t> triangles = triangles_of(part, k);
    if (!triangles.empty()) made.add(triangles, demands_->features[k].rim);
  }
  return made;
}

PartBounds SolidCheck::bounds_of(const SolidMesh& part, const Rims& rims) const {
  PartBounds made;
  if (rims.any()) made.rims = &rims;
  const Fraction bound = to_fraction(*d_.demands->bound);
  for (std::size_t k = 0; k <= demands_->features.size(); ++k) {
    const SolidDemand demand = demand_of(k).value_or(SolidDemand{});
    // If the bodies have more than that, the triangles do but for what they deviate.
    Both one{Fraction(demand.minimum) + Fraction(demand.scale) * bound - to_fraction(deviation_)};
    one.near = enclosed(one.exact);
    made.bounds.push_back(std::move(one));
  }
  bool as_cast = false;
  for (const std::uint32_t number : part.numbers) {
    const std::uint32_t feature = demands_->feature_of[number];
    made.of.push_back(demand_of(feature) ? feature : PartBounds::kAsCast);
    as_cast = as_cast || made.of.back() == PartBounds::kAsCast;
    if (as_cast) continue;
    if (!made.least || made.bounds[feature].exact < made.bounds[*made.least].exact) made.least = feature;
  }
  if (as_cast) made.least.reset();
  for (const std::uint32_t number : part.numbers) {
    const std::uint32_t feature = demands_->feature_of[number];
    made.within.push_back(feature == 0 ? kInfinity
                                       : demands_->features[feature - 1].within.value_or(kInfinity));
  }
  return made;
}

void SolidCheck::check_contacts(const SolidPair& pair, const SolidMesh& part, const SolidMesh& blank) {
  const double slack = kReadingTolerance * std::max(1.0, size_of(blank));
  for (std::size_t k = 0; k < d_.contacts.size(); ++k) {
    const WrittenSolidContact& contact = d_.contacts[k];
    for (const auto& [role, mesh, number, point] :
         {std::tuple("part", &part, contact.part_triangle, &contact.points.part_point),
          std::tuple("blank", &blank, contact.blank_triangle, &contact.points.blank_point)})
      if (!is_near_triangle(*point, *mesh, number, slack))
        find("contact {}: {}_point is not on triangle {} of the {}", k, role, number, role);
    const auto triangle = blank.triangle_of_file(contact.blank_triangle);
    const Span width = triangle ? blank.width(*triangle) : Span{};
    if (const auto bound = pair.bound_of(contact.points, slack, width); !bound)
      find("contact {}: {}", k, bound.error().message);
  }
}

Result<void> SolidCheck::check_certificate(Json certificate, const SolidMesh& part, const SolidMesh& blank) {
  PartBounds bounds;
  std::optional<Rims> rims;
  if (demands_) bounds = bounds_of(part, rims.emplace(rims_of(part)));
  // It is about the triangles; with demands their bounds are.
  const Decimal of_meshes = demands_ ? *bound() : *bound() - deviation_;
  const std::vector<SolidDatum> none;
  SolidCertificate proof(part, blank, d_.window, of_meshes, demands_ ? &bounds : nullptr,
                         demands_ ? demands_->datums : none, report_.findings);
  LEKALO_CHECK(proof.check(certificate, d_.boxes_in_file ? inputs_.certificate->name : inputs_.result.name));
  report_.intervals = proof.leaves();
  report_.bound_high = fmt::format("{}", enclosed(*bound()).high);
  if (d_.boxes_in_file && *d_.boxes_in_file != proof.leaves())
    find("certificate_file.boxes is {}, but the certificate has {} leaves", *d_.boxes_in_file,
         proof.leaves());
  return {};
}

void SolidCheck::check_pose() {
  if (const auto how = off_window(d_.window, d_.pose)) find("the placement is not in the window: {}", *how);
}

/// Nothing of these is rounded to the other side by more than a last digit.
void SolidCheck::check_derived_of_demands() {
  const WrittenSolidDemands& said = *d_.demands;
  if (d_.upper_bound || d_.gap) find("there is an upper_bound or a gap, but demands have a margin_bound");
  if (said.margin.has_value() != d_.inside)
    find("inside is {}, but {} margin", d_.inside, said.margin ? "there is a" : "there is no");
  if (said.gap.has_value() != (said.margin && said.bound))
    find("{}",
         said.gap ? "there is a margin_gap, but not both a margin and a margin_bound" : "margin_gap is null");
  if (!said.margin) return;
  const Fraction margin = to_fraction(*said.margin);
  if (said.bound) {
    const Fraction bound = to_fraction(*said.bound);
    if (bound < margin)
      find("margin_bound {} is below margin {}", approximate(*said.bound), approximate(*said.margin));
    if (said.gap && !is_near(*said.gap, bound - margin, abs(bound) + abs(margin)))
      find("margin_gap is not margin_bound less margin");
  }
  if (d_.shortfall && to_fraction(*d_.shortfall) != std::max(Fraction(0), Fraction(-margin)))
    find("shortfall is not what is missing of a margin of 0");
}

void SolidCheck::check_derived() {
  if (d_.inside != d_.clearance.has_value())
    find("inside is {}, but {} clearance", d_.inside, d_.clearance ? "there is a" : "there is no");
  if (d_.clearance && sgn(d_.clearance->digits) < 0)
    find("clearance {} is below 0, which no part in its blank has", approximate(*d_.clearance));
  if (d_.demands) check_derived_of_demands();
  if (d_.gap.has_value() != (d_.clearance && d_.upper_bound))
    find("{}", d_.gap ? "there is a gap, but not both a clearance and an upper_bound" : "gap is null");
  if (d_.shortfall.has_value() != d_.clearance.has_value())
    find("{}", d_.shortfall ? "there is a shortfall, but no clearance" : "shortfall is null");
  if (!d_.clearance) return;
  const Fraction clearance = to_fraction(*d_.clearance), demand = to_fraction(d_.min_allowance);
  if (d_.upper_bound) {
    const Fraction bound = to_fraction(*d_.upper_bound);
    if (bound < clearance)
      find("upper_bound {} is below clearance {}", approximate(*d_.upper_bound), approximate(*d_.clearance));
    if (d_.gap && !is_near(*d_.gap, bound - clearance, abs(bound) + clearance))
      find("gap is not upper_bound less clearance");
  }
  if (d_.demands) return;
  const Fraction missing = demand - clearance;
  if (d_.shortfall && (sgn(missing) <= 0 ? sgn(d_.shortfall->digits) != 0
                                         : !is_near(*d_.shortfall, missing, abs(demand) + clearance)))
    find("shortfall is not min_allowance less clearance");
}

void SolidCheck::check_status(bool has_certificate) {
  const char* const name = d_.demands ? "margin_bound" : "upper_bound";
  if (has_certificate && !bound()) find("there is a certificate, but no {} that it is to prove", name);
  if (!has_certificate && bound())
    note(
        fmt::format("there is no certificate, so that {} {} was not rechecked", name, approximate(*bound())));
  if (d_.status == "stopped") return;
  if (d_.status == "unproved") {
    if (has_certificate) find("status is unproved, but there is a certificate");
    return;
  }
  if (!bound()) return find("status is {}, but there is no {}", d_.status, name);
  const Decimal demand = d_.demands ? Decimal{} : d_.min_allowance;
  const bool out_of_reach = compare(*bound(), demand) < 0;
  if (out_of_reach != (d_.status == "infeasible"))
    find("status is {}, but {} {} is {} {}", d_.status, name, approximate(*bound()),
         out_of_reach ? "below" : "not below",
         d_.demands ? "0" : fmt::format("min_allowance {}", approximate(demand)));
  if (d_.status == "optimal" && !d_.inside) find("status is optimal, but the part is not in the blank");
}

/// Holds the program that was written against the original.
void SolidCheck::check_nc() {
  if (!d_.nc) return;
  if (!d_.clearance) return find("a program was written, but the part is not in the blank");
  const auto& [w, x, y, z] = d_.pose.quaternion;
  if (sgn(x.digits) != 0 || sgn(y.digits) != 0)
    return find("a program was written, but the part lies tilted, which three axes cannot follow");
  if (to_fraction(d_.nc->clearance) > to_fraction(*d_.clearance) - to_fraction(d_.nc->rounding_mm) ||
      sgn(d_.nc->rounding_mm.digits) < 0)
    find("the program's clearance {} is above clearance less its rounding", approximate(d_.nc->clearance));
  const auto& at = d_.pose.shift;
  const ProgramPose pose{at[0], at[1], {}, ProgramClaim::Solid{at[2], {w, z}}};
  open_ = !check_program(inputs_, *d_.nc, pose, report_) || open_;
}

}  // namespace

Result<LocateReport> check_solids(const LocateInputs& inputs, Json written) {
  LEKALO_TRY(SolidDocument document, read_solid_document(written, inputs.result.name));
  return SolidCheck(inputs, std::move(document)).run();
}

}  // namespace lekalo::verify

#include "angle_check.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "allowance.hpp"
#include "certificate.hpp"
#include "comparison_check.hpp"
#include "document.hpp"
#include "edge_lines.hpp"
#include "outline.hpp"
#include "verify/number/exact.hpp"
#include "verify/number/interval.hpp"
#include "verify/read/contour.hpp"

namespace lekalo::verify {
namespace {

/// The field theta_deg is there for people to read, so this relative tolerance suffices for it.
constexpr double kDegreesTolerance = 1e-14;
/// A contact may be farther than the closest pair by 10^-this of the blank's size and a roundoff.
constexpr unsigned long kContactPlaces = 6;
/// A dropped point may miss the line of its neighbours, and a trimmed contour may miss being convex, by
/// 10^-this of the largest coordinate.
constexpr unsigned long kRoundoffPlaces = 12;
/// All coordinates together may take this many digits once they have one exponent: 100 million, about 40 MB.
constexpr double kMostDigits = 1e8;

Interval rough(const Integer& value) { return {value, kRough}; }
Interval rough_length(const Point& p) { return square_root(rough(dot(p, p))); }

/// Returns an interval around value / 10^places.
Interval share(const Integer& value, unsigned long places) {
  return rough(value) / rough(power_of_ten(places));
}

/// Returns half the perimeter of the box around the points.
Integer size_of(const Ring& points) {
  const auto [left, right] = std::ranges::minmax_element(points, {}, &Point::x);
  const auto [bottom, top] = std::ranges::minmax_element(points, {}, &Point::y);
  return right->x - left->x + top->y - bottom->y;
}

/// Step 1 of docs/design/verify.md: makes all lengths of one verification integers of the unit 10^exponent
/// mm.
class Units {
 public:
  void add(const Decimal& value) {
    if (value.digits == 0) return;
    exponent_ = std::min(exponent_, value.exponent);
    ++count_;
    magnitude_ = std::max(magnitude_, digits_of(value.digits) + value.exponent);
  }
  void add(const Contour& contour) {
    for (const Decimal& value : contour.x) add(value);
    for (const Decimal& value : contour.y) add(value);
  }
  void add(const WrittenPlacement& p) {
    for (const Decimal* value : {&p.x, &p.y, &p.clearance}) add(*value);
  }
  [[nodiscard]] double digits() const {
    return static_cast<double>(count_) * static_cast<double>(magnitude_ - exponent_);
  }

  [[nodiscard]] Integer of(const Decimal& value) const { return in_units(value, exponent_); }
  [[nodiscard]] Ring of(const Contour& contour) const {
    Ring ring;
    for (std::size_t i = 0; i < contour.size(); ++i) ring.push_back({of(contour.x[i]), of(contour.y[i])});
    return ring;
  }
  [[nodiscard]] Interval millimetres(const Interval& units) const {
    return units / Interval(power_of_ten(static_cast<unsigned long>(-exponent_)), units.precision());
  }

 private:
  /// The exponent is never above 0.
  long exponent_ = 0, magnitude_ = 1;
  std::size_t count_ = 0;
};

/// The outlines in exact numbers. Results are held against the trimmed blank where there is one.
struct Scene {
  Units units;
  Outline part, file_blank;
  std::optional<Outline> trimmed;
  [[nodiscard]] const Outline& blank() const { return trimmed ? *trimmed : file_blank; }
};

class AngleCheck {
 public:
  AngleCheck(const LocateInputs& inputs, const ResultDocument& result) : inputs_(inputs), result_(result) {}

  Result<LocateReport> run() {
    LEKALO_CHECK(read_files());
    precision_ = working_precision(scene_.blank(), scene_.part);
    check_dropped("part", scene_.part, result_.part.dropped);
    check_dropped("blank", scene_.file_blank, result_.blank.dropped);
    check_trim();
    check_placements();
    check_derived();
    check_comparison();
    if (!check_deviations(result_, inputs_.deviations, part_points_, blank_points_, report_.findings,
                          report_.notes))
      all_rechecked_ = false;
    if (inputs_.features)
      find("there is a file of features, but a result for convex outlines has no demands");
    EdgeLines edges(scene_.blank(), result_.trim ? std::vector<std::size_t>() : result_.blank.dropped,
                    precision_);
    check_contacts(edges);
    LEKALO_TRY(const bool proved, check_certificate(edges));
    check_status(proved);
    report_.verdict = !report_.findings.empty() ? Verdict::refuted
                      : !proved                 ? Verdict::unproved
                      : all_rechecked_          ? Verdict::confirmed
                                                : Verdict::incomplete;
    return std::move(report_);
  }

 private:
  template <class... Args>
  void find(fmt::format_string<Args...> format, Args&&... args) {
    report_.findings.push_back(fmt::format(format, std::forward<Args>(args)...));
  }
  [[nodiscard]] std::string text(const Interval& units) const {
    return fmt::format("{}", scene_.units.millimetres(units).low_double());
  }
  [[nodiscard]] Pose pose_of(const WrittenPlacement& p) const {
    return {{scene_.units.of(p.x), scene_.units.of(p.y)}, p.theta};
  }

  Result<Contour> read_input(const Document& document, const WrittenInput& written, const char* role);
  Result<void> read_files();
  void check_dropped(const char* role, const Outline& outline, const std::vector<std::size_t>& dropped);
  void check_trim();
  void check_placements();
  Interval check_clearance(const std::string& what, const WrittenPlacement& placement);
  void check_angle(const std::string& what, const WrittenPlacement& placement);
  void check_difference(const char* field, const Decimal& written, const Decimal& a, const Decimal& b);
  void check_derived();
  void check_comparison();
  void check_contacts(EdgeLines& edges);
  /// Returns whether there was a certificate to look at.
  Result<bool> check_certificate(EdgeLines& edges);
  void check_bound(const CertificateCheck& check);
  void check_status(bool proved);

  const LocateInputs& inputs_;
  const ResultDocument& result_;
  LocateReport report_;
  Scene scene_;
  Precision precision_ = 256;
  Interval best_allowance_{256};
  /// The points of the two files, mm, in the doubles nearest to them.
  RoundedPoints part_points_, blank_points_;
  /// The pose of the earlier result in the new blank, with the clearance that is claimed for it there.
  std::optional<WrittenPlacement> last_;
  bool all_rechecked_ = true;
};

Result<Contour> AngleCheck::read_input(const Document& document, const WrittenInput& written,
                                       const char* role) {
  auto contour = read_contour(document);
  if (!contour) return contour;
  if (contour->unit && *contour->unit != written.unit) {
    find("the {} file says its unit is {}, the result says {}", role,
         *contour->unit == LengthUnit::inch ? "inch" : "mm",
         written.unit == LengthUnit::inch ? "inch" : "mm");
  }
  if (contour->size() != written.points) {
    find("the {} file has {} points, the result says {}", role, contour->size(), written.points);
  }
  to_millimetres(*contour, contour->unit.value_or(written.unit));
  return contour;
}

Result<void> AngleCheck::read_files() {
  LEKALO_TRY(const Contour part, read_input(inputs_.part, result_.part, "part"));
  LEKALO_TRY(const Contour blank, read_input(inputs_.blank, result_.blank, "blank"));

  for (const auto& [contour, points] : {std::pair{&part, &part_points_}, {&blank, &blank_points_}})
    for (std::size_t k = 0; k < contour->size(); ++k)
      points->emplace_back(approximate(contour->x[k]), approximate(contour->y[k]));
  Units& units = scene_.units;
  units.add(part);
  units.add(blank);
  if (result_.trim) units.add(result_.trim->contour);
  units.add(result_.best);
  if (result_.upper_bound) units.add(*result_.upper_bound);
  for (const WrittenPlacement& alternative : result_.alternatives) units.add(alternative);
  // The pose of the earlier result is looked at in the same units.
  if (result_.comparison && inputs_.earlier) {
    last_ = verify::check_comparison(result_, *inputs_.earlier, part_points_, report_.findings);
    if (last_) {
      last_->clearance = result_.comparison->last_pose_clearance;
      units.add(*last_);
    }
  }
  if (units.digits() > kMostDigits) {
    return failure(
        ErrorCode::bad_input,
        fmt::format("{}: the numbers of the result and its contours differ so much in magnitude that they "
                    "take {:.0f} digits together, more than {:.0f}",
                    inputs_.result.name, units.digits(), kMostDigits));
  }
  const auto outline = [&units](const Contour& contour, const std::string& name,
                                Outline& to) -> Result<void> {
    LEKALO_TRY(to, make_outline(units.of(contour), name));
    return {};
  };
  LEKALO_CHECK(outline(part, inputs_.part.name, scene_.part));
  LEKALO_CHECK(outline(blank, inputs_.blank.name, scene_.file_blank));
  if (!result_.trim) return {};
  return outline(result_.trim->contour, inputs_.result.name + ": field trim.contour",
                 scene_.trimmed.emplace());
}

/// Step 8: every dropped point must lie on the straight line between its kept neighbours, and no kept point
/// may repeat the one before.
void AngleCheck::check_dropped(const char* role, const Outline& outline,
                               const std::vector<std::size_t>& dropped) {
  const std::size_t n = outline.points.size();
  std::vector<bool> is_dropped(n, false);
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (dropped[i] >= n || (i > 0 && dropped[i] <= dropped[i - 1])) {
      return find("the dropped points of the {} are not ascending indices below {}", role, n);
    }
    is_dropped[dropped[i]] = true;
  }
  if (dropped.size() + 3 > n)
    return find("the result drops {} of the {} points of the {}", dropped.size(), n, role);
  const Interval tolerance = share(largest_coordinate(outline.points), kRoundoffPlaces);
  const auto first =
      static_cast<std::size_t>(std::find(is_dropped.begin(), is_dropped.end(), false) - is_dropped.begin());
  std::size_t from = first;
  do {
    std::size_t to = (from + 1) % n;
    while (is_dropped[to]) to = (to + 1) % n;
    const Point edge = outline.points[to] - outline.points[from];
    const bool apart = !(edge == Point{0, 0});
    if (!apart) find("points {} and {} of the {} are equal, but neither is dropped", from, to, role);
    for (std::size_t i = (from + 1) % n; i != to; i = (i + 1) % n) {
      if (!apart) continue;
      const Point w = outline.points[i] - outline.points[from];
      const Integer aside = abs(cross(edge, w)), behind = -dot(edge, w), beyond = dot(edge, w - edge);
      const Interval off = rough(std::max({aside, behind, beyond})) / rough_length(edge);
      if (certainly_above(off, tolerance)) {
        find("dropped point {} of the {} lies {} mm off the straight line between its neighbours", i, role,
             text(off));
      }
    }
    from = to;
  } while (from != first);
}

/// Step 7.
void AngleCheck::check_trim() {
  if (!scene_.trimmed) return;
  const Outline& trimmed = *scene_.trimmed;
  const Interval tolerance = share(largest_coordinate(trimmed.points), kRoundoffPlaces);
  for (std::size_t j = 0; j < trimmed.hull.size(); ++j) {
    const Interval dent = rough(trimmed.dents[j]) / rough_length(trimmed.side(j));
    if (certainly_above(dent, tolerance)) {
      find("the trimmed contour is not convex: it is dented by {} mm after its point {}", text(dent),
           trimmed.hull[j]);
    }
  }
  std::size_t culprit = 0;
  if (!lies_inside(trimmed, scene_.file_blank, culprit)) {
    find("the trimmed contour reaches outside the blank, across its edge {}", culprit);
  }
  if (compare(result_.trim->loss, result_.trim->tolerance) > 0) {
    find("the trimmed contour's loss {} is above its tolerance {}", approximate(result_.trim->loss),
         approximate(result_.trim->tolerance));
  }
}

/// Steps 2 and 3: the written clearance must not be above the exact one.
Interval AngleCheck::check_clearance(const std::string& what, const WrittenPlacement& placement) {
  const Pose pose = pose_of(placement);
  const Integer written = scene_.units.of(placement.clearance);
  // However far the part is shifted, no digit of its points is lost.
  const Precision wide = precision_ + static_cast<Precision>(bits_of(pose.shift.x) + bits_of(pose.shift.y));
  const Interval exact = allowance(scene_.blank(), scene_.part, pose, wide);
  const Interval clearance(written, wide);
  if (!certainly_not_above(clearance, exact)) {
    find("{} {} mm is {} {} mm, the exact minimum allowance at its pose", what, text(clearance),
         certainly_above(clearance, exact) ? "above" : "not provably at most", text(exact));
  }
  if (scene_.trimmed) {
    const Interval in_file = allowance(scene_.file_blank, scene_.part, pose, wide);
    if (certainly_above(clearance, in_file)) {
      find("{} {} mm is above {} mm, the exact minimum allowance in the untrimmed blank", what,
           text(clearance), text(in_file));
    }
  }
  return exact;
}

/// Step 8: theta_deg must say the same as theta, and theta must lie in the window.
void AngleCheck::check_angle(const std::string& what, const WrittenPlacement& placement) {
  const Precision wide = 256 + angle_bits(placement.theta) + angle_bits(placement.theta_deg);
  const Interval degrees =
      Interval(placement.theta, wide) * Interval(Integer(180), wide) / Interval::pi(wide);
  const double error = (degrees - Interval(placement.theta_deg, wide)).high_double();
  const double exact = degrees.high_double();
  if (!(std::abs(error) <= kDegreesTolerance * std::abs(exact))) {
    find("{}theta_deg is {}, but theta means {} degrees", what, approximate(placement.theta_deg), exact);
  }
  if (result_.window.full_circle()) return;
  const double from = approximate(result_.window.from_deg), to = approximate(result_.window.to_deg);
  const double slack = 4 * kDerivedTolerance * std::max({std::abs(from), std::abs(to), 1.0});
  if (!(exact >= from - slack && exact <= to + slack)) {
    find("{}theta is {} degrees, outside the window from {} to {}", what, exact, from, to);
  }
}

void AngleCheck::check_placements() {
  best_allowance_ = check_clearance("clearance", result_.best);
  check_angle("", result_.best);
  report_.clearance_low = scene_.units.millimetres(best_allowance_).low_text();
  report_.clearance_high = scene_.units.millimetres(best_allowance_).high_text();
  for (std::size_t i = 0; i < result_.alternatives.size(); ++i) {
    const std::string what = fmt::format("alternative {}: ", i);
    check_clearance(what + "clearance", result_.alternatives[i]);
    check_angle(what, result_.alternatives[i]);
  }
}

/// Step 8: a written difference must be a - b but for roundings.
void AngleCheck::check_difference(const char* field, const Decimal& written, const Decimal& a,
                                  const Decimal& b) {
  const double difference = approximate(a - b);
  const double slack = kDerivedTolerance * std::max(std::abs(approximate(a)), std::abs(approximate(b)));
  if (!(std::abs(approximate(written - (a - b))) <= slack)) {
    find("{} is written as {}, but the numbers it comes from give {}", field, approximate(written),
         difference);
  }
}

/// Step 8: gap, shortfall and the clearance of the program must follow from the numbers they come from.
void AngleCheck::check_derived() {
  const ResultDocument& r = result_;
  if (r.gap.has_value() != r.upper_bound.has_value()) {
    find("only one of upper_bound and gap is given");
  } else if (r.gap) {
    if (compare(*r.upper_bound, r.best.clearance) < 0)
      find("upper_bound {} is below clearance {}", approximate(*r.upper_bound),
           approximate(r.best.clearance));
    check_difference("gap", *r.gap, *r.upper_bound, r.best.clearance);
  }
  if (compare(r.best.clearance, r.min_allowance) >= 0) {
    if (r.shortfall.digits != 0) find("shortfall is {}, but min_allowance is met", approximate(r.shortfall));
  } else {
    check_difference("shortfall", r.shortfall, r.min_allowance, r.best.clearance);
  }
  if (!r.nc) return;
  const Decimal most = r.best.clearance - r.nc->rounding_mm;
  const double slack = kDerivedTolerance * std::abs(approximate(r.best.clearance));
  if (!(approximate(r.nc->clearance - most) <= slack) || sgn(r.nc->rounding_mm.digits) < 0)
    find("nc.clearance is {}, but the clearance less the rounding of the program is {}",
         approximate(r.nc->clearance), approximate(most));
  if (!check_program(inputs_, *r.nc, {r.best.x, r.best.y, r.best.theta}, report_)) all_rechecked_ = false;
}

/// Holds the earlier pose's clearance in the new blank against the outlines. The rest of the comparison was
/// looked at when the files were read.
void AngleCheck::check_comparison() {
  if (!result_.comparison) return;
  if (!inputs_.earlier) return find("there is a comparison, but the result names no earlier one");
  if (last_) check_clearance("comparison.last_pose_clearance", *last_);
}

/// Step 8: the contacts may be no further than the closest pair by more than a tolerance, and at an optimum
/// their multipliers balance.
void AngleCheck::check_contacts(EdgeLines& edges) {
  const Pose pose = pose_of(result_.best);
  const Ring& corners = scene_.blank().points;
  const Interval slack =
      share(size_of(corners), kContactPlaces) + share(largest_coordinate(corners), kRoundoffPlaces);
  double right = 0, up = 0, whole = 0;
  bool pushes = true;
  for (std::size_t i = 0; i < result_.contacts.size(); ++i) {
    const WrittenContact& contact = result_.contacts[i];
    std::string why;
    const EdgeLine* edge = edges.find(contact.blank_edge, why);
    if (contact.part_vertex >= scene_.part.points.size()) {
      why = fmt::format("part vertex {} does not exist, the part has {} points", contact.part_vertex,
                        scene_.part.points.size());
    }
    if (!why.empty()) {
      find("contact {}: {}", i, why);
      continue;
    }
    const Interval distance = line_distance(scene_.part.points[contact.part_vertex], edge->start,
                                            edge->direction, pose, precision_);
    const Interval farther = distance - best_allowance_;
    if (certainly_above(farther, slack)) {
      find("contact {}: part vertex {} is {} mm farther from blank edge {} than the closest pair", i,
           contact.part_vertex, text(farther), contact.blank_edge);
    }
    const double share = contact.multiplier / edge->length.high_double();
    right = right + share * rough(edge->direction.x).high_double();
    up = up + share * rough(edge->direction.y).high_double();
    whole = whole + contact.multiplier;
    pushes = pushes && contact.multiplier >= 0;
  }
  // Along edges instead of normals the sums are turned by a right angle, all alike.
  const bool balance =
      pushes && std::max({std::abs(right), std::abs(up), std::abs(whole - 1)}) <= kMultiplierTolerance;
  if (result_.status == "optimal" && !result_.contacts.empty() && report_.findings.empty() && !balance)
    find("the multipliers of the contacts do not balance, so these do not hold the part");
}

/// Steps 5 and 6.
Result<bool> AngleCheck::check_certificate(EdgeLines& edges) {
  std::optional<Json> intervals = result_.certificate;
  const Document* source = &inputs_.result;
  if (result_.certificate_file_intervals && inputs_.certificate) {
    source = &*inputs_.certificate;
    LEKALO_TRY(intervals, read_certificate_document(*source));
  }
  if (!intervals) return false;
  CertificateCheck check(scene_.part, edges, precision_, report_.findings);
  JsonItems items(*intervals);
  while (const auto item = items.next()) {
    LEKALO_TRY(const WrittenInterval interval, read_interval(*item, check.intervals(), source->name));
    check.add(interval);
  }
  check.finish(result_.window);
  report_.intervals = check.intervals();
  if (result_.certificate_file_intervals.value_or(check.intervals()) != check.intervals()) {
    find("the certificate file has {} intervals, the result says {}", check.intervals(),
         *result_.certificate_file_intervals);
  }
  check_bound(check);
  return true;
}

void AngleCheck::check_bound(const CertificateCheck& check) {
  if (!check.bound()) return;
  report_.bound_high = scene_.units.millimetres(*check.bound()).high_text();
  if (!result_.upper_bound) return find("there is a certificate, but upper_bound is null");
  const Interval written(scene_.units.of(*result_.upper_bound), precision_);
  if (!certainly_not_above(*check.bound(), written)) {
    find("upper_bound {} mm is below {} mm, the bound over certificate interval {}", text(written),
         text(*check.bound()), check.worst());
  }
}

void AngleCheck::check_status(bool proved) {
  const ResultDocument& r = result_;
  if (r.status == "unproved") {
    if (proved) find("status is unproved, but there is a certificate");
    return;
  }
  if (r.status == "stopped") return;
  if (!r.upper_bound) return find("status is {}, but there is no upper_bound", r.status);
  const bool out_of_reach = compare(*r.upper_bound, r.min_allowance) < 0;
  if (out_of_reach != (r.status == "infeasible")) {
    find("status is {}, but upper_bound {} is {} min_allowance {}", r.status, approximate(*r.upper_bound),
         out_of_reach ? "below" : "not below", approximate(r.min_allowance));
  }
}

}  // namespace

Result<LocateReport> check_angles(const LocateInputs& inputs, Json written) {
  LEKALO_TRY(const ResultDocument result, read_result_document(written, inputs.result.name));
  return AngleCheck(inputs, result).run();
}

}  // namespace lekalo::verify

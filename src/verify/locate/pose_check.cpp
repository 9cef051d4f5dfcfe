#include "pose_check.hpp"

#include <array>
#include <optional>

#include "cover_tree.hpp"
#include "demand_check.hpp"
#include "feature_check.hpp"
#include "pose_document.hpp"
#include "verify/number/interval.hpp"
#include "verify/read/known_fields.hpp"
#include "verify/shape/region_clearance.hpp"
#include "verify/shape/same_outline.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify {
namespace {

/// Derived fields and points that are printed for people may be off by this, in mm and relatively.
constexpr double kReadingTolerance = 1e-6;
/// An angle of the pose may be off the window by this, relatively: degrees and radians are rounded.
constexpr double kAngleTolerance = 4e-15;

/// Says whether a point may lie on the written edge of that number, or on what joins it to its circle.
bool lies_on(const Vec& p, std::size_t edge, const Shape& shape, double slack) {
  std::size_t count = 0;
  for (std::size_t k = 0; k < shape.sides.size(); ++k) {
    const bool reaches_edge = count == edge;
    if (shape.sides[k].written) ++count;
    if ((count == edge + 1 || reaches_edge) && distance(p, shape.sides[k]).low <= slack) return true;
  }
  return false;
}

class PoseCheck {
 public:
  PoseCheck(const LocateInputs& inputs, Json result) : inputs_(inputs), root_(result) {}

  Result<LocateReport> run() {
    refuse_unknown_fields(root_, complaint_);
    r_ = read_region_document(root_, complaint_);
    if (!complaint_.empty()) return bad(inputs_.result.name);
    check_shape("part", r_.part);
    check_shape("blank", r_.blank);
    place();
    const IgnoredRegions ignored = r_.part_cut ? read_ignored(inputs_.features) : IgnoredRegions{};
    const Origin part = check_input("part", {inputs_.part, r_.part, r_.part_tolerance.high, Json{"null"},
                                             r_.part_drawing, ignored.regions, ignored.unit});
    check_input("blank", {inputs_.blank, r_.blank, r_.blank_tolerance.high, r_.scan, r_.blank_drawing});
    check_clearance();
    check_contacts();
    check_derived();
    check_pose();
    const bool features_whole = check_features(
        inputs_.features,
        {r_.demands ? &*r_.demands : nullptr, r_.min_allowance_as_written, r_.part, r_.part_cut, part},
        report_);
    std::optional<DemandCheck> demands;
    if (r_.demands) {
      demands.emplace(*r_.demands, r_.part, placed_, r_.blank, r_.part_tolerance + r_.blank_tolerance,
                      report_.findings);
      demands->check_placement();
      if (!demands->check_missing()) {
        missing_open_ = true;
        report_.notes.emplace_back(
            "that no more is missing at the placement than the margin says was not shown");
      }
      check_curve();
    }
    const bool proved = check_certificates(demands ? &*demands : nullptr);
    if (!complaint_.empty())
      return bad(inputs_.certificate ? inputs_.certificate->name : inputs_.result.name);
    check_status();
    const bool open = demands && demands->leaves_choice_open();
    if (open)
      report_.notes.push_back(fmt::format(
          "the criterion \"{}\" is none that this checker knows, so it was not rechecked that the "
          "placement is the one that the criterion looks for",
          excerpt(r_.demands->criterion)));
    const bool claims_open = open || !features_whole || program_open_;
    report_.verdict = !report_.findings.empty()      ? Verdict::refuted
                      : !proved                      ? Verdict::unproved
                      : claims_open || missing_open_ ? Verdict::incomplete
                      : origins_open_                ? Verdict::stated_regions
                                                     : Verdict::confirmed;
    return std::move(report_);
  }

 private:
  tl::unexpected<Error> bad(const std::string& name) const {
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", name, complaint_));
  }
  template <class... Args>
  void find(fmt::format_string<Args...> format, Args&&... args) {
    report_.findings.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  void place();
  void check_shape(const char* role, const Shape& shape);
  Origin check_input(const char* role, const RegionClaim& claim);
  void check_clearance();
  [[nodiscard]] std::optional<ExactShift> exact_shift(const Decimal& x, const Decimal& y,
                                                      const Decimal& theta, bool mirrored) const;
  /// Returns the exact clearance less the tolerances.
  Span check_clearance(const std::string& whose, const Shape& placed, const std::optional<ExactShift>& shift,
                       Span written);
  void check_pose();
  void check_degrees(const std::string& whose, const Decimal& theta, const Decimal& written);
  void check_allowed(const std::string& whose, const Decimal& x, const Decimal& y, const Decimal& angle,
                     bool mirrored);
  void check_contacts();
  void check_derived();
  void check_beside_demands();
  void check_side();
  void check_curve();
  /// The subject of a certificate: for demands it is the grown part and the caps.
  struct Bounded {
    Span bound, grown_for, shift;
    std::optional<Span> most;
  };
  Json certificate_of(const char* key);
  bool check_cover(const char* key, const DemandCheck* demands, const Bounded& what);
  void check_own_outline(const std::string& says, const Bounded& what);
  [[nodiscard]] bool is_one_file() const;
  [[nodiscard]] bool lies_in_one_file();
  /// Returns whether every bound had a certificate to look at.
  bool check_certificates(DemandCheck* demands);
  void check_status();

  const LocateInputs& inputs_;
  Json root_;
  std::string complaint_;
  RegionDocument r_;
  Motion motion_;
  Shape placed_;
  /// True when it is open whether a region is what its file means.
  bool origins_open_ = false;
  bool program_open_ = false, missing_open_ = false;
  LocateReport report_;
};

void PoseCheck::place() {
  motion_ =
      motion_of(Interval(r_.theta, 96 + angle_bits(r_.theta)), enclosed(r_.x), enclosed(r_.y), r_.mirrored);
  placed_ = placed(r_.part, motion_);
}

void PoseCheck::check_shape(const char* role, const Shape& shape) {
  if (const auto fault = fault_of(shape)) find("the outline of the {} is none: {}", role, *fault);
}

/// Reports a region that was used and is not what its file means, and one of which that is not shown.
Origin PoseCheck::check_input(const char* role, const RegionClaim& claim) {
  // An outline with a fault is reported, and nothing follows from it.
  if (fault_of(claim.used)) return {};
  Origin origin = check_origin(claim);
  if (origin.fault) find("the {} used is not what {} means: {}", role, claim.file.name, *origin.fault);
  if (origin.open) {
    origins_open_ = true;
    report_.notes.push_back(fmt::format("that the {} used is what {} means was not rechecked: {}", role,
                                        claim.file.name, *origin.open));
  }
  return origin;
}

void PoseCheck::check_clearance() {
  const Span exact =
      check_clearance("", placed_, exact_shift(r_.x, r_.y, r_.theta, r_.mirrored), r_.clearance);
  report_.clearance_low = fmt::format("{}", exact.low);
  report_.clearance_high = fmt::format("{}", exact.high);
}

/// Returns a placement without rotation as it is written, and nothing for another one.
std::optional<ExactShift> PoseCheck::exact_shift(const Decimal& x, const Decimal& y, const Decimal& theta,
                                                 bool mirrored) const {
  // Findings are already there for an outline with a fault, and such an outline proves nothing.
  if (sgn(theta.digits) != 0 || !report_.findings.empty()) return std::nullopt;
  return ExactShift{x, y, mirrored};
}

Span PoseCheck::check_clearance(const std::string& whose, const Shape& placed,
                                const std::optional<ExactShift>& shift, Span written) {
  const Span tolerances = r_.part_tolerance + r_.blank_tolerance;
  // Adding even a zero tolerance widens an enclosure, and a part that touches has nothing to spare.
  const bool none = (r_.part_tolerance.high == 0 && r_.blank_tolerance.high == 0) || lies_in_one_file();
  // The clearance claimed for the regions as they are written.
  const Span claimed = none ? written : written + tolerances;
  const Span exact = clearance(r_.part, placed, r_.blank, shift, claimed.low);
  const Span less = none ? exact : exact - tolerances;
  if (claimed.high <= exact.low) return less;
  if (exact.low > 0)
    find(
        "{}clearance {} mm is above {} mm, the least distance between the outlines at its pose, less the "
        "tolerances",
        whose, written.low, less.low);
  else
    find(
        "{}clearance is {} mm, but the placed part {}: the exact one is between {} and {} mm, less the "
        "tolerances",
        whose, written.low,
        exact.high < 0 ? "sticks out of the blank by more"
                       : "meets the outline of the blank, or cannot be told from doing so",
        less.low, less.high);
  return less;
}

void PoseCheck::check_pose() {
  check_allowed("", r_.x, r_.y, r_.theta, r_.mirrored);
  check_degrees("", r_.theta, r_.theta_deg);
}

void PoseCheck::check_degrees(const std::string& whose, const Decimal& theta, const Decimal& written) {
  const Precision wide = 128 + angle_bits(theta);
  const Interval degrees = Interval(theta, wide) * Interval(Integer(180), wide) / Interval::pi(wide);
  const double meant = degrees.high_double();
  if (!(std::abs((degrees - Interval(written, 128 + angle_bits(written))).high_double()) <=
        1e-14 * std::abs(meant)))
    find("{}theta_deg is {}, but theta means {} degrees", whose, approximate(written), meant);
}

/// Checks locked shifts, the window and mirroring.
void PoseCheck::check_allowed(const std::string& whose, const Decimal& x, const Decimal& y,
                              const Decimal& angle, bool mirrored) {
  for (const auto& [locked, is] : {std::pair{&r_.locked_x, &x}, {&r_.locked_y, &y}})
    if (*locked && compare(**locked, *is) != 0) find("{}the placement is not where it is locked", whose);
  if (mirrored != (r_.mirror == "yes") && r_.mirror != "either")
    find("{}the placement is {}mirrored, which was not allowed", whose, mirrored ? "" : "not ");
  const Precision wide = 128 + angle_bits(angle);
  const double theta =
      (Interval(angle, wide) * Interval(Integer(180), wide) / Interval::pi(wide)).high_double();
  const double from = approximate(r_.window_from), to = approximate(r_.window_to);
  if (to - from >= 360) return;
  const double slack = kAngleTolerance * std::max({std::abs(from), std::abs(to), 1.0});
  if (!(theta >= from - slack && theta <= to + slack))
    find("{}theta is {} degrees, outside the window from {} to {}", whose, theta, from, to);
}

/// Checks that every placement of the trade-off curve has the clearance, the margin and the largest allowance
/// that the result states for it.
void PoseCheck::check_curve() {
  for (std::size_t k = 0; k < r_.demands->curve.size(); ++k) {
    const WrittenTradeOff& point = r_.demands->curve[k];
    const std::string whose = fmt::format("demands.trade_off[{}]: ", k);
    check_allowed(whose, point.x, point.y, point.theta, point.mirrored);
    check_degrees(whose, point.theta, point.theta_deg);
    WrittenDemands here = *r_.demands;
    here.margin = point.margin, here.largest = point.largest;
    const Shape at = placed(r_.part, motion_of(Interval(point.theta, 96 + angle_bits(point.theta)),
                                               enclosed(point.x), enclosed(point.y), point.mirrored));
    check_clearance(whose, at, exact_shift(point.x, point.y, point.theta, point.mirrored), point.clearance);
    std::vector<std::string> findings;
    DemandCheck(here, r_.part, at, r_.blank, r_.part_tolerance + r_.blank_tolerance, findings)
        .check_placement();
    for (const std::string& finding : findings) report_.findings.push_back(whose + finding);
  }
}

void PoseCheck::check_contacts() {
  for (std::size_t i = 0; i < r_.contacts.size(); ++i) {
    const WrittenTouch& contact = r_.contacts[i];
    const double size =
        std::max(std::abs(r_.blank.high_x - r_.blank.low_x), std::abs(r_.blank.high_y - r_.blank.low_y));
    const double slack = kReadingTolerance * std::max(1.0, size);
    if (!lies_on(contact.part, contact.part_edge, r_.part, slack))
      find("contact {}: part_at is not on edge {} of the part", i, contact.part_edge);
    if (!lies_on(contact.blank, contact.blank_edge, r_.blank, slack))
      find("contact {}: blank_at is not on edge {} of the blank", i, contact.blank_edge);
    const Span apart = length(verify::placed(contact.part, motion_) - contact.blank);
    if (!(apart.low <= contact.distance + slack && apart.high >= contact.distance - slack))
      find("contact {}: its points are {} mm apart, not {}", i, apart.low, contact.distance);
  }
}

void PoseCheck::check_derived() {
  const auto differs = [](Span written, Span real) {
    const double slack = 1e-15 * (std::abs(real.high) + std::abs(written.low));
    return written.low > real.high + slack || written.high < real.low - slack;
  };
  if (r_.demands) {
    check_beside_demands();
    return check_side();
  }
  if (r_.upper_bound.high < r_.clearance.low)
    find("upper_bound {} is below clearance {}", r_.upper_bound.low, r_.clearance.low);
  const Span gap = r_.upper_bound - r_.clearance;
  const Span widened{gap.low - 1e-15 * std::abs(r_.upper_bound.high),
                     gap.high + 1e-15 * std::abs(r_.upper_bound.high)};
  if (differs(r_.gap, widened)) find("gap is not upper_bound less clearance");
  const Span missing = r_.min_allowance - r_.clearance;
  if (missing.high <= 0 ? sgn(r_.shortfall_as_written.digits) != 0
                        : differs(r_.shortfall, {std::max(0.0, missing.low), missing.high}))
    find("shortfall is not min_allowance less clearance");
  check_side();
}

/// With demands what is missed is that of the margin, which also has the bound.
void PoseCheck::check_beside_demands() {
  if (r_.bound_beside_demands) find("upper_bound and gap are not null, but the bound is that of the margin");
  const Decimal& margin = r_.demands->margin_as_written;
  const Decimal missing = sgn(margin.digits) < 0 ? Decimal{} - margin : Decimal{};
  if (compare(r_.shortfall_as_written, missing) != 0)
    find("shortfall is {}, but the margin {} makes it {}", approximate(r_.shortfall_as_written),
         approximate(margin), approximate(missing));
}

void PoseCheck::check_side() {
  if (!r_.nc) return;
  const Span left = r_.clearance - enclosed(r_.nc->rounding_mm);
  if (enclosed(r_.nc->clearance).low > left.high || sgn(r_.nc->rounding_mm.digits) < 0)
    find("the program's clearance {} is above clearance less its rounding", approximate(r_.nc->clearance));
  if (r_.mirrored) find("a program was written, but the part lies mirrored");
  program_open_ = !check_program(inputs_, *r_.nc, {r_.x, r_.y, r_.theta}, report_);
}

Json PoseCheck::certificate_of(const char* key) {
  const Json here = Fields(root_, "", complaint_).get(key);
  if (!here.is_null() || !r_.in_file || !inputs_.certificate) return here;
  const auto root = parse_json(inputs_.certificate->bytes, inputs_.certificate->name);
  if (!root) return complaint_ = "it is no JSON document", Json{};
  refuse_unknown_fields(*root, complaint_);
  return Fields(*root, "", complaint_).get(key);
}

/// Says whether part and blank were read from the same bytes to the same outline. However far the reader was
/// off, it was off by the same.
bool PoseCheck::is_one_file() const {
  return inputs_.part.bytes == inputs_.blank.bytes && !r_.part_cut &&
         r_.part_tolerance.low == r_.blank_tolerance.low &&
         r_.part_tolerance.high == r_.blank_tolerance.high && same_outline(r_.part, r_.blank);
}

/// Says whether the part lies in the file that it is from as it is drawn there, and the result rests on it.
bool PoseCheck::lies_in_one_file() {
  return certificate_of("certificate").text == R"("same file")" && sgn(r_.x.digits) == 0 &&
         sgn(r_.y.digits) == 0 && sgn(r_.theta.digits) == 0 && !r_.mirrored && is_one_file();
}

/// Checks the reason that part and blank have one outline. No motion changes the part's area, which is that
/// of the blank; but with clearance around it, it would have to be less.
void PoseCheck::check_own_outline(const std::string& says, const Bounded& what) {
  if (says != "same outline" && says != "same file")
    return find("the certificate says \"{}\", which proves nothing", excerpt(says));
  if (!same_outline(r_.part, r_.blank))
    return find("the certificate says \"{}\", but part and blank have different outlines", says);
  if (says == "same file" && !is_one_file())
    return find("the certificate says \"same file\", but part and blank are different files or were cut");
  // The same bytes mean one shape where the same layers and the same joins were said of both.
  if (says == "same file" && r_.part_tolerance.high > 0 && r_.part_drawing.text != r_.blank_drawing.text) {
    origins_open_ = true;
    report_.notes.push_back("that part and blank were read from the file in the same way was not rechecked");
  }
  const bool none = says == "same file" || (r_.part_tolerance.high == 0 && r_.blank_tolerance.high == 0);
  const Span least = none ? Span{} : r_.part_tolerance + r_.blank_tolerance;
  if (!(what.bound.low >= least.high))
    find("upper_bound {} is below {} mm, which a part in its own outline may have", what.bound.low,
         least.high);
}

/// Returns false when there is no certificate of that name to look at.
bool PoseCheck::check_cover(const char* key, const DemandCheck* demands, const Bounded& what) {
  const Json certificate = certificate_of(key);
  if (certificate.text.empty() || certificate.is_null()) return false;
  if (certificate.is_string() && demands == nullptr)
    return check_own_outline(json_text(certificate), what), true;
  Fields fields(certificate, key, complaint_);
  std::vector<Decimal> pivot;
  fields.each("pivot",
              [&](Json item, const std::string& path) { pivot.push_back(fields.number_of(item, path)); });
  if (pivot.size() != 2) fields.complain(fmt::format("{} is not two numbers", fields.name("pivot")));
  if (!complaint_.empty()) return false;
  const Vec at{enclosed(pivot[0]), enclosed(pivot[1])};
  CoverTree::Problem problem{r_.part,        r_.blank,     at,          0,          0,
                             r_.window_from, r_.window_to, r_.locked_x, r_.locked_y};
  if ((r_.locked_x || r_.locked_y) && !(sgn(pivot[0].digits) == 0 && sgn(pivot[1].digits) == 0))
    find("a shift is locked, but the pivot of the certificate is not the part's origin");
  problem.pivot_off = std::max(0.0, -signed_distance(at, r_.part).low);
  problem.bound = ((what.bound - r_.part_tolerance) - r_.blank_tolerance).low;
  if (demands != nullptr) {
    problem.growth = demands->growth(what.grown_for), problem.caps = demands->caps(what.shift, what.most);
    problem.pivot_off = demands->off_grown_part(at, what.grown_for);
  }
  CoverTree cover(problem, report_.findings);
  bool plain = false, mirrored = false;
  fields.each("trees", [&](Json item, const std::string& path) {
    if (!complaint_.empty()) return;
    Fields tree(item, path, complaint_);
    const bool is_mirrored = truth_of(tree, "mirrored");
    (is_mirrored ? mirrored : plain) = true;
    cover.check(item, path, complaint_);
  });
  if (r_.mirror != "yes" && !plain) find("the {} has no tree for the part as it is", key);
  if (r_.mirror != "no" && !mirrored) find("the {} has no tree for the mirrored part", key);
  report_.intervals += cover.leaves();
  return true;
}

bool PoseCheck::check_certificates(DemandCheck* demands) {
  const bool bounds_largest = demands != nullptr && r_.demands->second && r_.demands->second->proof;
  const Json largest = Fields(root_, "", complaint_).get("largest_certificate");
  if (!bounds_largest && !largest.is_null())
    find("there is a largest_certificate, but nothing that it is to prove");
  if (demands == nullptr) {
    if (!check_cover("certificate", nullptr, {r_.upper_bound, {}, {}, {}})) return false;
    report_.bound_high = fmt::format("{}", r_.upper_bound.high);
    return true;
  }
  const WrittenDemands& d = *r_.demands;
  demands->check_criteria(r_.status == "optimal");
  bool proved = check_cover("certificate", demands, {d.bound, d.grown_for, d.shift, {}});
  if (proved) {
    demands->check_bound();
    report_.bound_high = fmt::format("{}", d.margin_bound.high);
    report_.notes.push_back("the bound is that of the margin of the demands");
    if (!d.curve.empty())
      report_.notes.push_back("the bounds of the points of the trade-off curve were not rechecked");
  }
  if (bounds_largest) {
    const WrittenSecond::Proof& p = *d.second->proof;
    demands->check_largest_bound();
    if (!check_cover("largest_certificate", demands, {p.bound, enclosed(p.grown_for), p.shift, p.most})) {
      report_.notes.push_back(
          "there is no certificate for the bound of largest allowances, so it was not rechecked");
      proved = false;
    } else {
      report_.notes.push_back(
          fmt::format("with a margin of {} or more no placement that keeps the maxima has a largest "
                      "allowance below {} mm",
                      enclosed(d.second->margin).high, enclosed(d.second->bound).low));
    }
  }
  return proved;
}

void PoseCheck::check_status() {
  const bool out_of_reach =
      r_.demands ? r_.demands->margin_bound.high < 0 : r_.upper_bound.high < r_.min_allowance.low;
  if (r_.status == "infeasible" && !out_of_reach)
    find("status is infeasible, but {}",
         r_.demands ? "margin_bound is not below 0" : "upper_bound is not below min_allowance");
  if (r_.status == "optimal" && out_of_reach)
    find("status is optimal, but {}",
         r_.demands ? "margin_bound is below 0" : "upper_bound is below min_allowance");
}

}  // namespace

Result<LocateReport> check_poses(const LocateInputs& inputs, Json written) {
  return PoseCheck(inputs, written).run();
}

}  // namespace lekalo::verify

#include "pose_check.hpp"

#include <array>
#include <optional>

#include "cover_tree.hpp"
#include "demand_check.hpp"
#include "feature_check.hpp"
#include "verify/number/interval.hpp"
#include "verify/shape/region_clearance.hpp"
#include "verify/shape/shape_distance.hpp"
#include "verify/shape/shape_inside.hpp"

namespace lekalo::verify {
namespace {

/// Derived fields and points that are printed for people may be off by this, in mm and relatively.
constexpr double kReadingTolerance = 1e-6;
/// An angle of the pose may be off the window by this, relatively: degrees and radians are rounded.
constexpr double kAngleTolerance = 4e-15;

Span enclosed(const Decimal& value) {
  const Interval interval(value, 64);
  return {interval.low_double(), interval.high_double()};
}

/// Refuses a field that is neither true nor false, because different readers would take it differently.
bool truth_of(Fields& fields, std::string_view key) {
  const Json value = fields.get(key);
  if (!value.is_bool()) fields.complain(fmt::format("field {} is neither true nor false", fields.name(key)));
  return value.is_bool() && value.is_true();
}

struct WrittenTouch {
  Vec part, blank;
  double distance = 0, multiplier = 0;
};

struct RegionDocument {
  std::string status;
  Decimal x, y, theta, theta_deg;
  bool mirrored = false;
  Span clearance, upper_bound, gap, min_allowance, shortfall, part_tolerance, blank_tolerance;
  Decimal min_allowance_as_written, shortfall_as_written;
  /// True if there is an upper_bound or gap beside demands, although the margin has the bound then.
  bool bound_beside_demands = false;
  std::string mirror;
  Decimal window_from, window_to;
  Shape part, blank;
  std::vector<WrittenTouch> contacts;
  bool in_file = false;
  std::optional<Decimal> locked_x, locked_y;
  std::optional<WrittenDemands> demands;
  bool part_cut = false;
  struct Program {
    Span clearance, rounding;
  };
  std::optional<Program> program;
};

class PoseCheck {
 public:
  PoseCheck(const LocateInputs& inputs, Json result) : inputs_(inputs), root_(result) {}

  Result<LocateReport> run() {
    read();
    if (!complaint_.empty()) return bad(inputs_.result.name);
    check_shape("part", r_.part);
    check_shape("blank", r_.blank);
    place();
    const bool part_is_region = check_input("part", inputs_.part, r_.part, r_.part_tolerance);
    check_input("blank", inputs_.blank, r_.blank, r_.blank_tolerance);
    check_clearance();
    check_contacts();
    check_derived();
    check_pose();
    const bool features_whole =
        check_features(inputs_.features,
                       {r_.demands ? &*r_.demands : nullptr, r_.min_allowance_as_written, r_.part,
                        r_.part_cut, part_is_region},
                       report_);
    std::optional<DemandCheck> demands;
    if (r_.demands) {
      demands.emplace(*r_.demands, r_.part, placed_, r_.blank, r_.part_tolerance + r_.blank_tolerance,
                      report_.findings);
      demands->check_placement();
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
    report_.verdict = !report_.findings.empty() ? Verdict::refuted
                      : !proved                 ? Verdict::unproved
                      : open || !features_whole ? Verdict::incomplete
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

  void read();
  void place();
  void check_shape(const char* role, const Shape& shape);
  /// Returns whether the file is a region file, which is rechecked.
  bool check_input(const char* role, const Document& file, const Shape& used, Span tolerance);
  void check_clearance();
  void check_pose();
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
  /// Returns whether every bound had a certificate to look at.
  bool check_certificates(DemandCheck* demands);
  void check_status();

  const LocateInputs& inputs_;
  Json root_;
  std::string complaint_;
  RegionDocument r_;
  Motion motion_;
  Shape placed_;
  LocateReport report_;
};

void PoseCheck::read() {
  Fields fields(root_, "", complaint_);
  std::string ignored;
  Fields format(fields.get("format"), "format", ignored);
  if (!format.get("name").is_string() || json_text(format.get("name")) != "lekalo-locate" ||
      format.get("version").text != "1")
    fields.complain("field format does not say lekalo-locate, version 1");
  if (fields.text("units") != "mm") fields.complain("field units is not \"mm\"");
  r_.status = fields.text("status");
  constexpr std::array<std::string_view, 3> kStatuses{"optimal", "stopped", "infeasible"};
  if (std::find(kStatuses.begin(), kStatuses.end(), r_.status) == kStatuses.end())
    fields.complain(fmt::format("\"{}\" is no status of a result", excerpt(r_.status)));
  r_.x = fields.number("x"), r_.y = fields.number("y");
  r_.theta = fields.number("theta"), r_.theta_deg = fields.number("theta_deg");
  r_.mirrored = truth_of(fields, "mirrored");
  r_.mirror = fields.text("mirror");
  if (r_.mirror != "no" && r_.mirror != "yes" && r_.mirror != "either")
    fields.complain("field mirror is none of \"no\", \"yes\", \"either\"");
  for (auto [key, to] : {std::pair{"clearance", &r_.clearance},
                         {"min_allowance", &r_.min_allowance},
                         {"shortfall", &r_.shortfall}})
    *to = enclosed(fields.number(key));
  r_.min_allowance_as_written = fields.number("min_allowance");
  r_.shortfall_as_written = fields.number("shortfall");
  std::vector<Decimal> ends;
  fields.each("window_deg",
              [&](Json item, const std::string& path) { ends.push_back(fields.number_of(item, path)); });
  if (ends.size() == 2) r_.window_from = ends[0], r_.window_to = ends[1];
  if (ends.size() != 2 || compare(ends[0], ends[1]) > 0)
    fields.complain("field window_deg is not two angles in ascending order");
  Fields tolerances(fields.get("tolerances"), "tolerances", complaint_);
  r_.part_tolerance = enclosed(tolerances.number("part")),
  r_.blank_tolerance = enclosed(tolerances.number("blank"));
  Fields regions(fields.get("regions"), "regions", complaint_);
  for (const auto& [key, to] : {std::pair{"part", &r_.part}, {"blank", &r_.blank}}) {
    const std::string path = fmt::format("regions.{}", key);
    if (Fields(regions.get(key), path, complaint_).text("units") != "mm")
      fields.complain(fmt::format("the units of {} are not mm", path));
    *to = read_shape(regions.get(key), path, complaint_);
  }
  for (const std::string_view key : {"locked", "demands", "scan", "part_cut"})
    if (fields.get(key).text.empty()) fields.complain(fmt::format("field {} is missing", key));
  if (const Json locked = fields.get("locked"); !locked.is_null()) {
    Fields shift(locked, "locked", complaint_);
    r_.locked_x = shift.number_or_null("x"), r_.locked_y = shift.number_or_null("y");
  }
  if (!fields.get("part_cut").text.empty()) r_.part_cut = truth_of(fields, "part_cut");
  const Json demands = fields.get("demands");
  if (!demands.is_null()) {
    r_.demands = read_demands(demands, complaint_);
    for (const std::string_view key : {"upper_bound", "gap"})
      if (fields.number_or_null(key)) r_.bound_beside_demands = true;
  } else {
    r_.upper_bound = enclosed(fields.number("upper_bound")), r_.gap = enclosed(fields.number("gap"));
  }
  if (const Json trim = fields.get("trim"); !trim.text.empty() && !trim.is_null())
    fields.complain("field trim says something that this checker does not know");
  if (const Json nc = fields.get("nc"); !nc.text.empty() && !nc.is_null()) {
    Fields program(nc, "nc", complaint_);
    r_.program = {enclosed(program.number("clearance")), enclosed(program.number("rounding_mm"))};
  }
  fields.each("contacts", [&](Json item, const std::string& path) {
    Fields contact(item, path, complaint_);
    const auto point = [&](std::string_view key) {
      std::vector<Span> numbers;
      contact.each(key, [&](Json number, const std::string& at) {
        numbers.push_back(enclosed(contact.number_of(number, at)));
      });
      if (numbers.size() != 2)
        return contact.complain(fmt::format("{} is not two numbers", contact.name(key))), Vec{};
      return Vec{numbers[0], numbers[1]};
    };
    r_.contacts.push_back({point("part_at"), point("blank_at"), approximate(contact.number("distance")),
                           approximate(contact.number("multiplier"))});
  });
  r_.in_file = !fields.get("certificate_file").text.empty() && !fields.get("certificate_file").is_null();
  if (r_.part_tolerance.low < 0 || r_.blank_tolerance.low < 0) fields.complain("a tolerance is negative");
}

void PoseCheck::place() {
  motion_ =
      motion_of(Interval(r_.theta, 96 + angle_bits(r_.theta)), enclosed(r_.x), enclosed(r_.y), r_.mirrored);
  placed_ = placed(r_.part, motion_);
}

void PoseCheck::check_shape(const char* role, const Shape& shape) {
  if (const auto fault = fault_of(shape)) find("the outline of the {} is none: {}", role, *fault);
}

/// Reports a shape that was used and is not the shape of its region file. Files of other kinds become regions
/// by rules that are not rechecked here.
bool PoseCheck::check_input(const char* role, const Document& file, const Shape& used, Span tolerance) {
  const auto root = parse_json(file.bytes, file.name);
  const auto has = [&](std::string_view key) {
    std::array<Json, 1> found;
    return root && root->is_object() && find_members(*root, std::array{key}, found) && !found[0].text.empty();
  };
  const bool cut = role == std::string_view("part") && r_.part_cut;
  if (cut || (!has("outer") && !has("pieces"))) {
    report_.notes.push_back(
        fmt::format("how {} became the region of the {} was not rechecked", file.name, role));
    return false;
  }
  // A file that does not say its unit may have been given one on the command line.
  std::string complaint;
  const bool said = has("units");
  bool same = false;
  for (const bool inch : {false, true}) {
    if (inch && said) continue;
    const Shape written = read_shape(*root, file.name, complaint, inch);
    if (!complaint.empty()) {
      find("the {} used is not the shape in {}: {}", role, file.name, complaint);
      return true;
    }
    same = same || same_edges(written, used, tolerance.high);
  }
  if (!same) find("the {} used is not the shape in {}", role, file.name);
  return true;
}

void PoseCheck::check_clearance() {
  const Span tolerances = r_.part_tolerance + r_.blank_tolerance;
  // Adding even a zero tolerance widens an enclosure, and a part that touches has nothing to spare.
  const bool none = r_.part_tolerance.high == 0 && r_.blank_tolerance.high == 0;
  // The clearance claimed for the regions as they are written.
  const Span claimed = none ? r_.clearance : r_.clearance + tolerances;
  std::optional<ExactShift> shift;
  if (sgn(r_.theta.digits) == 0) shift = ExactShift{r_.x, r_.y, r_.mirrored};
  // Findings are already there for an outline with a fault, and such an outline proves nothing.
  if (!report_.findings.empty()) shift.reset();
  const Span exact = clearance(r_.part, placed_, r_.blank, shift);
  const Span less = none ? exact : exact - tolerances;
  report_.clearance_low = fmt::format("{}", less.low);
  report_.clearance_high = fmt::format("{}", less.high);
  if (claimed.high <= exact.low) return;
  if (exact.low > 0)
    find(
        "clearance {} mm is above {} mm, the least distance between the outlines at its pose, less the "
        "tolerances",
        r_.clearance.low, less.low);
  else
    find(
        "clearance is {} mm, but the placed part {}: the exact one is between {} and {} mm, less the "
        "tolerances",
        r_.clearance.low,
        exact.high < 0 ? "sticks out of the blank by more"
                       : "meets the outline of the blank, or cannot be told from doing so",
        less.low, less.high);
}

void PoseCheck::check_pose() {
  check_allowed("", r_.x, r_.y, r_.theta, r_.mirrored);
  const Precision wide = 128 + angle_bits(r_.theta);
  const Interval degrees = Interval(r_.theta, wide) * Interval(Integer(180), wide) / Interval::pi(wide);
  const double theta = degrees.high_double();
  if (!(std::abs((degrees - Interval(r_.theta_deg, 128 + angle_bits(r_.theta_deg))).high_double()) <=
        1e-14 * std::abs(theta)))
    find("theta_deg is {}, but theta means {} degrees", approximate(r_.theta_deg), theta);
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

/// Checks that every placement of the trade-off curve has the margin and the largest allowance that the
/// result states for it.
void PoseCheck::check_curve() {
  for (std::size_t k = 0; k < r_.demands->curve.size(); ++k) {
    const WrittenTradeOff& point = r_.demands->curve[k];
    const std::string whose = fmt::format("demands.trade_off[{}]: ", k);
    check_allowed(whose, point.x, point.y, point.theta, point.mirrored);
    WrittenDemands here = *r_.demands;
    here.margin = point.margin, here.largest = point.largest;
    const Shape at = placed(r_.part, motion_of(Interval(point.theta, 96 + angle_bits(point.theta)),
                                               enclosed(point.x), enclosed(point.y), point.mirrored));
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
    if (!(distance(contact.part, r_.part).low <= slack))
      find("contact {}: part_at is not on the part's outline", i);
    if (!(distance(contact.blank, r_.blank).low <= slack))
      find("contact {}: blank_at is not on the blank's outline", i);
    const Span apart = length(verify::placed(contact.part, motion_) - contact.blank);
    if (!(apart.low <= contact.distance + slack && apart.high >= contact.distance - slack))
      find("contact {}: its points are {} mm apart, not {}", i, apart.low, contact.distance);
  }
}

void PoseCheck::check_derived() {
  const auto differs = [](Span written, Span real) {
    const double slack =
        1e-15 * std::max(std::abs(real.low), std::abs(real.high)) + 1e-15 * std::abs(written.low);
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
  if (missing.high <= 0 ? r_.shortfall.low != 0 || r_.shortfall.high != 0
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
  if (sgn(margin.digits) < 0)
    report_.notes.push_back(fmt::format(
        "that no more than {} mm is missing at the placement was not rechecked", approximate(missing)));
}

void PoseCheck::check_side() {
  if (r_.program) {
    const Span left = r_.clearance - r_.program->rounding;
    if (r_.program->clearance.low > left.high || r_.program->rounding.low < 0)
      find("the program's clearance {} is above clearance less its rounding", r_.program->clearance.low);
  }
}

Json PoseCheck::certificate_of(const char* key) {
  const Json here = Fields(root_, "", complaint_).get(key);
  if (!(here.text.empty() || here.is_null()) || !r_.in_file || !inputs_.certificate) return here;
  const auto root = parse_json(inputs_.certificate->bytes, inputs_.certificate->name);
  if (!root) return complaint_ = "it is no JSON document", Json{};
  return Fields(*root, "", complaint_).get(key);
}

/// Returns false when there is no certificate of that name to look at.
bool PoseCheck::check_cover(const char* key, const DemandCheck* demands, const Bounded& what) {
  const Json certificate = certificate_of(key);
  if (certificate.text.empty() || certificate.is_null()) return false;
  Fields fields(certificate, key, complaint_);
  std::vector<Span> pivot;
  fields.each("pivot", [&](Json item, const std::string& path) {
    pivot.push_back(enclosed(fields.number_of(item, path)));
  });
  if (pivot.size() != 2) fields.complain(fmt::format("{} is not two numbers", fields.name("pivot")));
  if (!complaint_.empty()) return false;
  const Vec at{pivot[0], pivot[1]};
  CoverTree::Problem problem{r_.part,        r_.blank,     at,          0,          0,
                             r_.window_from, r_.window_to, r_.locked_x, r_.locked_y};
  if ((r_.locked_x || r_.locked_y) &&
      !(pivot[0].low == 0 && pivot[0].high == 0 && pivot[1].low == 0 && pivot[1].high == 0))
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
  if (!bounds_largest && !largest.text.empty() && !largest.is_null())
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

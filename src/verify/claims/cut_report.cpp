#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "lekalo/base/angle.hpp"
#include "lekalo/verify/simulate.hpp"
#include "machining_fields.hpp"
#include "report_fields.hpp"
#include "verify/origin/origin.hpp"
#include "verify/pocket/nc_moves.hpp"
#include "verify/pocket/stroke.hpp"
#include "verify/read/known_fields.hpp"
#include "verify/shape/shape.hpp"

namespace lekalo::verify {
namespace {

/// mm that the tool may leave a pocket by; docs/design/pocket.md, step 9.
constexpr double kMostGouge = 0.005;
/// mm of path that a stretch lasts, to be one of the hot ones.
constexpr double kLasting = 0.2;
/// Words of a program have four decimals at least, and three on some controls.
constexpr double kWordRounding = 5.1e-4;

struct Figure {
  std::string_view key;
  double value;
};

std::vector<Figure> figures_of(const SimulateReport& r) {
  return {{"coverage_percent", r.coverage_percent},
          {"coverage_low_percent", r.coverage_low_percent},
          {"uncut_width_mm", r.uncut_width_mm},
          {"gouge_mm", r.gouge_mm},
          {"engagement_max_deg", r.engagement_max_deg},
          {"engagement_peak_deg", r.engagement_peak_deg},
          {"engagement_p95_deg", r.engagement_p95_deg},
          {"air_percent", r.air_percent},
          {"entry_mm", r.entry_mm},
          {"entry_layer_mm", r.entry_layer_mm},
          {"rapid_cut_mm", r.rapid_cut_mm},
          {"length_mm", r.length_mm},
          {"turning_rad", r.turning_rad},
          {"retracts", static_cast<double>(r.retracts)},
          {"seconds", r.seconds},
          {"lower_bound_seconds", r.lower_bound_seconds},
          {"reachable_mm2", r.reachable_mm2},
          {"uncut_mm2", r.uncut_mm2},
          {"left_before_mm2", r.left_before_mm2}};
}

double rounded(double value) { return std::round(value * 1000) / 1000; }

/// A stretch of path as reports have it, rounded to thousandths.
struct Stretch {
  std::array<double, 7> numbers{};  ///< from, to, z, length_mm, engagement_deg
  friend bool operator==(const Stretch&, const Stretch&) = default;
};

/// The stretches outside entries, kLasting and longer, all along which more of the rim is in material than
/// 1.25 times what a straight pass of this step-over meets, which is acos(1 - 2 step-over).
std::vector<Stretch> hot_cuts(const SimulateReport& report, double step_over) {
  const double cosine = 1 - 2 * step_over;
  const double held =
      1.25 * angle_between({1, 0}, {cosine, std::sqrt(1 - cosine * cosine)}) * kDegreesPerRadian;
  const auto is_hot = [&](const EngagementSample& s) { return !s.entry && s.engagement > held; };
  std::vector<Stretch> hot;
  const auto end = report.samples.end();
  for (auto first = report.samples.begin(); (first = std::find_if(first, end, is_hot)) != end;) {
    const auto behind = std::find_if_not(first, end, is_hot);
    double length = 0, largest = 0;
    for (auto s = first; s != behind; ++s) length += s->length, largest = std::max(largest, s->engagement);
    const EngagementSample& last = *std::prev(behind);
    if (length >= kLasting - 1e-9)
      hot.push_back({{rounded(first->x), rounded(first->y), rounded(last.x), rounded(last.y), rounded(last.z),
                      rounded(length), rounded(largest)}});
    first = behind;
  }
  return hot;
}

/// Names of layers compare without the case of A to Z.
bool is_among(const std::vector<std::string>& layers, const std::string& name) {
  const auto same = [](char a, char b) {
    const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
    return lower(a) == lower(b);
  };
  return std::any_of(layers.begin(), layers.end(), [&](const std::string& layer) {
    return std::equal(layer.begin(), layer.end(), name.begin(), name.end(), same);
  });
}

/// Rechecks one report.
class CutReport {
 public:
  CutReport(const Document& report, const std::vector<NamedFile>& names, const std::vector<Document>& files,
            Json root)
      : report_(report),
        names_(names),
        files_(files),
        fields_(root, "", complaint_),
        pocket_report_(kind_of(report) == Kind::pocket_report) {}

  Result<ClaimReport> rechecked() {
    check_format(fields_, pocket_report_ ? "lekalo-pocket" : "lekalo-simulate", complaint_);
    (void)fields_.get("inputs"), (void)fields_.text("version");
    if (pocket_report_) (void)fields_.get("outputs");
    read_machining(fields_, options_);
    read_followed(fields_, names_, files_, followed_);
    LEKALO_CHECK(fine());
    LEKALO_CHECK(judge());
    fields_.refuse_others();
    LEKALO_CHECK(fine());
    return std::move(claims_);
  }

 private:
  [[nodiscard]] Result<void> fine() const {
    if (complaint_.empty()) return {};
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", report_.name, complaint_));
  }

  /// Returns what the program is judged by: for a simulate report the file itself, for a pocket report the
  /// regions stated.
  Document regions() {
    if (!pocket_report_) return *followed_.pocket;
    const Json stated = fields_.get("regions");
    if (!stated.is_object()) fields_.complain("field regions is not an object");
    return {report_.name + ", regions", stated.text};
  }

  void leave_open(const std::string& why) {
    claims_.stated_regions = true;
    claims_.unchecked.push_back(fmt::format("regions: that they are what {} becomes was not rechecked: {}",
                                            followed_.pocket->name, why));
  }

  /// Derives the regions from the pocket's file anew.
  Result<void> compare_regions() {
    refuse_unknown_fields(fields_.get("regions"), "regions", complaint_);
    if (Fields(fields_.get("regions"), "regions", complaint_).text("units") != "mm")
      fields_.complain("the units of regions are not mm");
    const Shape stated = read_shape(fields_.get("regions"), "regions", complaint_);
    if (!fields_.has("tolerance_mm")) {
      leave_open("the report does not say how it was read, as those of lekalo 0.1 did not");
      return fine();
    }
    const double tolerance = fields_.number("tolerance_mm");
    if (!(tolerance >= 0)) fields_.complain("field tolerance_mm is below 0");
    const Json drawing = fields_.get("drawing"), scan = fields_.get("scan");
    for (const auto& [key, value] : {std::pair{"drawing", drawing}, {"scan", scan}})
      if (value.text.empty()) fields_.complain(fmt::format("field {} is missing", key));
    std::vector<std::string> open_layers;
    fields_.each("open_layers", [&](Json item, const std::string& path) {
      if (!item.is_string()) return fields_.complain(path + " is not a text");
      open_layers.push_back(json_text(item));
    });
    for (const auto& [key, value] : {std::pair{"drawing", drawing}, {"scan", scan}})
      refuse_unknown_fields(value, key, complaint_);
    LEKALO_CHECK(fine());
    const Origin origin = check_origin({*followed_.pocket, stated, tolerance, scan, drawing});
    if (origin.fault)
      claims_.findings.push_back(
          fmt::format("regions are not what {} means: {}", followed_.pocket->name, *origin.fault));
    else if (origin.open)
      leave_open(*origin.open);
    else
      compare_open_edges(stated, origin, open_layers, tolerance);
    if (tolerance > 0)
      claims_.notes.push_back(fmt::format("regions are within {} mm of what the file means", tolerance));
    return fine();
  }

  /// An edge is open where the file says so, or where the curve that it runs along lies on an open layer.
  void compare_open_edges(const Shape& stated, const Origin& origin,
                          const std::vector<std::string>& open_layers, double tolerance) {
    if (origin.in_file) {
      if (!same_edges(stated, *origin.in_file, tolerance, true))
        claims_.findings.push_back(fmt::format("the open edges are not those of {}", followed_.pocket->name));
      return;
    }
    // A scan has no layers.
    std::vector<std::set<std::string>> labels = origin.labels;
    labels.resize(stated.sides.size());
    std::size_t edge = 0;
    for (const Side& side : stated.sides) {
      if (!side.written) continue;
      const std::set<std::string>& layers = labels[edge++];
      const auto listed = static_cast<std::size_t>(std::count_if(
          layers.begin(), layers.end(), [&](const std::string& l) { return is_among(open_layers, l); }));
      if (side.open ? listed == 0 : listed > 0 && listed == layers.size())
        claims_.findings.push_back(fmt::format("edge {} of regions is {}, but its layer is {}", edge - 1,
                                               side.open ? "open" : "a wall",
                                               side.open ? "none of open_layers" : "one of open_layers"));
      else if (listed > 0 && listed < layers.size())
        claims_.unchecked.push_back(
            fmt::format("regions: which of two layers edge {} runs along, an open one or not", edge - 1));
    }
  }

  Result<void> judge() {
    const Document where = regions();
    LEKALO_CHECK(fine());
    std::vector<EarlierProgram> earlier = followed_.earlier;
    read_supposed(earlier);
    LEKALO_CHECK(fine());
    const Result<SimulateReport> judged = simulate(*followed_.program, where, options_, earlier);
    // An option out of its range is one of the report, and not of a command line.
    if (!judged && judged.error().code == ErrorCode::usage)
      return failure(ErrorCode::bad_input, fmt::format("{}: {}", report_.name, judged.error().message));
    if (!judged) return tl::unexpected(judged.error());
    const SimulateReport& found = *judged;
    for (const Figure& figure : figures_of(found)) compare(fields_, figure.key, figure.value, claims_);
    compare_spots(found);
    claims_.notes.push_back(fmt::format("the figures were made anew from {}", followed_.program->name));
    LEKALO_CHECK(compare_unsaid());
    if (!pocket_report_) return fine();
    LEKALO_CHECK(compare_regions());
    compare_stretches("hot_cuts", hot_cuts(found, options_.step_over));
    read_ramps();
    return compare_depth();
  }

  /// All that the programs leave to the control is unchecked. A report of simulate tells the same.
  Result<void> compare_unsaid() {
    LEKALO_TRY(const std::vector<std::string> unsaid,
               unsaid_modes(*followed_.program, options_, followed_.earlier));
    claims_.unchecked.insert(claims_.unchecked.end(), unsaid.begin(), unsaid.end());
    if (pocket_report_ || !fields_.has("unsaid")) return fine();
    std::vector<std::string> told;
    fields_.each("unsaid", [&](Json item, const std::string& path) {
      if (!item.is_string()) return fields_.complain(path + " is not a text");
      told.push_back(json_text(item));
    });
    LEKALO_CHECK(fine());
    if (told != unsaid) claims_.findings.push_back("unsaid is not what the programs do not say");
    return fine();
  }

  /// With `rest_of_mm` the larger tool's program is one that the path maker supposes.
  void read_supposed(std::vector<EarlierProgram>& earlier) {
    if (!pocket_report_ || !fields_.has("rest_of_mm")) return;
    const double tool = fields_.number("rest_of_mm");
    supposed_ = fields_.text("supposed_program");
    earlier.push_back({{"the supposed program", supposed_}, tool});
    claims_.unchecked.push_back(fmt::format(
        "rest_of_mm: that a tool of {} mm cuts what the supposed program cuts is not rechecked", tool));
  }

  void compare_spots(const SimulateReport& found) {
    compare_items(fields_, "uncut", found.uncut.size(), claims_, [&](ReportFields& item, std::size_t i) {
      compare(item, "x", found.uncut[i].x, claims_);
      compare(item, "y", found.uncut[i].y, claims_);
      compare(item, "width_mm", found.uncut[i].width_mm, claims_);
    });
    compare_items(fields_, "unreachable", found.unreachable.size(), claims_,
                  [&](ReportFields& item, std::size_t i) {
                    compare(item, "x", found.unreachable[i].x, claims_);
                    compare(item, "y", found.unreachable[i].y, claims_);
                    compare(item, "distance_mm", found.unreachable[i].distance_mm, claims_);
                    compare(item, "area_mm2", found.unreachable[i].area_mm2, claims_);
                  });
  }

  Stretch read_stretch(ReportFields& item) {
    Stretch stretch;
    std::size_t at = 0;
    for (const char* end : {"from", "to"}) {
      item.each(end, [&](Json number, const std::string&) {
        const auto value = number.is_number() ? parse_decimal(number.text) : std::nullopt;
        if (value && at < 4)
          stretch.numbers[at] = approximate(*value);
        else
          item.complain(fmt::format("field {} is not a list of two numbers", item.name(end)));
        ++at;
      });
    }
    if (at != 4) item.complain(fmt::format("field {} is not a list of two numbers", item.name("from")));
    stretch.numbers[4] = item.number("z");
    stretch.numbers[5] = item.number("length_mm");
    stretch.numbers[6] = item.number("engagement_deg");
    return stretch;
  }

  void compare_stretches(std::string_view list, const std::vector<Stretch>& found) {
    compare_items(fields_, list, found.size(), claims_, [&](ReportFields& item, std::size_t i) {
      if (!(read_stretch(item) == found[i]))
        claims_.findings.push_back(fmt::format("{}[{}] is not what the program cuts there", list, i));
    });
  }

  /// The engagement that a ramp saves was seen on a program that is not this one.
  void read_ramps() {
    std::size_t count = 0;
    fields_.each("ramps", [&](Json item, const std::string& path) {
      ReportFields fields(item, path, complaint_);
      if (!complaint_.empty()) return;
      (void)read_stretch(fields);
      fields.refuse_others();
      ++count;
    });
    if (count > 0)
      claims_.unchecked.push_back(fmt::format(
          "ramps: what {} stretches would have met without a ramp cannot be seen in the program", count));
  }

  /// The program goes down to the depth, but for what stays on the floor.
  Result<void> compare_depth() {
    const double depth = fields_.number("depth_mm"), stays = fields_.number("floor_stock_mm");
    LEKALO_CHECK(fine());
    LEKALO_TRY(const std::vector<Move> moves, read_moves(*followed_.program, options_.top, options_.control));
    double deepest = options_.top;
    for (const Move& move : moves) deepest = std::min({deepest, move.from_z, move.to_z});
    if (!(std::abs(options_.top - depth + stays - deepest) <= kWordRounding) || !(stays >= 0))
      claims_.findings.push_back(fmt::format(
          "the program goes down to Z {}, which is not depth_mm less floor_stock_mm below top_mm", deepest));
    return fine();
  }

  const Document& report_;
  const std::vector<NamedFile>& names_;
  const std::vector<Document>& files_;
  std::string complaint_;
  ReportFields fields_;
  bool pocket_report_;
  SimulateOptions options_;
  FollowedFiles followed_;  ///< without a program that is supposed
  std::string supposed_;
  ClaimReport claims_;
};

}  // namespace

Result<ClaimReport> verify_cut_report(const Document& report, const std::vector<Document>& files) {
  LEKALO_TRY(const Json root, parse_json(report.bytes, report.name));
  LEKALO_TRY(const std::vector<NamedFile> names, named_files(report));
  return CutReport(report, names, files, root).rechecked();
}

Result<ClaimReport> verify_pocket_program(const Document& program, const Document& pocket,
                                          const SimulateOptions& options,
                                          const std::vector<EarlierProgram>& earlier) {
  LEKALO_TRY(const SimulateReport found, simulate(program, pocket, options, earlier));
  ClaimReport report;
  if (!(found.gouge_mm <= kMostGouge))
    report.findings.push_back(fmt::format("the tool leaves the pocket by {} mm", found.gouge_mm));
  if (!(found.rapid_cut_mm <= 0))
    report.findings.push_back(fmt::format("{} mm of rapid motion meet material", found.rapid_cut_mm));
  if (!found.uncut.empty())
    report.findings.push_back(fmt::format(
        "{} places that the tool can reach stay uncut, the widest {:.3f} mm wide at ({:.3f}, {:.3f})",
        found.uncut.size(), found.uncut[0].width_mm, found.uncut[0].x, found.uncut[0].y));
  report.notes.push_back(
      fmt::format("coverage {:.4f} %, gouge {:.5f} mm", found.coverage_percent, found.gouge_mm));
  LEKALO_TRY(report.unchecked, unsaid_modes(program, options, earlier));
  return report;
}

}  // namespace lekalo::verify

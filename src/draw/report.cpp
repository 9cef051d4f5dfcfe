#include "lekalo/draw/report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "draw/paper/printed_number.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/io/text/csv_cell.hpp"
#include "lekalo/io/text/words.hpp"
#include "report_words.hpp"

namespace lekalo::draw {
namespace {

using geom::Point;

constexpr double kReportSamples = 2000;
constexpr double kTolerance = 1e-4;  ///< mm, of the extremes
/// The same for parts so small that 1e-4 mm shows.
constexpr double kToleranceOfSize = 1e-6;
/// The same for parts so large that doubles cannot reach the others.
constexpr double kLargestOfSize = 1e-10;

template <class Visit>
void for_each_contour(const std::vector<geom::Region>& regions, Visit&& visit) {
  for (std::size_t piece = 0; piece < regions.size(); ++piece) {
    visit(piece, std::size_t{0}, regions[piece].outer);
    for (std::size_t hole = 0; hole < regions[piece].holes.size(); ++hole)
      visit(piece, hole + 1, regions[piece].holes[hole]);
  }
}

double size_of(const std::vector<geom::Region>& regions) {
  double size = 0;
  for (const geom::Region& region : regions) {
    const geom::Box box = geom::bounds(region.outer);
    size = std::max({size, box.high.x - box.low.x, box.high.y - box.low.y});
  }
  return size;
}

double length_of(const std::vector<geom::Region>& regions) {
  double length = 0;
  for_each_contour(regions, [&](std::size_t, std::size_t, const geom::Contour& contour) {
    for (const geom::Edge& edge : contour)
      length +=
          edge.kind == geom::EdgeKind::line ? norm(edge.to - edge.from) : arc_radius(edge) * arc_sweep(edge);
  });
  return length;
}

std::vector<ReportFeature> contours_as_features(const std::vector<geom::Region>& part) {
  std::vector<ReportFeature> features;
  std::uint32_t edge = 0;
  for_each_contour(part, [&](std::size_t piece, std::size_t contour, const geom::Contour& edges) {
    ReportFeature& feature = features.emplace_back();
    if (part.size() > 1) feature.name = fmt::format("piece {}, ", piece);
    feature.name += contour == 0 ? "outline" : fmt::format("hole {}", contour - 1);
    for (std::size_t k = 0; k < edges.size(); ++k) feature.edges.push_back(edge++);
  });
  return features;
}

/// Returns the integral of the allowance over the edge, by trapezoids between the samples.
double area_over(const locate::EdgeAllowance& edge) {
  double area = 0;
  for (std::size_t k = 0; k + 1 < edge.samples.size(); ++k) {
    const locate::OutlinePoint &a = edge.samples[k], &b = edge.samples[k + 1];
    area += 0.5 * (a.allowance + b.allowance) * (b.along - a.along);
  }
  return area;
}

bool whole_is_met(const io::LocateDocument& document) {
  return document.shortfall == 0 && document.placement.clearance >= document.min_allowance;
}

FeatureRow row_of(ReportFeature feature, const Report& report) {
  FeatureRow row;
  row.feature = std::move(feature);
  double area = 0;
  bool first = true;
  for (const std::uint32_t k : row.feature.edges) {
    const locate::EdgeAllowance& edge = report.edges[k];
    row.minimum = first ? edge.least_low : std::min(row.minimum, edge.least_low);
    row.maximum = first ? edge.most_high : std::max(row.maximum, edge.most_high);
    first = false;
    row.length += edge.length;
    area += area_over(edge);
  }
  row.mean = row.length > 0 ? area / row.length : 0;
  row.minimum -= report.shapes.outline_error;
  row.maximum += report.shapes.outline_error;
  return row;
}

/// Returns what a measurement may miss a demand by. Missing it by no more than its own tolerance does not
/// contradict a result that says that every demand of a feature is met.
double rounding_of(const Report& report) {
  return report.margin && *report.margin >= 0 ? report.tolerance : 0;
}

/// Judges a feature by its own demand, or else by that on the whole part. A part that just fits meets the
/// latter where the checker says so. The rounding of the measurement here does not count then.
void judge(const Report& report, FeatureRow& row) {
  const io::LocateDocument& document = report.document;
  const ReportFeature& demand = row.feature;
  const double minimum = demand.minimum.value_or(document.min_allowance);
  const bool enough =
      row.minimum >= minimum - rounding_of(report) || (!demand.minimum && whole_is_met(document));
  const bool too_much = demand.maximum && row.maximum > *demand.maximum + rounding_of(report);
  row.met = enough && !too_much;
  if (!enough) {
    row.verdict = fmt::format("{} mm missing", short_number_up(minimum - row.minimum));
  } else if (too_much) {
    row.verdict = fmt::format("{} mm too much", short_number_up(row.maximum - *demand.maximum));
  } else {
    row.verdict = demand.minimum || demand.maximum || document.min_allowance > 0 ? "met" : "covered";
  }
}

geom::BlankFromPart pose_of(const Report& report) {
  const locate::Placement& p = report.document.placement;
  return geom::BlankFromPart::from_angle(p.theta, {p.x, p.y}, report.document.mirrored);
}

void find_demands(Report& report) {
  std::vector<std::optional<double>> own(report.edges.size());
  for (const FeatureRow& row : report.features) {
    if (!row.feature.minimum) continue;
    for (const std::uint32_t k : row.feature.edges)
      own[k] = std::max(own[k].value_or(*row.feature.minimum), *row.feature.minimum);
  }
  // A demand that the checker has confirmed counts as met, even if the measurement misses it by its rounding.
  const double whole = whole_is_met(report.document) ? 0 : report.document.min_allowance;
  for (const std::optional<double>& demand : own)
    report.demanded.push_back(demand ? *demand - rounding_of(report) : whole);
}

/// Finds the worst places of the outline and, where the part sticks out, of its inside. No two of them are
/// close together.
void find_missing(Report& report) {
  std::vector<locate::MissingPlace> places;
  for (std::size_t k = 0; k < report.edges.size(); ++k) {
    const locate::OutlinePoint& least = report.edges[k].least;
    if (least.allowance < report.demanded[k])
      places.push_back({least.in_part, least.in_blank, report.demanded[k] - least.allowance});
  }
  const double size = size_of(report.shapes.part), apart = size / 4;
  if (report.document.placement.clearance < 0) {
    // The rim of a finished feature may stick out.
    const double allowed = -*std::min_element(report.demanded.begin(), report.demanded.end());
    for (locate::MissingPlace place :
         locate::missing_material(report.shapes.part, report.shapes.blank, pose_of(report),
                                  kMostMissingPlaces, apart, 1e-6 * size)) {
      if (place.depth <= allowed) continue;
      place.depth += std::max(0.0, report.document.min_allowance);
      places.push_back(place);
    }
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const auto& a, const auto& b) { return a.depth > b.depth; });
  for (const locate::MissingPlace& place : places) {
    if (report.missing.size() == kMostMissingPlaces) break;
    const auto close = [&](const auto& other) { return norm(other.in_part - place.in_part) < apart; };
    if (std::none_of(report.missing.begin(), report.missing.end(), close)) report.missing.push_back(place);
  }
}

/// Keeps what the page prints of the document: all but its long lists.
io::LocateDocument without_lists(const io::LocateDocument& document) {
  io::LocateDocument kept;
  kept.status = document.status, kept.method = document.method;
  kept.inputs = document.inputs, kept.warnings = document.warnings;
  kept.seed = document.seed, kept.work = document.work;
  kept.placement = document.placement, kept.mirrored = document.mirrored;
  kept.upper_bound = document.upper_bound;
  kept.min_allowance = document.min_allowance, kept.shortfall = document.shortfall;
  kept.window_from_deg = document.window_from_deg, kept.window_to_deg = document.window_to_deg;
  kept.certificate_file = document.certificate_file;
  kept.certificate_intervals = document.certificate_intervals;
  kept.nc = document.nc;
  return kept;
}

}  // namespace

Result<Report> make_report(const io::LocateDocument& document, ReportShapes shapes,
                           std::vector<ReportFeature> features) {
  Report report;
  report.document = without_lists(document);
  report.shapes = std::move(shapes);
  if (document.demands)
    report.margin = document.demands->margin, report.margin_bound = document.demands->margin_bound;
  const double size = size_of(report.shapes.part);
  report.step = round_length(length_of(report.shapes.part) / kReportSamples);
  report.tolerance = std::max(std::min(kTolerance, kToleranceOfSize * size), kLargestOfSize * size);
  LEKALO_TRY(report.edges, locate::edge_allowances(report.shapes.part, report.shapes.blank, pose_of(report),
                                                   report.step, report.tolerance));
  if (features.empty()) features = contours_as_features(report.shapes.part);
  for (ReportFeature& feature : features) {
    report.features.push_back(row_of(std::move(feature), report));
    judge(report, report.features.back());
  }
  find_demands(report);
  find_missing(report);
  report.contacts_at_vertices = document.convex();
  report.contacts = document.contacts;
  const int decimals = decimals_for(std::max(size, size_of(report.shapes.blank)));
  report.proof = proof_sentences(document, decimals);
  report.assumptions = assumption_sentences(document, decimals);
  return report;
}

namespace {

std::uint32_t number_of(const std::vector<std::uint32_t>& numbers, std::size_t index) {
  return index < numbers.size() ? numbers[index] : static_cast<std::uint32_t>(index);
}

}  // namespace

std::string allowances_csv(const Report& report) {
  std::vector<std::string> names(report.edges.size());
  for (const FeatureRow& row : report.features)
    for (const std::uint32_t k : row.feature.edges)
      names[k] += (names[k].empty() ? "" : "; ") + row.feature.name;
  std::string text =
      "piece,contour,edge,s_mm,x_part,y_part,x_blank,y_blank,allowance_mm,blank_edge,feature\n";
  std::size_t edge = 0;
  for_each_contour(
      report.shapes.part, [&](std::size_t piece, std::size_t contour, const geom::Contour& edges) {
        for (std::size_t k = 0; k < edges.size(); ++k, ++edge) {
          const std::string name = io::csv_cell(names[edge]);
          for (const locate::OutlinePoint& p : report.edges[edge].samples) {
            text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", piece, contour,
                                number_of(report.shapes.part_edge_numbers, edge), p.along, p.in_part.x,
                                p.in_part.y, p.in_blank.x, p.in_blank.y, p.allowance,
                                number_of(report.shapes.blank_edge_numbers, p.blank_edge), name);
          }
        }
      });
  return text;
}

}  // namespace lekalo::draw

#include "report.hpp"

#include "lekalo/draw/report.hpp"
#include "placed_drawing.hpp"

namespace lekalo::cli {
namespace {

/// Both coordinates of a point move it by no more than this many times what one of them does.
constexpr double kOutlinePerCoordinate = 2;

Result<ReportFiles> make(const LocateOptions& o, const io::LocateDocument& document,
                         draw::ReportShapes shapes, std::vector<draw::ReportFeature> features = {}) {
  ReportFiles files;
  if (!o.drawing.empty()) {
    const bool mirrored = document.regions && document.regions->mirrored;
    Result<std::string> drawing =
        placed_drawing(o.drawing, shapes.part, shapes.blank, document.placement, mirrored);
    if (!drawing) return tl::unexpected(drawing.error());
    files.drawing = std::move(*drawing);
  }
  if (o.report.empty() && o.allowances.empty()) return files;
  const Result<draw::Report> report = draw::make_report(document, std::move(shapes), std::move(features));
  if (!report) return tl::unexpected(report.error());
  if (!o.allowances.empty()) files.allowances = draw::allowances_csv(*report);
  if (o.report.empty()) return files;
  Result<std::string> page = o.report.ends_with(".pdf")   ? draw::report_pdf(*report)
                             : o.report.ends_with(".png") ? draw::report_png(*report)
                                                          : Result<std::string>(draw::report_svg(*report));
  if (!page) return tl::unexpected(page.error());
  files.report = std::move(*page);
  return files;
}

/// Those of the demands, and one of all other edges.
std::vector<draw::ReportFeature> all_features(const io::DemandRecord& demands,
                                              const std::vector<geom::Region>& part) {
  std::size_t edges = 0;
  for (const geom::Region& region : part) {
    edges += region.outer.size();
    for (const geom::Contour& hole : region.holes) edges += hole.size();
  }
  std::vector<bool> taken(edges, false);
  std::vector<draw::ReportFeature> features;
  for (const locate::Feature& f : demands.features) {
    for (const std::uint32_t edge : f.edges) taken[edge] = true;
    draw::ReportFeature row{f.name, f.edges, f.minimum, f.target, f.maximum};
    if (f.finished) row.minimum = -*f.finished, row.maximum = *f.finished;
    features.push_back(std::move(row));
  }
  draw::ReportFeature rest{"all other edges", {}, demands.minimum, {}, {}};
  for (std::uint32_t edge = 0; edge < edges; ++edge)
    if (!taken[edge]) rest.edges.push_back(edge);
  if (!rest.edges.empty()) features.push_back(std::move(rest));
  return features;
}

bool asked_for(const LocateOptions& o) {
  return !o.report.empty() || !o.allowances.empty() || !o.drawing.empty();
}

Result<std::vector<geom::Region>> as_region(const geom::ConvexPolygon& polygon) {
  geom::Contour outer;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    outer.push_back({geom::EdgeKind::line, polygon[k], polygon[polygon.next(k)], {}});
  return geom::make_region(std::move(outer)).map([](geom::Region&& region) {
    return std::vector<geom::Region>{std::move(region)};
  });
}

}  // namespace

Result<ReportFiles> make_reports(const LocateOptions& o, const io::LocateDocument& document) {
  if (!asked_for(o)) return ReportFiles{};
  const io::RegionRecord& r = *document.regions;
  std::vector<draw::ReportFeature> features;
  if (r.demands && !r.demands->features.empty()) features = all_features(*r.demands, r.part);
  return make(o, document, {r.part, r.blank, r.part_tolerance + r.blank_tolerance, {}, {}, {}},
              std::move(features));
}

Result<ReportFiles> make_reports(const LocateOptions& o, const io::LocateDocument& document,
                                 const Contour& part, const Contour& blank) {
  if (!asked_for(o)) return ReportFiles{};
  Result<std::vector<geom::Region>> part_region = as_region(part.polygon);
  if (!part_region) return tl::unexpected(part_region.error());
  Result<std::vector<geom::Region>> blank_region = as_region(blank.polygon);
  if (!blank_region) return tl::unexpected(blank_region.error());
  return make(o, document,
              {std::move(*part_region), std::move(*blank_region),
               kOutlinePerCoordinate * (part.coordinate_error + blank.coordinate_error), part.edge_in_result,
               part.vertex_in_result, blank.edge_in_result});
}

}  // namespace lekalo::cli

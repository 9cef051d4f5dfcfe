#include "report.hpp"

#include "lekalo/io/report.hpp"

namespace lekalo::cli {
namespace {

/// Both coordinates of a point move it by no more than this many times what one of them does.
constexpr double kOutlinePerCoordinate = 2;

Result<ReportFiles> make(const LocateOptions& o, const io::LocateDocument& document,
                         io::ReportShapes shapes) {
  const Result<io::Report> report = io::make_report(document, std::move(shapes));
  if (!report) return tl::unexpected(report.error());
  ReportFiles files;
  if (!o.allowances.empty()) files.allowances = io::allowances_csv(*report);
  if (o.report.empty()) return files;
  Result<std::string> page = o.report.ends_with(".pdf")   ? io::report_pdf(*report)
                             : o.report.ends_with(".png") ? io::report_png(*report)
                                                          : Result<std::string>(io::report_svg(*report));
  if (!page) return tl::unexpected(page.error());
  files.report = std::move(*page);
  return files;
}

bool asked_for(const LocateOptions& o) { return !o.report.empty() || !o.allowances.empty(); }

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
  return make(o, document, {r.part, r.blank, r.part_tolerance + r.blank_tolerance, {}, {}, {}});
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

#include <algorithm>

#include "lekalo/draw/picture.hpp"
#include "lekalo/draw/report.hpp"
#include "lekalo/io/text/words.hpp"
#include "locate_documents.hpp"
#include "placed_drawing.hpp"

namespace lekalo::jobs {
namespace {

/// Both coordinates of a point move it by no more than this many times what one of them does.
constexpr double kOutlinePerCoordinate = 2;

std::uint32_t index_of(const std::vector<std::uint32_t>& numbers, std::uint32_t number) {
  if (numbers.empty()) return number;
  return static_cast<std::uint32_t>(std::find(numbers.begin(), numbers.end(), number) - numbers.begin());
}

draw::PictureOfRings rings_of(const LocateInputs& in, const io::LocateDocument& d) {
  const locate::ConvexOutline &part = *in.problem.part.convex, &blank = *in.problem.blank.convex;
  draw::PictureOfRings rings{part.polygon.vertices(),
                             blank.polygon.vertices(),
                             {},
                             part.vertex_numbers,
                             blank.edge_numbers,
                             {},
                             true};
  if (in.earlier) rings.start = in.earlier->placement;
  for (const locate::Touch& touch : d.contacts)
    rings.contacts.push_back({index_of(part.vertex_numbers, touch.part_edge),
                              index_of(blank.edge_numbers, touch.blank_edge), touch.multiplier});
  return rings;
}

draw::PictureOfRegions regions_of(const io::LocateDocument& d) {
  draw::PictureOfRegions regions{d.part, d.blank, d.contacts, {}, {}};
  if (d.demands) regions.margin = d.demands->margin, regions.margin_bound = d.demands->margin_bound;
  return regions;
}

Result<std::string> picture_of(const LocateJob& job, const LocateInputs& in, const io::LocateDocument& d) {
  draw::LocatePicture picture{"lekalo locate",
                              io::as_utf8(job.part.name),
                              io::as_utf8(job.blank.name),
                              d.method,
                              d.status,
                              {},
                              d.placement,
                              d.mirrored,
                              d.upper_bound,
                              d.min_allowance,
                              d.shortfall};
  if (d.convex())
    picture.outlines = rings_of(in, d);
  else
    picture.outlines = regions_of(d);
  if (job.outputs.picture == PictureForm::pdf)
    return failure(ErrorCode::usage, "a placement is drawn as SVG or PNG; reports are written as PDF too");
  return job.outputs.picture == PictureForm::svg ? draw::picture_svg(picture) : draw::picture_png(picture);
}

/// Those of the demands, and one of all other edges.
std::vector<draw::ReportFeature> all_features(const io::DemandRecord& demands,
                                              const std::vector<geom::Region>& part) {
  const std::size_t edges = geom::edges_in(part);
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

Result<std::vector<geom::Region>> as_region(const geom::ConvexPolygon& polygon) {
  geom::Contour outer;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    outer.push_back({geom::EdgeKind::line, polygon[k], polygon[polygon.next(k)], {}});
  LEKALO_TRY(geom::Region region, geom::make_region(std::move(outer)));
  return std::vector<geom::Region>{std::move(region)};
}

Result<draw::ReportShapes> shapes_of(const LocateInputs& in, const io::LocateDocument& d) {
  if (!d.convex()) return draw::ReportShapes{d.part, d.blank, d.part_tolerance + d.blank_tolerance, {}, {}};
  const locate::ConvexOutline &part = *in.problem.part.convex, &blank = *in.problem.blank.convex;
  LEKALO_TRY(auto part_region, as_region(part.polygon));
  LEKALO_TRY(auto blank_region, as_region(blank.polygon));
  return draw::ReportShapes{std::move(part_region), std::move(blank_region),
                            kOutlinePerCoordinate * (part.coordinate_error + blank.coordinate_error),
                            part.edge_numbers, blank.edge_numbers};
}

Result<std::string> page_of(const draw::Report& report, PictureForm form) {
  if (form == PictureForm::pdf) return draw::report_pdf(report);
  return form == PictureForm::png ? draw::report_png(report) : draw::report_svg(report);
}

Result<void> add_reports(const LocateOutputs& wanted, const LocateInputs& in, Located& made) {
  const bool drawing = wanted.drawing != DrawingFormat::none;
  if (!wanted.report && !drawing && !wanted.allowances) return {};
  const io::LocateDocument& d = made.document;
  LEKALO_TRY(draw::ReportShapes shapes, shapes_of(in, d));
  if (drawing) {
    LEKALO_TRY(made.drawing,
               placed_drawing(wanted.drawing, shapes.part, shapes.blank, d.placement, d.mirrored));
  }
  if (!wanted.report && !wanted.allowances) return {};
  std::vector<draw::ReportFeature> features;
  if (d.demands && !d.demands->features.empty()) features = all_features(*d.demands, d.part);
  LEKALO_TRY(const draw::Report report, draw::make_report(d, std::move(shapes), std::move(features)));
  if (wanted.allowances) made.allowances = draw::allowances_csv(report);
  if (wanted.report) {
    LEKALO_TRY(made.report, page_of(report, *wanted.report));
  }
  return {};
}

}  // namespace

Result<void> add_pictures(const LocateJob& job, const LocateInputs& in, Located& made) {
  if (job.outputs.picture) {
    LEKALO_TRY(made.picture, picture_of(job, in, made.document));
  }
  return add_reports(job.outputs, in, made);
}

}  // namespace lekalo::jobs

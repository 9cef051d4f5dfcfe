#include "shapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "lekalo/geom/region_check.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "lekalo/io/drawing/drawing.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/dxf/dxf.hpp"
#include "lekalo/io/scan/scan_file.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/shape/shape_tree.hpp"
#include "lekalo/io/svg/svg.hpp"

namespace lekalo::cli {
namespace {

/// Points of curves move by no more than this many times what their edges' coordinates do: both coordinates
/// of an end, and what an arc's centre and radius add.
constexpr double kOutlinePerCoordinate = 5;

enum class Kind { regions, tree, drawing, points, scan };

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return ending;
}

Kind kind_of(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  const std::string ending = ending_of(path);
  if (options.scan || ending == ".ply") return Kind::scan;
  if (ending == ".dxf" || ending == ".svg") return Kind::drawing;
  const auto says = [&](std::string_view word) { return bytes.find(word) != std::string_view::npos; };
  if (ending == ".json" && says("\"shape\"")) return Kind::tree;
  if (ending == ".json" && (says("\"outer\"") || says("\"pieces\""))) return Kind::regions;
  return Kind::points;
}

bool is_convex_polygon(const std::vector<geom::Region>& regions) {
  if (regions.size() != 1 || !regions[0].holes.empty()) return false;
  const geom::Contour& outer = regions[0].outer;
  for (std::size_t k = 0; k < outer.size(); ++k) {
    const geom::Edge &edge = outer[k], &next = outer[(k + 1) % outer.size()];
    if (edge.kind != geom::EdgeKind::line || geom::orientation(edge.from, edge.to, next.to) < 0) return false;
  }
  return true;
}

Result<Shape> shape_of_points(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  Result<io::ContourFile> file = io::parse_contour(bytes, path, options.units);
  if (!file) return tl::unexpected(file.error());
  geom::Ring ring;
  for (const geom::Point& p : file->points)
    if (ring.empty() || !(p == ring.back())) ring.push_back(p);
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  if (ring.size() < 3)
    return failure(ErrorCode::bad_input, fmt::format("{}: fewer than three different points", path));
  geom::Contour outer;
  for (std::size_t k = 0; k < ring.size(); ++k)
    outer.push_back({geom::EdgeKind::line, ring[k], ring[(k + 1) % ring.size()], {}});
  Result<geom::Region> region = geom::make_region(std::move(outer));
  if (!region) return failure(region.error().code, path + ": " + region.error().message);
  Shape shape;
  shape.regions.push_back(std::move(*region));
  shape.tolerance = kOutlinePerCoordinate * file->coordinate_error;
  shape.notices = std::move(file->notices);
  if (!is_convex_polygon(shape.regions))
    shape.notices.push_back(
        path + " is not convex and is taken as it is; --trim MM cuts a blank inwards to a convex one");
  return shape;
}

Result<Shape> shape_of_regions(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  Shape shape;
  Result<io::RegionFile> file = io::parse_regions(bytes, path, options.units, &shape.open);
  if (!file) return tl::unexpected(file.error());
  shape.regions = std::move(file->regions);
  shape.tolerance = kOutlinePerCoordinate * file->coordinate_error;
  return shape;
}

Result<Shape> shape_of_tree(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  Result<io::ShapeFile> file = io::parse_shape_tree(bytes, path, options.units);
  if (!file) return tl::unexpected(file.error());
  Shape shape;
  shape.regions = std::move(file->regions);
  shape.tolerance = file->tolerance;
  for (const std::uint32_t name : file->name_of_edge)
    shape.labels.push_back(name == io::kNoName ? "" : file->names[name]);
  return shape;
}

Result<Shape> shape_of_drawing(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  const Result<io::Drawing> drawing = ending_of(path) == ".svg" ? io::parse_svg(bytes, path, options.units)
                                                                : io::parse_dxf(bytes, path, options.units);
  if (!drawing) return tl::unexpected(drawing.error());
  io::DrawingOptions how;
  if (options.join) how.join_tolerance = *options.join;
  if (options.curve) how.curve_tolerance = *options.curve;
  how.take = options.layers;
  Result<io::DrawnRegions> drawn = io::make_regions(*drawing, how);
  if (!drawn) return tl::unexpected(drawn.error());
  Shape shape;
  shape.regions = std::move(drawn->regions);
  shape.tolerance = drawn->tolerance;
  for (const std::uint32_t curve : drawn->curve_of_edge)
    shape.labels.push_back(drawing->layers[drawing->curves[curve].layer].name);
  shape.notices = std::move(drawn->notices);
  return shape;
}

Result<Shape> shape_of_scan(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  io::ScanBlankOptions how;
  how.unit = options.units;
  if (options.scan) {
    how.scan = options.scan->measurement;
    how.slice = options.scan->slice;
  }
  Result<io::ScanBlank> scan = io::read_scan_blank(bytes, path, how);
  if (!scan) return tl::unexpected(scan.error());
  locate::GuaranteedBlank& blank = scan->blank;
  Shape shape;
  shape.regions = std::move(blank.regions);
  shape.notices = std::move(scan->notices);
  shape.scan = io::ScanRecord{scan->file.points.points.size(),
                              blank.proved(),
                              blank.ordered,
                              blank.guard,
                              blank.step,
                              blank.median_spacing,
                              blank.widest,
                              blank.deepest,
                              blank.loss,
                              std::move(blank.assumptions),
                              scan->unknown,
                              scan->dropped};
  return shape;
}

Result<Shape> parsed(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  switch (kind_of(bytes, path, options)) {
    case Kind::regions:
      return shape_of_regions(bytes, path, options);
    case Kind::tree:
      return shape_of_tree(bytes, path, options);
    case Kind::drawing:
      return shape_of_drawing(bytes, path, options);
    case Kind::scan:
      return shape_of_scan(bytes, path, options);
    case Kind::points:
      break;
  }
  return shape_of_points(bytes, path, options);
}

std::size_t edge_count(const std::vector<geom::Region>& regions) {
  std::size_t count = 0;
  for (const geom::Region& region : regions) {
    count += region.outer.size();
    for (const geom::Contour& hole : region.holes) count += hole.size();
  }
  return count;
}

}  // namespace

Need need_of(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  const Kind kind = kind_of(bytes, path, options);
  if (kind == Kind::scan || kind == Kind::tree) return Need::regions;
  // Polygons that the reader of convex contours reads too keep their fast path.
  const bool plain = options.layers.empty() && !options.join;
  const bool contour = kind != Kind::drawing || (plain && io::parse_contour(bytes, path, options.units));
  const Result<Shape> shape = parsed(bytes, path, options);
  // What cannot be read at all is refused by the reader that suits what is asked for.
  if (!shape && kind == Kind::drawing) return Need::outline;
  if (!shape) return kind == Kind::regions ? Need::regions : Need::convex_contour;
  if (!contour) return Need::regions;
  if (is_convex_polygon(shape->regions)) return Need::convex_contour;
  return kind == Kind::regions ? Need::regions : Need::outline;
}

Result<Shape> read_shape(std::string_view bytes, const std::string& path, const ShapeOptions& options) {
  Result<Shape> shape = parsed(bytes, path, options);
  if (!shape) return shape;
  if (const auto fault = geom::fault_of(shape->regions))
    return failure(ErrorCode::bad_input, fmt::format("{}: {}; outlines must not meet", path, *fault));
  if (shape->labels.empty()) shape->labels.assign(edge_count(shape->regions), "");
  return shape;
}

}  // namespace lekalo::cli

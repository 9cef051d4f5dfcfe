#include "lekalo/io/formats/outline_file.hpp"
#include "io/drawing/near_edges.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lekalo/base/counted.hpp"
#include "lekalo/base/limits.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/predicates.hpp"
#include "lekalo/geom/region_check.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/io/drawing/drawing_regions.hpp"
#include "lekalo/io/formats/drawing_formats.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/io/shape/shape_tree.hpp"

namespace lekalo::io {
namespace {

/// Points of curves move by no more than this many times what their edges' coordinates do: both coordinates
/// of an end, and what an arc's centre and radius add.
constexpr double kOutlinePerCoordinate = 5;

bool is_convex_polygon(const std::vector<geom::Region>& regions) {
  if (regions.size() != 1 || !regions[0].holes.empty()) return false;
  const geom::Contour& outer = regions[0].outer;
  for (std::size_t k = 0; k < outer.size(); ++k) {
    const geom::Edge &edge = outer[k], &next = outer[(k + 1) % outer.size()];
    if (edge.kind != geom::EdgeKind::line || geom::orientation(edge.from, edge.to, next.to) < 0) return false;
  }
  return true;
}

/// File indices of points equal to the one before, and of closing points: what a contour drops that is not
/// made convex by dropping collinear points.
std::vector<std::size_t> repeated_points(const geom::Ring& points) {
  std::size_t end = points.size();  // before the closing points
  while (end > 1 && points[end - 1] == points[0]) --end;
  std::vector<std::size_t> repeated;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (k >= end || points[k] == points[k - 1]) repeated.push_back(k);
  }
  return repeated;
}

Result<ReadOutline> convex_as_it_is(const ContourFile& file) {
  LEKALO_TRY(ConvexContour convex, make_convex(file));
  locate::ConvexOutline outline{convex.polygon, convex.coordinate_error, {}, {}};
  for (std::size_t k = 0; k < convex.polygon.size(); ++k) {
    outline.vertex_numbers.push_back(static_cast<std::uint32_t>(convex.file_index_of_vertex[k]));
    outline.edge_numbers.push_back(static_cast<std::uint32_t>(convex.file_edge(k)));
  }
  ReadOutline read;
  read.outline.convex = std::move(outline);
  read.notices = std::move(convex.notices);
  read.contour = ContourRecord{file.unit, file.points, std::move(convex.dropped), {}};
  return read;
}

Result<ReadOutline> convex_by_trimming(const ContourFile& file, double tolerance) {
  LEKALO_TRY(TrimmedContour trimmed, trim_to_convex(file, tolerance));
  TrimRecord record{tolerance, trimmed.loss, trimmed.polygon.vertices()};
  ReadOutline read;
  read.outline.convex = locate::ConvexOutline{std::move(trimmed.polygon), trimmed.coordinate_error, {}, {}};
  read.notices = std::move(trimmed.notices);
  read.contour = ContourRecord{file.unit, file.points, repeated_points(file.points), std::move(record)};
  return read;
}

std::size_t edge_count(const std::vector<geom::Region>& regions) {
  std::size_t count = 0;
  for (const geom::Region& region : regions) {
    count += region.outer.size();
    for (const geom::Contour& hole : region.holes) count += hole.size();
  }
  return count;
}

/// The first arc whose centre lies beyond the limits. Arcs that are nearly lines have theirs far out, also in
/// drawings that name no centre.
const geom::Edge* far_arc(const std::vector<geom::Region>& regions) {
  const auto find = [](const geom::Contour& contour) -> const geom::Edge* {
    for (const geom::Edge& edge : contour)
      if (edge.kind != geom::EdgeKind::line &&
          !(std::max(std::abs(edge.centre.x), std::abs(edge.centre.y)) <= limits::kLargestCoordinate))
        return &edge;
    return nullptr;
  };
  for (const geom::Region& region : regions) {
    if (const geom::Edge* const arc = find(region.outer)) return arc;
    for (const geom::Contour& hole : region.holes)
      if (const geom::Edge* const arc = find(hole)) return arc;
  }
  return nullptr;
}

/// Ends of lines may stick out of the material by this, mm, and by what the outline is off.
constexpr double kLinesStickOut = 1e-4;

/// Says whether no point of an edge lies further than about `slack` outside of the material. Parts of the
/// edge are halved until that is seen.
bool lies_within(const geom::RegionIndex& material, const geom::Edge& edge, double slack, std::size_t& work) {
  std::vector<geom::Edge> open{edge};
  while (!open.empty()) {
    if (work == 0) return false;
    --work;
    ask();
    const Bisected halves = bisected(open.back());
    open.pop_back();
    const double far = material.nearest(halves.middle).distance;
    const bool inside = material.contains(halves.middle);
    if (!inside && far > slack) return false;
    if ((inside && far > halves.half_length) || far + halves.half_length <= slack ||
        halves.half_length <= slack / 4)
      continue;
    open.push_back(halves.first);
    open.push_back(halves.second);
  }
  return true;
}

std::string place_of(const geom::Contour& line) {
  return fmt::format("from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) mm", line.front().from.x, line.front().from.y,
                     line.back().to.x, line.back().to.y);
}

/// Returns a sentence about lines that would change the material if they were closed. Those that lie in it
/// could only take some of it away, which a part may lack.
std::optional<std::string> what_is_missing(const DrawnRegions& drawn, bool may_lack_holes) {
  if (!drawn.doubtful.empty()) return drawn.doubtful.front();
  if (drawn.set_aside.empty() && drawn.marks.empty()) return std::nullopt;
  const geom::RegionIndex material(drawn.regions);
  const double slack = drawn.tolerance + kLinesStickOut;
  std::size_t work = kMostWork;
  const auto is_harmless = [&](const geom::Contour& line) {
    return may_lack_holes && !line.empty() &&
           std::all_of(line.begin(), line.end(),
                       [&](const geom::Edge& edge) { return lies_within(material, edge, slack, work); });
  };
  for (const SetAside& one : drawn.set_aside)
    if (!is_harmless(one.edges)) return one.sentence;
  for (const Mark& one : drawn.marks)
    if (!is_harmless(one.edges))
      return fmt::format(
          "the line {} encloses nothing and may be {}; close it, use a larger join tolerance, or "
          "take "
          "the layers without it",
          place_of(one.edges),
          may_lack_holes ? "more of the part, for it reaches out of it" : "the edge of a hole");
  return std::nullopt;
}

}  // namespace

OutlineFile::OutlineFile(std::string_view bytes, std::string name, OutlineOptions options)
    : bytes_(bytes), name_(std::move(name)), options_(std::move(options)), form_(form()) {}

OutlineFile::Form OutlineFile::form() const {
  if (options_.scan || kPlyFormat.is_named_so(name_)) return Form::scan;
  if (drawing_format_by_ending(name_) != nullptr) return Form::drawing;
  if (!kJsonFormat.is_named_so(name_)) return Form::points;
  const auto says = [&](std::string_view word) { return bytes_.find(word) != std::string_view::npos; };
  if (says("\"shape\"")) return Form::tree;
  return says("\"outer\"") || says("\"pieces\"") ? Form::regions : Form::points;
}

Result<ContourFile>& OutlineFile::points() {
  if (!points_) points_ = parse_contour(bytes_, name_, options_.units);
  return *points_;
}

Result<ReadOutline> OutlineFile::read_points() {
  LEKALO_CHECK(points());
  const ContourFile& file = *points();
  geom::Ring ring;
  for (const geom::Point& p : file.points)
    if (ring.empty() || !(p == ring.back())) ring.push_back(p);
  while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
  if (ring.size() < 3)
    return failure(ErrorCode::bad_input, fmt::format("{}: fewer than three different points", name_));
  geom::Contour outer;
  for (std::size_t k = 0; k < ring.size(); ++k)
    outer.push_back({geom::EdgeKind::line, ring[k], ring[(k + 1) % ring.size()], {}});
  auto region = geom::make_region(std::move(outer));
  if (!region) return failure(region.error().code, name_ + ": " + region.error().message);
  ReadOutline read;
  read.outline.regions.push_back(std::move(*region));
  read.outline.tolerance = kOutlinePerCoordinate * file.coordinate_error;
  read.notices = file.notices;
  if (!is_convex_polygon(read.outline.regions))
    read.notices.push_back(
        name_ + " is not convex and is taken as it is; --trim MM cuts a blank inwards to a convex one");
  return read;
}

Result<ReadOutline> OutlineFile::read_regions() const {
  ReadOutline read;
  LEKALO_TRY(RegionFile file, parse_regions(bytes_, name_, options_.units, &read.open));
  read.outline.regions = std::move(file.regions);
  read.outline.tolerance = kOutlinePerCoordinate * file.coordinate_error;
  return read;
}

Result<ReadOutline> OutlineFile::read_tree() const {
  LEKALO_TRY(ShapeFile file, parse_shape_tree(bytes_, name_, options_.units));
  ReadOutline read;
  read.outline.regions = std::move(file.regions);
  read.outline.tolerance = file.tolerance;
  for (const std::uint32_t name : file.name_of_edge)
    read.outline.labels.push_back(name == kNoName ? "" : file.names[name]);
  return read;
}

Result<ReadOutline> OutlineFile::read_drawing() const {
  LEKALO_TRY(const Drawing drawing, drawing_format_by_ending(name_)->parse(bytes_, name_, options_.units));
  // A hole that is missing would count as material, so nothing damaged is set aside here.
  if (!drawing.damaged.empty()) return failure(ErrorCode::bad_input, drawing.damaged.front());
  DrawingOptions how;
  if (options_.join) how.join_tolerance = *options_.join;
  if (options_.curve) how.curve_tolerance = *options_.curve;
  if (options_.repair) how.repair = *options_.repair;
  how.strict = options_.strict;
  how.take = options_.layers;
  LEKALO_TRY(DrawnRegions drawn, make_regions(drawing, how));
  if (auto missing = what_is_missing(drawn, options_.may_lack_holes))
    return failure(ErrorCode::bad_input, fmt::format("{}: {}", name_, *missing));
  ReadOutline read;
  read.drawing = record_of(drawing, how, drawn);
  read.outline.regions = std::move(drawn.regions);
  read.outline.tolerance = drawn.tolerance;
  for (const std::uint32_t curve : drawn.curve_of_edge)
    read.outline.labels.push_back(drawing.layers[drawing.curves[curve].layer].name);
  read.notices = std::move(drawn.notices);
  if (!drawing.texts.empty())
    read.notices.push_back(
        fmt::format("{}: {} passed over", name_, counted(drawing.texts.size(), "text is", "texts are")));
  std::vector<std::string> aside;
  for (const SetAside& one : drawn.set_aside) aside.push_back(one.sentence);
  tell_set_aside(aside, read.notices);
  return read;
}

Result<ReadOutline> OutlineFile::read_scan() const {
  ScanBlankOptions how;
  how.unit = options_.units;
  if (options_.scan) how.scan = options_.scan->measurement, how.slice = options_.scan->slice;
  LEKALO_TRY(ScanBlank scan, read_scan_blank(bytes_, name_, how));
  ReadOutline read;
  read.scan = record_of(scan, how);
  read.outline.regions = std::move(scan.blank.regions);
  read.notices = std::move(scan.notices);
  return read;
}

Result<ReadOutline>& OutlineFile::drawn() {
  if (drawn_) return *drawn_;
  switch (form_) {
    case Form::regions:
      return drawn_.emplace(read_regions());
    case Form::tree:
      return drawn_.emplace(read_tree());
    case Form::drawing:
      return drawn_.emplace(read_drawing());
    case Form::scan:
      return drawn_.emplace(read_scan());
    case Form::points:
      break;
  }
  return drawn_.emplace(read_points());
}

bool OutlineFile::is_convex(bool only_convex_will_do) {
  if (form_ == Form::scan || form_ == Form::tree) return false;
  const Result<ReadOutline>& read = drawn();
  const bool convex = read && is_convex_polygon(read->outline.regions);
  if (form_ == Form::regions) return convex;
  if (form_ == Form::points) return !read || convex || only_convex_will_do;
  if (!read) return only_convex_will_do;
  if (!convex && !only_convex_will_do) return false;
  // Drawings that the reader of convex outlines reads too.
  return options_.layers.empty() && !options_.join && points();
}

bool OutlineFile::looks_measured() {
  constexpr std::size_t kFewest = 60;  // a drawn outline of a few points may turn in any way
  if (form_ != Form::points || !points() || points()->points.size() < kFewest) return false;
  const geom::Ring& ring = points()->points;
  std::size_t bends_back = 0;
  int before = 0;
  for (std::size_t k = 0; k + 2 < ring.size(); ++k) {
    const geom::Point &a = ring[k], &b = ring[k + 1], &c = ring[k + 2];
    const bool gentle = (b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y) > 0;
    const int turn = gentle ? geom::orientation(a, b, c) : 0;
    if (turn * before < 0) ++bends_back;
    before = turn;
  }
  return 3 * bends_back >= ring.size();
}

Result<ReadOutline> OutlineFile::as_regions() {
  LEKALO_TRY(ReadOutline read, std::move(drawn()));
  drawn_.reset();
  if (const geom::Edge* const arc = far_arc(read.outline.regions))
    return failure(ErrorCode::bad_input,
                   fmt::format("{}: the arc from ({}, {}) to ({}, {}) has its centre at ({:.6g}, {:.6g}) mm; "
                               "coordinates go up to {:g} mm, so make it a line",
                               name_, arc->from.x, arc->from.y, arc->to.x, arc->to.y, arc->centre.x,
                               arc->centre.y, limits::kLargestCoordinate));
  if (const auto fault = geom::fault_of(read.outline.regions))
    return failure(ErrorCode::bad_input, fmt::format("{}: {}; outlines must not meet", name_, *fault));
  if (read.outline.labels.empty()) read.outline.labels.assign(edge_count(read.outline.regions), "");
  return read;
}

Result<ReadOutline> OutlineFile::as_convex(std::optional<double> trim) {
  LEKALO_CHECK(points());
  const ContourFile& file = *points();
  LEKALO_TRY(ReadOutline read, trim ? convex_by_trimming(file, *trim) : convex_as_it_is(file));
  read.notices.insert(read.notices.begin(), file.notices.begin(), file.notices.end());
  return read;
}

}  // namespace lekalo::io

#include "pocket_ground.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "lekalo/base/limits.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/io/shape/region_json.hpp"

namespace lekalo::jobs {
namespace {

using geom::EdgeKind;
using geom::Point;

bool is_listed(const std::vector<std::string>& layers, const std::string& label) {
  return std::find(layers.begin(), layers.end(), label) != layers.end();
}

Result<void> check_known(const std::string& name, const locate::Outline& outline,
                         const std::vector<std::string>& layers) {
  for (const std::string& layer : layers)
    if (!is_listed(outline.labels, layer))
      return failure(ErrorCode::bad_input,
                     fmt::format("{}: no outline has an edge on the layer \"{}\"", name, layer));
  return {};
}

/// The edges are the same, in one direction or the other.
bool are_same(const geom::Edge& a, const geom::Edge& b) {
  const bool arcs = a.kind != EdgeKind::line;
  if (arcs != (b.kind != EdgeKind::line) || (arcs && !(a.centre == b.centre))) return false;
  return (a.kind == b.kind && a.from == b.from && a.to == b.to) ||
         ((!arcs || a.kind != b.kind) && a.from == b.to && a.to == b.from);
}

/// The strip that lies straight out of an edge, so wide that the tool may stand on it.
Result<geom::Region> strip_beyond(const geom::Edge& edge, double width) {
  if (edge.kind == EdgeKind::line) {
    const Point way = edge.to - edge.from;
    const Point out = (-width / geom::norm(way)) * geom::perpendicular(way);
    return geom::make_region({{EdgeKind::line, edge.from, edge.from + out, {}},
                              {EdgeKind::line, edge.from + out, edge.to + out, {}},
                              {EdgeKind::line, edge.to + out, edge.to, {}},
                              {edge.kind, edge.to, edge.from, {}}});
  }
  // The material lies on the left, so the far side of a counter-clockwise arc is farther from its centre.
  const double radius = geom::arc_radius(edge);
  const double other = edge.kind == EdgeKind::arc_ccw ? radius + width : std::max(0.0, radius - width);
  const auto moved = [&](Point p) { return edge.centre + (other / radius) * (p - edge.centre); };
  const geom::Edge back = geom::reversed(edge);
  geom::Contour contour;
  if (other > 0) {
    contour = {{EdgeKind::line, edge.from, moved(edge.from), {}},
               {edge.kind, moved(edge.from), moved(edge.to), edge.centre},
               {EdgeKind::line, moved(edge.to), edge.to, {}},
               back};
  } else {
    contour = {
        {EdgeKind::line, edge.from, edge.centre, {}}, {EdgeKind::line, edge.centre, edge.to, {}}, back};
  }
  return geom::make_region(std::move(contour));
}

/// Goes through the edges of an outline in the order of their labels.
class GroundMaker {
 public:
  GroundMaker(const std::string& name, const io::ReadOutline& read, const PocketOptions& options)
      : name_(name),
        outline_(read.outline),
        said_open_(read.open),
        options_(options),
        all_(read.outline.regions) {}

  Result<PocketGround> made() {
    for (const geom::Region& region : outline_.regions) {
      LEKALO_CHECK(look_at(region.outer, true));
      for (const geom::Contour& hole : region.holes) LEKALO_CHECK(look_at(hole, false));
    }
    PocketGround ground{outline_.regions, outline_.regions, io::regions_json(outline_.regions, open_)};
    if (!open_.empty()) {
      Result<geom::BooleanResult> whole = geom::united(all_);
      if (!whole) return failure(whole.error().code, name_ + ": " + whole.error().message);
      ground.extended = std::move(whole->regions);
    }
    LEKALO_CHECK(check_reach(ground.extended));
    return ground;
  }

 private:
  /// Programs go no farther, and neither does who reads them.
  [[nodiscard]] Result<void> check_reach(const std::vector<geom::Region>& regions) const {
    constexpr double kMost = limits::kLargestProgramCoordinate;
    for (const geom::Region& region : regions) {
      const geom::Box box = geom::bounds(region.outer);
      for (const Point p : {box.low, box.high})
        if (!(std::max(std::abs(p.x), std::abs(p.y)) <= kMost))
          return failure(
              ErrorCode::bad_input,
              fmt::format("{}: the pocket reaches to ({:.9g}, {:.9g}) mm; programs go up to {:g} mm", name_,
                          p.x, p.y, kMost));
    }
    return {};
  }

  Result<void> look_at(const geom::Contour& contour, bool outer) {
    for (const geom::Edge& edge : contour) {
      const std::string& label = outline_.labels[edge_++];
      if (outer && is_listed(options_.island_layers, label))
        return failure(ErrorCode::bad_input,
                       fmt::format("{}: the island on layer \"{}\" at ({:.6g}, {:.6g}) lies in no pocket",
                                   name_, label, edge.from.x, edge.from.y));
      if (is_listed(options_.open_layers, label) || is_said_open(edge)) LEKALO_CHECK(open(edge));
    }
    return {};
  }

  [[nodiscard]] bool is_said_open(const geom::Edge& edge) const {
    return std::any_of(said_open_.begin(), said_open_.end(),
                       [&](const geom::Edge& said) { return are_same(said, edge); });
  }

  Result<void> open(const geom::Edge& edge) {
    Result<geom::Region> strip =
        strip_beyond(edge, options_.path.tool_diameter / 2 + options_.path.stock_to_leave);
    if (!strip)
      return failure(strip.error().code, fmt::format("{}: the open edge at ({:.6g}, {:.6g}): {}", name_,
                                                     edge.from.x, edge.from.y, strip.error().message));
    open_.push_back(edge);
    all_.push_back(std::move(*strip));
    return {};
  }

  const std::string& name_;
  const locate::Outline& outline_;
  const std::vector<geom::Edge>& said_open_;
  const PocketOptions& options_;
  std::size_t edge_ = 0;
  std::vector<geom::Region> all_;  ///< the pockets, then the strips beyond open edges
  std::vector<geom::Edge> open_;
};

}  // namespace

Result<io::ReadOutline> pocket_outline(const PocketJob& job) {
  io::OutlineOptions how = job.options.outline;
  if (!how.layers.empty())
    for (const auto* layers : {&job.options.island_layers, &job.options.open_layers})
      how.layers.insert(how.layers.end(), layers->begin(), layers->end());
  return io::read_outline(job.pocket.bytes, job.pocket.name, how);
}

Result<PocketGround> pocket_ground(const std::string& name, const io::ReadOutline& outline,
                                   const PocketOptions& options) {
  for (const auto* layers : {&options.island_layers, &options.open_layers})
    LEKALO_CHECK(check_known(name, outline.outline, *layers));
  return GroundMaker(name, outline, options).made();
}

}  // namespace lekalo::jobs

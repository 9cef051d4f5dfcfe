#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "arc_fit.hpp"
#include "floz_level.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/mill/fragments.hpp"
#include "level_path.hpp"

namespace lekalo::mill {
namespace {

using geom::Point;
using geom::Region;
using Kind = PathMove::Kind;
constexpr double kOperandError = 1e-9;  // mm, of offsets that are combined again

Result<void> check(const PocketOptions& o) {
  const auto outside = [](double v, double low, double high) { return !(v >= low && v <= high); };
  const auto wrong = [](const char* what, double v, const char* wanted) {
    return failure(ErrorCode::bad_input, fmt::format("a {} of {:g}: it is to be {}", what, v, wanted));
  };
  if (outside(o.tool_diameter, 0.01, 1e4)) return wrong("tool diameter", o.tool_diameter, "0.01 to 10000 mm");
  if (outside(o.step_over, 0.01, 0.5)) return wrong("step-over", o.step_over, "0.01 to 0.5 of the diameter");
  if (outside(o.stock_to_leave, 0, 1e4)) return wrong("stock to leave", o.stock_to_leave, "0 to 10000 mm");
  if (outside(o.depth, 1e-3, 1e4)) return wrong("depth", o.depth, "0.001 to 10000 mm");
  if (outside(o.floor_stock, 0, o.depth - 1e-3))
    return wrong("stock to leave on the floor", o.floor_stock, "at least 0.001 mm less than the depth");
  if (outside(o.step_down, 0, 1e4)) return wrong("step down", o.step_down, "0 to 10000 mm");
  if (o.step_down > 0 && o.depth / o.step_down > 1000)
    return wrong("step down", o.step_down, "a thousandth of the depth at least");
  if (outside(o.rest_of, 0, 1e4) || (o.rest_of > 0 && !(o.rest_of > o.tool_diameter)))
    return wrong("diameter of the tool before", o.rest_of, "larger than that of this tool");
  if (outside(o.safe_height, 1e-3, 1e4)) return wrong("safe height", o.safe_height, "0.001 to 10000 mm");
  if (outside(o.ramp_angle, 1e-3, 0.8)) return wrong("ramp angle", o.ramp_angle, "0.001 to 0.8 rad");
  if (outside(o.sampling, 1e-3, 1e4)) return wrong("sampling step", o.sampling, "0.001 to 10000 mm");
  if (outside(o.trace_step, 0, 1e4)) return wrong("step of the trace", o.trace_step, "0 to 10000 mm");
  if (outside(o.fit_tolerance, 1e-5, 1)) return wrong("fit tolerance", o.fit_tolerance, "0.00001 to 1 mm");
  return {};
}

bool line_inside(const geom::RegionIndex& allowed, Point a, Point b) {
  constexpr double kSlack = 1e-6;  // mm: the path runs on the boundary itself
  const double whole = norm(b - a);
  for (double at = 0; at < whole;) {
    const Point p = a + (at / whole) * (b - a);
    const double off = allowed.nearest(p).distance;
    if (!allowed.contains(p) && off > kSlack) return false;
    at += std::max(off, 0.02);  // what is nearer to the boundary than its distance is on the same side
  }
  return true;
}

/// The level's path again, deeper; from its end to its beginning through what is cut where the way is
/// straight.
void add_level(const PocketPath& level, double top, const geom::RegionIndex& allowed, double safe_height,
               PocketPath& path) {
  const auto first_down = static_cast<std::size_t>(
      std::find_if(level.moves.begin(), level.moves.end(), [](const PathMove& m) { return m.z <= 0; }) -
      level.moves.begin());
  std::size_t begin = 0;
  if (top < 0 && !path.moves.empty()) {
    while (!path.moves.empty() && path.moves.back().z > 0) path.moves.pop_back();
    const Point start = level.moves[first_down].to, at = path.moves.back().to;
    if (line_inside(allowed, at, start)) {
      path.moves.push_back({Kind::link, start, path.moves.back().z});
    } else {
      path.moves.push_back({Kind::rapid, at, safe_height});
      path.moves.push_back({Kind::rapid, start, safe_height});
      path.moves.push_back({Kind::plunge, start, top});
    }
    begin = first_down + 1;
  }
  for (std::size_t i = begin; i < level.moves.size(); ++i) {
    PathMove move = level.moves[i];
    if (move.z <= 0) move.z += top;
    path.moves.push_back(move);
  }
}

}  // namespace

Result<std::vector<Region>> places_to_cut(const std::vector<Region>& pockets, const PocketOptions& o) {
  if (auto good = check(o); !good) return tl::unexpected(good.error());
  const double radius = o.tool_diameter / 2;
  auto allowed = geom::offset(pockets, -(radius + o.stock_to_leave));
  if (!allowed) return tl::unexpected(allowed.error());
  if (allowed->regions.empty())
    return failure(
        ErrorCode::bad_input,
        fmt::format("a tool of {:g} mm that leaves {:g} mm on the walls fits nowhere in this pocket",
                    o.tool_diameter, o.stock_to_leave));
  if (!(o.rest_of > 0)) return std::move(allowed->regions);
  // Cut already: where the larger tool's middle may be, and as far about it as this tool's disc stays in that
  // one's. Along walls the two end alike; what is thinner than kThin there is rounding.
  constexpr double kThin = 2e-3;  // mm
  const auto larger = geom::offset(pockets, -(o.rest_of / 2 + o.stock_to_leave));
  if (!larger) return tl::unexpected(larger.error());
  const auto cut = geom::offset(larger->regions, o.rest_of / 2 - radius + kThin);
  if (!cut) return tl::unexpected(cut.error());
  const auto left = geom::combine(allowed->regions, cut->regions, geom::BooleanOperation::subtract,
                                  allowed->edge_error + cut->edge_error);
  if (!left) return tl::unexpected(left.error());
  // Some of what is cut beside it, so that the tool comes from there.
  const auto grown = geom::offset(left->regions, 0.25 * radius);
  if (!grown) return tl::unexpected(grown.error());
  auto places = geom::combine(grown->regions, allowed->regions, geom::BooleanOperation::intersect,
                              allowed->edge_error + grown->edge_error);
  if (!places) return tl::unexpected(places.error());
  if (places->regions.empty())
    return failure(ErrorCode::bad_input,
                   fmt::format("the tool of {:g} mm before has left nothing for one of {:g} mm", o.rest_of,
                               o.tool_diameter));
  return std::move(places->regions);
}

Result<PocketPath> pocket_path(const std::vector<Region>& pockets, const PocketOptions& o) {
  auto allowed = places_to_cut(pockets, o);
  if (!allowed) return tl::unexpected(allowed.error());
  const double depth = o.depth - o.floor_stock;
  const double levels = o.step_down > 0 ? std::ceil(depth / o.step_down * (1 - 1e-12)) : 1;
  PocketOptions one = o;
  one.depth = depth / levels;
  std::vector<Region> pieces = *allowed;
  const bool source = o.method != Method::fronts;
  if (source && !o.whole) {
    const auto fragments = convex_fragments(pockets);
    if (!fragments) return tl::unexpected(fragments.error());
    pieces.clear();
    for (const Region& fragment : *fragments) {
      const auto part = geom::combine(*allowed, {fragment}, geom::BooleanOperation::intersect, kOperandError);
      if (!part) return tl::unexpected(part.error());
      pieces.insert(pieces.end(), part->regions.begin(), part->regions.end());
    }
  }
  PocketPath whole;
  for (const Region& region : pieces) {
    const auto level = source ? floz_level(region, one) : level_path(region, one);
    if (!level) return tl::unexpected(level.error());
    const geom::RegionIndex index({region});
    PocketPath path;
    for (double k = 0; k < levels; ++k) add_level(*level, -k * one.depth, index, o.safe_height, path);
    whole.fronts += level->fronts;
    whole.moves.insert(whole.moves.end(), path.moves.begin(), path.moves.end());
  }
  return fitted(whole, o.fit_tolerance);
}

}  // namespace lekalo::mill

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "cleared.hpp"
#include "lekalo/base/stop.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/mill/fragments.hpp"
#include "level_path.hpp"
#include "mill/fragment/floz_level.hpp"
#include "mill/front/cleared_grid.hpp"
#include "mill/path/allowed_places.hpp"
#include "mill/path/arc_fit.hpp"
#include "mill/path/edge_path.hpp"

namespace lekalo::mill {
namespace {

using geom::Point;
using geom::Region;
using Kind = PathMove::Kind;
constexpr double kOperandError = 1e-9;  // mm, of offsets that are combined again

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

/// The starts that are chosen, each for the piece whose spiral begins there.
Result<std::vector<std::optional<Point>>> starts_of(const std::vector<Region>& pieces,
                                                    const PocketOptions& o) {
  constexpr double kSlack = 1e-6;  // mm: a start on a border is in one of its pieces
  std::vector<std::optional<Point>> starts(pieces.size());
  for (const Point p : o.starts) {
    std::size_t i = 0;
    for (; i < pieces.size(); ++i)
      if (const geom::RegionIndex index({pieces[i]});
          index.contains(p) || index.nearest(p).distance <= kSlack)
        break;
    if (i == pieces.size())
      return failure(
          ErrorCode::bad_input,
          fmt::format("the start ({:g}, {:g}) is no place to cut: the tool's middle has to keep {:g} "
                      "mm from the walls",
                      p.x, p.y, o.tool_diameter / 2 + o.stock_to_leave));
    if (starts[i])
      return failure(ErrorCode::bad_input,
                     fmt::format("the starts ({:g}, {:g}) and ({:g}, {:g}) lie in the place of one spiral: "
                                 "leave one of them out",
                                 starts[i]->x, starts[i]->y, p.x, p.y));
    starts[i] = p;
  }
  return starts;
}

double level_count(const PocketOptions& o) {
  return o.step_down > 0 ? std::ceil((o.depth - o.floor_stock) / o.step_down * (1 - 1e-12)) : 1;
}

/// The path of one piece of places, put together level by level.
class Levels {
 public:
  /// \param all_cut  a level's plan leaves nothing of the places
  Levels(const Region& places, bool all_cut, double safe_height, double tool_radius)
      : places_{places},
        limit_(places_),
        all_cut_(all_cut),
        safe_height_(safe_height),
        tool_radius_(tool_radius) {}

  /// Adds the plan of a level, which is made for one at the stock's face, `top` below it. From the end of the
  /// level above to the beginning of this one the tool goes at depth if the level above is all cut.
  void add(const PocketPath& plan, double top) {
    const auto first_down = static_cast<std::size_t>(
        std::find_if(plan.moves.begin(), plan.moves.end(), [](const PathMove& m) { return m.z <= 0; }) -
        plan.moves.begin());
    std::size_t begin = 0;
    if (!path_.moves.empty()) {
      while (path_.moves.back().z > 0) path_.moves.pop_back();
      const Point start = plan.moves[first_down].to, at = path_.moves.back().to;
      const double z = path_.moves.back().z;
      const std::vector<Point> corners = all_cut_ ? way(at, start) : std::vector<Point>{};
      for (const Point corner : corners) path_.moves.push_back({Kind::link, corner, z});
      if (corners.empty()) {
        path_.moves.push_back({Kind::rapid, at, safe_height_});
        path_.moves.push_back({Kind::rapid, start, safe_height_});
        path_.moves.push_back({Kind::plunge, start, top});
      }
      begin = first_down;
    }
    for (std::size_t i = begin; i < plan.moves.size(); ++i) {
      ask();
      PathMove move = plan.moves[i];
      if (move.z <= 0) move.z += top;
      const bool stays = !path_.moves.empty() && move.shape == geom::EdgeKind::line &&
                         path_.moves.back().to == move.to && path_.moves.back().z == move.z;
      if (!stays) path_.moves.push_back(move);
    }
  }

  [[nodiscard]] const std::vector<PathMove>& moves() const { return path_.moves; }

 private:
  /// Corners of a way among the places, all of which are cut on the level above; none where there is no way.
  std::vector<Point> way(Point from, Point to) {
    if (line_inside(limit_, from, to)) return {to};
    if (!grid_) grid_.emplace(Growth{{}, {places_}}, tool_radius_);
    std::vector<Point> corners = grid_->way(from, to);
    Point last = from;
    for (const Point corner : corners) {
      if (!line_inside(limit_, last, corner)) return {};
      last = corner;
    }
    return corners;
  }

  std::vector<Region> places_;
  geom::RegionIndex limit_;
  bool all_cut_;
  double safe_height_, tool_radius_;
  std::optional<ClearedGrid> grid_;
  PocketPath path_;
};

}  // namespace

double level_depth(const PocketOptions& o) { return (o.depth - o.floor_stock) / level_count(o); }

std::vector<EarlierCut> cuts_of(const PocketPath& path, double tool_diameter) {
  std::vector<EarlierCut> cuts;
  Point at;
  double z = 1;
  for (const PathMove& move : path.moves) {
    const double high = std::max(z, move.z);
    geom::Edge edge{geom::EdgeKind::line, at, move.to, {}};
    if (move.shape != geom::EdgeKind::line) edge = arc_of(move, at);
    if (high <= 0) {
      const double pieces = edge.kind == geom::EdgeKind::line ? 1 : 4;
      for (double i = 0; i < pieces; ++i)
        cuts.push_back(
            {pieces > 1 ? part_of(edge, i / pieces, (i + 1) / pieces) : edge, -high, tool_diameter});
    } else if (move.z <= 0 && at == move.to) {
      cuts.push_back({{geom::EdgeKind::line, at, at, {}}, -move.z, tool_diameter});
    }
    at = move.to, z = move.z;
  }
  return cuts;
}

Result<PocketPath> pocket_path(const std::vector<Region>& pockets, const PocketOptions& o,
                               const std::vector<EarlierCut>& before, const ProgressListener& progress) {
  LEKALO_TRY(auto allowed, allowed_places(pockets, o));
  const double levels = level_count(o);
  PocketOptions one = o;
  one.depth = level_depth(o);
  std::vector<Region> pieces = allowed;
  const bool source = o.method != Method::fronts;
  if (source && !before.empty())
    return failure(ErrorCode::bad_input, "the source's method knows no tool that was here before");
  if (source && !o.whole) {
    LEKALO_TRY(const auto fragments, convex_fragments(pockets));
    pieces.clear();
    for (const Region& fragment : fragments) {
      LEKALO_TRY(const auto part,
                 geom::combine(allowed, {fragment}, geom::BooleanOperation::intersect, kOperandError));
      pieces.insert(pieces.end(), part.regions.begin(), part.regions.end());
    }
  }
  // Each level has its own cleared places; levels that begin alike share a plan.
  std::vector<std::vector<Region>> cleared;
  for (double k = 1; k <= levels; ++k) {
    LEKALO_TRY(auto places, cleared_places(before, k * one.depth, o.tool_diameter / 2));
    cleared.push_back(std::move(places));
  }
  LEKALO_TRY(const auto starts, starts_of(pieces, o));
  double plans = 0;
  for (std::size_t k = 0; k < cleared.size(); ++k) plans += k == 0 || cleared[k] != cleared[k - 1] ? 1 : 0;
  const double to_plan = plans * geom::area(pieces);
  double planned = 0, told = 0;
  const AreaListener tell = [&](double mm2) {
    told = std::max(told, std::min(1.0, (planned + mm2) / to_plan));
    if (progress) progress({static_cast<std::uint64_t>(told * to_plan), told});
  };
  PocketPath whole;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Region& region = pieces[i];
    Levels path(region, !source, o.safe_height, o.tool_diameter / 2);
    Result<PocketPath> plan;
    for (std::size_t k = 0; k < cleared.size(); ++k) {
      if (k == 0 || cleared[k] != cleared[k - 1]) {
        LEKALO_TRY(const auto parts, divided(region, cleared[k]));
        plan = parts.left.empty() ? Result<PocketPath>(PocketPath{})
               : source           ? floz_level(region, one, starts[i])
                                  : level_path(region, one, parts.cleared, parts.left, tell);
        LEKALO_CHECK(plan);
        planned += geom::area(region);
        tell(0);
        whole.fronts += plan->fronts;
      }
      if (!plan->moves.empty()) path.add(*plan, -static_cast<double>(k) * one.depth);
    }
    whole.moves.insert(whole.moves.end(), path.moves().begin(), path.moves().end());
  }
  if (whole.moves.empty())
    return failure(ErrorCode::bad_input,
                   fmt::format("the tools before have left nothing for one of {:g} mm", o.tool_diameter));
  return fitted(whole, o.fit_tolerance);
}

}  // namespace lekalo::mill

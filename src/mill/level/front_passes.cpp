#include "front_passes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "lekalo/base/stop.hpp"
#include "mill/front/step_law.hpp"
#include "mill/path/edge_path.hpp"
#include "wall_way.hpp"

namespace lekalo::mill {

using geom::Edge;
using geom::Point;
using geom::Region;
using Kind = PathMove::Kind;

namespace {

constexpr double kSubtree = 0.05;  // mm of way for a mm of fronts that wait for one

/// The edges of a front in the direction of travel.
std::vector<Edge> along(const Front& front, bool back) {
  return back ? geom::reversed(front.edges) : front.edges;
}

}  // namespace

FrontPasses::FrontPasses(const Piece& piece, ToolMotion& tool, const PocketOptions& o,
                         const AreaListener& listener)
    : piece_(piece),
      tool_(tool),
      listener_(listener),
      law_{o.tool_diameter / 2, o.step_over * o.tool_diameter, piece.strip, straight_pass_angle(o.step_over)},
      either_way_(o.direction == Direction::any) {}

Result<void> FrontPasses::grow_from(const std::vector<Region>& start) {
  LEKALO_TRY(growth_, grow(piece_.allowed.index, piece_.fields.regions, piece_.narrow.regions, start, law_,
                           [this](double mm2) { listener_(planned_ + mm2); }));
  planned_ += geom::area(reached());
  count_ += fronts().size();
  tool_.set_growth(growth_);
  waiting_.assign(fronts().size(), 0.0);
  for (std::size_t i = fronts().size(); i-- > 0;) {
    waiting_[i] += length_of(fronts()[i].edges);
    if (!fronts()[i].parents.empty()) waiting_[fronts()[i].parents.front()] += waiting_[i];
  }
  return {};
}

Point FrontPasses::first_direction(Point centre, double disc) const {
  double least = std::numeric_limits<double>::infinity();
  Point best{1, 0};
  for (std::size_t i = 0; i < fronts().size() && fronts()[i].layer == 1; ++i)
    for (const Point p : {fronts()[i].edges.front().from, fronts()[i].edges.back().to}) {
      const double far = norm(p - centre), off = std::abs(far - disc) + kSubtree * waiting_[i];
      if (off < least && far > 0) least = off, best = (1 / far) * (p - centre);
    }
  return best;
}

void FrontPasses::cut_all() {
  std::vector<std::size_t> all(fronts().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  cut_all(all);
}

void FrontPasses::cut_all(const std::vector<std::size_t>& among) {
  while (const auto front = next(among)) {
    ask();
    cut(fronts()[*front]);
    tool_.set_done(*front);
  }
}

/// Chooses a near front, and of two near ones the one that fewer wait for, so that what is small is not left
/// behind.
std::optional<std::size_t> FrontPasses::next(const std::vector<std::size_t>& among) const {
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t i : among) {
    const Front& f = fronts()[i];
    if (tool_.is_done(i) ||
        !std::all_of(f.parents.begin(), f.parents.end(), [&](std::size_t p) { return tool_.is_done(p); }))
      continue;
    const double d = std::min(norm(f.edges.front().from - tool_.at()), norm(f.edges.back().to - tool_.at())) +
                     kSubtree * waiting_[i];
    if (d < least) least = d, best = i;
  }
  return best;
}

void FrontPasses::cut(const Front& front) {
  if (front.closed) return cut_ring(front);
  if (front.loop) return cut_loop(front);
  if (front.slot) return cut_slot(front);
  cut_across(front);
}

/// Cuts from wall to wall, beginning at the nearer one.
void FrontPasses::cut_across(const Front& front) {
  const Point begin = front.edges.front().from, end = front.edges.back().to;
  const bool back = either_way_ && norm(end - tool_.at()) < norm(begin - tool_.at());
  const Front given = begun_like_before(front, back);
  const geom::RegionIndex cut_before = before(front);
  std::vector<Edge> edges =
      pass_along(given, back, {piece_.fields.index, piece_.allowed.index, piece_.narrow.index, piece_.strip},
                 cut_before, law_.step);
  if (!std::all_of(edges.begin(), edges.end(), [&](const Edge& edge) { return tool_.is_inside(edge); }))
    edges = along(given, back);
  tool_.link(edges.front().from, cut_before);
  tool_.go(Kind::cut, edges);
  // The corner lies where the front itself meets the wall.
  Point corner = back ? end : begin;
  for (const Edge& edge : along(given, back)) {
    if (piece_.fields.index.nearest(place_at(edge, 0.5)).distance > 1e-6) break;
    corner = edge.to;
  }
  passes_.push_back({edges.front().from, corner, tool_.at()});
}

/// The pass before may have left the wall before it came to this front; then this one begins where that
/// began.
Front FrontPasses::begun_like_before(const Front& front, bool back) const {
  Front given = front;
  const Point begin = back ? front.edges.back().to : front.edges.front().from;
  if (!(norm(begin - tool_.at()) > 1e-3)) return given;
  for (const Pass& pass : passes_) {
    if (!(norm(pass.corner - begin) < 1e-2)) continue;
    const auto wall = way_along_wall(piece_.fields.index, pass.from, begin, kWallWay * law_.step);
    if (!wall) continue;
    const std::vector<Edge> more = back ? geom::reversed(*wall) : *wall;
    given.edges.insert(back ? given.edges.end() : given.edges.begin(), more.begin(), more.end());
    break;
  }
  return given;
}

/// Cuts a ring, beginning at its place nearest to what is cut before. Where no place is near, the tool comes
/// in over a ramp, and goes over the ramp's stretch again at the end.
void FrontPasses::cut_ring(const Front& front) {
  const geom::RegionIndex cut_before = before(front);
  const std::vector<Point> at = places_on(front.edges, 0.1 * law_.tool_radius);
  std::size_t start = 0;
  double gap = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < at.size(); ++i) {
    const auto near = cut_before.nearest(at[i]);
    const double here = near.distance + 0.01 * norm(near.point - tool_.at());
    if (here < gap) gap = here, start = i;
  }
  const std::size_t n = at.size() - 1;
  const auto leaving = cut_before.nearest(at[start]);
  // A short ring needs no ramp: nearly all of what it goes round is cut from outside of it.
  const bool ramped = leaving.distance >= 0.05 * law_.tool_radius && length_of(front.edges) > 6 * law_.step;
  const double ramp = ramped ? 3 * law_.step : 0;
  tool_.link(leaving.point, cut_before);
  double gone = 0;
  for (std::size_t k = 1; gone < ramp || k <= n; ++k) {
    const Point q = at[(start + k) % n];
    gone += norm(q - at[(start + k - 1) % n]);
    const double share = gone < ramp ? gone / ramp : 1;
    const Point p = share < 1 ? cut_before.nearest(q).point : q;
    tool_.go(Kind::cut, p + share * (q - p));
  }
  for (std::size_t k = 1; k <= n && ramped; ++k) {
    const Point q = at[(start + k) % n];
    tool_.go(Kind::cut, q);
    if (norm(q - at[start]) > ramp) break;
  }
  passes_.push_back({tool_.at(), tool_.at(), tool_.at()});
}

/// Cuts one loop of a trochoid, beginning at the side where the one before ended.
void FrontPasses::cut_loop(const Front& front) {
  const bool back =
      either_way_ && norm(front.left_lead.front() - tool_.at()) < norm(front.right_lead.front() - tool_.at());
  const std::vector<Point>& lead = back ? front.left_lead : front.right_lead;
  const double far = norm(lead.front() - tool_.at());
  // The tool goes straight across what the loop before has cut, if there is only that to cross.
  if (far < 3 * arc_radius(front.edges.front()) && tool_.is_inside(tool_.at(), lead.front())) {
    if (far > 1e-6) tool_.go(Kind::link, lead.front());
  } else {
    tool_.link(lead.front());
  }
  for (std::size_t i = 1; i < lead.size(); ++i) tool_.go(Kind::cut, lead[i]);
  tool_.go(Kind::cut, along(front, back));
  passes_.push_back({lead.back(), lead.back(), tool_.at()});
  loop_places_.push_back(front.edges.front().centre);
}

void FrontPasses::cut_slot(const Front& front) {
  tool_.link(front.edges.front().from);
  for (const Edge& edge : front.edges) {
    tool_.go(Kind::slot, edge);
    loop_places_.push_back(tool_.at());
  }
}

std::vector<Point> FrontPasses::ends() const {
  std::vector<Point> ends;
  ends.reserve(passes_.size());
  for (const Pass& pass : passes_) ends.push_back(pass.to);
  return ends;
}

}  // namespace lekalo::mill

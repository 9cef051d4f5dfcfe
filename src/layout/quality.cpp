#include "quality.hpp"

#include <algorithm>
#include <cstdint>

#include "lekalo/geom/wide_product.hpp"
#include "lekalo/phi/outline_relation.hpp"

namespace lekalo::layout {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Int128;
using geom::sign;

/// The point from + (part / whole) along: a grid point (part 0, whole 1), or where two edges cross. |along| <
/// 2^42, whole < 2^85, |part| < 2^86.
struct FractionPoint {
  GridPoint from, along;
  Int128 part = 0, whole = 1;

  [[nodiscard]] geom::Point rounded() const noexcept {
    const double share = static_cast<double>(part) / static_cast<double>(whole);
    return {static_cast<double>(from.x) + share * static_cast<double>(along.x),
            static_cast<double>(from.y) + share * static_cast<double>(along.y)};
  }
};

/// Returns the sign of q's x (y) less a grid point's; the numbers stay below 2^127.
int compare_x(const FractionPoint& q, GridPoint p) noexcept {
  return sign(q.whole * (q.from.x - p.x) + q.part * q.along.x);
}
int compare_y(const FractionPoint& q, GridPoint p) noexcept {
  return sign(q.whole * (q.from.y - p.y) + q.part * q.along.y);
}
/// Says on which side of the line a b the point q lies.
int turn(GridPoint a, GridPoint b, const FractionPoint& q) noexcept {
  return geom::sign_of_sum(q.whole, cross(b - a, q.from - a), q.part, cross(b - a, q.along));
}

struct Edge {
  GridPoint before, from, to;
};

template <class Visit>
void visit_edges(const GridRegion& region, Visit&& visit) {
  for (std::size_t l = 0; l < region.loops(); ++l) {
    const std::uint32_t begin = region.loop_starts[l], end = region.loop_starts[l + 1];
    GridPoint before = region.points[end - 2], from = region.points[end - 1];
    for (std::uint32_t i = begin; i < end; ++i) {
      visit(Edge{before, from, region.points[i]});
      before = from;
      from = region.points[i];
    }
  }
}

/// One outline around a point: all of it is material, none of it is, or what lies to the left of an edge or
/// corner there.
struct Surroundings {
  bool on_boundary = false, inside = false;
  GridPoint first, last;  ///< directions; material lies counter-clockwise from first to last
};

Surroundings surroundings(const GridRegion& region, const FractionPoint& q) {
  Surroundings found;
  visit_edges(region, [&](const Edge& edge) {
    if (found.on_boundary) return;
    const int from_y = compare_y(q, edge.from), to_y = compare_y(q, edge.to);
    if (from_y * to_y > 0) return;
    const int from_x = compare_x(q, edge.from), to_x = compare_x(q, edge.to);
    const bool level = from_y == 0 && to_y == 0;
    const int side = level ? 0 : turn(edge.from, edge.to, q);
    if (side == 0 && from_x * to_x <= 0) {
      // The edge that begins at the point tells.
      if (to_x == 0 && to_y == 0) return;
      found.on_boundary = true;
      found.first = edge.to - edge.from;
      found.last = from_x == 0 && from_y == 0 ? edge.before - edge.from : edge.from - edge.to;
      return;
    }
    // The ray goes to the right, and an end level with q counts as above it.
    if ((from_y > 0) != (to_y > 0) && (side > 0) == (to_y <= 0)) found.inside = !found.inside;
  });
  return found;
}

/// Says whether points just beyond q in direction d are material.
/// \pre no edge at q runs along d
bool is_material(const Surroundings& s, GridPoint d) noexcept {
  if (!s.on_boundary) return s.inside;
  const bool after_first = cross(s.first, d) > 0, before_last = cross(d, s.last) > 0;
  return cross(s.first, s.last) < 0 ? after_first || before_last
                                    : after_first && (before_last || cross(s.first, s.last) == 0);
}

bool upper(GridPoint d) noexcept { return d.y > 0 || (d.y == 0 && d.x > 0); }

/// Returns a direction between a and the next one counter-clockwise, b; any direction where they are the
/// same.
GridPoint between(GridPoint a, GridPoint b) noexcept {
  const int turn_of = sign(cross(a, b));
  // The sum is between the two, whatever their lengths.
  if (turn_of > 0) return a + b;
  if (turn_of == 0 && dot(a, b) > 0) return -a;
  // The two are half a turn or more apart.
  return {-a.y, a.x};
}

/// Step 4 of docs/design/layout-check.md: says whether discs of the set that is searched for touch q.
class Corner {
 public:
  Corner(const std::vector<const GridRegion*>& inside, const std::vector<const GridRegion*>& without)
      : inside_(inside), without_(without) {}

  bool begins_at(const FractionPoint& q) {
    around_.clear();
    rays_.clear();
    for (const GridRegion* region : inside_) {
      const Surroundings s = surroundings(*region, q);
      if (!s.on_boundary && !s.inside) return false;
      add(s);
    }
    for (const GridRegion* region : without_) {
      const Surroundings s = surroundings(*region, q);
      if (!s.on_boundary && s.inside) return false;
      add(s);
    }
    if (rays_.empty()) return true;
    std::sort(rays_.begin(), rays_.end(),
              [](GridPoint a, GridPoint b) { return upper(a) != upper(b) ? upper(a) : cross(a, b) > 0; });
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const GridPoint a = rays_[i], b = rays_[i + 1 == rays_.size() ? 0 : i + 1];
      if (i + 1 < rays_.size() && cross(a, b) == 0 && dot(a, b) > 0) continue;
      if (holds(between(a, b))) return true;
    }
    return false;
  }

 private:
  void add(const Surroundings& s) {
    around_.push_back(s);
    if (s.on_boundary) rays_.insert(rays_.end(), {s.first, s.last});
  }
  [[nodiscard]] bool holds(GridPoint d) const noexcept {
    for (std::size_t i = 0; i < around_.size(); ++i)
      if (is_material(around_[i], d) != (i < inside_.size())) return false;
    return true;
  }

  const std::vector<const GridRegion*>& inside_;
  const std::vector<const GridRegion*>& without_;
  std::vector<Surroundings> around_;
  std::vector<GridPoint> rays_;
};

}  // namespace

std::optional<geom::Point> common_corner(const std::vector<const GridRegion*>& inside,
                                         const std::vector<const GridRegion*>& without) {
  GridBox window = bounds(*inside.front());
  for (const GridRegion* region : inside) {
    const GridBox box = bounds(*region);
    window = {{std::max(window.low.x, box.low.x), std::max(window.low.y, box.low.y)},
              {std::min(window.high.x, box.high.x), std::min(window.high.y, box.high.y)}};
  }
  if (window.low.x >= window.high.x || window.low.y >= window.high.y) return std::nullopt;
  struct Near {
    Edge edge;
    GridBox box;
    std::size_t outline;
  };
  std::vector<Near> near;
  std::size_t outline = 0;
  for (const auto* list : {&inside, &without})
    for (const GridRegion* region : *list) {
      visit_edges(*region, [&](const Edge& edge) {
        const GridBox box = geom::box_of(edge.from, edge.to);
        if (boxes_meet(box, window)) near.push_back({edge, box, outline});
      });
      ++outline;
    }
  Corner corner(inside, without);
  for (const Near& a : near) {
    const FractionPoint q{a.edge.from, {}, 0, 1};
    if (geom::boxes_meet({a.edge.from, a.edge.from}, window) && corner.begins_at(q)) return q.rounded();
  }
  for (std::size_t i = 0; i < near.size(); ++i)
    for (std::size_t j = i + 1; j < near.size(); ++j) {
      const Edge &a = near[i].edge, &b = near[j].edge;
      if (near[i].outline == near[j].outline || !boxes_meet(near[i].box, near[j].box)) continue;
      if (geom::turn(a.from, a.to, b.from) * geom::turn(a.from, a.to, b.to) >= 0 ||
          geom::turn(b.from, b.to, a.from) * geom::turn(b.from, b.to, a.to) >= 0)
        // Crossings in a vertex are looked at already.
        continue;
      const GridPoint along = a.to - a.from, other = b.to - b.from;
      Int128 whole = cross(along, other), part = cross(b.from - a.from, other);
      if (whole < 0) whole = -whole, part = -part;
      const FractionPoint q{a.from, along, part, whole};
      if (corner.begins_at(q)) return q.rounded();
    }
  return std::nullopt;
}

std::optional<geom::Point> lacks_quality(const Part& part, const Placement& placement,
                                         const GridRegion& outline, const QualityZone& zone) {
  const GridRegion& of_zone = zone.outline.polygon;
  const bool by_part = part.quality > zone.quality;
  const bool by_area = std::any_of(part.areas.begin(), part.areas.end(),
                                   [&](const PartArea& area) { return area.quality > zone.quality; });
  if ((!by_part && !by_area) || !phi::interiors_meet(outline, of_zone)) return std::nullopt;
  std::vector<GridRegion> content, demanding;
  for (const PartArea& area : part.areas)
    (area.quality > zone.quality ? demanding : content)
        .push_back(geom::moved(geom::turned(area.outline.polygon, placement.rotation, placement.mirrored),
                               placement.at));
  for (const GridRegion& area : demanding)
    if (const auto at = common_corner({&outline, &of_zone, &area}, {})) return at;
  if (!by_part) return std::nullopt;
  std::vector<const GridRegion*> without;
  for (const GridRegion& area : content) without.push_back(&area);
  return common_corner({&outline, &of_zone}, without);
}

}  // namespace lekalo::layout

#include "lekalo/layout/remnant_outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "lekalo/geom/boolean.hpp"
#include "lekalo/layout/check.hpp"
#include "lekalo/phi/outline_relation.hpp"
#include "remnant.hpp"

namespace lekalo::layout {
namespace {

using geom::GridBox;
using geom::GridPoint;
using geom::GridRegion;
using geom::Int128;

/// A cut has at most so many corners beyond those of the sheet.
constexpr std::size_t kMostStairs = 4;
/// The cut ends so far outside the sheet's box, where no rounding brings it back in.
constexpr std::int64_t kBeyondSheet = geom::kGridPerMm;
/// Outlines of no more corners than this are searched for a rectangle whose sides pass through them.
constexpr std::size_t kMostAligned = 32;

bool holds(const GridBox& box, std::int64_t width, std::int64_t height) {
  return box.high.x - box.low.x >= width && box.high.y - box.low.y >= height;
}
bool holds_either_way(const GridBox& box, const RemnantRule& rule) {
  return holds(box, rule.width, rule.height) || holds(box, rule.height, rule.width);
}

/// The smallest remnant, in square steps.
Int128 least_area(const RemnantRule& rule) {
  constexpr Int128 kStepsPerMm2 = Int128{geom::kGridPerMm} * geom::kGridPerMm;
  return rule.area_mm2 > 0 ? rule.area_mm2 * kStepsPerMm2 : Int128{rule.width} * rule.height;
}

/// The width below which an arm of a remnant is of no use, steps: of an area, a quarter of the side of its
/// square.
std::int64_t least_arm(const RemnantRule& rule) {
  if (rule.area_mm2 == 0) return std::min(rule.width, rule.height);
  return static_cast<std::int64_t>(std::sqrt(static_cast<double>(rule.area_mm2)) / 4 *
                                   static_cast<double>(geom::kGridPerMm));
}

/// Mirrors points so that another corner of a box becomes the lower left one.
struct Mirrored {
  GridBox within;
  bool along_x = false, along_y = false;
  [[nodiscard]] GridPoint operator()(GridPoint p) const {
    return {along_x ? within.low.x + within.high.x - p.x : p.x,
            along_y ? within.low.y + within.high.y - p.y : p.y};
  }
  [[nodiscard]] GridBox operator()(const GridBox& box) const {
    return geom::box_of((*this)(box.low), (*this)(box.high));
  }
};

/// A corner of the cut: everything to the left of it and below is cut off.
using Stairs = std::vector<GridPoint>;

/// Finds the cut around upper right corners that keeps most, from the lower left corner of a box.
class StairSearch {
 public:
  StairSearch(const GridBox& within, std::vector<GridPoint> corners, const RemnantRule& rule)
      : within_(within), least_(least_area(rule)), arm_(least_arm(rule)) {
    std::sort(corners.begin(), corners.end(),
              [](GridPoint a, GridPoint b) { return a.x != b.x ? a.x > b.x : a.y > b.y; });
    for (const GridPoint& corner : corners)
      if (front_.empty() || corner.y > front_.back().y) front_.push_back(corner);
    std::reverse(front_.begin(), front_.end());
  }

  [[nodiscard]] Stairs best() const {
    Stairs best;
    Int128 least = -1;
    for (const bool top : {false, true})
      for (const bool right : {false, true}) {
        if (!top && within_.high.y - front_.front().y < arm_) continue;
        if (!right && within_.high.x - front_.back().x < arm_) continue;
        auto [loss, stairs] = fewest(top, right);
        if (least >= 0 && loss >= least) continue;
        least = loss;
        best = std::move(stairs);
      }
    return best;
  }

 private:
  /// The corner around the corners first to last of the front. The first may reach up to the top of the box,
  /// and the last to its right.
  [[nodiscard]] GridPoint around(std::size_t first, std::size_t last, bool top, bool right) const {
    return {right && last + 1 == front_.size() ? within_.high.x : front_[last].x,
            top && first == 0 ? within_.high.y : front_[first].y};
  }

  /// The stairs with the least sum of what is cut off and, for each corner within the box, the smallest
  /// remnant.
  [[nodiscard]] std::pair<Int128, Stairs> fewest(bool top, bool right) const {
    const std::size_t n = front_.size();
    struct Best {
      Int128 loss = -1;
      std::size_t from = 0;
    };
    std::array<std::vector<Best>, kMostStairs + 1> best;
    best.fill(std::vector<Best>(n + 1));
    best[0][0].loss = 0;
    for (std::size_t stairs = 1; stairs <= kMostStairs; ++stairs)
      for (std::size_t end = 1; end <= n; ++end)
        for (std::size_t from = 0; from < end; ++from) {
          if (best[stairs - 1][from].loss < 0) continue;
          const GridPoint corner = around(from, end - 1, top, right);
          const std::int64_t left = from == 0 ? within_.low.x : front_[from - 1].x;
          const bool turns = corner.x < within_.high.x && corner.y < within_.high.y;
          const Int128 loss = best[stairs - 1][from].loss +
                              Int128{corner.x - left} * (corner.y - within_.low.y) + (turns ? least_ : 0);
          Best& here = best[stairs][end];
          if (here.loss < 0 || loss < here.loss) here = {loss, from};
        }
    std::size_t count = 1;
    for (std::size_t stairs = 2; stairs <= kMostStairs; ++stairs)
      if (best[stairs][n].loss >= 0 && best[stairs][n].loss < best[count][n].loss) count = stairs;
    Stairs made;
    const Int128 loss = best[count][n].loss;
    for (std::size_t end = n; count > 0; --count) {
      const std::size_t from = best[count][end].from;
      made.push_back(around(from, end - 1, top, right));
      end = from;
    }
    std::reverse(made.begin(), made.end());
    return {loss, std::move(made)};
  }

  GridBox within_;
  Int128 least_;
  std::int64_t arm_;
  std::vector<GridPoint> front_;  ///< rising in x, falling in y
};

/// Returns what the stairs cut off, with a margin around the box.
Result<GridRegion> cut_off(const GridBox& within, const Stairs& stairs, const Mirrored& mirrored) {
  const GridPoint low = within.low - GridPoint{kBeyondSheet, kBeyondSheet};
  // Stairs that reach the border of the box go on beyond it.
  const auto beyond = [&](GridPoint p) {
    return GridPoint{p.x >= within.high.x ? within.high.x + kBeyondSheet : p.x,
                     p.y >= within.high.y ? within.high.y + kBeyondSheet : p.y};
  };
  std::vector<GridPoint> loop{low, {beyond(stairs.back()).x, low.y}};
  for (std::size_t i = stairs.size(); i-- > 0;) {
    const GridPoint corner = beyond(stairs[i]);
    loop.push_back(corner);
    loop.push_back({i == 0 ? low.x : beyond(stairs[i - 1]).x, corner.y});
  }
  for (GridPoint& point : loop) point = mirrored(point);
  return geom::make_grid_region({std::move(loop)});
}

/// Returns a corner of a Boolean's result on the grid: the nearest point, or one beside it that lies in the
/// sheet and not within what is cut off.
GridPoint corner_within(geom::Point p, const GridRegion& sheet, const GridRegion& off) {
  const GridPoint nearest{geom::grid_from_mm(p.x), geom::grid_from_mm(p.y)};
  const auto fine = [&](GridPoint at) {
    return geom::locate_point(sheet, at) != geom::PointLocation::outside &&
           geom::locate_point(off, at) != geom::PointLocation::inside;
  };
  if (fine(nearest)) return nearest;
  for (std::int64_t reach = 1; reach <= 2; ++reach)
    for (std::int64_t x = -reach; x <= reach; ++x)
      for (std::int64_t y = -reach; y <= reach; ++y)
        if (fine(nearest + GridPoint{x, y})) return nearest + GridPoint{x, y};
  return nearest;
}

/// A loop without points on straight lines between their neighbours, which a Boolean may leave.
std::vector<GridPoint> without_straight(const std::vector<GridPoint>& loop) {
  std::vector<GridPoint> kept;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const GridPoint before = kept.empty() ? loop.back() : kept.back(), after = loop[(i + 1) % loop.size()];
    if (geom::turn(before, loop[i], after) != 0) kept.push_back(loop[i]);
  }
  return kept;
}

Result<GridRegion> on_grid(const geom::Region& piece, const GridRegion& sheet, const GridRegion& off) {
  std::vector<std::vector<GridPoint>> loops;
  const auto add = [&](const geom::Contour& contour) {
    std::vector<GridPoint> loop;
    for (const geom::Edge& edge : contour) loop.push_back(corner_within(edge.from, sheet, off));
    loops.push_back(without_straight(loop));
  };
  add(piece.outer);
  for (const geom::Contour& hole : piece.holes) add(hole);
  return geom::make_grid_region(std::move(loops));
}

/// A rectangle in the outline, of the size of the rule where one of that size is found.
GridBox rectangle_within(const GridRegion& outline, const RemnantRule& rule) {
  const GridBox large = free_rectangle(outline, {}, geom::bounds(outline));
  if (rule.area_mm2 > 0 || holds_either_way(large, rule) || outline.points.size() > kMostAligned)
    return large;
  const std::array<std::pair<std::int64_t, std::int64_t>, 2> ways{
      {{rule.width, rule.height}, {rule.height, rule.width}}};
  for (const auto& [width, height] : ways)
    for (const GridPoint& u : outline.points)
      for (const GridPoint& v : outline.points)
        for (const std::int64_t x : {u.x, u.x - width})
          for (const std::int64_t y : {v.y, v.y - height}) {
            const GridBox box{{x, y}, {x + width, y + height}};
            if (phi::lies_within(outline, geom::rectangle(box))) return box;
          }
  return large;
}

bool satisfies(const Remnant& remnant, const RemnantRule& rule) {
  if (rule.area_mm2 > 0) return geom::twice_area(remnant.outline) >= 2 * least_area(rule);
  return holds_either_way(remnant.rectangle, rule);
}

/// A part where it lies, and how far a remnant stays from it.
struct CutPart {
  GridRegion outline;
  std::int64_t gap = 0;
};

/// Makes the remnants of one sheet.
class RemnantMaker {
 public:
  RemnantMaker(const GridRegion& sheet, std::vector<CutPart> parts, const RemnantRule& rule)
      : sheet_(sheet), parts_(std::move(parts)), rule_(rule) {}

  [[nodiscard]] std::vector<Remnant> make() const {
    std::vector<Remnant> best;
    Int128 most = 0;
    for (const bool along_y : {false, true})
      for (const bool along_x : {false, true}) {
        std::vector<Remnant> remnants = from_corner({geom::bounds(sheet_), along_x, along_y});
        Int128 area = 0;
        for (const Remnant& one : remnants) area += geom::twice_area(one.outline);
        if (area <= most) continue;
        most = area;
        best = std::move(remnants);
      }
    std::stable_sort(best.begin(), best.end(), [](const Remnant& a, const Remnant& b) {
      return geom::twice_area(a.outline) > geom::twice_area(b.outline);
    });
    return best;
  }

 private:
  [[nodiscard]] std::vector<Remnant> from_corner(const Mirrored& mirrored) const {
    const GridBox within = mirrored.within;
    std::vector<GridPoint> corners;
    for (const CutPart& part : parts_) {
      const GridPoint corner = mirrored(geom::bounds(part.outline)).high + GridPoint{part.gap, part.gap};
      corners.push_back({std::min(corner.x, within.high.x), std::min(corner.y, within.high.y)});
    }
    const Stairs stairs = StairSearch(within, std::move(corners), rule_).best();
    // Stairs of a few grid steps are no outline, and a Boolean may fail: then nothing is kept from this
    // corner.
    const Result<GridRegion> off = cut_off(within, stairs, mirrored);
    if (!off) return {};
    const auto rest = geom::combine({geom::region_of_lines(sheet_)}, {geom::region_of_lines(*off)},
                                    geom::BooleanOperation::subtract);
    if (!rest) return {};
    std::vector<Remnant> kept;
    for (const geom::Region& piece : rest->regions) {
      Result<GridRegion> outline = on_grid(piece, sheet_, *off);
      if (!outline || !is_proved(*outline, kept)) continue;
      Remnant remnant{*std::move(outline), {}};
      if (geom::twice_area(remnant.outline) < 2 * least_area(rule_)) continue;
      remnant.rectangle = rectangle_within(remnant.outline, rule_);
      if (satisfies(remnant, rule_)) kept.push_back(std::move(remnant));
    }
    return kept;
  }

  [[nodiscard]] bool is_proved(const GridRegion& outline, const std::vector<Remnant>& others) const {
    if (!phi::lies_within(sheet_, outline)) return false;
    for (const CutPart& part : parts_)
      if (phi::interiors_meet(outline, part.outline) ||
          phi::edges_nearer_than(outline, part.outline, part.gap))
        return false;
    return std::none_of(others.begin(), others.end(),
                        [&](const Remnant& other) { return phi::interiors_meet(outline, other.outline); });
  }

  const GridRegion& sheet_;
  std::vector<CutPart> parts_;
  RemnantRule rule_;
};

/// The polygon alone, moved: it holds the drawing, and moving doubles would round.
Outline polygon_moved(const Outline& outline, GridPoint by) {
  return {geom::moved(outline.polygon, by), {}, 0};
}

}  // namespace

bool fits_rule(const geom::GridRegion& outline, const RemnantRule& rule) {
  return geom::twice_area(outline) >= 2 * least_area(rule) &&
         (rule.area_mm2 > 0 || holds_either_way(geom::bounds(outline), rule));
}

std::int64_t remnant_gap(const Document& document, const Part& part) noexcept {
  return std::max(part.gap.value_or(document.rules.gap), document.rules.kerf);
}

std::vector<Remnant> remnants_of(const Document& document, std::uint32_t stock, std::int64_t copy,
                                 const RemnantRule& rule) {
  std::vector<CutPart> parts;
  for (const Placement& placement : document.placements)
    if (placement.stock == stock && placement.copy == copy) {
      const Part& part = document.parts[placement.part];
      parts.push_back({placed_outline(part, placement), remnant_gap(document, part)});
    }
  return RemnantMaker(document.stocks[stock].outline.polygon, std::move(parts), rule).make();
}

Stock stock_of(const Stock& sheet, const Remnant& remnant) {
  Stock stock;
  stock.kind = sheet.kind;
  stock.material = sheet.material;
  stock.grain_degrees = sheet.grain_degrees;
  stock.cost = sheet.cost * (static_cast<double>(geom::twice_area(remnant.outline)) /
                             static_cast<double>(geom::twice_area(sheet.outline.polygon)));
  const GridPoint to_corner = -geom::bounds(remnant.outline).low;
  stock.outline.polygon = geom::moved(remnant.outline, to_corner);
  for (const Defect& defect : sheet.defects)
    if (phi::interiors_meet(remnant.outline, defect.outline.polygon))
      stock.defects.push_back({defect.id, defect.severity, polygon_moved(defect.outline, to_corner)});
  for (const QualityZone& zone : sheet.zones)
    if (phi::interiors_meet(remnant.outline, zone.outline.polygon))
      stock.zones.push_back({zone.id, zone.quality, polygon_moved(zone.outline, to_corner)});
  return stock;
}

}  // namespace lekalo::layout

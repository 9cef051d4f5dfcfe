#pragma once

#include <algorithm>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/region_index.hpp"

namespace lekalo::cases {

/// Shapes for Booleans: simple ones on a coarse grid, where coincidences of every kind are common, the same
/// turned, or the same shaken by rounding errors.

inline geom::Contour boolean_polygon(const geom::Ring& ring) {
  geom::Contour contour;
  for (std::size_t i = 0; i < ring.size(); ++i)
    contour.push_back({geom::EdgeKind::line, ring[i], ring[(i + 1) % ring.size()], {}});
  return contour;
}
inline geom::Contour boolean_rectangle(double x, double y, double w, double h) {
  return boolean_polygon({{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}});
}
inline geom::Contour boolean_circle(geom::Point centre, double r, int quarter = 0) {
  const geom::Point offs[] = {{r, 0}, {0, r}, {-r, 0}, {0, -r}};
  const geom::Point from = centre + offs[quarter];
  return {{geom::EdgeKind::arc_ccw, from, from, centre}};
}
/// Round ends about two points on one axis direction; `waist` turns the ends inwards.
inline geom::Contour boolean_slot(double x, double y, double length, double r, bool waist = false) {
  const geom::EdgeKind out = geom::EdgeKind::arc_ccw, in = geom::EdgeKind::arc_cw;
  const geom::Point a{x, y - r}, b{x + length, y - r}, c{x + length, y + r}, d{x, y + r};
  return {{geom::EdgeKind::line, a, b, {}},
          {waist ? in : out, b, c, {x + length, y}},
          {geom::EdgeKind::line, c, d, {}},
          {waist ? in : out, d, a, {x, y}}};
}
inline geom::Contour boolean_rounded(double x, double y, double w, double h, double r) {
  using geom::EdgeKind;
  return {{EdgeKind::line, {x + r, y}, {x + w - r, y}, {}},
          {EdgeKind::arc_ccw, {x + w - r, y}, {x + w, y + r}, {x + w - r, y + r}},
          {EdgeKind::line, {x + w, y + r}, {x + w, y + h - r}, {}},
          {EdgeKind::arc_ccw, {x + w, y + h - r}, {x + w - r, y + h}, {x + w - r, y + h - r}},
          {EdgeKind::line, {x + w - r, y + h}, {x + r, y + h}, {}},
          {EdgeKind::arc_ccw, {x + r, y + h}, {x, y + h - r}, {x + r, y + h - r}},
          {EdgeKind::line, {x, y + h - r}, {x, y + r}, {}},
          {EdgeKind::arc_ccw, {x, y + r}, {x + r, y}, {x + r, y + r}}};
}

enum class BooleanKind { grid, turned, shaken };

inline geom::Contour map_contour(const geom::Contour& contour, const geom::BlankFromPart& pose) {
  geom::Contour out = contour;
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].from = pose(contour[i].from);
    if (out[i].kind != geom::EdgeKind::line) {
      out[i].centre = pose(contour[i].centre);
      if (pose.mirrored)
        out[i].kind =
            out[i].kind == geom::EdgeKind::arc_ccw ? geom::EdgeKind::arc_cw : geom::EdgeKind::arc_ccw;
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i].to = out[(i + 1) % out.size()].from;
  return out;
}
inline std::vector<geom::Region> map_regions(const std::vector<geom::Region>& regions,
                                             const geom::BlankFromPart& pose) {
  std::vector<geom::Region> out;
  for (const geom::Region& r : regions) {
    std::vector<geom::Contour> holes;
    for (const geom::Contour& h : r.holes) holes.push_back(map_contour(h, pose));
    out.push_back(geom::make_region(map_contour(r.outer, pose), std::move(holes)).value());
  }
  return out;
}

/// One to three pieces, some with a hole, each simple; the pieces may overlap and touch.
inline std::vector<geom::Region> boolean_operand(Random& random, BooleanKind kind) {
  const auto cell = [&](int n) { return static_cast<double>(random.below(static_cast<std::uint64_t>(n))); };
  std::vector<geom::Region> pieces;
  const std::size_t count = 1 + random.below(3);
  for (std::size_t i = 0; i < count; ++i) {
    const double x = cell(6), y = cell(6);
    geom::Contour outer;
    std::vector<geom::Contour> holes;
    switch (random.below(7)) {
      case 0:
        outer = boolean_rectangle(x, y, 1 + cell(4), 1 + cell(4));
        break;
      case 1:
        outer = boolean_circle({x, y}, 1 + cell(2), static_cast<int>(random.below(4)));
        break;
      case 2:
        outer = boolean_slot(x, y, 1 + cell(3), 1);
        break;
      case 3:
        outer = boolean_slot(x, y, 4, 1, true);
        break;
      case 4:
        outer = boolean_rounded(x, y, 2 + cell(3), 2 + cell(2), 1);
        break;
      case 5:
        outer = boolean_polygon({{x, y}, {x + 1 + cell(3), y + cell(2)}, {x + cell(3), y + 2 + cell(3)}});
        break;
      default:
        outer = boolean_rectangle(x, y, 4, 4);
        holes.push_back(random.below(2) == 0 ? boolean_circle({x + 2, y + 2}, 1)
                                             : boolean_rectangle(x + 1, y + 1, 2, 1));
    }
    auto region = geom::make_region(std::move(outer), std::move(holes));
    if (region) pieces.push_back(std::move(*region));
  }
  if (kind == BooleanKind::grid) return pieces;
  const double angle =
      kind == BooleanKind::turned ? static_cast<double>(1 + random.below(11)) * 0.5235987755982988 : 0;
  const double shift = kind == BooleanKind::shaken
                           ? static_cast<double>(random.below(7)) * 1e-15 * (random.below(2) == 0 ? 1 : 1e4)
                           : 0;
  return map_regions(pieces, geom::BlankFromPart::from_angle(angle, {shift, -shift}));
}

/// In any of the pieces: by rays, with none of the Booleans' code.
class Membership {
 public:
  explicit Membership(const std::vector<geom::Region>& pieces) {
    for (const geom::Region& piece : pieces) indices_.emplace_back(std::vector<geom::Region>{piece});
  }
  [[nodiscard]] bool contains(geom::Point p) const {
    return std::any_of(indices_.begin(), indices_.end(), [&](const auto& i) { return i.contains(p); });
  }
  [[nodiscard]] double distance(geom::Point p) const {
    double least = 1e300;
    for (const auto& index : indices_) least = std::min(least, index.nearest(p).distance);
    return least;
  }

 private:
  std::vector<geom::RegionIndex> indices_;
};

inline double area_of(const std::vector<geom::Region>& regions) {
  double sum = 0;
  for (const geom::Region& r : regions) sum += geom::area(r);
  return sum;
}
inline double length_of(const std::vector<geom::Region>& regions) {
  double sum = 0;
  const auto add = [&](const geom::Contour& c) {
    for (const geom::Edge& e : c)
      sum += e.kind == geom::EdgeKind::line ? norm(e.to - e.from) : geom::arc_radius(e) * geom::arc_sweep(e);
  };
  for (const geom::Region& r : regions) {
    add(r.outer);
    for (const geom::Contour& h : r.holes) add(h);
  }
  return sum;
}

}  // namespace lekalo::cases

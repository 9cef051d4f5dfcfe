#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/phi/region.hpp"
#include "support/cases.hpp"

namespace lekalo::cases {

/// Random parts and blanks of lines and arcs with holes, and a pose at which the part is known to fit.

enum class RegionKind {
  near_net,  ///< star-shaped outline, round holes cored in the blank, 0.3 to 3 mm of stock
  rounded,   ///< every corner an arc; the blank's corners are arcs of other radii
  slotted,   ///< concave: slots from outside, the blank's narrower
  roomy,     ///< a blank twice the size
  pieces,    ///< two parts of one blank with two pockets of material
  toothed,   ///< a toothed wheel on a cored hole: as many best angles as teeth
  turning    ///< a ring in a ring: every angle is as good
};
inline constexpr std::array kRegionKinds{RegionKind::near_net, RegionKind::rounded, RegionKind::slotted,
                                         RegionKind::roomy,    RegionKind::pieces,  RegionKind::toothed,
                                         RegionKind::turning};

struct RegionCase {
  std::string name;
  std::vector<geom::Region> part, blank;
  double theta = 0;
  geom::Point shift;
  [[nodiscard]] geom::BlankFromPart pose() const { return geom::BlankFromPart::from_angle(theta, shift); }
};

namespace region_detail {

inline geom::Contour polygon(const geom::Ring& ring) {
  geom::Contour contour;
  for (std::size_t i = 0; i < ring.size(); ++i)
    contour.push_back({geom::EdgeKind::line, ring[i], ring[(i + 1) % ring.size()], {}});
  return contour;
}

inline geom::Contour circle(geom::Point centre, double radius) {
  const geom::Point from = centre + geom::Point{radius, 0};
  return {{geom::EdgeKind::arc_ccw, from, from, centre}};
}

/// The ring with every corner cut by an arc that touches both sides, as large as half the shorter side and
/// `most` allow.
inline geom::Contour rounded(const geom::Ring& ring, double most) {
  const std::size_t n = ring.size();
  struct Corner {
    geom::Point in, out, centre;
    bool left = true;
  };
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < n; ++i) {
    const geom::Point p = ring[i], a = ring[(i + n - 1) % n] - p, b = ring[(i + 1) % n] - p;
    const geom::Point ua = (1 / norm(a)) * a, ub = (1 / norm(b)) * b;
    const double cut = std::min(most, 0.4 * std::min(norm(a), norm(b)));
    const geom::Point bisector = ua + ub;
    Corner corner{p + cut * ua, p + cut * ub, {}, cross(ub, ua) > 0};
    // The centre lies on the bisector where the perpendicular at the cut meets it.
    const double along = dot(bisector, ua);
    corner.centre = p + (cut / along) * bisector;
    corners.push_back(corner);
  }
  geom::Contour contour;
  for (std::size_t i = 0; i < n; ++i) {
    const Corner& c = corners[i];
    const bool flat = std::abs(cross(c.in - ring[i], c.out - ring[i])) < 1e-3 * norm(c.in - ring[i]);
    if (flat) {
      contour.push_back({geom::EdgeKind::line, c.in, ring[i], {}});
      contour.push_back({geom::EdgeKind::line, ring[i], c.out, {}});
    } else {
      contour.push_back({c.left ? geom::EdgeKind::arc_ccw : geom::EdgeKind::arc_cw, c.in, c.out, c.centre});
    }
    contour.push_back({geom::EdgeKind::line, c.out, corners[(i + 1) % n].in, {}});
  }
  return contour;
}

inline geom::Region region(geom::Contour outer, std::vector<geom::Contour> holes = {}) {
  return geom::make_region(std::move(outer), std::move(holes)).value();
}

inline geom::Contour moved(const geom::Contour& contour, const geom::BlankFromPart& pose) {
  geom::Contour out;
  for (const geom::Edge& e : contour) {
    geom::Edge m{e.kind, pose(e.from), pose(e.to), {}};
    if (e.kind != geom::EdgeKind::line) m.centre = pose(e.centre);
    out.push_back(m);
  }
  for (std::size_t i = 0; i < out.size(); ++i) out[i].to = out[(i + 1) % out.size()].from;
  return out;
}

}  // namespace region_detail

/// Cases of each kind: a thousand of all kinds together at most, since one takes a tenth of a second.
inline std::size_t region_case_count(std::size_t quick) {
  return std::min<std::size_t>(case_count(quick), 1000 / kRegionKinds.size());
}

/// `edges` about that many of the outline; holes come on top.
inline RegionCase region_case(std::uint64_t seed, std::uint64_t index, RegionKind kind,
                              std::size_t edges = 40) {
  using namespace region_detail;
  Random random(seed, 1000 + index * 8 + static_cast<std::uint64_t>(kind));
  RegionCase made;
  made.name = "region case " + std::to_string(static_cast<int>(kind)) + " " + std::to_string(index);
  made.theta = random.uniform(0, 6.283185307179586);
  made.shift = {random.uniform(-30, 30), random.uniform(-30, 30)};
  if (kind == RegionKind::turning) {
    const geom::Point off{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
    made.part = {region(circle({0, 0}, 30), {circle({0, 0}, 10)})};
    made.blank = {region(circle(made.shift, 32), {circle(made.shift + off, 8)})};
    return made;
  }
  if (kind == RegionKind::toothed) {
    const auto wheel = [&](std::size_t teeth, double high, double low) {
      geom::Ring ring;
      for (std::size_t i = 0; i < 4 * teeth; ++i) {
        const auto [sine, cosine] =
            geom::sincos(6.283185307179586 * static_cast<double>(i) / static_cast<double>(4 * teeth));
        ring.push_back((i % 4 < 2 ? high : low) * geom::Point{cosine, sine});
      }
      return ring;
    };
    const std::size_t teeth = 3 + random.below(4);
    const geom::BlankFromPart pose = made.pose();
    made.part = {region(polygon(wheel(teeth, 40, 34)), {circle({0, 0}, 10)})};
    made.blank = {region(moved(polygon(wheel(teeth, 42, 36.5)), pose), {moved(circle({0.2, 0}, 8), pose)})};
    return made;
  }
  std::array<double, 5> phase{}, height{};
  for (std::size_t i = 0; i < 5; ++i)
    phase[i] = random.uniform(0, 6.28), height[i] = random.uniform(0, 8) / static_cast<double>(i + 1);
  const double first = random.uniform(0, 6.28), second = random.uniform(0, 6.28);
  const bool slots = kind == RegionKind::slotted;
  const std::size_t n = kind == RegionKind::rounded ? std::max<std::size_t>(4, edges / 2) : edges;
  geom::Ring inner, outer;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
    const auto [sine, cosine] = geom::sincos(a);
    double r = 45;
    for (std::size_t k = 0; k < 5; ++k) r += height[k] * std::cos(static_cast<double>(k + 1) * a + phase[k]);
    if (slots && i % 4 >= 2) r -= 12;
    const double stock =
        kind == RegionKind::roomy ? 40.0 : 2.2 + 0.9 * std::cos(a + first) + 0.8 * std::cos(3 * a + second);
    inner.push_back(r * geom::Point{cosine, sine});
    outer.push_back((r + stock) * geom::Point{cosine, sine});
  }
  std::vector<geom::Contour> part_holes, blank_holes;
  const double small = random.uniform(0.4, 1.2);
  if (kind != RegionKind::slotted) {
    part_holes = {circle({12, 5}, 8), circle({-15, -8}, 6)};
    blank_holes = {circle({12.3, 5.2}, 8 - small - 0.4), circle({-15.2, -8.1}, 6 - small - 0.3)};
  }
  const bool arcs = kind == RegionKind::rounded;
  const geom::Contour part_outer = arcs ? rounded(inner, 4) : polygon(inner);
  const geom::Contour blank_outer = arcs ? rounded(outer, 2) : polygon(outer);
  const geom::BlankFromPart pose = made.pose();
  made.part = {region(part_outer, part_holes)};
  std::vector<geom::Contour> placed_holes;
  for (const geom::Contour& hole : blank_holes) placed_holes.push_back(moved(hole, pose));
  made.blank = {region(moved(blank_outer, pose), placed_holes)};
  if (kind == RegionKind::pieces) {
    const auto at = [](geom::Point p) { return geom::BlankFromPart::from_angle(0, p); };
    made.part.push_back(region(polygon({{90, -10}, {110, -12}, {112, 9}, {91, 12}})));
    const geom::Contour pocket = polygon({{88.9, -11.3}, {111.2, -13.1}, {113.6, 10.2}, {90.2, 13.4}});
    made.blank.push_back(region(moved(moved(pocket, at({0, 0})), pose)));
  }
  return made;
}

}  // namespace lekalo::cases

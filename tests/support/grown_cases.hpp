#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/offset.hpp"
#include "lekalo/geom/pose.hpp"
#include "lekalo/geom/region.hpp"
#include "lekalo/geom/trig.hpp"
#include "support/boolean_cases.hpp"
#include "support/region_cases.hpp"

namespace lekalo::cases {

/// Blanks made by growing the placed part: every edge by an allowance of its own, and bumps on top.

struct StockClass {
  const char* name;
  double least, most;  ///< allowance of an edge, mm
};
inline constexpr std::array kStockClasses{StockClass{"0.1 to 5 mm", 0.1, 5},
                                          StockClass{"0.3 to 3 mm", 0.3, 3}, StockClass{"1 to 3 mm", 1, 3}};

struct GrownCase {
  RegionCase shapes;
  double allowance = 0;  ///< at the known pose at least, mm, but for the errors of the Booleans
};

namespace grown_detail {

inline std::vector<geom::Region> primitive(Random& random, geom::Point at, double least, double most) {
  const double size = random.uniform(least, most);
  geom::Contour made;
  switch (random.below(5)) {
    case 0:
      made = boolean_circle({0, 0}, size);
      break;
    case 1: {
      const double high = size * random.uniform(0.5, 1);
      made = boolean_rectangle(-size, -high, 2 * size, 2 * high);
      break;
    }
    case 2: {
      const double radius = 0.45 * size;
      made = boolean_slot(radius - size, 0, 2 * (size - radius), radius);
      break;
    }
    case 3: {
      const double high = size * random.uniform(0.6, 1);
      made = boolean_rounded(-size, -high, 2 * size, 2 * high, 0.3 * high);
      break;
    }
    default: {
      geom::Ring ring;
      const std::size_t corners = 3 + random.below(6);
      for (std::size_t i = 0; i < corners; ++i) {
        const auto [sine, cosine] =
            geom::sincos(6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners));
        ring.push_back(size * random.uniform(0.8, 1) * geom::Point{cosine, sine});
      }
      made = boolean_polygon(ring);
    }
  }
  const double turn = random.below(2) == 0 ? 0 : random.uniform(0, 6.28);
  return {region_detail::region(region_detail::moved(made, geom::BlankFromPart::from_angle(turn, at)))};
}

/// A Boolean tree of primitives: a body, up to three united with it, up to four taken off; in one piece.
inline std::vector<geom::Region> tree(Random& random) {
  for (;;) {
    std::vector<geom::Region> body = primitive(random, {}, 28, 45);
    const auto around = [&](double low, double high) {
      const auto [sine, cosine] = geom::sincos(random.uniform(0, 6.283));
      return random.uniform(low, high) * geom::Point{cosine, sine};
    };
    for (std::uint64_t k = random.below(4); k > 0; --k)
      body = geom::combine(body, primitive(random, around(15, 38), 12, 25), geom::BooleanOperation::unite)
                 .value()
                 .regions;
    for (std::uint64_t k = 1 + random.below(4); k > 0; --k)
      body = geom::combine(body, primitive(random, around(5, 45), 7, 12), geom::BooleanOperation::subtract)
                 .value()
                 .regions;
    if (body.size() == 1 && geom::area(body[0]) > 800) return body;
  }
}

}  // namespace grown_detail

/// Three in four parts are trees, the others star-shaped outlines with holes, with round corners or slotted.
inline GrownCase grown_case(std::uint64_t seed, std::uint64_t index, const StockClass& stock) {
  constexpr std::array kOutlines{RegionKind::near_net, RegionKind::rounded, RegionKind::slotted};
  Random random(seed, 500'000 + index);
  GrownCase made;
  made.allowance = stock.least;
  made.shapes.name = "grown case " + std::to_string(index) + ", " + stock.name;
  made.shapes.part = index % 4 == 3 ? region_case(seed, index, kOutlines[index / 4 % 3], 24).part
                                    : grown_detail::tree(random);
  made.shapes.theta = random.uniform(0, 6.283185307179586);
  made.shapes.shift = {random.uniform(-30, 30), random.uniform(-30, 30)};
  const geom::BlankFromPart pose = made.shapes.pose();

  std::vector<double> allowances(geom::edges_in(made.shapes.part));
  for (double& allowance : allowances) allowance = random.uniform(stock.least, stock.most);
  allowances[random.below(allowances.size())] = stock.least;
  std::vector<geom::Region> blank = geom::offset_edges(made.shapes.part, allowances).value().regions;
  const geom::Contour& outer = made.shapes.part[0].outer;
  for (std::uint64_t k = random.below(3); k > 0; --k) {
    const geom::Point at = outer[random.below(outer.size())].from;
    blank =
        geom::combine(blank, {region_detail::region(boolean_circle(at, stock.most + random.uniform(1, 4)))},
                      geom::BooleanOperation::unite)
            .value()
            .regions;
  }
  for (const geom::Region& piece : blank) {
    std::vector<geom::Contour> holes;
    for (const geom::Contour& hole : piece.holes) holes.push_back(region_detail::moved(hole, pose));
    made.shapes.blank.push_back(region_detail::region(region_detail::moved(piece.outer, pose), holes));
  }
  return made;
}

}  // namespace lekalo::cases

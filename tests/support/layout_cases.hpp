#pragma once

// Random layouts: concave parts, some with holes, on strips, sheets and hides with defects and zones.
// Everything is a function of a seed and an index.

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/base/random.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/layout/session.hpp"

namespace lekalo::cases {

/// (Arguments of a function are evaluated in any order: nothing here draws twice in one call.)
inline geom::GridPoint grid_point(double x_mm, double y_mm) {
  return {geom::grid_from_mm(x_mm), geom::grid_from_mm(y_mm)};
}

/// A star-shaped polygon around a point: concave as a rule, never self-crossing.
inline std::vector<geom::GridPoint> star(Random& random, geom::Point centre, double least_mm, double most_mm,
                                         std::size_t count) {
  std::vector<geom::GridPoint> points;
  for (std::size_t i = 0; i < count; ++i) {
    const double angle =
        6.283185307179586 * (static_cast<double>(i) + random.uniform(0.1, 0.9)) / static_cast<double>(count);
    const double radius = random.uniform(least_mm, most_mm);
    const geom::SinCos at = geom::sincos(angle);
    points.push_back(grid_point(centre.x + radius * at.cosine, centre.y + radius * at.sine));
  }
  return points;
}

inline geom::GridPoint random_point(Random& random, geom::Point low, geom::Point high) {
  const double x = random.uniform(low.x, high.x);
  return grid_point(x, random.uniform(low.y, high.y));
}

inline layout::Outline outline_of(std::vector<std::vector<geom::GridPoint>> loops) {
  layout::Outline outline;
  outline.polygon = geom::make_grid_region(std::move(loops)).value();
  return outline;
}

inline std::vector<geom::GridPoint> box_loop(double x0, double y0, double x1, double y1) {
  return {grid_point(x0, y0), grid_point(x1, y0), grid_point(x1, y1), grid_point(x0, y1)};
}

/// Squares of 10 at (20, 40) and (60, 40) on a sheet of 100.
inline layout::Document two_squares() {
  layout::Document d;
  layout::Part part;
  part.id = "square";
  part.outline = outline_of({box_loop(0, 0, 10, 10)});
  d.parts = {part};
  layout::Stock stock;
  stock.id = "sheet";
  stock.outline = outline_of({box_loop(0, 0, 100, 100)});
  d.stocks = {stock};
  for (std::uint64_t id = 1; id <= 2; ++id) {
    layout::Placement placement;
    placement.id = id;
    placement.at = grid_point(40.0 * static_cast<double>(id) - 20, 40);
    d.placements.push_back(placement);
  }
  d.next_id = 3;
  return d;
}

inline layout::Part random_part(Random& random, std::size_t index) {
  layout::Part part;
  part.id = "part " + std::to_string(index);
  std::vector<std::vector<geom::GridPoint>> loops;
  switch (random.below(4)) {
    case 0: {  // an L on whole millimetres: shared edges and exact touches come of these
      const double w = 20 + static_cast<double>(random.below(30)),
                   h = 20 + static_cast<double>(random.below(30));
      const double a = 5 + static_cast<double>(random.below(10));
      loops = {{grid_point(0, 0), grid_point(w, 0), grid_point(w, a), grid_point(a, a), grid_point(a, h),
                grid_point(0, h)}};
      break;
    }
    case 1: {  // a frame: room inside
      const double w = 30 + static_cast<double>(random.below(30)),
                   h = 30 + static_cast<double>(random.below(30));
      loops = {box_loop(0, 0, w, h), box_loop(4, 4, w - 4, h - 4)};
      break;
    }
    default:
      loops = {star(random, {0, 0}, 6, 30, 3 + random.below(20))};
  }
  part.outline = outline_of(std::move(loops));
  part.demand = 100;
  part.may_mirror = random.below(2) == 0;
  if (random.below(3) == 0) part.rotations = {{0, 0}, {90, 90}, {180, 180}, {270, 270}};
  if (random.below(4) == 0) part.gap = geom::grid_from_mm_up(random.uniform(0, 3));
  return part;
}

/// Parts and a stock, nothing placed.
inline layout::Document random_order(std::uint64_t seed, std::size_t index) {
  Random random(seed, 9000 + index);
  layout::Document document;
  document.name = "random order";
  for (std::size_t i = 0, count = 2 + random.below(5); i < count; ++i)
    document.parts.push_back(random_part(random, i));
  layout::Stock stock;
  stock.id = "stock";
  switch (random.below(3)) {
    case 0:
      stock.kind = layout::StockKind::sheet;
      stock.count = 2;
      stock.outline = outline_of({box_loop(0, 0, 300, 200)});
      break;
    case 1:
      stock.kind = layout::StockKind::strip;
      stock.outline = outline_of({box_loop(0, 0, geom::mm_from_grid(layout::kLongestStrip), 150)});
      stock.open_length = true;
      break;
    default:
      stock.kind = layout::StockKind::hide;
      stock.outline =
          outline_of({star(random, {150, 150}, 110, 160, 24), star(random, {150, 150}, 3, 12, 6)});
      for (std::size_t i = 0; i < 3; ++i) {
        const geom::Point at{random.uniform(60, 240), random.uniform(60, 240)};
        stock.defects.push_back({"d" + std::to_string(i), static_cast<int>(1 + random.below(3)),
                                 outline_of({star(random, at, 2, 6, 7)})});
      }
      stock.zones.push_back({"belly", 1, outline_of({box_loop(-100, -100, 120, 400)})});
      document.parts[0].quality = 1;
      document.parts[1].quality = 2;
      document.parts[1].areas = {{0, outline_of({box_loop(-100, -100, 10, 100)})}};
  }
  document.stocks.push_back(std::move(stock));
  switch (random.below(3)) {
    case 0:
      break;
    case 1:
      document.rules.gap = geom::grid_from_mm_up(1);
      break;
    default:
      document.rules = {geom::grid_from_mm_up(random.uniform(0, 4)),
                        geom::grid_from_mm_up(random.uniform(0, 4)),
                        geom::grid_from_mm_up(random.uniform(0, 4))};
  }
  return document;
}

/// With up to `count` parts placed where they are clear.
inline layout::Document random_layout(std::uint64_t seed, std::size_t index, std::size_t count) {
  layout::Document document = random_order(seed, index);
  Random random(seed, 9500 + index);
  layout::Session session(document);
  for (std::size_t i = 0; i < 6 * count && session.document().placements.size() < count; ++i) {
    layout::PlaceCommand place;
    place.part = static_cast<std::uint32_t>(random.below(document.parts.size()));
    const double quarter = 90 * static_cast<double>(random.below(4));
    const bool slanting = document.parts[place.part].rotations.empty() && random.below(2) == 0;
    place.rotation = geom::rotation_from_degrees(slanting ? quarter + random.uniform(0, 90) : quarter);
    place.at = random_point(random, {0, 0}, {300, 250});
    if (random.below(2) == 0) {  // on whole millimetres
      const double x = static_cast<double>(random.below(300));
      place.at = grid_point(x, static_cast<double>(random.below(250)));
    }
    (void)session.apply(place);
  }
  return session.document();
}

}  // namespace lekalo::cases

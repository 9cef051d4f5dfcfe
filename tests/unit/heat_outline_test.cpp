// What the source's figure 2 shows, by the solver that `lekalo heat` uses: heat on the outline of its pocket
// at a point and over a stretch, how it spreads into the material, the thermal stress, and the outline that
// the expansion moves. The source names no law, no width and no constants; ours are below
// (docs/design/functional-voxel.md). The pocket's functional-voxel model (quadratic FLOZ) is the workpiece: a
// layer of voxels whose upper and lower sides are free, so that it is a plate in plane stress.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/disk/files.hpp"
#include "lekalo/field/grid.hpp"
#include "lekalo/field/level_lines.hpp"
#include "lekalo/heat/conduction.hpp"
#include "lekalo/heat/expansion.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "support/cases.hpp"
#include "support/places.hpp"

namespace lekalo::heat::heat_outline_test {
namespace {

using geom::Point;
using Numbers = std::vector<double>;

constexpr Point kPlace{30, 20};               // the middle of a side
constexpr double kSpread = 1, kStretch = 20;  // mm: standard deviation at the point; the stretch's length
constexpr double kHeat = 10;                  // W per mm of depth, in all
constexpr double kMargin = 35;                // mm of material about the pocket

// Aluminium 6061-T6, handbook values; W/(mm K) and J/(mm3 K).
constexpr Conductor kMetal{0.167, 2.42e-3};
constexpr Elastic kSprings{68.9e3, 0.33, 23.6e-6};

/// Of the heat that enters along the outlines, W per mm of length and mm of depth.
using Density = std::function<double(Point)>;

double at_a_point(Point p) {
  const double d = geom::norm(p - kPlace) / kSpread;
  return kHeat * std::exp(-d * d / 2) / (kSpread * std::sqrt(2 * std::numbers::pi));
}
double over_a_stretch(Point p) { return geom::norm(p - kPlace) <= kStretch / 2 ? kHeat / kStretch : 0; }

/// A layer of voxels about a pocket that goes through it.
class Plate {
 public:
  explicit Plate(double pitch) : Plate(model_nodes(pitch)) {}

  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const field::GridFrame& cells() const { return cells_; }
  /// Where the model is 0, next to the middle of a voxel.
  [[nodiscard]] Point wall_at(std::size_t n) const {
    const std::size_t low = n / cells_.columns * nodes_.columns + n % cells_.columns,
                      high = low + nodes_.columns;
    const double a = model_[low], b = model_[low + 1], c = model_[high], d = model_[high + 1];
    const Point slope = (0.5 / cells_.pitch) * Point{b + d - a - c, c + d - a - b};
    return cells_.node(n % cells_.columns, n / cells_.columns) -
           ((a + b + c + d) / 4 / geom::dot(slope, slope)) * slope;
  }
  /// The outlines as the model has them.
  [[nodiscard]] std::vector<Point> outline() const {
    std::vector<Point> places;
    for (const auto& line : field::LevelLines(nodes_, model_).at(0))
      for (const auto& place : line) places.push_back(place.at);
    return places;
  }

 private:
  using Model = std::pair<field::GridFrame, Numbers>;

  /// The model at the corners of voxels, above 0 where there is material.
  static Model model_nodes(double pitch) {
    const std::string name = cases::source_dir() + "/tests/corpus/pockets/paper-pocket.json";
    const auto file = *io::parse_regions(*disk::read_file(name), name);
    const auto model =
        *field::ContourModel::make(file.regions, {1, field::Logic::quadratic, field::FlozForm::normalised});
    const geom::Box box = geom::bounds(file.regions.front().outer);
    const auto count = [&](double length) {
      return static_cast<std::size_t>(std::ceil((length + 2 * kMargin) / pitch)) + 2;
    };
    // Nodes off the round numbers of drawings: a node on the outline has no sign.
    const double off = kMargin + 0.6 * pitch;
    const field::GridFrame nodes{box.low - Point{off, off}, pitch, count(box.high.x - box.low.x),
                                 count(box.high.y - box.low.y)};
    Numbers outside;
    for (const auto value : field::sample(model, nodes).value) outside.push_back(-static_cast<double>(value));
    return {nodes, std::move(outside)};
  }

  explicit Plate(Model model)
      : nodes_(model.first),
        cells_{nodes_.origin + Point{nodes_.pitch / 2, nodes_.pitch / 2}, nodes_.pitch, nodes_.columns - 1,
               nodes_.rows - 1},
        model_(std::move(model.second)),
        body_(*Grid::divide({nodes_.origin.x, nodes_.origin.y, 0},
                            {nodes_.origin.x + nodes_.pitch * static_cast<double>(cells_.columns),
                             nodes_.origin.y + nodes_.pitch * static_cast<double>(cells_.rows), nodes_.pitch},
                            nodes_.pitch),
              [this](Place p) {
                const auto i = static_cast<std::size_t>(std::lround((p.x - nodes_.origin.x) / nodes_.pitch)),
                           j = static_cast<std::size_t>(std::lround((p.y - nodes_.origin.y) / nodes_.pitch));
                return model_[j * nodes_.columns + i];
              }) {}

  field::GridFrame nodes_, cells_;  ///< corners of voxels, and their middles
  Numbers model_;                   ///< at the nodes
  Body body_;
};

/// Carried on from the voxels that have material into the others, ring by ring.
Numbers carried_on(const Plate& plate, Numbers values) {
  const std::size_t columns = plate.cells().columns, size = values.size();
  std::vector<char> known(size, 0);
  std::vector<std::size_t> ring;
  for (std::size_t n = 0; n < size; ++n)
    if (plate.body().share(n) > 0) known[n] = 1, ring.push_back(n);
  while (!ring.empty()) {
    std::vector<std::size_t> next;
    for (const std::size_t n : ring)
      for (const std::size_t m : {n + 1, n - 1, n + columns, n - columns})  // below 0: beyond size
        if (m < size && known[m] == 0) known[m] = 1, values[m] = values[n], next.push_back(m);
    ring = std::move(next);
  }
  return values;
}

/// What a grid's nodes have, bilinear between them. \pre p is between four
double between(const field::GridFrame& frame, const Numbers& of, Point p) {
  const Point d = (1 / frame.pitch) * (p - frame.origin);
  const auto i = static_cast<std::size_t>(d.x), j = static_cast<std::size_t>(d.y);
  const double s = d.x - static_cast<double>(i), t = d.y - static_cast<double>(j);
  const std::size_t n = j * frame.columns + i, above = n + frame.columns;
  return (1 - t) * ((1 - s) * of[n] + s * of[n + 1]) + t * ((1 - s) * of[above] + s * of[above + 1]);
}

struct Heated {
  double in = 0, out = 0;                     ///< W/mm
  double hottest = 0, stress = 0, moved = 0;  ///< of the outline K, of whole voxels MPa, of the outline mm
  Point hottest_at, cut_in;                   ///< where; and how the heated place moves, mm
};

/// The steady state: the border of the plate is as cold as its surroundings, and held.
Heated heated(const Plate& plate, const Density& density) {
  constexpr double kLong = 1e5;  // s: a plate of 100 mm is steady after some minutes
  const Body& body = plate.body();
  const Grid& grid = body.grid();
  Films films;
  Holding holding;
  for (const Side side : {Side::x_low, Side::x_high, Side::y_low, Side::y_high})
    films.sides[of(side)] = kNoResistance, holding.held[of(side)] = true;
  Heated found;
  std::vector<Source> sources;
  for (std::size_t n = 0; n < grid.size(); ++n)
    if (body.wall(n) > 0 && body.share(n) > 0) {
      sources.push_back({n, body.wall(n) * density(plate.wall_at(n))});
      found.in += sources.back().watts / grid.pitch.z;
    }
  Conduction conduction(body, kMetal, films);
  double before = 0;
  for (int step = 0; step < 3; ++step) {
    before = conduction.book().lost;
    EXPECT_TRUE(conduction.step(kLong, sources));
  }
  found.out = (conduction.book().lost - before) / kLong / grid.pitch.z;
  Expansion expansion(grid, kSprings, holding);
  expansion.follow(body);
  EXPECT_TRUE(expansion.solve(conduction.temperatures()));
  const Numbers warm = carried_on(plate, conduction.temperatures()), stress = expansion.mises();
  for (std::size_t n = 0; n < grid.size(); ++n)
    if (body.share(n) > 0.999) found.stress = std::max(found.stress, stress[n]);
  const auto moved_at = [&](Point p) {
    const Place by = expansion.moved({p.x, p.y, grid.pitch.z / 2});
    return Point{by.x, by.y};
  };
  for (const Point p : plate.outline()) {
    const double here = between(plate.cells(), warm, p);
    if (here > found.hottest) found.hottest = here, found.hottest_at = p;
    found.moved = std::max(found.moved, geom::norm(moved_at(p)));
  }
  found.cut_in = moved_at(kPlace);
  return found;
}

/// Heat in and out within 1 %, and these figures within parts of themselves.
void expect_figures(const Heated& found, double hottest, double stress, double moved, double part) {
  EXPECT_NEAR(found.in, kHeat, 0.01 * kHeat);
  EXPECT_NEAR(found.out, found.in, 1e-3 * kHeat);
  EXPECT_NEAR(found.hottest, hottest, part * hottest);
  EXPECT_NEAR(found.moved, moved, part * moved);
  // Whole voxels are the farther from the corners the larger they are, so that stress is the lower.
  EXPECT_NEAR(found.stress, stress, 0.02 * stress);
}

// An earlier solver in the plane with cells of 0.5 mm had 81 and 45 K, 54 MPa, 0.018 and 0.016 mm.
TEST(HeatOutline, HeatSpreadsFromAPointAndAStretchAndMovesTheOutline) {
  const Plate coarse(1);
  const Heated stretch = heated(coarse, over_a_stretch);
  expect_figures(stretch, 45.3, 46.6, 0.0158, 0.01);
  // The heated side, which is upright, comes into the pocket.
  EXPECT_LT(stretch.cut_in.x, -0.01);
  if (cases::case_count(1) == 1) return;
  const Heated point = heated(coarse, at_a_point);
  expect_figures(point, 81.3, 47.2, 0.0186, 0.04);
  EXPECT_LT(geom::norm(point.hottest_at - kPlace), 1);
  const Plate fine(0.5);
  expect_figures(heated(fine, at_a_point), 81.3, 56.4, 0.0186, 0.005);
  expect_figures(heated(fine, over_a_stretch), 45.3, 55.8, 0.0158, 0.005);
}

}  // namespace
}  // namespace lekalo::heat::heat_outline_test

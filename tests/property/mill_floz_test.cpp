#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lekalo/draw/voxel_pictures.hpp"
#include "lekalo/field/trace.hpp"
#include "lekalo/geom/boolean.hpp"
#include "lekalo/geom/region_index.hpp"
#include "lekalo/geom/trig.hpp"
#include "lekalo/io/shape/region_json.hpp"
#include "lekalo/mill/feeds.hpp"
#include "lekalo/mill/floz_field.hpp"
#include "lekalo/mill/fragments.hpp"
#include "lekalo/mill/pocket.hpp"
#include "mill/fragment/floz_level.hpp"
#include "support/cases.hpp"
#include "support/voxel_reader.hpp"

// The source's method and its parts: fragments, tracing, pictures of the model.

namespace lekalo::mill::mill_floz_test {
namespace {

using geom::EdgeKind;
using geom::Point;
using geom::Region;

/// The source's pocket, seven arcs and seven lines; two corners on each side turn away from the material.
const std::string kPaperPocket =
    R"({"units":"mm","outer":[{"arc":{"from":[-22,0],"to":[22,0],"centre":[0,0],"ccw":true}},)"
    R"({"arc":{"from":[22,0],"to":[30,8],"centre":[22,8],"ccw":true}},{"line":{"from":[30,8],"to":[30,32]}},)"
    R"({"arc":{"from":[30,32],"to":[22,40],"centre":[22,32],"ccw":true}},{"line":{"from":[22,40],"to":[15,40]}},)"
    R"({"line":{"from":[15,40],"to":[15,64]}},{"arc":{"from":[15,64],"to":[9,70],"centre":[9,64],"ccw":true}},)"
    R"({"line":{"from":[9,70],"to":[-9,70]}},{"arc":{"from":[-9,70],"to":[-15,64],"centre":[-9,64],"ccw":true}},)"
    R"({"line":{"from":[-15,64],"to":[-15,40]}},{"line":{"from":[-15,40],"to":[-22,40]}},)"
    R"({"arc":{"from":[-22,40],"to":[-30,32],"centre":[-22,32],"ccw":true}},{"line":{"from":[-30,32],"to":[-30,8]}},)"
    R"({"arc":{"from":[-30,8],"to":[-22,0],"centre":[-22,8],"ccw":true}}]})";

std::vector<Region> paper_pocket() { return io::parse_regions(kPaperPocket, "paper.json").value().regions; }

/// A polygon with corners at random radii, often with deep notches.
Region random_star(Random& random, std::size_t corners) {
  geom::Contour contour;
  std::vector<Point> points;
  for (std::size_t i = 0; i < corners; ++i) {
    const auto turn = geom::sincos(6.283185307179586 * static_cast<double>(i) / static_cast<double>(corners));
    points.push_back(random.uniform(12, 40) * Point{turn.cosine, turn.sine});
  }
  for (std::size_t i = 0; i < corners; ++i)
    contour.push_back({EdgeKind::line, points[i], points[(i + 1) % corners], {}});
  return geom::make_region(std::move(contour)).value();
}

double area_of(const std::vector<Region>& regions) {
  double sum = 0;
  for (const Region& region : regions) sum += geom::area(region);
  return sum;
}

TEST(MillFragments, TheSourcesPocketFallsIntoThree) {
  const auto fragments = convex_fragments(paper_pocket());
  ASSERT_TRUE(fragments) << fragments.error().message;
  EXPECT_EQ(fragments->size(), 3U);
  EXPECT_NEAR(area_of(*fragments), area_of(paper_pocket()), 1e-6);
}

TEST(MillFragments, CoverTheRegionsWithoutOverlapAndAreConvex) {
  for (std::size_t index = 0; index < cases::case_count(8); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    Random random(cases::seed(), 93000 + index);
    const Region star = random_star(random, 5 + index % 9);
    const auto fragments = convex_fragments({star});
    ASSERT_TRUE(fragments) << fragments.error().message;
    EXPECT_NEAR(area_of(*fragments), geom::area(star), 1e-6);
    const auto back = geom::united(*fragments, 1e-9);
    ASSERT_TRUE(back);
    EXPECT_NEAR(area_of(back->regions), geom::area(star), 1e-6);
    for (const Region& fragment : *fragments)
      for (std::size_t i = 0; i < fragment.outer.size(); ++i) {
        const geom::Edge &a = fragment.outer[i], &b = fragment.outer[(i + 1) % fragment.outer.size()];
        const Point u = a.to - a.from, v = b.to - b.from;
        const geom::Box box = geom::bounds(fragment.outer);
        const bool shallow =
            std::abs(cross(u, b.to - a.from)) <= 0.03 * norm(box.high - box.low) * norm(u + v);
        EXPECT_TRUE(cross(u, v) >= -0.11 * norm(u) * norm(v) || shallow) << a.to.x << " " << a.to.y;
      }
  }
}

Region ring_of(const std::vector<Point>& points, const std::vector<geom::Contour>& holes) {
  geom::Contour contour;
  for (std::size_t i = 0; i < points.size(); ++i)
    contour.push_back({EdgeKind::line, points[i], points[(i + 1) % points.size()], {}});
  return geom::make_region(contour, holes).value();
}

TEST(MillFragments, AGearLosesItsTeethAndItsBodyFallsIntoEight) {
  std::vector<Point> points;
  for (int i = 0; i < 48; ++i) {
    const auto turn = geom::sincos(6.283185307179586 * i / 48);
    points.push_back((i / 2 % 2 == 1 ? 17.0 : 21.0) * Point{turn.cosine, turn.sine});
  }
  const Region gear = ring_of(points, {{{EdgeKind::arc_ccw, {6, 0}, {6, 0}, {0, 0}}}});
  const auto fragments = convex_fragments({gear});
  ASSERT_TRUE(fragments) << fragments.error().message;
  // The line of a cut at one tooth runs through its neighbours, which are left whole.
  EXPECT_EQ(fragments->size(), 20U);
  EXPECT_NEAR(area_of(*fragments), geom::area(gear), 1e-6);
}

TEST(MillFragments, ACurveOfShortEdgesIsCutAsACurve) {
  // An arm that winds one and a half times, 8 mm wide at its end: one corner after the other would make 64.
  std::vector<Point> points;
  const auto place = [](int i, double r) {
    const auto turn = geom::sincos(6.283185307179586 * 1.5 * i / 60);
    return r * Point{turn.cosine, turn.sine};
  };
  for (int i = 0; i <= 60; ++i) points.push_back(place(i, 6 + 22.0 * i / 60));
  for (int i = 60; i >= 0; --i) points.push_back(place(i, std::max(0.5, 22.0 * i / 60)));
  const Region arm = ring_of(points, {});
  const auto fragments = convex_fragments({arm});
  ASSERT_TRUE(fragments) << fragments.error().message;
  EXPECT_LE(fragments->size(), 18U);
  EXPECT_GE(fragments->size(), 8U);
  EXPECT_NEAR(area_of(*fragments), geom::area(arm), 1e-6);
}

TEST(FieldTrace, TheStepSetsTheSpacingOfTheSpiral) {
  // On a cone every level line is a circle: a turn ends pi steps farther out.
  const field::Function f = [](Point p) {
    const double r = norm(p);
    return field::Jet{50 - r, r > 0 ? (-1 / r) * p : Point{}};
  };
  for (const double step : {0.3, 0.8}) {
    const auto spiral = field::gradient_spiral(f, {5, 0}, step);
    std::vector<double> radii;
    for (std::size_t i = 0; i + 1 < spiral.size(); ++i)
      if (spiral[i].y < 0 && spiral[i + 1].y >= 0) radii.push_back(norm(spiral[i]));
    ASSERT_GT(radii.size(), 5U);
    for (std::size_t i = 3; i + 1 < radii.size(); ++i)
      EXPECT_NEAR(radii[i + 1] - radii[i], 3.141592653589793 * step, 0.05 * step);
    EXPECT_LT(norm(spiral.back()), 50);
    EXPECT_GT(norm(spiral.back()), 49);
  }
}

TEST(MillFloz, TheSpiralsStayWhereTheToolMayBe) {
  for (const Method method : {Method::floz_linear, Method::floz_quadratic})
    for (const bool whole : {false, true}) {
      PocketOptions options;
      options.method = method, options.whole = whole;
      const auto path = pocket_path(paper_pocket(), options);
      ASSERT_TRUE(path) << path.error().message;
      EXPECT_EQ(path->fronts, whole ? 1U : 3U);
      const geom::RegionIndex pocket(paper_pocket());
      for (const PathMove& move : path->moves)
        if (move.z < 0) {
          EXPECT_TRUE(pocket.contains(move.to));
          EXPECT_GE(pocket.nearest(move.to).distance, 3 - 0.01);
        }
    }
}

/// The spiral's places, from the one where the tool goes down.
std::vector<Point> cut_places(const PocketPath& path) {
  std::vector<Point> places;
  for (const PathMove& move : path.moves)
    if (move.kind == PathMove::Kind::cut) places.push_back(move.to);
  return places;
}

TEST(MillFloz, ASpiralBeginsAtItsStartAndItsTurnsKeepTheStepOver) {
  // In a disc every turn is nearly a circle, so that a turn later is one step-over farther out; near the
  // outline the chords show, and it is not, nor on the linear model, whose level lines have corners.
  const Region disc = geom::make_region({{EdgeKind::arc_ccw, {40, 0}, {40, 0}, {0, 0}}}).value();
  constexpr double kTurn = 6.283185307179586;
  for (std::size_t index = 0; index < cases::case_count(10); ++index) {
    SCOPED_TRACE(fmt::format("seed {} case {}", cases::seed(), index));
    Random random(cases::seed(), 94000 + index);
    PocketOptions options;
    options.method = index % 2 == 0 ? Method::floz_linear : Method::floz_quadratic;
    options.sampling = 1, options.step_over = random.uniform(0.2, 0.5);
    const auto way = geom::sincos(random.uniform(0, kTurn));
    const Point start = random.uniform(5, 15) * Point{way.cosine, way.sine};
    const auto path = floz_level(disc, options, start);
    ASSERT_TRUE(path) << path.error().message;
    const std::vector<Point> places = cut_places(*path);
    ASSERT_FALSE(places.empty());
    EXPECT_EQ(places.front(), start);
    double angle = 0, before = norm(start);
    std::size_t turns = 0;
    for (std::size_t i = 1; i < places.size(); ++i) {
      EXPECT_LE(norm(places[i]), 40);
      angle += std::atan2(cross(places[i - 1], places[i]), dot(places[i - 1], places[i]));
      if (options.method == Method::floz_linear || norm(places[i]) > 30) continue;
      if (angle < kTurn * static_cast<double>(turns + 1)) continue;
      // The place is at most a step past the full turn.
      EXPECT_NEAR(norm(places[i]) - before, options.step_over * options.tool_diameter, 0.1);
      before = norm(places[i]), ++turns;
    }
    if (options.method == Method::floz_quadratic) {
      EXPECT_GE(turns, 4U);
    }
  }
}

TEST(MillFloz, EachFragmentsSpiralBeginsAtItsStart) {
  PocketOptions options;
  options.depth = 2, options.step_down = 1;
  const std::vector<Point> starts{{4, 22}, {-3, 55}};
  const geom::RegionIndex pocket(paper_pocket());
  for (const Method method : {Method::floz_linear, Method::floz_quadratic}) {
    options.method = method, options.starts.clear();
    const auto peaks = pocket_path(paper_pocket(), options);
    options.starts = starts;
    const auto path = pocket_path(paper_pocket(), options);
    ASSERT_TRUE(peaks && path) << path.error().message;
    EXPECT_EQ(path->fronts, 3U);
    std::vector<Point> down, peaks_down;
    for (const PathMove& move : peaks->moves)
      if (move.kind == PathMove::Kind::plunge && move.z < 0) peaks_down.push_back(move.to);
    for (const PathMove& move : path->moves) {
      if (move.kind == PathMove::Kind::plunge && move.z < 0) down.push_back(move.to);
      // What is above a start's level stays: no way through it at depth.
      EXPECT_NE(move.kind, PathMove::Kind::link);
      if (move.z >= 0) continue;
      EXPECT_TRUE(pocket.contains(move.to));
      EXPECT_GE(pocket.nearest(move.to).distance, 3 - 0.01);
    }
    for (const Point start : starts) EXPECT_EQ(std::count(down.begin(), down.end(), start), 2 + 1);
    // The third, in the half-disc, begins at its peak as before.
    EXPECT_EQ(std::count_if(down.begin(), down.end(), [](Point p) { return p.y < 0; }), 2 + 1);
    for (const Point p : down)
      if (p.y < 0) {
        EXPECT_EQ(std::count(peaks_down.begin(), peaks_down.end(), p), 2 + 1);
      }
  }
}

TEST(MillFloz, ASpiralMayBeginAtThePeak) {
  // In the middle of a square the gradient is rounding alone.
  const Region square = ring_of({{-20, -20}, {20, -20}, {20, 20}, {-20, 20}}, {});
  PocketOptions options;
  options.method = Method::floz_quadratic;
  const auto path = floz_level(square, options, Point{0, 0});
  ASSERT_TRUE(path) << path.error().message;
  const std::vector<Point> places = cut_places(*path);
  ASSERT_GT(places.size(), 100U);
  EXPECT_EQ(places.front(), (Point{0, 0}));
  EXPECT_GT(norm(places.back()), 17);
}

TEST(MillFloz, StartsThatBeginNothingAreRefused) {
  PocketOptions options;
  options.method = Method::floz_quadratic;
  const auto refusal = [&](const std::vector<Point>& starts) {
    options.starts = starts;
    const auto path = pocket_path(paper_pocket(), options);
    return path ? std::string() : path.error().message;
  };
  EXPECT_NE(refusal({{28, 20}}).find("(28, 20) is no place to cut"), std::string::npos);
  EXPECT_NE(refusal({{0, 20}, {5, 60}, {1, 10}}).find("(0, 20) and (1, 10)"), std::string::npos);
  EXPECT_NE(refusal({{0, 40}}).find("has no step"), std::string::npos);  // on the border of two
  EXPECT_NE(refusal({{std::nan(""), 0}}).find("coordinate"), std::string::npos);
}

TEST(IoVoxelPictures, ValueAndGradientAreReadBackFromThePicturesAlone) {
  PocketOptions options;
  options.method = Method::floz_quadratic;
  const auto grid = floz_field(paper_pocket(), options, 60);
  ASSERT_TRUE(grid);
  for (const std::uint16_t palette : {std::uint16_t{255}, std::uint16_t{65535}}) {
    const field::VoxelImages images = field::voxel_images(*grid, palette);
    const auto bytes = draw::voxel_pngs(images);
    ASSERT_TRUE(bytes) << bytes.error().message;
    const auto read = cases::parse_voxel_pngs(*bytes);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->images, images.images);
    EXPECT_EQ(read->palette, palette);
    EXPECT_EQ(read->frame.pitch, grid->frame.pitch);
    for (std::size_t n = 0; n < grid->frame.size(); n += 7) {
      const std::size_t i = n % grid->frame.columns, j = n / grid->frame.columns;
      const field::Jet node{static_cast<double>(grid->value[n]),
                            {static_cast<double>(grid->dx[n]), static_cast<double>(grid->dy[n])}};
      const cases::ReadingError error = cases::reading_error(*read, i, j, node);
      EXPECT_LE(std::abs(cases::read_node(*read, i, j).value - node.value), error.value);
    }
    auto [a, b, c, d] = *bytes;
    const auto swapped = cases::parse_voxel_pngs({b, a, c, d});
    ASSERT_FALSE(swapped);
    EXPECT_EQ(swapped.error().message.front(), 'A');
    c[c.size() / 2] = static_cast<char>(c[c.size() / 2] ^ 1);
    EXPECT_FALSE(cases::parse_voxel_pngs({a, b, c, d}));
    EXPECT_FALSE(cases::parse_voxel_pngs({a, "", c, d}));
  }
}

TEST(MillFeeds, FollowTheLoadInStepsThatHold) {
  PocketPath path;
  path.moves = {{PathMove::Kind::rapid, {0, 0}, 5},
                {PathMove::Kind::plunge, {0, 0}, -1},
                {PathMove::Kind::cut, {20, 0}, -1},
                {PathMove::Kind::cut, {20, 20}, -1, EdgeKind::arc_ccw, {20, 10}},
                {PathMove::Kind::link, {0, 20}, -1}};
  std::vector<std::vector<MoveLoad>> loads(5);
  for (int i = 0; i < 100; ++i) loads[2].push_back({0.2, i < 50 ? 20.0 : 78.0});
  for (int i = 0; i < 100; ++i) loads[3].push_back({0.31415926, i < 50 ? 78.0 : 160.0});
  loads[4].push_back({20, 0});
  const FeedOptions options{1000, 3000, 0.4};
  const PocketPath result = with_feeds(path, loads, options);
  ASSERT_EQ(result.moves.size(), 7U);
  EXPECT_NEAR(result.moves[2].feed, 1000 * std::cbrt(9), 1e-6);  // sin 78.5 / sin 20 is 2.87: the step below
  EXPECT_NEAR(result.moves[2].to.x, 9, 0.21);                    // slower 1 mm before the load
  EXPECT_EQ(result.moves[3].feed, 1000);
  EXPECT_EQ(result.moves[4].feed, 1000);
  EXPECT_EQ(result.moves[5].feed, 500);
  EXPECT_EQ(result.moves[5].to, path.moves[3].to);
  EXPECT_NEAR(norm(result.moves[4].to - Point{20, 10}), 10, 1e-9);
  EXPECT_EQ(result.moves[6].feed, 0);
}

/// At 5 times the feed a chip as thick as the one of 78.5 degrees is met at 11.3.
TEST(MillFeeds, WhatOfALinkCutsIsACut) {
  PocketPath path;
  path.moves = {{PathMove::Kind::rapid, {0, 0}, 5},
                {PathMove::Kind::plunge, {0, 0}, -1},
                {PathMove::Kind::link, {20, 0}, -1},
                {PathMove::Kind::link, {20, 20}, -1, EdgeKind::arc_ccw, {20, 10}},
                {PathMove::Kind::link, {0, 20}, -1}};
  std::vector<std::vector<MoveLoad>> loads(5);
  for (int i = 0; i < 100; ++i) loads[2].push_back({0.2, i >= 40 && i < 50 ? 40.0 : 11.0});
  for (int i = 0; i < 100; ++i) loads[3].push_back({0.31415926, i < 5 ? 60.0 : 0.0});
  loads[4].push_back({20, 11});
  const PocketPath result = with_cutting_links_slow(path, loads, {1000, 1000, 0.4}, 5000);
  ASSERT_EQ(result.moves.size(), 8U);
  const auto expect = [&](std::size_t i, PathMove::Kind kind, double x) {
    EXPECT_EQ(result.moves[i].kind, kind) << i;
    EXPECT_NEAR(result.moves[i].to.x, x, 1e-9) << i;
  };
  expect(2, PathMove::Kind::link, 7);  // a mm before
  expect(3, PathMove::Kind::cut, 11);
  expect(4, PathMove::Kind::link, 20);
  EXPECT_EQ(result.moves[5].kind, PathMove::Kind::cut);
  EXPECT_NEAR(norm(result.moves[5].to - Point{20, 10}), 10, 1e-9);
  EXPECT_EQ(result.moves[6].kind, PathMove::Kind::link);
  EXPECT_EQ(result.moves[6].to, path.moves[3].to);
  expect(7, PathMove::Kind::link, 0);
  EXPECT_EQ(with_cutting_links_slow(path, loads, {1000, 1000, 0.4}, 900).moves.size(), path.moves.size());
}

}  // namespace
}  // namespace lekalo::mill::mill_floz_test

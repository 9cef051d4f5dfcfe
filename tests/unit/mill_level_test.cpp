#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "lekalo/geom/region_index.hpp"
#include "mill/front/fields.hpp"
#include "mill/level/entry.hpp"
#include "mill/level/tool_motion.hpp"
#include "mill/level/wall_way.hpp"
#include "mill/path/edge_path.hpp"
#include "mill/path/mirror.hpp"

namespace lekalo::mill::mill_level_test {
namespace {

using geom::Edge;
using geom::EdgeKind;
using geom::Point;
using geom::Region;

Region polygon(const std::vector<Point>& corners) {
  geom::Contour contour;
  for (std::size_t i = 0; i < corners.size(); ++i)
    contour.push_back({EdgeKind::line, corners[i], corners[(i + 1) % corners.size()], {}});
  return *geom::make_region(contour);
}

Region square(double half) { return polygon({{-half, -half}, {half, -half}, {half, half}, {-half, half}}); }

Region disc(double r) { return *geom::make_region({{EdgeKind::arc_ccw, {r, 0}, {r, 0}, {0, 0}}}); }

/// Rooms of 20 mm left and right of x = 0, and 10 mm of a way 0.6 mm wide between them.
Region two_rooms() {
  return polygon({{-25, -10},
                  {-5, -10},
                  {-5, -0.3},
                  {5, -0.3},
                  {5, -10},
                  {25, -10},
                  {25, 10},
                  {5, 10},
                  {5, 0.3},
                  {-5, 0.3},
                  {-5, 10},
                  {-25, 10}});
}

constexpr double kRadius = 3;  // mm

Piece piece_of(const Region& allowed) { return *find_fields(allowed, kRadius, {}); }

TEST(MillLevel, FieldsKeepAStripOffTheWallsAndRoundCorners) {
  const Piece piece = piece_of(square(20));
  EXPECT_NEAR(piece.fields.index.nearest({20, 0}).distance, piece.strip, 1e-9);
  EXPECT_GT(piece.fields.index.nearest({20, 20}).distance, 2 * piece.strip);
  EXPECT_TRUE(piece.narrow.regions.empty());
}

TEST(MillLevel, ANarrowWayBetweenRoomsIsACorridor) {
  const Piece piece = piece_of(two_rooms());
  EXPECT_EQ(piece.fields.regions.size(), 2U);
  ASSERT_EQ(piece.narrow.regions.size(), 1U);
  EXPECT_TRUE(piece.narrow.index.contains({0, 0}));
  EXPECT_TRUE(piece.narrow.index.contains({5.1, 0}));
  EXPECT_FALSE(piece.narrow.index.contains({15, 0}));
}

TEST(MillLevel, FieldsHoldWhatOtherToolsHaveCleared) {
  const auto piece = find_fields(square(20), kRadius, {square(20)});
  ASSERT_TRUE(piece.has_value());
  EXPECT_NEAR(piece->fields.index.nearest({20, 20}).distance, 0, 1e-9);
}

TEST(MillLevel, TheEntryIsTheWidestDisc) {
  const Entry entry = widest_disc({square(2), polygon({{10, 0}, {30, 0}, {30, 12}, {10, 12}})}, kRadius);
  EXPECT_NEAR(entry.disc, 6, 1e-5);
  EXPECT_NEAR(entry.centre.y, 6, 1e-5);
  EXPECT_NEAR(entry.helix, 0.8 * kRadius, 1e-9);
  const Entry small = widest_disc({square(1)}, kRadius);
  EXPECT_EQ(small.helix, small.disc);
}

TEST(MillLevel, AWayAlongAWallGoesRoundCornersEitherWay) {
  const geom::RegionIndex walls({square(10)});
  for (const auto& [from, to] : {std::pair{Point{10, 9}, Point{9, 10}}, {Point{9, 10}, Point{10, 9}}}) {
    const auto way = way_along_wall(walls, from, to, 2.1);
    ASSERT_TRUE(way.has_value());
    ASSERT_EQ(way->size(), 2U);
    EXPECT_EQ(way->front().from, from);
    EXPECT_EQ(way->front().to, (Point{10, 10}));
    EXPECT_EQ(way->back().to, to);
    EXPECT_FALSE(way_along_wall(walls, from, to, 1.9).has_value());
  }
  EXPECT_FALSE(way_along_wall(walls, {10, 9}, {9, 9.9}, 10).has_value());
}

TEST(MillLevel, AWayAlongACirclePassesItsSeam) {
  const geom::RegionIndex walls({disc(5)});
  for (const auto& [from, to] : {std::pair{Point{4, -3}, Point{4, 3}}, {Point{4, 3}, Point{4, -3}}}) {
    const auto way = way_along_wall(walls, from, to, 7);
    ASSERT_TRUE(way.has_value());
    EXPECT_NEAR(length_of(*way), 10 * 0.6435011087932844, 1e-9);
  }
}

TEST(MillLevel, TheEndsOfAnArcAreAlikeFarFromItsCentre) {
  const Piece piece = piece_of(square(20));
  ToolMotion tool(piece, PocketOptions{});
  tool.go(PathMove::Kind::cut, Point{0, 0});
  tool.go(PathMove::Kind::cut, Point{0, 0});
  EXPECT_EQ(tool.moves().size(), 1U);
  tool.go(PathMove::Kind::cut, Edge{EdgeKind::arc_ccw, {0, 0}, {2, 0}, {1.1, 0.5}});
  EXPECT_EQ(tool.moves().back().centre, (Point{1, 0.5}));
  EXPECT_EQ(tool.at(), (Point{2, 0}));
}

TEST(MillLevel, ALinkLiftsOnlyWhereThereIsNoWayAtDepth) {
  const Piece piece = piece_of(two_rooms());
  ToolMotion tool(piece, PocketOptions{});
  tool.come_down({-20, 0});
  tool.set_growth(Growth{{}, {piece.fields.regions}});
  tool.link({-10, 5});
  EXPECT_EQ(tool.moves().back().kind, PathMove::Kind::link);
  tool.link({20, 0});
  EXPECT_EQ(tool.moves().back().kind, PathMove::Kind::plunge);
  EXPECT_EQ(tool.at(), (Point{20, 0}));
}

TEST(MillLevel, AMirrorTurnsSidesAndDirections) {
  const auto other = mirrored({polygon({{1, 0}, {4, 0}, {4, 2}})});
  ASSERT_TRUE(other.has_value());
  const geom::RegionIndex index(*other);
  EXPECT_TRUE(index.contains({-3, 0.5}));
  EXPECT_FALSE(index.contains({3, 0.5}));
  EXPECT_NEAR(geom::area(*other), 3, 1e-12);
  const PathMove arc{.to = {2, 1}, .shape = EdgeKind::arc_ccw, .centre = {1, 1}};
  const PocketPath path = mirrored(PocketPath{{arc}, 1});
  EXPECT_EQ(path.moves[0].to, (Point{-2, 1}));
  EXPECT_EQ(path.moves[0].centre, (Point{-1, 1}));
  EXPECT_EQ(path.moves[0].shape, EdgeKind::arc_cw);
}

}  // namespace
}  // namespace lekalo::mill::mill_level_test

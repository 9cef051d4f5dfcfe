#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "lekalo/geom/predicates.hpp"
#include "lekalo/io/contour/contour_file.hpp"
#include "support/cases.hpp"
#include "support/io_contours.hpp"
#include "support/ring_distance.hpp"

namespace lekalo::io_convex_test {
namespace {

using io_cases::GridPoint;
using io_cases::GridRing;

io::ContourFile read(const std::string& text, const std::string& name = "blank.csv") {
  auto file = io::parse_contour(text, name, std::nullopt);
  EXPECT_TRUE(file.has_value()) << file.error().message;
  return *std::move(file);
}

/// What must hold of every accepted contour, whatever it is.
void check_consistent(const io::ContourFile& file, const io::ConvexContour& contour) {
  const std::size_t n = file.points.size();
  std::set<std::size_t> seen(contour.dropped.begin(), contour.dropped.end());
  EXPECT_EQ(seen.size(), contour.dropped.size());
  EXPECT_TRUE(std::is_sorted(contour.dropped.begin(), contour.dropped.end()));
  for (std::size_t k = 0; k < contour.polygon.size(); ++k) {
    const std::size_t index = contour.file_index_of_vertex[k];
    ASSERT_LT(index, n);
    EXPECT_EQ(file.points[index], contour.polygon[k]);
    EXPECT_TRUE(seen.insert(index).second) << "both kept and dropped";

    // docs/formats.md: edge e runs from file point e to the next point that was not dropped, in file order.
    const std::size_t edge = contour.file_edge(k);
    std::size_t next = (edge + 1) % n;
    while (std::binary_search(contour.dropped.begin(), contour.dropped.end(), next)) next = (next + 1) % n;
    const geom::Point from = contour.polygon[k], to = contour.polygon[contour.polygon.next(k)];
    EXPECT_EQ(file.points[edge], contour.reversed ? to : from);
    EXPECT_EQ(file.points[next], contour.reversed ? from : to);
  }
  EXPECT_EQ(seen.size(), n) << "every point is kept or dropped";
  // The distance is evaluated in plain doubles here, hence the last term.
  const double moved =
      contour.coordinate_error - file.coordinate_error + 1e-15 * geom::largest_coordinate(file.points);
  for (const geom::Point p : file.points) {
    EXPECT_LE(cases::distance_to_boundary(p, contour.polygon.vertices()), moved);
  }
}

/// Every way to write one contour.
std::vector<GridRing> writings(const GridRing& ring, Random& random) {
  std::vector<GridRing> all{ring, io_cases::reversed(ring)};
  for (int i = 0; i < 3; ++i) {
    GridRing other = io_cases::begun_at(i == 1 ? io_cases::reversed(ring) : ring, random.below(ring.size()));
    for (int copies = 0; copies < 3; ++copies) {
      const auto at = other.begin() + static_cast<std::ptrdiff_t>(random.below(other.size()));
      other.insert(at, *at);
    }
    other.push_back(other.front());
    if (i == 2) other.push_back(other.front());
    all.push_back(other);
  }
  return all;
}

TEST(IoConvexProperty, DecimalsOnStraightEdgesAreDroppedInEveryWritingOfTheContour) {
  const std::uint64_t seed = cases::seed();
  for (std::size_t c = 0; c < cases::case_count(300); ++c) {
    SCOPED_TRACE(fmt::format("seed {} case {}", seed, c));
    Random random(seed, c);
    const int digits = static_cast<int>(random.below(7));
    const auto pieces = static_cast<std::int64_t>(1 + random.below(40));
    const GridRing corners = io_cases::convex_corners(random, 3 + random.below(20), 4000 * pieces, pieces);
    const std::int64_t far = c % 5 == 0 ? 100'000'000 : static_cast<std::int64_t>(random.below(100'000));
    const GridRing ring = io_cases::moved(io_cases::subdivided(corners, pieces), {far, -far / 3});
    std::optional<geom::Ring> first;
    for (const GridRing& writing : writings(ring, random)) {
      const io::ContourFile file = read(io_cases::csv(writing, digits));
      const auto contour = io::make_convex(file);
      ASSERT_TRUE(contour.has_value()) << contour.error().message;
      check_consistent(file, *contour);
      EXPECT_EQ(contour->polygon.size(), corners.size());
      if (!first) first = io_cases::canonical(contour->polygon);
      EXPECT_EQ(io_cases::canonical(contour->polygon), *first);
      EXPECT_LE(contour->coordinate_error, 4 * file.coordinate_error);
      if (digits == 0) {
        EXPECT_EQ(contour->coordinate_error, 0);
      }
    }
  }
}

TEST(IoConvexProperty, EveryFormatGivesTheSamePointsToTheBit) {
  const std::uint64_t seed = cases::seed();
  for (std::size_t c = 0; c < cases::case_count(100); ++c) {
    SCOPED_TRACE(fmt::format("seed {} case {}", seed, c));
    Random random(seed, c);
    const int digits = static_cast<int>(random.below(5));
    const GridRing ring =
        io_cases::subdivided(io_cases::convex_corners(random, 4 + random.below(20), 40000, 4), 2);
    const io::ContourFile csv = read(io_cases::csv(ring, digits));
    for (const io::ContourFile& other :
         {read(io_cases::json(ring, digits), "a.json"), read(io_cases::region(ring, digits), "a.json"),
          read(io_cases::dxf_entities(io_cases::polyline(ring, digits)), "a.dxf"),
          read(io_cases::dxf_entities(io_cases::lines(ring, digits, random)), "a.dxf")}) {
      EXPECT_EQ(other.points, csv.points);
      EXPECT_EQ(other.coordinate_error, csv.coordinate_error);
    }
  }
}

/// A dent of one step of the last digit, as small as 1e-6 mm, is a dent.
TEST(IoConvexProperty, OnePointOneStepInsideIsNamed) {
  const std::uint64_t seed = cases::seed();
  for (std::size_t c = 0; c < cases::case_count(200); ++c) {
    SCOPED_TRACE(fmt::format("seed {} case {}", seed, c));
    Random random(seed, c);
    const int digits = static_cast<int>(random.below(7));
    constexpr std::int64_t kPieces = 6;
    const GridRing corners = io_cases::convex_corners(random, 3 + random.below(8), 60000, kPieces);
    GridRing ring = io_cases::subdivided(corners, kPieces);
    // The middle of an edge, one step to its left along the shorter axis.
    const std::size_t edge = random.below(corners.size());
    const std::size_t dent = edge * kPieces + kPieces / 2;
    const GridPoint a = corners[edge], b = corners[(edge + 1) % corners.size()];
    if (std::abs(b.x - a.x) >= std::abs(b.y - a.y)) {
      ring[dent].y += b.x > a.x ? 1 : -1;
    } else {
      ring[dent].x += b.y > a.y ? -1 : 1;
    }
    const std::size_t start = random.below(ring.size());
    const auto refused = io::make_convex(read(io_cases::csv(io_cases::begun_at(ring, start), digits)));
    ASSERT_FALSE(refused.has_value());
    const std::size_t index = (dent + ring.size() - start) % ring.size();
    EXPECT_NE(refused.error().message.find(fmt::format("point {} (line {}:", index, index + 1)),
              std::string::npos)
        << refused.error().message;
    EXPECT_NE(refused.error().message.find("--trim"), std::string::npos);
  }
}

TEST(IoConvexProperty, ALongEdgeOfManyPointsDoesNotDrift) {
  // A shallow arc: each point is within the rounding of its neighbours' chord, the whole is not straight.
  for (const double sagitta : {1e-9, 1e-7}) {
    io::ContourFile file;
    file.name = "arc.csv";
    constexpr int kPoints = 5000;
    for (int i = 0; i <= kPoints; ++i) {
      const double x = 1000.0 * i / kPoints;
      file.points.push_back({x, sagitta * (x / 500 - 1) * (x / 500 - 1) - sagitta});
    }
    file.points.push_back({1000, 700});
    file.points.push_back({0, 700});
    file.places.assign(file.points.size(), 1);
    file.coordinate_error = 1e-12;
    const auto contour = io::make_convex(file);
    ASSERT_TRUE(contour.has_value()) << contour.error().message;
    check_consistent(file, *contour);
    EXPECT_GT(contour->polygon.size(), 10U);
    EXPECT_LT(contour->polygon.size(), 1000U);
    EXPECT_LE(contour->coordinate_error, 4.01e-12);
  }
}

TEST(IoConvexProperty, NoiseWithinTheCoordinateErrorNeverRefuses) {
  const std::uint64_t seed = cases::seed();
  for (std::size_t c = 0; c < cases::case_count(200); ++c) {
    SCOPED_TRACE(fmt::format("seed {} case {}", seed, c));
    Random random(seed, c);
    const auto polygon = cases::regular_ngon(3 + random.below(9), 100, {random.uniform(-1e3, 1e3), 50}, 0.1);
    io::ContourFile file;
    file.name = "noisy.csv";
    file.points = cases::with_points_on_edges(polygon, 400);
    file.coordinate_error = 1e-9;
    for (geom::Point& p : file.points) {
      p = p + geom::Point{random.uniform(-1e-9, 1e-9), random.uniform(-1e-9, 1e-9)};
    }
    file.places.assign(file.points.size(), 1);
    const auto contour = io::make_convex(file);
    ASSERT_TRUE(contour.has_value()) << contour.error().message;
    check_consistent(file, *contour);
    EXPECT_EQ(contour->polygon.size(), polygon.size());
  }
}

// ----------------------------------------------------------------------------------------------------------
// trim

/// Exact: the polygon's interior holds no piece of the contour, and its vertices are not outside.
void check_inside(const geom::ConvexPolygon& polygon, const geom::Ring& contour) {
  const geom::Ring& inner = polygon.vertices();
  for (const geom::Point v : inner) EXPECT_NE(geom::locate_point(contour, v), geom::PointLocation::outside);
  for (std::size_t i = 0; i < contour.size(); ++i) {
    const geom::Point a = contour[i], b = contour[(i + 1) % contour.size()];
    EXPECT_NE(geom::locate_point(inner, a), geom::PointLocation::inside);
    for (std::size_t k = 0; k < inner.size(); ++k) {
      EXPECT_NE(geom::segment_relation(a, b, inner[k], inner[polygon.next(k)]), geom::SegmentRelation::cross);
    }
  }
}

TEST(IoTrimProperty, TheTrimmedPolygonLiesInsideAndLosesWhatItSays) {
  const std::uint64_t seed = cases::seed();
  for (std::size_t c = 0; c < cases::case_count(300); ++c) {
    SCOPED_TRACE(fmt::format("seed {} case {}", seed, c));
    Random random(seed, c);
    const auto base =
        cases::regular_ngon(3 + random.below(12), random.uniform(1, 500),
                            {random.uniform(-1e4, 1e4), random.uniform(-1, 1)}, random.uniform(0, 1));
    const double size = geom::bounds(base.vertices()).high.x - geom::bounds(base.vertices()).low.x;
    io::ContourFile file;
    file.name = "probed.csv";
    file.points = cases::with_points_on_edges(base, 10 + random.below(150));
    // Noise of the size of the probe's step would make contours that cross themselves.
    double step = size;
    for (std::size_t k = 0; k + 1 < file.points.size(); ++k)
      step = std::min(step, norm(file.points[k + 1] - file.points[k]));
    const double noise = std::min(0.25 * step, size * std::pow(10.0, -random.uniform(1.5, 14)));
    for (geom::Point& p : file.points)
      p = p + geom::Point{random.uniform(-noise, noise), random.uniform(-noise, noise)};
    if (c % 2 == 1) std::reverse(file.points.begin(), file.points.end());
    file.places.assign(file.points.size(), 1);
    file.coordinate_error = c % 3 == 0 ? 0 : 0x1p-53 * geom::largest_coordinate(file.points);
    const auto trimmed = io::trim_to_convex(file, 3 * noise);
    ASSERT_TRUE(trimmed.has_value()) << trimmed.error().message;
    check_inside(trimmed->polygon, file.points);
    EXPECT_LE(trimmed->loss, 3 * noise + 1e-12 * size + 1e-13 * geom::largest_coordinate(file.points));
    // What is deeper than the loss below every hull edge is still there: the corners of the hull moved in by
    // it.
    const auto hull = cases::hull(file.points);
    for (int probe = 0; probe < 50; ++probe) {
      const double angle = random.uniform(0, 6.283);
      const geom::Point p = 0.7 * size * random.uniform() * geom::Point{std::cos(angle), std::sin(angle)} +
                            0.5 * (geom::bounds(file.points).low + geom::bounds(file.points).high);
      double depth = size;
      for (std::size_t k = 0; k < hull.size(); ++k) {
        const geom::Point a = hull[k], d = hull[hull.next(k)] - a;
        depth = std::min(depth, cross(d, p - a) / norm(d));
      }
      if (depth > trimmed->loss * (1 + 1e-9) + 1e-12 * size) {
        EXPECT_NE(geom::locate_point(trimmed->polygon.vertices(), p), geom::PointLocation::outside);
      }
    }
  }
}

}  // namespace
}  // namespace lekalo::io_convex_test

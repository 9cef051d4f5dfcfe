#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "support/drawn_text.hpp"
#include "verify/origin/scan_check.hpp"
#include "verify/read/json.hpp"
#include "verify/shape/shape_distance.hpp"

/// When the checker agrees that measured points prove a blank to be material.
namespace lekalo::verify::verify_scan_check_test {
namespace {

std::string region(double low, double high) {
  return fmt::format(
      R"({{"outer": [{{"line": {{"from": [{0}, {0}], "to": [{1}, {0}]}}}}, {{"line": {{"from": [{1}, {0}], "to": [{1}, {1}]}}}},
        {{"line": {{"from": [{1}, {1}], "to": [{0}, {1}]}}}}, {{"line": {{"from": [{0}, {1}], "to": [{0}, {0}]}}}}]}})",
      low, high);
}
Shape shape(const std::string& text) {
  std::string complaint;
  Shape read = read_shape(*parse_json(text, "b.json"), "b.json", complaint, false);
  EXPECT_EQ(complaint, "");
  return read;
}
/// Points along a square from 0 to `size`, counter-clockwise from the corner (0, 0), `step` apart.
MeasuredPoints square(double size, double step, MeasuredPoints points = {}, double from = 0) {
  points.contour_starts.push_back(points.at.size());
  const auto add = [&](double x, double y) { points.at.push_back({just(from + x), just(from + y)}); };
  for (double t = 0; t < size; t += step) add(t, 0);
  for (double t = 0; t < size; t += step) add(size, t);
  for (double t = size; t > 0; t -= step) add(t, size);
  for (double t = size; t > 0; t -= step) add(0, t);
  return points;
}
/// The words of a scan in order, with a guard of 0.1 and a step of 1.
WrittenScan ordered(const MeasuredPoints& points) {
  WrittenScan scan;
  scan.points = points.at.size(), scan.ordered = true;
  scan.guard = just(0.1), scan.step = just(1), scan.loss = just(1.5);
  return scan;
}
std::string judged(const WrittenScan& scan, const MeasuredPoints& points, const std::string& blank) {
  const Shape shaped = shape(blank);
  const ScanVerdict verdict = check_scan(scan, points, shaped);
  return verdict.fault + (verdict.open.empty() ? "" : "open") + (verdict.unknown ? "unknown" : "");
}

TEST(VerifyScanCheck, ABlankThatKeepsTheGuardIsProved) {
  const MeasuredPoints points = square(10, 1);
  EXPECT_EQ(judged(ordered(points), points, region(0.11, 9.89)), "");
  EXPECT_EQ(judged(ordered(points), points, region(0.1, 9.9)).substr(0, 31),
            "the blank comes nearer than 0.1");
  EXPECT_EQ(judged(ordered(points), points, region(0.09, 9.91)).substr(0, 31),
            "the blank comes nearer than 0.1");
  EXPECT_EQ(judged(ordered(points), points, region(-1, 11)),
            "the outline through the point at (0, 0) runs within the blank");
  EXPECT_EQ(judged(ordered(points), points, region(20, 21)).substr(0, 32),
            "the blank is farther than the lo");
}

TEST(VerifyScanCheck, TheBlankLosesNoMoreThanIsSaid) {
  const MeasuredPoints points = square(10, 1);
  WrittenScan scan = ordered(points);
  scan.loss = just(1.5);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "");  // the corners are 1.485 away
  EXPECT_EQ(judged(scan, points, region(1.07, 8.93)).substr(0, 41),
            "the blank is farther than the loss of 1.5");
  scan.loss = just(1.6);
  EXPECT_EQ(judged(scan, points, region(1.07, 8.93)), "");
}

TEST(VerifyScanCheck, PointsAreCountedAndLeftOut) {
  MeasuredPoints points = square(10, 1);
  WrittenScan scan = ordered(points);
  scan.points = 39;
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "there are 40 points, not 39");
  scan.points = 40, scan.left_out = {40};
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "there is no point 40 to be left out");
  // A stray point within the blank is told, unless it is left out; then a gap of 2 is left.
  points.at[5] = {just(5), just(5)};
  scan.left_out = {};
  EXPECT_NE(judged(scan, points, region(1.05, 8.95)), "");
  scan.left_out = {5};
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "unknown");
  scan.step = just(2);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "");
}

TEST(VerifyScanCheck, AGapIsBridgedByARadiusOrADip) {
  const MeasuredPoints points = square(10, 2);
  WrittenScan scan = ordered(points);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "unknown");
  scan.step = just(2);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "");
  // Between two points 2 apart an outline whose radii are at least 1.35 dips by 0.6: 1.35 - sqrt(1.25^2 - 1).
  scan.step = just(1), scan.min_radius = just(1.35);
  EXPECT_EQ(judged(scan, points, region(0.61, 9.39)), "");
  EXPECT_EQ(judged(scan, points, region(0.59, 9.41)).substr(0, 28), "the blank comes nearer than ");
  scan.min_radius = just(1.11);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "");
  scan.min_radius = just(1.09);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "unknown");
  // The lesser of what a radius and a dip say counts.
  scan.max_dip = just(0.3);
  EXPECT_EQ(judged(scan, points, region(0.41, 9.59)), "");
  EXPECT_EQ(judged(scan, points, region(0.39, 9.61)).substr(0, 28), "the blank comes nearer than ");
  scan.min_radius = just(1.35), scan.max_dip = just(0.6);
  EXPECT_EQ(judged(scan, points, region(0.61, 9.39)), "");
  scan.min_radius.reset(), scan.max_dip = just(0.3);
  EXPECT_EQ(judged(scan, points, region(0.41, 9.59)), "");
}

TEST(VerifyScanCheck, ContoursHaveThreePointsAndTellHolesFromMaterial) {
  MeasuredPoints none;
  EXPECT_EQ(judged(ordered(none), none, region(1.05, 8.95)), "the scan has no contour");
  MeasuredPoints two;
  two.at = {{just(0), just(0)}, {just(1), just(0)}, {just(1), just(0)}, {just(0), just(0)}};
  two.contour_starts = {0};
  EXPECT_EQ(judged(ordered(two), two, region(1.05, 8.95)),
            "a contour of the scan has fewer than three points");
  // A second outline about the blank makes its inside no material; one elsewhere says nothing of it.
  const MeasuredPoints twice = square(16, 1, square(10, 1), -3);
  WrittenScan scan = ordered(twice);
  scan.loss = just(20);
  EXPECT_EQ(judged(scan, twice, region(1.05, 8.95)),
            "piece 0 of the blank is not inside the outlines through the points");
  const MeasuredPoints beside = square(5, 1, square(10, 1), 30);
  scan = ordered(beside), scan.loss = just(60);
  EXPECT_EQ(judged(scan, beside, region(1.05, 8.95)), "");
  EXPECT_EQ(judged(scan, beside, region(31.05, 33.95)), "");
  EXPECT_EQ(judged(scan, beside, region(15, 20)),
            "piece 0 of the blank is not inside the outlines through the points");
  // Turned the other way round the same is inside.
  MeasuredPoints turned = square(10, 1);
  std::reverse(turned.at.begin(), turned.at.end());
  EXPECT_EQ(judged(ordered(turned), turned, region(1.05, 8.95)), "");
  // A point twice in a row is one corner.
  MeasuredPoints doubled = square(10, 1);
  doubled.at.insert(doubled.at.begin() + 3, doubled.at[3]);
  doubled.at.push_back(doubled.at.front());
  EXPECT_EQ(judged(ordered(doubled), doubled, region(1.05, 8.95)), "");
}

// ---- points in no order -----------------------------------------------------------------------------------

/// Corners of the outline first, then points beside its edges.
MeasuredPoints scattered(std::initializer_list<std::array<double, 2>> beside) {
  MeasuredPoints points;
  points.contour_starts = {0};
  for (const auto& p : {std::array{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}, {0.0, 10.0}})
    points.at.push_back({just(p[0]), just(p[1])});
  for (const auto& p : beside) points.at.push_back({just(p[0]), just(p[1])});
  return points;
}
WrittenScan unordered(const MeasuredPoints& points) {
  WrittenScan scan = ordered(points);
  scan.ordered = false, scan.step = just(10);
  scan.outlines = {{0, 1, 2, 3}};
  return scan;
}

TEST(VerifyScanCheck, OutlinesThroughPointsInNoOrderAreAsWritten) {
  const MeasuredPoints points = scattered({});
  WrittenScan scan = unordered(points);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "");
  scan.outlines = {};
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "there are no outlines through the points");
  scan.outlines = {{0, 1, 4, 3}};
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "an outline has a point 4");
  scan.outlines = {{0, 1, 2, 3, 1}};
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "two outlines, or one twice, have point 1");
  scan.outlines = {{0, 1}};
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "a contour of the scan has fewer than three points");
  scan.outlines = {{0, 1, 2, 3}}, scan.left_out = {2};
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "an outline has a point 2");
  scan.outlines = {{0, 1, 3}};
  EXPECT_NE(judged(scan, points, region(1.05, 8.95)), "");
}

TEST(VerifyScanCheck, EveryOtherPointWasMeasuredNearACorner) {
  // Corners spread by the larger of six guards and an eighth of the step.
  WrittenScan scan = unordered(scattered({{1.2, 0}}));
  EXPECT_EQ(judged(scan, scattered({{1.2, 0}}), region(1.05, 8.95)), "");
  EXPECT_EQ(judged(scan, scattered({{1.3, 0}}), region(1.05, 8.95)),
            "point 4 is at no outline through the points");
  scan.step = just(1), scan.max_dip = just(0.1);
  EXPECT_EQ(judged(scan, scattered({{0.59, 0}}), region(1.05, 8.95)), "");
  EXPECT_EQ(judged(scan, scattered({{0.61, 0}}), region(1.05, 8.95)),
            "point 4 is at no outline through the points");
  scan.left_out = {4};
  EXPECT_EQ(judged(scan, scattered({{0.61, 0}}), region(1.05, 8.95)), "");
}

TEST(VerifyScanCheck, ABlankKeepsAwayFromWhatLiesBetweenPointsBesideAnEdge) {
  const MeasuredPoints points = scattered({{1, 0.6}, {9, 0.6}});
  WrittenScan scan = unordered(points);
  EXPECT_EQ(judged(scan, points, region(0.8, 9.2)), "");
  EXPECT_EQ(judged(scan, points, region(0.65, 9.35)), "open");
  scan.max_dip = just(0.2);
  EXPECT_EQ(judged(scan, points, region(0.95, 9.05)), "");
  EXPECT_EQ(judged(scan, points, region(0.85, 9.15)), "open");
}

TEST(VerifyScanCheck, PointsBesideAnEdgeShortenItsGap) {
  WrittenScan scan = unordered(scattered({{1.2, 0}}));
  scan.step = just(9.8);
  // The sides without a point between are too long.
  EXPECT_EQ(judged(scan, scattered({{1.2, 0}}), region(1.05, 8.95)), "unknown");
  const MeasuredPoints all = scattered({{1.2, 0}, {10, 1.2}, {8.8, 10}, {0, 8.8}});
  scan = unordered(all), scan.step = just(9.8);
  EXPECT_EQ(judged(scan, all, region(1.05, 8.95)), "");
  scan.step = just(8.7), scan.guard = just(0.2);
  EXPECT_EQ(judged(scan, all, region(1.05, 8.95)), "unknown");
  scan.step = just(8.8);
  EXPECT_EQ(judged(scan, all, region(1.05, 8.95)), "");
}

TEST(VerifyScanCheck, ManyPointsBesideAnEdgeAreBoundedByTheirHull) {
  MeasuredPoints points = scattered({});
  for (int k = 0; k < 14; ++k) points.at.push_back({just(0.3 + 0.05 * k), just(k == 6 ? 0.55 : 0.2)});
  WrittenScan scan = unordered(points);
  scan.max_dip = just(0);
  EXPECT_EQ(judged(scan, points, region(0.7, 9.3)), "");
  EXPECT_EQ(judged(scan, points, region(0.62, 9.38)), "open");
}

/// The verdict whose open question has its whole sentence.
ScanVerdict verdict_of(const WrittenScan& scan, const MeasuredPoints& points, const std::string& blank) {
  const Shape shaped = shape(blank);
  return check_scan(scan, points, shaped);
}
/// A region of one contour of lines through these points, with holes.
std::string polygon(const std::vector<std::array<double, 2>>& p,
                    const std::vector<std::vector<std::array<double, 2>>>& holes = {}) {
  const auto contour = [](const std::vector<std::array<double, 2>>& at) {
    std::string edges;
    for (std::size_t k = 0; k < at.size(); ++k)
      edges += fmt::format(R"({}{{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", k == 0 ? "" : ", ",
                           at[k][0], at[k][1], at[(k + 1) % at.size()][0], at[(k + 1) % at.size()][1]);
    return "[" + edges + "]";
  };
  std::string text = R"({"outer": )" + contour(p) + R"(, "holes": [)";
  for (std::size_t h = 0; h < holes.size(); ++h) text += (h == 0 ? "" : ", ") + contour(holes[h]);
  return text + "]}";
}
/// The number next to `about` for which `is` is true.
template <class Is>
double near_to(double about, Is is) {
  double low = about, high = about;
  for (int k = 0; k < 64; ++k, low = step_down(low), high = step_up(high)) {
    if (is(low)) return low;
    if (is(high)) return high;
  }
  ADD_FAILURE() << "none is near to " << about;
  return about;
}

TEST(VerifyScanCheck, PointsAreOneWhereTheirEnclosuresAre) {
  const double more = 10 + 1e-9;
  for (const Vec& third : {Vec{{10, more}, {0, 1e-9}}, Vec{{9, 10 + 1e-8}, {0, 1e-9}},
                           Vec{{9, more}, {-1, 1e-9}}, Vec{{9, more}, {0, 1e-8}}}) {
    MeasuredPoints points;
    points.contour_starts = {0};
    points.at = {{just(0), just(0)}, {{9, more}, {0, 1e-9}}, third};
    EXPECT_NE(judged(ordered(points), points, region(1.05, 8.95)),
              "a contour of the scan has fewer than three points");
    points.at[2] = points.at[1];
    EXPECT_EQ(judged(ordered(points), points, region(1.05, 8.95)),
              "a contour of the scan has fewer than three points");
  }
  MeasuredPoints points = square(10, 1);
  WrittenScan scan = ordered(points);
  for (std::size_t k = 0; k < points.at.size(); ++k) scan.left_out.push_back(k);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "a contour of the scan has fewer than three points");
}

TEST(VerifyScanCheck, ATriangleIsAnOutline) {
  MeasuredPoints points;
  points.contour_starts = {0};
  points.at = {{just(0), just(0)}, {just(10), just(0)}, {just(0), just(10)}};
  WrittenScan scan = ordered(points);
  scan.step = just(15), scan.loss = just(9);
  EXPECT_EQ(judged(scan, points, region(1, 3)), "");
  // The slanting edge passes the blank on its left.
  points.at = {{just(0), just(0)}, {just(10), just(0)}, {just(10), just(10)}};
  EXPECT_EQ(judged(scan, points, polygon({{7, 1}, {9, 1}, {9, 3}, {7, 3}})), "");
}

TEST(VerifyScanCheck, APointAsFarFromSeveralCornersIsBesideAnEdgeOfTheFirst) {
  MeasuredPoints points = square(10, 1);
  const std::size_t count = points.at.size();
  points.at.push_back({just(5), just(5)});
  WrittenScan scan = unordered(points);
  scan.guard = just(1), scan.loss = just(6);
  // The middles of the four sides are 5 from the point, and so are both edges at each.
  for (const std::size_t first : {5U, 15U, 25U, 35U}) {
    scan.outlines = {{}};
    for (std::size_t k = 0; k < count; ++k) scan.outlines[0].push_back((first + k) % count);
    const Vec& corner = points.at[first];
    EXPECT_EQ(verdict_of(scan, points, region(4, 6)).open,
              fmt::format("the blank comes near to points measured beside the edge at ({}, {})", corner.x.low,
                          corner.y.low));
  }
}

TEST(VerifyScanCheck, ANearerCornerCountsBeforeAnEarlierOne) {
  // Beside an edge of the corner at (0, 0), which is the first, the point would be across the blank.
  MeasuredPoints points = square(10, 1);
  const std::size_t count = points.at.size();
  points.at.push_back({just(9.5), just(6)});
  WrittenScan scan = unordered(points);
  scan.guard = just(1.9), scan.loss = just(6), scan.outlines = {{}};
  for (std::size_t k = 0; k < count; ++k) scan.outlines[0].push_back(k);
  EXPECT_EQ(judged(scan, points, region(4, 7)), "");
}

TEST(VerifyScanCheck, ALengthAtTheVeryBoundIsWithinIt) {
  const MeasuredPoints points = scattered({});
  WrittenScan scan = unordered(points);
  const Span width = length(points.at[1] - points.at[0]);
  // A gap as wide as the step.
  scan.step = just(near_to(10 / (1 + 1e-12), [&](double step) { return step * (1 + 1e-12) == width.high; }));
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "");
  scan.step = just(step_down(step_down(scan.step.high)));
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "unknown");
  // A half that the radius less the guard does not exceed is bridged by nothing, whatever the step.
  scan = unordered(points), scan.guard = just(0.5);
  const double half = (width * just(0.5)).high;
  scan.min_radius = just(near_to(half + 0.5, [&](double r) { return (just(r) - scan.guard).low == half; }));
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "unknown");
  scan.min_radius = just(3);
  EXPECT_EQ(judged(scan, points, region(1.05, 8.95)), "unknown");
  // The blank is as far as the loss from the corner at (0, 0).
  scan = unordered(points);
  const double apart = distance(points.at[0], shape(region(1, 9))).low;
  scan.loss = just(near_to(apart - 1e-12, [&](double loss) { return loss + 1e-12 == apart; }));
  EXPECT_EQ(judged(scan, points, region(1, 9)), "");
  scan.loss = just(step_down(step_down(scan.loss.high)));
  EXPECT_NE(judged(scan, points, region(1, 9)), "");
}

TEST(VerifyScanCheck, ABlankAsFarAsTheGuardKeepsIt) {
  MeasuredPoints points;
  points.contour_starts = {0};
  points.at = {{just(10), just(0)}, {just(0), just(10)}, {just(-10), just(0)}, {just(0), just(-10)}};
  const std::string diamond = polygon({{8, 0}, {0, 8}, {-8, 0}, {0, -8}});
  WrittenScan scan = ordered(points);
  scan.step = just(20), scan.loss = just(3);
  const Shape blank = shape(diamond);
  double apart = kInfinity;
  for (std::size_t k = 0; k < 4; ++k)
    apart = std::min(apart, distance(side_between(points.at[k], points.at[(k + 1) % 4]), blank).low);
  scan.guard = just(apart);
  EXPECT_EQ(judged(scan, points, diamond), "");
  scan.guard = just(step_up(apart));
  EXPECT_EQ(judged(scan, points, diamond).substr(0, 27), "the blank comes nearer than");
}

TEST(VerifyScanCheck, ADipNoDeeperThanWhatTheRadiusLeavesCountsForTheEdgeAlone) {
  const MeasuredPoints points = scattered({{1, 0.5}, {9, 0.5}});
  WrittenScan scan = unordered(points);
  scan.min_radius = just(13), scan.loss = just(2);
  const Span g = scan.guard, inner = *scan.min_radius - g,
             half = length(points.at[1] - points.at[0]) * just(0.5);
  const double reach = (*scan.min_radius - square_root((inner - half) * (inner + half))).high;
  scan.max_dip = just(near_to(reach - g.high, [&](double dip) { return (g + just(dip)).high == reach; }));
  EXPECT_EQ(judged(scan, points, region(1.2, 8.8)), "");
  scan.max_dip = just(step_down(step_down(scan.max_dip->high)));
  EXPECT_EQ(judged(scan, points, region(1.2, 8.8)), "open");
}

TEST(VerifyScanCheck, ABlankThatTouchesIsNotApartWithoutAGuard) {
  const MeasuredPoints points = square(10, 1);
  WrittenScan scan = ordered(points);
  scan.guard = just(0);
  EXPECT_EQ(judged(scan, points, region(0, 10)).substr(0, 29), "the blank comes nearer than 0");
  EXPECT_EQ(judged(scan, points, region(0.01, 9.99)), "");
}

TEST(VerifyScanCheck, OneSideOfTheBlankWithinTheLossIsEnough) {
  // The slanting sides of the holes are farther than the loss, and their boxes are not.
  const MeasuredPoints points = square(10, 1);
  WrittenScan scan = ordered(points);
  scan.loss = just(1.6);
  EXPECT_EQ(judged(scan, points,
                   polygon({{1.05, 1.05}, {8.95, 1.05}, {8.95, 8.95}, {1.05, 8.95}},
                           {{{1.1, 3}, {3, 3}, {3, 1.1}},
                            {{8.9, 3}, {7, 1.1}, {7, 3}},
                            {{8.9, 7}, {7, 7}, {7, 8.9}},
                            {{1.1, 7}, {3, 8.9}, {3, 7}}})),
            "");
}

TEST(VerifyScanCheck, TheFirstSegmentThatTheBlankComesNearToIsTold) {
  // Its tip is near to what joins the two points, and to nothing else.
  const MeasuredPoints points = scattered({{1, 0.6}, {9, 0.6}, {9.4, 9}, {9.4, 1}});
  const std::string tip = polygon({{1.5, 1.5}, {5, 0.65}, {9.35, 5}, {8.5, 8.5}, {1.5, 8.5}});
  WrittenScan scan = unordered(points);
  scan.loss = just(5);
  EXPECT_EQ(verdict_of(scan, points, tip).open,
            "the blank comes near to points measured beside the edge at (0, 0)");
  EXPECT_EQ(
      verdict_of(scan, points, polygon({{1.5, 1.5}, {5, 0.75}, {9.35, 5}, {8.5, 8.5}, {1.5, 8.5}})).open,
      "the blank comes near to points measured beside the edge at (10, 0)");
  EXPECT_EQ(verdict_of(scan, points, polygon({{1.5, 1.5}, {5, 0.75}, {9, 5}, {8.5, 8.5}, {1.5, 8.5}})).open,
            "");
}

TEST(VerifyScanCheck, PointsBesideAnEdgeInABowAreAllOnTheirHull) {
  // The middle of a flat bow of fifteen points is near to the tip of the blank; a point below it is none of
  // the hull.
  for (const double top : {0.55, 0.45}) {
    MeasuredPoints points = scattered({});
    for (int k = -7; k <= 7; ++k)
      points.at.push_back({just(1 + 0.05 * k), just(k == 0 ? top : 0.45 - 0.002 * k * k)});
    points.at.push_back({just(1), just(0.3)});
    WrittenScan scan = unordered(points);
    scan.guard = just(0.25), scan.loss = just(3);
    EXPECT_EQ(judged(scan, points, polygon({{1, 0.78}, {8, 2}, {8, 8}, {2, 8}})), top > 0.5 ? "open" : "");
  }
}

TEST(VerifyScanCheck, ABlankLevelWithCornersIsSeenToBeInside) {
  MeasuredPoints points = square(10, 1);
  WrittenScan scan = ordered(points);
  scan.loss = just(3);
  EXPECT_EQ(judged(scan, points, region(2, 8)), "");
  EXPECT_EQ(judged(scan, points, region(3, 7)).substr(0, 23), "the blank is farther th");
  scan.loss = just(20);
  EXPECT_EQ(judged(scan, points, region(12, 16)),
            "piece 0 of the blank is not inside the outlines through the points");
  // An edge that begins to the left and passes to the right of it.
  MeasuredPoints slanting;
  slanting.contour_starts.push_back(0);
  for (const auto& [x, y] : {std::pair{0, -20}, {40, 20}, {0, 40}}) slanting.at.push_back({just(x), just(y)});
  scan = ordered(slanting);
  scan.step = just(100), scan.loss = just(60);
  EXPECT_EQ(judged(scan, slanting, region(2, 8)), "");
}

// ---- the words of a result
// ---------------------------------------------------------------------------------

const std::string kScan =
    R"({"units": "mm", "points": 4, "proved": true, "ordered": false, "guard": 0.1, "step": 1, "loss": 2, "min_radius": 3,
  "max_dip": 0.5, "slice": {"height": 5, "thickness": 2}, "left_out": [3], "outlines": [[0, 1, 2]]})";
std::string told(const std::string& text) {
  std::string complaint;
  const auto scan = read_written_scan(*parse_json(text, "r.json"), complaint);
  if (!complaint.empty()) return complaint;
  if (!scan) return "nothing";
  std::string all =
      fmt::format("{} {} {} {} {} {} {}", scan->unit == LengthUnit::inch, scan->points, scan->proved,
                  scan->ordered, scan->guard.high, scan->step.high, scan->loss.high);
  if (scan->min_radius) all += fmt::format(" r{}", scan->min_radius->high);
  if (scan->max_dip) all += fmt::format(" d{}", scan->max_dip->high);
  if (scan->slice)
    all += fmt::format(" s{}/{}", approximate(scan->slice->height), approximate(scan->slice->thickness));
  for (const std::size_t k : scan->left_out) all += fmt::format(" -{}", k);
  for (const auto& loop : scan->outlines) {
    all += " |";
    for (const std::size_t k : loop) all += fmt::format(" {}", k);
  }
  return all;
}
std::string with(const std::string& from, const std::string& to) {
  std::string text = kScan;
  return told(text.replace(text.find(from), from.size(), to));
}

TEST(VerifyScanCheck, TheWordsOfAScanAreRead) {
  EXPECT_EQ(told(kScan), "false 4 true false 0.1 1 2 r3 d0.5 s5/2 -3 | 0 1 2");
  EXPECT_EQ(with("\"mm\"", "\"inch\""), "true 4 true false 0.1 1 2 r3 d0.5 s5/2 -3 | 0 1 2");
  EXPECT_EQ(with("\"min_radius\": 3", "\"min_radius\": null"),
            "false 4 true false 0.1 1 2 d0.5 s5/2 -3 | 0 1 2");
  EXPECT_EQ(with("\"max_dip\": 0.5", "\"max_dip\": null"), "false 4 true false 0.1 1 2 r3 s5/2 -3 | 0 1 2");
  EXPECT_EQ(with("{\"height\": 5, \"thickness\": 2}", "null"),
            "false 4 true false 0.1 1 2 r3 d0.5 -3 | 0 1 2");
  EXPECT_EQ(with(R"("ordered": false)", R"("ordered": true)"),
            "field scan.outlines is for points in no order, and for those alone");
  EXPECT_EQ(with("[[0, 1, 2]]", "null"),
            "field scan.outlines is for points in no order, and for those alone");
  EXPECT_EQ(with(R"(, "outlines": [[0, 1, 2]])", ""), "nothing");
  EXPECT_EQ(with("\"mm\"", "\"cm\""), "field scan.units is neither \"mm\" nor \"inch\"");
  EXPECT_EQ(with("\"proved\": true", "\"proved\": 1"), "field scan.proved is neither true nor false");
  EXPECT_EQ(with("\"ordered\": false", "\"ordered\": 0"), "field scan.ordered is neither true nor false");
  EXPECT_EQ(with("\"guard\": 0.1", "\"guard\": -0.1"), "a length of the field scan is negative");
  EXPECT_EQ(with("\"guard\": 0.1", "\"guard\": 0"), "false 4 true false 0 1 2 r3 d0.5 s5/2 -3 | 0 1 2");
  EXPECT_EQ(with("\"max_dip\": 0.5", "\"max_dip\": -0.5"), "a length of the field scan is negative");
  EXPECT_EQ(with("\"max_dip\": 0.5", "\"max_dip\": 0"), "false 4 true false 0.1 1 2 r3 d0 s5/2 -3 | 0 1 2");
  EXPECT_EQ(with("[0, 1, 2]", "3"), "scan.outlines[0] is not a list");
}

}  // namespace
}  // namespace lekalo::verify::verify_scan_check_test

// Every kind of random case through solver and checker: the checker reads the written decimals exactly and
// shares no code with the solver, so what it confirms is true.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lekalo/locate/convex.hpp"
#include "lekalo/verify/verify.hpp"
#include "support/cases.hpp"

namespace lekalo::locate_verify_test {
namespace {

std::string contour_text(const geom::ConvexPolygon& polygon) {
  std::string text;
  for (const geom::Point& p : polygon.vertices()) text += fmt::format("{} {}\n", p.x, p.y);
  return text;
}

std::string contacts_text(const auto& contacts) {
  std::string text;
  for (const locate::Contact& contact : contacts)
    text += fmt::format("{}{{\"part_vertex\":{},\"blank_edge\":{},\"multiplier\":{}}}",
                        text.empty() ? "" : ",", contact.part_vertex, contact.blank_edge, contact.multiplier);
  return "[" + text + "]";
}

std::string result_text(const locate::ConvexResult& result, std::size_t part_points,
                        std::size_t blank_points) {
  std::string certificate;
  for (const locate::CertificateInterval& interval : result.certificate)
    certificate += fmt::format("{}{{\"from\":{},\"to\":{},\"contacts\":{}}}", certificate.empty() ? "" : ",",
                               interval.from, interval.to, contacts_text(interval.contacts));
  const char* status = result.status == locate::Status::optimal   ? "optimal"
                       : result.status == locate::Status::stopped ? "stopped"
                                                                  : "infeasible";
  const locate::Placement& best = result.best;
  return fmt::format(
      R"({{"format":{{"name":"lekalo-locate","version":1}},"status":"{}","units":"mm",
"inputs":[{{"role":"part","path":"part.csv","sha256":"","units":"mm","points":{},"dropped":[]}},
{{"role":"blank","path":"blank.csv","sha256":"","units":"mm","points":{},"dropped":[]}}],
"warnings":[],"seed":0,"work":{},"version":"0.1.0","method":"certified",
"x":{},"y":{},"theta":{},"theta_deg":{},"mirrored":false,"clearance":{},"upper_bound":{},"gap":{},
"min_allowance":0,"shortfall":{},"window_deg":[0,360],"contacts":{},"certificate":[{}],"certificate_file":null,
"alternatives":[],"alternatives_complete":true,"trim":null,"nc":null,
"comparison":null,"deviations":null,"run":{{}}}})",
      status, part_points, blank_points, result.work, best.x, best.y, best.theta,
      best.theta * 57.295779513082323, best.clearance, result.upper_bound,
      result.upper_bound - best.clearance, result.shortfall, contacts_text(result.contacts), certificate);
}

TEST(LocateAndVerify, TheCheckerConfirmsEveryRandomCase) {
  const std::size_t count = cases::case_count(300);
  for (std::size_t i = 0; i < count; ++i) {
    const cases::LocateCase one = cases::random_case(cases::seed() + 5, i);
    SCOPED_TRACE(one.name);
    // The file holds the shortest decimals that read back to these doubles.
    double largest = 0, largest_blank = 0;
    for (const geom::Point& p : one.part.vertices())
      largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    for (const geom::Point& p : one.blank.vertices())
      largest_blank = std::max({largest_blank, std::abs(p.x), std::abs(p.y)});
    const auto result =
        locate::locate_convex({one.part, one.blank, {}, 0x1p-53 * largest, 0x1p-53 * largest_blank}, {});
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->status, locate::Status::optimal);
    const double ulp = std::nextafter(one.largest_coordinate, 1e308) - one.largest_coordinate;
    EXPECT_LE(result->upper_bound - result->best.clearance, std::max(1e-9, 64 * ulp));
    const std::string part = contour_text(one.part), blank = contour_text(one.blank),
                      text = result_text(*result, one.part.size(), one.blank.size());
    const auto report = verify::verify_locate(
        {{"result.json", text}, {"part.csv", part}, {"blank.csv", blank}, std::nullopt});
    ASSERT_TRUE(report.has_value()) << report.error().message;
    EXPECT_EQ(report->verdict, verify::Verdict::confirmed)
        << (report->findings.empty() ? "" : report->findings.front());
    EXPECT_EQ(report->intervals, result->certificate.size());
  }
}

// At the flat spots of a superellipse neighbouring edges are parallel but for rounding: the light third
// contact of a basis of opposite edges once proved 0.016 mm less than it could, under the status "optimal".
TEST(LocateAndVerify, FlatSpotsOfSmoothOutlinesKeepTheGap) {
  for (const std::size_t n : {60, 1000, 5000}) {
    SCOPED_TRACE(n);
    const auto part_shape = cases::superellipse(n, 49, 29), blank_shape = cases::superellipse(n, 50, 31);
    const double error = 0x1p-53 * 50;
    const auto result = locate::locate_convex({part_shape, blank_shape, {}, error, error}, {});
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->status, locate::Status::optimal);
    EXPECT_LE(result->upper_bound - result->best.clearance, 1e-9);
    const std::string part = contour_text(part_shape), blank = contour_text(blank_shape),
                      text = result_text(*result, n, n);
    const auto report = verify::verify_locate(
        {{"result.json", text}, {"part.csv", part}, {"blank.csv", blank}, std::nullopt});
    ASSERT_TRUE(report.has_value()) << report.error().message;
    EXPECT_EQ(report->verdict, verify::Verdict::confirmed)
        << (report->findings.empty() ? "" : report->findings.front());
  }
}

TEST(LocateAndVerify, TheCheckerConfirmsThatAPartDoesNotFit) {
  const std::size_t count = cases::case_count(200);
  for (std::size_t i = 0; i < count; ++i) {
    // Part and blank change roles: what fits inside cannot hold it.
    const cases::LocateCase one = cases::random_case(cases::seed() + 6, i, cases::Kind::plain);
    SCOPED_TRACE(one.name);
    const double error = 0x1p-53 * one.largest_coordinate;
    const auto result = locate::locate_convex({one.blank, one.part, {}, error, error}, {});
    ASSERT_TRUE(result.has_value());
    EXPECT_EQ(result->status, locate::Status::infeasible);
    const std::string part = contour_text(one.blank), blank = contour_text(one.part),
                      text = result_text(*result, one.blank.size(), one.part.size());
    const auto report = verify::verify_locate(
        {{"result.json", text}, {"part.csv", part}, {"blank.csv", blank}, std::nullopt});
    ASSERT_TRUE(report.has_value()) << report.error().message;
    EXPECT_EQ(report->verdict, verify::Verdict::confirmed)
        << (report->findings.empty() ? "" : report->findings.front());
  }
}

}  // namespace
}  // namespace lekalo::locate_verify_test

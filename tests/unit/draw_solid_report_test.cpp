#include <gtest/gtest.h>

#include <string>

#include "lekalo/draw/solid_report.hpp"
#include "lekalo/locate/solid_allowance.hpp"
#include "support/solids.hpp"

namespace lekalo::draw::solid_report_test {
namespace {

/// A block of 40 x 30 x 20 mm in one with 2 mm all around but 1 mm on its top.
SolidReport example() {
  SolidReport report;
  SolidScene& scene = report.scene;
  scene.part_name = "part.stl", scene.blank_name = "<casting>.ply", scene.status = "optimal";
  scene.method = "certified";
  scene.blank = cases::block({-2, -2, -2}, {42, 32, 21});
  const locate::MeasuredPart measured =
      locate::measured_part(cases::block({0, 0, 0}, {40, 30, 20}), scene.blank, {}, 1000);
  scene.part = measured.mesh, scene.allowances = measured.allowances;
  scene.placement.inside = true, scene.placement.clearance = 1;
  scene.placement.contacts = {{7, 8, {20, 15, 20}, {20, 15, 21}, 1, 1}};
  scene.upper_bound = 1.005;
  report.shift = 5, report.turn_deg = 3, report.farthest_turn_deg = 5.19, report.certificate_boxes = 12,
  report.work = 99;
  report.inputs = {{"part", {"a/part.stl", std::string(64, 'a')}, "12 triangles, mm"},
                   {"blank", {"<casting>.ply", std::string(64, 'b')}, "12 triangles, mm"}};
  report.assumptions = {"The blank is taken as drawn."};
  report.warnings = {"It may be in inches."};
  return report;
}

bool has(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// The number of an attribute of the text element that has these words.
double attribute(const std::string& svg, const std::string& words, const std::string& name) {
  const std::size_t end = svg.find(">" + words + "<");
  EXPECT_NE(end, std::string::npos) << words;
  const std::size_t from = svg.find(" " + name + "=\"", svg.rfind("<text", end)) + name.size() + 3;
  return std::stod(svg.substr(from));
}

TEST(SolidReport, SaysWhatATechnologistDecidesBy) {
  const std::string svg = solid_report_svg(example());
  for (const char* words :
       {"Placement of part.stl", "in the blank &lt;casting&gt;.ply", ">optimal<", ">1.000000 mm<",
        ">1.005000 mm<", "no placement moved up to 5 mm along each axis", "up to 3°", "5.19°",
        "12 boxes of poses", ">7, 8<", "12 triangles, mm", "The blank is taken as drawn.",
        "Note: It may be in inches.", "allowance of the part, mm", "method certified, work 99",
        "first-angle projection, one scale"})
    EXPECT_TRUE(has(svg, words)) << words;
  EXPECT_TRUE(has(svg, std::string(64, 'a'))) << "digests are whole";
  EXPECT_FALSE(has(svg, "<casting>"));
}

TEST(SolidReport, TheViewsStandInFirstAngleOrder) {
  const std::string svg = solid_report_svg(example());
  // The view from the right stands to the left of the front, and that from above stands below it.
  EXPECT_LT(attribute(svg, "from the right", "x"), attribute(svg, "front", "x"));
  EXPECT_EQ(attribute(svg, "from the right", "y"), attribute(svg, "front", "y"));
  EXPECT_GT(attribute(svg, "from above", "y"), attribute(svg, "front", "y"));
  EXPECT_EQ(attribute(svg, "from above", "x"), attribute(svg, "front", "x"));
}

TEST(SolidReport, SaysWhatIsProvedAndWhatIsNot) {
  SolidReport report = example();
  report.scene.upper_bound.reset(), report.scene.method = "climb", report.certificate_boxes = 0;
  std::string svg = solid_report_svg(report);
  EXPECT_TRUE(has(svg, "Nothing is proved about other placements"));
  EXPECT_FALSE(has(svg, "boxes of poses"));
  report = example();
  report.scene.upper_bound.reset(), report.scene.margin = {0.25, 0.5, true}, report.certificate_boxes = 1;
  svg = solid_report_svg(report);
  EXPECT_TRUE(has(svg, "Proved: no placement moved")) << svg;
  EXPECT_FALSE(has(svg, "Nothing is proved"));
  EXPECT_TRUE(has(svg, "1 box of poses"));
  report.scene.status = "infeasible", report.scene.margin = {-0.5, -0.25, false};
  EXPECT_TRUE(has(solid_report_svg(report), "what is demanded"));
  report = example();
  report.scene.status = "infeasible", report.scene.min_allowance = 2, report.scene.shortfall = 1;
  report.certificate_file = {"part.certificate.json", std::string(64, 'c')};
  svg = solid_report_svg(report);
  EXPECT_TRUE(has(svg, "the demanded 2 mm cannot be had"));
  EXPECT_TRUE(has(svg, "part.certificate.json"));
  EXPECT_TRUE(has(svg, "less than 2 mm, by up to "));
  report.scene.placement.inside = false, report.scene.placement.contacts.clear();
  report.freedom = locate::SolidFreedom::c_xyz;
  svg = solid_report_svg(report);
  EXPECT_TRUE(has(svg, ">not inside<"));
  EXPECT_TRUE(has(svg, "turned about z by up to"));
  report.scene.status = "stopped", report.freedom = locate::SolidFreedom::xyz;
  EXPECT_TRUE(has(solid_report_svg(report), "Stopped before the search was complete"));
}

TEST(SolidReport, CountsWhatFindsNoRoom) {
  SolidReport report = example();
  report.assumptions.assign(60, "Something that is assumed without a proof and has to be told.");
  report.scene.placement.contacts.assign(40, report.scene.placement.contacts.front());
  const std::string svg = solid_report_svg(report);
  EXPECT_TRUE(has(svg, "more, in the result"));
  EXPECT_TRUE(has(svg, "class=\"more-contacts\""));
  EXPECT_TRUE(has(svg, "Colours: distance to the blank"));
  EXPECT_LT(attribute(svg, "lekalo 0.1.0", "y"), 297);
}

TEST(SolidReport, IsTheSameForAnyNumberOfThreadsInEveryForm) {
  const SolidReport report = example();
  EXPECT_TRUE(solid_report_svg(report, 1) == solid_report_svg(report, 3));
  const auto png = solid_report_png(report, 400, 1), pdf = solid_report_pdf(report, 1);
  ASSERT_TRUE(png && pdf);
  EXPECT_EQ(png->substr(1, 3), "PNG");
  EXPECT_EQ(pdf->substr(0, 5), "%PDF-");
  EXPECT_TRUE(*solid_report_png(report, 400, 2) == *png);
  EXPECT_TRUE(*solid_report_pdf(report, 2) == *pdf);
  EXPECT_EQ(solid_report_png(report, 99).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace lekalo::draw::solid_report_test

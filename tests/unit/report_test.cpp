#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "lekalo/draw/report.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/locate/convex.hpp"
#include "support/region_cases.hpp"
#include "support/xml.hpp"

namespace lekalo::test::report_test {
namespace {

using cases::region_detail::circle;
using cases::region_detail::polygon;
using cases::region_detail::region;
using draw::Report;
using geom::Point;
using geom::Region;
using io::LocateDocument;

/// A document of regions at a pose whose clearance is known.
LocateDocument document_of(const std::vector<Region>& part, const std::vector<Region>& blank,
                           double clearance, locate::Placement placement = {}) {
  LocateDocument d;
  d.status = clearance < 0 ? "infeasible" : "optimal";
  d.method = "certified";
  d.inputs = {{"part", {"shop/part.json", std::string(64, 'a')}, std::nullopt, 0, {}},
              {"blank", {"shop/blank.json", std::string(64, 'b')}, std::nullopt, 0, {}}};
  d.placement = placement;
  d.placement.clearance = clearance;
  d.upper_bound = clearance + 5e-4;
  d.shortfall = std::max(0.0, -clearance);
  d.part = part, d.blank = blank;
  d.certificate_intervals = 41;
  d.proof = locate::PoseProof{{}, std::vector<locate::CoverTree>(1)};
  return d;
}

Report report_of(const LocateDocument& document, std::vector<draw::ReportFeature> features = {}) {
  auto report = draw::make_report(document, {document.part, document.blank, 0, {}, {}}, std::move(features));
  EXPECT_TRUE(report.has_value());
  return report ? *std::move(report) : Report{};
}

std::vector<Region> plate(double low, double right, double top) {
  return {region(polygon({{low, low}, {right, low}, {right, top}, {low, top}}))};
}

locate::Touch touch(std::uint32_t edge, Point part, Point blank, double distance) {
  locate::Touch made;
  made.part_edge = made.blank_edge = edge;
  made.part = part, made.blank = blank, made.distance = distance;
  return made;
}

/// 40 x 20 with a hole of radius 5 in a blank with 2 mm all round and a core of radius 4.
LocateDocument plate_with_hole() {
  const std::vector<Region> part{
      region(polygon({{0, 0}, {40, 0}, {40, 20}, {0, 20}}), {circle({10, 10}, 5)})};
  const std::vector<Region> blank{
      region(polygon({{-2, -2}, {42, -2}, {42, 22}, {-2, 22}}), {circle({10, 10}, 4)})};
  LocateDocument d = document_of(part, blank, 1);
  d.contacts = {touch(4, {15, 10}, {14, 10}, 1)};
  return d;
}

std::vector<std::string> texts(const XmlDocument& page, const std::string& kind) {
  std::vector<std::string> found;
  for (const XmlElement& text : page.of("text", kind)) found.push_back(text.text);
  return found;
}

TEST(Report, OfAPlateWithAHoleGivesEveryContourItsExtremesAndItsMean) {
  const Report report = report_of(plate_with_hole());
  ASSERT_EQ(report.features.size(), 2U);
  const draw::FeatureRow &outline = report.features[0], &hole = report.features[1];
  EXPECT_EQ(outline.feature.name, "outline");
  EXPECT_EQ(outline.feature.edges, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(hole.feature.name, "hole 0");
  EXPECT_DOUBLE_EQ(outline.length, 120);
  for (const auto& [row, value] : {std::pair{&outline, 2.0}, std::pair{&hole, 1.0}}) {
    EXPECT_LE(row->minimum, value);
    EXPECT_GE(row->maximum, value);
    EXPECT_NEAR(row->minimum, value, 1e-10);
    EXPECT_NEAR(row->maximum, value, 2e-4);
    EXPECT_NEAR(row->mean, value, 1e-6);
    EXPECT_TRUE(row->met);
  }
  EXPECT_TRUE(report.missing.empty());
}

TEST(Report, SaysWhichDemandsOfFeaturesAreMetAndByHowMuchNot) {
  const std::vector<draw::ReportFeature> features{
      {"bore, \"H7\"", {4}, 0.5, 1, 1.5}, {"long sides", {0, 2}, 3, {}, {}}, {"ends", {1, 3}, {}, {}, 1.2}};
  const Report report = report_of(plate_with_hole(), features);
  EXPECT_TRUE(report.features[0].met);
  EXPECT_EQ(report.features[0].verdict, "met");
  EXPECT_FALSE(report.features[1].met);
  EXPECT_TRUE(report.features[1].verdict.ends_with(" mm missing")) << report.features[1].verdict;
  EXPECT_GE(std::stod(report.features[1].verdict), 1);
  EXPECT_LE(std::stod(report.features[1].verdict), 1.11);
  EXPECT_FALSE(report.features[2].met);
  EXPECT_GE(std::stod(report.features[2].verdict), 0.8);
  EXPECT_TRUE(report.features[2].verdict.ends_with(" mm too much"));
  EXPECT_EQ(report.demanded, (std::vector<double>{3, 0, 3, 0, 0.5}));
  // A long side lacks 1 mm: drawn red and labelled.
  ASSERT_FALSE(report.missing.empty());
  EXPECT_NEAR(report.missing[0].depth, 1, 1e-9);
  const XmlDocument page(report_svg(report));
  EXPECT_EQ(page.of("path", "allowance-too-thin").size(), 2U);
  EXPECT_FALSE(texts(page, "missing-label").empty());
  const std::string csv = allowances_csv(report);
  EXPECT_NE(csv.find(",\"bore, \"\"H7\"\"\"\n"), std::string::npos);
}

TEST(Report, WritesNoCellThatASpreadsheetWouldRun) {
  const auto cell = [](const std::string& name) {
    const std::vector<draw::ReportFeature> features{{name, {4}, {}, {}, {}}};
    const std::string csv = allowances_csv(report_of(plate_with_hole(), features));
    const std::size_t at = csv.find("\n0,1,4,");
    const std::size_t end = csv.find('\n', at + 1);
    std::string line = csv.substr(at, end - at);
    for (int commas = 0; commas < 10; ++commas) line.erase(0, line.find(',') + 1);
    return line;
  };
  EXPECT_EQ(cell("=1+2"), "'=1+2");
  EXPECT_EQ(cell("+cmd"), "'+cmd");
  EXPECT_EQ(cell("@SUM(A1)"), "'@SUM(A1)");
  EXPECT_EQ(cell("-x"), "'-x");
  EXPECT_EQ(cell("\t=x"), "'\t'=x");
  EXPECT_EQ(cell(" =x"), " '=x");
  EXPECT_EQ(cell("a;=x"), "a;'=x");
  EXPECT_EQ(cell("=HYPERLINK(\"a\")"), "\"'=HYPERLINK(\"\"a\"\")\"");
  EXPECT_EQ(cell("-3.5"), "-3.5");  // a number is no formula
  EXPECT_EQ(cell("bore - 7"), "bore - 7");
}

TEST(Report, OfDemandsThatAreMetFindsNothingMissingNeitherByRoundingNorOnTheRimOfAFinishedFeature) {
  const std::vector<Region> part = plate(0, 40, 20);
  const std::vector<Region> blank{region(polygon({{-2, -2}, {39.99, -2}, {39.99, 22}, {-2, 22}}))};
  LocateDocument d = document_of(part, blank, -0.0101);
  d.status = "optimal", d.shortfall = 0;
  d.upper_bound.reset();
  io::DemandRecord demands;
  demands.margin = 0, demands.margin_bound = 1e-4;
  d.demands = demands;
  const Report report = report_of(d, {{"face", {1}, -0.02, {}, 0.02}, {"sides", {0, 2, 3}, -0.0100, {}, {}}});
  for (const draw::FeatureRow& row : report.features) EXPECT_TRUE(row.met) << row.feature.name << row.verdict;
  EXPECT_TRUE(report.missing.empty());
  const XmlDocument page(report_svg(report));
  EXPECT_TRUE(page.of("path", "allowance-outside").empty());
  EXPECT_EQ(texts(page, "margin").size(), 1U);
  // The same with a demand that is not met.
  demands.margin = -0.005;
  d.demands = demands;
  const Report missed = report_of(d, {{"face", {1}, -0.005, {}, {}}});
  EXPECT_FALSE(missed.features[0].met);
  EXPECT_FALSE(missed.missing.empty());
}

TEST(Report, ShowsWhereHowMuchIsMissingOutsideAndInsideThePart) {
  const std::vector<Region> part = plate(0, 40, 20);
  const std::vector<Region> blank{
      region(polygon({{-3, -3}, {38, -3}, {38, 23}, {-3, 23}}), {circle({10, 10}, 4)})};
  const Report report = report_of(document_of(part, blank, -4.02));
  ASSERT_GE(report.missing.size(), 2U);
  ASSERT_LE(report.missing.size(), draw::kMostMissingPlaces);
  EXPECT_NEAR(report.missing[0].depth, 4, 0.1);
  EXPECT_NEAR(report.missing[0].in_blank.x, 10, 0.2);
  EXPECT_NEAR(report.missing[1].depth, 2, 1e-9);
  EXPECT_NEAR(report.missing[1].in_blank.x, 40, 1e-9);
  const XmlDocument page(report_svg(report));
  EXPECT_EQ(page.of("path", "part-outside").size(), 1U);
  EXPECT_FALSE(page.of("path", "allowance-outside").empty());
  EXPECT_EQ(page.of("circle", "missing-place").size(), report.missing.size());
  const auto labels = texts(page, "missing-label");
  ASSERT_FALSE(labels.empty());
  for (const std::string& label : labels) EXPECT_TRUE(label.ends_with("mm missing")) << label;
  EXPECT_EQ(texts(page, "status"), std::vector<std::string>{"infeasible"});
  EXPECT_NE(texts(page, "proof").at(0).find("does not fit"), std::string::npos);
}

TEST(Report, PrintsNumbersThatAreNeverBetterThanTheResult) {
  LocateDocument d = plate_with_hole();
  d.placement.clearance = 0.99999949, d.upper_bound = 1.00000051;
  const XmlDocument page(report_svg(report_of(d)));
  EXPECT_EQ(texts(page, "clearance").at(0), "0.999999 mm");
  EXPECT_EQ(texts(page, "upper-bound").at(0), "1.000001 mm");
  EXPECT_LE(std::stod(texts(page, "gap").at(0)), 1.2e-6);
  EXPECT_GE(std::stod(texts(page, "gap").at(0)), 1.02e-6);
  EXPECT_EQ(texts(page, "sha256"), (std::vector<std::string>{std::string(64, 'a'), std::string(64, 'b')}));
  EXPECT_EQ(texts(page, "input").at(0), "shop/part.json");
  std::string proof;
  for (const std::string& line : texts(page, "proof")) proof += line + " ";
  EXPECT_NE(proof.find("41 boxes of poses"), std::string::npos) << proof;
  EXPECT_EQ(texts(page, "version").size(), 1U);
}

TEST(Report, HistogramBarsHoldTheWholeLength) {
  const XmlDocument page(report_svg(report_of(plate_with_hole())));
  double sum = 0;
  for (const XmlElement& bar : page.of("path", "histogram-bar")) {
    const std::string title = page.child_text(bar, "title");
    sum += std::stod(title.substr(title.find(": ") + 2));
  }
  EXPECT_NEAR(sum, 100, 1e-9);
}

TEST(Report, CsvHasEveryEdgeWithItsEndsAndExtremesInNumbersThatReadBack) {
  const Report report = report_of(plate_with_hole());
  std::istringstream csv(allowances_csv(report));
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "piece,contour,edge,s_mm,x_part,y_part,x_blank,y_blank,allowance_mm,blank_edge,feature");
  std::size_t edge = 0, row = 0;
  while (std::getline(csv, line)) {
    std::istringstream fields(line);
    std::vector<std::string> f;
    for (std::string field; std::getline(fields, field, ',');) f.push_back(field);
    ASSERT_EQ(f.size(), 11U) << line;
    if (row == report.edges[edge].samples.size()) ++edge, row = 0;
    const locate::OutlinePoint& p = report.edges[edge].samples[row++];
    EXPECT_EQ(f[1], edge == 4 ? "1" : "0");
    EXPECT_EQ(std::stoul(f[2]), edge);
    EXPECT_EQ(std::strtod(f[3].c_str(), nullptr), p.along);
    EXPECT_EQ(std::strtod(f[4].c_str(), nullptr), p.in_part.x);
    EXPECT_EQ(std::strtod(f[7].c_str(), nullptr), p.in_blank.y);
    EXPECT_EQ(std::strtod(f[8].c_str(), nullptr), p.allowance);
    EXPECT_EQ(std::stoul(f[9]), p.blank_edge);
    EXPECT_EQ(f[10], edge == 4 ? "hole 0" : "outline");
  }
  EXPECT_EQ(edge, 4U);
  EXPECT_EQ(row, report.edges[4].samples.size());
}

TEST(Report, OfSeveralPiecesNamesThemAndCsvCountsThem) {
  LocateDocument d = plate_with_hole();
  d.part.push_back(region(polygon({{60, 0}, {70, 0}, {65, 9}})));
  d.blank.push_back(region(polygon({{56, -2}, {74, -2}, {65, 14}})));
  const Report report = report_of(d);
  ASSERT_EQ(report.features.size(), 3U);
  EXPECT_EQ(report.features[1].feature.name, "piece 0, hole 0");
  EXPECT_EQ(report.features[2].feature.name, "piece 1, outline");
  EXPECT_NE(allowances_csv(report).find("\n1,0,5,0,60,0,60,0,2,"), std::string::npos);
}

TEST(Report, OfConvexContoursPrintsTheNumbersOfTheFiles) {
  const auto one = cases::published_examples()[1];  // its part runs clockwise in the file
  const auto part = one.part(), blank = one.blank();
  const auto found = locate::locate_convex({part, blank, {}, 0, 0}, {});
  const auto as_region = [](const geom::ConvexPolygon& p) {
    return std::vector<Region>{region(polygon(p.vertices()))};
  };
  draw::ReportShapes shapes{as_region(part), as_region(blank), 0, {}, {}};
  const auto n = static_cast<std::uint32_t>(part.size());
  LocateDocument d;
  d.status = "optimal", d.method = "certified";
  d.placement = found->best, d.upper_bound = found->upper_bound;
  d.proof = locate::AngleProof{found->certificate};
  for (std::uint32_t k = 0; k < n; ++k) shapes.part_edge_numbers.push_back((2 * n - 2 - k) % n);
  for (const locate::Contact& contact : found->contacts) {
    d.contacts.push_back(locate::touch_of(contact, part, blank, found->best));
    d.contacts.back().part_edge = n - 1 - contact.part_vertex;
  }
  const auto report = draw::make_report(d, shapes);
  ASSERT_TRUE(report.has_value());
  ASSERT_EQ(report->contacts.size(), found->contacts.size());
  for (std::size_t k = 0; k < found->contacts.size(); ++k) {
    EXPECT_EQ(report->contacts[k].part_edge, d.contacts[k].part_edge);
    EXPECT_EQ(report->contacts[k].part, part[found->contacts[k].part_vertex]);
    EXPECT_NEAR(report->contacts[k].distance, found->best.clearance, 1e-9);
  }
  EXPECT_NEAR(report->features[0].minimum, found->best.clearance, 1e-9);
  EXPECT_NE(allowances_csv(*report).find("\n0,0,8,0,"), std::string::npos);
  EXPECT_EQ(XmlDocument(report_svg(*report)).of("path", "contact").size(), found->contacts.size());
}

struct TextBox {
  double left, right, top, bottom;
  std::string text;
};

/// No text on another or off the page, and none of the drawing outside its frame.
void expect_clear_page(const Report& report, const std::string& what) {
  const XmlDocument page(report_svg(report));
  std::vector<TextBox> boxes;
  for (const XmlElement& text : page.of("text")) {
    const double size = std::stod(text["font-size"]), x = std::stod(text["x"]), y = std::stod(text["y"]);
    const double width = size * io::text_width(text.text) * (text["font-weight"] == "bold" ? 1.1 : 1);
    const double left = text["text-anchor"] == "middle" ? x - width / 2
                        : text["text-anchor"] == "end"  ? x - width
                                                        : x;
    const TextBox box{left, left + width, y - 0.75 * size, y + 0.2 * size, text.text};
    EXPECT_GE(box.left, 11.9) << what << ": " << text.text;
    EXPECT_LE(box.right, 198.1) << what << ": " << text.text;
    EXPECT_GE(box.top, 10) << what << ": " << text.text;
    EXPECT_LE(box.bottom, 288) << what << ": " << text.text;
    for (const TextBox& other : boxes) {
      const bool apart = box.right <= other.left + 0.3 || other.right <= box.left + 0.3 ||
                         box.bottom <= other.top + 0.3 || other.bottom <= box.top + 0.3;
      EXPECT_TRUE(apart) << what << ": \"" << text.text << "\" lies on \"" << other.text << "\"";
    }
    boxes.push_back(box);
  }
}

TEST(Report, PutsNoTextOnAnotherOrOffThePage) {
  expect_clear_page(report_of(plate_with_hole()), "plate");
  for (std::uint64_t index = 0; index < 2; ++index) {
    for (const cases::RegionKind kind : cases::kRegionKinds) {
      const auto c = cases::region_case(cases::seed(), index, kind);
      for (const double off : {0.0, 4.0}) {
        LocateDocument d =
            document_of(c.part, c.blank, off == 0 ? 0.1 : -off, {c.shift.x + off, c.shift.y, c.theta, 0});
        for (std::uint32_t k = 0; k < 9; ++k) {
          const Point p = c.part[0].outer[k % c.part[0].outer.size()].from;
          d.contacts.push_back(touch(k, p, c.pose()(p), 0.1));
        }
        expect_clear_page(report_of(d), c.name);
      }
    }
  }
  LocateDocument full = plate_with_hole();
  full.status = std::string(40, 'm');
  for (io::InputRecord& input : full.inputs) input.file.path = "папка/" + std::string(300, 'W') + "Щ.json";
  full.inputs.push_back({"nc", {"n.nc", std::string(64, 'c')}, std::nullopt, 0, {}});
  full.inputs.push_back({"last-result", {"l.json", std::string(64, 'c')}, LengthUnit::inch, 5'000'000, {1}});
  full.placement.x = -123456789.123456, full.placement.y = 1e-300;
  full.placement.x = 0;
  full.min_allowance = 123.456, full.shortfall = 122.5;
  full.certificate_file = io::FileRecord{std::string(500, 'x'), std::string(64, 'd')};
  for (int k = 0; k < 40; ++k) full.warnings.push_back("a warning of some length " + std::string(150, 'w'));
  std::vector<draw::ReportFeature> features;
  for (std::uint32_t k = 0; k < 60; ++k)
    features.push_back({"Паз " + std::string(k, 'M'), {k % 5}, 0.1 * k, 1e-9, 1e9});
  expect_clear_page(report_of(full, features), "everything at once");
  for (const double scale : {1e-4, 1e3, 1e6}) {
    const auto sized = [&](geom::Ring ring) {
      for (Point& p : ring) p = scale * p;
      return std::vector<Region>{region(polygon(ring))};
    };
    expect_clear_page(report_of(document_of(sized({{0, 0}, {100, 0}, {90, 60}}),
                                            sized({{-9, -3}, {108, -3}, {94, 71}}), 1 * scale)),
                      "scale " + std::to_string(scale));
    expect_clear_page(report_of(document_of(sized({{0, 0}, {100, 0}, {100, 0.2}, {0, 0.2}}),
                                            sized({{-1, -1}, {101, -1}, {101, 1}, {-1, 1}}), 0.8 * scale)),
                      "sliver, scale " + std::to_string(scale));
    expect_clear_page(report_of(document_of(sized({{0, 0}, {0.2, 0}, {0.2, 100}, {0, 100}}),
                                            sized({{-1, -1}, {1, -1}, {1, 101}, {-1, 101}}), 0.8 * scale)),
                      "tall, scale " + std::to_string(scale));
  }
}

TEST(Report, IsTheSameBytesEveryTimeAndPdfHasNoDate) {
  const Report one = report_of(plate_with_hole()), two = report_of(plate_with_hole());
  EXPECT_EQ(report_svg(one), report_svg(two));
  EXPECT_EQ(allowances_csv(one), allowances_csv(two));
  const auto pdf = report_pdf(one), again = report_pdf(two);
  ASSERT_TRUE(pdf.has_value() && again.has_value());
  EXPECT_EQ(*pdf, *again);
  EXPECT_EQ(pdf->substr(0, 5), "%PDF-");
  EXPECT_EQ(pdf->find("CreationDate"), std::string::npos);
  EXPECT_NE(pdf->find("/MediaBox [ 0 0 595.27"), std::string::npos);
  EXPECT_LT(pdf->size(), 400'000U);
  const auto png = report_png(one), png_again = report_png(two);
  ASSERT_TRUE(png.has_value());
  EXPECT_EQ(*png, *png_again);
  EXPECT_EQ(report_png(one, 99).error().code, ErrorCode::usage);
}

TEST(WrappedText, BreaksAtBlanksFitsEveryLineAndEndsInAnEllipsisWhereRoomEnds) {
  const auto lines = io::wrapped("no placement leaves more than this everywhere", 12, 9);
  ASSERT_GT(lines.size(), 2U);
  std::string joined;
  for (const std::string& line : lines) {
    EXPECT_LE(io::text_width(line), 12) << line;
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, "no placement leaves more than this everywhere");
  const auto cut = io::wrapped("no placement leaves more than this everywhere", 12, 2);
  ASSERT_EQ(cut.size(), 2U);
  EXPECT_TRUE(cut[1].ends_with("…"));
  EXPECT_LE(io::text_width(cut[1]), 12);
  const auto digest = io::wrapped(std::string(64, 'a'), 20, 9);
  ASSERT_GT(digest.size(), 1U);
  for (const std::string& line : digest) EXPECT_LE(io::text_width(line), 20);
  EXPECT_TRUE(io::wrapped("", 20, 9).empty());
  EXPECT_TRUE(io::wrapped("   ", 20, 9).empty());
}

}  // namespace
}  // namespace lekalo::test::report_test

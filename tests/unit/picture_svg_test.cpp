#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "draw/paper/colour.hpp"
#include "lekalo/draw/picture.hpp"
#include "lekalo/io/text/words.hpp"
#include "lekalo/locate/convex.hpp"
#include "lekalo/phi/convex.hpp"
#include "support/cases.hpp"
#include "support/stopwatch.hpp"
#include "support/xml.hpp"

namespace lekalo::test::picture_svg_test {
namespace {

using draw::LocatePicture;
using geom::Point;
using geom::Ring;

draw::PictureOfRings& rings(draw::LocatePicture& picture) {
  return std::get<draw::PictureOfRings>(picture.outlines);
}
const draw::PictureOfRings& rings(const draw::LocatePicture& picture) {
  return std::get<draw::PictureOfRings>(picture.outlines);
}

LocatePicture picture_of(const geom::ConvexPolygon& part, const geom::ConvexPolygon& blank,
                         double min_allowance = 0) {
  locate::ConvexOptions options;
  options.min_allowance = min_allowance;
  options.run.work_limit = 20'000;
  const auto found = locate::locate_convex({part, blank, {}, 0, 0}, options);
  LocatePicture picture;
  picture.title = "lekalo locate";
  picture.part_name = "part.csv";
  picture.blank_name = "blank.csv";
  picture.method = "certified";
  picture.status = found->status == locate::Status::infeasible ? "infeasible" : "optimal";
  rings(picture).part = part.vertices();
  rings(picture).blank = blank.vertices();
  picture.result = found->best;
  picture.upper_bound = found->upper_bound;
  rings(picture).contacts = found->contacts;
  picture.min_allowance = min_allowance;
  picture.shortfall = found->shortfall;
  return picture;
}

LocatePicture example(std::size_t number) {
  const auto examples = cases::published_examples();
  return picture_of(examples[number - 1].part(), examples[number - 1].blank());
}

/// Example 1 in its blank made smaller by a fifth: the part sticks out all round.
LocatePicture too_small_blank() {
  const auto one = cases::published_examples()[0];
  Ring blank = one.blank().vertices();
  for (Point& p : blank) p = Point{36, 154} + 0.8 * (p - Point{36, 154});
  return picture_of(one.part(), cases::convex(blank), 0.5);
}

double number_in(const XmlDocument& svg, const std::string& kind) {
  const auto found = svg.of("text", kind);
  EXPECT_EQ(found.size(), 1u) << kind;
  return found.empty() ? std::nan("") : std::strtod(found[0].text.c_str(), nullptr);
}

/// The points of a path's data.
Ring points_of(const XmlElement& path) {
  std::string data = path["d"];
  for (char& c : data) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) c = ' ';
  }
  std::istringstream in(data);
  Ring points;
  for (Point p; in >> p.x >> p.y;) points.push_back(p);
  return points;
}

std::string hex(draw::Colour c) {
  char text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", c.red, c.green, c.blue);
  return text;
}

/// Paper millimetres per millimetre, by the bar a person would measure with.
double scale_by_bar(const XmlDocument& svg) {
  const Ring bar = points_of(svg.of("path", "scale-bar").at(0));
  const std::string label = svg.of("text", "scale-bar-label").at(0).text;
  double length = std::strtod(label.c_str(), nullptr);
  const std::size_t power = label.find("·10");
  if (power != std::string::npos) {
    std::string exponent;
    for (std::size_t i = power + 4; i < label.size();) {
      static const std::vector<std::pair<std::string, char>> kRaised{
          {"⁻", '-'}, {"⁰", '0'}, {"¹", '1'}, {"²", '2'}, {"³", '3'}, {"⁴", '4'},
          {"⁵", '5'}, {"⁶", '6'}, {"⁷", '7'}, {"⁸", '8'}, {"⁹", '9'}};
      const auto raised = std::find_if(kRaised.begin(), kRaised.end(), [&](const auto& one) {
        return label.compare(i, one.first.size(), one.first) == 0;
      });
      if (raised == kRaised.end()) break;
      exponent += raised->second;
      i += raised->first.size();
    }
    length *= std::pow(10.0, std::strtod(exponent.c_str(), nullptr));
  }
  return (bar[2].x - bar[1].x) / length;
}

class Published : public testing::TestWithParam<std::size_t> {};

TEST_P(Published, PrintsTheNumbersOfTheResultAndNeverABetterAllowance) {
  const LocatePicture picture = example(GetParam());
  const XmlDocument svg(picture_svg(picture));
  const double clearance = number_in(svg, "clearance"), bound = number_in(svg, "upper-bound");
  EXPECT_LE(clearance, picture.result.clearance);
  EXPECT_GE(clearance, picture.result.clearance - 1.001e-6);
  EXPECT_GE(bound, *picture.upper_bound);
  EXPECT_LE(bound, *picture.upper_bound + 1.001e-6);
  const double gap = *picture.upper_bound - picture.result.clearance;
  EXPECT_GE(number_in(svg, "gap"), gap);
  EXPECT_LE(number_in(svg, "gap"), 1.2 * gap);
  EXPECT_NEAR(number_in(svg, "x"), picture.result.x, 0.501e-6);
  EXPECT_NEAR(number_in(svg, "y"), picture.result.y, 0.501e-6);
  EXPECT_NEAR(number_in(svg, "theta-deg"), picture.result.theta * 180 / std::numbers::pi, 0.501e-7);
  EXPECT_EQ(svg.of("text", "status").at(0).text, "optimal");
}

TEST_P(Published, ShowsEveryContactAtTheLengthOfTheAllowance) {
  const LocatePicture picture = example(GetParam());
  const XmlDocument svg(picture_svg(picture));
  const auto lines = svg.of("path", "contact");
  ASSERT_GE(rings(picture).contacts.size(), 3u);
  ASSERT_EQ(lines.size(), rings(picture).contacts.size());
  ASSERT_EQ(svg.of("text", "contact-label").size(), rings(picture).contacts.size());
  const double scale = scale_by_bar(svg);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string label = "v" + std::to_string(rings(picture).contacts[i].part_vertex) + " e" +
                              std::to_string(rings(picture).contacts[i].blank_edge);
    EXPECT_EQ(svg.child_text(lines[i], "title"), "contact " + label);
    EXPECT_EQ(svg.of("text", "contact-label")[i].text, label);
    const Ring line = points_of(lines[i]);
    EXPECT_NEAR(geom::norm(line[1] - line[0]) / scale, picture.result.clearance, 0.01 / scale + 1e-4);
  }
}

TEST_P(Published, PaintsTheThinPlacesInTheThinColourAndTheThickestInTheThick) {
  const LocatePicture picture = example(GetParam());
  const XmlDocument svg(picture_svg(picture));
  const auto pieces = svg.of("path", "allowance");
  const std::string thin = hex(draw::scale_colour(0));
  for (const XmlElement& line : svg.of("path", "contact")) {
    const Point vertex = points_of(line)[0];
    const bool painted = std::any_of(pieces.begin(), pieces.end(), [&](const XmlElement& piece) {
      const Ring points = points_of(piece);
      return piece["stroke"] == thin &&
             std::any_of(points.begin(), points.end(), [&](Point p) { return geom::norm(p - vertex) < 0.2; });
    });
    EXPECT_TRUE(painted) << svg.child_text(line, "title");
  }
  const std::string thick = hex(draw::scale_colour(draw::kColourSteps - 1));
  EXPECT_TRUE(std::any_of(pieces.begin(), pieces.end(), [&](const auto& p) { return p["stroke"] == thick; }));
  EXPECT_TRUE(svg.of("path", "allowance-outside").empty());
  EXPECT_EQ(svg.of("path", "scale").size(), static_cast<std::size_t>(draw::kColourSteps));
  EXPECT_GE(svg.of("text", "tick-label").size(), 3u);
  EXPECT_NE(svg.of("text", "scale-title").at(0).text.find("mm"), std::string::npos);
}

TEST_P(Published, GivesTheSameBytesEveryTime) {
  EXPECT_EQ(picture_svg(example(GetParam())), picture_svg(example(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Examples, Published, testing::Range<std::size_t>(1, 7));

struct TextBox {
  double left, right, top, bottom;
};

TextBox box_of(const XmlElement& text) {
  const double size = std::stod(text["font-size"]), x = std::stod(text["x"]), y = std::stod(text["y"]);
  const double width = size * io::text_width(text.text);
  const double left = text["text-anchor"] == "middle" ? x - width / 2
                      : text["text-anchor"] == "end"  ? x - width
                                                      : x;
  return {left, left + width, y - 0.75 * size, y + 0.2 * size};
}

bool crosses(const TextBox& box, Point a, Point b) {
  for (int i = 0; i <= 200; ++i) {
    const Point p = a + (i / 200.0) * (b - a);
    if (p.x > box.left && p.x < box.right && p.y > box.top && p.y < box.bottom) return true;
  }
  return false;
}

void expect_clear_texts(const LocatePicture& picture, const std::string& what) {
  const XmlDocument svg(picture_svg(picture));
  std::vector<TextBox> boxes;
  for (const XmlElement& text : svg.of("text")) {
    const TextBox box = box_of(text);
    EXPECT_GE(box.left, 0) << what << ": " << text.text;
    EXPECT_LE(box.right, 250) << what << ": " << text.text;
    EXPECT_GE(box.top, 0) << what;
    EXPECT_LE(box.bottom, 160) << what;
    for (const TextBox& other : boxes) {
      const bool apart = box.right <= other.left + 0.3 || other.right <= box.left + 0.3 ||
                         box.bottom <= other.top + 0.3 || other.bottom <= box.top + 0.3;
      EXPECT_TRUE(apart) << what << ": " << text.text << " lies on another text";
    }
    boxes.push_back(box);
    for (const char* kind : {"blank-outline", "part-outline", "start", "contact", "inset"}) {
      for (const XmlElement& path : svg.of("path", kind)) {
        const Ring ring = points_of(path);
        for (std::size_t i = 0; i < ring.size(); ++i) {
          EXPECT_FALSE(crosses(box, ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]))
              << what << ": " << text.text << " lies on " << kind;
        }
        // The second outline is that of the inset, cut off only beyond its frame.
        if (std::string(kind).ends_with("outline")) break;
      }
    }
  }
}

TEST(PictureSvg, NoTextLiesOnTheDrawingOnAnotherTextOrOffThePage) {
  for (std::size_t number = 1; number <= 6; ++number) {
    expect_clear_texts(example(number), "example " + std::to_string(number));
  }
  expect_clear_texts(too_small_blank(), "too small blank");
  for (std::uint64_t index = 0; index < 40; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    expect_clear_texts(picture_of(c.part, c.blank), c.name);
  }
  LocatePicture long_names = example(4);
  long_names.title = long_names.part_name = long_names.blank_name = std::string(400, 'W');
  long_names.method = long_names.status = std::string(80, 'm');
  expect_clear_texts(long_names, "long names");
}

TEST(PictureSvg, IsAPageInMillimetresThatSaysWhatItShows) {
  const XmlDocument svg(picture_svg(example(1)));
  const XmlElement& root = svg.elements[0];
  EXPECT_EQ(root["width"], "250mm");
  EXPECT_EQ(root["height"], "160mm");
  EXPECT_EQ(root["viewBox"], "0 0 250 160");
  EXPECT_EQ(root["font-family"], "sans-serif");
  EXPECT_EQ(svg.child_text(root, "title"), "lekalo locate: part.csv in blank.csv");
  EXPECT_NE(svg.child_text(root, "desc").find("minimum allowance 0.9469280"), std::string::npos);
}

TEST(PictureSvg, WhatSticksOutIsDashedAndOfAColourOutsideTheScale) {
  const LocatePicture picture = too_small_blank();
  ASSERT_LT(picture.result.clearance, 0);
  const XmlDocument svg(picture_svg(picture));
  const auto outside = svg.of("path", "allowance-outside");
  ASSERT_FALSE(outside.empty());
  for (const XmlElement& piece : outside) {
    EXPECT_NE(piece["stroke-dasharray"], "");
    for (int i = 0; i < draw::kColourSteps; ++i) {
      EXPECT_NE(piece["stroke"], hex(draw::scale_colour(i)));
    }
  }
  EXPECT_EQ(svg.of("path", "part-outside").size(), 1u);
  EXPECT_EQ(svg.of("text", "status").at(0).text, "infeasible");
  EXPECT_EQ(number_in(svg, "min-allowance"), 0.5);
  EXPECT_GE(number_in(svg, "shortfall"), picture.shortfall);
  EXPECT_LE(number_in(svg, "shortfall"), picture.shortfall + 1.001e-6);
  EXPECT_LE(number_in(svg, "clearance"), picture.result.clearance);
  EXPECT_NE(svg.of("text", "outside").at(0).text.find("mm"), std::string::npos);
}

TEST(PictureSvg, PartlyOutsideShowsBothAndTheThinnestColourWhereItCrossesTheBlank) {
  LocatePicture picture = example(1);
  picture.result.x += 3;
  const auto one = cases::published_examples()[0];
  picture.result.clearance = phi::clearance_enclosure(one.part(), one.blank(), picture.result.x,
                                                      picture.result.y, picture.result.theta)
                                 .low;
  const XmlDocument svg(picture_svg(picture));
  EXPECT_FALSE(svg.of("path", "allowance").empty());
  EXPECT_FALSE(svg.of("path", "allowance-outside").empty());
}

TEST(PictureSvg, PrintsTheNumbersOfTheFilesForContactsWhereTheyDiffer) {
  LocatePicture picture = example(2);
  for (std::uint32_t i = 0; i < 10; ++i) {
    rings(picture).vertex_numbers.push_back(100 + i);
    rings(picture).edge_numbers.push_back(200 + i);
  }
  const XmlDocument svg(picture_svg(picture));
  const auto labels = svg.of("text", "contact-label");
  ASSERT_EQ(labels.size(), rings(picture).contacts.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    EXPECT_EQ(labels[i].text, "v" + std::to_string(100 + rings(picture).contacts[i].part_vertex) + " e" +
                                  std::to_string(200 + rings(picture).contacts[i].blank_edge));
  }
}

TEST(PictureSvg, AStartFarAwayGoesToAnInsetAndLeavesTheResultAsLargeAsBefore) {
  LocatePicture near = example(1);
  rings(near).draw_start = false;
  LocatePicture far = near;
  rings(far).draw_start = true;
  rings(far).start = {1e6, 3e6, 1, 0};
  const XmlDocument without(picture_svg(near)), with(picture_svg(far));
  EXPECT_EQ(scale_by_bar(with), scale_by_bar(without));
  EXPECT_TRUE(without.of("path", "start").empty() && without.of("circle", "start").empty());
  const auto inset = with.of("text", "inset-caption");
  ASSERT_EQ(inset.size(), 1u);
  EXPECT_EQ(inset[0].text, "start: 3.2e+06 mm away");
  EXPECT_EQ(with.of("circle", "start").size(), 1u);
}

TEST(PictureSvg, AStartNearbyIsDrawnInPlace) {
  LocatePicture picture = example(1);
  rings(picture).start = picture.result;
  rings(picture).start.x += 2;
  const XmlDocument svg(picture_svg(picture));
  const auto start = svg.of("path", "start"), result = svg.of("path", "part-outline");
  ASSERT_EQ(start.size(), 1u);
  const Point moved = points_of(start[0])[0] - points_of(result.at(0))[0];
  EXPECT_NEAR(moved.x / scale_by_bar(svg), 2, 0.01);
  EXPECT_NEAR(moved.y, 0, 0.01);
  EXPECT_TRUE(svg.of("text", "inset-caption").empty());
}

TEST(PictureSvg, AThinPlaceTooSmallToSeeIsMagnified) {
  const auto part = cases::convex({{0, 0}, {400, 0}, {400, 250}, {0, 250}});
  const auto blank = cases::convex({{-0.1, -0.1}, {400.2, -0.1}, {401, 251}, {-0.1, 252}});
  const XmlDocument svg(picture_svg(picture_of(part, blank)));
  EXPECT_EQ(svg.of("circle", "thinnest").size(), 1u);
  const Ring line = points_of(svg.of("path", "thinnest-line").at(0));
  EXPECT_GT(geom::norm(line[1] - line[0]), 3);
  EXPECT_TRUE(svg.of("text", "inset-caption").at(0).text.starts_with("in the ring"));
}

TEST(PictureSvg, MethodsWithoutProofSaySoAndNeedNoContacts) {
  LocatePicture picture = example(3);
  picture.upper_bound.reset();
  rings(picture).contacts.clear();
  picture.status = "unproved";
  picture.method = "icp";
  const XmlDocument svg(picture_svg(picture));
  EXPECT_EQ(svg.of("text", "upper-bound").at(0).text, "not proved");
  EXPECT_TRUE(svg.of("text", "gap").empty());
  EXPECT_TRUE(svg.of("path", "contact").empty());
}

TEST(PictureSvg, AnInfiniteBoundIsADash) {
  LocatePicture picture = example(3);
  picture.upper_bound = std::numeric_limits<double>::infinity();
  const XmlDocument svg(picture_svg(picture));
  EXPECT_EQ(svg.of("text", "upper-bound").at(0).text, "–");
}

TEST(PictureSvg, NamesMayHoldAnything) {
  LocatePicture picture = example(1);
  picture.part_name = "scans/<лопатка> & \"7\"'.csv";
  picture.blank_name = std::string("a\xff\x01]]>") + "\xed\xa0\x80";
  const XmlDocument svg(picture_svg(picture));
  const auto names = svg.of("text", "name");
  ASSERT_EQ(names.size(), 2u);
  EXPECT_EQ(names[0].text, "<лопатка> & \"7\"'.csv");
  EXPECT_EQ(names[1].text.substr(0, 7), "a��");
}

TEST(PictureSvg, ContactsWithIndicesThatDoNotExistAreLeftOut) {
  LocatePicture picture = example(1);
  const std::size_t before = rings(picture).contacts.size();
  rings(picture).contacts.push_back({1000, 0, 0});
  rings(picture).contacts.push_back({0, 1000, 0});
  EXPECT_EQ(XmlDocument(picture_svg(picture)).of("path", "contact").size(), before);
}

void expect_sound(const LocatePicture& picture, const std::string& what) {
  const std::string text = picture_svg(picture);
  const XmlDocument svg(text);
  for (const XmlElement& path : svg.of("path")) {
    for (const Point p : points_of(path)) {
      ASSERT_TRUE(std::abs(p.x) < 1000 && std::abs(p.y) < 1000) << what << ' ' << path["class"];
    }
    ASSERT_EQ(path["d"].find("nan"), std::string::npos) << what;
    ASSERT_EQ(path["d"].find("inf"), std::string::npos) << what;
  }
  const geom::Box box = geom::bounds(points_of(svg.of("path", "blank-outline").at(0)));
  EXPECT_TRUE(box.high.x - box.low.x > 60 || box.high.y - box.low.y > 60) << what << ": the blank is a dot";
  EXPECT_LE(number_in(svg, "clearance"), picture.result.clearance) << what;
  EXPECT_LT(text.size(), 1'000'000u) << what;
  for (const XmlElement& line : svg.of("path", "contact")) {
    const Ring ends = points_of(line);
    EXPECT_NEAR(geom::norm(ends[1] - ends[0]), scale_by_bar(svg) * std::abs(picture.result.clearance), 0.05)
        << what;
  }
}

TEST(PictureSvg, AnyKindAndSizeOfShapeMakesASoundPicture) {
  for (std::uint64_t index = 0; index < 60; ++index) {
    const auto c = cases::random_case(cases::seed(), index);
    expect_sound(picture_of(c.part, c.blank), c.name);
  }
  expect_sound(picture_of(cases::regular_ngon(997, 99), cases::regular_ngon(1000, 100)), "997 in 1000");
  expect_sound(picture_of(cases::regular_ngon(1000, 1e-5), cases::regular_ngon(1000, 2e-5, {1, 1})), "1e-5");
  expect_sound(picture_of(cases::regular_ngon(7, 1e8), cases::regular_ngon(5, 3e8)), "1e8");
}

TEST(PictureSvg, NoAllowanceAtAllIsNotDrawnAsSticksOut) {
  const auto ring = cases::published_examples()[1].blank();
  LocatePicture picture = picture_of(ring, ring);
  const XmlDocument svg(picture_svg(picture));
  EXPECT_TRUE(svg.of("path", "allowance-outside").empty());
  EXPECT_FALSE(svg.of("path", "allowance").empty());
}

TEST(PictureSvg, OfAHundredThousandPointsIsQuickAndSmall) {
  Ring part = cases::with_points_on_edges(cases::superellipse(60, 50, 30), 100'000);
  Ring blank = cases::with_points_on_edges(cases::superellipse(80, 52, 32), 100'000);
  LocatePicture picture = example(1);
  rings(picture).part = part;
  rings(picture).blank = blank;
  rings(picture).contacts.clear();
  picture.result = {0.1, 0.1, 0.01, 1};
  const cases::Stopwatch watch;
  const std::string text = picture_svg(picture);
  EXPECT_LT(watch.seconds(), 20 * cases::kSlowdown);
  EXPECT_LT(text.size(), 2'000'000u);
  EXPECT_NO_THROW(XmlDocument{text});
}

}  // namespace
}  // namespace lekalo::test::picture_svg_test

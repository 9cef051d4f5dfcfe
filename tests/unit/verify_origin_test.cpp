#include "verify/origin/origin.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "verify/read/json.hpp"

/// Whether the checker agrees that a region is what its file means, whatever kind of file that is.
namespace lekalo::verify::verify_origin_test {
namespace {

std::string arc(double from_x, double from_y, double to_x, double to_y, double x, double y) {
  return fmt::format(R"({{"arc": {{"from": [{}, {}], "to": [{}, {}], "centre": [{}, {}], "ccw": true}}}})",
                     from_x, from_y, to_x, to_y, x, y);
}
/// Lines through points, without one back to the first.
std::string lines(const std::vector<std::array<double, 2>>& p) {
  std::string edges;
  for (std::size_t k = 0; k + 1 < p.size(); ++k)
    edges += fmt::format(R"({}{{"line": {{"from": [{}, {}], "to": [{}, {}]}}}})", k == 0 ? "" : ", ", p[k][0],
                         p[k][1], p[k + 1][0], p[k + 1][1]);
  return edges;
}
std::string region(const std::string& edges) { return R"({"outer": [)" + edges + "]}"; }
std::string rectangle(double x, double y, double to_x, double to_y) {
  return region(lines({{x, y}, {to_x, y}, {to_x, to_y}, {x, to_y}, {x, y}}));
}
std::string square(double size) { return rectangle(0, 0, size, size); }

struct Claim {
  std::string name, bytes, used = square(10);
  double tolerance = 0;
  std::string scan = "null", drawing = "null";
  std::vector<std::string> ignored = {};
  std::optional<LengthUnit> unit_of_ignored = {};
};
Origin origin_of(const Claim& claim) {
  std::string complaint;
  const Shape used = read_shape(*parse_json(claim.used, "u.json"), "u.json", complaint, false);
  EXPECT_EQ(complaint, "");
  const auto json = [](const std::string& text) {
    return text.empty() ? Json{} : *parse_json(text, "r.json");
  };
  std::vector<Json> ignored;
  for (const std::string& one : claim.ignored) ignored.push_back(json(one));
  const Document file{claim.name, claim.bytes};
  return check_origin(
      {file, used, claim.tolerance, json(claim.scan), json(claim.drawing), ignored, claim.unit_of_ignored});
}
/// Says "" where the region is what the file means.
std::string judged(const Claim& claim) {
  const Origin origin = origin_of(claim);
  return origin.fault ? "fault: " + *origin.fault : origin.open ? "open: " + *origin.open : "";
}
/// What each edge of the region may be called, or which edges of the file it runs along.
template <class Mark>
std::string told(const std::vector<std::set<Mark>>& of_edges) {
  std::string text;
  for (const std::set<Mark>& marks : of_edges) {
    text += "|";
    for (const Mark& mark : marks) text += fmt::format(" {}", mark);
  }
  return text;
}

// ---- the edges of the region ------------------------------------------------------------------------------

/// A square with one round corner, whose arc is the first edge; its ends miss the circle by half a
/// micrometre.
const std::string kRounded =
    region(arc(10, 9, 9, 10, 9, 9.000001) + ", " + lines({{9, 10}, {0, 10}, {0, 0}, {10, 0}, {10, 9}}));

TEST(VerifyOrigin, AnArcThatIsJoinedToItsEndsIsOneEdge) {
  const std::string tree =
      R"({"shape": {"difference": [{"name": "s", "rectangle": {"size": [10, 10], "corner": [0, 0]}},
        {"difference": [{"name": "c", "rectangle": {"size": [1, 1], "corner": [9, 9]}},
                        {"name": "r", "circle": {"centre": [9, 9], "radius": 1}}]}]}, "units": "mm"})";
  const Origin in_tree = origin_of({"t.json", tree, kRounded, 1e-4});
  EXPECT_EQ(in_tree.fault.value_or(""), "");
  EXPECT_EQ(in_tree.open.value_or(""), "");
  EXPECT_EQ(told(in_tree.labels), "| c r s| s| s| s| s");

  const auto line = [](const char* layer, double x, double y, double to_x, double to_y) {
    return fmt::format("0\nLINE\n8\n{}\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n", layer, x, y, to_x, to_y);
  };
  const std::string dxf = "0\nSECTION\n2\nENTITIES\n0\nARC\n8\nR\n10\n9\n20\n9\n40\n1\n50\n0\n51\n90\n" +
                          line("A", 9, 10, 0, 10) + line("B", 0, 10, 0, 0) + line("C", 0, 0, 10, 0) +
                          line("D", 10, 0, 10, 9) + "0\nENDSEC\n0\nEOF\n";
  Claim drawn{"d.dxf", dxf, kRounded, 1e-4};
  drawn.drawing = R"({"layers": [], "join": 0, "set_aside": []})";
  const Origin in_drawing = origin_of(drawn);
  EXPECT_EQ(judged(drawn), "");
  EXPECT_EQ(told(in_drawing.labels), "| R| A| B| C| D");
}

// ---- units ------------------------------------------------------------------------------------------------

std::string dxf(const std::string& groups, const std::string& header = "") {
  std::string words =
      "0 SECTION 2 HEADER" + header + " 0 ENDSEC 0 SECTION 2 ENTITIES " + groups + " 0 ENDSEC 0 EOF";
  std::replace(words.begin(), words.end(), ' ', '\n');
  return words + "\n";
}
const std::string kDxfSquare = "0 LWPOLYLINE 90 4 70 1 10 0 20 0 10 10 20 0 10 10 20 10 10 0 20 10";
const std::string kWords = R"({"layers": [], "join": 0, "set_aside": []})";
const std::string kTree = R"({"shape": {"rectangle": {"size": [10, 10], "corner": [0, 0]}})";

TEST(VerifyOrigin, AFileThatSaysNoUnitIsInMillimetresOrInInches) {
  const std::string outer = square(10).substr(0, square(10).size() - 1);
  const std::string points = R"({"points": [[0, 0], [10, 0], [10, 10], [0, 10]])";
  struct Kind {
    const char *name, *drawing;
    std::string silent, mm, inch, otherwise;
  };
  const std::string none_there = "its outline at (100, 0) is none of the tree's";
  for (const Kind& kind :
       {Kind{"r.json", "null", outer + "}", outer + R"(, "units": "mm"})", outer + R"(, "units": "inch"})",
             "it has other edges"},
        Kind{"p.json", "null", points + "}", points + R"(, "units": "mm"})", points + R"(, "units": "inch"})",
             "it is not the outline through its points"},
        Kind{"t.json", "null", kTree + "}", kTree + R"(, "units": "mm"})", kTree + R"(, "units": "inch"})",
             ""},
        Kind{"d.dxf", kWords.c_str(), dxf(kDxfSquare), dxf(kDxfSquare, " 9 $INSUNITS 70 4"),
             dxf(kDxfSquare, " 9 $INSUNITS 70 1"), ""}}) {
    const auto with = [&](const std::string& bytes, double size) {
      return judged({kind.name, bytes, square(size), 1e-6, "null", kind.drawing});
    };
    SCOPED_TRACE(kind.name);
    EXPECT_EQ(with(kind.silent, 10), "");
    EXPECT_EQ(with(kind.silent, 254), "");
    EXPECT_EQ(with(kind.silent, 100).substr(0, 7 + kind.otherwise.size()), "fault: " + kind.otherwise);
    EXPECT_EQ(with(kind.mm, 10), "");
    EXPECT_EQ(with(kind.mm, 254).substr(0, 6), "fault:");
    EXPECT_EQ(with(kind.inch, 10).substr(0, 6), "fault:");
    EXPECT_EQ(with(kind.inch, 254), "");
  }
  EXPECT_EQ(judged({"p.csv", "0,0\n10,0\n10,10\n0,10\n", square(254), 1e-6}), "");
  for (const char* unit : {R"("cm")", "5"})
    EXPECT_EQ(judged({"t.json", kTree + R"(, "units": )" + unit + "}"}),
              "fault: its units are not mm or inch");
}

TEST(VerifyOrigin, AnSvgThatSaysNoUnitMayBeInPixelsToo) {
  Claim claim{"d.svg", R"(<svg width="100" height="96"><rect width="96" height="96"/></svg>)"};
  claim.drawing = kWords, claim.tolerance = 1e-6;
  for (const double size : {96.0, 96 * 25.4, 25.4}) {
    claim.used = square(size);
    EXPECT_EQ(judged(claim), "") << size;
  }
  claim.used = square(97);
  EXPECT_NE(judged(claim), "");
}

TEST(VerifyOrigin, WhatIsOpenInMillimetresMayBeShownInInches) {
  // In mm the circle of the file is too small for the other, but within eight tolerances of it.
  const Claim claim{"t.json", R"({"shape": {"circle": {"radius": 0.5}}})",
                    region(arc(12.7, 0, 12.7, 0, 0, 0)), 1.6};
  EXPECT_EQ(judged(claim), "");
  Claim in_mm = claim;
  in_mm.bytes = R"({"units": "mm", "shape": {"circle": {"radius": 0.5}}})";
  EXPECT_EQ(judged(in_mm).substr(0, 5), "open:");
}

TEST(VerifyOrigin, StrokesLieNoNearerToACurveThanTheirShareOfTheTolerance) {
  // Within a millionth of a micrometre of an ellipse of this size there would be millions of strokes.
  Claim claim{"d.dxf", dxf("0 ELLIPSE 8 0 10 0 20 0 11 1000 21 0 40 0.5 41 0 42 6.283185307179586")};
  claim.drawing = kWords, claim.tolerance = 0.01;
  EXPECT_EQ(judged(claim).substr(0, 24), "fault: a curve of layer ");
}

// ---- what is ignored --------------------------------------------------------------------------------------

TEST(VerifyOrigin, EdgesRunAlongThoseOfTheFileWhereNothingIsTakenOff) {
  Claim claim{"r.json", square(10), rectangle(0, 0, 8, 10), 1e-6};
  claim.ignored = {rectangle(8, 0, 10, 10)};
  EXPECT_EQ(judged(claim), "");
  EXPECT_EQ(told(origin_of(claim).edges), "| 0|| 2| 3");
  claim.used = square(10);
  EXPECT_EQ(judged(claim).substr(0, 6), "fault:");
  // The first edge of the file is joined to its ends.
  claim.bytes = kRounded, claim.used = rectangle(0, 0, 8, 10), claim.tolerance = 1e-5;
  EXPECT_EQ(judged(claim), "");
  EXPECT_EQ(told(origin_of(claim).edges), "| 3|| 1| 2");
}

TEST(VerifyOrigin, WhatIsIgnoredHasItsOwnUnitOrThatOfTheFile) {
  Claim claim{"r.json", square(254), rectangle(0, 0, 228.6, 254), 1e-6};
  claim.ignored = {rectangle(9, 0, 10, 10)};
  claim.unit_of_ignored = LengthUnit::inch;
  EXPECT_EQ(judged(claim), "");
  claim.unit_of_ignored = LengthUnit::millimetre;
  EXPECT_EQ(judged(claim).substr(0, 6), "fault:");
  claim.ignored = {rectangle(228.6, 0, 254, 254)};
  EXPECT_EQ(judged(claim), "");
  claim.unit_of_ignored.reset();
  EXPECT_EQ(judged(claim), "");
  claim.bytes = square(10), claim.ignored = {rectangle(9, 0, 10, 10)};
  EXPECT_EQ(judged(claim), "");
}

// ---- kinds of files ---------------------------------------------------------------------------------------

TEST(VerifyOrigin, TheNameOfAFileAndItsBeginningSayWhatItIs) {
  EXPECT_EQ(judged({"part", "\n\t {" + kTree.substr(1) + "}"}), "");
  EXPECT_EQ(judged({"part", square(10)}), "");
  EXPECT_EQ(judged({"r.json", square(10), square(10), 0, "null", ""}), "");
  EXPECT_EQ(judged({"r.json", square(10), square(10), 0, "null", kWords}),
            "fault: it is no drawing, but the field drawings says how one was read");
  const std::string unknown = "fault: part: the name does not end in .csv, .txt, .xyz, .json or .dxf";
  for (const char* bytes : {"0,0\n10,0\n10,10\n0,10\n", "[[0, 0], [10, 0], [10, 10], [0, 10]]", " \n", ""})
    EXPECT_EQ(judged({"part", bytes}), unknown) << bytes;
  EXPECT_EQ(judged({"part.csv", kTree + "}"}).substr(0, 6), "fault:");
  EXPECT_EQ(judged({"part.dwg", kTree + "}"}), "open: files that end so are not read here");
  EXPECT_EQ(judged({"p.json", "[[0, 0], [10, 0], [10, 10], [0, 10]]"}), "");
  EXPECT_EQ(judged({"p.json", "5"}), "fault: p.json: neither a list of points nor an object");
  EXPECT_EQ(judged({"p.json", "\"{\""}), "fault: p.json: neither a list of points nor an object");
  const std::string pieces = R"({"pieces": [)" + square(10) + ", " + rectangle(20, 0, 30, 10) + "]}";
  EXPECT_EQ(judged({"r.json", pieces, pieces}), "");
  EXPECT_EQ(judged({"t.json", kTree + R"(, "shape": {"circle": {"radius": 5}}})"}),
            "fault: field shape is given twice");
  EXPECT_EQ(judged({"r.json", square(10).substr(0, square(10).size() - 1) + R"(, "outer": []})"}),
            "fault: field r.json.outer is given twice");
}

TEST(VerifyOrigin, AScanWithAGapIsProvedByNobody) {
  std::string points;
  for (int k = 0; k < 20; ++k) {
    const int side = k / 5, t = k % 5 * 2;
    points += fmt::format("{} {}\n",
                          side == 0   ? t
                          : side == 1 ? 10
                          : side == 2 ? 10 - t
                                      : 0,
                          side == 0   ? 0
                          : side == 1 ? t
                          : side == 2 ? 10
                                      : 10 - t);
  }
  const auto with = [&](bool proved, double step) {
    return judged({"s.csv", points, rectangle(1.05, 1.05, 8.95, 8.95), 0,
                   fmt::format(R"({{"units": "mm", "points": 20, "proved": {}, "ordered": true, "guard": 0.1,
                     "step": {}, "loss": 1.5, "min_radius": null, "max_dip": null, "slice": null,
                     "left_out": [], "outlines": null}})",
                               proved, step)});
  };
  EXPECT_EQ(with(true, 2), "");
  EXPECT_EQ(with(true, 1), "fault: scan.proved is true, but some of its contours is unknown");
  EXPECT_EQ(with(false, 1), "open: some of its contours is not measured, and nothing is proved there");
}

}  // namespace
}  // namespace lekalo::verify::verify_origin_test

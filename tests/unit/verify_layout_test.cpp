// The checker of layouts: each rule, what touching is, and what is no layout.

#include "lekalo/verify/layout.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/layout_texts.hpp"

namespace lekalo::verify::verify_layout_test {
namespace {

using cases::add_part;
using cases::empty_layout;
using cases::Json;
using cases::outline_json;
using cases::place;
using cases::Points;
using cases::rectangle;

/// "overlap 1 2, defect 1 d" or the error's sentence.
std::string verdict(const std::string& bytes) {
  const auto checked = verify_layout({"layout.json", bytes});
  if (!checked) {
    EXPECT_EQ(checked.error().code, ErrorCode::bad_input);
    return checked.error().message;
  }
  std::string text;
  for (const LayoutViolation& v : checked->violations) {
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", name_of(v.kind), v.a);
    if (v.b != 0) text += fmt::format(" {}", v.b);
    if (!v.feature.empty()) text += " " + v.feature;
  }
  return text;
}
std::string verdict(const Json& layout) { return verdict(layout.dump()); }

/// Of two parts, the second one moved, turned about the origin first.
std::string of_two(const Json& first, const Json& second, double x, double y, double degrees = 0) {
  Json layout = empty_layout();
  add_part(layout, "a", first);
  add_part(layout, "b", second);
  place(layout, "a", 40, 40);
  place(layout, "b", 40 + x, 40 + y, degrees);
  return verdict(layout);
}

const Json kSquare = outline_json(rectangle(0, 0, 10, 10));
const Json kRing = outline_json(rectangle(0, 0, 30, 30), {rectangle(10, 10, 10, 10)});
const Json kTriangle = outline_json({{0, 0}, {10, 0}, {0, 10}});
constexpr double kStep = 0x1p-20;

TEST(VerifyLayout, TouchingIsNotOverlapping) {
  EXPECT_EQ(of_two(kSquare, kSquare, 10, 0), "") << "whole edge, opposite sides";
  EXPECT_EQ(of_two(kSquare, kSquare, 10, 3), "") << "part of an edge";
  EXPECT_EQ(of_two(kSquare, kSquare, 10, 10), "") << "vertex on vertex";
  EXPECT_EQ(of_two(kSquare, kTriangle, 10, 5, -45), "")
      << "vertex on an edge: half of a right angle each side";
  EXPECT_EQ(of_two(kRing, kSquare, 10, 10), "") << "a part fills a hole";
  EXPECT_EQ(of_two(kSquare, kRing, -10, -10), "");
  EXPECT_EQ(of_two(kRing, kTriangle, 10, 10), "") << "in the hole, on two of its edges";
  EXPECT_EQ(of_two(kRing, outline_json(rectangle(0, 0, 2, 2)), 14, 14), "") << "free in the hole";
}

TEST(VerifyLayout, AStepIsOverlapping) {
  EXPECT_EQ(of_two(kSquare, kSquare, 10 - kStep, 0), "overlap 1 2");
  EXPECT_EQ(of_two(kSquare, kSquare, 10 - kStep, 10 - kStep), "overlap 1 2");
  EXPECT_EQ(of_two(kRing, kSquare, 10 - kStep, 10), "overlap 1 2");
  EXPECT_EQ(of_two(kRing, kSquare, 10, 10 + kStep), "overlap 1 2");
  // Half a step is the even one of two.
  EXPECT_EQ(of_two(kSquare, kSquare, 10 - kStep / 2, 0), "");
  EXPECT_EQ(of_two(kSquare, kSquare, 10 - 1.5 * kStep, 0), "overlap 1 2");
}

TEST(VerifyLayout, OverlapsWithoutAVertexInside) {
  EXPECT_EQ(of_two(kSquare, kSquare, 0, 0), "overlap 1 2") << "a part on itself";
  EXPECT_EQ(of_two(kRing, kRing, 0, 0), "overlap 1 2");
  EXPECT_EQ(of_two(outline_json(rectangle(0, 10, 30, 10)), outline_json(rectangle(10, 0, 10, 30)), 0, 0),
            "overlap 1 2")
      << "crossing bars";
  EXPECT_EQ(of_two(kSquare, outline_json(rectangle(0, 0, 20, 10)), 0, 0), "overlap 1 2") << "same sides";
  EXPECT_EQ(of_two(kSquare, outline_json(rectangle(2, 2, 3, 3)), 0, 0), "overlap 1 2") << "one in the other";
  EXPECT_EQ(of_two(kSquare, outline_json(rectangle(0, 2, 10, 3)), 0, 0), "overlap 1 2")
      << "one in the other, all vertices on edges";
  // Two triangles with the same three vertices in the middles of edges.
  EXPECT_EQ(
      of_two(outline_json({{0, 0}, {20, 0}, {10, 20}}), outline_json({{10, 0}, {15, 10}, {5, 10}}), 0, 0),
      "overlap 1 2");
}

TEST(VerifyLayout, GapsAreExact) {
  const auto with_gap = [](double gap, double x, double y) {
    Json layout = empty_layout();
    layout["rules"] = {{"gap", gap}};
    add_part(layout, "a", kSquare);
    place(layout, "a", 40, 40);
    place(layout, "a", 40 + x, 40 + y);
    return verdict(layout);
  };
  EXPECT_EQ(with_gap(3, 13, 0), "");
  EXPECT_EQ(with_gap(3, 13 - kStep, 0), "gap 1 2");
  EXPECT_EQ(with_gap(5, 13, 14), "") << "from corner to corner 3, 4, 5";
  EXPECT_EQ(with_gap(5, 13, 14 - kStep), "gap 1 2");
  EXPECT_EQ(with_gap(3, 10, 0), "gap 1 2") << "touching";
  EXPECT_EQ(with_gap(0, 10, 0), "");
  EXPECT_EQ(with_gap(3, 9, 0), "overlap 1 2") << "not a gap as well";
  EXPECT_EQ(with_gap(3 + kStep / 1024, 13, 0), "gap 1 2") << "gaps are rounded up";

  Json own = empty_layout();
  own["rules"] = {{"gap", 3}};
  add_part(own, "a", kSquare)["gap"] = 0;
  add_part(own, "b", kSquare)["gap"] = 2;
  place(own, "a", 10, 10);
  place(own, "b", 22, 10);
  EXPECT_EQ(verdict(own), "") << "the larger of both parts' own gaps";
  own["parts"][1]["gap"] = 2.001;
  EXPECT_EQ(verdict(own), "gap 1 2");
  own["placements"][1]["stock"] = "t";
  own["stocks"].push_back(own["stocks"][0]);
  own["stocks"][1]["id"] = "t";
  EXPECT_EQ(verdict(own), "") << "on different stocks";

  Json hole = empty_layout();
  hole["rules"] = {{"gap", 3}};
  add_part(hole, "a", kRing);
  add_part(hole, "b", outline_json(rectangle(0, 0, 4, 4)));
  place(hole, "a", 0, 0);
  place(hole, "b", 13, 13);
  EXPECT_EQ(verdict(hole), "");
  hole["placements"][1]["x"] = 13 + kStep;
  EXPECT_EQ(verdict(hole), "gap 1 2");
}

TEST(VerifyLayout, Borders) {
  Json layout = empty_layout();
  layout["stocks"][0]["outline"] = outline_json(rectangle(0, 0, 100, 100), {rectangle(40, 40, 10, 10)});
  add_part(layout, "a", kSquare);
  Json& at = place(layout, "a", 0, 0);
  const auto moved = [&](double x, double y) {
    at["x"] = x, at["y"] = y;
    return verdict(layout);
  };
  EXPECT_EQ(moved(0, 0), "");
  EXPECT_EQ(moved(-kStep, 0), "outside 1");
  EXPECT_EQ(moved(90, 90 + kStep), "outside 1");
  EXPECT_EQ(moved(30, 40), "") << "beside the hole";
  EXPECT_EQ(moved(30 + kStep, 40), "outside 1");
  EXPECT_EQ(moved(40, 40), "outside 1") << "on the hole";
  EXPECT_EQ(moved(200, 40), "outside 1");
  layout["rules"] = {{"border_gap", 5}};
  EXPECT_EQ(moved(5, 5), "");
  EXPECT_EQ(moved(5, 85 + kStep), "border-gap 1");
  EXPECT_EQ(moved(25 + kStep, 40), "border-gap 1");
  layout["parts"][0]["border_gap"] = 4;
  EXPECT_EQ(moved(25 + kStep, 40), "");
  // A part around the stock's hole: no vertex of it is outside.
  layout["parts"][0]["outline"] = outline_json(rectangle(0, 0, 30, 30));
  EXPECT_EQ(moved(30, 30), "outside 1");
  layout["parts"][0]["outline"] = outline_json(rectangle(0, 0, 30, 30), {rectangle(10, 10, 10, 10)});
  layout["parts"][0]["border_gap"] = 0;
  EXPECT_EQ(moved(30, 30), "") << "its own hole on that of the stock";
}

TEST(VerifyLayout, Defects) {
  Json layout = empty_layout();
  layout["stocks"][0]["defects"] = {{{
                                         "id",
                                         "d",
                                     },
                                     {"severity", 2},
                                     {"outline", outline_json(rectangle(50, 50, 4, 4))}}};
  add_part(layout, "a", kSquare);
  Json& at = place(layout, "a", 40, 50);
  EXPECT_EQ(verdict(layout), "");
  at["x"] = 40 + kStep;
  EXPECT_EQ(verdict(layout), "defect 1 d");
  at["x"] = 47, at["y"] = 47;
  EXPECT_EQ(verdict(layout), "defect 1 d") << "the defect inside";
  layout["parts"][0]["tolerated_severity"] = 2;
  EXPECT_EQ(verdict(layout), "");
  layout["parts"][0]["tolerated_severity"] = 1;
  layout["rules"] = {{"defect_gap", 1}};
  at["x"] = 39, at["y"] = 50;
  EXPECT_EQ(verdict(layout), "");
  at["x"] = 39 + kStep;
  EXPECT_EQ(verdict(layout), "defect-gap 1 d");
}

TEST(VerifyLayout, ZonesAndAreas) {
  Json layout = empty_layout();
  layout["stocks"][0]["zones"] = {
      {{"id", "z"}, {"quality", 2}, {"outline", outline_json(rectangle(50, 0, 50, 100))}}};
  Json& part = add_part(layout, "a", kSquare);
  Json& at = place(layout, "a", 45, 0);  // its right half in the zone
  const auto area = [](const Json& quality, const Points& points) {
    return Json{{"quality", quality}, {"outline", outline_json(points)}};
  };
  EXPECT_EQ(verdict(layout), "") << "any quality";
  part["quality"] = 2;
  EXPECT_EQ(verdict(layout), "");
  part["quality"] = 3;
  EXPECT_EQ(verdict(layout), "quality 1 z");
  part["quality"] = "best";
  EXPECT_EQ(verdict(layout), "quality 1 z");
  at["x"] = 40;
  EXPECT_EQ(verdict(layout), "") << "beside the zone";
  at["x"] = 45;
  part["areas"] = Json::array({area(2, rectangle(5, 0, 5, 10))});
  EXPECT_EQ(verdict(layout), "") << "excused where the zone is";
  at["x"] = 45 + kStep;
  EXPECT_EQ(verdict(layout), "quality 1 z");
  at["x"] = 45;
  part["areas"] = Json::array({area(0, rectangle(5, 0, 5, 6)), area(1, rectangle(4, 5, 8, 9))});
  EXPECT_EQ(verdict(layout), "") << "two that overlap excuse it together";
  part["areas"] = Json::array({area(0, rectangle(5, 0, 5, 5)), area(1, rectangle(4, 5 + 8 * kStep, 8, 9))});
  EXPECT_EQ(verdict(layout), "quality 1 z") << "a slit between them";
  part["areas"] = Json::array({area(0, rectangle(-1, -1, 20, 20)), area(3, rectangle(7, 7, 1, 1))});
  EXPECT_EQ(verdict(layout), "quality 1 z") << "the highest counts where areas overlap";
  part["areas"][1] = area(3, rectangle(2, 7, 3, 1));
  EXPECT_EQ(verdict(layout), "") << "that one beside the zone";
  part["areas"] = Json::array({area(3, rectangle(10, 0, 4, 4))});
  part["quality"] = 0;
  EXPECT_EQ(verdict(layout), "") << "of an area only what is in the part";
  part["areas"] = Json::array({area("best", rectangle(8, 8, 4, 4))});
  EXPECT_EQ(verdict(layout), "quality 1 z");
  at["rotation_deg"] = 180, at["x"] = 55, at["y"] = 10;
  EXPECT_EQ(verdict(layout), "") << "turned away from the zone with the part";
  part["mirror"] = true;
  at["mirrored"] = true;
  EXPECT_EQ(verdict(layout), "quality 1 z") << "mirrored and turned it is in the zone again";
  at["rotation_deg"] = 0, at["y"] = 0;
  EXPECT_EQ(verdict(layout), "") << "mirrored away from it";

  // The worse of two zones counts; each is named.
  layout["stocks"][0]["zones"].push_back(
      {{"id", "y"}, {"quality", 1}, {"outline", outline_json(rectangle(48, 0, 9, 9))}});
  part.erase("areas");
  part["quality"] = 3;
  EXPECT_EQ(verdict(layout), "quality 1 z, quality 1 y");
  part["quality"] = 2;
  EXPECT_EQ(verdict(layout), "quality 1 y");
}

TEST(VerifyLayout, AnglesMirrorsGrainsCopies) {
  Json layout = empty_layout();
  Json& part = add_part(layout, "a", kSquare);
  Json& at = place(layout, "a", 50, 50);
  const auto turned = [&](double degrees) {
    at["rotation_deg"] = degrees;
    return verdict(layout);
  };
  EXPECT_EQ(turned(12.34), "");
  part["rotations"] = {0, 180, {{"from", 85}, {"to", 95}}, {{"from", 350}, {"to", 370}}};
  for (const double degrees : {0.0, 180.0, -180.0, 540.0, 85.0, 90.0, 95.0, 10.0, -10.0, 355.0})
    EXPECT_EQ(turned(degrees), "") << degrees;
  for (const double degrees : {1e-12, 84.9, 95.0001, 11.0, 349.0, 270.0})
    EXPECT_EQ(turned(degrees), degrees == 1e-12 ? "" : "rotation 1") << degrees;
  part["rotations"] = {{{"from", 20}, {"to", 300}}};
  EXPECT_EQ(turned(299), "");
  EXPECT_EQ(turned(301), "rotation 1");
  EXPECT_EQ(turned(0), "rotation 1");
  part["rotations"] = {{{"from", 20}, {"to", 380}}};
  EXPECT_EQ(turned(10), "");
  part["rotations"] = {0};
  EXPECT_EQ(turned(1e-12), "rotation 1") << "some multiples of 2^-52";
  at.erase("rotation_deg");
  at["c"] = 1, at["s"] = 0x1p-54;
  EXPECT_EQ(verdict(layout), "") << "the nearest multiple is 0";
  at["s"] = 0x1p-52;
  EXPECT_EQ(verdict(layout), "rotation 1");
  at.erase("c"), at.erase("s");

  part.erase("rotations");
  at["mirrored"] = true;
  EXPECT_EQ(turned(0), "mirror 1");
  part["mirror"] = true;
  EXPECT_EQ(turned(0), "");

  layout["stocks"][0]["grain_deg"] = 90;
  part["grain"] = {{"deg", 60}, {"tolerance_deg", 5}};
  at["mirrored"] = false;
  EXPECT_EQ(turned(30), "");
  EXPECT_EQ(turned(35), "");
  EXPECT_EQ(turned(35.0001), "grain 1");
  EXPECT_EQ(turned(210), "");
  EXPECT_EQ(turned(-30), "grain 1");
  at["mirrored"] = true;  // at 120
  EXPECT_EQ(turned(-30), "");
  EXPECT_EQ(turned(30), "grain 1");

  at["copy"] = 1;
  EXPECT_EQ(turned(-30), "stock 1");
  layout["stocks"][0]["count"] = 2;
  EXPECT_EQ(turned(-30), "");
}

TEST(VerifyLayout, AGrainThatOneOfTheTwoHasNotAllowsEveryAngle) {
  for (const bool of_part : {false, true}) {
    Json layout = empty_layout();
    Json& part = add_part(layout, "a", kSquare);
    if (of_part)
      part["grain"] = {{"deg", 0}};
    else
      layout["stocks"][0]["grain_deg"] = 0;
    place(layout, "a", 50, 50, 37);
    EXPECT_EQ(verdict(layout), "");
  }
}

TEST(VerifyLayout, TheOrderOfViolations) {
  Json layout = empty_layout();
  layout["stocks"][0]["count"] = 2;
  add_part(layout, "a", kSquare)["rotations"] = {90};
  place(layout, "a", -5, 0)["id"] = 9;
  place(layout, "a", -4, 0)["id"] = 4;
  place(layout, "a", 3, 0)["id"] = 6;
  place(layout, "a", 50, 0)["copy"] = 1;
  EXPECT_EQ(
      verdict(layout),
      "overlap 4 6, overlap 4 9, outside 4, rotation 4, overlap 6 9, rotation 6, outside 9, rotation 9, "
      "rotation 10");
}

TEST(VerifyLayout, Strips) {
  Json layout = empty_layout();
  layout["stocks"][0] = {{"id", "s"}, {"kind", "strip"}, {"height", 20}, {"length", 50}};
  add_part(layout, "a", kSquare);
  Json& at = place(layout, "a", 40, 10);
  EXPECT_EQ(verdict(layout), "");
  at["x"] = 40 + kStep;
  EXPECT_EQ(verdict(layout), "outside 1");
  layout["stocks"][0].erase("length");
  at["x"] = 262134;
  EXPECT_EQ(verdict(layout), "");
  at["x"] = 262134.5;
  EXPECT_EQ(verdict(layout), "outside 1");
}

/// A part of one arc and one line, both ways of chords: the upper half of a circle of radius 10.
Json half_disc(bool outside, double radius_factor = 1) {
  Points points{{10, 0}};
  const int pieces = 16;
  const double pi = 3.141592653589793;
  for (int i = 0; i < pieces; ++i) {
    if (outside) {
      const double angle = pi * (i + 0.5) / pieces,
                   r = radius_factor * (10 + 1e-5) / std::cos(pi / pieces / 2);
      points.push_back({r * std::cos(angle), r * std::sin(angle)});
    } else if (i > 0) {
      const double angle = pi * i / pieces, r = radius_factor * (10 - 1e-5);
      points.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
  }
  points.push_back({-10, 0});
  Json outline = outline_json(points);
  outline["curves"] = {{"outer",
                        {{{"arc", {{"from", {10, 0}}, {"to", {-10, 0}}, {"centre", {0, 0}}, {"ccw", true}}}},
                         {{"line", {{"from", {-10, 0}}, {"to", {10, 0}}}}}}}};
  outline["chord_tolerance"] = 0.06;
  return outline;
}

TEST(VerifyLayout, ChordsLieOnTheirSideOfTheArcs) {
  const auto part = [](const Json& outline) {
    Json layout = empty_layout();
    add_part(layout, "a", outline);
    return verdict(layout);
  };
  const auto stock = [](const Json& outline) {
    Json layout = empty_layout();
    layout["stocks"][0]["outline"] = outline;
    return verdict(layout);
  };
  const auto says = [](const std::string& sentence, const std::string& words) {
    return sentence.find(words) != std::string::npos;
  };
  EXPECT_EQ(part(half_disc(true)), "");
  EXPECT_EQ(stock(half_disc(false)), "");
  EXPECT_PRED2(says, part(half_disc(false)), "cuts into an arc");
  EXPECT_PRED2(says, stock(half_disc(true)), "reaches out of an arc");
  EXPECT_PRED2(says, part(half_disc(true, 1 - 2e-6)), "cuts into an arc");
  EXPECT_PRED2(says, part(half_disc(true, 1.01)), "farther from an arc");
  EXPECT_PRED2(says, stock(half_disc(false, 0.99)), "farther from an arc");
  EXPECT_PRED2(says, stock(half_disc(false, 1.000002)), "reaches out of an arc");
  Json backwards = half_disc(true);
  Json& loop = backwards["polygon"]["outer"];
  std::reverse(loop.begin(), loop.end());
  EXPECT_EQ(part(backwards), "") << "loops may run either way";
  Json changed = half_disc(true);
  changed["polygon"]["outer"][5][0] = -3.0;
  EXPECT_PRED2(says, part(changed), "arc");
  changed = half_disc(true);
  changed["curves"]["outer"][0]["arc"]["ccw"] = false;
  EXPECT_PRED2(says, part(changed), "is not what its curves become");
  changed = half_disc(true);
  changed["polygon"]["outer"].push_back({0.0, -1.0});
  EXPECT_PRED2(says, part(changed), "no point is where edge 1 of the drawing ends");
  changed = half_disc(true);
  changed["polygon"]["holes"] = {{{0, 2}, {1, 2}, {0, 3}}};
  EXPECT_PRED2(says, part(changed), "2 loops");
  changed = half_disc(true);
  changed.erase("polygon");
  EXPECT_PRED2(says, part(changed), "let lekalo write the file");
}

TEST(VerifyLayout, WhatIsNoLayout) {
  const auto refused = [](const Json& layout, const std::string& words) {
    const std::string sentence = verdict(layout);
    EXPECT_NE(sentence.find(words), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find("layout.json: "), 0U);
  };
  const auto with_part = [&](const Json& outline, const std::string& words) {
    Json layout = empty_layout();
    add_part(layout, "a", outline);
    refused(layout, words);
  };
  with_part(outline_json({{0, 0}, {10, 10}, {10, 0}, {0, 10}}), "cross");
  with_part(outline_json({{0, 0}, {10, 0}, {5, 2 * kStep}}), "less than 3 steps");
  with_part(outline_json({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}), "less than 3 steps");
  with_part(outline_json({{0, 0}, {10, 0}, {10, 10}, {0, 0}}), "twice");
  with_part(outline_json({{0, 0}, {10, 0}}), "fewer than three");
  with_part(outline_json(rectangle(0, 0, 9, 9), {rectangle(10, 0, 2, 2)}), "hole 0 is not inside");
  with_part(outline_json(rectangle(0, 0, 9, 9), {rectangle(1, 1, 5, 5), rectangle(2, 2, 1, 1)}),
            "is inside hole");
  with_part(outline_json(rectangle(0, 0, 9, 9), {rectangle(5, 5, 9, 1)}), "cross");
  with_part(outline_json(rectangle(0, 0, 300000, 9)), "parts[0].outline.polygon.outer[1]");
  with_part(Json::object(), "no polygon");
  with_part(Json::array(), "not an object");

  Json layout = empty_layout();
  add_part(layout, "a", kSquare);
  place(layout, "a", 0, 0);
  const auto changed = [&](const std::string& pointer, const Json& value, const std::string& words) {
    Json other = layout;
    other.at(pointer) = value;
    refused(other, words);
  };
  changed("/format", "lekalo-layout/2", "lekalo-layout/1");
  changed("/units", "inch", "not \"mm\"");
  changed("/colour", 1, "field colour is not one of a layout");
  changed("/placements/0/part", "b", "which is not there");
  changed("/placements/0/id", 0, "whole number");
  changed("/placements/0/x", 600000, "placements[0].x");
  changed("/placements/0/c", 1, "beside c and s");
  changed("/placements/0/copy", -1, "whole number");
  changed("/placements/0/mirrored", "no", "neither true nor false");
  changed("/parts/0/gap", -1, "not from 0");
  changed("/parts/0/rotations", Json::array(), "can never lie");
  changed("/parts/0/quality", "good", "whole number");
  changed("/parts/1", layout["parts"][0], "of another");
  changed("/stocks/0/kind", "roll", "strip, sheet or hide");
  changed("/next_id", 1, "next_id");
  Json other = layout;
  other["placements"].push_back(layout["placements"][0]);
  other["placements"][0]["id"] = other["placements"][1]["id"] = 3;
  refused(other, "id of another");
  other = layout;
  other["placements"][0].erase("rotation_deg");
  refused(other, "placements[0].c is missing");
  other["placements"][0]["c"] = 0.6, other["placements"][0]["s"] = 0.81;
  refused(other, "no cosine and sine");
  other["placements"][0]["s"] = 0.8;
  EXPECT_EQ(verdict(other), "outside 1");
  other["x_note"] = {{"anything", 1}};
  EXPECT_EQ(verdict(other), "outside 1");
  EXPECT_NE(verdict(std::string()).find("layout.json"), std::string::npos);
  EXPECT_NE(verdict(std::string("[1e999]")).find("layout.json"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::verify::verify_layout_test

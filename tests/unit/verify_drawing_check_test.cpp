#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "verify/origin/drawing_check.hpp"
#include "verify/shape/stretch.hpp"

/// What the checker says of an outline, and of what lies beside it, against the curves of a drawing.
namespace lekalo::verify::verify_drawing_check_test {
namespace {

constexpr double kReach = 0.25;

Vec point(double x, double y) { return {just(x), just(y)}; }
Side line(double x, double y, double to_x, double to_y) {
  return side_between(point(x, y), point(to_x, to_y));
}

/// A triangle, and the same as curves of a layer.
std::vector<Side> triangle() { return {line(0, 0, 8, 0), line(8, 0, 0, 6), line(0, 6, 0, 0)}; }
Shape outline(std::vector<Side> sides = triangle()) {
  Shape shape;
  shape.sides = std::move(sides);
  return shape;
}
DrawnCurve curve(const std::string& layer, const std::vector<Side>& sides, bool hidden = false) {
  DrawnCurve drawn;
  for (const Side& side : sides) drawn.pieces.push_back({side});
  drawn.layer = layer, drawn.hidden = hidden;
  return drawn;
}

/// The fault, or behind `?` what is open, or the layers of the edges.
std::string said(const WrittenDrawing& written, std::vector<DrawnCurve> curves, const Shape& used = outline(),
                 double reach = kReach) {
  ReadDrawing drawing;
  drawing.curves = std::move(curves);
  const DrawingVerdict verdict = check_drawing(written, drawing, used, reach);
  if (!verdict.fault.empty()) return verdict.fault;
  if (!verdict.open.empty()) return "?" + verdict.open;
  std::string text;
  for (const auto& layers : verdict.layers) {
    for (const std::string& layer : layers) text += layer + ",";
    text += ";";
  }
  return text;
}

TEST(VerifyDrawingCheck, AnOutlineRunsAlongTheCurvesThatCount) {
  EXPECT_EQ(said({}, {curve("a", triangle())}), "a,;a,;a,;");
  EXPECT_EQ(said({}, {curve("a", triangle()), curve("b", {line(8, 0, 0, 6)})}), "a,;a,b,;a,;");
  EXPECT_EQ(said({}, {curve("a", triangle()), curve("b", {line(20, 0, 21, 0)})}),
            "a curve of layer b about (20, 0) is neither of its outlines nor a mark nor set aside");
  // A line that joins an arc to its end is none of the edges.
  std::vector<Side> sides = triangle();
  sides[0].written = sides[2].written = false;
  EXPECT_EQ(said({}, {curve("a", triangle())}, outline(sides)), "a,;");
}

TEST(VerifyDrawingCheck, OnlyTheLayersThatWereTakenCount) {
  const DrawnCurve part = curve("a", triangle()), other = curve("b", {line(20, 0, 21, 0)}),
                   hidden = curve("c", {line(20, 0, 21, 0)}, true),
                   hidden_part = curve("d", triangle(), true);
  WrittenDrawing of_a, of_d;
  of_a.layers = {"A"}, of_d.layers = {"d"};
  EXPECT_EQ(said({}, {part, hidden}), "a,;a,;a,;");
  EXPECT_EQ(said(of_a, {part, other, hidden}), "a,;a,;a,;");
  EXPECT_EQ(said(of_d, {other, hidden_part}), "d,;d,;d,;");
  EXPECT_EQ(said({}, {hidden_part}), "its outline about (0, 0) runs along no curve that counts");
}

TEST(VerifyDrawingCheck, WhatWasSetAsideIsNoLongerThanTheJoin) {
  const DrawnCurve part = curve("a", triangle()), scrap = curve("b", {line(20, 0, 23, 4)});
  const std::string fault =
      "a curve of layer b about (20, 0) is neither of its outlines nor a mark nor set aside";
  WrittenDrawing written;
  EXPECT_EQ(said(written, {part, scrap}), fault);
  written.join = 5, written.set_aside = {point(20, 0)};
  EXPECT_EQ(said(written, {part, scrap}), "a,;a,;a,;");
  written.join = 4.5;
  EXPECT_EQ(said(written, {part, scrap}), fault);
  written.join = 5, written.set_aside = {point(30, 0), point(21, 0)};
  EXPECT_EQ(said(written, {part, scrap}), "a,;a,;a,;");
  // As far as the reach and no farther.
  written.join = 0, written.set_aside = {point(20, 0)};
  const double length = farthest(scrap.pieces[0].side, point(20, 0));
  EXPECT_EQ(said(written, {part, scrap}, outline(), length), "a,;a,;a,;");
  EXPECT_EQ(said(written, {part, scrap}, outline(), step_down(length)), fault);
}

TEST(VerifyDrawingCheck, MarksAndWhatWasSetAsideRunAlongCurvesToo) {
  const DrawnCurve part = curve("a", triangle()), beside = curve("b", {line(20, 0.5, 24, 0.5)});
  const auto loose = [](std::vector<Side> marks, std::vector<Side> aside, double error) {
    WrittenDrawing written;
    written.marks = std::move(marks), written.set_aside_curves = std::move(aside),
    written.loose_error = error;
    return written;
  };
  const std::vector<Side> mark{line(20, 0, 24, 0)};
  EXPECT_EQ(said(loose(mark, {}, 1), {part, beside}), "a,;a,;a,;");
  EXPECT_EQ(said(loose({}, mark, 1), {part, beside}), "a,;a,;a,;");
  EXPECT_EQ(said(loose(mark, {}, 0), {part, beside}),
            "a curve of layer b about (20, 0.5) is neither of its outlines nor a mark nor set aside");
  EXPECT_EQ(said(loose(mark, {}, 0), {part, beside}, outline(), 0.75), "a,;a,;a,;");
  for (const auto& written : {loose(mark, {}, 1), loose({}, mark, 1)})
    EXPECT_EQ(said(written, {part}),
              "a mark, or what was set aside, about (20, 0) runs along no curve that counts");
}

TEST(VerifyDrawingCheck, TheFieldDrawingsIsReadAsItIsWritten) {
  const auto complaint = [](const std::string& fields) {
    const std::string text = "{" + fields + "}";
    std::string sentence;
    (void)read_written_drawing(*parse_json(text, "r.json"), "drawings", sentence);
    return sentence;
  };
  EXPECT_EQ(complaint(R"("layers": [], "join": 0, "set_aside": [])"), "");
  EXPECT_EQ(complaint(R"("layers": ["a"], "join": 1, "set_aside": [[1, 2]], "loose_error": 0)"), "");
  EXPECT_EQ(complaint(R"("layers": [1], "join": 1, "set_aside": [])"), "drawings.layers[0] is not a text");
  for (const char* place : {"[1]", "[1, 2, 3]", "1", "[]"})
    EXPECT_EQ(complaint(R"("layers": [], "join": 1, "set_aside": [)" + std::string(place) + "]"),
              "drawings.set_aside[0] is not two numbers");
  const std::string below = "drawings: a distance below 0 is none, in join or loose_error";
  EXPECT_EQ(complaint(R"("layers": [], "join": -1, "set_aside": [])"), below);
  EXPECT_EQ(complaint(R"("layers": [], "join": 1, "set_aside": [], "loose_error": -1)"), below);
}

}  // namespace
}  // namespace lekalo::verify::verify_drawing_check_test

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/layout_texts.hpp"
#include "verify/drawn/line_match.hpp"

/// Exports are held against their layout, outline by outline.
namespace lekalo::verify::verify_exports_test {
namespace {

using cases::add_part;
using cases::Json;
using cases::outline_json;
using cases::place;
using cases::rectangle;

/// Two sheets: a D of a line and an arc, turned and mirrored, with a grain; a plate with a hole and an area.
Json sample() {
  Json layout = cases::empty_layout();
  Json& sheet = layout["stocks"][0];
  sheet["count"] = 3;
  sheet["defects"] = {{{"id", "knot"}, {"severity", 1}, {"outline", outline_json(rectangle(90, 90, 5, 5))}}};
  sheet["zones"] = {{{"id", "edge"}, {"quality", 1}, {"outline", outline_json(rectangle(0, 95, 100, 5))}}};
  Json half =
      Json::array({{{"line", {{"from", {0, -15}}, {"to", {0, 15}}}}},
                   {{"arc", {{"from", {0, 15}}, {"to", {0, -15}}, {"centre", {0, 0}}, {"ccw", true}}}}});
  Json& d = add_part(layout, "d", {{"curves", {{"outer", half}}}});
  d["mirror"] = true;
  d["grain"] = {{"deg", 30}, {"tolerance_deg", 90}};
  Json& plate = add_part(layout, "plate", outline_json(rectangle(0, 0, 30, 20), {rectangle(5, 5, 10, 10)}));
  plate["areas"] = {{{"quality", 0}, {"outline", outline_json(rectangle(20, 5, 5, 5))}}};
  place(layout, "d", 75, 30, 33.3)["mirrored"] = true;
  place(layout, "plate", 20, 60, 10);
  place(layout, "plate", 10, 10)["copy"] = 2;
  return layout;
}

struct Made {
  std::string layout;
  layout::Document document;
};
Made made_of(const Json& layout) {
  auto read = io::read_layout(layout.dump(), "layout");
  if (!read) throw std::logic_error(read.error().message);
  layout::Document document = std::move(read->document);
  std::string text = io::write_layout(document);
  return {std::move(text), std::move(document)};
}
const Made& made() {
  static const Made one = made_of(sample());
  return one;
}
std::string exported(const std::string& form, const std::vector<io::ExportWord>& words = {},
                     const Made& of = made()) {
  const auto request = io::read_export_words(*io::export_form(form), words, "--");
  if (!request) throw std::logic_error(request.error().message);
  const auto files = io::export_layout(of.document, "Sample", *request);
  if (!files) throw std::logic_error(files.error().message);
  return files->files.at(0).bytes;
}
std::string judged(const std::string& bytes, const ExportWords& words = {}, const Made& of = made()) {
  const auto report = verify_export({"e", bytes}, {"l.json", of.layout}, words);
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}
ExportWords on_sheet(const std::string& sheet, std::vector<std::string> only = {}) {
  ExportWords words;
  words.sheet = sheet, words.only = std::move(only);
  return words;
}

TEST(VerifyExports, WhatWasExportedIsTheLayout) {
  EXPECT_EQ(judged(exported("dxf")), "");
  EXPECT_EQ(judged(exported("dxf", {{"unit", "inch"}})), "");
  EXPECT_EQ(judged(exported("svg")), "");
  for (const char* form : {"dxf", "svg", "hpgl"}) {
    EXPECT_EQ(judged(exported(form, {{"sheet", "s#1"}}), on_sheet("s#1")), "") << form;
    EXPECT_EQ(judged(exported(form, {{"sheet", "s#1"}}), on_sheet("s")), "") << form;
    EXPECT_EQ(judged(exported(form, {{"sheet", "s#3"}}), on_sheet("s#3")), "") << form;
    EXPECT_NE(judged(exported(form, {{"sheet", "s#1"}}), on_sheet("s#3")), "") << form;
    EXPECT_EQ(judged(exported(form, {{"sheet", "s#1"}, {"only", "CUT"}}), on_sheet("s#1", {"CUT"})), "")
        << form;
    EXPECT_EQ(judged(exported(form, {{"sheet", "s#1"}, {"only", "MARK"}}), on_sheet("s#1", {"MARK"})), "")
        << form;
    EXPECT_NE(judged(exported(form, {{"sheet", "s#1"}, {"only", "CUT"}}), on_sheet("s#1")), "") << form;
    EXPECT_NE(judged(exported(form, {{"sheet", "s#1"}}), on_sheet("s#1", {"CUT"})), "") << form;
  }
  EXPECT_NE(judged(exported("dxf", {{"sheet", "s#1"}})), "");
  EXPECT_EQ(judged(exported("hpgl", {{"sheet", "s#1"}})),
            "e: a plot holds one sheet and 2 are in use; say which, for example --sheet s#1");
  EXPECT_EQ(judged(exported("dxf"), on_sheet("t")), "l.json: nothing lies on a sheet t, only on s#1, s#3");
  EXPECT_EQ(
      verify_export({"e", exported("dxf")}, {"l.json", cases::empty_layout().dump()}, {}).error().message,
      "l.json: nothing is placed, so nothing was exported");
}

/// An SVG with this on one layer.
std::string drawn_on(const std::string& layer, const std::string& what) {
  return R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" )"
         R"(width="200mm" height="200mm" viewBox="-100 -100 200 200" data-lekalo-corner="-100 -100"><g inkscape:groupmode="layer" inkscape:label=")" +
         layer + R"(" fill="none" stroke="#d00000" stroke-width="0.2">)" + what + "</g></svg>";
}

TEST(VerifyExports, AStripIsAsLongAsItIsUsed) {
  Json layout = cases::empty_layout();
  layout["stocks"] = {{{"id", "s"}, {"kind", "strip"}, {"height", 40}}};
  add_part(layout, "plate", outline_json(rectangle(0, 0, 30, 20)));
  const auto judged_of = [](const Json& of) {
    const Made strip = made_of(of);
    EXPECT_EQ(judged(exported("svg", {}, strip), {}, strip), "");
    // The sheet alone, drawn from 0 to a length.
    return [strip](const std::string& length) {
      const std::string path = "<path d=\"M0 0L" + length + " 0L" + length + " -40L0 -40Z\"/>";
      return judged(drawn_on("SHEET", path), on_sheet("", {"SHEET"}), strip);
    };
  };
  place(layout, "plate", -60, 10);
  EXPECT_EQ(judged_of(layout)("0.00000095367431640625"), "") << "nothing of it is used";
  place(layout, "plate", 50, 10);
  place(layout, "plate", 10, 10);
  EXPECT_EQ(judged_of(layout)("80"), "");
  EXPECT_NE(judged_of(layout)("40"), "");
  layout["stocks"][0]["length"] = 75;
  EXPECT_EQ(judged_of(layout)("75"), "");
  EXPECT_NE(judged_of(layout)("80"), "");
}

TEST(VerifyExports, SheetsLieBesideWhatSticksOut) {
  Json layout = cases::empty_layout();
  layout["stocks"][0]["count"] = 2;
  layout["stocks"][0]["defects"] = {
      {{"id", "knot"}, {"severity", 1}, {"outline", outline_json(rectangle(150, 90, 50, 5))}}};
  Json half =
      Json::array({{{"line", {{"from", {0, 15}}, {"to", {0, -15}}}}},
                   {{"arc", {{"from", {0, -15}}, {"to", {0, 15}}, {"centre", {0, 0}}, {"ccw", true}}}}});
  add_part(layout, "d", {{"curves", {{"outer", half}}}});
  // Neither the rightmost place of the one nor the leftmost of the other is at a quarter of its arc.
  place(layout, "d", 96, 30, 33.3);
  place(layout, "d", 4, 30, 180 + 33.3)["copy"] = 1;
  // The rightmost place of its circle is none of the arc's.
  Json cap =
      Json::array({{{"line", {{"from", {-30, 40}}, {"to", {30, 40}}}}},
                   {{"arc", {{"from", {30, 40}}, {"to", {-30, 40}}, {"centre", {0, 0}}, {"ccw", true}}}}});
  add_part(layout, "cap", {{"curves", {{"outer", cap}}}});
  place(layout, "cap", 75, 40);
  const Made both = made_of(layout);
  EXPECT_EQ(judged(exported("dxf", {}, both), {}, both), "");
}

TEST(VerifyExports, TheOnlyCopyHasTheNameOfItsStock) {
  Json layout = cases::empty_layout();
  add_part(layout, "plate", outline_json(rectangle(0, 0, 30, 20)));
  place(layout, "plate", 10, 10);
  const Made one = made_of(layout);
  EXPECT_EQ(judged(exported("svg", {}, one), on_sheet("s"), one), "");
  EXPECT_EQ(judged(exported("svg", {}, one), on_sheet("s#1"), one),
            "l.json: nothing lies on a sheet s#1, only on s");
}

TEST(VerifyExports, LinesMayBeOffByTheRoundingOfADrawing) {
  Json layout = cases::empty_layout();
  add_part(layout, "plate", outline_json(rectangle(0, 0, 20, 10)))["grain"] = {{"deg", 0}};
  place(layout, "plate", 0, 0);
  place(layout, "plate", -25, -5);
  const Made of = made_of(layout);
  const auto drawn = [&](const std::string& layer, const std::string& what) {
    return judged(drawn_on(layer, what), on_sheet("", {layer}), of);
  };
  const auto cut = [&](const std::string& y) {
    return drawn("CUT", "<path d=\"M0 " + y + "L20 " + y + "L20 -10L0 -10L0 0L0 " + y + "Z\"/>" +
                            R"(<path d="M-25 5L-5 5L-5 -5L-25 -5Z"/>)");
  };
  EXPECT_EQ(cut("-2e-6"), "");
  EXPECT_NE(cut("-2.1e-6"), "");
  const auto marks = [&](const std::string& second) {
    return drawn("MARK", R"(<line x1="1" y1="-1" x2="2" y2="-1"/>)" + second);
  };
  EXPECT_EQ(marks(R"(<line x1="-20" y1="0" x2="-10" y2="-4e-6"/>)"), "");
  EXPECT_EQ(marks(R"(<line x1="-20" y1="0" x2="-10" y2="-4.1e-6"/>)"),
            "the mark from (-20, -0) runs along the grain of no part\n1 marks of a grain are missing\n");
  EXPECT_NE(marks(R"(<path d="M-20 0L-10 0L-10 1Z"/>)"), "") << "a mark is one line";
}

// A knife cuts the parts alone.
TEST(VerifyExports, TheSheetBesideAKnifeIsWhereTheLayoutHasIt) {
  const std::string plot =
      exported("hpgl", {{"sheet", "s#1"}, {"process", "drag-knife"}, {"blade-offset", "0.25"}});
  ExportWords words = on_sheet("s#1");
  words.knife = KnifeWords{0.25, 0, 0.1};
  ASSERT_EQ(judged(plot, words), "");
  const std::size_t sheet = plot.find("SP4;"), to = plot.find("4000", sheet);
  ASSERT_NE(to, std::string::npos);
  EXPECT_NE(judged(std::string(plot).replace(to, 4, "4020"), words), "");
}

TEST(VerifyExports, BothEndsOfAShortArcAreNearAChord) {
  const Place begin{1, 0}, end{std::cos(0.3), std::sin(0.3)};
  const Likeness likeness{0, 1};
  const auto on = [&](Place from, Place to, const Stroke& arc) {
    const DrawnLine chord{"CUT", {line_between(from, to)}, false};
    return EdgeSet({&chord}).holds(arc, likeness);
  };
  const Stroke arc = arc_about(begin, end, {}, true), back = arc_about(end, begin, {}, false);
  const Place up{0, 1};
  for (const Stroke& either : {arc, back}) {
    EXPECT_TRUE(on({0, -0.5}, {2, -0.5}, either));
    EXPECT_FALSE(on(end + up, end + 2 * up, either)) << "the beginning is too far from it";
  }
}

/// Every place where a digit of the file can be changed by one at the third decimal, or a line left out.
std::vector<std::string> changes_of(const std::string& text, const std::string& numbers) {
  std::vector<std::string> changed;
  for (std::size_t at = 0; (at = text.find_first_of("0123456789", at)) != std::string::npos;) {
    std::size_t end = std::min(text.find_first_not_of("0123456789.", at), text.size());
    const std::string number = text.substr(at, end - at);
    if (number.find('.') != std::string::npos || numbers == "all") {
      std::string copy = text;
      std::size_t last = std::min(number.find('.') + 3, number.size() - 1);
      if (numbers == "all") last = 0;
      copy[at + last] = copy[at + last] == '9' ? '8' : static_cast<char>(copy[at + last] + 1);
      changed.push_back(std::move(copy));
    }
    at = end;
  }
  return changed;
}

TEST(VerifyExports, NoPlaceOfADrawingMayBeOther) {
  for (const std::string form : {"dxf", "svg"}) {
    const std::string text = exported(form, {{"sheet", "s#1"}, {"only", "CUT,MARK,SHEET,DEFECT,ZONE,AREA"}});
    ASSERT_EQ(judged(text, on_sheet("s#1", {"CUT", "MARK", "SHEET", "DEFECT", "ZONE", "AREA"})), "");
    std::size_t told = 0;
    for (const std::string& changed : changes_of(text, "decimals")) {
      const bool told_of_it =
          !judged(changed, on_sheet("s#1", {"CUT", "MARK", "SHEET", "DEFECT", "ZONE", "AREA"})).empty();
      told += told_of_it;
      if (told_of_it) continue;
      std::size_t at = 0;
      while (changed[at] == text[at]) ++at;
      if (form == "dxf" && at < text.find("ENTITIES")) continue;
      const std::string about = text.substr(at < 60 ? 0 : at - 60, 90);
      // Widths of lines, the version of XML, and copies of numbers for other readers are no claims.
      EXPECT_TRUE(about.find("width") != std::string::npos || about.find("version") != std::string::npos ||
                  about.find("lekalo-arcs") != std::string::npos)
          << form << ": " << about;
    }
    EXPECT_GE(told, 20U);
  }
}

// Machines tell by the colour what they do with a line.
TEST(VerifyExports, OutlinesAndMarksHaveTheColourOfTheirLayer) {
  const auto coloured = [](const std::string& form, const std::string& before, const std::string& colour) {
    std::string text = exported(form);
    const std::size_t at = text.find(before);
    if (at == std::string::npos) throw std::logic_error("test input: no " + before);
    return judged(text.insert(at + before.size(), colour));
  };
  const std::string cut = "a line on layer CUT is drawn in #0000ff and not in the colour of its layer\n",
                    mark = "a line on layer MARK is drawn in #0000ff and not in the colour of its layer\n";
  EXPECT_EQ(
      coloured("svg", "inkscape:label=\"CUT\" fill=\"none\" stroke=\"#d00000\" stroke-width=\"0.2\">\n<path",
               " stroke=\"#0000ff\""),
      cut);
  EXPECT_EQ(coloured("dxf", "AcDbEntity\n  8\nCUT\n", "420\n255\n"), cut);
  EXPECT_EQ(coloured("dxf", "AcDbEntity\n  8\nMARK\n", "420\n255\n"), mark);
}

TEST(VerifyExports, AnOutlineOnceMoreOrLessIsTold) {
  const std::string text = exported("svg", {{"sheet", "s#1"}});
  std::istringstream lines(text);
  std::size_t paths = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.find("<path") == std::string::npos && line.find("<line") == std::string::npos) continue;
    ++paths;
    const std::size_t at = text.find(line);
    EXPECT_NE(judged(text.substr(0, at) + text.substr(at + line.size()), on_sheet("s#1")), "") << line;
    EXPECT_NE(judged(text.substr(0, at) + line + "\n" + text.substr(at), on_sheet("s#1")), "") << line;
  }
  EXPECT_GE(paths, 6U);
  std::string strange = text;
  strange.replace(strange.find("inkscape:label=\"CUT\""), 20, "inkscape:label=\"CUP\"");
  EXPECT_NE(judged(strange, on_sheet("s#1")).find("something is drawn on a layer \"CUP\""),
            std::string::npos);
}

TEST(VerifyExports, AMarkRunsAlongTheGrainOfItsPart) {
  const std::string text = exported("svg", {{"sheet", "s#1"}, {"only", "MARK"}});
  const ExportWords marks = on_sheet("s#1", {"MARK"});
  ASSERT_EQ(judged(text, marks), "");
  const std::size_t at = text.find("<line"), end = text.find("/>", at) + 2;
  const auto with = [&](double x1, double y1, double x2, double y2) {
    // With fewer decimals a long line would not run along the grain.
    return judged(
        text.substr(0, at) +
            fmt::format(R"(<line x1="{:.12f}" y1="{:.12f}" x2="{:.12f}" y2="{:.12f}"/>)", x1, -y1, x2, -y2) +
            text.substr(end),
        marks);
  };
  // The D is mirrored and turned by 33.3 degrees about (75, 30): its round side shows to the other side, and
  // its grain runs at 180 - 30 + 33.3 degrees.
  const double angle = (180 - 30 + 33.3) * std::acos(-1.0) / 180, c = std::cos(angle), s = std::sin(angle);
  const double out = 33.3 * std::acos(-1.0) / 180, u = std::cos(out), v = std::sin(out);
  bool found = false;
  for (const double side : {1.0, -1.0}) {
    const double x = 75 + side * 6 * u, y = 30 + side * 6 * v;
    const std::string said = with(x, y, x + 2 * c, y + 2 * s);
    found = found || said.empty();
    if (!said.empty()) continue;
    EXPECT_NE(with(x, y, x + 2 * c + 0.001 * s, y + 2 * s - 0.001 * c), "");
    EXPECT_NE(with(x, y, x + 30 * c, y + 30 * s), "");
    EXPECT_NE(with(x + 30 * c, y + 30 * s, x, y), "");
  }
  EXPECT_TRUE(found);
}

TEST(VerifyExports, APlotMayDeviateByHalfAUnitAndItsChords) {
  const std::string text = exported("hpgl", {{"sheet", "s#1"}, {"only", "CUT,SHEET"}});
  const ExportWords words = on_sheet("s#1", {"CUT", "SHEET"});
  ASSERT_EQ(judged(text, words), "");
  std::size_t told = 0, all = 0;
  for (std::size_t at = 0; (at = text.find_first_of("0123456789", at)) != std::string::npos;) {
    const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
    std::string changed = text;
    changed.replace(at, end - at, std::to_string(std::stol(text.substr(at, end - at)) + 3));
    ++all;
    told += !judged(changed, words).empty();
    at = end;
  }
  EXPECT_GE(told * 4, all * 3) << told << " of " << all;  // a corner of chords may move along its arc
}

}  // namespace
}  // namespace lekalo::verify::verify_exports_test

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/layout_texts.hpp"

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
const Made& made() {
  static const Made one = [] {
    auto read = io::read_layout(sample().dump(), "layout");
    if (!read) throw std::logic_error(read.error().message);
    layout::Document document = std::move(read->document);
    std::string text = io::write_layout(document);
    return Made{std::move(text), std::move(document)};
  }();
  return one;
}
std::string exported(const std::string& form, const std::vector<io::ExportWord>& words = {}) {
  const auto request = io::read_export_words(*io::export_form(form), words, "--");
  if (!request) throw std::logic_error(request.error().message);
  const auto files = io::export_layout(made().document, "Sample", *request);
  if (!files) throw std::logic_error(files.error().message);
  return files->files.at(0).bytes;
}
std::string judged(const std::string& bytes, const ExportWords& words = {}) {
  const auto report = verify_export({"e", bytes}, {"l.json", made().layout}, words);
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
                  about.find("lekalo-arcs") != std::string::npos || about.find("43\n") != std::string::npos)
          << form << ": " << about;
    }
    EXPECT_GE(told, 20U);
  }
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
    return judged(text.substr(0, at) + "<line x1=\"" + std::to_string(x1) + "\" y1=\"" + std::to_string(-y1) +
                      "\" x2=\"" + std::to_string(x2) + "\" y2=\"" + std::to_string(-y2) + "\"/>" +
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
    EXPECT_NE(with(x - 30 * c, y - 30 * s, x, y), "");
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

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/marked_layouts.hpp"
#include "verify/drawn/placed_inside.hpp"

/// Exports of parts with lines and texts, changed one place at a time: what the checker finds and what it
/// lets pass beside it.
namespace lekalo::verify::verify_marked_exports_test {
namespace {

using cases::Json;

Json sample() {
  Json layout = cases::empty_layout();
  cases::add_marked_plate(layout, "plate");
  cases::place(layout, "plate", 80, 70, 90)["mirrored"] = true;
  return layout;
}
Json with_layer(const std::string& layer) {
  Json layout = sample();
  layout["parts"][0]["marks"][0]["layer"] = layer;
  return layout;
}

std::string exported(const Json& layout, const std::string& form,
                     const std::vector<io::ExportWord>& words = {}) {
  const auto document = io::read_layout(layout.dump(), "layout");
  if (!document) throw std::logic_error(document.error().message);
  const auto request = io::read_export_words(*io::export_form(form), words, "--");
  if (!request) throw std::logic_error(request.error().message);
  auto made = io::export_layout(document->document, "Sample", *request);
  if (!made) throw std::logic_error(made.error().message);
  return made->files[0].bytes;
}

std::string judged(const std::string& bytes, const Json& layout, std::vector<std::string> only = {}) {
  ExportWords words;
  words.only = std::move(only);
  const auto report = verify_export({"e", bytes}, {"l.json", layout.dump()}, words);
  if (!report) return report.error().message;
  std::string text;
  for (const std::string& finding : report->findings) text += finding + "\n";
  return text;
}
bool tells(const std::string& text, const std::string& what) { return text.find(what) != std::string::npos; }

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) throw std::logic_error("test input: no " + what);
  return text.replace(at, what.size(), by);
}

/// The export with groups added to its first text, which stands left, unturned and as wide as usual.
std::string with_groups(const std::string& groups) {
  const std::string look = "AcDbEntity\n  8\nTXT\n";
  return replaced(exported(sample(), "dxf"), look, look + groups);
}

TEST(VerifyMarkedExports, NamesOfLayersAreThoseOfExports) {
  for (const char* form : {"dxf", "svg", "hpgl"})
    for (const std::string& layer :
         {std::string("az"), std::string("AZ"), std::string("`{@["), std::string("cut"), std::string("zone"),
          std::string("Area"), std::string(), std::string(" a "), std::string(255, 'n'),
          std::string(256, 'n')})
      EXPECT_EQ(judged(exported(with_layer(layer), form), with_layer(layer)), "") << form << layer;
  for (const auto& [one, other] : {std::pair("az", "AZ"), std::pair("za", "ZA")})
    EXPECT_EQ(judged(exported(with_layer(one), "svg"), with_layer(other)), "");
  EXPECT_NE(judged(exported(with_layer("a"), "svg"), with_layer("b")), "");
  EXPECT_NE(judged(exported(with_layer("{"), "svg"), with_layer("[")), "");
}

TEST(VerifyMarkedExports, LettersThatTheFontLacksAreRectanglesInPlots) {
  Json layout = sample();
  layout["parts"][0]["texts"][0]["text"] = "中";
  for (const char* form : {"dxf", "svg", "hpgl"})
    EXPECT_EQ(judged(exported(layout, form), layout), "") << form;
  EXPECT_NE(judged(exported(layout, "hpgl"), sample()), "");
}

// Such a letter is 16 twenty-firsts of a capital wide.
TEST(VerifyMarkedExports, LettersBehindOneThatTheFontLacksStandBehindARectangle) {
  Json layout = sample();
  layout["parts"][0]["texts"][0]["text"] = "中A";
  EXPECT_EQ(judged(exported(layout, "hpgl"), layout), "");
}

TEST(VerifyMarkedExports, ArcsOfMarksTurnAsTheyAreWritten) {
  Json layout = sample();
  layout["parts"][0]["marks"][0]["edges"][1] = cases::arc_json(15, 5, 15, 15, 15, 10, false);
  for (const char* form : {"dxf", "svg", "hpgl"}) {
    EXPECT_EQ(judged(exported(layout, form), layout), "") << form;
    EXPECT_NE(judged(exported(layout, form), sample()), "") << form;
  }
}

TEST(VerifyMarkedExports, TextsAreEngravedIfTheyAreToBeAndTheFontHasTheirLetters) {
  const auto is_engraved = [](const char* role, const char* letters) {
    WrittenPart part;
    part.texts.emplace_back();
    part.texts[0].text = letters, part.texts[0].role = role, part.texts[0].height = 3;
    return placed_inside(part, WrittenPiece{}).at(0).is_engraved;
  };
  EXPECT_TRUE(is_engraved("mark", "A") && is_engraved("engrave", "Ж"));
  EXPECT_FALSE(is_engraved("bend", "A") || is_engraved("mark", "A中"));
}

TEST(VerifyMarkedExports, EachFieldOfATextIsCompared) {
  for (const char* form : {"dxf", "svg"}) {
    const std::string bytes = exported(sample(), form);
    for (const auto& [field, value] : {std::pair<const char*, Json>("text", "b"),
                                       {"height", 3.00001},
                                       {"deg", 350.001},
                                       {"anchor", "right"},
                                       {"width_factor", 0.80001},
                                       {"colour", "#008001"},
                                       {"layer", "TXU"},
                                       {"mirrored", true},
                                       {"at", {40.00001, 34}}}) {
      Json other = sample();
      other["parts"][0]["texts"][1][field] = value;
      EXPECT_TRUE(tells(judged(bytes, other), "is on no part")) << form << field;
      EXPECT_TRUE(tells(judged(bytes, other), "of a part is not drawn")) << form << field;
    }
    Json near = sample();
    near["parts"][0]["texts"][1]["height"] = 3.000001;
    EXPECT_EQ(judged(bytes, near), "") << form;
  }
}

TEST(VerifyMarkedExports, TextsOfADxfAreReadAsTheyAreWritten) {
  for (const char* groups : {" 72\n     3\n", " 72\n     1\n", " 73\n     1\n", " 11\n1.0\n", " 21\n1.0\n",
                             " 41\n0.0\n", " 41\n-1.0\n"})
    EXPECT_TRUE(tells(judged(with_groups(groups), sample()), "a text that lekalo does not write so"))
        << groups;
  for (const char* groups : {" 72\n     0\n", " 73\n     0\n", " 41\n1.0\n"})
    EXPECT_EQ(judged(with_groups(groups), sample()), "") << groups;
  const std::string dxf = exported(sample(), "dxf");
  EXPECT_TRUE(tells(judged(replaced(dxf, "\n 71\n     2\n", "\n 71\n     1\n"), sample()),
                    "a text that lekalo does not write so"));
  for (const char* colour : {"x", "1x", "16777216", "-1", "99999999999"})
    EXPECT_TRUE(
        tells(judged(with_groups("420\n" + std::string(colour) + "\n"), sample()), "a colour that is none"))
        << colour;
  EXPECT_FALSE(tells(judged(with_groups("420\n16777215\n"), sample()), "a colour that is none"));
}

TEST(VerifyMarkedExports, BrokenTextsOfAnSvgAreRefused) {
  const std::string svg = exported(sample(), "svg");
  const auto after = [&](const std::string& what, const std::string& by) {
    return judged(replaced(svg, what, by), sample());
  };
  EXPECT_TRUE(tells(after("transform=\"matrix(", "transform=\"matriz("), "a text without its place"));
  EXPECT_TRUE(tells(after(" text-anchor=\"start\"", ""), "does not write so"));
  EXPECT_TRUE(
      tells(judged(svg.substr(0, svg.find("transform=")) + svg.substr(svg.find("font-family=")), sample()),
            "a text without its place"));
  EXPECT_TRUE(tells(after(")\" font-family", "\" font-family"), "a text without its place"));
  const std::size_t size = svg.find("font-size=\"", svg.find("transform="));
  EXPECT_TRUE(
      tells(judged(std::string(svg).replace(size, svg.find(" text-anchor", size) - size, "font-size=\"0\""),
                   sample()),
            "does not write so"));
  EXPECT_TRUE(tells(after("transform=\"matrix(", "transform=\"matrix(x"), "a transformation that cannot"));
  EXPECT_TRUE(tells(after("transform=\"matrix(", "transform=\"matrix(1 "), "a transformation that cannot"));
  EXPECT_TRUE(tells(after("text-anchor=\"start\"", "text-anchor=\"begin\""), "does not write so"));
}

TEST(VerifyMarkedExports, TextsHaveTheirOwnColourOrAreBlack) {
  const std::string svg = exported(sample(), "svg");
  for (const auto& [own, other] : {std::pair("#000000", "#0000ff"), std::pair("#008000", "#000000")}) {
    const std::size_t at = svg.rfind("fill=\"" + std::string(own) + "\" stroke=\"none\"");
    EXPECT_TRUE(tells(judged(std::string(svg).replace(at + 6, 7, other), sample()), "is on no part")) << own;
  }
}

TEST(VerifyMarkedExports, LinesAndTextsAreAskedForAsMarks) {
  for (const char* form : {"dxf", "svg", "hpgl"})
    for (const char* layer : {"MARK", "CUT"}) {
      const std::string bytes = exported(sample(), form, {{"only", layer}});
      EXPECT_EQ(judged(bytes, sample(), {layer}), "") << form << layer;
      EXPECT_NE(judged(bytes, sample()), "") << form << layer;
    }
}

TEST(VerifyMarkedExports, TheReportSaysHowManyLinesAndTextsWereCompared) {
  const auto notes_of = [](const Json& layout) {
    const auto report = verify_export({"e", exported(layout, "svg")}, {"l.json", layout.dump()}, {});
    std::string notes;
    if (report)
      for (const std::string& note : report->notes) notes += note + "\n";
    return notes;
  };
  EXPECT_TRUE(tells(notes_of(sample()), "4 lines and 3 texts on parts were compared both ways"));
  Json bare = sample();
  bare["parts"][0].erase("marks"), bare["parts"][0].erase("texts");
  EXPECT_FALSE(tells(notes_of(bare), "on parts were compared"));
}

TEST(VerifyMarkedExports, AMarkThatIsPlottedWithThePenOfCutsIsRefused) {
  Json layout = sample();
  layout["parts"][0].erase("texts");
  const std::string plot = exported(layout, "hpgl");
  ASSERT_EQ(judged(plot, layout), "");
  EXPECT_NE(judged(replaced(plot, "SP2;", "SP1;"), layout), "");
  layout["parts"][0]["grain"] = {{"deg", 30}, {"tolerance_deg", 90}};
  EXPECT_EQ(judged(exported(layout, "hpgl"), layout), "") << "a mark of the grain beside marks of the part";
}

TEST(VerifyMarkedExports, ASlantedTextIsRefused) {
  const std::string svg = exported(sample(), "svg");
  const std::size_t at = svg.find("transform=\"matrix("), end = svg.find(')', at);
  std::istringstream words(svg.substr(at + 18, end - at - 18));
  double m[6];
  for (double& number : m) words >> number;
  const auto with = [&](double slant) {
    return judged(std::string(svg).replace(at, end - at,
                                           fmt::format("transform=\"matrix({} {} {} {} {} {}", m[0], m[1],
                                                       m[2] + slant * m[0], m[3] + slant * m[1], m[4], m[5])),
                  sample());
  };
  EXPECT_EQ(with(0), "");
  EXPECT_TRUE(tells(with(0.2), "is on no part"));
}

TEST(VerifyMarkedExports, ColoursOfLayoutsAreOfSixDigits) {
  const std::string svg = exported(sample(), "svg");
  for (const char* colour : {"#ff00000", "#ff000", "0ff0000", "#ff000g"}) {
    Json layout = sample();
    layout["parts"][0]["marks"][0]["colour"] = colour;
    EXPECT_TRUE(tells(judged(svg, layout), "is no colour as in #0000ff")) << colour;
  }
}

}  // namespace
}  // namespace lekalo::verify::verify_marked_exports_test

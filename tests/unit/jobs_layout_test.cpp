#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/io/layout/layout_json.hpp"
#include "lekalo/io/text/sha256.hpp"
#include "lekalo/jobs/check.hpp"
#include "lekalo/jobs/edit.hpp"
#include "lekalo/jobs/export.hpp"
#include "lekalo/jobs/layout.hpp"
#include "lekalo/jobs/show.hpp"
#include "support/json.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::jobs::jobs_layout_test {
namespace {

using cases::Json;

/// Squares of 10 at (20, 40) and (60, 40) on a sheet of 100, as a file.
Layout two_squares() { return open_layout({"squares.json", io::write_layout(cases::two_squares())}).value(); }

TEST(JobsLayout, IsOpenedWithItsNameDigestAndOwnBytes) {
  const std::string bytes = io::write_layout(cases::two_squares()) + "\n\n";
  const auto layout = open_layout({"squares.json", bytes});
  ASSERT_TRUE(layout) << layout.error().message;
  EXPECT_EQ(layout->name, "squares.json");
  EXPECT_EQ(layout->inputs.at(0).sha256, io::sha256(bytes));
  EXPECT_EQ(layout->document, cases::two_squares());
  EXPECT_EQ(layout_bytes(*layout), bytes);
  EXPECT_FALSE(layout->form);
}

TEST(JobsLayout, AJobOfAnotherProgramBecomesALayout) {
  const auto strip =
      open_layout({"jobs/strip.json", R"({"name": "s", "strip_height": 100, "items": [{"id": 0, "demand": 1,
        "allowed_orientations": [0], "shape": {"type": "simple_polygon",
        "data": [[0, 0], [10, 0], [10, 10], [0, 10], [0, 0]]}}]})"});
  ASSERT_TRUE(strip) << strip.error().message;
  EXPECT_EQ(strip->form, io::NestingForm::strip);
  EXPECT_EQ(strip->instance_name, "strip.json");
  EXPECT_TRUE(strip->bytes.empty());
  EXPECT_EQ(layout_bytes(*strip), io::write_layout(strip->document));
}

TEST(JobsLayout, AFileThatIsNoneIsRefusedByName) {
  const auto layout = open_layout({"letter.txt", "Dear all"});
  ASSERT_FALSE(layout);
  EXPECT_EQ(layout.error().code, ErrorCode::bad_input);
  EXPECT_EQ(layout.error().message.rfind("letter.txt", 0), 0u) << layout.error().message;
}

TEST(JobsCheck, SaysWhatBothChecksFind) {
  Layout layout = two_squares();
  const Checked fine = check(layout).value();
  EXPECT_TRUE(fine.valid());
  const Json said = Json::parse(check_json(layout, fine));
  EXPECT_EQ(said["status"], "valid");
  EXPECT_EQ(said["checked_by"], Json({"engine", "verify"}));
  EXPECT_EQ(said["inputs"][0]["path"], "squares.json");

  layout::Document broken = layout.document;
  broken.placements[1].at = broken.placements[0].at;
  Layout overlapping;
  overlapping.document = broken;
  const Checked found = check(overlapping).value();
  EXPECT_TRUE(found.agree());
  EXPECT_FALSE(found.valid());
  ASSERT_EQ(found.violations.size(), 1u);
  EXPECT_EQ(found.violations[0].kind, layout::ViolationKind::overlap);
  EXPECT_EQ(Json::parse(check_json(overlapping, found))["status"], "violations");
}

TEST(JobsCheck, TellsWhereTheTwoDoNotAgree) {
  // The checker reads the bytes and the engine the document: here they are of two layouts.
  Layout layout = two_squares();
  layout.document.placements[1].at = layout.document.placements[0].at;
  const Checked found = check(layout).value();
  EXPECT_FALSE(found.agree());
  EXPECT_FALSE(found.valid());
  EXPECT_EQ(found.disagreements,
            std::vector<std::string>{"only the engine finds overlap: placement 1 and 2 on 'sheet' #1"});
  EXPECT_EQ(Json::parse(check_json(layout, found))["status"], "refuted");
}

TEST(JobsEdit, CarriesOutALogOrNothing) {
  const auto edited = edit(cases::two_squares(), {"log", "lekalo-commands/1\nmove 1 by 5 0\n"});
  ASSERT_TRUE(edited) << edited.error().message;
  EXPECT_EQ(edited->document.placements[0].at.x, geom::grid_from_mm(25));
  EXPECT_EQ(edited->bytes, io::write_layout(edited->document));
  EXPECT_TRUE(edited->violations.empty());

  const auto refused = edit(cases::two_squares(), {"log", "lekalo-commands/1\nmove 1 by 40 0\n"});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::refuted);
  EXPECT_EQ(refused.error().message.rfind("log, line 2", 0), 0u) << refused.error().message;

  const auto free = edit(cases::two_squares(), {"log", "lekalo-commands/1\nmode free\nmove 1 by 40 0\n"});
  ASSERT_TRUE(free) << free.error().message;
  EXPECT_EQ(free->violations.size(), 1u);
}

TEST(JobsEdit, NamesTheKitsThatLoseParts) {
  layout::Document document = cases::two_squares();
  document.parts.push_back(document.parts[0]);
  document.parts[1].id = "lid";
  document.kits = {{"set", "", 1, 1, {{0, 1, std::nullopt}, {1, 1, std::nullopt}}},
                   {"lids", "", 1, 1, {{1, 2, std::nullopt}}}};
  const auto edited = edit(document, {"log", "lekalo-commands/1\nremove-part lid\n"});
  ASSERT_TRUE(edited) << edited.error().message;
  EXPECT_EQ(edited->notices,
            (std::vector<std::string>{"kit 'set' is made without the parts that were removed",
                                      "kit 'lids' is gone with the last of its parts"}));
  EXPECT_TRUE(edit(document, {"log", "lekalo-commands/1\nmove 1 by 5 0\n"})->notices.empty());
}

TEST(JobsShow, CountsAndDraws) {
  const Layout layout = two_squares();
  const Shown shown = show(layout.document);
  EXPECT_EQ(shown.completeness.placed[0].total(), 2);
  EXPECT_EQ(Json::parse(show_json(layout, shown))["violations"], 0);
  EXPECT_EQ(picture_form("a.pdf"), PictureForm::pdf);
  EXPECT_FALSE(picture_form("a.jpg"));
  const auto begins = [&](PictureForm form, const char* with) {
    return layout_picture(layout.document, "two", shown.violations, form)->find(with) < 100;
  };
  EXPECT_TRUE(begins(PictureForm::svg, "<svg"));
  EXPECT_TRUE(begins(PictureForm::png, "PNG"));
  EXPECT_TRUE(begins(PictureForm::pdf, "%PDF"));
}

TEST(JobsExport, GivesEveryForm) {
  const Layout layout = two_squares();
  EXPECT_EQ(export_layout(layout, {})->files.front().bytes, layout.bytes);
  ExportOptions machine;
  machine.form = LayoutForm::machine;
  EXPECT_NE(export_layout(layout, machine)->files.front().bytes.find("CUT"), std::string::npos);
  ExportOptions placements;
  placements.form = LayoutForm::placements;
  const auto none = export_layout(layout, placements);
  ASSERT_FALSE(none) << "there is no strip";
  EXPECT_EQ(none.error().message.rfind("squares.json: ", 0), 0u) << none.error().message;
}

TEST(JobsExport, ReadsTheWordsOfLabels) {
  const auto roll = read_label_words({{"label-size", "2.4x1.1in"}, {"label-remnant", "1m"}}, "--").value();
  EXPECT_DOUBLE_EQ(roll.paper.label_width(), 2.4 * 25.4);
  EXPECT_DOUBLE_EQ(roll.paper.label_height(), 1.1 * 25.4);
  EXPECT_DOUBLE_EQ(roll.least_remnant_mm, 1000);
  const auto sheet =
      read_label_words({{"label-sheet", "A4:3x8"}, {"label-margin", "7x13"}, {"label-gap", "2.5x0"}}, "--")
          .value();
  EXPECT_EQ(sheet.paper.columns, 3);
  EXPECT_EQ(sheet.paper.rows, 8);
  EXPECT_NEAR(sheet.paper.label_width(), (210 - 14 - 5) / 3.0, 1e-9);
  EXPECT_NEAR(sheet.paper.label_height(), (297 - 26) / 8.0, 1e-9);
  EXPECT_DOUBLE_EQ(read_label_words({{"label-sheet", "letter:2x5"}}, "")->paper.page_width, 215.9);
  EXPECT_DOUBLE_EQ(read_label_words({{"label-sheet", "100x150mm:1x4"}}, "")->paper.label_height(), 37.5);
  const auto none = read_label_words({}, "").value();
  EXPECT_DOUBLE_EQ(none.paper.label_width(), 62);
  EXPECT_DOUBLE_EQ(none.paper.label_height(), 29);
}

TEST(JobsExport, RefusesWrongWordsOfLabelsInOneSentence) {
  const std::vector<std::pair<std::vector<io::ExportWord>, std::string>> wrong{
      {{{"label-size", "62"}}, "--label-size 62: has to be width and height"},
      {{{"label-size", "0x29"}}, "--label-size 0x29: has to be"},
      {{{"label-size", "62xnan"}}, "--label-size 62xnan: has to be"},
      {{{"label-size", "62x1001"}}, "up to 1000 mm"},
      {{{"label-size", "-62x29"}}, "--label-size -62x29: has to be"},
      {{{"label-sheet", "A4"}}, "--label-sheet A4: has to be A4, A5, letter"},
      {{{"label-sheet", "A9:3x8"}}, "--label-sheet A9:3x8: has to be"},
      {{{"label-sheet", "A4:0x8"}}, "--label-sheet A4:0x8: has to be"},
      {{{"label-sheet", "A4:3x101"}}, "up to 100"},
      {{{"label-sheet", "A4:3x8x2"}}, "--label-sheet A4:3x8x2: has to be"},
      {{{"label-sheet", "A4:3"}}, "as in A4:3x8"},
      {{{"label-sheet", ":3x8"}}, "--label-sheet :3x8: has to be"},
      {{{"label-margin", "7"}}, "--label-margin has a meaning for sheets of labels alone: --label-sheet"},
      {{{"label-gap", "2"}, {"label-size", "62x29"}}, "--label-gap has a meaning for sheets"},
      {{{"label-sheet", "A4:3x8"}, {"label-margin", "-1"}}, "--label-margin -1: has to be one length from 0"},
      {{{"label-sheet", "A4:3x8"}, {"label-gap", "2x"}}, "--label-gap 2x: has to be"},
      {{{"label-sheet", "A4:3x8"}, {"label-margin", "105x0"}},
       "leave no room for 3 x 8 labels on paper of 210 x"},
      {{{"label-sheet", "A4:3x8"}, {"label-size", "62x29"}}, "leave one out"},
      {{{"label-remnant", "-5"}}, "--label-remnant -5: has to be a length"},
      {{{"label-remnant", "all"}}, "--label-remnant all: has to be a length"},
      {{{"kerf", "1"}}, "--kerf has no meaning for the form labels"}};
  for (const auto& [words, says] : wrong) {
    const auto read = read_label_words(words, "--");
    ASSERT_FALSE(read) << says;
    EXPECT_EQ(read.error().code, ErrorCode::usage);
    EXPECT_NE(read.error().message.find(says), std::string::npos) << read.error().message;
  }
}

}  // namespace
}  // namespace lekalo::jobs::jobs_layout_test

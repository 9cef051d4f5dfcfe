#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "draw/label/label_plan.hpp"
#include "draw/label/qr_code.hpp"
#include "draw/paper/report_sheet.hpp"
#include "lekalo/base/joined_text.hpp"
#include "lekalo/base/random.hpp"
#include "lekalo/draw/label/layout_labels.hpp"
#include "lekalo/io/text/words.hpp"
#include "support/cases.hpp"
#include "support/layout_cases.hpp"

/// What is printed, and that it can be read again, is tested in tests/oracle/labels.py.
namespace lekalo::draw::draw_labels_test {
namespace {

constexpr int kModules = 21;

/// As `Rect::contains`, but for rounding.
bool holds(const Rect& outer, const Rect& inner) { return outer.grown(1e-6).contains(inner); }
bool apart(const Rect& a, const Rect& b) { return !a.overlaps(b.grown(-1e-6)); }

/// The height of the number and lines of this size.
double height_of(const LabelLines& lines) {
  return lines.letters * (kNumberLetters + kLabelLine * static_cast<double>(lines.lines.size()));
}

TEST(LabelPlan, KeepsEverythingApartOnEveryLabelThatIsNotTooSmall) {
  Random random(cases::seed(), 1);
  int with_picture = 0;
  for (int i = 0; i < 20'000; ++i) {
    const bool tall = random.below(2) == 0;
    const std::size_t fields = 2 + random.below(4);
    const int modules = kModules + 4 * static_cast<int>(random.below(2));
    const LeastLabel least = least_label(tall, modules, fields);
    const bool small = random.below(3) == 0;
    double width = least.width + (small ? 0 : random.uniform(0, 100)),
           height = least.height + (small ? 0 : random.uniform(0, 100));
    (tall ? height : width) = std::max(width, height);
    if (is_tall(width, height) != tall) continue;  // as wide as it is high
    const Rect whole{random.uniform(0, 200), random.uniform(0, 200), width, height};
    const LabelPlan plan = label_plan(whole, modules, fields);
    ASSERT_TRUE(holds(whole, plan.code) && holds(whole.grown(-1.5), plan.text)) << width << " x " << height;
    ASSERT_TRUE(apart(plan.code, plan.text));
    ASSERT_GE(plan.code.width, kLeastModule * (modules + 8) - 1e-6);
    ASSERT_LE(plan.code.width, modules + 8 + 1e-6);
    ASSERT_GE(plan.text.width, 16.5 - 1e-6);
    ASSERT_GE(plan.text.height,
              kLeastLetters * (kNumberLetters + kLabelLine * static_cast<double>(fields)) - 1e-6);
    if (plan.picture.width == 0) continue;
    ++with_picture;
    ASSERT_TRUE(holds(whole, plan.picture) && apart(plan.picture, plan.code) &&
                apart(plan.picture, plan.text));
    ASSERT_GE(std::min(plan.picture.width, plan.picture.height), 4 - 1e-6);
  }
  EXPECT_GT(with_picture, 5'000);
}

TEST(LabelPlan, OrdinaryLabelsHaveAPicture) {
  for (const auto& [width, height] : std::vector<std::pair<double, double>>{
           {62, 29}, {90, 29}, {54, 17}, {100, 50}, {100, 150}, {40, 30}, {70, 37}, {38.1, 21.2}, {29, 90}})
    EXPECT_GT(label_plan({0, 0, width, height}, kModules, 3).picture.width, 0) << width << " x " << height;
}

TEST(LabelLines, FieldsThatFitAreWholeAndLarge) {
  const Rect text{0, 0, 40, 26};
  const LabelLines few = label_lines({"Side", "400 x 300 mm", "shelf"}, text);
  ASSERT_EQ(few.lines.size(), 3U);
  EXPECT_EQ(few.lines[0].words, "Side");
  EXPECT_TRUE(few.lines[0].bold);
  EXPECT_FALSE(few.lines[1].bold);
  EXPECT_DOUBLE_EQ(few.letters, 4);
  // Words stay whole, in smaller letters.
  const LabelLines whole = label_lines({"Schubladenvorderseite links oben", "9 x 9 mm"}, text);
  EXPECT_EQ(whole.lines[0].words.substr(0, 21), "Schubladenvorderseite");
  EXPECT_LT(whole.letters, 4);
  std::string all;
  for (std::size_t i = 0; i + 1 < whole.lines.size(); ++i) all += (i == 0 ? "" : " ") + whole.lines[i].words;
  EXPECT_EQ(all, "Schubladenvorderseite links oben");
}

TEST(LabelLines, WhatDoesNotFitIsShortenedInTheMiddleOfItsLastLine) {
  const std::string name = "Боковина шкафа для верхней одежды, левая, с отверстиями под полки, вариант 17";
  const Rect text{0, 0, 16, 12};
  const LabelLines lines = label_lines({name, "400 x 300 mm", "order"}, text);
  EXPECT_DOUBLE_EQ(lines.letters, kLeastLetters);
  ASSERT_EQ(lines.lines.size(), 3U);
  EXPECT_NE(lines.lines[0].words.find("…"), std::string::npos);
  EXPECT_TRUE(lines.lines[0].words.ends_with("17")) << lines.lines[0].words;
  EXPECT_EQ(lines.lines[1].words, "400 x 300 mm");
  EXPECT_EQ(lines.lines[2].words, "order");
  // A line more goes to the name, which begins and ends as it does.
  const LabelLines more = label_lines({name, "400 x 300 mm", "order"}, {0, 0, 16, 15});
  ASSERT_EQ(more.lines.size(), 4U);
  EXPECT_EQ(more.lines[0].words, "Боковина");
  EXPECT_TRUE(more.lines[1].words.starts_with("шк")) << more.lines[1].words;
  EXPECT_TRUE(more.lines[1].words.ends_with("17")) << more.lines[1].words;
}

TEST(LabelLines, NeverLeaveTheirPlace) {
  Random random(cases::seed(), 2);
  const std::vector<std::string> letters{"a", "W", "щ", "Ж", " ", " ", "1", "i", "葉", "-"};
  for (int i = 0; i < 3'000; ++i) {
    std::vector<std::string> fields;
    for (std::size_t k = 0; k < 2 + random.below(3); ++k) {
      std::string& field = fields.emplace_back("x");
      for (std::size_t c = random.below(80); c > 0; --c) field += letters[random.below(letters.size())];
    }
    const double least = kLeastLetters * (kNumberLetters + kLabelLine * static_cast<double>(fields.size()));
    const Rect text{0, 0, random.uniform(12, 60), least + random.uniform(0, 30)};
    const LabelLines lines = label_lines(fields, text);
    ASSERT_LE(height_of(lines), text.height + 1e-6) << joined_text(fields, "|");
    ASSERT_GE(lines.lines.size(), fields.size());
    ASSERT_GE(lines.letters, kLeastLetters);
    for (const LabelLines::Line& line : lines.lines)
      ASSERT_LE(
          io::text_width(line.words) * kSmallerLetters * lines.letters * (line.bold ? kReportBoldWider : 1),
          text.width + 1e-6)
          << line.words;
  }
}

/// Squares of 10 at (20, 40) and (60, 40) on a sheet of 100, and the code of a file.
struct Squares {
  layout::Document document = cases::two_squares();
  layout::Completeness completeness = layout::completeness(document);

  [[nodiscard]] Result<std::string> print(const LabelPaper& paper) const {
    return labels_pdf({"squares", document, completeness, "LK/0123456789", 100}, paper);
  }
};

#ifdef LEKALO_WITH_QR

TEST(QrCode, HasItsPatternsAndTheLeastVersion) {
  const QrCode code = qr_code("LK/3F9A0C71D2/12").value();
  EXPECT_EQ(code.version, 1);
  ASSERT_EQ(code.modules, 21);
  ASSERT_EQ(code.dark.size(), 441U);
  // Three corners have a dark frame, a light one in it, and a dark heart.
  for (const auto& [row, column] : {std::pair(0, 0), std::pair(0, 14), std::pair(14, 0)})
    for (int i = 0; i < 7; ++i) {
      EXPECT_TRUE(code.at(row, column + i) && code.at(row + i, column));
      EXPECT_EQ(code.at(row + 1, column + i), i == 0 || i == 6);
      EXPECT_EQ(code.at(row + 3, column + i), i != 1 && i != 5);
    }
  for (int i = 8; i < 13; ++i) EXPECT_EQ(code.at(6, i), i % 2 == 0);
  EXPECT_EQ(qr_code("LK/3F9A0C71D2/12")->dark, code.dark);
  EXPECT_NE(qr_code("LK/3F9A0C71D2/13")->dark, code.dark);
  EXPECT_EQ(qr_code("LK/3F9A0C71D2/12", 2)->version, 2);
  EXPECT_EQ(qr_code("LK/3F9A0C71D2/999999")->version, 1);
  EXPECT_EQ(qr_code("LK/3F9A0C71D2/9007199254740991")->version, 2);
}

TEST(LayoutLabels, AreTheSameTwiceOnRollsAndSheets) {
  const Squares squares;
  const LabelPaper sheet{210, 297, 3, 8, 7, 13, 2.5, 0};
  EXPECT_NEAR(sheet.label_width(), 63.6667, 1e-4);
  EXPECT_NEAR(sheet.label_height(), 33.875, 1e-9);
  for (const LabelPaper& paper : {LabelPaper{}, sheet}) {
    const auto first = squares.print(paper);
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_EQ(first->rfind("%PDF-", 0), 0U);
    EXPECT_EQ(*first, squares.print(paper).value());
  }
}

TEST(LayoutLabels, RefuseLabelsThatAreTooSmallAndNameTheLeastSize) {
  const Squares squares;
  const auto says = [&](const LabelPaper& paper) {
    const auto made = squares.print(paper);
    EXPECT_EQ(made ? ErrorCode::refuted : made.error().code, ErrorCode::usage);
    return made ? std::string() : made.error().message;
  };
  EXPECT_EQ(
      says({20, 10}),
      "labels of 20 x 10 mm are too small: 4 lines of text and a QR code of 21 modules of 0.4 mm and its "
      "light margin need 29.6 x 14.1 mm");
  EXPECT_TRUE(squares.print({29.6, 14.1}));
  EXPECT_FALSE(squares.print({29.5, 14.1}));
  EXPECT_FALSE(squares.print({29.6, 14}));
  EXPECT_NE(says({10, 40}).find("need 19.5 x 24.2 mm"), std::string::npos) << says({10, 40});
  EXPECT_TRUE(squares.print({19.5, 24.2}));
  EXPECT_FALSE(squares.print({19.4, 24.2}));
  EXPECT_FALSE(squares.print({19.5, 24.1}));
  EXPECT_NE(says({210, 297, 20, 20}).find(", of which the paper takes 10 x 12"), std::string::npos)
      << says({210, 297, 20, 20});
  EXPECT_TRUE(squares.print({210, 297, 10, 12}));
  EXPECT_EQ(says({12, 12, 2, 2}).find("of which"), std::string::npos) << says({12, 12, 2, 2});
}

TEST(LayoutLabels, NothingPlacedIsSaidSo) {
  Squares squares;
  squares.document.placements.clear();
  squares.completeness = layout::completeness(squares.document);
  const auto made = squares.print({});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::bad_input);
  EXPECT_NE(made.error().message.find("nothing is placed"), std::string::npos);
}

#else

TEST(LayoutLabels, WithoutQrCodesThereIsOneSentence) {
  const auto made = Squares().print({});
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::environment);
  EXPECT_NE(made.error().message.find("libqrencode-dev"), std::string::npos);
}

#endif

}  // namespace
}  // namespace lekalo::draw::draw_labels_test

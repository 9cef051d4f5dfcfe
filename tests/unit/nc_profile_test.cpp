#include "lekalo/nc/profile.hpp"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>

#include "lekalo/geom/trig.hpp"
#include "support/profile_parts.hpp"

namespace lekalo::nc::nc_profile_test {
namespace {

using cases::box_contour;
using cases::circle_contour;
using cases::region_of_contours;

ProfileOptions plain() {
  ProfileOptions options;
  options.kerf_mm = 1, options.feed_mm_per_min = 600, options.tolerance_mm = 0.01;
  return options;
}
ProfilePart square(std::uint64_t id, double x, double y, double side = 10) {
  return {id, region_of_contours(box_contour(x, y, side, side))};
}

TEST(NcProfile, ASquareWithAHoleIsTheseLines) {
  ProfileOptions options = plain();
  options.lead_in_mm = 2, options.speed = 80;
  const auto made = profile_program(
      {{4, region_of_contours(box_contour(10, 10, 30, 20), {circle_contour({20, 20}, 3.5, true)})}},
      "Plate, 'ä'", options);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->text,
            "(PLATE)\n"
            "(KERF 1.0000 COMPENSATED IN THE PATH NO G41 G42)\n"
            "G21 G17 G90\n"
            "G40 G49 G80 G54 G94 G91.1 G61\n"
            "(PLACEMENT 4 HOLE 1)\n"
            "G0 X19.0000 Y20.0000\n"
            "M3 S80\n"
            "G1 X17.0000 Y20.0000 F600.0\n"
            "G3 X23.0000 Y20.0000 I3.0000 J0.0000\n"
            "G3 X17.0000 Y20.0000 I-3.0000 J0.0000\n"
            "M5\n"
            "(PLACEMENT 4 OUTLINE)\n"
            "G0 X7.5000 Y10.0000\n"
            "M3 S80\n"
            "G1 X9.5000 Y10.0000 F600.0\n"
            "G1 X9.5000 Y20.0000\n"
            "G1 X9.5000 Y30.0000\n"
            "G2 X10.0000 Y30.5000 I0.5000 J0.0000\n"
            "G1 X25.0000 Y30.5000\n"
            "G1 X40.0000 Y30.5000\n"
            "G2 X40.5000 Y30.0000 I0.0000 J-0.5000\n"
            "G1 X40.5000 Y20.0000\n"
            "G1 X40.5000 Y10.0000\n"
            "G2 X40.0000 Y9.5000 I-0.5000 J0.0000\n"
            "G1 X25.0000 Y9.5000\n"
            "G1 X10.0000 Y9.5000\n"
            "G2 X9.5000 Y10.0000 I0.0000 J0.5000\n"
            "M5\n"
            "M5\n"
            "G0 X0.0000 Y0.0000\n"
            "M2\n")
      << made->text;
}

struct Wrong {
  const char* what;
  void (*change)(ProfileOptions&);
  const char* says;
};

TEST(NcProfile, OptionsOutOfRangeAreRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  const auto refused = [](const ProfileOptions& options) {
    const auto made = profile_program({square(1, 0, 0)}, "x", options);
    EXPECT_FALSE(made);
    EXPECT_TRUE(made || made.error().code == ErrorCode::usage);
    return made ? std::string() : made.error().message;
  };
  for (const double bad : {nan, infinite, -1.0, 0.0, 101.0}) {
    ProfileOptions options = plain();
    options.kerf_mm = bad;
    EXPECT_NE(refused(options).find("kerf"), std::string::npos) << bad;
  }
  const Wrong wrongs[] = {
      {"feed", [](ProfileOptions& o) { o.feed_mm_per_min = 0; }, "feed"},
      {"lead", [](ProfileOptions& o) { o.lead_in_mm = -1; }, "lead-in"},
      {"tolerance", [](ProfileOptions& o) { o.tolerance_mm = 0.3; }, "tolerance"},
      {"pierce", [](ProfileOptions& o) { o.pierce_s = 1000; }, "pierce"},
      {"router without speed",
       [](ProfileOptions& o) { o.process = Process::router, o.depth_mm = 1, o.plunge_mm_per_min = 1; },
       "spindle"},
      {"router without depth",
       [](ProfileOptions& o) { o.process = Process::router, o.speed = 100, o.plunge_mm_per_min = 1; },
       "depth"},
      {"a million passes",
       [](ProfileOptions& o) {
         o.process = Process::router, o.speed = 100, o.plunge_mm_per_min = 1, o.depth_mm = 1000,
         o.pass_mm = 0.01;
       },
       "pass"},
      {"dark beam", [](ProfileOptions& o) { o.post = *post_named("grbl"); }, "beam stays dark"},
  };
  for (const Wrong& wrong : wrongs) {
    ProfileOptions options = plain();
    wrong.change(options);
    EXPECT_NE(refused(options).find(wrong.says), std::string::npos) << wrong.what;
  }
}

TEST(NcProfile, WhatTheKerfCannotCutIsRefusedByName) {
  struct Case {
    std::vector<ProfilePart> parts;
    const char* says;
  };
  const geom::Contour keyhole = cases::ring_contour({{0, 0},
                                                     {30, 0},
                                                     {30, 9.6},
                                                     {10, 9.6},
                                                     {10, 5},
                                                     {5, 5},
                                                     {5, 15},
                                                     {10, 15},
                                                     {10, 10.4},
                                                     {30, 10.4},
                                                     {30, 20},
                                                     {0, 20}});
  const geom::Contour dumbbell = cases::ring_contour({{5, 5},
                                                      {8, 5},
                                                      {8, 9.7},
                                                      {12, 9.7},
                                                      {12, 5},
                                                      {15, 5},
                                                      {15, 15},
                                                      {12, 15},
                                                      {12, 10.3},
                                                      {8, 10.3},
                                                      {8, 15},
                                                      {5, 15}});
  const Case cases_of_trouble[] = {
      {{}, "there is no part to cut"},
      {{{9, region_of_contours(box_contour(0, 0, 10, 10), {circle_contour({5, 5}, 0.45, true)})}},
       "placement 9: hole 1 is narrower than the kerf of 1 mm"},
      {{{9, region_of_contours(keyhole)}}, "placement 9: the mouth of a notch is narrower"},
      {{{9, region_of_contours(box_contour(0, 0, 20, 20), {dumbbell})}},
       "placement 9: a neck of hole 1 is narrower"},
      {{square(2, 0, 0), square(5, 10.5, 0)}, "placements 2 and 5 are too near for the kerf of 1 mm"},
      {{square(2, 0, 0), square(5, 5, 5)}, "placements 2 and 5 are too near"},        // overlapping
      {{square(2, 0, 0, 30), square(5, 10, 10)}, "placements 2 and 5 are too near"},  // one inside the other
  };
  for (const Case& one : cases_of_trouble) {
    const auto made = profile_program(one.parts, "x", plain());
    ASSERT_FALSE(made) << one.says;
    EXPECT_EQ(made.error().code, ErrorCode::bad_input);
    EXPECT_NE(made.error().message.find(one.says), std::string::npos) << made.error().message;
  }
}

TEST(NcProfile, ANarrowSlotStaysAndIsReported) {
  // 0.6 wide, open at the top: the kerf of 1 passes by. The slot's end is 8 from the cut below the part.
  const auto made = profile_program(
      {{1, region_of_contours(cases::ring_contour(
               {{0, 0}, {20, 0}, {20, 20}, {10.3, 20}, {10.3, 8}, {9.7, 8}, {9.7, 20}, {0, 20}}))}},
      "x", plain());
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_NEAR(made->left_over_mm, 8, 1e-3);
  EXPECT_EQ(made->left_over_of, 1U);
}

TEST(NcProfile, LeadsAreShortenedAndLeftOutWhereThereIsNoRoom) {
  ProfileOptions options = plain();
  options.lead_in_mm = 4;
  const auto lead = [&](double hole_radius) {
    const auto made = profile_program(
        {{1, region_of_contours(box_contour(0, 0, 50, 50), {circle_contour({25, 25}, hole_radius, true)})}},
        "x", options);
    EXPECT_TRUE(made) << made.error().message;
    return made ? std::pair(made->shortened_leads, made->bare_starts) : std::pair<std::size_t, std::size_t>();
  };
  EXPECT_EQ(lead(10), std::pair(0UL, 0UL));
  EXPECT_EQ(lead(2.2), std::pair(1UL, 0UL));  // 2 mm of lead in a path of radius 1.7
  EXPECT_EQ(lead(0.55), std::pair(0UL, 1UL));
}

TEST(NcProfile, ThePostsWriteTheirOwnWords) {
  ProfileOptions options = plain();
  options.speed = 700, options.pierce_s = 0.5;
  const auto text = [&] {
    const auto made = profile_program({square(1, 5, 5)}, "x", options);
    EXPECT_TRUE(made) << made.error().message;
    return made ? made->text : std::string();
  };
  const auto has = [](const std::string& all, const char* part) {
    return all.find(part) != std::string::npos;
  };
  options.post = *post_named("grbl");
  EXPECT_TRUE(has(text(), "M4 S700\nG4 P0.500\n"));
  EXPECT_FALSE(has(text(), "G80"));
  options.process = Process::plasma;
  EXPECT_TRUE(has(text(), "M3 S700\n"));
  options.post = *post_named("fanuc");
  EXPECT_EQ(text().rfind("%\nO0001 (X)\n", 0), 0U);
  EXPECT_TRUE(has(text(), "G4 P500\n"));
  EXPECT_TRUE(has(text(), "X4.500"));
  EXPECT_FALSE(has(text(), "X4.5000"));
  EXPECT_TRUE(text().ends_with("M30\n%\n"));
  options.unit = LengthUnit::inch;
  EXPECT_TRUE(has(text(), "G20 G17 G90"));
  EXPECT_TRUE(has(text(), "F23.62"));
  options.pierce_s = 0, options.process = Process::router, options.post = *post_named("linuxcnc"),
  options.unit = LengthUnit::millimetre;
  options.depth_mm = 5, options.pass_mm = 2, options.plunge_mm_per_min = 90;
  EXPECT_TRUE(has(text(), "G0 Z5.0000\nM3 S700\n"));
  for (const char* down : {"G1 Z-2.0000 F90.0\n", "G1 Z-4.0000 F90.0\n", "G1 Z-5.0000 F90.0\n"})
    EXPECT_TRUE(has(text(), down));
  EXPECT_FALSE(has(text(), "Z-6"));
}

/// The first feed behind the comment of a hole, and whether a lead comes before its path: it then has one
/// motion more.
std::string feed_of_hole(const std::string& text, std::size_t hole) {
  const std::size_t cut = text.find(fmt::format("(PLACEMENT 1 HOLE {})", hole));
  const std::size_t feed = text.find(" F", cut);
  return text.substr(feed + 1, text.find('\n', feed) - feed - 1);
}

TEST(NcProfile, HolesUpToADiameterHaveLeadsAndFeedsOfTheirOwn) {
  ProfileOptions options = plain();
  options.lead_in_mm = 2;
  // Diameters of 3, 5, 4 * 80 / 84 and 20 mm: four times the area over the length.
  const std::vector<ProfilePart> parts{
      {1, region_of_contours(box_contour(0, 0, 80, 80),
                             {circle_contour({10, 10}, 1.5, true), box_contour(20, 5, 5, 5),
                              box_contour(10, 30, 40, 2), circle_contour({60, 60}, 10, true)})}};
  const auto without = profile_program(parts, "x", options);
  ASSERT_TRUE(without) << without.error().message;
  EXPECT_TRUE(without->cuts_by_hole.empty());
  options.holes = {{3, 0.5, 0.4}, {5, std::nullopt, 0.65}};
  const auto made = profile_program(parts, "x", options);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->cuts_by_hole, (std::vector<std::size_t>{1, 2}));
  EXPECT_NE(made->text.find("NO G41 G42)\n(HOLES UP TO 3.0000 LEAD 0.5000 F240.0)\n"
                            "(HOLES UP TO 5.0000 LEAD 2.0000 F390.0)\nG21"),
            std::string::npos)
      << made->text;
  EXPECT_EQ(feed_of_hole(made->text, 1), "F240.0");
  EXPECT_EQ(feed_of_hole(made->text, 2), "F390.0");
  EXPECT_EQ(feed_of_hole(made->text, 3), "F390.0");
  EXPECT_EQ(feed_of_hole(made->text, 4), "F600.0");
  // The path of the first hole begins 1 mm right of its middle, and the lead half a millimetre before that.
  EXPECT_NE(made->text.find("(PLACEMENT 1 HOLE 1)\nG0 X10.5000 Y10.0000\n"), std::string::npos) << made->text;
  // Larger holes are cut as without the rules.
  options.holes = {{2.9, 0.5, 0.4}};
  const auto larger = profile_program(parts, "x", options);
  ASSERT_TRUE(larger) << larger.error().message;
  std::string text = larger->text;
  const std::size_t begin = text.find("(HOLES");
  text.erase(begin, text.find('\n', begin) + 1 - begin);
  EXPECT_EQ(text, without->text);
}

TEST(NcProfile, CornersAreCutAtAFeedOfTheirOwn) {
  ProfileOptions options = plain();
  options.corners = {0.5, 2};
  // An outline has its corners in arcs of half the kerf, a hole has them sharp; a round hole has none.
  const std::vector<ProfilePart> parts{
      {1, region_of_contours(box_contour(10, 10, 30, 20),
                             {box_contour(15, 15, 8, 8), circle_contour({32, 20}, 4, true)})}};
  const auto made = profile_program(parts, "x", options);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_NE(made->text.find("NO G41 G42)\n(CORNERS F300.0 UP TO 2.0000 FROM EACH)\n"), std::string::npos);
  EXPECT_NE(made->text.find("G2 X9.5000 Y10.0000 I0.0000 J0.5000 F300.0\n"
                            "G1 X9.5000 Y12.0000\n"
                            "G1 X9.5000 Y28.0000 F600.0\n"
                            "G1 X9.5000 Y30.0000 F300.0\n"
                            "G2 X10.0000 Y30.5000 I0.5000 J0.0000\n"
                            "G1 X12.0000 Y30.5000\n"
                            "G1 X38.0000 Y30.5000 F600.0\n"),
            std::string::npos)
      << made->text;
  EXPECT_NE(made->text.find("G1 X15.5000 Y15.5000 F300.0\n"
                            "G1 X17.5000 Y15.5000\n"
                            "G1 X20.5000 Y15.5000 F600.0\n"
                            "G1 X22.5000 Y15.5000 F300.0\n"),
            std::string::npos)
      << made->text;
  EXPECT_EQ(feed_of_hole(made->text, 2), "F600.0");
  // Where corners are nearer to each other than that, all between them is slow.
  options.corners = {0.5, 4};
  const auto all_slow = profile_program(parts, "x", options);
  ASSERT_TRUE(all_slow) << all_slow.error().message;
  EXPECT_NE(all_slow->text.find("G1 X22.5000 Y22.5000 F300.0\nG1 X15.5000 Y22.5000\n"), std::string::npos)
      << all_slow->text;
  const auto refused = [&](double share, double distance) {
    options.corners = {share, distance};
    const auto wrong = profile_program(parts, "x", options);
    return wrong ? std::string() : wrong.error().message;
  };
  EXPECT_NE(refused(1.5, 2).find("share of the feed at corners is 1.5"), std::string::npos);
  EXPECT_NE(refused(0.001, 2).find("share of the feed at corners is 0.001"), std::string::npos);
  EXPECT_NE(refused(0.5, 0).find("distance from corners in mm is 0"), std::string::npos);
  EXPECT_NE(refused(0.5, 1001).find("distance from corners in mm is 1001"), std::string::npos);
  options.feed_mm_per_min = 0.15;
  EXPECT_NE(refused(0.5, 2).find("feed in mm/min at corners is 0.075"), std::string::npos);
  EXPECT_EQ(refused(1, 0), "");
}

TEST(NcProfile, LeadsToCornersThatPointInwardsDoNotCutAnEdgeTwice) {
  ProfileOptions options = plain();
  options.lead_in_mm = 1;
  // The path of the hole is 3 by 3 mm: too short to be halved, so that cuts may begin at its corners alone.
  const auto made = profile_program(
      {{1, region_of_contours(box_contour(0, 0, 20, 20), {box_contour(8, 8, 4, 4)})}}, "x", options);
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(made->bare_starts, 1U);
  options.kerf_mm = 0.5;
  const auto wider = profile_program(
      {{1, region_of_contours(box_contour(0, 0, 20, 20), {box_contour(8, 8, 4, 4)})}}, "x", options);
  ASSERT_TRUE(wider) << wider.error().message;
  EXPECT_EQ(wider->bare_starts, 0U) << "from the middle of an edge";
}

TEST(NcProfile, ATurnedHoleIsCutByTheSameRule) {
  ProfileOptions options = plain();
  options.holes = {{7, 0.0, 0.5}};
  for (int k = 0; k < 60; ++k) {
    const auto [sine, cosine] = geom::sincos(0.11 * k);
    const geom::Point along{7 * cosine, 7 * sine}, across{-7 * sine, 7 * cosine}, at{40.1, 37.3};
    const auto made = profile_program(
        {{1, region_of_contours(box_contour(0, 0, 80, 80),
                                {cases::ring_contour({at, at + along, at + along + across, at + across})})}},
        "x", options);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_EQ(made->cuts_by_hole, std::vector<std::size_t>{1}) << k;
  }
}

TEST(NcProfile, RulesOfHolesOutOfRangeAreRefusedByName) {
  struct Case {
    std::vector<HoleCut> holes;
    const char* says;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case wrong[] = {{{{0, 1.0, 1}}, "the diameter up to which"},
                        {{{nan, 1.0, 1}}, "the diameter up to which"},
                        {{{3, -1.0, 1}}, "lead-in in mm of holes up to 3 mm is -1"},
                        {{{3, 1.0, 1.5}}, "share of the feed of holes up to 3 mm is 1.5"},
                        {{{3, 1.0, nan}}, "share of the feed"},
                        {{{3, 1.0, 0.001}}, "share of the feed"},
                        {{{5, 1.0, 1}, {5, 1.0, 1}}, "ascending order"}};
  for (const Case& one : wrong) {
    ProfileOptions options = plain();
    options.holes = one.holes;
    const auto made = profile_program({square(1, 0, 0)}, "x", options);
    ASSERT_FALSE(made) << one.says;
    EXPECT_EQ(made.error().code, ErrorCode::usage);
    EXPECT_NE(made.error().message.find(one.says), std::string::npos) << made.error().message;
  }
  ProfileOptions slow = plain();
  slow.feed_mm_per_min = 1, slow.holes = {{3, 1.0, 0.05}};
  const auto made = profile_program({square(1, 0, 0)}, "x", slow);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("feed in mm/min of holes up to 3 mm is 0.05"), std::string::npos);
}

// ---- common lines -----------------------------------------------------------------------------------------

ProfileOptions sharing() {
  ProfileOptions options = plain();
  options.common_line = true, options.lead_in_mm = 3;
  return options;
}
/// The words behind the modes, without their feed.
std::string cuts_of(const std::vector<ProfilePart>& parts, const ProfileOptions& options) {
  const auto made = profile_program(parts, "x", options);
  if (!made) return made.error().message;
  const std::size_t begin = made->text.find("(COMMON");
  return begin == std::string::npos ? made->text : made->text.substr(begin);
}

TEST(NcCommonLine, TwoSquaresAreALineAndAnOutline) {
  EXPECT_EQ(cuts_of({square(1, 10, 10), square(2, 21, 10)}, sharing()),
            "(COMMON LINE OF PLACEMENTS 1 2)\n"
            "G0 X20.5000 Y6.5000\n"
            "M3\n"
            "G1 X20.5000 Y9.5000 F600.0\n"
            "G1 X20.5000 Y20.5000\n"
            "M5\n"
            "(COMMON OUTLINE OF PLACEMENTS 1 2)\n"
            "G0 X31.0000 Y23.5000\n"
            "M3\n"
            "G1 X31.0000 Y20.5000 F600.0\n"
            "G2 X31.5000 Y20.0000 I0.0000 J-0.5000\n"
            "G1 X31.5000 Y15.0000\n"
            "G1 X31.5000 Y10.0000\n"
            "G2 X31.0000 Y9.5000 I-0.5000 J0.0000\n"
            "G1 X25.5000 Y9.5000\n"
            "G1 X20.0000 Y9.5000\n"
            "G1 X15.0000 Y9.5000\n"
            "G1 X10.0000 Y9.5000\n"
            "G2 X9.5000 Y10.0000 I0.0000 J0.5000\n"
            "G1 X9.5000 Y15.0000\n"
            "G1 X9.5000 Y20.0000\n"
            "G2 X10.0000 Y20.5000 I0.5000 J0.0000\n"
            "G1 X20.5000 Y20.5000\n"
            "G1 X31.0000 Y20.5000\n"
            "M5\n"
            "M5\n"
            "G0 X0.0000 Y0.0000\n"
            "M2\n");
}

TEST(NcCommonLine, AGridIsItsLinesAndOneOutline) {
  std::vector<ProfilePart> parts;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 4; ++j) parts.push_back(square(parts.size() + 1, 10 + 11 * i, 10 + 11 * j));
  const auto shared = profile_program(parts, "x", sharing());
  ASSERT_TRUE(shared) << shared.error().message;
  EXPECT_EQ(shared->common_lines, 7U);
  EXPECT_EQ(shared->cuts, 8U);
  EXPECT_NEAR(shared->shared_mm, 10 * (4 * 4 + 5 * 3), 1e-9);
  EXPECT_LE(shared->common_off_mm, 1e-9);
  ProfileOptions options = sharing();
  options.common_line = false;
  const auto apart = profile_program(parts, "x", options);
  ASSERT_TRUE(apart);
  EXPECT_EQ(apart->cuts, 20U);
  EXPECT_NEAR(apart->shared_mm, shared->shared_mm, 1e-9) << "it is told without being asked";
  EXPECT_LT(shared->cut_mm, 0.7 * apart->cut_mm);
}

TEST(NcCommonLine, OnlyWhatIsOneKerfApartIsShared) {
  const auto lines = [](double apart, double along = 0) {
    const auto made = profile_program({square(1, 10, 10), square(2, 20 + apart, 10 + along)}, "x", sharing());
    return made ? static_cast<int>(made->common_lines) : -1;
  };
  EXPECT_EQ(lines(1), 1);
  EXPECT_EQ(lines(1.009), 1) << "within the tolerance";
  EXPECT_EQ(lines(0.991), 1);
  EXPECT_EQ(lines(1.012), 0);
  EXPECT_EQ(lines(0.988), -1) << "the kerf would enter a part";
  EXPECT_EQ(lines(3), 0);
  EXPECT_EQ(lines(1, 8.9), 1);
  EXPECT_EQ(lines(1, 9.1), 0) << "a stretch shorter than a kerf is cut twice";
}

TEST(NcCommonLine, WhatIsHeldByNeighboursAloneIsCutBeforeTheyAre) {
  // A ring of bars around a place that they leave empty, in which a square lies by itself.
  std::vector<ProfilePart> parts{square(1, 10, 10),
                                 {2, region_of_contours(box_contour(21, 10, 21, 10))},
                                 square(3, 43, 10),
                                 {4, region_of_contours(box_contour(10, 21, 10, 21))},
                                 {5, region_of_contours(box_contour(43, 21, 10, 21))},
                                 square(6, 10, 43),
                                 {7, region_of_contours(box_contour(21, 43, 21, 10))},
                                 square(8, 43, 43),
                                 square(9, 27, 27)};
  const std::string program = cuts_of(parts, sharing());
  const std::size_t lone = profile_program(parts, "x", sharing())->text.find("(PLACEMENT 9 OUTLINE)"),
                    pocket = profile_program(parts, "x", sharing())->text.find("(COMMON POCKET"),
                    outline = profile_program(parts, "x", sharing())->text.find("(COMMON OUTLINE");
  ASSERT_NE(pocket, std::string::npos) << program;
  EXPECT_LT(lone, pocket);
  EXPECT_LT(pocket, outline);
}

TEST(NcCommonLine, JointsHeatAndArcsForLeadsAreRefused) {
  ProfileOptions options = sharing();
  options.joints.rule = JointRule::count, options.joints.count = 1, options.joints.width_mm = 0.5;
  EXPECT_NE(cuts_of({square(1, 10, 10)}, options).find("common lines and joints do not go together"),
            std::string::npos);
  options = sharing();
  options.lead = LeadShape::arc;
  EXPECT_NE(cuts_of({square(1, 10, 10)}, options).find("take lines for leads"), std::string::npos);
  options = sharing();
  options.heat_spread_mm = 10;
  EXPECT_NE(
      cuts_of({square(1, 10, 10)}, options).find("common lines and a spread of heat do not go together"),
      std::string::npos);
}

TEST(NcCommonLine, ARouterLiftsBetweenThePassesOfALine) {
  ProfileOptions options = sharing();
  options.process = Process::router, options.depth_mm = 4, options.pass_mm = 2;
  options.speed = 9000, options.plunge_mm_per_min = 100;
  const std::string program = cuts_of({square(1, 10, 10), square(2, 21, 10)}, options);
  EXPECT_NE(program.find("G1 X20.5000 Y20.5000\nG0 Z5.0000\nG0 X20.5000 Y9.5000\nG1 Z-4.0000"),
            std::string::npos)
      << program;
}

}  // namespace
}  // namespace lekalo::nc::nc_profile_test

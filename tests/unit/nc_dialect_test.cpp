#include "lekalo/nc/dialect.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <vector>

#include "lekalo/io/layout/layout_export.hpp"
#include "lekalo/mill/program.hpp"
#include "lekalo/nc/profile.hpp"
#include "lekalo/nc/rewrite.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/places.hpp"
#include "support/profile_parts.hpp"
#include "verify/pocket/nc_moves.hpp"
#include "verify/profile/profile_moves.hpp"

// A post is a value. Both writers of programs take one that nobody registered, and whatever lists the posts
// lists those of the library.

namespace lekalo::nc::nc_dialect_test {
namespace {

/// A control that nobody has, unlike the others in everything in which posts may differ.
Dialect strange() {
  return {.name = "strange",
          .control = "Strange 9",
          .decimals = {.millimetre = 5, .inch = 6},
          .comment = {.open = "; ", .close = "", .longest = 12},
          .dwell = {.units_per_second = 10, .decimals = 1},
          .tape_mark = "%",
          .program_number = "O4711",
          .pocket = {.modes = "G17 {unit} G90\nG94 {offset}", .end = "G4 P1.0\nM2"},
          .profile = {.modes = "G54\n{unit} G17 G90 G94", .end = "M30"},
          .tool_change = "T{tool}\nM6",
          .laser_on = "M8 M4",
          .laser_needs_power = true};
}

mill::PocketPath short_path() {
  using Kind = mill::PathMove::Kind;
  mill::PocketPath path;
  path.moves = {{Kind::rapid, {0, 0}, 5},
                {Kind::plunge, {0, 0}, -1},
                {Kind::cut, {10, 0}, -1},
                {Kind::cut, {10, 20}, -1, geom::EdgeKind::arc_ccw, {10, 10}},
                {Kind::rapid, {10, 20}, 5}};
  return path;
}

mill::ProgramOptions pocket_options(const Dialect& post) {
  mill::ProgramOptions options;
  options.post = post, options.work_offset = 3, options.tool_number = 12, options.spindle = 9000;
  options.comments = {"From plate 7, left"};
  return options;
}

ProfileOptions profile_options(const Dialect& post) {
  ProfileOptions options;
  options.post = post, options.kerf_mm = 1, options.feed_mm_per_min = 600, options.speed = 80;
  options.pierce_s = 0.25;
  return options;
}

std::vector<ProfilePart> square() {
  return {{1, cases::region_of_contours(cases::box_contour(5, 5, 10, 10))}};
}

/// The text of the file of this name, wherever it stands in a folder of the checkout.
std::string text_of(const std::string& folder, const std::string& name) {
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(cases::source_dir() + "/" + folder)) {
    if (entry.path().filename() != name) continue;
    std::ifstream file(entry.path());
    return {std::istreambuf_iterator<char>(file), {}};
  }
  return {};
}

/// The words between quotes or bars.
std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words;
  const std::regex word("[a-z0-9]+");
  for (auto found = std::sregex_iterator(list.begin(), list.end(), word); found != std::sregex_iterator();
       ++found)
    words.push_back(found->str());
  return words;
}

std::vector<std::string> names_of_posts() {
  std::vector<std::string> names;
  for (const Dialect& post : posts()) names.emplace_back(post.name);
  return names;
}

TEST(NcDialect, APocketIsWrittenInADialectOfOnesOwn) {
  std::vector<std::size_t> move_of_line;
  const std::string text = program_of(short_path(), pocket_options(strange()), &move_of_line);
  EXPECT_EQ(text,
            "%\n"
            "O4711\n"
            "; FROM PLATE 7\n"
            "G17 G21 G90\n"
            "G94 G56\n"
            "T12\n"
            "M6\n"
            "S9000 M3\n"
            "G0 Z5.00000\n"
            "G0 X0.00000 Y0.00000\n"
            "G1 Z-1.00000 F300.0\n"
            "G1 X10.00000 F1500.0\n"
            "G3 X10.00000 Y20.00000 I0.00000 J10.00000\n"
            "G0 Z5.00000\n"
            "M5\n"
            "G4 P1.0\n"
            "M2\n"
            "%\n");
  constexpr std::size_t none = mill::kNoMove;
  EXPECT_EQ(move_of_line, (std::vector<std::size_t>{none, none, none, none, none, none, none, none, 0, 0, 1,
                                                    2, 3, 4, none, none, none, none}));

  const auto moves = verify::read_moves({"p.nc", text}, 0);
  ASSERT_TRUE(moves) << moves.error().message;
  ASSERT_EQ(moves->size(), 4U);
  EXPECT_TRUE((*moves)[2].arc && (*moves)[2].ccw);
  EXPECT_EQ((*moves)[2].to.x, 10);
  EXPECT_EQ((*moves)[2].to.y, 20);
  EXPECT_EQ((*moves)[2].centre.y, 10);
}

TEST(NcDialect, AnEmptyTextIsNoLine) {
  Dialect post = strange();
  post.tool_change = "", post.pocket.end = "";
  const std::string text = program_of(short_path(), pocket_options(post));
  EXPECT_EQ(text.find("\n\n"), std::string::npos) << text;
  EXPECT_NE(text.find("G94 G56\nS9000 M3\n"), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with("M5\n%\n")) << text;
}

TEST(NcDialect, AProfileIsCutInADialectOfOnesOwn) {
  const auto made = profile_program(square(), "Plate", profile_options(strange()));
  ASSERT_TRUE(made) << made.error().message;
  const std::string& text = made->text;
  EXPECT_TRUE(
      text.starts_with("%\n"
                       "O4711 ; PLATE\n"
                       "; KERF 1.00000\n"
                       "G54\n"
                       "G21 G17 G90 G94\n"
                       "; PLACEMENT 1\n"
                       "G0 X5.00000 Y4.50000\n"
                       "M8 M4 S80\n"
                       "G4 P2.5\n"
                       "G2 X4.50000 Y5.00000 I0.00000 J0.50000 F600.0\n"
                       "G1 X4.50000 Y15.00000\n"
                       "G2 X5.00000 Y15.50000 I0.50000 J0.00000\n"))
      << text;
  EXPECT_TRUE(text.ends_with("M5\nG0 X0.00000 Y0.00000\nM30\n%\n")) << text;

  // The reader of programs understands every word, and not moved at all the program keeps every byte.
  const auto rewritten = rewrite_program(text, "p.nc", 0, 0, 0, {});
  ASSERT_TRUE(rewritten) << rewritten.error().message;
  EXPECT_EQ(rewritten->program, text);
}

TEST(NcDialect, ALaserThatNeedsPowerIsRefusedWithoutByTheNameOfItsControl) {
  ProfileOptions options = profile_options(strange());
  options.speed = 0;
  const auto made = profile_program(square(), "x", options);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("a Strange 9 laser needs the power"), std::string::npos)
      << made.error().message;
}

/// What a pocket and a cut do not say of their motions, as the checker sees it.
std::vector<std::string> left_to_control(const std::string& pocket, const std::string& profile,
                                         words::Control language) {
  verify::SimulateOptions machining;
  machining.tool_diameter = 1, machining.control = language;
  const std::string plate = R"({"outer": [{"line": {"from": [-40, -40], "to": [40, -40]}},
      {"line": {"from": [40, -40], "to": [0, 40]}}, {"line": {"from": [0, 40], "to": [-40, -40]}}]})";
  const auto judged = verify::verify_pocket_program({"p.nc", pocket}, {"plate.json", plate}, machining, {});
  const auto read = verify::read_profile({"c.nc", profile}, language);
  if (!judged || !read) return {judged ? read.error().message : judged.error().message};
  std::vector<std::string> left = judged->unchecked;
  left.insert(left.end(), read->unsaid.sentences().begin(), read->unsaid.sentences().end());
  return left;
}

TEST(NcDialect, EveryPostHasANameOfItsOwnAndFillsEveryPlace) {
  std::set<std::string_view> names;
  for (const Dialect& post : posts()) {
    SCOPED_TRACE(post.name);
    EXPECT_TRUE(names.insert(post.name).second);
    EXPECT_FALSE(post.name.empty() || post.control.empty());
    EXPECT_TRUE(std::ranges::all_of(post.name,
                                    [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }));
    EXPECT_EQ(post_named(post.name), &post);
    const std::string pocket = program_of(short_path(), pocket_options(post));
    const auto profile = profile_program(square(), "x", profile_options(post));
    ASSERT_TRUE(profile) << profile.error().message;
    for (const std::string& text : {pocket, profile->text}) {
      EXPECT_EQ(text.find_first_of("{}"), std::string::npos) << text;
      EXPECT_NE(text.find("G21"), std::string::npos);
    }
    EXPECT_NE(pocket.find("G56"), std::string::npos);
    EXPECT_TRUE(verify::read_moves({"p.nc", pocket}, 0));
    EXPECT_TRUE(rewrite_program(profile->text, "p.nc", 0, 0, 0, {}));
    EXPECT_EQ(left_to_control(pocket, profile->text, post.language), std::vector<std::string>());
  }
  EXPECT_EQ(post_named("heidenhain"), nullptr);
}

TEST(NcDialect, TheOptionsOfExportListThePosts) {
  const auto& words = io::export_words();
  const auto post = std::ranges::find(words, "post", &io::ExportWordHelp::name);
  ASSERT_NE(post, words.end());
  EXPECT_EQ(words_of(post->type), names_of_posts());
}

TEST(NcDialect, ThePageOffersThePosts) {
  const std::string page = text_of("web/src", "export_choices.ts");
  std::smatch list;
  ASSERT_TRUE(std::regex_search(page, list, std::regex(R"(name:\s*['"]post['"],\s*of:\s*\[([^\]]*)\])")));
  EXPECT_EQ(words_of(list[1]), names_of_posts());
}

TEST(NcDialect, TheDocsNamePostsThatThereAre) {
  const std::string docs = text_of("docs", "cli.md");
  const std::regex option(R"(--post ([a-z0-9|]+))");
  std::size_t named = 0;
  for (auto found = std::sregex_iterator(docs.begin(), docs.end(), option); found != std::sregex_iterator();
       ++found)
    for (const std::string& name : words_of((*found)[1])) {
      EXPECT_NE(post_named(name), nullptr) << name;
      ++named;
    }
  EXPECT_GT(named, 0U);
}

}  // namespace
}  // namespace lekalo::nc::nc_dialect_test

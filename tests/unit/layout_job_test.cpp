#include "lekalo/layout/job.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "lekalo/layout/check.hpp"
#include "lekalo/layout/session.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::layout::layout_job_test {
namespace {

using cases::box_loop;
using cases::grid_point;
using cases::outline_of;

constexpr std::int64_t mm = geom::kGridPerMm;

Part part(const char* id, double width, double height) {
  Part made;
  made.id = id;
  made.demand = 2;
  made.outline = outline_of({box_loop(0, 0, width, height)});
  return made;
}

void place(Document& d, std::uint32_t part, std::uint32_t stock, std::int64_t copy, double x, double y) {
  Placement placement;
  placement.id = d.next_id++;
  placement.part = part;
  placement.stock = stock;
  placement.copy = copy;
  placement.at = grid_point(x, y);
  d.placements.push_back(placement);
}

/// Three parts on two stocks; the bar is in a kit. Placements 1 square, 2 bar, 3 lid, 4 lid, the last on copy
/// 1 of `board`.
Document job() {
  Document d;
  d.parts = {part("square", 10, 10), part("bar", 20, 5), part("lid", 8, 8)};
  for (const char* id : {"scrap", "board"}) {
    Stock stock = sheet_of(100 * mm, 100 * mm, 2);
    stock.id = id;
    d.stocks.push_back(stock);
  }
  d.stocks[1].defects = {{"knot", 1, outline_of({box_loop(90, 90, 95, 95)})}};
  d.kits = {{"box", "", 1, 1, {{1, 2, std::nullopt}}}};
  place(d, 0, 0, 0, 10, 10);
  place(d, 1, 1, 0, 10, 10);
  place(d, 2, 1, 0, 50, 50);
  place(d, 2, 1, 1, 50, 50);
  return d;
}

/// Carries a line out; the fault, or "". What is undone afterwards is as it was, and what is done again as it
/// became.
std::string carry_out(Session& session, const std::string& line) {
  const auto command = command_from_text(line, session.document());
  if (!command) return "unreadable: " + command.error().message;
  const Document before = session.document();
  const auto change = session.apply(*command);
  if (!change) {
    EXPECT_TRUE(session.document() == before);
    return change.error().message;
  }
  if (change->is_nothing()) return "nothing";
  const Document after = session.document();
  Document alone = before;
  layout::carry_out(alone, *change);
  EXPECT_TRUE(alone == after) << line;
  layout::carry_out(alone, reversed(*change, before.next_id));
  EXPECT_TRUE(alone == before) << line;
  session.undo();
  EXPECT_TRUE(session.document() == before) << line;
  session.redo();
  EXPECT_TRUE(session.document() == after) << line;
  return "";
}

std::vector<std::uint64_t> ids(const Document& d) {
  std::vector<std::uint64_t> all;
  for (const Placement& one : d.placements) all.push_back(one.id);
  return all;
}

TEST(LayoutJob, EachCommandDoesWhatItSays) {
  Session session(job());
  const auto& d = session.document();
  EXPECT_EQ(carry_out(session, "quantity square 6"), "");
  EXPECT_EQ(d.parts[0].demand, 6);
  EXPECT_EQ(carry_out(session, "rotations lid 0,170..190"), "");
  EXPECT_EQ(d.parts[2].rotations, (std::vector<AngleRange>{{0, 0}, {170, 190}}));
  EXPECT_EQ(carry_out(session, "rotations lid any"), "");
  EXPECT_TRUE(d.parts[2].rotations.empty());
  EXPECT_EQ(carry_out(session, "mirror bar yes"), "");
  EXPECT_TRUE(d.parts[1].may_mirror);
  EXPECT_EQ(carry_out(session, "add-sheet 3000x1500=2"), "");
  ASSERT_EQ(d.stocks.size(), 3u);
  EXPECT_EQ(d.stocks[2].id, "3000x1500");
  EXPECT_EQ(d.stocks[2].count, 2);
  EXPECT_EQ(d.stocks[2].cost, 4.5);
  EXPECT_EQ(carry_out(session, "add-sheet 3000x1500"), "");
  EXPECT_EQ(d.stocks[3].id, "3000x1500-2");
  EXPECT_EQ(d.stocks[3].count, 6 + 2 + 2 + 2) << "one for every piece that is wanted, those of kits too";
  EXPECT_EQ(carry_out(session, "add-strip 1400"), "");
  EXPECT_EQ(d.stocks[4].id, "strip-1400");
  EXPECT_TRUE(d.stocks[4].open_length);
  EXPECT_EQ(carry_out(session, "count scrap 7"), "");
  EXPECT_EQ(d.stocks[0].count, 7);
  EXPECT_EQ(carry_out(session, "gap 4"), "");
  EXPECT_EQ(carry_out(session, "border 10"), "");
  EXPECT_EQ(d.rules, (Rules{4 * mm, 10 * mm, 0}));
  EXPECT_EQ(carry_out(session, "kerf 3"), "");
  EXPECT_EQ(d.rules, (Rules{4 * mm, 10 * mm, 0, 3 * mm})) << "narrower than the gap";
  EXPECT_EQ(carry_out(session, "kerf 5"), "");
  EXPECT_EQ(d.rules, (Rules{5 * mm, 10 * mm, 0, 5 * mm}));
  EXPECT_EQ(carry_out(session, "gap 4"), "nothing") << "the cut is wider";
  EXPECT_EQ(carry_out(session, "kerf 5"), "nothing");
  EXPECT_EQ(carry_out(session, "quantity square 6"), "nothing");
  EXPECT_EQ(ids(d), (std::vector<std::uint64_t>{1, 2, 3, 4}));
  while (session.can_undo()) session.undo();
  EXPECT_TRUE(d == job());
}

TEST(LayoutJob, WhatIsPlacedOfAPartThatGoesGoesWithItAndOthersKeepTheirParts) {
  Session session(job());
  const auto& d = session.document();
  EXPECT_EQ(carry_out(session, "remove-part square"), "");
  EXPECT_EQ(ids(d), (std::vector<std::uint64_t>{2, 3, 4}));
  ASSERT_EQ(d.parts.size(), 2u);
  EXPECT_EQ(d.parts[d.placements[0].part].id, "bar");
  EXPECT_EQ(d.parts[d.placements[1].part].id, "lid");
  EXPECT_EQ(d.parts[d.kits[0].pieces[0].part].id, "bar");
  EXPECT_EQ(d.next_id, job().next_id) << "no id is given again";
  EXPECT_EQ(session.workspace().at({1, 0}, grid_point(52, 52)), (std::vector<std::uint64_t>{3}));
  session.undo();
  EXPECT_TRUE(d == job());
}

TEST(LayoutJob, APartThatGoesIsInNoKitAnyMoreAndAKitOfNothingGoesToo) {
  Document first = job();
  first.kits.push_back(
      {"set", "Set", 3, 2, {{0, 1, std::nullopt}, {1, 2, false}, {2, 1, std::nullopt}, {1, 1, {}}}});
  first.kits.push_back({"lids", "", 1, 1, {{2, 4, std::nullopt}}});
  Session session(first);
  const auto& d = session.document();
  const auto removed = session.apply(RemovePartCommand{1});
  ASSERT_TRUE(removed);
  EXPECT_EQ(removed->job.kits.size(), 2u);
  EXPECT_EQ(d.kits, (std::vector<Kit>{{"set", "Set", 3, 2, {{0, 1, std::nullopt}, {1, 1, std::nullopt}}},
                                      {"lids", "", 1, 1, {{1, 4, std::nullopt}}}}));
  EXPECT_EQ(wanted(d, 1), 2 + 3 * 1 + 4) << "the lid";
  session.undo();
  EXPECT_TRUE(d == first);
  EXPECT_EQ(carry_out(session, "remove-part bar"), "");
  EXPECT_EQ(carry_out(session, "remove-part lid"), "");
  EXPECT_EQ(d.kits, (std::vector<Kit>{{"set", "Set", 3, 2, {{0, 1, std::nullopt}}}}));
  EXPECT_EQ(carry_out(session, "remove-part square"), "");
  EXPECT_TRUE(d.kits.empty() && d.parts.empty());
  while (session.can_undo()) session.undo();
  EXPECT_TRUE(d == first);
}

TEST(LayoutJob, WhatLiesOnASheetThatGoesIsTakenOff) {
  Session session(job());
  const auto& d = session.document();
  EXPECT_EQ(carry_out(session, "remove-stock scrap"), "");
  EXPECT_EQ(ids(d), (std::vector<std::uint64_t>{2, 3, 4}));
  EXPECT_EQ(d.stocks[d.placements[0].stock].id, "board");
  EXPECT_EQ(d.parts.size(), 3u) << "its parts are wanted as before";
  EXPECT_EQ(carry_out(session, "count board 1"), "");
  EXPECT_EQ(ids(d), (std::vector<std::uint64_t>{2, 3}));
  EXPECT_EQ(carry_out(session, "remove-stock board"), "");
  EXPECT_TRUE(d.placements.empty() && d.stocks.empty());
  while (session.can_undo()) session.undo();
  EXPECT_TRUE(d == job());
}

TEST(LayoutJob, WhatCannotBeIsRefusedInOneSentence) {
  Document first = job();
  first.placements[0].locked = true;
  Stock strip = strip_of(1400 * mm);
  first.stocks.push_back(strip);
  first.parts[1].may_mirror = true;
  first.kits.push_back({"pair", "", 1, 1, {{1, 1, false}, {1, 1, true}}});
  Session session(first);
  const std::pair<const char*, const char*> refused[] = {
      {"quantity lid -1", "a quantity is a whole number from 0 to 1000000000, not -1"},
      {"quantity lid 1000000001", "a quantity is a whole number from 0 to"},
      {"rotations lid 0,3601", "rotations lie within +-3600 degrees"},
      {"rotations lid 90..0", "the first of a range not above its last"},
      {"mirror bar no", "kit 'pair' is made with part 'bar' turned over, so it may be mirrored"},
      {"remove-part square", "placement 1 is locked; unlock it first"},
      {"remove-stock scrap", "placement 1 is locked; unlock it first"},
      {"add-sheet 0x100", "a side of a sheet is from 0.001 to 262144 mm long"},
      {"add-sheet 100x262145", "a side of a sheet is from 0.001 to 262144 mm long"},
      {"add-sheet 1x1=1000000001", "there are from 1 to 1000000000 of a stock, not 1000000001"},
      {"add-strip -4", "a strip is from 0.001 to 262144 mm wide"},
      {"count board 0", "there are from 1 to 1000000000 of a stock, not 0"},
      {"count strip-1400 2", "there is one of strip 'strip-1400'; add another strip instead"},
      {"gap -1", "gap, border and kerf are from 0 to 262144 mm"},
      {"border 262145", "gap, border and kerf are from 0 to 262144 mm"},
  };
  for (const auto& [line, why] : refused) {
    const std::string said = carry_out(session, line);
    EXPECT_NE(said.find(why), std::string::npos) << line << ": " << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
  EXPECT_TRUE(session.document() == first);
  EXPECT_FALSE(session.can_undo());
}

TEST(LayoutJob, RulesThatBreakAreAdmittedAndShowAsViolations) {
  Session session(job(), Mode::strict);
  EXPECT_TRUE(check(session.document()).empty());
  ASSERT_EQ(carry_out(session, "border 20"), "");
  EXPECT_EQ(check(session.document()).size(), 2u);
  const Placement& one = *session.workspace().find(1);
  EXPECT_EQ(session.workspace().violations_of(std::span(&one, 1)).size(), 1u);
}

TEST(LayoutJob, WhatComesIsCalledAsNobodyElseAndHasTheGrainOfTheOthers) {
  Document d = job();
  for (Stock& stock : d.stocks) stock.grain_degrees = 90;
  d.parts[0].grain = Grain{90, 0};
  Additions come;
  come.parts = {part("lid", 3, 3), part("lid", 4, 4), part("foot", 5, 5)};
  come.stocks = {sheet_of(50 * mm, 50 * mm, 0), sheet_of(50 * mm, 50 * mm, 3)};
  come.stocks[1].grain_degrees = 0;
  for (Part& one : d.parts) one.material = {"steel", 2 * mm};
  d.stocks[0].material = {"steel", 2 * mm};
  come.parts[2].material.name = "brass";
  const JobChange change = added(d, come);
  ASSERT_TRUE(can_bring_in(d, change));
  bring_in(d, change);
  EXPECT_EQ(d.parts[3].id, "lid-2");
  EXPECT_EQ(d.parts[4].id, "lid-3");
  EXPECT_EQ(d.parts[5].id, "foot");
  EXPECT_FALSE(d.parts[5].grain) << "not all parts have one";
  EXPECT_EQ(d.stocks[2].count, 6 + 6 + 2) << "one for every piece, of those that come too";
  EXPECT_EQ(d.stocks[2].grain_degrees, 90);
  EXPECT_EQ(d.stocks[3].count, 3);
  EXPECT_EQ(d.stocks[3].grain_degrees, 0);
  EXPECT_EQ(d.parts[3].material, (Material{"steel", 2 * mm}));
  EXPECT_EQ(d.parts[5].material, (Material{"brass", 0}));
  EXPECT_FALSE(d.stocks[2].material.is_said()) << "not all stock is of one";
}

TEST(LayoutJob, AChangeThatDoesNotFitIsNoticed) {
  const Document d = job();
  const auto fits = [&](const JobChange& change) { return can_bring_in(d, change); };
  EXPECT_TRUE(fits({{{3, std::nullopt, part("new", 1, 1)}}, {}, std::nullopt}));
  EXPECT_TRUE(
      fits({{{0, std::nullopt, part("new", 1, 1)}, {1, d.parts[0], std::nullopt}}, {}, std::nullopt}));
  EXPECT_TRUE(
      fits({{{0, d.parts[0], std::nullopt}, {3, std::nullopt, part("square", 1, 1)}}, {}, std::nullopt}));
  EXPECT_FALSE(fits({{{4, std::nullopt, part("new", 1, 1)}}, {}, std::nullopt})) << "a hole in the list";
  EXPECT_FALSE(fits({{{3, std::nullopt, part("lid", 1, 1)}}, {}, std::nullopt})) << "an id twice";
  EXPECT_FALSE(fits({{{1, d.parts[0], std::nullopt}}, {}, std::nullopt})) << "another part";
  EXPECT_FALSE(fits({{{1, std::nullopt, std::nullopt}}, {}, std::nullopt}));
  EXPECT_FALSE(fits({{{3, d.parts[0], std::nullopt}}, {}, std::nullopt}));
  EXPECT_FALSE(fits({{}, {}, RulesChange{{1, 0, 0}, {2, 0, 0}}}));
  EXPECT_FALSE(can_take_out(d, {{{0, d.parts[0], std::nullopt}}, {}, std::nullopt})) << "placed";
  EXPECT_FALSE(can_take_out(d, {{}, {{0, d.stocks[0], std::nullopt}}, std::nullopt}));
  Document without = d;
  without.placements.clear();
  EXPECT_TRUE(can_take_out(without, {{{0, d.parts[0], std::nullopt}}, {}, std::nullopt}));
  EXPECT_FALSE(can_take_out(without, {{{1, d.parts[1], std::nullopt}}, {}, std::nullopt})) << "in a kit";
  EXPECT_TRUE(can_take_out(
      without, {{{1, d.parts[1], std::nullopt}}, {}, std::nullopt, {{0, d.kits[0], std::nullopt}}}));
  const auto kit = [](std::uint32_t of) { return Kit{"box", "", 1, 1, {{of, 2, std::nullopt}}}; };
  const std::vector<ItemChange<Part>> first = {{0, std::nullopt, part("new", 1, 1)}};
  EXPECT_TRUE(fits({first, {}, std::nullopt, {{0, kit(2), kit(0)}}}));
  EXPECT_FALSE(fits({first, {}, std::nullopt, {{0, kit(1), kit(0)}}})) << "the bar has another number there";
  EXPECT_FALSE(fits({first, {}, std::nullopt, {{0, kit(2), kit(4)}}})) << "no such part";
  EXPECT_FALSE(fits({{}, {}, std::nullopt, {{1, kit(1), std::nullopt}}})) << "no such kit";
}

TEST(LayoutJob, DifferencesLeadFromOneDocumentToTheOther) {
  const Document a = job();
  const auto leads = [&](const Document& from, const Document& to) {
    const Change change = difference(from, to);
    EXPECT_TRUE(can_bring_in(from, change.job));
    Workspace workspace(from);
    (void)workspace.scene({0, 0});
    carry_out(workspace, change);
    EXPECT_TRUE(workspace.document() == to);
    take_back(workspace, change);
    EXPECT_TRUE(workspace.document() == from);
  };
  Document b = a;
  b.rules.gap = mm;
  b.parts.push_back(part("new", 3, 3));
  b.parts[0].demand = 9;
  b.stocks[1].defects.clear();
  b.placements[0].part = 3;
  leads(a, b);
  leads(b, a);
  Document c = a;  // in another order
  std::swap(c.parts[0], c.parts[2]);
  std::swap(c.stocks[0], c.stocks[1]);
  leads(a, c);
  Document d = a;
  d.parts = {part("x", 2, 2), a.parts[1]};
  d.stocks = {a.stocks[1]};
  d.stocks[0].count = 1;
  d.stocks[0].defects.clear();
  d.placements = {};
  leads(a, d);
  leads(d, b);
  leads(d, c);
}

TEST(LayoutJob, AnOlderChangeFindsItsPartsUnderTheirNewNumbers) {
  const Document then = job();
  Session session(then);
  const auto removed = session.apply(RemoveCommand{{4}});
  ASSERT_TRUE(removed);
  const Document after = session.document();
  ASSERT_EQ(carry_out(session, "remove-part square"), "");
  ASSERT_EQ(carry_out(session, "remove-stock scrap"), "");
  const Document now = session.document();
  const auto back = renumbered(reversed(*removed, now.next_id), after, now);
  ASSERT_TRUE(back) << back.error().message;
  Document made = now;
  layout::carry_out(made, *back);
  ASSERT_EQ(made.placements.size(), 3u);
  EXPECT_EQ(made.parts[made.placements[2].part].id, "lid");
  EXPECT_EQ(made.stocks[made.placements[2].stock].id, "board");
  // Once the part is gone, or another one has its name, nothing is put back.
  ASSERT_EQ(carry_out(session, "remove-part lid"), "");
  const auto gone = renumbered(reversed(*removed, now.next_id), after, session.document());
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().message, "part 'lid' is not there any more");
  Document other = session.document();
  other.parts.push_back(part("lid", 9, 9));
  const auto another = renumbered(reversed(*removed, now.next_id), after, other);
  ASSERT_FALSE(another);
  EXPECT_EQ(another.error().message, "part 'lid' is another one now");
}

TEST(LayoutJob, APartThatComesBackStandsWhereItStoodAsFarAsTheOthersAreThere) {
  Document then = job();
  then.kits.clear();
  Session session(then);
  const auto removed = session.apply(RemovePartCommand{1});
  ASSERT_TRUE(removed);
  const Document after = session.document();
  ASSERT_EQ(carry_out(session, "remove-part square"), "");
  ASSERT_EQ(carry_out(session, "add-sheet 10x10"), "");
  const auto back = renumbered(reversed(*removed, after.next_id), after, session.document());
  ASSERT_TRUE(back) << back.error().message;
  Document made = session.document();
  ASSERT_TRUE(can_bring_in(made, back->job));
  layout::carry_out(made, *back);
  ASSERT_EQ(made.parts.size(), 2u);
  EXPECT_EQ(made.parts[0].id, "bar");
  EXPECT_EQ(made.parts[1].id, "lid");
  EXPECT_EQ(ids(made), (std::vector<std::uint64_t>{2, 3, 4}));
  EXPECT_EQ(made.parts[made.placements[0].part].id, "bar");
  EXPECT_EQ(made.parts[made.placements[1].part].id, "lid");
}

}  // namespace
}  // namespace lekalo::layout::layout_job_test

#include "lekalo/layout/session.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <string>
#include <tuple>
#include <vector>

#include "lekalo/base/stop.hpp"
#include "lekalo/layout/check.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::layout::layout_session_test {
namespace {

using cases::box_loop;
using cases::grid_point;
using cases::outline_of;
using geom::GridPoint;

constexpr std::int64_t mm = geom::kGridPerMm;

/// Part 0 is 10 x 10, part 1 20 x 5, part 2 a frame of 30 with a room of 20; sheets of 100 x 100, two copies.
Document empty() {
  Document d;
  const Outline outlines[] = {outline_of({box_loop(0, 0, 10, 10)}), outline_of({box_loop(0, 0, 20, 5)}),
                              outline_of({box_loop(0, 0, 30, 30), box_loop(5, 5, 25, 25)})};
  const char* const names[] = {"square", "bar", "frame"};
  for (std::size_t i = 0; i < 3; ++i) {
    Part part;
    part.id = names[i];
    part.outline = outlines[i];
    d.parts.push_back(part);
  }
  Stock stock;
  stock.id = "sheet";
  stock.count = 2;
  stock.outline = outline_of({box_loop(0, 0, 100, 100)});
  d.stocks = {stock};
  return d;
}

void place(Document& d, std::uint32_t part, double x, double y, double degrees = 0) {
  Placement placement;
  placement.id = d.next_id++;
  placement.part = part;
  placement.at = grid_point(x, y);
  placement.rotation = geom::rotation_from_degrees(degrees);
  d.placements.push_back(placement);
}

/// Two squares at (20, 40) and (60, 40).
Document two() {
  Document d = empty();
  place(d, 0, 20, 40);
  place(d, 0, 60, 40);
  return d;
}

/// Where a placement lies, in mm.
std::vector<double> where(const Session& session, std::uint64_t id) {
  const Placement& placement = *session.workspace().find(id);
  return {geom::mm_from_grid(placement.at.x), geom::mm_from_grid(placement.at.y)};
}
/// Where it lies to within the two steps that a slide may leave.
void expect_near(const Session& session, std::uint64_t id, double x, double y) {
  const auto at = where(session, id);
  EXPECT_NEAR(at[0], x, 2.5 * geom::kGridStep) << "placement " << id;
  EXPECT_NEAR(at[1], y, 2.5 * geom::kGridStep) << "placement " << id;
  EXPECT_TRUE(check(session.document()).empty());
}

/// Carries a line out; the fault, or "".
std::string carry_out(Session& session, const std::string& line) {
  const auto command = command_from_text(line, session.document());
  if (!command) return "unreadable: " + command.error().message;
  const auto change = session.apply(*command);
  return change ? "" : change.error().message;
}

TEST(LayoutSession, ANewCommandForgetsWhatWasUndone) {
  Session session(two());
  EXPECT_FALSE(session.can_undo());
  EXPECT_EQ(carry_out(session, "move 1 by 5 0"), "");
  EXPECT_EQ(carry_out(session, "move 1 by 5 0"), "");
  session.undo();
  EXPECT_EQ(where(session, 1), (std::vector<double>{25, 40}));
  EXPECT_TRUE(session.can_redo());
  EXPECT_EQ(carry_out(session, "move 2 by 0 5"), "");
  EXPECT_FALSE(session.can_redo());
  EXPECT_EQ(session.log(), "lekalo-commands/1\nmove 1 by 5 0\nmove 2 by 0 5\n");
  session.undo();
  session.undo();
  EXPECT_TRUE(session.document() == two());
  EXPECT_FALSE(session.can_undo());
}

TEST(LayoutSession, WhatMovesNothingOrIsRefusedLeavesNoTraceAndForgetsNothing) {
  Session session(two());
  EXPECT_EQ(carry_out(session, "move 1 by 5 0"), "");
  session.undo();
  EXPECT_EQ(carry_out(session, "move 1 by 0 0"), "");
  EXPECT_NE(carry_out(session, "move 1 by 40 0"), "");
  EXPECT_TRUE(session.can_redo());
  EXPECT_EQ(session.log(), "lekalo-commands/1\n");
  EXPECT_TRUE(session.document() == two());
}

TEST(LayoutSession, LockedPlacementsStay) {
  Session session(two());
  ASSERT_EQ(carry_out(session, "lock 1"), "");
  for (const char* line : {"move 1 by 1 0", "rotate 1 90", "flip 1", "remove 1", "swap 1 2", "swap 2 1",
                           "slide 1 towards 1 0", "slide-along 1 by 1 0", "settle 1 towards 1 0",
                           "push 1 by 1 0", "snap 1 within 5", "nearest 1 by 1 0", "move 2,1 by 1 0"})
    EXPECT_EQ(carry_out(session, line), "placement 1 is locked; unlock it first") << line;
  EXPECT_EQ(where(session, 1), (std::vector<double>{20, 40}));
  ASSERT_EQ(carry_out(session, "unlock 1"), "");
  EXPECT_EQ(carry_out(session, "move 1 by 1 0"), "");
}

TEST(LayoutSession, IdsAreNeverUsedAgain) {
  Session session(two());
  ASSERT_EQ(carry_out(session, "place square sheet 0 1 0 0 0 upright"), "");
  EXPECT_NE(session.workspace().find(3), nullptr);
  ASSERT_EQ(carry_out(session, "remove 3"), "");
  ASSERT_EQ(carry_out(session, "place square sheet 0 1 0 0 0 upright"), "");
  EXPECT_EQ(session.workspace().find(3), nullptr);
  EXPECT_NE(session.workspace().find(4), nullptr);
  EXPECT_EQ(session.document().next_id, 5U);
}

TEST(LayoutSession, StrictRefusesWithTheRuleAndFreeAdmits) {
  Session session(two());
  EXPECT_EQ(carry_out(session, "move 1 by 35 0"),
            "not admitted: placement 1: overlap with placement 2, 5 mm");
  session.set_mode(Mode::free);
  EXPECT_EQ(carry_out(session, "move 1 by 35 0"), "");
  EXPECT_EQ(check(session.document()).size(), 1U);
  EXPECT_EQ(session.log(), "lekalo-commands/1\nmode free\nmove 1 by 35 0\n");
  // Sliding needs a valid place to start from, in either mode.
  EXPECT_NE(carry_out(session, "slide 1 towards 1 0").find("placement 1 breaks a rule where it lies"),
            std::string::npos);
  const auto again = replay(two(), session.log());
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_TRUE(again->document() == session.document());
}

TEST(LayoutSession, ALogWithAFaultNamesItsLine) {
  const auto fault = [](const std::string& log) {
    const auto session = replay(two(), log);
    return session ? "" : session.error().message;
  };
  EXPECT_EQ(
      fault("lekalo-commands/1\n\n  # note\nmove 1 by 1 0\n"),
      "line 3: there is no command '#'; there are "
      "place, fit, move, rotate, flip, remove, swap, lock, unlock, slide, slide-along, settle, push, snap, "
      "compact and nearest, add-, move-, reshape-, grade- and remove-, each with defect or zone, and "
      "quantity, "
      "rotations, mirror, remove-part, add-sheet, add-strip, count, remove-stock, gap, border and kerf");
  EXPECT_EQ(fault("lekalo-commands/1\n\n# note\nmove 1 by 35 0\n"),
            "line 4: not admitted: placement 1: overlap with placement 2, 5 mm");
  EXPECT_EQ(fault("lekalo-commands/2\n"), "line 1: a log of commands begins with 'lekalo-commands/1'");
  EXPECT_EQ(fault("lekalo-commands/1"), "");
  EXPECT_NE(fault(""), "");
}

TEST(LayoutSession, WhatCameAndWentBeforeDoesNotMatterToACommand) {
  // A square half way between two others: snapping has to choose one of two edges equally near.
  Document d = two();
  place(d, 0, 40, 40);
  Session fresh(d), used(d);
  const Sheet other{0, 1}, first{0, 0};
  for (const Sheet sheet : {other, first})
    for (const std::uint64_t id : {1, 2}) ASSERT_TRUE(used.apply(MoveCommand{{id}, {}, sheet}));
  ASSERT_TRUE(used.document() == fresh.document());
  ASSERT_TRUE(fresh.apply(SnapCommand{3, 15 * mm}));
  ASSERT_TRUE(used.apply(SnapCommand{3, 15 * mm}));
  EXPECT_TRUE(used.document() == fresh.document());
}

TEST(LayoutSession, TurningAPartForHoursKeepsTheMemory) {
  Session session(two());
  const Sheet sheet{0, 0};
  std::size_t most = 0;
  for (int turn = 0; turn < 12000; ++turn) {
    ASSERT_TRUE(session.apply(RotateCommand{{1}, 0.03}));
    if (turn == 3000) most = session.workspace().scene(sheet).bytes();
  }
  EXPECT_LE(session.workspace().scene(sheet).bytes(), 2 * most);
  EXPECT_TRUE(check(session.document()).empty());
}

TEST(LayoutCommandsUnit, RotateFlipAndSwapGoAboutTheMiddlesOfBoxes) {
  Document d = empty();
  place(d, 1, 20, 20);  // 20 x 5, middle (30, 22.5)
  place(d, 0, 70, 70);  // middle (75, 75)
  for (Part& part : d.parts) part.may_mirror = true;
  Session session(d);
  ASSERT_EQ(carry_out(session, "rotate 1 90"), "");
  EXPECT_EQ(where(session, 1), (std::vector<double>{32.5, 12.5}));
  ASSERT_EQ(carry_out(session, "rotate 1 -90"), "");
  EXPECT_TRUE(session.document() == d);
  ASSERT_EQ(carry_out(session, "flip 1"), "");
  EXPECT_EQ(where(session, 1), (std::vector<double>{40, 20}));
  ASSERT_EQ(carry_out(session, "flip 1"), "");
  EXPECT_TRUE(session.document() == d);
  ASSERT_EQ(carry_out(session, "swap 1 2"), "");
  EXPECT_EQ(where(session, 1), (std::vector<double>{65, 72.5}));
  EXPECT_EQ(where(session, 2), (std::vector<double>{25, 17.5}));
  // Two as one: about the middle of both.
  Session pair(two());
  ASSERT_EQ(carry_out(pair, "rotate 1,2 180"), "");
  EXPECT_EQ(where(pair, 1), (std::vector<double>{70, 50}));
  EXPECT_EQ(where(pair, 2), (std::vector<double>{30, 50}));
}

TEST(LayoutCommandsUnit, SlideKeepsTheGapAndStopsWithinTwoSteps) {
  Document d = two();
  d.rules.gap = 3 * mm;
  d.rules.border_gap = mm;
  Session session(d);
  ASSERT_EQ(carry_out(session, "slide 1 towards 1 0"), "");
  expect_near(session, 1, 60 - 3 - 10, 40);
  EXPECT_LE(where(session, 1)[0], 47);
  ASSERT_EQ(carry_out(session, "slide 2 towards 0 -5"), "");
  expect_near(session, 2, 60, 1);
  EXPECT_GE(where(session, 2)[1], 1);
}

TEST(LayoutCommandsUnit, SlideStopsAtALockedNeighbourAndInsideAHole) {
  Document d = empty();
  place(d, 2, 30, 30);  // its room is (35, 35) to (55, 55)
  place(d, 0, 40, 40);
  Session session(d);
  ASSERT_EQ(carry_out(session, "slide 2 towards -1 0"), "");
  expect_near(session, 2, 35, 40);
  ASSERT_EQ(carry_out(session, "settle 2 towards 0 1 then 1 0"), "");
  expect_near(session, 2, 45, 45);
}

TEST(LayoutCommandsUnit, SlideAlongFollowsTheObstacle) {
  Document d = empty();
  place(d, 0, 20, 40);
  place(d, 1, 40, 30, 90);  // a wall from x = 35 to 40, y = 30 to 50
  Session session(d);
  // Around it: straight to the wall, then up along it until the way to the goal opens.
  ASSERT_EQ(carry_out(session, "slide-along 1 by 40 15"), "");
  EXPECT_TRUE(check(session.document()).empty());
  expect_near(session, 1, 60, 55);
}

TEST(LayoutCommandsUnit, SettleRestsInTheCorner) {
  Session session(two());
  ASSERT_EQ(carry_out(session, "settle 1 towards -1 0 then 0 -1"), "");
  expect_near(session, 1, 0, 0);
  ASSERT_EQ(carry_out(session, "settle 2 towards 0 -1 then -1 0"), "");
  expect_near(session, 2, 10, 0);
}

TEST(LayoutCommandsUnit, PushMovesWhatIsInTheWayAndStopsAtWhatIsFixed) {
  Document d = two();
  place(d, 0, 80, 45);
  Session session(d);
  ASSERT_EQ(carry_out(session, "push 1 by 35 0"), "");
  expect_near(session, 1, 55, 40);
  expect_near(session, 2, 65, 40);
  expect_near(session, 3, 80, 45);
  ASSERT_EQ(carry_out(session, "push 1 by 50 0"), "");  // to the border: all three in a row
  expect_near(session, 3, 90, 45);
  expect_near(session, 2, 80, 40);
  expect_near(session, 1, 70, 40);
  ASSERT_EQ(carry_out(session, "move 1 by -40 0"), "");
  ASSERT_EQ(carry_out(session, "lock 2"), "");
  ASSERT_EQ(carry_out(session, "push 1 by 60 0"), "");
  expect_near(session, 1, 70, 40);
  EXPECT_NEAR(where(session, 2)[0], 80, 1e-5);
}

TEST(LayoutCommandsUnit, SnapTurnsParallelGoesAgainstAndCornerToCorner) {
  Document d = two();
  d.placements[1].at = grid_point(32, 41.5);
  d.placements[1].rotation = geom::rotation_from_degrees(4);
  Session session(d);
  ASSERT_EQ(carry_out(session, "snap 2 within 3"), "");
  const Placement& placed = *session.workspace().find(2);
  // As exactly as the turned vertices, which lie on the grid, say where its edges run.
  EXPECT_NEAR(geom::degrees_of(placed.rotation), 0, 1e-5);
  expect_near(session, 2, 30, 40);
  // With a part that may not be turned to it, and with nothing near.
  EXPECT_EQ(carry_out(session, "move 2 by 30 20"), "");
  EXPECT_EQ(carry_out(session, "snap 2 within 3"), "placement 2: no edge within 3 mm that it fits against");
  EXPECT_EQ(carry_out(session, "snap 2 within 0"), "snapping needs a reach above 0");
}

TEST(LayoutCommandsUnit, CompactSettlesAllButTheLocked) {
  Document d = two();
  place(d, 0, 40, 44);
  d.placements[2].locked = true;
  Session session(d);
  ASSERT_EQ(carry_out(session, "compact sheet 0 towards -1 0"), "");
  EXPECT_EQ(where(session, 3), (std::vector<double>{40, 44}));
  EXPECT_NEAR(where(session, 1)[0], 0, 3e-6);
  EXPECT_TRUE(check(session.document()).empty());
  // The second went round the locked one, or rests against it.
  EXPECT_LE(where(session, 2)[0], 50 + 3e-6);
  // One undo takes all of it back.
  session.undo();
  EXPECT_TRUE(session.document() == d);
}

TEST(LayoutCommandsUnit, NearestIsTheDroppedPlaceWhereItIsValidAndBesideOtherwise) {
  Session session(two());
  ASSERT_EQ(carry_out(session, "nearest 1 by 5 5"), "");
  EXPECT_EQ(where(session, 1), (std::vector<double>{25, 45}));
  session.undo();
  // Dropped 2 mm into the other: out the same way is nearest.
  ASSERT_EQ(carry_out(session, "nearest 1 by 32 0"), "");
  EXPECT_TRUE(check(session.document()).empty());
  const auto at = where(session, 1);
  EXPECT_NEAR(at[0], 50, 0.05);
  EXPECT_NEAR(at[1], 40, 0.5);
  session.undo();
  // Off the sheet: back to its edge. Onto another copy: where it was dropped.
  ASSERT_EQ(carry_out(session, "nearest 1 by -25 0"), "");
  EXPECT_NEAR(where(session, 1)[0], 0, 0.05);
  session.undo();
  ASSERT_EQ(carry_out(session, "nearest 1 by 40 0 to sheet 1"), "");
  EXPECT_EQ(session.workspace().find(1)->copy, 1);
  EXPECT_EQ(where(session, 1), (std::vector<double>{60, 40}));
}

TEST(LayoutCommandsUnit, FitTakesTheLowestPlaceLeftmostFirstUntilNothingFits) {
  Document d = empty();
  for (Part& part : d.parts) part.rotations = {{0, 0}};
  d.stocks[0].outline = outline_of({box_loop(0, 0, 25, 12)});
  Session session(d);
  ASSERT_EQ(carry_out(session, "fit square sheet 0"), "");
  expect_near(session, 1, 0, 0);
  ASSERT_EQ(carry_out(session, "fit square sheet 0"), "");
  expect_near(session, 2, 10, 0);
  EXPECT_EQ(carry_out(session, "fit square sheet 0"), "no place was found where part 'square' fits");
  EXPECT_EQ(carry_out(session, "fit frame sheet 0"), "no place was found where part 'frame' fits");
  // The command in the log is the command; the place follows from it.
  EXPECT_EQ(session.log(), "lekalo-commands/1\nfit \"square\" \"sheet\" 0\nfit \"square\" \"sheet\" 0\n");
  EXPECT_EQ(fits_where(session.workspace(), 0, {0, 1}, 3).size(), 1U) << "starts that settle to one place";
}

/// Kind, placement and feature of every violation.
std::vector<std::string> broken(const Session& session) {
  std::vector<std::string> all;
  for (const Violation& v : check(session.document()))
    all.push_back(std::string(name_of(v.kind)) + " " + std::to_string(v.a) + " " +
                  feature_id(session.document(), v));
  return all;
}

TEST(LayoutFeatures, ADefectThatIsReallyThereIsAdmittedAndThePartsOnItAreListed) {
  Document d = two();
  d.parts[0].tolerated_severity = 1;
  d.rules.defect_gap = 2 * mm;
  Session session(d);
  const std::string spot = " outline 25 45 27 45 27 47 25 47";
  ASSERT_EQ(carry_out(session, "add-defect sheet scar 2" + spot), "");
  EXPECT_EQ(broken(session), (std::vector<std::string>{"defect 1 scar"}));
  const Workspace& workspace = session.workspace();
  EXPECT_EQ(workspace.violations_with(0, FeatureKind::defect, 0), check(session.document()));
  // The other part cannot go there, and the one on it can go away.
  EXPECT_EQ(carry_out(session, "move 2 by -38 0").find("not admitted"), 0u);
  ASSERT_EQ(carry_out(session, "grade-defect sheet scar 1"), "");
  EXPECT_TRUE(broken(session).empty());
  ASSERT_EQ(carry_out(session, "grade-defect sheet scar 3"), "");
  ASSERT_EQ(carry_out(session, "move-defect sheet scar by 6 0"), "");
  EXPECT_EQ(broken(session), (std::vector<std::string>{"defect-gap 1 scar"}));
  ASSERT_EQ(carry_out(session, "reshape-defect sheet scar outline 25 45 70 45 70 47 25 47"), "");
  EXPECT_EQ(broken(session), (std::vector<std::string>{"defect 1 scar", "defect 2 scar"}));
  ASSERT_EQ(carry_out(session, "remove-defect sheet scar"), "");
  EXPECT_TRUE(broken(session).empty());
  const std::string log = session.log();
  for (int i = 0; i < 3; ++i) session.undo();
  EXPECT_EQ(session.document().stocks[0].defects[0].severity, 3);
  for (; session.can_undo();) session.undo();
  EXPECT_TRUE(session.document() == d);
  for (; session.can_redo();) session.redo();
  EXPECT_EQ(session.log(), log);
}

TEST(LayoutFeatures, ZonesCountByTheirQuality) {
  Document d = two();
  d.parts[0].quality = 2;
  Session session(d);
  ASSERT_EQ(carry_out(session, "add-zone sheet belly 1 outline 0 0 50 0 50 100 0 100"), "");
  ASSERT_EQ(carry_out(session, "add-defect sheet belly 1 outline 90 90 91 90 91 91"), "");  // its own list
  EXPECT_EQ(broken(session), (std::vector<std::string>{"quality 1 belly"}));
  EXPECT_EQ(session.workspace().violations_with(0, FeatureKind::zone, 0), check(session.document()));
  ASSERT_EQ(carry_out(session, "grade-zone sheet belly 2"), "");
  EXPECT_TRUE(broken(session).empty());
}

TEST(LayoutFeatures, WhatCannotBeIsRefusedInOneSentence) {
  Session session(two());
  ASSERT_EQ(carry_out(session, "add-defect sheet a 1 outline 1 1 2 1 2 2"), "");
  const Document before = session.document();
  const std::pair<const char*, const char*> refusals[] = {
      {"add-defect sheet a 1 outline 1 1 2 1 2 2", "has a defect 'a' already"},
      {"add-defect sheet b 0 outline 1 1 2 1 2 2", "the severity of a defect is a whole number from 1"},
      {"add-zone sheet b -1 outline 1 1 2 1 2 2", "the quality of a zone is a whole number from 0"},
      {"add-zone sheet b 1000001 outline 1 1 2 1 2 2", "to 1000000, not 1000001"},
      {"add-defect sheet \"\" 1 outline 1 1 2 1 2 2", "the id of a defect has 1 to 1000 bytes"},
      {"add-defect sheet \"a\nb\" 1 outline 1 1 2 1 2 2", "without control characters"},
      {"add-defect sheet b 1 outline", "outline"},
      {"add-defect sheet b 1 outline 1 1 2 1", "outline"},
      {"add-defect sheet b 1 outline 0 0 4 4 4 0 0 4", "outline"},
      {"add-defect sheet b 1 outline 0 0 9 0 9 9 0 9 hole 20 20 21 20 21 21", "hole 0"},
      {"add-defect sheet b 1 outline 0 0 300000 0 0 9", "outline"},
      {"reshape-defect sheet a outline 0 0 4 4 4 0 0 4", "outline"},
      {"move-defect sheet a by 262144 0", "defect 'a' would leave the range of +-262144 mm"},
      {"move-zone sheet a by 1 0", "stock 'sheet' has no zone 'a'"},
      {"remove-defect sheet b", "stock 'sheet' has no defect 'b'"},
      {"grade-defect sheet a 0", "the severity of a defect"},
  };
  for (const auto& [line, why] : refusals) {
    SCOPED_TRACE(line);
    const std::string said = carry_out(session, line);
    EXPECT_NE(said.find(why), std::string::npos) << said;
    EXPECT_EQ(said.find('\n'), std::string::npos);
  }
  EXPECT_TRUE(session.document() == before);
  // What changes nothing leaves no trace.
  for (const char* line :
       {"move-defect sheet a by 0 0", "grade-defect sheet a 1", "reshape-defect sheet a outline 1 1 2 1 2 2"})
    ASSERT_EQ(carry_out(session, line), "");
  session.undo();
  EXPECT_FALSE(session.can_undo());
}

TEST(LayoutFeatures, AMovedDefectIsItsPolygonAndUndoBringsTheCurvesBack) {
  Document d = two();
  Defect defect;
  defect.id = "round";
  geom::Region drawn;
  const geom::Point corners[] = {{70, 70}, {80, 70}, {70, 80}};
  for (int i = 0; i < 3; ++i) {
    geom::Edge edge;
    edge.from = corners[i];
    edge.to = corners[(i + 1) % 3];
    drawn.outer.push_back(edge);
  }
  defect.outline = outline_of({{grid_point(70, 70), grid_point(80, 70), grid_point(70, 80)}});
  defect.outline.curves = {drawn};
  defect.outline.chord_tolerance_mm = 0.01;
  d.stocks[0].defects = {defect};
  Session session(d);
  ASSERT_EQ(carry_out(session, "move-defect sheet round by 0.5 0"), "");
  EXPECT_TRUE(session.document().stocks[0].defects[0].outline.curves.empty());
  EXPECT_EQ(session.document().stocks[0].defects[0].outline.chord_tolerance_mm, 0);
  session.undo();
  EXPECT_TRUE(session.document() == d);
}

TEST(LayoutFeatures, DifferencesLeadFromOneDocumentToTheOther) {
  Document a = two();
  const auto defect = [](const char* id, double x) {
    return Defect{id, 1, outline_of({box_loop(x, 0, x + 1, 1)})};
  };
  a.stocks[0].defects = {defect("a", 0), defect("b", 2), defect("c", 4), defect("d", 6)};
  const auto leads_to = [&](std::vector<Defect> defects) {
    Document b = a;
    b.stocks[0].defects = std::move(defects);
    const Change change = difference(a, b);
    Document made = a;
    carry_out(made, change);
    EXPECT_TRUE(made == b);
    Workspace workspace(a);
    (void)workspace.scene({0, 0});
    carry_out(workspace, change);
    EXPECT_TRUE(workspace.document() == b);
    take_back(workspace, change);
    EXPECT_TRUE(workspace.document() == a);
    return change.features.size();
  };
  EXPECT_EQ(leads_to(a.stocks[0].defects), 0u);
  EXPECT_EQ(leads_to({}), 4u);
  EXPECT_EQ(leads_to({defect("a", 0), defect("x", 1), defect("b", 3), defect("d", 6), defect("y", 9)}), 4u);
  EXPECT_EQ(leads_to({defect("d", 6), defect("a", 0), defect("e", 8)}), 7u);  // another order
}

TEST(LayoutFeatures, DrawingForHoursKeepsTheMemory) {
  Session session(two());
  ASSERT_EQ(carry_out(session, "add-defect sheet a 1 outline 1 1 2 1 2 2"), "");
  const Sheet sheet{0, 0};
  std::size_t early = 0, late = 0;
  for (int turn = 0; turn < 9000; ++turn) {
    ASSERT_TRUE(session.apply(
        MoveFeatureCommand{FeatureKind::defect, 0, "a", {turn % 2 == 0 ? mm : -mm, turn % 3 * mm / 100}}));
    std::size_t& most = turn < 4000 ? early : late;
    most = std::max(most, session.workspace().scene(sheet).bytes());
  }
  EXPECT_LE(late, early + early / 4);
}

TEST(LayoutCommandsUnit, CompactOfAllSheetsIsThatOfEach) {
  Document d = two();
  d.placements[1].copy = 1;
  Session all(d), each(d);
  ASSERT_EQ(carry_out(all, "compact towards -1 0"), "");
  ASSERT_EQ(carry_out(each, "compact sheet 0 towards -1 0"), "");
  ASSERT_EQ(carry_out(each, "compact sheet 1 towards -1 0"), "");
  EXPECT_TRUE(all.document() == each.document());
  EXPECT_FALSE(all.document() == d);
}

TEST(LayoutCommandsUnit, LongCommandsSayHowFarTheyAreAndGiveWhatTheyHaveWhenStopped) {
  const Workspace workspace(two());
  const Command compact = *command_from_text("compact sheet 0 towards 0 -1", workspace.document());
  std::vector<double> heard;
  std::atomic<bool> stop = false;
  RunControl run;
  run.stop = &stop;
  run.progress = [&](const Progress& progress) { heard.push_back(progress.fraction); };
  const auto whole = plan(workspace, compact, Mode::strict, run);
  ASSERT_TRUE(whole);
  EXPECT_TRUE(*whole == *plan(workspace, compact, Mode::strict));
  EXPECT_EQ(whole->placements.size(), 2u);
  ASSERT_FALSE(heard.empty());
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_LE(heard.back(), 1);
  run.progress = [&](const Progress&) { stop = true; };
  const auto part = plan(workspace, compact, Mode::strict, run);
  ASSERT_TRUE(part);
  EXPECT_EQ(part->placements.size(), 1u);
  const auto none =
      plan(workspace, *command_from_text("fit square sheet 0", workspace.document()), Mode::strict, run);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "stopped before a place was found where part 'square' fits");
}

/// What lies in the scenes: of each sheet and body the placement and the place, in the document's order.
std::vector<std::tuple<std::int64_t, std::uint64_t, GridPoint>> bodies_of(const Workspace& workspace) {
  std::vector<std::tuple<std::int64_t, std::uint64_t, GridPoint>> found;
  for (std::int64_t copy = 0; copy < 2; ++copy) {
    const Sheet sheet{0, copy};
    for (const phi::BodyIndex body :
         workspace.near(sheet, {grid_point(-1000, -1000), grid_point(1000, 1000)}, 0, ~0U))
      found.emplace_back(copy, workspace.placement_of(sheet, body), workspace.scene(sheet).body(body).at);
  }
  return found;
}

TEST(LayoutSession, AStopAtAnyStepLeavesTheScenesAsTheyWere) {
  // A person who closes the page stops a gesture, and others go on in the same workspace.
  Document document = two();
  place(document, 1, 40, 80);
  place(document, 2, 20, 10);
  document.placements.back().copy = 1;
  const auto whole = bodies_of(Workspace(document));
  for (const char* const line : {"move 1,2 by 5 0", "move 1,3 by 0 0 to sheet 1", "swap 1 3",
                                 "settle 1,2 towards 0 -1", "push 1 by 60 0", "compact towards 0 -1"}) {
    const auto command = command_from_text(line, document);
    ASSERT_TRUE(command.has_value()) << line << ": " << command.error().message;
    std::size_t stops = 0;
    RunControl run;
    for (run.work_limit = 0;; ++run.work_limit) {
      const Workspace workspace(document);
      const auto planned = stoppable(run, [&] { return plan(workspace, *command, Mode::strict); });
      ASSERT_EQ(bodies_of(workspace), whole) << line << ", stopped after " << run.work_limit << " steps";
      if (planned) break;
      ++stops;
    }
    EXPECT_GT(stops, 0U) << line;
  }
}

}  // namespace
}  // namespace lekalo::layout::layout_session_test

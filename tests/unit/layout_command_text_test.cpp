#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "lekalo/layout/session.hpp"
#include "support/layout_cases.hpp"

namespace lekalo::layout::layout_command_text_test {
namespace {

constexpr std::int64_t mm = geom::kGridPerMm;

/// Two parts, one with an awkward name, and two stocks.
Document document() {
  Document d;
  for (const char* id : {"vamp", "a \"b\"\\\nc"}) {
    Part part;
    part.id = id;
    part.outline = cases::outline_of({cases::box_loop(0, 0, 10, 10)});
    d.parts.push_back(part);
  }
  for (const char* id : {"hide", "second hide"}) {
    Stock stock;
    stock.id = id;
    stock.count = 2;
    stock.outline = cases::outline_of({cases::box_loop(0, 0, 100, 100)});
    d.stocks.push_back(stock);
  }
  return d;
}

std::string fault_of(const std::string& line) {
  const auto command = command_from_text(line, document());
  if (command) return "read";
  EXPECT_EQ(command.error().code, ErrorCode::bad_input);
  EXPECT_EQ(command.error().message.find('\n'), std::string::npos);
  return command.error().message;
}

TEST(LayoutCommandText, EveryCommandHasOneLineThatReadsBackToIt) {
  const geom::GridRotation odd = geom::rotation_from_degrees(33.3);
  const std::pair<Command, std::string> commands[] = {
      {PlaceCommand{0, 1, 1, {}, false, {3 * mm, -mm / 2}},
       R"(place "vamp" "second hide" 1 1 0 3 -0.5 upright)"},
      {PlaceCommand{1, 0, 0, odd, true, {1, -1}}, ""},
      {MoveCommand{{3, 1}, {mm, 0}, std::nullopt}, "move 3,1 by 1 0"},
      {MoveCommand{{3}, {0, 0}, Sheet{1, 1}}, R"(move 3 by 0 0 to "second hide" 1)"},
      {RotateCommand{{2}, -12.25}, "rotate 2 -12.25"},
      {RotateCommand{{2}, 0.1 + 0.2}, "rotate 2 0.30000000000000004"},
      {FlipCommand{{1, 2, 3}}, "flip 1,2,3"},
      {RemoveCommand{{9007199254740991}}, "remove 9007199254740991"},
      {SwapCommand{4, 2}, "swap 4 2"},
      {LockCommand{{4}, true}, "lock 4"},
      {LockCommand{{4, 5}, false}, "unlock 4,5"},
      {SlideCommand{{1}, {-mm, 0}}, "slide 1 towards -1 0"},
      {SlideAlongCommand{{1}, {2 * mm, mm / 4}}, "slide-along 1 by 2 0.25"},
      {SettleCommand{{1}, {0, -mm}, std::nullopt}, "settle 1 towards 0 -1"},
      {SettleCommand{{1}, {0, -mm}, geom::GridPoint{-mm, 0}}, "settle 1 towards 0 -1 then -1 0"},
      {PushCommand{{1, 2}, {mm, mm}}, "push 1,2 by 1 1"},
      {SnapCommand{7, 5 * mm}, "snap 7 within 5"},
      {CompactCommand{Sheet{0, 1}, {-mm, -mm}}, R"(compact "hide" 1 towards -1 -1)"},
      {CompactCommand{std::nullopt, {0, -mm}}, "compact towards 0 -1"},
      {AddFeatureCommand{FeatureKind::defect,
                         0,
                         "d 1",
                         3,
                         {{{0, 0}, {4 * mm, 0}, {0, 4 * mm}}, {{mm, mm}, {2 * mm, mm}, {mm, 2 * mm}}}},
       R"(add-defect "hide" "d 1" 3 outline 0 0 4 0 0 4 hole 1 1 2 1 1 2)"},
      {AddFeatureCommand{FeatureKind::zone, 1, "z", 0, {{{-1, 0}, {4 * mm, 0}, {0, 4 * mm}}}}, ""},
      {MoveFeatureCommand{FeatureKind::zone, 1, "z", {mm, -mm / 2}},
       R"(move-zone "second hide" "z" by 1 -0.5)"},
      {ReshapeFeatureCommand{FeatureKind::defect, 0, "d", {{{0, 0}, {mm, 0}, {0, mm}}}},
       R"(reshape-defect "hide" "d" outline 0 0 1 0 0 1)"},
      {GradeFeatureCommand{FeatureKind::defect, 0, "d", 7}, R"(grade-defect "hide" "d" 7)"},
      {RemoveFeatureCommand{FeatureKind::zone, 0, "a \"b\""}, R"(remove-zone "hide" "a \"b\"")"},
      {NearestCommand{{1}, {mm, 0}, std::nullopt}, "nearest 1 by 1 0"},
      {NearestCommand{{1}, {mm, 0}, Sheet{0, 1}}, R"(nearest 1 by 1 0 to "hide" 1)"},
      {FitCommand{0, {0, 0}, std::nullopt}, R"(fit "vamp" "hide" 0)"},
      {FitCommand{1, {1, 1}, true}, R"(fit "a \"b\"\\\nc" "second hide" 1 mirrored)"},
      {FitCommand{0, {0, 0}, false}, R"(fit "vamp" "hide" 0 upright)"},
      {QuantityCommand{0, 6}, R"(quantity "vamp" 6)"},
      {QuantityCommand{1, 0}, R"(quantity "a \"b\"\\\nc" 0)"},
      {RotationsCommand{0, {}}, R"(rotations "vamp" any)"},
      {RotationsCommand{0, {{0, 0}, {90, 90}, {170, 190.5}}}, R"(rotations "vamp" 0,90,170..190.5)"},
      {RotationsCommand{0, {{0.1 + 0.2, 0.1 + 0.2}}}, ""},
      {MirrorCommand{0, true}, R"(mirror "vamp" yes)"},
      {MirrorCommand{0, false}, R"(mirror "vamp" no)"},
      {RemovePartCommand{1}, ""},
      {AddSheetCommand{3000 * mm, 1500 * mm, 0}, "add-sheet 3000x1500"},
      {AddSheetCommand{3000 * mm + 1, mm / 2, 7}, ""},
      {AddStripCommand{1400 * mm}, "add-strip 1400"},
      {CountCommand{1, 3}, R"(count "second hide" 3)"},
      {RemoveStockCommand{0}, R"(remove-stock "hide")"},
      {RuleCommand{RuleKind::gap, 4 * mm}, "gap 4"},
      {RuleCommand{RuleKind::border, mm / 4}, "border 0.25"},
      {RuleCommand{RuleKind::kerf, 1}, ""},
  };
  std::vector<bool> seen(std::variant_size_v<Command>);
  for (const auto& [command, text] : commands) {
    const std::string line = to_text(command, document());
    SCOPED_TRACE(line);
    if (!text.empty()) {
      EXPECT_EQ(line, text);
    }
    EXPECT_EQ(line.find('\n'), std::string::npos);
    const auto read = command_from_text(line, document());
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(*read == command);
    seen[command.index()] = true;
  }
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_TRUE(seen[i]) << "command " << i << " of the variant";
}

TEST(LayoutCommandText, SpacesTabsAndNamesWithoutQuotationMarks) {
  const auto command = command_from_text("  fit\tvamp   hide 1\r", document());
  ASSERT_TRUE(command) << command.error().message;
  EXPECT_TRUE(*command == Command(FitCommand{0, {0, 1}, std::nullopt}));
}

TEST(LayoutCommandText, EveryFaultIsNamed) {
  const std::pair<const char*, const char*> faults[] = {
      {"", "the line ends too early"},
      {"turn 1 90", "there is no command 'turn'; there are place, fit, move"},
      {"move", "the line ends too early"},
      {"move 1", "the line ends too early"},
      {"move 1 3 4", "'3' where 'by' belongs"},
      {"move one by 3 4", "'one' is no list of placements such as 3,5"},
      {"move 1,,2 by 3 4", "'1,,2' is no list of placements"},
      {"move 1, by 3 4", "'1,' is no list of placements"},
      {"move -1 by 3 4", "'-1' is no list of placements"},
      {"move 1.5 by 3 4", "'1.5' is no list of placements"},
      {"move 99999999999999999999 by 3 4", "is no list of placements"},
      {"move 1 by 3", "the line ends too early"},
      {"move 1 by 3 x", "'x' is no number"},
      {"move 1 by nan 0", "'nan' is no number"},
      {"quantity", "the line ends too early"},
      {"quantity sole 3", "there is no part \"sole\"; there are \"vamp\""},
      {"quantity vamp many", "'many' is no whole number"},
      {"quantity vamp 3 4", "'4' is left over"},
      {"rotations vamp 0,", "'0,' is not \"any\" or degrees, as in 0,90,170..190"},
      {"rotations vamp 0..", "'0..' is not"},
      {"rotations vamp all", "'all' is not"},
      {"mirror vamp maybe", "'maybe' where 'no' belongs"},
      {"add-sheet 3000", "'3000' is no size such as 3000x1500, or 3000x1500=2 for two of it, in mm"},
      {"add-sheet 3000x", "'3000x' is no size"},
      {"add-sheet x1500", "'x1500' is no size"},
      {"add-sheet 3000x1500=", "'3000x1500=' is no size"},
      {"add-sheet 3000x1500=0", "'3000x1500=0' is no size"},
      {"add-sheet 3000x1500=-2", "'3000x1500=-2' is no size"},
      {"add-sheet 3000=2x1500", "'3000=2x1500' is no size"},
      {"add-sheet 3e99x1500", "'3e99x1500' is no size"},
      {"add-strip wide", "'wide' is no number"},
      {"count sole 3", "there is no stock \"sole\""},
      {"gap", "the line ends too early"},
      {"gap 4mm", "'4mm' is no number"},
      {"kerf 1e300", "is beyond the limits"},
      {"move 1 by inf 0", "'inf' is no number"},
      {"move 1 by 1e999 0", "'1e999' is no number"},
      {"move 1 by 3mm 0", "'3mm' is no number"},
      {"move 1 by 3,5 0", "'3,5' is no number"},
      {"move 1 by 1e9 0", "1"},
      {"move 1 by 3 4 5", "'5' is left over"},
      {"move 1 by 3 4 to roof 0", "there is no stock \"roof\"; there are \"hide\", \"second hide\""},
      {"move 1 by 3 4 to hide", "the line ends too early"},
      {"move 1 by 3 4 to hide x", "'x' is no whole number"},
      {"swap 1", "the line ends too early"},
      {"swap 1 b", "'b' is no whole number"},
      {"rotate 1 left", "'left' is no number"},
      {"snap 1 by 3", "'by' where 'within' belongs"},
      {"slide 1 to 0 1", "'to' where 'towards' belongs"},
      {"settle 1 towards 0 1 then 1", "the line ends too early"},
      {"add-defect roof d 1 outline 0 0", "there is no stock \"roof\""},
      {"add-defect hide d severe outline 0 0", "'severe' is no whole number"},
      {"add-defect hide d 1 polygon 0 0", "'polygon' where 'outline' belongs"},
      {"add-defect hide d 1 outline 0 0 4", "the line ends too early"},
      {"add-defect hide d 1 outline 0 0 4 hole", "'hole' is no number"},
      {"add-hole hide d", "there is no command 'add-hole'"},
      {"xdefect hide d", "there is no command 'xdefect'"},
      {"remove-zone hide", "the line ends too early"},
      {"remove-zone hide z 1", "'1' is left over"},
      {"grade-zone hide z 99999999999", "is no whole number"},
      {"move-zone hide z 1 1", "'1' where 'by' belongs"},
      {"compact hide 0 by 1 0", "'by' where 'towards' belongs"},
      {"fit sole hide 0", "there is no part \"sole\"; there are \"vamp\""},
      {"fit \"vamp hide 0", "a name without its closing quotation mark"},
      {"fit vamp hide 0 sideways", "'sideways' is left over"},
      {"place vamp hide 0 1 0 3 4", "the line ends too early"},
      {"place vamp hide 0 1 0 3 4 flat", "'flat' where 'upright' belongs"},
      {"place vamp hide 0 5 0 3 4 upright", "cosine and sine"},
  };
  for (const auto& [line, fault] : faults) {
    SCOPED_TRACE(line);
    EXPECT_NE(fault_of(line).find(fault), std::string::npos) << fault_of(line);
    EXPECT_NE(fault_of(line), "read");
  }
}

}  // namespace
}  // namespace lekalo::layout::layout_command_text_test

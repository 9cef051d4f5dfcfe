#include <algorithm>
#include <set>

#include "e2e/cli_run.hpp"
#include "support/layout_texts.hpp"
#include "support/places.hpp"

/// `lekalo check`, `show`, `export` and `edit`, as a person runs them. That the engine and the independent
/// checker disagree cannot be brought about from outside: it would take a mistake in one of them. Their
/// sameness is tested in tests/differential/layout_oracle_test.cpp, and lies to the checker in
/// tests/property/verify_layout_test.cpp.
namespace lekalo::test::cli_layout_test {
namespace {

using cases::add_part;
using cases::outline_json;
using cases::place;
using cases::rectangle;

const std::string kShoes = cases::source_dir() + "/examples/layouts/shoes";

/// A sheet of 100 x 100 with a hole, a defect and a bad zone; squares of 10 and one that must lie straight.
Json plain() {
  Json layout = cases::empty_layout();
  Json& sheet = layout["stocks"][0];
  sheet["outline"] = outline_json(rectangle(0, 0, 100, 100), {rectangle(45, 45, 10, 10)});
  sheet["grain_deg"] = 0;
  sheet["defects"] = {{{"id", "cut"}, {"severity", 2}, {"outline", outline_json(rectangle(70, 10, 5, 5))}}};
  sheet["zones"] = {{{"id", "belly"}, {"quality", 1}, {"outline", outline_json(rectangle(0, 90, 100, 10))}}};
  layout["rules"] = {{"gap", 2}, {"border_gap", 1}, {"defect_gap", 3}};
  Json& square = add_part(layout, "square", outline_json(rectangle(0, 0, 10, 10)));
  square["quality"] = 1;
  square["demand"] = 3;
  Json& collar = add_part(layout, "collar", outline_json(rectangle(0, 0, 20, 5)));
  collar["rotations"] = {0, 180, {{"from", 85}, {"to", 95}}};
  collar["grain"] = {{"deg", 0}, {"tolerance_deg", 5}};
  collar["quality"] = 2;
  return layout;
}

/// Every kind of violation once.
Json broken() {
  Json layout = plain();
  place(layout, "square", 5, 5);                       // 1
  place(layout, "square", 12, 5);                      // 2: overlaps 1 by 3
  place(layout, "square", 5, 17);                      // 3
  place(layout, "square", 16, 17);                     // 4: 1 from 3, 2 needed
  place(layout, "square", 95, 30);                     // 5: 5 outside
  place(layout, "square", 89.5, 50);                   // 6: 0.5 from the border, 1 needed
  place(layout, "square", 63, 8);                      // 7: covers 3 of the defect
  place(layout, "square", 77, 8);                      // 8: 2 from the defect, 3 needed
  place(layout, "collar", 5, 88);                      // 9: 3 in the zone
  place(layout, "collar", 40, 70, 45);                 // 10: an angle it may not have, and off the grain
  place(layout, "collar", 60, 60, 90);                 // 11: off the grain
  place(layout, "square", 95, 70)["mirrored"] = true;  // 12
  place(layout, "square", 5, 5)["copy"] = 1;           // 13: there is no such copy
  return layout;
}

void write_layout(const TemporaryFolder& folder, const std::string& name, const Json& layout) {
  write_bytes(folder / name, layout.dump());
}

std::string sentence(const Ran& ran) {
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
  EXPECT_EQ(ran.err.rfind("lekalo: ", 0), 0U) << ran.err;
  EXPECT_EQ(ran.out, "");
  return ran.err;
}

TEST(CliLayout, CheckSaysThatAValidLayoutIsValid) {
  const TemporaryFolder folder;
  Json layout = plain();
  place(layout, "square", 5, 5);
  place(layout, "square", 17, 5);  // at the gap of 2 exactly
  place(layout, "collar", 78, 60, 90)["x_note"] = "turned";
  layout["stocks"][0].erase("grain_deg");
  write_layout(folder, "order.json", layout);
  const Ran ran = run(folder.path(), {"check", "order.json", "--json", "--picture", "order.svg"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("Valid: 3 placements, no rule is broken; confirmed by the independent checker."),
            std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("x_note"), std::string::npos) << "a field left out is named: " << ran.err;
  const Json json = ran.json();
  EXPECT_EQ(json["status"], "valid");
  EXPECT_EQ(json["valid"], true);
  EXPECT_EQ(json["violations"], Json::array());
  EXPECT_EQ(json["disagreements"], Json::array());
  EXPECT_EQ(json["inputs"][0]["path"], "order.json");
  EXPECT_EQ(json["inputs"][0]["sha256"].get<std::string>().size(), 64U);
  EXPECT_EQ(json["warnings"].size(), 1U);
  EXPECT_NE(read_bytes(folder / "order.svg").find("no violations"), std::string::npos);
}

TEST(CliLayout, CheckNamesEveryKindOfViolationWithPlaceAmountAndWayOut) {
  const TemporaryFolder folder;
  write_layout(folder, "broken.json", broken());
  const Ran ran = run(folder.path(), {"check", "broken.json", "--json"});
  ASSERT_EQ(ran.status, 1) << ran.err;
  const Json json = ran.json();
  EXPECT_EQ(json["status"], "violations");
  EXPECT_EQ(json["valid"], false);
  struct Expected {
    std::string kind;
    int a;
    Json b;
    double amount;
    Json direction;
    std::string feature, words;
  };
  const Json none = nullptr;
  const Expected expected[] = {
      {"overlap", 1, 2, 3, {-1, 0}, "", "square (placement 1) overlaps square (placement 2) by 3.00000"},
      {"gap", 3, 4, 1, {-1, 0}, "", "square (placement 3) is too near to square (placement 4) by 1.0"},
      {"outside", 5, none, 5, {-1, 0}, "", "square (placement 5) reaches out of the material by 5.00000"},
      {"border-gap", 6, none, 0.5, {-1, 0}, "", "square (placement 6) is too near to the border by 0.5"},
      {"defect", 7, none, 3, {-1, 0}, "cut", "square (placement 7) covers defect cut by 3.00000"},
      {"defect-gap", 8, none, 1, {1, 0}, "cut", "square (placement 8) is too near to defect cut by 1.0"},
      {"quality",
       9,
       none,
       3,
       {0, -1},
       "belly",
       "collar (placement 9) reaches into zone belly, which is too bad for it, by 3.00"},
      {"rotation", 10, none, 0, none, "", "collar (placement 10) is turned to an angle it may not have"},
      {"grain", 10, none, 0, none, "", "collar (placement 10) lies off the grain"},
      {"grain", 11, none, 0, none, "", "collar (placement 11) lies off the grain"},
      {"mirror", 12, none, 0, none, "", "square (placement 12) is mirrored and may not be"},
      {"stock", 13, none, 0, none, "",
       "square (placement 13) lies on a copy of the stock that is not there"}};
  ASSERT_EQ(json["violations"].size(), std::size(expected)) << json["violations"].dump(1) << ran.err;
  for (const Expected& e : expected) {
    SCOPED_TRACE(e.kind);
    const auto found = std::find_if(json["violations"].begin(), json["violations"].end(),
                                    [&](const Json& v) { return v["kind"] == e.kind && v["a"] == e.a; });
    ASSERT_NE(found, json["violations"].end());
    const Json& v = *found;
    EXPECT_EQ(v["b"], e.b);
    EXPECT_EQ(v["stock"], "s");
    EXPECT_EQ(v["copy"], e.kind == "stock" ? 1 : 0);
    EXPECT_NEAR(v["amount_mm"].get<double>(), e.amount, 1e-4);
    EXPECT_GE(v["amount_mm"].get<double>(), e.amount) << "an amount is never too small";
    ASSERT_EQ(v["at"].size(), 2U);
    if (e.direction.is_null())
      EXPECT_TRUE(v["direction"].is_null());
    else
      for (std::size_t k : {0U, 1U})
        EXPECT_NEAR(v["direction"][k].get<double>(), e.direction[k].get<double>(), 1e-6);
    EXPECT_EQ(v.value("feature", ""), e.feature);
    EXPECT_NE(ran.err.find(e.words), std::string::npos) << e.words << "\n" << ran.err;
  }
  EXPECT_NE(ran.err.find("Not valid: 12 violations among 13 placements"), std::string::npos) << ran.err;
}

TEST(CliLayout, CheckDrawsTheViolations) {
  const TemporaryFolder folder;
  write_layout(folder, "broken.json", broken());
  ASSERT_EQ(run(folder.path(), {"check", "broken.json", "--picture", "broken.svg"}).status, 1);
  const std::string svg = read_bytes(folder / "broken.svg");
  for (const char* text : {"12 violations", "overlap", "border-gap", "quality", "Violations"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;
}

struct Bad {
  std::string name, bytes, named;
};

TEST(CliLayout, BadFilesGetOneSentenceAndLeaveNothing) {
  const auto changed = [](const std::string& at, const Json& value) {
    Json layout = plain();
    place(layout, "square", 5, 5);
    layout["kits"] = {{{"id", "pair"}, {"pieces", {{{"part", "square"}}}}}};
    layout.at(at) = value;
    return layout.dump();
  };
  const std::string outer = "/parts/0/outline/polygon/outer";
  const std::string whole = changed("/name", "order 7");
  const Bad bad[] = {
      {"self-crossing", changed(outer, {{0, 0}, {10, 10}, {10, 0}, {0, 8}}), "parts[0].outline.polygon"},
      {"zero area", changed(outer, {{0, 0}, {10, 0}, {20, 0}}), "parts[0].outline.polygon"},
      {"unknown part", changed("/placements/0/part", "sole"), "placements[0].part: there is no part 'sole'"},
      {"unknown stock", changed("/placements/0/stock", "roof"),
       "placements[0].stock: there is no stock 'roof'"},
      {"kit of nothing", changed("/kits/0/pieces", Json::array()), "kits[0]"},
      {"kit of unknown", changed("/kits/0/pieces/0/part", "lace"),
       "kits[0].pieces[0].part: there is no part"},
      {"mirrored kit", changed("/kits/0/pieces/0/mirrored", true), "kits[0].pieces[0]"},
      {"huge place", changed("/placements/0/x", 1e300), "placements[0].x: 1e+300 is out of range"},
      {"huge outline", changed(outer + "/1/0", 1e9), "parts[0].outline.polygon.outer[1]"},
      {"huge gap", changed("/rules/gap", 1e30), "rules.gap"},
      {"negative gap", changed("/rules/gap", -1), "rules.gap"},
      {"unknown field", changed("/sheets", 3), "unknown field 'sheets'"},
      {"text for number", changed("/placements/0/x", "5"), "placements[0].x: a number is needed"},
      {"other version", changed("/format", "lekalo-layout/2"), "lekalo-layout/2"},
      {"cut off", whole.substr(0, whole.size() / 2), "the file ends too early"},
      {"not a number", R"({"format": "lekalo-layout/1", "units": NaN})", "not JSON"},
      {"other JSON", R"({"a": 1})", "no layout; known are"},
      {"a list", "[1, 2]", "broken.json"},
      {"words", "Dear Sir or Madam", "no layout; known are"},
      {"binary rubbish", std::string("\x00\x01\xfe\xff", 4), "this is not a text file"},
      {"empty", "", "is empty"},
  };
  for (const Bad& one : bad) {
    SCOPED_TRACE(one.name);
    const TemporaryFolder folder;
    write_bytes(folder / "broken.json", one.bytes);
    write_bytes(folder / "old.svg", "old");
    write_bytes(folder / "some.commands", "lekalo-commands/1\n");
    for (const Words& words :
         {Words{"check", "broken.json", "--picture", "old.svg", "--json"},
          Words{"show", "broken.json", "--picture", "old.svg"},
          Words{"export", "broken.json", "-o", "old.svg"},
          Words{"edit", "broken.json", "--commands", "some.commands", "-o", "old.svg"}}) {
      const Ran ran = run(folder.path(), words);
      EXPECT_EQ(ran.status, 3) << words[0];
      const std::string text = sentence(ran);
      EXPECT_EQ(text.rfind("lekalo: broken.json", 0), 0U) << text;
      EXPECT_NE(text.find(one.named), std::string::npos) << text;
      EXPECT_EQ(folder.files().size(), 3U);
      EXPECT_EQ(read_bytes(folder / "old.svg"), "old");
    }
  }
}

TEST(CliLayout, FilesThatAreNotThereAndFolders) {
  const TemporaryFolder folder;
  for (const char* path : {"none.json", "."}) {
    const Ran ran = run(folder.path(), {"check", path});
    EXPECT_EQ(ran.status, 3);
    EXPECT_NE(sentence(ran).find(path), std::string::npos);
  }
  const Ran ran = run(folder.path(), {"check"});
  EXPECT_EQ(ran.status, 2);
  EXPECT_EQ(sentence(ran), "lekalo: the file of the layout is missing (see lekalo check --help)\n");
}

TEST(CliLayout, WrongWordsAreUsageErrors) {
  const TemporaryFolder folder;
  write_layout(folder, "order.json", plain());
  write_bytes(folder / "some.commands", "lekalo-commands/1\n");
  const std::pair<Words, std::string> wrong[] = {
      {{"show", "order.json", "--picture", "order.gif"}, ".svg, .png or .pdf"},
      {{"show", "order.json", "--pictur", "order.svg"}, "did you mean --picture?"},
      {{"export", "order.json", "--format", "excel"}, "layout, placements"},
      {{"check", "order.json", "--units", "furlong"}, "mm, inch"},
      {{"check", "order.json", "--chord-tolerance", "-1"}, "--chord-tolerance"},
      {{"check", "order.json", "two.json"}, "two.json"},
      {{"edit", "order.json"}, "--commands"},
      {{"edit", "order.json", "--commands", "some.commands", "-o", "order.json"}, "would be replaced"},
      {{"edit", "order.json", "--commands", "some.commands", "-o", "some.commands"}, "would be replaced"},
      {{"export", "order.json", "-o", "./order.json"}, "would be replaced"},
      {{"shoe", "order.json"},
       "there is no command \"shoe\", only locate, verify, pocket, simulate, fit, heat, check, show, export, "
       "quote, edit, nest, new, stock"},
  };
  const auto before = folder.files();
  for (const auto& [words, named] : wrong) {
    const Ran ran = run(folder.path(), words);
    EXPECT_EQ(ran.status, 2) << words[0];
    const std::string text = sentence(ran);
    EXPECT_NE(text.find(named), std::string::npos) << text;
  }
  const Ran ran = run(folder.path(), {"show", "order.json", "--picture", "nowhere/order.svg"});
  EXPECT_EQ(ran.status, 5);
  EXPECT_NE(sentence(ran).find("nowhere"), std::string::npos);
  EXPECT_EQ(folder.files(), before);
}

TEST(CliLayout, ShowDrawsInThreeFormsAndCounts) {
  const TemporaryFolder folder;
  Json layout = plain();
  layout["name"] = "Order 7 <&>";
  layout["kits"] = {{{"id", "pair"}, {"demand", 2}, {"pieces", {{{"part", "square"}, {"count", 2}}}}}};
  for (int i = 0; i < 3; ++i) place(layout, "square", 5 + 12 * i, 5);
  write_layout(folder, "order.json", layout);
  Ran ran;
  for (const char* ending : {"png", "pdf", "svg"}) {
    ran = run(folder.path(), {"show", "order.json", "--picture", std::string("order.") + ending, "--json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
  }
  EXPECT_EQ(read_bytes(folder / "order.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(read_bytes(folder / "order.pdf").substr(0, 5), "%PDF-");
  const std::string svg = read_bytes(folder / "order.svg");
  EXPECT_EQ(svg.substr(0, 5), "<?xml") << svg.substr(0, 40);
  for (const char* text : {"Order 7 &lt;&amp;&gt;", "square", "1 of 2 complete", "Parts: 3 placed"})
    EXPECT_NE(svg.find(text), std::string::npos) << text;

  const Json json = ran.json();
  EXPECT_EQ(json["kits"][0]["complete"], 1);
  EXPECT_EQ(json["kits"][0]["missing"][0]["part"], "square");
  EXPECT_EQ(json["kits"][0]["missing"][0]["count"], 1);
  EXPECT_EQ(json["parts"][0]["placed"], 3);
  EXPECT_EQ(json["parts"][0]["missing"], 4);  // 2 kits of 2 and 3 of its own are wanted
  EXPECT_EQ(json["sheets"][0]["parts"], 3);
  EXPECT_EQ(json["sheets"][0]["parts_area_mm2"], 300);
  EXPECT_EQ(json["sheets"][0]["material_area_mm2"], 9900);
  EXPECT_EQ(json["sheets"][0]["defect_area_mm2"], 25);
  EXPECT_EQ(json["violations"], 0);
  EXPECT_NE(ran.err.find("Order 7 <&>: 3 placed, 2 parts, 1 stock\n"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("1 of 2 complete; missing 1 square"), std::string::npos) << ran.err;

  // The same bytes again.
  const auto first = folder.files();
  for (const char* ending : {"png", "pdf", "svg"})
    ASSERT_EQ(run(folder.path(), {"show", "order.json", "--picture", std::string("order.") + ending}).status,
              0);
  EXPECT_EQ(folder.files(), first);
}

const std::string kStrip = R"({"name": "roll", "strip_height": 100, "items": [
 {"id": 0, "demand": 2, "allowed_orientations": [0, 180],
  "shape": {"type": "simple_polygon", "data": [[0, 0], [30, 0], [30, 20], [10, 20]]}},
 {"id": 1, "demand": 1, "shape": {"type": "simple_polygon", "data": [[0, 0], [25, 0], [0, 25]]}}]})";

TEST(CliLayout, PlacementsGoOutAndComeBack) {
  const TemporaryFolder folder;
  write_bytes(folder / "roll.json", kStrip);
  write_bytes(folder / "roll.commands",
              "lekalo-commands/1\nplace 0 strip 0 1 0 5 5 upright\nfit 0 strip 0\nfit 1 strip 0\n");
  const Ran edited =
      run(folder.path(), {"edit", "roll.json", "--commands", "roll.commands", "-o", "layout.json"});
  ASSERT_EQ(edited.status, 0) << edited.err;
  const Ran out = run(folder.path(), {"export", "layout.json", "--format", "placements", "--instance-name",
                                      "roll.json", "-o", "placed.json"});
  ASSERT_EQ(out.status, 0) << out.err;
  const Json placed = Json::parse(read_bytes(folder / "placed.json"));
  EXPECT_EQ(placed["instance"], "roll.json");
  EXPECT_EQ(placed["placements"].size(), 3U);
  const Ran check = run(folder.path(), {"check", "placed.json", "--json"});
  EXPECT_EQ(check.status, 0) << check.err;
  EXPECT_EQ(check.json()["work"], 3);
  // Out again: the items are still known by name, and nothing has moved.
  const Ran again = run(folder.path(), {"export", "placed.json", "--format", "placements"});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.out, read_bytes(folder / "placed.json"));
  // A layout as a layout is itself.
  EXPECT_EQ(run(folder.path(), {"export", "layout.json"}).out, read_bytes(folder / "layout.json"));
  // From placements a layout comes that says the same.
  ASSERT_EQ(run(folder.path(), {"export", "placed.json", "-o", "back.json"}).status, 0);
  const Json sheets = run(folder.path(), {"show", "layout.json", "--json"}).json()["sheets"];
  EXPECT_EQ(run(folder.path(), {"show", "back.json", "--json"}).json()["sheets"], sheets);
}

TEST(CliLayout, PlacementsFindTheFileOfTheirItems) {
  const TemporaryFolder folder;
  write_bytes(folder / "roll.json", kStrip);
  fs::create_directory(folder / "plans");
  fs::create_directory(folder / "far");
  const std::string placements =
      R"({"instance": "INSTANCE", "strip_height": 100, "placements": [{"item": 1, "rotation": 90, "x": 40, "y": 3}]})";
  const auto write = [&](const std::string& path, const std::string& instance) {
    std::string text = placements;
    write_bytes(folder / path, text.replace(text.find("INSTANCE"), 8, instance));
  };
  write("beside.json", "roll.json");
  write("plans/above.json", "roll.json");
  write("last-name.json", "elsewhere/roll.json");
  write("far/lost.json", "nowhere.json");
  for (const char* path : {"beside.json", "plans/above.json", "last-name.json"}) {
    const Ran ran = run(folder.path(), {"check", path});
    EXPECT_EQ(ran.status, 0) << path << ran.err;
  }
  const Ran lost = run(folder.path(), {"check", "far/lost.json"});
  EXPECT_EQ(lost.status, 3);
  EXPECT_NE(sentence(lost).find("name it with --instance"), std::string::npos) << lost.err;
  EXPECT_EQ(run(folder.path(), {"check", "far/lost.json", "--instance", "roll.json"}).status, 0);
  const Ran useless = run(folder.path(), {"check", "roll.json", "--instance", "beside.json"});
  EXPECT_EQ(useless.status, 0);
  EXPECT_NE(useless.err.find("--instance has no effect"), std::string::npos) << useless.err;
}

TEST(CliLayout, DrawingsOfPartsGoStraightIn) {
  const TemporaryFolder folder;
  write_bytes(folder / "part.svg",
              R"(<svg xmlns="http://www.w3.org/2000/svg" width="40mm" height="30mm" viewBox="0 0 40 30">
<path id="sole" d="M 5 5 H 35 V 25 H 5 Z"/><circle id="heel" cx="20" cy="15" r="4"/></svg>)");
  fs::copy(fs::path(cases::source_dir()) / "tests/corpus/data/dxf/1x1rectangle.dxf", folder / "part.dxf");
  for (const char* part : {"part.svg", "part.dxf"}) {
    const Ran shown = run(folder.path(), {"show", part, "--picture", "part.png", "--json"});
    ASSERT_EQ(shown.status, 0) << shown.err;
    EXPECT_EQ(shown.json()["parts"].size(), 1U);
    EXPECT_EQ(read_bytes(folder / "part.png").substr(1, 3), "PNG");
    const Ran checked = run(folder.path(), {"check", part});
    EXPECT_EQ(checked.status, 0) << checked.err;
    EXPECT_NE(checked.err.find("Nothing is placed"), std::string::npos) << checked.err;
  }
}

TEST(CliLayout, EditCarriesOutTheCommandsOfTheShoes) {
  const TemporaryFolder folder;
  const Ran ran =
      run(folder.path(), {"edit", kShoes + ".json", "--commands", kShoes + ".commands", "-o", "shoes.json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("10 placed, no rule is broken"), std::string::npos) << ran.err;
  const Ran check = run(folder.path(), {"check", "shoes.json"});
  EXPECT_EQ(check.status, 0) << check.err;
  const Json show = run(folder.path(), {"show", "shoes.json", "--json"}).json();
  EXPECT_EQ(show["kits"][0]["complete"], 1);
}

TEST(CliLayout, TheSameCommandsGiveTheSameBytes) {
  const TemporaryFolder folder;
  Json layout = plain();
  place(layout, "square", 5, 5);
  place(layout, "collar", 30, 30);
  write_layout(folder, "order.json", layout);
  write_bytes(
      folder / "c.txt",
      "lekalo-commands/1\r\n# every kind of motion\r\nfit square s 0\nmove 1 by 0.1 20.2\nrotate 2 180\n"
      "slide 2 towards -1 -0.3\nslide-along 2 by 20 1\nsettle 2 towards 1 0 then 0 -1\npush 1 by 12 0\n"
      "nearest 3 by 40 40\nsnap 1 within 60\nfit square s 0\nlock 3\ncompact s 0 towards -1 -1\n");
  const Words edit{"edit", "order.json", "--commands", "c.txt"};
  const Ran first = run(folder.path(), edit);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.err.find("4 placed, no rule is broken"), std::string::npos) << first.err;
  ASSERT_EQ(run(folder.path(), edit + Words{"-o", "out.json"}).status, 0);
  EXPECT_EQ(read_bytes(folder / "out.json"), first.out);
  EXPECT_EQ(run(folder.path(), {"check", "out.json"}).status, 0);
}

TEST(CliLayout, EditRefusesWhatBreaksARuleAndWritesNothing) {
  const TemporaryFolder folder;
  Json layout = plain();
  place(layout, "square", 5, 5);
  place(layout, "square", 20, 5);
  write_layout(folder, "order.json", layout);
  write_bytes(folder / "out.json", "old");
  const auto edit = [&](const std::string& commands) {
    write_bytes(folder / "c.txt", commands);
    return run(folder.path(), {"edit", "order.json", "--commands", "c.txt", "-o", "out.json"});
  };
  struct Case {
    std::string commands;
    int status;
    std::string named;
  };
  const Case refused[] = {
      {"lekalo-commands/1\n\n# closer\nmove 2 by -4 0\n", 4, "c.txt, line 4: not admitted"},
      {"lekalo-commands/1\nmove 2 by 90 0\n", 4, "outside"},
      {"lekalo-commands/1\nmove 2 by -10 0\n", 4, "overlap"},
      {"lekalo-commands/1\nflip 2\n", 4, "mirror"},
      {"lekalo-commands/1\nmvoe 2 by -4 0\n", 3,
       "c.txt, line 2: there is no command 'mvoe'; there are place"},
      {"lekalo-commands/1\nmove 2 by x 0\n", 3, "line 2: 'x' is no number"},
      {"lekalo-commands/1\nmove 2 by 1e999 0\n", 3, "line 2: '1e999' is no number"},
      {"lekalo-commands/1\nmove 2 by 1\n", 3, "line 2: the line ends too early"},
      {"lekalo-commands/1\nmove 2 by 1 0 0\n", 3, "line 2: '0' is left over"},
      {"lekalo-commands/1\nfit sole s 0\n", 3, "there is no part \"sole\"; there are \"square\", \"collar\""},
      {"lekalo-commands/1\nfit square s 1\n", 2, "stock 's' has 1 copy, counted from 0; there is no copy 1"},
      {"lekalo-commands/1\nmove 7 by 1 0\n", 2, "line 2: there is no placement 7"},
      {"lekalo-commands/1\nlock 2\nmove 2 by 1 0\n", 2, "line 3: placement 2 is locked; unlock it first"},
      {"move 2 by 1 0\n", 3, "line 1: a log of commands begins with 'lekalo-commands/1'"},
      {"", 3, "c.txt: is empty"},
  };
  for (const Case& one : refused) {
    SCOPED_TRACE(one.commands);
    const Ran ran = edit(one.commands);
    EXPECT_EQ(ran.status, one.status) << ran.err;
    EXPECT_NE(sentence(ran).find(one.named), std::string::npos) << ran.err;
    EXPECT_EQ(read_bytes(folder / "out.json"), "old");
  }
  // Free: it is done, and said.
  const Ran free = edit("lekalo-commands/1\nmode free\nmove 2 by -10 0\n");
  EXPECT_EQ(free.status, 1) << free.err;
  EXPECT_NE(free.err.find("2 placed, 1 violation; lekalo check says which and where"), std::string::npos)
      << free.err;
  EXPECT_EQ(run(folder.path(), {"check", "out.json"}).status, 1);
}

TEST(CliLayout, HelpAndCompletionKnowTheCommands) {
  const TemporaryFolder folder;
  const std::string help = run(folder.path(), {"--help"}).out;
  const std::string completion = run(folder.path(), {"completion", "bash"}).out;
  for (const char* command : {"check", "show", "export", "edit"}) {
    EXPECT_NE(help.find(std::string("\n  ") + command), std::string::npos) << help;
    EXPECT_NE(completion.find(command), std::string::npos) << command;
    const Ran ran = run(folder.path(), {command, "--help"});
    EXPECT_EQ(ran.status, 0);
    EXPECT_NE(ran.out.find("Exit codes: 0 "), std::string::npos) << ran.out;
  }
  for (const char* option : {"--commands", "--instance", "--format"})
    EXPECT_NE(completion.find(option), std::string::npos) << option;
}

}  // namespace
}  // namespace lekalo::test::cli_layout_test

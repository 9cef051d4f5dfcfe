#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "e2e/cli_run.hpp"

namespace lekalo::test::cli_order_test {
namespace {

std::string square_svg(int side) {
  const std::string s = std::to_string(side);
  return "<svg xmlns='http://www.w3.org/2000/svg' width='" + s + "mm' height='" + s + "mm' viewBox='0 0 " +
         s + " " + s + "'><rect width='" + s + "' height='" + s + "'/></svg>";
}

/// A folder with drawings: side.svg, lids/a.svg, lids/b.svg.
struct Shop : TemporaryFolder {
  Shop() {
    fs::create_directory(path() / "lids");
    write_bytes(*this / "side.svg", square_svg(40));
    write_bytes(*this / "lids/a.svg", square_svg(20));
    write_bytes(*this / "lids/b.svg", square_svg(10));
  }
  [[nodiscard]] Ran operator()(const Words& words) const { return run(path(), words); }
};

const Words kSheet{"--sheet", "200x100=2", "--gap", "4", "--border", "10", "--rotations", "0,90"};

TEST(CliOrder, ALineATableAndAFolderGiveTheSameBytes) {
  const Shop shop;
  const Words search{"--work", "100000"};
  const Ran line = shop(Words{"nest", "--part", "side.svg=4", "--part", "lids/*.svg=2"} + kSheet + search);
  ASSERT_EQ(line.status, 0) << line.err;
  const Json layout = line.json();
  ASSERT_EQ(layout["parts"].size(), 3u);
  EXPECT_EQ(layout["parts"][0]["id"], "side");
  EXPECT_EQ(layout["parts"][0]["demand"], 4);
  EXPECT_EQ(layout["parts"][2]["id"], "b");
  EXPECT_EQ(layout["rules"]["gap"], 4);
  EXPECT_EQ(layout["placements"].size(), 8u);

  write_bytes(shop / "order.csv", "quantity;file\n4;side.svg\n2;lids/*.svg\n");
  EXPECT_EQ(shop(Words{"nest", "--order", "order.csv"} + kSheet + search).out, line.out);
  const Ran folder = shop(Words{"nest", "--part", "side.svg=4", "--part", "lids=2"} + kSheet + search);
  EXPECT_EQ(folder.out, line.out);
  const Ran positional = shop(Words{"nest", "side.svg", "--part", "lids/a.svg"} + kSheet + search);
  EXPECT_EQ(positional.status, 0) << positional.err;
  EXPECT_EQ(positional.json()["placements"].size(), 2u);
}

TEST(CliOrder, ATableIsReadFromStandardInput) {
  const Shop shop;
  write_bytes(shop / "order.csv", "file,quantity\nside.svg,2\n");
  const Ran from_file = shop({"new", "--order", "order.csv", "--strip", "50cm"});
  ASSERT_EQ(from_file.status, 0) << from_file.err;
  const std::string command = "cd '" + shop.path().string() + "' && '" + cases::program() +
                              "' new --order - --strip 50cm < order.csv > piped.json 2> piped.txt";
  ASSERT_EQ(std::system(command.c_str()), 0) << read_bytes(shop / "piped.txt");
  EXPECT_EQ(read_bytes(shop / "piped.json"), from_file.out);
}

TEST(CliOrder, NewWritesWhatNestWouldPlace) {
  const Shop shop;
  const Words order = Words{"--part", "side.svg=4", "--part", "lids=1"} + kSheet;
  ASSERT_EQ(shop(Words{"new", "-o", "job.json"} + order).status, 0);
  const Json job = Json::parse(read_bytes(shop / "job.json"));
  EXPECT_TRUE(!job.contains("placements") || job["placements"].empty());
  const Ran by_file = shop({"nest", "job.json", "--work", "1000"});
  EXPECT_EQ(by_file.status, 0) << by_file.err;
  EXPECT_EQ(by_file.out, shop(Words{"nest", "--work", "1000"} + order).out);
}

/// Twenty rings of 400 corners take far longer to read than a hundredth of a second.
TEST(CliOrder, DrawingsThatTakeLongerToReadThanTheTimeArePlaced) {
  const Shop shop;
  std::string rings =
      "<svg xmlns='http://www.w3.org/2000/svg' width='2000mm' height='100mm' viewBox='0 0 2000 100'>";
  for (int ring = 0; ring < 20; ++ring) {
    rings += "<path d='M";
    for (int corner = 0; corner < 400; ++corner) {
      const double angle = 6.283185307179586 * corner / 400, radius = 40 + corner % 2;
      rings += fmt::format(" {:.4f} {:.4f}", 50 + 100 * ring + radius * std::cos(angle),
                           50 + radius * std::sin(angle));
    }
    rings += " z'/>";
  }
  write_bytes(shop / "rings.svg", rings + "</svg>");
  const Ran ran = shop({"nest", "--part", "rings.svg", "--sheet", "1000x500", "--time", "0.01"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["placements"].size(), 20u);
}

TEST(CliOrder, LengthsHaveUnits) {
  const Shop shop;
  const auto gap_of = [&](const std::string& word) {
    const Ran ran = shop({"new", "--part", "side.svg", "--sheet", "4x2ft", "--gap", word});
    EXPECT_EQ(ran.status, 0) << word << ": " << ran.err;
    return ran.status == 0 ? ran.json()["rules"]["gap"].get<double>() : -1;
  };
  EXPECT_NEAR(gap_of("1/8in"), 3.175, 1e-6);
  EXPECT_NEAR(gap_of("1 1/2 in"), 38.1, 1e-6);
  EXPECT_NEAR(gap_of("3 mm"), 3, 1e-6);
  EXPECT_NEAR(gap_of("0.5cm"), 5, 1e-6);
  EXPECT_NEAR(gap_of("2ft"), 609.6, 1e-6);
  EXPECT_NEAR(gap_of("2'"), 609.6, 1e-6);
  EXPECT_NEAR(gap_of("0.25\""), 6.35, 1e-6);
  const Json sheet = shop({"new", "--part", "side.svg", "--sheet", "4x2ft"}).json();
  EXPECT_EQ(sheet["stocks"][0]["outline"]["polygon"]["outer"][2], Json::parse("[1219.2, 609.6]"));
}

TEST(CliOrder, TheLastEqualsWithDigitsIsTheNumber) {
  const Shop shop;
  write_bytes(shop / "a=2.svg", square_svg(5));
  const Json layout = shop({"new", "--part", "a=2.svg=3", "--sheet", "50x50"}).json();
  EXPECT_EQ(layout["parts"][0]["id"], "a=2");
  EXPECT_EQ(layout["parts"][0]["demand"], 3);
  EXPECT_EQ(shop({"new", "--part", "a=2.svg", "--sheet", "50x50"}).json()["parts"][0]["demand"], 1);
}

TEST(CliOrder, EverythingThatIsMissingIsToldAtOnce) {
  const Shop shop;
  const Ran nothing = shop({"new"});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_NE(nothing.err.find("no part is ordered"), std::string::npos) << nothing.err;
  EXPECT_NE(nothing.err.find("there is no sheet"), std::string::npos) << nothing.err;
  const Ran files = shop({"nest", "--part", "nix/*.dxf=3", "--part", "gone.svg", "--order", "gone.csv",
                          "--sheet", "gone-too.dxf", "-o", "out.json"});
  EXPECT_EQ(files.status, 3);
  for (const char* name : {"nix/*.dxf", "gone.svg", "gone.csv", "gone-too.dxf"})
    EXPECT_NE(files.err.find(name), std::string::npos) << files.err;
  EXPECT_FALSE(fs::exists(shop / "out.json"));
  const Ran half = shop({"nest", "--part", "side.svg", "--sheet", "10x"});
  EXPECT_EQ(half.status, 3);
  EXPECT_NE(half.err.find("--sheet: 10x is neither a size, as 3000x1500, nor a file"), std::string::npos)
      << half.err;
  const Ran words = shop({"nest", "--part", "side.svg=0", "--sheet", "0x5", "--gap", "2q", "--grain", "up"});
  EXPECT_EQ(words.status, 2);
  for (const char* option : {"--part", "--sheet", "--gap", "--grain"})
    EXPECT_NE(words.err.find(std::string(option) + ": "), std::string::npos) << words.err;
}

TEST(CliOrder, ADrawingAloneIsToldHowToSaySheets) {
  const Shop shop;
  const Ran alone = shop({"nest", "side.svg"});
  EXPECT_EQ(alone.status, 2);
  EXPECT_NE(alone.err.find("--sheet 3000x1500"), std::string::npos) << alone.err;
  EXPECT_EQ(shop({"nest", "side.svg", "--sheet", "50x50", "--work", "1"}).status, 0);
}

TEST(CliOrder, ALayoutIsNotMixedWithAnOrder) {
  const Shop shop;
  ASSERT_EQ(shop(Words{"new", "--part", "side.svg", "-o", "job.json"} + kSheet).status, 0);
  EXPECT_EQ(shop({"nest", "job.json", "--gap", "3"}).status, 2);
  const Ran mixed = shop({"nest", "job.json", "--sheet", "300x300"});
  EXPECT_EQ(mixed.status, 3);
  EXPECT_NE(mixed.err.find("give it alone"), std::string::npos) << mixed.err;
}

TEST(CliOrder, AnOutputNeverReplacesADrawing) {
  const Shop shop;
  const std::string before = read_bytes(shop / "side.svg");
  EXPECT_EQ(shop(Words{"new", "--part", "side.svg", "-o", "side.svg"} + kSheet).status, 2);
  EXPECT_EQ(read_bytes(shop / "side.svg"), before);
}

TEST(CliOrder, TheReportNamesEveryFile) {
  const Shop shop;
  write_bytes(shop / "sheet.svg", square_svg(150));
  const Ran ran =
      shop({"nest", "--part", "lids=1", "--sheet", "sheet.svg=1", "--work", "1", "--json", "-o", "out.json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json inputs = ran.json()["inputs"];
  ASSERT_EQ(inputs.size(), 3u);
  EXPECT_EQ(inputs[0]["path"], "lids/a.svg");
  EXPECT_EQ(inputs[2]["role"], "sheet");
}

TEST(CliOrder, GrainHoldsPartsAlongTheStock) {
  const Shop shop;
  const Json layout =
      shop({"new", "--part", "side.svg", "--sheet", "90x90", "--grain", "y", "--mirror"}).json();
  EXPECT_EQ(layout["parts"][0]["grain"]["deg"], 90);
  EXPECT_EQ(layout["stocks"][0]["grain_deg"], 90);
  EXPECT_EQ(layout["parts"][0]["mirror"], true);
}

/// An order of steel in two thicknesses and of birch.
struct Works : Shop {
  Works() {
    write_bytes(*this / "order.csv",
                "file;quantity;material;thickness;customer;due;label\n"
                "side.svg;4;steel;2;Orlova;2026-12-01;order 7\n"
                "lids/a.svg;3;birch plywood;9;;;\n"
                "lids/b.svg;5;steel;1/16in;;;\n"
                "lids/a.svg;2;steel;2mm;Petrov;;\n");
  }
  /// What is in the folder, but for the drawings and the order.
  [[nodiscard]] std::vector<std::string> written() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(path()))
      if (const std::string name = entry.path().filename(); name.rfind("out", 0) == 0) names.push_back(name);
    std::sort(names.begin(), names.end());
    return names;
  }
};
const Words kSheets{"--sheet", "200x100@steel:2",   "--sheet", "90x60=3@birch plywood:9",
                    "--sheet", "50x50@steel:1/16in"};
const Words kNestWorks = Words{"nest", "--order", "order.csv", "--work", "1000", "-o", "out.json"};

TEST(CliOrder, EachMaterialBecomesALayoutWithItsPicture) {
  const Works shop;
  const Ran ran = shop(kNestWorks + kSheets + Words{"--picture", "out.svg"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(shop.written(), (std::vector<std::string>{"out-birch-plywood-9.json", "out-birch-plywood-9.svg",
                                                      "out-steel-1.5875.json", "out-steel-1.5875.svg",
                                                      "out-steel-2.json", "out-steel-2.svg"}));
  for (const char* line :
       {"steel, 2 mm: 6 placed, 0 missing, 1 sheet, density 36.000 %", "Written: out-steel-2.json",
        "birch plywood, 9 mm: 3 placed, 0 missing, 1 sheet", "in all: 14 placed, 0 missing, 3 sheets"})
    EXPECT_NE(ran.err.find(line), std::string::npos) << line << "\n" << ran.err;
  const Json steel = Json::parse(read_bytes(shop / "out-steel-2.json"));
  ASSERT_EQ(steel["parts"].size(), 2u);
  const Json& side = steel["parts"][0];
  EXPECT_EQ(side["material"], "steel");
  EXPECT_EQ(side["thickness"], 2);
  EXPECT_EQ(side["customer"], "Orlova");
  EXPECT_EQ(side["due"], "2026-12-01");
  EXPECT_EQ(side["label"], "order 7");
  EXPECT_EQ(steel["stocks"][0]["material"], "steel");
  EXPECT_EQ(steel["stocks"][0]["thickness"], 2);
  EXPECT_FALSE(steel["parts"][1].contains("due"));
  for (const char* name : {"out-steel-2.json", "out-birch-plywood-9.json", "out-steel-1.5875.json"})
    EXPECT_EQ(shop({"verify", name}).status, 0) << name;

  // What is said of a part outlives a correction by hand.
  write_bytes(shop / "words.txt", "lekalo-commands/1\nlock 1\n");
  ASSERT_EQ(shop({"edit", "out-steel-2.json", "--commands", "words.txt", "-o", "edited.json"}).status, 0);
  EXPECT_EQ(Json::parse(read_bytes(shop / "edited.json"))["parts"][0], side);
}

TEST(CliOrder, TheReportOfSeveralMaterialsIsVerified) {
  const Works shop;
  const Ran ran = shop(kNestWorks + kSheets + Words{"--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json report = ran.json();
  EXPECT_EQ(report["format"]["name"], "lekalo-order");
  EXPECT_EQ(report["status"], "complete");
  ASSERT_EQ(report["layouts"].size(), 3u);
  EXPECT_EQ(report["layouts"][1]["material"], "birch plywood");
  EXPECT_EQ(report["layouts"][1]["thickness"], 9);
  EXPECT_EQ(report["layouts"][1]["placed"], 3);
  EXPECT_EQ(report["placed"], 14);
  EXPECT_EQ(report["missing"], 0);
  EXPECT_EQ(report["sheets"], 3);
  const double parts = 4 * 1600 + 2 * 400 + 3 * 400 + 5 * 100, sheets = 20000 + 5400 + 2500;
  EXPECT_NEAR(report["density"].get<double>(), parts / sheets, 1e-9);
  EXPECT_EQ(report["outputs"].size(), 3u);
  EXPECT_EQ(report["inputs"].size(), 4u);
  write_bytes(shop / "r.json", ran.out);
  const Ran verified = shop({"verify", "r.json"});
  EXPECT_EQ(verified.status, 1) << verified.err;
  EXPECT_NE(verified.err.find("every rule and figure was rechecked for 14 placements in 3 layouts"),
            std::string::npos)
      << verified.err;
  Json lie = report;
  lie["layouts"][0]["thickness"] = 3;
  write_bytes(shop / "r.json", lie.dump());
  EXPECT_EQ(shop({"verify", "r.json"}).status, 4);
}

TEST(CliOrder, PiecesThatFindNoRoomAreCountedInTheirLayoutAndInAll) {
  const Works shop;
  const Ran ran = shop(kNestWorks + Words{"--json", "--sheet", "90x50=1@steel:2", "--sheet",
                                          "90x60@birch plywood:9", "--sheet", "50x50@steel:1/16in"});
  ASSERT_EQ(ran.status, 1) << ran.err;
  const Json report = ran.json();
  EXPECT_EQ(report["status"], "incomplete");
  EXPECT_EQ(report["missing"], report["layouts"][0]["missing"]);
  EXPECT_EQ(report["layouts"][1]["missing"], 0);
  EXPECT_GT(report["missing"].get<int>(), 0);
  EXPECT_EQ(shop.written().size(), 3u);
  write_bytes(shop / "r.json", ran.out);
  EXPECT_EQ(shop({"verify", "r.json"}).status, 1);
}

TEST(CliOrder, NewWritesALayoutForEachMaterialAndNestGivesTheSameBytes) {
  const Works shop;
  const Ran made = shop(Words{"new", "--order", "order.csv", "-o", "job.json"} + kSheets);
  ASSERT_EQ(made.status, 0) << made.err;
  ASSERT_EQ(shop(kNestWorks + kSheets).status, 0);
  for (const char* word : {"steel-2", "steel-1.5875", "birch-plywood-9"})
    EXPECT_EQ(shop({"nest", std::string("job-") + word + ".json", "--work", "1000"}).out,
              read_bytes(shop / (std::string("out-") + word + ".json")));
}

TEST(CliOrder, OneMaterialIsOneFileAsBefore) {
  const Shop shop;
  const Words nest = Words{"nest", "--part", "side.svg=4", "--work", "1000"} + kSheet;
  const Ran plain = shop(nest);
  write_bytes(shop / "order.csv", "file,quantity,material,thickness\nside.svg,4,steel,2\n");
  const Ran ran = shop(Words{"nest", "--order", "order.csv", "--work", "1000", "-o", "out.json"} + kSheet);
  ASSERT_EQ(ran.status, 0) << ran.err;
  Json layout = Json::parse(read_bytes(shop / "out.json"));
  for (const char* list : {"parts", "stocks"}) {
    EXPECT_EQ(layout[list][0]["material"], "steel");
    layout[list][0].erase("material");
    layout[list][0].erase("thickness");
  }
  EXPECT_EQ(layout, plain.json());
}

TEST(CliOrder, OfSeveralLayoutsAllAreWrittenOrNone) {
  const Works shop;
  fs::create_directory(shop / "out-steel-1.5875.json");
  const Ran folder = shop(kNestWorks + kSheets);
  EXPECT_EQ(folder.status, 5);
  EXPECT_NE(folder.err.find("--output: out-steel-1.5875.json is a folder"), std::string::npos) << folder.err;
  EXPECT_EQ(shop.written(), std::vector<std::string>{"out-steel-1.5875.json"});
}

TEST(CliOrder, WhatIsWrongWithMaterialsIsOneSentence) {
  const Works shop;
  write_bytes(shop / "unsaid.csv", "file,material\nside.svg,steel\nlids/a.svg,\n");
  write_bytes(shop / "thick.csv", "file,thickness\nside.svg,thick\n");
  write_bytes(shop / "day.csv", "file,due\nside.svg,2026-02-30\n");
  const Words order{"nest", "--order", "order.csv", "-o", "out.json"};
  struct Case {
    Words words;
    int status;
    const char* told;
  };
  for (const Case& one : {
           Case{order + Words{"--sheet", "90x90@steel:2", "--sheet", "90x90@birch plywood:9"}, 3,
                "order.csv: line 4: there is no sheet of steel, 1.5875 mm; say it behind a sheet, as in "
                "3000x1500@steel:1.5875 (there are sheets of: steel, 2 mm; birch plywood, 9 mm)"},
           {order + Words{"--sheet", "90x90"}, 3, "order.csv: line 2: there is no sheet of steel, 2 mm"},
           {order + Words{"--sheet", "90x90@"}, 3, "there are sheets of: no material"},
           {Words{"nest", "--order", "unsaid.csv", "-o", "out.json", "--sheet", "90x90@steel", "--sheet",
                  "9x9@felt"},
            3, "unsaid.csv: line 3: there is no sheet of no material; say what it is of"},
           {Words{"nest", "--order", "order.csv"} + kSheets, 2,
            "the order is of 3 materials (steel, 2 mm; birch plywood, 9 mm; steel, 1.5875 mm), and each gets "
            "a layout "
            "of its own; say --output FILE"},
           {Words{"new", "--order", "order.csv"} + kSheets, 2,
            "say --output FILE, as in out.json for out-steel-2.json"},
           {order + Words{"--sheet", "90x90@steel:thick"}, 2,
            "--sheet: \"90x90@steel:thick\" has the thickness 'thick', which is no length"},
           {order + Words{"--sheet", "90x90=0@steel:2"}, 2,
            "does not end in a number from 1 to 1,000,000,000"},
           {order + Words{"--strip", "90=3@steel:2"}, 2, "has a number of pieces; there is one of a strip"},
           {order + Words{"--strip", "90@steel:"}, 2, "--strip: \"90@steel:\" has the thickness ''"},
           {order + Words{"--part", "side.svg@:0", "--sheet", "90x90"}, 2,
            "--part: \"side.svg@:0\" has the thickness"},
           {Words{"nest", "--order", "thick.csv", "-o", "out.json", "--sheet", "90x90"}, 3,
            "thick.csv: line 2: the thickness 'thick' is not a length"},
           {Words{"nest", "--order", "day.csv", "-o", "out.json", "--sheet", "90x90"}, 3,
            "day.csv: line 2: the due '2026-02-30' is not a day, as 2026-12-01"},
       }) {
    const Ran ran = shop(one.words);
    EXPECT_EQ(ran.status, one.status) << ran.err;
    EXPECT_NE(ran.err.find(one.told), std::string::npos) << one.told << "\n" << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_TRUE(shop.written().empty()) << one.told;
  }
}

/// Two of a pair have 4 bookcases, 4 frames, so 4 * 2 + 2 * 1 = 10 sides and 4 * 3 = 12 of b.
const char* const kBill =
    "assembly,file,quantity\npair,bookcase,2\npair,side.svg,1\nbookcase,frame,1\nbookcase,lids/b.svg,3\n"
    "frame,side.svg,2\n";

TEST(CliOrder, ABillOfMaterialsIsMultipliedOut) {
  const Shop shop;
  write_bytes(shop / "bill.csv", kBill);
  const Ran built = shop({"new", "--order", "bill.csv", "--build", "pair=2", "--sheet", "200x100"});
  ASSERT_EQ(built.status, 0) << built.err;
  const Ran flat = shop({"new", "--part", "side.svg=10", "--part", "lids/b.svg=12", "--sheet", "200x100"});
  ASSERT_EQ(flat.status, 0) << flat.err;
  EXPECT_EQ(built.out, flat.out);
  const Ran nested = shop({"nest", "--order", "bill.csv", "--build", "frame", "--build", "bookcase=1",
                           "--sheet", "200x100", "--work", "1"});
  ASSERT_EQ(nested.status, 0) << nested.err;
  EXPECT_EQ(nested.json()["placements"].size(), 4u + 3u);
}

TEST(CliOrder, WhatIsWrongWithABillIsOneSentence) {
  const Shop shop;
  write_bytes(shop / "bill.csv", kBill);
  write_bytes(shop / "order.csv", "file,quantity\nside.svg,1\n");
  write_bytes(shop / "circle.csv", "assembly,file\ndesk,drawer\ndrawer,desk\n");
  write_bytes(shop / "gone.csv", "assembly,file\ndesk,drawer\n");
  write_bytes(shop / "many.csv", "assembly,file,quantity\ndesk,drawer,1000000\ndrawer,side.svg,1001\n");
  write_bytes(shop / "unsaid.csv", "assembly,file\n,side.svg\n");
  const Words sheet{"--sheet", "200x100", "-o", "out.json"};
  struct Case {
    Words words;
    int status;
    const char* told;
  };
  for (const Case& one : {
           Case{{"--order", "bill.csv"},
                2,
                "say how many are built, as in --build cabinet=2; in no other assembly: 'pair'"},
           {{"--order", "bill.csv", "--build", "desk"},
            2,
            "--build: 'desk' is no assembly of bill.csv, which has 'pair', "},
           {{"--order", "bill.csv", "--build", "pair=0"},
            2,
            "--build: \"pair=0\" does not end in a number from 1"},
           {{"--order", "order.csv", "--build", "pair"}, 2, "--build: order.csv is no bill of materials"},
           {{"--part", "side.svg", "--build", "pair"},
            2,
            "--build says what is built of a bill of materials, which --order"},
           {{"--order", "circle.csv", "--build", "desk"},
            3,
            "circle.csv: line 2: 'drawer' is a part of itself ('drawer' in"},
           {{"--order", "gone.csv", "--build", "desk"}, 3, "gone.csv: line 2: drawer: "},
           {{"--order", "gone.csv", "--build", "desk"}, 3, "; and no line has it as its assembly"},
           {{"--order", "many.csv", "--build", "desk"},
            3,
            "many.csv: line 3: 1000000 of 'drawer', with 1001 of 'side.svg'"},
           {{"--order", "unsaid.csv", "--build", "desk"}, 3, "unsaid.csv: line 2: the assembly is missing"},
       }) {
    const Ran ran = shop(Words{"nest"} + one.words + sheet);
    EXPECT_EQ(ran.status, one.status) << ran.err;
    EXPECT_NE(ran.err.find(one.told), std::string::npos) << one.told << "\n" << ran.err;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    EXPECT_FALSE(fs::exists(shop / "out.json"));
  }
}

/// Bars and triangles; 12 bars and 4 triangles of 5 mm gap have room on the sheet.
std::string bar_svg(int width, int height) {
  return "<svg xmlns='http://www.w3.org/2000/svg' width='" + std::to_string(width) + "mm' height='" +
         std::to_string(height) + "mm' viewBox='0 0 " + std::to_string(width) + " " + std::to_string(height) +
         "'><rect width='" + std::to_string(width) + "' height='" + std::to_string(height) + "'/></svg>";
}

TEST(CliOrder, RowsWithEdgesInCommonAreNestedCutOnceAndVerified) {
  const Shop shop;
  write_bytes(shop / "bar.svg", bar_svg(80, 30));
  write_bytes(shop / "gusset.svg",
              "<svg xmlns='http://www.w3.org/2000/svg' width='60mm' height='40mm' viewBox='0 0 60 40'>"
              "<path d='M0 0 L60 0 L0 40 Z'/></svg>");
  const Words order{"nest",    "--part",   "bar.svg=12", "--part",      "gusset.svg=4",
                    "--sheet", "500x400",  "--kerf",     "0.4",         "--gap",
                    "5",       "--border", "8",          "--rotations", "0,90,180,270",
                    "--work",  "300000",   "-o",         "layout.json"};
  const Ran rows = shop(order + Words{"--common-line"});
  ASSERT_EQ(rows.status, 0) << rows.err;
  EXPECT_NE(rows.err.find("edges in common: "), std::string::npos) << rows.err;
  EXPECT_EQ(rows.err.find("none that are worth"), std::string::npos) << rows.err;
  EXPECT_EQ(shop({"check", "layout.json"}).status, 0);
  EXPECT_EQ(shop({"verify", "layout.json"}).status, 0);
  const Ran cut = shop({"export", "layout.json", "--format", "gcode", "--kerf", "0.4", "--feed", "2000",
                        "--lead-in", "2", "--common-line", "-o", "cut.nc"});
  ASSERT_EQ(cut.status, 0) << cut.err;
  EXPECT_NE(cut.err.find("are cut once, in "), std::string::npos) << cut.err;
  const Ran verified =
      shop({"verify", "cut.nc", "--layout", "layout.json", "--kerf", "0.4", "--common-line"});
  EXPECT_EQ(verified.status, 0) << verified.err;
  // Without the word nothing comes nearer than the gap.
  ASSERT_EQ(shop(order).status, 0);
  const Ran apart = shop({"export", "layout.json", "--format", "gcode", "--kerf", "0.4", "--feed", "2000",
                          "--common-line", "-o", "cut.nc"});
  ASSERT_EQ(apart.status, 0) << apart.err;
  EXPECT_EQ(apart.err.find("in common"), std::string::npos) << apart.err;

  const Ran no_kerf = shop({"nest", "--part", "bar.svg=2", "--sheet", "500x400", "--common-line"});
  EXPECT_EQ(no_kerf.status, 2);
  EXPECT_NE(no_kerf.err.find("--common-line belongs to an order, and --kerf MM says"), std::string::npos);
}

}  // namespace
}  // namespace lekalo::test::cli_order_test

#include <fmt/core.h>

#include <cmath>

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

}  // namespace
}  // namespace lekalo::test::cli_order_test

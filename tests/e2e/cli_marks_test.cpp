#include <fmt/core.h>

#include <string>

#include "e2e/cli_run.hpp"

/// Lines and texts inside a part, from a drawing to a cut sheet, as a person does it.
namespace lekalo::test::cli_marks_test {
namespace {

std::string line(double x0, double y0, double x1, double y1, const std::string& layer) {
  return fmt::format("0\nLINE\n8\n{}\n10\n{}\n20\n{}\n11\n{}\n21\n{}\n", layer, x0, y0, x1, y1);
}

/// A plate of 80 x 50 with a line to engrave, a bend, a dimension and two texts.
std::string plate() {
  return "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n" +
         line(0, 0, 80, 0, "CUT") + line(80, 0, 80, 50, "CUT") + line(80, 50, 0, 50, "CUT") +
         line(0, 50, 0, 0, "CUT") + line(10, 10, 30, 10, "ENG") + line(0, 30, 80, 30, "BEND") +
         line(10, 5, 20, 5, "DIM") +
         "0\nTEXT\n8\nENG\n62\n1\n10\n10\n20\n15\n40\n5\n1\nN 7\n0\nTEXT\n8\nENG\n10\n10\n20\n36\n40\n5\n1\n"
         "Жук\n0\nENDSEC\n0\nEOF\n";
}
const std::string kRules = R"({"format": "lekalo-layers/1", "layers": [{"name": "ENG", "role": "engrave"},
  {"name": "BEND", "role": "bend"}, {"name": "DIM", "role": "ignore"}]})";

TEST(CliMarks, FromADrawingToACutSheet) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.dxf", plate());
  write_bytes(folder / "layers.json", kRules);
  const Ran nested =
      run(folder.path(), {"nest", "--part", "plate.dxf=6", "--sheet", "300x200", "--gap", "2",
                          "--layer-rules", "layers.json", "-o", "nested.json", "--work", "1000"});
  ASSERT_EQ(nested.status, 0) << nested.err;
  EXPECT_NE(nested.err.find("1 line and 0 texts are on layers that layers.json says to ignore"),
            std::string::npos)
      << nested.err;
  for (const std::string form : {"dxf", "svg", "hpgl", "gcode"}) {
    Words words{"export", "nested.json", "--format", form, "-o", "out." + form};
    Words check{"verify", "out." + form, "--layout", "nested.json"};
    if (form == "gcode") {
      for (const char* const word : {"--kerf", "0.3", "--feed", "2000", "--engrave-feed", "4000"})
        words.push_back(word);
      check.insert(check.end(), {"--kerf", "0.3"});
    }
    const Ran made = run(folder.path(), words);
    ASSERT_EQ(made.status, 0) << made.err;
    if (form == "gcode") {
      EXPECT_NE(made.err.find("18 lines and texts are engraved before them"), std::string::npos) << made.err;
    }
    const Ran verified = run(folder.path(), check);
    EXPECT_EQ(verified.status, 0) << verified.out << verified.err;
  }
  const std::string dxf = read_bytes(folder / "out.dxf");
  EXPECT_NE(dxf.find("\nN 7\n"), std::string::npos);
  EXPECT_NE(dxf.find("\nЖук\n"), std::string::npos);
  EXPECT_EQ(dxf.find("\nDIM\n"), std::string::npos);
}

TEST(CliMarks, ATableThatIsWrongIsRefusedInOneSentence) {
  const TemporaryFolder folder;
  write_bytes(folder / "plate.dxf", plate());
  write_bytes(folder / "layers.json",
              R"({"format": "lekalo-layers/1", "layers": [{"name": "ENG", "role": "burn"}]})");
  for (const Words& words : {Words{"check", "plate.dxf", "--layer-rules", "layers.json"},
                             Words{"nest", "--part", "plate.dxf", "--sheet", "300x200", "--layer-rules",
                                   "layers.json", "-o", "nested.json"}}) {
    const Ran ran = run(folder.path(), words);
    EXPECT_EQ(ran.status, 3) << ran.err;
    EXPECT_NE(
        ran.err.find("layers.json: row 1: role 'burn' has to be one of cut, mark, engrave, bend and ignore"),
        std::string::npos)
        << ran.err;
  }
  EXPECT_EQ(folder.files().size(), 2U);
}

}  // namespace
}  // namespace lekalo::test::cli_marks_test

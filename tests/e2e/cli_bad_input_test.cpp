#include "e2e/cli_run.hpp"

/// Everything a person can do wrong, as a table: each case has its exit status, exactly one sentence on
/// stderr that names the file and the place, and leaves every file as it was.
namespace lekalo::test::cli_bad_input_test {
namespace {

struct BadInput {
  std::string name;
  std::map<std::string, std::string> files;  ///< over the plate's files
  Words words;
  int status;
  Words named;  ///< what the sentence has to contain
};

const Words kOutputs{"-o",      "out.json", "--picture", "out.svg",  "--deviations",
                     "out.csv", "--nc",     "part.nc",   "--nc-out", "out.nc"};
const Words kUsual = kLocatePlate + kOutputs;

/// Keeps the table readable in the test's output.
void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

BadInput bad_part(const std::string& name, const std::string& text, const Words& named) {
  return {name, {{"part.csv", text}}, kUsual, 3, Words{"part.csv"} + named};
}
BadInput bad_blank(const std::string& name, const std::string& text, const Words& named) {
  return {name, {{"blank.csv", text}}, kUsual, 3, Words{"blank.csv"} + named};
}
BadInput bad_words(const std::string& name, const Words& words, const Words& named) {
  return {name, {}, words, 2, named};
}
BadInput bad_program(const std::string& name, const std::string& text, const Words& named) {
  return {name, {{"part.nc", text}}, kUsual, 3, Words{"part.nc"} + named};
}

Words with_part(const std::string& path) {
  return Words{"locate", "--part", path, "--blank", "blank.csv"} + kOutputs;
}

Words plain(const std::string& part) {
  return {"locate", "--part", part, "--blank", "blank.csv", "-o", "out.json"};
}

std::vector<BadInput> contour_cases() {
  const std::string dxf_bulge =
      "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n90\n3\n70\n1\n10\n0\n20\n0\n42\n1\n10\n9\n20\n0\n10\n5\n20\n9"
      "\n0\n"
      "ENDSEC\n0\nEOF\n";
  const std::string dxf_open =
      "0\nSECTION\n2\nENTITIES\n0\nLINE\n10\n0\n20\n0\n11\n9\n21\n0\n0\nLINE\n10\n9\n20\n0\n11\n5\n21\n9\n0\n"
      "ENDSEC\n"
      "0\nEOF\n";
  return {
      bad_part("empty file", "", {}),
      bad_part("only comments", "# nothing\n; here\n", {}),
      bad_part("a word among numbers", "0 0\n80 0\n80 forty\n0 40\n", {"3", "forty"}),
      bad_part("one number on a line", "0 0\n80 0\n80\n0 40\n", {"3"}),
      bad_part("four numbers on a line", "0 0\n80 0 1 2\n80 40\n0 40\n", {"2"}),
      bad_part("decimal comma", "0,5 0,5\n80,5 0,5\n80,5 40,5\n0,5 40,5\n", {"1"}),
      bad_part("not a number", "0 0\n80 0\nnan nan\n0 40\n", {"3"}),
      bad_part("infinite", "0 0\n80 0\ninf 40\n0 40\n", {"3"}),
      bad_part("beyond all doubles", "0 0\n80 0\n1e999 40\n0 40\n", {"3"}),
      bad_part("two points", "0 0\n80 0\n", {}),
      bad_part("all on one line", "0 0\n10 10\n20 20\n30 30\n", {}),
      bad_part("all the same point", "5 5\n5 5\n5 5\n", {}),
      bad_part("a dent", "0 0\n40 5\n80 0\n80 40\n0 40\n", {"1"}),
      bad_part("a star that runs around twice", "10 0\n-8.1 5.9\n3.1 -9.5\n3.1 9.5\n-8.1 -5.9\n", {}),
      bad_blank("a bow tie", "0 0\n90 50\n90 0\n0 50\n", {}),
      bad_blank("a dent in the blank points to --trim", "0 0\n45 1\n90 0\n90 50\n0 50\n", {"--trim"}),
      bad_blank("binary rubbish", std::string("\x00\x01\xfe\xff\x7f", 5), {}),
      {"a missing part file", {}, with_part("nowhere.csv"), 3, {"nowhere.csv"}},
      {"a folder as part file", {}, with_part("."), 3, {"."}},
      {"an unknown ending", {{"part.png", kPlate}}, with_part("part.png"), 3, {"part.png"}},
      {"JSON that is not JSON", {{"p.json", "[[0, 0], [80, 0"}}, with_part("p.json"), 3, {"p.json"}},
      {"a JSON point with three numbers",
       {{"p.json", "[[0, 0], [80, 0, 1], [80, 40]]"}},
       with_part("p.json"),
       3,
       {"p.json", "1"}},
      {"a JSON point that is a word",
       {{"p.json", R"([[0, 0], [80, "x"], [80, 40]])"}},
       with_part("p.json"),
       3,
       {"p.json", "1"}},
      {"a JSON object without points", {{"p.json", R"({"lines": []})"}}, with_part("p.json"), 3, {"p.json"}},
      {"a JSON unit nobody knows",
       {{"p.json", R"({"units": "ell", "points": [[0, 0], [80, 0], [80, 40]]})"}},
       with_part("p.json"),
       3,
       {"p.json", "ell"}},
      {"a file in mm said to be in inches",
       {{"p.json", R"({"units": "mm", "points": [[0, 0], [80, 0], [80, 40]]})"}},
       with_part("p.json") + Words{"--units", "inch"},
       3,
       {"p.json"}},
      {"a DXF without entities",
       {{"p.dxf", "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n"}},
       with_part("p.dxf"),
       3,
       {"p.dxf"}},
      {"an arc and what only convex contours have",
       {{"p.dxf", dxf_bulge}},
       with_part("p.dxf"),
       2,
       {"--deviations"}},
      {"a DXF chain that does not close, any shape",
       {{"p.dxf", dxf_open}},
       plain("p.dxf"),
       3,
       {"p.dxf", "LINE"}},
      {"a DXF layer that is not there",
       {{"p.dxf", dxf_bulge}},
       plain("p.dxf") + Words{"--part-layers", "CUT"},
       3,
       {"p.dxf", "CUT"}},
      {"an SVG that is no XML", {{"p.svg", "<svg><path"}}, plain("p.svg"), 3, {"p.svg"}},
      {"a tree of nothing",
       {{"p.json", R"({"shape": {"union": []}})"}},
       plain("p.json"),
       3,
       {"p.json", "union"}},
      {"a scan that is cut off",
       {{"s.ply",
         "ply\nformat ascii 1.0\nelement vertex 9\nproperty float x\nproperty float y\nend_header\n0 0\n"}},
       {"locate", "--part", "part.csv", "--blank", "s.ply", "--uncertainty", "0.01", "-o", "out.json"},
       3,
       {"s.ply"}},
      {"a scan without uncertainty",
       {},
       {"locate", "--part", "part.csv", "--blank", "blank.csv", "--min-radius", "3", "-o", "out.json"},
       2,
       {"--uncertainty"}},
      {"a feature with a word nobody knows",
       {{"f.json", R"({"features": [{"name": "a", "edges": [0], "minimun": 1}]})"}},
       plain("part.csv") + Words{"--features", "f.json"},
       3,
       {"f.json", "minimun"}},
      {"a feature of an edge that the part has not",
       {{"f.json", R"({"features": [{"name": "a", "edges": [99]}]})"}},
       plain("part.csv") + Words{"--features", "f.json"},
       3,
       {"f.json", "99"}},
      {"a trade-off of one point", {}, plain("part.csv") + Words{"--trade-off", "1"}, 2, {"--trade-off"}},
      {"a DXF chain that does not close", {{"p.dxf", dxf_open}}, with_part("p.dxf"), 3, {"p.dxf"}},
      {"a dent deeper than --trim",
       {{"blank.csv", "100 100\n145 103\n190 100\n190 150\n100 150\n"}},
       kUsual + Words{"--trim", "0.5"},
       3,
       {"blank.csv"}},
  };
}

std::vector<BadInput> command_line_cases() {
  return {
      bad_words("no command", {}, {"--help"}),
      bad_words("an unknown command", {"allocate"}, {"allocate"}),
      bad_words("no part", Words{"locate", "--blank", "blank.csv"}, {"--part"}),
      bad_words("no layer", {"pocket", "part.csv", "--layer"}, {"--layer: needs a value after it"}),
      bad_words("no blank", Words{"locate", "--part", "part.csv"}, {"--blank"}),
      bad_words("an unknown option", kUsual + Words{"--fast"}, {"--fast"}),
      bad_words("an option misspelt", kUsual + Words{"--min-alowance", "3"},
                {"--min-alowance", "did you mean --min-allowance?"}),
      bad_words("an option of another command", {"verify", "out.json", "--gap", "1"}, {"--gap"}),
      bad_words("a word too many", kUsual + Words{"more"}, {"more"}),
      bad_words("an option twice", kUsual + Words{"--part", "blank.csv"}, {"--part", "more than once"}),
      bad_words("an option without its value", kLocatePlate + Words{"--gap"}, {"--gap", "a value"}),
      bad_words("an empty value", kLocatePlate + Words{"-o", ""}, {"-o"}),
      bad_words("a gap of 0", kUsual + Words{"--gap", "0"}, {"--gap", "0"}),
      bad_words("a gap that is no number", kUsual + Words{"--gap", "small"}, {"--gap", "small"}),
      bad_words("a gap of nan", kUsual + Words{"--gap", "nan"}, {"--gap", "nan"}),
      bad_words("an allowance below 0", kUsual + Words{"--min-allowance", "-1"}, {"--min-allowance", "-1"}),
      bad_words("an infinite allowance", kUsual + Words{"--min-allowance", "inf"},
                {"--min-allowance", "inf"}),
      bad_words("a number with a unit", kUsual + Words{"--min-allowance", "1mm"}, {"--min-allowance", "1mm"}),
      bad_words("a window with one end", kLocatePlate + Words{"--window", "10"}, {"--window", "2 values"}),
      bad_words("a window the wrong way round", kUsual + Words{"--window", "10", "-10"},
                {"--window", "10", "-10"}),
      bad_words("a window beyond two turns", kUsual + Words{"--window", "0", "1000"}, {"--window", "1000"}),
      bad_words("an unknown method", kUsual + Words{"--method", "guess"}, {"--method", "guess", "certified"}),
      bad_words("no starts", kUsual + Words{"--method", "ipopt", "--starts", "0"}, {"--starts", "0"}),
      bad_words("half a start", kUsual + Words{"--method", "ipopt", "--starts", "1.5"}, {"--starts", "1.5"}),
      bad_words("a negative seed", kUsual + Words{"--seed", "-1"}, {"--seed", "-1"}),
      bad_words("no work", kUsual + Words{"--work", "0"}, {"--work", "0"}),
      bad_words("no time", kUsual + Words{"--time", "0"}, {"--time", "0"}),
      bad_words("an unknown unit", kUsual + Words{"--units", "cm"}, {"--units", "cm", "inch"}),
      bad_words("a trim of 0", kUsual + Words{"--trim", "0"}, {"--trim", "0"}),
      bad_words("a picture of unknown kind", kLocatePlate + Words{"--picture", "out.bmp"},
                {"--picture", "out.bmp"}),
      bad_words("a certificate that ICP cannot make",
                kLocatePlate + Words{"--method", "icp", "--certificate", "out.cert"},
                {"--certificate", "icp"}),
      bad_words("alternatives that IPOPT cannot list",
                kLocatePlate + Words{"--method", "ipopt", "--alternatives", "1"},
                {"--alternatives", "ipopt"}),
      bad_words("a program without a place for the new one", kLocatePlate + Words{"--nc", "part.nc"},
                {"--nc-out"}),
      bad_words("a place for a program without one", kLocatePlate + Words{"--nc-out", "out.nc"}, {"--nc"}),
      bad_words("a mode without a program", kLocatePlate + Words{"--nc-mode", "g68"}, {"--nc-mode", "--nc"}),
      bad_words("an unknown mode", kUsual + Words{"--nc-mode", "g54"}, {"--nc-mode", "g54", "offset"}),
      bad_words("a work offset nobody has", kUsual + Words{"--wcs", "10"}, {"--wcs", "10"}),
      bad_words("an unknown scan frame", kUsual + Words{"--scan-frame", "table"}, {"--scan-frame", "table"}),
      bad_words("the result over the part", kLocatePlate + Words{"-o", "part.csv"},
                {"-o", "part.csv", "--part"}),
      bad_words("the program over itself", kLocatePlate + Words{"--nc", "part.nc", "--nc-out", "./part.nc"},
                {"--nc-out", "part.nc"}),
      bad_words("two outputs in one file",
                kLocatePlate + Words{"-o", "out.json", "--certificate", "./out.json"},
                {"-o", "--certificate", "out.json"}),
      bad_words("verify without a result", {"verify"}, {"result"}),
      bad_words("completion for an unknown shell", {"completion", "dos"}, {"dos", "bash"}),
  };
}

std::vector<BadInput> program_cases() {
  const auto with = [](const std::string& line) { return "G21 G90 G17 G54\nG0 X0 Y0\n" + line + "\nM2\n"; };
  return {
      bad_program("an empty program", "", {}),
      bad_program("an arc in G18", with("G18 G2 X10 Z10 I5 K5"), {":3"}),
      bad_program("an expression", with("G1 X[1+#7] F100"), {":3"}),
      bad_program("a variable that nothing sets", with("G0 X#7"), {":3"}),
      bad_program("machine coordinates", with("G53 G0 X0"), {":3"}),
      bad_program("a reference point", with("G28"), {":3"}),
      bad_program("a shift inside", with("G92 X0 Y0"), {":3"}),
      bad_program("a rotary axis", with("G1 A90 F100"), {":3"}),
      bad_program("a subprogram", with("M98 P1000"), {":3"}),
      bad_program("a word that is not on the list", with("G5.1 X1 Y1 I0 J1"), {":3"}),
      bad_program("a move before X is known", "G21 G90 G17 G54\nG1 Y10 F100\nM2\n", {":2"}),
  };
}

std::vector<BadInput> surroundings_cases() {
  const auto only = [](const Words& words) { return kLocatePlate + words; };
  return {
      {"a folder that does not exist", {}, only({"-o", "no/such/out.json"}), 5, {"no/such"}},
      {"a file as folder", {}, only({"-o", "part.nc/out.json"}), 5, {"part.nc"}},
      {"a folder as result", {}, only({"-o", "."}), 5, {"-o", "folder"}},
      {"a full device as result", {}, only({"-o", "/dev/full"}), 5, {"/dev/full"}},
      {"the device for nothing", {}, only({"-o", "/dev/null"}), 5, {"/dev/null"}},
      {"a folder that takes no files", {}, only({"-o", "/proc/out.json"}), 5, {"/proc/out.json"}},
      {"the second output has no folder",
       {},
       only({"-o", "out.json", "--picture", "no/such/out.svg"}),
       5,
       {"no/such"}},
      {"an earlier result that is none",
       {},
       only({"--compare", "part.csv", "-o", "out.json"}),
       3,
       {"part.csv"}},
      {"an earlier result of another kind",
       {{"last.json", R"({"format": {"name": "lekalo-verify", "version": 1}})"}},
       only({"--compare", "last.json", "-o", "out.json"}),
       3,
       {"last.json", "format"}},
      {"verify of a missing result", {}, {"verify", "nowhere.json"}, 3, {"nowhere.json"}},
      {"verify of a contour", {}, {"verify", "part.csv"}, 3, {"part.csv"}},
  };
}

class BadInputs : public testing::TestWithParam<BadInput> {};

TEST_P(BadInputs, GiveTheirExitStatusOneSentenceAndNoFile) {
  const BadInput& bad = GetParam();
  const TemporaryFolder folder;
  write_plate(folder);
  for (const auto& [name, bytes] : bad.files) write_bytes(folder / name, bytes);
  write_bytes(folder / "out.json", "the old result\n");  // has to survive
  write_bytes(folder / "out.nc", "the old program\n");
  const auto before = folder.files();

  const Ran ran = run(folder.path(), bad.words);

  EXPECT_EQ(ran.status, bad.status) << ran.err;
  EXPECT_EQ(ran.out, "");
  EXPECT_EQ(ran.err.rfind("lekalo: ", 0), 0U) << ran.err;
  EXPECT_EQ(ran.err.find('\n'), ran.err.size() - 1) << ran.err;
  EXPECT_GT(ran.err.size(), 20U) << ran.err;
  for (const std::string& word : bad.named) {
    EXPECT_NE(ran.err.find(word), std::string::npos) << "no \"" << word << "\" in: " << ran.err;
  }
  EXPECT_TRUE(folder.files() == before) << "a file appeared or changed";
}

std::string test_name(const testing::TestParamInfo<BadInput>& info) {
  std::string name;
  for (const char c : info.param.name) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Contours, BadInputs, testing::ValuesIn(contour_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(CommandLine, BadInputs, testing::ValuesIn(command_line_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(Programs, BadInputs, testing::ValuesIn(program_cases()), test_name);
INSTANTIATE_TEST_SUITE_P(Surroundings, BadInputs, testing::ValuesIn(surroundings_cases()), test_name);

}  // namespace
}  // namespace lekalo::test::cli_bad_input_test

#include "e2e/cli_run.hpp"

/// `lekalo verify` of what is no placement: layouts, reports, programs, exports.
namespace lekalo::test::cli_verify_claims_test {
namespace {

const fs::path kOrders = fs::path(cases::source_dir()) / "examples/orders";

/// One rectangle of 60 x 40 with a corner cut off, and a disc in it that stays.
const std::string kPocket = R"({"units": "mm", "outer": [{"line": {"from": [0, 0], "to": [60, 0]}},
 {"line": {"from": [60, 0], "to": [60, 30]}}, {"line": {"from": [60, 30], "to": [50, 40]}},
 {"line": {"from": [50, 40], "to": [0, 40]}}, {"line": {"from": [0, 40], "to": [0, 0]}}],
 "holes": [[{"arc": {"from": [24, 20], "to": [24, 20], "centre": [20, 20], "ccw": false}}]]})";

class CliVerifyClaims : public testing::Test {
 protected:
  [[nodiscard]] Ran lekalo(const Words& words) const { return run(folder_.path(), words); }
  /// Runs a command that has to succeed, and keeps its standard output in a file.
  void keep(const Words& words, const std::string& file = "") const {
    const Ran ran = lekalo(words);
    ASSERT_EQ(ran.status, 0) << ran.err;
    if (!file.empty()) write_bytes(folder_ / file, ran.out);
  }
  void expect(int status, const Words& words, const std::string& said = "") const {
    const Ran ran = lekalo(Words{"verify"} + words);
    EXPECT_EQ(ran.status, status) << ran.err;
    EXPECT_NE(ran.err.find(said), std::string::npos) << ran.err;
  }
  void nest() const {
    write_bytes(folder_ / "given.json", read_bytes(kOrders / "frames.json"));
    keep({"nest", "given.json", "--work", "3000", "--threads", "1", "-o", "nested.json", "--json"},
         "report.json");
  }
  void change(const std::string& file, const std::string& from, const std::string& to) const {
    std::string bytes = read_bytes(folder_ / file);
    const std::size_t at = bytes.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write_bytes(folder_ / file, bytes.replace(at, from.size(), to));
  }
  TemporaryFolder folder_;
};

TEST_F(CliVerifyClaims, ALayoutKeepsItsRulesAndTheLayoutItWasMadeFrom) {
  nest();
  expect(0, {"nested.json"}, "Confirmed");
  expect(0, {"nested.json", "--layout", "given.json"}, "Confirmed");
  write_bytes(folder_ / "other.json", read_bytes(kOrders / "brackets.json"));
  expect(4, {"nested.json", "--layout", "other.json"}, "layout it was made from");
  Json layout = Json::parse(read_bytes(folder_ / "nested.json"));
  Json cut = layout;
  cut["rules"]["kerf"] = 0.2;
  write_bytes(folder_ / "cut.json", cut.dump());
  expect(0, {"cut.json"}, "Confirmed");
  expect(4, {"cut.json", "--layout", "given.json"}, "the kerf is not that of the layout it was made from");
  layout.at("/placements/0/x") = layout.at("/placements/1/x");
  layout.at("/placements/0/y") = layout.at("/placements/1/y");
  layout.at("/placements/0")["copy"] = layout.at("/placements/1").value("copy", 0);
  write_bytes(folder_ / "nested.json", layout.dump());
  expect(4, {"nested.json"}, "is broken by placement");
}

TEST_F(CliVerifyClaims, AReportOfNestSaysWhatItsLayoutHas) {
  nest();
  expect(0, {"report.json"}, "Confirmed");
  change("report.json", "\"density\": 0.", "\"density\": 0.9");
  expect(4, {"report.json"}, "density is");
}

TEST_F(CliVerifyClaims, AReportOfNestIsOfTheVeryFiles) {
  nest();
  change("nested.json", "{", "{ ");
  expect(4, {"report.json"}, "SHA-256");
  fs::remove(folder_ / "nested.json");
  expect(4, {"report.json"}, "nested.json, which it names, is not there");
  keep({"nest", "given.json", "--work", "1000", "--json"}, "report.json");
  expect(3, {"report.json"}, "was not written");
}

TEST_F(CliVerifyClaims, AReportOfCheckHasTheViolationsOfItsLayout) {
  nest();
  keep({"check", "nested.json", "--json"}, "check.json");
  expect(0, {"check.json"}, "Confirmed");
  change("check.json", "\"violations\": []",
         R"("violations": [{"kind": "overlap", "a": 1, "b": 2, "stock": "x", "copy": 0, "amount_mm": 1,
             "at": [0, 0], "direction": null}])");
  expect(4, {"check.json"}, "violations are not those of nested.json");
}

TEST_F(CliVerifyClaims, ReportsOfPocketAndSimulateAreMadeAnew) {
  write_bytes(folder_ / "pocket.json", kPocket);
  keep({"pocket", "pocket.json", "--tool", "8", "--depth", "2", "-o", "p.ngc", "--json"}, "pocketed.json");
  keep({"simulate", "p.ngc", "--pocket", "pocket.json", "--tool", "8", "--json"}, "simulated.json");
  expect(0, {"pocketed.json"}, "Confirmed");
  expect(0, {"simulated.json"}, "Confirmed");
  fs::create_directory(folder_ / "away");
  fs::rename(folder_ / "p.ngc", folder_ / "away/p.ngc");
  expect(4, {"pocketed.json"}, "p.ngc");
  expect(0, {"pocketed.json", "--program", "away/p.ngc"}, "Confirmed");
  for (const char* report : {"pocketed.json", "simulated.json"}) {
    const std::string before = read_bytes(folder_ / report);
    for (const char* field : {"coverage_percent", "seconds", "tool_mm", "step_over", "stock_to_leave_mm"}) {
      Json changed = Json::parse(before);
      changed[field] = changed[field].get<double>() * 0.75 + 0.01;
      write_bytes(folder_ / report, changed.dump());
      expect(4, {report, "--program", "away/p.ngc"}, " and is to be ");
    }
  }
}

/// 50 x 30 with an open left side, a round island, and an opening with a fold of an ellipse.
const std::string kDrawing =
    R"(<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="30mm" viewBox="0 0 50 30">)"
    R"(<g id="WALL"><path d="M0 0H40A10 8 0 0 1 50 8V30H0"/></g><g id="OPEN"><path d="M0 30V0"/></g>)"
    R"(<g id="ISLAND"><rect x="0.2in" y="12" width="8" height="6" rx="2"/></g></svg>)";

TEST_F(CliVerifyClaims, ThePocketOfADrawingIsDerivedFromIt) {
  write_bytes(folder_ / "p.svg", kDrawing);
  keep({"pocket", "p.svg", "--tool", "6", "--depth", "1", "--open-layer", "OPEN", "--island-layer", "ISLAND",
        "-o", "p.ngc", "--json"},
       "r.json");
  expect(0, {"r.json"}, "Confirmed");
  const std::string before = read_bytes(folder_ / "r.json");
  change("r.json", "\"OPEN\"", "\"WALL\"");
  expect(4, {"r.json"}, "its layer is");
  write_bytes(folder_ / "r.json", before);
  change("r.json", "\"tolerance_mm\": ", "\"tolerance_mm\": -");
  expect(3, {"r.json"}, "below 0");
}

TEST_F(CliVerifyClaims, ThePocketOfATreeIsDerivedFromIt) {
  const std::string tree = R"({"units": "mm", "shape": {"difference": [
      {"rectangle": {"corner": [0, 0], "size": [60, 40]}}, {"circle": {"centre": [30, 20], "radius": 6}}]}})";
  write_bytes(folder_ / "tree.json", tree);
  keep({"pocket", "tree.json", "--tool", "8", "--depth", "1", "-o", "p.ngc", "--json"}, "r.json");
  expect(0, {"r.json"}, "Confirmed");
  // Another tree, named with its own digest, is one of other regions.
  const std::string digest = Json::parse(read_bytes(folder_ / "r.json"))["inputs"][0]["sha256"];
  change("tree.json", "\"radius\": 6", "\"radius\": 5");
  keep({"pocket", "tree.json", "--tool", "8", "--depth", "1", "-o", "q.ngc", "--json"}, "q.json");
  change("r.json", digest, Json::parse(read_bytes(folder_ / "q.json"))["inputs"][0]["sha256"]);
  expect(4, {"r.json"}, "regions are not what tree.json means");
}

TEST_F(CliVerifyClaims, AProgramAloneSaysWhatToAdd) {
  write_bytes(folder_ / "pocket.json", kPocket);
  keep({"pocket", "pocket.json", "--tool", "8", "--depth", "2", "-o", "p.ngc"});
  expect(2, {"p.ngc"}, "--pocket FILE --tool MM");
  expect(0, {"p.ngc", "--pocket", "pocket.json", "--tool", "8"}, "Confirmed");
  expect(4, {"p.ngc", "--pocket", "pocket.json", "--tool", "9"}, "leaves the pocket");
  expect(4, {"p.ngc", "--pocket", "pocket.json", "--tool", "6"}, "uncut");
}

TEST_F(CliVerifyClaims, AProfileProgramCutsEveryPartAndEntersNone) {
  nest();
  for (const Words& more :
       {Words{"--process", "laser", "--pierce", "0.3", "--lead-in", "2"},
        Words{"--process", "plasma", "--lead", "arc", "--lead-in", "1.5", "--unit", "inch"},
        Words{"--process", "router", "--depth", "4", "--pass", "3", "--plunge", "200", "--speed", "9000",
              "--post", "fanuc"}}) {
    keep(Words{"export", "nested.json", "--format", "gcode", "--kerf", "0.3", "--feed", "2000", "--sheet",
               "steel 2 mm#1", "-o", "cut.nc"} +
         more);
    const Words as{"cut.nc", "--layout", "nested.json", "--sheet", "steel 2 mm#1", "--kerf"};
    expect(0, as + Words{"0.3"}, "Confirmed");
    expect(4, as + Words{"0.5"}, "the kerf enters a part");
    expect(4, as + Words{"0.1"}, "follows no contour");
  }
  expect(2, {"cut.nc", "--layout", "nested.json"}, "--kerf");
}

TEST_F(CliVerifyClaims, ExportsAreTheLayout) {
  nest();
  for (const Words& more :
       {Words{"--format", "dxf"}, Words{"--format", "dxf", "--unit", "inch"}, Words{"--format", "svg"}}) {
    keep(Words{"export", "nested.json", "-o", "out"} + more);
    expect(0, {"out", "--layout", "nested.json"}, "Confirmed");
    expect(2, {"out"}, "--layout FILE");
    expect(4, {"out", "--layout", "nested.json", "--only", "CUT"}, "layer SHEET");
    expect(3, {"out", "--layout", "given.json"}, "nothing is placed");
  }
}

TEST_F(CliVerifyClaims, EveryUntouchedResultOfTheExamplesIsConfirmed) {
  std::vector<fs::path> orders{fs::path(cases::source_dir()) / "examples/layouts/shoes.json"};
  // Tables of orders are no layouts.
  for (const auto& entry : fs::directory_iterator(kOrders))
    if (entry.path().extension() == ".json") orders.push_back(entry.path());
  for (const fs::path& order : orders) {
    SCOPED_TRACE(order.string());
    // Exit status 1 says that not everything found room.
    const Ran ran =
        lekalo({"nest", order.string(), "--work", "500", "--threads", "1", "-o", "n.json", "--json"});
    ASSERT_LE(ran.status, 1) << ran.err;
    write_bytes(folder_ / "r.json", ran.out);
    keep({"check", "n.json", "--json"}, "c.json");
    for (const char* file : {"n.json", "r.json", "c.json"}) expect(0, {file}, "Confirmed");
    expect(0, {"n.json", "--layout", order.string()}, "Confirmed");
    for (const char* form : {"dxf", "svg"}) {
      keep({"export", "n.json", "--format", form, "-o", "out"});
      expect(0, {"out", "--layout", "n.json"}, "Confirmed");
    }
    const std::string sheet = ran.json()["stocks"][0]["stock"];
    keep({"export", "n.json", "--format", "hpgl", "--sheet", sheet, "-o", "out"});
    expect(0, {"out", "--layout", "n.json", "--sheet", sheet}, "Confirmed");
  }
}

TEST_F(CliVerifyClaims, OtherFilesAreNamedInOneSentence) {
  nest();
  keep({"show", "nested.json", "--picture", "p.png"});
  keep({"show", "nested.json", "--picture", "p.pdf"});
  for (const char* picture : {"p.png", "p.pdf"}) expect(3, {picture}, "it is a picture");
  write_bytes(folder_ / "any.txt", "any");
  expect(3, {"any.txt"}, "none of the files");
  expect(2, {"nested.json", "--part", "given.json"}, "has no use for it");
}

}  // namespace
}  // namespace lekalo::test::cli_verify_claims_test

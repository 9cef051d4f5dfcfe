#include "e2e/cli_run.hpp"

/// `lekalo verify`: a result that was not touched is confirmed, anything changed afterwards is refuted.
namespace lekalo::test::cli_verify_test {
namespace {

class Verify : public testing::Test {
 protected:
  void SetUp() override {
    write_plate(folder_);
    const Ran ran = run(folder_.path(), kLocatePlate + Words{"-o", "out.json", "--nc", "part.nc", "--nc-out",
                                                             "out.nc", "--alternatives", "0.01"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    result_ = Json::parse(read_bytes(folder_ / "out.json"));
  }
  [[nodiscard]] Ran verify(const Words& more = {}) const {
    return run(folder_.path(), Words{"verify", "out.json"} + more);
  }
  [[nodiscard]] Ran verify_changed(const Json& changed) const {
    write_bytes(folder_ / "out.json", changed.dump());
    return verify();
  }
  /// Exit status of the result with one number moved by `step`.
  [[nodiscard]] int verify_moved(const std::string& field, double step) const {
    Json changed = result_;
    changed.at(field) = changed.at(field) + step;
    return verify_changed(changed).status;
  }
  TemporaryFolder folder_;
  Json result_;
};

TEST_F(Verify, ConfirmsWhatWasNotTouched) {
  const Ran ran = verify({"--json"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  const Json report = ran.json();
  EXPECT_EQ(report["format"]["name"], "lekalo-verify");
  EXPECT_EQ(report["status"], "confirmed");
  EXPECT_EQ(report["findings"].size(), 0U);
  EXPECT_EQ(report["inputs"].size(), 4U);
  EXPECT_GT(report["intervals"], 0);
  const double low = std::stod(report["clearance_low"].get<std::string>());
  EXPECT_GE(low, result_["clearance"].get<double>());
  EXPECT_NEAR(low, 5, 1e-8);
  EXPECT_NEAR(std::stod(report["bound_high"].get<std::string>()), 5, 1e-8);
  EXPECT_NE(ran.err.find("Confirmed"), std::string::npos);
  EXPECT_NE(ran.err.find(report["clearance_low"].get<std::string>()), std::string::npos);
}

TEST_F(Verify, ConfirmsFormattedOtherwise) { EXPECT_EQ(verify_changed(result_).status, 0); }

TEST_F(Verify, PrintsNothingToStdoutWithoutJson) { EXPECT_EQ(verify().out, ""); }

TEST_F(Verify, RefutesAClearanceThatIsTooLarge) {
  EXPECT_EQ(verify_moved("/clearance", 1e-6), 4);
  EXPECT_EQ(verify_moved("/clearance", 1), 4);
}

TEST_F(Verify, RefutesAPoseThatWasMoved) {
  EXPECT_EQ(verify_moved("/x", 1e-3), 4);
  EXPECT_EQ(verify_moved("/y", -1e-3), 4);
  EXPECT_EQ(verify_moved("/theta", 1e-4), 4);
}

TEST_F(Verify, RefutesABoundThatIsTooSmall) { EXPECT_EQ(verify_moved("/upper_bound", -1e-3), 4); }

TEST_F(Verify, RefutesABoundBelowTheClearanceAlsoWithoutACertificate) {
  Json changed = result_;
  changed["certificate"] = nullptr;
  changed["upper_bound"] = 1e-9;
  changed["gap"] = 1e-9 - changed["clearance"].get<double>();
  EXPECT_EQ(verify_changed(changed).status, 4);
}

TEST_F(Verify, RefutesACertificateWithAHole) {
  Json changed = result_;
  ASSERT_GT(changed["certificate"].size(), 2U);
  changed["certificate"].erase(1);
  const Ran ran = verify_changed(changed);
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("covers"), std::string::npos) << ran.err;
}

TEST_F(Verify, RefutesContactsThatProveLess) {
  Json changed = result_;
  for (Json& interval : changed["certificate"]) {
    Json& contact = interval["contacts"][0];
    contact["part_vertex"] = (contact["part_vertex"].get<int>() + 2) % 4;
  }
  EXPECT_EQ(verify_changed(changed).status, 4);
}

TEST_F(Verify, RefutesAnAlternativeThatIsNone) {
  EXPECT_EQ(verify_moved("/alternatives/0/clearance", 1e-3), 4);
}

TEST_F(Verify, RefutesAStatusThatTheNumbersDoNotHave) {
  Json changed = result_;
  changed["status"] = "infeasible";
  EXPECT_EQ(verify_changed(changed).status, 4);
}

TEST_F(Verify, RefutesANarrowerWindowThanThePose) {
  Json changed = result_;
  changed["window_deg"] = {80, 100};
  EXPECT_EQ(verify_changed(changed).status, 4);
}

TEST_F(Verify, RefutesAResultForOtherContours) {
  write_bytes(folder_ / "blank.csv", "100 100\n190 100\n190 150\n100 150.5\n");
  const Ran ran = verify();
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("SHA-256"), std::string::npos) << ran.err;
}

TEST_F(Verify, RefutesAProgramThatWasEdited) {
  write_bytes(folder_ / "out.nc", read_bytes(folder_ / "out.nc") + "G0 X0\n");
  const Ran ran = verify();
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("out.nc"), std::string::npos) << ran.err;
}

TEST_F(Verify, LeavesAProgramThatWentAwayOpen) {
  fs::remove(folder_ / "out.nc");
  const Ran ran = verify();
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("out.nc"), std::string::npos) << ran.err;
}

TEST_F(Verify, WithoutCertificateTheBoundIsUnproved) {
  Json changed = result_;
  changed["certificate"] = nullptr;
  const Ran ran = verify_changed(changed);
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("Unproved"), std::string::npos) << ran.err;
}

TEST_F(Verify, ReportsWhatCannotBeReadWithOneSentence) {
  Json no_clearance = result_;
  no_clearance.erase("clearance");
  Json no_inputs = result_;
  no_inputs["inputs"] = Json::array();
  Json huge_index = result_;
  huge_index["contacts"][0]["part_vertex"] = -1;
  for (const Json& changed : {no_clearance, no_inputs, huge_index}) {
    const Ran ran = verify_changed(changed);
    EXPECT_EQ(ran.status, 3) << ran.err;
    EXPECT_NE(ran.err.find("out.json"), std::string::npos) << ran.err;
    EXPECT_EQ(ran.err.find('\n'), ran.err.size() - 1) << ran.err;
  }
}

TEST_F(Verify, AFileThatIsMissingRefutesAndIsNamed) {
  fs::remove(folder_ / "blank.csv");
  const Ran ran = verify({"--json"});
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("the blank file blank.csv, which it names, is not there"), std::string::npos)
      << ran.err;
  const Json report = Json::parse(ran.out);
  EXPECT_EQ(report["status"], "refuted");
  EXPECT_EQ(report["findings"].size(), 1U);
  // Who says where it is now, and is wrong, has not asked about the result.
  EXPECT_EQ(verify({"--blank", "nowhere.csv"}).status, 3);
}

TEST_F(Verify, ReadsTheProgramThatWasMovedToo) {
  write_bytes(folder_ / "part.nc", read_bytes(folder_ / "part.nc") + "M0\n");
  const Ran ran = verify();
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("part.nc"), std::string::npos) << ran.err;
  fs::rename(folder_ / "part.nc", folder_ / "edited.nc");
  EXPECT_EQ(verify().status, 4);
  EXPECT_EQ(verify({"--nc", "edited.nc"}).status, 4);
  EXPECT_EQ(verify({"--features", "edited.nc"}).status, 2);
  EXPECT_EQ(verify({"--compare", "edited.nc"}).status, 2);
}

TEST_F(Verify, ReadsTheEarlierResultToo) {
  ASSERT_EQ(run(folder_.path(), kLocatePlate + Words{"-o", "again.json", "--compare", "out.json"}).status, 0);
  const Ran ran = run(folder_.path(), {"verify", "again.json"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.err.find("not rechecked"), std::string::npos) << ran.err;
  fs::rename(folder_ / "out.json", folder_ / "first.json");
  EXPECT_EQ(run(folder_.path(), {"verify", "again.json"}).status, 4);
  EXPECT_EQ(run(folder_.path(), {"verify", "again.json", "--compare", "first.json"}).status, 0);
  write_bytes(folder_ / "first.json", read_bytes(folder_ / "first.json") + " ");
  EXPECT_EQ(run(folder_.path(), {"verify", "again.json", "--compare", "first.json"}).status, 4);
}

TEST_F(Verify, FindsTheFilesBesideTheResultAndWhereItIsTold) {
  const TemporaryFolder elsewhere;
  EXPECT_EQ(run(elsewhere.path(), {"verify", (folder_ / "out.json").string()}).status, 0);
  fs::create_directory(folder_ / "moved");
  fs::rename(folder_ / "blank.csv", folder_ / "moved/b.csv");
  EXPECT_EQ(verify().status, 4);
  EXPECT_EQ(verify({"--blank", "moved/b.csv"}).status, 0);
}

TEST_F(Verify, ChecksTheCertificateFile) {
  ASSERT_EQ(run(folder_.path(), kLocatePlate + Words{"-o", "out.json", "--certificate", "out.cert"}).status,
            0);
  EXPECT_EQ(verify().status, 0);
  const std::string certificate = read_bytes(folder_ / "out.cert");
  Json shorter = Json::parse(certificate);
  EXPECT_EQ(shorter["format"]["name"], "lekalo-certificate");
  shorter["intervals"].erase(0);
  write_bytes(folder_ / "out.cert", shorter.dump());
  EXPECT_EQ(verify().status, 4);
  fs::remove(folder_ / "out.cert");
  EXPECT_EQ(verify().status, 4);
}

/// A part of every kind of file in a plate, and another part.
struct PartFile {
  const char *name, *bytes, *other;
};
constexpr PartFile kParts[] = {
    {"tree.json",
     R"({"shape": {"difference": [{"rectangle": {"size": [40, 20]}}, {"circle": {"radius": 5}}]}})",
     R"({"shape": {"difference": [{"rectangle": {"size": [40, 20]}}, {"circle": {"radius": 5.01}}]}})"},
    {"points.csv", "0 0\n40 0\n40 20\n20 10\n0 20\n", "0 0\n40 0\n40 20\n20 10.01\n0 20\n"},
    {"region.json",
     R"({"outer": [{"line": {"from": [0, 0], "to": [40, 0]}},
                   {"arc": {"from": [40, 0], "to": [0, 0], "centre": [20, 0], "ccw": true}}]})",
     R"({"outer": [{"line": {"from": [0, 0], "to": [40, 0]}}, {"line": {"from": [40, 0], "to": [0, 9]}},
                   {"line": {"from": [0, 9], "to": [0, 0]}}]})"},
    {"bulge.dxf",
     "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n0\n20\n0\n42\n0."
     "5\n10\n40\n20\n0\n10\n40\n"
     "20\n20\n10\n0\n20\n20\n0\nENDSEC\n0\nEOF\n",
     "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n0\n20\n0\n42\n0."
     "4\n10\n40\n20\n0\n10\n40\n"
     "20\n20\n10\n0\n20\n20\n0\nENDSEC\n0\nEOF\n"},
    {"curve.svg",
     R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="30mm" viewBox="0 0 50 30">
<path d="M5 5 h30 c5 0 5 15 0 15 h-30 z"/><g transform="rotate(20)"><circle cx="15" cy="7" r="3"/></g></svg>)svg",
     R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="30mm" viewBox="0 0 50 30">
<path d="M5 5 h30 c5 0 5 15 0 15 h-30 z"/><g transform="rotate(20)"><circle cx="15" cy="7" r="3.1"/></g></svg>)svg"}};

/// Says of the file of a role in the result that it has the bytes that are there now.
void take_digest_of_now(const TemporaryFolder& folder, const std::string& result, const std::string& role) {
  Json report = run(folder.path(), {"verify", result, "--json"}).json();
  Json changed = Json::parse(read_bytes(folder / result));
  for (const Json& now : report["inputs"])
    for (Json& then : changed["inputs"])
      if (now["role"] == role && then["role"] == role) then["sha256"] = now["sha256"];
  write_bytes(folder / result, changed.dump());
}

TEST(CliVerify, PartAndBlankOfOneFileAreReadInOneWay) {
  const TemporaryFolder folder;
  write_bytes(folder / "one.svg", R"(<svg xmlns="http://www.w3.org/2000/svg" width="60mm" height="40mm"
    viewBox="0 0 60 40"><path d="M0 0H60V40H0Z"/><circle cx="30" cy="20" r="7.3"/></svg>)");
  ASSERT_EQ(run(folder.path(),
                {"locate", "--part", "one.svg", "--blank", "one.svg", "--gap", "0.1", "-o", "r.json"})
                .status,
            0);
  const Ran as_it_is = run(folder.path(), {"verify", "r.json"});
  EXPECT_EQ(as_it_is.status, 0) << as_it_is.err;
  EXPECT_EQ(as_it_is.err.find("not rechecked"), std::string::npos) << as_it_is.err;
  Json changed = Json::parse(read_bytes(folder / "r.json"));
  ASSERT_EQ(changed["certificate"], "same file");
  changed["drawings"]["blank"]["join"] = 0.02;
  write_bytes(folder / "r.json", changed.dump());
  const Ran otherwise = run(folder.path(), {"verify", "r.json"});
  EXPECT_EQ(otherwise.status, 1) << otherwise.err;
  EXPECT_NE(otherwise.err.find("in the same way was not rechecked"), std::string::npos) << otherwise.err;
}

TEST(CliVerify, TheCheckerReadsEveryKindOfPartItself) {
  for (const PartFile& part : kParts) {
    SCOPED_TRACE(part.name);
    const TemporaryFolder folder;
    write_bytes(folder / "blank.json", R"({"shape": {"rectangle": {"size": [60, 50]}}})");
    write_bytes(folder / part.name, part.bytes);
    const Ran made = run(folder.path(), {"locate", "--part", part.name, "--blank", "blank.json", "--window",
                                         "0", "0", "--gap", "0.5", "-o", "r.json"});
    ASSERT_EQ(made.status, 0) << made.err;
    const Ran ran = run(folder.path(), {"verify", "r.json"});
    EXPECT_EQ(ran.status, 0) << ran.err;
    // Another part under its name, with its digest.
    write_bytes(folder / part.name, part.other);
    EXPECT_EQ(run(folder.path(), {"verify", "r.json"}).status, 4);
    take_digest_of_now(folder, "r.json", "part");
    const Ran forged = run(folder.path(), {"verify", "r.json"});
    EXPECT_EQ(forged.status, 4) << forged.err;
    EXPECT_NE(forged.err.find("the part used is not what"), std::string::npos) << forged.err;
  }
}

TEST(CliVerify, AScanHasToProveTheBlank) {
  const TemporaryFolder folder;
  std::string points;
  for (int k = 0; k < 240; ++k) {
    const int side = k / 60, at = k % 60;
    const int x = side == 0 ? at : (side == 1 ? 60 : (side == 2 ? 60 - at : 0));
    const int y = side == 0 ? 0 : (side == 1 ? at : (side == 2 ? 60 : 60 - at));
    points += std::to_string(x) + " " + std::to_string(y) + "\n";
  }
  write_bytes(folder / "scan.csv", points);
  write_bytes(folder / "part.json", kParts[0].bytes);
  const Ran made =
      run(folder.path(), {"locate", "--part", "part.json", "--blank", "scan.csv", "--uncertainty", "0.01",
                          "--max-dip", "0.05", "--window", "0", "0", "--gap", "0.5", "-o", "r.json"});
  ASSERT_EQ(made.status, 0) << made.err;
  const Ran ran = run(folder.path(), {"verify", "r.json"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  const Json result = Json::parse(read_bytes(folder / "r.json"));
  for (const auto& [field, value] :
       std::map<std::string, Json>{{"guard", 0.2}, {"max_dip", 0.5}, {"points", 239}, {"units", "inch"}}) {
    Json changed = result;
    changed["scan"][field] = value;
    write_bytes(folder / "r.json", changed.dump());
    EXPECT_EQ(run(folder.path(), {"verify", "r.json"}).status, 4) << field;
  }
}

TEST(CliVerify, APartFarAwayIsToldToBeOutside) {
  const TemporaryFolder folder;
  write_bytes(folder / "blank.json", R"({"shape": {"regular_polygon": {"sides": 500, "radius": 60}}})");
  write_bytes(folder / "part.json", kParts[0].bytes);
  ASSERT_EQ(run(folder.path(), {"locate", "--part", "part.json", "--blank", "blank.json", "--window", "0",
                                "0", "--gap", "0.5", "-o", "r.json"})
                .status,
            0);
  Json changed = Json::parse(read_bytes(folder / "r.json"));
  changed["x"] = 1e9;
  write_bytes(folder / "r.json", changed.dump());
  const Ran ran = run(folder.path(), {"verify", "r.json"});
  EXPECT_EQ(ran.status, 4);
  EXPECT_NE(ran.err.find("clearance is"), std::string::npos) << ran.err;
}

TEST_F(Verify, AnotherProgramUnderTheNameOfTheOriginalIsRefuted) {
  std::string program = read_bytes(folder_ / "part.nc");
  const std::size_t place = program.find('X');
  ASSERT_NE(place, std::string::npos);
  program.insert(place + 1, "1");
  write_bytes(folder_ / "part.nc", program);
  take_digest_of_now(folder_, "out.json", "nc");
  const Ran ran = verify();
  EXPECT_EQ(ran.status, 4) << ran.err;
  EXPECT_NE(ran.err.find("moved: its motion in line"), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace lekalo::test::cli_verify_test

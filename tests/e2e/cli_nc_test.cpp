#include <cmath>

#include "e2e/cli_run.hpp"
#include "support/places.hpp"

/// The NC program beside the placement: all three modes, what the result says about them, and when there is
/// none.
namespace lekalo::test::cli_nc_test {
namespace {

class Program3 : public testing::Test {
 protected:
  void SetUp() override { write_plate(folder_); }
  [[nodiscard]] Ran locate(const Words& more) const {
    return run(folder_.path(), kLocatePlate +
                                   Words{"--window", "-5", "5", "--nc", "part.nc", "--nc-out", "out.nc",
                                         "--json", "-o", "out.json"} +
                                   more);
  }
  [[nodiscard]] std::string program() const { return read_bytes(folder_ / "out.nc"); }
  TemporaryFolder folder_;
};

TEST_F(Program3, CoordinatesModeShiftsThemAndKeepsTheRest) {
  const Ran ran = locate({});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json nc = ran.json()["nc"];
  EXPECT_EQ(nc["mode"], "coordinates");
  EXPECT_EQ(nc["scan_frame"], "machine");
  EXPECT_EQ(nc["work_offset"], 1);
  EXPECT_GT(nc["motions"], 3);
  EXPECT_FALSE(nc["notes"].empty());
  EXPECT_EQ(nc["output"]["path"], "out.nc");
  EXPECT_EQ(nc["output"]["sha256"].get<std::string>().size(), 64U);
  // The plate moves by (105, 105) and turns by nothing that is seen in five decimals.
  EXPECT_NE(program().find("X115"), std::string::npos) << program();
  EXPECT_NE(program().find("X175"), std::string::npos) << program();
  EXPECT_NE(program().find("G0 Z5\n"), std::string::npos) << program();
  EXPECT_NE(program().find("Z-1 F100"), std::string::npos) << program();
  EXPECT_NE(ran.err.find("out.nc"), std::string::npos) << ran.err;
}

TEST_F(Program3, ClearanceOfTheProgramIsThatOfThePlacementLessTheRounding) {
  write_bytes(folder_ / "blank.csv", "100.3 100\n190.2 104\n188 154\n98.1 150\n");
  const Json result = locate({}).json();
  const double clearance = result["clearance"], rounding = result["nc"]["rounding_mm"];
  const double left = result["nc"]["clearance"];
  EXPECT_GT(rounding, 0.0);
  EXPECT_LT(rounding, 1e-4);
  EXPECT_LE(left, clearance - rounding);
  EXPECT_NEAR(left, clearance - rounding, 1e-14);
}

TEST_F(Program3, OffsetModeSetsTheWorkOffset) {
  const Ran ran = locate({"--nc-mode", "offset"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(program().find("G10 L2 P1 X105"), std::string::npos) << program();
  EXPECT_NE(program().find("G1 X70\n"), std::string::npos) << "the program itself stays: " << program();
  EXPECT_EQ(ran.json()["nc"]["mode"], "offset");
}

TEST_F(Program3, OffsetModeIsForTheWorkOffsetThatTheProgramRunsIn) {
  write_bytes(folder_ / "part.nc", "G21 G90 G17\nG55\nG0 X10 Y10\nM2\n");
  const Ran ran = locate({"--nc-mode", "offset", "--wcs", "2"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(program().find("G10 L2 P2"), std::string::npos) << program();
  EXPECT_EQ(ran.json()["nc"]["work_offset"], 2);
}

TEST_F(Program3, G68ModeTurnsInTheControl) {
  const Ran ran = locate({"--nc-mode", "g68"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(program().find("G68"), std::string::npos) << program();
  EXPECT_NE(program().find("G69"), std::string::npos) << program();
  EXPECT_EQ(ran.json()["nc"]["mode"], "g68");
}

TEST_F(Program3, ScanFrameStandsInTheResult) {
  const Ran ran = locate({"--scan-frame", "wcs"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["nc"]["scan_frame"], "wcs");
}

TEST_F(Program3, OffsetModeWithAScanInTheWorkOffsetIsUsage) {
  const Ran ran = locate({"--nc-mode", "offset", "--scan-frame", "wcs"});
  EXPECT_EQ(ran.status, 2);
  EXPECT_FALSE(fs::exists(folder_ / "out.nc"));
  EXPECT_FALSE(fs::exists(folder_ / "out.json"));
}

TEST_F(Program3, AllowanceLostInTheRoundingGivesNoProgramButTheResult) {
  // 5 mm are there; the demand leaves less than the rounding of five decimals.
  const double clearance = locate({}).json()["clearance"];
  fs::remove(folder_ / "out.nc");
  write_bytes(folder_ / "blank.csv", "100.3 100\n190.2 104\n188 154\n98.1 150\n");
  const Json free = locate({}).json();
  fs::remove(folder_ / "out.nc");
  const double most = free["clearance"];
  EXPECT_GT(clearance, most);
  const Ran ran = locate({"--min-allowance", std::to_string(most - 1e-6)});
  EXPECT_EQ(ran.status, 1) << ran.err;
  EXPECT_FALSE(fs::exists(folder_ / "out.nc"));
  EXPECT_TRUE(ran.json()["nc"].is_null());
  EXPECT_EQ(ran.json()["status"], "optimal");
  EXPECT_EQ(ran.json()["shortfall"], 0);
  EXPECT_NE(ran.err.find("no NC program"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("rounding"), std::string::npos) << ran.err;
}

TEST_F(Program3, ExampleProgramIsRewrittenForItsBlank) {
  const std::string input = (fs::path(cases::source_dir()) / "examples/localisation/part.nc").string();
  for (const Words& mode : {Words{}, Words{"--nc-mode", "offset"}}) {
    const Ran ran = run(
        folder_.path(),
        locate_example(1) + Words{"--nc", input, "--nc-out", "out.nc", "--json", "-o", "out.json"} + mode);
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_GT(program().size(), 1000U);
    EXPECT_EQ(run(folder_.path(), {"verify", "out.json"}).status, 0);
  }
}

}  // namespace
}  // namespace lekalo::test::cli_nc_test

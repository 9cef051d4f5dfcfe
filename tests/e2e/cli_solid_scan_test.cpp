#include "e2e/cli_run.hpp"
#include "lekalo/locate/solid.hpp"
#include "support/scanned_blanks.hpp"
#include "support/solid_files.hpp"

/// A part in a blank that a scanner measured, as a person places it.
namespace lekalo::test::cli_solid_scan_test {
namespace {

constexpr double kNoise = 0.02;

class SolidScan : public testing::Test {
 protected:
  void SetUp() override {
    write_bytes(folder_ / "part.stl", solid_files::stl_binary(cases::Casting::part()));
    write_bytes(folder_ / "scan.ply", solid_files::ply<float>(casting_.scanned(0.9 * kNoise, random_),
                                                              solid_files::PlyForm::little));
  }
  [[nodiscard]] Ran locate(const Words& more) const {
    return run(folder_.path(), Words{"locate", "--part", "part.stl", "--blank", "scan.ply", "--freedom",
                                     "c-xyz", "--window", "-1", "1", "--shift", "1", "--gap", "0.05"} +
                                   more);
  }
  [[nodiscard]] Ran verify() const { return run(folder_.path(), {"verify", "r.json"}); }
  /// Verifies a result with one field of its scan changed.
  [[nodiscard]] int with(const std::string& field, const Json& value) const {
    Json result = Json::parse(read_bytes(folder_ / "r.json"));
    result.at("/scan" + field) = value;
    write_bytes(folder_ / "changed.json", result.dump());
    return run(folder_.path(), {"verify", "changed.json"}).status;
  }
  TemporaryFolder folder_;
  Random random_{7};
  cases::Casting casting_{random_};
};

const Words kMeasured{"--uncertainty", "0.01", "--min-radius", "5"};

TEST_F(SolidScan, WithoutAWordAboutTheUndersideNothingIsProved) {
  const Ran ran = locate(kMeasured + Words{"-o", "r.json", "--json"});
  ASSERT_EQ(ran.status, 1) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["scan"]["proved"], false);
  EXPECT_EQ(result["scan"]["unknown_triangles"], 120);
  EXPECT_NEAR(result["unknown_area_mm2"], 400 * 3.14, 3);
  for (const char* words :
       {"A placement was found, but parts of the blank are unknown", "unknown            120",
        "--underside z=LEVEL --flat MM", "assumed            every corner of the scan"})
    EXPECT_NE(ran.err.find(words), std::string::npos) << words << " is not in\n" << ran.err;
  const Ran checked = verify();
  EXPECT_EQ(checked.status, 1) << checked.err;
  EXPECT_NE((checked.out + checked.err).find("120 triangles of the scan are unknown"), std::string::npos)
      << checked.out << checked.err;
  EXPECT_EQ(with("/proved", true), 4);
}

TEST_F(SolidScan, APlacementHoldsInTheTrueBlankAndIsConfirmed) {
  const Ran ran = locate(kMeasured + Words{"--underside", "z=0", "--flat", "0.1", "-o", "r.json", "--json",
                                           "--allowances", "a.csv", "--picture", "p.png"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["status"], "optimal");
  EXPECT_EQ(result["scan"]["proved"], true);
  EXPECT_EQ(result["unknown_area_mm2"], 0);
  EXPECT_EQ(result["scan"]["assumptions"].size(), 4U);
  EXPECT_NE(ran.err.find("assumed            the underside at z = 0 mm is solid and flat to 0.1 mm"),
            std::string::npos)
      << ran.err;
  // The true blank, which nobody has told, holds the part.
  const double clearance = result["clearance"];
  EXPECT_GT(clearance, 0.8);
  const Json& q = result["quaternion"];
  const solid::Motion motion =
      motion_of(locate::SolidPose{{q[0], q[1], q[2], q[3]}, {result["x"], result["y"], result["z"]}});
  for (const solid::Vector p : cases::Casting::part().vertices)
    EXPECT_GE(casting_.depth(motion(p)), clearance);
  EXPECT_EQ(verify().status, 0);
  EXPECT_EQ(with("/guard", 0.01), 4);
  EXPECT_EQ(with("/min_radius", 6), 4);
  EXPECT_EQ(with("/underside/flat", 0.05), 4);
  EXPECT_EQ(with("/widest", 0.01), 4);
  EXPECT_EQ(with("/unknown_triangles", 1), 4);
}

TEST_F(SolidScan, LoosePointsBecomeAMeshThatTheCheckerHoldsAgainstThem) {
  std::vector<solid::Vector> points = casting_.scanned(0.9 * kNoise, random_).vertices;
  points.pop_back();  // the middle of the underside, which nobody saw
  write_bytes(folder_ / "scan.ply", solid_files::points(points));
  const Words stated = kMeasured + Words{"--underside", "z=0", "--flat", "0.1", "-o", "r.json", "--json"};
  const Ran refused = locate(stated);
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(refused.err.find("--mesh FILE.ply they are meshed first"), std::string::npos) << refused.err;
  const Ran ran = locate(stated + Words{"--mesh", "mesh.ply"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["scan"]["proved"], true);
  EXPECT_EQ(result["inputs"][1]["path"], "mesh.ply");
  EXPECT_EQ(result["inputs"][2]["path"], "scan.ply");
  EXPECT_GT(result["clearance"], 0.6);
  EXPECT_EQ(verify().status, 0);
  // The mesh alone is a scanner's mesh like any other.
  const Ran again = run(folder_.path(), Words{"locate", "--part", "part.stl", "--blank", "mesh.ply",
                                              "--method", "climb", "-o", "again.json"} +
                                            kMeasured + Words{"--underside", "z=0", "--flat", "0.1"});
  EXPECT_EQ(again.status, 0) << again.err;
  points[points.size() / 2].z += 1e-6;
  write_bytes(folder_ / "scan.ply", solid_files::points(points));
  const Ran other = verify();
  EXPECT_EQ(other.status, 4);
  EXPECT_NE((other.out + other.err).find("is not the points file of this result"), std::string::npos)
      << other.err;
}

TEST_F(SolidScan, WordsThatDoNotGoTogetherAreRefusedInOneSentence) {
  for (const auto& [words, sentence] :
       {std::pair{Words{"--uncertainty", "0.01"},
                  "--uncertainty for a solid needs --min-radius MM or --max-dip MM"},
        {kMeasured + Words{"--underside", "z=0"}, "--underside and --flat need each other"},
        {kMeasured + Words{"--underside", "0", "--flat", "1"}, "\"0\" is no level like z=0"},
        {Words{"--min-radius", "5"}, "a scan needs --uncertainty MM"},
        {kMeasured + Words{"--step", "1"}, "--step is for outlines in the plane"}}) {
    const Ran ran = locate(words);
    EXPECT_EQ(ran.status, 2) << ran.err;
    EXPECT_NE(ran.err.find(sentence), std::string::npos) << ran.err;
  }
}

}  // namespace
}  // namespace lekalo::test::cli_solid_scan_test

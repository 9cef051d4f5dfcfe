#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <string>

#include "e2e/cli_run.hpp"
#include "lekalo/locate/solid.hpp"
#include "support/cases.hpp"
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

/// The casting whose points examples/solid/make.py writes: a block on a table with a core whose end is
/// rounded.
class ScannedExample {
 public:
  /// How deep a point lies in its material, mm; below 0 outside.
  [[nodiscard]] static double depth(solid::Vector q) {
    const double turn = 3.5 * std::numbers::pi / 180, c = std::cos(turn), s = std::sin(turn);
    const solid::Vector at = q - solid::Vector{2.5, -1.5, 0},
                        p{c * at.x + s * at.y, c * at.y - s * at.x, at.z};
    // The core is where a ball of its rounding goes: around a cylinder that is thinner and shorter by that.
    constexpr double kRound = 6, kRadius = 21.5, kFloor = -5.4;
    const double across = std::max(0.0, std::hypot(p.x - 8.5, p.y - 2) - (kRadius - kRound));
    const double below = std::max(0.0, kFloor + kRound - p.z);
    return std::min({p.x + 57.4, 58.2 - p.x, p.y + 38.1, 37.3 - p.y, p.z + 22.6, 23.5 - p.z,
                     std::hypot(across, below) - kRound});
  }
};

TEST_F(SolidScan, TheExampleLiesInTheCastingThatItsPointsAreOf) {
  const fs::path solids = fs::path(cases::source_dir()) / "examples" / "solid";
  const Ran ran =
      run(folder_.path(), Words{"locate", "--part", (solids / "part.stl").string(), "--blank",
                                (solids / "scan.ply").string(), "--mesh", "mesh.ply", "--underside",
                                "z=-22.6", "--flat", "0.05", "--gap", "0.1", "-o", "r.json", "--json"} +
                              kMeasured);
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["scan"]["proved"], true);
  const double clearance = result["clearance"];
  EXPECT_GT(clearance, 1.5);
  const Json& q = result["quaternion"];
  const solid::Motion motion =
      motion_of(locate::SolidPose{{q[0], q[1], q[2], q[3]}, {result["x"], result["y"], result["z"]}});
  const std::string part = read_bytes(solids / "part.stl");
  std::size_t corners = 0;
  double least = 1e9;
  for (std::size_t at = 84; at + 50 <= part.size(); at += 50)
    for (std::size_t k = 12; k < 48; k += 12, ++corners) {
      std::array<float, 3> p{};
      std::memcpy(p.data(), part.data() + at + k, sizeof(p));
      least = std::min(least, ScannedExample::depth(motion({p[0], p[1], p[2]})));
    }
  EXPECT_EQ(corners, 3U * 384);
  EXPECT_GE(least, clearance);
  EXPECT_LT(least, clearance + 0.7);
  EXPECT_EQ(verify().status, 0);
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

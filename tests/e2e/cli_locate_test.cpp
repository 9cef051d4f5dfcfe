#include <cmath>
#include <csignal>
#include <sstream>

#include "e2e/cli_run.hpp"
#include "support/places.hpp"

/// `lekalo locate` as a person runs it, on good input.
namespace lekalo::test::cli_locate_test {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The optima of the six published examples to twelve digits: the least sinusoid of all dual bases, maximised
/// by a dense sweep over the angle, outside this program.
constexpr std::array<double, 6> kOptima{0.946928019557, 0.429429597742, 0.882092581690,
                                        0.661610612080, 1.081789907306, 0.671113786060};

class Examples : public testing::TestWithParam<int> {};

TEST_P(Examples, ReachTheirOptimumWithEveryOutputAndVerifyConfirmsIt) {
  const int number = GetParam();
  const double optimum = kOptima[static_cast<std::size_t>(number - 1)];
  const TemporaryFolder folder;
  write_bytes(folder / "part.nc", kPlateProgram);
  const Ran ran = run(
      folder.path(), locate_example(number) + Words{"-o", "out.json", "--picture", "out.svg", "--deviations",
                                                    "out.csv", "--certificate", "out.cert", "--nc", "part.nc",
                                                    "--nc-out", "out.nc", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const auto files = folder.files();
  EXPECT_EQ(files.size(), 6U);
  EXPECT_EQ(files.at("out.json"), ran.out);
  EXPECT_NE(files.at("out.svg").find("<svg"), std::string::npos);
  EXPECT_NE(ran.err.find("out.svg"), std::string::npos) << ran.err;

  const Json result = ran.json();
  EXPECT_EQ(result["format"]["name"], "lekalo-locate");
  EXPECT_EQ(result["status"], "optimal");
  EXPECT_EQ(result["method"], "certified");
  const double clearance = result["clearance"], bound = result["upper_bound"];
  EXPECT_GE(clearance, optimum - 1e-9);
  EXPECT_LE(clearance, optimum + 1e-12);
  EXPECT_GE(bound, clearance);
  EXPECT_LE(bound - clearance, 1e-9);
  EXPECT_TRUE(result["certificate"].is_null());
  EXPECT_GT(result["certificate_file"]["intervals"], 0);
  EXPECT_LE(result["nc"]["clearance"], clearance);
  EXPECT_GT(result["nc"]["clearance"], clearance - 1e-4);

  const Ran verified = run(folder.path(), {"verify", "out.json", "--json"});
  EXPECT_EQ(verified.status, 0) << verified.err;
  EXPECT_EQ(verified.json()["status"], "confirmed");
}

TEST_P(Examples, AreWrittenAsPngToo) {
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder.path(), locate_example(GetParam()) + Words{"--picture", "out.png"}).status, 0);
  EXPECT_EQ(read_bytes(folder / "out.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
}

INSTANTIATE_TEST_SUITE_P(Published, Examples, testing::Range(1, 7));

std::string regular_polygon(int corners, double radius) {
  std::ostringstream text;
  text.precision(17);
  for (int k = 0; k < corners; ++k) {
    text << radius * std::cos(2 * kPi * k / corners) << ' ' << radius * std::sin(2 * kPi * k / corners)
         << '\n';
  }
  return text.str();
}

class Plate : public testing::Test {
 protected:
  void SetUp() override { write_plate(folder_); }
  [[nodiscard]] Ran locate(const Words& more) const { return run(folder_.path(), kLocatePlate + more); }
  [[nodiscard]] int verify(const std::string& result) const {
    return run(folder_.path(), {"verify", result}).status;
  }
  TemporaryFolder folder_;
};

TEST_F(Plate, LiesInTheMiddleOfItsBlank) {
  const Ran ran = locate({"--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_NEAR(result["clearance"], 5, 1e-8);
  EXPECT_LE(result["clearance"], 5.0);
  const double turn = std::remainder(result["theta"].get<double>(), 2 * kPi);
  const bool upright = std::abs(turn) < 1;
  EXPECT_NEAR(result["x"], upright ? 105 : 185, 1e-6);
  EXPECT_NEAR(result["y"], upright ? 105 : 145, 1e-6);
  EXPECT_EQ(result["mirrored"], false);
  EXPECT_EQ(result["shortfall"], 0);
  EXPECT_EQ(result["gap"].get<double>() > 0, result["upper_bound"] > result["clearance"]);
}

TEST_F(Plate, ResultHasTheFieldsOfItsFormatInTheirOrder) {
  const Json result = locate({"--json"}).json();
  EXPECT_EQ(result.keys(), (Words{"format",
                                  "status",
                                  "units",
                                  "inputs",
                                  "warnings",
                                  "seed",
                                  "work",
                                  "version",
                                  "method",
                                  "x",
                                  "y",
                                  "theta",
                                  "theta_deg",
                                  "mirrored",
                                  "clearance",
                                  "upper_bound",
                                  "gap",
                                  "min_allowance",
                                  "shortfall",
                                  "window_deg",
                                  "contacts",
                                  "certificate",
                                  "certificate_file",
                                  "alternatives",
                                  "alternatives_complete",
                                  "trim",
                                  "nc",
                                  "comparison",
                                  "deviations",
                                  "run"}));
  EXPECT_EQ(result["inputs"][0]["role"], "part");
  EXPECT_EQ(result["inputs"][0]["path"], "part.csv");
  EXPECT_EQ(result["inputs"][0]["sha256"].get<std::string>().size(), 64U);
  EXPECT_EQ(result["inputs"][1]["points"], 4);
  EXPECT_EQ(result["inputs"][1]["units"], "mm");
}

TEST_F(Plate, WritesNothingToStdoutWithoutJson) {
  const Ran ran = locate({"-o", "out.json"});
  EXPECT_EQ(ran.out, "");
  EXPECT_NE(ran.err.find("minimum allowance"), std::string::npos) << ran.err;
}

TEST_F(Plate, ReplacesAnOlderResult) {
  write_bytes(folder_ / "out.json", "old");
  ASSERT_EQ(locate({"-o", "out.json"}).status, 0);
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, DemandThatCannotBeMetIsProvedWithTheBestPlacementAndNoProgram) {
  const Ran ran = locate({"--min-allowance", "6", "-o", "out.json", "--picture", "out.svg", "--nc", "part.nc",
                          "--nc-out", "out.nc", "--json"});
  EXPECT_EQ(ran.status, 1) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["status"], "infeasible");
  EXPECT_NEAR(result["clearance"], 5, 1e-8);
  EXPECT_NEAR(result["shortfall"], 1, 1e-8);
  EXPECT_LT(result["upper_bound"], 6.0);
  EXPECT_TRUE(result["nc"].is_null());
  EXPECT_TRUE(fs::exists(folder_ / "out.json"));
  EXPECT_TRUE(fs::exists(folder_ / "out.svg"));
  EXPECT_FALSE(fs::exists(folder_ / "out.nc"));
  EXPECT_NE(ran.err.find("no NC program"), std::string::npos) << ran.err;
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, DemandThatIsMetIsSaid) {
  const Ran ran = locate({"--min-allowance", "4.9", "--json"});
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.json()["status"], "optimal");
  EXPECT_EQ(ran.json()["min_allowance"], 4.9);
}

TEST_F(Plate, PartLargerThanTheBlankIsInfeasibleAndSticksOut) {
  write_bytes(folder_ / "blank.csv", "0 0\n70 0\n70 30\n0 30\n");
  const Ran ran = locate({"--json", "-o", "out.json"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_EQ(ran.json()["status"], "infeasible");
  EXPECT_NEAR(ran.json()["clearance"], -5, 1e-8);
  EXPECT_NE(ran.err.find("sticks out"), std::string::npos);
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, PartThatJustFitsMeetsItsDemand) {
  // The search alone would say -5e-13 mm; the checker knows that it is 0.
  const fs::path part = example(1, "part");
  const Ran exact = run(folder_.path(), {"locate", "--part", part, "--blank", part, "--nc", "part.nc",
                                         "--nc-out", "out.nc", "--json", "-o", "out.json"});
  EXPECT_EQ(exact.status, 0) << exact.err;
  EXPECT_EQ(exact.json()["clearance"], 0);
  EXPECT_EQ(exact.json()["shortfall"], 0);
  EXPECT_EQ(exact.out.find(": -0,"), std::string::npos) << exact.out;
  EXPECT_TRUE(fs::exists(folder_ / "out.nc"));
  const Ran verified = run(folder_.path(), {"verify", "out.json"});
  EXPECT_EQ(verified.status, 0) << verified.err;
  EXPECT_NE(verified.err.find("between 0 and 0 mm"), std::string::npos) << verified.err;
}

TEST_F(Plate, PartThatMissesItsDemandByLastDigitsIsToldSoInDigits) {
  write_bytes(folder_ / "blank.csv", "0 0\n79.9999999995 0\n79.9999999995 40\n0 40\n");
  const Ran missed = locate({"--json", "-o", "out.json", "--nc", "part.nc", "--nc-out", "out.nc"});
  EXPECT_EQ(missed.status, 1);
  EXPECT_EQ(missed.json()["status"], "infeasible");
  EXPECT_NE(missed.err.find("-2.6e-10 mm: the part sticks out"), std::string::npos) << missed.err;
  EXPECT_NE(missed.err.find("2.6e-10 mm are missing"), std::string::npos) << missed.err;
  EXPECT_FALSE(fs::exists(folder_ / "out.nc"));
}

TEST_F(Plate, DemandBetweenClearanceAndBoundIsCalledOpen) {
  write_bytes(folder_ / "part.csv", regular_polygon(97, 90));
  write_bytes(folder_ / "blank.csv", regular_polygon(100, 100));
  const Ran ran = locate({"--min-allowance", "9.96", "--gap", "1", "--json"});
  ASSERT_GT(ran.json()["upper_bound"], 9.96);
  ASSERT_LT(ran.json()["clearance"], 9.96);
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("leaves open"), std::string::npos) << ran.err;
}

TEST_F(Plate, WindowHoldsTheAngle) {
  const Ran ran = locate({"--window", "170", "190", "--json", "-o", "out.json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["window_deg"], Json::array({170.0, 190.0}));
  EXPECT_NEAR(result["theta_deg"], 180, 1e-6);
  EXPECT_NEAR(result["clearance"], 5, 1e-8);
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, WindowWithoutTheBestAngleHasItsOwnOptimumAtItsEnd) {
  for (const Words& window :
       {Words{"10", "40"}, Words{"-40", "-10"}, Words{"10", "10"}, Words{"370", "400"}}) {
    const Ran ran = locate(Words{"--window"} + window + Words{"--json", "-o", "out.json"});
    EXPECT_EQ(ran.status, 1) << ran.err;  // the turned plate sticks out
    const double turn = std::abs(std::remainder(ran.json()["theta"].get<double>(), 2 * kPi));
    EXPECT_NEAR(turn, 10 * kPi / 180, 1e-9);
    EXPECT_EQ(verify("out.json"), 0) << window[0];
  }
}

TEST_F(Plate, AlternativesListTheOtherWayRound) {
  const Ran ran = locate({"--alternatives", "0.001", "--json", "-o", "out.json"});
  const Json result = ran.json();
  ASSERT_EQ(result["alternatives"].size(), 1U) << ran.out;
  const Json other = result["alternatives"][0];
  const double apart = std::remainder(other["theta"].get<double>() - result["theta"].get<double>(), 2 * kPi);
  EXPECT_NEAR(std::abs(apart), kPi, 1e-6);
  EXPECT_NEAR(other["clearance"], 5, 1e-6);
  EXPECT_EQ(result["alternatives_complete"], true);
  EXPECT_EQ(verify("out.json"), 0);
}

/// A regular polygon as a text file.
TEST_F(Plate, StoppedByItsBudgetIsAValidResultWithAValidBound) {
  write_bytes(folder_ / "part.csv", regular_polygon(97, 90));
  write_bytes(folder_ / "blank.csv", regular_polygon(100, 100));
  const Ran ran = locate({"--work", "40", "--json", "-o", "out.json"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["status"], "stopped");
  EXPECT_GT(result["gap"], 1e-9);
  EXPECT_GT(result["clearance"], 5.0);
  EXPECT_EQ(verify("out.json"), 0) << "the bound of a stopped search is proved too";
  EXPECT_EQ(locate({"--work", "40", "--min-allowance", "20"}).status, 1);
}

TEST_F(Plate, LongCertificateGoesToItsFileOrIsLeftOutWithAWord) {
  write_bytes(folder_ / "part.csv", regular_polygon(79, 90));
  write_bytes(folder_ / "blank.csv", regular_polygon(82, 100));
  const Words search{"--gap", "1e-8", "--json", "-o", "out.json"};
  const Ran without = locate(search);
  ASSERT_EQ(without.status, 0) << without.err;
  EXPECT_TRUE(without.json()["certificate"].is_null());
  EXPECT_TRUE(without.json()["certificate_file"].is_null());
  EXPECT_NE(without.err.find("--certificate"), std::string::npos) << without.err;
  EXPECT_EQ(verify("out.json"), 1) << "without a certificate there is no proof to confirm";

  const Ran with = locate(search + Words{"--certificate", "out.cert"});
  ASSERT_EQ(with.status, 0) << with.err;
  EXPECT_GT(with.json()["certificate_file"]["intervals"], 10'000);
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, CtrlCStopsWithTheBestSoFarAndWritesIt) {
  write_bytes(folder_ / "part.csv", regular_polygon(4999, 90));
  write_bytes(folder_ / "blank.csv", regular_polygon(5000, 100));
  Program program(folder_.path(), kLocatePlate + Words{"--gap", "1e-13", "-o", "out.json", "--json"});
  program.send_after_work(SIGINT, 0.3);
  const Ran ran = program.wait();
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_TRUE(fs::exists(folder_ / "out.json"));
  EXPECT_TRUE(ran.json()["status"] == "stopped" || ran.json()["status"] == "optimal");
}

TEST_F(Plate, TimeLimitStopsTheSearch) {
  write_bytes(folder_ / "part.csv", regular_polygon(4999, 90));
  write_bytes(folder_ / "blank.csv", regular_polygon(5000, 100));
  const Ran ran = locate({"--gap", "1e-13", "--time", "0.2", "--json"});
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_TRUE(ran.json()["status"] == "stopped" || ran.json()["status"] == "optimal");
}

TEST_F(Plate, DentedProbingIsTrimmedInwardsAndTheLossReported) {
  write_bytes(folder_ / "blank.csv", "100 100\n145 100.25\n190 100\n190 150\n100 150\n");
  const Ran as_it_is = locate({"--json"});
  EXPECT_EQ(as_it_is.status, 0);
  EXPECT_NEAR(as_it_is.json()["clearance"], 4.875, 2e-3);
  EXPECT_NE(as_it_is.err.find("--trim"), std::string::npos) << as_it_is.err;
  const Ran ran = locate({"--trim", "0.5", "--json", "-o", "out.json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_NEAR(result["trim"]["loss"], 0.25, 1e-9);
  EXPECT_EQ(result["trim"]["tolerance"], 0.5);
  EXPECT_GE(result["trim"]["contour"].size(), 4U);
  EXPECT_NEAR(result["clearance"], 4.875, 1e-6);
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, TrimmedBlankListsItsRepeatedPoints) {
  // A probing that rests (0 and 1), repeats itself (4 and 5) and closes twice (7 and 8): the self-check once
  // missed these in the result.
  write_bytes(folder_ / "blank.csv",
              "100 100\n100 100\n145 100.25\n190 100\n190 150\n190 150\n100 150\n100 100\n100 100\n");
  const Ran ran = locate({"--trim", "0.5", "--json", "-o", "out.json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["inputs"][1]["dropped"], Json::array({1, 5, 7, 8}));
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, InchesGiveTheSamePlacementInMillimetres) {
  write_bytes(folder_ / "part.csv", "0 0\n8 0\n8 4\n0 4\n");
  write_bytes(folder_ / "blank.csv", "10 10\n19 10\n19 15\n10 15\n");
  const Ran ran = locate({"--units", "inch", "--json", "-o", "out.json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NEAR(ran.json()["clearance"], 12.7, 1e-8);
  EXPECT_EQ(ran.json()["units"], "mm");
  EXPECT_EQ(ran.json()["inputs"][0]["units"], "inch");
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, EveryContourFormatGivesTheSamePlacement) {
  write_bytes(folder_ / "p.json", "[[0, 0], [80, 0], [80, 40], [0, 40]]");
  write_bytes(folder_ / "p.dxf",
              "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n90\n4\n70\n1\n10\n0\n20\n0\n10\n80\n20\n0\n10\n80\n20"
              "\n40\n10\n0\n"
              "20\n40\n0\nENDSEC\n0\nEOF\n");
  write_bytes(folder_ / "p.txt", "x;y\n0;0\n80;0\n80;40\n0;40\n0;0\n");
  const Json expected = locate({"--json"}).json();
  for (const char* name : {"p.json", "p.dxf", "p.txt"}) {
    const Ran ran = run(folder_.path(), {"locate", "--part", name, "--blank", "blank.csv", "--json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.json()["x"], expected["x"]) << name;
    EXPECT_EQ(ran.json()["clearance"], expected["clearance"]) << name;
  }
}

TEST_F(Plate, IndicesCountTheFileWhicheverWayItRuns) {
  // Clockwise, with a collinear point (2) and a closing point (5).
  write_bytes(folder_ / "blank.csv", "100 100\n100 150\n145 150\n190 150\n190 100\n100 100\n");
  const Ran ran = locate({"--json", "-o", "out.json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["inputs"][1]["dropped"], Json::array({2, 5}));
  EXPECT_FALSE(result["warnings"].empty());
  for (const Json& contact : result["contacts"]) {
    EXPECT_NE(contact["blank_edge"], 2);
    EXPECT_LE(contact["blank_edge"], 4);
  }
  EXPECT_EQ(verify("out.json"), 0);
}

TEST_F(Plate, DeviationsAreThoseOfEveryProbedPointInFileOrder) {
  const Ran ran = locate({"--window", "-5", "5", "--deviations", "out.csv", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  std::istringstream lines(read_bytes(folder_ / "out.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "index,x,y,deviation");
  const std::array<std::array<double, 2>, 4> corners{{{100, 100}, {190, 100}, {190, 150}, {100, 150}}};
  for (std::size_t k = 0; k < corners.size(); ++k) {
    std::getline(lines, line);
    std::istringstream fields(line);
    std::size_t index = 9;
    double x = 0, y = 0, deviation = 0;
    char comma = 0;
    fields >> index >> comma >> x >> comma >> y >> comma >> deviation;
    EXPECT_EQ(index, k);
    EXPECT_EQ(x, corners[k][0]);
    EXPECT_EQ(y, corners[k][1]);
    EXPECT_NEAR(deviation, 5 * std::sqrt(2.0), 1e-6);
  }
  EXPECT_FALSE(std::getline(lines, line));
  EXPECT_EQ(ran.json()["deviations"]["points"], 4);
}

TEST_F(Plate, ProbedAgainReportsTheShiftAndWhatTheOldPlacementIsWorth) {
  ASSERT_EQ(locate({"--window", "-5", "5", "-o", "last.json"}).status, 0);
  write_bytes(folder_ / "blank.csv", "102 101\n192 101\n192 151\n102 151\n");
  const Ran ran = locate({"--window", "-5", "5", "--compare", "last.json", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json comparison = ran.json()["comparison"];
  EXPECT_EQ(comparison["same_part"], true);
  EXPECT_NEAR(comparison["dx"], 2, 1e-6);
  EXPECT_NEAR(comparison["dy"], 1, 1e-6);
  EXPECT_NEAR(comparison["dtheta"], 0, 1e-9);
  EXPECT_NEAR(comparison["largest_shift"], std::sqrt(5.0), 1e-6);
  EXPECT_NEAR(comparison["last_clearance"], 5, 1e-8);
  EXPECT_NEAR(comparison["last_pose_clearance"], 3, 1e-6);
  EXPECT_EQ(ran.json()["inputs"][2]["role"], "last-result");
}

TEST_F(Plate, ComparedWithAnotherPartIsSaid) {
  ASSERT_EQ(locate({"-o", "last.json"}).status, 0);
  write_bytes(folder_ / "part.csv", "0 0\n80 0\n80 39\n0 39\n");
  const Ran ran = locate({"--compare", "last.json", "--json"});
  EXPECT_EQ(ran.json()["comparison"]["same_part"], false);
  EXPECT_NE(ran.err.find("another part"), std::string::npos) << ran.err;
}

TEST_F(Plate, ReferenceMethodsProveNothingAndSayTheTruth) {
  for (const char* method : {"ipopt", "icp"}) {
#ifndef LEKALO_WITH_IPOPT
    if (std::string(method) == "ipopt") continue;
#endif
    const Ran ran = locate({"--method", method, "--json", "-o", "out.json"});
    const Json result = ran.json();
    EXPECT_EQ(result["status"], "unproved") << method;
    EXPECT_EQ(result["method"], method);
    EXPECT_TRUE(result["upper_bound"].is_null());
    EXPECT_TRUE(result["gap"].is_null());
    EXPECT_TRUE(result["certificate"].is_null());
    EXPECT_LE(result["clearance"], 5.0);
    EXPECT_EQ(ran.status, result["clearance"] >= 0.0 ? 0 : 1);
    EXPECT_EQ(verify("out.json"), 1) << method;
  }
}

TEST_F(Plate, OptionsWithoutEffectAreNamed) {
  const Ran ran = locate({"--starts", "3", "--json"});
  EXPECT_EQ(ran.status, 0);
  ASSERT_EQ(ran.json()["warnings"].size(), 1U);
  EXPECT_NE(ran.json()["warnings"][0].get<std::string>().find("--starts"), std::string::npos);
}

TEST_F(Plate, PictureNumbersContactsLikeTheResult) {
  // Clockwise and with a repeated first point, so that no index of the solver is that of the file.
  write_bytes(folder_ / "part.csv", "0 0\n0 0\n0 40\n80 40\n80 0\n");
  write_bytes(folder_ / "blank.csv", "100 100\n100 100\n100 150\n190 150.5\n190 100\n");
  const Ran ran = locate({"--json", "--picture", "out.svg"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const std::string picture = read_bytes(folder_ / "out.svg");
  ASSERT_FALSE(ran.json()["contacts"].empty());
  const Json result = ran.json();
  for (const Json& contact : result["contacts"]) {
    const std::string label = "v" + contact["part_vertex"].dump() + " e" + contact["blank_edge"].dump();
    EXPECT_NE(picture.find(label), std::string::npos) << label;
  }
}

TEST_F(Plate, NamesThatAreNotUtf8Work) {
  const std::string name = "bl\xe4nk.csv";  // Latin-1
  write_bytes(folder_ / name, kPlateBlank);
  const Ran ran = run(folder_.path(), {"locate", "--part", "part.csv", "--blank", name, "-o",
                                       "r\xe9sult.json", "--json", "--picture", "p.svg"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["inputs"][1]["path"], "bl\xEF\xBF\xBDnk.csv");
  EXPECT_EQ(ran.json()["warnings"].size(), 1U);
  ASSERT_TRUE(fs::exists(folder_ / "r\xe9sult.json"));
  EXPECT_EQ(verify("r\xe9sult.json"), 4) << "the name in the result is not that of the file";
  EXPECT_EQ(run(folder_.path(), {"verify", "r\xe9sult.json", "--blank", name}).status, 0);
}

TEST_F(Plate, FullDiskBehindStdoutIsAnErrorAndLeavesNoFile) {
  const auto before = folder_.files();
  const Ran ran =
      Program(folder_.path(), kLocatePlate + Words{"--json", "-o", "out.json"}, "/dev/full").wait();
  EXPECT_EQ(ran.status, 5);
  EXPECT_NE(ran.err.find("stdout"), std::string::npos) << ran.err;
  EXPECT_TRUE(folder_.files() == before);
}

TEST_F(Plate, SelfCheckIsOnTheBytesThatAreWritten) {
  // What the file says is confirmed without the program that wrote it knowing any more.
  ASSERT_EQ(locate({"-o", "out.json"}).status, 0);
  const std::string result = read_bytes(folder_ / "out.json");
  EXPECT_EQ(verify("out.json"), 0);
  const Json parsed = Json::parse(result);
  EXPECT_EQ(parsed["clearance"].get<double>() <= parsed["upper_bound"].get<double>(), true);
}

TEST(Help, ExplainsEveryCommand) {
  const TemporaryFolder folder;
  const Ran all = run(folder.path(), {"--help"});
  EXPECT_EQ(all.status, 0);
  for (const char* word : {"locate", "verify", "completion"}) {
    EXPECT_NE(all.out.find(word), std::string::npos) << all.out;
  }
  const Ran locate = run(folder.path(), {"locate", "--help"});
  EXPECT_EQ(locate.status, 0);
  for (const char* word : {"--part",       "--blank",         "--units",        "--window",
                           "--gap",        "--min-allowance", "--method",       "--starts",
                           "--seed",       "--work",          "--alternatives", "--nc",
                           "--nc-out",     "--nc-mode",       "--wcs",          "-o",
                           "--picture",    "--json",          "--trim",         "--compare",
                           "--deviations", "--certificate",   "Exit codes"}) {
    EXPECT_NE(locate.out.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(run(folder.path(), {"verify", "--help"}).status, 0);
}

TEST(Help, VersionIsOneLine) {
  const TemporaryFolder folder;
  const Ran ran = run(folder.path(), {"--version"});
  EXPECT_EQ(ran.status, 0);
  EXPECT_EQ(ran.out.rfind("lekalo ", 0), 0U);
  EXPECT_EQ(ran.out.find('\n'), ran.out.size() - 1);
}

TEST(Completion, KnowsCommandsOptionsAndChoices) {
  const TemporaryFolder folder;
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Ran ran = run(folder.path(), {"completion", shell});
    EXPECT_EQ(ran.status, 0);
    for (const char* word : {"locate", "verify", "min-allowance", "certified ipopt icp"}) {
      EXPECT_NE(ran.out.find(word), std::string::npos) << shell << ' ' << word;
    }
  }
}

TEST(Completion, BashUnderstandsItsScript) {
  const TemporaryFolder folder;
  write_bytes(
      folder / "try.sh",
      "eval \"$(" + cases::program() +
          " completion bash)\"\nCOMP_WORDS=(lekalo locate --meth)\nCOMP_CWORD=2\n_lekalo\n"
          "echo \"${COMPREPLY[@]}\" > out\nCOMP_WORDS=(lekalo locate --method i)\nCOMP_CWORD=3\n_lekalo\n"
          "echo \"${COMPREPLY[@]}\" >> out\n");
  ASSERT_EQ(std::system(("cd " + folder.path().string() + " && bash try.sh").c_str()), 0);
  EXPECT_EQ(read_bytes(folder / "out"), "--method\nipopt icp\n");
}

}  // namespace
}  // namespace lekalo::test::cli_locate_test

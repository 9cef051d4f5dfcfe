#include <csignal>

#include "e2e/cli_run.hpp"
#include "support/solid_cases.hpp"
#include "support/solid_files.hpp"
#include "support/three_mf_files.hpp"

/// `lekalo locate` for solids, as a person runs it.
namespace lekalo::test::cli_solids_test {
namespace {

const solid::Mesh kPart = cases::block({-20, -15, -10}, {20, 15, 10});
const solid::Mesh kBlank = cases::block({-22, -17, -13}, {24, 17, 11});

class Solids : public testing::Test {
 protected:
  void SetUp() override {
    write_bytes(folder_ / "part.stl", solid_files::stl_binary(kPart));
    write_bytes(folder_ / "casting.ply", solid_files::ply<float>(kBlank, solid_files::PlyForm::little));
  }
  [[nodiscard]] Ran locate(const Words& more) const {
    return run(folder_.path(), Words{"locate", "--part", "part.stl", "--blank", "casting.ply"} + more);
  }
  [[nodiscard]] Ran verify(const std::string& result) const {
    return run(folder_.path(), {"verify", result});
  }
  /// Places the example's part with a file of features that is beside it.
  [[nodiscard]] Ran example_with(const char* features) const {
    const fs::path solids = fs::path(cases::source_dir()) / "examples" / "solid";
    return run(folder_.path(), {"locate", "--part", solids / "part.stl", "--blank", solids / "casting.stl",
                                "--features", solids / features, "--gap", "0.2", "-o", "r.json", "--json"});
  }
  TemporaryFolder folder_;
};

TEST_F(Solids, APlacementIsFoundToldAndConfirmed) {
  const Ran ran = locate({"--min-allowance", "1.9", "--gap", "0.05", "-o", "r.json", "--json", "--allowances",
                          "a.csv", "--picture", "p.png", "--certificate", "c.json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json result = ran.json();
  EXPECT_EQ(result["status"], "optimal");
  EXPECT_NEAR(result["clearance"], 2, 0.05);
  EXPECT_LE(result["clearance"], 2.0);
  EXPECT_GE(result["upper_bound"], 2.0);
  EXPECT_LE(result["gap"], 0.05);
  EXPECT_TRUE(result["certificate"].is_null());
  EXPECT_EQ(result["certificate_file"]["path"], "c.json");
  const auto files = folder_.files();
  EXPECT_EQ(files.size(), 6U);
  EXPECT_EQ(files.at("r.json"), ran.out);
  EXPECT_EQ(files.at("p.png").substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(files.at("a.csv").rfind("index,x_part,", 0), 0U);
  for (const char* words :
       {"The best placement was found and proved.", "the part lies at   x = ", "turned by  ",
        "minimum allowance  1.9", "1.9 mm: met",
        "no placement within 5 mm and 5 degrees of the start (about some axes 8.65 degrees) has more than",
        "nearest at         blank (", "wrote              r.json", "wrote              a.csv",
        "part.stl: the file does not say its unit"})
    EXPECT_NE(ran.err.find(words), std::string::npos) << words << " is not in\n" << ran.err;
  EXPECT_EQ(verify("r.json").status, 0);
  write_bytes(folder_ / "c.json", files.at("c.json") + "\n");
  EXPECT_EQ(verify("r.json").status, 4);
}

TEST_F(Solids, AllTurnsAreProvedAndAFoundStartAndWhatIsSymmetricAreTold) {
  const Ran ran = locate({"--freedom", "c-xyz", "--window", "-180", "180", "--find-start", "--shift", "5",
                          "--gap", "0.05", "-o", "r.json", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["window"]["turn_deg"], 180);
  for (const char* words : {"start              found by climbs from all over: the middle of the part at (",
                            "no placement within 5 mm of the start, turned anyhow about z, has more than",
                            "the part is the same after 1/2 of a turn about its axis (",
                            "this pose is one of 4 equal ones", "estimated, within 0.05 mm"})
    EXPECT_NE(ran.err.find(words), std::string::npos) << words << " is not in\n" << ran.err;
  EXPECT_EQ(verify("r.json").status, 0);
}

TEST_F(Solids, A3mfIsPlacedInItsOwnUnitAndConfirmed) {
  using namespace three_mf_files;
  const std::string inches = "unit=\"inch\"";
  solid::Mesh part = kPart;
  for (solid::Vector& p : part.vertices) p = 1 / 25.4 * p;
  write_bytes(folder_ / "part.3mf", archive(model(object(1, mesh(part), "name=\"part\""), item(1), inches)));
  write_bytes(folder_ / "casting.3mf", archive(kBlank));
  const Words words{"locate", "--part",    "part.3mf", "--blank", "casting.3mf", "--method",
                    "climb",  "--freedom", "xyz",      "-o",      "r.json",      "--json"};
  const Ran ran = run(folder_.path(), words);
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NEAR(ran.json()["clearance"], 2, 0.05);
  EXPECT_EQ(ran.json()["inputs"][0]["units"], "inch");
  EXPECT_EQ(verify("r.json").status, 1);  // no bound, and the rest is confirmed
  std::string result = ran.out;
  const std::size_t unit = result.find("\"inch\"");
  write_bytes(folder_ / "r.json", result.replace(unit, 6, "\"mm\""));
  const Ran refuted = verify("r.json");
  EXPECT_EQ(refuted.status, 4);
  EXPECT_NE((refuted.out + refuted.err).find("the part is said to be in another unit than part.3mf says"),
            std::string::npos)
      << refuted.err;
  const Ran refused = run(folder_.path(), words + Words{"--units", "inch"});
  EXPECT_EQ(refused.status, 3);
  EXPECT_NE(
      refused.err.find("casting.3mf: '3D/3dmodel.model': line 2: the file says mm, but inch was asked for"),
      std::string::npos)
      << refused.err;
}

TEST_F(Solids, AProgramOfThreeAxesIsWrittenForThePlacement) {
  write_bytes(folder_ / "p.nc", "G21 G90 G17 G54\nG0 X-20. Y-15. Z30.\nG1 Z9. F200.\nX20.\nG0 Z30.\nM30\n");
  const Words program{"--nc", "p.nc", "--nc-out", "o.nc", "-o", "r.json", "--method", "climb"};
  const Ran refused = locate(program);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--nc, whose program has three axes, goes with --freedom c-xyz or xyz"),
            std::string::npos)
      << refused.err;
  const Ran ran = locate(program + Words{"--freedom", "c-xyz"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("NC program         4 motions"), std::string::npos) << ran.err;
  EXPECT_NE(ran.err.find("zero in X, Y and Z"), std::string::npos) << ran.err;
  EXPECT_EQ(verify("r.json").status, 1);  // no bound, and the rest is confirmed
  std::string bytes = read_bytes(folder_ / "o.nc");
  bytes.replace(bytes.find(" Z", bytes.find("X-")), 2, " Z1");
  write_bytes(folder_ / "o.nc", bytes);
  EXPECT_EQ(verify("r.json").status, 4);
  write_bytes(folder_ / "p.nc", "G21 G90\nG0 X1. Y2.\nG1 X5. F9.\n");
  const Ran high = locate(program + Words{"--freedom", "xyz"});
  EXPECT_EQ(high.status, 3);
  EXPECT_NE(high.err.find("p.nc:3: it cuts at a Z that the program has not said"), std::string::npos)
      << high.err;
}

TEST_F(Solids, TheLinesOfAWorkOffsetAreWrittenAndConfirmed) {
  const Words offset{"--offset-out", "lines.txt", "-o", "r.json", "--method", "climb"};
  for (const auto& [more, sentence] :
       {std::pair{Words{"--offset", "linuxcnc"}, "--offset linuxcnc, which turns about Z alone"},
        {Words{"--offset", "fanuc"},
         "--offset with --freedom six is for a machine that can tilt: say --axes 5"},
        {Words{"--offset", "heidenhain"}, "--offset: \"heidenhain\" is not one of"},
        {Words{}, "--offset CONTROL and --offset-out FILE need each other"}}) {
    const Ran refused = locate(offset + more);
    EXPECT_EQ(refused.status, 2) << refused.err;
    EXPECT_NE(refused.err.find(sentence), std::string::npos) << refused.err;
  }
  const Ran ran = locate(offset + Words{"--offset", "siemens", "--axes", "5", "--wcs", "2"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("wrote              lines.txt"), std::string::npos) << ran.err;
  const std::string lines = read_bytes(folder_ / "lines.txt");
  EXPECT_NE(lines.find("\nG71 G55\nTRANS X"), std::string::npos) << lines;
  EXPECT_EQ(verify("r.json").status, 1);  // no bound, and the rest is confirmed
  std::filesystem::remove(folder_ / "lines.txt");
  EXPECT_NE(verify("r.json").err.find("lines.txt is not there"), std::string::npos);
}

TEST_F(Solids, APageThatTurnsIsAPictureAndFourViewsAreAReport) {
  ASSERT_EQ(locate({"--method", "climb", "--picture", "p.html", "--report", "r.pdf"}).status, 0);
  EXPECT_NE(read_bytes(folder_ / "p.html").find("<canvas"), std::string::npos);
  EXPECT_EQ(read_bytes(folder_ / "r.pdf").substr(0, 5), "%PDF-");
}

TEST_F(Solids, AQuickPlacementProvesNothing) {
  const Ran ran = locate({"--method", "climb", "-o", "r.json", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["status"], "unproved");
  EXPECT_NE(ran.err.find("it proves nothing about others"), std::string::npos) << ran.err;
  EXPECT_EQ(ran.err.find("no placement"), std::string::npos) << ran.err;
  const Ran verified = verify("r.json");
  EXPECT_EQ(verified.status, 1) << verified.err;
  EXPECT_NE(verified.err.find("Unproved"), std::string::npos) << verified.err;
}

TEST_F(Solids, MethodsKeptForComparisonAreVerifiedAsUnproved) {
  for (const char* method : {"icp", "axes"}) {
    const Ran ran = locate({"--method", method, "-o", "r.json", "--json"});
    ASSERT_EQ(ran.status, 0) << ran.err;
    EXPECT_EQ(ran.json()["method"], method);
    EXPECT_EQ(ran.json()["status"], "unproved");
    EXPECT_EQ(verify("r.json").status, 1);
  }
}

TEST_F(Solids, FacesHaveTheirOwnDemands) {
  const auto features = [&](const char* minimum) {
    write_bytes(folder_ / "f.json",
                std::string(R"({"minimum": 0.5, "features": [{"name": "end", "minimum": )") + minimum +
                    R"(, "plane": {"normal": [1, 0, 0], "at": -20, "within": 0.01}}]})");
  };
  const Words words{"--features", "f.json", "--gap", "0.05", "-o", "r.json", "--json"};
  features("1");
  const Ran ran = locate(words);
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["status"], "optimal");
  EXPECT_EQ(ran.json()["demands"]["features"][0]["triangles"], 2);
  EXPECT_NE(ran.err.find("demands            met, with a margin of "), std::string::npos) << ran.err;
  EXPECT_NEAR(ran.json()["demands"]["margin"].get<double>(), 1, 0.06);
  EXPECT_NE(ran.err.find("no placement within 5 mm and 5 degrees of the start (about some axes 8.65 degrees) "
                         "has a margin above 1.0"),
            std::string::npos)
      << ran.err;
  EXPECT_EQ(verify("r.json").status, 0);
  features("0.9");
  EXPECT_EQ(verify("r.json").status, 4);
  features("2.5");
  const Ran missed = locate(words);
  EXPECT_EQ(missed.status, 1) << missed.err;
  EXPECT_NE(missed.err.find("No placement in the window meets the demands; this is proved."),
            std::string::npos)
      << missed.err;
  EXPECT_NE(missed.err.find("mm are missing on \"end\", at the part's (-20.000, "), std::string::npos)
      << missed.err;
  EXPECT_EQ(verify("r.json").status, 0);
}

TEST_F(Solids, TheExampleOfDemandsIsMet) {
  const Ran ran = example_with("features.json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["status"], "optimal");
  EXPECT_GT(ran.json()["demands"]["margin"], 0.0);
  EXPECT_EQ(verify("r.json").status, 0);
}

TEST_F(Solids, DatumsAreKeptAndTold) {
  const fs::path solids = fs::path(cases::source_dir()) / "examples" / "solid";
  const auto placed = [&](const fs::path& features) {
    return run(folder_.path(), {"locate", "--part", solids / "part.stl", "--blank", solids / "casting.stl",
                                "--features", features, "--gap", "0.2", "-o", "r.json", "--json"});
  };
  const Ran ran = placed(solids / "datums.json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["status"], "optimal");
  for (const char* words :
       {"datum              \"seat\" is kept within 0.1 mm: the part is off it by up to 0.0",
        "datum              \"bore\" is kept within 0.2 mm",
        "of the start (about some axes 8.65 degrees) that keeps the datums has"})
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
  EXPECT_EQ(verify("r.json").status, 0);
  // A seat 20 mm higher is out of reach.
  std::string higher = read_bytes(solids / "datums.json");
  higher.replace(higher.find("-19.2"), 5, "0.800");
  write_bytes(folder_ / "higher.json", higher);
  const Ran none = placed("higher.json");
  EXPECT_EQ(none.status, 1) << none.err;
  EXPECT_EQ(none.json()["status"], "infeasible");
  const auto seat = none.json()["demands"]["datums"][0];
  EXPECT_NEAR(seat["missed"], seat["off"].get<double>() - seat["within"].get<double>(), 1e-9);
  for (const char* words :
       {"No placement in the window meets the demands and keeps the datums; this is proved.",
        "none: the datum \"seat\" is missed by ", "\"seat\" is not kept within 0.1 mm"})
    EXPECT_NE(none.err.find(words), std::string::npos) << none.err;
  EXPECT_EQ(verify("r.json").status, 0);
}

TEST_F(Solids, MaximaAreKeptAndTold) {
  const fs::path solids = fs::path(cases::source_dir()) / "examples" / "solid";
  const auto placed = [&](const fs::path& features) {
    return run(folder_.path(), {"locate", "--part", solids / "part.stl", "--blank", solids / "casting.stl",
                                "--features", features, "--work", "40", "-o", "r.json", "--json"});
  };
  const Ran ran = placed(solids / "maxima.json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  for (const char* words : {"maximum            \"top\" keeps 3.5 mm: its largest allowance is",
                            "maximum            \"underside\" keeps 3.2 mm", "that keeps the maxima has"})
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
  EXPECT_EQ(verify("r.json").status, 0);
  // Top and underside have 6.1 mm together.
  std::string less = read_bytes(solids / "maxima.json");
  less.replace(less.find("3.5"), 3, "2.5");
  write_bytes(folder_ / "less.json", less);
  const Ran none = placed("less.json");
  EXPECT_EQ(none.status, 1) << none.err;
  EXPECT_NE(none.err.find("none: a maximum is not kept"), std::string::npos) << none.err;
  EXPECT_EQ(verify("r.json").status, 0);
}

TEST_F(Solids, FinishedFacesLieInTheSurfaceOfTheBlank) {
  // The blank's top is 1 mm over the part's, and may be cut into by 0.2.
  const auto placed = [&](const std::string& others) {
    write_bytes(folder_ / "f.json", R"({"as_cast": true, "features": [
      {"name": "top", "plane": {"normal": [0, 0, 1], "at": 10, "within": 0.001}, "finished": 0.2},
      {"name": "underside", "plane": {"normal": [0, 0, 1], "at": -10, "within": 0.001}, )" +
                                        others + "]}");
    return locate({"--features", "f.json", "--json", "-o", "r.json"});
  };
  const Ran ran = placed(R"("minimum": 1.5})");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_NE(ran.err.find("finished           \"top\" is within 0.2 mm of the blank's surface: the farthest"),
            std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("that keeps the finished faces has a margin above"), std::string::npos) << ran.err;
  EXPECT_LE(ran.json()["demands"]["features"][0]["largest"], 0.2);
  EXPECT_EQ(verify("r.json").status, 0);
  // The blank is 4 mm higher than the part.
  const Ran none = placed(R"("finished": 0.2}, {"name": "end", "minimum": 0, "plane":
    {"normal": [1, 0, 0], "at": 20, "within": 0.001}})");
  EXPECT_EQ(none.status, 1) << none.err;
  EXPECT_EQ(none.json()["status"], "infeasible");
  EXPECT_NE(none.err.find("none: a finished face is too far from the blank's surface"), std::string::npos)
      << none.err;
  EXPECT_EQ(verify("r.json").status, 0);
}

TEST_F(Solids, TheExampleOfAFinishedBoreIsMet) {
  // The bore's edge demands nothing: with less stock left there than is asked for the top.
  const Ran ran = example_with("finished.json");
  ASSERT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.json()["status"], "optimal");
  EXPECT_EQ(ran.json()["demands"]["features"][0]["rim"], 2.5);
  EXPECT_EQ(verify("r.json").status, 0);
}

TEST_F(Solids, ACriterionChoosesThePlacementWithLeastToCut) {
  // Across there are 4 mm together and along 6, so that along x the part may lie anywhere from 2 to 4.
  const Ran ran = locate({"--criterion", "largest", "--give-up", "0.1", "--min-allowance", "1.95", "--gap",
                          "0.02", "-o", "r.json", "--json"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json choice = ran.json()["choice"];
  EXPECT_EQ(choice["criterion"], "largest");
  EXPECT_EQ(choice["give_up"], 0.1);
  EXPECT_GE(choice["largest"], 3.0);
  EXPECT_LE(choice["largest"], 3.02);
  EXPECT_NEAR(choice["margin_found"], 2, 0.02);
  EXPECT_GE(ran.json()["clearance"], 1.95);
  for (const char* words : {"The largest margin was found and proved, and a placement near it chosen.",
                            "largest allowance  3.0", "that there is no smaller one is not proved"})
    EXPECT_NE(ran.err.find(words), std::string::npos) << words << " is not in\n" << ran.err;
  EXPECT_EQ(verify("r.json").status, 0);
  std::string lie = ran.out;
  lie.replace(lie.find("\"largest\": 3.0"), 14, "\"largest\": 2.9");
  write_bytes(folder_ / "lie.json", lie);
  EXPECT_EQ(verify("lie.json").status, 4);
  const Ran icp = locate({"--criterion", "largest", "--method", "icp"});
  EXPECT_EQ(icp.status, 2);
  EXPECT_NE(icp.err.find("which --method icp does not look for"), std::string::npos) << icp.err;
}

TEST_F(Solids, TargetsOfTheExampleAreNearlyMet) {
  const fs::path solids = fs::path(cases::source_dir()) / "examples" / "solid";
  const auto placed = [&](const Words& more) {
    return run(folder_.path(), Words{"locate", "--part", solids / "part.stl", "--blank",
                                     solids / "casting.stl", "--features", solids / "targets.json",
                                     "--method", "climb", "--gap", "0.05", "-o", "r.json", "--json"} +
                                   more);
  };
  const Ran ran = placed({"--criterion", "even", "--give-up", "0.5"});
  ASSERT_EQ(ran.status, 0) << ran.err;
  const Json choice = ran.json()["choice"];
  EXPECT_EQ(choice["criterion"], "even");
  EXPECT_LE(choice["largest"], choice["largest_found"].get<double>() + 0.5);
  for (const char* words : {"even               allowances deviate by ",
                            "that no placement is more even is not proved", "and of the smallest "})
    EXPECT_NE(ran.err.find(words), std::string::npos) << words << " is not in\n" << ran.err;
  EXPECT_EQ(verify("r.json").status, 1) << "there is no certificate";
  // With nothing to give up it is less even.
  const Ran close = placed({"--criterion", "even"});
  ASSERT_EQ(close.status, 0) << close.err;
  EXPECT_GE(close.json()["choice"]["deviation"], choice["deviation"]);
  std::string lie = ran.out;
  const std::size_t at = lie.find("\"deviation\": ") + 13;
  lie.insert(at, "1");
  write_bytes(folder_ / "lie.json", lie);
  EXPECT_EQ(verify("lie.json").status, 4);
}

TEST_F(Solids, ADemandThatIsMissedIsExitStatusOne) {
  const Ran ran = locate({"--min-allowance", "3", "--method", "climb", "-o", "r.json"});
  EXPECT_EQ(ran.status, 1);
  EXPECT_NE(ran.err.find("are missing"), std::string::npos) << ran.err;
  EXPECT_TRUE(fs::exists(folder_ / "r.json"));
}

TEST_F(Solids, APartThatDoesNotFitIsToldWithWhatToTry) {
  write_bytes(folder_ / "casting.ply", solid_files::obj(cases::block({100, -17, -13}, {146, 17, 11})));
  const Ran ran = locate({"--json", "-o", "r.json", "--picture", "p.png", "--report", "r.svg"});
  EXPECT_EQ(ran.status, 1) << ran.err;
  EXPECT_EQ(ran.json()["inside"], false);
  EXPECT_NE(read_bytes(folder_ / "r.svg").find("<svg"), std::string::npos);
  for (const char* words : {"inside the blank", "the part is not inside the blank", "--shift"})
    EXPECT_NE(ran.err.find(words), std::string::npos) << ran.err;
  const Ran verified = verify("r.json");
  EXPECT_EQ(verified.status, 0);
  EXPECT_NE(verified.err.find("not inside there, and the bound holds"), std::string::npos) << verified.err;
}

TEST_F(Solids, ADemandThatNoPoseMeetsIsProvedImpossible) {
  const Ran ran = locate({"--min-allowance", "2.1", "--gap", "0.05", "-o", "r.json", "--json"});
  EXPECT_EQ(ran.status, 1) << ran.err;
  EXPECT_EQ(ran.json()["status"], "infeasible");
  EXPECT_NEAR(ran.json()["shortfall"], 0.1, 0.05);
  EXPECT_NE(ran.err.find("this is proved"), std::string::npos) << ran.err;
  EXPECT_EQ(verify("r.json").status, 0);
}

TEST_F(Solids, AnEarlierResultIsTheStart) {
  ASSERT_EQ(locate({"--method", "climb", "-o", "r.json"}).status, 0);
  const Ran again =
      locate({"--method", "climb", "--start", "r.json", "--shift", "0.1", "--tilt", "0.1", "--json"});
  EXPECT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(again.json()["inputs"][2]["role"], "start");
  EXPECT_EQ(again.json()["window"]["x"], Json::parse(read_bytes(folder_ / "r.json"))["x"]);
}

TEST_F(Solids, InterruptedTheSearchKeepsItsBest) {
  Random random(5);
  const cases::SolidCase slow = cases::turned_part(random, 48);
  write_bytes(folder_ / "part.stl", solid_files::stl_binary(slow.part));
  write_bytes(folder_ / "casting.ply", solid_files::ply<float>(slow.blank, solid_files::PlyForm::little));
  Program program(folder_.path(), {"locate", "--part", "part.stl", "--blank", "casting.ply", "--gap", "1e-6",
                                   "-o", "r.json"});
  program.send_after_work(SIGINT, 0.3);
  const Ran ran = program.wait();
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(verify("r.json").status, 0);
  const Ran timed = locate({"--gap", "1e-6", "--time", "0.3", "--json"});
  EXPECT_EQ(timed.status, 0) << timed.err;
  EXPECT_EQ(timed.json()["status"], "stopped");
  EXPECT_TRUE(timed.json()["inside"].get<bool>());
}

struct Refused {
  std::string title;
  Words words;
  int status;
  Words named;
};

class SolidWords : public Solids, public testing::WithParamInterface<Refused> {};

TEST_P(SolidWords, AreRefusedInOneSentenceAndNothingIsWritten) {
  const Refused& refused = GetParam();
  write_plate(folder_);
  write_bytes(folder_ / "cloud.xyz", solid_files::points(kBlank.vertices));
  write_bytes(folder_ / "empty.stl", "");
  solid::Mesh open = kBlank;
  open.triangles.pop_back();
  write_bytes(folder_ / "open.stl", solid_files::stl_text(open));
  const auto before = folder_.files();
  const Ran ran = run(folder_.path(), Words{"locate"} + refused.words + Words{"-o", "r.json"});
  EXPECT_EQ(ran.status, refused.status) << ran.err;
  EXPECT_EQ(ran.err.find('\n'), ran.err.size() - 1) << ran.err;
  for (const std::string& word : refused.named) EXPECT_NE(ran.err.find(word), std::string::npos) << ran.err;
  EXPECT_TRUE(folder_.files() == before);
}

const Words kSolids{"--part", "part.stl", "--blank", "casting.ply"};
const Words kOutlines{"--part", "part.csv", "--blank", "blank.csv"};

std::string test_name(const testing::TestParamInfo<Refused>& of) {
  std::string name;
  for (const char c : of.param.title) name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(
    All, SolidWords,
    testing::Values(
        Refused{"an outline in a solid",
                {"--part", "part.csv", "--blank", "open.stl"},
                3,
                {"open.stl is a solid"}},
        Refused{
            "a solid in an outline", {"--part", "part.stl", "--blank", "blank.csv"}, 3, {"both as solids"}},
        Refused{"points as a blank",
                {"--part", "part.stl", "--blank", "cloud.xyz"},
                3,
                {"cloud.xyz: points are not a closed surface"}},
        Refused{"an open mesh",
                {"--part", "part.stl", "--blank", "open.stl"},
                3,
                {"open.stl: the surface is open", "triangle", "close it"}},
        Refused{"an empty file", {"--part", "empty.stl", "--blank", "casting.ply"}, 3, {"empty.stl"}},
        Refused{"words of the plane",
                kSolids + Words{"--mirror", "yes", "--trim", "1", "--seed", "4"},
                2,
                {"--trim, --mirror and --seed are for outlines"}},
        Refused{"a method of the plane",
                kSolids + Words{"--method", "ipopt"},
                2,
                {"--method ipopt is for outlines"}},
        Refused{"words of solids",
                kOutlines + Words{"--freedom", "xyz", "--shift", "3", "--tilt", "2"},
                2,
                {"--freedom, --tilt and --shift are for solids"}},
        Refused{"a drawing of solids",
                kSolids + Words{"--picture", "p.svg"},
                2,
                {"--picture p.svg is for outlines"}},
        Refused{"a page of outlines",
                kOutlines + Words{"--picture", "p.html"},
                2,
                {"--picture p.html is for solids"}},
        Refused{
            "a method of solids", kOutlines + Words{"--method", "axes"}, 2, {"--method axes is for solids"}},
        Refused{"metres in the plane", kOutlines + Words{"--units", "m"}, 2, {"--units m is for solids"}},
        Refused{"a freedom nobody knows",
                kSolids + Words{"--freedom", "five"},
                2,
                {"--freedom", "xyz, c-xyz, six"}},
        Refused{"a tilt beyond a quarter turn", kSolids + Words{"--tilt", "91"}, 2, {"--tilt", "90", "180"}},
        Refused{"a tilt beyond all", kSolids + Words{"--tilt", "181"}, 2, {"--tilt", "180"}},
        Refused{"a start that is given and looked for",
                kSolids + Words{"--find-start", "--start", "s.json"},
                2,
                {"--find-start and --start"}},
        Refused{"a start in the plane that is looked for",
                kOutlines + Words{"--find-start"},
                2,
                {"--find-start is for solids"}},
        Refused{"a negative shift", kSolids + Words{"--shift", "-1"}, 2, {"--shift"}},
        Refused{"a window with six freedoms", kSolids + Words{"--window", "-5", "5"}, 2, {"c-xyz", "--tilt"}},
        Refused{"a window of more than half a turn",
                kSolids + Words{"--freedom", "c-xyz", "--window", "0", "181"},
                2,
                {"--window", "180", "360"}},
        Refused{"a tilt about z", kSolids + Words{"--freedom", "c-xyz", "--tilt", "1"}, 2, {"--freedom six"}},
        Refused{"a certificate of a climb",
                kSolids + Words{"--method", "climb", "--certificate", "c.json"},
                2,
                {"--certificate", "climb"}},
        Refused{"a start that is no result", kSolids + Words{"--start", "part.csv"}, 3, {"part.csv"}},
        Refused{"the result over the start",
                kSolids + Words{"--start", "s.json", "--certificate", "s.json"},
                2,
                {"--start"}}),
    test_name);

}  // namespace
}  // namespace lekalo::test::cli_solids_test

// The checker and results of `lekalo heat`: honest ones hold, and lies about every figure that it can make
// anew are refuted.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "lekalo/jobs/heat_result.hpp"
#include "lekalo/verify/claims.hpp"
#include "support/json.hpp"
#include "support/json_paths.hpp"
#include "support/prepared.hpp"
#include "verify/claims/heat_fields.hpp"
#include "verify/heat/cut_work.hpp"

namespace lekalo::verify_heat_test {
namespace {

using cases::each_path;
using cases::is_number;
using cases::Json;
using cases::one_of;
using heat::Property;

const std::string kPocket =
    R"({"units":"mm","outer":[{"line":{"from":[0,0],"to":[20,0]}},{"line":{"from":[20,0],"to":[20,16]}},)"
    R"({"line":{"from":[20,16],"to":[0,16]}},{"line":{"from":[0,16],"to":[0,0]}}]})";
/// A ring whose contours turn the other way round, and whose outer circle is one edge.
const std::string kRing =
    R"({"units":"mm","outer":[{"arc":{"from":[15,0],"to":[15,0],"centre":[0,0],"ccw":false}}],)"
    R"("islands":[[{"arc":{"from":[7,0],"to":[-7,0],"centre":[0,0],"ccw":true}},)"
    R"({"arc":{"from":[-7,0],"to":[7,0],"centre":[0,0],"ccw":true}}]]})";

/// Corners of the tool's radius, and the same the other way round.
const std::string kRounded =
    R"({"units":"mm","outer":[{"line":{"from":[3,0],"to":[17,0]}},)"
    R"({"arc":{"from":[17,0],"to":[20,3],"centre":[17,3],"ccw":true}},{"line":{"from":[20,3],"to":[20,13]}},)"
    R"({"arc":{"from":[20,13],"to":[17,16],"centre":[17,13],"ccw":true}},{"line":{"from":[17,16],"to":[3,16]}},)"
    R"({"arc":{"from":[3,16],"to":[0,13],"centre":[3,13],"ccw":true}},{"line":{"from":[0,13],"to":[0,3]}},)"
    R"({"arc":{"from":[0,3],"to":[3,0],"centre":[3,3],"ccw":true}}]})";
const std::string kRoundedBack =
    R"({"units":"mm","outer":[{"arc":{"from":[3,0],"to":[0,3],"centre":[3,3],"ccw":false}},)"
    R"({"line":{"from":[0,3],"to":[0,13]}},{"arc":{"from":[0,13],"to":[3,16],"centre":[3,13],"ccw":false}},)"
    R"({"line":{"from":[3,16],"to":[17,16]}},{"arc":{"from":[17,16],"to":[20,13],"centre":[17,13],"ccw":false}},)"
    R"({"line":{"from":[20,13],"to":[20,3]}},{"arc":{"from":[20,3],"to":[17,0],"centre":[17,3],"ccw":false}},)"
    R"({"line":{"from":[17,0],"to":[3,0]}}]})";
const std::string kDisc =
    R"({"units":"mm","outer":[{"arc":{"from":[15,0],"to":[15,0],"centre":[0,0],"ccw":true}}]})";

const std::string kProgram =
    "G21 G90 G17\nG0 X3.2 Y3.2 Z5\nG1 Z-4 F200\nG1 X16.8 F600\nG1 Y12.8\nG1 X3.2\nG1 Y3.2\nG1 Y8\nG1 X16.8\n"
    "G1 X17 Y8\nG1 Y13\nG1 X3\nG1 Y3\nG1 X17\nG1 Y8\nG0 Z5\n";

jobs::HeatResultJob job_of(double share_least, double share_greatest) {
  jobs::HeatResultJob job;
  jobs::HeatSourceJob& source = job.heat.source;
  source.program = {"part.ngc", kProgram};
  source.pocket = {"pocket.json", kPocket};
  source.machining.tool_diameter = 6;
  source.cutting.teeth = 3, source.cutting.spindle_rpm = 8000;
  source.stock.block = heat::read_stock("40x36x10");
  heat::MaterialWords words{"6061-T6", {}};
  words.stated[static_cast<std::size_t>(Property::share)] = heat::Interval{share_least, share_greatest};
  job.heat.material = *heat::material_of(words);
  job.heat.film = {5, 50};
  job.heat.pitch = 5;
  return job;
}

std::vector<verify::Document> files_of(const jobs::HeatResultJob& job) {
  const jobs::HeatSourceJob& source = job.heat.source;
  std::vector<verify::Document> files{{source.program.name, source.program.bytes},
                                      {source.pocket.name, source.pocket.bytes}};
  for (const jobs::EarlierProgram& before : source.after)
    files.push_back({before.program.name, before.program.bytes});
  if (source.stock.outline)
    files.insert(files.begin() + 2, {source.stock.outline->name, source.stock.outline->bytes});
  return files;
}

/// With a temperature of the model itself, which narrows the heat.
jobs::HeatResultJob measured_job() {
  jobs::HeatResultJob job = job_of(0.05, 0.2);
  job.heat.measured = {{20, {10, 8, -7}, 12, 1000}};
  const auto rises = jobs::heat_result(job).value().found.middle().rises_k;
  job.heat.measured[0].celsius += 0.1 * rises[0];
  job.heat.measured[0].uncertainty_k = 0.02 * rises[0];
  return job;
}

/// A result with three films.
const cases::Prepared<Json> kHonest([] {
  return Json::parse(jobs::heat_result(measured_job()).value().json);
});

Result<verify::ClaimReport> judged(const Json& document, const jobs::HeatResultJob& job) {
  return verify::verify_heat_report({"r.json", document.dump()}, files_of(job));
}

/// Both of the field and of the middle case's.
void in_both(Json& document, const std::function<void(Json&)>& change) {
  change(document);
  change(document["cases"][1]);
}

bool refuted(const std::function<void(Json&)>& change) {
  Json document = *kHonest;
  change(document);
  const auto report = judged(document, job_of(0.05, 0.2));
  return !report || !report->findings.empty();
}

/// The sentence of what is refused, or all findings.
std::string said(const std::function<void(Json&)>& change) {
  Json document = *kHonest;
  change(document);
  const auto report = judged(document, job_of(0.05, 0.2));
  if (!report) return report.error().message;
  std::string all;
  for (const std::string& finding : report->findings) all += finding + "; ";
  return all;
}

/// A triangle with a hole, about the pocket.
const std::string kBlank =
    R"({"units":"mm","outer":[{"line":{"from":[-20,-10],"to":[50,-10]}},{"line":{"from":[50,-10],"to":[10,50]}},)"
    R"({"line":{"from":[10,50],"to":[-20,-10]}}],)"
    R"("holes":[[{"arc":{"from":[34,0],"to":[30,0],"centre":[32,0],"ccw":false}},)"
    R"({"arc":{"from":[30,0],"to":[34,0],"centre":[32,0],"ccw":false}}]]})";
const std::string kDrawn =
    "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n-10\n20\n-10\n10\n35\n20\n-"
    "10\n10\n30\n20\n"
    "30\n10\n-10\n20\n26\n0\nENDSEC\n0\nEOF\n";

jobs::HeatResultJob outline_job() {
  jobs::HeatResultJob job = job_of(0.1, 0.2);
  job.heat.source.stock = {};
  job.heat.source.stock.outline = jobs::File{"blank.json", kBlank};
  job.heat.source.stock.thickness = 9;
  return job;
}

TEST(VerifyHeat, AnOutlineIsThatOfItsFile) {
  const jobs::HeatResultJob job = outline_job();
  const Json honest = Json::parse(jobs::heat_result(job).value().json);
  const auto said_of = [&](const std::function<void(Json&)>& change) {
    Json document = honest;
    change(document);
    const auto report = judged(document, job);
    if (!report) return report.error().message;
    return report->findings.empty() ? std::string() : report->findings[0];
  };
  EXPECT_EQ(said_of([](Json&) {}), "");
  EXPECT_NE(said_of([](Json& d) { d["stock"]["outline"] = Json(); }).find("go together"), std::string::npos);
  EXPECT_NE(said_of([](Json& d) {
              d["stock"]["outline"]["regions"]["holes"] = Json::array();
            }).find("is not what blank.json means"),
            std::string::npos);
  EXPECT_NE(said_of([](Json& d) { d["stock"]["high_mm"][1] = 51; }).find("stock.high_mm[1]"),
            std::string::npos);
  EXPECT_NE(said_of([](Json& d) { d["stock"]["outline"]["regions"]["units"] = "inch"; }).find("units"),
            std::string::npos);
  // Its file is not named, though it is there.
  Json without = honest;
  without["inputs"].erase(2);
  std::vector<verify::Document> files = files_of(job);
  files.erase(files.begin() + 2);
  const auto lost = verify::verify_heat_report({"r.json", without.dump()}, files);
  ASSERT_FALSE(lost);
  EXPECT_NE(lost.error().message.find("go together"), std::string::npos) << lost.error().message;
  for (const char* key : {"regions", "tolerance_mm", "drawing", "scan"})
    EXPECT_NE(said_of([&](Json& d) { d["stock"]["outline"].erase(key); }), "") << key;
}

// What a file means is known to a tolerance that stands in the result, and a note says it.
TEST(VerifyHeat, TheToleranceOfAnOutlineIsNoted) {
  const jobs::HeatResultJob job = outline_job();
  Json document = Json::parse(jobs::heat_result(job).value().json);
  const auto noted = [&](double tolerance) {
    document["stock"]["outline"]["tolerance_mm"] = tolerance;
    const auto report = judged(document, job);
    return std::ranges::any_of(report.value().notes, [&](const std::string& note) {
      return note.starts_with("stock.outline is within ");
    });
  };
  EXPECT_FALSE(noted(0));
  EXPECT_TRUE(noted(0.001));
}

TEST(VerifyHeat, FilesHaveTheirRolesOnce) {
  const auto answer = [](const std::vector<std::string>& roles) {
    Json document = *kHonest;
    const jobs::HeatResultJob job = job_of(0.05, 0.2);
    std::vector<verify::Document> files = files_of(job);
    for (const std::string& role : roles) {
      document["inputs"].push_back({{"role", role}, {"path", "o"}, {"sha256", "x"}});
      files.push_back({"o", "{}"});
    }
    const auto report = verify::verify_heat_report({"r.json", document.dump()}, files);
    return report ? std::string() : report.error().message;
  };
  const auto wrong = [&](const std::vector<std::string>& roles) {
    return answer(roles) == "r.json: the files that it names have the role \"" + roles.back() +
                                "\" twice, or no such report has it";
  };
  EXPECT_EQ(answer({}), "");
  EXPECT_TRUE(wrong({"other"})) << answer({"other"});
  EXPECT_TRUE(wrong({"program"})) << answer({"program"});
  EXPECT_TRUE(wrong({"stock", "stock"})) << answer({"stock", "stock"});
  EXPECT_TRUE(wrong({"corrected", "corrected"})) << answer({"corrected", "corrected"});
  EXPECT_NE(answer({"stock"}).find("go together"), std::string::npos) << answer({"stock"});
}

TEST(VerifyHeat, WhatWasMeasuredIsHeldAgainstTheProgram) {
  EXPECT_NE(said([](Json& d) {
              d["measured"][0]["at_mm"][2] = -2;
              d["measured"][0]["at_mm"][1] = 3.2;
            }).find("measured[0] is in the air"),
            std::string::npos);
  EXPECT_NE(
      said([](Json& d) { d["measured"][0]["at_mm"][0] = 70; }).find("measured[0] is outside of the stock"),
      std::string::npos);
  EXPECT_NE(said([](Json& d) { d["measured"][0]["seconds"] = 1e4; }).find("outside of the program's time"),
            std::string::npos);
  EXPECT_NE(said([](Json& d) {
              d["calibrated"]["share"] = {0.05, 0.06};
            }).find("calibrated.share"),
            std::string::npos);
  EXPECT_NE(said([](Json& d) { d["measured"] = Json::array(); }).find("calibrated"), std::string::npos);
}

TEST(VerifyHeat, HonestResultsHoldAndWhatIsComputedIsNamed) {
  std::vector<jobs::HeatResultJob> jobs{job_of(0.05, 0.2), job_of(0, 0), job_of(0.1, 0.1)};
  jobs[2].heat.film = {200, 200};
  jobs.push_back(job_of(0, 0.2));
  jobs.back().heat.holding.held[of(heat::Side::x_low)] =
      jobs.back().heat.holding.held[of(heat::Side::x_high)] = true;
  jobs.back().heat.source.stock.block = heat::read_stock("50x40x6@-20,-9");
  jobs.back().heat.source.cutting.wear = {1, 1.5};
  jobs.push_back(job_of(0.1, 0.2));
  jobs.back().heat.source.pocket = {"ring.json", kRing};
  jobs.back().heat.source.program.bytes =
      "G21 G90 G17\nG0 X11 Y0 Z5\nG1 Z-2 F200\nG2 X11 Y0 I-11 J0 F600\nG1 X12\nG2 X12 Y0 I-12 J0\nG1 X10\nG2 "
      "X10 Y0 "
      "I-10 J0\nG0 Z5\n";
  jobs.back().heat.holding.datum = heat::Place{0, 0, 0};
  jobs.push_back(job_of(0.1, 0.2));
  for (const std::string& pocket : {kRounded, kRoundedBack}) {
    jobs.push_back(job_of(0.1, 0.2));
    jobs.back().heat.source.pocket = {"rounded.json", pocket};
  }
  jobs.push_back(jobs[4]);
  jobs.back().heat.source.pocket = {"disc.json", kDisc};
  // The first film carries nothing off, so that the workpiece does not always cool down; then none does.
  jobs.push_back(job_of(0.1, 0.2));
  jobs.back().heat.film = {0, 50};
  jobs.push_back(job_of(0.1, 0.2));
  jobs.back().heat.film = {0, 0};
  // Less heat than a joule.
  jobs.push_back(job_of(1e-4, 2e-4));
  jobs.push_back(job_of(0.1, 0.2));
  jobs.back().heat.source.after = {{{"before.ngc", kProgram.substr(0, 70) + "\nG0 Z5\n"}, 5}};
  jobs.push_back(outline_job());
  jobs.push_back(outline_job());
  jobs.back().heat.source.stock.outline = jobs::File{"blank.dxf", kDrawn};
  for (const jobs::HeatResultJob& job : jobs) {
    const auto made = jobs::heat_result(job);
    ASSERT_TRUE(made) << made.error().message;
    const auto report = judged(Json::parse(made->json), job);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->findings.empty()) << report->findings[0];
    EXPECT_GE(report->unchecked.size(), 4U);
  }
}

TEST(VerifyHeat, ThePlacesOfARingAreThoseOfBothCircles) {
  jobs::HeatResultJob job = job_of(0.1, 0.1);
  job.heat.source.pocket = {"ring.json", kRing};
  job.heat.source.program.bytes =
      "G21 G90 G17\nG0 X11 Y0 Z5\nG1 Z-2 F200\nG2 X11 Y0 I-11 J0 F600\nG1 X12\nG2 X12 Y0 I-12 J0\nG0 Z5\n";
  const Json result = Json::parse(jobs::heat_result(job).value().json);
  // The outer circle is 94.2 mm round, 19 places; each half of the island 22 mm, 5 places, and stays 1 mm
  // off.
  EXPECT_EQ(result["walls"].size(), 19U);
  EXPECT_EQ(result["uncut_places"], 10);
}

// Provenance and information.
bool is_free(const std::string& path) {
  return one_of(path, {"/inputs", "/warnings", "/seed", "/work", "/version", "/run"}) &&
         !one_of(path, {"/work_j"});
}

// A result of a kilobyte may not ask for a million places.
TEST(VerifyHeat, VoxelsTooSmallForTheWallsAreRefusedAtOnce) {
  for (const double voxel : {1e-12, 1e-6, 0.01}) {
    const std::string sentence = said([&](Json& d) { d["voxel_mm"] = voxel; });
    EXPECT_NE(sentence.find("the walls of pocket.json have more than 1000000 places"), std::string::npos)
        << sentence.substr(0, 200);
  }
  // Of many places that are not there some are named.
  const std::string sentence = said([](Json& d) { d["voxel_mm"] = 0.05; });
  EXPECT_NE(sentence.find("walls has no place at"), std::string::npos) << sentence.substr(0, 200);
  EXPECT_LT(std::count(sentence.begin(), sentence.end(), ';'), 400);
}

TEST(VerifyHeat, AWallOfOnePlaceMoreThanTheLimitIsRefused) {
  jobs::HeatResultJob job = job_of(0.05, 0.2);
  job.heat.source.program.bytes = "G21 G90 G17\nG0 X3 Y3 Z5\nG1 Z-0.00001 F200\nG1 Y5 F600\nG0 Z5\n";
  Json document = *kHonest;
  // Four walls of 20 and 16 mm, on one height.
  document["voxel_mm"] = 0.0000719;
  const auto report = judged(document, job);
  ASSERT_FALSE(report);
  EXPECT_NE(report.error().message.find("more than 1000000 places"), std::string::npos);
}

TEST(VerifyHeat, NoFieldCanBeAbsentOrAnother) {
  EXPECT_FALSE(refuted([](Json&) {}));
  std::size_t count = 0;
  each_path(*kHonest, "", [&](const std::string& path) {
    // One wall and one case stand for all.
    if (is_free(path) ||
        one_of(path, {"/walls/1", "/walls/2", "/walls/3", "/cases/1", "/cases/2", "/errors_um/"}))
      return;
    const std::size_t slash = path.rfind('/');
    const std::string key = path.substr(slash + 1);
    const auto parent = [&](Json& d) -> Json& { return slash == 0 ? d : d.at(path.substr(0, slash)); };
    ++count;
    if (key.find_first_not_of("0123456789") != key.npos) {
      EXPECT_TRUE(refuted([&](Json& d) { parent(d).erase(key); })) << "without " << path;
      EXPECT_TRUE(refuted([&](Json& d) { parent(d)[key + "_"] = 0; })) << "more beside " << path;
    }
    const bool may_be_null = one_of(path, {"glass_c", "datum_mm", "outline", "correction"});
    if (!may_be_null) {
      EXPECT_TRUE(refuted([&](Json& d) { d.at(path) = Json(); })) << path << " null";
    }
    if (path != "/material/name") {
      EXPECT_TRUE(refuted([&](Json& d) { d.at(path) = "x"; })) << path << " x";
    }
  });
  EXPECT_GT(count, 100U);
}

TEST(VerifyHeat, NoFigureCanBeAnother) {
  std::size_t count = 0;
  each_path(*kHonest, "", [&](const std::string& path) {
    if (!is_number(kHonest->at(path)) || is_free(path)) return;
    // These were stated, or are computed in voxels and held by nothing else; a little more of the stock, or
    // left on walls, changes no cut.
    if (one_of(path, {"/conductivity",  "/density",     "/heat_capacity",    "/expansion_per_k",
                      "/youngs",        "/poisson",     "/ambient_c",        "/step_over",
                      "/rapid",         "stress_at_mm", "stress_seconds",    "/stock/",
                      "stock_to_leave", "/voxel_mm",    "/cases/1/half_s",   "/cases/1/tenth_s",
                      "/yield_mpa/1",   "/melting_c/1", "/measured/0/at_mm", "/measured/0/seconds"}))
      return;
    ++count;
    for (const double factor : {0.98, 1.02})
      EXPECT_TRUE(refuted([&](Json& d) {
        Json& value = d.at(path);
        value = value.get<double>() * factor + (factor > 1 ? 0.01 : -0.01);
      })) << path
          << " times " << factor;
  });
  EXPECT_GT(count, 90U);
}

TEST(VerifyHeat, LiesThatGoTogetherWithMostOfTheRestAreFound) {
  // The worst place is left out, with its errors.
  EXPECT_NE(said([](Json& d) {
              d["walls"].erase(0);
              for (std::size_t i = 0; i < 3; ++i) d["cases"][i]["errors_um"].erase(0);
            }).find("which the program cuts"),
            std::string::npos);
  // A place is there twice, and another is not.
  EXPECT_TRUE(refuted([](Json& d) { d["walls"][1] = d["walls"][0]; }));
  // Another moment.
  EXPECT_NE(said([](Json& d) { d["walls"][0]["seconds"] = 1; }).find("does not cut the place then"),
            std::string::npos);
  // Heat is not all somewhere, the same in all places where it is said.
  EXPECT_NE(said([](Json& d) {
              for (Json* at : {&d, &d["cases"][1]}) {
                Json& stored = (*at)["heat_balance"]["stored_j"];
                stored = 0.9 * stored.get<double>();
              }
            }).find("is not what is stored, lost and removed"),
            std::string::npos);
  // A scaling that leaves less than it does, and one that is not the best.
  EXPECT_TRUE(refuted([](Json& d) { d["uniform_scaling"]["left_um"]["most"] = 0; }));
  EXPECT_NE(said([](Json& d) {
              for (Json* at : {&d["uniform_scaling"], &d["cases"][1]["uniform_scaling"]})
                (*at)["factor"] = 1.001;
            }).find("least squares"),
            std::string::npos);
  // A larger block, in which the same is cut, holds as much; one that the program leaves does not.
  EXPECT_NE(said([](Json& d) { d["stock"]["low_mm"][0] = 4; }).find("beyond the stock"), std::string::npos);
  // A material that does not hold what the workpiece gets.
  EXPECT_NE(said([](Json& d) { d["ambient_c"] = 900; }).find("beyond limit_c throughout"), std::string::npos);
  // More of the power.
  EXPECT_NE(said([](Json& d) { d["material"]["share"][1] = 0.1; }).find("into_workpiece_j"),
            std::string::npos);
  EXPECT_NE(said([](Json& d) { d["status"] = "proved"; }).find("status"), std::string::npos);
}

bool says(const std::string& sentences, const std::string& words) {
  return sentences.find(words) != sentences.npos;
}

TEST(VerifyHeat, IntervalsOfStatedFiguresAreHeldAtBothEnds) {
  struct Bounds {
    const char* path;
    double least, greatest;
  };
  for (const auto& [path, least, greatest] :
       {Bounds{"wear", 1, 5}, Bounds{"film_w_m2k", 0, 1e5}, Bounds{"material/cutting_force_n_mm2", 1, 1e4},
        Bounds{"material/force_exponent", 0, 0.6}, Bounds{"material/share", 0, 1},
        Bounds{"material/conductivity_w_mk", 1e-9, 1e6}, Bounds{"material/yield_mpa", 1, 5000},
        Bounds{"material/poisson", 0, 0.49}, Bounds{"material/melting_c", 40, 4000}}) {
    const std::string field = std::string("/") + path;
    const auto answer = [&field](double low, double high) {
      return said([&](Json& d) { d.at(field) = Json::array({low, high}); });
    };
    const std::string wrong = "is no interval";
    for (const auto& [low, high] : {std::pair{least, greatest}, {least, least}, {greatest, greatest}})
      EXPECT_FALSE(says(answer(low, high), wrong)) << path << ' ' << low << ' ' << high;
    for (const auto& [low, high] : {std::pair{least - 1e-6 * least - 1e-10, greatest},
                                    {least, greatest * (1 + 1e-9)},
                                    {greatest, least}})
      EXPECT_TRUE(says(answer(low, high), wrong)) << path << ' ' << low << ' ' << high;
  }
}

TEST(VerifyHeat, WhatStandsForNoToolNoBlockAndNoMaterialIsSaid) {
  for (const char* key : {"tool_mm", "teeth", "spindle_rpm"})
    EXPECT_TRUE(
        says(said([&](Json& d) { d[key] = 0; }), "tool_mm, teeth and spindle_rpm are not all above 0"));
  EXPECT_FALSE(says(said([](Json& d) { d["teeth"] = 1; }), "above 0"));
  EXPECT_TRUE(says(said([](Json& d) { d["voxel_mm"] = 0; }), "voxel_mm is not above 0"));
  for (const char* axis : {"0", "1"})
    EXPECT_TRUE(says(said([&](Json& d) {
                       d.at(std::string("/stock/low_mm/") + axis) =
                           double(d.at(std::string("/stock/high_mm/") + axis));
                     }),
                     "stock is no block"));
  EXPECT_TRUE(says(said([](Json& d) { d["stock"]["thickness_mm"] = 0; }), "stock is no block"));
  EXPECT_TRUE(
      says(said([](Json& d) { d["material"]["melting_c"] = Json(); }), "neither melting_c nor glass_c"));
  EXPECT_TRUE(says(said([](Json& d) {
                     d["material"]["melting_c"] = Json();
                     d["material"]["glass_c"] = Json::array({100, 120});
                   }),
                   " and is to be 100;"));
}

TEST(VerifyHeat, MeasurementsHaveAnUncertaintyAndARiseForEachCase) {
  const auto uncertain = [](double kelvin) {
    return said([&](Json& d) { d["measured"][0]["uncertainty_k"] = kelvin; });
  };
  EXPECT_TRUE(says(uncertain(0), "field measured[0].uncertainty_k is not above 0")) << uncertain(0);
  EXPECT_FALSE(says(uncertain(1e-6), "above 0"));
  const auto wrong = [](const Json& rises) {
    return says(said([&](Json& d) { d["measured"][0]["rises_k"] = rises; }),
                "field measured[0].rises_k is not a rise above 0 for each case");
  };
  EXPECT_TRUE(wrong({1, 2}) && wrong({1, 2, 3, 4}) && wrong(Json::array({1})) && wrong(Json::array()));
  EXPECT_TRUE(wrong({0, 1, 2}) && wrong({1, 2, 0}) && wrong({1, -1, 2}));
  EXPECT_FALSE(wrong({0.25, 0.5, 0.75}));
  // One film is one case.
  jobs::HeatResultJob job = measured_job();
  job.heat.film = {20, 20};
  const Json single = Json::parse(jobs::heat_result(job).value().json);
  ASSERT_EQ(single["measured"][0]["rises_k"].size(), 1U);
  const auto report = judged(single, job);
  ASSERT_TRUE(report) << report.error().message;
  EXPECT_TRUE(report->findings.empty()) << report->findings[0];
}

TEST(VerifyHeat, TheHeatThatAMeasurementSupportsIsToldToOnePartInAHundredMillion) {
  const auto off_by = [](double part) {
    return says(said([&](Json& d) {
                  Json& m = d["measured"][0];
                  // Much heat, of which written figures are a small part.
                  m["rises_k"] = {1e-6, 1e-6, 1e-6};
                  const Json& work = d["booked"]["work_j"];
                  const double middle = (double(work[0]) + double(work[1])) / 2;
                  const double high =
                      double(m["temperature_c"]) + double(m["uncertainty_k"]) - double(d["ambient_c"]);
                  m["supported_j"][1] = high * middle / 1e-6 * (1 + part);
                }),
                "measured[0].supported_j[1] is ");
  };
  EXPECT_FALSE(off_by(0.5e-8) || off_by(-0.5e-8));
  EXPECT_TRUE(off_by(1.5e-8) && off_by(-1.5e-8));
}

/// Holds the figures of a program's work against what was found.
struct Held : private verify::HeldFigures {
  std::string said(const Json& written, const verify::BookedWork& found) {
    const std::string text = written.dump();
    verify::ReportFields fields(verify::parse_json(text, "r.json").value(), "", complaint_);
    hold_booked(fields, found);
    std::string all = complaint_;
    for (const std::string& finding : claims_.findings) all += finding + "; ";
    return all;
  }
};

TEST(VerifyHeat, SumsOverPiecesAreToldToOnePartInABillion) {
  const double sum = 1e6;
  const verify::BookedWork found{sum, sum, sum, {0, sum}, {0, sum}, {0, sum}, {0, sum}, ""};
  const Json honest{{"seconds", sum},
                    {"cutting_seconds", sum},
                    {"volume_mm3", sum},
                    {"work_j", {0, sum}},
                    {"into_workpiece_j", {0, sum}},
                    {"carried_off_j", {0, sum}},
                    {"greatest_power_w", {0, sum}}};
  EXPECT_EQ(Held().said(honest, found), "");
  for (const char* path : {"seconds", "cutting_seconds", "volume_mm3", "work_j/1", "into_workpiece_j/1",
                           "carried_off_j/1", "greatest_power_w/1"})
    for (const double off : {0.5e-9, 1.5e-9}) {
      Json other = honest;
      other.at(std::string("/") + path) = sum * (1 + off);
      EXPECT_EQ(!Held().said(other, found).empty(), off > 1e-9) << path << off;
    }
}

// What a command line would be told as its own fault is that of the result; what is wrong with a file is said
// of the file.
TEST(VerifyHeat, WhatCannotBeFollowedIsSaidOfTheResultOrOfItsProgram) {
  Json beyond = *kHonest;
  beyond["step_over"] = 5;
  const auto of_the_result = judged(beyond, job_of(0.05, 0.2));
  ASSERT_FALSE(of_the_result);
  EXPECT_EQ(of_the_result.error().code, ErrorCode::bad_input);
  EXPECT_TRUE(says(of_the_result.error().message, "r.json: a step-over of 5"))
      << of_the_result.error().message;
  jobs::HeatResultJob other = job_of(0.05, 0.2);
  other.heat.source.program.bytes = "G21 G90 G17\nG0 Z5\n";
  const auto of_the_program = judged(*kHonest, other);
  ASSERT_FALSE(of_the_program);
  EXPECT_EQ(of_the_program.error().message.rfind("part.ngc: ", 0), 0U) << of_the_program.error().message;
}

TEST(VerifyHeat, StressesAreInTheStockAndInTheProgram) {
  EXPECT_TRUE(says(said([](Json& d) { d["cases"][0]["warmest_k"] = -1; }), "or a stress below 0"));
  EXPECT_TRUE(says(said([](Json& d) { d["cases"][0]["stress_mpa"] = -1; }), "or a stress below 0"));
  const auto& stock = (*kHonest)["stock"];
  for (int axis = 0; axis < 3; ++axis) {
    const double low = axis < 2 ? double(stock["low_mm"][axis]) : -double(stock["thickness_mm"]);
    const double high = axis < 2 ? double(stock["high_mm"][axis]) : 0;
    const auto outside = [&](double at) {
      return says(said([&](Json& d) { d["cases"][0]["stress_at_mm"][axis] = at; }), "outside of the stock");
    };
    EXPECT_TRUE(outside(low - 0.001) && outside(high + 0.001)) << axis;
    EXPECT_FALSE(outside(low) || outside(high)) << axis;
  }
  const auto late = [](double seconds) {
    return says(said([&](Json& d) { d["cases"][0]["stress_seconds"] = seconds; }), "outside of the program");
  };
  const double end = (*kHonest)["booked"]["seconds"];
  EXPECT_TRUE(late(-0.001) && late(end + 0.001));
  EXPECT_FALSE(late(0) || late(end));
}

TEST(VerifyHeat, WhatCoolsDownComesToAHalfBeforeItComesToATenth) {
  const auto wrong = [](std::size_t which, Json half, Json tenth) {
    return says(said([&](Json& d) {
                  Json& one = d["cases"][which];
                  one["half_s"] = half, one["tenth_s"] = tenth;
                  if (which == 0) one["film_w_m2k"] = 0;
                }),
                "do not go together");
  };
  const Json never;
  EXPECT_TRUE(wrong(1, never, 5) && wrong(1, 5, 4) && wrong(1, 5, 5) && wrong(1, 0, never) && wrong(1, 0, 5));
  EXPECT_FALSE(wrong(1, never, never) || wrong(1, 5, never) || wrong(1, 5, 6) || wrong(0, never, never));
  EXPECT_TRUE(wrong(0, 5, 6));
}

TEST(VerifyHeat, EachFindingNamesWhatItIsOf) {
  const auto shift = [](Json& at) { at["uniform_scaling"]["shift_um"][0] = 7; };
  EXPECT_TRUE(says(said([&](Json& d) { in_both(d, shift); }), "shift_um does not leave the least squares"));
  const auto factor = [](Json& at) { at["uniform_scaling"]["factor"] = 1.001; };
  EXPECT_TRUE(says(said([&](Json& d) { in_both(d, factor); }), "factor does not leave the least squares"));
  EXPECT_TRUE(says(said([](Json& d) { d["walls"][1] = d["walls"][0]; }), "is there twice"));
  for (const int axis : {0, 1})
    EXPECT_TRUE(says(said([&](Json& d) {
                       Json& out = d["walls"][0]["outward"][axis];
                       out = double(out) + 1.5e-9;
                     }),
                     "walls[0].outward is "))
        << axis;
}

TEST(VerifyHeat, FiguresOfAllCasesAreToldBySentencesOfTheirOwn) {
  const auto off = [](const char* path, double by) {
    return said([&](Json& d) { d.at(path) = double(d.at(path)) + by; });
  };
  for (const char* path : {"/cases/0/film_w_m2k", "/cases/1/film_w_m2k", "/cases/2/film_w_m2k"})
    EXPECT_TRUE(says(off(path, 0.5), "].film_w_m2k is ")) << path;
  for (const char* path : {"/cases/1/uniform_scaling/centre_mm/0", "/cases/1/uniform_scaling/centre_mm/1"})
    EXPECT_TRUE(says(off(path, 1e-5), "cases[1].uniform_scaling.centre_mm is ")) << path;
  EXPECT_TRUE(says(off("/walls/0/error_um", 1e-6), "walls[0].error_um is "));
  EXPECT_TRUE(says(off("/walls/0/errors_um/1", 0.01), "walls[0].errors_um[1] is "));
  for (const char* path : {"/uniform_scaling/shift_um/0", "/uniform_scaling/shift_um/1"})
    EXPECT_TRUE(says(off(path, 1e-6), "uniform_scaling.shift_um is ")) << path;
  EXPECT_TRUE(says(off("/warmest_k/middle", 1e-6), "warmest_k.middle is "));
  EXPECT_TRUE(says(off("/stress_mpa/middle", 1e-6), "stress_mpa.middle is "));
}

TEST(VerifyHeat, TheTimesOfCoolingDownAreTheLeastAndTheGreatestOfTheCases) {
  for (const std::string key : {"half_s", "tenth_s"}) {
    const Json honest = (*kHonest)["cooling_down"][key];
    ASSERT_TRUE(honest.size() == 2 && is_number(honest[0]) && is_number(honest[1])) << honest.dump();
    const auto wrong = [&](const Json& least, const Json& greatest) {
      return says(said([&](Json& d) {
                    d["cooling_down"][key] = Json::array({least, greatest});
                  }),
                  "cooling_down." + key + " is not that of the cases");
    };
    EXPECT_FALSE(wrong(honest[0], honest[1]));
    EXPECT_TRUE(wrong(Json(), honest[1]) && wrong(honest[0], Json())) << key;
    EXPECT_TRUE(wrong(double(honest[0]) + 1e-6, honest[1]) && wrong(honest[0], double(honest[1]) + 1e-6))
        << key;
    EXPECT_TRUE(says(said([&](Json& d) { d["cooling_down"][key].push_back(honest[1]); }),
                     "cooling_down." + key + " is not that of the cases"));
  }
}

// The model may lose a thousandth of the heat, and says how much it did.
TEST(VerifyHeat, AThousandthOfTheHeatMayBeMissingAndIsSaid) {
  const auto with_missing = [](double part) {
    return said([&](Json& d) {
      in_both(d, [&](Json& at) {
        Json& b = at["heat_balance"];
        const double stored = double(b["stored_j"]) - part * double(b["in_j"]);
        b["stored_j"] = stored;
        b["unaccounted_part"] = part * double(b["in_j"]) / std::max(double(b["in_j"]), stored);
      });
    });
  };
  EXPECT_FALSE(says(with_missing(5e-4), "heat_balance")) << with_missing(5e-4);
  EXPECT_TRUE(says(with_missing(2e-3), "is not what is stored, lost and removed"));
}

// A pass that comes as near to a wall as it has to, but for a tenth of a nanometre, may cut it or not.
TEST(VerifyHeat, APlaceThatRoundingDecidesMayBeThereOrNot) {
  jobs::HeatResultJob job = job_of(0.1, 0.1);
  job.heat.film = {20, 20};
  job.heat.source.program.bytes = "G21 G90 G17\nG0 X3.0999999999 Y5 Z5\nG1 Z-4 F200\nG1 Y11 F600\nG0 Z5\n";
  Json document = Json::parse(jobs::heat_result(job).value().json);
  ASSERT_FALSE(document["walls"].empty());
  const auto answer = [&] {
    const auto report = judged(document, job);
    std::string all;
    for (const std::string& finding : report.value().findings) all += finding + "; ";
    return all;
  };
  EXPECT_EQ(answer(), "");
  document["walls"].erase(0);
  document["cases"][0]["errors_um"].erase(0);
  EXPECT_FALSE(says(answer(), "which the program")) << answer();
}

verify::BookedWork booked(const verify::CutPiece& piece) {
  const verify::CheckedCutting cutting{6, 3, 8000, {100, 100}, {0.1, 0.2}, {1, 1}, {1, 1}};
  return verify::booked_work({{piece}, 1}, {0, 0, 40, 36, 10}, cutting, 0);
}

verify::CutPiece straight_down(double x, double y, double depth) {
  verify::CutPiece down;
  down.seconds = 1, down.from_x = down.to_x = x, down.from_y = down.to_y = y;
  down.to_z = -depth, down.floor_area = 10;
  return down;
}

// Straight down beside the block: the tool's disc meets it or not.
TEST(VerifyHeat, AToolBesideTheBlockCutsNothingOfIt) {
  const auto volume = [](double x, double y) { return booked(straight_down(x, y, 1)).volume_mm3; };
  for (const auto& [x, y] : {std::pair{-2.0, -2.0}, {-2.5, 18.0}, {18.0, -2.5}, {42.5, 18.0}, {18.0, 38.5}})
    EXPECT_EQ(volume(x, y), 10) << x << ' ' << y;
  for (const auto& [x, y] : {std::pair{-2.5, -2.5},
                             {42.5, 38.5},
                             {-3.5, 18.0},
                             {18.0, -3.5},
                             {43.5, 18.0},
                             {18.0, 39.5},
                             {-3.0, 18.0}})
    EXPECT_EQ(volume(x, y), 0) << x << ' ' << y;
  // The middle of a ramp counts.
  verify::CutPiece ramp = straight_down(18, 18, 1);
  ramp.from_x = -6, ramp.to_x = -1;
  EXPECT_EQ(booked(ramp).volume_mm3, 0);
  ramp = straight_down(18, 18, 1);
  ramp.from_y = -6, ramp.to_y = -1;
  EXPECT_EQ(booked(ramp).volume_mm3, 0);
}

/// A millimetre deep along X, 2 mm of it; the engaged arc begins straight up from the middle, in Y.
verify::CutPiece along(double y, double arc, double from = 1.5707963267948966) {
  verify::CutPiece across;
  across.seconds = 1, across.from_x = 10, across.to_x = 12, across.length = 2;
  across.from_y = across.to_y = y, across.from_z = across.to_z = -1;
  across.rim.push_back({-1, 0, from, from + arc, 0.5});
  return across;
}

TEST(VerifyHeat, WhatIsBelowTheBlockOrTakesNoTimeIsNoCut) {
  EXPECT_EQ(booked(straight_down(18, 18, 12)).volume_mm3, 100);
  verify::CutPiece piece = along(18, 1);
  EXPECT_EQ(booked(piece).volume_mm3, 1);
  const double work = booked(piece).work_j.greatest;
  EXPECT_GT(work, 0);
  piece.rim.push_back({-12, -11, 1, 2, 0.5});
  piece.rim.push_back({-1, 0, 1, 2, 0});
  piece.rim.push_back({-1, 0, 1, 1, 0.5});
  EXPECT_EQ(booked(piece).volume_mm3, 1);
  EXPECT_EQ(booked(piece).work_j.greatest, work);
  piece.seconds = 0.5;
  EXPECT_EQ(booked(piece).seconds, 0.5);
  piece.seconds = 0;
  EXPECT_EQ(booked(piece).volume_mm3, 0);
}

// A thin chip takes most force with the steep exponent, and a thick one with the mild one.
TEST(VerifyHeat, TheWorkIsOfTheExponentThatMakesItLeastAndGreatest) {
  verify::CutPiece down = straight_down(18, 18, 8);
  // 400 teeth a second, 80 mm3 by 100 N/mm2.
  for (const auto& [seconds, chip] : {std::pair{1.0, 0.02}, {0.01, 2.0}}) {
    down.seconds = seconds;
    const double mild = std::pow(chip, -0.1), steep = std::pow(chip, -0.2);
    EXPECT_DOUBLE_EQ(booked(down).work_j.least, 8 * std::min(mild, steep)) << chip;
    EXPECT_DOUBLE_EQ(booked(down).work_j.greatest, 8 * std::max(mild, steep)) << chip;
  }
}

// Along the lower side of the block, outside of it: the rim's highest place is what meets it.
TEST(VerifyHeat, AContactMayCrossTheBordersOfTheBlockByAHundredthOfAMillimetre) {
  EXPECT_EQ(booked(along(-2.995, 0.001)).volume_mm3, 0);
  EXPECT_EQ(booked(along(-2.985, 0.001)).volume_mm3, 1);
  // The arc's end is 3 (1 - cos) lower.
  EXPECT_EQ(booked(along(-2.985, 0.11)).fault, "");
  EXPECT_TRUE(says(booked(along(-2.985, 0.14)).fault, "mm beyond the stock"));
  // A tool that is within the block cuts what its rim meets, on the border too.
  EXPECT_EQ(booked(along(3, 0.001, -1.5707963267948966)).volume_mm3, 1);
}

}  // namespace
}  // namespace lekalo::verify_heat_test
